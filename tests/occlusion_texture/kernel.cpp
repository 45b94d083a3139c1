#include <doctest/doctest.h>

#include <limits>
#include <penumbra/occlusion_texture/kernel.hpp>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

/// Where the line from `point` to (light_x, light_y) on the light's plane meets the plane at `depth`.
Vec2<long double> crossing(const Vec3<long double>& point, long double light_x, long double light_y,
                           long double depth) {
    const long double t = (point.z - depth) / point.z;
    return {point.x + (light_x - point.x) * t, point.y + (light_y - point.y) * t};
}

}  // namespace

TEST_CASE_TEMPLATE("kernel_scale is the share of the way back to the light", T, float, double) {
    test::Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const T p = std::exp2(random.in(T(-20), T(20))), z = p * random.in(T(0), T(1));
        CAPTURE(p);
        CAPTURE(z);
        const long double truth =
            (static_cast<long double>(p) - static_cast<long double>(z)) / static_cast<long double>(p);
        // p − z and the quotient are rounded once each
        CHECK(std::abs(static_cast<long double>(kernel_scale(z, p)) - truth) <=
              1.01L * static_cast<long double>(std::numeric_limits<T>::epsilon()) * truth);
    }
}

TEST_CASE_TEMPLATE("kernel_scale has its documented limits", T, float, double) {
    const T tiny = std::numeric_limits<T>::denorm_min(), huge = std::numeric_limits<T>::max();
    CHECK(kernel_scale(T(0), T(1)) == T(1));    // occluder on the light
    CHECK(kernel_scale(T(-1), T(1)) == T(1));   // occluder behind the light
    CHECK(kernel_scale(T(1), T(1)) == T(0));    // occluder at the point
    CHECK(kernel_scale(T(2), T(1)) == T(0));    // occluder behind the point
    CHECK(kernel_scale(T(0), T(0)) == T(0));    // point on the light's plane
    CHECK(kernel_scale(T(-2), T(-1)) == T(0));  // point behind the light
    CHECK(kernel_scale(T(-2), T(0)) == T(0));
    for (const T p : {tiny, std::numeric_limits<T>::min(), T(1), huge})
        for (const T z : {-huge, T(-1), -tiny, T(0), tiny, T(0.5), T(1), huge}) {
            CAPTURE(p);
            CAPTURE(z);
            const T scale = kernel_scale(z, p);
            CHECK(scale >= T(0));
            CHECK(scale <= T(1));
        }
}

TEST_CASE_TEMPLATE("kernel_size scales the light's size", T, float, double) {
    CHECK(kernel_size(T(1), T(4), T(2)) == T(1.5));
    CHECK(kernel_size(T(3), T(4), T(0)) == T(0));
    CHECK(kernel_size(T(5), T(4), T(2)) == T(0));
    CHECK(kernel_size(T(0), T(4), T(2)) == T(2));
}

TEST_CASE_TEMPLATE("kernel_rect holds the lines from the point to the light's corners", T, float, double) {
    test::Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const Vec3<T> p(random.in(T(-8), T(8)), random.in(T(-8), T(8)), random.in(T(0.1), T(20)));
        const T z = p.z * random.in(T(0), T(1));
        const Vec2<T> low(random.in(T(-3), T(1)), random.in(T(-3), T(1)));
        const Rect2<T> part{low, low + Vec2<T>(random.in(T(0), T(2)), random.in(T(0), T(2)))};
        const Rect2<T> kernel = kernel_rect(z, p, part);
        const Vec3<long double> exact_p(p);
        const auto exact = [](T x) { return static_cast<long double>(x); };
        const Vec2<long double> min = crossing(exact_p, exact(part.min.x), exact(part.min.y), exact(z));
        const Vec2<long double> max = crossing(exact_p, exact(part.max.x), exact(part.max.y), exact(z));
        // three roundings of numbers up to 8
        const long double tolerance = 3.0L * 8.0L * exact(std::numeric_limits<T>::epsilon());
        CAPTURE(p.x);
        CAPTURE(p.z);
        CAPTURE(z);
        CHECK(std::abs(exact(kernel.min.x) - min.x) <= tolerance);
        CHECK(std::abs(exact(kernel.min.y) - min.y) <= tolerance);
        CHECK(std::abs(exact(kernel.max.x) - max.x) <= tolerance);
        CHECK(std::abs(exact(kernel.max.y) - max.y) <= tolerance);
    }
}

TEST_CASE_TEMPLATE("kernel_rect is the point at the point and the light at the light", T, float, double) {
    const Rect2<T> light{Vec2<T>(T(-2), T(-1)), Vec2<T>(T(2), T(1))};
    const Vec3<T> p(T(3), T(5), T(7));
    const Rect2<T> at_point = kernel_rect(T(7), p, light), at_light = kernel_rect(T(0), p, light);
    CHECK(at_point.min == Vec2<T>(T(3), T(5)));
    CHECK(at_point.max == Vec2<T>(T(3), T(5)));
    CHECK(at_light.min == light.min);
    CHECK(at_light.max == light.max);
}
