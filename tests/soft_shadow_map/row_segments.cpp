#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/soft_shadow_map/light_map_maker.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

template <class T>
RowSegments<T> segments_of(const std::vector<Mesh<T>>& casters, const std::vector<T>& positions, int resolution = 256) {
    const LightFrame<T> frame = light_frame(light_along_x<T>(), Vec3<T>(T(0), T(-1), T(0)));
    const detail::LightMapMaker<T> maker(light_map_geometry(casters, {}, frame, T(1), resolution));
    std::vector<LightMap<T>> maps;
    for (const T position : positions) maps.push_back(maker.make(position));
    std::vector<const LightMap<T>*> all;
    for (const LightMap<T>& map : maps) all.push_back(&map);
    return RowSegments<T>(maker.view(), all, T(0.01));
}

template <class T>
std::size_t count_in(const RowSegments<T>& rows, int y) {
    return rows.starts()[static_cast<std::size_t>(y) + 1] - rows.starts()[static_cast<std::size_t>(y)];
}

}  // namespace

TEST_CASE_TEMPLATE("a plane is one segment a row, from border to border, whatever maps see it", T, float, double) {
    const Vec3<T> center(T(0), T(3), T(0));
    for (const T tilt : {T(0), T(0.3), T(-0.8)}) {
        const std::vector<Mesh<T>> quad{quad_mesh(center, Vec3<T>(T(0.8), tilt, T(0)), Vec3<T>(T(0), T(0), T(-0.7)))};
        for (const std::vector<T>& positions : {std::vector<T>{T(-1), T(1)}, {T(-1), T(-0.3), T(0.4), T(1)}}) {
            const RowSegments<T> rows = segments_of(quad, positions);
            REQUIRE(rows.starts().size() == 257);
            CHECK(count_in(rows, 2) == 0);
            const RowSegment<T>& segment = rows.segments()[rows.starts()[128]];
            CHECK(count_in(rows, 128) == 1);
            const double texel = static_cast<double>(extent(rows.view().slopes).x) / 256.0;
            for (const double side : {-1.0, 1.0}) {
                const double z = 3.0 - side * static_cast<double>(tilt), slope = side * 0.8 / z;
                const RowPoint<T>& end = (side < 0.0) == (segment.a.slope < segment.b.slope) ? segment.a : segment.b;
                CHECK(std::abs(static_cast<double>(end.slope) - slope) < texel);
                CHECK(1.0 / static_cast<double>(end.inverse_depth) == doctest::Approx(z).epsilon(0.03));
            }
        }
    }
}

TEST_CASE_TEMPLATE("round casters are few segments, no nearer to the light than they are", T, float, double) {
    Mesh<T> sphere = icosphere<T>(4);
    for (Vec3<T>& p : sphere.positions) p = p * T(0.7) + Vec3<T>(T(0.2), T(3), T(0));
    const RowSegments<T> rows = segments_of<T>({sphere}, {T(-1), T(0), T(1)});
    std::size_t most = 0;
    for (int y = 0; y < 256; ++y) most = std::max(most, count_in(rows, y));
    MESSAGE(most, " segments in a row");
    CHECK(most > 4);
    CHECK(most < 60);
    for (int y = 0; y < 256; ++y)
        for (std::size_t i = rows.starts()[static_cast<std::size_t>(y)];
             i < rows.starts()[static_cast<std::size_t>(y) + 1]; ++i)
            for (const RowPoint<T>& end : {rows.segments()[i].a, rows.segments()[i].b}) {
                const double z = 1.0 / static_cast<double>(end.inverse_depth), x = static_cast<double>(end.slope) * z;
                const double row = static_cast<double>(rows.view().row_slope(static_cast<T>(y) + T(0.5)));
                const double away = glm::length(glm::dvec3(x - 0.2, 3.0 - z, row * z));
                CHECK(away < 0.7 + 0.02);  // borders go on by half a texel
            }
}

TEST_CASE_TEMPLATE("the plain test drops nothing that hides", T, float, double) {
    Random random(1);
    int dropped = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto point = [&] {
            const T z = random.in(T(0.5), T(8)), x = random.in(T(-6), T(6));
            return RowPoint<T>{x / z, T(1) / z};
        };
        const RowSegment<T> segment{point(), point()};
        const RowPoint<T> from = point();
        const T first = random.in(T(-3), T(2)), last = first + random.in(T(0), T(2));
        const LightInterval<T> hidden = hidden_interval(segment.a, segment.b, from, first, last);
        const bool hides = hidden.low < hidden.high && hidden.high - hidden.low > T(1e-5);
        const bool may = may_hide(segment, from, first, last);
        if (hides) CHECK(may);
        dropped += !may;
    }
    CHECK(dropped > 5000);
}

TEST_CASE_TEMPLATE("points on a caster are not hidden by it, points well behind are", T, float, double) {
    const std::vector<Mesh<T>> quad{
        quad_mesh(Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(0.8), T(0.3), T(0)), Vec3<T>(T(0.1), T(0.4), T(-0.7)))};
    const RowSegments<T> rows = segments_of(quad, {T(-1), T(1)});
    const LightFrame<T> frame = light_frame(light_along_x<T>(), Vec3<T>(T(0), T(-1), T(0)));
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const T s = random.in(T(-0.9), T(0.9)), t = random.in(T(-0.9), T(0.9));
        const Vec3<T> on =
            Vec3<T>(T(0), T(3), T(0)) + s * Vec3<T>(T(0.8), T(0.3), T(0)) + t * Vec3<T>(T(0.1), T(0.4), T(-0.7));
        const Vec3<T> point_ls = frame.to_light(on);
        CHECK(rows.visibility(point_ls) == T(1));
        if (std::abs(s) < T(0.3) && std::abs(t) < T(0.5))
            CHECK(rows.visibility(point_ls + Vec3<T>(T(0), T(0), T(0.2))) <= T(0.001));
    }
}
