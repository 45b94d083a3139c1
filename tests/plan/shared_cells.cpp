#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <penumbra/plan/shared_cells.hpp>
#include <set>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

using V3 = Vec3<double>;

/// Follows a slope, up to waves that are as steep as the variation says.
double at(const Variation<double>& v, const LightFrame<double>& frame, const V3& point) {
    const V3 p = frame.to_light(point), q = v.turned(p);
    return glm::dot(v.slope, p) + v.along * std::sin(q.x) + v.across * std::sin(q.y) + v.deep * std::sin(q.z);
}

}  // namespace

TEST_CASE("points answer for others within a tolerance, by as few as that takes") {
    test::Random random(8);
    const V3 normal = glm::normalize(V3(0.3, -0.5, -0.8)), u = any_perpendicular(normal);
    const LightFrame<double> frame{V3(1.0, 2.0, 5.0), u, glm::cross(normal, u), normal};
    detail::SharedCells<double> cells;
    int divided = 0, few = 0;
    for (int n = 0; n < 2000; ++n) {
        CAPTURE(n);
        const double turn = random.in(0.0, 6.3), size = std::exp(random.in(-4.0, 0.0));
        Variation<double> v;
        v.known = true, v.direction = Vec2<double>(std::cos(turn), std::sin(turn)), v.slope = random.point(-1.0, 1.0);
        v.along = random.in(0.0, 1.0), v.across = random.in(0.0, 0.5), v.deep = random.in(0.0, 0.1);
        std::vector<V3> points;
        for (int k = random.whole(1, 256); k > 0; --k)
            points.push_back(
                frame.to_world(V3(random.in(0.0, size), random.in(0.0, size), random.in(0.0, size) * 0.1)));
        const double tolerance = std::exp(random.in(-5.0, -1.0));
        const auto most = static_cast<std::size_t>(random.whole(1, 256));
        if (!cells.divide(frame, points.data(), points.size(), v, tolerance, most)) {
            const double doubt = v.change(V3(size * 1.5, size * 1.5, size * 0.1));
            CHECK(doubt > tolerance);  // else one would do
            continue;
        }
        ++divided;
        std::set<std::size_t> asked;
        double worst = 0.0;
        std::size_t strange = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t by = cells.asked_for(i);
            asked.insert(by);
            strange += by >= points.size() || cells.asked_for(by) != by ? 1 : 0;
            worst = std::max(worst, std::abs(at(v, frame, points[by]) + cells.step(i) - at(v, frame, points[i])));
        }
        CHECK(strange == 0);  // who answers for others asks for itself
        CHECK(worst <= tolerance * 1.000001);
        few += asked.size() * 4 < points.size() ? 1 : 0;
    }
    CHECK(divided > 1000);
    CHECK(few > 500);
}
