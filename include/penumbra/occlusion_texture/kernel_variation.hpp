// How much a mean over a kernel can change between neighbouring points.
//
// The means of one image over two boxes differ by at most the share of the larger box that both do not have in common,
// whatever the image holds. Source: ours.
#pragma once

#include <algorithm>
#include <cmath>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>

namespace penumbra::detail {

/// One side of a kernel on a plane, −h (1 − s) + P s or h (1 − s) + P s with s = z / p: where it is at most, over
/// points P of [from, to] and shares s of [least, most].
template <class T>
Vec2<T> kernel_range(T half, T from, T to, T least, T most) {
    const T low = from + half, high = to - half;
    return Vec2<T>(low * (low > T(0) ? least : most) - half, high * (high > T(0) ? most : least) + half);
}

/// Texels around the kernels of all points of a box (light space, depths > 0) on all planes between two depths ≥ 0, the
/// second not beyond the box's far side.
template <class T>
Rect2<T> kernel_reach(const SliceCamera<T>& camera, T near, T far, const Box3<T>& box_ls, const Vec2<T>& half_size) {
    const T top = std::max(near, T(0)), bottom = std::max(far, top);
    const T least = top / box_ls.max.z, most = std::min(bottom / box_ls.min.z, T(1));
    const Vec2<T> x = kernel_range(half_size.x, box_ls.min.x, box_ls.max.x, least, most);
    const Vec2<T> y = kernel_range(half_size.y, box_ls.min.y, box_ls.max.y, least, most);
    Rect2<T> texels = empty_rect<T>();
    for (const T depth : {top, bottom}) {
        const Vec2<T> scale = camera.scale_tx * (T(1) / (T(1) + camera.convergence * depth));
        texels = extend(texels, Vec2<T>(x.x, y.x) * scale + camera.origin_tx);
        texels = extend(texels, Vec2<T>(x.y, y.y) * scale + camera.origin_tx);
    }
    return texels;
}

/// By how much the mean over one of cells × cells parts of the kernel on a plane at `depth` changes at most as a point
/// moves by a world unit along each axis, within a box. Sides move by s = z / p for each unit across the light's axis,
/// and by (|P| + h) s / p for each in depth, in which kernels change in size as well.
template <class T>
Vec3<T> kernel_variation(const SliceCamera<T>& camera, T depth, const Box3<T>& box_ls, const Vec2<T>& half_size,
                         T cells) {
    const T most = std::min(depth / box_ls.min.z, T(1)), sinking = most / box_ls.min.z;
    const T w = T(1) + camera.convergence * depth;
    Vec3<T> change(T(0), T(0), T(0));
    for (int k = 0; k < 2; ++k) {
        const T half = half_size[k], out = std::max(std::abs(box_ls.min[k]), std::abs(box_ls.max[k])) + half;
        const T width = std::max(T(2) * half * (T(1) - most), smallest_box<T> * cells * w / camera.scale_tx[k]);
        change[k] = most * cells / width;
        change.z += (out * cells + T(2) * half) * sinking / width;
    }
    return change;
}

}  // namespace penumbra::detail
