#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/penumbra_wedge/edge_union.hpp>
#include <vector>

#include "support/polygon_union.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

using Polygons = std::vector<test::Polygon2>;

const Rect2<double> unit_d{{-1.0, -1.0}, {1.0, 1.0}};

#if defined(__SANITIZE_ADDRESS__)
constexpr int trials = 40;
#else
constexpr int trials = 300;
#endif

template <class T>
Rect2<T> as(const Rect2<double>& box) {
    return {Vec2<T>(box.min), Vec2<T>(box.max)};
}

template <class T, std::size_t N>
double area_of(EdgeUnion<T, N>& edges, const Rect2<double>& box_d) {
    const Rect2<T> box = as<T>(box_d);
    const T sum = edges.area([&](T ax, T ay, T bx, T by) { return detail::edge_coverage(ax, ay, bx, by, box); });
    return static_cast<double>(sum / area(box));
}

/// What all loops together cover of the box, each a piece.
template <class T>
double covered(const Polygons& loops, const Rect2<double>& box = unit_d, int weight = 1) {
    static EdgeUnion<T, 512> edges;
    edges.clear();
    for (const test::Polygon2& loop : loops) {
        edges.begin_piece();
        for (std::size_t i = 0; i < loop.size(); ++i)
            REQUIRE(edges.add(Vec2<T>(loop[i]), Vec2<T>(loop[i + 1 == loop.size() ? 0 : i + 1]), weight, as<T>(box)));
    }
    return area_of(edges, box);
}
double truth_of(const Polygons& loops, const Rect2<double>& box = unit_d) {
    return test::union_area(loops, box) / area(box);
}

enum class Kind { convex, star, concave, clockwise, twice, on_a_grid, tiny, far, needle, any };
constexpr Kind kinds[] = {Kind::convex,    Kind::star, Kind::concave, Kind::clockwise, Kind::twice,
                          Kind::on_a_grid, Kind::tiny, Kind::far,     Kind::needle};

/// Around the box, of coordinates that float holds.
test::Polygon2 random_loop(test::Random& random, Kind kind) {
    if (kind == Kind::any) kind = kinds[random.whole(0, 8)];
    const glm::dvec2 at(random.in(-1.2, 1.2), random.in(-1.2, 1.2));
    const double radius = kind == Kind::tiny  ? random.in(1e-6, 1e-3)
                          : kind == Kind::far ? std::pow(10.0, random.in(0.0, 5.0))
                                              : random.in(0.1, 1.2);
    const int corners = random.whole(3, 15), around = kind == Kind::star || kind == Kind::twice ? 2 : 1;
    const double start = random.in(0.0, 6.28), sign = kind == Kind::clockwise ? -1.0 : 1.0;
    test::Polygon2 loop;
    for (int i = 0; i < corners; ++i) {
        const double angle = start + sign * 2.0 * std::acos(-1.0) * around * i / corners;
        const double r = radius * (kind == Kind::convex || kind == Kind::star ? 1.0 : random.in(0.3, 1.0));
        glm::dvec2 corner = at + r * glm::dvec2(std::cos(angle), std::sin(angle));
        if (kind == Kind::on_a_grid) corner = glm::round(corner * 8.0) / 8.0;
        if (kind == Kind::needle) corner.x = at.x + (corner.x - at.x) * 1e-5;
        loop.push_back(glm::dvec2(Vec2<float>(corner)));
    }
    return loop;
}
Polygons random_loops(test::Random& random, Kind kind, int count) {
    Polygons loops;
    for (int k = 0; k < count; ++k) loops.push_back(random_loop(random, kind));
    return loops;
}

template <class T>
constexpr double room = sizeof(T) == 4 ? 1e-6 : 1e-13;

}  // namespace

TEST_CASE_TEMPLATE("any loops: what they cover together, and of one alone", T, float, double) {
    for (const int count : {1, 2, 5, 20}) {
        double worst = 0.0;
        for (int kind = 0; kind <= static_cast<int>(Kind::any); ++kind) {
            test::Random random(1);
            for (int t = 0; t < trials; ++t) {
                const Polygons loops = random_loops(random, static_cast<Kind>(kind), count);
                const double error = std::abs(covered<T>(loops) - truth_of(loops));
                CAPTURE(kind);
                CAPTURE(t);
                REQUIRE(error <= room<T>);
                worst = std::max(worst, error);
            }
        }
        MESSAGE(count, " loops: worst ", worst);
    }
}

TEST_CASE_TEMPLATE("boxes of any place and shape", T, float, double) {
    test::Random random(2);
    for (int t = 0; t < trials; ++t) {
        const double scale = std::ldexp(1.0, random.whole(-20, 20));
        const Polygons loops = random_loops(random, Kind::any, 6);
        Polygons there = loops;
        for (test::Polygon2& loop : there)
            for (glm::dvec2& v : loop) v *= scale;
        const Rect2<double> box{{-0.75, -0.25}, {0.5, 0.75}}, box_there{box.min * scale, box.max * scale};
        const double here = covered<T>(loops, box);
        CHECK(std::abs(here - truth_of(loops, box)) <= room<T>);
        CHECK(covered<T>(there, box_there) == here);
    }
}

TEST_CASE_TEMPLATE("weights: what is wound backwards or several times counts once", T, float, double) {
    test::Random random(3);
    for (int t = 0; t < trials; ++t) {
        const Polygons loops = random_loops(random, Kind::convex, 4);
        const double once = covered<T>(loops);
        for (const int weight : {-2, -1, 2}) CHECK(std::abs(covered<T>(loops, unit_d, weight) - once) <= room<T>);
        CHECK(covered<T>(loops, unit_d, 0) == 0.0);
    }
}

TEST_CASE_TEMPLATE("loops on top of each other, inside each other, side by side", T, float, double) {
    test::Random random(4);
    for (int t = 0; t < trials; ++t) {
        const test::Polygon2 loop = random_loop(random, Kind::concave);
        test::Polygon2 inner = random_loop(random, Kind::convex), outer = inner;
        const double once = covered<T>({loop});
        CHECK(std::abs(covered<T>({loop, loop, loop, loop}) - once) <= room<T>);
        for (glm::dvec2& v : inner) v = v * 0.5 + outer[0] * 0.25 + outer[1] * 0.25;
        CHECK(std::abs(covered<T>({inner, outer}) - covered<T>({outer})) <= room<T>);
        // halves of the box that share an edge, upright at times
        const double x = random.in(-1.0, 1.0), tilt = t % 4 == 0 ? 0.0 : random.in(-0.5, 0.5);
        const glm::dvec2 bottom(x + tilt, -2), top(x - tilt, 2);
        CHECK(std::abs(covered<T>({{{-2.5, -2}, bottom, top, {-2.5, 2}}, {bottom, {2.5, -2}, {2.5, 2}, top}}) - 1.0) <=
              room<T>);
        // a fan of triangles, neighbours sharing edges: the polygon
        Polygons fan;
        for (std::size_t k = 2; k < outer.size(); ++k) fan.push_back({outer[0], outer[k - 1], outer[k]});
        CHECK(std::abs(covered<T>(fan) - covered<T>({outer})) <= room<T>);
    }
}

TEST_CASE_TEMPLATE("a piece of several loops: holes stay open", T, float, double) {
    EdgeUnion<T, 16> edges;
    const auto square = [&](T half, int weight) {
        const Vec2<T> c[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
        for (int k = 0; k < 4; ++k) edges.add(c[k], c[(k + 1) % 4], weight, as<T>(unit_d));
    };
    edges.clear(), square(T(0.5), 1), square(T(0.25), -1);
    CHECK(area_of(edges, unit_d) == 0.25 - 0.0625);
    CHECK(area_of(edges, unit_d) == 0.25 - 0.0625);  // again
    edges.begin_piece(), square(T(0.25), 1);
    CHECK(area_of(edges, unit_d) == 0.25);
    edges.clear();
    CHECK(area_of(edges, unit_d) == 0.0);
    square(T(3), 1);
    CHECK(area_of(edges, unit_d) == 1.0);
}

TEST_CASE_TEMPLATE("never less than the largest, never more than all or the sum", T, float, double) {
    test::Random random(5);
    for (int t = 0; t < trials; ++t) {
        Polygons loops;
        double largest = 0.0, sum = 0.0, before = 0.0;
        for (int k = 0; k < 8; ++k) {
            loops.push_back(random_loop(random, Kind::any));
            const double alone = covered<T>({loops.back()}), all = covered<T>(loops);
            largest = std::max(largest, alone), sum += alone;
            const double slack = 2.0 * room<T>;
            REQUIRE(all >= largest - slack);
            REQUIRE(all >= before - slack);
            REQUIRE(all <= std::min(sum, 1.0) + slack);
            before = all;
        }
    }
}

TEST_CASE_TEMPLATE("the order of loops, of edges and of their ends changes nothing beyond rounding", T, float, double) {
    test::Random random(6);
    for (int t = 0; t < trials; ++t) {
        Polygons loops = random_loops(random, Kind::any, 8);
        const double before = covered<T>(loops);
        for (std::size_t k = loops.size(); k > 1; --k)
            std::swap(loops[k - 1], loops[static_cast<std::size_t>(random.whole(0, static_cast<int>(k) - 1))]);
        for (test::Polygon2& loop : loops) {
            std::rotate(loop.begin(), loop.begin() + random.whole(0, static_cast<int>(loop.size()) - 1), loop.end());
            if (random.whole(0, 1) == 0) std::reverse(loop.begin(), loop.end());
        }
        CHECK(std::abs(covered<T>(loops) - before) <= 2.0 * room<T>);
    }
}

TEST_CASE_TEMPLATE("a small move changes little", T, float, double) {
    test::Random random(7);
    for (int t = 0; t < trials; ++t) {
        const Kind kind = kinds[random.whole(0, 6)];
        Polygons loops = random_loops(random, kind, 6);
        const double before = covered<T>(loops), step = std::pow(10.0, random.in(-8.0, -4.0));
        double around = 0.0;
        for (test::Polygon2& loop : loops)
            for (std::size_t i = 0; i < loop.size(); ++i)
                around += glm::length(loop[i] - loop[(i + 1) % loop.size()]) + 2.0 * step;
        for (test::Polygon2& loop : loops)
            for (glm::dvec2& v : loop) v += glm::dvec2(random.in(-step, step), random.in(-step, step));
        // what edges sweep, and coordinates that float rounds
        const double most = around * (1.5 * step + (sizeof(T) == 4 ? 1e-7 : 0.0)) / 4.0 + room<T>;
        CHECK(std::abs(covered<T>(loops) - before) <= most);
    }
}

TEST_CASE("more edges than fit are reported, and leave what is there as it is") {
    EdgeUnion<float, 6> edges;
    const Rect2<float> box = as<float>(unit_d);
    const Vec2<float> c[] = {{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.0F, 0.75F}};
    for (int loop = 0; loop < 2; ++loop) {
        edges.begin_piece();
        for (int k = 0; k < 3; ++k) CHECK(edges.add(c[k], c[(k + 1) % 3], 1, box));
    }
    const double before = area_of(edges, unit_d);
    CHECK(edges.count() == 6);
    CHECK(!edges.add(c[0], c[1], 1, box));
    CHECK(edges.add({0.5F, -1.0F}, {0.5F, 1.0F}, 1, box));    // upright
    CHECK(edges.add({2.0F, -1.0F}, {3.0F, 1.0F}, 1, box));    // beside
    CHECK(edges.add({-0.5F, -1.0F}, {0.5F, -1.5F}, 1, box));  // below
    CHECK(edges.add({-0.5F, -0.5F}, {0.5F, -0.5F}, 0, box));  // counts for nothing
    CHECK(edges.count() == 6);
    CHECK(area_of(edges, unit_d) == before);
    edges.clear();
    CHECK(edges.count() == 0);
    CHECK(edges.add(c[0], c[1], 1, box));
}

TEST_CASE_TEMPLATE("crossings beyond counting come to an end, and so do numbers that are none", T, float, double) {
    static EdgeUnion<T, 256> edges;
    const Rect2<T> box = as<T>(unit_d);
    test::Random random(8);
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    constexpr T odd[] = {nan,     inf,      -inf,
                         T(1e18), T(-1e18), std::numeric_limits<T>::max(),
                         T(0),    T(1e-30), std::numeric_limits<T>::denorm_min()};
    for (int t = 0; t < trials; ++t) {
        edges.clear();
        const bool any = t % 2 == 0;  // else finite, as the domain says
        for (int k = 0; k < 256; ++k) {
            const auto number = [&] {
                const int which = random.whole(any ? 0 : 3, 24);
                return which < 9 && (any || which != 5) ? odd[which] : random.in(T(-1.5), T(1.5));
            };
            if (k % 8 == 0) edges.begin_piece();
            const T ax = number(), ay = number(), bx = number(), by = number();
            edges.add({ax, ay}, {bx, by}, random.whole(-2, 2), box);
        }
        const double area = area_of(edges, unit_d);
        if (!any) CHECK(std::abs(area) < 1e3);  // finite; edges without loops cover anything
    }
    for (const Rect2<T>& bad :
         {Rect2<T>{{nan, nan}, {nan, nan}}, Rect2<T>{{-inf, -inf}, {inf, inf}}, Rect2<T>{{T(0), T(0)}, {T(0), T(0)}}}) {
        edges.clear();
        for (int k = 0; k < 256; ++k)
            edges.add({random.in(T(-1), T(1)), random.in(T(-1), T(1))},
                      {random.in(T(-1), T(1)), random.in(T(-1), T(1))}, 1, bad);
        area_of(edges, unit_d);
    }
}

TEST_CASE_TEMPLATE("huge coordinates, and edges all but upright", T, float, double) {
    CHECK(covered<T>({{{-1e18, -1e18}, {1e18, -1e18}, {1e18, 1e18}, {-1e18, 1e18}}}) == 1.0);
    CHECK(covered<T>({{{-1e18, -1e18}, {1e18, -1e18}, {0.0, 1e18}}, {{-3, -3}, {3, -3}, {0, 0.5}}}) == 1.0);
    const double tiny = static_cast<double>(std::numeric_limits<T>::min());
    for (const double run : {1e-3, 1e-9, 1e-20, 1e-37, tiny, tiny / 4.0}) {
        CAPTURE(run);
        const Polygons halves{{{-2, -2}, {0, -2}, {run, 2}, {-2, 2}}, {{0, -2}, {2, -2}, {2, 2}, {run, 2}}};
        CHECK(std::abs(covered<T>(halves) - 1.0) <= room<T>);
        CHECK(std::abs(covered<T>({halves[0]}) - 0.5) <= 0.5 * run + room<T>);
        const Polygons far{{{-2, -2}, {0, -1e18}, {run, 1e18}, {-2, 2}}};
        CHECK(std::abs(covered<T>(far) - 0.5) <= 0.5 * run + room<T>);
    }
}

TEST_CASE("a hundred lines that cross one another everywhere") {
    // a grid of needles: 40 by 40 crossings and more than 16 an edge
    test::Random random(9);
    Polygons needles;
    for (int k = 0; k < 40; ++k) {
        const double at = random.in(-0.9, 0.9), lean = random.in(-0.05, 0.05), half = 0.004;
        const bool upright = k % 2 == 0;
        const auto corner = [&](double along, double across) {
            const glm::dvec2 v(along, at + lean * along + across);
            return upright ? glm::dvec2(v.y, v.x) : v;
        };
        needles.push_back({corner(-2, -half), corner(2, -half), corner(2, half), corner(-2, half)});
    }
    CHECK(std::abs(covered<double>(needles) - truth_of(needles)) <= 1e-13);
    CHECK(std::abs(covered<float>(needles) - truth_of(needles)) <= 2e-6);
}
