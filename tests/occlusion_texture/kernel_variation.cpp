#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/occlusion_texture/kernel_variation.hpp>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <vector>

#include "../plan/random_scenes.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

using Sums = SummedArea<std::uint32_t>;

/// Rectangles, some of them holes, or noise.
Image<std::uint8_t> random_mask(test::Random& random, int width, int height) {
    Image<std::uint8_t> mask(width, height);
    if (random.whole(0, 3) == 0) {
        const int share = random.whole(0, 8);
        for (std::size_t i = 0; i < mask.size(); ++i) mask.data()[i] = random.whole(0, 7) < share ? 255 : 0;
        return mask;
    }
    for (int k = random.whole(1, 6); k > 0; --k) {
        const int x0 = random.whole(0, width - 1), x1 = random.whole(x0, width), y0 = random.whole(0, height - 1),
                  y1 = random.whole(y0, height);
        const std::uint8_t value = random.whole(0, 3) == 0 ? 0 : 255;
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) mask(x, y) = value;
    }
    return mask;
}

SliceCamera<double> random_camera(test::Random& random) {
    SliceCamera<double> camera;
    camera.convergence = random.whole(0, 2) == 0 ? 0.0 : random.in(0.0, 1.5);
    camera.width = random.whole(5, 90), camera.height = random.whole(5, 90);
    camera.origin_tx = Vec2<double>(camera.width * random.in(0.2, 0.8), camera.height * random.in(0.2, 0.8));
    camera.scale_tx = Vec2<double>(random.in(5.0, 60.0), random.in(5.0, 60.0));
    return camera;
}

/// How far a change lies out of what the trend allows for a step.
double excess(const detail::Trend<double>& trend, const Vec3<double>& step, double change) {
    double low = 0.0, high = 0.0;
    for (int k = 0; k < 3; ++k) {
        const auto& g = trend.gradient[static_cast<std::size_t>(k)];
        low += std::min(g.low * step[k], g.high * step[k]), high += std::max(g.low * step[k], g.high * step[k]);
    }
    return std::max(low - change, change - high);
}

/// A function that changes evenly.
struct Even {
    double at_zero;
    Vec3<double> gradient;

    double at(const Vec3<double>& x) const { return at_zero + glm::dot(gradient, x); }
    /// Over [−1, 1]³, with room to spare.
    detail::Trend<double> trend(double room) const {
        const double reach = std::abs(gradient.x) + std::abs(gradient.y) + std::abs(gradient.z);
        detail::Trend<double> result{{at_zero - reach - room, at_zero + reach + room}, {}};
        for (int k = 0; k < 3; ++k)
            result.gradient[static_cast<std::size_t>(k)] = {gradient[k] - room, gradient[k] + room};
        return result;
    }
};

OcclusionTextureOptions any_options(test::Random& random) {
    OcclusionTextureOptions options;
    options.resolution = random.whole(0, 1) == 0 ? 64 : 200;
    options.slices = random.whole(1, 12), options.light_cells = random.whole(1, 4);
    const SliceBlend blends[] = {SliceBlend::connected(), SliceBlend::scattered(), SliceBlend::disjoint(),
                                 SliceBlend::unknown()};
    options.blend = blends[random.whole(0, 3)];
    options.plane = random.whole(0, 1) == 0 ? SlicePlane::middle : SlicePlane::bottom;
    const SelfShadow modes[] = {SelfShadow::mean_depth, SelfShadow::mean_depth, SelfShadow::fade, SelfShadow::clear};
    options.self_shadow = modes[random.whole(0, 3)];
    options.self_shadow_bias = random.in(0.05F, 1.0F);
    return options;
}

}  // namespace

TEST_CASE("means over kernels change within the bounds of their gradients, whatever the mask holds") {
    test::Random random(11);
    int known = 0, changing = 0;
    double closest = 0.0;
    for (int n = 0; n < 6000; ++n) {
        const SliceCamera<double> camera = random_camera(random);
        const Sums mask(random_mask(random, camera.width, camera.height));
        const int cells = random.whole(1, 4);
        const Vec2<double> half_size(random.in(0.05, 1.0), random.in(0.05, 1.0));
        const bool moves = random.whole(0, 1) == 0;  // the plane, half as fast as the point
        const double top = random.in(0.0, 2.0), size = std::exp(random.in(-6.0, -1.0));
        const auto plane_of = [&](double p) { return moves ? (top + p) * 0.5 : top; };
        const Vec3<double> half = random.point(0.0, 1.0) * size;
        const Vec3<double> middle(random.in(-2.0, 2.0), random.in(-2.0, 2.0), top + half.z + random.in(0.05, 3.0));
        const Box3<double> box{middle - half, middle + half};
        const double slope = moves ? 0.5 : 0.0;
        const detail::KernelSweep<double> sweep(camera, {plane_of(box.min.z), plane_of(box.max.z)}, {slope, slope}, box,
                                                half_size, cells);
        if (sweep.is_far() || !sweep.is_known()) continue;
        ++known;
        const auto mean_at = [&](const Vec3<double>& point, int cell) {
            const Vec2<double> part = half_size * (2.0 / cells), corner(cell % cells, cell / cells);
            const Vec2<double> from = corner * part - half_size;
            return mask.mean(camera.footprint(plane_of(point.z), point, {from, from + part})) / 255.0;
        };
        std::vector<Vec3<double>> points;
        for (int i = 0; i < 10; ++i) {
            Vec3<double> at = random.point(-1.0, 1.0);
            for (int k = 0; k < 3 && i < 8; ++k) at[k] = (i >> k & 1) != 0 ? 1.0 : -1.0;
            points.push_back(middle + half * at);
        }
        double worst = 0.0, change = 0.0, outside = 0.0;
        sweep.visit(mask, [&](std::size_t cell, const detail::Trend<double>& trend) {
            std::vector<double> means;
            for (const Vec3<double>& p : points) means.push_back(mean_at(p, static_cast<int>(cell)));
            for (std::size_t i = 0; i < points.size(); ++i) {
                outside = std::max({outside, trend.value.low - means[i], means[i] - trend.value.high});
                for (std::size_t k = 0; k < i; ++k) {
                    const double by = means[i] - means[k];
                    worst = std::max(worst, excess(trend, points[i] - points[k], by));
                    change = std::max(change, std::abs(by));
                }
            }
        });
        const auto held = sweep.sides().held(mask);
        using Held = detail::KernelSides<double>::Held;
        CAPTURE(n);
        CHECK(worst <= 1e-9);
        CHECK(outside <= 1e-9);
        if (held != Held::some) CHECK(std::abs(mean_at(middle, 0) - (held == Held::all ? 1.0 : 0.0)) <= 1e-9);
        changing += change > 1e-3 ? 1 : 0;
        closest = std::max(closest, change > 1e-3 ? 1.0 + worst / change : 0.0);
    }
    CHECK(known > 2000);
    CHECK(changing > 1000);
    CHECK(closest > 0.99);  // some come as close as that to their bounds
}

TEST_CASE("occlusions of evenly changing slices combine within their bounds") {
    test::Random random(12);
    const Combination rules[] = {Combination::product, Combination::sum, Combination::max, Combination::mean};
    for (int n = 0; n < 4000; ++n) {
        const Combination rule = rules[n % 4];
        const double room = random.whole(0, 1) == 0 ? 0.0 : random.in(0.0, 0.05);
        std::vector<Even> slices;
        detail::OcclusionTrend<double> combined;
        for (int k = random.whole(1, 5); k > 0; --k) {
            slices.push_back({random.in(0.0, 1.0), random.point(-0.3, 0.3)});
            combined.add(slices.back().trend(room).at_least_zero().up_to_one(), rule);
        }
        const detail::Trend<double> trend = combined.result(rule);
        const auto at = [&](const Vec3<double>& x) {
            OcclusionAccumulator<double> all;
            for (const Even& slice : slices) all.add(saturate(slice.at(x)));
            return all.result(rule);
        };
        double worst = 0.0, outside = 0.0;
        for (int i = 0; i < 40; ++i) {
            const Vec3<double> a = random.point(-1.0, 1.0), b = random.point(-1.0, 1.0);
            worst = std::max(worst, excess(trend, b - a, at(b) - at(a)));
            outside = std::max({outside, trend.value.low - at(a), at(a) - trend.value.high});
        }
        CAPTURE(n);
        CHECK(worst <= 1e-12);
        CHECK(outside <= 1e-12);
    }
}

TEST_CASE("of a plain edge's penumbra nearly all is known") {
    // a quad with one edge across the light's middle, which covers half of what a point below it sees
    Mesh<double> quad = test::level_quad(Vec3<double>(-4.0, 0.0, 3.0), 4.0, 4.0);
    const RectLight<double> light{Vec3<double>(0.0, 0.0, 6.0), Vec3<double>(0.5, 0.0, 0.0),
                                  Vec3<double>(0.0, -0.5, 0.0)};
    for (const SliceBlend blend : {SliceBlend::connected(), SliceBlend::scattered(), SliceBlend::unknown()}) {
        OcclusionTextureOptions options;
        options.slices = 1, options.blend = blend;
        const OcclusionTextureShadow<double> shadow({quad}, light, options);
        const Vec3<double> half(0.04, 0.04, 0.02), middle = shadow.frame().to_light(Vec3<double>(0.0, 0.0, 0.0));
        const Variation<double> variation = shadow.variation({middle - half, middle + half}, 0.1);
        REQUIRE(variation.known);
        REQUIRE_FALSE(variation.lit);
        const auto at = [&](const Vec3<double>& step) {
            return shadow.visibility(shadow.frame().to_world(middle + step));
        };
        const Vec3<double> across = std::abs(variation.slope.x) > std::abs(variation.slope.y)
                                        ? Vec3<double>(half.x, 0.0, 0.0)
                                        : Vec3<double>(0.0, half.y, 0.0);
        const double change = at(across) - at(-across);
        CHECK(std::abs(change) > 0.05);
        CHECK(std::abs(glm::dot(variation.slope, across * 2.0) - change) < 0.1 * std::abs(change));
        CHECK(variation.change(variation.turned(across * 2.0)) < 0.15 * std::abs(change));
        const Vec3<double> along(across.y, across.x, 0.0);
        CHECK(variation.change(variation.turned(along * 2.0)) < 0.15 * std::abs(change));
    }
}

TEST_CASE("what is all lit or all dark does not change") {
    const Mesh<double> quad = test::level_quad(Vec3<double>(0.0, 0.0, 3.0), 2.0, 2.0);
    const RectLight<double> light{Vec3<double>(0.0, 0.0, 6.0), Vec3<double>(0.5, 0.0, 0.0),
                                  Vec3<double>(0.0, -0.5, 0.0)};
    for (const SelfShadow mode : {SelfShadow::mean_depth, SelfShadow::fade, SelfShadow::clear}) {
        OcclusionTextureOptions options;
        options.self_shadow = mode;
        const OcclusionTextureShadow<double> shadow({quad}, light, options);
        const Vec3<double> half(0.3, 0.3, 0.1);
        const auto around = [&](const Vec3<double>& point) {
            const Vec3<double> middle = shadow.frame().to_light(point);
            return shadow.variation({middle - half, middle + half}, 1e-6);
        };
        const Variation<double> dark = around(Vec3<double>(0.0, 0.0, 0.5));
        CHECK(dark.known);
        CHECK_FALSE(dark.lit);
        CHECK(dark.change(dark.turned(half)) <= 0.0);
        CHECK(around(Vec3<double>(7.0, 0.0, 0.5)).lit);
        CHECK(around(Vec3<double>(0.0, 0.0, 4.0)).lit);
    }
}

TEST_CASE("visibility changes by no more than the variation, by any option") {
    test::Random random(13);
    int known = 0, changing = 0, within = 0;
    for (std::uint32_t number = 1; number <= 400; ++number) {
        const test::PlanScene<double> scene = test::random_scene<double>(number);
        const OcclusionTextureShadow<double> shadow(scene.casters, scene.rect(), any_options(random));
        const std::vector<Vec3<double>> seen = test::seen_points(scene, 2 * number + 1, scene.center);
        for (int n = 0; n < 40; ++n) {
            const auto at = static_cast<std::size_t>(random.whole(0, static_cast<int>(seen.size()) - 1));
            const Vec3<double> middle = shadow.frame().to_light(seen[at]);
            const Vec3<double> half = random.point(0.0, 1.0) * std::exp(random.in(-8.0, -1.0));
            const Box3<double> box{middle - half, middle + half};
            if (!(box.min.z > 0.0)) continue;
            const Variation<double> variation = shadow.variation(box, 1e9);
            if (!variation.known) continue;
            ++known;
            std::array<Vec3<double>, 12> at_ls, at_ws;
            std::array<double, 12> v;
            for (std::size_t i = 0; i < at_ls.size(); ++i) {
                Vec3<double> share = random.point(-1.0, 1.0);
                for (int k = 0; k < 3 && i < 8; ++k) share[k] = (i >> k & 1) != 0 ? 1.0 : -1.0;
                at_ls[i] = middle + half * share * 0.999999, at_ws[i] = shadow.frame().to_world(at_ls[i]);
            }
            shadow.visibility(at_ws.data(), at_ws.size(), v.data());
            double worst = 0.0, change = 0.0;
            for (std::size_t i = 0; i < v.size(); ++i)
                for (std::size_t k = 0; k < i; ++k) {
                    const Vec3<double> step = at_ls[i] - at_ls[k];
                    const double by = v[i] - v[k], bound = variation.change(variation.turned(step));
                    worst = std::max(worst, std::abs(by - glm::dot(variation.slope, step)) - bound);
                    change = std::max(change, std::abs(by));
                }
            changing += change > 1e-3 ? 1 : 0;
            within += change > 1e-3 && middle.z < shadow.range().top(shadow.range().count) ? 1 : 0;
            CAPTURE(number);
            CAPTURE(n);
            CAPTURE(change);
            CHECK(worst <= 1e-5);  // full occlusion is rounded up by that, cell by cell
        }
    }
    CHECK(known > 3000);
    CHECK(changing > 300);
    CHECK(within > 30);  // points among slices
}
