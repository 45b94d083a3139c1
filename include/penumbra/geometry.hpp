// Vectors, rectangles, boxes, planes, and the clipping of convex polygons.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <penumbra/detail/error.hpp>
#include <penumbra/numeric.hpp>
#include <string>

namespace penumbra {

template <class T>
using Vec2 = glm::vec<2, T, glm::defaultp>;
template <class T>
using Vec3 = glm::vec<3, T, glm::defaultp>;

template <class T>
bool is_finite(const Vec2<T>& v) {
    return is_finite(v.x) && is_finite(v.y);
}
template <class T>
bool is_finite(const Vec3<T>& v) {
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

namespace detail {

template <class T>
std::string text(const Vec3<T>& v) {
    return "(" + text(static_cast<double>(v.x)) + ", " + text(static_cast<double>(v.y)) + ", " +
           text(static_cast<double>(v.z)) + ")";
}

/// Of the components; glm::abs may not be inlined.
template <class T>
Vec3<T> magnitudes(const Vec3<T>& v) {
    return Vec3<T>(std::abs(v.x), std::abs(v.y), std::abs(v.z));
}
template <class T>
T largest_component(const Vec3<T>& v) {
    return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

/// The exponent of the power of two that brings `largest` near 1, where squares neither overflow nor vanish. Powers
/// scale exactly; and nothing is divided by `largest`, whose reciprocal, which -ffast-math takes, may be a denormal.
template <class T>
int exponent_to_unit(T largest) {
    constexpr int most = std::numeric_limits<T>::max_exponent - 2;
    return clamp(-floor_log2(largest), -most, most);
}

}  // namespace detail

/// v / |v|, or `fallback` where v is too short to have a direction (length below the smallest normal number)
/// or not finite. Scales before squaring, so that neither 1e-30 nor 1e+30 is lost. Error: 3.5 ULP a component,
/// 5 with -ffast-math.
template <class T>
Vec3<T> normalize_or(const Vec3<T>& v, const Vec3<T>& fallback) {
    const T largest = detail::largest_component(v);
    if (!(largest >= std::numeric_limits<T>::min()) || !is_finite(largest)) return fallback;
    const Vec3<T> scaled = v * exp2_int<T>(detail::exponent_to_unit(largest));
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

/// |v|, also where the squares of its coordinates would overflow or vanish. Error: 2.5 ULP, 4 with -ffast-math.
template <class T>
T safe_length(const Vec3<T>& v) {
    const int exponent = detail::exponent_to_unit(detail::largest_component(v));
    const Vec3<T> scaled = v * exp2_int<T>(exponent);
    return std::sqrt(glm::dot(scaled, scaled)) * exp2_int<T>(-exponent);
}

/// A unit vector perpendicular to the unit vector n. Continuous except where n.z changes sign.
/// Source: T. Duff et al., "Building an orthonormal basis, revisited", 2017.
template <class T>
Vec3<T> any_perpendicular(const Vec3<T>& n) {
    const T sign = n.z < T(0) ? T(-1) : T(1);
    const T a = T(-1) / (sign + n.z);
    return Vec3<T>(T(1) + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}

/// An axis-aligned rectangle, closed; empty where max < min in a coordinate.
template <class T>
struct Rect2 {
    Vec2<T> min, max;
};

/// The rectangle that contains nothing and that `extend` may start from.
template <class T>
Rect2<T> empty_rect() {
    constexpr T big = std::numeric_limits<T>::max();
    return {Vec2<T>(big, big), Vec2<T>(-big, -big)};
}

template <class T>
Vec2<T> extent(const Rect2<T>& r) {
    return r.max - r.min;
}

template <class T>
Rect2<T> extend(const Rect2<T>& r, const Vec2<T>& point) {
    return {glm::min(r.min, point), glm::max(r.max, point)};
}

template <class T>
Rect2<T> intersect(const Rect2<T>& a, const Rect2<T>& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

/// Area of r; 0 for an empty one.
template <class T>
T area(const Rect2<T>& r) {
    const Vec2<T> size = extent(r);
    return size.x > T(0) && size.y > T(0) ? size.x * size.y : T(0);
}

/// An axis-aligned box, closed; empty where max < min in a coordinate.
template <class T>
struct Box3 {
    Vec3<T> min, max;
};

/// The box that contains nothing and that `extend` may start from.
template <class T>
Box3<T> empty_box() {
    constexpr T big = std::numeric_limits<T>::max();
    return {Vec3<T>(big, big, big), Vec3<T>(-big, -big, -big)};
}

template <class T>
bool is_empty(const Box3<T>& b) {
    return !(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z);
}

template <class T>
Box3<T> extend(const Box3<T>& b, const Vec3<T>& point) {
    return {glm::min(b.min, point), glm::max(b.max, point)};
}

namespace detail {

/// How far a box reaches from the origin, axis by axis.
template <class T>
Vec3<T> farthest_of(const Box3<T>& b) {
    return glm::max(magnitudes(b.min), magnitudes(b.max));
}

/// Around both.
template <class T>
Box3<T> join(const Box3<T>& a, const Box3<T>& b) {
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

}  // namespace detail

/// The plane { x : dot(normal, x) + offset = 0 }; its inside is where the left side is ≥ 0.
template <class T>
struct Plane {
    Vec3<T> normal;
    T offset;
};

/// Signed distance of `point` in units of |normal|; ≥ 0 inside.
template <class T>
T signed_distance(const Plane<T>& plane, const Vec3<T>& point) {
    return glm::dot(plane.normal, point) + plane.offset;
}

/// A convex polygon of at most Capacity vertices, without allocation. Vertex is any type with + − and
/// scaling.
template <class Vertex, std::size_t Capacity>
struct ConvexPolygon {
    std::array<Vertex, Capacity> vertices{};
    std::size_t count = 0;

    void push(const Vertex& v) {
        if (count < Capacity) vertices[count++] = v;
    }
};

/// The part of `polygon` where distance(vertex) ≥ 0, `distance` being linear in the vertex. A cut gains at
/// most one vertex. Cut points are computed from the inside vertex to the outside one, so that two polygons
/// with a common edge get the same point, bit for bit; `settle(vertex)` may then put them exactly on the border.
/// Source: I. Sutherland & G. Hodgman, "Reentrant polygon clipping", 1974.
template <class Vertex, std::size_t Capacity, class Distance, class Settle>
ConvexPolygon<Vertex, Capacity> clip(const ConvexPolygon<Vertex, Capacity>& polygon, Distance&& distance,
                                     Settle&& settle) {
    ConvexPolygon<Vertex, Capacity> result;
    const auto cut = [&](const Vertex& inside, const Vertex& outside, auto share) {
        Vertex v = inside + (outside - inside) * share;
        settle(v);
        result.push(v);
    };
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vertex& a = polygon.vertices[i];
        const Vertex& b = polygon.vertices[i + 1 == polygon.count ? 0 : i + 1];
        const auto da = distance(a), db = distance(b);
        const bool a_inside = da >= 0, b_inside = db >= 0;
        if (a_inside) result.push(a);
        if (a_inside && !b_inside) cut(a, b, da / (da - db));
        if (!a_inside && b_inside) cut(b, a, db / (db - da));
    }
    return result;
}
template <class Vertex, std::size_t Capacity, class Distance>
ConvexPolygon<Vertex, Capacity> clip(const ConvexPolygon<Vertex, Capacity>& polygon, Distance&& distance) {
    return clip(polygon, distance, [](Vertex&) {});
}

}  // namespace penumbra
