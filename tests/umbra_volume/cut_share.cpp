#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/umbra_volume/cut_share.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

/// From where the edge's ends land on the light's plane: the signed distance of their line from the centre. The visible
/// side is on its right, seen from the light, so on its left on the plane as the point sees it.
long double landed_share(const Vec3<double>& v1, const Vec3<double>& v2, const Vec3<double>& x, double radius) {
    using Exact3 = glm::vec<3, long double, glm::defaultp>;
    using Exact2 = glm::vec<2, long double, glm::defaultp>;
    const Exact3 point(x);
    const auto land = [&](const Exact3& v) {
        return Exact2(point) + (Exact2(v) - Exact2(point)) * (point.z / (point.z - v.z));
    };
    const Exact2 a = land(Exact3(v1)), b = land(Exact3(v2)), d = b - a;
    const long double distance = (d.x * a.y - d.y * a.x) / std::hypot(d.x, d.y);
    return std::clamp((1.0L - distance / static_cast<long double>(radius)) / 2.0L, 0.0L, 1.0L);
}

}  // namespace

TEST_CASE_TEMPLATE("t of an edge is where its line lands on the disk", T, float, double) {
    test::Random random(1);
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const T radius = random.in(T(0.1), T(3));
        const Vec3<T> v1(random.in(T(-2), T(2)), random.in(T(-2), T(2)), random.in(T(1), T(3)));
        Vec3<T> v2(random.in(T(-2), T(2)), random.in(T(-2), T(2)), random.in(T(1), T(3)));
        if (i % 4 == 0) v2.z = v1.z;
        const Vec3<T> x(random.in(T(-3), T(3)), random.in(T(-3), T(3)), random.in(T(4), T(8)));
        if (safe_length(v2 - v1) < T(0.1)) continue;
        const T t = edge_cut_share(v1, v2, x, radius);
        const long double exact =
            landed_share(Vec3<double>(v1), Vec3<double>(v2), Vec3<double>(x), static_cast<double>(radius));
        const double off =
            std::abs(static_cast<double>(static_cast<long double>(t) - exact)) * static_cast<double>(radius);
        worst = std::max(worst, off);
        CHECK(std::abs(t + edge_cut_share(v2, v1, x, radius) - T(1)) <= T(2e-5) + T(0) * radius);
    }
    MESSAGE("t times radius is off by at most " << worst);
    CHECK(worst <= (sizeof(T) == 4 ? 2e-5 : 4e-14));
}

TEST_CASE_TEMPLATE("t is 1 in the penumbra's plane, 0 in the umbra's", T, float, double) {
    test::Random random(2);
    const LightFrame<T> frame{Vec3<T>(T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0)),
                              Vec3<T>(T(0), T(0), T(1))};
    const T slack = sizeof(T) == 4 ? T(2e-5) : T(4e-14);
    for (int i = 0; i < 20000; ++i) {
        const T radius = random.in(T(0.1), T(2));
        const Vec3<T> v1(random.in(T(-2), T(2)), random.in(T(-2), T(2)), random.in(T(1), T(3)));
        const Vec3<T> v2(random.in(T(-2), T(2)), random.in(T(-2), T(2)), random.in(T(1), T(3)));
        const ExtrusionPoints<T> rim = extrusion_points(v1, v2, frame, radius);
        if (!rim.valid || safe_length(v2 - v1) < T(0.1)) continue;
        const Vec3<T> edge = mix(v1, v2, random.in(T(0), T(1)));
        const T far = random.in(T(1), T(3));
        // points whose ray to the rim passes through the edge
        CHECK(edge_cut_share(v1, v2, edge + (edge - rim.penumbra) * far, radius) >= T(1) - slack / radius);
        CHECK(edge_cut_share(v1, v2, edge + (edge - rim.umbra) * far, radius) <= slack / radius);
    }
}

TEST_CASE_TEMPLATE("from depths it is the same for edges parallel to the light", T, float, double) {
    test::Random random(3);
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) {
        // in the plane across the edge: the edge at (a, s), the point on the ray of slope m
        const double radius = random.in(0.1, 3.0), a = random.in(-2.0, 2.0), s = random.in(0.5, 3.0);
        const double m = random.in(-1.0, 1.0) * (std::abs(a) + radius) / s, x = s * random.in(1.01, 10.0);
        // depth where the ray meets the plane from the rim through the edge: u (a − m s) = ± r (1 − s / u)
        const double offset = a - m * s;
        const bool lit = offset > 0.0;  // caster at larger values
        const double crossing = s / (1.0 - std::abs(offset) / radius);
        if (!(std::abs(offset) < radius)) continue;
        const Vec3<double> v1(a, -1.0, s), v2(a, 1.0, s);  // caster on its left as seen from the light: x > a
        const double exact = edge_cut_share(v1, v2, Vec3<double>(m * x, 0.3, x), radius);
        const T depth = static_cast<T>(x), edge = static_cast<T>(s), at = static_cast<T>(crossing);
        const T t = lit ? penumbra_cut_share(edge, at, depth) : umbra_cut_share(edge, at, depth);
        worst = std::max(worst, std::abs(static_cast<double>(t) - exact));
    }
    MESSAGE("t from depths is off by at most " << worst);
    CHECK(worst <= (sizeof(T) == 4 ? 1e-5 : 3e-14));
}

TEST_CASE_TEMPLATE("limits: before the crossing, at the edge, without a radius, on the edge's line", T, float, double) {
    const Vec3<T> v1(T(0), T(-1), T(2)), v2(T(0), T(1), T(2));
    CHECK(penumbra_cut_share(T(2), T(3), T(2.5)) == T(1));
    CHECK(penumbra_cut_share(T(2), T(3), T(3)) == T(1));
    CHECK(umbra_cut_share(T(2), T(3), T(3)) == T(0));
    CHECK(umbra_cut_share(T(2), T(3), T(1)) == T(0));
    CHECK(penumbra_cut_share(T(2), T(2), T(2)) == T(1));
    CHECK(penumbra_cut_share(T(2), T(2), T(9)) == T(0.5));
    CHECK(umbra_cut_share(T(2), T(2), T(9)) == T(0.5));
    const T huge = std::numeric_limits<T>::max();
    CHECK(penumbra_cut_share(T(2), huge, T(9)) == T(1));
    CHECK(umbra_cut_share(T(2), huge, T(9)) == T(0));
    CHECK(edge_cut_share(v1, v2, Vec3<T>(T(1), T(0), T(4)), T(0)) == T(0));   // behind the caster, at x > 0
    CHECK(edge_cut_share(v1, v2, Vec3<T>(T(-1), T(0), T(4)), T(0)) == T(1));  // beside it
    CHECK(edge_cut_share(v1, v2, Vec3<T>(T(0), T(0), T(4)), T(1)) == T(0.5));
    CHECK(edge_cut_share(v1, v2, v1, T(1)) == T(0.5));
    CHECK(edge_cut_share(v1, v1, Vec3<T>(T(3), T(0), T(4)), T(1)) == T(0.5));
}
