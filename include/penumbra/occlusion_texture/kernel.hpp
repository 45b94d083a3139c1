// The part of an occluding plane through which a point sees the light: what an occlusion texture is averaged
// over.
//
//   light   ───────●───────  depth 0, half-size S
//                 / \ .
//   plane   ─────[───]─────  depth z, kernel: half-size S (p − z) / p, centre P_xy z / p
//                 \ /
//   point          P         depth p
//
// Source: E. Eisemann & X. Décoret, "Plausible image based soft shadows using occlusion textures", 2006,
// eq. 4.
#pragma once

#include <penumbra/geometry.hpp>

namespace penumbra {

/// Size of the kernel as a fraction of the light's: (p − z) / p, in [0, 1]. Depths in world units from the
/// light's plane. 0 where the occluder is not between light and point (z ≥ p, or p ≤ 0: the point is not on
/// the lit side); 1 where the occluder touches or lies behind the light (z ≤ 0 < p). Error: 2 roundings.
template <class T>
constexpr T kernel_scale(T occluder_depth, T point_depth) {
    const T scale = saturated_ratio(point_depth - occluder_depth, point_depth);
    return point_depth > T(0) ? scale : T(0);
}

/// Size of the kernel in the unit of `light_size` (half-extent, extent or radius alike): light_size ×
/// kernel_scale. In [0, light_size].
template <class T>
constexpr T kernel_size(T occluder_depth, T point_depth, T light_size) {
    return light_size * kernel_scale(occluder_depth, point_depth);
}

/// The kernel on the plane at `occluder_depth` through which a point sees a part of the light. Light space,
/// world units; `light_part_ls` is the whole light, [−S, S], or any cell of it. A kernel of scale 0 is the
/// single point P_xy; one of scale 1 is the part itself. Error: 3 roundings of the larger of |P_xy| and the
/// light's extent.
template <class T>
Rect2<T> kernel_rect(T occluder_depth, const Vec3<T>& point_ls, const Rect2<T>& light_part_ls) {
    const T scale = kernel_scale(occluder_depth, point_ls.z);
    const Vec2<T> shift = Vec2<T>(point_ls.x, point_ls.y) * (T(1) - scale);
    return {shift + light_part_ls.min * scale, shift + light_part_ls.max * scale};
}

}  // namespace penumbra
