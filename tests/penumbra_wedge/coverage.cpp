#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <limits>
#include <penumbra/penumbra_wedge/coverage.hpp>
#include <string>
#include <vector>

#include "../support/polygon_union.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int polygons = 200000;
#else
constexpr int polygons = 1100000;
#endif

template <class T>
using Loop = std::vector<Vec2<T>>;

template <class T>
double exact(T x) {
    return static_cast<double>(x);
}
template <class T>
Rect2<double> exact(const Rect2<T>& box) {
    return {glm::dvec2(box.min), glm::dvec2(box.max)};
}

/// The largest of many errors, and what it came of.
struct Worst {
    double error = 0;
    std::string at = "-";

    template <class T>
    void add(double e, const Loop<T>& loop, const Rect2<T>& box) {
        if (e <= error) return;
        error = e;
        at = "box";
        for (const Vec2<T>& v : {box.min, box.max}) tell(v);
        at += " loop";
        for (const Vec2<T>& v : loop) tell(v);
    }

  private:
    template <class T>
    void tell(const Vec2<T>& v) {
        char text[64];
        std::snprintf(text, sizeof text, " (%a, %a)", exact(v.x), exact(v.y));
        at += text;
    }
};

#define CHECK_WORST(worst, allowed)                                               \
    do {                                                                          \
        INFO("worst " << worst.error << " of " << allowed << " at " << worst.at); \
        CHECK(worst.error <= allowed);                                            \
    } while (false)

/// What one loop may be off by, in units of the box: the figures.
template <class T>
constexpr double loop_tolerance = sizeof(T) == 4 ? 5e-7 : 1e-14;
template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

template <class T>
T sum_of_edges(const Loop<T>& loop, const Rect2<T>& box) {
    return loop_coverage(loop.data(), loop.size(), box);
}

/// The light as a square and as a slat, a quadrant, and a box anywhere.
template <class T>
std::vector<Rect2<T>> boxes() {
    return {{Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))},
            {Vec2<T>(T(-4), T(-0.25)), Vec2<T>(T(4), T(0.25))},
            {Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))},
            {Vec2<T>(T(-0.7), T(0.1)), Vec2<T>(T(0.3), T(1.9))}};
}

/// Loops in units of the box, whose sides are ±1; most coordinates up to 3.
template <class T>
class Loops {
  public:
    static constexpr int kinds = 12, twice_around = 6, far_end = 8;
    static constexpr std::array<const char*, kinds> names{
        {"random", "edge near the centre", "edge through a corner", "edge along a border", "ends outside", "needle",
         "twice around", "on a grid", "one end at 1e5 or 1e18", "coincident vertices", "tiny", "thin along a border"}};

    explicit Loops(std::uint32_t seed) : random_(seed) {}

    Loop<T> next(int kind) {
        Loop<T> loop;
        const int count = random_.whole(3, 6);
        for (int i = 0; i < count; ++i) loop.push_back(anywhere());
        switch (kind) {
            case 1: {  // within 0, 1e-8 … 1e-3 of the light's centre
                const int exponent = random_.whole(-9, -3);
                line(loop, Vec2<T>(T(0), T(0)), exponent == -9 ? T(0) : sign() * std::pow(T(10), T(exponent)));
                break;
            }
            case 2: {
                const Vec2<T> corner(sign(), sign());
                line(loop, corner, T(0));
                if (random_.whole(0, 1) == 0) loop[2] = corner;
                break;
            }
            case 3: {
                const T border = sign();
                const bool upright = random_.whole(0, 1) == 0;
                for (std::size_t i = 0; i < 2; ++i) (upright ? loop[i].x : loop[i].y) = border;
                break;
            }
            case 4:
                for (Vec2<T>& v : loop) (random_.whole(0, 1) == 0 ? v.x : v.y) = sign() * random_.in(T(1), T(3));
                break;
            case 5: {
                const T width = std::exp2(random_.in(T(-30), T(-3)));
                for (std::size_t i = 2; i < loop.size(); ++i) {
                    const T t = random_.in(T(0), T(1));
                    loop[i] = loop[1] + (loop[0] - loop[1]) * t + Vec2<T>(width * t, -width);
                }
                break;
            }
            case twice_around:
                for (std::size_t i = 0, n = loop.size(); i < n; ++i) loop.push_back(loop[i]);
                break;
            case 7:
                for (Vec2<T>& v : loop) v = glm::floor(v * T(2)) / T(2);
                break;
            case far_end:
                loop[0] = loop[0] * (random_.whole(0, 1) == 0 ? T(3e4) : T(3e17));
                break;
            case 9:
                for (std::size_t i = 1; i < loop.size(); ++i)
                    if (random_.whole(0, 1) == 0) loop[i] = loop[i - 1];
                break;
            case 10: {
                const T size = std::exp2(random_.in(T(-30), T(-3)));
                for (Vec2<T>& v : loop) v = loop[0] + v * size;
                break;
            }
            case 11:
                for (Vec2<T>& v : loop) v.y = T(1) - v.y * std::exp2(random_.in(T(-30), T(-3)));
                break;
            default:
                break;
        }
        return loop;
    }
    T sign() { return random_.whole(0, 1) == 0 ? T(-1) : T(1); }

  private:
    Vec2<T> anywhere() {
        const T x = random_.in(T(-3), T(3)), y = random_.in(T(-3), T(3));
        return Vec2<T>(x, y);
    }
    /// Puts the first two vertices on a line that passes `point` at a distance.
    void line(Loop<T>& loop, const Vec2<T>& point, T distance) {
        const T turn = random_.in(T(0), T(6.2831853));
        const Vec2<T> along(std::cos(turn), std::sin(turn)), at = point + Vec2<T>(-along.y, along.x) * distance;
        loop[0] = at - along * random_.in(T(0), T(2));
        loop[1] = at + along * random_.in(T(0), T(2));
    }

    test::Random random_;
};

template <class T>
Loop<T> in_box(Loop<T> loop, const Rect2<T>& box) {
    const Vec2<T> middle = (box.min + box.max) * T(0.5), half = (box.max - box.min) * T(0.5);
    for (Vec2<T>& v : loop) v = middle + half * v;
    return loop;
}

/// The same instructions at each call: with -ffast-math, inlined copies may round differently.
template <class T>
T one_edge(const Vec2<T>& a, const Vec2<T>& b, const Rect2<T>& box) {
    T (*const volatile call)(const Vec2<T>&, const Vec2<T>&, const Rect2<T>&) = &edge_coverage<T>;
    return call(a, b, box);
}
template <class T>
CoverageMoments<T> one_edge_moments(const Vec2<T>& a, const Vec2<T>& b, const Rect2<T>& box) {
    CoverageMoments<T> (*const volatile call)(const Vec2<T>&, const Vec2<T>&, const Rect2<T>&) = &edge_moments<T>;
    return call(a, b, box);
}

template <class T>
bool same_but_sign(T a, T b) {
    const T negated = -b;
    return (a == T(0) && b == T(0)) || std::memcmp(&a, &negated, sizeof a) == 0;
}

}  // namespace

TEST_CASE("the exact areas agree with each other") {
    test::Random random(1);
    const Rect2<double> box{{-1, -1}, {1, 1}};
    const test::Polygon2 square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 2000; ++i) {  // anywhere
        std::vector<test::Polygon2> shapes, convex;
        for (int k = random.whole(1, 6); k > 0; --k) {
            const int count = random.whole(3, 7);
            const double x = random.in(-1.5, 1.5), y = random.in(-1.5, 1.5), radius = random.in(0.1, 1.5);
            test::Polygon2 polygon;
            for (int j = 0; j < count; ++j) {
                const double turn = 2 * pi<double> * (j + 0.1 * k) / count;
                polygon.push_back({x + radius * std::cos(turn), y + radius * std::sin(turn)});
            }
            const test::Polygon2 cut = test::intersection(polygon, square);
            CHECK(std::abs(test::winding_area(polygon, box) - test::area(cut)) <= 1e-14);
            if (cut.size() >= 3) convex.push_back(cut);
            if (k % 2 == 0) std::reverse(polygon.begin(), polygon.end());
            shapes.push_back(polygon);
        }
        const double truth = test::union_measure(convex, [](const test::Polygon2& p) { return test::area(p); });
        CHECK(std::abs(test::union_area(shapes, box) - truth) <= 2e-14);
    }
    for (int i = 0; i < 500; ++i) {  // squares on their corners, on a grid: sides coincide, corners lie on sides
        std::vector<test::Polygon2> shapes;
        std::vector<glm::dvec3> diamonds;
        for (int k = random.whole(1, 8); k > 0; --k) {
            const double x = random.whole(-4, 4) * 0.5, y = random.whole(-4, 4) * 0.5, r = random.whole(1, 3) * 0.5;
            diamonds.emplace_back(x, y, r);
            shapes.push_back({{x + r, y}, {x, y + r}, {x - r, y}, {x, y - r}});
        }
        int inside = 0;  // of 4 × 4 cells, each of four triangles with one answer for all points inside
        for (int k = 0; k < 64; ++k) {
            const glm::dvec2 middle(-0.75 + 0.5 * (k % 4), -0.75 + 0.5 * (k / 4 % 4));
            const glm::dvec2 aside[] = {{0.1, 0}, {-0.1, 0}, {0, 0.1}, {0, -0.1}};
            const glm::dvec2 p = middle + aside[k / 16];
            inside += std::any_of(diamonds.begin(), diamonds.end(),
                                  [&](const glm::dvec3& d) { return std::abs(p.x - d.x) + std::abs(p.y - d.y) < d.z; });
        }
        CHECK(std::abs(test::union_area(shapes, box) - inside / 16.0) <= 1e-14);
    }
    // a triangle's moments; shapes that are not convex, that cross themselves, that have a hole
    const auto m = test::winding_moments(test::Polygon2{{-1, -1}, {0.5, -1}, {-1, -0.25}}, box);
    CHECK(exact(m.area) == doctest::Approx(0.5625));
    CHECK(exact(m.x) == doctest::Approx(0.5625 * 0.5));
    CHECK(exact(m.y) == doctest::Approx(0.5625 * 0.25));
    const test::Polygon2 arrow{{-0.5, 0}, {0.5, -0.5}, {0, 0}, {0.5, 0.5}}, bow{{-2, -1}, {2, 1}, {2, -1}, {-2, 1}};
    const test::Polygon2 hole{{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}};
    CHECK(test::union_area({arrow}, box) == doctest::Approx(0.25));
    CHECK(test::winding_area(bow, box) == doctest::Approx(0.0));
    CHECK(test::union_area({bow}, box) == doctest::Approx(1.0));
    CHECK(test::union_area_of_shapes({{square, hole}}, box) == doctest::Approx(3.0));
    CHECK(test::union_area_of_shapes({{square}, {hole}}, box) == doctest::Approx(4.0));
}

TEST_CASE_TEMPLATE("the sum over a loop is its area inside the box", T, float, double) {
    Loops<T> loops(1);
    for (const Rect2<T>& box : boxes<T>())
        for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
            CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
            Worst worst;
            for (int i = 0; i < polygons / (4 * Loops<T>::kinds); ++i) {
                const Loop<T> loop = in_box(loops.next(kind), box);
                const double truth = test::winding_area(loop, exact(box)) / exact(area(box));
                worst.add(std::abs(exact(sum_of_edges(loop, box)) - truth), loop, box);
            }
            CHECK_WORST(worst, loop_tolerance<T> * (kind == Loops<T>::twice_around ? 2 : 1));
        }
}

TEST_CASE_TEMPLATE("an edge has the area of the box below it", T, float, double) {
    Loops<T> loops(10);
    for (const Rect2<T>& box : boxes<T>())
        for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
            CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
            Worst worst;
            for (int i = 0; i < polygons / (40 * Loops<T>::kinds); ++i) {
                const Loop<T> loop = in_box(loops.next(kind), box);
                const Vec2<T> a = loop[0], b = loop[1];
                const Loop<T> below{a, b, Vec2<T>(b.x, box.min.y), Vec2<T>(a.x, box.min.y)};
                const double truth = test::winding_area(below, exact(box));
                worst.add(std::abs(exact(edge_coverage(a, b, box)) - truth) / exact(area(box)), below, box);
            }
            CHECK_WORST(worst, 1.5 * epsilon<T>);
        }
}

TEST_CASE_TEMPLATE("ends that are far in both directions cost what they are rounded to", T, float, double) {
    // the exact area needs twice the digits of 1e18
    Loops<T> loops(2);
    const Rect2<T> box = boxes<T>()[0];
    for (const T far : {T(1e5), T(1e18)}) {
        Worst worst;
        for (int i = 0; i < polygons / 100; ++i) {
            Loop<T> loop = loops.next(1);  // the first edge runs through the centre
            for (std::size_t k = 0; k < 2; ++k) loop[k] = loop[k] * (far / T(3));
            const double truth = exact(test::winding_moments<test::Quad>(loop, exact(box)).area) / exact(area(box));
            const T got = sum_of_edges(loop, box);
            CHECK(std::abs(got) <= T(2.00001));
            // the line between them may lie ε of their distance aside
            if (far < T(1e6)) worst.add(std::abs(exact(got) - truth), loop, box);
        }
        CHECK_WORST(worst, epsilon<T> * exact(far));
        // along an axis there is nothing to round
        for (int i = 0; i < polygons / 100; ++i) {
            Loop<T> loop = loops.next(0);
            loop[0].x = -far, loop[1].x = far * T(0.7);
            const double truth = exact(test::winding_moments<test::Quad>(loop, exact(box)).area) / exact(area(box));
            worst.add(std::abs(exact(sum_of_edges(loop, box)) - truth) / loop_tolerance<T>, loop, box);
        }
    }
}

TEST_CASE_TEMPLATE("where a loop starts and the order of its edges change nothing beyond rounding", T, float, double) {
    Loops<T> loops(3);
    test::Random random(3);
    const Rect2<T> box = boxes<T>()[0];
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (int i = 0; i < polygons / 200; ++i) {
            Loop<T> loop = loops.next(kind);
            const double once = exact(sum_of_edges(loop, box));
            std::vector<std::size_t> order;
            for (std::size_t k = 0; k < loop.size(); ++k) order.push_back(k);
            for (std::size_t k = 0; k < loop.size(); ++k)
                std::swap(order[k], order[static_cast<std::size_t>(random.whole(0, static_cast<int>(k)))]);
            T sum = T(0);
            for (const std::size_t k : order) sum += edge_coverage(loop[k], loop[(k + 1) % loop.size()], box);
            worst.add(std::abs(exact(sum / area(box)) - once), loop, box);
            std::rotate(loop.begin(), loop.begin() + random.whole(1, 2), loop.end());
            worst.add(std::abs(exact(sum_of_edges(loop, box)) - once), loop, box);
        }
        // sums of up to 12 terms of up to one box, in another order: up to 6 roundings apart on each side
        CHECK_WORST(worst, 6 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("splitting an edge changes nothing beyond rounding", T, float, double) {
    Loops<T> loops(4);
    test::Random random(4);
    const Rect2<T> box = boxes<T>()[0];
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        if (kind == Loops<T>::far_end) continue;  // the point of the split is rounded to 1e5 ε
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (int i = 0; i < polygons / 200; ++i) {
            const Loop<T> loop = loops.next(kind);
            const Vec2<T> a = loop[0], b = loop[1];
            const T t = random.whole(0, 3) == 0 ? T(0.5) : random.in(T(0), T(1));
            const Vec2<T> middle(mix(a.x, b.x, t), mix(a.y, b.y, t));
            const T whole = edge_coverage(a, b, box);
            const T parts = edge_coverage(a, middle, box) + edge_coverage(middle, b, box);
            worst.add(std::abs(exact(parts) - exact(whole)) / exact(area(box)), loop, box);
        }
        // three times up to 1.5 ε, and a middle that lies beside the edge
        CHECK_WORST(worst, 3 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("reversing an edge changes the sign of the result and no bit else", T, float, double) {
    using Limits = std::numeric_limits<T>;
    std::vector<T> specials;
    for (const T x : {T(0), Limits::denorm_min(), Limits::min(), Limits::epsilon(), T(1e-8), T(1) / T(3), T(1),
                      T(1) + Limits::epsilon(), T(1) - Limits::epsilon() / T(2), T(2), T(3), T(1e5), T(1e18)})
        for (const T sign : {T(1), T(-1)}) specials.push_back(sign * x);
    const std::size_t domain = specials.size();
#ifndef __FAST_MATH__  // which has no such numbers
    for (const T x : {Limits::max(), Limits::infinity()})
        for (const T sign : {T(1), T(-1)}) specials.push_back(sign * x);
#endif
    const Rect2<T> box = boxes<T>()[0];
    int wrong = 0, outside = 0;
    const auto check = [&](const Vec2<T>& a, const Vec2<T>& b, bool in_domain) {
        const T one = one_edge(a, b, box), other = one_edge(b, a, box);
        const bool good = is_finite(one) && std::abs(one) <= T(4) * (T(1) + Limits::epsilon());
        if (in_domain && !good) ++outside;
        if (is_finite(one) ? !same_but_sign(one, other) : is_finite(other)) ++wrong;
        const CoverageMoments<T> m = one_edge_moments(a, b, box), n = one_edge_moments(b, a, box);
        if (is_finite(m.area) && !(same_but_sign(m.area, n.area) && same_but_sign(m.x, n.x) && same_but_sign(m.y, n.y)))
            ++wrong;
        if (in_domain && !(is_finite(m.area) && is_finite(m.x) && is_finite(m.y))) ++outside;
    };
    const std::size_t n = specials.size();
    for (std::size_t i = 0; i < n * n * n * n; ++i) {
        const std::size_t k[4] = {i % n, i / n % n, i / n / n % n, i / n / n / n};
        check(Vec2<T>(specials[k[0]], specials[k[1]]), Vec2<T>(specials[k[2]], specials[k[3]]),
              std::max(std::max(k[0], k[1]), std::max(k[2], k[3])) < domain);
    }
    Loops<T> loops(5);
    for (int i = 0; i < polygons / 10; ++i) {
        const Loop<T> loop = loops.next(i % Loops<T>::kinds);
        check(loop[0], loop[1], true);
    }
    CHECK(wrong == 0);
    CHECK(outside == 0);
}

TEST_CASE_TEMPLATE("scaling by a power of two is exact", T, float, double) {
    Loops<T> loops(6);
    for (const int exponent : {-30, -7, 1, 20}) {
        const T scale = std::ldexp(T(1), exponent), square = scale * scale;
        int wrong = 0;
        for (int i = 0; i < polygons / 50; ++i) {
            const Rect2<T> box = boxes<T>()[static_cast<std::size_t>(i) % 4], large{box.min * scale, box.max * scale};
            const Loop<T> loop = in_box(loops.next(i % Loops<T>::kinds), box);
            const Vec2<T> a = loop[0], b = loop[1];
            wrong += one_edge(a * scale, b * scale, large) != one_edge(a, b, box) * square;
            const CoverageMoments<T> m = one_edge_moments(a, b, box), n = one_edge_moments(a * scale, b * scale, large);
            wrong += n.area != m.area * square || n.x != m.x * square * scale || n.y != m.y * square * scale;
        }
        CAPTURE(exponent);
        CHECK(wrong == 0);
    }
}

TEST_CASE_TEMPLATE("quadrants and cells add up to the whole", T, float, double) {
    Loops<T> loops(7);
    for (const int cells : {2, 8})
        for (const Rect2<T>& box : boxes<T>()) {
            Worst worst;
            for (int i = 0; i < polygons / 1000; ++i) {
                const Loop<T> loop = in_box(loops.next(i % Loops<T>::kinds), box);
                const auto border = [&](int x, int y) {
                    const T n = static_cast<T>(cells);
                    return Vec2<T>(mix(box.min.x, box.max.x, static_cast<T>(x) / n),
                                   mix(box.min.y, box.max.y, static_cast<T>(y) / n));
                };
                double sum = 0;
                for (int y = 0; y < cells; ++y)
                    for (int x = 0; x < cells; ++x) {
                        const Rect2<T> cell{border(x, y), border(x + 1, y + 1)};
                        sum += exact(sum_of_edges(loop, cell)) * exact(area(cell)) / exact(area(box));
                    }
                worst.add(std::abs(sum - exact(sum_of_edges(loop, box))), loop, box);
            }
            CHECK_WORST(worst, loop_tolerance<T>);
        }
}

TEST_CASE_TEMPLATE("moments are those of what is inside", T, float, double) {
    Loops<T> loops(8);
    for (const Rect2<T>& box : boxes<T>())
        for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
            CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
            const double whole = exact(area(box)), width = exact(extent(box).x), height = exact(extent(box).y);
            Worst worst;
            for (int i = 0; i < polygons / (40 * Loops<T>::kinds); ++i) {
                const Loop<T> loop = in_box(loops.next(kind), box);
                CoverageMoments<T> sum{T(0), T(0), T(0)};
                for (std::size_t k = 0; k < loop.size(); ++k) {
                    const Vec2<T> a = loop[k], b = loop[(k + 1) % loop.size()];
                    const CoverageMoments<T> m = edge_moments(a, b, box);
                    worst.add(std::abs(exact(m.area) - exact(edge_coverage(a, b, box))) / whole, {a, b}, box);
                    sum = sum + m;
                }
                const auto truth = test::winding_moments(loop, exact(box));
                worst.add(std::abs(exact(sum.area) - exact(truth.area)) / whole, loop, box);
                worst.add(std::abs(exact(sum.x) - exact(truth.x)) / (whole * width), loop, box);
                worst.add(std::abs(exact(sum.y) - exact(truth.y)) / (whole * height), loop, box);
            }
            CHECK_WORST(worst, loop_tolerance<T> * (kind == Loops<T>::twice_around ? 2 : 1));
        }
}

TEST_CASE_TEMPLATE("what covers the box is 1, what lies beside it is 0, to the last bit", T, float, double) {
    for (const Rect2<T>& box : boxes<T>())
        for (const T grow : {T(1), T(1.5), T(1e5), T(1e17)}) {
            const Loop<T> square{Vec2<T>(-grow, -grow), Vec2<T>(grow, -grow), Vec2<T>(grow, grow),
                                 Vec2<T>(-grow, grow)};
            CHECK(sum_of_edges(in_box(square, box), box) == T(1));
            const Loop<T> back(square.rbegin(), square.rend());
            CHECK(sum_of_edges(in_box(back, box), box) == T(-1));
            Loop<T> below, beside;
            for (const Vec2<T>& v : square) {
                below.push_back(v * T(0.9) - Vec2<T>(T(0), T(2) * grow));
                beside.push_back(v * T(0.9) + Vec2<T>(T(2) * grow, T(0)));
            }
            CHECK(sum_of_edges(in_box(below, box), box) == T(0));
            CHECK(sum_of_edges(in_box(beside, box), box) == T(0));
        }
}

TEST_CASE_TEMPLATE("two halves that touch hide what the whole hides, wherever the seam", T, float, double) {
    Loops<T> loops(9);
    const Rect2<T> box = boxes<T>()[0];
    Worst worst;
    for (int i = 0; i < polygons / 50; ++i) {
        const Loop<T> loop = loops.next(i % 8);
        const std::size_t cut = 2;
        const Loop<T> one(loop.begin(), loop.begin() + cut + 1);
        Loop<T> other(loop.begin() + cut, loop.end());
        other.push_back(loop[0]);
        const double sum = exact(sum_of_edges(one, box)) + exact(sum_of_edges(other, box));
        worst.add(std::abs(sum - exact(sum_of_edges(loop, box))), loop, box);
    }
    CHECK_WORST(worst, loop_tolerance<T>);
}

TEST_CASE_TEMPLATE("edges and boxes without size hide nothing", T, float, double) {
    const Rect2<T> box = boxes<T>()[0], line{Vec2<T>(T(-1), T(0)), Vec2<T>(T(1), T(0))},
                   upright{Vec2<T>(T(0), T(-1)), Vec2<T>(T(0), T(1))}, point{Vec2<T>(T(0), T(0)), Vec2<T>(T(0), T(0))};
    const Loop<T> loop{Vec2<T>(T(-2), T(-2)), Vec2<T>(T(2), T(-1)), Vec2<T>(T(1), T(2))};
    for (const Rect2<T>& flat : {line, upright, point}) {
        CHECK(sum_of_edges(loop, flat) == T(0));
        for (std::size_t k = 0; k < 3; ++k) {
            const CoverageMoments<T> m = edge_moments(loop[k], loop[(k + 1) % 3], flat);
            CHECK(m.area == T(0));
            CHECK(m.x == T(0));
            CHECK(m.y == T(0));
        }
    }
    CHECK(edge_coverage(Vec2<T>(T(0.5), T(0.5)), Vec2<T>(T(0.5), T(0.5)), box) == T(0));  // no length
    CHECK(edge_coverage(Vec2<T>(T(0.5), T(-3)), Vec2<T>(T(0.5), T(3)), box) == T(0));     // upright
    CHECK(edge_coverage(Vec2<T>(T(-3), T(-1)), Vec2<T>(T(3), T(-1)), box) == T(0));       // along the lower border
    CHECK(edge_coverage(Vec2<T>(T(3), T(1)), Vec2<T>(T(-3), T(1)), box) == T(4));         // along the upper one
    CHECK(edge_coverage(Vec2<T>(T(1), T(0)), Vec2<T>(T(-1), T(0)), box) == T(2));         // through the centre
    CHECK(loop_coverage(loop.data(), 0, box) == T(0));
    CHECK(loop_coverage(loop.data(), 1, box) == T(0));
    CHECK(std::abs(loop_coverage(loop.data(), 2, box)) == T(0));
}
