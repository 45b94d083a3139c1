#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <set>
#include <utility>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

template <class T>
DiskLight<T> some_light(test::Random& random, T radius) {
    const Vec3<T> normal = normalize_or(random.point(T(-1), T(1)), Vec3<T>(T(0), T(0), T(-1)));
    return {random.point(T(-1), T(1)), normal * random.in(T(0.5), T(2)), radius};
}

/// A mesh before a light: its vertices at depths around `depth`.
template <class T>
Mesh<T> before(const DiskLight<T>& light, const Mesh<T>& mesh, test::Random& random, T scale, T depth) {
    const LightFrame<T> frame = light_frame(light);
    const T x = random.in(T(-2), T(2)), y = random.in(T(-2), T(2));
    return test::placed(mesh, random, scale, frame.to_world(Vec3<T>(x, y, depth)));
}

bool balanced(const std::vector<VolumeEdge>& edges) {
    std::map<std::uint32_t, int> at;
    for (const VolumeEdge& e : edges) ++at[e.from], --at[e.to];
    return std::all_of(at.begin(), at.end(), [](const auto& entry) { return entry.second == 0; });
}

std::set<std::pair<std::uint32_t, std::uint32_t>> directed(const std::vector<VolumeEdge>& edges) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> result;
    for (const VolumeEdge& e : edges) result.insert({e.from, e.to});
    return result;
}

/// Whether all vertices lie on the side of the plane through an edge and `rim` on which casters lie (−1), the other
/// (1), or both (0). Those on the plane are on either.
int side_of(const Mesh<double>& mesh, const VolumeEdge& edge, const Vec3<double>& rim) {
    const Vec3<double>&a = mesh.positions[edge.from], &b = mesh.positions[edge.to];
    const Vec3<double> normal = glm::normalize(glm::cross(a - rim, b - rim));
    bool below = true, above = true;
    for (const Vec3<double>& p : mesh.positions) {
        below = below && glm::dot(normal, p - rim) < 1e-9;
        above = above && glm::dot(normal, p - rim) > -1e-9;
    }
    return below ? -1 : above ? 1 : 0;
}

}  // namespace

TEST_CASE_TEMPLATE("near and far points are where the disk is nearest and farthest, distances what they are there", T,
                   float, double) {
    test::Random random(1);
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (int i = 0; i < 2000; ++i) {
        const DiskLight<T> light = some_light<T>(random, random.in(T(0), T(3)));
        const LightFrame<T> frame = light_frame(light);
        // every third nearly parallel to the disk, or quite
        Vec3<T> normal = random.point(T(-1), T(1));
        if (i % 3 == 0) normal = frame.normal + frame.u * (i % 2 == 0 ? T(0) : random.in(T(0), T(1e-4)));
        normal = normalize_or(normal, frame.u);
        const Vec3<T> q = random.point(T(-2), T(2));
        const NearFarPoints<T> points = near_far_points(normal, light);
        const DiskDistances<T> distances = disk_distances(normal, q, light);
        double least = 1e30, largest = -1e30;
        for (int k = 0; k < 720; ++k) {
            const double angle = 2.0 * pi<double> * k / 720.0;
            const Vec3<double> rim = Vec3<double>(light.center) +
                                     static_cast<double>(light.radius) * (std::cos(angle) * Vec3<double>(frame.u) +
                                                                          std::sin(angle) * Vec3<double>(frame.v));
            const double distance = glm::dot(Vec3<double>(normal), rim - Vec3<double>(q));
            least = std::min(least, distance), largest = std::max(largest, distance);
        }
        const double sagitta = static_cast<double>(light.radius) * 1e-5, slack = 40.0 * static_cast<double>(epsilon);
        CHECK(static_cast<double>(distances.least) <= least + slack);
        CHECK(static_cast<double>(distances.least) >= least - sagitta - slack);
        CHECK(static_cast<double>(distances.largest) >= largest - slack);
        CHECK(static_cast<double>(distances.largest) <= largest + sagitta + slack);
        CHECK(std::abs(glm::dot(normal, points.near - q) - distances.least) <= T(40) * epsilon);
        CHECK(std::abs(glm::dot(normal, points.far - q) - distances.largest) <= T(40) * epsilon);
        CHECK(safe_length(points.near - light.center) <= light.radius + T(8) * epsilon);
        const DiskSight sight = disk_sight(normal, q, light);
        if (least > 1e-4 + sagitta) CHECK(sight == DiskSight::all);
        if (largest < -1e-4 - sagitta) CHECK(sight == DiskSight::none);
        if (least < -1e-4 - sagitta && largest > 1e-4 + sagitta) CHECK(sight == DiskSight::some);
    }
}

TEST_CASE("a plane parallel to the disk has the centre for both points; no normal sees nothing") {
    const DiskLight<double> light{{1, 2, 3}, {0, 0, 2}, 5.0};
    const NearFarPoints<double> points = near_far_points(Vec3<double>(0, 0, -3), light);
    CHECK(points.near == light.center);
    CHECK(points.far == light.center);
    CHECK(disk_sight(Vec3<double>(0, 0, 0), Vec3<double>(0, 0, 9), light) == DiskSight::none);
    CHECK(disk_sight(Vec3<double>(0, 0, -1), Vec3<double>(0, 0, 9), light) == DiskSight::all);
    CHECK(disk_sight(Vec3<double>(0, 0, 1), Vec3<double>(0, 0, 9), light) == DiskSight::none);
    CHECK(disk_sight(Vec3<double>(1, 0, 0), Vec3<double>(0, 0, 9), light) == DiskSight::some);
}

TEST_CASE("penumbra planes of a convex solid part it from the disk, umbra planes do not: just on its silhouettes") {
    test::Random random(2);
    int penumbra_edges = 0, umbra_edges = 0, missed = 0, checked = 0;
    for (int i = 0; i < 400; ++i) {
        const DiskLight<double> light = some_light<double>(random, random.in(0.0, i % 2 == 0 ? 0.5 : 5.0));
        const Mesh<double> shape = i % 3 == 0   ? test::box_mesh(Vec3<double>(0, 0, 0), Vec3<double>(1, 1, 0.3))
                                   : i % 3 == 1 ? test::tetrahedron_mesh<double>()
                                                : test::icosphere<double>(1);
        const Mesh<double> mesh = before(light, shape, random, random.in(0.2, 1.0), 4.0);
        const VolumeSilhouettes s = volume_silhouettes(mesh, light);
        CHECK(balanced(s.umbra));
        CHECK(balanced(s.penumbra));
        for (const VolumeEdge& e : s.penumbra) {
            const auto points = extrusion_points(mesh.positions[e.from], mesh.positions[e.to], light);
            CHECK(points.valid);
            CHECK(e.ridge);
            CHECK(side_of(mesh, e, points.penumbra) == -1);
        }
        for (const VolumeEdge& e : s.umbra) {
            const auto points = extrusion_points(mesh.positions[e.from], mesh.positions[e.to], light);
            CHECK(points.valid);
            CHECK(side_of(mesh, e, points.umbra) == -1);
        }
        penumbra_edges += static_cast<int>(s.penumbra.size()), umbra_edges += static_cast<int>(s.umbra.size());
        // and no other edge has such a plane, either way round; planes with both on one side are common, but some of
        // the disk sees past them
        const auto outer = directed(s.penumbra);
        for (const Edge& edge : edge_adjacency(mesh).edges) {
            for (const auto& [from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
                const VolumeEdge e{from, to, true};
                const auto points = extrusion_points(mesh.positions[from], mesh.positions[to], light);
                if (!points.valid) continue;
                ++checked;
                missed += (side_of(mesh, e, points.penumbra) == -1) != (outer.count({from, to}) > 0);
            }
        }
    }
    CHECK(penumbra_edges > 1000);
    CHECK(umbra_edges > 1000);
    CHECK(missed <= checked / 500);  // diagonals of a box's sides lie in its planes
}

TEST_CASE("without a radius both are the silhouette from a point, from closed, concave meshes too") {
    test::Random random(3);
    for (int i = 0; i < 60; ++i) {
        const DiskLight<double> light = some_light<double>(random, 0.0);
        const Mesh<double> mesh =
            before(light, i % 2 == 0 ? test::torus_mesh<double>(16, 8) : test::icosphere<double>(2), random,
                   random.in(0.2, 1.0), 4.0);
        const VolumeSilhouettes s = volume_silhouettes(mesh, light);
        std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
        for (const SilhouetteEdge& e : silhouette(mesh, edge_adjacency(mesh), light.center, 0.0, SilhouetteFrom::point))
            seen.insert({e.from, e.to});
        CHECK(directed(s.umbra) == seen);
        CHECK(directed(s.penumbra) == seen);
        CHECK(s.faces.empty());
        CHECK(!seen.empty());
    }
}

TEST_CASE("loops close on any mesh: sheets, soups, edges of many faces, either winding") {
    test::Random random(4);
    std::size_t edges = 0;
    for (int i = 0; i < 300; ++i) {
        const DiskLight<float> light = some_light<float>(random, i % 4 == 0 ? 0.0F : random.in(0.0F, 4.0F));
        Mesh<float> mesh = before(light, test::soup<float>(random, 9, 20), random, 1.0F, 3.0F);
        if (i % 5 == 0) mesh.triangles.resize(1);
        const VolumeSilhouettes s = volume_silhouettes(mesh, light);
        CHECK(balanced(s.umbra));
        CHECK(balanced(s.penumbra));
        edges += s.umbra.size() + s.penumbra.size();
    }
    CHECK(edges > 1000);
}

TEST_CASE("a solid inside out, and scaled, has the same silhouettes; around the light it has none") {
    test::Random random(5);
    for (int i = 0; i < 40; ++i) {
        const DiskLight<double> light = some_light<double>(random, random.in(0.0, 3.0));
        Mesh<double> mesh = before(light, test::torus_mesh<double>(12, 6), random, 0.5, 4.0);
        const VolumeSilhouettes s = volume_silhouettes(mesh, light);
        for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
        const VolumeSilhouettes turned = volume_silhouettes(mesh, light);
        CHECK(directed(turned.umbra) == directed(s.umbra));
        CHECK(directed(turned.penumbra) == directed(s.penumbra));
        for (Vec3<double>& p : mesh.positions) p *= 1024.0;
        const DiskLight<double> grown{light.center * 1024.0, light.normal, light.radius * 1024.0};
        CHECK(directed(volume_silhouettes(mesh, grown).penumbra) == directed(s.penumbra));
    }
    const Mesh<double> room = test::box_mesh(Vec3<double>(0, 0, 0), Vec3<double>(9, 9, 9));
    const VolumeSilhouettes s = volume_silhouettes(room, DiskLight<double>{{0, 0, 0}, {0, 0, 1}, 1.0});
    CHECK(s.umbra.empty());
    CHECK(s.penumbra.empty());
    CHECK(volume_silhouettes(Mesh<double>{}, DiskLight<double>{{0, 0, 0}, {0, 0, 1}, 1.0}).umbra.empty());
}

TEST_CASE("a sheet is a solid without thickness") {
    // a square that all of the disk sees: its border, once, the same for both
    const DiskLight<double> light{{0, 0, 0}, {0, 0, 1}, 1.0};
    Mesh<double> square{{{-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}}, {{0, 1, 2}, {0, 2, 3}}};
    const auto border = directed({{0, 3, true}, {3, 2, true}, {2, 1, true}, {1, 0, true}});
    CHECK(directed(volume_silhouettes(square, light).umbra) == border);
    CHECK(directed(volume_silhouettes(square, light).penumbra) == border);
    std::swap(square.triangles[1].x, square.triangles[1].y);  // any winding
    CHECK(directed(volume_silhouettes(square, light).penumbra) == border);
    // one whose plane cuts the disk: as a thin box, edges far from the axis are of the umbra, both ways round
    const Mesh<double> upright{{{0, -3, 3}, {0, 3, 3}, {0, 3, 5}, {0, -3, 5}}, {{0, 1, 2}, {0, 2, 3}}};
    const VolumeSilhouettes s = volume_silhouettes(upright, light);
    // of a thin box the side towards the disk sees all of it, those at the ends and below see nothing
    CHECK(directed(s.penumbra) == directed({{0, 1, true}, {1, 0, true}}));
    CHECK(s.umbra.size() == 6);
    CHECK(directed(s.umbra).count({2, 1}) + directed(s.umbra).count({1, 2}) == 2);
    CHECK(directed(s.umbra).count({0, 1}) + directed(s.umbra).count({1, 0}) == 0);
    CHECK(s.faces.size() == 4);  // both sides of both triangles
}

TEST_CASE("a face without area between two others changes nothing") {
    // a box with one edge split, the sliver that fills the gap included
    test::Random random(6);
    for (int i = 0; i < 50; ++i) {
        const DiskLight<double> light{
            {random.in(-1.0, 1.0), random.in(-1.0, 1.0), -4.0}, {0, 0, 1}, random.in(0.0, 2.0)};
        Mesh<double> box = test::box_mesh(Vec3<double>(0, 0, 0), Vec3<double>(1, 1, 1));
        const std::size_t plain = volume_silhouettes(box, light).penumbra.size();
        box.positions.push_back(Vec3<double>(0, -1, -1));  // on the edge from 0 to 1
        for (glm::uvec3& t : box.triangles)
            for (int k = 0; k < 3; ++k)
                if (t[k] == 0 && t[(k + 1) % 3] == 1) {
                    const std::uint32_t third = t[(k + 2) % 3];
                    t = glm::uvec3(0, 8, third);
                    box.triangles.emplace_back(8, 1, third);
                    box.triangles.emplace_back(0, 1, 8);
                    k = 3;
                    break;
                }
        CHECK(is_closed(edge_adjacency(box)));
        const VolumeSilhouettes s = volume_silhouettes(box, light);
        CHECK(balanced(s.penumbra));
        CHECK(s.penumbra.size() >= plain);
        CHECK(s.penumbra.size() <= plain + 1);
    }
}
