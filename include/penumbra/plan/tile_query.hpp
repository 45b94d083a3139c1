// A batch of points, answered by as few queries as a tolerance allows.
//
// Points that are neighbours in the array are taken together: where nothing can be in the way of any of them, all see
// the whole light; where visibility cannot change by more than the tolerance between them, one of them answers for all;
// else they are split, and in the end asked one by one. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// How a point came by its answer.
enum class PointAnswer : std::uint8_t {
    lit,     ///< nothing can be in the way: no query
    shared,  ///< visibility cannot change enough: a neighbour's query
    own      ///< a query of its own
};

namespace detail {

/// One batch. `Shadow` has visibility(points, count, result); `Vary`, a callable, has the Variation of a box in light
/// space, given what more than which need not be known, and the points.
template <class T, class Shadow, class Vary>
class TileQuery {
  public:
    /// `tolerance` ≥ 0.
    TileQuery(const Shadow& shadow, const Vary& vary, const LightFrame<T>& frame, T tolerance)
        : shadow_(shadow), vary_(vary), frame_(frame), tolerance_(tolerance) {}

    /// `answers`, if any, is told how each point came by its answer.
    void operator()(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers) {
        bool try_tiles = true;
        for (std::size_t first = 0; first < count; first += most) {
            const std::size_t n = std::min(most, count - first);
            PointAnswer* const told = answers ? answers + first : nullptr;
            if (!try_tiles) {  // they did not pay; the next are tried again
                ask_all(points + first, n, result + first, told);
                try_tiles = true;
                continue;
            }
            const std::size_t asked = ask_by_tiles(points + first, n, result + first, told);
            try_tiles = asked * 20 < n * 19;
        }
    }

  private:
    static constexpr std::size_t most = 1024, tile = 64, parts = 4;
    static constexpr int most_cells = 16;  ///< along an axis, in which points share answers
    static constexpr std::uint16_t none = 0xffff;
    static constexpr T smallest = T(1e-30);    ///< what extents are taken for that are none
    static constexpr T worth_sharing = T(12);  ///< in tolerances, from a box's middle to its corners

    void ask_all(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers) const {
        shadow_.visibility(points, count, result);
        if (answers) std::fill_n(answers, count, PointAnswer::own);
    }

    /// Returns how many queries were made.
    std::size_t ask_by_tiles(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers) {
        points_ = points, result_ = result, answers_ = answers, queries_ = 0;
        asked_at_.fill(none), answered_by_.fill(none);
        const std::size_t tiles = (count + tile - 1) / tile;
        for (std::size_t t = 0; t < tiles; ++t) {
            const std::size_t first = t * tile;
            boxes_[t] = box_of(first, std::min(tile, count - first));
            if (!is_finite(boxes_[t].min) || !is_finite(boxes_[t].max)) {
                ask_all(points, count, result, answers);
                return count;
            }
        }
        for (std::size_t t = 0; t < tiles;) {
            const std::size_t many = std::min(tiles - t, parts);
            split(t, many, count);
            t += many;
        }
        std::array<Vec3<T>, most> asked{};
        std::array<T, most> answered{};
        for (std::size_t q = 0; q < queries_; ++q) asked[q] = points[queried_[q]];
        shadow_.visibility(asked.data(), queries_, answered.data());
        for (std::size_t i = 0; i < count; ++i)
            if (answered_by_[i] != none) result[i] = saturate(answered[answered_by_[i]] + steps_[i]);
        return queries_;
    }

    /// Four points at a time, coordinate by coordinate, so that it vectorises. Not finite if any point is not.
    Box3<T> box_of(std::size_t first, std::size_t count) const {
        constexpr std::size_t lanes = 12;
        const Vec3<T>* const points = points_ + first;
        std::array<T, lanes> low, high, sum{};
        for (std::size_t j = 0; j < lanes; ++j) low[j] = high[j] = points[0][static_cast<int>(j % 3)];
        std::size_t i = 0;
        for (; i + 4 <= count; i += 4) {
            std::array<T, lanes> at;
            for (std::size_t k = 0; k < 4; ++k)
                at[3 * k] = points[i + k].x, at[3 * k + 1] = points[i + k].y, at[3 * k + 2] = points[i + k].z;
            for (std::size_t j = 0; j < lanes; ++j) {
                low[j] = at[j] < low[j] ? at[j] : low[j];
                high[j] = at[j] > high[j] ? at[j] : high[j];
                sum[j] += std::abs(at[j]);  // whatever min and max make of what is not finite
            }
        }
        Box3<T> box{points[0], points[0]};
        T all = T(0);
        const auto extend_by = [&](int axis, T least, T greatest, T size) {
            box.min[axis] = least < box.min[axis] ? least : box.min[axis];
            box.max[axis] = greatest > box.max[axis] ? greatest : box.max[axis];
            all += size;
        };
        for (std::size_t j = 0; j < lanes; ++j) extend_by(static_cast<int>(j % 3), low[j], high[j], sum[j]);
        for (; i < count; ++i)
            for (int k = 0; k < 3; ++k) extend_by(k, points[i][k], points[i][k], std::abs(points[i][k]));
        if (!is_finite(all)) box.max.x = std::numeric_limits<T>::infinity();
        return box;
    }
    /// A box in world space, and what rounding may make of its points' places, in light space.
    Box3<T> seen(const Box3<T>& box) const {
        const Vec3<T> middle = frame_.to_light((box.min + box.max) * T(0.5)), half = (box.max - box.min) * T(0.5);
        const Vec3<T> reach = glm::max(glm::abs(box.min), glm::abs(box.max)) + glm::abs(frame_.origin);
        const T margin = T(8) * std::numeric_limits<T>::epsilon() * (reach.x + reach.y + reach.z);
        const Vec3<T> out(glm::dot(glm::abs(frame_.u), half) + margin, glm::dot(glm::abs(frame_.v), half) + margin,
                          glm::dot(glm::abs(frame_.normal), half) + margin);
        return {middle - out, middle + out};
    }

    /// Answers the points of some tiles: together if that can be, else tile by tile, point by point.
    void split(std::size_t first_tile, std::size_t tiles, std::size_t all) {
        Box3<T> box = boxes_[first_tile];
        for (std::size_t t = first_tile + 1; t < first_tile + tiles; ++t) box = join(box, boxes_[t]);
        const std::size_t first = first_tile * tile, count = std::min(tiles * tile, all - first);
        const Box3<T> box_ls = seen(box);
        Variation<T> variation;
        if (box_ls.min.z > T(0)) variation = vary_(box_ls, worth_sharing * tolerance_, points_ + first, count);
        if (variation.known && variation.lit) {
            std::fill_n(result_ + first, count, T(1));
            tell(first, count, PointAnswer::lit);
        } else if (variation.known && doubt(variation, box_ls) <= tolerance_) {
            set_slope(variation);
            for (std::size_t i = first; i < first + count; ++i) ask(i, first + count / 2);
        } else if (variation.known && count > 1 && tolerance_ > T(0) &&
                   (tiles == 1 || doubt(variation, box_ls) <= T(4) * tolerance_)) {
            set_slope(variation);
            share_answers(first, count, variation);
        } else if (tiles > 1) {
            for (std::size_t t = first_tile; t < first_tile + tiles; ++t) split(t, 1, all);
        } else {
            for (std::size_t i = first; i < first + count; ++i) ask(i, i);
        }
    }

    /// By how much two points of the box may differ from the slope.
    static T doubt(const Variation<T>& variation, const Box3<T>& box_ls) {
        const Vec3<T> size = box_ls.max - box_ls.min;
        const Vec2<T> d(std::abs(variation.direction.x), std::abs(variation.direction.y));
        return variation.change(Vec3<T>(size.x * d.x + size.y * d.y, size.x * d.y + size.y * d.x, size.z));
    }

    /// Puts the points into cells in which visibility changes by no more than the tolerance from the middle to a side,
    /// and asks for the one nearest to the middle; others answer with it if they may.
    void share_answers(std::size_t first, std::size_t count, const Variation<T>& variation) {
        const Vec2<T> d = variation.direction;
        const Vec3<T> along = frame_.u * d.x + frame_.v * d.y, across = frame_.v * d.x - frame_.u * d.y;
        std::array<T, parts*tile>&x = x_, &y = y_, &z = z_, &away = away_;
        std::array<int, parts* tile>& cell = cell_;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3<T> from = points_[first + i] - frame_.origin;
            x[i] = from.x * along.x + from.y * along.y + from.z * along.z;
            y[i] = from.x * across.x + from.y * across.y + from.z * across.z;
            z[i] = from.x * frame_.normal.x + from.y * frame_.normal.y + from.z * frame_.normal.z;
        }
        const auto range = [&](const std::array<T, parts * tile>& values) {
            T low = values[0], high = values[0];
            for (std::size_t i = 0; i < count; ++i) {
                low = values[i] < low ? values[i] : low;
                high = values[i] > high ? values[i] : high;
            }
            return Vec2<T>(low, high);
        };
        const Vec2<T> in_x = range(x), in_y = range(y), in_z = range(z);
        const T left = std::max(tolerance_ - variation.turning - variation.deep * (in_z.y - in_z.x) * T(0.5),
                                T(1e-3) * tolerance_);
        const Cells cells = fewest_cells(variation.along * (in_x.y - in_x.x), variation.across * (in_y.y - in_y.x), left);
        const int columns = cells.columns, rows = cells.rows;
        const T width = std::max(in_x.y - in_x.x, smallest) / static_cast<T>(columns);
        const T height = std::max(in_y.y - in_y.x, smallest) / static_cast<T>(rows);
        const T per_width = T(1) / width, per_height = T(1) / height, middle_z = (in_z.x + in_z.y) * T(0.5);
        for (std::size_t i = 0; i < count; ++i) {
            const int column = std::min(static_cast<int>((x[i] - in_x.x) * per_width), columns - 1);
            const int row = std::min(static_cast<int>((y[i] - in_y.x) * per_height), rows - 1);
            cell[i] = row * columns + column;
            const T from_x = x[i] - (in_x.x + width * (static_cast<T>(column) + T(0.5)));
            const T from_y = y[i] - (in_y.x + height * (static_cast<T>(row) + T(0.5)));
            away[i] = variation.change(Vec3<T>(from_x, from_y, z[i] - middle_z));
        }
        std::array<std::uint16_t, most_cells * most_cells> chosen;
        std::fill_n(chosen.begin(), columns * rows, none);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint16_t& one = chosen[static_cast<std::size_t>(cell[i])];
            if (one == none || away[i] < away[one]) one = static_cast<std::uint16_t>(i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t with = chosen[static_cast<std::size_t>(cell[i])];
            const bool may = variation.change(Vec3<T>(x[i] - x[with], y[i] - y[with], z[i] - z[with])) <= tolerance_;
            ask(first + i, may ? first + with : first + i);
        }
    }

    struct Cells {
        int columns, rows;
    };
    /// Cells from whose middles to corners no more than `most` is in doubt, of what is from side to side.
    static Cells fewest_cells(T along, T across, T most) {
        Cells best = {most_cells, most_cells};
        for (int rows = 1; rows <= most_cells; ++rows) {
            const T rest = T(2) * most - across / static_cast<T>(rows);
            if (!(rest > T(0))) continue;
            const T columns = along / rest;
            if (!(columns < static_cast<T>(most_cells))) continue;
            const Cells cells = {static_cast<int>(columns) + 1, rows};
            if (cells.columns * cells.rows < best.columns * best.rows) best = cells;
        }
        return best;
    }
    /// How visibility changes between points that share answers, in world space.
    void set_slope(const Variation<T>& variation) {
        const Vec3<T>& s = variation.slope;
        slope_ = frame_.u * s.x + frame_.v * s.y + frame_.normal * s.z;
    }
    /// Has a point answered by another's query, or its own.
    void ask(std::size_t point, std::size_t by) {
        if (asked_at_[by] == none) {
            asked_at_[by] = static_cast<std::uint16_t>(queries_);
            queried_[queries_++] = static_cast<std::uint16_t>(by);
        }
        answered_by_[point] = asked_at_[by];
        steps_[point] = point == by ? T(0) : glm::dot(slope_, points_[point] - points_[by]);
        tell(point, 1, point == by ? PointAnswer::own : PointAnswer::shared);
    }
    void tell(std::size_t first, std::size_t count, PointAnswer how) {
        if (answers_) std::fill_n(answers_ + first, count, how);
    }

    const Shadow& shadow_;
    const Vary& vary_;
    const LightFrame<T>& frame_;
    T tolerance_;
    const Vec3<T>* points_ = nullptr;
    T* result_ = nullptr;
    PointAnswer* answers_ = nullptr;
    std::array<Box3<T>, most / tile> boxes_;
    std::array<T, parts * tile> x_{}, y_{}, z_{}, away_{};  ///< of points that share answers
    std::array<int, parts * tile> cell_{};
    std::array<std::uint16_t, most> asked_at_, answered_by_, queried_;  ///< of each point; of each query
    std::array<T, most> steps_;  ///< by how much a point's visibility differs from the answer
    Vec3<T> slope_ = Vec3<T>(T(0), T(0), T(0));
    std::size_t queries_ = 0;
};

}  // namespace detail
}  // namespace penumbra
