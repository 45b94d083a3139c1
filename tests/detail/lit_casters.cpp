#include <doctest/doctest.h>

#include <cmath>
#include <penumbra/detail/lit_casters.hpp>
#include <penumbra/detail/nearest_surfaces.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"

using namespace penumbra;
using detail::NearestSurfaces;

TEST_CASE_TEMPLATE("casters in light space, far from the world's origin", T, float, double) {
    const DiskLight<T> light{Vec3<T>(T(1e4), T(5), T(-2e4)), Vec3<T>(T(0), T(-1), T(0)), T(1)};
    const Mesh<T> box = test::box_mesh<T>(light.center + Vec3<T>(T(1), T(-3), T(0)), Vec3<T>(T(0.5), T(0.5), T(0.5)));
    const std::vector<Mesh<double>> lit = detail::in_light_space(std::vector<Mesh<T>>{box}, light_frame(light));
    REQUIRE(lit.size() == 1);
    CHECK(lit[0].triangles.size() == 12);
    const Box3<double> around = bounds(lit[0]);
    CHECK(around.min.z == doctest::Approx(2.5));
    CHECK(around.max.z == doctest::Approx(3.5));
    CHECK(detail::reach_of(lit) == doctest::Approx(3.5));
    CHECK(detail::reach_of({}) == 0.0);
}

TEST_CASE("what lies before the light's plane: cut there, welded, or nothing") {
    const Mesh<double> box = test::box_mesh<double>({0, 0, 0}, {1, 1, 1});
    const Mesh<double> cut = detail::lit_part(box, 0.25);
    for (const Vec3<double>& p : cut.positions) CHECK(p.z >= 0.25);
    const Box3<double> around = bounds(cut);
    CHECK(around.min.z == 0.25);
    CHECK(around.max == Vec3<double>(1, 1, 1));
    CHECK(!is_closed(edge_adjacency(cut)));  // open where it was cut
    CHECK(detail::lit_part(box, 1.5).triangles.empty());
    const Mesh<double> all = detail::lit_part(box, -2.0);
    CHECK(all.triangles.size() == 12);
    CHECK(all.positions.size() == 8);
    CHECK(is_closed(edge_adjacency(all)));
}

TEST_CASE("slopes around all shadows, with texels to spare, up to the widest") {
    const std::vector<Mesh<double>> box{test::box_mesh<double>({0, 0, 3}, {1, 0.5, 1})};
    const Rect2<double> slopes = detail::slopes_around(box, {0.5, 0.0}, 16.0, 100, 2);
    const double width = 2.0 * 1.5 / 2.0, height = 2.0 * 0.5 / 2.0;  // of what is nearest, seen from the light's ends
    CHECK(slopes.max.x == doctest::Approx(0.5 * width + 0.02 * width));
    CHECK(slopes.min.x == doctest::Approx(-slopes.max.x));
    CHECK(slopes.max.y == doctest::Approx(0.5 * height + 0.02 * height));
    const std::vector<Mesh<double>> flat{test::box_mesh<double>({0, 0, 0.011}, {1, 1, 0.01})};
    CHECK(detail::slopes_around(flat, {0.0, 0.0}, 16.0, 100).max.x == doctest::Approx(16.32));
    const Rect2<double> nothing = detail::slopes_around({}, {1.0, 1.0}, 16.0, 100);
    CHECK(!(nothing.min.x < nothing.max.x));
}

TEST_CASE("the two nearest surfaces, in any order of coming") {
    test::Random random(1);
    for (int i = 0; i < 200; ++i) {
        NearestSurfaces at;
        CHECK(at.empty());
        CHECK(!at.has_inside());
        double depths[4], first = NearestSurfaces::none, second = NearestSurfaces::none;
        for (double& depth : depths) {
            depth = random.in(1.0, 9.0);
            CHECK(at.add(depth, 0.01 * depth, true) == (depth < first));
            second = depth < first ? first : std::min(second, depth), first = std::min(first, depth);
            CHECK(at.first == first);
            CHECK(at.second == second);
            CHECK(at.slack == 0.01 * first);
        }
        CHECK(at.has_inside());
        CHECK(at.middle() == 0.5 * (first + second));
    }
    NearestSurfaces sheet;
    sheet.add(2.0, 0.0, false), sheet.add(3.0, 0.0, true);
    CHECK(!sheet.has_inside());
}

TEST_CASE("what a plane's depth changes by over a texel, at most 5 %") {
    test::Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const Vec3<double> normal = random.point(-1.0, 1.0), ray(random.in(-1.0, 1.0), random.in(-1.0, 1.0), 1.0);
        const double depth = random.in(1.0, 9.0), facing = std::abs(glm::dot(normal, ray));
        const Vec2<double> texel(0.002, 0.003);
        const double slack = detail::depth_slack(normal, ray, texel, depth);
        CHECK(slack <= 0.05 * depth * (1.0 + 1e-12));
        if (facing < 0.2) continue;
        // depth = k / (normal · ray): over a texel towards where it grows
        const double k = depth * glm::dot(normal, ray);
        double most = 0.0;
        for (const double x : {-0.5, 0.5})
            for (const double y : {-0.5, 0.5})
                most = std::max(
                    most, std::abs(k / glm::dot(normal, ray + Vec3<double>(x * texel.x, y * texel.y, 0.0)) - depth));
        CHECK(slack == doctest::Approx(2.0 * most).epsilon(0.03));
    }
    CHECK(detail::depth_slack({1, 0, 0}, {0, 0, 1}, {0.01, 0.01}, 2.0) == 2e-5);  // seen edge-on
}
