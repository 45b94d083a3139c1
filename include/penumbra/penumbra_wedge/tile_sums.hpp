// What a tile's points lose of the light by the edges of one silhouette, as exact areas.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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

/// Areas over `Boxes` boxes, one for each lane: what a piece or a mesh blocks of each.
template <class T, std::size_t Boxes>
struct AreaSums {
    using Values = typename PointTile<T>::Values;
    const PointTile<T>& tile;
    std::array<Rect2<T>, Boxes> boxes;
    std::array<Values, Boxes> areas;

    void clear() {
        for (Values& area : areas) std::fill_n(area.begin(), tile.lanes, T(0));
    }
    void edges(const TileEdge<T>& e) {
        for (std::size_t b = 0; b < Boxes; ++b) {
            const Rect2<T> box = boxes[b];
            Values& area = areas[b];
            for (std::size_t i = 0; i < tile.lanes; ++i)
                area[i] += e.coefficient[i] * edge_coverage(e.ax[i], e.ay[i], e.bx[i], e.by[i], box);
        }
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        for (std::size_t b = 0; b < Boxes; ++b) areas[b][lane] += coefficient * edge_coverage(from, to, boxes[b]);
    }
};

}  // namespace penumbra::detail
