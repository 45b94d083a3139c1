#include "slice_capture.hpp"

#include <algorithm>
#include <string>

namespace penumbra::opengl {
namespace {

/// Whether a closed mesh's triangles look inwards.
bool is_inside_out(const Mesh<float>& mesh) {
    float six_volumes = 0.0F;
    const auto corner = [&](const glm::uvec3& t, int k) { return mesh.positions[t[k]] - mesh.positions[0]; };
    for (const glm::uvec3& t : mesh.triangles)
        six_volumes += glm::dot(corner(t, 0), glm::cross(corner(t, 1), corner(t, 2)));
    return six_volumes < 0.0F;
}

}  // namespace

SliceView::SliceView(const std::vector<Mesh<float>>& casters, const RectLight<float>& light,
                     const OcclusionTextureOptions& options)
    : half_size(penumbra::half_size(light)), faces(options.faces), closes_leaks(options.blend.close_leaks) {
    const Box3<float> box = bounds(casters);
    frame = light_frame(light, is_empty(box) ? Vec3<float>(0.0F) : (box.min + box.max) * 0.5F - light.center);
    LitTriangles<float> all;
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const LitTriangles<float> lit = lit_triangles<float>({casters[i]}, frame, faces);
        all.vertices_ls.insert(all.vertices_ls.end(), lit.vertices_ls.begin(), lit.vertices_ls.end());
        const bool encloses = faces != SliceFaces::all && !lit.faces.empty() && lit.faces[0] == faces;
        const bool inside_out = encloses && is_inside_out(casters[i]);
        if (!runs.empty() && runs.back().encloses == encloses && runs.back().inside_out == inside_out)
            runs.back().end = i + 1;
        else
            runs.push_back({i, i + 1, encloses, inside_out});
    }
    constexpr int margin = 2;  // empty texels around the casters, as in the C++
    camera = fit_slice_camera(all.vertices_ls, half_size, options.projection, options.resolution, margin);
    range = slice_range(all, options.slices);
}

bool SliceView::has_solids() const {
    return faces == SliceFaces::solid && std::any_of(runs.begin(), runs.end(), [](const Run& r) { return r.encloses; });
}

SliceCapturePasses::SliceCapturePasses(ProgramCache& programs, const Texture& masks, const Texture* depths, int groups,
                                       bool solids)
    : has_depths_(depths != nullptr), has_solids_(solids), size_(masks.size()) {
    const bool resolves = has_depths_ || has_solids_;
    if (resolves) masks_ = Texture::array(GL_RGBA8, size_, groups);
    if (has_depths_) depths_ = Texture::array(GL_RGBA8, size_, groups);
    if (has_solids_) windings_ = Texture::array(GL_RGBA16F, size_, groups);
    const Source vertex{{}, {library("occlusion_texture/slice_capture.vert")}};
    for (int first = 0; first < groups; first += 4) {
        const int end = std::min(first + 4, groups);
        const auto program = [&](const char* what) {
            return &programs.get(vertex, {{std::string("PENUMBRA_CAPTURE PENUMBRA_CAPTURE_") + what,
                                           "PENUMBRA_CAPTURE_TARGETS " + std::to_string(end - first)},
                                          {library("occlusion_texture/slice_capture.frag")}});
        };
        std::vector<Framebuffer::Target> surfaces, windings;
        for (int group = first; group < end; ++group) {
            surfaces.push_back({resolves ? masks_ : masks, group});
            if (has_depths_) surfaces.push_back({depths_, group});
            if (has_solids_) windings.push_back({windings_, group});
        }
        draws_.push_back({4 * first, end - first, program(has_depths_ ? "SURFACES" : "MASKS"),
                          has_solids_ ? program("WINDINGS") : nullptr, Framebuffer(surfaces),
                          has_solids_ ? Framebuffer(windings) : Framebuffer()});
    }
    if (!resolves) return;
    resolve_ = &programs.full_screen({{std::string("PENUMBRA_RESOLVE_SOLIDS ") + (has_solids_ ? "1" : "0"),
                                       std::string("PENUMBRA_RESOLVE_DEPTHS ") + (has_depths_ ? "1" : "0")},
                                      {library("occlusion_texture/slice_resolve.frag")}});
    for (int group = 0; group < groups; ++group) {
        std::vector<Framebuffer::Target> targets{{masks, group}};
        if (has_depths_) targets.push_back({*depths, group});
        resolve_targets_.emplace_back(targets);
    }
}

void SliceCapturePasses::capture(const SliceView& view, const Geometry& geometry, bool clip_zero_to_one) const {
    for (const Draw& draw : draws_) {
        begin(*draw.surfaces, draw, view, clip_zero_to_one);
        draw_surfaces(draw, view, geometry);
        if (!has_solids_) continue;
        begin(*draw.windings, draw, view, clip_zero_to_one);
        draw_windings(draw, view, geometry);
    }
}

void SliceCapturePasses::begin(const Program& program, const Draw& draw, const SliceView& view,
                               bool clip_zero_to_one) const {
    program.use();
    program.set("penumbra_world", glm::mat4(1.0F));
    program.set("penumbra_light_origin", view.frame.origin);
    program.set("penumbra_light_u", view.frame.u);
    program.set("penumbra_light_v", view.frame.v);
    program.set("penumbra_light_normal", view.frame.normal);
    program.set("penumbra_convergence", view.camera.convergence);
    program.set("penumbra_origin_tx", view.camera.origin_tx);
    program.set("penumbra_scale_tx", view.camera.scale_tx);
    program.set("penumbra_size_tx", glm::vec2(size_));
    program.set("penumbra_farthest", std::max(view.range.bottom(view.range.count - 1) * 1.1F, 1e-30F));
    program.set("penumbra_clip_zero_to_one", clip_zero_to_one);
    program.set("penumbra_range_first", view.range.first);
    program.set("penumbra_range_thickness", view.range.thickness);
    program.set("penumbra_range_count", view.range.count);
    program.set("penumbra_first", draw.first);
}

void SliceCapturePasses::draw_surfaces(const Draw& draw, const SliceView& view, const Geometry& geometry) const {
    for (int target = 0; target < draw.groups * (has_depths_ ? 2 : 1); ++target)
        draw.surface_target.clear_color(target, glm::vec4(0.0F));
    const bool facing = view.faces == SliceFaces::facing;
    for (const SliceView::Run& run : view.runs) {
        State state;
        state.blend = GL_MAX;
        if (facing && run.encloses) state.cull = run.inside_out ? GL_BACK : GL_FRONT;
        state.set();
        draw.surfaces->set("penumbra_close_leaks", view.closes_leaks && (facing || !run.encloses));
        geometry.draw_casters(run.first, run.end);
    }
}

void SliceCapturePasses::draw_windings(const Draw& draw, const SliceView& view, const Geometry& geometry) const {
    for (int target = 0; target < draw.groups; ++target) draw.winding_target.clear_color(target, glm::vec4(0.0F));
    State state;
    state.blend = GL_FUNC_ADD;
    state.set();
    for (const SliceView::Run& run : view.runs) {
        if (!run.encloses) continue;
        glFrontFace(run.inside_out ? GL_CW : GL_CCW);
        geometry.draw_casters(run.first, run.end);
    }
    glFrontFace(GL_CCW);
}

void SliceCapturePasses::resolve() const {
    State{}.set();
    resolve_->use();
    resolve_->set("penumbra_masks", 0, masks_);
    if (has_depths_) resolve_->set("penumbra_depths", 1, depths_);
    if (has_solids_) resolve_->set("penumbra_windings", 2, windings_);
    for (std::size_t group = 0; group < resolve_targets_.size(); ++group) {
        resolve_targets_[group].bind();
        resolve_->set("penumbra_group", static_cast<int>(group));
        resolve_->draw_full_screen();
    }
}

}  // namespace penumbra::opengl
