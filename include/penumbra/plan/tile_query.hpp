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
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/numeric.hpp>
#include <penumbra/plan/shared_cells.hpp>
#include <penumbra/plan/tile_box.hpp>
#include <utility>

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
    /// `tolerance`: negative, if not even neighbours that surely see the same may share an answer. `effort`: of finding
    /// a variation, in queries, roughly.
    TileQuery(const Shadow& shadow, const Vary& vary, const LightFrame<T>& frame, T tolerance, std::size_t effort)
        : shadow_(shadow), vary_(vary), frame_(frame), tolerance_(tolerance), effort_(effort) {}

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
    static constexpr std::size_t most = 1024, tile = 64, parts = SharedCells<T>::capacity / tile;
    static constexpr std::size_t fewest = 4;  ///< that are answered together
    /// In which points share answers, in efforts; where it takes more, parts of them are tried.
    static constexpr std::size_t most_cells_of_tiles = 20, most_cells_of_tile = 32;
    static constexpr int most_gaps = 3;  ///< at which a part of a tile is split
    static constexpr std::uint16_t none = 0xffff;
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
            boxes_[t] = box_of(points + first, std::min(tile, count - first));
            if (!is_finite(boxes_[t].min) || !is_finite(boxes_[t].max)) {
                ask_all(points, count, result, answers);
                return count;
            }
        }
        for (std::size_t t = 0; t < tiles;) {
            const std::size_t many = std::min(tiles - t, parts);
            const bool together = untried_ == 0;
            if (!together) --untried_;
            for (std::size_t part = t; !together && part < t + many; ++part) split(part, 1, count);
            if (together) split(t, many, count);
            t += many;
        }
        for (std::size_t q = 0; q < queries_; ++q) asked_[q] = points[queried_[q]];
        shadow_.visibility(asked_.data(), queries_, answered_.data());
        for (std::size_t i = 0; i < count; ++i)
            if (answered_by_[i] != none) result[i] = saturate(answered_[answered_by_[i]] + steps_[i]);
        return queries_;
    }

    /// Points that are answered together if they can be: a run of the batch, or some from anywhere in it.
    struct Group {
        const Vec3<T>* points;
        std::size_t count, first;
        const std::uint16_t* places;  ///< in the batch; if null, from the first on

        std::size_t place(std::size_t i) const { return places ? places[i] : first + i; }
    };

    /// Answers the points of some tiles: together if that can be, else tile by tile, part by part, point by point.
    void split(std::size_t first_tile, std::size_t tiles, std::size_t all) {
        Box3<T> box = boxes_[first_tile];
        for (std::size_t t = first_tile + 1; t < first_tile + tiles; ++t) box = join(box, boxes_[t]);
        const std::size_t first = first_tile * tile, count = std::min(tiles * tile, all - first);
        const Group group{points_ + first, count, first, nullptr};
        if (tiles == 1) {
            answer(group, box, most_gaps);
        } else if (answer_together(group, box, most_cells_of_tiles * effort_)) {
            failures_ = 0;
        } else {
            failures_ = std::min<std::size_t>(2 * failures_ + 1, 15);
            untried_ = failures_;
            for (std::size_t t = first_tile; t < first_tile + tiles; ++t) split(t, 1, all);
        }
    }
    void answer(const Group& group, const Box3<T>& box, int gaps) {
        if (group.count >= fewest) {
            if (answer_together(group, box, most_cells_of_tile * effort_)) return;
            if (gaps > 0 && split_at_gap(group, box, gaps)) return;
            if (!group.places && group.count == tile) {
                for (std::size_t k = 0; k < 4; ++k) {
                    const Group part{group.points + k * tile / 4, tile / 4, group.first + k * tile / 4, nullptr};
                    answer(part, box_of(part.points, part.count), 0);
                }
                return;
            }
        }
        for (std::size_t i = 0; i < group.count; ++i) assign(group.place(i), query(group.place(i)), T(0));
    }
    /// False if not known well enough for that many cells to do.
    bool answer_together(const Group& group, const Box3<T>& box, std::size_t most_used) {
        const Box3<T> box_ls = seen_from(frame_, box);
        Variation<T> variation;
        const T most_known = group.count >= 2 * effort_ ? worth_sharing * tolerance_ : T(0);
        if (box_ls.min.z > T(0)) variation = vary_(box_ls, most_known, group.points, group.count);
        if (!variation.known) return false;
        if (variation.lit) {
            see_all(group);
            return true;
        }
        if (doubt(variation, box_ls) <= tolerance_) {
            share_answer(group, group.count / 2, variation.slope);
            return true;
        }
        return tolerance_ > T(0) && share_answers(group, variation, most_used);
    }
    void see_all(const Group& group) {
        if (group.places)
            for (std::size_t i = 0; i < group.count; ++i) result_[group.places[i]] = T(1);
        else
            std::fill_n(result_ + group.first, group.count, T(1));
        tell(group, PointAnswer::lit);
    }
    /// Points of a tile that see two surfaces, one before the other, are answered by surface. False if there is no gap.
    bool split_at_gap(const Group& group, const Box3<T>& box, int gaps) {
        const Vec3<T> size = box.max - box.min;
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        const T middle = (box.min[axis] + box.max[axis]) * T(0.5);
        T below = box.min[axis], above = box.max[axis];
        for (std::size_t i = 0; i < group.count; ++i) {
            const T at = group.points[i][axis];
            below = at <= middle && at > below ? at : below;
            above = at > middle && at < above ? at : above;
        }
        if (!(above - below > size[axis] * T(0.5))) return false;
        std::array<Vec3<T>, tile> points;
        std::array<std::uint16_t, tile> places;
        std::size_t near = 0, far = group.count;
        for (std::size_t i = 0; i < group.count; ++i) {
            const std::size_t to = group.points[i][axis] <= middle ? near++ : --far;
            points[to] = group.points[i], places[to] = static_cast<std::uint16_t>(group.place(i));
        }
        for (const auto& [first, end] : {std::pair(std::size_t(0), near), std::pair(near, group.count)}) {
            Box3<T> part{points[first], points[first]};
            for (std::size_t i = first; i < end; ++i)
                part = {glm::min(part.min, points[i]), glm::max(part.max, points[i])};
            answer({&points[first], end - first, 0, &places[first]}, part, gaps - 1);
        }
        return true;
    }

    /// By how much two points of the box may differ from the slope.
    static T doubt(const Variation<T>& variation, const Box3<T>& box_ls) {
        const Vec3<T> size = box_ls.max - box_ls.min;
        const Vec2<T> d(std::abs(variation.direction.x), std::abs(variation.direction.y));
        return variation.change(Vec3<T>(size.x * d.x + size.y * d.y, size.x * d.y + size.y * d.x, size.z));
    }

    /// Asks for one point of each cell of them; false if that takes more cells.
    bool share_answers(const Group& group, const Variation<T>& variation, std::size_t most_used) {
        if (!cells_.divide(frame_, group.points, group.count, variation, tolerance_, most_used)) return false;
        for (std::size_t i = 0; i < group.count; ++i)
            assign(group.place(i), query(group.place(cells_.asked_for(i))), cells_.step(i));
        return true;
    }
    /// Has all points answered by the query of one.
    void share_answer(const Group& group, std::size_t by, const Vec3<T>& slope_ls) {
        const Vec3<T> from = group.points[by];
        const Vec3<T> slope = frame_.u * slope_ls.x + frame_.v * slope_ls.y + frame_.normal * slope_ls.z;
        const std::uint16_t asked = query(group.place(by));
        if (group.places) {
            for (std::size_t i = 0; i < group.count; ++i)
                assign(group.places[i], asked, glm::dot(slope, group.points[i] - from));
        } else {
            T* const steps = &steps_[group.first];
            for (std::size_t i = 0; i < group.count; ++i) steps[i] = glm::dot(slope, group.points[i] - from);
            std::fill_n(&answered_by_[group.first], group.count, asked);
        }
        tell(group, PointAnswer::shared);
        if (answers_) answers_[group.place(by)] = PointAnswer::own;
    }
    /// The query of a point: which of all it is.
    std::uint16_t query(std::size_t point) {
        if (asked_at_[point] == none) {
            asked_at_[point] = static_cast<std::uint16_t>(queries_);
            queried_[queries_++] = static_cast<std::uint16_t>(point);
        }
        return asked_at_[point];
    }
    /// Has a point answered by a query, from which its visibility differs by `step`.
    void assign(std::size_t point, std::uint16_t query, T step) {
        answered_by_[point] = query, steps_[point] = step;
        if (answers_) answers_[point] = queried_[query] == point ? PointAnswer::own : PointAnswer::shared;
    }
    void tell(const Group& group, PointAnswer how) {
        if (!answers_) return;
        for (std::size_t i = 0; i < group.count; ++i) answers_[group.place(i)] = how;
    }

    const Shadow& shadow_;
    const Vary& vary_;
    const LightFrame<T>& frame_;
    T tolerance_;
    std::size_t effort_;
    const Vec3<T>* points_ = nullptr;
    T* result_ = nullptr;
    PointAnswer* answers_ = nullptr;
    std::array<Box3<T>, most / tile> boxes_;
    SharedCells<T> cells_;
    std::array<std::uint16_t, most> asked_at_, answered_by_, queried_;  ///< of each point; of each query
    std::array<Vec3<T>, most> asked_{};
    std::array<T, most> answered_{};
    std::array<T, most> steps_;  ///< by how much a point's visibility differs from the answer
    std::size_t queries_ = 0;
    std::size_t failures_ = 0, untried_ = 0;  ///< of blocks of tiles: more after each that had to be split
};

}  // namespace detail
}  // namespace penumbra
