// Casters and lights by which queries that read textures are compared with the C++.
#pragma once

#include <cstddef>
#include <cstdint>
#include <penumbra/mesh.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

namespace penumbra::test {

struct Scene {
    const char* name;
    std::vector<Mesh<float>> casters;
    Vec2<float> light;  ///< its half-extents, a disk's radius first; it hangs at (0, 4, 0) and looks down
};

inline Mesh<float> scaled_at(Mesh<float> mesh, float scale, const Vec3<float>& center) {
    for (Vec3<float>& p : mesh.positions) p = p * scale + center;
    return mesh;
}

/// More than are told apart by where they are.
inline std::vector<Mesh<float>> overlapping_spheres() {
    std::vector<Mesh<float>> spheres;
    for (int i = 0; i < 30; ++i) {
        const float size = static_cast<float>(i) * 0.01F;
        spheres.push_back(scaled_at(
            icosphere<float>(i % 3 == 0 ? 2 : 1), 0.2F + size,
            {static_cast<float>(i % 6) * 0.5F - 1.25F, 1.0F + 7.0F * size, static_cast<float>(i / 6) * 0.5F - 1.0F}));
    }
    return spheres;
}
inline std::vector<Mesh<float>> standing_boxes() {
    Random random(4);
    std::vector<Mesh<float>> boxes;
    for (int i = 0; i < 12; ++i) {
        const Vec3<float> half(random.in(0.1F, 0.3F), random.in(0.1F, 1.2F), random.in(0.1F, 0.3F));
        boxes.push_back(
            box_mesh<float>({static_cast<float>(i % 4) - 1.5F, half.y, static_cast<float>(i / 4) - 1.0F}, half));
    }
    return boxes;
}
/// A wavy sheet and a sphere in one mesh, a ring that folds over itself, and triangles at random.
inline std::vector<Mesh<float>> sheets() {
    Random random(4);
    Mesh<float> sheet;
    for (int k = 0; k < 81; ++k)
        sheet.positions.emplace_back(static_cast<float>(k % 9) * 0.3F - 1.2F, 1.5F + 0.3F * static_cast<float>(k % 3),
                                     static_cast<float>(k / 9) * 0.3F - 1.2F);
    for (std::uint32_t k = 0; k < 71; ++k)
        if (k % 9 < 8) sheet.triangles.emplace_back(k, k + 1, k + 10), sheet.triangles.emplace_back(k, k + 10, k + 9);
    const Mesh<float> ball = scaled_at(icosphere<float>(1), 0.4F, {1.2F, 0.9F, 1.0F});
    for (const glm::uvec3& t : ball.triangles)
        sheet.triangles.push_back(t + static_cast<std::uint32_t>(sheet.positions.size()));
    sheet.positions.insert(sheet.positions.end(), ball.positions.begin(), ball.positions.end());
    return {sheet, placed(torus_mesh<float>(12, 8), random, 0.8F, Vec3<float>(-1, 1, -1)),
            scaled_at(soup<float>(random, 12, 20), 0.7F, {1.0F, 1.0F, -1.0F})};
}
/// A large one that covers the light's lower part with its sides out of sight, and small ones before it.
inline std::vector<Mesh<float>> large_and_small_spheres() {
    std::vector<Mesh<float>> spheres{scaled_at(icosphere<float>(3), 1.4F, {0.0F, 1.8F, 0.6F})};
    for (int i = 0; i < 8; ++i)
        spheres.push_back(scaled_at(
            icosphere<float>(1), 0.12F,
            {static_cast<float>(i % 4) * 0.5F - 0.75F, i < 4 ? 0.2F : 3.4F, static_cast<float>(i / 4) * 0.3F - 0.9F}));
    return spheres;
}
inline std::vector<Mesh<float>> casters_at_the_light() {
    return {box_mesh<float>({1.6F, 4.0F, 0.2F}, {0.3F, 1.5F, 0.4F}),
            box_mesh<float>({0.0F, 4.0F, 0.0F}, {0.2F, 0.2F, 0.2F}),  // around its centre
            scaled_at(icosphere<float>(2), 0.6F, {-1.0F, 3.9F, 0.4F}),
            {{{-2, 3, -1}, {0.4F, 5, -1.2F}, {2, 1, -0.9F}}, {{0, 1, 2}}}};
}

inline std::vector<Scene> scenes() {
    return {{"overlapping spheres", overlapping_spheres(), {0.7F, 0.4F}},
            {"standing boxes", standing_boxes(), {0.5F, 0.9F}},
            {"sheets", sheets(), {0.7F, 0.4F}},
            {"large and small", large_and_small_spheres(), {0.25F, 0.3F}},
            {"casters at the light", casters_at_the_light(), {0.7F, 0.4F}},
            {"a light of no size", standing_boxes(), {0.0F, 0.0F}},
            {"no casters", {}, {0.7F, 0.4F}}};
}

inline Vec3<float> on_caster(const std::vector<Mesh<float>>& casters, Random& random) {
    const Mesh<float>& mesh = casters[static_cast<std::size_t>(random.whole(0, static_cast<int>(casters.size()) - 1))];
    const int last = static_cast<int>(mesh.triangles.size()) - 1;
    const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(random.whole(0, last))];
    const float u = random.in(0.0F, 1.0F), v = random.in(0.0F, 1.0F - u);
    return mesh.positions[t.x] * (1.0F - u - v) + mesh.positions[t.y] * u + mesh.positions[t.z] * v;
}

/// On the ground, on casters, anywhere and behind the light.
inline std::vector<Vec3<float>> points_in(const Scene& scene, int count) {
    Random random(3);
    std::vector<Vec3<float>> points;
    for (int i = 0; i < count; ++i) {
        Vec3<float> point(random.in(-2.5F, 2.5F), 0.0F, random.in(-2.5F, 2.5F));
        if (i % 4 == 1) point.y = random.in(-0.5F, 5.0F);
        if (i % 4 == 2 && !scene.casters.empty()) point = on_caster(scene.casters, random);
        points.push_back(point);
    }
    return points;
}

/// How far a twin's visibility is from the C++'s.
struct Difference {
    double small = 2e-6;
    double worst = 0;
    int flips = 0;  ///< points at which it is above that: a cell of a mask, or an edge, was taken otherwise

    void add(float twin, float truth) {
        const double error = std::abs(static_cast<double>(twin) - static_cast<double>(truth));
        worst = error <= worst ? worst : error;  // NaN stays
        flips += error <= small ? 0 : 1;
    }
};

}  // namespace penumbra::test
