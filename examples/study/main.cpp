// The study: how accurate each method is, what it costs, and how many rays buy the same accuracy.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>

#include "../scenes/scene.hpp"
#include "measure.hpp"
#include "plans.hpp"
#include "report.hpp"
#include "scaling.hpp"
#include "settings.hpp"

namespace {

using namespace penumbra::study;

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string joined(int argc, char** argv) {
    std::string command = "examples/run.sh";
    for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);
    return command;
}

struct Arguments {
    std::vector<std::string> scenes, methods;
    std::string mesh, light, out = "out/study";
    std::vector<double> sizes = {1.0};
    std::size_t points = 0;
    bool quick = false, scaling = false, plans = false;
    double tolerance = 0.02;
    int lines = 1080;
};

std::vector<Scene> wanted_scenes(const Arguments& arguments) {
    const bool all = arguments.scenes.empty() && arguments.mesh.empty() && !arguments.scaling;
    std::vector<Scene> plain, scenes;
    for (const std::string& name : all ? scene_names() : arguments.scenes) {
        plain.push_back(make_scene(name));
        if (all && !arguments.light.empty() && kind_of(plain.back().light) != arguments.light) plain.pop_back();
    }
    if (!arguments.mesh.empty()) plain.push_back(load_scene(arguments.mesh));
    for (const double size : arguments.sizes)
        for (const Scene& scene : plain) scenes.push_back(under(scene, arguments.light, static_cast<float>(size)));
    return scenes;
}

/// Scenes that compare rules for overlap, and those of disk and line lights, are many and plain: they get by with less.
Effort effort_for(Subject subject, const Arguments& arguments) {
    Effort effort;
    if (subject == Subject::overlap || subject == Subject::volumes || subject == Subject::lines) {
        effort.points = 4096, effort.timed = 2048, effort.most_rays = 512, effort.rounds = 3;
        effort.width = 400, effort.height = 300;
    }
    if (subject == Subject::lines) effort.points = 2048, effort.timed = 1024, effort.most_rays = 256;
    if (arguments.quick) effort = {2048, 1024, 1024, 256, 3, 280, 210, 128};
    if (arguments.points > 0) effort.points = arguments.points;
    return effort;
}

int run_plans(const Arguments& arguments, const std::string& command) {
    const std::filesystem::path folder = arguments.out;
    std::filesystem::create_directories(folder);
    std::vector<PlanRow> rows;
    for (const Scene& scene : wanted_scenes(arguments))
        for (PlanRow& row : measure_plans(scene, arguments.tolerance, arguments.lines, folder))
            rows.push_back(std::move(row));
    write_plans(rows,
                {{"command", command},
                 {"machine", processor()},
                 {"compiler", PENUMBRA_STUDY_COMPILER},
                 {"flags", PENUMBRA_STUDY_FLAGS}},
                folder);
    return 0;
}

int run(const Arguments& arguments, const std::string& command) {
    if (arguments.plans) return run_plans(arguments, command);
    Study study;
    study.command = command;
    study.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    study.machine = processor();
    study.compiler = PENUMBRA_STUDY_COMPILER;
    study.flags = PENUMBRA_STUDY_FLAGS;
    study.truth_rays = effort_for(Subject::methods, arguments).truth_rays;
    const std::filesystem::path folder = arguments.out;
    std::filesystem::create_directories(folder);
    for (const Scene& scene : wanted_scenes(arguments)) {
        const std::vector<Setting> settings = settings_for(scene, arguments.methods, arguments.quick);
        if (settings.empty()) continue;
        measure_scene(scene, settings, effort_for(scene.subject, arguments), folder, study);
    }
    if (arguments.scaling) {
        const Effort effort = effort_for(Subject::overlap, arguments);
        const auto wanted = [&](const char* kind) { return arguments.light.empty() || arguments.light == kind; };
        if (wanted("rectangle")) measure_spheres(effort, study), measure_triangles(effort, study);
        if (wanted("disk")) measure_disk_triangles(effort, study), measure_resolution(effort, study);
        if (wanted("line")) measure_line_samples(effort, study);
    }
    compare_with_rays(study);
    for (const std::string& missing : write_study(study, folder)) fmt::print(stderr, "note: {}\n", missing);
    print_table(study);
    fmt::print("\nresults: {}\n", (folder / "index.html").string());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Measures soft-shadow methods against ray-traced truth: accuracy, time, and rays at equal accuracy.");
    app.add_option("--scene", arguments.scenes, "a built-in scene; again for more; all if none is named")
        ->check(CLI::IsMember(scene_names()));
    app.add_option("--mesh", arguments.mesh, "a mesh file (anything assimp reads), stood above the ground")
        ->check(CLI::ExistingFile);
    app.add_option("--light", arguments.light,
                   "kind of light for the scenes that are named, of the same area, a line of the same length; else "
                   "which scenes are measured")
        ->check(CLI::IsMember(light_kinds()));
    app.add_option("--size", arguments.sizes, "factor on the light's size; again for more")
        ->check(CLI::Range(0.0, 1e3))
        ->capture_default_str();
    app.add_option("--method", arguments.methods,
                   "a method, with all its settings; again for more; all if none is named")
        ->check(CLI::IsMember(method_names()));
    app.add_flag("--scaling", arguments.scaling,
                 "cost against spheres, triangles, resolutions and samples; no scenes unless they are named");
    app.add_flag("--plans", arguments.plans, "methods as planned for a tolerance beside all their effects");
    app.add_option("--tolerance", arguments.tolerance, "of visibility, for --plans")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    app.add_option("--lines", arguments.lines, "of the picture of 16 : 9 whose points --plans asks for")
        ->check(CLI::Range(9, 4320))
        ->capture_default_str();
    app.add_option("--points", arguments.points, "points to measure errors at, at most those that the camera sees")
        ->check(CLI::Range(1, 10000000));
    app.add_flag("--quick", arguments.quick, "fewer settings, points and rays: about a tenth of the time");
    app.add_option("--out", arguments.out, "folder for the results")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        return run(arguments, joined(argc, argv));
    } catch (const std::exception& error) {
        fmt::print(stderr, "study: {}\n", error.what());
        return 1;
    }
}
