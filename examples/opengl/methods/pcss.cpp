// Percentage-closer soft shadows: a shadow map from the light's centre, blockers searched and averaged around a point,
// and a filter as wide as they let the penumbra be. What engines mostly have, for comparison; not the library's.
// Source: R. Fernando, "Percentage-closer soft shadows", 2005; receiver planes: J. Isidoro, "Shadow mapping: GPU-based
// tips and techniques", 2006; noise: J. Jimenez, "Next generation post processing in Call of Duty", 2014.
#include <algorithm>
#include <limits>
#include <memory>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <penumbra/umbra_volume/shadow.hpp>

#include "method.hpp"

namespace penumbra::opengl {
namespace {

// In light space a point is seen from the light's centre at slopes (x, y) / depth, which the map's window holds.
constexpr std::string_view view = R"glsl(
uniform penumbra_LightFrame frame;
uniform vec2 window_min, window_size;  // slopes
uniform float near, far;               // depths that the map holds
float depth_in_map(float depth) { return far * (depth - near) / (depth * (far - near)); }
)glsl";

constexpr std::string_view map_vertex = R"glsl(
uniform bool clip_zero_to_one;
in vec3 penumbra_position;
void main() {
    vec3 point = penumbra_to_light(frame, penumbra_position);
    float z = (point.z - near) * far / (far - near);
    gl_Position = vec4(2.0 * (point.xy - window_min * point.z) / window_size - point.z,
                       clip_zero_to_one ? z : 2.0 * z - point.z, point.z);
}
)glsl";

constexpr std::string_view map_fragment = "void main() {}";

constexpr std::string_view shading = R"glsl(
uniform highp sampler2D map;
uniform highp sampler2DShadow map_below;  // bilinear
uniform highp sampler2D normals;
uniform vec2 half_size;                   // of the light
uniform bool is_disk;
uniform int blocker_samples, filter_samples;
uniform float bias;                       // texels

float noise() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

// Sample i of n on the light, in [-1, 1]: a Vogel disk, turned at each pixel, or a rectangle's R2 sequence, shifted.
vec2 sample_of(int i, int n, float turn) {
    if (!is_disk) {
        vec2 shift = vec2(turn, fract(turn * 97.0));
        return 2.0 * fract(shift + float(i) * vec2(0.7548776662, 0.5698402910)) - 1.0;
    }
    float angle = 2.3999632 * float(i) + 6.2831853 * turn;
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

// Up to which depth a surface that the light's centre sees at these slopes blocks: nothing behind the receiver's plane
// does, which runs along the light's direction in the limit, and nothing behind the point.
float blocking_depth(vec3 point, vec3 normal, vec2 slopes, float reach) {
    float along = dot(normal, vec3(slopes, 1.0));
    float depth = dot(normal, point) / (abs(along) > 1e-6 ? along : 1e-6);
    return clamp(depth > 0.0 ? depth : point.z, point.z * (1.0 - 4.0 * reach), point.z);
}

void main() {
    vec4 at = penumbra_point();
    if (at.w == 0.0) discard;
    visible = 1.0;
    vec3 point = penumbra_to_light(frame, at.xyz);
    if (point.z <= near) return;
    vec3 normal = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz;
    normal = vec3(dot(normal, frame.u), dot(normal, frame.v), dot(normal, frame.normal));
    vec2 center = point.xy / point.z, texel = window_size / vec2(textureSize(map, 0));
    float offset = bias * max(texel.x, texel.y) * point.z, turn = noise();

    vec2 reach = max(half_size * (1.0 / near - 1.0 / point.z), texel);
    float longest = max(reach.x, reach.y), sum = 0.0, blockers = 0.0;
    for (int i = 0; i < blocker_samples; ++i) {
        vec2 slopes = center + reach * sample_of(i, blocker_samples, turn);
        float in_map = textureLod(map, (slopes - window_min) / window_size, 0.0).r;
        float depth = far * near / (far - in_map * (far - near));
        if (in_map < 1.0 && depth < blocking_depth(point, normal, slopes, longest) - offset) {
            sum += depth;
            blockers += 1.0;
        }
    }
    if (blockers == 0.0) return;

    reach = max(half_size * (blockers / sum - 1.0 / point.z), texel);
    longest = max(reach.x, reach.y);
    float lit = 0.0;
    for (int i = 0; i < filter_samples; ++i) {
        vec2 slopes = center + reach * sample_of(i, filter_samples, turn);
        float depth = max(blocking_depth(point, normal, slopes, longest) - offset, near);
        lit += textureLod(map_below, vec3((slopes - window_min) / window_size, min(depth_in_map(depth), 1.0)), 0.0);
    }
    visible = lit / float(filter_samples);
}
)glsl";

class Pcss final : public Method {
  public:
    bool takes(const scenes::Light&) const override { return true; }
    std::vector<Knob> knobs() override {
        return {number_knob("resolution", resolution_, 64, 8192),
                number_knob("blocker_samples", blocker_samples_, 1, 64),
                number_knob("filter_samples", filter_samples_, 1, 128), number_knob("bias", bias_, 0.0F, 8.0F)};
    }
    void prepare(const scenes::Scene& scene, const Geometry&) override;
    void draw(const Geometry& geometry, const Frame& frame, Timers& timers) override;
    /// The library's answer for such a light: what the method is compared with.
    Query by_cpp(const scenes::Scene& scene) const override;

  private:
    struct DeleteSampler {
        void operator()(GLuint name) const { glDeleteSamplers(1, &name); }
    };

    void look(const RectLight<float>& light, const Vec3<float>& aim);
    void look(const DiskLight<float>& light, const Vec3<float>& aim);
    void look(const LinearLight<float>& light, const Vec3<float>& aim);
    void fit(const std::vector<Mesh<float>>& casters);
    void make_programs();
    void set_view(const Program& program) const;

    int resolution_ = 2048, blocker_samples_ = 16, filter_samples_ = 32;
    float bias_ = 1.0F;

    LightFrame<float> frame_;
    Vec2<float> half_size_;
    bool is_disk_ = false;
    Rect2<float> window_;  // slopes
    float near_ = 1.0F, far_ = 2.0F;

    Program draw_map_, shade_;
    Texture map_;
    Framebuffer map_target_;
    Handle<DeleteSampler> below_;
};

void Pcss::make_programs() {
    draw_map_ = Program({{}, {library("light.glsl"), view, map_vertex}}, {{}, {map_fragment}});
    shade_ = Program::full_screen({{}, {shading_head, library("light.glsl"), view, shading}});
    GLuint name = 0;
    glGenSamplers(1, &name);
    below_ = Handle<DeleteSampler>(name);
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Pcss::look(const RectLight<float>& light, const Vec3<float>& aim) {
    frame_ = light_frame(light, aim);
    half_size_ = half_size(light);
}
void Pcss::look(const DiskLight<float>& light, const Vec3<float>&) {
    frame_ = light_frame(light);
    half_size_ = Vec2<float>(light.radius);
}
void Pcss::look(const LinearLight<float>& light, const Vec3<float>& aim) {
    frame_ = light_frame(light, aim);
    half_size_ = Vec2<float>(0.5F * glm::length(light.b - light.a), 0.0F);
}

void Pcss::prepare(const scenes::Scene& scene, const Geometry&) {
    const Box3<float> box = bounds(scene.casters);
    const Vec3<float> aim =
        is_empty(box) ? Vec3<float>(0.0F) : (box.min + box.max) * 0.5F - scenes::center_of(scene.light);
    std::visit([&](const auto& light) { look(light, aim); }, scene.light);
    is_disk_ = std::holds_alternative<DiskLight<float>>(scene.light);
    fit(scene.casters);
    if (shade_.empty()) make_programs();
    if (map_.size().x == resolution_) return;
    map_ = Texture(GL_DEPTH_COMPONENT32F, {resolution_, resolution_});
    map_target_ = Framebuffer::depth_only(map_);
}

/// The window and the depths of all casters, but for what is nearer than 1/50 of the farthest depth.
void Pcss::fit(const std::vector<Mesh<float>>& casters) {
    std::vector<Vec3<float>> points_ls;
    for (const Mesh<float>& mesh : casters)
        for (const Vec3<float>& p : mesh.positions) points_ls.push_back(frame_.to_light(p));
    float nearest = std::numeric_limits<float>::max(), farthest = 0.0F;
    for (const Vec3<float>& p : points_ls) nearest = std::min(nearest, p.z), farthest = std::max(farthest, p.z);
    near_ = farthest > 0.0F ? std::max(nearest, farthest * 0.02F) * 0.999F : 1.0F;
    far_ = farthest > 0.0F ? std::max(farthest * 1.001F, near_ * 1.001F) : 2.0F;
    window_ = empty_rect<float>();
    for (const Vec3<float>& p : points_ls)
        if (p.z >= near_) window_ = extend(window_, Vec2<float>(p.x, p.y) / p.z);
    if (!(window_.min.x <= window_.max.x)) window_ = {Vec2<float>(-1.0F), Vec2<float>(1.0F)};
    constexpr float margin = 4.0F;  // empty texels around
    const Vec2<float> room =
        glm::max(extent(window_), 1e-4F) * (margin / (static_cast<float>(resolution_) - 2.0F * margin));
    window_ = {window_.min - room, window_.max + room};
}

Query Pcss::by_cpp(const scenes::Scene& scene) const {
    if (const auto* rectangle = std::get_if<RectLight<float>>(&scene.light))
        return query_of<PenumbraWedgeShadow<float>>(scene.casters, *rectangle);
    if (const auto* disk = std::get_if<DiskLight<float>>(&scene.light))
        return query_of<UmbraVolumeShadow<float>>(scene.casters, *disk);
    return query_of<SoftShadowMap<float>>(scene.casters, std::get<LinearLight<float>>(scene.light));
}

void Pcss::set_view(const Program& program) const {
    program.use();
    program.set("frame", frame_);
    program.set("window_min", window_.min);
    program.set("window_size", extent(window_));
    program.set("near", near_);
    program.set("far", far_);
}

void Pcss::draw(const Geometry& geometry, const Frame& frame, Timers& timers) {
    {
        const Timers::Scope scope(timers, "map");
        State state;
        state.depth = GL_LESS;
        state.set();
        map_target_.clear_depth(1.0F);
        set_view(draw_map_);
        draw_map_.set("clip_zero_to_one", frame.reverse_depth);
        geometry.draw_casters();
    }
    const Timers::Scope scope(timers, "shade");
    State{}.set();
    frame.target.bind();
    set_view(shade_);
    shade_.set("positions", 0, frame.positions);
    shade_.set("normals", 1, frame.normals);
    shade_.set("map", 2, map_);
    shade_.set("map_below", 3, map_);
    shade_.set("half_size", half_size_);
    shade_.set("is_disk", is_disk_);
    shade_.set("blocker_samples", blocker_samples_);
    shade_.set("filter_samples", filter_samples_);
    shade_.set("bias", bias_);
    glBindSampler(3, below_.name());
    shade_.draw_full_screen();
    glBindSampler(3, 0);
}

}  // namespace

std::unique_ptr<Method> make_pcss(const Capabilities&) { return std::make_unique<Pcss>(); }

}  // namespace penumbra::opengl
