// Where on the light a silhouette blocks, cell by cell.
//
// The light's box has up to 32 × 32 cells; a column of cells is one word, its lowest cell the lowest bit. An edge
// raises or lowers the winding number of all cells whose middle lies below it, as edge_coverage does with areas: edges
// come in any order. Winding numbers are kept for a column's 32 cells at once, as four words of binary digits, modulo
// 16, and a cell is blocked where its number is not 0. Masks of several silhouettes unite by "or", and then say how
// much of the sum of exact areas to believe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/coverage.hpp>

namespace penumbra {

/// The number of bits that are set.
constexpr int count_bits(std::uint32_t word) {
    word = word - ((word >> 1) & 0x55555555U);
    word = (word & 0x33333333U) + ((word >> 2) & 0x33333333U);
    word = (word + (word >> 4)) & 0x0f0f0f0fU;
    return static_cast<int>((word * 0x01010101U) >> 24);
}

/// The `count` lowest bits, 0 to 32.
constexpr std::uint32_t low_bits(int count) { return count > 0 ? (2U << ((count > 0 ? count : 1) - 1)) - 1U : 0U; }

/// Winding numbers of 32 cells, modulo 16: one word for each binary digit.
struct WindingColumn {
    std::uint32_t ones = 0, twos = 0, fours = 0, eights = 0;
};

/// With 1 more at each of `cells`, or 1 less. Exact modulo 16.
constexpr WindingColumn add_winding(const WindingColumn& column, std::uint32_t cells, bool less) {
    const std::uint32_t flip = less ? 0xffffffffU : 0U;  // a digit borrows where it is 0, and carries where it is 1
    const std::uint32_t to_twos = (column.ones ^ flip) & cells;
    const std::uint32_t to_fours = (column.twos ^ flip) & to_twos;
    const std::uint32_t to_eights = (column.fours ^ flip) & to_fours;
    return {column.ones ^ cells, column.twos ^ to_twos, column.fours ^ to_fours, column.eights ^ to_eights};
}

/// The cells whose winding number is not 0.
constexpr std::uint32_t wound_cells(const WindingColumn& column) {
    return column.ones | column.twos | column.fours | column.eights;
}

/// The sum of all 32 winding numbers, each from −8 to 7.
constexpr int winding_sum(const WindingColumn& column) {
    return count_bits(column.ones) + 2 * count_bits(column.twos) + 4 * count_bits(column.fours) -
           8 * count_bits(column.eights);
}

namespace detail {

/// An edge on its way across columns, left to right: y at x is left_y + (x − left_x) slope.
template <class T>
struct ColumnLine {
    T left_x, right_x, left_y, slope;
    bool rightward;
};

template <class T>
ColumnLine<T> column_line(const ColumnEdge<T>& e) {
    const bool ascends = e.x0 < e.x1;
    const T lx = ascends ? e.x0 : e.x1, ly = ascends ? e.y0 : e.y1;
    const T rx = ascends ? e.x1 : e.x0, ry = ascends ? e.y1 : e.y0;
    return {lx, rx, ly, (ry - ly) / divisor(rx - lx), ascends == (e.sign > T(0))};
}

/// The first of `size` columns whose middle is at x or to the right of it; `size` if none is.
template <class T>
int first_column(T x, const Rect2<T>& box, int size) {
    const T columns = static_cast<T>(size) / (box.max.x - box.min.x);
    return static_cast<int>(clamp((x - box.min.x) * columns + T(0.5), T(0), static_cast<T>(size)));
}
/// Of that column's `size` cells, those whose middle lies below the line.
template <class T>
std::uint32_t cells_below(const ColumnLine<T>& line, int column, const Rect2<T>& box, int size) {
    const T x = box.min.x + (static_cast<T>(column) + T(0.5)) * ((box.max.x - box.min.x) / static_cast<T>(size));
    const T y = line.left_y + (x - line.left_x) * line.slope;
    const T cells = static_cast<T>(size) / (box.max.y - box.min.y);
    return low_bits(static_cast<int>(clamp((y - box.min.y) * cells + T(0.5), T(0), static_cast<T>(size))));
}

}  // namespace detail

/// Winding numbers over a box of Size × Size cells, Size 8, 16 or 32. Box and edges share a plane's coordinates.
template <int Size>
struct WindingMask {
    static_assert(Size == 8 || Size == 16 || Size == 32, "8, 16 or 32");
    std::array<WindingColumn, Size> columns{};

    /// Adds an edge from a to b, `weight` times; over a closed loop that runs counter-clockwise, 1 for each cell whose
    /// middle is inside. Domain: |coordinates| ≤ 1e18, a box with an area. Middles within 8 ε box sizes of an edge may
    /// fall on either side of it, but on the same for both ways round. Exact modulo 16.
    template <class T>
    void add(const Vec2<T>& a, const Vec2<T>& b, int weight, const Rect2<T>& box) {
        const detail::ColumnLine<T> line = detail::column_line(detail::column_edge(a.x, a.y, b.x, b.y, box));
        const int end = detail::first_column(line.right_x, box, Size);
        for (int column = detail::first_column(line.left_x, box, Size); column < end; ++column) {
            const std::uint32_t cells = detail::cells_below(line, column, box, Size);
            WindingColumn& winding = columns[static_cast<std::size_t>(column)];
            for (int k = weight < 0 ? -weight : weight; k > 0; --k)
                winding = add_winding(winding, cells, line.rightward == (weight > 0));
        }
    }
    /// The number of cells whose winding number is not 0.
    int wound() const {
        int sum = 0;
        for (const WindingColumn& column : columns) sum += count_bits(wound_cells(column));
        return sum;
    }
    /// The sum of all winding numbers, each from −8 to 7.
    int sum() const {
        int sum = 0;
        for (const WindingColumn& column : columns) sum += winding_sum(column);
        return sum;
    }
};

/// What several silhouettes block together, from their exact areas and from where their masks lie.
template <class T>
struct MaskedOcclusion {
    T occlusion = T(0);  ///< of all so far, in [0, 1]
    T total = T(0);      ///< the sum of each for itself
    int united = 0;      ///< cells that are blocked

    /// Adds a silhouette that by its edges blocks `area`, a fraction of the light in which what it covers twice counts
    /// twice, and by its mask `wound` of `all` cells, with winding numbers that sum up to `winding`; `fresh` of them
    /// were not blocked before. It counts with the fresh share of its area: never brightens, stays between the largest
    /// and the sum, exact where nothing overlaps. Error, RMS, over up to 20 casters at random: .015 with 8 × 8 cells,
    /// .005 with 16 × 16, .002 with 32 × 32.
    constexpr void add(T area, int wound, int winding, int fresh, int all) {
        T blocked = area;
        if (winding != wound) {  // it lies over itself: the mask says how much
            const T share = static_cast<T>(wound) / static_cast<T>(winding > 0 ? winding : all);
            blocked = wound == all ? T(1) : winding > 0 ? area * share : share;
        }
        blocked = saturate(blocked);
        total += blocked;
        united += fresh;
        const T more = wound > 0 ? blocked * (static_cast<T>(fresh) / static_cast<T>(wound)) : blocked;
        const T upper = saturate(total), lower = occlusion > blocked ? occlusion : blocked;
        occlusion = united == all && upper == T(1) ? T(1) : clamp(occlusion + more, lower, upper);
    }
};

}  // namespace penumbra
