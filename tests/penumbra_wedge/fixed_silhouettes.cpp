#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/penumbra_wedge/coverage.hpp>
#include <penumbra/penumbra_wedge/fixed_silhouettes.hpp>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

using Tree = detail::TreeWithSilhouettes<float>;

const RectLight<float> light{{0, 4, 0}, {0.7F, 0, 0}, {0, 0, 0.4F}};

std::vector<Mesh<float>> casters() {
    test::Random random(1);
    return {test::placed(test::torus_mesh<float>(16, 8), random, 0.8F, Vec3<float>(-1, 1, -1)),
            test::box_mesh<float>({0.5F, 4.0F, 0.0F}, {0.3F, 0.4F, 0.3F}),  // cut by the light's plane
            test::placed(test::soup<float>(random, 20, 40), random, 0.8F, Vec3<float>(1, 1, 0))};
}

PenumbraWedgeShadow<float> shadow_of(const std::vector<Mesh<float>>& meshes) {
    return PenumbraWedgeShadow<float>(meshes, light, {OverlapRule::additive, 32, SilhouetteFrom::light_center});
}

}  // namespace

TEST_CASE("beyond a mesh its fixed silhouette blocks what the tree's edges do") {
    test::Random random(2);
    for (const Mesh<float>& mesh : casters()) {
        const PenumbraWedgeShadow<float> shadow = shadow_of({mesh});
        const Tree all = detail::SilhouetteInserter<float>(shadow.index().tree(), true).result();
        const Vec2<float> half = shadow.scaled_half_size();
        const Rect2<float> box{-half, half};
        int shaded = 0;
        for (int i = 0; i < 500; ++i) {
            const Vec3<float> point(random.in(-3.0F, 3.0F), -1.5F, random.in(-3.0F, 3.0F));
            const Vec3<float> p = shadow.frame().to_light(point) * shadow.scale();
            float sum = 0.0F;
            for (const detail::FixedEdge<float>& e : all.edges) {
                const auto seen = [&](const Vec3<float>& v) {
                    return Vec2<float>(p) + Vec2<float>(v - p) * (p.z / (p.z - v.z));
                };
                sum += static_cast<float>(e.coefficient) * edge_coverage(seen(e.a), seen(e.b), box);
            }
            const float blocked = saturate(sum / area(box));
            CHECK(std::abs(blocked + shadow.visibility(point) - 1.0F) < 4e-5F);
            shaded += blocked > 0.01F && blocked < 0.99F ? 1 : 0;
        }
        CHECK(shaded > 20);
    }
}

TEST_CASE("silhouettes are put before the meshes that they are of; all else stays as it is") {
    const PenumbraWedgeShadow<float> shadow = shadow_of(casters());
    const detail::WedgeTree<float>& tree = shadow.index().tree();
    const Tree all = detail::SilhouetteInserter<float>(tree, true).result();
    std::size_t of_tree = 0, fixed_edges = 0, meshes = 0;
    for (std::size_t n = 0; n < all.nodes.size(); ++n) {
        const Tree::Node& at = all.nodes[n];
        CHECK(at.node.skip > n);
        CHECK(at.node.skip <= all.nodes.size());
        if (at.points == detail::WedgePoints::beyond) {
            const Tree::Node& mesh = all.nodes[at.node.skip];
            CHECK(at.is_fixed);
            CHECK(at.node.mesh_root);
            CHECK(at.node.box.min == mesh.node.box.min);
            CHECK(at.node.box.max == mesh.node.box.max);
            CHECK(mesh.points == detail::WedgePoints::not_beyond);
            CHECK(mesh.node.mesh_root);
            ++meshes;
        }
        if (!at.is_fixed) {
            const detail::WedgeNode<float>& same = tree.nodes[of_tree++];
            CHECK(at.node.first_edge == same.first_edge);
            CHECK(at.node.edge_count == same.edge_count);
            CHECK(at.node.box.min == same.box.min);
            // what is beyond a node begins with the silhouette, if it begins with a mesh
            std::size_t skipped = 0;
            for (std::size_t k = n; k < at.node.skip; ++k) skipped += all.nodes[k].is_fixed ? 0 : 1;
            CHECK(of_tree - 1 + skipped == same.skip);
            continue;
        }
        CHECK(at.node.edge_count <= 8);
        for (std::size_t e = 0; e < at.node.edge_count; ++e) {
            const detail::FixedEdge<float>& edge = all.edges[at.node.first_edge + e];
            CHECK(edge.coefficient != 0);
            CHECK(glm::min(edge.a, at.node.box.min) == at.node.box.min);
            CHECK(glm::max(edge.b, at.node.box.max) == at.node.box.max);
            ++fixed_edges;
        }
    }
    CHECK(of_tree == tree.nodes.size());
    CHECK(fixed_edges == all.edges.size());
    CHECK(meshes == 3);
    CHECK(all.edges.size() < tree.edges.size());
}

TEST_CASE("without silhouettes the tree is what it was") {
    const PenumbraWedgeShadow<float> shadow = shadow_of(casters());
    const detail::WedgeTree<float>& tree = shadow.index().tree();
    const Tree all = detail::SilhouetteInserter<float>(tree, false).result();
    REQUIRE(all.nodes.size() == tree.nodes.size());
    CHECK(all.edges.empty());
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        CHECK(all.nodes[n].node.skip == tree.nodes[n].skip);
        CHECK(all.nodes[n].points == detail::WedgePoints::all);
    }
    CHECK(detail::SilhouetteInserter<float>({}, true).result().nodes.empty());
}
