// Soft shadows in real time, beside the ray-traced truth: in a window, or headless for pictures and times.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>

#include "arguments.hpp"
#include "headless.hpp"
#include "timings.hpp"
#include "truth.hpp"
#include "window/window.hpp"

using namespace penumbra;
using namespace penumbra::opengl;

int main(int argc, char** argv) {
    Arguments arguments;
    bool headless = false;
    std::string timings;
    const std::map<std::string, Picture> kinds_of_picture{
        {"shaded", Picture::shaded}, {"visibility", Picture::visibility}, {"difference", Picture::difference}};

    CLI::App app("Soft shadows in real time by the library's shaders, beside the ray-traced truth.");
    app.add_option("--scene", arguments.scene, "a built-in scene")
        ->check(CLI::IsMember(scenes::scene_names()))
        ->capture_default_str();
    app.add_option("--mesh", arguments.mesh, "a mesh file in its place, anything assimp reads");
    app.add_option("--light", arguments.light, "kind of light; the scene's own if none is named")
        ->check(CLI::IsMember(scenes::light_kinds()));
    app.add_option("--light-size", arguments.light_size, "factor on the light's size")->check(CLI::Range(0.0, 1e3));
    app.add_option("--method", arguments.method, "one for such a light if none is named")
        ->check(CLI::IsMember(method_names()));
    app.add_option("--knob", arguments.knobs, "name=value, one of the method's; again for more");
    app.add_option("--plan", arguments.plan, "turn the method's knobs as planned for this tolerance, and say why")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option_function<std::string>(
           "--size",
           [&](const std::string& text) {
               if (std::sscanf(text.c_str(), "%dx%d", &arguments.size.x, &arguments.size.y) != 2 ||
                   arguments.size.x < 1 || arguments.size.y < 1 || arguments.size.x > 16384 || arguments.size.y > 16384)
                   throw CLI::ValidationError("--size", "'" + text + "' is not WIDTHxHEIGHT, 1x1 to 16384x16384");
               arguments.size_given = true;
           },
           "WIDTHxHEIGHT")
        ->default_str("960x720");
    app.add_option("--picture", arguments.picture, "shaded, visibility or difference from the truth")
        ->transform(CLI::CheckedTransformer(kinds_of_picture));
    app.add_option("--split", arguments.split, "the truth is shown right of this part of the width")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--gl", arguments.gl, "version of OpenGL: 4.3, or 3.3 without compute shaders")
        ->check(CLI::IsMember({"3.3", "4.3"}))
        ->capture_default_str();
    app.add_flag("--ordinary-depth", arguments.ordinary_depth, "near at 0, also where reverse depth is possible");
    app.add_option("--frames", arguments.frames, "how many to draw, then end")->check(CLI::Range(1, 1000000));
    app.add_option("--out", arguments.out, "write the last frame as PNG");

    app.add_flag("--headless", headless, "no window, no window system");
    app.add_option("--csv", arguments.csv, "headless: milliseconds of each pass and frame");
    app.add_flag("--panels", arguments.panels, "headless: truth, method and difference side by side");
    app.add_flag("--compare", arguments.compare, "headless: print how far the GPU is from the C++ with the same knobs");
    app.add_option("--rays", arguments.rays, "a point for the truth")->check(CLI::Range(4, Truth::most_rays));
    app.add_option("--timings", timings, "headless: time every method on three scenes into this file");
    app.add_flag("--exercise", arguments.exercise, "window: turn, resize and minimise at random, for tests");
    CLI11_PARSE(app, argc, argv);
    try {
        if (!timings.empty())
            run_timings(timings, arguments);
        else if (headless || arguments.compare)
            run_headless(arguments);
        else
            run_window(arguments);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "opengl_example: %s\n", error.what());
        return 1;
    }
}
