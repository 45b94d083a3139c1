// What all silhouettes block together, exactly, where intervals do not say it already.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/penumbra_wedge/edge_union.hpp>
#include <penumbra/penumbra_wedge/interval_blending.hpp>
#include <penumbra/penumbra_wedge/mask_blending.hpp>
#include <penumbra/penumbra_wedge/tile_sums.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// Keeps the edges of a few points. On lights of any shape, see RectShape.
template <class T>
class UnionBlender {
  public:
    static constexpr std::size_t capacity = 8;
    static constexpr std::size_t most_edges = 256;  ///< of a point

    explicit UnionBlender(const PointTile<T>& tile) : tile_(tile) {
        for (auto& edges : edges_) edges.clear();
    }

    void begin_mesh() {}
    void begin_piece(const Box3<T>&, bool) {
        for (auto& edges : edges_) edges.begin_piece();
    }
    void edges(const TileEdge<T>& e) {
        std::array<ColumnEdge<T>, capacity> columns;
        for (std::size_t i = 0; i < capacity; ++i)
            columns[i] = column_edge(e.ax[i], e.ay[i], e.bx[i], e.by[i], tile_.light);
        for (std::size_t i = 0; i < tile_.count; ++i)
            if (e.coefficient[i] != T(0)) add(i, columns[i], e.coefficient[i]);
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        add(lane, column_edge(from.x, from.y, to.x, to.y, tile_.light), coefficient);
    }
    void end_piece() {}
    void end_mesh() {}

    /// Whether a point has more edges than are kept.
    bool is_full(std::size_t i) const { return full_[i]; }
    template <class Shape>
    T occlusion(std::size_t i, const Shape& shape) {
        const T area =
            edges_[i].area([&](T ax, T ay, T bx, T by) { return shape.coverage(ax, ay, bx, by); }) / shape.area();
        return saturate(settle(area));
    }

  private:
    void add(std::size_t lane, const ColumnEdge<T>& edge, T coefficient) {
        full_[lane] = !edges_[lane].add(edge, static_cast<int>(coefficient), tile_.light) || full_[lane];
    }

    const PointTile<T>& tile_;
    std::array<EdgeUnion<T, most_edges>, capacity> edges_;
    std::array<bool, capacity> full_{};
};

/// The area of all silhouettes together, for points at which pieces may overlap by more than `tolerance` either way;
/// by masks of `size` for points with more edges than UnionBlender keeps. May give up as WedgeIndex::visit does;
/// returns whether it did not.
template <class T, class Shape>
bool blend_exactly(const WedgeIndex<T>& index, const PointTile<T>& tile, const Shape& shape, int size, T tolerance,
                   bool may_give_up, T* occlusion) {
    using Blender = UnionBlender<T>;
    OpenPoints<T> open;
    const T least = std::max(T(32) * std::numeric_limits<T>::epsilon(), T(2) * tolerance);
    if (!find_open_points(index, tile, shape, least, may_give_up, occlusion, open)) return false;
    OpenPoints<T> crowded;
    for (std::size_t first = 0; first < open.tile.count; first += Blender::capacity) {
        const std::size_t count = std::min(Blender::capacity, open.tile.count - first);
        PointTile<T> few;
        for (std::size_t i = 0; i < count; ++i) few.push(open.tile[first + i]);
        few.finish(tile.light.max);
        Blender blender(few);
        index.visit(few, blender);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = open.from[first + i];
            const OcclusionBounds<T> bounds = open.bounds[first + i];
            if (blender.is_full(i)) {
                crowded.from[crowded.tile.count] = at, crowded.bounds[crowded.tile.count] = bounds;
                crowded.tile.push(tile[at]);
            } else {
                occlusion[at] = clamp(blender.occlusion(i, shape), bounds.lower, bounds.upper);
            }
        }
    }
    if (crowded.tile.count > 0) blend_by_masks(index, crowded, tile.light.max, shape, size, occlusion);
    return true;
}

}  // namespace penumbra::detail
