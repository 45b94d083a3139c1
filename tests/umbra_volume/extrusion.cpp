#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <penumbra/umbra_volume/extrusion.hpp>
#include <string>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

/// Set PENUMBRA_LONG_TESTS for 1.2 million random edges.
int edges() { return std::getenv("PENUMBRA_LONG_TESTS") != nullptr ? 1200000 : 60000; }

using Exact = glm::vec<3, long double, glm::defaultp>;

template <class T>
Exact exact(const Vec3<T>& v) {
    return Exact(static_cast<long double>(v.x), static_cast<long double>(v.y), static_cast<long double>(v.z));
}

/// By how much of a radius the plane through the edge and `point` fails to touch the disk: the extremes over the disk
/// of the distance from it are N·(c − v) ± r |N × n|, one of which should be 0; measured in the disk's plane.
template <class T>
long double tangency(const Vec3<T>& v1, const Vec3<T>& v2, const Vec3<T>& point, const DiskLight<T>& light) {
    const Exact e = exact(v2) - exact(v1), n = glm::normalize(exact(light.normal)), p = exact(point);
    // from the vertex farther from the point, by which the plane is known better
    const Exact N = glm::cross(exact(v1) - p, e);
    const long double r = static_cast<long double>(light.radius), across = glm::length(glm::cross(N, n));
    return std::abs(std::abs(glm::dot(N, exact(light.center) - p)) / across - r) / r;
}

/// Signs of the side on which the disk lies of the plane through the edge and `point`: −1 is the caster's. 0: on both.
template <class T>
int side_of_disk(const Vec3<T>& v1, const Vec3<T>& v2, const Vec3<T>& point, const DiskLight<T>& light,
                 long double slack) {
    const Exact n = glm::normalize(exact(light.normal)), p = exact(point);
    const Exact N = glm::cross(exact(v1) - p, exact(v2) - p);
    const long double middle = glm::dot(N, exact(light.center) - p), across = glm::length(glm::cross(N, n));
    const long double reach = across * static_cast<long double>(light.radius);
    if (middle >= reach * (1 - slack)) return 1;
    return middle <= -reach * (1 - slack) ? -1 : 0;
}

template <class T>
DiskLight<T> some_light(test::Random& random) {
    const Vec3<T> normal = normalize_or(random.point(T(-1), T(1)), Vec3<T>(T(0), T(0), T(-1)));
    return {Vec3<T>(T(0), T(0), T(0)), normal * random.in(T(0.5), T(2)), random.in(T(0.25), T(2))};
}

/// Where the edge's line meets the light's plane, in radii from the centre; huge if it is parallel.
template <class T>
long double landing(const Vec3<T>& v1, const Vec3<T>& v2, const DiskLight<T>& light) {
    const Exact n = glm::normalize(exact(light.normal)), a = exact(v1) - exact(light.center), e = exact(v2) - exact(v1);
    const long double w = glm::dot(e, n);
    const Exact A = a * w - e * glm::dot(a, n);
    return glm::length(A) / std::max(std::abs(w), 1e-4000L) / static_cast<long double>(light.radius);
}

/// The light at 0 that shines along z, and edges in its space: truth without a frame's rounding.
template <class T>
DiskLight<T> plain_light(T radius) {
    return {Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(0), T(0), T(1)), radius};
}

template <class T>
constexpr long double allowed = sizeof(T) == 4 ? 1e-6L : 1e-13L;

}  // namespace

TEST_CASE_TEMPLATE("planes through extrusion points touch the disk, from the caster's side or the other", T, float,
                   double) {
    test::Random random(1);
    long double worst = 0, worst_near = 0;
    int wrong = 0, valid = 0, hits = 0;
    std::string at;
    for (int n = 0; n < edges(); ++n) {
        const DiskLight<T> light = some_light<T>(random);
        const LightFrame<T> frame = light_frame(light);
        const T r = light.radius;
        const auto vertex = [&] {
            const T x = random.in(T(-3), T(3)), y = random.in(T(-3), T(3)), depth = random.in(T(1), T(4));
            return frame.to_world(Vec3<T>(x * r, y * r, depth * r));
        };
        const Vec3<T> v1 = vertex();
        Vec3<T> v2 = vertex();
        if (n % 3 == 1) {  // nearly parallel to the light
            Vec3<T> flat = frame.to_light(v2);
            flat.z = frame.to_light(v1).z + std::ldexp(random.in(T(-1), T(1)), -random.whole(0, 30));
            v2 = frame.to_world(flat);
        }
        const ExtrusionPoints<T> points = extrusion_points(v1, v2, light);
        const long double a = landing(v1, v2, light);
        if (std::abs(a - 1) < 1e-4L) continue;
        CHECK(points.valid == (a > 1));
        if (!points.valid) {
            ++hits;
            continue;
        }
        ++valid;
        const long double error =
            std::max(tangency(v1, v2, points.umbra, light), tangency(v1, v2, points.penumbra, light));
        (a > 2 ? worst : worst_near) = std::max(a > 2 ? worst : worst_near, a > 2 ? error : error * std::sqrt(a - 1));
        wrong += side_of_disk(v1, v2, points.penumbra, light, 1e-4L) == 1 ? 0 : 1;
        wrong += side_of_disk(v1, v2, points.umbra, light, 1e-4L) == -1 ? 0 : 1;
        // the points are on the rim
        for (const Vec3<T>& p : {points.umbra, points.penumbra}) {
            const long double size = glm::length(exact(p)) / static_cast<long double>(r);
            REQUIRE(std::abs(size - 1) <= allowed<T>);
            REQUIRE(std::abs(glm::dot(exact(p), exact(frame.normal))) <= allowed<T> * static_cast<long double>(r));
        }
        const ExtrusionPoints<T> back = extrusion_points(v2, v1, light);
        REQUIRE((back.umbra == points.penumbra && back.penumbra == points.umbra));
    }
    INFO("worst " << static_cast<double>(worst) << ", near the rim times √distance "
                  << static_cast<double>(worst_near));
    CHECK(worst <= allowed<T>);
    CHECK(worst_near <= 2 * allowed<T>);
    CHECK(wrong == 0);
    CHECK(valid > edges() / 2);
    CHECK(hits > edges() / 200);
}

TEST_CASE_TEMPLATE("a caster lies wholly on its side of both planes wherever it does from the disk", T, float, double) {
    test::Random random(2);
    const DiskLight<T> light = plain_light(T(1));
    int cases = 0;
    for (int n = 0; n < edges(); ++n) {
        const auto vertex = [&] {
            const T x = random.in(T(-2), T(2)), y = random.in(T(-2), T(2)), depth = random.in(T(0.5), T(3));
            return Vec3<T>(x, y, depth);
        };
        const Vec3<T> v1 = vertex(), v2 = vertex(), q = vertex();
        // brute force: the triangle's third vertex is left of the edge from every point of the rim
        long double nearest = -1e30L;
        for (int k = 0; k < 32; ++k) {
            const Exact p(std::cos(0.19634954L * k), std::sin(0.19634954L * k), 0);
            const Exact N = glm::cross(exact(v1) - p, exact(v2) - p);
            nearest = std::max(nearest, glm::dot(N, exact(q) - p) / glm::length(N));
        }
        const ExtrusionPoints<T> points = extrusion_points(v1, v2, light);
        if (nearest > -0.05L || !points.valid) continue;
        ++cases;
        for (const Vec3<T>& point : {points.umbra, points.penumbra}) {
            const Exact p = exact(point), N = glm::cross(exact(v1) - p, exact(v2) - p);
            REQUIRE(glm::dot(N, exact(q) - p) < 0);
        }
        REQUIRE(side_of_disk(v1, v2, points.penumbra, light, 1e-3L) == 1);
        REQUIRE(side_of_disk(v1, v2, points.umbra, light, 1e-3L) == -1);
    }
    CHECK(cases > edges() / 20);
}

TEST_CASE_TEMPLATE("any slope: 1e-1 to 1e-9 and none, gaps of 1e-3 at depth 1000", T, float, double) {
    const T radii[] = {T(1), T(0.01), T(100)};
    for (const T r : radii)
        for (const T depth : {T(1), T(5)})
            for (T slope = T(0.1); slope > T(1e-10); slope *= T(0.1))
                for (const T sign : {T(-1), T(0), T(1)}) {
                    const Vec3<T> v1(T(0.3) * r, T(-0.7) * r, depth * r);
                    const Vec3<T> v2 = v1 + Vec3<T>(T(0.8) * r, T(0.6) * r, sign * slope * r);
                    const DiskLight<T> light = plain_light(r);
                    const ExtrusionPoints<T> points = extrusion_points(v1, v2, light);
                    CHECK(points.valid);
                    CHECK(tangency(v1, v2, points.umbra, light) <= allowed<T>);
                    CHECK(tangency(v1, v2, points.penumbra, light) <= allowed<T>);
                }
    const Vec3<T> v1(T(3), T(2), T(1000)), v2 = v1 + Vec3<T>(T(1e-3), T(-2e-3), T(0));
    const DiskLight<T> light = plain_light(T(1));
    const ExtrusionPoints<T> points = extrusion_points(v1, v2, light);
    CHECK(tangency(v1, v2, points.umbra, light) <= allowed<T>);
    CHECK(tangency(v1, v2, points.penumbra, light) <= allowed<T>);
    CHECK(side_of_disk(v1, v2, points.penumbra, light, 1e-4L) == 1);
}

TEST_CASE_TEMPLATE("the edge's line beside the rim: |a| / r − 1 from 1e-1 to 1e-7", T, float, double) {
    test::Random random(3);
    const DiskLight<T> light = plain_light(T(1));
    for (T gap = T(0.1); gap > T(2e-7); gap *= T(0.1)) {
        long double worst = 0;
        for (int n = 0; n < 2000; ++n) {
            const T turn = random.in(T(0), T(6.28));
            const Vec3<T> a(std::cos(turn) * (T(1) + gap), std::sin(turn) * (T(1) + gap), T(0));
            const Vec3<T> along(random.in(T(-1), T(1)), random.in(T(-1), T(1)), T(1));
            const Vec3<T> v1 = a + along * random.in(T(0.25), T(1)), v2 = v1 + along * random.in(T(0.25), T(1));
            const ExtrusionPoints<T> points = extrusion_points(v1, v2, light);
            const long double there = landing(v1, v2, light);
            if (there > 1 + 8 * static_cast<long double>(std::numeric_limits<T>::epsilon())) {
                CHECK(points.valid);
                worst =
                    std::max({worst, tangency(v1, v2, points.umbra, light), tangency(v1, v2, points.penumbra, light)});
            }
            CHECK(std::abs(glm::length(exact(points.umbra)) - 1) <= allowed<T>);
        }
        INFO("gap " << gap << ": " << static_cast<double>(worst));
        CHECK(worst <= allowed<T>);
    }
}

TEST_CASE_TEMPLATE("lines that meet the disk, its rim or its centre have no planes, and a documented point", T, float,
                   double) {
    const DiskLight<T> light = plain_light(T(1));
    const auto meets = [&](T x, T y) {  // straight down and slanted, through (x, y, 0)
        for (const Vec3<T>& along : {Vec3<T>(T(0), T(0), T(1)), Vec3<T>(T(0.5), T(-0.25), T(1))}) {
            const Vec3<T> a(x, y, T(0));
            const ExtrusionPoints<T> points = extrusion_points(a + along, a + along * T(2), light);
            CHECK_FALSE(points.valid);
            CHECK(points.umbra == points.penumbra);
            const T size = std::sqrt(x * x + y * y);
            const Vec3<T> nearest = size > T(0) ? a / size : a;
            CHECK(safe_length(points.umbra - nearest) <= T(4) * std::numeric_limits<T>::epsilon());
        }
    };
    meets(T(0), T(0));
    meets(T(0.5), T(0));
    meets(T(-0.25), T(0.5));
    meets(T(1), T(0));
    meets(T(0), T(-1));
    // outside by 2e-6: points that are close to those of the rim
    const Vec3<T> down(T(0), T(0), T(1)), a(T(1.000002), T(0), T(0));
    const ExtrusionPoints<T> outside = extrusion_points(a + down, a + down * T(2), light);
    CHECK(outside.valid);
    CHECK(safe_length(outside.umbra - Vec3<T>(T(1), T(0), T(0))) < T(3e-3));
    CHECK(safe_length(outside.penumbra - Vec3<T>(T(1), T(0), T(0))) < T(3e-3));
}

TEST_CASE_TEMPLATE("no length, no radius, a huge one, in the light's plane: finite, and as documented", T, float,
                   double) {
    const Vec3<T> center(T(3), T(4), T(5)), normal(T(0), T(0), T(-2)), v1(T(4), T(5), T(2)), v2(T(4.5), T(4), T(1));
    const DiskLight<T> point_light{center, normal, T(0)};
    const ExtrusionPoints<T> sharp = extrusion_points(v1, v2, point_light);
    CHECK(sharp.valid);
    CHECK(sharp.umbra == center);
    CHECK(sharp.penumbra == center);
    const ExtrusionPoints<T> none = extrusion_points(v1, v1, DiskLight<T>{center, normal, T(1)});
    CHECK_FALSE(none.valid);
    CHECK(none.umbra == center);
    const Vec3<T> flat1(T(5), T(4), T(5)), flat2(T(5), T(6), T(5));
    const ExtrusionPoints<T> flat = extrusion_points(flat1, flat2, DiskLight<T>{center, normal, T(1)});
    CHECK_FALSE(flat.valid);
    CHECK(flat.penumbra == center);
    const ExtrusionPoints<T> huge = extrusion_points(v1, v2, DiskLight<T>{center, normal, T(1e15)});
    CHECK_FALSE(huge.valid);
    CHECK(is_finite(huge.umbra));
    const ExtrusionPoints<T> level =
        extrusion_points(v1, v1 + Vec3<T>(T(1), T(0), T(0)), DiskLight<T>{center, normal, T(1e15)});
    CHECK(level.valid);
    CHECK(safe_length(level.umbra) == doctest::Approx(1e15));
}

TEST_CASE_TEMPLATE("continuous through edges parallel to the light", T, float, double) {
    const DiskLight<T> light = plain_light(T(1));
    const Vec3<T> v1(T(-1), T(0.5), T(2)), v2(T(1), T(1), T(2));
    const ExtrusionPoints<T> level = extrusion_points(v1, v2, light);
    for (const T slope : {T(-1e-4), T(1e-4)}) {
        const ExtrusionPoints<T> tilted = extrusion_points(v1, v2 + Vec3<T>(T(0), T(0), slope), light);
        CHECK(safe_length(tilted.umbra - level.umbra) < T(1e-4));
        CHECK(safe_length(tilted.penumbra - level.penumbra) < T(1e-4));
    }
}
