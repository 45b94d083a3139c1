#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>

#include "support/random.hpp"

using namespace penumbra;
using test::Random;

namespace {

/// A point at x and depth z.
template <class T>
RowPoint<T> at(double x, double z) {
    return {static_cast<T>(x / z), static_cast<T>(1.0 / z)};
}

/// Where the line from (px, pz) through (ex, ez) meets the light's line: plain geometry.
double light_position(double ex, double ez, double px, double pz) { return px + (ex - px) * pz / (pz - ez); }

}  // namespace

TEST_CASE_TEMPLATE("points appear where they are seen from a position", T, float, double) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.in(-3.0, 3.0), z = random.in(0.5, 9.0), p = random.in(-2.0, 2.0);
        const double error = std::abs(static_cast<double>(slope_from(at<T>(x, z), static_cast<T>(p))) - (x - p) / z);
        CHECK(error <
              16.0 * static_cast<double>(std::numeric_limits<T>::epsilon()) * (std::abs(x / z) + std::abs(p / z)));
    }
}

TEST_CASE_TEMPLATE("past an edge, the light's part beyond the line through point and edge", T, float, double) {
    Random random(2);
    double worst = 0.0;
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const double ez = random.in(0.5, 6.0), pz = ez + random.in(0.1, 6.0);
        const double ex = random.in(-2.0, 2.0), px = random.in(-4.0, 4.0);
        double hidden = random.in(-2.0, 2.0), seen = random.in(-2.0, 2.0);
        if (std::abs(seen - hidden) < 0.05) continue;
        const double truth = clamp((seen - light_position(ex, ez, px, pz)) / (seen - hidden), 0.0, 1.0);
        const double visible = static_cast<double>(
            edge_visibility(at<T>(ex, ez), at<T>(px, pz), static_cast<T>(hidden), static_cast<T>(seen)));
        const double nearer = 1.0 / ez - 1.0 / pz, size = std::abs(ex / ez) + std::abs(px / pz) + 4.0 / ez;
        const double unit =
            static_cast<double>(std::numeric_limits<T>::epsilon()) * size / (nearer * std::abs(seen - hidden));
        worst = std::max(worst, std::abs(visible - truth) / unit);
        inside += truth > 0.0 && truth < 1.0;
    }
    CHECK(inside > 2000);
    MESSAGE(worst, " units of the documented bound's 2");
    CHECK(worst < 2.0);
}

TEST_CASE_TEMPLATE("edges that are not in front, and lights of no length", T, float, double) {
    const RowPoint<T> point = at<T>(1.0, 4.0);
    CHECK(edge_visibility(at<T>(0.0, 4.0), point, T(-1), T(1)) == T(1));
    CHECK(edge_visibility(at<T>(0.0, 5.0), point, T(-1), T(1)) == T(1));
    CHECK(edge_visibility(point, point, T(-1), T(1)) == T(1));
    // a light of no length is on one side of the edge's shadow or the other
    CHECK(edge_visibility(at<T>(-1.0, 2.0), point, T(0), T(0)) == T(1));
    CHECK(edge_visibility(at<T>(2.0, 2.0), point, T(0), T(0)) == T(0));
    // far beyond either side: exactly nothing and all
    CHECK(edge_visibility(at<T>(50.0, 2.0), point, T(-1), T(1)) == T(0));
    CHECK(edge_visibility(at<T>(-50.0, 2.0), point, T(-1), T(1)) == T(1));
    CHECK(edge_visibility(at<T>(50.0, 2.0), point, T(1), T(-1)) == T(1));
}

TEST_CASE_TEMPLATE("skins: exact by the receiver's own depth, eq. 1 on straight receivers, linear where it is parallel",
                   T, float, double) {
    // The skin from an edge at depth ez to a receiver's point behind it, both seen from `hidden`; drawn from `seen`.
    Random random(3);
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    for (int i = 0; i < 20000; ++i) {
        const double ez = random.in(1.0, 3.0), tilt = i % 4 == 0 ? 0.0 : random.in(-0.6, 0.6);
        const double hidden = -1.0, seen = 1.0, ex = random.in(-1.0, 1.0);
        const double slope_hidden = (ex - hidden) / ez, slope_seen = (ex - seen) / ez;
        // the receiver z = 5 + tilt x, along a ray x = p + slope z
        const auto receiver = [&](double p, double slope) { return (5.0 + tilt * p) / (1.0 - tilt * slope); };
        const double far = receiver(hidden, slope_hidden), under = receiver(seen, slope_seen);
        if (far < 3.5 || under < 3.5 || far > 50.0 || under > 50.0) continue;
        const double far_slope = (hidden + slope_hidden * far - seen) / far;  // of the skin's far end, as drawn
        const double share = random.in(0.0, 1.0), slope = slope_seen + share * (far_slope - slope_seen);
        const double pz = receiver(seen, slope), px = seen + slope * pz;
        const double truth = clamp((seen - light_position(ex, ez, px, pz)) / (seen - hidden), 0.0, 1.0);
        const auto inverse = [](double z) { return static_cast<T>(1.0 / z); };
        const T s = static_cast<T>(share);
        CHECK(std::abs(static_cast<double>(skin_visibility(s, inverse(ez), inverse(far), inverse(pz))) - truth) <
              64.0 * epsilon);
        CHECK(std::abs(static_cast<double>(
                           skin_visibility(s, inverse(ez), inverse(far), mix(inverse(under), inverse(far), s))) -
                       truth) < 64.0 * epsilon);
        const double k1 = 1.0 / ez - 1.0 / far, k2 = 1.0 / ez - 1.0 / under, k = std::min(k1, k2) / std::max(k1, k2);
        const double bound = (1.0 - std::sqrt(k)) / (1.0 + std::sqrt(k));
        CHECK(std::abs(static_cast<double>(skin_visibility(s)) - truth) < bound + 64.0 * epsilon);
        if (tilt == 0.0) CHECK(std::abs(static_cast<double>(skin_visibility(s)) - truth) < 64.0 * epsilon);
    }
}

TEST_CASE_TEMPLATE("skins: ends, and receivers that are not behind", T, float, double) {
    CHECK(skin_visibility(T(0)) == T(0));
    CHECK(skin_visibility(T(1)) == T(1));
    CHECK(skin_visibility(T(-3)) == T(0));
    CHECK(skin_visibility(T(7)) == T(1));
    CHECK(skin_visibility(T(0), T(0.5), T(0.2), T(0.3)) == T(0));
    CHECK(skin_visibility(T(1), T(0.5), T(0.2), T(0.2)) == T(1));
    CHECK(skin_visibility(T(0.5), T(0.5), T(0.2), T(0.5)) == T(1));
    CHECK(skin_visibility(T(0.5), T(0.5), T(0.2), T(0.7)) == T(1));
    CHECK(skin_visibility(T(0.5), T(0.5), T(0), T(0)) == T(0.5));  // without a receiver: infinitely far
}
