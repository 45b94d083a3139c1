// Tiles of the OpenGL example: classes are those of the C++, and where they say that all is lit, it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/plan/extents.hpp>
#include <string>
#include <vector>

#include "../../examples/opengl/context.hpp"
#include "../../examples/opengl/viewer.hpp"

using namespace penumbra;
using opengl::TileClasses;
using opengl::Viewer;

namespace {

struct Case {
    const char* scene;
    const char* light;
    const char* method;
    std::vector<std::string> knobs;
};

std::vector<std::uint8_t> texels(const opengl::Texture& classes) {
    std::vector<std::uint8_t> result(static_cast<std::size_t>(classes.size().x * classes.size().y));
    classes.bind(0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, result.data());
    return result;
}

/// Of the tile's points, with what rounding may make of their places.
Box3<float> box_of_tile(const std::vector<float>& positions, glm::ivec2 size, glm::ivec2 tile,
                        const LightFrame<float>& frame) {
    Box3<float> box = empty_box<float>();
    Vec3<float> reach(0.0F);
    const glm::ivec2 first = tile * TileClasses::size, end = glm::min(first + TileClasses::size, size);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const float* const at = &positions[static_cast<std::size_t>(4 * (y * size.x + x))];
            const Vec3<float> point(at[0], at[1], at[2]), point_ls = frame.to_light(point);
            if (at[3] == 0.0F || !(point_ls.z > 0.0F)) continue;
            box = extend(box, point_ls), reach = glm::max(reach, glm::abs(point));
        }
    if (is_empty(box)) return box;
    reach += glm::abs(frame.origin);
    const float margin = 8.0F * std::numeric_limits<float>::epsilon() * (reach.x + reach.y + reach.z);
    return {box.min - margin, box.max + margin};
}

/// Compares all classes with the C++; how many tiles with points there are of each.
std::array<int, 3> check_classes(const Viewer& viewer) {
    const opengl::TileView view = *viewer.method().tile_view();
    const std::vector<Box3<float>> casters = caster_boxes(viewer.scene(), view);
    const std::vector<float> positions = viewer.renderer().positions().floats(4);
    const std::vector<std::uint8_t> classes = texels(*viewer.tiles());
    const glm::ivec2 tiles = viewer.tiles()->size();
    std::array<int, 3> count{0, 0, 0};
    int otherwise = 0;
    for (int y = 0; y < tiles.y; ++y)
        for (int x = 0; x < tiles.x; ++x) {
            const Box3<float> tile = box_of_tile(positions, viewer.renderer().size(), {x, y}, view.frame);
            TileClass expected = TileClass::lit;
            for (const Box3<float>& caster : casters) expected = with_caster(expected, caster, tile, view.light);
            const std::uint8_t got = classes[static_cast<std::size_t>(y * tiles.x + x)];
            REQUIRE(got <= 2);
            otherwise += got != static_cast<std::uint8_t>(expected);
            count[got] += is_empty(tile) ? 0 : 1;
        }
    CHECK(otherwise == 0);
    return count;
}

void check(const Case& of, glm::ivec2 size) {
    std::string name = std::string(of.scene) + ", " + of.method;
    for (const std::string& knob : of.knobs) name += ", " + knob;
    CAPTURE(name);
    Viewer viewer(scenes::under(scenes::make_scene(of.scene), of.light, 1.0F), of.method, opengl::capabilities("4.3"),
                  true);
    for (const std::string& knob : of.knobs) viewer.set_knob(knob);
    viewer.resize(size);
    viewer.draw_frame();
    REQUIRE(viewer.tiles() == nullptr);
    const std::vector<float> asked = viewer.asked().visible;
    const Image<pictures::Rgb> plain = viewer.screenshot();

    viewer.set_knob("tiles=on");
    viewer.draw_frame();
    REQUIRE(viewer.tiles() != nullptr);
    const std::vector<float> by_tiles = viewer.asked().visible;
    REQUIRE(by_tiles.size() == asked.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < asked.size(); ++i)
        worst = std::max(worst, std::abs(static_cast<double>(by_tiles[i]) - static_cast<double>(asked[i])));
    const std::array<int, 3> count = check_classes(viewer);
    MESSAGE(name << ": " << count[0] << " tiles lit, " << count[1] << " single, " << count[2]
                 << " several; visibility changes by " << worst);
    CHECK(count[0] > 0);
    CHECK(count[1] > 0);
    CHECK(count[2] > 0);
    CHECK(worst <= 1e-5);

    viewer.set_knob("tiles=show");
    viewer.draw_frame();
    CHECK(viewer.asked().visible == by_tiles);
    const Image<pictures::Rgb> shown = viewer.screenshot();
    int colored = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) colored += plain(x, y) != shown(x, y);
    CHECK(colored > size.x * size.y / 4);
}

}  // namespace

TEST_CASE("what needs no query is seen by the whole light") {
    const opengl::HeadlessContext context("4.3");
    const std::vector<std::string>& complaints = opengl::collect_complaints();
    const Case cases[] = {{"boxes", "rectangle", "occlusion_texture", {}},
                          {"boxes", "rectangle", "penumbra_wedge", {"technique=index"}},
                          {"boxes", "disk", "umbra_volume", {"layers=2"}},
                          {"boxes", "line", "soft_shadow_map", {"mode=skins"}},
                          {"boxes", "line", "soft_shadow_map", {"mode=intervals"}}};
    for (const Case& of : cases) check(of, {100, 76});
    CHECK(complaints.empty());
}

TEST_CASE("methods that tiles spare nothing have no such knob") {
    const opengl::HeadlessContext context("4.3");
    Viewer viewer(scenes::make_scene("boxes"), "pcss", opengl::capabilities("4.3"), true);
    CHECK_THROWS(viewer.set_knob("tiles=on"));
    viewer.set_method("occlusion_texture");
    viewer.set_knob("filter=mipmap");
    CHECK_THROWS(viewer.set_knob("tiles=on"));
    viewer.set_method("penumbra_wedge");
    viewer.set_knob("tiles=on");
    viewer.set_knob("technique=rasterised");
    CHECK_THROWS(viewer.set_knob("tiles=on"));
    viewer.resize({16, 12});
    viewer.draw_frame();
    CHECK(viewer.tiles() == nullptr);
}

TEST_CASE("knobs as planned change visibility by no more than the tolerance") {
    const opengl::HeadlessContext context("4.3");
    Viewer viewer(scenes::make_scene("sheet"), "penumbra_wedge", opengl::capabilities("4.3"), true);
    viewer.resize({60, 45});
    viewer.draw_frame();
    const std::vector<float> full = viewer.asked().visible;
    const std::string words = viewer.plan(0.02F);
    CHECK(words.find("overlap: left out") != std::string::npos);
    for (const opengl::Knob& knob : viewer.knobs())
        if (knob.name == "overlap") CHECK(knob.names[static_cast<std::size_t>(knob.get())] == "additive");
    viewer.draw_frame();
    const std::vector<float> planned = viewer.asked().visible;
    REQUIRE(planned.size() == full.size());
    for (std::size_t i = 0; i < full.size(); ++i) CHECK(std::abs(planned[i] - full[i]) <= 0.02F);

    for (const char* kind : {"rectangle", "disk", "line"}) {
        viewer.set_light(scenes::as_kind(viewer.scene().light, kind));
        for (const std::string& name : opengl::methods_for(viewer.scene().light, opengl::capabilities("4.3"))) {
            viewer.set_method(name);
            CAPTURE(name);
            CHECK(viewer.plan(0.02F).empty() == (name == "pcss"));
            viewer.draw_frame();
        }
    }
}
