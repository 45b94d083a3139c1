#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <penumbra/penumbra_wedge/wedge.hpp>
#include <utility>
#include <vector>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

using Exact = Vec3<long double>;

template <class T>
Exact exact(const Vec3<T>& v) {
    return Exact(v);
}

/// Whether P sees the edge before the light: cut to what lies between the light's plane and P's depth, projected from P
/// on that plane, cut to the light. Homogeneous, no planes of wedges.
template <class T>
bool sees(const Vec3<T>& a, const Vec3<T>& b, const Vec2<T>& half, const Vec3<T>& point) {
    const Exact p = exact(point);
    const long double hx = static_cast<long double>(half.x), hy = static_cast<long double>(half.y);
    const auto distances = [&](const Exact& e) {
        const long double w = p.z - e.z, x = p.z * (e.x - p.x) + p.x * w, y = p.z * (e.y - p.y) + p.y * w;
        return std::array<long double, 6>{e.z, w, hx * w - x, hx * w + x, hy * w - y, hy * w + y};
    };
    const std::array<long double, 6> at_a = distances(exact(a)), at_b = distances(exact(b));
    long double first = 0, last = 1;
    for (std::size_t k = 0; k < 6; ++k) {
        if (at_a[k] < 0 && at_b[k] < 0) return false;
        if (at_a[k] < 0) first = std::max(first, at_a[k] / (at_a[k] - at_b[k]));
        if (at_b[k] < 0) last = std::min(last, at_a[k] / (at_a[k] - at_b[k]));
    }
    return first <= last;
}

/// 1 if P is on the inner side of the shadow plane by more than rounding, −1 on the outer side, else 0: the signed
/// volume of light's centre, edge and P, as P sees it.
template <class T>
int side_of_center(const Vec3<T>& a, const Vec3<T>& b, const Vec2<T>& half, const Vec3<T>& point) {
    const Exact along = exact(b) - exact(a), normal = glm::cross(exact(a), along);
    const long double ends = glm::length(exact(a)) + glm::length(exact(b));
    const long double size = ends + glm::length(exact(point)) + static_cast<long double>(half.x + half.y);
    const long double distance = glm::dot(normal, exact(point));
    const long double least =
        64 * static_cast<long double>(std::numeric_limits<T>::epsilon()) * ends * glm::length(along) * size;
    return distance > least ? 1 : distance < -least ? -1 : 0;
}

#if defined(__SANITIZE_ADDRESS__)
constexpr int share = 4;  // of what is tested elsewhere
#else
constexpr int share = 1;
#endif

template <class T>
struct Case {
    Vec3<T> a, b;
    Vec2<T> half;
};

/// Edges of every kind, in front of the light but for those that say so.
template <class T>
Case<T> any_case(test::Random& random) {
    Case<T> c;
    c.half = Vec2<T>(random.in(T(0.05), T(2)), random.in(T(0.05), T(2)));
    c.a = random.point(T(-3), T(3)), c.b = random.point(T(-3), T(3));
    c.a.z = random.in(T(0.01), T(4)), c.b.z = random.in(T(0.01), T(4));
    const auto sign = [&] { return random.whole(0, 1) == 0 ? T(-1) : T(1); };
    // on the light's plane: anywhere on the light, its centre, a corner, a point of its border
    const auto on_light = [&] {
        const int kind = random.whole(0, 3);
        const T x = random.in(T(-1), T(1)), y = random.in(T(-1), T(1)), sx = sign(), sy = sign();
        return kind == 0   ? Vec3<T>(c.half.x * x, c.half.y * y, T(0))
               : kind == 1 ? Vec3<T>(T(0), T(0), T(0))
               : kind == 2 ? Vec3<T>(c.half.x * sx, c.half.y * sy, T(0))
                           : Vec3<T>(c.half.x * sx, c.half.y * y, T(0));
    };
    switch (random.whole(0, 17)) {
        case 0:  // parallel to the light
            c.b.z = c.a.z;
            break;
        case 1:  // and to one of its sides
            c.b.z = c.a.z, c.b.x = c.a.x;
            break;
        case 2:
            c.b.y = c.a.y;
            break;
        case 3:  // of no length
            c.b = c.a;
            break;
        case 4:  // nearly so: some ULP
            c.b = c.a * (T(1) + random.in(T(-4), T(4)) * std::numeric_limits<T>::epsilon());
            break;
        case 5:
            c.b = c.a + T(1e-5) * random.point(T(-1), T(1));
            break;
        case 6: {  // pointing at the light, its centre, a corner, its border
            const Vec3<T> q = on_light();
            c.b = q + (c.a - q) * random.in(T(0), T(2));
            break;
        }
        case 7:  // towards the light's plane, at a right angle
            c.b.x = c.a.x, c.b.y = c.a.y;
            break;
        case 8:  // touching the plane
            c.a.z = T(0);
            break;
        case 9:  // touching the light
            c.a = on_light();
            break;
        case 10:  // nearly
            c.a = on_light(), c.a.z = T(1e-6);
            break;
        case 11:  // crossing the plane
            c.a.z = random.in(T(-3), T(0));
            break;
        case 12:  // crossing it in the light
            c.a = on_light() + (on_light() - c.b) * random.in(T(0.1), T(1));
            break;
        case 13:  // a light without area
            c.half.x = T(0);
            break;
        case 14:
            c.half = Vec2<T>(T(0), T(0));
            break;
        case 15:  // far away
            c.b = c.b * T(1e5);
            break;
        case 16:
            c.a.x += T(1e4);
            break;
        default:
            break;
    }
    return c;
}

/// A point of the wedge, or as near to one as T allows; false if the case has none.
template <class T>
bool any_point(const Case<T>& c, test::Random& random, Vec3<T>& point) {
    const long double t = random.whole(0, 3) == 0 ? random.whole(0, 1) : static_cast<long double>(random.in(0.0, 1.0));
    const Exact e = exact(c.a) * (1 - t) + exact(c.b) * t;
    long double x = static_cast<long double>(random.in(-1.0, 1.0)), y = static_cast<long double>(random.in(-1.0, 1.0));
    const int kind = random.whole(0, 3);  // on the light, its border, a corner, the centre
    if (kind == 1 || kind == 2) x = x < 0 ? -1 : 1;
    if (kind == 2) y = y < 0 ? -1 : 1;
    if (kind == 3) x = y = 0;
    const Exact q(x * static_cast<long double>(c.half.x), y * static_cast<long double>(c.half.y), 0);
    const long double s = random.whole(0, 5) == 0 ? 0 : std::exp2(static_cast<long double>(random.in(-10.0, 10.0)));
    point = Vec3<T>(e + (e - q) * s);
    return e.z >= 0 && point.z > T(0);
}

/// In front of the light, and nothing special.
template <class T>
Case<T> plain_case(test::Random& random) {
    Case<T> c;
    c.half = Vec2<T>(random.in(T(0.1), T(1.5)), random.in(T(0.1), T(1.5)));
    c.a = random.point(T(-2), T(2)), c.b = random.point(T(-2), T(2));
    c.a.z = random.in(T(0.2), T(3)), c.b.z = random.in(T(0.2), T(3));
    return c;
}

/// The convex hull's area of what sees an end of the edge before the light, at one depth.
long double slice_area(const Case<double>& c, long double depth) {
    std::vector<std::pair<long double, long double>> points, hull;
    Exact a = exact(c.a), b = exact(c.b);
    if (b.z < a.z) std::swap(a, b);
    if (b.z > depth) b = a + (b - a) * ((depth - a.z) / (b.z - a.z));
    for (const Exact& e : {a, b})
        for (const long double x : {-1.0L, 1.0L})
            for (const long double y : {-1.0L, 1.0L}) {
                const Exact q(x * static_cast<long double>(c.half.x), y * static_cast<long double>(c.half.y), 0);
                const Exact p = q + (e - q) * (depth / e.z);
                points.emplace_back(p.x, p.y);
            }
    std::sort(points.begin(), points.end());
    long double area = 0;
    for (int turn = 0; turn < 2; ++turn) {  // A. Andrew's chains
        hull.clear();
        for (const auto& p : points) {
            const auto bends = [&](const auto& u, const auto& v) {
                return (v.first - u.first) * (p.second - u.second) - (v.second - u.second) * (p.first - u.first) <= 0;
            };
            while (hull.size() > 1 && bends(hull[hull.size() - 2], hull.back())) hull.pop_back();
            hull.push_back(p);
        }
        for (std::size_t i = 0; i + 1 < hull.size(); ++i)
            area += (hull[i].first * hull[i + 1].second - hull[i + 1].first * hull[i].second) / 2;
        std::reverse(points.begin(), points.end());
    }
    return area;
}

/// Areas are quadratic in the depth between the edge's ends and beyond them: Simpson's rule is exact.
long double wedge_volume(const Case<double>& c, long double depth) {
    const long double a = std::min(static_cast<long double>(std::min(c.a.z, c.b.z)), depth),
                      b = std::min(static_cast<long double>(std::max(c.a.z, c.b.z)), depth);
    const auto part = [&](long double from, long double to) {
        return (to - from) / 6 * (slice_area(c, from) + 4 * slice_area(c, (from + to) / 2) + slice_area(c, to));
    };
    return part(a, b) + part(b, depth);
}

template <class T>
std::array<Vec3<T>, wedge_vertex_count> vertices(const Case<T>& c, const Box3<T>& receivers) {
    std::array<Vec3<T>, wedge_vertex_count> result;
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = wedge_vertex(c.a, c.b, c.half, receivers, static_cast<int>(i));
    return result;
}

/// How far, at most, the point is outside a side of the geometry, which is convex. In units of `rounding`, its
/// vertices', which turns narrow triangles: they are the less known the farther away the point.
template <class T>
long double outside(const std::array<Vec3<T>, wedge_vertex_count>& geometry, const Vec3<T>& point,
                    long double rounding) {
    long double most = 0;
    for (const auto& t : wedge_triangles) {
        const Exact v = exact(geometry[t[0]]), e = exact(geometry[t[1]]) - v, f = exact(geometry[t[2]]) - v;
        const Exact normal = glm::cross(e, f), to = exact(point) - v;
        const long double twice_area = glm::length(normal);
        const long double longest = std::max({glm::length(e), glm::length(f), glm::length(e - f)});
        if (!(twice_area > rounding * longest)) continue;
        const long double height = twice_area / longest;
        const long double distance = glm::dot(normal, to) / twice_area;
        most = std::max(most, distance / (rounding * (1 + glm::length(to) / height)));
    }
    return most;
}

}  // namespace

TEST_CASE_TEMPLATE("a wedge contains all its points, for edges of every kind", T, float, double) {
    test::Random random(1);
    int points = 0, inner = 0, outer = 0;
    for (int round = 0; round < 600000 / share; ++round) {
        const Case<T> c = any_case<T>(random);
        const Wedge<T> w = wedge(c.a, c.b, c.half);
        const HalfWedge<T> halves[2] = {half_wedge(w, WedgeHalf::inner), half_wedge(w, WedgeHalf::outer)};
        for (int k = 0; k < 2; ++k) {
            Vec3<T> point;
            if (!any_point(c, random, point)) continue;
            ++points;
            CAPTURE(round);
            CAPTURE(point.z);
            CHECK(contains(w, point));
            const bool in_inner = contains(halves[0], point), in_outer = contains(halves[1], point);
            CHECK((in_inner || in_outer));
            const int side = side_of_center(c.a, c.b, c.half, point);
            CHECK((side != 1 || (in_inner && !in_outer)));
            CHECK((side != -1 || (in_outer && !in_inner)));
            inner += side == 1, outer += side == -1;
        }
    }
    CHECK(points > 1000000 / share);
    CHECK(inner > 200000 / share);
    CHECK(outer > 200000 / share);
}

TEST_CASE("and nothing else: its planes are exact") {
    test::Random random(2);
    int points = 0, in = 0, wrong = 0;
    for (int round = 0; round < 600000 / share; ++round) {
        const Case<double> c = any_case<double>(random);
        // an edge on the light's border, in the light's plane, has all points or none, as rounding decides
        if (std::min(c.a.z, c.b.z) < 1e-3) continue;
        Vec3<double> point;
        if (!any_point(c, random, point)) continue;
        const double size = std::exp2(random.in(-10.0, 3.0));
        point = point + size * random.point(-1.0, 1.0);
        if (!(point.z > 0.0)) continue;
        const bool found = contains(wedge(c.a, c.b, c.half), point);
        ++points, in += found, wrong += found != sees(c.a, c.b, c.half, point);
    }
    CHECK(points > 300000 / share);
    CHECK(in > 100000 / share);
    CHECK(points - in > 100000 / share);
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("three planes a half let little else in", T, float, double) {
    test::Random random(3);
    int truth = 0, six = 0, inner = 0, outer = 0;
    for (int round = 0; round < 10000; ++round) {
        const Case<T> c = plain_case<T>(random);
        const Wedge<T> w = wedge(c.a, c.b, c.half);
        const HalfWedge<T> halves[2] = {half_wedge(w, WedgeHalf::inner), half_wedge(w, WedgeHalf::outer)};
        for (int k = 0; k < 100; ++k) {
            Vec3<T> point = random.point(T(-6), T(6));
            point.z = random.in(T(0.1), T(6));
            truth += sees(c.a, c.b, c.half, point), six += contains(w, point);
            inner += contains(halves[0], point), outer += contains(halves[1], point);
        }
    }
    MESSAGE("true " << truth << ", six planes " << six << ", inner " << inner << ", outer " << outer);
    CHECK(truth > 100000);
    CHECK(std::abs(six - truth) <= truth * 1e-4);  // float's slack
    CHECK(inner + outer <= truth * 1.04);          // 3 % measured
    CHECK(std::abs(inner - outer) < truth * 0.05);
}

TEST_CASE_TEMPLATE("points of the inner half see the light's centre left of the edge", T, float, double) {
    test::Random random(4);
    int inner = 0, outer = 0;
    for (int round = 0; round < 100000; ++round) {
        const Case<T> c = plain_case<T>(random);
        Vec3<T> point;
        if (!any_point(c, random, point) || !(point.z > T(3.1))) continue;
        const Exact p = exact(point);
        const auto landed = [&](const Vec3<T>& e) { return p + (exact(e) - p) * (p.z / (p.z - exact(e).z)); };
        const Exact a = landed(c.a), b = landed(c.b);
        const long double left = (b.x - a.x) * -a.y + (b.y - a.y) * a.x;
        if (std::abs(left) < 1e-3L * glm::length(b - a)) continue;
        const Wedge<T> w = wedge(c.a, c.b, c.half);
        CHECK(contains(half_wedge(w, WedgeHalf::inner), point) == (left > 0));
        CHECK(contains(half_wedge(w, WedgeHalf::outer), point) == (left < 0));
        inner += left > 0, outer += left < 0;
    }
    CHECK(inner > 10000);
    CHECK(outer > 10000);
}

TEST_CASE("the bounding geometry is closed, and each side is shared by two triangles") {
    std::map<std::pair<int, int>, int> sides;
    for (const auto& t : wedge_triangles)
        for (int k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
    CHECK(sides.size() == 3 * wedge_triangle_count);
    for (const auto& [side, count] : sides) {
        CHECK(side.first != side.second);
        CHECK(side.first < wedge_vertex_count);
        CHECK(count == 1);
        CHECK(sides[{side.second, side.first}] == 1);
    }
    CHECK(sides.size() == 3 * wedge_triangle_count);
    CHECK(wedge_vertex_count - static_cast<int>(sides.size()) / 2 + wedge_triangle_count == 2);  // a sphere
}

TEST_CASE_TEMPLATE("the bounding geometry is the wedge: it has its points, and its volume", T, float, double) {
    test::Random random(5);
    long double worst = 0, worst_volume = 0;
    int inside = 0;
    for (int round = 0; round < 100000; ++round) {
        const bool plain = round % 4 == 0;
        const Case<T> c = plain ? plain_case<T>(random) : any_case<T>(random);
        const T depth = random.in(T(0.1), T(8));
        const Box3<T> receivers{Vec3<T>(T(-20), T(-20), T(0)), Vec3<T>(T(20), T(20), depth)};
        const auto geometry = vertices(c, receivers);
        long double size = 0, volume = 0;
        for (const Vec3<T>& v : geometry) {
            REQUIRE(is_finite(v));
            size = std::max(size, static_cast<long double>(detail::largest_component(v)));
        }
        for (const auto& t : wedge_triangles) {
            const Exact at = exact(geometry[0]);
            volume += glm::dot(exact(geometry[t[0]]) - at,
                               glm::cross(exact(geometry[t[1]]) - at, exact(geometry[t[2]]) - at)) /
                      6;
        }
        const long double rounding = static_cast<long double>(std::numeric_limits<T>::epsilon()) * size;
        CAPTURE(round);
        if (plain) {
            const Case<double> same{Vec3<double>(c.a), Vec3<double>(c.b), Vec2<double>(c.half)};
            const long double truth = wedge_volume(same, static_cast<long double>(depth));
            worst_volume = std::max(worst_volume, std::abs(volume - truth) / (rounding * size * size));
        }
        for (int k = 0; k < 8; ++k) {
            Vec3<T> point;
            if (!any_point(c, random, point) || point.z > depth) continue;
            if (std::max(std::abs(point.x), std::abs(point.y)) > T(20)) continue;
            ++inside;
            worst = std::max(worst, outside(geometry, point, rounding));
        }
    }
    MESSAGE("outside by " << static_cast<double>(worst) << " epsilon, volume by " << static_cast<double>(worst_volume));
    CHECK(inside > 100000);
    CHECK(worst <= 2);
    CHECK(worst_volume <= 2);
}

TEST_CASE_TEMPLATE("edges that point at the light have halves of three sides, exactly", T, float, double) {
    test::Random random(6);
    int truth = 0, inner = 0, outer = 0;
    for (int round = 0; round < 20000; ++round) {
        Case<T> c = plain_case<T>(random);
        const T x = random.in(T(-0.9), T(0.9)), y = random.in(T(-0.9), T(0.9));
        const Vec3<T> on_light(c.half.x * x, c.half.y * y, T(0));
        c.b = on_light + (c.a - on_light) * random.in(T(0.1), T(3));
        const Wedge<T> w = wedge(c.a, c.b, c.half);
        const HalfWedge<T> halves[2] = {half_wedge(w, WedgeHalf::inner), half_wedge(w, WedgeHalf::outer)};
        for (int k = 0; k < 20; ++k) {
            Vec3<T> point = random.point(T(-6), T(6));
            point.z = random.in(T(0.1), T(6));
            truth += sees(c.a, c.b, c.half, point);
            inner += contains(halves[0], point), outer += contains(halves[1], point);
        }
    }
    CHECK(truth > 10000);
    CHECK(std::abs(inner + outer - truth) <= truth * 2e-4);  // float's slack
}

TEST_CASE_TEMPLATE("an edge the other way round has the same wedge, with its halves exchanged", T, float, double) {
    test::Random random(7);
    int different = 0;
    for (int round = 0; round < 20000; ++round) {
        const Case<T> c = any_case<T>(random);
        const Wedge<T> there = wedge(c.a, c.b, c.half), back = wedge(c.b, c.a, c.half);
        Vec3<T> point;
        if (!any_point(c, random, point)) continue;
        point += random.point(T(-1), T(1));
        const bool parted = there.shadow.normal != Vec3<T>(T(0), T(0), T(0));
        different += contains(there, point) != contains(back, point);
        if (!parted) continue;  // all is outer, both ways
        different +=
            contains(half_wedge(there, WedgeHalf::inner), point) != contains(half_wedge(back, WedgeHalf::outer), point);
        different +=
            contains(half_wedge(there, WedgeHalf::outer), point) != contains(half_wedge(back, WedgeHalf::inner), point);
    }
    CHECK(different <= 20);  // where rounding decides
}

TEST_CASE_TEMPLATE("degenerate edges and lights have the wedges that are written down", T, float, double) {
    test::Random random(8);
    const auto at = [](T x, T y, T z) { return Vec3<T>(x, y, z); };
    const Vec2<T> half(T(1), T(0.5)), none(T(0), T(0));
    const Wedge<T> behind = wedge(at(T(-1), T(0), T(-1)), at(T(1), T(0), T(-0.1)), half);
    const Wedge<T> beside = wedge(at(T(-9), T(2), T(0)), at(T(9), T(0.7), T(0)), half);
    const Wedge<T> past_corner = wedge(at(T(0), T(2), T(0)), at(T(2.5), T(0), T(0)), half);
    const Wedge<T> on_light = wedge(at(T(-9), T(1), T(0)), at(T(9), T(-2), T(0)), half);
    const Wedge<T> through_light = wedge(at(T(0.5), T(0.2), T(-1)), at(T(-0.5), T(-0.2), T(1)), half);
    const Wedge<T> dot = wedge(at(T(0.5), T(0.2), T(1)), at(T(0.5), T(0.2), T(1)), half);
    const Wedge<T> in_line = wedge(at(T(0.5), T(0.25), T(1)), at(T(1), T(0.5), T(2)), half);
    const Wedge<T> no_light = wedge(at(T(-1), T(0.5), T(1)), at(T(1), T(0.5), T(1)), none);
    int seen = 0;
    for (int k = 0; k < 20000; ++k) {
        Vec3<T> p = random.point(T(-4), T(4));
        p.z = random.in(T(0.01), T(4));
        for (const Wedge<T>& empty : {behind, beside, past_corner}) {
            CHECK(!contains(empty, p));
            CHECK(!contains(half_wedge(empty, WedgeHalf::inner), p));
        }
        CHECK(!contains(half_wedge(behind, WedgeHalf::outer), p));
        CHECK(contains(on_light, p));
        CHECK(contains(through_light, p));
        const bool in_dot = sees(at(T(0.5), T(0.2), T(1)), at(T(0.5), T(0.2), T(1)), half, p);
        CHECK(contains(dot, p) == in_dot);
        CHECK(!contains(half_wedge(dot, WedgeHalf::inner), p));
        CHECK((!in_dot || contains(half_wedge(dot, WedgeHalf::outer), p)));
        CHECK(!contains(half_wedge(in_line, WedgeHalf::inner), p));
        CHECK((!contains(in_line, p) || contains(half_wedge(in_line, WedgeHalf::outer), p)));
        CHECK(!contains(no_light, p));  // flat, and none of these points in its plane
        CHECK(contains(no_light, at(p.x, T(0.5) * p.z, p.z)) == (std::abs(p.x) <= p.z));
        seen += in_dot;
    }
    CHECK(seen > 1000);
    const Box3<T> receivers{at(T(-4), T(-3), T(0.5)), at(T(4), T(3), T(2))};
    for (int i = 0; i < wedge_vertex_count; ++i) {
        // nothing to bound: behind the light, or beyond the receivers
        const Vec3<T> p = at(T(1), T(0), T(-1)), q = at(T(0), T(0), T(-2)), far = at(T(0), T(0), T(3));
        CHECK(wedge_vertex(p, q, half, receivers, i) == wedge_vertex(p, q, half, receivers, 0));
        CHECK(wedge_vertex(far + p * T(0.1), far, half, receivers, i) ==
              wedge_vertex(far + p * T(0.1), far, half, receivers, 0));
        // touching the light's plane: the receivers' box
        const Vec3<T> v = wedge_vertex(at(T(1), T(2), T(0)), at(T(1), T(1), T(1)), half, receivers, i);
        CHECK(std::abs(v.x) == T(4));
        CHECK(std::abs(v.y) == T(3));
        CHECK(v.z == (i < 6 ? T(0.5) : T(2)));
    }
}

TEST_CASE_TEMPLATE("wedges scale by powers of two bit for bit", T, float, double) {
    test::Random random(9);
    for (int round = 0; round < 20000; ++round) {
        const Case<T> c = any_case<T>(random);
        const T scale = exp2_int<T>(random.whole(-30, 30));
        const Wedge<T> one = wedge(c.a, c.b, c.half), other = wedge(c.a * scale, c.b * scale, c.half * scale);
        for (const auto plane : {&Wedge<T>::shadow, &Wedge<T>::inner, &Wedge<T>::outer, &Wedge<T>::right,
                                 &Wedge<T>::top, &Wedge<T>::left, &Wedge<T>::bottom}) {
            CHECK((one.*plane).normal == (other.*plane).normal);
            if ((one.*plane).normal != Vec3<T>(T(0), T(0), T(0)))
                CHECK((one.*plane).offset * scale == (other.*plane).offset);
        }
    }
}

TEST_CASE_TEMPLATE("planes and vertices are finite at any size", T, float, double) {
    test::Random random(10);
    const auto number = [&] {
        const T size = exp2_int<T>(random.whole(-60, 59));
        return random.whole(0, 7) == 0 ? T(0) : size * random.in(T(-1), T(1));
    };
    const auto point = [&] {
        const T x = number(), y = number(), z = number();
        return Vec3<T>(x, y, z);
    };
    for (int round = 0; round < 100000; ++round) {
        const T x = std::abs(number()), y = std::abs(number());
        const Case<T> c{point(), point(), Vec2<T>(x, y)};
        const Wedge<T> w = wedge(c.a, c.b, c.half);
        for (const Plane<T>& p : {w.shadow, w.inner, w.outer, w.right, w.top, w.left, w.bottom}) {
            CHECK(is_finite(p.normal));
            CHECK(is_finite(p.offset));
            CHECK(glm::dot(p.normal, p.normal) <= T(200));
        }
        const Vec3<T> p = point(), q = point();
        CHECK(is_finite(signed_distance(w.inner, p)));
        const Box3<T> receivers{glm::min(p, q), glm::max(p, q)};
        for (const Vec3<T>& v : vertices(c, receivers)) CHECK(is_finite(v));
    }
}
