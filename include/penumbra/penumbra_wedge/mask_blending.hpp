// What all silhouettes block together by masks, where intervals do not say it already.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/penumbra_wedge/bitmask.hpp>
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

/// Exact areas and masks, piece by piece.
template <class T, class Shape>
class MaskBlender {
  public:
    MaskBlender(const PointTile<T>& tile, const Shape& shape, int size) : sums_{tile, {{shape}}, {}}, size_(size) {
        for (std::size_t j = 0; j < static_cast<std::size_t>(size); ++j) united_[j].fill(0U), clear(j);
    }

    void begin_mesh() {}
    void begin_piece(const Box3<T>&, bool) { sums_.clear(), first_ = size_, last_ = -1; }
    /// Areas and lines by vectors; crossings, few in each lane but at other columns in each, lane by lane.
    void edges(const TileEdge<T>& e) {
        const PointTile<T>& tile = sums_.tile;
        const Rect2<T> light = tile.light;
        const Shape shape = sums_.shapes[0];
        typename PointTile<T>::Values x0, y0, x1, y1, sign, left, right, y, slope;
        std::array<int, PointTile<T>::capacity> first, end;
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            const ColumnEdge<T> edge = column_edge(e.ax[i], e.ay[i], e.bx[i], e.by[i], light);
            x0[i] = edge.x0, y0[i] = edge.y0, x1[i] = edge.x1, y1[i] = edge.y1, sign[i] = edge.sign;
        }
        for (std::size_t i = 0; i < tile.lanes; ++i)
            sums_.areas[0][i] += e.coefficient[i] * shape.coverage(ColumnEdge<T>{x0[i], y0[i], x1[i], y1[i], sign[i]},
                                                                   e.ax[i], e.ay[i], e.bx[i], e.by[i]);
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            const ColumnLine<T> line = column_line(ColumnEdge<T>{x0[i], y0[i], x1[i], y1[i], sign[i]});
            left[i] = line.left_x, right[i] = line.right_x, y[i] = line.left_y, slope[i] = line.slope;
        }
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            first[i] = first_column(left[i], light, size_);
            end[i] = first_column(right[i], light, size_);
        }
        for (std::size_t i = 0; i < tile.count; ++i) {
            const bool rightward = (x0[i] < x1[i]) == (sign[i] > T(0));
            const auto weight = static_cast<int>(rightward ? -e.coefficient[i] : e.coefficient[i]);
            cross(i, first[i], end[i], {left[i], right[i], y[i], slope[i], rightward}, weight);
        }
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        sums_.edge(lane, from, to, coefficient);
        const ColumnLine<T> line = column_line(column_edge(from.x, from.y, to.x, to.y, sums_.tile.light));
        const Rect2<T>& light = sums_.tile.light;
        cross(lane, first_column(line.left_x, light, size_), first_column(line.right_x, light, size_), line,
              static_cast<int>(line.rightward ? -coefficient : coefficient));
    }
    void end_piece() {
        const std::size_t lanes = sums_.tile.lanes;
        const Shape& shape = sums_.shapes[0];
        std::array<int, PointTile<T>::capacity> wound, sum, fresh;
        for (auto* counts : {&wound, &sum, &fresh}) std::fill_n(counts->begin(), lanes, 0);
        for (int j = first_; j <= last_; ++j) {
            const Column& c = columns_[static_cast<std::size_t>(j)];
            const std::uint32_t light = shape.cells(j, size_);
            Words& united = united_[static_cast<std::size_t>(j)];
            for (std::size_t i = 0; i < lanes; ++i) {
                const WindingColumn winding{c.ones[i] & light, c.twos[i] & light, c.fours[i] & light,
                                            c.eights[i] & light};
                const std::uint32_t cells = wound_cells(winding);
                fresh[i] += count_bits(cells & ~united[i]);
                united[i] |= cells;
                wound[i] += count_bits(cells);
                sum[i] += winding_sum(winding);
            }
            clear(static_cast<std::size_t>(j));
        }
        const T unit = T(1) / shape.area();
        for (std::size_t i = 0; i < sums_.tile.count; ++i)
            all_[i].add(settle(sums_.areas[0][i] * unit), wound[i], sum[i], fresh[i], shape.cell_count(size_));
    }
    void end_mesh() {}
    void result(T* occlusion) const {
        for (std::size_t i = 0; i < sums_.tile.count; ++i) occlusion[i] = all_[i].occlusion;
    }

  private:
    static constexpr std::size_t most = 32;
    using Words = std::array<std::uint32_t, PointTile<T>::capacity>;
    struct Column {
        Words ones, twos, fours, eights;
    };

    void clear(std::size_t j) {
        for (Words* words : {&columns_[j].ones, &columns_[j].twos, &columns_[j].fours, &columns_[j].eights})
            std::fill_n(words->begin(), sums_.tile.lanes, 0U);
    }

    /// Raises the winding numbers of one lane by `weight` below a line, in columns `first` to `end` − 1.
    void cross(std::size_t lane, int first, int end, const ColumnLine<T>& line, int weight) {
        if (first >= end || weight == 0) return;
        first_ = std::min(first_, first), last_ = std::max(last_, end - 1);
        for (int j = first; j < end; ++j) {
            const std::uint32_t below = cells_below(line, j, sums_.tile.light, size_);
            Column& column = columns_[static_cast<std::size_t>(j)];
            WindingColumn winding{column.ones[lane], column.twos[lane], column.fours[lane], column.eights[lane]};
            for (int k = std::abs(weight); k > 0; --k) winding = add_winding(winding, below, weight < 0);
            column.ones[lane] = winding.ones, column.twos[lane] = winding.twos;
            column.fours[lane] = winding.fours, column.eights[lane] = winding.eights;
        }
    }

    AreaSums<T, Shape, 1> sums_;
    int size_, first_ = 0, last_ = -1;
    std::array<Column, most> columns_;
    std::array<Words, most> united_;
    std::array<MaskedOcclusion<T>, PointTile<T>::capacity> all_{};
};

/// Masks only for points at which they can tell anything: where pieces may overlap, by more than half a cell and by
/// more than `tolerance` either way. May give up as WedgeIndex::visit does; returns whether it did not.
template <class T, class Shape>
bool blend_by_masks(const WedgeIndex<T>& index, const PointTile<T>& tile, const Shape& shape, int size, T tolerance,
                    bool may_give_up, T* occlusion) {
    IntervalBlender<T, Shape> intervals(tile, shape);
    if (!index.visit(tile, intervals, may_give_up)) return false;
    const T least = std::max(T(0.5) / static_cast<T>(shape.cell_count(size)), T(2) * tolerance);
    PointTile<T> open;
    std::array<std::size_t, PointTile<T>::capacity> from;
    std::array<OcclusionBounds<T>, PointTile<T>::capacity> bounds;
    for (std::size_t i = 0; i < tile.count; ++i) {
        const T total = intervals.total[i];
        const T upper = saturate(total), lower = clamp(total - intervals.overlap[i], intervals.largest[i], upper);
        occlusion[i] = T(0.5) * (lower + upper);
        const bool folded = intervals.folded[i] > T(0);
        if (!folded && upper - lower <= least) continue;
        from[open.count] = i;
        bounds[open.count] = {folded ? T(0) : lower, folded ? T(1) : upper};
        open.push(tile[i]);
    }
    if (open.count == 0) return true;
    open.finish(tile.light.max);
    MaskBlender<T, Shape> masks(open, shape, size);
    index.visit(open, masks);
    std::array<T, PointTile<T>::capacity> masked;
    masks.result(masked.data());
    for (std::size_t i = 0; i < open.count; ++i)
        occlusion[from[i]] = clamp(masked[i], bounds[i].lower, bounds[i].upper);
    return true;
}

}  // namespace penumbra::detail
