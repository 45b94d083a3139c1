// t: the share of a disk light's diameter, across an edge's line, on the side that the edge leaves visible.
//
// The plane through a point and an edge meets the light's plane in a line; t says where that line cuts the disk, from
// 1, where it hides nothing, to 0. From the edge itself t is exact; from depths along the ray from the light's centre,
// as a D-buffer keeps them, it is exact for edges parallel to the light.
#pragma once

#include <algorithm>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// t at `point` behind the edge from v1 to v2, whose caster lies on its left as seen from the light, as for
/// extrusion_points: ½ (1 − N·(c − x) / (r |N × n_c|)), N = (v1 − x) × (v2 − x). Light space of the disk, whose centre
/// is the origin. Domain: coordinates below 1e9. Range [0, 1]; 1 or 0 for radius 0 and for a line parallel to the
/// light's plane and far from the disk; ½ for a point on the edge's line. Error: 4 ε of |x| |v1 − x| over the distance
/// of x from the edge's line, in units of r.
template <class T>
T edge_cut_share(const Vec3<T>& v1, const Vec3<T>& v2, const Vec3<T>& point, T radius) {
    // from the difference of the vertices, which keeps the digits of short edges
    const Vec3<T> normal = glm::cross(v1 - point, v2 - v1);
    const T across = glm::dot(normal, point);
    const T reach = radius * safe_length(Vec3<T>(normal.x, normal.y, T(0)));
    const bool cuts = reach > T(0);
    const T u = clamp(across, -reach, reach) / (cuts ? reach : T(1));
    const T step = across > T(0) ? T(1) : across < T(0) ? T(-1) : T(0);
    return T(0.5) * (T(1) + (cuts ? u : step));
}

/// t past an edge at `silhouette_depth`, at `depth`, on a ray from the light's centre that the caster does not block
/// and that enters the penumbra volume at `penumbra_depth`: 1 − ½ (1/p − 1/x) / (1/s − 1/x). Depths from the light's
/// plane, or all of them distances along the ray. Domain: 0 < s ≤ p. Range [½, 1]; 1 up to p, and for x ≤ s. Source:
/// the umbra and penumbra volume paper for circular lights, eq. 3, put right: denominators from s, branches exchanged.
/// RMSE as printed: .52.
template <class T>
T penumbra_cut_share(T silhouette_depth, T penumbra_depth, T depth) {
    const T s = silhouette_depth, p = penumbra_depth, x = depth;
    // the fractions times s p x, so that nothing is divided but once
    return T(1) - T(0.5) * saturated_ratio((x - p) * s, std::max((x - s) * p, T(0)));
}

/// t past an edge at `silhouette_depth`, at `depth`, on a ray from the light's centre that the caster blocks and that
/// leaves the umbra volume at `umbra_depth`: ½ (1/u − 1/x) / (1/s − 1/x). Domain as penumbra_cut_share. Range [0, ½]; 0
/// up to u.
template <class T>
T umbra_cut_share(T silhouette_depth, T umbra_depth, T depth) {
    const T s = silhouette_depth, u = umbra_depth, x = depth;
    return T(0.5) * saturated_ratio((x - u) * s, std::max((x - s) * u, T(0)));
}

}  // namespace penumbra
