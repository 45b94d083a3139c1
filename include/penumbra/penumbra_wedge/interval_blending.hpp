// What all silhouettes block together, as an interval, and at which points that does not say enough.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/penumbra_wedge/tile_sums.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// The interval in which the truth lies for each lane, from the exact area of each piece and from a rectangle around
/// it: two pieces overlap by no more than their rectangles do. On lights of any shape, see RectShape.
template <class T, class Shape>
class IntervalBlender {
  public:
    IntervalBlender(const PointTile<T>& tile, const Shape& shape) : sums_{tile, {{shape}}, {}} {}

    void begin_mesh() {}
    void begin_piece(const Box3<T>& box, bool simple) {
        sums_.clear();
        box_ = box, simple_ = simple;
        piece_ = &pieces_[kept_ < most ? kept_ : most - 1];
        constexpr T big = std::numeric_limits<T>::max();
        const std::size_t lanes = sums_.tile.lanes;
        std::fill_n(piece_->left.begin(), lanes, big), std::fill_n(piece_->right.begin(), lanes, -big);
        std::fill_n(piece_->bottom.begin(), lanes, big), std::fill_n(piece_->top.begin(), lanes, -big);
    }
    void edges(const TileEdge<T>& e) {
        sums_.edges(e);
        Kept& r = *piece_;
        for (std::size_t i = 0; i < sums_.tile.lanes; ++i) {
            const bool counts = e.coefficient[i] != T(0);
            const T left = std::min(e.ax[i], e.bx[i]), right = std::max(e.ax[i], e.bx[i]);
            const T bottom = std::min(e.ay[i], e.by[i]), top = std::max(e.ay[i], e.by[i]);
            r.left[i] = std::min(r.left[i], counts ? left : r.left[i]);
            r.right[i] = std::max(r.right[i], counts ? right : r.right[i]);
            r.bottom[i] = std::min(r.bottom[i], counts ? bottom : r.bottom[i]);
            r.top[i] = std::max(r.top[i], counts ? top : r.top[i]);
        }
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T c) { sums_.edge(lane, from, to, c); }
    void end_piece() {
        const std::size_t lanes = sums_.tile.lanes;
        const T unit = T(1) / sums_.shapes[0].area();
        Kept& piece = *piece_;
        T any = T(0);
        for (std::size_t i = 0; i < lanes; ++i) {
            const T raw = sums_.areas[0][i] * unit, occlusion = saturate(settle(raw));
            const bool counts_twice = !simple_ && settle(std::abs(raw)) > T(0);
            piece.area[i] = occlusion;
            any = std::max(any, occlusion);
            folded[i] = counts_twice ? T(1) : folded[i];
        }
        if (!(any > T(0))) return;
        include_hidden_edges(piece);
        for (std::size_t k = 0; k < std::min(kept_, most - 1); ++k) {
            const Kept& other = pieces_[k];
            for (std::size_t i = 0; i < lanes; ++i) {
                const T x = std::min(piece.right[i], other.right[i]) - std::max(piece.left[i], other.left[i]);
                const T y = std::min(piece.top[i], other.top[i]) - std::max(piece.bottom[i], other.bottom[i]);
                const T common = std::max(x, T(0)) * std::max(y, T(0)) * unit;
                overlap[i] += std::min(common, std::min(piece.area[i], other.area[i]));
            }
        }
        const bool has_room = kept_ + 1 < most;
        for (std::size_t i = 0; i < lanes; ++i) {
            total[i] += piece.area[i];
            largest[i] = std::max(largest[i], piece.area[i]);
            overlap[i] += has_room ? T(0) : piece.area[i];  // nobody will know where this one is
        }
        kept_ += has_room ? 1 : 0;
    }
    void end_mesh() {}

    typename PointTile<T>::Values total{}, largest{}, folded{};
    typename PointTile<T>::Values overlap{};  ///< at most this much of the total is counted twice

  private:
    static constexpr std::size_t most = 24;
    struct Kept {
        typename PointTile<T>::Values area, left, right, bottom, top;
    };

    /// Limits a piece's rectangle to the light. Edges to the left, to the right and below are not handed out: where the
    /// piece's box may reach there, so does the rectangle.
    void include_hidden_edges(Kept& r) const {
        const PointTile<T>& tile = sums_.tile;
        const Rect2<T> light = tile.light;
        const Box3<T> b = box_;
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            const T p = tile.depth[i], px = tile.x[i], py = tile.y[i];
            const bool beyond = b.max.z >= p;
            const T near = p / (p - std::min(b.min.z, T(0.5) * p)), far = p / (beyond ? p : p - b.max.z);
            const T left = px + std::min((b.min.x - px) * near, (b.min.x - px) * far);
            const T right = px + std::max((b.max.x - px) * near, (b.max.x - px) * far);
            const T bottom = py + std::min((b.min.y - py) * near, (b.min.y - py) * far);
            r.left[i] = (beyond | (left < light.min.x)) ? light.min.x : r.left[i];
            r.right[i] = (beyond | (right > light.max.x)) ? light.max.x : r.right[i];
            r.bottom[i] = (beyond | (bottom < light.min.y)) ? light.min.y : r.bottom[i];
            r.top[i] = (beyond | (r.top[i] > light.max.y)) ? light.max.y : r.top[i];
        }
    }

    AreaSums<T, Shape, 1> sums_;
    std::array<Kept, most> pieces_;
    std::size_t kept_ = 0;
    Kept* piece_ = nullptr;
    Box3<T> box_{};
    bool simple_ = false;
};

/// Points of a tile at which silhouettes may overlap, and the interval that is known of each.
template <class T>
struct OpenPoints {
    PointTile<T> tile;
    std::array<std::size_t, PointTile<T>::capacity> from;  ///< lanes of the tile that was asked about
    std::array<OcclusionBounds<T>, PointTile<T>::capacity> bounds;
};

/// Fills in what is blocked where the interval is no wider than `least`, its middle, and finds all other points. May
/// give up as WedgeIndex::visit does; returns whether it did not.
template <class T, class Shape>
bool find_open_points(const WedgeIndex<T>& index, const PointTile<T>& tile, const Shape& shape, T least,
                      bool may_give_up, T* occlusion, OpenPoints<T>& open) {
    IntervalBlender<T, Shape> intervals(tile, shape);
    if (!index.visit(tile, intervals, may_give_up)) return false;
    for (std::size_t i = 0; i < tile.count; ++i) {
        const T total = intervals.total[i];
        const T upper = saturate(total), lower = clamp(total - intervals.overlap[i], intervals.largest[i], upper);
        occlusion[i] = T(0.5) * (lower + upper);
        const bool folded = intervals.folded[i] > T(0);
        if (!folded && upper - lower <= least) continue;
        open.from[open.tile.count] = i;
        open.bounds[open.tile.count] = {folded ? T(0) : lower, folded ? T(1) : upper};
        open.tile.push(tile[i]);
    }
    return true;
}

}  // namespace penumbra::detail
