// A quad between a light and the ground, in a program without exceptions that handles errors its own way.
#include <cstdio>

static int errors = 0;
#define PENUMBRA_ON_ERROR(message) (std::printf("error as expected: %s\n", (message)), ++errors)
#include <penumbra/penumbra.hpp>

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
    return below == 0 && beside == 1 && errors == 1 && without == 1 ? 0 : 1;
}
