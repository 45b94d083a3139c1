#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/plan/extents.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

template <class T>
Box3<T> box(T x0, T y0, T z0, T x1, T y1, T z1) {
    return {Vec3<T>(x0, y0, z0), Vec3<T>(x1, y1, z1)};
}

/// Anywhere near depths of `near` to `far`, flat now and then along an axis.
template <class T>
Box3<T> random_box(test::Random& random, T near, T far) {
    const Vec3<T> a = random.point(T(-2), T(2)), size = random.point(T(0), T(1.5));
    Box3<T> b{a, a + size};
    b.min.z = random.in(near, far), b.max.z = random.in(b.min.z, far);
    const int flat = random.whole(0, 5);
    if (flat < 3) b.max[flat] = b.min[flat];
    return b;
}
template <class T>
Vec3<T> in_box(test::Random& random, const Box3<T>& b) {
    const Vec3<T> share = random.point(T(0), T(1));
    const int corner = random.whole(0, 15);  // each second on corners
    Vec3<T> p = b.min + (b.max - b.min) * share;
    for (int k = 0; k < 3 && corner < 8; ++k) p[k] = (corner >> k & 1) != 0 ? b.max[k] : b.min[k];
    return p;
}
template <class T>
LightExtent<T> random_light(test::Random& random) {
    const T x = random.in(T(0.01), T(1.5)), y = random.in(T(0.01), T(1.5));
    const int kind = random.whole(0, 4);
    if (kind == 0) return {Vec2<T>(x, x), true};
    return {Vec2<T>(kind == 1 ? T(0) : x, kind <= 2 ? T(0) : y), false};
}

template <class T>
Vec2<double> seen_at(const Vec3<T>& e, const Vec3<T>& p) {
    const glm::dvec3 from(p), at(e);
    return glm::dvec2(from) + (glm::dvec2(at) - glm::dvec2(from)) * (from.z / (from.z - at.z));
}
template <class T>
bool contains(const Rect2<T>& r, const Vec2<double>& at, double slack) {
    return at.x >= static_cast<double>(r.min.x) - slack && at.x <= static_cast<double>(r.max.x) + slack &&
           at.y >= static_cast<double>(r.min.y) - slack && at.y <= static_cast<double>(r.max.y) + slack;
}
/// Whether the way from P to L meets a box before the light.
bool is_hidden(const Box3<double>& b, const glm::dvec3& p, const glm::dvec3& l) {
    double first = 0.0, last = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double way = l[k] - p[k], low = b.min[k] - p[k], high = b.max[k] - p[k];
        if (std::abs(way) < 1e-12) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        first = std::max(first, std::min(low / way, high / way)),
        last = std::min(last, std::max(low / way, high / way));
    }
    return first <= last;
}
Box3<double> as_double(const Box3<float>& b) { return {Vec3<double>(b.min), Vec3<double>(b.max)}; }

/// Over an even grid on the light, what each of some boxes hides from P: the box around it as a share of the light's,
/// and for a disk the share of its samples.
struct Hidden {
    double share = 0.0;
    bool any = false;
};
Hidden hidden_share(const std::vector<Box3<float>>& boxes, const Vec3<float>& p, const LightExtent<float>& light) {
    constexpr int n = 24;
    Rect2<double> around = empty_rect<double>();
    int hidden = 0, all = 0;
    const glm::dvec2 half(light.half_size);
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) {
            const glm::dvec2 at(2.0 * i / n - 1.0, 2.0 * k / n - 1.0);
            if (light.disk && glm::dot(at, at) > 1.0) continue;
            ++all;
            bool is = true;
            for (const Box3<float>& b : boxes) is = is && is_hidden(as_double(b), p, glm::dvec3(at * half, 0.0));
            if (!is) continue;
            ++hidden, around = extend(around, at);
        }
    if (hidden == 0) return {};
    if (light.disk) return {static_cast<double>(hidden) / all - 0.1, true};  // less what the samples may be off by
    const glm::dvec2 size = extent(around) * 0.5;
    return {(half.x > 0.0 ? size.x : 1.0) * (half.y > 0.0 ? size.y : 1.0), true};
}

}  // namespace

TEST_CASE_TEMPLATE("a box lands where its points do, and its corners on the border", T, float, double) {
    test::Random random(1);
    const double slack = std::is_same_v<T, float> ? 1e-4 : 1e-12;
    for (int n = 0; n < 2000; ++n) {
        const Box3<T> caster = random_box(random, T(0.2), T(2)), receivers = random_box(random, T(2.5), T(6));
        const Rect2<T> rect = project_box(caster, receivers);
        for (int i = 0; i < 16; ++i) {
            const Vec3<T> e = in_box(random, caster), p = in_box(random, receivers);
            CHECK(contains(rect, seen_at(e, p), slack));
        }
        Rect2<double> corners = empty_rect<double>();
        for (int i = 0; i < 64; ++i) {
            Vec3<T> e, p;
            for (int k = 0; k < 3; ++k) {
                e[k] = (i >> k & 1) != 0 ? caster.max[k] : caster.min[k];
                p[k] = (i >> (k + 3) & 1) != 0 ? receivers.max[k] : receivers.min[k];
            }
            corners = extend(corners, seen_at(e, p));
        }
        CHECK(contains(Rect2<T>{Vec2<T>(corners.min), Vec2<T>(corners.max)}, Vec2<double>(rect.min), slack));
        CHECK(contains(Rect2<T>{Vec2<T>(corners.min), Vec2<T>(corners.max)}, Vec2<double>(rect.max), slack));
    }
}

TEST_CASE("boxes that reach past each other in depth land wherever any of their points may") {
    test::Random random(2);
    for (int n = 0; n < 4000; ++n) {
        const Box3<float> caster = random_box(random, -1.0F, 3.0F), receivers = random_box(random, -0.5F, 4.0F);
        const Rect2<float> rect = project_box(caster, receivers);
        for (int i = 0; i < 16; ++i) {
            const Vec3<float> e = in_box(random, caster), p = in_box(random, receivers);
            if (!(e.z > 0.0F) || !(p.z > e.z * 1.0001F)) continue;
            const Vec2<double> at = seen_at(e, p);
            CHECK(contains(rect, at, 1e-3 * (1.0 + std::abs(at.x) + std::abs(at.y))));
        }
    }
}

TEST_CASE("a caster's shadow box holds every point from which something hides the light") {
    test::Random random(3);
    int hits = 0;
    for (int n = 0; n < 4000; ++n) {
        const Box3<float> caster = random_box(random, -0.3F, 3.0F);
        Box3<float> receivers = random_box(random, 0.0F, 5.0F);
        receivers.min.x -= 3.0F, receivers.min.y -= 3.0F, receivers.max.x += 2.0F, receivers.max.y += 2.0F;
        const LightExtent<float> light = random_light<float>(random);
        const Box3<float> shadow = shadow_box(caster, receivers, light.half_size);
        for (int i = 0; i < 16; ++i) {
            const Vec3<float> e = in_box(random, caster), p = in_box(random, receivers);
            if (!(e.z > 1e-3F) || !(p.z > e.z)) continue;
            const Vec3<float> l = Vec3<float>(light.half_size, 0.0F) * random.point(-1.0F, 1.0F);
            // the point behind E as seen from L, at P's depth
            const Vec3<float> behind = l + (e - l) * (p.z / e.z);
            const Vec3<float> low = receivers.min - 1e-6F, high = receivers.max + 1e-6F;
            if (behind.x < low.x || behind.y < low.y || behind.x > high.x || behind.y > high.y) continue;
            ++hits;
            const Vec3<float> slack = Vec3<float>(1e-4F) + glm::abs(behind) * 1e-5F;
            CHECK_FALSE(is_empty(shadow));
            CHECK(glm::all(glm::lessThanEqual(shadow.min - slack, behind)));
            CHECK(glm::all(glm::greaterThanEqual(shadow.max + slack, behind)));
        }
    }
    CHECK(hits > 1000);
}

TEST_CASE("limits hold for what boxes hide of lights of any shape") {
    test::Random random(4);
    int hits = 0, both = 0, zero = 0;
    for (int n = 0; n < 3000; ++n) {
        const Box3<float> a = random_box(random, 0.05F, 2.5F), b = random_box(random, 0.05F, 2.5F),
                          receivers = random_box(random, 1.0F, 5.0F);
        const LightExtent<float> light = random_light<float>(random);
        const float of_a = occlusion_limit(a, receivers, light), of_both = overlap_limit(a, b, receivers, light);
        const float width = penumbra_width(a, receivers, light.half_size);
        zero += of_both > 0.0F ? 0 : 1;
        CHECK((of_a >= 0.0F && of_a <= 1.0F && of_both >= 0.0F && of_both <= of_a));
        for (int i = 0; i < 4; ++i) {
            const Vec3<float> p = in_box(random, receivers);
            const Hidden by_a = hidden_share({a}, p, light), by_both = hidden_share({a, b}, p, light);
            hits += by_a.any ? 1 : 0, both += by_both.any ? 1 : 0;
            CHECK(static_cast<double>(of_a) >= by_a.share - 1e-4);
            CHECK(static_cast<double>(of_both) >= by_both.share - 1e-4);
            if (by_a.any) CHECK(of_a > 0.0F);
            if (by_both.any) CHECK(of_both > 0.0F);
            // what of it lies nearest to the light casts the widest penumbra, if it hides any
            const float z = std::min(a.max.z, 0.999F * p.z);
            const Box3<float> part{Vec3<float>(a.min.x, a.min.y, a.min.z), Vec3<float>(a.max.x, a.max.y, a.min.z)};
            if (a.min.z < z && hidden_share({part}, p, light).any) {
                const float size = 2.0F * std::max(light.half_size.x, light.half_size.y);
                CHECK(width >= size * (p.z - a.min.z) / a.min.z * 0.999F);
            }
        }
    }
    CHECK(hits > 500);
    CHECK(both > 100);
    CHECK(zero > 100);
}

TEST_CASE("a plate half way down, by hand") {
    const Box3<float> plate = box(-1.0F, -1.0F, 1.0F, 1.0F, 1.0F, 1.0F),
                      ground = box(-9.0F, -9.0F, 2.0F, 9.0F, 9.0F, 2.0F);
    const Vec2<float> half(1.0F, 0.5F);
    const Box3<float> shadow = shadow_box(plate, ground, half);
    CHECK(shadow.max.x == doctest::Approx(3.0));
    CHECK(shadow.min.x == doctest::Approx(-3.0));
    CHECK(shadow.max.y == doctest::Approx(2.5));
    CHECK(shadow.min.y == doctest::Approx(-2.5));
    CHECK(penumbra_width(plate, ground, half) == doctest::Approx(2.0));
    CHECK(occlusion_limit(plate, ground, {half, false}) == doctest::Approx(1.0));
    // from points of x in [1.5, 2], where it ends at −1 to 0 on the light: half of it at most
    const Box3<float> aside = box(2.0F, -9.0F, 2.0F, 2.5F, 9.0F, 2.0F);
    CHECK(occlusion_limit(plate, aside, {half, false}) == doctest::Approx(0.5).epsilon(1e-4));
    // a fifth of its size: 0.4 × 0.4 of 2 × 1
    const Box3<float> small = box(-0.1F, -0.1F, 1.0F, 0.1F, 0.1F, 1.0F);
    const Box3<float> below = box(0.0F, 0.0F, 2.0F, 0.0F, 0.0F, 2.0F);
    CHECK(occlusion_limit(small, below, {half, false}) == doctest::Approx(0.08).epsilon(1e-4));
    CHECK(occlusion_limit(small, below, {Vec2<float>(1.0F, 1.0F), true}) ==
          doctest::Approx(0.16 / std::acos(-1.0)).epsilon(1e-3));
    CHECK(occlusion_limit(small, below, {Vec2<float>(1.0F, 0.0F), false}) == doctest::Approx(0.2).epsilon(1e-4));
    CHECK(occlusion_limit(small, below, {Vec2<float>(0.0F, 0.0F), false}) == doctest::Approx(1.0));
}

TEST_CASE("wedges overlap from where they meet on") {
    const LightExtent<float> light{Vec2<float>(1.0F, 1.0F), false};
    // plates at x = -c and c, 2 wide: their shadows end at 3 - 2c and 2c - 3. From x = 3 - 2c on the ground the one on
    // the right begins at 2 (c - 1) - x on the light, and from 2c - 3 the other ends at -2 (c - 1) - x: c = 5/4
    const Box3<float> ground = box(-50.0F, -50.0F, 2.0F, 50.0F, 50.0F, 2.0F);
    const auto plate = [](float x) { return box(x - 1.0F, -1.0F, 1.0F, x + 1.0F, 1.0F, 1.0F); };
    CHECK_FALSE(overlap_limit(plate(-1.26F), plate(1.26F), ground, light) > 0.0F);
    CHECK(overlap_limit(plate(-1.24F), plate(1.24F), ground, light) > 0.0F);
    CHECK(overlap_limit(plate(0.0F), plate(0.0F), ground, light) == doctest::Approx(1.0));
}

TEST_CASE("a tile is lit, of one caster or of several") {
    const LightExtent<float> light{Vec2<float>(1.0F, 1.0F), false};
    const Box3<float> tile = box(0.0F, 0.0F, 2.0F, 0.5F, 0.5F, 2.1F);
    const Box3<float> over = box(-0.1F, -0.1F, 1.0F, 0.1F, 0.1F, 1.0F), aside = box(4.0F, 0.0F, 1.0F, 5.0F, 1.0F, 1.0F),
                      below = box(-0.1F, -0.1F, 2.2F, 0.1F, 0.1F, 3.0F);
    CHECK(with_caster(TileClass::lit, aside, tile, light) == TileClass::lit);
    CHECK(with_caster(TileClass::lit, below, tile, light) == TileClass::lit);
    CHECK(with_caster(TileClass::lit, over, tile, light) == TileClass::single);
    CHECK(with_caster(TileClass::single, aside, tile, light) == TileClass::single);
    CHECK(with_caster(TileClass::single, over, tile, light) == TileClass::several);
    CHECK(with_caster(TileClass::several, aside, tile, light) == TileClass::several);
}

TEST_CASE_TEMPLATE("what is empty, behind the light or below receivers hides nothing", T, float, double) {
    const LightExtent<T> light{Vec2<T>(T(1), T(1)), false};
    const Box3<T> caster = box(T(-1), T(-1), T(1), T(1), T(1), T(1.5)),
                  ground = box(T(-5), T(-5), T(2), T(5), T(5), T(2));
    const Box3<T> behind = box(T(-1), T(-1), T(-2), T(1), T(1), T(-1)),
                  on_it = box(T(-1), T(-1), T(-2), T(1), T(1), T(0)), below = box(T(-1), T(-1), T(2), T(1), T(1), T(3)),
                  empty = empty_box<T>();
    for (const Box3<T>& none : {behind, on_it, below, empty}) {
        CHECK(is_empty(shadow_box(none, ground, light.half_size)));
        CHECK_FALSE(occlusion_limit(none, ground, light) > T(0));
        CHECK_FALSE(overlap_limit(none, caster, ground, light) > T(0));
        CHECK_FALSE(overlap_limit(caster, none, ground, light) > T(0));
        CHECK_FALSE(penumbra_width(none, ground, light.half_size) > T(0));
        CHECK(with_caster(TileClass::lit, none, ground, light) == TileClass::lit);
    }
    for (const Box3<T>& nowhere : {empty, behind, on_it}) {
        CHECK_FALSE(occlusion_limit(caster, nowhere, light) > T(0));
        CHECK_FALSE(penumbra_width(caster, nowhere, light.half_size) > T(0));
        CHECK(is_empty(shadow_box(caster, nowhere, light.half_size)));
    }
    CHECK_FALSE(light_share(empty_rect<T>(), light) > T(0));
}

TEST_CASE_TEMPLATE("limits are finite for any finite boxes", T, float, double) {
    test::Random random(5);
    const T values[] = {T(0), T(-1), T(1), T(1e-30), T(1e9), T(-1e9), T(1e12), T(1e-6)};
    const auto value = [&] { return values[random.whole(0, 7)]; };
    const auto any_box = [&] {
        Box3<T> b;
        for (int k = 0; k < 3; ++k) {
            const T x = value(), y = value();
            b.min[k] = std::min(x, y), b.max[k] = std::max(x, y);
        }
        return b;
    };
    for (int n = 0; n < 20000; ++n) {
        const Box3<T> a = any_box(), b = any_box(), receivers = any_box();
        const T x = std::abs(value()), y = std::abs(value());
        const bool disk = random.whole(0, 1) == 0;
        const LightExtent<T> light{Vec2<T>(x, disk ? x : y), disk};
        const T one = occlusion_limit(a, receivers, light), both = overlap_limit(a, b, receivers, light);
        const T width = penumbra_width(a, receivers, light.half_size);
        const bool good = is_finite(one) && is_finite(both) && is_finite(width) && one >= T(0) && one <= T(1) &&
                          both >= T(0) && both <= T(1) && width >= T(0);
        CAPTURE(n);
        CHECK(good);
    }
}
