#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <penumbra/penumbra_wedge/lit_side.hpp>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

struct Points {
    static constexpr std::size_t capacity = 64;
    std::vector<Vec3<float>> points;
    std::size_t size() const { return points.size(); }
    const Vec3<float>& operator[](std::size_t i) const { return points[i]; }
};

struct Scene {
    Mesh<float> solid;
    RectLight<float> light;
};

Scene random_scene(test::Random& random) {
    const int kind = random.whole(0, 2);
    Mesh<float> mesh =
        kind == 0 ? test::box_mesh(Vec3<float>(0.0F), random.point(0.2F, 1.5F)) : test::icosphere<float>(kind - 1);
    const Vec3<float> axis = glm::normalize(random.point(-1.0F, 1.0F) + Vec3<float>(0.0F, 0.0F, 1e-3F));
    const float angle = random.in(0.0F, 6.3F);
    for (Vec3<float>& p : mesh.positions)
        p = p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) +
            axis * glm::dot(axis, p) * (1.0F - std::cos(angle));
    Scene scene;
    scene.solid = mesh;
    scene.light.center = Vec3<float>(random.in(-2.0F, 2.0F), random.in(-2.0F, 2.0F), 5.0F);
    scene.light.half_u = Vec3<float>(random.in(0.01F, 1.5F), 0.0F, 0.0F);
    scene.light.half_v = Vec3<float>(0.0F, -random.in(0.01F, 1.5F), 0.0F);  // looks down
    return scene;
}

/// Points on faces around a vertex, some on edges and corners, some a little before the faces.
std::vector<Vec3<float>> points_on(const Mesh<float>& mesh, test::Random& random) {
    const int last = static_cast<int>(mesh.triangles.size()) - 1;
    const std::uint32_t vertex = mesh.triangles[static_cast<std::size_t>(random.whole(0, last))].x;
    const float size = std::exp(random.in(-7.0F, 0.0F)),
                before = random.whole(0, 2) == 0 ? random.in(0.0F, 0.1F) : 0.0F;
    std::vector<Vec3<float>> points;
    for (int n = 0; n < 400 && points.size() < 24; ++n) {
        const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(random.whole(0, last))];
        if (t.x != vertex && t.y != vertex && t.z != vertex) continue;
        const Vec3<float> a = mesh.positions[vertex];
        const std::uint32_t others[] = {t.x == vertex ? t.y : t.x, t.z == vertex ? t.y : t.z};
        float u = random.in(0.0F, size), v = random.in(0.0F, size);
        if (random.whole(0, 60) == 0) u = 0.0F;  // on an edge
        if (u + v > 1.0F) u = 1.0F - u, v = 1.0F - v;
        const Vec3<float> b = mesh.positions[others[0]] - a, c = mesh.positions[others[1]] - a;
        const Vec3<float> out = glm::normalize(
            glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
        points.push_back(a + b * u + c * v + out * before);
    }
    return points;
}

/// The longest part of a segment inside the solid, as a share of it.
double share_inside(const Mesh<float>& mesh, const Vec3<double>& from, const Vec3<double>& to) {
    double first = 0.0, last = 1.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<double> a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const Vec3<double> out = glm::normalize(glm::cross(b - a, c - a));
        const double at_from = glm::dot(out, from - a) + 4e-6, at_to = glm::dot(out, to - a) + 4e-6;
        if (at_from >= 0.0 && at_to >= 0.0) return 0.0;
        if (at_from > 0.0) first = std::max(first, at_from / (at_from - at_to));
        if (at_to > 0.0) last = std::min(last, at_from / (at_from - at_to));
    }
    return std::max(last - first, 0.0);
}

}  // namespace

TEST_CASE("a convex solid hides nothing from points on its lit side") {
    test::Random random(77);
    int aside = 0, all_lit = 0;
    for (int n = 0; n < 3000; ++n) {
        CAPTURE(n);
        const Scene scene = random_scene(random);
        const PenumbraWedgeShadow<float> shadow({scene.solid}, scene.light);
        const std::vector<Vec3<float>> on = points_on(scene.solid, random);
        Points points;
        Box3<float> box = empty_box<float>();
        for (const Vec3<float>& p : on) {
            points.points.push_back(detail::to_scaled_light(shadow.frame(), p, shadow.scale()));
            box = extend(box, points.points.back());
        }
        const detail::WedgeTree<float>& tree = shadow.index().tree();
        std::size_t piece = 0;
        while (!tree.nodes[piece].piece_root) ++piece;
        PointTile<float> tile;
        tile.cover(box, shadow.scaled_half_size());
        const detail::WedgeSight<float> sight{tree, shadow.index().silhouette(), shadow.index().tolerance()};
        const bool hides_nothing = detail::hides_nothing(sight, tile, points, piece);
        bool is_lit = true;
        float least = 1.0F;
        double inside = 0.0;
        for (const Vec3<float>& p : on) {
            const float seen = shadow.visibility(p);
            is_lit = is_lit && seen >= 1.0F, least = std::min(least, seen);
            for (int k = 0; k < 25 && hides_nothing; ++k) {
                const float u = static_cast<float>(k % 5) * 0.5F - 1.0F, v = static_cast<float>(k / 5) * 0.5F - 1.0F;
                const Vec3<double> to(scene.light.center + scene.light.half_u * u + scene.light.half_v * v);
                inside = std::max(inside, share_inside(scene.solid, Vec3<double>(p), to));
            }
        }
        aside += hides_nothing ? 1 : 0, all_lit += is_lit ? 1 : 0;
        if (!hides_nothing) continue;
        CHECK(least >= 1.0F - 1e-5F);
        CHECK(inside <= 0.0);
    }
    MESSAGE(aside);
    CHECK(aside * 3 > all_lit);
    CHECK(all_lit > 500);
}

TEST_CASE("a face opens for points that are before it, or on it and not near its border") {
    detail::WedgeFace<float> face{};
    face.normal = Vec3<float>(0.0F, 0.0F, -1.0F);
    face.a = Vec3<float>(-1.0F, -1.0F, 2.0F), face.b = Vec3<float>(0.0F, 1.0F, 2.0F);
    face.c = Vec3<float>(1.0F, -1.0F, 2.0F);
    const Vec2<float> light(0.5F, 0.5F);
    const detail::LitFace<float> lit(face, light, 1e-3F);
    CHECK(lit.faces_light());
    CHECK(lit.opens(Vec3<float>(0.0F, 0.0F, 1.9F)));
    CHECK(lit.opens(Vec3<float>(5.0F, 0.0F, 1.9F)));  // before the plane: the solid is behind it
    CHECK(lit.opens(Vec3<float>(0.0F, 0.0F, 2.0F)));
    CHECK(lit.opens(Vec3<float>(0.0F, 0.0F, 2.0005F)));
    CHECK(!lit.opens(Vec3<float>(0.0F, 0.0F, 2.002F)));    // behind it
    CHECK(!lit.opens(Vec3<float>(0.0F, -1.0F, 2.0005F)));  // the border hides some of the light
    CHECK(!lit.opens(Vec3<float>(0.0F, -0.9995F, 2.0005F)));
    CHECK(lit.opens(Vec3<float>(0.0F, -0.98F, 2.0005F)));
    CHECK(!lit.opens(Vec3<float>(2.0F, 0.0F, 2.0F)));  // beside it, as far as rounding tells
    detail::WedgeFace<float> edge_on{};                // to parts of a wider light
    edge_on.normal = Vec3<float>(1.0F, 0.0F, 0.0F);
    edge_on.a = face.a, edge_on.b = Vec3<float>(-1.0F, 1.0F, 2.0F), edge_on.c = Vec3<float>(-1.0F, 0.0F, 3.0F);
    CHECK(detail::LitFace<float>(edge_on, light, 1e-3F).faces_light());
    const Vec2<float> wide(1.5F, 0.5F);  // some of which is behind the plane
    CHECK(!detail::LitFace<float>(edge_on, wide, 1e-3F).faces_light());
}
