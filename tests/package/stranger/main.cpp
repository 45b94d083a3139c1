// A quad between a light and the ground, and shaders, in a program without exceptions that handles errors its own way.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stranger_shaders.hpp>
#include <string>

static int errors = 0;
#define PENUMBRA_ON_ERROR(message) (std::printf("error as expected: %s\n", (message)), ++errors)
#include <penumbra/penumbra.hpp>
#include <penumbra/shaders.hpp>

/// Whether all ways lead to the same text, which needs no other file.
static bool shaders_agree() {
    std::ifstream in(FLAT_SHADERS "/penumbra/occlusion_texture/shadow.glsl");
    const std::string file(std::istreambuf_iterator<char>(in), {});
    return file.size() > 10000 && file.find("\n#include") == std::string::npos &&
           file == stranger_shaders::occlusion_texture_shadow && file == penumbra::shaders::occlusion_texture_shadow &&
           stranger_shaders::files[1].path == "occlusion_texture/slice_capture.vert" &&
           stranger_shaders::files[1].text == penumbra::shaders::occlusion_texture_slice_capture_vert;
}

int main() {
    using namespace penumbra;
    const RectLight<float> light{{0, 4, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}};  // emits down
    const Mesh<float> quad{{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    const OcclusionTextureShadow<float> shadow({quad}, light);
    const float below = shadow.visibility({0, 0, 0}), beside = shadow.visibility({3, 0, 0});
    std::printf("below the quad %g, beside it %g\n", static_cast<double>(below), static_cast<double>(beside));

    Mesh<float> broken = quad;
    broken.triangles[0].x = 17;
    const OcclusionTextureShadow<float> nothing({broken}, light);
    const float without = nothing.visibility({0, 0, 0});
    std::printf("a broken mesh reports %d error, and leaves %g\n", errors, static_cast<double>(without));
    const bool agree = shaders_agree();
    std::printf("shaders agree: %d\n", agree ? 1 : 0);
    return below == 0 && beside == 1 && errors == 1 && without == 1 && agree ? 0 : 1;
}
