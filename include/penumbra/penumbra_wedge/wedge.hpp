// Penumbra wedges: the points from which an edge lies before the light, P = E + s (E − q) for E on the edge, q on the
// light and s ≥ 0.
//
// Light space; the light is [−half, half]² in the plane of depth 0. At depth p the points that see one E of depth e
// before the light are a rectangle: centre E p/e, half-size half (p/e − 1). Both are linear in p/e, and so is E, so
// that a slice of the wedge is the convex hull of its ends' two rectangles: their common bounding box, less what two
// tangents cut off. Over all depths, each side of the box is a plane through an end of the edge and a side of the
// light, for whichever end it lies farther out at all depths; each tangent a plane through the edge and a corner of the
// light. These six half-spaces are the wedge, exactly. Where the edge points at the light, the nearer end's rectangle
// holds the other's: there are no tangents, all sides are the nearer end's, and the wedge is the shadow of that end.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>

namespace penumbra {

/// The six outside planes of a wedge, which point inwards, and the plane that parts it. A plane with normal and offset
/// 0 has everything inside. Normals are not of unit length; the shorter, the less well a plane is known.
template <class T>
struct Wedge {
    Plane<T> shadow;                    ///< through the light's centre and the edge; ≥ 0 in the inner half
    Plane<T> inner, outer;              ///< through the edge and a corner of the light, one for each half
    Plane<T> right, top, left, bottom;  ///< through an end and a side of the light, by where they bound the wedge
    Vec2<T> half_size;                  ///< of the light
    T reach;                            ///< largest coordinate of what the planes go through, for their rounding
};

/// Half of a wedge, between the shadow plane and three outside planes; all point inwards.
template <class T>
struct HalfWedge {
    Plane<T> shadow;
    std::array<Plane<T>, 3> outside;
    T reach;
};

/// Points from which the edge does, or does not, leave the light's centre to its left: on the side of what the
/// silhouette hides.
enum class WedgeHalf { inner, outer };

namespace detail {

/// An edge from its end a nearer to the light. `along` is b − a times a power of two; `at` an end that is lit;
/// `reaches` tells on which sides (right, top, left, bottom) of every slice b's rectangle lies farther out than that of
/// a, or, if the edge crosses the light's plane, of where it does.
template <class T>
struct OrderedEdge {
    Vec3<T> a, b, along, at;
    bool lit, crosses, swapped;
    std::array<bool, 4> reaches;
};

template <class T>
OrderedEdge<T> ordered_edge(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec2<T>& half_size) {
    OrderedEdge<T> edge;
    edge.swapped = b_ls.z < a_ls.z;
    edge.a = edge.swapped ? b_ls : a_ls;
    edge.b = edge.swapped ? a_ls : b_ls;
    edge.lit = edge.b.z >= T(0);
    edge.crosses = edge.lit && edge.a.z < T(0);
    edge.at = edge.crosses || largest_component(edge.b) < largest_component(edge.a) ? edge.b : edge.a;
    edge.along = edge.b - edge.a;
    edge.along = edge.along * exp2_int<T>(exponent_to_unit(largest_component(edge.along)));
    // (b.x ± half.x) / b.z against (a.x ± half.x) / a.z, which is the same for all ends on the line. Rounding is
    // monotone, so that opposite sides never both reach. In a slice's plane ends count as they lie.
    const Vec3<T>& low = edge.crosses ? edge.b : edge.a;
    const T depth = edge.along.z > T(0) ? low.z : T(1);
    const T shift_x = edge.along.x * depth, shift_y = edge.along.y * depth;
    edge.reaches[0] = (low.x + half_size.x) * edge.along.z < shift_x;
    edge.reaches[1] = (low.y + half_size.y) * edge.along.z < shift_y;
    edge.reaches[2] = (low.x - half_size.x) * edge.along.z > shift_x;
    edge.reaches[3] = (low.y - half_size.y) * edge.along.z > shift_y;
    return edge;
}

template <class T>
bool side_of_b(const OrderedEdge<T>& edge, int side) {
    return edge.reaches[static_cast<std::size_t>(side % 4)];
}

/// Which way corner k of a slice lies; it ends side k and begins side k + 1, counter-clockwise.
template <class T>
Vec2<T> slice_corner(int k) {
    return Vec2<T>(k == 0 || k == 3 ? T(1) : T(-1), k < 2 ? T(1) : T(-1));
}

template <class T>
Plane<T> plane_of_nothing() {
    return {Vec3<T>(T(0), T(0), T(0)), -std::numeric_limits<T>::max()};
}

/// One side of all slices, through an end of the edge and a side of the light. There is none where an edge crosses the
/// light's plane and b does not reach farther: what is nearly in the plane throws its shadow without limit.
template <class T>
Plane<T> side_plane(const OrderedEdge<T>& edge, int side, const Vec2<T>& half_size) {
    const bool of_b = side_of_b(edge, side), is_x = side % 2 == 0;
    const Vec3<T>& end = of_b ? edge.b : edge.a;
    if (edge.crosses && !of_b) return {Vec3<T>(T(0), T(0), T(0)), T(0)};
    const T sign = side < 2 ? T(1) : T(-1), half = is_x ? half_size.x : half_size.y;
    const T rise = sign * (is_x ? end.x : end.y) + half;
    const T scale = exp2_int<T>(exponent_to_unit(glm::max(end.z, std::abs(rise))));
    const T across = end.z * scale;
    return {Vec3<T>(is_x ? -sign * across : T(0), is_x ? T(0) : -sign * across, rise * scale), -(across * half)};
}

template <class T>
T wedge_slack(const Vec3<T>& point_ls, T reach) {
    return T(32) * std::numeric_limits<T>::epsilon() * (largest_component(point_ls) + reach);
}

}  // namespace detail

/// The wedge of the edge from a to b, an edge of a silhouette: counter-clockwise around what is hidden. Light space,
/// `half_size` ≥ 0. Domain: |coordinates| ≤ 1e18. What of the edge lies behind the light is cut off at depth 0.
/// Degenerate: an edge behind the light has an empty wedge; one in the light's plane nothing or, if it meets the light,
/// everything; a light without area a flat wedge, which reaches back to the light. An edge of no length, or in line
/// with the light's centre, has no shadow plane: its wedge is all outer half.
/// Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006.
template <class T>
Wedge<T> wedge(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec2<T>& half_size) {
    const detail::OrderedEdge<T> edge = detail::ordered_edge(a_ls, b_ls, half_size);
    const Vec3<T> zero(T(0), T(0), T(0));
    Wedge<T> result;
    result.half_size = half_size;
    result.reach = glm::max(detail::largest_component(edge.at), glm::max(half_size.x, half_size.y));
    result.shadow = result.inner = result.outer = Plane<T>{zero, T(0)};
    if (!edge.lit) {
        result.right = result.top = result.left = result.bottom = detail::plane_of_nothing<T>();
        result.inner = result.outer = detail::plane_of_nothing<T>();
        return result;
    }
    const Vec3<T> from_center = edge.at * exp2_int<T>(detail::exponent_to_unit(detail::largest_component(edge.at)));
    result.shadow.normal = edge.swapped ? glm::cross(edge.along, from_center) : glm::cross(from_center, edge.along);
    result.right = detail::side_plane(edge, 0, half_size);
    result.top = detail::side_plane(edge, 1, half_size);
    result.left = detail::side_plane(edge, 2, half_size);
    result.bottom = detail::side_plane(edge, 3, half_size);
    for (int k = 0; k < 4; ++k) {
        const bool here = detail::side_of_b(edge, k), next = detail::side_of_b(edge, k + 1);
        if (here == next) continue;
        const Vec2<T> toward = detail::slice_corner<T>(k);  // seen through the edge, the light is upside down
        const Vec3<T> corner = Vec3<T>(-toward.x * half_size.x, -toward.y * half_size.y, T(0)) - edge.at;
        const Vec3<T> ray = corner * exp2_int<T>(detail::exponent_to_unit(detail::largest_component(corner)));
        const Vec3<T> normal = next ? glm::cross(edge.along, ray) : glm::cross(ray, edge.along);
        (next == edge.swapped ? result.inner : result.outer) = Plane<T>{normal, -glm::dot(normal, edge.at)};
    }
    return result;
}

/// One half of a wedge by three outside planes, as the paper has it: the plane through the edge, and one side plane at
/// each end, those that leave least outside the half; all three sides where the edge points at the light. Contains the
/// half, and 3 % more, measured over random edges in a box around edge and light.
template <class T>
HalfWedge<T> half_wedge(const Wedge<T>& wedge, WedgeHalf which) {
    const bool inner = which == WedgeHalf::inner;
    const Vec3<T> zero(T(0), T(0), T(0)), normal = inner ? wedge.shadow.normal : -wedge.shadow.normal;
    const bool nothing = inner && normal == zero;
    const Plane<T> shadow = nothing ? detail::plane_of_nothing<T>() : Plane<T>{normal, T(0)};
    const Plane<T>& through = inner ? wedge.inner : wedge.outer;
    // of the sides next to the corner that lies farthest out, both, or one and the side across
    const bool to_right = normal.x >= T(0), to_top = normal.y >= T(0);
    const T out_x = std::abs(normal.x) * wedge.half_size.x, out_y = std::abs(normal.y) * wedge.half_size.y;
    const Plane<T>& x = to_right ? wedge.right : wedge.left;
    const Plane<T>& y = to_top ? wedge.top : wedge.bottom;
    const Plane<T>& across =
        out_x <= out_y ? (to_right ? wedge.left : wedge.right) : (to_top ? wedge.bottom : wedge.top);
    if (through.normal == zero && through.offset == T(0)) return {shadow, {x, y, across}, wedge.reach};
    if (out_x < T(3) * out_y && out_y < T(3) * out_x) return {shadow, {through, x, y}, wedge.reach};
    return {shadow, {through, out_x <= out_y ? x : y, across}, wedge.reach};
}

/// Whether a point of depth > 0 may be in the wedge. Light space. Never false for a point of the wedge; true for those
/// outside only within 32 ε of the largest coordinate, farther where an edge points at a corner of the light.
template <class T>
bool contains(const Wedge<T>& wedge, const Vec3<T>& point_ls) {
    const T through = glm::min(signed_distance(wedge.inner, point_ls), signed_distance(wedge.outer, point_ls));
    const T x = glm::min(signed_distance(wedge.right, point_ls), signed_distance(wedge.left, point_ls));
    const T y = glm::min(signed_distance(wedge.top, point_ls), signed_distance(wedge.bottom, point_ls));
    return glm::min(through, glm::min(x, y)) >= -detail::wedge_slack(point_ls, wedge.reach);
}

/// Whether a point of depth > 0 may be in the half of a wedge. Never false for a point of it.
template <class T>
bool contains(const HalfWedge<T>& part, const Vec3<T>& point_ls) {
    const T first = glm::min(signed_distance(part.shadow, point_ls), signed_distance(part.outside[0], point_ls));
    const T second = glm::min(signed_distance(part.outside[1], point_ls), signed_distance(part.outside[2], point_ls));
    return glm::min(first, second) >= -detail::wedge_slack(point_ls, part.reach);
}

/// Vertices and triangles of the geometry that bounds a wedge: a prism, 6 vertices at the edge and 6 at the far depth.
inline constexpr int wedge_vertex_count = 12, wedge_triangle_count = 20;

/// The triangles' vertices, wound outwards in a right-handed space: closed, each side shared by two triangles. Some
/// have no area, since the edge has two ends for six vertices.
inline constexpr std::uint8_t wedge_triangles[wedge_triangle_count][3] = {
    {0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}, {6, 7, 8},  {6, 8, 9},  {6, 9, 10}, {6, 10, 11}, {0, 1, 7}, {0, 7, 6},
    {1, 2, 8}, {1, 8, 7}, {2, 3, 9}, {2, 9, 8}, {3, 4, 10}, {3, 10, 9}, {4, 5, 11}, {4, 11, 10}, {5, 0, 6}, {5, 6, 11}};

/// Vertex `index` of the geometry that bounds what of a wedge lies within `receivers_ls`: the wedge itself up to the
/// receivers' largest depth. Light space. A wedge that reaches sideways without limit, because its edge comes within 64
/// ε of that depth to the light's plane, is bounded by the receivers' box. All vertices are one point where no receiver
/// is beyond the edge.
template <class T>
Vec3<T> wedge_vertex(const Vec3<T>& a_ls, const Vec3<T>& b_ls, const Vec2<T>& half_size, const Box3<T>& receivers_ls,
                     int index) {
    const detail::OrderedEdge<T> edge = detail::ordered_edge(a_ls, b_ls, half_size);
    const T depth = receivers_ls.max.z;
    const bool deep = index >= 6;
    const int slot = deep ? index - 6 : index;
    if (!edge.lit || !(depth > edge.a.z)) return edge.a;
    if (edge.crosses || edge.a.z <= T(64) * std::numeric_limits<T>::epsilon() * depth) {
        const Vec2<T> toward = detail::slice_corner<T>(slot < 3 ? slot : 3);
        return Vec3<T>(toward.x > T(0) ? receivers_ls.max.x : receivers_ls.min.x,
                       toward.y > T(0) ? receivers_ls.max.y : receivers_ls.min.y, deep ? depth : receivers_ls.min.z);
    }
    bool of_b = false;
    int corner = 0;
    for (int k = 0, last = -1; k < 4; ++k) {  // 4 or 6 vertices, the last again and again
        const bool here = detail::side_of_b(edge, k), next = detail::side_of_b(edge, k + 1);
        if (slot > last) of_b = here, corner = k;
        ++last;
        if (here != next && slot > last) of_b = next, corner = k;
        if (here != next) ++last;
    }
    Vec3<T> end = of_b ? edge.b : edge.a;
    if (end.z > depth) {
        end = edge.a + (edge.b - edge.a) * ((depth - edge.a.z) / (edge.b.z - edge.a.z));
        end.z = depth;
    }
    if (!deep || end.z == depth) return end;
    const Vec2<T> toward = detail::slice_corner<T>(corner);
    const T ratio = depth / end.z, out_x = toward.x * half_size.x, out_y = toward.y * half_size.y;
    return Vec3<T>((end.x + out_x) * ratio - out_x, (end.y + out_y) * ratio - out_y, depth);
}

}  // namespace penumbra
