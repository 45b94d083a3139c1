// What a tile's points lose of the light by the edges of one silhouette, as exact areas.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/penumbra_wedge/coverage.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// Carries sums of edges over their rounding: what is nearly 0 becomes at most 0, what is nearly 1 at least 1, and
/// others move by less than 16 ε.
template <class T>
constexpr T settle(T occlusion) {
    constexpr T slack = T(16) * std::numeric_limits<T>::epsilon();
    return occlusion * (T(1) + T(2) * slack) - slack;
}

/// A light that fills its box. Lights of other shapes have the same members; tile.light is the box around them.
template <class T>
struct RectShape {
    Rect2<T> box;

    T area() const { return penumbra::area(box); }
    /// What lies of the light below an edge, signed.
    T coverage(T ax, T ay, T bx, T by) const { return edge_coverage(ax, ay, bx, by, box); }
    /// The same where column_edge of the light's box is there already.
    T coverage(const ColumnEdge<T>& edge, T, T, T, T) const { return covered_below(edge, box); }
    /// Of a column of a mask of the box, the cells whose middle is on the light; and how many there are in all columns.
    std::uint32_t cells(int, int) const { return 0xffffffffU; }
    int cell_count(int size) const { return size * size; }
};

/// Areas over `Count` shapes, one for each lane: what a piece or a mesh blocks of each.
template <class T, class Shape, std::size_t Count>
struct AreaSums {
    using Values = typename PointTile<T>::Values;
    const PointTile<T>& tile;
    std::array<Shape, Count> shapes;
    std::array<Values, Count> areas;

    void clear() {
        for (Values& area : areas) std::fill_n(area.begin(), tile.lanes, T(0));
    }
    void edges(const TileEdge<T>& e) {
        for (std::size_t s = 0; s < Count; ++s) {
            const Shape shape = shapes[s];
            Values& area = areas[s];
            for (std::size_t i = 0; i < tile.lanes; ++i)
                area[i] += e.coefficient[i] * shape.coverage(e.ax[i], e.ay[i], e.bx[i], e.by[i]);
        }
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        for (std::size_t s = 0; s < Count; ++s)
            areas[s][lane] += coefficient * shapes[s].coverage(from.x, from.y, to.x, to.y);
    }
};

}  // namespace penumbra::detail
