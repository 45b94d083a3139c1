// Where a caster's shadow can be: what bounds the work on one silhouette.
#pragma once

#include <penumbra/geometry.hpp>

namespace penumbra {

/// All points between two depths whose x and y are within a rectangle that changes linearly from `near` to `far`.
/// Light space.
template <class T>
struct ShadowFrustum {
    T near_depth, far_depth;
    Rect2<T> near, far;
};

namespace detail {

template <class T>
ShadowFrustum<T> empty_frustum() {
    return {T(0), T(0), empty_rect<T>(), empty_rect<T>()};
}

/// The largest P.x = E.x + s (E.x + half) at `depth`, for E of a box with this largest x and depths. In depth it is the
/// larger of two lines, one for each end of the depths.
template <class T>
T farthest_out(T largest, T half, const Box3<T>& box, T depth) {
    const T of_near = (largest + half) * (depth / box.min.z), of_far = (largest + half) * (depth / box.max.z);
    return (of_near > of_far ? of_near : of_far) - half;
}

template <class T>
Rect2<T> farthest_out(const Box3<T>& box, const Vec2<T>& half, T depth, T margin) {
    return {Vec2<T>(-farthest_out(-box.min.x, half.x, box, depth) - margin,
                    -farthest_out(-box.min.y, half.y, box, depth) - margin),
            Vec2<T>(farthest_out(box.max.x, half.x, box, depth) + margin,
                    farthest_out(box.max.y, half.y, box, depth) + margin)};
}

}  // namespace detail

template <class T>
bool is_empty(const ShadowFrustum<T>& frustum) {
    return !(frustum.near_depth < frustum.far_depth);
}

/// Contains all points within `receivers_ls` from which something in `box_ls` lies before the light, with a margin of
/// 2⁻¹⁰ of the receivers' largest depth around them: for what rasterizers round. Light space; the light's half-extents
/// ≥ 0. All of the receivers, where the box comes as near as 2⁻¹² of that depth to the light's plane, or reaches
/// behind it. Empty if no receiver lies beyond the box, or it is behind the light.
template <class T>
ShadowFrustum<T> shadow_frustum(const Box3<T>& box_ls, const Vec2<T>& half_size, const Box3<T>& receivers_ls) {
    const T deepest = receivers_ls.max.z, margin = deepest / T(1024);
    if (is_empty(box_ls) || is_empty(receivers_ls) || !(box_ls.min.z < deepest) || !(box_ls.max.z > T(0)))
        return detail::empty_frustum<T>();
    const T far = deepest + margin;
    if (!(box_ls.min.z > deepest / T(4096))) {
        const Rect2<T> all{Vec2<T>(receivers_ls.min.x - margin, receivers_ls.min.y - margin),
                           Vec2<T>(receivers_ls.max.x + margin, receivers_ls.max.y + margin)};
        return {T(0), far, all, all};
    }
    return {box_ls.min.z, far, detail::farthest_out(box_ls, half_size, box_ls.min.z, margin),
            detail::farthest_out(box_ls, half_size, far, margin)};
}

/// False only if no point is in both.
template <class T>
bool may_meet(const ShadowFrustum<T>& a, const ShadowFrustum<T>& b) {
    const T near = glm::max(a.near_depth, b.near_depth), far = glm::min(a.far_depth, b.far_depth);
    if (!(near < far)) return false;
    const auto at = [](const ShadowFrustum<T>& f, T depth) {
        const T t = (depth - f.near_depth) / (f.far_depth - f.near_depth);
        return Rect2<T>{f.near.min * (T(1) - t) + f.far.min * t, f.near.max * (T(1) - t) + f.far.max * t};
    };
    // apart along an axis at both ends, the same way round, is apart all the way
    const Rect2<T> an = at(a, near), bn = at(b, near), af = at(a, far), bf = at(b, far);
    const auto apart = [](T max_near, T min_near, T max_far, T min_far) {
        return max_near < min_near && max_far < min_far;
    };
    return !(apart(an.max.x, bn.min.x, af.max.x, bf.min.x) || apart(bn.max.x, an.min.x, bf.max.x, af.min.x) ||
             apart(an.max.y, bn.min.y, af.max.y, bf.min.y) || apart(bn.max.y, an.min.y, bf.max.y, af.min.y));
}

}  // namespace penumbra
