// Ray-traced truth, and the sweep over samplers and numbers of rays that methods are compared with.
#pragma once

#include <cstdint>
#include <penumbra/reference/embree.hpp>
#include <string>
#include <vector>

#include "ray_cost.hpp"
#include "../scenes/scene.hpp"
#include "timing.hpp"

namespace penumbra::study {

using namespace scenes;

using Points = std::vector<Vec3<float>>;

/// Visibility by so many stratified rays a point, on all cores; another seed, another independent estimate.
std::vector<float> trace(const reference::Scene& traced, const Scene& scene, const Points& points, int rays,
                         std::uint32_t seed = 0);

/// How much of the light's rim each point sees: exactly 0 or 1 where no ray or every ray is blocked.
std::vector<float> trace_rim(const reference::Scene& traced, const Scene& scene, const Points& points, int rays);

/// At which points several casters hide the same part of the light: more than 1 % of it.
std::vector<bool> overlaps(const Scene& scene, const Points& points);

/// What rays are swept on: errors are of `points`, against `truth`; `timed` are timed, into `result`, on one thread.
struct RayTarget {
    const reference::Scene& traced;
    const Scene& scene;
    const Points& points;
    const std::vector<float>& truth;
    const Points& timed;
    std::vector<float>& result;
};

/// Every sampler, each way of handing rays to Embree, 4 to `most` rays by doubling; beyond 256 the best three of them.
/// Adds a row with its error and a timing for each. Timings refer to the target's members.
void sweep_rays(const RayTarget& target, int most, std::vector<RayRow>& rows, std::vector<Timing>& timings);

}  // namespace penumbra::study
