// What a method of soft shadows is to the renderer.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <penumbra/geometry.hpp>
#include <penumbra/plan/extents.hpp>
#include <string>
#include <vector>

#include "../../scenes/scene.hpp"
#include "../geometry.hpp"
#include "../gl/program.hpp"
#include "../gl/texture.hpp"
#include "../gl/timers.hpp"
#include "knob.hpp"

namespace penumbra::opengl {

/// What the driver can do beyond OpenGL 3.3.
struct Capabilities {
    bool compute = false;        ///< OpenGL 4.3: compute shaders and image stores
    bool reverse_depth = false;  ///< glClipControl: clip depths from 0 to 1, as 32-bit floats with near planes at 1
};

/// A frame whose surfaces are drawn: where visibility is asked, and where it goes.
struct Frame {
    glm::ivec2 size;
    const Texture& positions;   ///< RGBA32F: world space, and 1 where visibility is asked, 0 elsewhere
    const Texture& depth;       ///< DEPTH_COMPONENT32F, of the same surfaces
    const Texture& visibility;  ///< R32F: to write where visibility is asked
    glm::mat4 world_to_clip;
    Box3<float> receivers;      ///< world space, around all that may be in `positions`
    bool reverse_depth;         ///< near is 1 and far 0, else near 0 and far 1
    const Framebuffer& target;  ///< draws to `visibility` alone
    const Texture& normals;     ///< RGBA16F: world space, of the triangles, towards the eye
    /// Classes of tiles, if there are any: where all is lit, nothing is asked.
    const Texture* tiles = nullptr;
};

using Query = std::function<void(const Vec3<float>* points, std::size_t count, float* visible)>;

/// Of one of the library's shadows, made of these arguments.
template <class Shadow, class... Arguments>
Query query_of(const Arguments&... arguments) {
    const auto shadow = std::make_shared<const Shadow>(arguments...);
    return [shadow](const Vec3<float>* points, std::size_t count, float* visible) {
        shadow->visibility(points, count, visible);
    };
}

/// What tiles are judged by: the light in its frame, and by how much a method's images widen casters.
struct TileView {
    LightFrame<float> frame;
    LightExtent<float> light;
    float texel = 0.0F, texel_slope = 0.0F;  ///< a texel's width on the light's plane, and more for each unit of depth
    float thickness = 0.0F;                  ///< of slices
};

/// One of the library's methods by its shaders. Knobs are the options of the C++ class where it has them, so that
/// `by_cpp` answers the same question.
class Method {
  public:
    Method() = default;
    virtual ~Method() = default;
    Method(const Method&) = delete;
    Method& operator=(const Method&) = delete;

    virtual bool takes(const scenes::Light& light) const = 0;
    /// Knobs of what the scene or the frame is drawn with. After one is set: prepare().
    virtual std::vector<Knob> knobs() = 0;
    /// The scene, its light or a knob has changed. What only the host can do is done here. `takes` the light.
    virtual void prepare(const scenes::Scene& scene, const Geometry& geometry) = 0;
    /// Nothing where tiles spare nothing, or the method answers otherwise than 1 where nothing is before the light.
    /// What is in it is that of the latest prepare().
    virtual std::optional<TileView> tile_view() const { return std::nullopt; }
    /// All passes of a frame, those that depend on the light alone included.
    virtual void draw(const Geometry& geometry, const Frame& frame, Timers& timers) = 0;
    /// Turns knobs as a plan has them, which loses no more than `tolerance` of visibility, and says what was decided;
    /// an empty text where there are no plans. All casters stay. After it: prepare().
    virtual std::string plan(const scenes::Scene&, float /*tolerance*/) { return {}; }
    /// Visibility of the same scene by the C++ with the same knobs.
    virtual Query by_cpp(const scenes::Scene& scene) const = 0;
};

std::unique_ptr<Method> make_occlusion_texture(const Capabilities& capabilities);
std::unique_ptr<Method> make_penumbra_wedge(const Capabilities& capabilities);
std::unique_ptr<Method> make_umbra_volume(const Capabilities& capabilities);
std::unique_ptr<Method> make_soft_shadow_map(const Capabilities& capabilities);
/// Percentage-closer soft shadows: what most engines have, for comparison. Not the library's.
std::unique_ptr<Method> make_pcss(const Capabilities& capabilities);

/// "occlusion_texture", "penumbra_wedge", "umbra_volume", "soft_shadow_map", "pcss".
std::vector<std::string> method_names();
/// Throws std::runtime_error with a message for the user if there is none of that name.
std::unique_ptr<Method> make_method(const std::string& name, const Capabilities& capabilities);

/// What shading passes begin with. `penumbra_point()` is the world-space point of the fragment's pixel, its w 1 where
/// visibility is asked; visibility goes to `visible`, and is 1 where `penumbra_is_lit()` says so. See tell_points().
inline constexpr std::string_view shading_head = R"glsl(
uniform highp sampler2D positions;
uniform highp usampler2D tile_classes;
uniform int tile_size;  // 0: there are none
layout(location = 0) out float visible;
vec4 penumbra_point() { return texelFetch(positions, ivec2(gl_FragCoord.xy), 0); }
bool penumbra_is_lit() {
    return tile_size > 0 && texelFetch(tile_classes, ivec2(gl_FragCoord.xy) / tile_size, 0).r == 0u;
}
)glsl";

/// To a program in use that begins so. Takes texture units 0 and 8.
void tell_points(const Program& program, const Frame& frame);

}  // namespace penumbra::opengl
