#include "rays.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"
#include "progress.hpp"

namespace penumbra::study {
namespace {

using reference::Rays;
using reference::SampleOptions;
using reference::Sampler;

const char* name_of(Sampler sampler) {
    switch (sampler) {
        case Sampler::stratified:
            return "stratified";
        case Sampler::r2:
            return "r2";
        case Sampler::sobol:
            break;
    }
    return "sobol";
}

/// What of the light `count` points see, on this thread.
void trace(const reference::Scene& traced, const Light& light, const Vec3<float>* points, std::size_t count,
           const SampleOptions& options, float* result) {
    std::visit([&](const auto& it) { traced.visibility(points, count, it, options, result); }, light);
}

std::vector<float> trace(const reference::Scene& traced, const Scene& scene, const Points& points,
                         const SampleOptions& options) {
    std::vector<float> result(points.size());
    in_parallel(points.size(), [&](std::size_t first, std::size_t count) {
        trace(traced, scene.light, points.data() + first, count, options, result.data() + first);
    });
    return result;
}

/// A way of tracing, and its time × error² with most rays, which more rays change little.
struct Way {
    Rays mode;
    Sampler sampler;
    double cost = 0.0;
};

double measure(const RayTarget& target, const Way& way, int rays, std::vector<RayRow>& rows,
               std::vector<Timing>& timings) {
    RayRow row;
    row.scene = target.scene.name;
    row.sampler = fmt::format("{}{}", name_of(way.sampler), way.mode == Rays::coherent16 ? " coherent" : "");
    row.packet = way.mode == Rays::single ? 1 : 16;
    row.rays = rays;
    say(row.scene, fmt::format("{} rays, {}", rays, row.sampler));
    SampleOptions options;
    options.samples = rays;
    options.sampler = way.sampler;
    options.rays = way.mode;
    options.seed = 1000U + static_cast<std::uint32_t>(rays);  // independent of the truth's
    row.rmse = compare(trace(target.traced, target.scene, target.points, options), target.truth).rmse;
    rows.push_back(row);
    timings.emplace_back(target.timed.size(), [=, &traced = target.traced, &light = target.scene.light,
                                               &timed = target.timed, &result = target.result](std::size_t count) {
        trace(traced, light, timed.data(), count, options, result.data());
    });
    timings.back().first();
    return timings.back().ns_per_point() * row.rmse * row.rmse;
}

}  // namespace

std::vector<float> trace(const reference::Scene& traced, const Scene& scene, const Points& points, int rays,
                         std::uint32_t seed) {
    SampleOptions options;
    options.samples = rays;
    options.sampler = Sampler::stratified;
    options.seed = seed;
    return trace(traced, scene, points, options);
}

std::vector<float> trace_rim(const reference::Scene& traced, const Scene& scene, const Points& points, int rays) {
    const std::vector<LinearLight<float>> pieces = rim(scene.light);
    SampleOptions options;
    options.samples = std::max(rays / static_cast<int>(pieces.size()), 1);
    std::vector<float> result(points.size());
    in_parallel(points.size(), [&](std::size_t first, std::size_t count) {
        std::vector<float> seen(count);
        for (const LinearLight<float>& piece : pieces) {
            traced.visibility(points.data() + first, count, piece, options, seen.data());
            for (std::size_t i = 0; i < count; ++i) result[first + i] += seen[i];
        }
    });
    for (float& visibility : result) visibility /= static_cast<float>(pieces.size());
    return result;
}

std::vector<bool> overlaps(const Scene& scene, const Points& points) {
    constexpr int rays = 128;
    std::vector<bool> result(points.size());
    if (scene.casters.size() < 2) return result;
    // the same rays each time, so that the sum exceeds the whole by just what is hidden more than once
    const std::vector<float> all = trace(reference::Scene(scene.casters), scene, points, rays);
    std::vector<float> sum(points.size());
    for (const Mesh<float>& caster : scene.casters) {
        const std::vector<float> one = trace(reference::Scene(std::vector<Mesh<float>>{caster}), scene, points, rays);
        for (std::size_t i = 0; i < points.size(); ++i) sum[i] += 1.0F - one[i];
    }
    for (std::size_t i = 0; i < points.size(); ++i) result[i] = sum[i] - (1.0F - all[i]) > 0.01F;
    return result;
}

void sweep_rays(const RayTarget& target, int most, std::vector<RayRow>& rows, std::vector<Timing>& timings) {
    constexpr int all_to = 256;
    std::vector<Way> ways;
    for (const Rays mode : {Rays::single, Rays::packet16, Rays::coherent16})
        for (const Sampler sampler : {Sampler::stratified, Sampler::r2, Sampler::sobol})
            ways.push_back({mode, sampler});
    for (Way& way : ways)
        for (int rays = 4; rays <= std::min(most, all_to); rays *= 2)
            way.cost = measure(target, way, rays, rows, timings);
    std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.cost < b.cost; });
    ways.resize(3);
    for (const Way& way : ways)
        for (int rays = 2 * all_to; rays <= most; rays *= 2) measure(target, way, rays, rows, timings);
}

}  // namespace penumbra::study
