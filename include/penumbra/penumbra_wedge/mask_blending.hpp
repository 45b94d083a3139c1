// What all silhouettes block together by masks, where intervals do not say it already.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <penumbra/combine.hpp>
#include <penumbra/penumbra_wedge/bitmask.hpp>
#include <penumbra/penumbra_wedge/interval_blending.hpp>
#include <penumbra/penumbra_wedge/tile_sums.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

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

/// Fills in what is blocked at open points; of their tile, which is finished with this, at least one.
template <class T, class Shape>
void blend_by_masks(const WedgeIndex<T>& index, OpenPoints<T>& open, const Vec2<T>& half_size, const Shape& shape,
                    int size, T* occlusion) {
    open.tile.finish(half_size);
    MaskBlender<T, Shape> masks(open.tile, shape, size);
    index.visit(open.tile, masks);
    std::array<T, PointTile<T>::capacity> masked;
    masks.result(masked.data());
    for (std::size_t i = 0; i < open.tile.count; ++i)
        occlusion[open.from[i]] = clamp(masked[i], open.bounds[i].lower, open.bounds[i].upper);
}

/// Masks only for points at which they can tell anything: where pieces may overlap, by more than half a cell and by
/// more than `tolerance` either way. May give up as WedgeIndex::visit does; returns whether it did not.
template <class T, class Shape>
bool blend_by_masks(const WedgeIndex<T>& index, const PointTile<T>& tile, const Shape& shape, int size, T tolerance,
                    bool may_give_up, T* occlusion) {
    const T least = std::max(T(0.5) / static_cast<T>(shape.cell_count(size)), T(2) * tolerance);
    OpenPoints<T> open;
    if (!find_open_points(index, tile, shape, least, may_give_up, occlusion, open)) return false;
    if (open.tile.count > 0) blend_by_masks(index, open, tile.light.max, shape, size, occlusion);
    return true;
}

}  // namespace penumbra::detail
