// Plans: what to simulate of a method for one scene, and how wrong that can be.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <penumbra/plan/candidates.hpp>
#include <penumbra/plan/scene_extents.hpp>
#include <penumbra/plan/selection.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <penumbra/umbra_volume/shadow.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// What a plan is made from besides the scene.
template <class Shadow>
struct PlanSettings {
    using Real = typename Shadow::Real;

    typename Shadow::Options full = {};  ///< every effect that may be simulated
    /// World units: what a point stands for. Where all penumbrae are narrower they are left out, and within this
    /// distance of a shadow's border the bound does not hold. 0: a point is a point.
    Real footprint = Real(0);
    bool casters_receive = true;  ///< whether visibility is asked for on casters as well
    /// The plan of the frame before: what it left out stays out as long as the tolerance allows, and what it did not
    /// comes out only within the share 1 − hysteresis of that. So small movements do not switch effects on and off.
    const Plan<Shadow>* previous = nullptr;
    Real hysteresis = Real(0.1);
};

namespace detail {

template <class T>
RectLight<T> point_like(const RectLight<T>& light) {
    return {light.center, light.half_u * T(1.0 / 1024.0), light.half_v * T(1.0 / 1024.0)};
}
template <class T>
DiskLight<T> point_like(const DiskLight<T>& light) {
    return {light.center, light.normal, light.radius * T(1.0 / 1024.0)};
}
template <class T>
LinearLight<T> point_like(const LinearLight<T>& light) {
    const Vec3<T> middle = light.a * T(0.5) + light.b * T(0.5), half = (light.b - light.a) * T(0.5 / 1024.0);
    return {middle - half, middle + half};
}

/// Whether what a caster hides does not depend on which others there are: images are fitted to all of them.
template <class T>
bool are_separable(const PenumbraWedgeShadow<T>*, const PenumbraWedgeOptions&) {
    return true;
}
template <class T>
bool are_separable(const UmbraVolumeShadow<T>*, const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::edge_sum;
}
template <class T>
bool are_separable(const OcclusionTextureShadow<T>*, const OcclusionTextureOptions&) {
    return false;
}
template <class T>
bool are_separable(const SoftShadowMap<T>*, const SoftShadowMapOptions&) {
    return false;
}

template <class Shadow>
class Planner {
  public:
    using T = typename Shadow::Real;
    using Meshes = std::vector<Mesh<T>>;

    Planner(const Meshes& casters, const typename Shadow::Light& light, const Meshes& receivers, T tolerance,
            const PlanSettings<Shadow>& settings)
        : casters_(casters),
          settings_(settings),
          extents_(scene_extents(casters, light, receivers, settings.casters_receive)) {
        plan_.options = settings.full, plan_.light = light, plan_.tolerance = tolerance;
    }

    /// The plan for the tolerance: up to half of it for what is left out everywhere, the rest for points and tiles.
    Plan<Shadow> make() {
        const Plan<Shadow>* const before = settings_.previous;
        return make([&](std::vector<Candidate<T>>& candidates) {
            return detail::select(candidates, budget(), before ? settings_.hysteresis : T(0), [&](const auto& one) {
                if (!before) return true;
                if (one.effect != Effect::casters) return !before->simulates(one.effect);
                return !std::binary_search(before->casters.begin(), before->casters.end(), one.caster);
            });
        });
    }
    /// The plan without what select(candidates) marks as out; it returns what that loses.
    template <class Select>
    Plan<Shadow> make(const Select& select) {
        CandidateSearch<T> search{casters_, extents_, budget(), {}};
        find_casters(search);
        find_penumbra(search);
        find_candidates(settings_.full, search);
        plan_.bound = select(search.found);
        keep_casters(search.found);
        for (const Candidate<T>& candidate : search.found) {
            if (candidate.effect == Effect::casters) continue;
            plan_.decisions.push_back(
                {candidate.effect, !candidate.out, candidate.loss, T(0), candidate.reason, candidate.number});
            if (candidate.out) leave_out(candidate);
        }
        decide_at_points();
        std::stable_sort(plan_.decisions.begin(), plan_.decisions.end(),
                         [](const auto& a, const auto& b) { return a.effect < b.effect; });
        return std::move(plan_);
    }

  private:
    T budget() const { return plan_.tolerance * T(0.5); }

    void find_casters(CandidateSearch<T>& search) const {
        if (are_separable(static_cast<const Shadow*>(nullptr), settings_.full)) {
            for (std::size_t i = 0; i < casters_.size(); ++i)
                search.found.push_back({Effect::casters, extents_.hidden[i], "", T(0), i});
        } else if (!casters_.empty()) {
            search.found.push_back({Effect::casters, extents_.total_hidden(), "", T(0), casters_.size()});
        }
    }
    void find_penumbra(CandidateSearch<T>& search) const {
        const T width = extents_.widest_penumbra();
        search.add(Effect::penumbra, width <= settings_.footprint ? T(0) : T(1), "the widest penumbra measures %s",
                   width);
    }

    void keep_casters(const std::vector<Candidate<T>>& found) {
        std::vector<bool> out(casters_.size(), false);
        T lost = T(0), least_kept = T(1);
        for (const Candidate<T>& candidate : found) {
            if (candidate.effect != Effect::casters) continue;
            if (!candidate.out) {
                least_kept = std::min(least_kept, candidate.loss);
                continue;
            }
            lost += candidate.loss;
            if (candidate.caster < out.size())
                out[candidate.caster] = true;
            else
                out.assign(out.size(), true);
        }
        for (std::size_t i = 0; i < casters_.size(); ++i)
            if (!out[i]) plan_.casters.push_back(i);
        const std::size_t left_out = casters_.size() - plan_.casters.size();
        if (left_out > 0)
            plan_.decisions.push_back({Effect::casters, false, lost, T(0),
                                       "what %s casters hide of the light is too little or out of sight",
                                       static_cast<T>(left_out)});
        else
            plan_.decisions.push_back({Effect::casters, true, least_kept, T(0),
                                       "each hides at least %s of the light from some receiver", least_kept});
    }

    void leave_out(const Candidate<T>& candidate) {
        if (candidate.effect == Effect::penumbra) plan_.light = point_like(plan_.light);
        if constexpr (std::is_same_v<Shadow, OcclusionTextureShadow<T>>)
            if (candidate.effect == Effect::slices) plan_.options.slices = static_cast<int>(candidate.number);
        detail::leave_out(candidate.effect, plan_.options);
    }

    /// What is left of the tolerance is lost at a point either because masks are left out there or because a neighbour
    /// answers for it, which it does only where nothing overlaps.
    void decide_at_points() {
        const T left = std::max(plan_.tolerance - plan_.bound, T(0));
        if constexpr (std::is_same_v<Shadow, PenumbraWedgeShadow<T>> || std::is_same_v<Shadow, UmbraVolumeShadow<T>>) {
            if (decides_at_points(plan_.options)) {
                plan_.options.tolerance = std::max(plan_.options.tolerance, static_cast<float>(std::min(left, T(1))));
                for (auto& decision : plan_.decisions)
                    if (decision.effect == Effect::overlap) decision.share = left;
            }
        }
        plan_.tile_tolerance = left;
        plan_.bound += left;
        plan_.decisions.push_back(
            {Effect::every_point, true, T(1), left, "of neighbours that differ by up to %s one is asked", left});
    }

    const Meshes& casters_;
    const PlanSettings<Shadow>& settings_;
    SceneExtents<T> extents_;
    Plan<Shadow> plan_;
};

}  // namespace detail

/// Which effects a scene calls for: those without which visibility might change by more than `tolerance` at one of the
/// receivers. Of others those whose loss is smallest are left out first, as long as all losses together stay within the
/// tolerance; each loss is a limit from boxes around casters and receivers, so that planning takes a hundredth of
/// building. |planned − full| ≤ bound ≤ tolerance, up to rounding, 1e-4.
/// Visibility is asked for on receivers, and on casters unless settings say otherwise; if on neither, anywhere.
/// Stable: a larger tolerance never simulates more; see PlanSettings for scenes that move. Reports a light and options
/// out of their domain, and a tolerance below 0 or not finite, by name; meshes are the shadow's to check.
template <class Shadow>
Plan<Shadow> plan_for(const std::vector<Mesh<typename Shadow::Real>>& casters, const typename Shadow::Light& light,
                      const std::vector<Mesh<typename Shadow::Real>>& receivers, typename Shadow::Real tolerance,
                      const PlanSettings<Shadow>& settings = {}) {
    const auto is_share = [&] { return is_finite(tolerance) && tolerance >= typename Shadow::Real(0); };
    const auto message = [&] {
        return "tolerance = " + detail::text(static_cast<double>(tolerance)) + " is not a finite number ≥ 0";
    };
    if (!validate(settings.full) || !validate(light) || !detail::require(is_share(), message)) return {};
    return detail::Planner<Shadow>(casters, light, receivers, tolerance, settings).make();
}

/// The plan of the most accurate method for the light.
template <class T>
Plan<PenumbraWedgeShadow<T>> plan(const std::vector<Mesh<T>>& casters, const RectLight<T>& light,
                                  const std::vector<Mesh<T>>& receivers, T tolerance,
                                  const PlanSettings<PenumbraWedgeShadow<T>>& settings = {}) {
    return plan_for(casters, light, receivers, tolerance, settings);
}
template <class T>
Plan<UmbraVolumeShadow<T>> plan(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light,
                                const std::vector<Mesh<T>>& receivers, T tolerance,
                                const PlanSettings<UmbraVolumeShadow<T>>& settings = {}) {
    return plan_for(casters, light, receivers, tolerance, settings);
}
template <class T>
Plan<SoftShadowMap<T>> plan(const std::vector<Mesh<T>>& casters, const LinearLight<T>& light,
                            const std::vector<Mesh<T>>& receivers, T tolerance,
                            const PlanSettings<SoftShadowMap<T>>& settings = {}) {
    return plan_for(casters, light, receivers, tolerance, settings);
}
/// The plan of another method, by its settings.
template <class T>
Plan<OcclusionTextureShadow<T>> plan(const std::vector<Mesh<T>>& casters, const RectLight<T>& light,
                                     const std::vector<Mesh<T>>& receivers, T tolerance,
                                     const PlanSettings<OcclusionTextureShadow<T>>& settings) {
    return plan_for(casters, light, receivers, tolerance, settings);
}

}  // namespace penumbra
