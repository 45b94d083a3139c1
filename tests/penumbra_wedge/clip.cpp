#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <penumbra/light.hpp>
#include <penumbra/penumbra_wedge/clip.hpp>
#include <string>
#include <vector>

#include "../support/polygon_union.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int casters = 20000;
#else
constexpr int casters = 200000;
#endif

using Exact = long double;

template <class T>
using Loop = std::vector<Vec3<T>>;

template <class T>
double exact(T x) {
    return static_cast<double>(x);
}
template <class T>
Rect2<double> exact(const Rect2<T>& box) {
    return {glm::dvec2(box.min), glm::dvec2(box.max)};
}

/// The part of a loop where `side` ≥ 0.
template <class Side>
Loop<Exact> cut(const Loop<Exact>& loop, Side side) {
    Loop<Exact> result;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3<Exact>&a = loop[i], &b = loop[(i + 1) % loop.size()];
        const Exact da = side(a), db = side(b);
        if (da >= 0) result.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

/// The fraction of the box that a caster hides, winding counted: with a near plane, 1e-9 of the way before the point,
/// that long double can afford.
template <class T>
double hidden(const Loop<T>& loop_ls, const Vec3<T>& point_ls, const Rect2<T>& box) {
    const Vec3<Exact> p(point_ls);
    Loop<Exact> loop;
    for (const Vec3<T>& v : loop_ls) loop.push_back(Vec3<Exact>(v));
    loop = cut(loop, [](const Vec3<Exact>& v) { return v.z; });
    loop = cut(loop, [&](const Vec3<Exact>& v) { return p.z * (1 - 1e-9L) - v.z; });
    std::vector<Vec2<Exact>> shadow;
    for (const Vec3<Exact>& v : loop) {
        const Exact grown = p.z / (p.z - v.z);
        shadow.push_back(Vec2<Exact>(p.x + (v.x - p.x) * grown, p.y + (v.y - p.y) * grown));
    }
    return test::winding_area(shadow, exact(box)) / exact(area(box));
}

/// The largest of many errors, and what it came of.
struct Worst {
    double error = 0;
    std::string at = "-";

    template <class T>
    void add(double e, const Loop<T>& loop, const Vec3<T>& point) {
        if (e <= error) return;
        error = e;
        at = "point";
        tell(point);
        at += " loop";
        for (const Vec3<T>& v : loop) tell(v);
    }

  private:
    template <class T>
    void tell(const Vec3<T>& v) {
        char text[96];
        std::snprintf(text, sizeof text, " (%a, %a, %a)", exact(v.x), exact(v.y), exact(v.z));
        at += text;
    }
};

#define CHECK_WORST(worst, allowed)                                               \
    do {                                                                          \
        INFO("worst " << worst.error << " of " << allowed << " at " << worst.at); \
        CHECK(worst.error <= allowed);                                            \
    } while (false)

template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
/// A point and a planar caster.
template <class T>
struct Case {
    Vec3<T> point;
    Loop<T> loop;
};

/// Length over distance from the point, of the side for which that is largest.
template <class T>
double nearness(const Case<T>& c) {
    double largest = 0;
    for (std::size_t k = 0; k < c.loop.size(); ++k) {
        const glm::dvec3 p(c.point), a = glm::dvec3(c.loop[k]) - p, b = glm::dvec3(c.loop[(k + 1) % c.loop.size()]) - p;
        const double length = glm::length(b - a);
        if (!(length > 0)) continue;
        const double t = clamp(-glm::dot(a, b - a) / (length * length), 0.0, 1.0);
        largest = std::max(largest, length / std::max(glm::length(a + (b - a) * t), 1e-300));
    }
    return largest;
}
/// What clips may be off by. A vertex is rounded by some ε of the distances to the point; a side that passes it nearer
/// than its ends are turns by that much more. Measured: 8 ε and 1.0 ε.
template <class T>
double tolerance(double nearness) {
    return (12 + 1.5 * nearness) * static_cast<double>(std::numeric_limits<T>::epsilon());
}
/// The figures for float, in ε: 5e-6, and 5e-4 within 1e-3 of the point.
template <class T>
constexpr double figure = 42 * epsilon<T>;
template <class T>
constexpr double near_figure = 4200 * epsilon<T>;

template <class T>
Rect2<T> light() {
    return {Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))};
}

template <class T>
Vec3<T> mix(const Vec3<T>& a, const Vec3<T>& b, T t) {
    return a + (b - a) * t;
}

template <class T>
T coverage(const Loop<T>& loop, const Vec3<T>& point, const Rect2<T>& box) {
    return loop_coverage(loop.data(), loop.size(), point, box);
}

template <class T>
class Cases {
  public:
    static constexpr int kinds = 8;
    static constexpr std::array<const char*, kinds> names{
        {"between light and point", "star", "across the point's depth", "across the light's plane", "across both",
         "vertices at depths 0 and p", "needle", "comb"}};

    explicit Cases(std::uint32_t seed) : random_(seed) {}

    Case<T> next(int kind) {
        const Vec3<T> point = anywhere();
        const T p = point.z;
        // around a place on the way to the light
        const T depth = kind == 2 ? p : kind == 3 ? T(0) : p * random_.in(T(0.1), T(0.9));
        const Vec3<T> way = on_way(point, depth), center = way + random_.point(T(-0.5), T(0.5));
        T size = std::exp2(random_.in(T(-4), T(1)));
        if (kind == 4) size = T(2) * p;
        Case<T> result{point, polygon(center, size, kind == 1, kind == 7)};
        if (kind == 5) {
            result.loop.resize(3);
            result.loop[0].z = p;
            result.loop[1].z = T(0);
            result.loop[2].z = random_.whole(0, 1) == 0 ? p : T(0);
        }
        if (kind == 6) {
            Loop<T>& l = result.loop;
            for (std::size_t i = 2; i < l.size(); ++i) l[i] = mix(l[0], l[1], random_.in(T(0), T(1)));
            for (Vec3<T>& v : l) v += random_.point(T(-0.01), T(0.01));
        }
        return result;
    }
    /// A triangle, which is planar as rounded, around the place that is so far from the point.
    Case<T> around(T distance) {
        const Vec3<T> point = anywhere();
        axes();
        const Vec3<T> place = point + glm::cross(u_, v_) * distance;
        const T size = std::exp2(random_.in(T(-9), T(1))), share = random_.in(T(0.1), T(1));
        return {point, {place + (u_ - v_) * size, place - (u_ + v_) * size * share, place + v_ * size}};
    }
    /// The same with its first side through the place.
    Case<T> beside(T distance) {
        Case<T> c = around(distance);
        const Vec3<T> place = c.point + glm::cross(u_, v_) * distance, along = c.loop[0] - c.loop[1];
        c.loop[0] = place + along, c.loop[1] = place - along * random_.in(T(0.1), T(1));
        return c;
    }

  private:
    Vec3<T> anywhere() {
        const Vec3<T> share = random_.point(T(0), T(1));
        return Vec3<T>(T(6) * share.x - T(3), T(6) * share.y - T(3), T(1) + T(7) * share.z);
    }
    /// At `depth` between the point and somewhere on the light.
    Vec3<T> on_way(const Vec3<T>& point, T depth) {
        const Vec3<T> lamp = random_.point(T(-1), T(1)) * Vec3<T>(T(1), T(1), T(0));
        return lamp + (point - lamp) * (depth / point.z);
    }
    void axes() {
        const Vec3<T> n = normalize_or(random_.point(T(-1), T(1)), Vec3<T>(T(0), T(0), T(1)));
        u_ = any_perpendicular(n), v_ = glm::cross(n, u_);
    }
    Loop<T> polygon(const Vec3<T>& center, T size, bool star, bool comb) {
        axes();
        return polygon_on_axes(center, size, star, comb);
    }
    /// Turns either way.
    Loop<T> polygon_on_axes(const Vec3<T>& center, T size, bool star, bool comb) {
        Loop<T> loop;
        const int count = comb ? 12 : random_.whole(3, star ? 12 : 7);
        for (int i = 0; i < count; ++i) {
            const T turn = T(6.2831853) * static_cast<T>(i) / static_cast<T>(count);
            const T radius = size * (star ? random_.in(T(0.1), T(1)) : T(1));
            T x = radius * std::cos(turn), y = radius * std::sin(turn);
            if (comb) {  // a back with teeth
                x = size * (i < 2 ? (i == 0 ? T(-1) : T(1)) : T(1) - static_cast<T>(i - 2) / T(4.5));
                y = size * (i < 2 ? T(-1) : (i - 2) % 4 < 2 ? T(1) : T(-0.9));
            }
            loop.push_back(center + u_ * x + v_ * y);
        }
        return loop;
    }

    test::Random random_;
    Vec3<T> u_, v_;
};

}  // namespace

TEST_CASE_TEMPLATE("a planar caster hides what its exact projection covers", T, float, double) {
    Cases<T> cases(1);
    const Rect2<T> box = light<T>();
    for (int kind = 0; kind < Cases<T>::kinds; ++kind) {
        CAPTURE(Cases<T>::names[static_cast<std::size_t>(kind)]);
        Worst worst, relative;
        int partly = 0;
        for (int i = 0; i < casters / Cases<T>::kinds; ++i) {
            const Case<T> c = cases.next(kind);
            const double truth = hidden(c.loop, c.point, box), near = nearness(c);
            const double error = std::abs(exact(coverage(c.loop, c.point, box)) - truth);
            partly += std::abs(truth) > 1e-4 && std::abs(truth) < 0.9999;
            relative.add(error / tolerance<T>(near), c.loop, c.point);
            if (near < 20) worst.add(error, c.loop, c.point);
        }
        CHECK_WORST(relative, 1.0);
        CHECK_WORST(worst, figure<T>);
        CHECK(partly > casters / Cases<T>::kinds / 10);
    }
}

TEST_CASE_TEMPLATE("a caster 1e-6 from the point is as any other", T, float, double) {
    Cases<T> cases(2);
    const Rect2<T> box = light<T>();
    for (const T distance : {T(1e-2), T(1e-3), T(1e-4), T(1e-5), T(1e-6)}) {
        CAPTURE(distance);
        Worst worst;
        int seen = 0;
        for (int i = 0; i < casters / 20; ++i) {
            const Case<T> c = cases.around(distance);
            const glm::dvec3 a(c.loop[0] - c.point), b(c.loop[1] - c.point), third(c.loop[2] - c.point);
            const glm::dvec3 normal = glm::cross(b - a, third - a);
            const double away = std::abs(glm::dot(normal, a)) / glm::length(normal), size = glm::length(b - a);
            if (away < 4 * epsilon<T> * size) continue;  // the plane as rounded may pass on either side of the point
            const double truth = hidden(c.loop, c.point, box), got = exact(coverage(c.loop, c.point, box));
            worst.add(std::abs(got - truth), c.loop, c.point);
            ++seen;
        }
        CHECK(seen > casters / 40);
        CHECK_WORST(worst, figure<T>);
    }
}

TEST_CASE_TEMPLATE("a side that passes near the point costs ε length / distance", T, float, double) {
    Cases<T> cases(3);
    const Rect2<T> box = light<T>();
    for (const T distance : {T(1e-2), T(1e-3), T(1e-4), T(1e-5), T(1e-6)}) {
        CAPTURE(distance);
        Worst worst, relative;
        for (int i = 0; i < casters / 20; ++i) {
            const Case<T> c = cases.beside(distance);
            const double error = std::abs(exact(coverage(c.loop, c.point, box)) - hidden(c.loop, c.point, box));
            const double near = nearness(c);
            relative.add(error / tolerance<T>(near), c.loop, c.point);
            if (near < 2700) worst.add(error, c.loop, c.point);
        }
        CHECK_WORST(relative, 1.0);
        CHECK_WORST(worst, near_figure<T>);
    }
}

TEST_CASE_TEMPLATE("what covers the box is 1, what is beside, behind or beyond is 0, to the last bit", T, float,
                   double) {
    Cases<T> cases(4);
    test::Random random(4);
    const Rect2<T> box = light<T>(), part{Vec2<T>(T(0.1), T(-0.7)), Vec2<T>(T(0.4), T(1.3))};
    for (int i = 0; i < casters / 20; ++i) {
        const Case<T> c = cases.next(i % 2);
        Loop<T> around, behind, beyond, beside;
        for (std::size_t k = 0; k < 4; ++k) {  // on a slanted plane across the way
            const T x = (k == 1 || k == 2) ? T(9) : T(-9), y = k >= 2 ? T(9) : T(-9);
            around.push_back(Vec3<T>(x, y, c.point.z * (T(0.5) + x * T(0.02) - y * T(0.03))));
        }
        const T most = std::max_element(c.loop.begin(), c.loop.end(), [](auto& a, auto& b) { return a.z < b.z; })->z;
        const T least = std::min_element(c.loop.begin(), c.loop.end(), [](auto& a, auto& b) { return a.z < b.z; })->z;
        for (const Vec3<T>& v : c.loop) {
            behind.push_back(v - Vec3<T>(T(0), T(0), most + random.in(T(1e-3), T(1))));
            beyond.push_back(v + Vec3<T>(T(0), T(0), c.point.z - least + random.in(T(1e-3), T(1))));
            beside.push_back(v + Vec3<T>(T(9), T(0), T(0)));
        }
        for (const Rect2<T>& b : {box, part}) {
            CHECK(coverage(around, c.point, b) == T(1));
            CHECK(coverage(Loop<T>(around.rbegin(), around.rend()), c.point, b) == T(-1));
            for (const Loop<T>& away : {behind, beyond, beside}) CHECK(coverage(away, c.point, b) == T(0));
        }
    }
}

TEST_CASE_TEMPLATE("the other way round negates; where a loop starts changes nothing", T, float, double) {
    Cases<T> cases(5);
    test::Random random(5);
    const Rect2<T> box = light<T>();
    Worst worst;
    for (int i = 0; i < casters / 4; ++i) {
        const Case<T> c = cases.next(i % Cases<T>::kinds);
        const double once = exact(coverage(c.loop, c.point, box));
        Loop<T> loop = c.loop;
        std::rotate(loop.begin(), loop.begin() + random.whole(1, 2), loop.end());
        worst.add(std::abs(exact(coverage(loop, c.point, box)) - once), c.loop, c.point);
        std::reverse(loop.begin(), loop.end());
        worst.add(std::abs(exact(coverage(loop, c.point, box)) + once), c.loop, c.point);
    }
    CHECK_WORST(worst, 4 * epsilon<T>);  // the same edges in another order
}

TEST_CASE_TEMPLATE("scaling by a power of two changes no bit", T, float, double) {
    Cases<T> cases(6);
    T (*const volatile cover)(const Vec3<T>*, std::size_t, const Vec3<T>&, const Rect2<T>&) = &loop_coverage<T>;
    for (const int exponent : {-20, -3, 1, 20}) {
        const T scale = std::ldexp(T(1), exponent);
        const Rect2<T> box = light<T>(), large{box.min * scale, box.max * scale};
        int wrong = 0;
        for (int i = 0; i < casters / 8; ++i) {
            const Case<T> c = cases.next(i % Cases<T>::kinds);
            Loop<T> loop = c.loop;
            for (Vec3<T>& v : loop) v = v * scale;
            wrong += cover(loop.data(), loop.size(), c.point * scale, large) !=
                     cover(c.loop.data(), loop.size(), c.point, box);
        }
        CAPTURE(exponent);
        CHECK(wrong == 0);
    }
}

TEST_CASE_TEMPLATE("scenes turned, mirrored, and moved by 1e5 look the same", T, float, double) {
    Cases<T> cases(7);
    test::Random random(7);
    const Rect2<T> box = light<T>();
    const LightFrame<T> here{Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0)),
                             Vec3<T>(T(0), T(0), T(1))};
    Worst quarter, turned, moved;
    for (int i = 0; i < casters / 8; ++i) {
        Case<T> c = cases.next(0);
        c.loop.resize(3);                                             // planar, whatever rounds
        for (Vec3<T>& v : c.loop) v = glm::floor(v * T(64)) / T(64);  // moves by 1e5 without rounding
        c.point = glm::floor(c.point * T(64)) / T(64);
        const double once = exact(coverage(c.loop, c.point, box));

        Case<T> mirrored = c, quarter_turn = c;
        for (std::size_t k = 0; k <= c.loop.size(); ++k) {
            const auto vertex = [&](Case<T>& of) -> Vec3<T>& { return k < of.loop.size() ? of.loop[k] : of.point; };
            vertex(mirrored).x *= T(-1);
            vertex(quarter_turn) = Vec3<T>(-vertex(c).y, vertex(c).x, vertex(c).z);
        }
        const double allowed = tolerance<T>(nearness(c));
        quarter.add(std::abs(exact(coverage(mirrored.loop, mirrored.point, box)) + once) / allowed, c.loop, c.point);
        quarter.add(std::abs(exact(coverage(quarter_turn.loop, quarter_turn.point, box)) - once) / allowed, c.loop,
                    c.point);

        const auto through = [&](const LightFrame<T>& frame) {
            Loop<T> loop;
            for (const Vec3<T>& v : c.loop) loop.push_back(frame.to_light(frame.to_world(v)));
            return exact(coverage(loop, frame.to_light(frame.to_world(c.point)), box));
        };
        LightFrame<T> far = here;
        far.origin = Vec3<T>(T(1e5), T(-1e5), T(1e5));
        moved.add(std::abs(through(far) - once), c.loop, c.point);
        const Vec3<T> n = normalize_or(random.point(T(-1), T(1)), here.normal);
        turned.add(std::abs(through(light_frame(DiskLight<T>{here.origin, n, T(1)})) - once) / allowed, c.loop,
                   c.point);
    }
    CHECK_WORST(quarter, 1.0);
#ifndef __FAST_MATH__  // which may add before it subtracts
    CHECK_WORST(moved, 0.0);
#endif
    CHECK_WORST(turned, 16.0);  // coordinates up to 8 are rounded three times, of vertices at distances of 1 and more
}

TEST_CASE_TEMPLATE("what lands of a loop is a closed loop in the box", T, float, double) {
    Cases<T> cases(8);
    const Rect2<T> box{Vec2<T>(T(-0.3), T(-1.1)), Vec2<T>(T(0.9), T(0.7))};
    int edges = 0, outside = 0, open = 0;
    for (int i = 0; i < casters / 4; ++i) {
        const Case<T> c = cases.next(i % Cases<T>::kinds);
        std::vector<Vec2<T>> from, to;
        project_loop(c.loop.data(), c.loop.size(), c.point, box,
                     [&](const Vec2<T>& a, const Vec2<T>& b) { from.push_back(a), to.push_back(b); });
        for (std::size_t k = 0; k < from.size(); ++k) {
            const Vec2<T> v = from[k];
            edges += 1;
            outside += !(v.x >= box.min.x && v.x <= box.max.x && v.y >= box.min.y && v.y <= box.max.y);
            open += to[k] != from[(k + 1) % from.size()];
        }
    }
    CHECK(edges > casters / 2);
    CHECK(outside == 0);
    CHECK(open == 0);
}

TEST_CASE_TEMPLATE("edge by edge, a caster between light and point hides the same", T, float, double) {
    Cases<T> cases(9);
    for (const Rect2<T>& box : {light<T>(), Rect2<T>{Vec2<T>(T(0), T(-1)), Vec2<T>(T(1), T(0))}}) {
        Worst worst;
        int loops = 0;
        for (int i = 0; i < casters / 2; ++i) {
            const Case<T> c = cases.next(i % 2 == 0 ? 7 : i % 4 / 2);
            if (std::any_of(c.loop.begin(), c.loop.end(),
                            [&](const Vec3<T>& v) { return v.z < T(0) || v.z > c.point.z * T(0.95); }))
                continue;
            T sum = T(0);
            for (std::size_t k = 0; k < c.loop.size(); ++k) {
                const Vec3<T> a = c.loop[k], b = c.loop[(k + 1) % c.loop.size()];
                const ProjectedEdge<T> e = project_edge(a, b, c.point, box), back = project_edge(b, a, c.point, box);
                CHECK((e.lands == back.lands && e.a == back.b && e.b == back.a));
                if (e.lands) sum += edge_coverage(e.a, e.b, box);
            }
            ++loops;
            const double truth = hidden(c.loop, c.point, box);
            worst.add(std::abs(exact(sum / area(box)) - truth) / tolerance<T>(nearness(c)), c.loop, c.point);
        }
        CHECK(loops > casters / 8);
        CHECK_WORST(worst, 1.0);
    }
}

TEST_CASE_TEMPLATE("an edge lands where lines through its points do, within the box's columns", T, float, double) {
    Cases<T> cases(10);
    const Rect2<T> box = light<T>();
    double worst = 0;
    int landed = 0;
    for (int i = 0; i < casters; ++i) {
        const Case<T> c = cases.next(i % 5);
        const ProjectedEdge<T> e = project_edge(c.loop[0], c.loop[1], c.point, box);
        if (!e.lands) continue;
        ++landed;
        // the plane through point and edge holds what lands, up to ε of the normal's terms
        const glm::dvec3 p(c.point), a = glm::dvec3(c.loop[0]) - p, b = glm::dvec3(c.loop[1]) - p;
        const glm::dvec3 normal = glm::cross(a, b);
        for (const Vec2<T>& end : {e.a, e.b}) {
            CHECK(end.x >= box.min.x);
            CHECK(end.x <= box.max.x);
            const glm::dvec3 to = glm::dvec3(glm::dvec2(end), 0) - p;
            const double size = glm::length(a) * glm::length(b) * glm::length(to);
            worst = std::max(worst, std::abs(glm::dot(normal, to)) / size);
        }
    }
    CHECK(landed > casters / 8);
    CHECK(worst <= 12 * epsilon<T>);
    // exactly on the column where it is cut, as far as it reaches where not
    const ProjectedEdge<T> cut =
        project_edge(Vec3<T>(T(-4), T(0.5), T(1)), Vec3<T>(T(0), T(0.5), T(1)), Vec3<T>(T(0), T(0), T(2)), box);
    CHECK(cut.lands);
    CHECK(cut.a == Vec2<T>(T(-1), T(1)));
    CHECK(cut.b == Vec2<T>(T(0), T(1)));
}

TEST_CASE_TEMPLATE("what does not land", T, float, double) {
    const Vec3<T> p(T(0), T(0), T(2));
    const Rect2<T> box = light<T>(), flat{Vec2<T>(T(-1), T(0)), Vec2<T>(T(1), T(0))};
    const auto lands = [&](const Vec3<T>& a, const Vec3<T>& b) {
        const ProjectedEdge<T> e = project_edge(a, b, p, box);
        if (!e.lands) CHECK((e.a == Vec2<T>(T(0), T(0)) && e.b == e.a));
        return e.lands;
    };
    CHECK_FALSE(lands(Vec3<T>(T(0), T(0), T(-1)), Vec3<T>(T(1), T(0), T(-0.001))));  // behind the light
    CHECK_FALSE(lands(Vec3<T>(T(0), T(0), T(3)), Vec3<T>(T(1), T(0), T(2.001))));    // beyond the point
    CHECK_FALSE(lands(Vec3<T>(T(0.5), T(0), T(2)), Vec3<T>(T(1), T(0), T(2))));      // at the point's depth
    CHECK_FALSE(lands(Vec3<T>(T(5), T(-1), T(1)), Vec3<T>(T(5), T(1), T(1))));       // beside the columns
    CHECK_FALSE(lands(p, p));                                                        // the point itself
    CHECK(lands(Vec3<T>(T(0.5), T(7), T(1)), Vec3<T>(T(-0.5), T(9), T(1))));         // above the box
    CHECK(lands(Vec3<T>(T(0), T(0), T(-1)), Vec3<T>(T(0.1), T(0), T(1))));           // through the light's plane
    CHECK_FALSE(project_edge(Vec3<T>(T(0), T(0), T(1)), Vec3<T>(T(1), T(0), T(1)), p, flat).lands);
    const Loop<T> triangle{Vec3<T>(T(-5), T(-5), T(1)), Vec3<T>(T(5), T(-5), T(1)), Vec3<T>(T(0), T(5), T(1))};
    CHECK(coverage(triangle, p, flat) == T(0));
    CHECK(coverage(Loop<T>{}, p, box) == T(0));
    CHECK(coverage(Loop<T>{triangle[0]}, p, box) == T(0));
    CHECK(coverage(Loop<T>{triangle[0], triangle[1]}, p, box) == T(0));
    CHECK(coverage(Loop<T>{triangle[0], triangle[2], triangle[2]}, p, box) == T(0));
}

TEST_CASE_TEMPLATE("triangle_coverage is loop_coverage of a triangle, in range for any coordinates", T, float, double) {
    const Rect2<T> box = light<T>();
    const T numbers[] = {T(0), T(1), T(-1), T(0.3), T(2), T(1e-6), T(-1e5), T(1e18), T(-1e18)};
    test::Random random(11);
    const auto any = [&] { return numbers[random.whole(0, 8)]; };
    int wrong = 0, outside = 0;
    for (int i = 0; i < casters; ++i) {
        Loop<T> loop;
        for (int k = 0; k < 3; ++k) {
            const T x = any(), y = any(), z = any();
            loop.push_back(Vec3<T>(x, y, z));
        }
        const T depth = std::abs(any());
        const Vec3<T> point(any(), loop[0].y, depth > T(0) ? depth : T(2));
        const T share = triangle_coverage(loop[0], loop[1], loop[2], point, box);
        outside += !(is_finite(share) && std::abs(share) <= T(1.00001));
        wrong += share != coverage(loop, point, box);
    }
#ifndef __FAST_MATH__  // with which inlined copies may round differently
    CHECK(wrong == 0);
#endif
    CHECK(outside == 0);
}
