// Scenes of casters over a floor under a line light, and how much of it points see, exactly.
#pragma once

#include <cmath>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <vector>

#include "support/polygon_area.hpp"
#include "support/random.hpp"

namespace penumbra::test {

/// A parallelogram around `center`.
template <class T>
Mesh<T> quad_mesh(const Vec3<T>& center, const Vec3<T>& u, const Vec3<T>& v) {
    return {{center - u - v, center + u - v, center + u + v, center - u + v}, {{0, 1, 2}, {0, 2, 3}}};
}

template <class T>
LinearLight<T> light_along_x() {
    return {Vec3<T>(T(-1), T(6), T(0)), Vec3<T>(T(1), T(6), T(0))};
}

/// World space, y up, the floor at y = 0; the light is 6 above it along x unless a scene says otherwise.
template <class T>
struct LineScene {
    const char* name;
    std::vector<Mesh<T>> casters;
    LinearLight<T> light = light_along_x<T>();
};

template <class T>
Mesh<T> line_scene_floor() {
    return quad_mesh(Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(20), T(0), T(0)), Vec3<T>(T(0), T(0), T(-20)));
}

/// The paper's blocker, Figures 2, 4 and 9: oblique to the light.
template <class T>
LineScene<T> wide_blocker() {
    return {"a wide blocker",
            {quad_mesh(Vec3<T>(T(0.2), T(2.5), T(0)), Vec3<T>(T(1.5), T(0), T(0.3)), Vec3<T>(T(-0.2), T(0), T(1)))}};
}

/// A random vector: x, y and z between the two numbers of each.
template <class T>
Vec3<T> vector_in(Random& random, const float (&x)[2], const float (&y)[2], const float (&z)[2]) {
    const T at_x = static_cast<T>(random.in(x[0], x[1])), at_y = static_cast<T>(random.in(y[0], y[1]));
    return Vec3<T>(at_x, at_y, static_cast<T>(random.in(z[0], z[1])));
}

/// Quads side by side above each other, their gaps seldom wider than the light.
template <class T>
LineScene<T> ten_quads() {
    LineScene<T> scene{"ten quads", {}};
    Random random(7);
    for (int i = 0; i < 10; ++i) {
        const Vec3<T> place(static_cast<T>(i) - T(4.5), T(0), T(0));
        const Vec3<T> center = place + vector_in<T>(random, {-0.2F, 0.2F}, {1, 2}, {-0.5F, 0.5F});
        const Vec3<T> u = vector_in<T>(random, {0.15F, 0.3F}, {-0.1F, 0.1F}, {-0.1F, 0.1F});
        scene.casters.push_back(quad_mesh(center, u, vector_in<T>(random, {-0.1F, 0.1F}, {-0.1F, 0.1F}, {0.4F, 0.8F})));
    }
    return scene;
}

/// Quads of any direction that overlap as the light sees them.
template <class T>
LineScene<T> eight_quads() {
    LineScene<T> scene{"eight random quads", {}};
    Random random(9);
    for (int i = 0; i < 8; ++i) {
        const Vec3<T> center = vector_in<T>(random, {-2, 2}, {1, 4}, {-0.8F, 0.8F});
        const Vec3<T> u = vector_in<T>(random, {0.15F, 0.4F}, {-0.3F, 0.3F}, {-0.3F, 0.3F});
        scene.casters.push_back(quad_mesh(center, u, vector_in<T>(random, {-0.3F, 0.3F}, {-0.3F, 0.3F}, {0.3F, 0.6F})));
    }
    return scene;
}

/// Figure 6: through the gap between two blockers points see the middle of the light, and neither of its ends.
template <class T>
LineScene<T> two_blockers() {
    const Vec3<T> u(T(1), T(0), T(0)), v(T(0), T(0), T(1));
    return {"two blockers",
            {quad_mesh(Vec3<T>(T(-1.21), T(2.5), T(0)), u, v), quad_mesh(Vec3<T>(T(1.2), T(2.5), T(0)), u, v)}};
}

/// 40 bars, as wide as the gaps between them.
template <class T>
LineScene<T> fence() {
    LineScene<T> scene{"a fence", {}};
    for (int i = 0; i < 40; ++i)
        scene.casters.push_back(quad_mesh(Vec3<T>(T(-3.9) + T(0.2) * static_cast<T>(i), T(2), T(0)),
                                          Vec3<T>(T(0.05), T(0), T(0)), Vec3<T>(T(0), T(0), T(0.8))));
    return scene;
}

template <class T>
std::vector<Polygon3> triangles_of(const std::vector<Mesh<T>>& meshes) {
    std::vector<Polygon3> result;
    for (const Mesh<T>& mesh : meshes)
        for (const glm::uvec3& t : mesh.triangles)
            result.push_back(
                {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])});
    return result;
}

/// Points and how much of the light they see, exactly.
template <class T>
struct LineTruth {
    std::vector<Vec3<T>> points;
    std::vector<double> visible;

    LineTruth() = default;
    LineTruth(const LineScene<T>& scene, const std::vector<Vec3<T>>& at) : points(at) {
        const std::vector<Polygon3> polygons = triangles_of(scene.casters);
        const LinearLight<double> light{glm::dvec3(scene.light.a), glm::dvec3(scene.light.b)};
        for (const Vec3<T>& point : points) visible.push_back(exact_visibility(glm::dvec3(point), light, polygons));
    }

    template <class Shadow>
    double rmse(const Shadow& shadow) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double error = static_cast<double>(shadow.visibility(points[i])) - visible[i];
            sum += error * error;
        }
        return std::sqrt(sum / static_cast<double>(points.size()));
    }
};

/// Random points of the floor around the middle.
template <class T>
std::vector<Vec3<T>> floor_points(int count, float half_x, float half_z) {
    Random random(3);
    std::vector<Vec3<T>> points;
    for (int i = 0; i < count; ++i) {
        const float x = random.in(-half_x, half_x);
        points.emplace_back(static_cast<T>(x), T(0), static_cast<T>(random.in(-half_z, half_z)));
    }
    return points;
}

}  // namespace penumbra::test
