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
    static constexpr int most_swept = 32;   ///< texels that a side may sweep
    static constexpr int most_read = 1024;  ///< texels of which depths are read one by one

    KernelSweep() {}

    /// Light space; the box lies behind the plane. Its depth and by how much it grows with a point's, ends first.
    KernelSweep(const SliceCamera<T>& camera, const Vec2<T>& depths, const ValueRange<T>& depth_slope,
                const Box3<T>& box_ls, const Vec2<T>& half_size, int cells)
        : cells_(cells), box_(box_ls), half_size_(half_size) {
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
            Axis& axis = axes_[static_cast<std::size_t>(k)];
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
                Side& side = axis.sides[static_cast<std::size_t>(j)];
                side.first = texel(place.low + camera.origin_tx[k] - slack);
                side.end = texel(place.high + camera.origin_tx[k] + slack) + 1;
                is_known_ = is_known_ && std::min(side.end, sizes[k]) - std::max(side.first, 0) <= most_swept;
            }
        }
        const auto extent = [&](const Axis& axis) {
            return static_cast<T>(axis.sides[static_cast<std::size_t>(cells)].end - axis.sides[0].first);
        };
        is_far_ = is_far_ || extent(axes_[0]) * extent(axes_[1]) > most_summed;
    }

    /// Whether a side sweeps so few texels, and kernels are so large, that trends are known.
    bool is_known() const { return is_known_; }

    /// What kernels may read of a mask: nothing, texels that are all set, or anything.
    enum class Held { nothing, all, some };
    Held held(const SummedArea<std::uint32_t>& mask) const {
        const Region r = region(mask);
        if (r.first[0] >= r.end[0] || r.first[1] >= r.end[1]) return Held::nothing;
        const std::uint32_t sum = mask.sum(r.first[0], r.first[1], r.end[0], r.end[1]);
        const auto width = static_cast<std::uint32_t>(r.end[0] - r.first[0]),
                   height = static_cast<std::uint32_t>(r.end[1] - r.first[1]);
        return sum == 0 ? Held::nothing : !r.is_cut && sum == width * height * 255U ? Held::all : Held::some;
    }

    /// Relative depths, 0 to 1, of all that any kernel may read of a slice; all there are where that is much. Low is 2,
    /// high −1 where it holds nothing.
    ValueRange<T> held_depths(const SummedArea<std::uint32_t>& mask, const SummedArea<std::uint32_t>& depths) const {
        const auto [first, end, is_cut] = region(mask);
        const int width = end[0] - first[0], height = end[1] - first[1];
        if (width <= 0 || height <= 0) return {T(2), T(-1)};
        if (width > most_read || height > most_read || width * height > most_read) return {T(0), T(1)};
        int low = 2 * 255, high = -255;
        const int stride = mask.width() + 1;
        for (int y = first[1]; y < end[1]; ++y) {
            const std::uint32_t *above = mask.data() + y * stride, *below = above + stride;
            const std::uint32_t *depth_above = depths.data() + y * stride, *depth_below = depth_above + stride;
            for (int x = first[0]; x < end[0]; ++x) {
                const auto set = static_cast<int>((below[x + 1] - below[x]) - (above[x + 1] - above[x]));
                const auto depth =
                    static_cast<int>((depth_below[x + 1] - depth_below[x]) - (depth_above[x + 1] - depth_above[x]));
                low = std::min(low, depth + 2 * (255 - set)), high = std::max(high, depth - (255 - set));
            }
        }
        return {static_cast<T>(low) * per_texel, static_cast<T>(high) * per_texel};
    }

    /// Whether a side sweeps more than a kernel's size: then little is known of what kernels see.
    bool is_wild() const {
        const auto sweeps_more = [&](const Axis& axis) {
            const Side& a = axis.sides[0];
            return static_cast<T>(a.end - a.first - 2) > axis.width.low * static_cast<T>(cells_);
        };
        return sweeps_more(axes_[0]) || sweeps_more(axes_[1]);
    }
    /// Whether kernels may lie anywhere.
    bool is_far() const { return is_far_; }

    /// Bounds of a cell's mean, 0 to 1.
    ValueRange<T> mean(const SummedArea<std::uint32_t>& mask, std::size_t cell) const {
        const auto n = static_cast<std::size_t>(cells_), c = cell % n, r = cell / n;
        const Side x0 = axes_[0].sides[c], x1 = axes_[0].sides[c + 1], y0 = axes_[1].sides[r],
                   y1 = axes_[1].sides[r + 1];
        const std::int64_t sure_held = mask.sum(x0.end, y0.end, x1.first, y1.first),
                           may_held = mask.sum(x0.first, y0.first, x1.end, y1.end);
        const auto area = [](int width, int height) {
            return std::int64_t(std::max(width, 0)) * std::int64_t(std::max(height, 0));
        };
        return share(axes_[0].width * axes_[1].width, area(x1.first - x0.end, y1.first - y0.end), sure_held, sure_held,
                     area(x1.end - x0.first, y1.end - y0.first), may_held, may_held);
    }

    /// What the kernel's cells see of a mask, row by row: 0 to 1.
    template <class Add>
    void visit(const SummedArea<std::uint32_t>& mask, const Add& add) const {
        std::array<Lines, most_sides> across_x, across_y;
        for (int k = 0; k <= cells_; ++k) find_columns(mask, k, across_x[static_cast<std::size_t>(k)]);
        for (int k = 0; k <= cells_; ++k) find_rows(mask, k, across_y[static_cast<std::size_t>(k)]);
        for (int row = 0; row < cells_; ++row) {
            for (int column = 0; column < cells_; ++column) {
                const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
                add(static_cast<std::size_t>(row * cells_ + column),
                    trend(mask, column, row, across_x[c][r], across_x[c + 1][r], across_y[r][c], across_y[r + 1][c]));
            }
        }
    }

  private:
    static constexpr std::size_t most_sides = BoxGrid<T>::most_cells + 1;
    static constexpr T most_summed = T(16e6);           ///< texels whose sum is exact
    static constexpr T most_rounding = T(1.0 / 512.0);  ///< texels by which rounding moves a side, and more
    static constexpr T per_texel = T(1.0 / 255.0);

    /// The texels [first, end) that a side is in; beyond the image they hold nothing.
    struct Side {
        int first, end;
    };
    struct Axis {
        std::array<Side, most_sides> sides;
        ValueRange<T> width;  ///< of a cell, texels
    };
    /// Of a side's parts, one to each cell beside it.
    using Lines = std::array<ValueRange<T>, BoxGrid<T>::most_cells>;

    struct Region {
        int first[2], end[2];
        bool is_cut;  ///< by the image
    };
    /// Of a mask, what kernels may read; thin ones are widened.
    Region region(const SummedArea<std::uint32_t>& mask) const {
        const auto n = static_cast<std::size_t>(cells_);
        const int sizes[] = {mask.width(), mask.height()};
        Region result{{0, 0}, {0, 0}, false};
        for (std::size_t k = 0; k < 2; ++k) {
            const int more = axes_[k].width.low > smallest_box<T>
                                 ? 0
                                 : static_cast<int>(smallest_box<T> * static_cast<T>(cells_)) + 1;
            const int first = axes_[k].sides[0].first - more, end = axes_[k].sides[n].end + more;
            result.first[k] = std::max(first, 0), result.end[k] = std::min(end, sizes[k]);
            result.is_cut = result.is_cut || first < 0 || end > sizes[k];
        }
        return result;
    }
    static int texel(T at) {
        constexpr T far = T(1 << 20);
        return static_cast<int>(std::floor(clamp(at, -far, far)));
    }
    /// What a mean over a length, or an area, is at least and at most: texels that it surely covers, in integers, and
    /// all that it may cover.
    static ValueRange<T> share(const ValueRange<T>& size, std::int64_t sure, std::int64_t sure_least,
                               std::int64_t sure_most, std::int64_t may, std::int64_t may_least,
                               std::int64_t may_most) {
        const auto over = [](std::int64_t held, T of) { return static_cast<T>(held) * per_texel / of; };
        const std::int64_t free_least = 255 * sure - sure_most, free_most = 255 * may - may_least;
        const T low = std::max(over(sure_least, size.high), T(1) - over(free_most, size.low));
        const T high = std::min(over(may_most, size.low), T(1) - over(free_least, size.high));
        const T least = clamp(low, T(0), T(1));
        return {least, clamp(high, least, T(1))};
    }

    struct Extremes {
        int sure_least = 0x7fffffff, sure_most = 0, may_least = 0x7fffffff, may_most = 0;

        void add(std::uint32_t sure, std::uint32_t may) {
            const int a = static_cast<int>(sure), b = static_cast<int>(may);
            sure_least = std::min(sure_least, a), sure_most = std::max(sure_most, a);
            may_least = std::min(may_least, b), may_most = std::max(may_most, b);
        }
    };
    static ValueRange<T> share(const Axis& along, int cell, const Extremes& held) {
        const Side &a = along.sides[static_cast<std::size_t>(cell)],
                   &b = along.sides[static_cast<std::size_t>(cell) + 1];
        return share(along.width, std::max(b.first - a.end, 0), held.sure_least, held.sure_most, b.end - a.first,
                     held.may_least, held.may_most);
    }

    /// What lines along side k across x hold.
    void find_columns(const SummedArea<std::uint32_t>& mask, int k, Lines& lines) const {
        const Side side = axes_[0].sides[static_cast<std::size_t>(k)];
        const int first = std::max(side.first, 0), end = std::min(side.end, mask.width());
        const bool beyond = side.first < 0 || side.end > mask.width();
        for (int cell = 0; cell < cells_; ++cell) {
            const Side a = axes_[1].sides[static_cast<std::size_t>(cell)],
                       b = axes_[1].sides[static_cast<std::size_t>(cell) + 1];
            const auto row = [&](int y) { return mask.data() + clamp(y, 0, mask.height()) * (mask.width() + 1); };
            const std::uint32_t *may_top = row(a.first), *may_bottom = row(b.end), *top = row(a.end),
                                *bottom = row(std::max(b.first, a.end));
            Extremes held;
            if (beyond) held.add(0, 0);
            for (int x = first; x < end; ++x)
                held.add((bottom[x + 1] - bottom[x]) - (top[x + 1] - top[x]),
                         (may_bottom[x + 1] - may_bottom[x]) - (may_top[x + 1] - may_top[x]));
            lines[static_cast<std::size_t>(cell)] = share(axes_[1], cell, held);
        }
    }
    /// What lines along side k across y hold.
    void find_rows(const SummedArea<std::uint32_t>& mask, int k, Lines& lines) const {
        const Side side = axes_[1].sides[static_cast<std::size_t>(k)];
        const int first = std::max(side.first, 0), end = std::min(side.end, mask.height());
        const bool beyond = side.first < 0 || side.end > mask.height();
        const auto sides = static_cast<std::size_t>(cells_) + 1;
        std::array<int, 2 * most_sides> at;  // where each side begins and ends
        std::array<std::uint32_t, 2 * most_sides> above{}, sums{};
        for (std::size_t j = 0; j < sides; ++j) {
            at[2 * j] = clamp(axes_[0].sides[j].first, 0, mask.width());
            at[2 * j + 1] = clamp(axes_[0].sides[j].end, 0, mask.width());
        }
        std::array<Extremes, BoxGrid<T>::most_cells> held;
        for (int y = first; y <= end && first < end; ++y) {
            const std::uint32_t* row = mask.data() + y * (mask.width() + 1);
            for (std::size_t j = 0; j < 2 * sides; ++j) {
                const std::uint32_t sum = row[at[j]];
                sums[j] = sum - above[j], above[j] = sum;
            }
            for (std::size_t j = 0; j + 1 < sides && y > first; ++j) {
                const bool is_sure = at[2 * j + 2] > at[2 * j + 1];
                held[j].add(is_sure ? sums[2 * j + 2] - sums[2 * j + 1] : 0U, sums[2 * j + 3] - sums[2 * j]);
            }
        }
        for (int cell = 0; cell < cells_; ++cell) {
            Extremes& of_cell = held[static_cast<std::size_t>(cell)];
            if (beyond) of_cell.add(0, 0);
            lines[static_cast<std::size_t>(cell)] = share(axes_[0], cell, of_cell);
        }
    }

    Trend<T> trend(const SummedArea<std::uint32_t>& mask, int column, int row, const ValueRange<T>& left,
                   const ValueRange<T>& right, const ValueRange<T>& top, const ValueRange<T>& bottom) const {
        Trend<T> result;
        result.value = mean(mask, static_cast<std::size_t>(row * cells_ + column));
        result.gradient[2] = deep(0, column, left, right, result.value) + deep(1, row, top, bottom, result.value);
        result.gradient[0] = across(0, left, right) * s_;
        result.gradient[1] = across(1, top, bottom) * s_;
        return result;
    }
    /// n (b − a) / (2 h r)
    ValueRange<T> across(int axis, const ValueRange<T>& a, const ValueRange<T>& b) const {
        const T per = static_cast<T>(cells_) / (T(2) * half_size_[axis]);
        return (b - a) * ValueRange<T>{per / r_.high, per / r_.low};
    }
    ValueRange<T> deep(int axis, int cell, const ValueRange<T>& a, const ValueRange<T>& b,
                       const ValueRange<T>& value) const {
        const T middle = half_size_[axis] * (static_cast<T>(2 * cell + 1) / static_cast<T>(cells_) - T(1));
        return across(axis, a, b) *
                   (shift_ * ValueRange<T>{box_.min[axis], box_.max[axis]} - growth_ * ValueRange<T>{middle, middle}) +
               (value - (a + b) * T(0.5)) * growth_ * ValueRange<T>{T(1) / r_.high, T(1) / r_.low};
    }

    int cells_;
    Box3<T> box_;
    Vec2<T> half_size_;
    ValueRange<T> s_, r_, shift_, growth_;
    std::array<Axis, 2> axes_;
    bool is_known_ = true, is_far_ = false;
};

}  // namespace penumbra::detail
