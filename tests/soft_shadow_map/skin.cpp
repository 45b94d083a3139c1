#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <penumbra/soft_shadow_map/skin.hpp>

#include "support/random.hpp"

using namespace penumbra;
using test::Random;

TEST_CASE_TEMPLATE("skins reach from where the edge appears to where what is behind it does", T, float, double) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double source = random.in(-2.0, 2.0), target = random.in(-2.0, 2.0), slope = random.in(-1.0, 1.0);
        const double edge = random.in(0.5, 4.0), far = edge + random.in(0.0, 5.0);
        const Skin<T> skin = warp_skin(static_cast<T>(slope), static_cast<T>(1.0 / edge), static_cast<T>(1.0 / far),
                                       static_cast<T>(source), static_cast<T>(target));
        // both lie on one ray from the source: x = source + slope z
        const auto seen = [&](double z) { return (source + slope * z - target) / z; };
        const double tolerance = 16.0 * static_cast<double>(std::numeric_limits<T>::epsilon()) * (1.0 + 4.0 / edge);
        CHECK(std::abs(static_cast<double>(skin.edge.slope) - seen(edge)) < tolerance);
        CHECK(std::abs(static_cast<double>(skin.far.slope) - seen(far)) < tolerance);
        // half-way in the image it is straight in space
        const double middle = 0.5 * (seen(edge) + seen(far));
        const T share = skin_share(skin, static_cast<T>(middle));
        const double z = 1.0 / static_cast<double>(skin_inverse_depth(skin, share));
        if (far - edge > 0.5 && std::abs(source - target) > 0.5) {
            CHECK(static_cast<double>(share) == doctest::Approx(0.5).epsilon(1e-3));
            CHECK((source + slope * z - target) / z == doctest::Approx(middle).epsilon(1e-3));
        }
    }
}

TEST_CASE_TEMPLATE("shares beyond the ends, and skins of no width", T, float, double) {
    const Skin<T> skin{{T(0.25), T(0.5)}, {T(0.75), T(0.25)}}, turned{{T(0.75), T(0.5)}, {T(0.25), T(0.25)}};
    CHECK(skin_share(skin, T(0.25)) == T(0));
    CHECK(skin_share(skin, T(0)) == T(0));
    CHECK(skin_share(skin, T(0.75)) == T(1));
    CHECK(skin_share(skin, T(9)) == T(1));
    CHECK(skin_share(skin, T(0.5)) == T(0.5));
    CHECK(skin_share(turned, T(0.75)) == T(0));
    CHECK(skin_share(turned, T(9)) == T(0));
    CHECK(skin_share(turned, T(0.25)) == T(1));
    const Skin<T> none{{T(0.5), T(0.5)}, {T(0.5), T(0.25)}};
    for (const T at : {T(0), T(0.5), T(1)}) CHECK(skin_share(none, at) == T(1));
    CHECK(skin_inverse_depth(skin, T(0)) == T(0.5));
    CHECK(skin_inverse_depth(skin, T(1)) == T(0.25));
}

TEST_CASE_TEMPLATE("a straight receiver goes on under the edge", T, float, double) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const double source = -1.0, target = random.in(0.0, 2.0), slope = random.in(-0.5, 0.5),
                     tilt = random.in(-0.5, 0.5);
        const double edge = random.in(1.0, 3.0);
        const auto receiver = [&](double p, double along) { return (6.0 + tilt * p) / (1.0 - tilt * along); };
        const double far = receiver(source, slope), beyond_slope = slope + 0.05,
                     beyond = receiver(source, beyond_slope);
        const Skin<T> skin = warp_skin(static_cast<T>(slope), static_cast<T>(1.0 / edge), static_cast<T>(1.0 / far),
                                       static_cast<T>(source), static_cast<T>(target));
        const auto point = [&](double along, double z) {
            return RowPoint<T>{static_cast<T>((source + along * z) / z), static_cast<T>(1.0 / z)};
        };
        const double at_edge = (source + slope * edge - target) / edge, under = receiver(target, at_edge);
        if (under < edge || under > 100.0) continue;
        const T found =
            receiver_under_edge(skin, point(slope, far), point(beyond_slope, beyond), static_cast<T>(target));
        CHECK(static_cast<double>(found) == doctest::Approx(1.0 / under).epsilon(2e-4));
    }
    // one point twice: parallel to the light; never nearer than the edge, nor beyond infinity
    const Skin<T> skin{{T(0), T(0.5)}, {T(0.3), T(0.2)}};
    const RowPoint<T> far{T(0.1), T(0.2)};
    CHECK(receiver_under_edge(skin, far, far, T(1)) == T(0.2));
    CHECK(receiver_under_edge(skin, far, {T(0.2), T(9)}, T(0)) >= T(0));
    CHECK(receiver_under_edge(skin, far, {T(0.2), T(-9)}, T(0)) <= T(0.5));
}
