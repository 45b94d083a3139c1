#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <penumbra/umbra_volume/disk_coverage.hpp>
#include <string>
#include <vector>

#include "../support/polygon_area.hpp"
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

/// The largest of many errors, and what it came of.
struct Worst {
    double error = 0;
    std::string at = "-";

    template <class T>
    void add(double e, const Loop<T>& loop) {
        if (e <= error) return;
        error = e;
        at.clear();
        for (const Vec2<T>& v : loop) {
            char text[64];
            std::snprintf(text, sizeof text, " (%a, %a)", exact(v.x), exact(v.y));
            at += text;
        }
    }
};

#define CHECK_WORST(worst, allowed)                                              \
    do {                                                                         \
        INFO("worst " << worst.error << " of " << allowed << " at" << worst.at); \
        CHECK(worst.error <= allowed);                                           \
    } while (false)

/// What one loop may be off by, in units of the disk.
template <class T>
constexpr double loop_tolerance = sizeof(T) == 4 ? 5e-7 : 1e-14;
template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

/// The area of a loop inside the disk around the origin: triangles from there, cut by sectors. In long double; each
/// from the nearer end, so that ends at 1e18 keep their digits.
template <class T>
long double truth_of(const Loop<T>& loop, T radius) {
    using Real = long double;
    struct Point {
        Real x, y;
    };
    const auto cross = [](Point a, Point b) { return a.x * b.y - a.y * b.x; };
    const auto dot = [](Point a, Point b) { return a.x * b.x + a.y * b.y; };
    const Real r = static_cast<Real>(radius);
    Real sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2<T> from = loop[i], to = loop[(i + 1) % loop.size()];
        Point a{static_cast<Real>(from.x), static_cast<Real>(from.y)};
        Point b{static_cast<Real>(to.x), static_cast<Real>(to.y)};
        const bool forward = dot(a, a) <= dot(b, b);
        if (!forward) std::swap(a, b);
        const auto sector = [&](Point p, Point q) { return r * r * std::atan2(cross(p, q), dot(p, q)) / 2; };
        const Point d{b.x - a.x, b.y - a.y};
        const Real dd = dot(d, d), ad = dot(a, d), inside = r * r * dd - cross(a, d) * cross(a, d);
        Real area = 0;
        if (dd > 0 && inside > 0) {
            const Real low = (-ad - std::sqrt(inside)) / dd, high = (-ad + std::sqrt(inside)) / dd;
            if (high > 0 && low < 1) {
                const Point enter = low > 0 ? Point{a.x + low * d.x, a.y + low * d.y} : a;
                const Point leave = high < 1 ? Point{a.x + high * d.x, a.y + high * d.y} : b;
                area = (low > 0 ? sector(a, enter) : 0) + cross(enter, leave) / 2 + (high < 1 ? sector(leave, b) : 0);
            } else {
                area = sector(a, b);
            }
        } else {
            area = sector(a, b);
        }
        sum += forward ? area : -area;
    }
    return sum;
}

template <class T>
T sum_of_edges(const Loop<T>& loop, T radius) {
    T sum = T(0);
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += disk_edge_coverage(loop[i], loop[(i + 1) % loop.size()], radius);
    return sum;
}
template <class T>
double disk_area(T radius) {
    return std::acos(-1.0) * exact(radius) * exact(radius);
}
template <class T>
double error_of(const Loop<T>& loop, T radius) {
    return std::abs(
               static_cast<double>(static_cast<long double>(sum_of_edges(loop, radius)) - truth_of(loop, radius))) /
           disk_area(radius);
}

/// Loops in units of the radius; most coordinates up to 3.
template <class T>
class Loops {
  public:
    static constexpr int kinds = 15, twice_around = 6, far_end = 8;
    static constexpr std::array<const char*, kinds> names{
        {"random", "edge near the centre", "edge near the rim", "edge along the disk's box", "ends outside", "needle",
         "twice around", "on a grid", "one end at 1e5 or 1e18", "coincident vertices", "tiny", "thin along a tangent",
         "vertices on the rim", "tiny at the rim", "upright edges"}};

    explicit Loops(std::uint32_t seed) : random_(seed) {}

    Loop<T> next(int kind) {
        Loop<T> loop;
        const int count = random_.whole(3, 6);
        for (int i = 0; i < count; ++i) loop.push_back(anywhere());
        switch (kind) {
            case 1:
                line(loop, little());
                break;
            case 2:
                line(loop, T(1) + little());
                break;
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
            case 11: {  // all within a band along a tangent
                const Vec2<T> along = direction(), out(along.y, -along.x);
                const T width = std::exp2(random_.in(T(-30), T(-3)));
                for (Vec2<T>& v : loop) v = along * v.x + out * (T(1) + v.y * width);
                break;
            }
            case 12:
                for (Vec2<T>& v : loop) v = direction() * (random_.whole(0, 2) == 0 ? T(1) + little() : T(1));
                break;
            case 13: {
                const T size = std::exp2(random_.in(T(-24), T(-3)));
                const Vec2<T> at = direction();
                for (Vec2<T>& v : loop) v = at + v * size;
                break;
            }
            case 14:
                for (std::size_t i = 1; i < loop.size(); i += 2) loop[i].x = loop[i - 1].x + (i == 3 ? little() : T(0));
                break;
            default:
                break;
        }
        return loop;
    }
    T sign() { return random_.whole(0, 1) == 0 ? T(-1) : T(1); }
    Vec2<T> direction() {
        const T turn = random_.in(T(0), T(6.2831853));
        return Vec2<T>(std::cos(turn), std::sin(turn));
    }
    /// 0, ±1e-8 … ±1e-3.
    T little() {
        const int exponent = random_.whole(-9, -3);
        return exponent == -9 ? T(0) : sign() * std::pow(T(10), T(exponent));
    }

  private:
    Vec2<T> anywhere() {
        const T x = random_.in(T(-3), T(3)), y = random_.in(T(-3), T(3));
        return Vec2<T>(x, y);
    }
    /// Puts the first two vertices on a line that passes the centre at a distance.
    void line(Loop<T>& loop, T distance) {
        const Vec2<T> along = direction(), at = Vec2<T>(-along.y, along.x) * distance;
        loop[0] = at - along * random_.in(T(0), T(2));
        loop[1] = at + along * random_.in(T(0), T(2));
    }

    test::Random random_;
};

template <class T>
std::vector<T> radii() {
    return {T(1), T(0.7), T(1.9999), T(350)};
}
template <class T>
Loop<T> scaled(Loop<T> loop, T factor) {
    for (Vec2<T>& v : loop) v = v * factor;
    return loop;
}

/// The same instructions at each call: with -ffast-math, inlined copies may round differently.
template <class T>
T one_edge(const Vec2<T>& a, const Vec2<T>& b, T radius) {
    T (*const volatile call)(const Vec2<T>&, const Vec2<T>&, T) = &disk_edge_coverage<T>;
    return call(a, b, radius);
}

/// The same bits; where compilers fuse products and sums as they please, the same to rounding, in units of the disk.
template <class T>
bool same(T a, T b, T radius) {
#if defined(__FAST_MATH__) || defined(__FP_FAST_FMA)
    return std::abs(exact(a) - exact(b)) <= 2 * epsilon<T> * disk_area(radius);
#else
    static_cast<void>(radius);
    return a == b;
#endif
}
template <class T>
bool same_but_sign(T a, T b) {
    const T negated = -b;
    return (a == T(0) && b == T(0)) || std::memcmp(&a, &negated, sizeof a) == 0;
}

}  // namespace

TEST_CASE("the exact areas agree with each other") {
    Loops<double> loops(1);
    for (int i = 0; i < 30000; ++i) {
        const int kind = i % Loops<double>::kinds;
        if (kind == Loops<double>::far_end) continue;  // which the other cuts without care
        const Loop<double> loop = loops.next(kind);
        for (const double radius : radii<double>())
            CHECK(std::abs(static_cast<double>(truth_of(loop, radius)) - test::area_in_circle(loop, radius)) <=
                  4e-15 * static_cast<double>(loop.size()) * std::max(1.0, radius * radius));
    }
}

TEST_CASE_TEMPLATE("the sum over a loop is its area inside the disk", T, float, double) {
    Loops<T> loops(1);
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (const T radius : radii<T>())
            for (int i = 0; i < polygons / (4 * Loops<T>::kinds); ++i) {
                const Loop<T> loop = scaled(loops.next(kind), radius);
                worst.add(error_of(loop, radius), loop);
            }
        CHECK_WORST(worst, loop_tolerance<T> * (kind == Loops<T>::twice_around ? 2 : 1));
    }
}

TEST_CASE_TEMPLATE("an edge has the area of the disk below it", T, float, double) {
    Loops<T> loops(10);
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (const T radius : radii<T>())
            for (int i = 0; i < polygons / (20 * Loops<T>::kinds); ++i) {
                const Loop<T> loop = scaled(loops.next(kind), radius);
                const T floor = T(-4) * radius + std::min(T(0), std::min(loop[0].y, loop[1].y));
                const Loop<T> below{loop[0], loop[1], Vec2<T>(loop[1].x, floor), Vec2<T>(loop[0].x, floor)};
                const double got = exact(disk_edge_coverage(loop[0], loop[1], radius));
                worst.add(std::abs(got - static_cast<double>(truth_of(below, radius))) / disk_area(radius), below);
            }
        CHECK_WORST(worst, 2.2 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("ends that are far in both directions cost what they are rounded to", T, float, double) {
    Loops<T> loops(2);
    for (const T far : {T(1e5), T(1e18)}) {
        Worst worst;
        for (int i = 0; i < polygons / 100; ++i) {
            Loop<T> loop = loops.next(1);  // the first edge runs through the centre
            for (std::size_t k = 0; k < 2; ++k) loop[k] = loop[k] * (far / T(3));
            CHECK(std::abs(sum_of_edges(loop, T(1))) <= T(2.00001) * pi<T>);
            // the line between them may lie ε of their distance aside
            if (far < T(1e6)) worst.add(error_of(loop, T(1)), loop);
        }
        CHECK_WORST(worst, epsilon<T> * exact(far));
        // along an axis there is little to round
        Worst along;
        for (int i = 0; i < polygons / 100; ++i) {
            const Loop<T> near = loops.next(0);
            const Vec2<T> a(-far, near[0].y), b(far, near[0].y + (i % 2 == 0 ? T(0) : near[1].y));
            const double height = std::clamp(0.5 * (exact(a.y) + exact(b.y)), -1.0, 1.0);  // at 1e18
            const double flat = -std::acos(-height) - height * std::sqrt(1.0 - height * height);
            const Loop<T> below{a, b, Vec2<T>(far, T(-10)), Vec2<T>(-far, T(-10))};
            const double truth = far < T(1e6) ? static_cast<double>(truth_of(below, T(1))) : flat;
            along.add(std::abs(exact(disk_edge_coverage(a, b, T(1))) - truth) / disk_area(1.0), below);
        }
        CHECK_WORST(along, 4 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("where a loop starts and the order of its edges change nothing beyond rounding", T, float, double) {
    Loops<T> loops(3);
    test::Random random(3);
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (int i = 0; i < polygons / 200; ++i) {
            Loop<T> loop = loops.next(kind);
            const double once = exact(sum_of_edges(loop, T(1)));
            std::vector<std::size_t> order;
            for (std::size_t k = 0; k < loop.size(); ++k) order.push_back(k);
            for (std::size_t k = 0; k < loop.size(); ++k)
                std::swap(order[k], order[static_cast<std::size_t>(random.whole(0, static_cast<int>(k)))]);
            T sum = T(0);
            for (const std::size_t k : order) sum += disk_edge_coverage(loop[k], loop[(k + 1) % loop.size()], T(1));
            worst.add(std::abs(exact(sum) - once) / disk_area(1.0), loop);
            std::rotate(loop.begin(), loop.begin() + random.whole(1, 2), loop.end());
            worst.add(std::abs(exact(sum_of_edges(loop, T(1))) - once) / disk_area(1.0), loop);
        }
        // sums of up to 12 terms of up to one disk, in another order: up to 6 roundings apart on each side
        CHECK_WORST(worst, 6 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("splitting an edge changes nothing beyond rounding", T, float, double) {
    Loops<T> loops(4);
    test::Random random(4);
    for (int kind = 0; kind < Loops<T>::kinds; ++kind) {
        if (kind == Loops<T>::far_end) continue;  // the point of the split is rounded to 1e5 ε
        CAPTURE(Loops<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst;
        for (int i = 0; i < polygons / 200; ++i) {
            const Loop<T> loop = loops.next(kind);
            const Vec2<T> a = loop[0], b = loop[1];
            const T t = random.whole(0, 3) == 0 ? T(0.5) : random.in(T(0), T(1));
            const Vec2<T> middle(mix(a.x, b.x, t), mix(a.y, b.y, t));
            const T whole = disk_edge_coverage(a, b, T(1));
            const T parts = disk_edge_coverage(a, middle, T(1)) + disk_edge_coverage(middle, b, T(1));
            worst.add(std::abs(exact(parts) - exact(whole)) / disk_area(1.0), loop);
        }
        // three times up to 2.2 ε, and a middle that lies beside the edge
        CHECK_WORST(worst, 4 * epsilon<T>);
    }
}

TEST_CASE_TEMPLATE("reversing an edge changes the sign of the result and no bit else", T, float, double) {
    using Limits = std::numeric_limits<T>;
    std::vector<T> specials;
    for (const T x : {T(0), Limits::denorm_min(), Limits::min(), Limits::epsilon(), T(1e-8), T(1) / T(3), T(0.6),
                      T(0.8), T(1), T(1) + Limits::epsilon(), T(1) - Limits::epsilon() / T(2), T(3), T(1e5), T(1e18)})
        for (const T sign : {T(1), T(-1)}) specials.push_back(sign * x);
    const std::size_t domain = specials.size();
#ifndef __FAST_MATH__  // which has no such numbers
    for (const T x : {Limits::max(), Limits::infinity()})
        for (const T sign : {T(1), T(-1)}) specials.push_back(sign * x);
#endif
    int wrong = 0, outside = 0;
    const auto check = [&](const Vec2<T>& a, const Vec2<T>& b, bool in_domain) {
        const T one = one_edge(a, b, T(1)), other = one_edge(b, a, T(1));
        const bool good = is_finite(one) && std::abs(one) <= pi<T> * (T(1) + T(2) * Limits::epsilon());
        if (in_domain && !good) ++outside;
        if (is_finite(one) ? !same_but_sign(one, other) : is_finite(other)) ++wrong;
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
    for (const int exponent : {-40, -7, 1, 20, 40}) {
        const T scale = std::ldexp(T(1), exponent), square = scale * scale;
        int wrong = 0;
        for (int i = 0; i < polygons / 50; ++i) {
            const T radius = radii<T>()[static_cast<std::size_t>(i) % 4];
            const Loop<T> loop = scaled(loops.next(i % Loops<T>::kinds), radius);
            const Vec2<T> a = loop[0], b = loop[1];
            wrong += one_edge(a * scale, b * scale, radius * scale) != one_edge(a, b, radius) * square;
        }
        CAPTURE(exponent);
        CHECK(wrong == 0);
    }
}

TEST_CASE_TEMPLATE("turning a loop changes nothing beyond rounding", T, float, double) {
    Loops<T> loops(7);
    Worst worst;
    for (int i = 0; i < polygons / 20; ++i) {
        const int kind = i % Loops<T>::kinds;
        if (kind == Loops<T>::far_end || kind == Loops<T>::twice_around) continue;
        const Loop<T> loop = loops.next(kind);
        Loop<T> turned = loop;  // by a right angle: exact
        for (Vec2<T>& v : turned) v = Vec2<T>(-v.y, v.x);
        worst.add(std::abs(exact(sum_of_edges(turned, T(1))) - exact(sum_of_edges(loop, T(1)))) / disk_area(1.0), loop);
    }
    CHECK_WORST(worst, 2 * loop_tolerance<T>);
}

TEST_CASE_TEMPLATE("continuous across the rim, through tangents and past upright edges", T, float, double) {
    Loops<T> loops(8);
    test::Random random(8);
    const double step = 4 * epsilon<T>;
    Worst worst;
    for (int i = 0; i < polygons / 10; ++i) {
        Vec2<T> a = loops.direction(), b = loops.direction() * random.in(T(0), T(2));
        if (i % 3 == 1) b = a + Vec2<T>(-a.y, a.x) * random.in(T(-2), T(2));  // a tangent
        if (i % 3 == 2) b.x = a.x;
        const double before = exact(disk_edge_coverage(a, b, T(1)));
        const auto nudge = [&](T x) { return x + loops.sign() * static_cast<T>(step); };
        const Vec2<T> c(nudge(a.x), nudge(a.y)), d(nudge(b.x), nudge(b.y));
        const double after = exact(disk_edge_coverage(c, d, T(1)));
        worst.add(std::abs(after - before) / disk_area(1.0), Loop<T>{a, b, c, d});
    }
    // the disk's height times the way of both ends, half its width times that of the line, and rounding
    CHECK_WORST(worst, (2 * 2 + 2) * step / disk_area(1.0) + 2 * 2.2 * epsilon<T>);
}

TEST_CASE_TEMPLATE("what covers the disk is 1, what lies beside it is 0, to the last bit", T, float, double) {
    for (const T radius : radii<T>())
        for (const T grow : {T(1), T(1.5), T(1e5), T(1e17)}) {
            const Loop<T> unit{Vec2<T>(-grow, -grow), Vec2<T>(grow, -grow), Vec2<T>(grow, grow), Vec2<T>(-grow, grow)};
            const Loop<T> square = scaled(unit, radius), back(square.rbegin(), square.rend());
            CHECK(same(sum_of_edges(square, radius), pi<T> * radius * radius, radius));
            CHECK(same(sum_of_edges(back, radius), -pi<T> * radius * radius, radius));
            Loop<T> below, beside;
            for (const Vec2<T>& v : square) {
                below.push_back(v * T(0.9) - Vec2<T>(T(0), T(2) * grow * radius));
                beside.push_back(v * T(0.9) + Vec2<T>(T(2) * grow * radius, T(0)));
            }
            CHECK(same(sum_of_edges(below, radius), T(0), radius));
            CHECK(same(sum_of_edges(beside, radius), T(0), radius));
        }
}

TEST_CASE_TEMPLATE("lines through the centre, tangents, edges and disks without size", T, float, double) {
    const T whole = pi<T>, one = T(1);
    const auto edge = [](T ax, T ay, T bx, T by, T radius = T(1)) {
        return disk_edge_coverage(Vec2<T>(ax, ay), Vec2<T>(bx, by), radius);
    };
    CHECK(edge(T(0.5), T(0.5), T(0.5), T(0.5)) == T(0));            // no length
    CHECK(edge(T(0.5), T(-3), T(0.5), T(3)) == T(0));               // upright
    CHECK(edge(T(0.3), T(-1e18), T(0.3), T(1e18)) == T(0));         // and long
    CHECK(same(edge(T(-3), T(-1), T(3), T(-1)), T(0), one));        // the tangent below
    CHECK(same(edge(T(3), T(1), T(-3), T(1)), whole, one));         // the one above
    CHECK(same(edge(T(1), T(0), T(-1), T(0)), whole / T(2), one));  // through the centre
    CHECK(same(edge(T(1e18), T(0), T(-1e18), T(0)), whole / T(2), one));
    const double quarter = exact(whole) / 4;
    CHECK(std::abs(exact(edge(T(0), T(0), T(-1), T(0))) - quarter) <= epsilon<T>);  // from there
    CHECK(std::abs(exact(edge(T(0), T(0), T(-1e5), T(0))) - quarter) <= epsilon<T>);
    for (const T radius : {T(0), std::numeric_limits<T>::denorm_min()}) {  // nothing to cover
        CHECK(edge(T(1), T(0), T(-1), T(0), radius) == T(0));
        CHECK(edge(T(1e18), T(-3), T(-1e18), T(4), radius) == T(0));
        CHECK(edge(T(0), T(0), T(0), T(0), radius) == T(0));
    }
    // huge, and coordinates of huge disks
    CHECK(std::abs(exact(edge(T(1), T(1), T(-1), T(1), T(1e6))) - (2e6 + 2)) <= epsilon<T> * disk_area(1e6));
    CHECK(same(edge(T(1e18), T(0), T(-1e18), T(0), T(1e18)), pi<T> * T(1e18) * T(1e18) / T(2), T(1e18)));
    CHECK(sum_of_edges(Loop<T>{}, one) == T(0));
    CHECK(same(edge(T(1), T(2), T(-3), T(0.1)), -edge(T(-3), T(0.1), T(1), T(2)), one));
}

TEST_CASE_TEMPLATE("loops over edges have the same root, and the same areas", T, float, double) {
    test::Random random(9);
    double worst_root = 0;
    for (int i = 0; i < polygons; ++i) {
        const T x = std::exp2(random.in(T(-39), T(60))), root = std::sqrt(x);
        worst_root = std::max(worst_root, std::abs(exact(detail::LaneRoot()(x)) - exact(root)) / exact(root));
    }
    CHECK(worst_root <= 2 * epsilon<T>);  // half of that without -ffast-math
    CHECK(detail::LaneRoot()(T(0)) == T(0));
    for (T x = T(1); x > T(1e-36); x *= T(0.7))
        CHECK(std::abs(detail::LaneRoot()(x) - std::sqrt(x)) <=
              std::max(T(1e-10), T(2) * std::numeric_limits<T>::epsilon()));
    Loops<T> loops(9);
    Worst worst;
    int not_finite = 0;
    for (int i = 0; i < polygons / 4; ++i) {
        const T radius = radii<T>()[static_cast<std::size_t>(i) % 4];
        const Loop<T> loop = scaled(loops.next(i % Loops<T>::kinds), radius);
        const Vec2<T> a = loop[0], b = loop[1];
        const T lane = detail::disk_edge_coverage(a.x, a.y, b.x, b.y, detail::DiskUnits<T>(radius), detail::LaneRoot());
        not_finite += !is_finite(lane);
        worst.add(std::abs(exact(lane) - exact(disk_edge_coverage(a, b, radius))) / disk_area(radius), loop);
    }
    CHECK(not_finite == 0);
    CHECK_WORST(worst, 3 * epsilon<T>);  // with -ffast-math; else 1.3 ε
}
