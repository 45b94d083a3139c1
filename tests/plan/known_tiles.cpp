#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/plan/known_tiles.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

/// Lit beyond x = 1, dark before x = −1, and between them it changes.
class SlopeShadow {
  public:
    static double at(const Vec3<double>& p) {
        return is_finite(p) ? std::min(std::max(0.5 + 0.5 * p.x, 0.0), 1.0) : 1.0;
    }
    void visibility(const Vec3<double>* points, std::size_t count, double* result) const {
        for (std::size_t i = 0; i < count; ++i) result[i] = at(points[i]);
        asked += count;
    }
    static Variation<double> known(const Box3<double>& box) {
        if (box.min.x >= 1.0) return Variation<double>::all_lit();
        Variation<double> dark;
        dark.known = box.max.x <= -1.0;
        return dark;
    }

    mutable std::size_t asked = 0;
};

const LightFrame<double> frame{Vec3<double>(0.0), Vec3<double>(1.0, 0.0, 0.0), Vec3<double>(0.0, 1.0, 0.0),
                               Vec3<double>(0.0, 0.0, 1.0)};

/// Runs of 64 neighbours.
std::vector<Vec3<double>> points_in_runs(std::size_t count, test::Random& random) {
    std::vector<Vec3<double>> points;
    double middle = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 64 == 0) middle = random.in(-3.0, 3.0);
        points.emplace_back(middle + random.in(-0.1, 0.1), random.in(-1.0, 1.0), random.in(1.0, 2.0));
    }
    return points;
}

using Query = detail::KnownTiles<double, SlopeShadow, Variation<double> (*)(const Box3<double>&)>;

}  // namespace

TEST_CASE("batches of any size are answered as the shadow answers, whoever is told how") {
    test::Random random(1);
    std::vector<std::size_t> counts = {1023, 1024, 1025, 3000};
    for (std::size_t count = 0; count <= 200; ++count) counts.push_back(count);
    const auto known = &SlopeShadow::known;
    for (const std::size_t count : counts) {
        const std::vector<Vec3<double>> points = points_in_runs(count, random);
        std::vector<double> told(count + 1, -1.0), untold(count + 1, -1.0);
        std::vector<PointAnswer> answers(count + 1, PointAnswer::shared);
        const SlopeShadow shadow;
        const Query query(shadow, known, frame);
        query(points.data(), count, told.data(), answers.data());
        const std::size_t asked = shadow.asked;
        query(points.data(), count, untold.data(), nullptr);
        double worst = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            worst = std::max({worst, std::abs(told[i] - SlopeShadow::at(points[i])), std::abs(told[i] - untold[i])});
        CAPTURE(count);
        CHECK(worst <= 0.0);
        CHECK(asked == static_cast<std::size_t>(std::count(answers.begin(), answers.end(), PointAnswer::own)));
        CHECK(told[count] < 0.0);  // nothing is written beyond
    }
}

TEST_CASE("what is known is not asked, and of what is not few boxes are looked at") {
    std::size_t boxes = 0;
    const auto known = [&](const Box3<double>& box) {
        ++boxes;
        return SlopeShadow::known(box);
    };
    const auto asked = [&](double x) {
        boxes = 0;
        const std::vector<Vec3<double>> points(64 * 256, Vec3<double>(x, 0.0, 1.0));
        std::vector<double> result(points.size());
        const SlopeShadow shadow;
        detail::KnownTiles<double, SlopeShadow, decltype(known)>(shadow, known, frame)(points.data(), points.size(),
                                                                                       result.data(), nullptr);
        return shadow.asked;
    };
    CHECK(asked(2.0) == 0);
    CHECK(boxes == 256);
    CHECK(asked(-2.0) == 256);
    CHECK(boxes == 256);
    CHECK(asked(0.0) == 64 * 256);
    CHECK(boxes < 64);
}

TEST_CASE("after what is not known, what is known is found again") {
    std::vector<Vec3<double>> points(64 * 64, Vec3<double>(0.0, 0.0, 1.0));
    for (std::size_t i = 64 * 32; i < points.size(); ++i) points[i].x = 2.0;
    std::vector<double> result(points.size());
    const SlopeShadow shadow;
    const auto known = &SlopeShadow::known;
    Query(shadow, known, frame)(points.data(), points.size(), result.data(), nullptr);
    CHECK(shadow.asked >= 64 * 32);
    CHECK(shadow.asked <= 64 * 40);
}

TEST_CASE("points without a place are asked") {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    test::Random random(3);
    const auto known = &SlopeShadow::known;
    for (int n = 0; n < 200; ++n) {
        std::vector<Vec3<double>> points = points_in_runs(static_cast<std::size_t>(random.whole(1, 700)), random);
        for (int k = random.whole(1, 4); k > 0; --k)
            points[static_cast<std::size_t>(random.whole(0, static_cast<int>(points.size()) - 1))][random.whole(0, 2)] =
                bad[random.whole(0, 2)];
        std::vector<double> result(points.size());
        const SlopeShadow shadow;
        Query(shadow, known, frame)(points.data(), points.size(), result.data(), nullptr);
        double worst = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            worst = std::max(worst, is_finite(result[i]) ? std::abs(result[i] - SlopeShadow::at(points[i])) : 1.0);
        CHECK(worst <= 0.0);
    }
}
