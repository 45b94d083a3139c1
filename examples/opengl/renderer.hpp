// A frame: the surfaces that the camera sees, then visibility by a method.
#pragma once

#include <glm/glm.hpp>

#include "../scenes/scene.hpp"
#include "geometry.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"
#include "gl/timers.hpp"
#include "methods/method.hpp"
#include "methods/tile_classes.hpp"

namespace penumbra::opengl {

/// The images of a frame, all of one size.
class Renderer {
  public:
    /// `reverse_depth`: see Frame.
    explicit Renderer(bool reverse_depth);

    /// At least one pixel is drawn, whatever the size.
    void resize(glm::ivec2 size);
    void set_scene(const scenes::Scene& scene);

    /// The method must have been prepared for the scene, and so must `tiles`, if there are any.
    void draw(const scenes::Scene& scene, Method& method, TileClasses* tiles, Timers& timers);

    glm::ivec2 size() const { return positions_.size(); }
    const Geometry& geometry() const { return geometry_; }
    const Texture& positions() const { return positions_; }    ///< see Frame
    const Texture& normals() const { return normals_; }        ///< RGBA16F: towards the eye; 1 on casters, 0 elsewhere
    const Texture& visibility() const { return visibility_; }  ///< R32F: in [0, 1]; −1 where it is not asked
    glm::mat4 world_to_clip(const scenes::Camera& camera) const;

  private:
    bool reverse_depth_;
    Program surfaces_;
    Geometry geometry_;
    Box3<float> receivers_;
    Texture positions_, normals_, depth_, visibility_;
    Framebuffer surface_target_, visibility_target_;
};

}  // namespace penumbra::opengl
