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

namespace penumbra {

/// How a point came by its answer.
enum class PointAnswer : std::uint8_t {
    lit,     ///< nothing can be in the way: no query
    shared,  ///< visibility cannot change enough: a neighbour's query
    own      ///< a query of its own
};

namespace detail {

/// One batch. `Shadow` has visibility(points, count, result); `Vary`, a callable, has the Variation of a box in light
/// space, given what more than which need not be known.
template <class T, class Shadow, class Vary>
class TileQuery {
  public:
    /// `tolerance` > 0.
    TileQuery(const Shadow& shadow, const Vary& vary, const LightFrame<T>& frame, T tolerance)
        : shadow_(shadow), vary_(vary), frame_(frame), tolerance_(tolerance) {}

    /// `answers`, if any, is told how each point came by its answer.
    void operator()(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers) {
        std::size_t skip = 0, pause = 1;
        for (std::size_t first = 0; first < count; first += most) {
            const std::size_t n = std::min(most, count - first);
            PointAnswer* const told = answers ? answers + first : nullptr;
            // where tiles have not paid, the next are not tried; longer and longer, as long as they do not pay
            if (skip > 0) {
                --skip;
                ask_all(points + first, n, result + first, told);
                continue;
            }
            const std::size_t asked = ask_by_tiles(points + first, n, result + first, told);
            const bool pays = asked * 10 < n * 9;
            skip = pays ? 0 : pause;
            pause = pays ? 1 : std::min<std::size_t>(2 * pause, 2);
        }
    }

  private:
    static constexpr std::size_t most = 1024, tile = 64, parts = 4;
    static constexpr std::uint16_t none = 0xffff;
    T worth_sharing = T(12);  ///< in tolerances, from a box's middle to its corners

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
        std::array<Vec3<T>, most> asked;
        std::array<T, most> answered;
        for (std::size_t q = 0; q < queries_; ++q) asked[q] = points[queried_[q]];
        shadow_.visibility(asked.data(), queries_, answered.data());
        for (std::size_t i = 0; i < count; ++i)
            if (answered_by_[i] != none) result[i] = answered[answered_by_[i]];
        return queries_;
    }

    Box3<T> box_of(std::size_t first, std::size_t count) const {
        Box3<T> box = {points_[first], points_[first]};
        T all = T(0);  // not finite if any is not, whatever min and max make of it
        for (std::size_t i = first; i < first + count; ++i) {
            const Vec3<T>& p = points_[i];
            box.min = Vec3<T>(p.x < box.min.x ? p.x : box.min.x, p.y < box.min.y ? p.y : box.min.y,
                              p.z < box.min.z ? p.z : box.min.z);
            box.max = Vec3<T>(p.x > box.max.x ? p.x : box.max.x, p.y > box.max.y ? p.y : box.max.y,
                              p.z > box.max.z ? p.z : box.max.z);
            all += std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
        }
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
        for (std::size_t t = first_tile + 1; t < first_tile + tiles; ++t)
            box = {glm::min(box.min, boxes_[t].min), glm::max(box.max, boxes_[t].max)};
        const std::size_t first = first_tile * tile, count = std::min(tiles * tile, all - first);
        const Box3<T> box_ls = seen(box);
        Variation<T> variation;
        if (box_ls.min.z > T(0)) variation = vary_(box_ls, worth_sharing * tolerance_);
        if (variation.known && variation.lit) {
            std::fill_n(result_ + first, count, T(1));
            tell(first, count, PointAnswer::lit);
        } else if (variation.known && count > 1) {
            share_answers(first, count, variation);
        } else if (tiles > 1) {
            for (std::size_t t = first_tile; t < first_tile + tiles; ++t) split(t, 1, all);
        } else {
            for (std::size_t i = first; i < first + count; ++i) ask(i, i);
        }
    }

    /// Puts the points into cells in which visibility changes by no more than the tolerance from the middle to a side,
    /// and asks for the one nearest to the middle; others answer with it if they may.
    void share_answers(std::size_t first, std::size_t count, const Variation<T>& variation) {
        Box3<T> box = empty_box<T>();
        for (std::size_t i = 0; i < count; ++i) {
            turned_[i] = variation.turned(frame_.to_light(points_[first + i]));
            box = extend(box, turned_[i]);
        }
        const Vec3<T> size = box.max - box.min, middle = (box.min + box.max) * T(0.5);
        const T left = tolerance_ - variation.deep * size.z * T(0.5);
        const auto cells_of = [&](T change) {
            return static_cast<std::size_t>(clamp(change / std::max(left, T(1e-3) * tolerance_), T(0), T(15))) + 1;
        };
        const std::size_t columns = cells_of(variation.along * size.x), rows = cells_of(variation.across * size.y);
        std::array<std::uint16_t, 256> chosen;
        std::array<T, 256> nearest;
        chosen.fill(none), nearest.fill(std::numeric_limits<T>::max());
        const auto cell_of = [](T at, T low, T extent, std::size_t cells) {
            const T n = static_cast<T>(cells);
            return static_cast<std::size_t>(clamp(saturated_ratio(at - low, extent) * n, T(0), n - T(0.5)));
        };
        std::array<std::uint8_t, parts * tile> cell;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t x = cell_of(turned_[i].x, box.min.x, size.x, columns);
            const std::size_t y = cell_of(turned_[i].y, box.min.y, size.y, rows), c = y * columns + x;
            const Vec3<T> center(box.min.x + size.x * ((static_cast<T>(x) + T(0.5)) / static_cast<T>(columns)),
                                 box.min.y + size.y * ((static_cast<T>(y) + T(0.5)) / static_cast<T>(rows)), middle.z);
            cell[i] = static_cast<std::uint8_t>(c);
            const T away = variation.change(turned_[i] - center);
            if (away < nearest[c]) nearest[c] = away, chosen[c] = static_cast<std::uint16_t>(i);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t with = chosen[cell[i]];
            const bool may = variation.change(turned_[i] - turned_[with]) <= tolerance_;
            ask(first + i, may ? first + with : first + i);
        }
    }

    /// Has a point answered by another's query, or its own.
    void ask(std::size_t point, std::size_t by) {
        if (asked_at_[by] == none) {
            asked_at_[by] = static_cast<std::uint16_t>(queries_);
            queried_[queries_++] = static_cast<std::uint16_t>(by);
        }
        answered_by_[point] = asked_at_[by];
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
    std::array<Vec3<T>, parts * tile> turned_;
    std::array<std::uint16_t, most> asked_at_, answered_by_, queried_;  ///< of each point; of each query
    std::size_t queries_ = 0;
};

}  // namespace detail
}  // namespace penumbra
