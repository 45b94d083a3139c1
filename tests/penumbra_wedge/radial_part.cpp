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
    CHECK(part.moment.x >= part.area * part.rect.min.x);
    CHECK(part.moment.y >= part.area * part.rect.min.y);
    CHECK(part.moment.x <= part.area * part.rect.max.x);
    CHECK(part.moment.y <= part.area * part.rect.max.y);
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
                const Vec2<T> astray{random.in(T(-1), T(1)), random.in(T(-1), T(1))};
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

TEST_CASE_TEMPLATE("a corner that is enclosed without an edge near it is in the rectangle", T, float, double) {
    const Rect2<T> box{Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))};
    // the lower half, by one edge inside: the paper's rectangle would be flat
    const RadialPart<T> lower = part_of<T>({{T(-9), T(-9)}, {T(9), T(-9)}, {T(9), T(0.5)}, {T(-9), T(0.5)}}, box);
    CHECK(lower.rect.min == Vec2<T>(T(0), T(0)));
    CHECK(lower.rect.max == Vec2<T>(T(1), T(0.5)));
    CHECK(lower.area == doctest::Approx(0.5).epsilon(1e-6));
    CHECK(lower.moment.y == doctest::Approx(0.125).epsilon(1e-6));
    // all but a cut corner: the edge's own rectangle is the corner
    const RadialPart<T> most =
        part_of<T>({{T(-9), T(-9)}, {T(9), T(-9)}, {T(9), T(-7.25)}, {T(-7.25), T(9)}, {T(-9), T(9)}}, box);
    CHECK(most.rect.min == Vec2<T>(T(0), T(0)));
    CHECK(most.rect.max == Vec2<T>(T(1), T(1)));
    CHECK(most.area == doctest::Approx(1 - 0.125 * 0.25).epsilon(1e-6));
    // each corner alone
    for (int corner = 0; corner < 4; ++corner) {
        const T x = (corner & 1) != 0 ? T(1) : T(0), y = (corner & 2) != 0 ? T(1) : T(0);
        const RadialPart<T> part = part_of<T>({{x - T(0.25), y - T(0.25)},
                                               {x + T(0.25), y - T(0.25)},
                                               {x + T(0.25), y + T(0.25)},
                                               {x - T(0.25), y + T(0.25)}},
                                              box);
        CHECK(part.rect.min == Vec2<T>(x * T(0.75), y * T(0.75)));
        CHECK(part.rect.max == Vec2<T>(T(0.25) + x * T(0.75), T(0.25) + y * T(0.75)));
        CHECK(part.area == doctest::Approx(0.0625).epsilon(1e-6));
    }
}

TEST_CASE_TEMPLATE("all and nothing are exact, also if edges run along the border give or take a rounding", T, float,
                   double) {
    test::Random random(3);
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (int i = 0; i < 1000; ++i) {
        const Rect2<T> light = light_box<T>();
        const auto near = [&](T x) { return x + random.in(T(-2), T(2)) * epsilon; };
        const Loop<T> around{{near(light.min.x), near(light.min.y)},
                             {near(light.max.x), near(light.min.y)},
                             {near(light.max.x), near(light.max.y)},
                             {near(light.min.x), near(light.max.y)}};
        for (int k = 0; k < 4; ++k) CHECK(same(part_of(around, quadrant(light, k)), full_part<T>()));
        CHECK(same(part_of(around, light), full_part<T>()));
        // the left half: all of the left quadrants, nothing of the right ones
        const T zero = random.in(T(-2), T(2)) * epsilon;
        const Loop<T> left{around[0], {zero, around[0].y}, {zero, around[2].y}, around[3]};
        for (int k = 0; k < 4; ++k)
            CHECK(same(part_of(left, quadrant(light, k)), (k & 1) != 0 ? empty_part<T>() : full_part<T>()));
    }
}

TEST_CASE_TEMPLATE("what a cut leaves on the border does not widen the rectangle", T, float, double) {
    // A fork whose prongs reach into the light from below, cut by the light's border: its pieces stay connected there.
    const Rect2<T> light{Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))};
    const Loop<T> fork{{T(-0.75), T(-1)}, {T(-0.5), T(-1)}, {T(-0.5), T(-0.75)}, {T(-0.75), T(-0.75)},
                       {T(-0.75), T(-1)}, {T(0.5), T(-1)},  {T(0.75), T(-1)},    {T(0.75), T(-0.5)},
                       {T(0.5), T(-0.5)}, {T(0.5), T(-1)},  {T(1), T(-1)},       {T(1), T(1)},
                       {T(1), T(-1)}};
    const RadialPart<T> left = part_of(fork, quadrant(light, 0)), right = part_of(fork, quadrant(light, 1));
    CHECK(left.rect.min == Vec2<T>(T(0.25), T(0)));
    CHECK(left.rect.max == Vec2<T>(T(0.5), T(0.25)));
    CHECK(right.rect.min == Vec2<T>(T(0.5), T(0)));
    CHECK(right.rect.max == Vec2<T>(T(0.75), T(0.5)));
    CHECK(same(part_of(fork, quadrant(light, 2)), empty_part<T>()));
    CHECK(same(part_of(fork, quadrant(light, 3)), empty_part<T>()));
}

TEST_CASE_TEMPLATE("edges that are cut to the columns of the light give the same part", T, float, double) {
    test::Random random(4);
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (int i = 0; i < 5000; ++i) {
        const Rect2<T> light = light_box<T>(), box = quadrant(light, random.whole(0, 3));
        const Loop<T> loop = random_convex<T>(random, 1.5, 1.5);
        RadialPartBuilder<T> whole(box), cut(box);
        for (std::size_t k = 0; k < loop.size(); ++k) {
            Vec2<T> a = loop[k], b = loop[(k + 1) % loop.size()];
            whole.add(a, b, 1);
            const bool swap = a.x > b.x;
            if (swap) std::swap(a, b);
            if (b.x < light.min.x || a.x > light.max.x) continue;
            const T slope = a.x < b.x ? (b.y - a.y) / (b.x - a.x) : T(0);
            const auto at = [&](T x) {  // a rounding off the column now and then
                return Vec2<T>(x * (T(1) + random.in(T(-1), T(1)) * epsilon), a.y + (x - a.x) * slope);
            };
            const Vec2<T> from = a.x < light.min.x ? at(light.min.x) : a, to = b.x > light.max.x ? at(light.max.x) : b;
            if (swap)
                cut.add(to, from, 1);
            else
                cut.add(from, to, 1);
        }
        const RadialPart<T> expected = whole.finish(), part = cut.finish();
        CAPTURE(i);
        CHECK(std::abs(part.area - expected.area) <= 128 * epsilon);
        if (expected.area < T(1e-4)) continue;
        // Where an edge leaves the rectangle upwards at a small angle, a rounding goes a long way.
        CHECK(std::abs(part.rect.min.x - expected.rect.min.x) <= T(1e4) * epsilon);
        CHECK(std::abs(part.rect.min.y - expected.rect.min.y) <= T(1e4) * epsilon);
        CHECK(std::abs(part.rect.max.x - expected.rect.max.x) <= T(1e4) * epsilon);
        CHECK(std::abs(part.rect.max.y - expected.rect.max.y) <= T(1e4) * epsilon);
    }
}

TEST_CASE_TEMPLATE("ends at 1e5 and 1e18 leave what is near", T, float, double) {
    const Rect2<T> box{Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))};
    for (const T far : {T(1e5), T(1e18)}) {
        // right and below of a line from (0.25, 0.25) straight up, and of one from there to the left
        const RadialPart<T> part = part_of<T>(
            {{T(0.25), T(0.25)}, {-far, T(0.25)}, {-far, -far}, {far, -far}, {far, far}, {T(0.25), far}}, box);
        CAPTURE(far);
        CHECK(part.area == doctest::Approx(1 - 0.75 * 0.25).epsilon(1e-5));
        CHECK(part.rect.min == Vec2<T>(T(0), T(0)));
        CHECK(part.rect.max == Vec2<T>(T(1), T(1)));
        // a wedge between two lines from one corner inside
        const RadialPart<T> wedge = part_of<T>({{T(0.5), T(0.5)}, {far, far / 2}, {far, far}}, box);
        CHECK(wedge.rect.min.x == T(0.5));
        CHECK(wedge.rect.max == Vec2<T>(T(1), T(1)));
        CHECK(wedge.area == doctest::Approx(0.0625).epsilon(1e-4));
    }
}

TEST_CASE_TEMPLATE("degenerate edges and boxes give nothing; clockwise loops neither", T, float, double) {
    const Rect2<T> box{Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))};
    const Loop<T> square{{T(0.25), T(0.25)}, {T(0.75), T(0.25)}, {T(0.75), T(0.75)}, {T(0.25), T(0.75)}};
    CHECK(same(RadialPartBuilder<T>(box).finish(), empty_part<T>()));
    CHECK(same(part_of(Loop<T>(square.rbegin(), square.rend()), box), empty_part<T>()));
    CHECK(same(part_of<T>({{T(0.5), T(0.5)}}, box), empty_part<T>()));                      // no length
    CHECK(same(part_of<T>({{T(0.25), T(0.5)}, {T(0.75), T(0.5)}}, box), empty_part<T>()));  // there and back
    for (const Vec2<T> size : {Vec2<T>(T(0), T(1)), Vec2<T>(T(1), T(0)), Vec2<T>(T(0), T(0))})
        CHECK(same(part_of(square, {Vec2<T>(T(0.5), T(0.5)), Vec2<T>(T(0.5), T(0.5)) + size}), empty_part<T>()));
    // loops around the part, clockwise and not, leave what the others wind
    RadialPartBuilder<T> builder(box);
    for (int k = 0; k < 4; ++k) {
        const Vec2<T> a = square[static_cast<std::size_t>(k)], b = square[static_cast<std::size_t>((k + 1) % 4)];
        const Vec2<T> middle(T(0.5), T(0.5));
        builder.add(middle + (a - middle) * T(8), middle + (b - middle) * T(8), 1);
        builder.add(a, b, -1);
    }
    const RadialPart<T> hole = builder.finish();
    CHECK(hole.area == doctest::Approx(0.75).epsilon(1e-6));
    CHECK(hole.rect.min == Vec2<T>(T(0), T(0)));
    CHECK(hole.rect.max == Vec2<T>(T(1), T(1)));
}

TEST_CASE_TEMPLATE("scaling everything by a power of two changes no bit", T, float, double) {
    test::Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const Rect2<T> box = quadrant(light_box<T>(), random.whole(0, 3));
        Loop<T> loop = random_convex<T>(random, 1.2, 1);
        const RadialPart<T> part = part_of(loop, box);
        const T scale = exp2_int<T>(random.whole(-20, 20));
        for (Vec2<T>& v : loop) v *= scale;
        CHECK(same(part_of(loop, {box.min * scale, box.max * scale}), part));
    }
}

TEST_CASE_TEMPLATE("valid_part makes a part of any finite numbers and leaves parts as they are", T, float, double) {
    test::Random random(6);
    int parts = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto number = [&] {
            const T special[] = {T(0),
                                 T(1),
                                 T(-1),
                                 std::numeric_limits<T>::min(),
                                 std::numeric_limits<T>::max(),
                                 -std::numeric_limits<T>::max(),
                                 T(1e-30),
                                 T(0.5)};
            return random.whole(0, 2) == 0 ? special[random.whole(0, 7)] : random.in(T(-0.5), T(1.5));
        };
        RadialPart<T> garbage;
        garbage.area = number() * random.in(T(0), T(1));
        for (Vec2<T>* v : {&garbage.moment, &garbage.rect.min, &garbage.rect.max}) v->x = number(), v->y = number();
        const RadialPart<T> part = valid_part(garbage);
        CAPTURE(i);
        check_invariants(part);
        CHECK(same(valid_part(part), part));
        parts += part.area > T(0);
    }
    CHECK(parts > 5000);
    CHECK(same(valid_part(full_part<T>()), full_part<T>()));
    CHECK(same(valid_part(empty_part<T>()), empty_part<T>()));
}
