#include "renderer.hpp"

#include <algorithm>
#include <penumbra/mesh.hpp>

namespace penumbra::opengl {
namespace {

constexpr std::string_view surface_vertex = R"glsl(
uniform mat4 world_to_clip;
in vec3 penumbra_position;
out vec3 position;
void main() {
    position = penumbra_position;
    gl_Position = world_to_clip * vec4(penumbra_position, 1.0);
}
)glsl";

constexpr std::string_view surface_fragment = R"glsl(
uniform vec3 eye, light;  // the light's centre
uniform float on_caster;
in vec3 position;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
void main() {
    vec3 normal = cross(dFdx(position), dFdy(position));  // that of the triangle: shadows know no smooth normals
    normal *= inversesqrt(max(dot(normal, normal), 1e-30)) * (dot(normal, eye - position) < 0.0 ? -1.0 : 1.0);
    out_position = vec4(position, dot(normal, light - position) > 0.0 ? 1.0 : 0.0);
    out_normal = vec4(normal, on_caster);
}
)glsl";

}  // namespace

Renderer::Renderer(bool reverse_depth)
    : reverse_depth_(reverse_depth), surfaces_(Source{{}, {surface_vertex}}, Source{{}, {surface_fragment}}) {
    resize({1, 1});
}

void Renderer::resize(glm::ivec2 size) {
    size = glm::max(size, glm::ivec2(1, 1));
    if (!positions_.empty() && size == positions_.size()) return;
    positions_ = Texture(GL_RGBA32F, size);
    normals_ = Texture(GL_RGBA16F, size);
    depth_ = Texture(GL_DEPTH_COMPONENT32F, size);
    visibility_ = Texture(GL_R32F, size);
    surface_target_ = Framebuffer({{positions_}, {normals_}}, &depth_);
    visibility_target_ = Framebuffer({{visibility_}});
}

void Renderer::set_scene(const scenes::Scene& scene) {
    geometry_ = Geometry(scene);
    receivers_ = bounds(scene.casters);
    for (const Vec3<float>& p : scene.ground.positions) receivers_ = extend(receivers_, p);
}

glm::mat4 Renderer::world_to_clip(const scenes::Camera& camera) const {
    const Vec3<float> back = glm::normalize(camera.eye - camera.target);
    const Vec3<float> right = glm::normalize(glm::cross(Vec3<float>(0.0F, 1.0F, 0.0F), back));
    const Vec3<float> up = glm::cross(back, right);
    const glm::mat4 to_eye = glm::transpose(
        glm::mat4(glm::vec4(right, -glm::dot(right, camera.eye)), glm::vec4(up, -glm::dot(up, camera.eye)),
                  glm::vec4(back, -glm::dot(back, camera.eye)), glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)));
    const float aspect = static_cast<float>(size().x) / static_cast<float>(size().y), near = 0.05F;
    glm::mat4 project(0.0F);  // no far plane
    project[0][0] = 1.0F / camera.width_tan;
    project[1][1] = aspect / camera.width_tan;
    project[2][2] = reverse_depth_ ? 0.0F : -1.0F;
    project[2][3] = -1.0F;
    project[3][2] = reverse_depth_ ? near : -2.0F * near;
    return project * to_eye;
}

void Renderer::draw(const scenes::Scene& scene, Method& method, TileClasses* tiles, Timers& timers) {
    const glm::mat4 world_to_clip = this->world_to_clip(scene.camera);
    {
        const Timers::Scope scope(timers, "surfaces");
        if (reverse_depth_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        surface_target_.clear_color(0, glm::vec4(0.0F));
        surface_target_.clear_color(1, glm::vec4(0.0F));
        surface_target_.clear_depth(reverse_depth_ ? 0.0F : 1.0F);
        State state;
        state.depth = reverse_depth_ ? GL_GREATER : GL_LESS;
        state.set();
        surfaces_.use();
        surfaces_.set("world_to_clip", world_to_clip);
        surfaces_.set("eye", scene.camera.eye);
        surfaces_.set("light", scenes::center_of(scene.light));
        surfaces_.set("on_caster", 1.0F);
        geometry_.draw_casters();
        surfaces_.set("on_caster", 0.0F);
        geometry_.draw_ground();
        visibility_target_.clear_color(0, glm::vec4(-1.0F));
    }
    Frame frame{size(),         positions_,         depth_,  visibility_, world_to_clip, receivers_,
                reverse_depth_, visibility_target_, normals_};
    if (tiles != nullptr) {
        const Timers::Scope scope(timers, "tiles");
        tiles->draw(frame);
        frame.tiles = &tiles->classes();
    }
    method.draw(geometry_, frame, timers);
    if (reverse_depth_) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

}  // namespace penumbra::opengl
