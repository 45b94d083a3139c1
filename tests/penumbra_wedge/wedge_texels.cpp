#include <doctest/doctest.h>

#include <algorithm>
#include <penumbra/penumbra_wedge/wedge_texels.hpp>
#include <stdexcept>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

/// Reads texels by the table of wedge_texels.hpp.
struct Reader {
    const Image<glm::vec4>& image;
    glm::vec4 operator()(float at, int offset = 0) const {
        const int texel = static_cast<int>(at) + offset;
        return image.data()[texel];
    }
};

bool same(const glm::vec4& texel, const Vec3<float>& xyz, float w) { return texel == glm::vec4(xyz, w); }

bool same_face(const Reader& at, float texel, const detail::WedgeFace<float>& f, float coefficient) {
    return same(at(texel), f.normal, f.depth_max) && same(at(texel, 1), f.a, coefficient) &&
           same(at(texel, 2), f.b, f.depth_min) && same(at(texel, 3), f.c, 0.0F);
}

std::vector<Mesh<float>> casters() {
    test::Random random(1);
    Mesh<float> box = test::box_mesh<float>({0.5F, 4.0F, 0.0F}, {0.3F, 0.4F, 0.3F});  // cut by the light's plane
    return {test::placed(test::torus_mesh<float>(16, 8), random, 0.8F, Vec3<float>(-1, 1, -1)), box,
            test::placed(test::soup<float>(random, 20, 40), random, 0.8F, Vec3<float>(1, 1, 0))};
}
const RectLight<float> light{{0, 4, 0}, {0.7F, 0, 0}, {0, 0, 0.4F}};

}  // namespace

TEST_CASE("texels hold every node, edge and face of the tree") {
    for (const SilhouetteFrom from : {SilhouetteFrom::point, SilhouetteFrom::light_center}) {
        const PenumbraWedgeShadow<float> shadow(casters(), light, {OverlapRule::bitmask, 32, from});
        const detail::WedgeTree<float>& tree = shadow.index().tree();
        const WedgeTexels texels = wedge_texels(shadow);
        const Reader at{texels.texels};
        REQUIRE(texels.texels.width() == 1024);
        const bool from_light = from == SilhouetteFrom::light_center;
        const auto all = detail::SilhouetteInserter<float>(tree, from_light).result();
        REQUIRE(texels.nodes == static_cast<int>(5 * all.nodes.size()));
        CHECK(texels.scale == shadow.scale());
        CHECK(texels.half_size == shadow.scaled_half_size());
        CHECK(texels.tolerance == shadow.index().tolerance());

        const auto coefficient = [&](const detail::WedgeFace<float>& f) {
            return from == SilhouetteFrom::light_center ? static_cast<float>(f.from_light) : f.solid ? 0.0F : 1.0F;
        };
        std::size_t edges = 0, fixed_edges = 0, faces = 0, beside_none = 0, caps = 0;
        for (std::size_t n = 0; n < all.nodes.size(); ++n) {
            const detail::WedgeNode<float>& node = all.nodes[n].node;
            const float texel = static_cast<float>(5 * n);
            const glm::vec4 items = at(texel, 4);
            const int traits = static_cast<int>(at(texel, 1).w);
            CHECK(same(at(texel), node.box.min, static_cast<float>(5 * node.skip)));
            CHECK(Vec3<float>(at(texel, 1)) == node.box.max);
            CHECK((traits & 1) == int(node.mesh_root));
            CHECK((traits >> 1 & 1) == int(node.piece_root));
            CHECK((traits >> 2 & 1) == int(node.in_piece));
            CHECK((traits >> 3 & 1) == int(node.solid));
            CHECK((traits >> 4 & 1) == int(node.simple));
            CHECK((traits >> 5 & 3) - 1 == node.least);
            CHECK((traits >> 7 & 3) - 1 == node.most);
            CHECK((traits >> 9 & 1) == int(all.nodes[n].points == detail::WedgePoints::beyond));
            CHECK((traits >> 10 & 1) == int(all.nodes[n].points == detail::WedgePoints::not_beyond));
            CHECK(same(at(texel, 2), node.normal_min, node.offset_min));
            CHECK(same(at(texel, 3), node.normal_max, node.offset_max));
            REQUIRE(items.y - items.x == static_cast<float>(2 * node.edge_count));
            REQUIRE(items.w - items.z == static_cast<float>(4 * node.owned_faces));
            if (all.nodes[n].is_fixed) {
                for (std::size_t e = 0; e < node.edge_count; ++e) {
                    const detail::FixedEdge<float>& edge = all.edges[node.first_edge + e];
                    const glm::vec4 a = at(items.x + static_cast<float>(2 * e));
                    const glm::vec4 b = at(items.x + static_cast<float>(2 * e), 1);
                    CHECK(Vec3<float>(a) == edge.a);
                    CHECK(Vec3<float>(b) == edge.b);
                    CHECK(std::max(a.w, b.w) == 0.0F);  // as if beside caps
                    CHECK(a.w - b.w == static_cast<float>(edge.coefficient));
                    ++fixed_edges;
                }
                continue;
            }
            for (std::size_t f = 0; f < node.face_count; ++f) {
                const detail::WedgeFace<float>& face = tree.faces[node.first_face + f];
                CHECK(same_face(at, items.z + static_cast<float>(4 * f), face, coefficient(face)));
                ++faces;
            }
            for (std::size_t e = 0; e < node.edge_count; ++e) {
                const detail::WedgeEdge<float>& edge = tree.edges[node.first_edge + e];
                const glm::vec4 a = at(items.x + static_cast<float>(2 * e));
                const glm::vec4 b = at(items.x + static_cast<float>(2 * e), 1);
                CHECK(Vec3<float>(a) == edge.a);
                CHECK(Vec3<float>(b) == edge.b);
                for (const auto& [side, local] : {std::pair(a.w, edge.left), std::pair(b.w, edge.right)}) {
                    if (local < 2) {
                        CHECK(side == (local == 0 ? 0.0F : -1.0F));
                        ++(local == 0 ? beside_none : caps);
                        continue;
                    }
                    const detail::WedgeFace<float>& face = tree.faces[node.first_face + local - 2U];
                    CHECK(same_face(at, side, face, coefficient(face)));
                }
                ++edges;
            }
        }
        CHECK(edges == tree.edges.size());
        CHECK(faces == tree.faces.size());
        CHECK(fixed_edges == all.edges.size());
        CHECK((fixed_edges > 0) == from_light);
        CHECK(beside_none > 0);
        CHECK(caps > 0);
        CHECK(texels.texels.size() < 5 * all.nodes.size() + 2 * (edges + fixed_edges) + 4 * faces + 1024);

        REQUIRE(texels.meshes.size() == 3);
        for (const glm::ivec2& mesh : texels.meshes) {
            const float first = static_cast<float>(mesh.x);
            CHECK((static_cast<int>(at(first, 1).w) & 1) == 1);
            // its silhouette, if there is one, then itself
            CHECK(at(from_light ? at(first).w : first).w == static_cast<float>(mesh.y));
        }
    }
}

TEST_CASE("without casters there are no texels") {
    const WedgeTexels texels = wedge_texels(PenumbraWedgeShadow<float>({}, light));
    CHECK(texels.texels.empty());
    CHECK(texels.nodes == 0);
}

TEST_CASE("more texels than floats can number are reported") {
    CHECK(detail::require_addressable(16777216));
    CHECK_THROWS_WITH_AS(detail::require_addressable(16777217),
                         "penumbra: a wedge index of 16777217 texels is above 16777216", std::invalid_argument);
}
