// Lights changed by hand: moved, resized, turned.
#pragma once

#include <penumbra/geometry.hpp>
#include <string>
#include <vector>

#include "../../scenes/light.hpp"

namespace penumbra::opengl {

scenes::Light moved(const scenes::Light& light, const Vec3<float>& by);

/// Turned about an axis through its centre, radians.
scenes::Light turned(const scenes::Light& light, const Vec3<float>& axis, float angle);

/// What its size consists of, world units: a rectangle's half sides, a disk's radius, half a line's length.
struct LightSize {
    const char* name;
    float value;
};
std::vector<LightSize> sizes_of(const scenes::Light& light);

/// With size number `index` of these replaced by `value` > 0.
scenes::Light resized(const scenes::Light& light, std::size_t index, float value);

}  // namespace penumbra::opengl
