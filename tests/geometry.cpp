#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/geometry.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

template <class T>
long double wide(T x) {
    return static_cast<long double>(x);
}

template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

/// Twice the signed area, by the shoelace formula.
template <class Polygon>
double twice_area(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const auto &a = polygon.vertices[i], &b = polygon.vertices[(i + 1) % polygon.count];
        sum +=
            static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(a.y) * static_cast<double>(b.x);
    }
    return sum;
}

/// The area of a convex polygon inside a box, in double. Between the heights of corners and crossings the width is
/// linear, so that the width at the middle times the height is exact. Nothing is shared with clip.
template <class Polygon>
double area_by_slabs(const Polygon& polygon, const Rect2<double>& box) {
    std::vector<double> heights{box.min.y, box.max.y};
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const Vec2<double> a(polygon.vertices[k]), b(polygon.vertices[(k + 1) % polygon.count]);
        heights.push_back(a.y);
        for (const double x : {box.min.x, box.max.x})
            if ((a.x < x) != (b.x < x)) heights.push_back(a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
    }
    for (double& y : heights) y = std::min(std::max(y, box.min.y), box.max.y);
    std::sort(heights.begin(), heights.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        const double y = (heights[i] + heights[i + 1]) / 2;
        double low = box.max.x, high = box.min.x;
        for (std::size_t k = 0; k < polygon.count; ++k) {
            const Vec2<double> a(polygon.vertices[k]), b(polygon.vertices[(k + 1) % polygon.count]);
            if ((a.y < y) == (b.y < y)) continue;
            const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
            low = std::min(low, std::max(x, box.min.x)), high = std::max(high, std::min(x, box.max.x));
        }
        sum += std::max(0.0, high - low) * (heights[i + 1] - heights[i]);
    }
    return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("normalize_or is a unit vector for every length that has a direction", T, float, double) {
    test::Random random(1);
    const int range = std::numeric_limits<T>::max_exponent - 3;
    double worst = 0, worst_length = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3<T> direction = random.point(T(-1), T(1));
        // components may differ by any power of two: what is too small for the length does not matter
        const Vec3<T> v = direction * std::ldexp(T(1), random.whole(-range, range));
        if (std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) < std::numeric_limits<T>::min() * T(2)) continue;
        const long double x = wide(v.x), y = wide(v.y), z = wide(v.z), length = std::sqrt(x * x + y * y + z * z);
        const Vec3<T> unit = normalize_or(v, Vec3<T>(T(9), T(9), T(9)));
        for (int k = 0; k < 3; ++k) {
            const long double truth = wide(v[k]) / length;
            int exponent = 0;
            std::frexp(truth, &exponent);
            if (std::abs(v[k]) < std::numeric_limits<T>::min()) continue;  // flushed by -ffast-math
            const long double ulp = std::ldexp(1.0L, exponent - std::numeric_limits<T>::digits);
            worst = std::max(worst, static_cast<double>(std::abs(wide(unit[k]) - truth) / ulp));
        }
        worst_length =
            std::max(worst_length, static_cast<double>(std::abs(wide(safe_length(v)) / length - 1)) / epsilon<T>);
    }
#ifdef __FAST_MATH__
    CHECK(worst <= 5);
    CHECK(worst_length <= 4);
#else
    CHECK(worst <= 3.5);
    CHECK(worst_length <= 2.5);
#endif
    const Vec3<T> fallback(T(1), T(2), T(3)), zero(T(0), T(0), T(0));
    CHECK(normalize_or(zero, fallback) == fallback);
    CHECK(normalize_or(Vec3<T>(T(0), T(0), std::numeric_limits<T>::max()), fallback) == Vec3<T>(T(0), T(0), T(1)));
#ifndef __FAST_MATH__
    CHECK(normalize_or(Vec3<T>(-std::numeric_limits<T>::min(), T(0), T(0)), fallback) == Vec3<T>(T(-1), T(0), T(0)));
    CHECK(normalize_or(Vec3<T>(std::numeric_limits<T>::denorm_min(), T(0), T(0)), fallback) == fallback);
    CHECK(normalize_or(Vec3<T>(std::numeric_limits<T>::infinity(), T(0), T(0)), fallback) == fallback);
    CHECK(normalize_or(Vec3<T>(std::numeric_limits<T>::quiet_NaN(), T(0), T(0)), fallback) == fallback);
#endif
}

TEST_CASE_TEMPLATE("lengths and directions at the ends of the range, computed at run time", T, float, double) {
    // volatile: a compiler that knows the value folds the division that -ffast-math would spoil
    volatile T largest = std::numeric_limits<T>::max(), smallest = std::numeric_limits<T>::min();
    int wrong = 0;
    for (const T end : {T(largest), T(largest) / T(3), T(smallest), T(smallest) * T(5)})
        for (int k = 1; k < 60; ++k) {
            const T size = end > T(1) ? end / static_cast<T>(k) : end * static_cast<T>(k);
            const Vec3<T> v(size * T(0.5), size * T(-0.25), size), unit = normalize_or(v, Vec3<T>(T(9)));
            const double length = std::sqrt(0.25 + 0.0625 + 1.0), x = static_cast<double>(unit.x) * length;
            const bool whole = size * T(0.25) >= std::numeric_limits<T>::min();  // no component is a denormal
            if (!whole) {
                wrong += !is_finite(unit) || std::abs(glm::dot(unit, unit) - T(1)) > T(1e-5);
                continue;
            }
            wrong += !is_finite(unit) || std::abs(x - 0.5) > 4 * epsilon<T>;
            wrong += std::abs(static_cast<double>(unit.y) * length + 0.25) > 4 * epsilon<T>;
            wrong += std::abs(static_cast<double>(unit.z) * length - 1.0) > 4 * epsilon<T>;
            if (size > std::numeric_limits<T>::max() / T(2)) continue;  // |v| itself overflows near the largest
            wrong += std::abs(static_cast<double>(safe_length(v) / size) / length - 1.0) > 4 * epsilon<T>;
        }
    CHECK(wrong == 0);
    CHECK(safe_length(Vec3<T>(T(0), T(0), T(0))) == T(0));
    CHECK(safe_length(Vec3<T>(T(0), -T(largest), T(0))) == T(largest));
    CHECK(safe_length(Vec3<T>(T(2), T(3), T(6))) == T(7));
}

TEST_CASE_TEMPLATE("any_perpendicular is a unit vector at a right angle, the poles included", T, float, double) {
    test::Random random(2);
    double worst = 0;
    const auto check = [&](const Vec3<T>& n) {
        const Vec3<T> p = any_perpendicular(n);
        worst = std::max(worst, std::abs(static_cast<double>(glm::dot(n, p))));
        worst = std::max(worst, std::abs(static_cast<double>(glm::dot(p, p)) - 1));
    };
    for (const T s : {T(1), T(-1)}) {
        check(Vec3<T>(s, T(0), T(0))), check(Vec3<T>(T(0), s, T(0))), check(Vec3<T>(T(0), T(0), s));
        for (int exponent = 1; exponent < 40; ++exponent)
            check(normalize_or(Vec3<T>(std::ldexp(T(1), -exponent), std::ldexp(T(-1), -exponent), s), Vec3<T>(T(1))));
    }
    for (int i = 0; i < 100000; ++i) check(normalize_or(random.point(T(-1), T(1)), Vec3<T>(T(0), T(0), T(1))));
    CHECK(worst < 8 * epsilon<T>);
}

TEST_CASE_TEMPLATE("rectangles and boxes: extend, intersect, extent, area", T, float, double) {
    CHECK(area(empty_rect<T>()) == T(0));
    CHECK(is_empty(empty_box<T>()));
    test::Random random(3);
    Rect2<T> rect = empty_rect<T>();
    Box3<T> box = empty_box<T>();
    Vec3<T> low(T(100)), high(T(-100));
    for (int i = 0; i < 100; ++i) {
        const Vec3<T> p = random.point(T(-5), T(5));
        rect = extend(rect, Vec2<T>(p.x, p.y)), box = extend(box, p);
        for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
        CHECK(!is_empty(box));
        CHECK(box.min == low);
        CHECK(box.max == high);
        CHECK(rect.min == Vec2<T>(low.x, low.y));
        CHECK(rect.max == Vec2<T>(high.x, high.y));
    }
    // areas of intersections on a grid, counted cell by cell
    for (int i = 0; i < 2000; ++i) {
        int side[8];
        for (int& s : side) s = random.whole(0, 9);
        const auto make = [&](int k) {
            return Rect2<T>{Vec2<T>(T(side[k]), T(side[k + 1])), Vec2<T>(T(side[k + 2]), T(side[k + 3]))};
        };
        int cells = 0;
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x)
                cells += x >= side[0] && x < side[2] && y >= side[1] && y < side[3] && x >= side[4] && x < side[6] &&
                         y >= side[5] && y < side[7];
        CHECK(area(intersect(make(0), make(4))) == T(cells));
    }
    CHECK(extent(Rect2<T>{Vec2<T>(T(1), T(2)), Vec2<T>(T(4), T(3))}) == Vec2<T>(T(3), T(1)));
    CHECK(!is_empty(Box3<T>{Vec3<T>(T(1)), Vec3<T>(T(1))}));  // a point is not empty
}

TEST_CASE_TEMPLATE("signed_distance is positive inside", T, float, double) {
    const Plane<T> plane{Vec3<T>(T(0), T(2), T(0)), T(-6)};  // y = 3, in units of 2
    CHECK(signed_distance(plane, Vec3<T>(T(7), T(4), T(1))) == T(2));
    CHECK(signed_distance(plane, Vec3<T>(T(7), T(3), T(1))) == T(0));
    CHECK(signed_distance(plane, Vec3<T>(T(7), T(1), T(1))) == T(-4));
}

TEST_CASE_TEMPLATE("is_finite of vectors looks at every component", T, float, double) {
    const T big = std::numeric_limits<T>::max();
    CHECK(is_finite(Vec2<T>(big, -big)));
    CHECK(is_finite(Vec3<T>(big, T(0), -big)));
    for (int k = 0; k < 3; ++k) {
        Vec3<T> v(T(1), T(1), T(1));
        v[k] = std::numeric_limits<T>::infinity();
        CHECK(!is_finite(v));
        if (k < 2) CHECK(!is_finite(Vec2<T>(v.x, v.y)));
    }
}

TEST_CASE_TEMPLATE("the two sides of a cut have the polygon's area, and hold what they should", T, float, double) {
    test::Random random(4);
    double worst = 0;
    int outside = 0, too_many = 0;
    for (int i = 0; i < 20000; ++i) {
        ConvexPolygon<Vec2<T>, 8> polygon;
        const T turn = random.in(T(0), T(6));
        const int corners = random.whole(3, 6);
        for (int k = 0; k < corners; ++k) {
            const T angle = turn + T(6.2831853) * static_cast<T>(k) / static_cast<T>(corners);
            polygon.push(Vec2<T>(std::cos(angle), std::sin(angle)));
        }
        const T a = random.in(T(-1), T(1)), b = random.in(T(-1), T(1)), c = random.in(T(-1), T(1));
        const auto distance = [&](const Vec2<T>& v) { return a * v.x + b * v.y + c; };
        const auto inner = clip(polygon, distance);
        const auto outer = clip(polygon, [&](const Vec2<T>& v) { return -distance(v); });
        worst = std::max(worst, std::abs(twice_area(inner) + twice_area(outer) - twice_area(polygon)));
        too_many += inner.count > polygon.count + 1;
        for (std::size_t k = 0; k < inner.count; ++k)
            outside += distance(inner.vertices[k]) < -T(8) * std::numeric_limits<T>::epsilon();
    }
    CHECK(worst < 16 * epsilon<T>);
    CHECK(outside == 0);
    CHECK(too_many == 0);
}

TEST_CASE_TEMPLATE("a polygon cut to a rectangle has the area of its slices", T, float, double) {
    test::Random random(6);
    double worst = 0;
    int partly = 0, outside = 0;
    for (int i = 0; i < 5000; ++i) {
        ConvexPolygon<Vec2<T>, 16> polygon;
        const double turn = random.in(0.0, 6.0);
        const int corners = random.whole(3, 9);
        for (int k = 0; k < corners; ++k) {
            const double angle = turn + 6.283185307179586 * k / corners;
            polygon.push(Vec2<T>(static_cast<T>(2 * std::cos(angle)), static_cast<T>(std::sin(angle))));
        }
        const T x = random.in(T(-2), T(1)), y = random.in(T(-1.5), T(0.5)), w = random.in(T(0.1), T(3));
        const T h = random.in(T(0.1), T(2));
        auto inside = clip(polygon, [&](const Vec2<T>& v) { return v.x - x; });
        inside = clip(inside, [&](const Vec2<T>& v) { return x + w - v.x; });
        inside = clip(inside, [&](const Vec2<T>& v) { return v.y - y; });
        inside = clip(inside, [&](const Vec2<T>& v) { return y + h - v.y; });
        for (std::size_t k = 0; k < inside.count; ++k) {
            const Vec2<T> v = inside.vertices[k];
            const T slack = T(8) * std::numeric_limits<T>::epsilon();
            outside += v.x < x - slack || v.x > x + w + slack || v.y < y - slack || v.y > y + h + slack;
        }
        const Rect2<double> box{Vec2<double>(x, y), Vec2<double>(x + w, y + h)};
        const double area = area_by_slabs(polygon, box);
        worst = std::max(worst, std::abs(twice_area(inside) / 2 - area));
        partly += area > 0.01 && area < 0.99 * static_cast<double>(w) * static_cast<double>(h);
    }
    CHECK(worst < 32 * epsilon<T>);  // of perimeters up to 10
    CHECK(outside == 0);
    CHECK(partly > 2000);
}

TEST_CASE_TEMPLATE("clip of polygons without area stays on them", T, float, double) {
    test::Random random(7);
    int off = 0, cut = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec2<T> a(random.in(T(-1), T(1)), T(0.5)), b(random.in(T(-1), T(1)), T(0.5));
        const T limit = random.in(T(-1), T(1));
        const auto distance = [&](const Vec2<T>& v) { return v.x - limit; };
        ConvexPolygon<Vec2<T>, 5> point, line;
        for (int k = 0; k < 4; ++k) point.push(a), line.push(k < 2 ? a : b);
        const auto p = clip(point, distance), l = clip(line, distance);
        off += p.count != (a.x >= limit ? 4U : 0U);
        cut += l.count > 0 && (a.x >= limit) != (b.x >= limit);
        for (std::size_t k = 0; k < l.count; ++k) {
            const T slack = T(4) * std::numeric_limits<T>::epsilon(), x = l.vertices[k].x;
            off += std::abs(l.vertices[k].y - T(0.5)) > slack || x < limit - slack;
            off += x < std::min(a.x, b.x) - slack || x > std::max(a.x, b.x) + slack;
        }
    }
    CHECK(off == 0);
    CHECK(cut > 1000);
}

TEST_CASE_TEMPLATE("cuts of a common edge agree bit for bit, from either side", T, float, double) {
    test::Random random(5);
    int different = 0, cuts = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3<T> p = random.point(T(-1), T(1)), q = random.point(T(-1), T(1)), r = random.point(T(-1), T(1)),
                      s = random.point(T(-1), T(1));
        const auto distance = [](const Vec3<T>& v) { return v.z; };
        if ((p.z >= T(0)) == (q.z >= T(0))) continue;
        ConvexPolygon<Vec3<T>, 4> one, other;
        one.push(p), one.push(q), one.push(r);
        other.push(q), other.push(p), other.push(s);
        const auto a = clip(one, distance), b = clip(other, distance);
        int found = 0;
        for (std::size_t k = 0; k < a.count; ++k)
            for (std::size_t m = 0; m < b.count; ++m) found += a.vertices[k] == b.vertices[m];
        different += found < 2;  // the inside end, and the cut
        ++cuts;
    }
    CHECK(cuts > 5000);
    CHECK(different == 0);
}

TEST_CASE_TEMPLATE("clip: all inside, all outside, corners on the border, settled cuts", T, float, double) {
    ConvexPolygon<Vec2<T>, 4> triangle;
    triangle.push(Vec2<T>(T(0), T(0))), triangle.push(Vec2<T>(T(2), T(0))), triangle.push(Vec2<T>(T(0), T(2)));
    CHECK(clip(triangle, [](const Vec2<T>& v) { return v.x + T(1); }).count == 3);
    CHECK(clip(triangle, [](const Vec2<T>& v) { return -v.x - T(1); }).count == 0);
    CHECK(clip(triangle, [](const Vec2<T>& v) { return v.x; }).count == 3);   // touches from inside
    const auto edge = clip(triangle, [](const Vec2<T>& v) { return -v.x; });  // touches from outside
    CHECK(twice_area(edge) == 0.0);
    CHECK(clip(ConvexPolygon<Vec2<T>, 4>(), [](const Vec2<T>& v) { return v.x; }).count == 0);
    const auto settled = clip(
        triangle, [](const Vec2<T>& v) { return T(1) / T(3) - v.x; }, [](Vec2<T>& v) { v.x = T(7); });
    CHECK(settled.count == 4);
    CHECK(std::count_if(settled.vertices.begin(), settled.vertices.begin() + 4,
                        [](const Vec2<T>& v) { return v.x == T(7); }) == 2);
    ConvexPolygon<Vec2<T>, 3> full;
    for (int i = 0; i < 5; ++i) full.push(Vec2<T>(T(i), T(0)));
    CHECK(full.count == 3);  // what does not fit is left out
}
