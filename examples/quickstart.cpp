// The smallest use of penumbra: a quad above the ground, and how much of a light three points on the ground see.
#include <cstdio>
#include <penumbra/penumbra.hpp>

int main() {
    using namespace penumbra;
    const Mesh<float> quad{{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    const RectLight<float> light{{0, 4, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}};  // emits down
    const OcclusionTextureShadow<float> shadow({quad}, light);
    for (const Vec3<float>& point : {Vec3<float>(0, 0, 0), Vec3<float>(1.3F, 0, 0), Vec3<float>(3, 0, 0)})
        std::printf("%.1f  %.3f\n", static_cast<double>(point.x), static_cast<double>(shadow.visibility(point)));
}
