#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/penumbra_wedge/radial_part.hpp>
#include <vector>

#include "../support/polygon_union.hpp"
#include "../support/random.hpp"

using namespace penumbra;
using test::Polygon2;

namespace {

template <class T>
using Loop = std::vector<Vec2<T>>;

template <class T>
RadialPart<T> part_of(const Loop<T>& loop, const Rect2<T>& box) {
    RadialPartBuilder<T> builder(box);
    for (std::size_t i = 0; i < loop.size(); ++i) builder.add(loop[i], loop[(i + 1) % loop.size()], 1);
    return builder.finish();
}

/// Corners on an ellipse, counter-clockwise.
template <class T>
Loop<T> random_convex(test::Random& random, double reach, double size) {
    const int corners = random.whole(3, 8);
    const double x = random.in(-reach, reach), y = random.in(-reach, reach), turn = random.in(0.0, 6.3);
    const double flat = std::exp2(random.in(-6.0, 0.0));
    std::vector<double> angles;
    for (int k = 0; k < corners; ++k) angles.push_back(random.in(0.0, 6.28));
    std::sort(angles.begin(), angles.end());
    Loop<T> loop;
    for (const double angle : angles) {
        const double u = size * std::cos(angle), v = flat * size * std::sin(angle);
        loop.emplace_back(static_cast<T>(x + u * std::cos(turn) - v * std::sin(turn)),
                          static_cast<T>(y + u * std::sin(turn) + v * std::cos(turn)));
    }
    return loop;
}

/// What of the box lies within `margin` of a convex polygon, which may be negative: an independent cut, in double.
template <class T>
Polygon2 cut_convex(const Loop<T>& loop, const Rect2<T>& box, double margin) {
    const glm::dvec2 low(box.min), high(box.max);
    Polygon2 result{low, {high.x, low.y}, high, {low.x, high.y}};
    for (std::size_t i = 0; i < loop.size() && !result.empty(); ++i) {
        const glm::dvec2 from(loop[i]), along = glm::dvec2(loop[(i + 1) % loop.size()]) - from;
        const double length = glm::length(along);
        if (!(length > 0)) continue;
        result = test::cut(result, [&](const glm::dvec2& p) { return test::cross(along, p - from) / length + margin; });
    }
    return result;
}

Rect2<double> around(const Polygon2& polygon) {
    Rect2<double> rect = empty_rect<double>();
    for (const glm::dvec2& p : polygon) rect = extend(rect, p);
    return rect;
}

/// From part coordinates to the plane.
template <class T>
Rect2<double> on_plane(const Rect2<T>& rect, const Rect2<T>& box) {
    const glm::dvec2 low(box.min), size = glm::dvec2(box.max) - low;
    return {low + glm::dvec2(rect.min) * size, low + glm::dvec2(rect.max) * size};
}

bool holds(const Rect2<double>& outer, const Rect2<double>& inner, double margin) {
    return inner.min.x > inner.max.x || (outer.min.x <= inner.min.x + margin && outer.min.y <= inner.min.y + margin &&
                                         outer.max.x >= inner.max.x - margin && outer.max.y >= inner.max.y - margin);
}

template <class T>
bool same(const RadialPart<T>& a, const RadialPart<T>& b) {
    return a.area == b.area && a.moment == b.moment && a.rect.min == b.rect.min && a.rect.max == b.rect.max;
}

template <class T>
void check_invariants(const RadialPart<T>& part) {
    const T epsilon = std::numeric_limits<T>::epsilon();
    CHECK(part.area >= T(0));
    CHECK(part.area <= area(part.rect));
    if (part.area == T(0)) {
        CHECK(same(part, empty_part<T>()));
        return;
    }
    CHECK(part.rect.min.x >= T(0));
    CHECK(part.rect.min.y >= T(0));
    CHECK(part.rect.max.x <= T(1));
    CHECK(part.rect.max.y <= T(1));
    const Vec2<T> centre = part.moment / part.area;  // a rounding
    CHECK(centre.x >= part.rect.min.x * (T(1) - epsilon));
    CHECK(centre.y >= part.rect.min.y * (T(1) - epsilon));
    CHECK(centre.x <= part.rect.max.x * (T(1) + epsilon));
    CHECK(centre.y <= part.rect.max.y * (T(1) + epsilon));
}

template <class T>
Rect2<T> light_box() {
    return {Vec2<T>(T(-1), T(-0.75)), Vec2<T>(T(1), T(0.75))};
}

}  // namespace

TEST_CASE_TEMPLATE("quadrants cover the box once, lower left first", T, float, double) {
    const Rect2<T> box{Vec2<T>(T(-2), T(-1)), Vec2<T>(T(4), T(5))};
    const Rect2<T> q0 = quadrant(box, 0), q1 = quadrant(box, 1), q2 = quadrant(box, 2), q3 = quadrant(box, 3);
    CHECK(q0.min == box.min);
    CHECK(q0.max == Vec2<T>(T(1), T(2)));
    CHECK(q1.min == Vec2<T>(T(1), T(-1)));
    CHECK(q1.max == Vec2<T>(T(4), T(2)));
    CHECK(q2.min == Vec2<T>(T(-2), T(2)));
    CHECK(q2.max == Vec2<T>(T(1), T(5)));
    CHECK(q3.min == Vec2<T>(T(1), T(2)));
    CHECK(q3.max == box.max);
}

TEST_CASE_TEMPLATE("a convex silhouette's part is that of its cut polygon", T, float, double) {
    test::Random random(1);
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    double worst_area = 0, worst_moment = 0;
    for (int i = 0; i < 20000; ++i) {
        const double size = std::exp2(random.in(-8.0, 3.0));
        const Loop<T> loop = random_convex<T>(random, 1.2 + size * 0.7, size);
        for (int k = 0; k < 5; ++k) {
            const Rect2<T> box = k < 4 ? quadrant(light_box<T>(), k) : light_box<T>();
            const glm::dvec2 low(box.min), extents = glm::dvec2(box.max) - low;
            const RadialPart<T> part = part_of(loop, box);
            CAPTURE(i);
            CAPTURE(k);
            check_invariants(part);
            // one loop's moments, by cuts and the shoelace formula
            const auto truth = test::winding_moments(loop, {glm::dvec2(box.min), glm::dvec2(box.max)});
            const double whole = extents.x * extents.y;
            const double area = static_cast<double>(truth.area) / whole;
            // edge_moments' 8 ε an edge, for ends up to 12 away; plus an area as thin as the border
            const double tolerance = 256 * epsilon;
            worst_area = std::max(worst_area, std::abs(static_cast<double>(part.area) - area));
            CHECK(std::abs(static_cast<double>(part.area) - area) <= tolerance);
            const double moment_error = std::max(
                std::abs(static_cast<double>(part.moment.x) - static_cast<double>(truth.x) / whole / extents.x),
                std::abs(static_cast<double>(part.moment.y) - static_cast<double>(truth.y) / whole / extents.y));
            worst_moment = std::max(worst_moment, moment_error);
            CHECK(moment_error <= tolerance);
            if (part.area == T(0)) continue;
            // the border of the cut polygon is right to `margin`, wherever that leaves the rectangle
            const double margin = 64 * epsilon;
            const Rect2<double> rect = on_plane(part.rect, box);
            CHECK(holds(around(cut_convex(loop, box, margin)), rect, margin));
            CHECK(holds(rect, around(cut_convex(loop, box, -margin)), margin));
        }
    }
    std::printf("parts of convex silhouettes: worst area %.2g, moment %.2g\n", worst_area, worst_moment);
}

TEST_CASE_TEMPLATE("several loops in any order, in pieces, reversed with weight -1, doubled with weight 2", T, float,
                   double) {
    struct Edge {
        Vec2<T> a, b;
        int weight;
    };
    test::Random random(2);
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (int i = 0; i < 2000; ++i) {
        std::vector<Edge> edges;
        const Rect2<T> box = quadrant(light_box<T>(), random.whole(0, 3));
        Rect2<T> rect = empty_part<T>().rect;
        T sum = T(0);
        bool sliver = false;  // within the border of 16 ε: empty by itself, but not beside others
        RadialPartBuilder<T> plain(box), turned(box), twice(box);
        for (int l = 0; l < 3; ++l) {
            const Loop<T> loop = random_convex<T>(random, 1.2, 0.5);
            const RadialPart<T> one = part_of(loop, box);
            sum += one.area;
            const double area = test::area(cut_convex(loop, box, 0));
            sliver = sliver || (area != 0 && area < 1e-4);
            rect = {glm::min(rect.min, one.rect.min), glm::max(rect.max, one.rect.max)};
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const Vec2<T> a = loop[k], b = loop[(k + 1) % loop.size()];
                plain.add(a, b, 1), turned.add(b, a, -1), twice.add(a, b, 2);
                const Vec2<T> middle = a + (b - a) * random.in(T(0), T(1));
                edges.push_back({a, middle, 1}), edges.push_back({b, middle, -1});
                const Vec2<T> astray(random.in(T(-1), T(1)), random.in(T(-1), T(1)));
                edges.push_back({a, astray, 0});
            }
        }
        for (std::size_t k = edges.size(); k > 1; --k)
            std::swap(edges[k - 1], edges[static_cast<std::size_t>(random.whole(0, static_cast<int>(k) - 1))]);
        RadialPartBuilder<T> shuffled(box);
        for (const Edge& e : edges) shuffled.add(e.a, e.b, e.weight);
        const RadialPart<T> part = plain.finish(), part_shuffled = shuffled.finish(), part_twice = twice.finish();
        CAPTURE(i);
        CHECK(same(part, turned.finish()));
        CHECK(std::abs(part.area - std::min(sum, area(part.rect))) <= 128 * epsilon);
        CHECK(std::abs(part_shuffled.area - part.area) <= 128 * epsilon);
        CHECK(std::abs(part_twice.area - std::min(T(2) * part.area, area(part.rect))) <= 128 * epsilon);
        if (sliver) continue;
        CHECK(part.rect.min == rect.min);
        CHECK(part.rect.max == rect.max);
        CHECK(part_twice.rect.min == rect.min);
        CHECK(part_twice.rect.max == rect.max);
    }
}
