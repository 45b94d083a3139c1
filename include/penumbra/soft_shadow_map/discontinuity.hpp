// Where neighbouring texels of a depth map belong to different surfaces.
//
// Depths and thresholds are in world units; only differences between neighbours count, whatever the resolution.
#pragma once

#include <glm/glm.hpp>
#include <penumbra/geometry.hpp>

namespace penumbra {

/// The Laplacian of a Gaussian of 3 × 3 depths: positive where the middle is nearer than what is around it. Kernel
/// (1 2 1; 2 −12 2; 1 2 1) / 16. A step of height h along a column's or a row's border gives h / 4 on its near side and
/// −h / 4 on the far one; planes 0. Error: 2 ε of the largest depth. Domain: depths below 1e37, so `none` must become
/// one. Source: D. Marr & E. Hildreth, "Theory of edge detection", 1980; Heidrich et al. 2000.
template <class T>
T laplacian_of_gaussian(const glm::mat<3, 3, T, glm::defaultp>& depths) {
    const T corners = (depths[0][0] + depths[0][2]) + (depths[2][0] + depths[2][2]);
    const T sides = (depths[0][1] + depths[2][1]) + (depths[1][0] + depths[1][2]);
    return (corners + T(2) * sides - T(12) * depths[1][1]) * T(0.0625);
}

/// Is there a step between two neighbours with these Laplacians? Where they change sign, and differ as by a step of at
/// least `threshold` > 0. The paper's detector: blind to steps whose sides are less than two texels wide, where both
/// sides are steep it may see some that are not there.
template <class T>
bool is_laplacian_step(T left, T right, T threshold) {
    if ((left > T(0)) == (right > T(0))) return false;
    const T difference = left > right ? left - right : right - left;
    return difference >= T(0.5) * threshold;
}

/// Is there a step between two neighbours along a row or column? `left` and `right` are three depths on either side,
/// those at the border first. There is if depth changes by more than `threshold`, and inverse depth by more than 5 / 4
/// of what it does within either side in the same sense, between all three: surfaces go on as they began, and planes
/// change their inverse depth evenly, however steep. A surface less than three texels wide always has steps around it.
/// `none` and beyond is no surface, steps to which always count. Domain: depths > 0, threshold ≥ 0.
template <class T>
bool is_step(const Vec3<T>& left, const Vec3<T>& right, T threshold, T none) {
    if (!(left.x < none) || !(right.x < none)) return left.x < none || right.x < none;
    if (!((left.x < right.x ? right.x - left.x : left.x - right.x) > threshold)) return false;
    const T sign = right.x < left.x ? T(1) : T(-1);
    const T l = T(1) / left.x, r = T(1) / right.x;
    T before = T(0), after = T(0);
    if (left.y < none && left.z < none)
        before = glm::min(sign * (l - T(1) / left.y), sign * (T(1) / left.y - T(1) / left.z));
    if (right.y < none && right.z < none)
        after = glm::min(sign * (T(1) / right.y - r), sign * (T(1) / right.z - T(1) / right.y));
    const T change = sign * (r - l);
    return change > T(1.25) * before && change > T(1.25) * after;
}

}  // namespace penumbra
