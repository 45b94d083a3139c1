// Soft shadows of a line light from shadow maps of a few of its points.
//
// What an engine provides: its casters' and receivers' positions; two or three images of R32F, as high as all maps
// together, one or two depth buffers as large, two of RG32UI with a texel for 32 columns, one or two of RGBA32F; and
// world-space positions of what it shades. It gets, per frame: a depth map from each point (casters once, twice if one
// is closed; then what only receives), two full-screen passes over all maps, and a function that its shading calls per
// light. The modes of intervals are for lights and casters that stay: the host finds segments, no pass is drawn.
#include <algorithm>
#include <memory>
#include <penumbra/soft_shadow_map/light_map_texels.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <tuple>
#include <utility>

#include "method.hpp"
#include "planned.hpp"

namespace penumbra::opengl {
namespace {

constexpr std::string_view shade_maps = R"glsl(
uniform highp sampler2D maps, edges;
uniform penumbra_LightFrame light;
uniform penumbra_LightMapView view;
uniform int count;
void main() {
    vec4 point = penumbra_point();
    if (point.w == 0.0) discard;
    visible = penumbra_is_lit()
                  ? 1.0
                  : penumbra_visibility(maps, edges, view, count, penumbra_to_light(light, point.xyz));
}
)glsl";

constexpr std::string_view shade_segments = R"glsl(
uniform highp sampler2D segments;
uniform penumbra_LightFrame light;
uniform penumbra_LightMapView view;
uniform float half_length;
void main() {
    vec4 point = penumbra_point();
    if (point.w == 0.0) discard;
    visible = penumbra_is_lit()
                  ? 1.0
                  : penumbra_visibility(segments, view, -half_length, half_length, penumbra_to_light(light, point.xyz));
}
)glsl";

class SoftShadowMapMethod final : public Method {
  public:
    bool takes(const scenes::Light& light) const override { return std::holds_alternative<LinearLight<float>>(light); }
    std::vector<Knob> knobs() override;
    void prepare(const scenes::Scene& scene, const Geometry&) override;
    std::optional<TileView> tile_view() const override;
    void draw(const Geometry& geometry, const Frame& frame, Timers& timers) override;
    std::string plan(const scenes::Scene& scene, float tolerance) override;
    Query by_cpp(const scenes::Scene& scene) const override;

  private:
    using Options = SoftShadowMapOptions;
    /// Casters that are drawn alike.
    struct Run {
        std::size_t first, end;
        bool solid;
    };

    Options options() const;
    bool has_segments() const {
        return options_.mode == LinearMode::intervals || options_.mode == LinearMode::interval_mask;
    }
    bool has_skins() const { return options_.mode == LinearMode::skins; }
    bool has_edges() const { return has_skins() && options_.transition == SkinTransition::exact; }
    void make_programs();
    void make_textures();

    void begin(const Program& program) const;
    template <class Draw>
    void draw_maps(const Program& program, const Framebuffer& target, const Draw& draw) const;
    void draw_surfaces(const Geometry& geometry) const;
    void draw_discontinuities() const;
    void draw_skins() const;
    void shade(const Frame& frame) const;

    Options options_;

    // what the light sees
    LightMapGeometry<float> scene_;  // without its meshes: the GPU has its own
    std::vector<Run> runs_;
    bool solid_ = false;  // any

    std::tuple<LinearMode, SkinTransition, StepDetector, bool> programs_are_for_{};
    Program casters_, insides_, receivers_, discontinuities_, rows_, skins_, shade_;

    std::tuple<int, int, bool, bool, bool> textures_are_for_{};
    Texture surfaces_, blocked_, inside_, depth_, inside_depth_;  // of light_map.frag
    Texture onward_, backward_, marked_rows_;                     // of discontinuities.frag and discontinuity_rows.frag
    Texture maps_, edges_;                                        // of skins.frag
    Framebuffer caster_target_, inside_target_, receiver_target_, mark_target_, row_target_, map_target_;
    Texture segments_;
};

std::vector<Knob> SoftShadowMapMethod::knobs() {
    return {choice_knob("mode", options_.mode, {"hard", "skins", "intervals", "interval_mask"}),
            number_knob("resolution", options_.resolution, 16, 2048),
            number_knob("samples", options_.samples, 2, 33),
            choice_knob("transition", options_.transition, {"linear", "rational", "exact"}),
            choice_knob("detector", options_.detector, {"slope_aware", "laplacian"}),
            number_knob("step", options_.step, 0.0F, 1.0F)};
}

/// Maps on top of each other are one texture: many are smaller.
SoftShadowMapOptions SoftShadowMapMethod::options() const {
    GLint rows = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &rows);
    Options options = options_;
    options.resolution = std::min(options.resolution, std::min(rows, 16384) / options.samples);
    options.most_samples = 0;
    return options;
}

std::string SoftShadowMapMethod::plan(const scenes::Scene& scene, float tolerance) {
    const auto plan = planned<SoftShadowMap<float>>(scene, options(), tolerance);
    options_.transition = plan.options.transition;
    return plan.text();
}

Query SoftShadowMapMethod::by_cpp(const scenes::Scene& scene) const {
    return query_of<SoftShadowMap<float>>(scene.casters, std::get<LinearLight<float>>(scene.light), options(),
                                          std::vector<Mesh<float>>{scene.ground});
}

/// Of the scene, an engine needs the depths of its nearest and farthest caster, bounds of all slopes, and which casters
/// are closed.
void SoftShadowMapMethod::prepare(const scenes::Scene& scene, const Geometry&) {
    const auto& light = std::get<LinearLight<float>>(scene.light);
    const std::vector<Mesh<float>> receivers{scene.ground};
    scene_ = light_map_geometry(scene.casters, receivers, light, options().resolution);
    runs_.clear();
    solid_ = false;
    for (std::size_t i = 0; i < scene_.casters.size(); ++i) {
        const bool solid = scene_.casters[i].solid;
        solid_ |= solid;
        if (!runs_.empty() && runs_.back().solid == solid)
            runs_.back().end = i + 1;
        else
            runs_.push_back({i, i + 1, solid});
    }
    scene_.casters.clear(), scene_.receivers.clear();
    if (has_segments()) {
        const SoftShadowMap<float> shadow(scene.casters, light, options(), receivers);
        const RowSegmentTexels texels = row_segment_texels(shadow.segments());
        segments_ = texels.segments.empty() ? Texture(GL_RGBA32F, {1, 1}) : Texture(texels.segments);
    }
    make_programs();
    make_textures();
}

std::optional<TileView> SoftShadowMapMethod::tile_view() const {
    const Vec2<float> seen = extent(scene_.view.slopes);
    const float texel =
        scene_.view.empty() ? 0.0F : std::max(seen.x, seen.y) / static_cast<float>(scene_.view.resolution);
    return TileView{scene_.frame, {Vec2<float>(scene_.half_length, 0.0F), false}, 0.0F, texel};
}

void SoftShadowMapMethod::make_programs() {
    const auto wanted = std::make_tuple(options_.mode, options_.transition, options_.detector, solid_);
    if (!shade_.empty() && wanted == std::exchange(programs_are_for_, wanted)) return;
    programs_are_for_ = wanted;
    const auto option = [](const char* name, auto value) {
        return std::string("PENUMBRA_SOFT_SHADOW_MAP_") + name + " " + std::to_string(static_cast<int>(value));
    };
    if (has_segments()) {
        shade_ = Program::full_screen(
            {{option("MASK", options_.mode == LinearMode::interval_mask)},
             {shading_head, library("light.glsl"), library("soft_shadow_map/row_segments.glsl"), shade_segments}});
        return;
    }
    const auto map_program = [](const char* what) {
        return Program(Source{{}, {library("soft_shadow_map/light_map.vert")}},
                       Source{{std::string("PENUMBRA_LIGHT_MAP PENUMBRA_LIGHT_MAP_") + what},
                              {library("soft_shadow_map/light_map.frag")}});
    };
    casters_ = map_program("CASTERS");
    if (solid_) insides_ = map_program("INSIDES");
    receivers_ = map_program("RECEIVERS");
    const std::vector<std::string> options{option("HARD", !has_skins()), option("EDGES", has_edges()),
                                           option("TRANSITION", options_.transition),
                                           option("DETECTOR", options_.detector), option("SOLID", solid_)};
    discontinuities_ = Program::full_screen({options, {library("soft_shadow_map/discontinuities.frag")}});
    rows_ = Program::full_screen({{}, {library("soft_shadow_map/discontinuity_rows.frag")}});
    skins_ = Program::full_screen({options, {library("soft_shadow_map/skins.frag")}});
    shade_ = Program::full_screen(
        {options, {shading_head, library("light.glsl"), library("soft_shadow_map/skin_maps.glsl"), shade_maps}});
}

void SoftShadowMapMethod::make_textures() {
    if (has_segments()) return;
    const int width = options().resolution;
    const glm::ivec2 size(width, width * options_.samples), marks((width + 31) / 32, size.y);
    const auto wanted = std::make_tuple(size.x, size.y, solid_, has_skins(), has_edges());
    if (wanted == std::exchange(textures_are_for_, wanted)) return;
    const auto make = [](bool needed, GLenum format, glm::ivec2 of_size) {
        return needed ? Texture(format, of_size) : Texture();
    };
    surfaces_ = Texture(GL_R32F, size);
    blocked_ = Texture(GL_R32F, size);
    depth_ = Texture(GL_DEPTH_COMPONENT32F, size);
    inside_ = make(solid_, GL_R32F, size);
    inside_depth_ = make(solid_, GL_DEPTH_COMPONENT32F, size);
    onward_ = make(has_skins(), GL_RG32UI, marks);
    backward_ = make(has_skins(), GL_RG32UI, marks);
    marked_rows_ = make(has_skins(), GL_RG32UI, {(marks.x + 31) / 32, size.y});
    maps_ = Texture(GL_RGBA32F, size);
    edges_ = make(has_edges(), GL_RGBA32F, size);
    caster_target_ = Framebuffer({{surfaces_}, {blocked_}}, &depth_);
    inside_target_ = solid_ ? Framebuffer({{inside_}}, &inside_depth_) : Framebuffer();
    receiver_target_ = Framebuffer({{surfaces_}}, &depth_);
    mark_target_ = has_skins() ? Framebuffer({{onward_}, {backward_}}) : Framebuffer();
    row_target_ = has_skins() ? Framebuffer({{marked_rows_}}) : Framebuffer();
    map_target_ = has_edges() ? Framebuffer({{maps_}, {edges_}}) : Framebuffer({{maps_}});
}

void SoftShadowMapMethod::draw(const Geometry& geometry, const Frame& frame, Timers& timers) {
    if (!has_segments() && !scene_.view.empty()) {
        {
            const Timers::Scope scope(timers, "maps");
            draw_surfaces(geometry);
        }
        if (has_skins()) {
            const Timers::Scope scope(timers, "discontinuities");
            draw_discontinuities();
        }
        const Timers::Scope scope(timers, "skins");
        draw_skins();
    }
    const Timers::Scope scope(timers, "shade");
    shade(frame);
}

/// What all passes are told.
void SoftShadowMapMethod::begin(const Program& program) const {
    program.use();
    program.set("penumbra_view.slopes.min", scene_.view.slopes.min);
    program.set("penumbra_view.slopes.max", scene_.view.slopes.max);
    program.set("penumbra_view.resolution", scene_.view.resolution);
    program.set("penumbra_count", options_.samples);
    program.set("penumbra_half_length", scene_.half_length);
    program.set("penumbra_step", scene_.step(options_.step));
    program.set("penumbra_nearest", static_cast<float>(scene_.nearest));
}

/// `draw` once for each map.
template <class Draw>
void SoftShadowMapMethod::draw_maps(const Program& program, const Framebuffer& target, const Draw& draw) const {
    begin(program);
    program.set("penumbra_world", glm::mat4(1.0F));
    program.set("penumbra_light", scene_.frame);
    program.set("penumbra_near", static_cast<float>(scene_.near));
    program.set("penumbra_farthest", static_cast<float>(scene_.farthest));
    target.bind();
    const int size = scene_.view.resolution;
    for (int map = 0; map < options_.samples; ++map) {
        glViewport(0, map * size, size, size);
        program.set("penumbra_from", even_position(scene_.half_length, map, options_.samples));
        draw();
    }
}

void SoftShadowMapMethod::draw_surfaces(const Geometry& geometry) const {
    State state;
    state.depth = GL_LESS;
    state.set();
    const glm::vec4 none(LightMap<float>::none);
    caster_target_.clear_color(0, none);
    caster_target_.clear_color(1, none);
    caster_target_.clear_depth(1.0F);
    draw_maps(casters_, caster_target_, [&] {
        for (const Run& run : runs_) {
            casters_.set("penumbra_solid", run.solid);
            geometry.draw_casters(run.first, run.end);
        }
    });
    if (solid_) {
        inside_target_.clear_color(0, none);
        inside_target_.clear_depth(1.0F);
        insides_.use();
        insides_.set("penumbra_surfaces", 0, surfaces_);
        insides_.set("penumbra_blocked", 1, blocked_);
        draw_maps(insides_, inside_target_, [&] { geometry.draw_casters(); });
    }
    if (has_skins()) draw_maps(receivers_, receiver_target_, [&] { geometry.draw_ground(); });
}

void SoftShadowMapMethod::draw_discontinuities() const {
    State{}.set();
    mark_target_.bind();
    begin(discontinuities_);
    discontinuities_.set("penumbra_surfaces", 0, surfaces_);
    discontinuities_.draw_full_screen();
    row_target_.bind();
    rows_.use();
    rows_.set("penumbra_onward", 0, onward_);
    rows_.set("penumbra_backward", 1, backward_);
    rows_.draw_full_screen();
}

void SoftShadowMapMethod::draw_skins() const {
    State{}.set();
    map_target_.bind();
    begin(skins_);
    skins_.set("penumbra_blocked", 0, blocked_);
    if (solid_) skins_.set("penumbra_insides", 1, inside_);
    if (has_skins()) {
        skins_.set("penumbra_surfaces", 2, surfaces_);
        skins_.set("penumbra_onward", 3, onward_);
        skins_.set("penumbra_backward", 4, backward_);
        skins_.set("penumbra_rows", 5, marked_rows_);
    }
    skins_.draw_full_screen();
}

void SoftShadowMapMethod::shade(const Frame& frame) const {
    State{}.set();
    frame.target.bind();
    shade_.use();
    tell_points(shade_, frame);
    if (has_segments()) {
        shade_.set("segments", 1, segments_);
        shade_.set("half_length", scene_.half_length);
    } else {
        shade_.set("maps", 1, maps_);
        shade_.set("edges", 2, has_edges() ? edges_ : maps_);
        shade_.set("count", options_.samples);
    }
    shade_.set("light", scene_.frame);
    shade_.set("view.slopes.min", scene_.view.slopes.min);
    shade_.set("view.slopes.max", scene_.view.slopes.max);
    shade_.set("view.resolution", scene_.view.resolution);
    shade_.draw_full_screen();
}

}  // namespace

std::unique_ptr<Method> make_soft_shadow_map(const Capabilities&) { return std::make_unique<SoftShadowMapMethod>(); }

}  // namespace penumbra::opengl
