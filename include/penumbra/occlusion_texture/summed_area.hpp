// Summed-area tables: the exact mean over any box, at fractional positions too, in constant time.
// Source: F. Crow, "Summed-area tables for texture mapping", 1984. Float tables lose their digits to the differences of
// large sums; here sums are integers and are differenced before anything is rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/detail/prefix_sum.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// Writes the table of a width × height image: table[y · table_stride + x], 0 ≤ x ≤ width, 0 ≤ y ≤ height, is the sum
/// of the texels [0, x) × [0, y). Strides in elements; table_stride ≥ width + 1. Integer sums may wrap around.
/// O(texels).
template <class U, class Sum>
void build_summed_area(const U* image, int width, int height, std::ptrdiff_t image_stride, Sum* table,
                       std::ptrdiff_t table_stride) {
    for (int x = 0; x <= width; ++x) table[x] = Sum(0);
    for (int y = 1; y <= height; ++y) table[y * table_stride] = Sum(0);
    int done = 0;
    if constexpr (detail::sums_in_pairs<U, Sum>)
        done = detail::build_summed_strips(image, width, height, image_stride, table, table_stride);
    for (int y = 0; y < height; ++y) {
        const U* in = image + y * image_stride;
        const Sum* above = table + y * table_stride;
        Sum* out = table + (y + 1) * table_stride;
        Sum row = static_cast<Sum>(out[done] - above[done]);
        for (int x = done; x < width; ++x) {
            row = static_cast<Sum>(row + static_cast<Sum>(in[x]));
            out[x + 1] = static_cast<Sum>(above[x + 1] + row);
        }
    }
}

/// Prefix sums of an image. Sum: std::uint32_t for 8-bit texels (exact up to 4096² texels, and beyond for boxes whose
/// own sum fits), std::uint64_t for wider ones; float and double take any texel, with their rounding.
template <class Sum>
class SummedArea {
  public:
    /// How far beyond a box its mean reads, as for the other filters.
    static constexpr float reach = 0.0F;

    SummedArea() = default;

    /// Reports an image that is empty or has over 2^31 − 1 sums.
    template <class U>
    explicit SummedArea(const Image<U>& image) {
        rebuild(image);
    }

    /// The same for another image, in the memory at hand.
    template <class U>
    void rebuild(const Image<U>& image) {
        const auto sums =
            (static_cast<std::size_t>(image.width()) + 1) * (static_cast<std::size_t>(image.height()) + 1);
        if (!detail::require(!image.empty(), [] { return std::string("image is empty"); }) ||
            !detail::require(sums <= most_sums, [&] {
                return "image of " + std::to_string(image.width()) + " × " + std::to_string(image.height()) +
                       " texels has over 2^31 - 1 sums";
            }))
            return;
        width_ = image.width();
        height_ = image.height();
        table_.resize(sums);
        build_summed_area(image.data(), width_, height_, width_, table_.data(), stride());
    }

    int width() const { return width_; }
    int height() const { return height_; }
    /// (width + 1) × (height + 1) sums, row 0 first, for upload.
    const Sum* data() const { return table_.data(); }
    std::size_t bytes() const { return table_.size() * sizeof(Sum); }

    /// Sum of the texels [x0, x1) × [y0, y1), cut to the image; 0 if x1 ≤ x0 or y1 ≤ y0. Exact for unsigned integers
    /// while it fits Sum.
    Sum sum(int x0, int y0, int x1, int y1) const {
        x0 = penumbra::clamp(x0, 0, width_), x1 = penumbra::clamp(x1, 0, width_);
        y0 = penumbra::clamp(y0, 0, height_), y1 = penumbra::clamp(y1, 0, height_);
        if (x1 <= x0 || y1 <= y0) return Sum(0);
        const Sum *low = row(y0), *high = row(y1);
        return static_cast<Sum>((high[x1] - low[x1]) - (high[x0] - low[x0]));
    }

    /// Mean over a box in texel units, in the texel's unit. Texels count by the area that lies in the box; outside the
    /// image there are zeros. Boxes thinner than 1/16 texel are widened to that; NaN reads as 0.
    /// Error for integer sums: 1e-6 of the largest texel in float, 1e-14 in double, at every image size.
    float mean(const Rect2<float>& box_tx) const { return mean_of_one(box_tx); }
    double mean(const Rect2<double>& box_tx) const { return mean_of_one(box_tx); }

    /// The same for the cells of a grid: result[row · cells + column][i]. Cells share the reads of their sides, and all
    /// but the reads vectorises.
    template <class T>
    void mean(const detail::BoxGrid<T>& grid_tx, std::array<T, detail::Boxes<T>::capacity>* result) const {
        const auto cells = static_cast<std::size_t>(grid_tx.cells);
        const std::size_t n = grid_tx.count;
        if (table_.empty()) {
            for (std::size_t cell = 0; cell < cells * cells; ++cell) result[cell].fill(T(0));
            return;
        }
        std::array<Side<T>, detail::BoxGrid<T>::most_cells + 1> x;
        for (std::size_t k = 0; k <= cells; ++k) x[k].set(grid_tx.x[k], n, width_);
        std::array<Corners<T>, 2> lines;  // of corners, above and below a row of cells
        for (std::size_t row = 0; row <= cells; ++row) {
            const Corners<T>& above = lines[(row + 1) % 2];
            Corners<T>& below = lines[row % 2];
            below.y.set(grid_tx.y[row], n, height_);
            for (std::size_t k = 0; k <= cells; ++k) read(x[k], below.y, n, below.at[k]);
            if (row == 0) continue;
            for (std::size_t k = 0; k < cells; ++k, ++result) {
                combine(above.at[k], above.at[k + 1], below.at[k], below.at[k + 1], above.y, below.y, x[k], x[k + 1], n,
                        *result);
                for (std::size_t i = 0; i < n; ++i)
                    (*result)[i] /=
                        (grid_tx.x[k + 1][i] - grid_tx.x[k][i]) * (grid_tx.y[row][i] - grid_tx.y[row - 1][i]);
            }
        }
    }

  private:
    static constexpr std::size_t most_sums = 0x7fffffff;  // so that indices are int, which halves the cost of reads
    static constexpr std::size_t block = detail::Boxes<float>::capacity;

    std::ptrdiff_t stride() const { return width_ + 1; }
    const Sum* row(int y) const { return table_.data() + y * stride(); }

    /// A side of each box: the whole texels before it, and the fraction beyond them, in [0, 1]. The texel after exists.
    template <class T>
    struct Side {
        std::array<int, block> whole;
        std::array<T, block> fraction;

        void set(const std::array<T, block>& at, std::size_t n, int size) {
            for (std::size_t i = 0; i < n; ++i) {
                const T inside = penumbra::clamp(at[i], T(0), static_cast<T>(size));
                const int floor = static_cast<int>(inside);
                whole[i] = floor < size ? floor : size - 1;
                fraction[i] = inside - static_cast<T>(whole[i]);
            }
        }
    };

    /// A corner of each box: the sum before its whole texels, of the column below that up to them, of the row beside
    /// it, and its texel.
    template <class T>
    struct Corner {
        std::array<Sum, block> sum, column, row;
        std::array<T, block> texel;
    };
    template <class T>
    struct Corners {
        std::array<Corner<T>, detail::BoxGrid<T>::most_cells + 1> at;
        Side<T> y;
    };

    template <class T>
    void read(const Side<T>& x, const Side<T>& y, std::size_t n, Corner<T>& corner) const {
        const Sum *first = table_.data(), *second = first + stride();
        const int pitch = static_cast<int>(stride());
        for (std::size_t i = 0; i < n; ++i) {
            const int at = y.whole[i] * pitch + x.whole[i];
            corner.sum[i] = first[at];
            corner.column[i] = static_cast<Sum>(first[at + 1] - first[at]);
            corner.row[i] = static_cast<Sum>(second[at] - first[at]);
            corner.texel[i] = difference<T>(static_cast<Sum>(second[at + 1] - second[at]), corner.column[i]);
        }
    }

    /// Of sums, in integers before it is rounded.
    template <class T>
    static T difference(Sum high, Sum low) {
        return static_cast<T>(static_cast<Sum>(high - low));
    }

    /// Sums over boxes from their corners a b / c d: the whole columns and rows, then what the sides cut.
    template <class T>
    static void combine(const Corner<T>& a, const Corner<T>& b, const Corner<T>& c, const Corner<T>& d,
                        const Side<T>& top, const Side<T>& bottom, const Side<T>& left, const Side<T>& right,
                        std::size_t n, std::array<T, block>& result) {
        for (std::size_t i = 0; i < n; ++i) {
            const T l = left.fraction[i], r = right.fraction[i];
            const T whole =
                difference<T>(static_cast<Sum>(d.sum[i] - c.sum[i]), static_cast<Sum>(b.sum[i] - a.sum[i])) +
                r * difference<T>(d.column[i], b.column[i]) - l * difference<T>(c.column[i], a.column[i]);
            const T below = difference<T>(d.row[i], c.row[i]) + r * d.texel[i] - l * c.texel[i];
            const T above = difference<T>(b.row[i], a.row[i]) + r * b.texel[i] - l * a.texel[i];
            const T sum = whole + bottom.fraction[i] * below - top.fraction[i] * above;
            result[i] = sum > T(0) ? sum : T(0);
        }
    }

    template <class T>
    T mean_of_one(const Rect2<T>& box_tx) const {
        detail::Boxes<T> boxes;
        boxes.push(box_tx);
        detail::BoxGrid<T> grid;
        grid.set(boxes, 1);
        std::array<T, block> result;
        mean(grid, &result);
        return result[0];
    }

    std::vector<Sum> table_;
    int width_ = 0, height_ = 0;
};

}  // namespace penumbra
