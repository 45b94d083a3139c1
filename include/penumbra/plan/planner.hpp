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
#include <type_traits>
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

/// Whether what a caster hides does not depend on which others there are. Masks count what is new, in an order that
/// depends on all; rectangles likewise; and images are fitted to all.
inline bool are_separable(const PenumbraWedgeOptions& options) {
    return options.overlap == OverlapRule::additive || options.overlap == OverlapRule::maximum ||
           options.overlap == OverlapRule::product || options.overlap == OverlapRule::product_quadrants;
}
inline bool are_separable(const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::edge_sum && !decides_at_points(options);
}
inline bool are_separable(const OcclusionTextureOptions&) { return false; }
inline bool are_separable(const SoftShadowMapOptions&) { return false; }

/// Texels a side, of methods by images; 0 of others.
inline int image_size(const PenumbraWedgeOptions&) { return 0; }
inline int image_size(const UmbraVolumeOptions& options) {
    return options.mode == DiskMode::d_buffer ? options.resolution : 0;
}
inline int image_size(const OcclusionTextureOptions& options) { return options.resolution; }
inline int image_size(const SoftShadowMapOptions& options) { return options.resolution; }

template <class Shadow>
class Planner {
  public:
    using T = typename Shadow::Real;
    using Meshes = std::vector<Mesh<T>>;

    Planner(const Meshes& casters, const typename Shadow::Light& light, const Meshes& receivers, T tolerance,
            const PlanSettings<Shadow>& settings)
        : casters_(casters),
          settings_(settings),
          extents_(scene_extents(casters, light, receivers, settings.casters_receive, image_size(settings.full))) {
        plan_.options = settings.full, plan_.light = light, plan_.tolerance = tolerance;
    }

    /// The plan for the tolerance: up to an eighth each for slices and for other effects that are left out everywhere,
    /// a quarter for casters, the rest for points and tiles. So what one kind takes does not bring another back.
    Plan<Shadow> make() {
        const Plan<Shadow>* const before = settings_.previous;
        const T hysteresis = before ? settings_.hysteresis : T(0), tolerance = plan_.tolerance;
        const auto select_effects = [&](const Pointers& candidates) {
            return detail::select(candidates, tolerance * T(0.125), hysteresis,
                                  [&](const auto& one) { return !before || !before->simulates(one.effect); });
        };
        const auto select_casters = [&](const Pointers& candidates) {
            return detail::select(candidates, tolerance * caster_budget, hysteresis, [&](const auto& one) {
                return !before || !std::binary_search(before->casters.begin(), before->casters.end(), one.caster);
            });
        };
        return make(select_effects, select_casters);
    }
    /// The plan without what both mark as out; each returns what that loses.
    template <class SelectEffects, class SelectCasters>
    Plan<Shadow> make(const SelectEffects& select_effects, const SelectCasters& select_casters) {
        CandidateSearch<T> search{casters_, extents_, plan_.tolerance * T(0.125), {}};
        find_penumbra(search);
        find_candidates(settings_.full, search);
        plan_.bound = select(search.found, select_effects);
        for (const Candidate<T>& candidate : search.found) {
            plan_.decisions.push_back(
                {candidate.effect, !candidate.out, candidate.loss, T(0), candidate.reason, candidate.number});
            if (candidate.out) leave_out(candidate);
        }
        std::vector<Candidate<T>> casters = find_casters();
        plan_.bound += select(casters, select_casters);
        keep_casters(casters);
        decide_at_points();
        std::stable_sort(plan_.decisions.begin(), plan_.decisions.end(),
                         [](const auto& a, const auto& b) { return a.effect < b.effect; });
        return std::move(plan_);
    }

  private:
    using Pointers = std::vector<Candidate<T>*>;
    static constexpr T caster_budget = T(0.25);  ///< of the tolerance

    template <class Select>
    static T select(std::vector<Candidate<T>>& candidates, const Select& choose) {
        Pointers common;
        T lost = T(0);
        for (Candidate<T>& candidate : candidates) {
            candidate.out = candidate.has_own_budget;
            if (candidate.has_own_budget)
                lost += candidate.loss;
            else
                common.push_back(&candidate);
        }
        return lost + choose(common);
    }

    /// Those that can be left out one by one, or all together. The casters that reach farthest say how near to a face a
    /// point is on it: they stay as long as any does.
    std::vector<Candidate<T>> find_casters() const {
        std::vector<Candidate<T>> found;
        T all = T(0);
        for (std::size_t i = 0; i < casters_.size(); ++i)
            all += image_size(plan_.options) > 0 ? (extents_.hidden[i] > T(0) ? T(1) : T(0))
                                                 : counted(casters_[i], extents_.hidden[i]);
        const bool one_by_one = are_separable(plan_.options) && has_own_frame(plan_.light);
        if (one_by_one && all > plan_.tolerance * caster_budget) {
            const auto [from_light, from_origin] = farthest_casters();
            for (std::size_t i = 0; i < casters_.size(); ++i)
                if (i != from_light && i != from_origin)
                    found.push_back({Effect::casters, counted(casters_[i], extents_.hidden[i]), "", T(0), i});
        } else if (!casters_.empty()) {
            found.push_back({Effect::casters, saturate(all), "", T(0), casters_.size()});
        }
        return found;
    }
    std::pair<std::size_t, std::size_t> farthest_casters() const {
        std::pair<std::size_t, std::size_t> farthest(0, 0);
        T from_light = T(-1), from_origin = T(-1);
        for (std::size_t i = 0; i < casters_.size(); ++i) {
            const Box3<T> box = checked_bounds(casters_[i]);
            if (is_empty(box)) continue;
            const Vec3<T>& light = extents_.frame.origin;
            const T reach = largest_component(farthest_of<T>({box.min - light, box.max - light}));
            const T far = largest_component(farthest_of(box));
            const auto is_farther = [&](T distance, T before, std::size_t other) {  // of equals, what hides more
                return distance > before || (distance >= before && extents_.hidden[i] > extents_.hidden[other]);
            };
            if (is_farther(reach, from_light, farthest.first)) from_light = reach, farthest.first = i;
            if (is_farther(far, from_origin, farthest.second)) from_origin = far, farthest.second = i;
        }
        return farthest;
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
                                       "the least of them hides up to %s of the light from a receiver", least_kept});
    }

    void leave_out(const Candidate<T>& candidate) {
        if (candidate.effect == Effect::penumbra) plan_.light = point_like(plan_.light);
        if constexpr (std::is_same_v<Shadow, OcclusionTextureShadow<T>>)
            if (candidate.effect == Effect::slices) plan_.options.slices = static_cast<int>(candidate.number);
        detail::leave_out(candidate.effect, plan_.options);
    }

    /// What is left of the tolerance is lost at a point because overlaps are left out there or because a neighbour
    /// answers for it: either, where masks decide; for unions both, of which neighbours save more. If full leaves out
    /// overlaps, neighbours of it differ by as much, either way.
    void decide_at_points() {
        const T left = std::max(plan_.tolerance - plan_.bound, T(0));
        T shared = left;
        if constexpr (std::is_same_v<Shadow, PenumbraWedgeShadow<T>> || std::is_same_v<Shadow, UmbraVolumeShadow<T>>) {
            if (decides_at_points(plan_.options)) {
                const bool exact = are_exact(plan_.options);
                const T before = static_cast<T>(plan_.options.tolerance);
                const T overlap = std::max(exact ? left * T(0.03125) : left, before);
                if (exact) shared = left - overlap - before;
                if (exact && before > T(0) && !(shared > T(0))) shared = T(-1);
                plan_.options.tolerance = static_cast<float>(std::min(overlap, T(1)));
                for (auto& decision : plan_.decisions)
                    if (decision.effect == Effect::overlap) decision.share = std::min(overlap, left);
            }
        }
        plan_.tile_tolerance = shared;
        plan_.bound += left;
        const T differ = std::max(shared, T(0));
        plan_.decisions.push_back(
            {Effect::every_point, true, T(1), differ, "of neighbours that differ by up to %s one is asked", differ});
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
/// building. |planned − full| ≤ bound ≤ tolerance, up to rounding, 2e-4.
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
