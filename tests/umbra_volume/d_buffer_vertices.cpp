#include <doctest/doctest.h>

#include <algorithm>
#include <penumbra/umbra_volume/d_buffer_vertices.hpp>
#include <vector>

#include "support/box_mesh.hpp"

using namespace penumbra;

namespace {

const DiskLight<float> light{{0, 8, 0}, {0, -1, 0}, 1.0F};

DBufferGeometry<float> geometry_of(float radius) {
    const std::vector<Mesh<float>> casters{
        test::box_mesh<float>({0.3F, 3.0F, -0.2F}, {0.6F, 0.5F, 0.7F}),
        {{{-3, 2, -1}, {-2, 2, -1}, {-2, 2, 1}, {-3, 2, 1}}, {{0, 1, 2}, {0, 2, 3}}}};
    return d_buffer_geometry(casters, light_frame(light), radius, 256);
}

}  // namespace

TEST_CASE("casters keep their triangles and say which of them are closed") {
    const DBufferVertices vertices = d_buffer_vertices(geometry_of(light.radius), light.radius);
    CHECK(vertices.casters.size() == 8 + 4);
    REQUIRE(vertices.triangles.size() == 3 * (12 + 2));
    for (std::size_t i = 0; i < vertices.triangles.size(); ++i) {
        REQUIRE(vertices.triangles[i] < vertices.casters.size());
        CHECK(vertices.casters[vertices.triangles[i]].caster == (i < 36 ? 0.0F : -2.0F));
    }
}

TEST_CASE("depth over stretch is the depth of a side's edge, at both of its ends") {
    const DBufferGeometry<float> geometry = geometry_of(light.radius);
    const DBufferVertices vertices = d_buffer_vertices(geometry, light.radius);
    for (const auto* volume : {&vertices.umbra, &vertices.penumbra}) {
        REQUIRE(!volume->empty());
        REQUIRE(volume->size() % 3 == 0);
        int at_ends = 0;
        for (std::size_t i = 0; i < volume->size(); ++i) {
            const DBufferVolumeVertex& v = (*volume)[i];
            CHECK(v.edge == (*volume)[i / 3 * 3].edge);
            CHECK(v.caster == (*volume)[i / 3 * 3].caster);
            const HidingEdge<float>& edge = geometry.edges[static_cast<std::size_t>(v.edge)];
            CHECK(static_cast<float>(edge.mesh) == v.caster);
            const float depth = v.position.z / v.stretch;
            CHECK(depth >= std::min(edge.a.z, edge.b.z) * 0.99999F);
            CHECK(depth <= std::max(edge.a.z, edge.b.z) * 1.00001F);
            at_ends += v.stretch == 1.0F;
        }
        CHECK(at_ends >= 8);
    }
}

TEST_CASE("a light of radius 0 has no volumes") {
    const DBufferVertices vertices = d_buffer_vertices(geometry_of(0.0F), 0.0F);
    CHECK(vertices.umbra.empty());
    CHECK(vertices.penumbra.empty());
    CHECK(!vertices.triangles.empty());
}
