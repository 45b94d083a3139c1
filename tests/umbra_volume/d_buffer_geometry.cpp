#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/d_buffer_geometry.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

const DiskLight<float> light{{0, 8, 0}, {0, -1, 0}, 1.0F};

/// A solid, and a sheet beside it.
std::vector<Mesh<float>> solid_and_sheet() {
    return {test::box_mesh<float>({0.3F, 3.0F, -0.2F}, {0.6F, 0.5F, 0.7F}),
            {{{-3, 2, -1}, {-2, 2, -1}, {-2, 2, 1}, {-3, 2, 1}}, {{0, 1, 2}, {0, 2, 3}}}};
}

}  // namespace

TEST_CASE("the image holds all casters and what the light's rim sees past them") {
    const LightFrame<float> frame = light_frame(light);
    const DBufferGeometry<float> geometry = d_buffer_geometry(solid_and_sheet(), frame, light.radius, 256);
    for (const Mesh<float>& mesh : solid_and_sheet())
        for (const Vec3<float>& p : mesh.positions) {
            const Vec3<float> at = frame.to_light(p);
            CHECK(at.z >= static_cast<float>(geometry.near));
            for (int k = 0; k < 16; ++k) {
                const float angle = static_cast<float>(k) * 0.3927F;
                const Vec2<float> slope((at.x - light.radius * std::cos(angle)) / at.z,
                                        (at.y - light.radius * std::sin(angle)) / at.z);
                CHECK(slope.x > geometry.slopes.min.x);
                CHECK(slope.y > geometry.slopes.min.y);
                CHECK(slope.x < geometry.slopes.max.x);
                CHECK(slope.y < geometry.slopes.max.y);
            }
        }
}

TEST_CASE("a box has one loop of each kind, a sheet one for both; each side knows its edge") {
    const DBufferGeometry<float> geometry = d_buffer_geometry(solid_and_sheet(), light_frame(light), light.radius, 256);
    REQUIRE(geometry.casters.size() == 2);
    CHECK(geometry.casters[0].solid);
    CHECK(!geometry.casters[1].solid);
    for (std::uint32_t m = 0; m < 2; ++m) {
        const DBufferCaster& caster = geometry.casters[m];
        int quads[2] = {0, 0};
        for (const DBufferSide& side : caster.sides) {
            REQUIRE(side.edge < geometry.edges.size());
            const HidingEdge<float>& edge = geometry.edges[side.edge];
            CHECK(edge.mesh == m);
            CHECK(side.side.ridge);
            CHECK(!side.side.crossed);
            if (side.side.is_fan()) continue;
            ++quads[side.side.kind == VolumeKind::umbra ? 0 : 1];
            CHECK(edge.a == Vec3<float>(side.side.a));
            CHECK(edge.b == Vec3<float>(side.side.b));
        }
        CHECK(quads[0] >= 4);
        CHECK(quads[1] >= 4);
        for (const DBufferFace& face : caster.faces) {
            CHECK(face.face < caster.mesh.triangles.size());
            CHECK(face.edge < geometry.edges.size());
        }
    }
}

TEST_CASE("casters behind the light leave nothing to draw") {
    const std::vector<Mesh<float>> behind{test::box_mesh<float>({0, 12, 0}, {1, 1, 1})};
    const DBufferGeometry<float> geometry = d_buffer_geometry(behind, light_frame(light), light.radius, 64);
    CHECK(!(geometry.slopes.min.x < geometry.slopes.max.x));
    REQUIRE(geometry.casters.size() == 1);
    CHECK(geometry.casters[0].mesh.triangles.empty());
    CHECK(geometry.casters[0].sides.empty());
    CHECK(geometry.edges.empty());
}

TEST_CASE("a D-buffer does not depend on the order in which a mesh's triangles come") {
    test::Random random(5);
    std::vector<Mesh<float>> casters = solid_and_sheet();
    casters.push_back(test::box_mesh<float>({0.9F, 4.5F, 0.4F}, {0.4F, 0.3F, 0.5F}));
    const DBuffer<float> before(casters, light_frame(light), light.radius, 128, 2);
    for (Mesh<float>& mesh : casters) std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    const DBuffer<float> after(casters, light_frame(light), light.radius, 128, 2);
    int shadowed = 0;
    for (int i = 0; i < 4000; ++i) {
        const float x = random.in(-3.0F, 3.0F), y = random.in(-3.0F, 3.0F);
        const Vec3<float> point(x, y, 8.0F);
        const float a = before.visibility(point, CutVisibility::exact, CutShare::edge);
        const float b = after.visibility(point, CutVisibility::exact, CutShare::edge);
        shadowed += a < 1.0F;
        CHECK(static_cast<double>(a) == doctest::Approx(static_cast<double>(b)).epsilon(1e-5));
    }
    CHECK(shadowed > 400);
}
