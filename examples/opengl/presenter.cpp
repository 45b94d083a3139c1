#include "presenter.hpp"

#include "../pictures/picture.hpp"

namespace penumbra::opengl {
namespace {

constexpr float difference_scale = 0.25F;

constexpr std::string_view shade = R"glsl(
uniform sampler2D positions, normals, visibility, truth, difference_colors;
uniform vec3 light;  // the light's centre
uniform int kind;    // Picture
uniform highp usampler2D tile_classes;
uniform int tile_size;  // 0: tiles are not shown
uniform float split, difference_scale;
layout(location = 0) out vec4 color;

vec3 encoded(vec3 linear) {
    vec3 low = 12.92 * linear, high = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThan(linear, vec3(0.0031308)));
}

vec3 tile_color(ivec2 at) {
    if (tile_size == 0) return vec3(1.0);
    uint tile = texelFetch(tile_classes, at / tile_size, 0).r;
    return tile == 0u ? vec3(0.6, 0.8, 0.6) : tile == 1u ? vec3(1.0, 0.9, 0.35) : vec3(1.0, 0.4, 0.35);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float width = float(textureSize(positions, 0).x);
    float ours = texelFetch(visibility, at, 0).r, traced = texelFetch(truth, at, 0).r;
    bool is_asked = ours >= 0.0;
    vec3 background = vec3(0.55, 0.62, 0.7);
    color.a = 1.0;
    if (kind == 2) {
        float place = clamp((ours - traced) / difference_scale, -1.0, 1.0) * 0.5 + 0.5;
        vec3 difference = texture(difference_colors, vec2((place * 255.0 + 0.5) / 256.0, 0.5)).rgb;
        color.rgb = is_asked && traced >= 0.0 ? difference : vec3(0.6);
        return;
    }
    bool is_bar = split < 1.0 && abs(gl_FragCoord.x - split * width) < 1.0;
    float visible = max(gl_FragCoord.x < split * width ? ours : traced, 0.0);
    vec4 normal = texelFetch(normals, at, 0);
    bool is_surface = dot(normal.xyz, normal.xyz) > 0.0;
    vec3 to_light = normalize(light - texelFetch(positions, at, 0).xyz);
    float lit = visible * max(dot(normal.xyz, to_light), 0.0) * (is_asked ? 1.0 : 0.0);
    vec3 base = normal.w > 0.5 ? vec3(0.75, 0.62, 0.45) : vec3(0.7);
    vec3 linear = kind == 1 ? vec3(is_asked ? visible : 0.0)
                            : is_surface ? base * (0.06 + 0.94 * lit) : background;
    color.rgb = is_bar ? vec3(1.0) : encoded(linear) * (is_asked ? tile_color(at) : vec3(1.0));
}
)glsl";

constexpr std::string_view outline_vertex = R"glsl(
uniform mat4 world_to_clip;
uniform vec3 ends[2];
void main() { gl_Position = world_to_clip * vec4(ends[gl_VertexID], 1.0); }
)glsl";
constexpr std::string_view outline_fragment = R"glsl(
layout(location = 0) out vec4 color;
void main() { color = vec4(1.0, 0.85, 0.3, 1.0); }
)glsl";

Texture colors_of_differences() {
    Image<glm::u8vec4> colors(256, 1);
    for (int x = 0; x < 256; ++x)
        colors(x, 0) = glm::u8vec4(
            pictures::difference_color((static_cast<float>(x) / 127.5F - 1.0F) * difference_scale, difference_scale),
            255);
    Texture texture(colors);
    texture.set_linear();
    return texture;
}

}  // namespace

Presenter::Presenter()
    : shade_(Program::full_screen({{}, {shade}})),
      outline_(Source{{}, {outline_vertex}}, Source{{}, {outline_fragment}}),
      difference_colors_(colors_of_differences()) {}

void Presenter::draw(const Renderer& frame, const Texture& truth, const Texture* tiles, const scenes::Scene& scene,
                     const Show& show) {
    if (picture_.empty() || picture_.size() != frame.size()) {
        picture_ = Texture(GL_RGBA8, frame.size());
        target_ = Framebuffer({{picture_}});
    }
    target_.bind();
    State().set();
    shade_.use();
    shade_.set("positions", 0, frame.positions());
    shade_.set("normals", 1, frame.normals());
    shade_.set("visibility", 2, frame.visibility());
    shade_.set("truth", 3, truth);
    shade_.set("difference_colors", 4, difference_colors_);
    shade_.set("light", scenes::center_of(scene.light));
    shade_.set("kind", static_cast<int>(show.picture));
    shade_.set("tile_classes", 5);
    shade_.set("tile_size", tiles != nullptr ? TileClasses::size : 0);
    if (tiles != nullptr) tiles->bind(5);
    shade_.set("split", show.split);
    shade_.set("difference_scale", difference_scale);
    shade_.draw_full_screen();
    if (!show.light) return;
    outline_.use();
    outline_.set("world_to_clip", frame.world_to_clip(scene.camera));
    for (const LinearLight<float>& piece : scenes::rim(scene.light)) {
        outline_.set("ends[0]", piece.a);
        outline_.set("ends[1]", piece.b);
        outline_.draw_lines(2);
    }
}

void Presenter::show_in_window(glm::ivec2 size) const {
    target_.bind();  // to read from as well
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, target_.size().x, target_.size().y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
}

}  // namespace penumbra::opengl
