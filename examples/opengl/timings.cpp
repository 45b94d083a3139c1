#include "timings.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "measures.hpp"
#include "viewer.hpp"

namespace penumbra::opengl {
namespace {

/// A method, and how it is set.
struct Setting {
    const char* method;
    std::vector<std::string> knobs;
};
const Setting settings[] = {{"occlusion_texture", {"slices=16"}},
                            {"penumbra_wedge", {"technique=rasterised", "overlap=rectangles"}},
                            {"penumbra_wedge", {"technique=rasterised", "overlap=product"}},
                            {"penumbra_wedge", {"technique=index"}},
                            {"umbra_volume", {"layers=1"}},
                            {"umbra_volume", {"layers=2"}},
                            {"soft_shadow_map", {"mode=skins", "samples=2"}},
                            {"soft_shadow_map", {"mode=skins", "samples=5"}},
                            {"soft_shadow_map", {"mode=intervals"}},
                            {"pcss", {}}};

std::string text_of(const std::vector<std::string>& knobs) {
    std::string text;
    for (const std::string& knob : knobs) text += (text.empty() ? "" : " ") + knob;
    return text;
}

/// Each leaf of foliage has an outline: nothing for wedges, and drivers may take a draw of seconds for a fault.
bool is_for(const Setting& setting, const scenes::Scene& scene) {
    return scene.subject != scenes::Subject::occlusion_textures || setting.method != std::string("penumbra_wedge");
}

double error_of(Viewer& viewer) {
    viewer.resize({320, 240});
    viewer.draw_frame();
    const std::vector<float> visible = viewer.asked().visible;
    return rmse(visible, viewer.by_rays(1024));
}

/// Of all passes but that of the surfaces, in all and one by one.
struct Cost {
    float sum = 0.0F;
    std::string passes;
};

Cost cost_of(Viewer& viewer, glm::ivec2 size, int frames) {
    viewer.resize(size);
    viewer.draw_frame();
    viewer.timers().clear();
    for (int frame = 0; frame < frames; ++frame) viewer.draw_frame();
    viewer.timers().next_frame(true);
    Cost cost;
    for (const Timers::Pass& pass : viewer.timers().passes()) {
        if (pass.name == "surfaces") continue;
        const float milliseconds = median(pass.milliseconds);
        cost.sum += milliseconds;
        cost.passes += fmt::format("{}{} {:.3f}", cost.passes.empty() ? "" : ", ", pass.name, milliseconds);
    }
    return cost;
}

}  // namespace

void run_timings(const std::string& file, const Arguments& arguments) {
    const HeadlessContext context(arguments.gl);
    const std::vector<std::string>& complaints = collect_complaints();
    const Capabilities can = capabilities(arguments.gl);
    const std::vector<glm::ivec2> sizes =
        arguments.size_given ? std::vector{arguments.size} : std::vector<glm::ivec2>{{1920, 1080}, {3840, 2160}};
    std::ofstream csv(file);
    csv << "driver,scene,light,method,knobs,width,height,ms,passes,rmse\n";
    fmt::print("{}\n{:8} {:9} {:17} {:38} {:>11} {:>9} {:>6}  {}\n", driver_name(), "scene", "light", "method", "knobs",
               "size", "ms", "RMSE", "ms of each pass");
    for (const char* name : {"spheres", "bunny", "foliage"})
        for (const std::string& kind : scenes::light_kinds())
            for (const Setting& setting : settings) {
                const scenes::Scene scene = scenes::under(scenes::make_scene(name), kind, 1.0F);
                if (!make_method(setting.method, can)->takes(scene.light) || !is_for(setting, scene)) continue;
                Viewer viewer(scene, setting.method, can, true);
                for (const std::string& knob : setting.knobs) viewer.set_knob(knob);
                const double error = error_of(viewer);
                for (const glm::ivec2 size : sizes) {
                    const Cost cost = cost_of(viewer, size, arguments.frames > 0 ? arguments.frames : 33);
                    const std::string knobs = text_of(setting.knobs);
                    csv << fmt::format("\"{}\",{},{},{},{},{},{},{:.4f},\"{}\",{:.5f}\n", driver_name(), name, kind,
                                       setting.method, knobs, size.x, size.y, cost.sum, cost.passes, error);
                    fmt::print("{:8} {:9} {:17} {:38} {:>11} {:9.3f} {:6.4f}  {}\n", name, kind, setting.method, knobs,
                               fmt::format("{}x{}", size.x, size.y), cost.sum, error, cost.passes);
                    std::fflush(stdout);
                }
            }
    if (!csv) throw std::runtime_error("cannot write " + file);
    require_none(complaints);
}

}  // namespace penumbra::opengl
