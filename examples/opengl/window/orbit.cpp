#include "orbit.hpp"

#include <algorithm>
#include <cmath>

namespace penumbra::opengl {

Orbit::Orbit(const scenes::Camera& camera) : target_(camera.target), width_tan_(camera.width_tan) {
    const Vec3<float> from = camera.eye - camera.target;
    distance_ = glm::length(from);
    azimuth_ = std::atan2(from.x, from.z);
    elevation_ = std::asin(from.y / distance_);
}

void Orbit::turn(glm::vec2 radians) {
    azimuth_ += radians.x;
    elevation_ = std::clamp(elevation_ + radians.y, -1.5F, 1.5F);
}

void Orbit::zoom(float factor) { distance_ = std::clamp(distance_ * factor, 0.05F, 1000.0F); }

void Orbit::pan(glm::vec2 heights) {
    const float unit = 2.0F * width_tan_ * distance_;
    const Vec3<float> back = glm::normalize(camera().eye - target_);
    target_ += right() * (heights.x * unit) + glm::cross(back, right()) * (heights.y * unit);
}

scenes::Camera Orbit::camera() const {
    const float level = std::cos(elevation_);
    const Vec3<float> from(level * std::sin(azimuth_), std::sin(elevation_), level * std::cos(azimuth_));
    return {target_ + from * distance_, target_, width_tan_};
}

Vec3<float> Orbit::right() const { return {std::cos(azimuth_), 0.0F, -std::sin(azimuth_)}; }
Vec3<float> Orbit::ahead() const { return {-std::sin(azimuth_), 0.0F, -std::cos(azimuth_)}; }

}  // namespace penumbra::opengl
