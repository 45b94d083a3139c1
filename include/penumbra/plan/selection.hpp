// Which effects a tolerance pays for: those whose loss is cheapest go first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/plan/effect.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// What to simulate of one method, for one scene.
template <class Shadow>
struct Plan {
    using Real = typename Shadow::Real;

    typename Shadow::Options options;
    typename Shadow::Light light;                 ///< shrunk to a point, in effect, where penumbrae are left out
    std::vector<std::size_t> casters;             ///< the meshes whose shadows are simulated
    Real tolerance = Real(0);                     ///< what was asked for
    Real bound = Real(0);                         ///< |planned − full| is no more, at any receiver
    Real tile_tolerance = Real(0);                ///< of it, what neighbours that share a query may differ
                                                   ///< by; negative: none share
    std::vector<EffectDecision<Real>> decisions;  ///< in the order of Effect

    /// Whether the effect is simulated, at least where it may matter. True for what the method does not have.
    bool simulates(Effect effect) const {
        for (const EffectDecision<Real>& decision : decisions)
            if (decision.effect == effect) return decision.simulated;
        return true;
    }
    /// One line for each effect: what was decided, and why.
    std::string text() const {
        std::string result;
        for (const EffectDecision<Real>& decision : decisions) result += decision.text() + "\n";
        return result;
    }
};

namespace detail {

/// What may be left out.
template <class T>
struct Candidate {
    Effect effect;
    T loss;
    const char* reason;
    T number;
    std::size_t caster = 0;       ///< Effect::casters
    bool has_own_budget = false;  ///< and is within it
    bool out = false;
};

/// Marks the cheapest of these candidates whose losses together are at most `budget`. What `was_out` keeps its place up
/// to the whole budget, others come out only within the share 1 − hysteresis of it. Returns the losses' sum.
template <class T, class WasOut>
T select(std::vector<Candidate<T>*> candidates, T budget, T hysteresis, const WasOut& was_out) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate<T>* a, const Candidate<T>* b) { return a->loss < b->loss; });
    T sum = T(0);
    for (Candidate<T>* const candidate : candidates) {
        const T most = was_out(*candidate) ? budget : budget * (T(1) - hysteresis);
        candidate->out = sum + candidate->loss <= most;
        if (candidate->out) sum += candidate->loss;
    }
    return sum;
}

}  // namespace detail
}  // namespace penumbra
