// How the occlusions of several casters combine when only their sizes are known, not where they overlap.
//
// With a and b the fractions of the light that two casters block, the fraction that both together block lies
// in [max(a, b), min(1, a + b)]: the low end when one hides the other, the high end when they are disjoint.
// Every rule here stays in that interval.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// Right when the casters' overlap on the light is as random: 1 − (1−a)(1−b). Occlusions in [0, 1] to [0, 1].
/// Evaluated as h + l (1−h) with l ≤ h, which is symmetric, keeps small occlusions, and cannot leave the
/// interval by rounding. Error: 2 ULP. Source: E. Eisemann & X. Décoret, "Plausible image based soft shadows
/// using occlusion textures", 2006, eq. 5.
template <class T>
constexpr T combine_product(T occlusion_a, T occlusion_b) {
    const T high = occlusion_a > occlusion_b ? occlusion_a : occlusion_b;
    const T low = occlusion_a > occlusion_b ? occlusion_b : occlusion_a;
    return saturate(high + low * (T(1) - high));
}

/// Right when the casters block disjoint parts: min(1, a + b).
template <class T>
constexpr T combine_sum(T occlusion_a, T occlusion_b) {
    return saturate(occlusion_a + occlusion_b);
}

/// Right when one caster hides behind the other: max(a, b).
template <class T>
constexpr T combine_max(T occlusion_a, T occlusion_b) {
    return saturate(occlusion_a > occlusion_b ? occlusion_a : occlusion_b);
}

/// The middle of the interval: ½ (max(a, b) + min(1, a + b)). Halves the worst case.
template <class T>
constexpr T combine_mean(T occlusion_a, T occlusion_b) {
    return T(0.5) * (combine_max(occlusion_a, occlusion_b) + combine_sum(occlusion_a, occlusion_b));
}

/// The interval in which the true occlusion of the union lies.
template <class T>
struct OcclusionBounds {
    T lower, upper;
};

template <class T>
constexpr OcclusionBounds<T> occlusion_bounds(T occlusion_a, T occlusion_b) {
    return {combine_max(occlusion_a, occlusion_b), combine_sum(occlusion_a, occlusion_b)};
}

/// The four rules by name.
enum class Combination { product, sum, max, mean };

/// Takes occlusions one at a time, in any order, and gives every rule's answer for all of them together.
/// `mean` is the middle of the interval of all, which is not what pairwise combine_mean gives: that depends
/// on the order.
template <class T>
struct OcclusionAccumulator {
    T transmission = T(1);  ///< Π (1 − occlusion)
    T total = T(0);         ///< Σ occlusion, not clamped
    T largest = T(0);       ///< max occlusion

    /// Adds an occlusion in [0, 1].
    constexpr void add(T occlusion) {
        transmission *= T(1) - occlusion;
        total += occlusion;
        largest = occlusion > largest ? occlusion : largest;
    }
    constexpr OcclusionBounds<T> bounds() const { return {saturate(largest), saturate(total)}; }
    /// The combined occlusion in [0, 1]; 0 if nothing was added.
    constexpr T result(Combination rule) const {
        switch (rule) {
            case Combination::product:
                // the difference loses occlusions below ε, the interval does not
                return clamp(T(1) - transmission, saturate(largest), saturate(total));
            case Combination::sum:
                return saturate(total);
            case Combination::max:
                return saturate(largest);
            case Combination::mean:
                break;
        }
        return T(0.5) * (saturate(largest) + saturate(total));
    }
};

/// The rule applied to `count` occlusions; 0 for none.
template <class T>
constexpr T combine(const T* occlusions, std::size_t count, Combination rule) {
    OcclusionAccumulator<T> all;
    for (std::size_t i = 0; i < count; ++i) all.add(occlusions[i]);
    return all.result(rule);
}

/// The interval for `count` occlusions; [0, 0] for none.
template <class T>
constexpr OcclusionBounds<T> occlusion_bounds(const T* occlusions, std::size_t count) {
    OcclusionAccumulator<T> all;
    for (std::size_t i = 0; i < count; ++i) all.add(occlusions[i]);
    return all.bounds();
}

}  // namespace penumbra
