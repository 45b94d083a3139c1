// Intervals of a line light that are hidden from a point, and their union: sorted and exact, or as a mask of cells.
//
// Positions on the light are shares of it, 0 at one end and 1 at the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/numeric.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>

namespace penumbra {

/// Shares of a light from low to high; empty unless low < high.
template <class T>
struct LightInterval {
    T low, high;
};

/// What the segment from a to b hides from `point` of a light between the positions `first` and `last`, world units
/// from its centre, first ≤ last. Only what is nearer to the light than the point hides. Empty if nothing is hidden. A
/// light of no length is hidden as a whole or not at all; a point on the segment loses what lies to one side, or
/// nothing. Error: 4 ε · (|slopes| + |positions| inverse depth) over the difference of inverse depths and the light's
/// length.
template <class T>
LightInterval<T> hidden_interval(const RowPoint<T>& a, const RowPoint<T>& b, const RowPoint<T>& point, T first,
                                 T last) {
    const T nearer_a = a.inverse_depth - point.inverse_depth, nearer_b = b.inverse_depth - point.inverse_depth;
    if (!(nearer_a > T(0)) && !(nearer_b > T(0))) return {T(1), T(0)};
    const T side_a = a.slope - point.slope, side_b = b.slope - point.slope, length = last - first;
    const T at_a = saturated_ratio(side_a - first * nearer_a, length * nearer_a);
    const T at_b = saturated_ratio(side_b - first * nearer_b, length * nearer_b);
    if (nearer_a > T(0) && nearer_b > T(0)) return {at_a < at_b ? at_a : at_b, at_a < at_b ? at_b : at_a};
    // one end is behind the point: towards where the segment passes it, the interval goes on beyond the light
    const T at = nearer_a > T(0) ? at_a : at_b;
    const T passes = nearer_a > T(0) ? side_b * nearer_a - side_a * nearer_b : side_a * nearer_b - side_b * nearer_a;
    return passes == T(0) ? LightInterval<T>{T(1), T(0)}
                          : (passes > T(0) ? LightInterval<T>{at, T(1)} : LightInterval<T>{T(0), at});
}

/// A union of intervals, sorted. Exact up to `capacity` intervals with gaps between them; of more, those with the
/// smallest gap become one, which hides that gap.
template <class T>
class LightUnion {
  public:
    static constexpr int capacity = 16;

    /// Adds an interval within [0, 1], or nothing if it is empty.
    void add(const LightInterval<T>& interval) {
        if (!(interval.low < interval.high)) return;
        T low = interval.low, high = interval.high;
        int first = 0;  // the first that ends at or after low; from there on, all that begin up to high are united
        while (first < count_ && parts_[at(first)].high < low) ++first;
        int last = first;
        for (; last < count_ && !(parts_[at(last)].low > high); ++last) {
            low = parts_[at(last)].low < low ? parts_[at(last)].low : low;
            high = parts_[at(last)].high > high ? parts_[at(last)].high : high;
        }
        const int change = 1 - (last - first);
        if (change > 0)
            for (int i = count_; i > first; --i) parts_[at(i)] = parts_[at(i - 1)];
        if (change < 0)
            for (int i = last; i < count_; ++i) parts_[at(i + change)] = parts_[at(i)];
        parts_[at(first)] = {low, high};
        count_ += change;
        if (count_ > capacity) close_smallest_gap();
    }
    /// The share of the light that is hidden, in [0, 1]; may round to 1 before is_full(). Error: a rounding an
    /// interval.
    T share() const {
        T sum = T(0);
        for (int i = 0; i < count_; ++i) sum += parts_[at(i)].high - parts_[at(i)].low;
        return saturate(sum);
    }
    /// True if all of the light is hidden.
    bool is_full() const { return count_ == 1 && parts_[0].low <= T(0) && parts_[0].high >= T(1); }

  private:
    static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }
    void close_smallest_gap() {
        int best = 0;
        for (int i = 1; i + 1 < count_; ++i)
            if (parts_[at(i + 1)].low - parts_[at(i)].high < parts_[at(best + 1)].low - parts_[at(best)].high) best = i;
        parts_[at(best)].high = parts_[at(best + 1)].high;
        for (int i = best + 1; i + 1 < count_; ++i) parts_[at(i)] = parts_[at(i + 1)];
        --count_;
    }

    std::array<LightInterval<T>, capacity + 1> parts_{};
    int count_ = 0;
};

/// A union of intervals as 128 cells of the light, each hidden or not by its centre. RMS error of one interval 1 / 313,
/// at most 1 / 128; none at the light's ends.
template <class T>
class LightMask {
  public:
    static constexpr int cells = 128;

    /// Hides the cells whose centres lie in an interval.
    void add(const LightInterval<T>& interval) {
        if (!(interval.low < interval.high)) return;
        const int first = first_cell(interval.low), end = first_cell(interval.high);
        for (int word = 0; word < 4; ++word)
            words_[static_cast<std::size_t>(word)] |= cells_below(end - 32 * word) & ~cells_below(first - 32 * word);
    }
    /// The share of the light that is hidden, in [0, 1].
    T share() const {
        int sum = 0;
        for (std::uint32_t word : words_) {
            word -= (word >> 1) & 0x55555555U;
            word = (word & 0x33333333U) + ((word >> 2) & 0x33333333U);
            sum += static_cast<int>((((word + (word >> 4)) & 0x0f0f0f0fU) * 0x01010101U) >> 24);
        }
        return static_cast<T>(sum) / T(cells);
    }
    /// True if all of the light is hidden.
    bool is_full() const { return (words_[0] & words_[1] & words_[2] & words_[3]) == 0xffffffffU; }

  private:
    /// The first cell whose centre is at or after a share of the light.
    static int first_cell(T share) { return static_cast<int>(clamp(share, T(0), T(1)) * T(cells) + T(0.5)); }
    static std::uint32_t cells_below(int end) { return end <= 0 ? 0U : end >= 32 ? 0xffffffffU : (1U << end) - 1U; }

    std::array<std::uint32_t, 4> words_{};
};

}  // namespace penumbra
