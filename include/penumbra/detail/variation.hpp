// How much visibility can change within a box of points: what lets a batch of points be answered together.
#pragma once

#include <cmath>
#include <penumbra/geometry.hpp>

namespace penumbra {

/// What is known of all points in a box, in light space.
template <class T>
struct Variation {
    bool known = false;                          ///< if not, nothing is
    bool lit = false;                            ///< everything sees the whole light: visibility is exactly 1
    Vec2<T> direction = Vec2<T>(T(1), T(0));     ///< across the light's axis, of unit length: where it changes most
    T along = T(0), across = T(0), deep = T(0);  ///< change for each world unit along it, across it, in depth, at most

    static Variation unknown() { return {}; }
    static Variation all_lit() { return {true, true, Vec2<T>(T(1), T(0)), T(0), T(0), T(0)}; }

    /// A step in the frame in which changes are bounded: along, across, deep.
    Vec3<T> turned(const Vec3<T>& step) const {
        return Vec3<T>(step.x * direction.x + step.y * direction.y, step.y * direction.x - step.x * direction.y,
                       step.z);
    }
    /// Visibilities of two points of the box, that far apart in this frame, differ by at most this.
    T change(const Vec3<T>& turned_step) const {
        return along * std::abs(turned_step.x) + across * std::abs(turned_step.y) + deep * std::abs(turned_step.z);
    }
};

}  // namespace penumbra
