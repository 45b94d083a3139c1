// Which of a few points answer for the others, where it is known how visibility changes between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>

namespace penumbra::detail {

/// Points in cells in which visibility changes by no more than a tolerance from the middle to a side. The one nearest
/// to a middle answers for those of its cell that differ little enough from it. Source: ours.
template <class T>
class SharedCells {
  public:
    static constexpr std::size_t capacity = 256;

    /// Of points in world space, at most `capacity`; `variation` is known of a box around them. False if that takes
    /// more than `most_used` cells.
    bool divide(const LightFrame<T>& frame, const Vec3<T>* points, std::size_t count, const Variation<T>& variation,
                T tolerance, std::size_t most_used) {
        turn(frame, points, count, variation.direction);
        const Vec2<T> in_x = range(x_, count), in_y = range(y_, count), in_z = range(z_, count);
        const T left =
            std::max(tolerance - variation.turning - variation.deep * (in_z.y - in_z.x) * T(0.5), T(1e-3) * tolerance);
        const Cells cells =
            fewest_cells(variation.along * (in_x.y - in_x.x), variation.across * (in_y.y - in_y.x), left);
        if (static_cast<std::size_t>(cells.columns * cells.rows) > most_used) return false;
        choose({Vec3<T>(in_x.x, in_y.x, in_z.x), Vec3<T>(in_x.y, in_y.y, in_z.y)}, cells, count, variation);
        const Vec3<T> slope = variation.turned(variation.slope);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t with = chosen_[cell_[i]];
            const Vec3<T> way(x_[i] - x_[with], y_[i] - y_[with], z_[i] - z_[with]);
            away_[i] = variation.change(way);
            step_[i] = slope.x * way.x + slope.y * way.y + slope.z * way.z;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const bool may = away_[i] <= tolerance;
            asked_for_[i] = may ? chosen_[cell_[i]] : static_cast<std::uint16_t>(i);
            step_[i] = may ? step_[i] : T(0);
        }
        return true;
    }

    /// Whose visibility answers for a point: another's, or its own.
    std::size_t asked_for(std::size_t i) const { return asked_for_[i]; }
    /// By how much a point's visibility differs from that.
    T step(std::size_t i) const { return step_[i]; }

  private:
    static constexpr int most_cells = 16;    ///< along an axis
    static constexpr T smallest = T(1e-30);  ///< what extents are taken for that are none
    using Values = std::array<T, capacity>;

    /// Places in the frame in which doubts are bounded.
    void turn(const LightFrame<T>& frame, const Vec3<T>* points, std::size_t count, const Vec2<T>& direction) {
        const Vec3<T> along = frame.u * direction.x + frame.v * direction.y,
                      across = frame.v * direction.x - frame.u * direction.y;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3<T> from = points[i] - frame.origin;
            x_[i] = from.x * along.x + from.y * along.y + from.z * along.z;
            y_[i] = from.x * across.x + from.y * across.y + from.z * across.z;
            z_[i] = from.x * frame.normal.x + from.y * frame.normal.y + from.z * frame.normal.z;
        }
    }
    /// From least to greatest, eight at a time, so that it vectorises.
    static Vec2<T> range(const std::array<T, capacity>& values, std::size_t count) {
        constexpr std::size_t lanes = 8;
        std::array<T, lanes> low, high;
        low.fill(values[0]), high.fill(values[0]);
        std::size_t i = 0;
        for (; i + lanes <= count; i += lanes) {
            for (std::size_t j = 0; j < lanes; ++j) {
                low[j] = values[i + j] < low[j] ? values[i + j] : low[j];
                high[j] = values[i + j] > high[j] ? values[i + j] : high[j];
            }
        }
        for (; i < count; ++i) low[0] = std::min(low[0], values[i]), high[0] = std::max(high[0], values[i]);
        return Vec2<T>(*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end()));
    }

    struct Cells {
        int columns, rows;
    };
    /// Cells from whose middles to corners no more than `doubtful` is in doubt, of what is from side to side.
    static Cells fewest_cells(T along, T across, T doubtful) {
        Cells best = {most_cells, most_cells};
        for (int rows = 1; rows <= most_cells && rows < best.columns * best.rows; ++rows) {
            const T rest = T(2) * doubtful - across / static_cast<T>(rows);
            if (!(rest > T(0))) continue;
            const T columns = along / rest;
            if (!(columns < static_cast<T>(most_cells))) continue;
            const Cells cells = {static_cast<int>(columns) + 1, rows};
            if (cells.columns * cells.rows < best.columns * best.rows) best = cells;
        }
        return best;
    }
    /// The points nearest to the middles of cells of a box.
    void choose(const Box3<T>& box, const Cells& cells, std::size_t count, const Variation<T>& variation) {
        const int columns = cells.columns, rows = cells.rows;
        const T width = std::max(box.max.x - box.min.x, smallest) / static_cast<T>(columns);
        const T height = std::max(box.max.y - box.min.y, smallest) / static_cast<T>(rows);
        const T per_width = T(1) / width, per_height = T(1) / height, middle_z = (box.min.z + box.max.z) * T(0.5);
        for (std::size_t i = 0; i < count; ++i) {
            const int column = std::min(static_cast<int>((x_[i] - box.min.x) * per_width), columns - 1);
            const int row = std::min(static_cast<int>((y_[i] - box.min.y) * per_height), rows - 1);
            cell_[i] = static_cast<std::uint32_t>(row * columns + column);
            const T from_x = x_[i] - (box.min.x + width * (static_cast<T>(column) + T(0.5)));
            const T from_y = y_[i] - (box.min.y + height * (static_cast<T>(row) + T(0.5)));
            away_[i] = variation.change(Vec3<T>(from_x, from_y, z_[i] - middle_z));
        }
        std::array<T, most_cells * most_cells> nearest;
        std::fill_n(chosen_.begin(), columns * rows, std::uint16_t(0));
        std::fill_n(nearest.begin(), columns * rows, std::numeric_limits<T>::max());
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t c = cell_[i];
            const bool is_nearer = away_[i] < nearest[c];
            nearest[c] = is_nearer ? away_[i] : nearest[c];
            chosen_[c] = is_nearer ? static_cast<std::uint16_t>(i) : chosen_[c];
        }
    }

    Values x_{}, y_{}, z_{}, away_{}, step_{};
    std::array<std::uint32_t, capacity> cell_{};
    std::array<std::uint16_t, capacity> asked_for_{};
    std::array<std::uint16_t, most_cells * most_cells> chosen_{};  ///< of each cell
};

}  // namespace penumbra::detail
