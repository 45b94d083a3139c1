#include "scaling.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "error.hpp"
#include "../scenes/meshes.hpp"
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
    void add(const std::string& series, const Setting& setting) { add(series, setting, x); }
    void add(const std::string& series, const Setting& setting, double at) {
        const auto start = Clock::now();
        built.push_back(setting.build(scene));
        Cost cost;
        cost.series = series, cost.x = at;
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
    void compare_with_rays() {
        for (Cost& cost : costs) cost.rays = ray_cost(rays, scene.name, cost.rmse);
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

void finish(CostFigure figure, const Stages& stages, Study& study) {
    for (const auto& stage : stages) figure.costs.insert(figure.costs.end(), stage->costs.begin(), stage->costs.end());
    study.cost_figures.push_back(std::move(figure));
    say(study.cost_figures.back().name, "done\n");
}

/// A scene of the figure, looked at.
Stage& add_stage(Stages& stages, const std::string& figure, Scene scene, double x, const Effort& effort) {
    stages.push_back(std::make_unique<Stage>());
    Stage& stage = *stages.back();
    stage.scene = std::move(scene);
    stage.scene.name = figure;
    stage.x = x;
    say(figure, fmt::format("{:.0f}", x));
    stage.look_around(effort);
    return stage;
}

/// A sphere above the ground, under a disk of the same size.
Scene sphere_under_disk(std::size_t triangles) {
    Scene scene = make_scene("concave");
    scene.light = scaled(scene.light, 0.5F);
    scene.casters = {make_sphere(Vec3<float>(0.0F, 1.4F, 0.0F), 1.0F, triangles)};
    return scene;
}

}  // namespace

void measure_spheres(const Effort& effort, Study& study) {
    CostFigure figure{"spheres", "spheres",
                      "Cost against the number of spheres, as in Figure 12 of Forest, Barthe & Paulin 2006: spheres of "
                      "762 triangles under a low light, so that silhouettes overlap."};
    figure.log_x = false;
    const std::string ours = "bit masks, silhouettes per point";
    const WedgeFigure settings = wedge_figure();
    Stages stages;
    for (const int side : {1, 2, 3, 5, 7, 9}) {
        Stage& stage = add_stage(stages, figure.name, low_spheres(side), side * side, effort);
        stage.add_rays(effort.most_rays);
        stage.add("plain wedges", settings.plain);
        stage.add("blended wedges (the paper)", settings.blended);
        stage.add(ours, settings.ours);
    }
    take_turns(stages, figure.name, effort.rounds);
    for (const auto& stage : stages) {
        const double rmse = stage->costs.back().rmse;
        const RayCost rays = ray_cost(stage->rays, stage->scene.name, rmse);
        Cost cost;
        cost.series = "Embree, at the error of " + ours, cost.x = stage->x;
        cost.ns_per_point = rays.ns, cost.rmse = rmse, cost.at_least = rays.bound == Bound::lower;
        stage->costs.push_back(cost);
    }
    finish(std::move(figure), stages, study);
}

void measure_triangles(const Effort& effort, Study& study) {
    CostFigure figure{"triangles", "triangles",
                      "Cost against the number of triangles of a prism with 48 corners: all go into its caps, flat or "
                      "domed, and its silhouette stays as it is."};
    figure.log_y = false;
    const WedgeFigure settings = wedge_figure();
    Stages stages;
    for (const std::size_t triangles : {10000U, 30000U, 100000U, 300000U, 1000000U}) {
        for (const float dome : {0.0F, 0.1F}) {
            Scene scene = make_scene("slab");
            scene.casters = {make_prism(Vec3<float>(0.0F, 2.0F, 0.0F), 1.5F, 0.35F, 48, triangles, dome)};
            const auto x = static_cast<double>(scene.triangle_count());
            Stage& stage = add_stage(stages, figure.name, std::move(scene), x, effort);
            const std::string caps = dome > 0.0F ? "domed caps" : "flat caps";
            stage.add(caps + ", silhouettes per point", settings.ours);
            stage.add(caps + ", silhouettes from the light's centre", settings.plain);
        }
    }
    take_turns(stages, figure.name, effort.rounds);
    finish(std::move(figure), stages, study);
}

void measure_disk_triangles(const Effort& effort, Study& study) {
    CostFigure figure{"disk-triangles", "triangles, disk light",
                      "Cost of a disk light's umbra volumes against the number of triangles of a sphere, as in the "
                      "paper's Table 1: D-buffers of 1024² texels, and sums over edges."};
    const VolumeFigure settings = volume_figure(1024);
    Stages stages;
    for (const std::size_t triangles : {1000U, 10000U, 100000U}) {
        Stage& stage = add_stage(stages, figure.name, sphere_under_disk(triangles), double(triangles), effort);
        stage.add_rays(effort.most_rays);
        stage.add("D-buffer, one layer", settings.one_layer);
        stage.add("D-buffer, two layers", settings.two_layers);
        stage.add("sum over edges", settings.edge_sum);
    }
    take_turns(stages, figure.name, effort.rounds);
    for (const auto& stage : stages) stage->compare_with_rays();
    finish(std::move(figure), stages, study);
}

void measure_resolution(const Effort& effort, Study& study) {
    CostFigure figure{"resolution", "texels a side",
                      "Cost of a disk light's umbra volumes against the D-buffer's resolution, for a sphere of 10,000 "
                      "triangles."};
    figure.log_y = false;
    Stages stages;
    Stage& stage = add_stage(stages, figure.name, sphere_under_disk(10000), 0.0, effort);
    stage.add_rays(effort.most_rays);
    for (const int resolution : {256, 512, 1024, 2048}) {
        const VolumeFigure settings = volume_figure(resolution);
        stage.add("D-buffer, one layer", settings.one_layer, resolution);
        stage.add("D-buffer, two layers", settings.two_layers, resolution);
    }
    take_turns(stages, figure.name, effort.rounds);
    stage.compare_with_rays();
    finish(std::move(figure), stages, study);
}

void measure_line_samples(const Effort& effort, Study& study) {
    CostFigure figure{"line-samples", "samples of a line light",
                      "Cost of a line light's maps against their number, on the scene blocker: plain shadow maps, the "
                      "same with skins, and intervals."};
    figure.log_x = figure.log_y = false;
    Stages stages;
    Stage& stage = add_stage(stages, figure.name, make_scene("blocker"), 0.0, effort);
    stage.add_rays(effort.most_rays);
    for (const int samples : {2, 3, 5, 9, 17, 33}) {
        const LineFigure settings = line_figure(samples);
        stage.add("plain shadow maps", settings.plain, samples);
        stage.add("skins, linear (the paper)", settings.linear, samples);
        stage.add("skins, exact", settings.exact, samples);
        stage.add("intervals", settings.intervals, samples);
    }
    take_turns(stages, figure.name, effort.rounds);
    stage.compare_with_rays();
    finish(std::move(figure), stages, study);
}

}  // namespace penumbra::study
