#include "headless.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "../pictures/picture.hpp"
#include "viewer.hpp"

namespace penumbra::opengl {
namespace {

void require_no(const std::vector<std::string>& complaints) {
    if (!complaints.empty()) throw std::runtime_error("the driver complains: " + complaints.front());
}

float median(std::deque<float> values) {
    if (values.empty()) return 0.0F;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double rmse(const std::vector<float>& visible, const std::vector<float>& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const double error = static_cast<double>(visible[i]) - static_cast<double>(truth[i]);
        sum += error * error;
    }
    return std::sqrt(sum / std::max<double>(static_cast<double>(visible.size()), 1.0));
}

Image<float> image_of(const Viewer& viewer, const Viewer::Asked& asked, const std::vector<float>& visible) {
    const glm::ivec2 size = viewer.renderer().size();
    Image<float> image(size.x, size.y, -1.0F);
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const int pixel = static_cast<int>(asked.pixels[i]);
        image(pixel % size.x, size.y - 1 - pixel / size.x) = visible[i];
    }
    return image;
}

/// Truth, method and their difference.
Image<pictures::Rgb> panels(Viewer& viewer, int rays) {
    const Viewer::Asked asked = viewer.asked();
    const std::vector<float> traced = viewer.by_rays(rays);
    const Image<float> truth = image_of(viewer, asked, traced), ours = image_of(viewer, asked, asked.visible);
    return pictures::side_by_side(
        {{fmt::format("Ray-traced truth\n{} rays a point", viewer.truth_rays()), pictures::visibility_picture(truth)},
         {fmt::format("{} on the GPU\nRMSE {:.4f}", viewer.method_name(), rmse(asked.visible, traced)),
          pictures::visibility_picture(ours)},
         {"Difference\nblue: too dark, red: too bright", pictures::difference_picture(ours, truth)}});
}

void print_comparison(const Viewer& viewer) {
    const Viewer::Asked asked = viewer.asked();
    const std::vector<float> expected = viewer.by_cpp(asked.points);
    const auto share_above = [&](float limit) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) count += std::abs(asked.visible[i] - expected[i]) > limit;
        return 100.0 * static_cast<double>(count) / static_cast<double>(expected.size());
    };
    fmt::print("against the C++: RMSE {:.5f}; off by > 1e-4 {:.3f} %, > .01 {:.3f} %, > .1 {:.3f} % of {} points\n",
               rmse(asked.visible, expected), share_above(1e-4F), share_above(0.01F), share_above(0.1F),
               expected.size());
}

void write_csv(const std::string& file, const Timers& timers, int frames) {
    std::ofstream csv(file);
    csv << "frame";
    for (const Timers::Pass& pass : timers.passes()) csv << ',' << pass.name << " ms";
    csv << '\n';
    for (int frame = 0; frame < frames; ++frame) {
        csv << frame;
        for (const Timers::Pass& pass : timers.passes())
            csv << ',' << pass.milliseconds[static_cast<std::size_t>(frame)];
        csv << '\n';
    }
    if (!csv) throw std::runtime_error("cannot write " + file);
}

}  // namespace

void run_headless(const Arguments& arguments) {
    const scenes::Scene scene = wanted_scene(arguments);
    const HeadlessContext context(arguments.gl);
    const std::vector<std::string>& complaints = collect_complaints();
    const Capabilities can = capabilities(arguments.gl);
    const std::string method = arguments.method.empty() ? methods_for(scene.light, can).front() : arguments.method;
    Viewer viewer(scene, method, can, !arguments.ordinary_depth);
    for (const std::string& knob : arguments.knobs) viewer.set_knob(knob);
    viewer.resize(arguments.size);
    viewer.show.picture = arguments.picture;
    viewer.show.split = arguments.split;

    const int frames = std::clamp(arguments.frames, 1, static_cast<int>(Timers::history));
    viewer.draw_frame();  // drivers compile as they draw
    viewer.timers().clear();
    for (int frame = 0; frame < frames; ++frame) viewer.draw_frame();
    viewer.timers().next_frame(true);
    fmt::print("{}\n{}: {} triangles, {}; {}\n", driver_name(), viewer.scene().name, viewer.scene().triangle_count(),
               scenes::text_of(viewer.scene().light), method);
    for (const Timers::Pass& pass : viewer.timers().passes())
        fmt::print("{:24} {:9.3f} ms\n", pass.name, median(pass.milliseconds));
    if (arguments.compare) print_comparison(viewer);
    if (!arguments.csv.empty()) write_csv(arguments.csv, viewer.timers(), frames);
    if (!arguments.out.empty()) {
        if (arguments.panels) {
            pictures::write_png(arguments.out, panels(viewer, arguments.rays));
        } else {
            const bool shows_truth = arguments.picture == Picture::difference || arguments.split < 1.0F;
            if (shows_truth) viewer.by_rays(arguments.rays);
            viewer.draw_frame();
            pictures::write_png(arguments.out, viewer.screenshot());
        }
    }
    require_no(complaints);
}

void run_timings(const std::string& file, const std::string& gl) {
    const HeadlessContext context(gl);
    const std::vector<std::string>& complaints = collect_complaints();
    const Capabilities can = capabilities(gl);
    std::ofstream csv(file);
    csv << "driver,scene,light,method,width,height,pass,ms,rmse\n";
    fmt::print("{}\n", driver_name());
    for (const char* name : {"spheres", "bunny", "foliage"})
        for (const std::string& kind : scenes::light_kinds()) {
            const scenes::Scene scene = scenes::under(scenes::make_scene(name), kind, 1.0F);
            for (const std::string& method : methods_for(scene.light, can)) {
                Viewer viewer(scene, method, can, true);
                viewer.resize({320, 240});
                viewer.show.light = false;
                viewer.draw_frame();
                const Viewer::Asked asked = viewer.asked();
                const double error = rmse(asked.visible, viewer.by_rays(1024));
                for (const glm::ivec2 size : {glm::ivec2(1920, 1080), glm::ivec2(3840, 2160)}) {
                    viewer.resize(size);
                    viewer.timers().clear();
                    for (int frame = 0; frame < 33; ++frame) viewer.draw_frame();
                    viewer.timers().next_frame(true);
                    float sum = 0.0F;
                    std::string passes;
                    for (const Timers::Pass& pass : viewer.timers().passes()) {
                        const float milliseconds = median(pass.milliseconds);
                        csv << fmt::format("\"{}\",{},{},{},{},{},{},{:.4f},{:.5f}\n", driver_name(), name, kind,
                                           method, size.x, size.y, pass.name, milliseconds, error);
                        if (pass.name == "surfaces") continue;
                        sum += milliseconds;
                        passes += fmt::format("{}{} {:.3f}", passes.empty() ? "" : ", ", pass.name, milliseconds);
                    }
                    fmt::print("{:8} {:9} {:18} {:4} x {:4}  {:8.3f} ms  RMSE {:.4f}  {}\n", name, kind, method, size.x,
                               size.y, sum, error, passes);
                }
            }
        }
    if (!csv) throw std::runtime_error("cannot write " + file);
    require_no(complaints);
}

}  // namespace penumbra::opengl
