// The three lights, and the frame in which a light sees the scene.
#pragma once

#include <cmath>
#include <penumbra/detail/error.hpp>
#include <penumbra/geometry.hpp>
#include <string>

namespace penumbra {

/// A rectangle that emits along cross(half_u, half_v). World space, world units; half_u ⟂ half_v.
template <class T>
struct RectLight {
    Vec3<T> center, half_u, half_v;
};

/// A disk that emits along `normal`, which need not be of unit length. World space, world units.
template <class T>
struct DiskLight {
    Vec3<T> center, normal;
    T radius;
};

/// A line segment from a to b that emits in every direction. World space, world units.
template <class T>
struct LinearLight {
    Vec3<T> a, b;
};

/// An orthonormal, right-handed frame whose third axis is the light's emission direction.
/// In light space (_ls) the third coordinate is the depth: 0 on the light's plane, positive on the lit side.
template <class T>
struct LightFrame {
    Vec3<T> origin, u, v, normal;

    /// World space to light space. Subtracts the origin first, which keeps scenes far from the world's origin
    /// exact to the rounding of their own coordinates (-ffast-math may undo that).
    Vec3<T> to_light(const Vec3<T>& point_ws) const {
        const Vec3<T> offset = point_ws - origin;
        return Vec3<T>(glm::dot(offset, u), glm::dot(offset, v), glm::dot(offset, normal));
    }
    /// Light space to world space.
    Vec3<T> to_world(const Vec3<T>& point_ls) const {
        return origin + point_ls.x * u + point_ls.y * v + point_ls.z * normal;
    }
};

/// Half-extents of a rectangle light along its frame's u and v, world units.
template <class T>
Vec2<T> half_size(const RectLight<T>& light) {
    return Vec2<T>(safe_length(light.half_u), safe_length(light.half_v));
}

/// The frame of a rectangle light. A zero-size side takes any direction perpendicular to the other; a light
/// with no size at all emits along `aim` (world space, any length), or along −z where `aim` has no direction
/// either.
template <class T>
LightFrame<T> light_frame(const RectLight<T>& light, const Vec3<T>& aim = Vec3<T>(T(0), T(0), T(-1))) {
    const Vec3<T> zero(T(0), T(0), T(0));
    Vec3<T> u = normalize_or(light.half_u, zero);
    Vec3<T> v = normalize_or(light.half_v, zero);
    const bool has_u = glm::dot(u, u) > T(0), has_v = glm::dot(v, v) > T(0);
    const Vec3<T> direction = normalize_or(aim, Vec3<T>(T(0), T(0), T(-1)));
    // With a side missing, the normal is the part of `aim` perpendicular to the side that is there.
    if (!has_u || !has_v) {
        const Vec3<T> side = has_u ? u : has_v ? v : zero;
        const Vec3<T> across = direction - side * glm::dot(direction, side);
        Vec3<T> normal = glm::dot(across, across) > T(1e-6) ? normalize_or(across, direction) : any_perpendicular(side);
        // Again: what rounding left along the side is large beside an `across` of 1e-3.
        normal = normalize_or(normal - side * glm::dot(normal, side), normal);
        if (!has_u && !has_v) u = any_perpendicular(normal);
        if (!has_u && has_v) u = glm::cross(v, normal);
        v = glm::cross(normal, u);
        return {light.center, u, v, normal};
    }
    const Vec3<T> normal = normalize_or(glm::cross(u, v), direction);
    return {light.center, u, glm::cross(normal, u), normal};
}

/// The frame of a disk light: third axis along its normal (−z where it has none), first axis arbitrary.
template <class T>
LightFrame<T> light_frame(const DiskLight<T>& light) {
    const Vec3<T> normal = normalize_or(light.normal, Vec3<T>(T(0), T(0), T(-1)));
    const Vec3<T> u = any_perpendicular(normal);
    return {light.center, u, glm::cross(normal, u), normal};
}

/// The frame of a linear light: origin at its midpoint, first axis along b − a, third axis the part of `aim`
/// perpendicular to it (any perpendicular where `aim` runs along the light).
template <class T>
LightFrame<T> light_frame(const LinearLight<T>& light, const Vec3<T>& aim = Vec3<T>(T(0), T(0), T(-1))) {
    const Vec3<T> half = light.b * T(0.5) - light.a * T(0.5);  // halved first: b − a may overflow
    return light_frame(RectLight<T>{light.a + half, half, Vec3<T>(T(0), T(0), T(0))}, aim);
}

namespace detail {

/// The ends, along one axis, of where points of a caster at [low, high] appear from receivers at [from, to], on the
/// light's plane. E appears at E + (E − P)(m − 1) from P, m = p / (p − z) being between `least` and `most`.
template <class T>
Vec2<T> project_range(T low, T high, T from, T to, T least, T most) {
    const T left = low - to, right = high - from;
    return Vec2<T>(low + left * ((left < T(0) ? most : least) - T(1)),
                   high + right * ((right > T(0) ? most : least) - T(1)));
}

}  // namespace detail

/// Where on the light's plane any point of a caster's box may appear from any point of the receivers' box, both in
/// light space. What the caster has behind the light's plane, and beyond the receivers, is left out; empty if nothing
/// is left. Where some receiver lies no deeper than the caster, the rectangle reaches 1e9 times as far as they are
/// apart. Error: 4 roundings of the largest coordinate, times p / (p − z).
template <class T>
Rect2<T> project_box(const Box3<T>& caster_ls, const Box3<T>& receivers_ls) {
    const T near = caster_ls.min.z > T(0) ? caster_ls.min.z : T(0);
    if (is_empty(caster_ls) || is_empty(receivers_ls) || !(near < receivers_ls.max.z) || !(caster_ls.max.z > T(0)))
        return empty_rect<T>();
    constexpr T far = T(1e9);
    const T room = receivers_ls.min.z - caster_ls.max.z;
    const T least = receivers_ls.max.z / (receivers_ls.max.z - near);
    const T most = room * far > receivers_ls.min.z ? receivers_ls.min.z / room : far;
    const Vec2<T> x = detail::project_range(caster_ls.min.x, caster_ls.max.x, receivers_ls.min.x, receivers_ls.max.x,
                                            least, most > least ? most : least);
    const Vec2<T> y = detail::project_range(caster_ls.min.y, caster_ls.max.y, receivers_ls.min.y, receivers_ls.max.y,
                                            least, most > least ? most : least);
    return {Vec2<T>(x.x, y.x), Vec2<T>(x.y, y.y)};
}

namespace detail {

template <class T>
bool require_finite(const Vec3<T>& v, const char* name) {
    return require(is_finite(v), [&] { return std::string(name) + " = " + text(v) + " is not finite"; });
}

}  // namespace detail

/// Reports (see detail/error.hpp) a light with a coordinate that is not finite, or with sides that are not
/// perpendicular (|cos| > 1e-3). True if the light is good.
template <class T>
bool validate(const RectLight<T>& light) {
    if (!detail::require_finite(light.center, "light.center") ||
        !detail::require_finite(light.half_u, "light.half_u") || !detail::require_finite(light.half_v, "light.half_v"))
        return false;
    const Vec3<T> zero(T(0), T(0), T(0));
    const T cosine = std::abs(glm::dot(normalize_or(light.half_u, zero), normalize_or(light.half_v, zero)));
    return detail::require(cosine <= T(1e-3), [&] {
        return "light.half_u = " + detail::text(light.half_u) +
               " is not perpendicular to light.half_v = " + detail::text(light.half_v);
    });
}

/// Reports a light with a coordinate that is not finite, a normal without direction, or a negative radius.
template <class T>
bool validate(const DiskLight<T>& light) {
    const Vec3<T> zero(T(0), T(0), T(0));
    return detail::require_finite(light.center, "light.center") &&
           detail::require_finite(light.normal, "light.normal") &&
           detail::require(normalize_or(light.normal, zero) != zero,
                           [&] { return "light.normal = " + detail::text(light.normal) + " has no direction"; }) &&
           detail::require(is_finite(light.radius) && light.radius >= T(0), [&] {
               return "light.radius = " + detail::text(static_cast<double>(light.radius)) +
                      " is not a finite number ≥ 0";
           });
}

/// Reports a light with an end that is not finite.
template <class T>
bool validate(const LinearLight<T>& light) {
    return detail::require_finite(light.a, "light.a") && detail::require_finite(light.b, "light.b");
}

}  // namespace penumbra
