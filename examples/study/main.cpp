// The study: how accurate each method is, what it costs, and how many rays buy the same accuracy.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>

#include "measure.hpp"
#include "report.hpp"
#include "scene.hpp"
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
    std::vector<std::string> scenes;
    std::string mesh, light = "rectangle", out = "out/study";
    double size = 1.0;
    std::size_t points = 0;
    bool quick = false;
};

std::vector<Scene> wanted_scenes(const Arguments& arguments) {
    const auto size = static_cast<float>(arguments.size);
    std::vector<Scene> scenes;
    for (const std::string& name : arguments.scenes) scenes.push_back(make_scene(name, size));
    if (!arguments.mesh.empty()) scenes.push_back(load_scene(arguments.mesh, size));
    if (scenes.empty())
        for (const std::string& name : scene_names()) scenes.push_back(make_scene(name, size));
    return scenes;
}

int run(const Arguments& arguments, const std::string& command) {
    Effort effort;
    if (arguments.quick) effort = {1024, 1024, 256, 3, 280, 210, 128};
    if (arguments.points > 0) effort.points = arguments.points;

    Study study;
    study.command = command;
    study.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    study.machine = processor();
    study.compiler = PENUMBRA_STUDY_COMPILER;
    study.flags = PENUMBRA_STUDY_FLAGS;
    study.truth_rays = effort.truth_rays;
    const std::filesystem::path folder = arguments.out;
    std::filesystem::create_directories(folder);
    const std::vector<Setting> settings = occlusion_texture_settings(arguments.quick);
    for (const Scene& scene : wanted_scenes(arguments)) measure_scene(scene, settings, effort, folder, study);
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
    app.add_option("--light", arguments.light, "kind of light")
        ->check(CLI::IsMember({"rectangle"}))
        ->capture_default_str();
    app.add_option("--size", arguments.size, "factor on the light's size")
        ->check(CLI::Range(0.0, 1e3))
        ->capture_default_str();
    app.add_option("--points", arguments.points, "points to measure on, at most those that the camera sees")
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
