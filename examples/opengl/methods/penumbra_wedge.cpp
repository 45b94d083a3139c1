// Soft shadows of a rectangle light from the silhouettes of casters.
//
// What an engine provides: world-space positions of what it shades; the library's index of its casters as a texture of
// RGBA32F, made by the host where casters or the light have moved. Technique `index`: a function that its shading calls
// per light, no pass at all. Technique `rasterised`, the paper's blending: silhouettes as the light's centre sees them,
// one volume each, drawn with the depth buffer of its surfaces; either in one draw, blended into one target of R32F or
// RGBA32F, or by rectangles in two or three targets of RGBA32UI, twice, a batch of silhouettes that do not meet after
// the other; then one texel a pixel to read where it shades.
#include <algorithm>
#include <memory>
#include <penumbra/penumbra_wedge/shadow_frustum.hpp>
#include <penumbra/penumbra_wedge/wedge_texels.hpp>
#include <tuple>
#include <utility>

#include "method.hpp"
#include "planned.hpp"

namespace penumbra::opengl {
namespace {

constexpr std::string_view shade_by_index = R"glsl(
uniform highp sampler2D wedges;
uniform penumbra_WedgeShadow shadow;
uniform penumbra_LightFrame light;
void main() {
    vec4 point = penumbra_point();
    if (point.w == 0.0) discard;
    visible = penumbra_is_lit() ? 1.0 : penumbra_visibility(wedges, shadow, penumbra_to_light(light, point.xyz));
}
)glsl";

constexpr std::string_view shade_areas = R"glsl(
uniform highp sampler2D blocked;
void main() {
    if (penumbra_point().w == 0.0) discard;
    vec4 of_light = texelFetch(blocked, ivec2(gl_FragCoord.xy), 0);
#ifdef LEFT
    visible = dot(of_light, LEFT);
#else
    visible = 1.0 - min(of_light.x, 1.0);
#endif
}
)glsl";

constexpr std::string_view shade_rectangles = R"glsl(
uniform highp usampler2D rects, coverages;
void main() {
    if (penumbra_point().w == 0.0) discard;
    penumbra_PackedParts all;
    all.rects = texelFetch(rects, ivec2(gl_FragCoord.xy), 0);
    all.coverages = texelFetch(coverages, ivec2(gl_FragCoord.xy), 0);
    penumbra_FourParts parts = penumbra_unpack_parts(all);
    visible = 1.0 - 0.25 * (parts.part[0].area + parts.part[1].area + parts.part[2].area + parts.part[3].area);
}
)glsl";

enum class Technique { rasterised, index };

/// Silhouettes that are drawn together.
struct Batch {
    int first, count;
};

/// The box around a box of world space in the light's frame.
Box3<float> to_light(const LightFrame<float>& frame, const Box3<float>& box_ws, float scale) {
    Box3<float> box = empty_box<float>();
    for (int k = 0; k < 8 && !is_empty(box_ws); ++k)
        box = extend(box, frame.to_light(Vec3<float>((k & 1) != 0 ? box_ws.max.x : box_ws.min.x,
                                                     (k & 2) != 0 ? box_ws.max.y : box_ws.min.y,
                                                     (k & 4) != 0 ? box_ws.max.z : box_ws.min.z)) *
                              scale);
    return box;
}

template <class Choice>
std::string option(const char* name, Choice value) {
    return std::string("PENUMBRA_PENUMBRA_WEDGE_") + name + " " + std::to_string(static_cast<int>(value));
}

void tell(const Program& program, const std::string& name, const WedgeTexels& index) {
    program.set((name + ".half_size").c_str(), index.half_size);
    program.set((name + ".scale").c_str(), index.scale);
    program.set((name + ".tolerance").c_str(), index.tolerance);
    program.set((name + ".nodes").c_str(), index.nodes);
}

/// Of what silhouette_frustum.vert draws.
State volumes(const Frame& frame) {
    State state;
    state.depth = frame.reverse_depth ? GL_LESS : GL_GREATER;
    state.write_depth = false;
    state.cull = GL_FRONT;
    return state;
}

void draw_batch(const Program& program, Batch batch) {
    program.set("penumbra_first", batch.first);
    program.draw_triangles(36 * batch.count);
}

class PenumbraWedge final : public Method {
  public:
    bool takes(const scenes::Light& light) const override { return std::holds_alternative<RectLight<float>>(light); }
    std::vector<Knob> knobs() override;
    void prepare(const scenes::Scene& scene, const Geometry&) override;
    std::optional<TileView> tile_view() const override;
    void draw(const Geometry&, const Frame& frame, Timers& timers) override;
    std::string plan(const scenes::Scene& scene, float tolerance) override;
    Query by_cpp(const scenes::Scene& scene) const override;

  private:
    using Options = PenumbraWedgeOptions;

    Options options() const;
    bool is_index() const { return technique_ == Technique::index; }
    OverlapRule rule() const { return options().overlap; }
    bool multiplies() const { return rule() == OverlapRule::product || rule() == OverlapRule::product_quadrants; }
    bool has_rectangles() const { return rule() >= OverlapRule::rectangles; }
    bool has_centres() const { return rule() == OverlapRule::rectangles_centroid; }

    void make_programs();
    void place_silhouettes(const Box3<float>& receivers_ws);
    void make_targets(const Frame& frame);
    void tell_volumes(const Program& program, const Frame& frame) const;
    void blend_areas(const Frame& frame) const;
    void blend_rectangles(const Frame& frame) const;
    void shade(const Frame& frame) const;

    Technique technique_ = Technique::index;
    Options options_;

    WedgeTexels index_;  // without its texels: the GPU has them
    LightFrame<float> light_{};
    std::vector<Box3<float>> boxes_;  // of meshes, in the index's unit
    Texture wedges_;

    std::tuple<Technique, OverlapRule, int, SilhouetteFrom> programs_are_for_{};
    Program blend_, blend_within_, copy_, shade_;

    Box3<float> placed_for_ = empty_box<float>();
    Texture silhouettes_;
    std::vector<Batch> batches_;

    std::tuple<int, int, GLuint, OverlapRule> targets_are_for_{};
    Texture blocked_;                                        // by areas
    Texture rects_, coverages_, centres_;                    // by rectangles
    Texture drawn_rects_, drawn_coverages_, drawn_centres_;  // the same, with the latest batch
    Framebuffer target_, drawn_target_;
};

std::vector<Knob> PenumbraWedge::knobs() {
    Knob size = choice_knob("bitmask_size", options_.bitmask_size, {"8", "16", "32"});
    size.get = [this] { return options_.bitmask_size == 8 ? 0.0 : options_.bitmask_size == 16 ? 1.0 : 2.0; };
    size.set = [this](double choice) { options_.bitmask_size = 8 << static_cast<int>(choice); };
    return {choice_knob("technique", technique_, {"rasterised", "index"}),
            choice_knob("overlap", options_.overlap,
                        {"additive", "maximum", "product", "product_quadrants", "rectangles", "rectangles_centroid",
                         "rectangle_product", "bitmask", "exact"}),
            std::move(size), choice_knob("silhouette", options_.silhouette, {"light_center", "point"})};
}

/// What is drawn. Rasterised: silhouettes from the light's centre, and the paper's rectangles in place of what takes
/// hundreds of numbers a pixel.
PenumbraWedgeOptions PenumbraWedge::options() const {
    Options options = options_;
    if (is_index()) return options;
    options.silhouette = SilhouetteFrom::light_center;
    if (options.overlap >= OverlapRule::rectangle_product) options.overlap = OverlapRule::rectangles;
    return options;
}

std::string PenumbraWedge::plan(const scenes::Scene& scene, float tolerance) {
    const auto plan = planned<PenumbraWedgeShadow<float>>(scene, options(), tolerance);
    options_.overlap = plan.options.overlap, options_.silhouette = plan.options.silhouette;
    return plan.text();
}

Query PenumbraWedge::by_cpp(const scenes::Scene& scene) const {
    return query_of<PenumbraWedgeShadow<float>>(scene.casters, std::get<RectLight<float>>(scene.light), options());
}

void PenumbraWedge::prepare(const scenes::Scene& scene, const Geometry&) {
    const PenumbraWedgeShadow<float> shadow(scene.casters, std::get<RectLight<float>>(scene.light), options());
    index_ = wedge_texels(shadow);
    light_ = shadow.frame();
    boxes_.clear();
    for (const glm::ivec2& nodes : index_.meshes) {
        const glm::vec4* const node = index_.texels.data() + nodes.x;
        boxes_.push_back({Vec3<float>(node[0]), Vec3<float>(node[1])});
    }
    wedges_ = index_.texels.empty() ? Texture(GL_RGBA32F, {1, 1}) : Texture(index_.texels);
    index_.texels = {};
    placed_for_ = empty_box<float>();
    make_programs();
}

/// What is rasterised costs the same, whatever is asked then.
std::optional<TileView> PenumbraWedge::tile_view() const {
    if (!is_index()) return std::nullopt;
    return TileView{light_, {index_.half_size / index_.scale, false}};
}

void PenumbraWedge::make_programs() {
    const Options of = options();
    const auto wanted = std::make_tuple(technique_, of.overlap, of.bitmask_size, of.silhouette);
    if (!shade_.empty() && wanted == programs_are_for_) return;
    programs_are_for_ = wanted;
    const std::string rule = option("OVERLAP", of.overlap);
    if (is_index()) {
        shade_ = Program::full_screen(
            {{rule, option("SILHOUETTE", of.silhouette), option("BITMASK_SIZE", of.bitmask_size)},
             {shading_head, library("light.glsl"), library("penumbra_wedge/shadow.glsl"), shade_by_index}});
        return;
    }
    const Source volume{{}, {library("penumbra_wedge/silhouette_frustum.vert")}};
    const std::string within = "PENUMBRA_SILHOUETTE_WITHIN 1";
    blend_ = Program(volume, Source{{rule}, {library("penumbra_wedge/silhouette_blend.frag")}});
    blend_within_ = Program(Source{{within}, volume.texts},
                            Source{{rule, within}, {library("penumbra_wedge/silhouette_blend.frag")}});
    if (has_rectangles()) {
        copy_ = Program(volume, Source{{rule}, {library("penumbra_wedge/silhouette_copy.frag")}});
        shade_ = Program::full_screen({{}, {shading_head, library("penumbra_wedge/packing.glsl"), shade_rectangles}});
    } else {
        const char* const left = of.overlap == OverlapRule::product             ? "LEFT vec4(1.0, 0.0, 0.0, 0.0)"
                                 : of.overlap == OverlapRule::product_quadrants ? "LEFT vec4(0.25)"
                                                                                : "BLOCKED";
        shade_ = Program::full_screen({{left}, {shading_head, shade_areas}});
    }
}

/// Brings silhouettes into batches; the later of two that may meet, in the index's order, comes into a later one where
/// the order matters.
void PenumbraWedge::place_silhouettes(const Box3<float>& receivers_ws) {
    if (receivers_ws.min == placed_for_.min && receivers_ws.max == placed_for_.max) return;
    placed_for_ = receivers_ws;
    const Box3<float> receivers = to_light(light_, receivers_ws, index_.scale);
    struct Silhouette {
        ShadowFrustum<float> frustum;
        glm::ivec2 nodes;
        int batch;
    };
    std::vector<Silhouette> all;
    const bool in_order = has_rectangles();
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const ShadowFrustum<float> frustum = shadow_frustum(boxes_[i], index_.half_size, receivers);
        if (is_empty(frustum)) continue;
        int batch = 0;
        for (std::size_t k = 0; in_order && k < all.size(); ++k)
            if (all[k].batch >= batch && may_meet(all[k].frustum, frustum)) batch = all[k].batch + 1;
        all.push_back({frustum, index_.meshes[i], batch});
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.batch < b.batch; });

    batches_.clear();
    std::vector<glm::vec4> texels;
    for (const Silhouette& s : all) {
        if (s.batch == static_cast<int>(batches_.size())) batches_.push_back({static_cast<int>(texels.size() / 3), 0});
        ++batches_.back().count;
        texels.emplace_back(s.frustum.near.min, s.frustum.near.max);
        texels.emplace_back(s.frustum.far.min, s.frustum.far.max);
        texels.emplace_back(s.frustum.near_depth, s.frustum.far_depth, s.nodes);
    }
    Image<glm::vec4> image(WedgeTexels::width, static_cast<int>(texels.size()) / WedgeTexels::width + 1);
    std::copy(texels.begin(), texels.end(), image.data());
    silhouettes_ = Texture(image);
}

void PenumbraWedge::make_targets(const Frame& frame) {
    const auto wanted = std::make_tuple(frame.size.x, frame.size.y, frame.depth.name(), rule());
    if (wanted == std::exchange(targets_are_for_, wanted)) return;
    if (!has_rectangles()) {
        blocked_ = Texture(rule() == OverlapRule::product_quadrants ? GL_RGBA32F : GL_R32F, frame.size);
        target_ = Framebuffer({{blocked_}}, &frame.depth);
        return;
    }
    for (Texture* texture : {&rects_, &coverages_, &drawn_rects_, &drawn_coverages_})
        *texture = Texture(GL_RGBA32UI, frame.size);
    for (Texture* texture : {&centres_, &drawn_centres_})
        *texture = has_centres() ? Texture(GL_RGBA32UI, frame.size) : Texture();
    const auto target = [&](const Texture& rects, const Texture& coverages, const Texture& centres) {
        return has_centres() ? Framebuffer({{rects}, {coverages}, {centres}}, &frame.depth)
                             : Framebuffer({{rects}, {coverages}}, &frame.depth);
    };
    target_ = target(rects_, coverages_, centres_);
    drawn_target_ = target(drawn_rects_, drawn_coverages_, drawn_centres_);
}

void PenumbraWedge::draw(const Geometry&, const Frame& frame, Timers& timers) {
    if (!is_index()) {
        place_silhouettes(frame.receivers);
        make_targets(frame);
        const Timers::Scope scope(timers, "silhouettes");
        has_rectangles() ? blend_rectangles(frame) : blend_areas(frame);
    }
    const Timers::Scope scope(timers, "shade");
    shade(frame);
}

void PenumbraWedge::tell_volumes(const Program& program, const Frame& frame) const {
    program.use();
    program.set("penumbra_silhouettes", 0, silhouettes_);
    program.set("penumbra_scale", index_.scale);
    program.set("penumbra_world_to_clip", frame.world_to_clip);
    program.set("penumbra_light", light_);
    program.set("penumbra_positions", 1, frame.positions);
    program.set("penumbra_wedges", 2, wedges_);
    tell(program, "penumbra_shadow", index_);
}

void PenumbraWedge::blend_areas(const Frame& frame) const {
    target_.clear_color(0, glm::vec4(multiplies() ? 1.0F : 0.0F));
    State state = volumes(frame);
    state.blend = rule() == OverlapRule::maximum ? GL_MAX : GL_FUNC_ADD;
    state.set();
    if (multiplies()) glBlendFunc(GL_ZERO, GL_ONE_MINUS_SRC_COLOR);
    for (const Program* program : {&blend_, &blend_within_}) {
        tell_volumes(*program, frame);
        for (const Batch& batch : batches_) draw_batch(*program, batch);  // one
    }
}

void PenumbraWedge::blend_rectangles(const Frame& frame) const {
    for (int k = 0; k < (has_centres() ? 3 : 2); ++k) {
        target_.clear_integers(k, glm::uvec4(0U));
        drawn_target_.clear_integers(k, glm::uvec4(0U));
    }
    volumes(frame).set();
    for (const Program* program : {&blend_, &blend_within_, &copy_}) tell_volumes(*program, frame);
    const auto pass = [&](const Program& program, Batch batch, const Texture& rects, const Texture& coverages,
                          const Texture& centres) {
        program.use();
        program.set("penumbra_rects", 3, rects);
        program.set("penumbra_coverages", 4, coverages);
        if (has_centres()) program.set("penumbra_centres", 5, centres);
        draw_batch(program, batch);
    };
    for (const Batch& batch : batches_) {
        drawn_target_.bind();
        pass(blend_, batch, rects_, coverages_, centres_);
        pass(blend_within_, batch, rects_, coverages_, centres_);
        target_.bind();
        pass(copy_, batch, drawn_rects_, drawn_coverages_, drawn_centres_);
    }
}

void PenumbraWedge::shade(const Frame& frame) const {
    State().set();
    frame.target.bind();
    shade_.use();
    tell_points(shade_, frame);
    if (is_index()) {
        shade_.set("wedges", 1, wedges_);
        shade_.set("light", light_);
        tell(shade_, "shadow", index_);
    } else if (has_rectangles()) {
        shade_.set("rects", 1, rects_);
        shade_.set("coverages", 2, coverages_);
    } else {
        shade_.set("blocked", 1, blocked_);
    }
    shade_.draw_full_screen();
}

}  // namespace

std::unique_ptr<Method> make_penumbra_wedge(const Capabilities&) { return std::make_unique<PenumbraWedge>(); }

}  // namespace penumbra::opengl
