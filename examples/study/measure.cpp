#include "measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "drawing.hpp"
#include "error.hpp"
#include "measured.hpp"
#include "progress.hpp"
#include "timing.hpp"

namespace penumbra::study {
namespace {

Points points_of(const View& view, const std::vector<std::size_t>& chosen) {
    Points points;
    for (const std::size_t i : chosen) points.push_back(view.points[i]);
    return points;
}

Measured look_at(const Scene& scene, const Effort& effort) {
    say(scene.name, "looking");
    View view = look(scene, effort.width, effort.height);
    Points points = points_of(view, spread(view, effort.points, Effort::error_run));
    Points timed = points_of(view, spread(view, effort.timed, Effort::timed_run));
    Measured measured{
        scene, effort, std::move(view), std::move(points), std::move(timed), reference::Scene(scene.casters), {},
        {},    {}};
    const Points& at = measured.points;
    say(scene.name, fmt::format("truth, {} rays at {} points", effort.truth_rays, at.size()));
    measured.truth = trace(measured.traced, scene, at, effort.truth_rays);
    measured.overlap = overlaps(scene, at);
    SceneInfo& info = measured.info;
    info.name = scene.name;
    info.about = scene.about;
    info.triangles = scene.triangle_count();
    info.light = text_of(scene.light);
    info.points = at.size();
    info.overlap_points = static_cast<std::size_t>(std::count(measured.overlap.begin(), measured.overlap.end(), true));
    // of two independent estimates' difference, half the variance is either's
    const Points few(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(at.size() / 4));
    std::vector<float> once = measured.truth;
    once.resize(few.size());
    info.truth_noise = compare(trace(measured.traced, scene, few, effort.truth_rays, 77), once).rmse / std::sqrt(2.0);
    return measured;
}

Candidate build(const Setting& setting, const Measured& measured) {
    Candidate candidate;
    const auto start = Clock::now();
    candidate.built = setting.build(measured.scene);
    candidate.special = setting.special;
    Row& row = candidate.row;
    row.build_ms = seconds_since(start) * 1e3;
    row.scene = measured.info.name;
    row.triangles = measured.info.triangles;
    row.light = measured.info.light;
    row.method = setting.method;
    row.knobs = setting.knobs;
    row.is_default = setting.is_default;
    row.points = measured.info.points;
    row.bytes = candidate.built.bytes;
    return candidate;
}

void set_errors(Row& row, const std::vector<float>& visibility, const Measured& measured) {
    const Error error = compare(visibility, measured.truth);
    row.rmse = error.rmse, row.max_error = error.max, row.bias = error.bias;
    if (measured.info.overlap_points > 0)
        row.overlap_rmse = compare(visibility, measured.truth, &measured.overlap).rmse;
}

}  // namespace

void measure_scene(const Scene& scene, const std::vector<Setting>& settings, const Effort& effort,
                   const std::filesystem::path& folder, Study& study) {
    const Measured measured = look_at(scene, effort);
    study.scenes.push_back(measured.info);

    // Rays and methods run in turn, so that neither has the quieter machine.
    const Points& timed = measured.timed;
    std::vector<float> result(timed.size());
    std::vector<Timing> timings;
    std::vector<RayRow> rays;
    sweep_rays({measured.traced, scene, measured.points, measured.truth, timed, result}, effort.most_rays, rays,
               timings);
    std::vector<Candidate> candidates;
    candidates.reserve(settings.size());
    for (const Setting& setting : settings) {
        say(scene.name, fmt::format("setting {} of {}", candidates.size() + 1, settings.size()));
        candidates.push_back(build(setting, measured));
        Candidate& candidate = candidates.back();
        timings.emplace_back(
            timed.size(), [&](std::size_t count) { candidate.built.visibility(timed.data(), count, result.data()); });
        timings.back().first();
        set_errors(candidate.row, ask(candidate.built, measured.points), measured);
    }
    take_turns(timings, effort.rounds,
               [&](int round) { say(scene.name, fmt::format("timing, round {} of {}", round + 1, effort.rounds)); });
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].ns_per_point = timings[i].ns_per_point();
        study.ray_rows.push_back(rays[i]);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        candidates[i].row.ns_per_point = timings[rays.size() + i].ns_per_point();
        study.rows.push_back(candidates[i].row);
    }
    draw(measured, candidates, folder, study);
    say(scene.name, "done\n");
}

}  // namespace penumbra::study
