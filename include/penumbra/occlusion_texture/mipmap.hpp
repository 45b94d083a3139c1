// Mip-maps as a box filter: the least memory, and the largest error.
// Source: L. Williams, "Pyramidal parametrics", 1983.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/detail/texel.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// The mip-map of an image, any size: texel (x, y) of level l is the mean over the 2^l × 2^l texels from
/// (2^l x, 2^l y), texels outside the image counting as 0. Texel: as for NBuffer.
template <class Texel>
class MipMap {
    using Traits = detail::TexelTraits<Texel>;
    template <class T>
    using Mean = detail::TexelMean<Texel, T>;

  public:
    /// How far beyond a box its mean reads at most, in the size of the box, or in texels if that is below one.
    static constexpr float reach = 2.0F;
    MipMap() = default;

    /// Builds all levels, down to one texel. Reports an empty image.
    explicit MipMap(const Image<Texel>& image) { rebuild(image); }

    /// The same for another image, in the memory at hand.
    void rebuild(const Image<Texel>& image) {
        if (!detail::require(!image.empty(), [] { return std::string("image is empty"); })) return;
        levels_.resize(static_cast<std::size_t>(detail::ceil_log2(std::max(image.width(), image.height()))) + 1);
        levels_[0] = image;
        for (std::size_t l = 1; l < levels_.size(); ++l) reduce(levels_[l - 1], levels_[l], static_cast<int>(l) - 1);
    }

    int levels() const { return static_cast<int>(levels_.size()); }
    /// Level l: ⌈width / 2^l⌉ × ⌈height / 2^l⌉ texels. Unsigned integers are rounded to nearest at each level.
    const Image<Texel>& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }
    std::size_t bytes() const {
        std::size_t texels = 0;
        for (const Image<Texel>& level : levels_) texels += level.size();
        return texels * sizeof(Texel);
    }

    /// Mean over a box in texel units, in the texel's unit; zeros outside the image. Trilinear, between the levels next
    /// to 2^-0.8 times the box's size: a bilinear tap of a level is already wider than its texels. Elongated boxes are
    /// read as up to 8 square tiles. Boxes thinner than 1/16 texel are widened to that; NaN reads as 0.
    /// Error: .02 RMS across an edge, .055 in noise of single texels, of the largest value.
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
    static void reduce(const Image<Texel>& in, Image<Texel>& out, int level) {
        const int width = (in.width() + 1) / 2, height = (in.height() + 1) / 2;
        if (out.width() != width || out.height() != height) out = Image<Texel>(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) out(x, y) = average(in, 2 * x, 2 * y, level);
    }

    static Texel average(const Image<Texel>& in, int x, int y, int level) {
        const bool right = x + 1 < in.width(), below = y + 1 < in.height();
        const Texel a = in(x, y), b = right ? in(x + 1, y) : Texel(0), c = below ? in(x, y + 1) : Texel(0);
        const Texel d = right && below ? in(x + 1, y + 1) : Texel(0);
        if constexpr (Traits::channels == 1) {
            return detail::quarter(a, b, c, d, level);
        } else {
            Texel result(0);
            for (int k = 0; k < Traits::channels; ++k) result[k] = detail::quarter(a[k], b[k], c[k], d[k], level);
            return result;
        }
    }

    template <class T>
    Mean<T> mean_of(const Rect2<T>& box_tx) const {
        if (levels_.empty()) return Mean<T>(T(0));
        const detail::Tiles<T> tiles = detail::square_tiles(detail::widen(box_tx));
        constexpr T narrowing = T(0.574349177498517);  // 2^-0.8
        const T size = clamp(tiles.size * narrowing, T(1), exp2_int<T>(levels() - 1));
        const int low = floor_log2(size), high = std::min(low + 1, levels() - 1);
        const T weight = size / exp2_int<T>(low) - T(1);
        Mean<T> sum(T(0));
        for (int i = 0; i < tiles.count; ++i) {
            const Vec2<T> center = tiles.first + tiles.step * static_cast<T>(i);
            sum += tap(low, center) * (T(1) - weight) + tap(high, center) * weight;
        }
        return sum / static_cast<T>(tiles.count);
    }

    /// Bilinear tap of a level at a position of level 0, zeros outside.
    template <class T>
    Mean<T> tap(int l, const Vec2<T>& center) const {
        const Image<Texel>& level = levels_[static_cast<std::size_t>(l)];
        const T scale = T(1) / exp2_int<T>(l);
        const T x = clamp(center.x * scale - T(0.5), T(-2), static_cast<T>(level.width()) + T(1));
        const T y = clamp(center.y * scale - T(0.5), T(-2), static_cast<T>(level.height()) + T(1));
        const int x0 = static_cast<int>(x + T(2)) - 2, y0 = static_cast<int>(y + T(2)) - 2;
        const T fx = x - static_cast<T>(x0), fy = y - static_cast<T>(y0);
        const auto at = [&](int i, int j) {
            const bool inside = i >= 0 && j >= 0 && i < level.width() && j < level.height();
            return inside ? Mean<T>(level(i, j)) : Mean<T>(T(0));
        };
        const Mean<T> top = at(x0, y0) * (T(1) - fx) + at(x0 + 1, y0) * fx;
        const Mean<T> bottom = at(x0, y0 + 1) * (T(1) - fx) + at(x0 + 1, y0 + 1) * fx;
        return top * (T(1) - fy) + bottom * fy;
    }

    std::vector<Image<Texel>> levels_;
};

}  // namespace penumbra
