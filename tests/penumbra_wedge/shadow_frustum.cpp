#include <doctest/doctest.h>

#include <penumbra/penumbra_wedge/shadow_frustum.hpp>

#include "support/random.hpp"

using namespace penumbra;

namespace {

using V = Vec3<double>;

V inside(test::Random& random, const Box3<double>& box) {
    return {random.in(box.min.x, box.max.x), random.in(box.min.y, box.max.y), random.in(box.min.z, box.max.z)};
}
Box3<double> random_box(test::Random& random, double nearest, double farthest) {
    Box3<double> box = empty_box<double>();
    for (int k = 0; k < 2; ++k)
        box = extend(box, V(random.in(-3.0, 3.0), random.in(-3.0, 3.0), random.in(nearest, farthest)));
    return box;
}

bool contains(const Box3<double>& box, const V& p) {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y && p.z >= box.min.z &&
           p.z <= box.max.z;
}
bool contains(const ShadowFrustum<double>& f, const V& p) {
    const double t = (p.z - f.near_depth) / (f.far_depth - f.near_depth);
    const Vec2<double> low = f.near.min * (1.0 - t) + f.far.min * t, high = f.near.max * (1.0 - t) + f.far.max * t;
    return t >= 0.0 && t <= 1.0 && p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
}

}  // namespace

TEST_CASE("a frustum holds every receiver from which something in the box lies before the light") {
    test::Random random(3);
    const Vec2<double> half(0.8, 0.3);
    int asked = 0, held = 0;
    for (int i = 0; i < 300; ++i) {
        const Box3<double> box = random_box(random, i % 10 == 0 ? -0.5 : 0.1, 4.0);
        const Box3<double> receivers{V(-9.0, -9.0, -1.0), V(9.0, 9.0, random.in(1.0, 6.0))};
        const ShadowFrustum<double> frustum = shadow_frustum(box, half, receivers);
        for (int k = 0; k < 200; ++k) {
            const V before = inside(random, box), at(random.in(-half.x, half.x), random.in(-half.y, half.y), 0.0);
            if (!(before.z > 0.0)) continue;
            const V point = before + (before - at) * random.in(0.0, 3.0);
            if (!contains(receivers, point)) continue;
            ++asked;
            if (is_empty(frustum) || !contains(frustum, point)) ++held;
        }
    }
    CHECK(asked > 5000);
    CHECK(held == 0);
}

TEST_CASE("a frustum is tight: its sides are where shadows of the box's corners end, and a margin") {
    const Box3<double> box{V(1.0, -0.5, 2.0), V(1.5, 0.5, 3.0)}, receivers{V(-9.0, -9.0, 0.0), V(9.0, 9.0, 8.0)};
    const ShadowFrustum<double> f = shadow_frustum(box, Vec2<double>(0.5, 0.25), receivers);
    const double margin = 8.0 / 1024.0, far = 8.0 + margin;
    CHECK(f.near_depth == 2.0);
    CHECK(f.far_depth == far);
    CHECK(f.near.max.x == doctest::Approx(1.5 + margin));
    CHECK(f.far.max.x == doctest::Approx((1.5 + 0.5) * far / 2.0 - 0.5 + margin));
    CHECK(f.far.min.x ==
          doctest::Approx((1.0 - 0.5) * far / 3.0 + 0.5 - margin));  // of the far end: away from the axis
    CHECK(f.far.min.y == doctest::Approx(-((0.5 + 0.25) * far / 2.0 - 0.25 + margin)));
}

TEST_CASE("a frustum is empty where no receiver lies beyond the box, and all receivers near the light's plane") {
    const Box3<double> receivers{V(-2.0, -3.0, 0.0), V(4.0, 5.0, 6.0)};
    const Vec2<double> half(0.5, 0.5);
    const auto at = [](double from, double to) { return Box3<double>{V(0.0, 0.0, from), V(1.0, 1.0, to)}; };
    CHECK(is_empty(shadow_frustum(at(6.0, 7.0), half, receivers)));
    CHECK(is_empty(shadow_frustum(at(-2.0, 0.0), half, receivers)));
    CHECK(is_empty(shadow_frustum(empty_box<double>(), half, receivers)));
    CHECK(is_empty(shadow_frustum(at(1.0, 2.0), half, empty_box<double>())));
    for (const double depth : {-1.0, 0.0, 6.0 / 4096.0}) {
        const ShadowFrustum<double> f = shadow_frustum(at(depth, 2.0), half, receivers);
        CHECK(f.near_depth == 0.0);
        CHECK(f.near.min == f.far.min);
        CHECK(f.far.max.y == doctest::Approx(5.0 + 6.0 / 1024.0));
    }
}

TEST_CASE("frusta that share a point may meet; those that are apart mostly do not") {
    test::Random random(4);
    const Box3<double> receivers{V(-9.0, -9.0, 0.0), V(9.0, 9.0, 6.0)};
    int missed = 0, apart = 0, said_apart = 0;
    for (int i = 0; i < 2000; ++i) {
        Box3<double> boxes[2];
        ShadowFrustum<double> f[2];
        for (int k = 0; k < 2; ++k) {
            const V low(random.in(-3.0, 3.0), random.in(-3.0, 3.0), random.in(1.0, 5.0));
            boxes[k] = {low, low + V(0.4, 0.4, 0.4)};
            f[k] = shadow_frustum(boxes[k], Vec2<double>(0.5, 0.5), receivers);
        }
        bool share = false;
        for (int k = 0; k < 200 && !share; ++k) {
            const double depth = random.in(f[0].near_depth, f[0].far_depth);
            const double t = (depth - f[0].near_depth) / (f[0].far_depth - f[0].near_depth);
            const Vec2<double> low = f[0].near.min * (1.0 - t) + f[0].far.min * t;
            const Vec2<double> high = f[0].near.max * (1.0 - t) + f[0].far.max * t;
            share = contains(f[1], V(random.in(low.x, high.x), random.in(low.y, high.y), depth));
        }
        if (share && !(may_meet(f[0], f[1]) && may_meet(f[1], f[0]))) ++missed;
        if (!share) ++apart;
        if (!share && !may_meet(f[0], f[1])) ++said_apart;
    }
    CHECK(missed == 0);
    CHECK(apart > 500);
    CHECK(said_apart > apart * 9 / 10);
}
