// What ray-traced visibility costs at a given error, from a sweep over numbers of rays.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::study {

/// One point of the sweep: `rays` a point, traced alone or in packets of `packet`.
struct RayRow {
    std::string scene;
    std::string sampler;  ///< stratified, r2 or sobol
    int packet = 1;
    int rays = 0;
    double rmse = 0.0, ns_per_point = 0.0;
};

/// Whether a cost is known, or only that it is at least (lower) or at most (upper) what is given.
enum class Bound { none, lower, upper };

/// Time and rays a point; not positive if nothing was swept.
struct RayCost {
    Bound bound = Bound::none;
    double ns = -1.0, rays = -1.0;
    std::string sampler;  ///< its name, with the size of its packets
};

/// The cost on one sampler's rows, few rays to many and not empty: interpolated log-log where the curve first comes
/// down to `rmse`; an upper bound if the fewest rays are more accurate already, a lower one if the most are not.
inline RayCost cost_on(const std::vector<const RayRow*>& curve, double rmse) {
    const RayRow &first = *curve.front(), &last = *curve.back();
    const std::string name =
        first.packet > 1 ? first.sampler + ", packets of " + std::to_string(first.packet) : first.sampler;
    if (first.rmse <= rmse)
        return {first.rmse < rmse ? Bound::upper : Bound::none, first.ns_per_point, double(first.rays), name};
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const RayRow &a = *curve[i], &b = *curve[i + 1];
        if (!(b.rmse <= rmse && rmse < a.rmse)) continue;
        // an error of exactly 0 has no logarithm; what is left to say is which ray count had it
        const double t = b.rmse > 0.0 ? std::log(rmse / a.rmse) / std::log(b.rmse / a.rmse) : 1.0;
        return {Bound::none, a.ns_per_point * std::pow(b.ns_per_point / a.ns_per_point, t),
                a.rays * std::pow(double(b.rays) / a.rays, t), name};
    }
    return {Bound::lower, last.ns_per_point, double(last.rays), name};
}

/// The cost on the cheapest of all samplers that are as accurate as `rmse` on the scene. If none is, the cheapest row
/// of most rays, as a lower bound: samplers that were swept less far had fallen behind.
inline RayCost ray_cost(const std::vector<RayRow>& rows, const std::string& scene, double rmse) {
    std::map<std::pair<std::string, int>, std::vector<const RayRow*>> curves;
    for (const RayRow& row : rows)
        if (row.scene == scene) curves[{row.sampler, row.packet}].push_back(&row);
    RayCost best;
    for (auto& [sampler, curve] : curves) {
        std::sort(curve.begin(), curve.end(), [](auto* a, auto* b) { return a->rays < b->rays; });
        const RayCost cost = cost_on(curve, rmse);
        const bool reaches = cost.bound != Bound::lower, best_reaches = best.bound != Bound::lower;
        const bool further = !reaches && cost.rays > best.rays, as_far = reaches || cost.rays == best.rays;
        const bool better = reaches == best_reaches ? further || (as_far && cost.ns < best.ns) : reaches;
        if (best.ns <= 0.0 || better) best = cost;
    }
    return best;
}

}  // namespace penumbra::study
