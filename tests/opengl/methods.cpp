// Every method of the OpenGL example on the driver: the same visibility as the C++ at the same points, and as near to
// the ray-traced truth.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../../examples/opengl/context.hpp"
#include "../../examples/opengl/measures.hpp"
#include "../../examples/opengl/viewer.hpp"

using namespace penumbra;
using opengl::Viewer;

namespace {

struct Case {
    const char* scene;
    const char* light;
    const char* method;
    std::vector<std::string> knobs;
    double rmse;   ///< against the C++
    double share;  ///< of points more than .01 off
};

void check(const Case& of, const opengl::Capabilities& can, bool reverse_depth, glm::ivec2 size) {
    std::string name = std::string(of.scene) + ", " + of.method;
    for (const std::string& knob : of.knobs) name += ", " + knob;
    CAPTURE(name);
    Viewer viewer(scenes::under(scenes::make_scene(of.scene), of.light, 1.0F), of.method, can, reverse_depth);
    for (const std::string& knob : of.knobs) viewer.set_knob(knob);
    viewer.resize(size);
    viewer.draw_frame();
    const Viewer::Asked asked = viewer.asked();
    REQUIRE(asked.points.size() > static_cast<std::size_t>(size.x * size.y / 4));
    const std::vector<float> by_cpp = viewer.by_cpp(asked.points), truth = viewer.by_rays(128);
    std::size_t off = 0, shadowed = 0;
    for (std::size_t i = 0; i < by_cpp.size(); ++i) {
        off += std::abs(asked.visible[i] - by_cpp[i]) > 0.01F;
        shadowed += by_cpp[i] < 0.5F;
    }
    const double count = static_cast<double>(by_cpp.size()), from_cpp = opengl::rmse(asked.visible, by_cpp);
    const double share = static_cast<double>(off) / count;
    const double error = opengl::rmse(asked.visible, truth), cpp_error = opengl::rmse(by_cpp, truth);
    MESSAGE(name << ": from the C++ " << from_cpp << ", " << 100.0 * share << " % off; from the truth " << error
                 << ", the C++ " << cpp_error);
    CHECK(shadowed > by_cpp.size() / 100);  // else nothing is compared
    CHECK(from_cpp <= of.rmse);
    CHECK(share <= of.share);
    CHECK(error <= 1.1 * cpp_error + 1e-4);
}

}  // namespace

TEST_CASE("every method gives the visibility of the C++, and is as near to the truth") {
    const opengl::HeadlessContext context("4.3");
    const std::vector<std::string>& complaints = opengl::collect_complaints();
    const Case cases[] = {
        {"spheres", "rectangle", "occlusion_texture", {}, 5e-4, 1e-3},
        {"bunny", "rectangle", "occlusion_texture", {"filter=n_buffer"}, 2e-4, 1e-4},
        {"foliage", "rectangle", "occlusion_texture", {"blend=scattered", "slices=16"}, 6e-4, 1e-4},
        {"spheres", "rectangle", "penumbra_wedge", {"technique=rasterised", "overlap=rectangles"}, 3e-3, 5e-3},
        {"bunny", "rectangle", "penumbra_wedge", {"technique=rasterised", "overlap=additive"}, 1e-3, 1e-3},
        {"boxes", "rectangle", "penumbra_wedge", {"technique=rasterised", "overlap=rectangles_centroid"}, 1e-3, 1e-3},
        {"spheres-disk", "disk", "umbra_volume", {"layers=1"}, 1e-3, 1e-3},
        {"bunny-disk", "disk", "umbra_volume", {"layers=2"}, 1e-3, 1e-3},
        {"concave-near", "disk", "umbra_volume", {"layers=2"}, 1e-4, 1e-4},
        {"spheres-line", "line", "soft_shadow_map", {"mode=skins", "samples=5"}, 6e-3, 1e-3},
        {"bunny-line", "line", "soft_shadow_map", {"mode=skins", "transition=linear"}, 6e-3, 1e-3},
        {"two-blockers", "line", "soft_shadow_map", {"mode=skins", "samples=5", "transition=rational"}, 1e-4, 1e-4}};
    for (const Case& of : cases) check(of, opengl::capabilities("4.3"), true, {320, 240});
    CHECK(complaints.empty());
}

TEST_CASE("the same with OpenGL 3.3 and ordinary depth") {
    const opengl::HeadlessContext context("3.3");
    const std::vector<std::string>& complaints = opengl::collect_complaints();
    const Case cases[] = {
        {"boxes", "rectangle", "occlusion_texture", {}, 2e-3, 2e-3},
        {"boxes", "rectangle", "penumbra_wedge", {"technique=rasterised", "overlap=product"}, 1e-3, 1e-3},
        {"concave-near", "disk", "umbra_volume", {"layers=2"}, 1e-4, 1e-4},
        {"fence", "line", "soft_shadow_map", {"mode=skins", "samples=3"}, 1e-4, 1e-4}};
    for (const Case& of : cases) check(of, opengl::capabilities("3.3"), false, {160, 120});
    CHECK(complaints.empty());
}

TEST_CASE("queries by textures that the host makes, on the driver") {
    const opengl::HeadlessContext context("4.3");
    const std::vector<std::string>& complaints = opengl::collect_complaints();
    const Case cases[] = {{"boxes", "rectangle", "penumbra_wedge", {"technique=index"}, 1e-3, 1e-3},
                          {"fence", "line", "soft_shadow_map", {"mode=intervals"}, 1e-5, 1e-5},
                          {"fence", "line", "soft_shadow_map", {"mode=interval_mask"}, 1e-5, 1e-5},
                          {"fence", "line", "soft_shadow_map", {"mode=hard", "samples=9"}, 1e-4, 1e-4}};
    for (const Case& of : cases) check(of, opengl::capabilities("4.3"), true, {160, 120});
    CHECK(complaints.empty());
}
