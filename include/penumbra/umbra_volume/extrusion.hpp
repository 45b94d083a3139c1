// Extrusion points: where the planes through a caster's edge that touch a disk light touch it.
//
// Two planes through an edge touch the disk's rim. The penumbra plane has the disk and the caster on opposite sides:
// beyond it the edge hides nothing. The umbra plane has both on one side: beyond it the edge's caster may hide all.
// In light space the edge's line meets the light's plane at a = A / w, with A = z₁ e_xy − e_z v₁_xy, e = v₂ − v₁ and
// w = −e_z, and the points are those where the tangents from a touch the circle. Written in A and w, which are finite
// where a is not, there is no special case for edges that are parallel to the light, and no loss beside it.
#pragma once

#include <cmath>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// Points of a disk's rim, world space. Not valid where the edge's line meets the disk: no plane through it touches
/// the rim.
template <class T>
struct ExtrusionPoints {
    Vec3<T> umbra, penumbra;
    bool valid;
};

/// The extrusion points of the edge from v1 to v2, for a disk of that radius around the frame's origin, in the frame's
/// first two axes. World space and unit. The caster lies on the left of the edge as seen from the light, that is, on
/// the side of the plane through v1, v2 and a point p of the disk where dot(cross(v1 − p, v2 − p), q − p) < 0: the way
/// in which a face that is counter-clockwise from outside, and looks at the light, runs along its sides. Domain: both
/// vertices in front of the light, coordinates relative to it below 1e15, radius in [0, 1e15]. Reversing the edge swaps
/// the two points, bit for bit. Radius 0: both are the centre, valid unless the edge's line meets it. Continuous
/// through edges parallel to the light. Where the edge's line meets the disk, rim included: not valid, and both points
/// are the rim's nearest to where it does, to which they tend as the line comes in from outside; the disk's centre for
/// a line through it, an edge of no length, and one in the light's plane. Error, of the distance from the disk's centre
/// at which its plane meets the light's: 2 ε r in the light's own frame, at any slope and down to 1e-6 r from the rim;
/// turned to a frame, 1e-6 r and 1e-14 r for edges within 4 r of the axis at depths of r to 4 r. It grows with the
/// rounding of the coordinates in units of the nearer vertex's depth.
/// Source: the umbra and penumbra volume paper for circular lights; derived anew, homogeneous.
template <class T>
ExtrusionPoints<T> extrusion_points(const Vec3<T>& v1, const Vec3<T>& v2, const LightFrame<T>& frame, T radius) {
    const Vec3<T> a = frame.to_light(v1), b = frame.to_light(v2);
    // from the nearer vertex, so that one far away does not drown what lies at the light
    const T distance1 = glm::dot(a, a), distance2 = glm::dot(b, b);
    const bool by_order = a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    const bool forward = distance1 < distance2 || (distance1 == distance2 && by_order);
    const Vec3<T> start = forward ? a : b;
    // e turned, not the difference of what was turned: several digits more for short edges
    const Vec3<T> along_ws = forward ? v2 - v1 : v1 - v2;
    const Vec3<T> scaled = along_ws * exp2_int<T>(detail::exponent_to_unit(detail::largest_component(along_ws)));
    const Vec3<T> along(glm::dot(scaled, frame.u), glm::dot(scaled, frame.v), glm::dot(scaled, frame.normal));
    const Vec2<T> across(start.z * along.x - along.z * start.x, start.z * along.y - along.z * start.y);
    const T reach = safe_length(Vec3<T>(across.x, across.y, T(0))), slope = -along.z;
    const bool has_direction = reach >= std::numeric_limits<T>::min();
    const T divisor = has_direction ? reach : T(1);
    const Vec2<T> outward(has_direction ? across.x / divisor : T(0), has_direction ? across.y / divisor : T(0));
    const T limit = radius * std::abs(slope);
    const bool valid = has_direction && reach > limit;
    const T cosine = clamp(radius * slope / divisor, T(-1), T(1));
    const T sine = valid ? std::sqrt((reach - limit) * (reach + limit)) / divisor : T(0);
    const T side = forward ? sine : -sine;
    const Vec3<T> foot(outward.x * (radius * cosine), outward.y * (radius * cosine), T(0));
    const Vec3<T> aside(-outward.y * (radius * side), outward.x * (radius * side), T(0));
    return {frame.to_world(foot + aside), frame.to_world(foot - aside), valid};
}

/// The same for a disk light.
template <class T>
ExtrusionPoints<T> extrusion_points(const Vec3<T>& v1, const Vec3<T>& v2, const DiskLight<T>& light) {
    return extrusion_points(v1, v2, light_frame(light), light.radius);
}

}  // namespace penumbra
