// The OpenGL example as a program: pictures, knobs at random, sizes, bad input.
#include "../../examples/opengl/viewer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "../../examples/opengl/context.hpp"
#include "support/folder.hpp"

using namespace penumbra;
using opengl::Viewer;

namespace {

/// Few and simple casters: what is tested is not their shadows.
scenes::Scene small_scene() { return scenes::make_scene("boxes"); }

bool all_in_range(const Viewer& viewer) {
    for (const float visible : viewer.renderer().visibility().floats(1))
        if (!(visible == -1.0F || (visible >= 0.0F && visible <= 1.0F))) return false;
    return true;
}

}  // namespace

TEST_CASE("knobs, lights, scenes, sizes and pictures at random leave no error") {
    const opengl::HeadlessContext context("4.3");
    const std::vector<std::string>& complaints = opengl::collect_complaints();
    const opengl::Capabilities can = opengl::capabilities("4.3");
    Viewer viewer(small_scene(), "occlusion_texture", can, true);
    std::minstd_rand random(7);
    const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    int bad = 0;
    std::string last;
    for (int frame = 0; frame < 500; ++frame) {
        if (frame % 25 == 0) viewer.set_method(opengl::method_names()[static_cast<std::size_t>(frame / 25) % 5]);
        if (frame % 20 == 10) {
            const std::size_t kind = pick(3);
            viewer.set_light(scenes::as_kind(viewer.scene().light, scenes::light_kinds()[kind]));
        }
        if (frame % 100 == 60) {
            scenes::Scene empty = small_scene();
            empty.casters.clear();
            viewer.set_scene(empty);
        }
        if (frame % 100 == 70) viewer.set_scene(small_scene());
        const std::vector<opengl::Knob> knobs = viewer.knobs();
        const opengl::Knob& knob = knobs[pick(knobs.size())];
        // large images are as good as small ones, and slower
        const double most = knob.name == "resolution" ? 200.0 : knob.most, least = std::min(knob.least, most);
        const double part = static_cast<double>(random() % 1001) / 1000.0, value = least + (most - least) * part;
        knob.set(knob.whole ? std::floor(value + 0.5) : value);
        viewer.knob_changed();
        viewer.resize({static_cast<int>(1 + pick(40)), static_cast<int>(1 + pick(30))});
        viewer.show.picture = static_cast<opengl::Picture>(pick(3));
        viewer.show.split = static_cast<float>(pick(3)) * 0.5F;
        viewer.draw_frame();
        if (complaints.empty() && all_in_range(viewer)) continue;
        ++bad;
        last = viewer.method_name() + ", " + knob.name + " = " + std::to_string(knob.get());
        break;
    }
    CAPTURE(last);
    CAPTURE(complaints);
    CHECK(bad == 0);
    CHECK(complaints.empty());
}

TEST_CASE("the truth converges, and pictures show it") {
    const opengl::HeadlessContext context("4.3");
    const opengl::Capabilities can = opengl::capabilities("4.3");
    Viewer viewer(small_scene(), "penumbra_wedge", can, true);
    viewer.resize({80, 60});
    viewer.show.split = 0.5F;
    viewer.show.light = false;
    viewer.draw_frame();
    const std::vector<float> few = viewer.by_rays(4);
    const std::vector<float> many = viewer.by_rays(opengl::Truth::most_rays);
    CHECK(viewer.truth_rays() == opengl::Truth::most_rays);
    double change = 0.0;
    for (std::size_t i = 0; i < many.size(); ++i) {
        REQUIRE(many[i] >= 0.0F);
        REQUIRE(many[i] <= 1.0F);
        change += std::abs(static_cast<double>(many[i]) - static_cast<double>(few[i]));
    }
    CHECK(change / static_cast<double>(many.size()) < 0.05);

    // left the method, right the truth: as near exact as each other here
    viewer.show.picture = opengl::Picture::visibility;
    viewer.draw_frame();
    const Image<pictures::Rgb> split = viewer.screenshot();
    viewer.show.split = 1.0F;
    viewer.draw_frame();
    const Image<pictures::Rgb> ours = viewer.screenshot();
    int different = 0, dark = 0, lit = 0;
    for (int y = 0; y < split.height(); ++y)
        for (int x = 0; x < split.width(); ++x) {
            if (std::abs(x - 40) < 2) continue;  // the bar
            different += std::abs(split(x, y).x - ours(x, y).x) > 12;
            dark += ours(x, y).x < 60, lit += ours(x, y).x == 255;
        }
    CHECK(different < 20);
    CHECK(dark > 100);
    CHECK(lit > 1000);

    viewer.show.picture = opengl::Picture::difference;
    viewer.draw_frame();
    int strong = 0;
    const Image<pictures::Rgb> difference = viewer.screenshot();
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const pictures::Rgb& color = difference.data()[i];
        strong += std::abs(color.x - color.z) > 60;
    }
    CHECK(strong < 20);
}

TEST_CASE("another camera or light begins the truth anew") {
    const opengl::HeadlessContext context("4.3");
    Viewer viewer(small_scene(), "penumbra_wedge", opengl::capabilities("4.3"), true);
    viewer.resize({40, 30});
    viewer.draw_frame();
    const std::vector<float> before = viewer.by_rays(64);
    scenes::Light light = viewer.scene().light;
    viewer.set_light(scenes::scaled(light, 2.0F));
    viewer.draw_frame();
    const std::vector<float> after = viewer.by_rays(64);
    REQUIRE(before.size() == after.size());  // the same surfaces face its centre
    CHECK(before != after);
}

TEST_CASE("what cannot be shown is told in a message that names it") {
    const test::Folder folder;
    const std::string broken = folder.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
    const std::string noise = folder.write("noise.stl", "\x01\x02\x03 not a mesh");
    CHECK_THROWS_WITH_AS(scenes::load_scene("/no/such/mesh.obj"), doctest::Contains("/no/such/mesh.obj"),
                         std::runtime_error);
    CHECK_THROWS_WITH_AS(scenes::load_scene(broken), doctest::Contains("broken.obj"), std::runtime_error);
    CHECK_THROWS_WITH_AS(scenes::load_scene(noise), doctest::Contains("noise.stl"), std::runtime_error);

    const opengl::HeadlessContext context("4.3");
    Viewer viewer(small_scene(), "occlusion_texture", opengl::capabilities("4.3"), true);
    CHECK_THROWS_WITH_AS(viewer.set_knob("slices=0"), doctest::Contains("slices"), std::runtime_error);
    CHECK_THROWS_WITH_AS(viewer.set_knob("slices=2.5"), doctest::Contains("2.5"), std::runtime_error);
    CHECK_THROWS_WITH_AS(viewer.set_knob("filter=best"), doctest::Contains("summed_area"), std::runtime_error);
    CHECK_THROWS_WITH_AS(viewer.set_knob("sloces=3"), doctest::Contains("sloces"), std::runtime_error);
    CHECK_THROWS_WITH_AS(viewer.set_method("rays"), doctest::Contains("rays"), std::runtime_error);
    CHECK_NOTHROW(viewer.set_knob("slices=5"));
}

TEST_CASE("a light that a method is not for brings another method, and the other way round") {
    const opengl::HeadlessContext context("4.3");
    const opengl::Capabilities can = opengl::capabilities("4.3");
    Viewer viewer(small_scene(), "occlusion_texture", can, true);
    viewer.resize({16, 12});
    viewer.set_light(scenes::as_kind(viewer.scene().light, "line"));
    CHECK(viewer.method_name() == "soft_shadow_map");
    viewer.set_method("umbra_volume");
    CHECK(scenes::kind_of(viewer.scene().light) == "disk");
    viewer.draw_frame();
    CHECK(all_in_range(viewer));
}
