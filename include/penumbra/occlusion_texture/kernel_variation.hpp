// How a mean over a kernel can change between neighbouring points.
//
// Over a box of points each side of a kernel stays within a few columns or rows of texels. The mean changes by what a
// moving side gains or loses, which is what the texels under it hold: from the least and the most that any of its
// columns holds follow bounds of the mean's gradient. With s = z / p, r = 1 − s, light of half-size h in n × n cells,
// P the point, t the place of a cell's middle in [−1, 1], and a, b what a cell's sides across x hold, per length:
//
//   dm/dPx = s n (b − a) / (2 h r)
//   dm/dp  = Σ over both axes [n (P (q − e s) − h t (q + e r)) (b − a) / (2 h r) + (q + e r) (m − (a + b) / 2) / r]
//
// with q = ds/dp and e = −d ln scale/dp, which is 0 where the plane's depth does not depend on the point's.
// It is differentiable but where a side passes from texel to texel, and continuous there, so that bounds of its
// gradient in a box are bounds of its change. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/kernel_sides.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <penumbra/occlusion_texture/trend.hpp>

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

/// The kernels of all points of a box on a plane that all of them lie behind, in cells × cells parts.
template <class T>
class KernelSweep {
  public:
    using Sides = KernelSides<T>;
    static constexpr int most_swept = 32;  ///< texels that a side may sweep

    KernelSweep() {}

    /// Light space; the box lies behind the plane. Its depth and by how much it grows with a point's, ends first.
    KernelSweep(const SliceCamera<T>& camera, const Vec2<T>& depths, const ValueRange<T>& depth_slope,
                const Box3<T>& box_ls, const Vec2<T>& half_size, int cells)
        : box_(box_ls), half_size_(half_size) {
        sides_.cells = cells;
        const T near = std::max(depths.x, T(0)), far = std::max(depths.y, T(0));
        const T p_near = box_ls.min.z, p_far = box_ls.max.z;
        const T w_near = T(1) + camera.convergence * near, w_far = T(1) + camera.convergence * far;
        s_ = between(near / p_near, far / p_far);
        r_ = between((p_near - near) / p_near, (p_far - far) / p_far);
        // with the depth's slope z', convergence c: q = ds/dp = (z' − s) / p, e = −d ln scale/dp = c z' / w
        const ValueRange<T> q = (depth_slope - s_) * ValueRange<T>{T(1) / p_far, T(1) / p_near};
        const ValueRange<T> e = depth_slope * between(camera.convergence / w_near, camera.convergence / w_far);
        shift_ = q - e * s_, growth_ = q + e * r_;
        const ValueRange<T> scale = between(T(1) / w_near, T(1) / w_far);
        const int sizes[] = {camera.width, camera.height};
        const T n = static_cast<T>(cells);
        is_known_ = r_.low > T(0);
        for (int k = 0; k < 2; ++k) {
            typename Sides::Axis& axis = sides_.axes[static_cast<std::size_t>(k)];
            const T half = half_size[k],
                    slack = most_rounding + T(16) * std::numeric_limits<T>::epsilon() * static_cast<T>(sizes[k]);
            axis.width = r_ * scale * (T(2) * half * camera.scale_tx[k] / n);
            is_known_ = is_known_ && axis.width.low > smallest_box<T>;
            is_far_ = is_far_ || !(axis.width.high * n < T(1 << 19));
            for (int j = 0; j <= cells; ++j) {
                const T at = half * (static_cast<T>(2 * j) / n - T(1)), from = box_ls.min[k] - at,
                        to = box_ls.max[k] - at;
                const ValueRange<T> place = ValueRange<T>{at + from * (from > T(0) ? s_.low : s_.high),
                                                          at + to * (to > T(0) ? s_.high : s_.low)} *
                                            scale * camera.scale_tx[k];
                typename Sides::Side& side = axis.sides[static_cast<std::size_t>(j)];
                side.first = texel(place.low + camera.origin_tx[k] - slack);
                side.end = texel(place.high + camera.origin_tx[k] + slack) + 1;
                is_known_ = is_known_ && std::min(side.end, sizes[k]) - std::max(side.first, 0) <= most_swept;
            }
        }
        const auto extent = [&](const typename Sides::Axis& axis) {
            return static_cast<T>(axis.sides[static_cast<std::size_t>(cells)].end - axis.sides[0].first);
        };
        is_far_ = is_far_ || extent(sides_.axes[0]) * extent(sides_.axes[1]) > most_summed;
    }

    /// Whether a side sweeps so few texels, and kernels are so large, that trends are known.
    bool is_known() const { return is_known_; }

    /// Whether a side sweeps more than a kernel's size: then little is known of what kernels see.
    bool is_wild() const {
        const auto sweeps_more = [&](const typename Sides::Axis& axis) {
            const typename Sides::Side& a = axis.sides[0];
            return static_cast<T>(a.end - a.first - 2) > axis.width.low * static_cast<T>(sides_.cells);
        };
        return sweeps_more(sides_.axes[0]) || sweeps_more(sides_.axes[1]);
    }
    /// Whether kernels may lie anywhere.
    bool is_far() const { return is_far_; }
    /// For what kernels see of a mask, all together or cell by cell.
    const Sides& sides() const { return sides_; }

    /// What the kernel's cells see of a mask, row by row: 0 to 1.
    template <class Add>
    void visit(const SummedArea<std::uint32_t>& mask, const Add& add) const {
        const int n = sides_.cells;
        std::array<typename Sides::Lines, Sides::most_sides> across_x, across_y;
        for (int k = 0; k <= n; ++k) sides_.find_columns(mask, k, across_x[static_cast<std::size_t>(k)]);
        for (int k = 0; k <= n; ++k) sides_.find_rows(mask, k, across_y[static_cast<std::size_t>(k)]);
        for (int row = 0; row < n; ++row) {
            for (int column = 0; column < n; ++column) {
                const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
                add(static_cast<std::size_t>(row * n + column),
                    trend(mask, column, row, across_x[c][r], across_x[c + 1][r], across_y[r][c], across_y[r + 1][c]));
            }
        }
    }

  private:
    static constexpr T most_summed = T(16e6);           ///< texels whose sum is exact
    static constexpr T most_rounding = T(1.0 / 512.0);  ///< texels by which rounding moves a side, and more

    static int texel(T at) {
        constexpr T far = T(1 << 20);
        return static_cast<int>(std::floor(clamp(at, -far, far)));
    }

    Trend<T> trend(const SummedArea<std::uint32_t>& mask, int column, int row, const ValueRange<T>& left,
                   const ValueRange<T>& right, const ValueRange<T>& top, const ValueRange<T>& bottom) const {
        Trend<T> result;
        result.value = sides_.mean(mask, static_cast<std::size_t>(row * sides_.cells + column));
        result.gradient[2] = deep(0, column, left, right, result.value) + deep(1, row, top, bottom, result.value);
        result.gradient[0] = across(0, left, right) * s_;
        result.gradient[1] = across(1, top, bottom) * s_;
        return result;
    }
    /// n (b − a) / (2 h r)
    ValueRange<T> across(int axis, const ValueRange<T>& a, const ValueRange<T>& b) const {
        const T per = static_cast<T>(sides_.cells) / (T(2) * half_size_[axis]);
        return (b - a) * ValueRange<T>{per / r_.high, per / r_.low};
    }
    ValueRange<T> deep(int axis, int cell, const ValueRange<T>& a, const ValueRange<T>& b,
                       const ValueRange<T>& value) const {
        const T middle = half_size_[axis] * (static_cast<T>(2 * cell + 1) / static_cast<T>(sides_.cells) - T(1));
        return across(axis, a, b) *
                   (shift_ * ValueRange<T>{box_.min[axis], box_.max[axis]} - growth_ * ValueRange<T>{middle, middle}) +
               (value - (a + b) * T(0.5)) * growth_ * ValueRange<T>{T(1) / r_.high, T(1) / r_.low};
    }

    Sides sides_;
    Box3<T> box_;
    Vec2<T> half_size_;
    ValueRange<T> s_, r_, shift_, growth_;
    bool is_known_ = true, is_far_ = false;
};

}  // namespace penumbra::detail
