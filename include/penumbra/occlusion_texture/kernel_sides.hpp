// What a mask holds under the sides of kernels, and between them.
//
// Over a box of points each side of a kernel stays within a few columns or rows of texels: kernels surely cover what is
// between those, and may cover what is under them. Sums are integers. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <penumbra/occlusion_texture/trend.hpp>

namespace penumbra::detail {

/// Where the sides of kernels in cells × cells parts may be.
template <class T>
struct KernelSides {
    static constexpr int most_read = 1024;  ///< texels of which depths are read one by one
    static constexpr std::size_t most_sides = BoxGrid<T>::most_cells + 1;

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

    int cells;
    std::array<Axis, 2> axes;

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

    /// Bounds of a cell's mean, 0 to 1.
    ValueRange<T> mean(const SummedArea<std::uint32_t>& mask, std::size_t cell) const {
        const auto n = static_cast<std::size_t>(cells), c = cell % n, r = cell / n;
        const Side x0 = axes[0].sides[c], x1 = axes[0].sides[c + 1], y0 = axes[1].sides[r], y1 = axes[1].sides[r + 1];
        const std::int64_t sure_held = mask.sum(x0.end, y0.end, x1.first, y1.first),
                           may_held = mask.sum(x0.first, y0.first, x1.end, y1.end);
        const auto area = [](int width, int height) {
            return std::int64_t(std::max(width, 0)) * std::int64_t(std::max(height, 0));
        };
        return share(axes[0].width * axes[1].width, area(x1.first - x0.end, y1.first - y0.end), sure_held, sure_held,
                     area(x1.end - x0.first, y1.end - y0.first), may_held, may_held);
    }

    /// What lines along side k across x hold.
    void find_columns(const SummedArea<std::uint32_t>& mask, int k, Lines& lines) const {
        const Side side = axes[0].sides[static_cast<std::size_t>(k)];
        const int first = std::max(side.first, 0), end = std::min(side.end, mask.width());
        const bool beyond = side.first < 0 || side.end > mask.width();
        for (int cell = 0; cell < cells; ++cell) {
            const Side a = axes[1].sides[static_cast<std::size_t>(cell)],
                       b = axes[1].sides[static_cast<std::size_t>(cell) + 1];
            const auto row = [&](int y) { return mask.data() + clamp(y, 0, mask.height()) * (mask.width() + 1); };
            const std::uint32_t *may_top = row(a.first), *may_bottom = row(b.end), *top = row(a.end),
                                *bottom = row(std::max(b.first, a.end));
            Extremes held;
            if (beyond) held.add(0, 0);
            for (int x = first; x < end; ++x)
                held.add((bottom[x + 1] - bottom[x]) - (top[x + 1] - top[x]),
                         (may_bottom[x + 1] - may_bottom[x]) - (may_top[x + 1] - may_top[x]));
            lines[static_cast<std::size_t>(cell)] = share(axes[1], cell, held);
        }
    }
    /// What lines along side k across y hold.
    void find_rows(const SummedArea<std::uint32_t>& mask, int k, Lines& lines) const {
        const Side side = axes[1].sides[static_cast<std::size_t>(k)];
        const int first = std::max(side.first, 0), end = std::min(side.end, mask.height());
        const bool beyond = side.first < 0 || side.end > mask.height();
        const auto sides = static_cast<std::size_t>(cells) + 1;
        std::array<int, 2 * most_sides> at;  // where each side begins and ends
        std::array<std::uint32_t, 2 * most_sides> above{}, sums{};
        for (std::size_t j = 0; j < sides; ++j) {
            at[2 * j] = clamp(axes[0].sides[j].first, 0, mask.width());
            at[2 * j + 1] = clamp(axes[0].sides[j].end, 0, mask.width());
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
        for (int cell = 0; cell < cells; ++cell) {
            Extremes& of_cell = held[static_cast<std::size_t>(cell)];
            if (beyond) of_cell.add(0, 0);
            lines[static_cast<std::size_t>(cell)] = share(axes[0], cell, of_cell);
        }
    }

  private:
    static constexpr T per_texel = T(1.0 / 255.0);

    struct Region {
        int first[2], end[2];
        bool is_cut;  ///< by the image
    };
    /// Of a mask, what kernels may read; thin ones are widened.
    Region region(const SummedArea<std::uint32_t>& mask) const {
        const auto n = static_cast<std::size_t>(cells);
        const int sizes[] = {mask.width(), mask.height()};
        Region result{{0, 0}, {0, 0}, false};
        for (std::size_t k = 0; k < 2; ++k) {
            const int more =
                axes[k].width.low > smallest_box<T> ? 0 : static_cast<int>(smallest_box<T> * static_cast<T>(cells)) + 1;
            const int first = axes[k].sides[0].first - more, end = axes[k].sides[n].end + more;
            result.first[k] = std::max(first, 0), result.end[k] = std::min(end, sizes[k]);
            result.is_cut = result.is_cut || first < 0 || end > sizes[k];
        }
        return result;
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
};

}  // namespace penumbra::detail
