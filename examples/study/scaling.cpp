#include "scaling.hpp"

#include <fmt/format.h>

#include <memory>

#include "error.hpp"
#include "meshes.hpp"
#include "progress.hpp"
#include "rays.hpp"
#include "timing.hpp"
#include "view.hpp"

namespace penumbra::study {
namespace {

/// A scene of a figure, all that is timed in it, and what it costs. Timings hold references to it.
struct Stage {
    Scene scene;
    double x = 0.0;
    Points points;
    std::vector<float> truth, result;
    std::unique_ptr<reference::Scene> traced;
    std::vector<RayRow> rays;
    std::vector<Timing> timings;  // of rays, then of costs
    std::vector<Built> built;
    std::vector<Cost> costs;

    void look_around(const Effort& effort) {
        const View view = look(scene, effort.width, effort.height);
        for (const std::size_t i : spread(view, effort.timed, Effort::timed_run)) points.push_back(view.points[i]);
        result.resize(points.size());
        traced = std::make_unique<reference::Scene>(scene.casters);
        truth = trace(*traced, scene, points, effort.truth_rays);
    }
    void add_rays(int most) { sweep_rays({*traced, scene, points, truth, points, result}, most, rays, timings); }
    void add(const std::string& figure, const std::string& series, const Setting& setting) {
        const auto start = Clock::now();
        built.push_back(setting.build(scene));
        Cost cost{figure, series, x};
        cost.build_ms = seconds_since(start) * 1e3;
        timings.emplace_back(points.size(), [this, i = built.size() - 1](std::size_t count) {
            built[i].visibility(points.data(), count, result.data());
        });
        timings.back().first();
        cost.rmse = compare(ask(built.back(), points), truth).rmse;
        costs.push_back(cost);
    }
    void collect() {
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i].ns_per_point = timings[i].ns_per_point();
        for (std::size_t i = 0; i < costs.size(); ++i) costs[i].ns_per_point = timings[rays.size() + i].ns_per_point();
    }
};

using Stages = std::vector<std::unique_ptr<Stage>>;

/// All stages in turn, so that no size of scene has the quieter machine.
void take_turns(Stages& stages, const std::string& figure, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        say(figure, fmt::format("timing, round {} of {}", round + 1, rounds));
        for (const auto& stage : stages)
            for (Timing& timing : stage->timings)
                if (round < timing.rounds(rounds)) timing.again();
    }
    for (const auto& stage : stages) stage->collect();
}

}  // namespace

void measure_spheres(const Effort& effort, Study& study) {
    const std::string figure = "spheres", ours = "bit masks, silhouettes per point";
    const WedgeFigure settings = wedge_figure();
    Stages stages;
    for (const int side : {1, 2, 3, 5, 7, 9}) {
        say(figure, fmt::format("{} of them", side * side));
        stages.push_back(std::make_unique<Stage>());
        Stage& stage = *stages.back();
        stage.scene = low_spheres(side);
        stage.scene.name = figure;
        stage.x = side * side;
        stage.look_around(effort);
        stage.add_rays(effort.most_rays);
        stage.add(figure, "plain wedges", settings.plain);
        stage.add(figure, "blended wedges (the paper)", settings.blended);
        stage.add(figure, ours, settings.ours);
    }
    take_turns(stages, figure, effort.rounds);
    for (const auto& stage : stages) {
        const double rmse = stage->costs.back().rmse;
        const RayCost rays = ray_cost(stage->rays, stage->scene.name, rmse);
        Cost cost{figure, "Embree, at the error of " + ours, stage->x};
        cost.ns_per_point = rays.ns, cost.rmse = rmse, cost.at_least = rays.bound == Bound::lower;
        stage->costs.push_back(cost);
        study.costs.insert(study.costs.end(), stage->costs.begin(), stage->costs.end());
    }
    say(figure, "done\n");
}

void measure_triangles(const Effort& effort, Study& study) {
    const std::string figure = "triangles";
    const WedgeFigure settings = wedge_figure();
    Stages stages;
    for (const std::size_t triangles : {10000U, 30000U, 100000U, 300000U, 1000000U}) {
        for (const float dome : {0.0F, 0.1F}) {
            stages.push_back(std::make_unique<Stage>());
            Stage& stage = *stages.back();
            stage.scene = make_scene("slab");
            stage.scene.name = figure;
            stage.scene.casters = {make_prism(Vec3<float>(0.0F, 2.0F, 0.0F), 1.5F, 0.35F, 48, triangles, dome)};
            stage.x = static_cast<double>(stage.scene.triangle_count());
            say(figure, fmt::format("{:.0f} of them", stage.x));
            stage.look_around(effort);
            const std::string caps = dome > 0.0F ? "domed caps" : "flat caps";
            stage.add(figure, caps + ", silhouettes per point", settings.ours);
            stage.add(figure, caps + ", silhouettes from the light's centre", settings.plain);
        }
    }
    take_turns(stages, figure, effort.rounds);
    for (const auto& stage : stages) study.costs.insert(study.costs.end(), stage->costs.begin(), stage->costs.end());
    say(figure, "done\n");
}

}  // namespace penumbra::study
