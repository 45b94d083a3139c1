// Meshes to take silhouettes of.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <penumbra/mesh.hpp>
#include <utility>

#include "random.hpp"

namespace penumbra::test {

/// A regular tetrahedron around 0, wound outwards.
template <class T>
Mesh<T> tetrahedron_mesh() {
    const T s = T(1);
    return {{Vec3<T>(s, s, s), Vec3<T>(s, -s, -s), Vec3<T>(-s, s, -s), Vec3<T>(-s, -s, s)},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// The unit sphere as 20 · 4^level triangles, wound outwards. Vertex 0 is at +z, vertex 11 at −z.
template <class T>
Mesh<T> icosphere(int level) {
    Mesh<double> mesh;
    const double pi5 = std::acos(-1.0) / 5.0, z = std::sqrt(0.2), r = 2.0 * z;
    mesh.positions.emplace_back(0.0, 0.0, 1.0);
    for (int k = 0; k < 10; ++k)  // 1 … 5 above, 6 … 10 below
        mesh.positions.emplace_back(r * std::cos(pi5 * (2 * (k % 5) + k / 5)),
                                    r * std::sin(pi5 * (2 * (k % 5) + k / 5)), k < 5 ? z : -z);
    mesh.positions.emplace_back(0.0, 0.0, -1.0);
    for (std::uint32_t k = 0; k < 5; ++k) {
        const std::uint32_t a = 1 + k, b = 1 + (k + 1) % 5, c = 6 + k, d = 6 + (k + 1) % 5;
        for (const glm::uvec3& t :
             {glm::uvec3(0, a, b), glm::uvec3(a, c, b), glm::uvec3(b, c, d), glm::uvec3(c, 11, d)})
            mesh.triangles.push_back(t);
    }
    for (; level > 0; --level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto next = static_cast<std::uint32_t>(mesh.positions.size());
            const auto [at, is_new] = middles.insert({std::minmax(a, b), next});
            if (is_new) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return at->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
            for (const glm::uvec3& part :
                 {glm::uvec3(t.x, ab, ca), glm::uvec3(ab, t.y, bc), glm::uvec3(ca, bc, t.z), glm::uvec3(ab, bc, ca)})
                finer.push_back(part);
        }
        mesh.triangles.swap(finer);
    }
    Mesh<T> result{{}, mesh.triangles};
    for (const glm::dvec3& p : mesh.positions) result.positions.push_back(Vec3<T>(p));
    return result;
}

/// A ring of radius 1 and thickness 0.4 around the z axis, n by m quads, wound outwards: closed and concave.
template <class T>
Mesh<T> torus_mesh(std::uint32_t n, std::uint32_t m) {
    Mesh<T> mesh;
    const double turn = 2.0 * std::acos(-1.0);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < m; ++k) {
            const double u = turn * i / n, v = turn * k / m, r = 1.0 + 0.4 * std::cos(v);
            mesh.positions.push_back(Vec3<T>(glm::dvec3(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v))));
            const std::uint32_t a = i * m + k, b = (i + 1) % n * m + k, c = (i + 1) % n * m + (k + 1) % m,
                                d = i * m + (k + 1) % m;
            mesh.triangles.emplace_back(a, b, c), mesh.triangles.emplace_back(a, c, d);
        }
    return mesh;
}

/// Triangles of random vertices: borders, edges of many faces, either winding, duplicates, faces without area.
template <class T>
Mesh<T> soup(Random& random, int vertices, int triangles) {
    Mesh<T> mesh;
    for (int i = 0; i < vertices; ++i) mesh.positions.push_back(random.point(T(-1), T(1)));
    for (int i = 0; i < triangles; ++i) {
        const auto index = [&] { return static_cast<std::uint32_t>(random.whole(0, vertices - 1)); };
        const std::uint32_t a = index(), b = index(), c = index();
        mesh.triangles.emplace_back(a, b, c);
    }
    return mesh;
}

/// Turned at random, scaled, then moved.
template <class T>
Mesh<T> placed(Mesh<T> mesh, Random& random, T scale, const Vec3<T>& center) {
    const Vec3<T> z = normalize_or(random.point(T(-1), T(1)), Vec3<T>(T(0), T(0), T(1)));
    const Vec3<T> x = any_perpendicular(z), y = glm::cross(z, x);
    for (Vec3<T>& p : mesh.positions) p = center + scale * (p.x * x + p.y * y + p.z * z);
    return mesh;
}

}  // namespace penumbra::test
