// What is known of casters before anything is built: which cover no part of a light twice.
#include <doctest/doctest.h>

#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/plan/candidates.hpp>
#include <utility>

#include "support/box_mesh.hpp"

using namespace penumbra;

namespace {

using V = Vec3<float>;

Mesh<float> turned_over(Mesh<float> mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

/// Both in one mesh.
Mesh<float> joined(Mesh<float> a, const Mesh<float>& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + first);
    return a;
}

/// A polygon as a fan around its first corner, below a light at the origin that looks along +z.
Mesh<float> fan(const std::vector<V>& corners) {
    Mesh<float> mesh{corners, {}};
    for (std::uint32_t k = 2; k < corners.size(); ++k) mesh.triangles.emplace_back(0U, k - 1, k);
    return mesh;
}

/// Whether every piece of a mesh is simple, as the wedge index sees it.
bool all_simple(const Mesh<float>& mesh) {
    const LightFrame<float> frame{V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(0, 0, 1)};
    const detail::LitMesh<float> lit = detail::lit_mesh(mesh, frame, 1.0F, 1e-5F);
    for (const detail::Piece& piece : lit.pieces)
        if (!piece.simple) return false;
    return !lit.pieces.empty();
}

const Mesh<float> box = test::box_mesh<float>({0, 0, 5}, {1, 0.5F, 0.25F});

}  // namespace

TEST_CASE("convex solids, triangles and planar quads cover once; what may fold does not") {
    const Mesh<float> quad{{V(0, 0, 4), V(1, 0, 4), V(1, 1, 4), V(0, 1, 4)}, {{0, 1, 2}, {0, 2, 3}}};
    CHECK(detail::covers_once(box));
    CHECK(detail::covers_once(turned_over(box)));
    CHECK(detail::covers_once(quad));
    CHECK(detail::covers_once(fan({V(0, 0, 4), V(1, 0, 4), V(0, 1, 5)})));

    Mesh<float> open = box, bent = quad, folded = quad, dented = box, twice = box;
    open.triangles.pop_back();
    bent.positions[2].z = 5.0F;
    folded.triangles[1] = {0, 3, 2};
    dented.positions[7] = V(0, 0, 5);
    twice.triangles.insert(twice.triangles.end(), box.triangles.begin(), box.triangles.end());
    for (const Mesh<float>* mesh : {&open, &bent, &folded, &dented, &twice}) CHECK(!detail::covers_once(*mesh));
    CHECK(!detail::covers_once(joined(box, test::box_mesh<float>({0, 0, 7}, {1, 1, 1}))));
    CHECK(!detail::covers_once(joined(quad, quad)));
}

TEST_CASE("a solid with one face turned around does not cover once") {
    for (std::size_t i = 0; i < box.triangles.size(); ++i) {
        Mesh<float> mesh = box;
        std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
        CAPTURE(i);
        CHECK(!detail::covers_once(mesh));
    }
}

TEST_CASE("the wedge index takes flat convex sheets for simple, and no others") {
    const std::vector<V> hexagon = {V(2, 0, 4), V(1, 2, 4), V(-1, 2, 4), V(-2, 0, 4), V(-1, -2, 4), V(1, -2, 4)};
    CHECK(all_simple(fan(hexagon)));
    CHECK(all_simple(turned_over(fan(hexagon))));
    CHECK(all_simple(box));

    std::vector<V> notched = hexagon, bent = hexagon;
    notched[2] = V(0, 0.5F, 4);
    bent[3].z = 4.5F;
    CHECK(!all_simple(fan(notched)));
    CHECK(!all_simple(fan(bent)));
    // around twice: every border lies to one side of all
    std::vector<V> star = hexagon;
    star.insert(star.end(), hexagon.begin(), hexagon.end());
    CHECK(!all_simple(fan(star)));
    // with a hole in the middle
    Mesh<float> ring{hexagon, {}};
    for (const V& corner : hexagon) ring.positions.push_back(V(0.5F * corner.x, 0.5F * corner.y, corner.z));
    for (std::uint32_t k = 0; k < 6; ++k) {
        const std::uint32_t next = (k + 1) % 6;
        ring.triangles.emplace_back(k, next, 6 + next);
        ring.triangles.emplace_back(k, 6 + next, 6 + k);
    }
    CHECK(!all_simple(ring));
}
