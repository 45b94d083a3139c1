#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <penumbra/umbra_volume/volume.hpp>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/polygon_area.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

constexpr double far_depth = 40.0;

DiskLight<double> disk(double radius) { return {{0, 0, 0}, {0, 0, 1}, radius}; }

Mesh<double> shape(int kind, test::Random& random) {
    const Vec3<double> center(random.in(-1.0, 1.0), random.in(-1.0, 1.0), 4.0);
    const double size = random.in(0.3, 1.0);
    switch (kind) {
        case 0:
            return test::placed(test::box_mesh(Vec3<double>(0, 0, 0), Vec3<double>(1, 0.7, 0.4)), random, size, center);
        case 1:
            return test::placed(test::tetrahedron_mesh<double>(), random, size, center);
        case 2:
            return test::placed(test::icosphere<double>(1), random, size, center);
        case 3:
            return test::placed(test::torus_mesh<double>(10, 6), random, size, center);
        default:
            return test::placed(Mesh<double>{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}},
                                random, size, center);
    }
}

/// How often a closed mesh runs around a point: the sum of the solid angles of its faces.
double winding(const Mesh<double>& mesh, const Vec3<double>& p) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<double> a = mesh.positions[t.x] - p, b = mesh.positions[t.y] - p, c = mesh.positions[t.z] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                          la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2.0 * std::acos(-1.0));
}

/// Of a convex solid, what looks away from P: the rest hides behind it.
double visibility(const Mesh<double>& mesh, const DiskLight<double>& light, const Vec3<double>& p) {
    std::vector<test::Polygon3> away;
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        if (glm::dot(glm::cross(b - a, c - a), p - a) < 0.0) away.push_back({a, b, c});
    }
    return test::exact_visibility(p, light, away);
}

}  // namespace

TEST_CASE("volumes have no holes, whatever the mesh, the radius and the silhouettes") {
    test::Random random(1);
    std::size_t single = 0, volumes = 0;
    for (int i = 0; i < 250; ++i) {
        const double radius = i % 5 == 0 ? 0.0 : std::pow(10.0, random.in(-3.0, 1.0));
        const Mesh<double> mesh = shape(i % 5, random);
        const VolumeSilhouettes s = volume_silhouettes(mesh, disk(radius));
        for (const VolumeKind kind : {VolumeKind::umbra, VolumeKind::penumbra}) {
            const Mesh<double> volume = volume_mesh(mesh, s, radius, kind, far_depth, 0.3);
            if (volume.triangles.empty()) continue;
            const EdgeAdjacency adjacency = edge_adjacency(volume);
            CHECK(is_closed(adjacency));
            bool by_two = true;
            for (const Edge& e : adjacency.edges) by_two = by_two && e.count == 2;
            ++volumes, single += by_two ? 1 : 0;
            if (i % 5 < 3) CHECK(by_two);
        }
    }
    CHECK(volumes > 300);
    CHECK(single * 10 > volumes * 8);  // a torus has loops that touch, a sheet has edges there and back
}

TEST_CASE("sides lie in planes that touch the disk, and fans on the cone between") {
    test::Random random(2);
    int quads = 0, fans = 0;
    for (int i = 0; i < 200; ++i) {
        const double radius = random.in(0.1, 3.0);
        const Mesh<double> mesh = shape(i % 5, random);
        const VolumeSilhouettes s = volume_silhouettes(mesh, disk(radius));
        for (const VolumeKind kind : {VolumeKind::umbra, VolumeKind::penumbra}) {
            const auto loops = volume_sides(mesh.positions, s, radius, kind, 0.3);
            for (const auto& loop : loops) {
                for (std::size_t k = 0; k < loop.size(); ++k) {
                    const VolumeSide<double>&side = loop[k], &next = loop[k + 1 == loop.size() ? 0 : k + 1];
                    CHECK(side.b == next.a);
                    CHECK(glm::length(side.rim_b - next.rim) <= 1e-12 * radius);
                    CHECK(glm::length(side.rim) == doctest::Approx(radius));
                    CHECK(side.far_a(far_depth).z == doctest::Approx(far_depth));
                    if (side.is_fan()) {
                        ++fans;
                        CHECK(std::abs(detail::rim_angle(side.rim, side.rim_b)) <= 0.3 + 1e-9);
                        continue;
                    }
                    ++quads;
                    const Vec3<double> normal = glm::normalize(glm::cross(side.b - side.a, side.a - side.rim));
                    CHECK(std::abs(glm::dot(normal, side.far_b(far_depth) - side.rim)) <= 1e-9);
                    const double reach = radius * std::hypot(normal.x, normal.y);
                    CHECK(std::abs(std::abs(glm::dot(normal, side.rim)) - reach) <= 1e-9);
                }
            }
        }
    }
    CHECK(quads > 1000);
    CHECK(fans > 1000);
}

TEST_CASE("a convex solid's penumbra volume holds the points that see a part of the light, and no others") {
    test::Random random(3);
    int lit = 0, partly = 0, wrong_lit = 0, wrong_partly = 0;
    for (int i = 0; i < 150; ++i) {
        const double radius = random.in(0.1, 3.0);
        const Mesh<double> mesh = shape(i % 3, random);
        const VolumeSilhouettes s = volume_silhouettes(mesh, disk(radius));
        const Mesh<double> volume = volume_mesh(mesh, s, radius, VolumeKind::penumbra, far_depth, 0.05);
        for (int k = 0; k < 60; ++k) {
            const Vec3<double> p(random.in(-6.0, 6.0), random.in(-6.0, 6.0), random.in(5.5, 12.0));
            const double v = visibility(mesh, disk(radius), p);
            const double around = winding(volume, p);
            CHECK(std::abs(around - std::round(around)) < 1e-3);
            if (v >= 1.0 - 1e-12) ++lit, wrong_lit += std::abs(around) > 0.5;
            if (v < 1.0 - 1e-3) ++partly, wrong_partly += around < 0.5;
        }
    }
    CHECK(lit > 500);
    CHECK(partly > 500);
    CHECK(wrong_lit == 0);
    CHECK(wrong_partly == 0);
}

TEST_CASE("trimmed sides bound the umbra: dark on one side, not on the other") {
    test::Random random(4);
    int sides = 0;
    for (int i = 0; i < 120; ++i) {
        const double radius = i % 4 == 0 ? random.in(2.0, 4.0) : random.in(0.05, 0.6);
        const Mesh<double> mesh = shape(i % 3, random);
        const VolumeSilhouettes s = volume_silhouettes(mesh, disk(radius));
        for (const auto& loop : volume_sides(mesh.positions, s, radius, VolumeKind::umbra, 0.3)) {
            const auto polygons = trimmed_umbra(loop, 12.0);
            REQUIRE(polygons.size() == loop.size());
            for (std::size_t k = 0; k < polygons.size(); ++k) {
                const auto& polygon = polygons[k];
                if (polygon.count == 0) continue;
                Vec3<double> middle(0, 0, 0), normal(0, 0, 0);
                for (std::size_t v = 0; v < polygon.count; ++v) {
                    middle += polygon.vertices[v] / static_cast<double>(polygon.count);
                    if (v >= 2)
                        normal += glm::cross(polygon.vertices[v - 1] - polygon.vertices[0],
                                             polygon.vertices[v] - polygon.vertices[0]);
                }
                // its two sides, where there is room for them
                if (glm::length(normal) < 0.02 || middle.z < 5.5 || loop[k].is_fan()) continue;
                normal = glm::normalize(glm::cross(loop[k].b - loop[k].a, loop[k].a - loop[k].rim));
                ++sides;
                CHECK(visibility(mesh, disk(radius), middle + normal * 1e-7) == doctest::Approx(0.0).epsilon(1e-9));
                CHECK(visibility(mesh, disk(radius), middle - normal * 1e-3) > 1e-9);
            }
        }
    }
    CHECK(sides > 200);
}

TEST_CASE("of a concave loop sides end at outer corners, and fans go around the inner one") {
    const Mesh<double> corner{{{0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {1, 1, 3}, {1, 2, 3}, {0, 2, 3}},
                              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
    const VolumeSilhouettes s = volume_silhouettes(corner, disk(0.3));
    CHECK(s.umbra.size() == 6);
    const auto loops = volume_sides(corner.positions, s, 0.3, VolumeKind::umbra, 0.3);
    REQUIRE(loops.size() == 1);
    const auto polygons = trimmed_umbra(loops[0], 6.0);
    int quads = 0, fans = 0;
    for (std::size_t k = 0; k < polygons.size(); ++k) {
        if (polygons[k].count == 0) continue;
        (loops[0][k].is_fan() ? fans : quads) += 1;
        if (loops[0][k].is_fan()) CHECK(loops[0][k].from == 3);
    }
    CHECK(quads == 6);
    CHECK(fans == 6);  // a quarter turn in steps of 0.3 radians
    CHECK(volume_sides(corner.positions, VolumeSilhouettes{}, 0.3, VolumeKind::umbra, 0.3).empty());
}
