#include <doctest/doctest.h>

#include <penumbra/soft_shadow_map/light_map_geometry.hpp>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/box_mesh.hpp"

using namespace penumbra;
using namespace penumbra::test;

TEST_CASE_TEMPLATE("a light's maps face the middle of all casters; depths, solids and the step are theirs", T, float,
                   double) {
    const Mesh<T> box = box_mesh(Vec3<T>(T(0.5), T(3), T(1)), Vec3<T>(T(0.5), T(0.25), T(0.5)));
    const Mesh<T> quad =
        quad_mesh(Vec3<T>(T(-0.5), T(2.5), T(-1)), Vec3<T>(T(0.5), T(0), T(0)), Vec3<T>(T(0), T(0), T(0.5)));
    const LightMapGeometry<T> all =
        light_map_geometry<T>({box, quad}, {line_scene_floor<T>()}, light_along_x<T>(), 100);
    CHECK(all.half_length == T(1));
    CHECK(all.frame.origin == Vec3<T>(T(0), T(6), T(0)));
    CHECK(all.frame.u.x == doctest::Approx(1));
    CHECK(all.frame.normal.y == doctest::Approx(-1));  // straight above the middle
    REQUIRE(all.casters.size() == 2);
    CHECK(all.casters[0].solid);
    CHECK(!all.casters[1].solid);
    REQUIRE(all.receivers.size() == 1);
    CHECK(all.nearest == doctest::Approx(2.75));
    CHECK(all.farthest == doctest::Approx(3.5));
    CHECK(all.near == doctest::Approx(1e-6 * 20.0));
    CHECK(all.step(0.0F) == doctest::Approx(3.5e-3));
    CHECK(all.step(0.25F) == T(0.25));
    CHECK(all.view.resolution == 100);
    // what is nearest and farthest to the side, seen from the light's ends, and four texels
    const T width = all.view.slopes.max.x - all.view.slopes.min.x;
    CHECK(all.view.slopes.max.x == doctest::Approx(2.0 / 2.75 + 0.04 * (2.0 / 2.75 + 2.0 / 3.5) / 1.08).epsilon(0.01));
    CHECK(all.view.column(all.view.slopes.min.x + width) == doctest::Approx(100));
}

TEST_CASE_TEMPLATE("without casters, or with none before the light: an empty image", T, float, double) {
    CHECK(light_map_geometry<T>({}, {line_scene_floor<T>()}, light_along_x<T>(), 64).view.empty());
    const LightFrame<T> up = light_frame(light_along_x<T>(), Vec3<T>(T(0), T(1), T(0)));
    const LightMapGeometry<T> behind = light_map_geometry<T>({line_scene_floor<T>()}, {}, up, T(1), 64);
    CHECK(behind.view.empty());
    CHECK(behind.nearest == 0.0);
    CHECK(behind.farthest == 0.0);
    CHECK(behind.casters[0].mesh.triangles.empty());
}

TEST_CASE_TEMPLATE("a light of no length has an image, and what crosses its plane is cut", T, float, double) {
    const LinearLight<T> point{Vec3<T>(T(0), T(6), T(0)), Vec3<T>(T(0), T(6), T(0))};
    const Mesh<T> column = box_mesh(Vec3<T>(T(3), T(4), T(0)), Vec3<T>(T(0.5), T(3), T(0.5)));
    const LightFrame<T> down = light_frame(point, Vec3<T>(T(0), T(-1), T(0)));
    const LightMapGeometry<T> all = light_map_geometry<T>({column, wide_blocker<T>().casters[0]}, {}, down, T(0), 64);
    CHECK(light_map_geometry<T>(wide_blocker<T>().casters, {}, point, 64).half_length == T(0));
    CHECK(!all.view.empty());
    CHECK(all.nearest >= all.near);
    CHECK(all.view.slopes.max.x <= T(LightMapGeometry<T>::widest * 1.1));
    CHECK(!all.casters[0].solid);
}
