#include "headless.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "../pictures/picture.hpp"
#include "measures.hpp"
#include "viewer.hpp"

namespace penumbra::opengl {
namespace {

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
    if (arguments.plan >= 0.0F) fmt::print("{}", viewer.plan(arguments.plan));
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
    require_none(complaints);
}

}  // namespace penumbra::opengl
