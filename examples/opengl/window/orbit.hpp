// A camera that looks at a point from all around.
#pragma once

#include <glm/glm.hpp>

#include "../../scenes/scene.hpp"

namespace penumbra::opengl {

/// World space, y up.
class Orbit {
  public:
    explicit Orbit(const scenes::Camera& camera);

    void turn(glm::vec2 radians);  ///< to the right and upwards
    void zoom(float factor);       ///< on the distance
    void pan(glm::vec2 heights);   ///< to the right and upwards, in parts of what is seen at the target
    scenes::Camera camera() const;
    /// Level directions to the right of the picture and into it.
    Vec3<float> right() const;
    Vec3<float> ahead() const;
    float distance() const { return distance_; }

  private:
    Vec3<float> target_;
    float azimuth_, elevation_, distance_, width_tan_;
};

}  // namespace penumbra::opengl
