// The OpenGL example in a window, on a display that nobody sees.
#include <doctest/doctest.h>
#include <stb/stb_image.h>

#include <cmath>
#include <memory>
#include <string>

#include "../../examples/opengl/context.hpp"
#include "../../examples/opengl/viewer.hpp"
#include "support/folder.hpp"

using namespace penumbra;

namespace {

std::string in_window(const std::string& options) {
    return "xvfb-run -a -s '-screen 0 1024x768x24' '" PENUMBRA_OPENGL_EXAMPLE "' " + options;
}

}  // namespace

TEST_CASE("the window shows what is drawn without one, beside its panel") {
    const test::Folder folder;
    REQUIRE(folder.run(in_window("--scene boxes --method occlusion_texture --size 900x600 --frames 4 --out w.png")));
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
        stbi_load((folder.path / "w.png").string().c_str(), &width, &height, &channels, 3), stbi_image_free);
    REQUIRE(pixels != nullptr);
    REQUIRE(width == 900);
    REQUIRE(height == 600);

    const opengl::HeadlessContext context("4.3");
    opengl::Viewer viewer(scenes::make_scene("boxes"), "occlusion_texture", opengl::capabilities("4.3"), true);
    viewer.resize({900, 600});
    viewer.draw_frame();
    const Image<pictures::Rgb> expected = viewer.screenshot();
    int different = 0, panel = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int at = 3 * (y * width + x);
            const bool differs = std::abs(pixels.get()[at] - expected(x, y).x) > 4;
            (x < 350 ? panel : different) += differs;
        }
    CHECK(different < 100);  // another route to the same driver
    CHECK(panel > 10000);
}

TEST_CASE("a window that is turned, resized to one pixel and minimised goes on without a complaint") {
    const test::Folder folder;
    CHECK(
        folder.run(in_window("--scene boxes --method occlusion_texture --size 320x240 --frames 160 --exercise "
                             "--picture shaded --split .5")));
}
