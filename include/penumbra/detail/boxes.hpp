// Boxes in texel units, as the prefilters take them: many at a time, as arrays, and cut into square tiles.
#pragma once

#include <array>
#include <cstddef>
#include <penumbra/geometry.hpp>

namespace penumbra::detail {

/// The least width and height of a box, texels: the limit of a box without size is what its middle reads.
template <class T>
inline constexpr T smallest_box = T(0.0625);

/// A side's two ends, at least `least` apart about their middle, and where conversions to int are defined. NaN becomes
/// a far end.
template <class T>
void widen(T& min, T& max, T least) {
    constexpr T big = T(1e9), far = T(65536);  // far beyond any image, where `least` is more than rounding
    const T low = clamp(min, -big, big), high = clamp(max, -big, big);
    const T middle = clamp((low + high) * T(0.5), -far, far), half = least * T(0.5);
    const bool thin = !(high - low >= least);
    min = thin ? middle - half : low;
    max = thin ? middle + half : high;
}

template <class T>
Rect2<T> widen(Rect2<T> box) {
    widen(box.min.x, box.max.x, smallest_box<T>);
    widen(box.min.y, box.max.y, smallest_box<T>);
    return box;
}

/// Up to `capacity` boxes.
template <class T>
struct Boxes {
    static constexpr std::size_t capacity = 64;
    std::array<T, capacity> min_x, min_y, max_x, max_y;
    std::size_t count = 0;

    void push(const Rect2<T>& box) {
        min_x[count] = box.min.x, min_y[count] = box.min.y;
        max_x[count] = box.max.x, max_y[count] = box.max.y;
        ++count;
    }
    Rect2<T> operator[](std::size_t i) const { return {Vec2<T>(min_x[i], min_y[i]), Vec2<T>(max_x[i], max_y[i])}; }
};

/// Up to `Boxes::capacity` boxes, each cut in cells × cells equal ones. Neighbours share their sides, which a
/// summed-area table reads once.
template <class T>
struct BoxGrid {
    static constexpr int most_cells = 8;
    using Values = std::array<T, Boxes<T>::capacity>;
    std::array<Values, most_cells + 1> x, y;  ///< sides in ascending order; cells + 1 of them are set
    int cells = 1;
    std::size_t count = 0;

    /// Every cell is at least `smallest_box` wide and high.
    void set(const Boxes<T>& boxes, int cells_a_side) {
        cells = cells_a_side;
        count = boxes.count;
        divide(boxes.min_x, boxes.max_x, x);
        divide(boxes.min_y, boxes.max_y, y);
    }
    Rect2<T> box(int column, int row, std::size_t i) const {
        const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
        return {Vec2<T>(x[c][i], y[r][i]), Vec2<T>(x[c + 1][i], y[r + 1][i])};
    }

  private:
    void divide(const Values& min, const Values& max, std::array<Values, most_cells + 1>& sides) const {
        const auto n = static_cast<std::size_t>(cells);
        const T least = smallest_box<T> * static_cast<T>(cells), step = T(1) / static_cast<T>(cells);
        for (std::size_t i = 0; i < count; ++i) {
            T low = min[i], high = max[i];
            widen(low, high, least);
            sides[0][i] = low, sides[n][i] = high;
        }
        for (std::size_t k = 1; k < n; ++k)
            for (std::size_t i = 0; i < count; ++i)
                sides[k][i] = sides[0][i] + (sides[n][i] - sides[0][i]) * (step * static_cast<T>(k));
    }
};

/// A box cut along its longer side into nearly square tiles, at most 8; more elongated ones are read in part.
template <class T>
struct Tiles {
    Vec2<T> first, step;  ///< centre of the first tile, and from centre to centre
    T size;               ///< mean of a tile's sides
    int count;
};
template <class T>
Tiles<T> square_tiles(const Rect2<T>& box) {
    const Vec2<T> size = extent(box);
    const bool wide = size.x > size.y;
    const T longer = wide ? size.x : size.y, shorter = wide ? size.y : size.x;
    if (longer < T(1.5) * shorter)
        return {(box.min + box.max) * T(0.5), Vec2<T>(T(0), T(0)), (longer + shorter) * T(0.5), 1};
    const int count = static_cast<int>(clamp(longer / shorter + T(0.5), T(1), T(8)));
    const T side = longer / static_cast<T>(count);
    const Vec2<T> step = wide ? Vec2<T>(side, T(0)) : Vec2<T>(T(0), side);
    const Vec2<T> half = wide ? Vec2<T>(side, size.y) * T(0.5) : Vec2<T>(size.x, side) * T(0.5);
    return {box.min + half, step, (side + shorter) * T(0.5), count};
}

}  // namespace penumbra::detail
