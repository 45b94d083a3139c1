#include <doctest/doctest.h>

#include <cmath>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/light_map_maker.hpp>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/box_mesh.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

template <class T>
detail::LightMapMaker<T> maker_of(const std::vector<Mesh<T>>& casters, int resolution = 256) {
    const LightFrame<T> frame = light_frame(light_along_x<T>(), Vec3<T>(T(0), T(-1), T(0)));
    return detail::LightMapMaker<T>(light_map_geometry(casters, {line_scene_floor<T>()}, frame, T(1), resolution));
}

}  // namespace

TEST_CASE_TEMPLATE("texels and slopes are each other's inverse; a point is in the same row of every map", T, float,
                   double) {
    const LightMapView<T> view{{Vec2<T>(T(-0.5), T(-0.25)), Vec2<T>(T(1.5), T(0.75))}, 100};
    CHECK(view.column(T(-0.5)) == T(0));
    CHECK(view.column(T(1.5)) == T(100));
    CHECK(view.row(T(0.25)) == T(50));
    for (int i = 0; i <= 100; ++i) {
        CHECK(view.column(view.column_slope(static_cast<T>(i))) == doctest::Approx(i).epsilon(1e-5));
        CHECK(view.row(view.row_slope(static_cast<T>(i))) == doctest::Approx(i).epsilon(1e-5));
    }
    CHECK(!view.empty());
    CHECK(LightMapView<T>().empty());
}

TEST_CASE_TEMPLATE("positions from end to end, the ends exactly", T, float, double) {
    for (const int count : {2, 3, 10, 33}) {
        CHECK(even_position(T(0.7), 0, count) == T(-0.7));
        CHECK(even_position(T(0.7), count - 1, count) == T(0.7));
        for (int i = 0; i < count; ++i) {
            const double share = static_cast<double>(i) / (count - 1);
            CHECK(static_cast<double>(even_position(T(0.7), i, count)) == doctest::Approx(1.4 * share - 0.7));
            CHECK(even_position(T(0), i, count) == T(0));
        }
    }
}

TEST_CASE_TEMPLATE("maps see what is there: depths of an oblique quad by its plane, from every position", T, float,
                   double) {
    const Vec3<T> center(T(0.2), T(3), T(0.1)), u(T(0.8), T(0.5), T(0)), v(T(0.1), T(-0.2), T(-0.7));
    const detail::LightMapMaker<T> maker = maker_of(std::vector<Mesh<T>>{quad_mesh(center, u, v)});
    const LightMapView<T>& view = maker.view();
    const LightFrame<double> frame = light_frame(LinearLight<double>{{-1, 6, 0}, {1, 6, 0}}, {0, -1, 0});
    const glm::dvec3 c = frame.to_light(glm::dvec3(center)), n = glm::cross(glm::dvec3(u), glm::dvec3(v));
    const glm::dvec3 normal(glm::dot(n, frame.u), glm::dot(n, frame.v), glm::dot(n, frame.normal));
    for (const double position : {-1.0, 0.0, 0.7}) {
        const LightMap<T> map = maker.make(static_cast<T>(position));
        int covered = 0, floor = 0;
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) {
                const glm::dvec3 ray(static_cast<double>(view.column_slope(static_cast<T>(x) + T(0.5))),
                                     static_cast<double>(view.row_slope(static_cast<T>(y) + T(0.5))), 1.0);
                floor += map.receiver(x, y) < LightMap<T>::none;
                if (map.receiver(x, y) < LightMap<T>::none)
                    CHECK(static_cast<double>(map.receiver(x, y)) == doctest::Approx(6.0).epsilon(1e-5));
                if (!(map.caster(x, y) < LightMap<T>::none)) {
                    CHECK(map.surface(x, y) == map.receiver(x, y));
                    continue;
                }
                ++covered;
                const double k = glm::dot(normal, c - glm::dvec3(position, 0, 0)), depth = k / glm::dot(normal, ray);
                CHECK(static_cast<double>(map.caster(x, y)) == doctest::Approx(depth).epsilon(2e-4));
                CHECK(map.surface(x, y) == map.caster(x, y));
                CHECK(map.blocked(x, y) >= map.caster(x, y));
                CHECK(map.blocked(x, y) < map.caster(x, y) * T(1.06));
                // the plane in the next column, and half a row on
                const double column = static_cast<double>(extent(view.slopes).x) / 256.0;
                const double next = glm::dot(normal, ray + glm::dvec3(column, 0, 0)) / k;
                CHECK(static_cast<double>(map.bend(x, y)) == doctest::Approx(next - 1.0 / depth).epsilon(1e-3));
                CHECK(map.slack(x, y) >= T(0));
                CHECK(map.slack(x, y) * map.caster(x, y) <= T(0.0201));
            }
        CHECK(covered > 3000);
        CHECK(floor > 60000);
    }
}

TEST_CASE_TEMPLATE("solids block from a little within on, never beyond their middle", T, float, double) {
    const std::vector<Mesh<T>> box{box_mesh(Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(0.5), T(0.25), T(0.5)))};
    const detail::LightMapMaker<T> maker = maker_of(box);
    CHECK(maker.farthest() == doctest::Approx(3.25));
    const LightMap<T> map = maker.make(T(0));
    int inside = 0;
    for (std::size_t i = 0; i < map.caster.size(); ++i) {
        if (!(map.caster.data()[i] < LightMap<T>::none)) continue;
        CHECK(map.blocked.data()[i] >= map.caster.data()[i]);
        CHECK(map.blocked.data()[i] <= T(3.2501));
        inside += map.caster.data()[i] < T(2.751);
    }
    CHECK(inside > 1000);
}

TEST_CASE_TEMPLATE("maps hold all penumbrae with texels to spare, and what is seen too flat is not in them", T, float,
                   double) {
    const detail::LightMapMaker<T> maker = maker_of(wide_blocker<T>().casters);
    for (const T position : {T(-1), T(0), T(1)}) {
        const LightMap<T> map = maker.make(position);
        for (int i = 0; i < 256; ++i)
            for (int edge = 0; edge < 3; ++edge) {
                CHECK(!(map.caster(edge, i) < LightMap<T>::none));
                CHECK(!(map.caster(255 - edge, i) < LightMap<T>::none));
                CHECK(!(map.caster(i, edge) < LightMap<T>::none));
                CHECK(!(map.caster(i, 255 - edge) < LightMap<T>::none));
            }
    }
    // beside the light, nearly in its plane
    const detail::LightMapMaker<T> flat = maker_of(std::vector<Mesh<T>>{
        quad_mesh(Vec3<T>(T(50), T(5.9), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(0), T(1)))});
    for (const T depth : {flat.view().slopes.max.x, -flat.view().slopes.min.x}) CHECK(depth <= T(17));
}
