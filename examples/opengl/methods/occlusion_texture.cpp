// Soft shadows of a rectangle light from occlusion textures.
//
// An engine provides its casters' positions, textures of at most `resolution` texels a side with a layer for four
// slices (RGBA8, and RGBA16F where casters are closed), and world-space positions of what it shades. Per light and
// frame:
//   capture    draws the casters for up to 16 slices at once, blended by maximum, and closed ones again, added;
//              slice_capture.cpp
//   resolve    fills solids, full-screen passes; the same
//   prefilter  makes tables, N-Buffers or mip-maps, full-screen or compute passes; slice_filter.cpp
//   shade      calls penumbra_visibility(), below: what an engine's own shading calls for each light
#include <algorithm>
#include <memory>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <tuple>
#include <utility>

#include "method.hpp"
#include "planned.hpp"
#include "slice_capture.hpp"
#include "slice_filter.hpp"

namespace penumbra::opengl {
namespace {

// a uniform where the snippet wants a number: to turn it compiles nothing
constexpr std::string_view shading_options = R"glsl(
uniform highp float self_shadow_bias;
#define PENUMBRA_OCCLUSION_TEXTURE_BIAS self_shadow_bias
)glsl";

constexpr std::string_view shading = R"glsl(
uniform highp PENUMBRA_SLICE_SAMPLER masks, depths;
uniform penumbra_OcclusionTexture slices;
uniform penumbra_LightFrame frame;
void main() {
    vec4 point = penumbra_point();
    if (point.w == 0.0) discard;
    visible = penumbra_is_lit() ? 1.0 : penumbra_visibility(masks, depths, slices, penumbra_to_light(frame, point.xyz));
}
)glsl";

/// Choices of the C++ and of the shaders have the same numbers.
template <class Choice>
std::string option(const char* name, Choice value) {
    return "PENUMBRA_OCCLUSION_TEXTURE_" + std::string(name) + " " + std::to_string(static_cast<int>(value));
}

class OcclusionTexture final : public Method {
  public:
    explicit OcclusionTexture(const Capabilities& can) : can_(can), compute_(can.compute) {}

    bool takes(const scenes::Light& light) const override { return std::holds_alternative<RectLight<float>>(light); }
    std::vector<Knob> knobs() override;
    void prepare(const scenes::Scene& scene, const Geometry&) override;
    std::optional<TileView> tile_view() const override;
    void draw(const Geometry& geometry, const Frame& frame, Timers& timers) override;
    std::string plan(const scenes::Scene& scene, float tolerance) override;
    Query by_cpp(const scenes::Scene& scene) const override;

  private:
    using Options = OcclusionTextureOptions;
    enum class Blend { scattered, connected, disjoint, unknown };

    Options options() const;
    bool has_depths() const { return options_.self_shadow == SelfShadow::mean_depth; }
    void make_textures();
    void shade(const Frame& frame) const;

    Capabilities can_;
    Options options_;
    Blend blend_ = Blend::connected;
    bool compute_;

    SliceView view_;
    using Layout = std::tuple<int, int, int, SliceFilter, bool, bool, bool>;
    Layout layout_{};  // of the textures
    ProgramCache programs_;
    SliceFilterPasses filter_;
    SliceCapturePasses capture_;
    const Program* shade_ = nullptr;
};

std::vector<Knob> OcclusionTexture::knobs() {
    std::vector<Knob> knobs{number_knob("slices", options_.slices, 1, Options::most_slices),
                            number_knob("resolution", options_.resolution, 16, 2048),
                            number_knob("light_cells", options_.light_cells, 1, Options::most_cells),
                            choice_knob("filter", options_.filter, {"mipmap", "n_buffer", "summed_area"}),
                            choice_knob("blend", blend_, {"scattered", "connected", "disjoint", "unknown"}),
                            choice_knob("plane", options_.plane, {"bottom", "middle"}),
                            choice_knob("faces", options_.faces, {"solid", "all", "facing"}),
                            choice_knob("projection", options_.projection, {"perspective", "orthographic"}),
                            choice_knob("self_shadow", options_.self_shadow, {"fade", "clear", "mean_depth"}),
                            number_knob("self_shadow_bias", options_.self_shadow_bias, 0.001F, 1.0F)};
    if (can_.compute) knobs.push_back(choice_knob("prefilter", compute_, {"fragment", "compute"}));
    return knobs;
}

OcclusionTextureOptions OcclusionTexture::options() const {
    constexpr SliceBlend blends[] = {SliceBlend::scattered(), SliceBlend::connected(), SliceBlend::disjoint(),
                                     SliceBlend::unknown()};
    Options options = options_;
    options.blend = blends[static_cast<std::size_t>(blend_)];
    return options;
}

std::string OcclusionTexture::plan(const scenes::Scene& scene, float tolerance) {
    const auto plan = planned<OcclusionTextureShadow<float>>(scene, options(), tolerance);
    options_.slices = plan.options.slices, options_.self_shadow = plan.options.self_shadow;  // leaks are the blend's
    return plan.text();
}

Query OcclusionTexture::by_cpp(const scenes::Scene& scene) const {
    return query_of<OcclusionTextureShadow<float>>(scene.casters, std::get<RectLight<float>>(scene.light), options());
}

void OcclusionTexture::prepare(const scenes::Scene& scene, const Geometry&) {
    view_ = SliceView(scene.casters, std::get<RectLight<float>>(scene.light), options());
    make_textures();
    shade_ = &programs_.full_screen(
        {{option("FILTER", options_.filter), option("COMBINATION", options().blend.combination),
          option("CHANNELS", filter_.channels()), option("CELLS", options_.light_cells),
          option("PLANE", options_.plane), option("SELF_SHADOW", options_.self_shadow)},
         {shading_head, shading_options, library("light.glsl"), library("occlusion_texture/shadow.glsl"), shading}});
}

/// Mip-maps blur further than two texels.
std::optional<TileView> OcclusionTexture::tile_view() const {
    if (options_.filter == SliceFilter::mipmap) return std::nullopt;
    const float texel = 1.0F / std::min(view_.camera.scale_tx.x, view_.camera.scale_tx.y);
    return TileView{
        view_.frame, {view_.half_size, false}, texel, texel * view_.camera.convergence, view_.range.thickness};
}

/// An engine makes them once, for the largest image that it allows, and draws to a part.
void OcclusionTexture::make_textures() {
    const int groups = (options_.slices + 3) / 4;
    const glm::ivec2 size(view_.camera.width, view_.camera.height);
    const bool solids = view_.has_solids();
    const Layout layout{size.x, size.y, groups, options_.filter, compute_, has_depths(), solids};
    if (layout == std::exchange(layout_, layout)) return;
    capture_ = {}, filter_ = {};  // before new ones need their memory
    filter_ = SliceFilterPasses(programs_, options_.filter, compute_, size, groups, has_depths() ? 2 : 1);
    capture_ =
        SliceCapturePasses(programs_, filter_.slices(0), has_depths() ? &filter_.slices(1) : nullptr, groups, solids);
}

void OcclusionTexture::draw(const Geometry& geometry, const Frame& frame, Timers& timers) {
    {
        const Timers::Scope scope(timers, "capture");
        capture_.capture(view_, geometry, frame.reverse_depth);
    }
    if (capture_.needs_resolve()) {
        const Timers::Scope scope(timers, "resolve");
        capture_.resolve();
    }
    {
        const Timers::Scope scope(timers, "prefilter");
        filter_.run();
    }
    const Timers::Scope scope(timers, "shade");
    shade(frame);
}

void OcclusionTexture::shade(const Frame& frame) const {
    State{}.set();
    frame.target.bind();
    shade_->use();
    tell_points(*shade_, frame);
    shade_->set("masks", 1, filter_.filtered(0));
    shade_->set("depths", 2, filter_.filtered(has_depths() ? 1 : 0));
    shade_->set("self_shadow_bias", options_.self_shadow_bias);
    shade_->set("slices.camera.convergence", view_.camera.convergence);
    shade_->set("slices.camera.origin_tx", view_.camera.origin_tx);
    shade_->set("slices.camera.scale_tx", view_.camera.scale_tx);
    shade_->set("slices.range.first", view_.range.first);
    shade_->set("slices.range.thickness", view_.range.thickness);
    shade_->set("slices.range.count", view_.range.count);
    shade_->set("slices.half_size", view_.half_size);
    shade_->set("slices.levels", filter_.levels());
    shade_->set("frame", view_.frame);
    shade_->draw_full_screen();
}

}  // namespace

std::unique_ptr<Method> make_occlusion_texture(const Capabilities& capabilities) {
    return std::make_unique<OcclusionTexture>(capabilities);
}

}  // namespace penumbra::opengl
