// What a method of soft shadows is to the renderer.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <penumbra/geometry.hpp>
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
    /// All passes of a frame, those that depend on the light alone included.
    virtual void draw(const Geometry& geometry, const Frame& frame, Timers& timers) = 0;
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
/// visibility is asked; visibility goes to `visible`.
inline constexpr std::string_view shading_head = R"glsl(
uniform highp sampler2D positions;
layout(location = 0) out float visible;
vec4 penumbra_point() { return texelFetch(positions, ivec2(gl_FragCoord.xy), 0); }
)glsl";

}  // namespace penumbra::opengl
