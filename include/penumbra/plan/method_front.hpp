// Which method a scene and a light want, for a tolerance.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/plan/cost.hpp>
#include <penumbra/plan/planner.hpp>
#include <vector>

namespace penumbra {

/// A method, in one of its modes.
enum class PlannedMethod { penumbra_wedge, edge_sum, d_buffer, intervals, skins, occlusion_texture };

inline const char* name_of(PlannedMethod method) {
    constexpr const char* names[] = {"penumbra_wedge",         "umbra_volume, edge_sum",
                                     "umbra_volume, d_buffer", "soft_shadow_map, intervals",
                                     "soft_shadow_map, skins", "occlusion_texture"};
    return names[static_cast<int>(method)];
}

/// One way to shade a scene.
template <class T>
struct MethodChoice {
    PlannedMethod method;
    T tolerance;  ///< to plan it with
    T bound;      ///< against the most accurate method for the light with all its effects
    double ns;    ///< a point, as predicted
};

namespace detail {

/// The methods for one light: those that are exact but for what plans leave out, and those of which nothing is known.
template <class T, class Light>
class MethodFront {
  public:
    MethodFront(const std::vector<Mesh<T>>& casters, const Light& light, const std::vector<Mesh<T>>& receivers,
                const CostTable& costs, bool casters_receive)
        : casters_(casters),
          light_(light),
          receivers_(receivers),
          costs_(costs),
          extents_(scene_extents(casters, light, receivers, casters_receive)),
          casters_receive_(casters_receive) {}

    template <class Shadow>
    void add(PlannedMethod method, const typename Shadow::Options& full, bool is_exact) {
        PlanSettings<Shadow> settings;
        settings.full = full, settings.casters_receive = casters_receive_;
        const double full_ns = predicted_full_ns(extents_, casters_, full, costs_);
        const T other = is_exact || !(extents_.total_hidden() > T(0)) ? T(0) : T(1);
        for (const T tolerance : {T(0), T(0.001), T(0.002), T(0.005), T(0.01), T(0.02), T(0.05), T(0.1), T(0.2)}) {
            const Plan<Shadow> plan = plan_for<Shadow>(casters_, light_, receivers_, tolerance, settings);
            all_.push_back({method, tolerance, plan.bound + other, predicted_ns(plan, costs_, full_ns)});
        }
    }

    /// From the smallest bound to the least time.
    std::vector<MethodChoice<T>> best() {
        std::stable_sort(all_.begin(), all_.end(), [](const MethodChoice<T>& a, const MethodChoice<T>& b) {
            return a.bound < b.bound || (a.bound <= b.bound && a.ns < b.ns);
        });
        std::vector<MethodChoice<T>> front;
        for (const MethodChoice<T>& choice : all_)
            if (front.empty() || choice.ns < front.back().ns) front.push_back(choice);
        return front;
    }

  private:
    const std::vector<Mesh<T>>& casters_;
    const Light& light_;
    const std::vector<Mesh<T>>& receivers_;
    const CostTable& costs_;
    SceneExtents<T> extents_;
    bool casters_receive_;
    std::vector<MethodChoice<T>> all_;
};

}  // namespace detail

/// The ways to shade a scene that no other beats both in what is lost and in time, from the most exact to the fastest.
/// What is lost is what plans say, from the same boxes. Of occlusion textures, D-buffers and skins nothing is known
/// before they are built but that they are right where there is no shadow: their bound is 1, and so they end a front,
/// for those who look at pictures. Times are predicted from costs.
template <class T>
std::vector<MethodChoice<T>> method_front(const std::vector<Mesh<T>>& casters, const RectLight<T>& light,
                                          const std::vector<Mesh<T>>& receivers, const CostTable& costs,
                                          bool casters_receive = true) {
    detail::MethodFront<T, RectLight<T>> front(casters, light, receivers, costs, casters_receive);
    front.template add<PenumbraWedgeShadow<T>>(PlannedMethod::penumbra_wedge, {}, true);
    front.template add<OcclusionTextureShadow<T>>(PlannedMethod::occlusion_texture, {}, false);
    return front.best();
}
template <class T>
std::vector<MethodChoice<T>> method_front(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light,
                                          const std::vector<Mesh<T>>& receivers, const CostTable& costs,
                                          bool casters_receive = true) {
    detail::MethodFront<T, DiskLight<T>> front(casters, light, receivers, costs, casters_receive);
    UmbraVolumeOptions d_buffer;
    d_buffer.mode = DiskMode::d_buffer;
    front.template add<UmbraVolumeShadow<T>>(PlannedMethod::edge_sum, {}, true);
    front.template add<UmbraVolumeShadow<T>>(PlannedMethod::d_buffer, d_buffer, false);
    return front.best();
}
template <class T>
std::vector<MethodChoice<T>> method_front(const std::vector<Mesh<T>>& casters, const LinearLight<T>& light,
                                          const std::vector<Mesh<T>>& receivers, const CostTable& costs,
                                          bool casters_receive = true) {
    detail::MethodFront<T, LinearLight<T>> front(casters, light, receivers, costs, casters_receive);
    SoftShadowMapOptions skins;
    skins.mode = LinearMode::skins;
    front.template add<SoftShadowMap<T>>(PlannedMethod::intervals, {}, true);
    front.template add<SoftShadowMap<T>>(PlannedMethod::skins, skins, false);
    return front.best();
}

/// The fastest of a front within the tolerance, the most exact if none is; the front is not empty.
template <class T>
MethodChoice<T> fastest_within(const std::vector<MethodChoice<T>>& front, T tolerance) {
    MethodChoice<T> chosen = front.front();
    for (const MethodChoice<T>& choice : front)
        if (choice.bound <= tolerance) chosen = choice;
    return chosen;
}

}  // namespace penumbra
