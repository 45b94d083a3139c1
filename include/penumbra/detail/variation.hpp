// How much visibility can change within a box of points: what lets a batch of points be answered together.
#pragma once

#include <cmath>
#include <penumbra/geometry.hpp>

namespace penumbra {

/// What is known of all points in a box, in light space: of two that are `step` apart, visibilities differ by slope ·
/// step, give or take change(turned(step)).
template <class T>
struct Variation {
    bool known = false;                          ///< if not, nothing is
    bool lit = false;                            ///< everything sees the whole light: visibility is exactly 1
    Vec3<T> slope = Vec3<T>(T(0), T(0), T(0));   ///< for each world unit; 0 on a lit box
    Vec2<T> direction = Vec2<T>(T(1), T(0));     ///< across the light's axis, of unit length: where most is in doubt
    T along = T(0), across = T(0), deep = T(0);  ///< doubt for each world unit along it, across it, in depth, at most
    T turning = T(0);                            ///< doubt between any two points

    static Variation unknown() { return {}; }
    static Variation all_lit() {
        Variation result;
        result.known = result.lit = true;
        return result;
    }

    /// Whatever it is, all see the same.
    static Variation unchanging() {
        Variation result;
        result.known = true;
        return result;
    }

    /// A step in the frame in which doubts are bounded: along, across, deep.
    Vec3<T> turned(const Vec3<T>& step) const {
        return Vec3<T>(step.x * direction.x + step.y * direction.y, step.y * direction.x - step.x * direction.y,
                       step.z);
    }
    /// Visibilities of two points of the box, that far apart in this frame, differ from the slope by at most this.
    T change(const Vec3<T>& turned_step) const {
        return turning + along * std::abs(turned_step.x) + across * std::abs(turned_step.y) +
               deep * std::abs(turned_step.z);
    }
};

}  // namespace penumbra
