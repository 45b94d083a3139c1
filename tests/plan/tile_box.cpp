#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <penumbra/plan/tile_box.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

TEST_CASE("a box holds its points and no more, however many there are") {
    test::Random random(1);
    for (std::size_t count = 1; count <= 130; ++count) {
        std::vector<Vec3<float>> points;
        for (std::size_t i = 0; i < count; ++i)
            points.emplace_back(random.in(-3.0F, 5.0F), random.in(-1.0F, 1.0F), random.in(10.0F, 11.0F));
        points.emplace_back(1e9F, -1e9F, std::numeric_limits<float>::quiet_NaN());  // is not looked at
        const Box3<float> box = detail::box_of(points.data(), count);
        CAPTURE(count);
        for (int k = 0; k < 3; ++k) {
            float low = points[0][k], high = low;
            for (std::size_t i = 0; i < count; ++i)
                low = std::min(low, points[i][k]), high = std::max(high, points[i][k]);
            CHECK(box.min[k] >= low);
            CHECK(box.min[k] <= low);
            CHECK(box.max[k] >= high);
            CHECK(box.max[k] <= high);
        }
    }
}

TEST_CASE("a box around a point without a place is not finite") {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    for (std::size_t count = 1; count <= 67; ++count)
        for (std::size_t at = 0; at < count; ++at) {
            std::vector<Vec3<double>> points(count, Vec3<double>(1.0, 2.0, 3.0));
            points[at][static_cast<int>(at % 3)] = bad[at % 7 % 3];
            const Box3<double> box = detail::box_of(points.data(), count);
            CAPTURE(count);
            CAPTURE(at);
            CHECK_FALSE((is_finite(box.min) && is_finite(box.max)));
        }
}

TEST_CASE("a box as a light sees it holds all that it sees of its points") {
    test::Random random(2);
    for (int n = 0; n < 200; ++n) {
        const Vec3<float> normal = normalize_or(random.point(-1.0F, 1.0F), Vec3<float>(0.0F, 0.0F, 1.0F));
        const Vec3<float> u = any_perpendicular(normal);
        const LightFrame<float> frame{random.point(-1e3F, 1e3F), u, glm::cross(normal, u), normal};
        std::vector<Vec3<float>> points;
        const Vec3<float> middle = random.point(-1e3F, 1e3F);
        for (int i = 0; i < 64; ++i) points.push_back(middle + random.point(-0.1F, 0.1F));
        const Box3<float> box = detail::seen_from(frame, detail::box_of(points.data(), points.size()));
        bool holds = true;
        for (const Vec3<float>& p : points) {
            const Vec3<float> at = frame.to_light(p);
            for (int k = 0; k < 3; ++k) holds = holds && at[k] >= box.min[k] && at[k] <= box.max[k];
        }
        CHECK(holds);
    }
}
