// Bounds of values and of their gradients over a box of points, and what combining occlusions makes of them.
//
// Functions that are continuous, and differentiable but on few surfaces, change between two points of a convex box by
// step · g, with a g within the bounds of their gradients. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <penumbra/combine.hpp>

namespace penumbra::detail {

/// All values from low to high.
template <class T>
struct ValueRange {
    T low = T(0), high = T(0);

    friend ValueRange operator+(const ValueRange& a, const ValueRange& b) { return {a.low + b.low, a.high + b.high}; }
    friend ValueRange operator-(const ValueRange& a, const ValueRange& b) { return {a.low - b.high, a.high - b.low}; }
    friend ValueRange operator*(const ValueRange& a, const ValueRange& b) {
        const T ll = a.low * b.low, lh = a.low * b.high, hl = a.high * b.low, hh = a.high * b.high;
        return {std::min(std::min(ll, lh), std::min(hl, hh)), std::max(std::max(ll, lh), std::max(hl, hh))};
    }
    friend ValueRange operator*(const ValueRange& a, T positive) { return {a.low * positive, a.high * positive}; }
    /// Around both.
    friend ValueRange join(const ValueRange& a, const ValueRange& b) {
        return {std::min(a.low, b.low), std::max(a.high, b.high)};
    }
};

template <class T>
ValueRange<T> between(T a, T b) {
    return {std::min(a, b), std::max(a, b)};
}

/// Bounds of a value and of its gradient in light space.
template <class T>
struct Trend {
    ValueRange<T> value;
    std::array<ValueRange<T>, 3> gradient{};

    static Trend constant(T value) { return {{value, value}, {}}; }
    friend Trend operator+(const Trend& a, const Trend& b) {
        Trend sum{a.value + b.value, {}};
        for (std::size_t k = 0; k < 3; ++k) sum.gradient[k] = a.gradient[k] + b.gradient[k];
        return sum;
    }
    friend Trend operator*(const Trend& a, T positive) {
        Trend result{a.value * positive, {}};
        for (std::size_t k = 0; k < 3; ++k) result.gradient[k] = a.gradient[k] * positive;
        return result;
    }
    friend Trend operator*(const Trend& a, const Trend& b) {
        Trend product{a.value * b.value, {}};
        for (std::size_t k = 0; k < 3; ++k) product.gradient[k] = a.gradient[k] * b.value + a.value * b.gradient[k];
        return product;
    }
    Trend complement() const { return constant(T(1)) + negative(); }
    Trend negative() const {
        Trend result{{-value.high, -value.low}, {}};
        for (std::size_t k = 0; k < 3; ++k) result.gradient[k] = {-gradient[k].high, -gradient[k].low};
        return result;
    }
    friend Trend join(const Trend& a, const Trend& b) {
        Trend result{join(a.value, b.value), {}};
        for (std::size_t k = 0; k < 3; ++k) result.gradient[k] = join(a.gradient[k], b.gradient[k]);
        return result;
    }
    friend Trend larger(const Trend& a, const Trend& b) {
        if (a.value.low >= b.value.high) return a;
        if (b.value.low >= a.value.high) return b;
        Trend result{{std::max(a.value.low, b.value.low), std::max(a.value.high, b.value.high)}, {}};
        for (std::size_t k = 0; k < 3; ++k) result.gradient[k] = join(a.gradient[k], b.gradient[k]);
        return result;
    }
    friend Trend lesser(const Trend& a, const Trend& b) { return larger(a.complement(), b.complement()).complement(); }
    Trend up_to_one() const { return value.high <= T(1) ? *this : lesser(*this, constant(T(1))); }
    Trend at_least_zero() const { return value.low >= T(0) ? *this : larger(*this, constant(T(0))); }
};

/// Casters' occlusion of a cell of the light, slice by slice, as OcclusionAccumulator has it of a point.
template <class T>
struct OcclusionTrend {
    Trend<T> transmission = Trend<T>::constant(T(1)), total{}, largest{};

    void add(const Trend<T>& blocked, Combination rule) {
        if (rule == Combination::product) transmission = transmission * blocked.complement();
        if (rule == Combination::sum || rule == Combination::mean) total = total + blocked;
        if (rule == Combination::max || rule == Combination::mean) largest = larger(largest, blocked);
    }
    Trend<T> result(Combination rule) const {
        switch (rule) {
            case Combination::product:
                return transmission.complement();
            case Combination::sum:
                return total.up_to_one();
            case Combination::max:
                return largest;
            case Combination::mean:
                break;
        }
        return (total.up_to_one() + largest) * T(0.5);
    }
};

}  // namespace penumbra::detail
