#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/light.hpp>
#include <stdexcept>
#include <string>

#include "support/error_of.hpp"
#include "support/random.hpp"

using namespace penumbra;
using penumbra::test::error_of;

namespace {

template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

/// How far a frame is from orthonormal and right-handed.
template <class T>
double defect(const LightFrame<T>& f) {
    double worst = 0;
    const Vec3<T> axes[] = {f.u, f.v, f.normal};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            worst = std::max(worst, std::abs(static_cast<double>(glm::dot(axes[i], axes[j])) - (i == j ? 1 : 0)));
    return std::max(worst, std::abs(static_cast<double>(glm::dot(glm::cross(f.u, f.v), f.normal)) - 1));
}

template <class T>
double distance(const Vec3<T>& a, const Vec3<T>& b) {
    return static_cast<double>(glm::length(a - b));
}

template <class T>
RectLight<T> random_rect(test::Random& random, T size) {
    const Vec3<T> u = normalize_or(random.point(T(-1), T(1)), Vec3<T>(T(1), T(0), T(0)));
    const Vec3<T> v = glm::cross(u, any_perpendicular(u));
    const T width = random.in(T(0.1), T(1)), height = random.in(T(0.1), T(1));
    return {random.point(T(-3), T(3)), u * (size * width), v * (size * height)};
}

}  // namespace

TEST_CASE_TEMPLATE("frames of rectangles: orthonormal, right-handed, along the sides, at every size", T, float,
                   double) {
    test::Random random(1);
    double worst = 0, off = 0;
    for (int i = 0; i < 20000; ++i) {
        const T size = std::pow(T(10), random.in(T(-30), T(30)));
        const RectLight<T> light = random_rect(random, size);
        const LightFrame<T> frame = light_frame(light);
        worst = std::max(worst, defect(frame));
        off = std::max(off, distance(frame.u, normalize_or(light.half_u, frame.v)));
        off = std::max(off, distance(frame.v, normalize_or(light.half_v, frame.u)));
        const Vec2<T> half = half_size(light);
        const auto length = [](const Vec3<T>& v) {  // squares of 1e±30 fit in double
            return glm::length(Vec3<double>(v));
        };
        off = std::max(off, std::abs(static_cast<double>(half.x) / length(light.half_u) - 1));
        off = std::max(off, std::abs(static_cast<double>(half.y) / length(light.half_v) - 1));
        CHECK(frame.origin == light.center);
    }
    CHECK(worst < 8 * epsilon<T>);
    CHECK(off < 8 * epsilon<T>);
    // emits along cross(half_u, half_v)
    const LightFrame<T> down =
        light_frame(RectLight<T>{Vec3<T>(T(0)), Vec3<T>(T(2), T(0), T(0)), Vec3<T>(T(0), T(0), T(3))});
    CHECK(distance(down.normal, Vec3<T>(T(0), T(-1), T(0))) < 4 * epsilon<T>);
}

TEST_CASE_TEMPLATE("a light without one side, or both, looks where it is aimed", T, float, double) {
    test::Random random(2);
    const Vec3<T> zero(T(0), T(0), T(0));
    double worst = 0, off = 0, turned = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3<T> side = random.point(T(-1), T(1)), aim = random.point(T(-1), T(1));
        const Vec3<T> along = normalize_or(side, aim), wanted = normalize_or(aim, side);
        const LightFrame<T> u_only = light_frame(RectLight<T>{zero, side, zero}, aim);
        const LightFrame<T> v_only = light_frame(RectLight<T>{zero, zero, side}, aim);
        const LightFrame<T> none = light_frame(RectLight<T>{zero, zero, zero}, aim);
        for (const LightFrame<T>& frame : {u_only, v_only, none}) worst = std::max(worst, defect(frame));
        off = std::max({off, distance(u_only.u, along), distance(v_only.v, along), distance(none.normal, wanted)});
        // of all normals at a right angle to the side, the one nearest to the aim
        const T across = glm::dot(wanted, along), best = std::sqrt(std::max(T(0), T(1) - across * across));
        turned = std::max(turned, static_cast<double>(std::abs(glm::dot(u_only.normal, wanted) - best)));
        turned = std::max(turned, static_cast<double>(std::abs(glm::dot(v_only.normal, wanted) - best)));
    }
    CHECK(worst < 8 * epsilon<T>);
    CHECK(off < 8 * epsilon<T>);
    CHECK(turned < 2e3 * epsilon<T>);
    worst = 0;
    for (int i = 0; i < 20000; ++i) {  // aims ever nearer to the side, past where any perpendicular is taken
        const Vec3<T> side = random.point(T(-1), T(1)), away = random.point(T(-1), T(1));
        const Vec3<T> aim = normalize_or(side, away) + away * std::exp2(random.in(T(-14), T(0)));
        worst = std::max(worst, defect(light_frame(RectLight<T>{zero, side, zero}, aim)));
        worst = std::max(worst, defect(light_frame(RectLight<T>{zero, zero, side}, aim)));
    }
    CHECK(worst < 8 * epsilon<T>);
    const Vec3<T> x(T(1), T(0), T(0));
    CHECK(defect(light_frame(RectLight<T>{zero, x, zero}, x)) < 8 * epsilon<T>);  // aimed along itself
    CHECK(light_frame(RectLight<T>{zero, zero, zero}, zero).normal == Vec3<T>(T(0), T(0), T(-1)));
}

TEST_CASE_TEMPLATE("frames of disks and lines", T, float, double) {
    test::Random random(3);
    double worst = 0, off = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3<T> n = random.point(T(-1), T(1)), a = random.point(T(-3), T(3)), b = random.point(T(-3), T(3));
        const LightFrame<T> disk = light_frame(DiskLight<T>{a, n * T(7), T(1)});
        const LightFrame<T> line = light_frame(LinearLight<T>{a, b}, n);
        worst = std::max({worst, defect(disk), defect(line)});
        off = std::max(off, distance(disk.normal, normalize_or(n, b)));
        off = std::max(off, distance(line.u, normalize_or(b - a, n)));
        off = std::max(off, distance(line.origin, (a + b) * T(0.5)));
        CHECK(disk.origin == a);
    }
    CHECK(worst < 8 * epsilon<T>);
    CHECK(off < 8 * epsilon<T>);
    const Vec3<T> spot(T(1), T(2), T(3));
    CHECK(defect(light_frame(LinearLight<T>{spot, spot})) < 8 * epsilon<T>);  // a line without length
}

TEST_CASE_TEMPLATE("the ends of the range: sizes and frames stay finite, a line's middle too", T, float, double) {
    volatile T largest = std::numeric_limits<T>::max(), smallest = std::numeric_limits<T>::min();
    for (const T size : {T(largest), T(largest) / T(1e3), T(smallest), T(smallest) * T(1e3)}) {
        CAPTURE(size);
        const RectLight<T> light{Vec3<T>(T(0)), Vec3<T>(size, T(0), T(0)), Vec3<T>(T(0), size, T(0))};
        const Vec2<T> half = half_size(light);
        CHECK(half.x == size);
        CHECK(half.y == size);
        CHECK(defect(light_frame(light)) < 8 * epsilon<T>);
        CHECK(defect(light_frame(DiskLight<T>{Vec3<T>(T(0)), light.half_u, size})) < 8 * epsilon<T>);
    }
#ifndef __FAST_MATH__  // may subtract before it halves
    const LightFrame<T> frame =
        light_frame(LinearLight<T>{Vec3<T>(-T(largest), T(0), T(0)), Vec3<T>(T(largest), T(0), T(0))});
    CHECK(frame.origin == Vec3<T>(T(0), T(0), T(0)));
    CHECK(frame.u == Vec3<T>(T(1), T(0), T(0)));
    CHECK(frame.normal == Vec3<T>(T(0), T(0), T(-1)));
#endif
}

TEST_CASE_TEMPLATE("there and back again in scenes of any size", T, float, double) {
    test::Random random(5);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const T size = std::exp2(random.in(T(-90), T(90)));
        RectLight<T> light = random_rect(random, size);
        light.center *= size;
        const LightFrame<T> frame = light_frame(light);
        const Vec3<T> point = random.point(T(-4), T(4)) * size;
        const Vec3<double> off(frame.to_world(frame.to_light(point)) - point);
        worst = std::max(worst, glm::length(off) / static_cast<double>(size));
    }
    CHECK(worst < 32 * epsilon<T>);  // of coordinates up to 7 sizes
}

TEST_CASE_TEMPLATE("there and back again, also 1e5 from the origin", T, float, double) {
    test::Random random(4);
    double worst = 0, depth = 0;
    for (const T far : {T(0), T(1e5)}) {
        for (int i = 0; i < 5000; ++i) {
            RectLight<T> light = random_rect(random, T(1));
            light.center += Vec3<T>(far, -far, far);
            const LightFrame<T> frame = light_frame(light);
            const Vec3<T> point = light.center + random.point(T(-4), T(4));
            const Vec3<T> point_ls = frame.to_light(point);
            worst = std::max(worst, distance(frame.to_world(point_ls), point) / (8 + static_cast<double>(far)));
            // depth is the distance from the light's plane, along the emission
            const Vec3<T> offset = point - light.center;
            const double truth = static_cast<double>(glm::dot(glm::cross(light.half_u, light.half_v), offset)) /
                                 static_cast<double>(glm::length(glm::cross(light.half_u, light.half_v)));
            depth = std::max(depth, std::abs(static_cast<double>(point_ls.z) - truth));
        }
    }
    CHECK(worst < 4 * epsilon<T>);  // at 1e5, what is left of the coordinates themselves
#ifdef __FAST_MATH__  // may take the light's own depth from the point's: digits are lost far from the origin
    CHECK(depth < 1e6 * epsilon<T>);
#else
    CHECK(depth < 200 * epsilon<T>);
#endif
}

TEST_CASE_TEMPLATE("what is wrong with a light is told by name and value", T, float, double) {
    const Vec3<T> o(T(0), T(0), T(0)), x(T(1), T(0), T(0)), y(T(0), T(1), T(0));
    const T inf = std::numeric_limits<T>::infinity();
    const Vec3<T> endless(inf, T(0), T(0));
    CHECK(validate(RectLight<T>{o, x, y}));
    CHECK(validate(RectLight<T>{o, o, o}));
    CHECK(error_of([&] {
              validate(RectLight<T>{o, x, x + y});
          }) == "penumbra: light.half_u = (1, 0, 0) is not perpendicular to light.half_v = (1, 1, 0)");
    CHECK(error_of([&] {
              validate(RectLight<T>{Vec3<T>(T(0), inf, T(0)), x, y});
          }) == "penumbra: light.center = (0, inf, 0) is not finite");
    CHECK(error_of([&] { validate(RectLight<T>{o, endless, y}); }).find("light.half_u") != std::string::npos);
    CHECK(error_of([&] { validate(RectLight<T>{o, x, endless}); }).find("light.half_v") != std::string::npos);
    CHECK(validate(DiskLight<T>{o, x, T(0)}));
    CHECK(error_of([&] {
              validate(DiskLight<T>{o, o, T(1)});
          }) == "penumbra: light.normal = (0, 0, 0) has no direction");
    CHECK(error_of([&] {
              validate(DiskLight<T>{o, x, T(-1)});
          }) == "penumbra: light.radius = -1 is not a finite number ≥ 0");
    CHECK(error_of([&] { validate(DiskLight<T>{o, x, inf}); }).find("light.radius = inf") != std::string::npos);
    CHECK(validate(LinearLight<T>{o, o}));
    CHECK(error_of([&] { validate(LinearLight<T>{o, endless}); }).find("light.b") != std::string::npos);
}
