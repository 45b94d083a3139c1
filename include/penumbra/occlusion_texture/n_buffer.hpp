// N-Buffers: the mean over every block of 2^l × 2^l texels, at every position.
// Source: X. Décoret, "N-Buffers for efficient depth map query", 2005; E. Eisemann & X. Décoret, "Plausible image based
// soft shadows using occlusion textures", 2006, section 4.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/detail/quarter.hpp>
#include <penumbra/detail/texel.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace penumbra {

namespace detail {

/// build_n_buffer_level() for small integers in rows that follow each other in memory. Many rows are written as one: a
/// mask makes zeros of what belongs to the next row. The last row, which nothing follows, is read from a copy.
template <int Parity, class Value>
void build_n_buffer_level_in_lanes(const Value* in, Value* out, std::ptrdiff_t values, int height, std::ptrdiff_t reach,
                                   int rows_below) {
    std::vector<Value> masks(static_cast<std::size_t>(values + mask_chunk + 64), std::numeric_limits<Value>::max());
    // the mask's cache lines begin where those of the output do
    const auto phase = reinterpret_cast<std::uintptr_t>(out) - reinterpret_cast<std::uintptr_t>(masks.data());
    Value* const mask = masks.data() + phase % 64 / sizeof(Value);
    for (std::ptrdiff_t x = values - reach; x < values + mask_chunk; x += values)
        std::fill_n(mask + x, std::min(reach, values + mask_chunk - x), Value(0));
    std::vector<Value> last_row(static_cast<std::size_t>(2 * values), Value(0));
    std::copy_n(in + (height - 1) * values, values, last_row.begin());

    // rows with a row below, the last of which reads from the copy; then the others, the same
    const int rows_with_below = height - rows_below;
    if (rows_with_below > 1)
        write_masked_quarters<Parity, true>(in, in + rows_below * values, reach, mask, values, out,
                                            (rows_with_below - 1) * values);
    int y = std::max(rows_with_below - 1, 0);
    if (rows_with_below > 0) {
        write_masked_quarters<Parity, true>(in + y * values, last_row.data(), reach, mask, values, out + y * values,
                                            values);
        ++y;
    }
    if (y < height - 1)
        write_masked_quarters<Parity, false>(in + y * values, in, reach, mask, values, out + y * values,
                                             (height - 1 - y) * values);
    write_masked_quarters<Parity, false>(last_row.data(), in, reach, mask, values, out + (height - 1) * values, values);
}

}  // namespace detail

/// Writes level + 1 of an N-Buffer from `level`: four lookups, 2^level texels apart. Values outside the image are 0.
/// Sizes and strides in values, `channels` of them a texel; `in` and `out` do not overlap.
template <class Value>
void build_n_buffer_level(const Value* in, Value* out, int width, int height, std::ptrdiff_t stride, int channels,
                          int level) {
    const std::ptrdiff_t values = static_cast<std::ptrdiff_t>(width) * channels;
    const std::ptrdiff_t step = std::ptrdiff_t(1) << std::min(level, 28);  // texels
    const std::ptrdiff_t reach = std::min(values, step * channels);
    const int rows_below = static_cast<int>(std::min<std::ptrdiff_t>(step, height));
    if constexpr (detail::fits_lanes<Value>) {
        if (stride == values && values >= 64 && height > 0) {
            if (level % 2 == 0)
                detail::build_n_buffer_level_in_lanes<0>(in, out, values, height, reach, rows_below);
            else
                detail::build_n_buffer_level_in_lanes<1>(in, out, values, height, reach, rows_below);
            return;
        }
    }
    const std::vector<Value> zeros(static_cast<std::size_t>(values), Value(0));
    for (int y = 0; y < height; ++y) {
        const std::ptrdiff_t inside = values - reach;
        const Value *first = in + y * stride,
                    *second = y + rows_below < height ? first + rows_below * stride : zeros.data();
        Value* result = out + y * stride;
        detail::write_quarters(first, first + reach, second, second + reach, result, inside, level);
        detail::write_quarters(first + inside, zeros.data(), second + inside, zeros.data(), result + inside, reach,
                               level);
    }
}

/// The N-Buffer of an image. Texel: float, double, std::uint8_t, std::uint16_t, or four of them (RGBA).
template <class Texel>
class NBuffer {
    using Traits = detail::TexelTraits<Texel>;
    template <class T>
    using Mean = detail::TexelMean<Texel, T>;

  public:
    /// How far beyond a box its mean reads at most, in the size of the box, or in texels if that is below one.
    static constexpr float reach = 2.0F;
    static constexpr int all_levels = -1;

    NBuffer() = default;

    /// Builds `levels` levels, the image itself among them; all_levels goes up to the block that covers the image.
    /// Fewer serve when no box is larger. Reports an empty image and levels of 0.
    explicit NBuffer(const Image<Texel>& image, int levels = all_levels) { rebuild(image, levels); }

    /// The same for another image, in the memory at hand.
    void rebuild(const Image<Texel>& image, int levels = all_levels) {
        if (!detail::require(!image.empty(), [] { return std::string("image is empty"); }) ||
            !detail::require(levels == all_levels || levels >= 1,
                             [&] { return "levels = " + std::to_string(levels) + " is not positive"; }))
            return;
        const int all = detail::ceil_log2(std::max(image.width(), image.height())) + 1;
        levels_.resize(static_cast<std::size_t>(levels == all_levels ? all : std::min(levels, all)));
        levels_[0] = image;
        using Value = typename Traits::Value;
        const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(image.width()) * Traits::channels;
        for (std::size_t l = 1; l < levels_.size(); ++l) {
            if (levels_[l].width() != image.width() || levels_[l].height() != image.height())
                levels_[l] = Image<Texel>(image.width(), image.height());
            build_n_buffer_level(reinterpret_cast<const Value*>(levels_[l - 1].data()),
                                 reinterpret_cast<Value*>(levels_[l].data()), image.width(), image.height(), stride,
                                 Traits::channels, static_cast<int>(l) - 1);
        }
    }

    int levels() const { return static_cast<int>(levels_.size()); }
    /// Texel (x, y) of level l is the mean over [x, x + 2^l) × [y, y + 2^l), texels outside the image counting as 0.
    /// Unsigned integers are rounded to nearest at each level: off by at most l / 2, by 0.3 √l typically.
    const Image<Texel>& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }
    std::size_t bytes() const { return levels_.empty() ? 0 : levels_.size() * levels_[0].size() * sizeof(Texel); }

    /// Mean over a box in texel units, in the texel's unit; zeros outside the image. Blocks of the two levels next to
    /// the box's size, both at its centre, are interpolated; elongated boxes are read as up to 8 square tiles. Exact
    /// for squares of 2^l texels inside the image. Boxes thinner than 1/16 texel are widened to that; NaN reads as 0.
    /// Error: .01 RMS across an edge, .02 in noise of single texels, of the largest value.
    Mean<float> mean(const Rect2<float>& box_tx) const { return mean_of(box_tx); }
    Mean<double> mean(const Rect2<double>& box_tx) const { return mean_of(box_tx); }

    /// The same for the cells of a grid: result[row · cells + column][i].
    template <class T>
    void mean(const detail::BoxGrid<T>& grid_tx, std::array<Mean<T>, detail::Boxes<T>::capacity>* result) const {
        for (int row = 0; row < grid_tx.cells; ++row)
            for (int column = 0; column < grid_tx.cells; ++column, ++result)
                for (std::size_t i = 0; i < grid_tx.count; ++i) (*result)[i] = mean_of(grid_tx.box(column, row, i));
    }

  private:
    template <class T>
    Mean<T> mean_of(const Rect2<T>& box_tx) const {
        if (levels_.empty()) return Mean<T>(T(0));
        const Rect2<T> box = detail::widen(box_tx);
        const Vec2<T> image(static_cast<T>(levels_[0].width()), static_cast<T>(levels_[0].height()));
        const Rect2<T> inside = intersect(box, {Vec2<T>(T(0), T(0)), image});
        const T share = area(inside);
        if (!(share > T(0))) return Mean<T>(T(0));
        const detail::Tiles<T> tiles = detail::square_tiles(inside);
        const T size = std::max(tiles.size, T(1));
        const int low = std::min(floor_log2(size), levels() - 1), high = std::min(low + 1, levels() - 1);
        // 1 / size runs linearly between the levels: that keeps the slope across an edge
        const T weight = saturate(T(2) - T(2) * exp2_int<T>(low) / size);
        Mean<T> sum(T(0));
        for (int i = 0; i < tiles.count; ++i) {
            const Vec2<T> center = tiles.first + tiles.step * static_cast<T>(i);
            sum += block(low, center) * (T(1) - weight) + block(high, center) * weight;
        }
        return sum * (share / (extent(box).x * extent(box).y * static_cast<T>(tiles.count)));
    }

    /// The block of a level around a centre, moved into the image; a block larger than the image is the whole image.
    template <class T>
    Mean<T> block(int l, const Vec2<T>& center) const {
        const Image<Texel>& level = levels_[static_cast<std::size_t>(l)];
        const T size = exp2_int<T>(l);
        const Axis<T> x(center.x - size * T(0.5), size, level.width()),
            y(center.y - size * T(0.5), size, level.height());
        const Texel *top = level.row(y.low), *bottom = level.row(y.high);
        const Mean<T> a = Mean<T>(top[x.low]) * (T(1) - x.fraction) + Mean<T>(top[x.high]) * x.fraction;
        const Mean<T> b = Mean<T>(bottom[x.low]) * (T(1) - x.fraction) + Mean<T>(bottom[x.high]) * x.fraction;
        return (a * (T(1) - y.fraction) + b * y.fraction) * (x.scale * y.scale);
    }

    template <class T>
    struct Axis {
        int low, high;
        T fraction, scale;  // scale: from the mean over the block to the mean over the part in the image
        Axis(T start, T size, int count) {
            const T room = static_cast<T>(count) - size;
            const T at = penumbra::clamp(start, T(0), std::max(room, T(0)));
            low = static_cast<int>(at);
            high = low + 1 < count ? low + 1 : low;
            fraction = at - static_cast<T>(low);
            scale = room < T(0) ? size / static_cast<T>(count) : T(1);
        }
    };

    std::vector<Image<Texel>> levels_;
};

}  // namespace penumbra
