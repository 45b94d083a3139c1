#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <string>
#include <thread>
#include <vector>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

using Options = OcclusionTextureOptions;

constexpr SliceFilter filters[] = {SliceFilter::mipmap, SliceFilter::n_buffer, SliceFilter::summed_area};

/// A light of half-sides 1 and ½ at height 8 that emits down. Depth is 8 − y.
template <class T>
RectLight<T> light_above(T scale = T(1)) {
    return {Vec3<T>(T(0), T(8) * scale, T(0)), Vec3<T>(scale, T(0), T(0)), Vec3<T>(T(0), T(0), T(0.5) * scale)};
}

/// An axis-aligned rectangle at height y.
template <class T>
Mesh<T> quad(T y, const Rect2<T>& r) {
    return {{Vec3<T>(r.min.x, y, r.min.y), Vec3<T>(r.max.x, y, r.min.y), Vec3<T>(r.max.x, y, r.max.y),
             Vec3<T>(r.min.x, y, r.max.y)},
            {{0, 1, 2}, {0, 2, 3}}};
}

/// The kernel of a point of height 0 ≤ h < y on the plane of height y under light_above, from similar triangles.
Rect2<double> kernel_at(double y, const Vec3<double>& p) {
    const double s = (y - p.y) / (8.0 - p.y);
    return {{p.x * (1 - s) - s, p.z * (1 - s) - 0.5 * s}, {p.x * (1 - s) + s, p.z * (1 - s) + 0.5 * s}};
}

/// Exact occlusion of one horizontal rectangle.
double exact_occlusion(double y, const Rect2<double>& r, const Vec3<double>& p) {
    const Rect2<double> kernel = kernel_at(y, p);
    return area(intersect(kernel, r)) / area(kernel);
}

template <class T>
Mesh<T> random_triangles(std::uint32_t seed, int count) {
    test::Random random(seed);
    Mesh<T> mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3<T> at = random.point(T(-2), T(2)) + Vec3<T>(T(0), T(4), T(0));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        // multiples of 1/64, so that tests may move them far away without rounding
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(glm::round((at + random.point(T(-0.7), T(0.7))) * T(64)) / T(64));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

template <class T>
std::vector<Vec3<T>> random_points(std::uint32_t seed, int count) {
    test::Random random(seed);
    std::vector<Vec3<T>> points;
    for (int i = 0; i < count; ++i)
        points.push_back(
            glm::round(Vec3<T>(random.in(T(-4), T(4)), random.in(T(0), T(7)), random.in(T(-4), T(4))) * T(64)) / T(64));
    return points;
}

template <class T>
std::vector<T> query(const OcclusionTextureShadow<T>& shadow, const std::vector<Vec3<T>>& points) {
    std::vector<T> result(points.size(), T(-7));
    shadow.visibility(points.data(), points.size(), result.data());
    return result;
}

/// Every combination that the hard cases run through.
template <class Visit>
void every_option(Visit&& visit) {
    for (const SliceFilter filter : filters)
        for (const Combination rule : {Combination::product, Combination::sum, Combination::max, Combination::mean})
            for (const SelfShadow mode : {SelfShadow::fade, SelfShadow::clear, SelfShadow::mean_depth})
                for (const int variant : {0, 1, 2}) {
                    Options o;
                    o.filter = filter;
                    o.blend = {rule, variant == 1};
                    o.self_shadow = mode;
                    o.resolution = variant == 2 ? 1 : 61;
                    o.slices = variant == 1 ? 5 : 8;
                    o.light_cells = variant + 1;
                    o.plane = variant == 1 ? SlicePlane::bottom : SlicePlane::middle;
                    o.faces = variant == 2 ? SliceFaces::solid : SliceFaces::all;
                    o.projection = variant == 1 ? SliceProjection::orthographic : SliceProjection::perspective;
                    visit(o);
                }
}

template <class T>
void check_range(const OcclusionTextureShadow<T>& shadow, const std::vector<Vec3<T>>& points) {
    const std::vector<T> result = query(shadow, points);
    std::size_t outside = 0, worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!(result[i] >= T(0) && result[i] <= T(1))) ++outside, worst = i;
    CAPTURE(points[worst].x);
    CAPTURE(points[worst].y);
    CAPTURE(points[worst].z);
    CAPTURE(result[worst]);
    CHECK(outside == 0);
}

std::string message_of(const Options& options) {
    try {
        OcclusionTextureShadow<float>({}, light_above<float>(), options);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE_TEMPLATE("one rectangle parallel to the light: exact to the texel", T, float, double) {
    const Rect2<double> r{{-0.7, -0.9}, {0.8, 0.6}};
    const Mesh<T> caster = quad<T>(T(3), {Vec2<T>(r.min), Vec2<T>(r.max)});
    for (const SliceFilter filter : filters)
        for (const int cells : {1, 2, 3}) {
            Options o;
            o.filter = filter;
            o.light_cells = cells;
            const OcclusionTextureShadow<T> shadow({caster}, light_above<T>(), o);
            const Vec2<T> texel = T(1) / shadow.camera().scale_tx;
            double worst = 0.0;
            test::Random random(1);
            for (int i = 0; i < 3000; ++i) {
                const Vec3<double> p(random.in(-3.0, 3.0), random.in(0.0, 2.0), random.in(-3.0, 3.0));
                const Rect2<double> kernel = kernel_at(3.0, p);
                const double w = 1.0 + 5.0 * static_cast<double>(shadow.camera().convergence);
                // each side of the mask is off by half a texel at most, and of opposite sides both
                const double blur = w * (static_cast<double>(texel.x) / (kernel.max.x - kernel.min.x) +
                                         static_cast<double>(texel.y) / (kernel.max.y - kernel.min.y));
                const double error =
                    std::abs(static_cast<double>(shadow.visibility(Vec3<T>(p))) - (1.0 - exact_occlusion(3.0, r, p)));
                worst = std::max(worst, error - 1.01 * blur);
            }
            CAPTURE(cells);
            CAPTURE(static_cast<int>(filter));
            // on top: nothing for exact boxes, a few hundredths for the approximate ones (their own tests state them)
            CHECK(worst <= (filter == SliceFilter::summed_area ? 0.0 : filter == SliceFilter::n_buffer ? 0.06 : 0.31));
        }
}

TEST_CASE("the error falls with the resolution") {
    const Rect2<double> r{{-0.71, -0.93}, {0.83, 0.67}};
    double last = 1.0;
    for (const int resolution : {32, 128, 512}) {
        Options o;
        o.resolution = resolution;
        const OcclusionTextureShadow<double> shadow({quad(3.0, r)}, light_above<double>(), o);
        double sum = 0.0;
        test::Random random(2);
        for (int i = 0; i < 4000; ++i) {
            const Vec3<double> p(random.in(-2.0, 2.0), random.in(0.0, 2.0), random.in(-2.0, 2.0));
            const double error = shadow.visibility(p) - (1.0 - exact_occlusion(3.0, r, p));
            sum += error * error;
        }
        const double rmse = std::sqrt(sum / 4000);
        CAPTURE(resolution);
        CHECK(rmse < last / 2.5);  // four times the texels: a quarter of the error, less luck
        last = rmse;
    }
    CHECK(last < 0.003);
}

TEST_CASE("two rectangles: each rule is exact where its assumption holds") {
    Options o;
    o.slices = 2;
    o.light_cells = 1;
    // heights chosen so that each rectangle lies on its slice's middle plane or within 1/4 slice of it
    const Rect2<double> left{{-4.0, -4.0}, {-0.1, 4.0}}, right{{0.1, -4.0}, {4.0, 4.0}},
        inner{{-0.25, -0.2}, {0.25, 0.2}}, outer{{-2.0, -2.0}, {2.0, 2.0}};
    const auto visible = [&](const Mesh<double>& upper, const Mesh<double>& lower, Combination rule,
                             const Vec3<double>& p) {
        o.blend = {rule, false};
        return OcclusionTextureShadow<double>({upper, lower}, light_above<double>(), o).visibility(p);
    };
    // disjoint as seen from the axis: left half above, right half below
    const Vec3<double> p(0.0, 0.0, 0.0);
    const double disjoint = exact_occlusion(4.0, left, p) + exact_occlusion(3.9, right, p);
    CHECK(visible(quad(4.0, left), quad(3.9, right), Combination::sum, p) ==
          doctest::Approx(1 - disjoint).epsilon(0.02));
    CHECK(visible(quad(4.0, left), quad(3.9, right), Combination::max, p) > 1 - disjoint + 0.3);
    // the small one hides behind the large one
    CHECK(visible(quad(4.0, inner), quad(3.9, outer), Combination::max, p) == 0.0);
    CHECK(visible(quad(4.0, outer), quad(3.9, inner), Combination::max, p) == 0.0);
    // crossed stripes block independently
    const Rect2<double> across{{-4.0, -0.1}, {4.0, 0.1}}, along{{-0.2, -4.0}, {0.2, 4.0}};
    const double a = exact_occlusion(4.0, across, p), b = exact_occlusion(3.9, along, p);
    CHECK(visible(quad(4.0, across), quad(3.9, along), Combination::product, p) ==
          doctest::Approx((1 - a) * (1 - b)).epsilon(0.03));
}

TEST_CASE("splitting the light in cells tends to the truth where no rule is right") {
    // Three strips that overlap in part; truth by brute force over the light.
    const double heights[] = {4.5, 3.5, 2.5};
    const Rect2<double> strips[] = {{{-0.6, -2.0}, {0.1, 2.0}}, {{-0.2, -2.0}, {0.5, 0.1}}, {{-1.0, -0.1}, {0.3, 2.0}}};
    std::vector<Mesh<double>> casters;
    for (int k = 0; k < 3; ++k) casters.push_back(quad(heights[k], strips[k]));
    const auto truth = [&](const Vec3<double>& p) {
        int seen = 0;
        const int n = 256;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Vec3<double> q((i + 0.5) / n * 2 - 1, 8.0, (j + 0.5) / n - 0.5);
                bool blocked = false;
                for (int k = 0; k < 3; ++k) {
                    const double t = (heights[k] - p.y) / (q.y - p.y);
                    const Vec3<double> at = p + (q - p) * t;
                    blocked |= at.x > strips[k].min.x && at.x < strips[k].max.x && at.z > strips[k].min.y &&
                               at.z < strips[k].max.y;
                }
                seen += !blocked;
            }
        return static_cast<double>(seen) / (n * n);
    };
    std::vector<double> rmse;
    for (const int cells : {1, 2, 4, 8}) {
        Options o;
        o.light_cells = cells;
        o.slices = 64;  // the planes are the strips' own, near enough
        o.blend = {Combination::max, false};
        const OcclusionTextureShadow<double> shadow(casters, light_above<double>(), o);
        double sum = 0.0;
        test::Random random(3);
        for (int i = 0; i < 60; ++i) {
            const Vec3<double> p(random.in(-0.5, 0.5), 0.0, random.in(-0.5, 0.5));
            const double error = shadow.visibility(p) - truth(p);
            sum += error * error;
        }
        rmse.push_back(std::sqrt(sum / 60));
    }
    CAPTURE(rmse[0]);
    CAPTURE(rmse[3]);
    CHECK(rmse[1] < 0.75 * rmse[0]);
    CHECK(rmse[2] < 0.75 * rmse[1]);
    CHECK(rmse[3] < 0.75 * rmse[2]);
}

TEST_CASE_TEMPLATE("full and no occlusion are exact under every option", T, float, double) {
    const T far = T(40);
    const Mesh<T> wall = quad<T>(T(4), {Vec2<T>(-far, -far), Vec2<T>(far, far)});
    const Mesh<T> aside = quad<T>(T(4), {Vec2<T>(T(6), T(6)), Vec2<T>(T(7), T(7))});
    every_option([&](const Options& o) {
        // a wall of one texel: taps of the approximate filters reach over its border
        if (o.resolution == 1 && o.filter != SliceFilter::summed_area) return;
        CAPTURE(static_cast<int>(o.filter));
        CAPTURE(o.resolution);
        const OcclusionTextureShadow<T> dark({wall}, light_above<T>(), o), lit({aside}, light_above<T>(), o);
        for (const Vec3<T>& p :
             {Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(0.7), T(0.1), T(-0.3)), Vec3<T>(T(-1), T(1), T(1))}) {
            CHECK(dark.visibility(p) == T(0));
            CHECK(lit.visibility(p) == T(1));
        }
    });
}

TEST_CASE_TEMPLATE("results stay in range for random scenes under every option", T, float, double) {
    const Mesh<T> mesh = random_triangles<T>(4, 60);
    const auto points = random_points<T>(5, 500);
    every_option(
        [&](const Options& o) { check_range(OcclusionTextureShadow<T>({mesh}, light_above<T>(), o), points); });
}

TEST_CASE_TEMPLATE("single and batch queries agree bit for bit, in any order, from any thread", T, float, double) {
    const Mesh<T> mesh = random_triangles<T>(6, 12);  // few, so that blocks of points often hold some that see all
    const auto points = random_points<T>(7, 333);
    every_option([&](const Options& o) {
        const OcclusionTextureShadow<T> shadow({mesh}, light_above<T>(), o);
        const std::vector<T> batch = query(shadow, points);
        int different = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
#ifdef __FAST_MATH__  // vectorised and scalar divisions round differently there
            different += !(std::abs(shadow.visibility(points[i]) - batch[i]) <= T(2e-5));
#else
            different += shadow.visibility(points[i]) != batch[i];
#endif
        }
        CAPTURE(static_cast<int>(o.filter));
        CAPTURE(o.resolution);
        CHECK(different == 0);
    });

    const OcclusionTextureShadow<T> shadow({mesh}, light_above<T>());
    const std::vector<T> batch = query(shadow, points);
    std::vector<std::vector<T>> others(3);
    std::vector<std::thread> threads;
    for (auto& other : others) threads.emplace_back([&] { other = query(shadow, points); });
    for (auto& thread : threads) thread.join();
    for (const auto& other : others) CHECK(other == batch);
}

TEST_CASE_TEMPLATE("points on, behind and beyond the light's plane see all of it", T, float, double) {
    const OcclusionTextureShadow<T> shadow({random_triangles<T>(8, 60)}, light_above<T>());
    for (const T y : {T(8), T(8.001), T(9), T(1e6)})
        for (const T x : {T(0), T(0.3), T(5), T(1e6)}) CHECK(shadow.visibility(Vec3<T>(x, y, T(0))) == T(1));
    const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
#ifndef __FAST_MATH__  // there NaN and infinity do not exist
    for (const T bad : {nan, inf, -inf})
        for (int k = 0; k < 3; ++k) {
            Vec3<T> p(T(0), T(0), T(0));
            p[k] = bad;
            CHECK(shadow.visibility(p) == T(1));
        }
#endif
    (void)nan, (void)inf;
}

TEST_CASE_TEMPLATE("far points, huge points and points between slices stay in range", T, float, double) {
    std::vector<Vec3<T>> points;
    const T steps[] = {T(0), T(1e-30), T(1e-6), T(0.5), T(3), T(1e5), T(1e15)};
    for (const T x : steps)
        for (const T y : steps)
            for (const T sign : {T(-1), T(1)}) points.emplace_back(sign * x, T(8) - y, x);
    const Mesh<T> mesh = random_triangles<T>(9, 60);
    every_option([&](const Options& o) {
        const OcclusionTextureShadow<T> shadow({mesh}, light_above<T>(), o);
        check_range(shadow, points);
        std::vector<Vec3<T>> boundaries;
        for (int slice = 0; slice <= o.slices; ++slice)
            for (const T x : {T(-1), T(0), T(0.7)}) boundaries.emplace_back(x, T(8) - shadow.range().top(slice), x);
        check_range(shadow, boundaries);
    });
}

TEST_CASE_TEMPLATE("a surface does not shadow itself when it is flat", T, float, double) {
    const Mesh<T> floor = quad<T>(T(2), {Vec2<T>(T(-3), T(-3)), Vec2<T>(T(3), T(3))});
    const Mesh<T> roof = quad<T>(T(5), {Vec2<T>(T(-0.1), T(-0.1)), Vec2<T>(T(0.1), T(0.1))});
    for (const SelfShadow mode : {SelfShadow::clear, SelfShadow::mean_depth}) {
        Options o;
        o.self_shadow = mode;
        const OcclusionTextureShadow<T> shadow({floor, roof}, light_above<T>(), o);
        // `clear` starts to count at the slice's bottom, where the floor lies to within a rounding
        CHECK(shadow.visibility(Vec3<T>(T(2), T(2), T(2))) >= T(1) - T(1e-6));
        CHECK(shadow.visibility(Vec3<T>(T(0), T(2), T(0))) < T(0.999));  // the roof still shadows it
    }
}

TEST_CASE_TEMPLATE("an empty scene, and one behind the light, are fully lit", T, float, double) {
    const Vec3<T> p(T(0), T(0), T(0));
    Mesh<T> loose;
    loose.positions = {Vec3<T>(T(0), T(1), T(0))};
    const Mesh<T> behind = quad<T>(T(9), {Vec2<T>(T(-3), T(-3)), Vec2<T>(T(3), T(3))});
    CHECK(OcclusionTextureShadow<T>({}, light_above<T>()).visibility(p) == T(1));
    CHECK(OcclusionTextureShadow<T>({Mesh<T>(), loose}, light_above<T>()).visibility(p) == T(1));
    CHECK(OcclusionTextureShadow<T>({behind}, light_above<T>()).visibility(p) == T(1));
    CHECK(OcclusionTextureShadow<T>({}, light_above<T>()).bytes() == 0);
}

TEST_CASE_TEMPLATE("degenerate casters: edge-on, zero area, at the light, at the point, around the light", T, float,
                   double) {
    const Vec3<T> below(T(0), T(0), T(0));
    every_option([&](const Options& o) {
        const Mesh<T> edge_on{{Vec3<T>(T(0), T(5), T(0)), Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(0), T(3), T(1))},
                              {{0, 1, 2}}};
        const Mesh<T> needle{{Vec3<T>(T(0), T(5), T(0)), Vec3<T>(T(1), T(5), T(0)), Vec3<T>(T(2), T(5), T(0))},
                             {{0, 1, 2}}};
        const Mesh<T> dot{{Vec3<T>(T(0), T(5), T(0))}, {{0, 0, 0}}};
        const Mesh<T> in_plane = quad<T>(T(8), {Vec2<T>(T(-3), T(-3)), Vec2<T>(T(3), T(3))});
        const Mesh<T> through{{Vec3<T>(T(0), T(9), T(0)), Vec3<T>(T(-1), T(7), T(0)), Vec3<T>(T(1), T(7), T(0.5))},
                              {{0, 1, 2}}};
        for (const Mesh<T>& mesh : {edge_on, needle, dot, in_plane, through}) {
            const OcclusionTextureShadow<T> shadow({mesh}, light_above<T>(), o);
            check_range(shadow,
                        {below, Vec3<T>(T(0), T(5), T(0)), Vec3<T>(T(0), T(7.9999), T(0)), Vec3<T>(T(3), T(1), T(2))});
        }
        CHECK(OcclusionTextureShadow<T>({needle, dot}, light_above<T>(), o).visibility(below) == T(1));
        // on the point itself: between the limits "just above" (dark) and "just below" (lit)
        const Mesh<T> touching = quad<T>(T(0), {Vec2<T>(T(-3), T(-3)), Vec2<T>(T(3), T(3))});
        check_range(OcclusionTextureShadow<T>({touching}, light_above<T>(), o), {below});
    });
}

TEST_CASE_TEMPLATE("a light inside a closed caster is dark outside", T, float, double) {
    Mesh<T> room;
    for (unsigned i = 0; i < 8; ++i)
        room.positions.push_back(Vec3<T>((i & 1U) ? T(3) : T(-3), (i & 2U) ? T(11) : T(5), (i & 4U) ? T(3) : T(-3)));
    for (const auto& q :
         {std::array<unsigned, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
        room.triangles.emplace_back(q[0], q[1], q[2]);
        room.triangles.emplace_back(q[0], q[2], q[3]);
    }
    for (const SliceFaces faces : {SliceFaces::all, SliceFaces::solid, SliceFaces::facing}) {
        Options o;
        o.faces = faces;
        const OcclusionTextureShadow<T> shadow({room}, light_above<T>(), o);
        CHECK(shadow.visibility(Vec3<T>(T(0), T(0), T(0))) == T(0));
        CHECK(shadow.visibility(Vec3<T>(T(0), T(6), T(0))) == T(1));  // inside, with the light
    }
}

TEST_CASE_TEMPLATE("a light without size casts hard shadows", T, float, double) {
    const Rect2<T> r{Vec2<T>(T(-0.7), T(-0.9)), Vec2<T>(T(0.8), T(0.6))};
    const Vec3<T> zero(T(0), T(0), T(0));
    for (const Vec3<T>& side : {zero, Vec3<T>(T(1e-6), T(0), T(0))}) {
        const OcclusionTextureShadow<T> shadow({quad<T>(T(3), r)}, RectLight<T>{Vec3<T>(T(0), T(8), T(0)), side, zero});
        test::Random random(10);
        for (int i = 0; i < 2000; ++i) {
            const Vec3<T> p(random.in(T(-3), T(3)), T(0), random.in(T(-3), T(3)));
            const Vec2<T> at = Vec2<T>(p.x, p.z) * T(5.0 / 8.0);  // where the line to the light passes the caster
            const T nearest = std::min(std::min(std::abs(at.x - r.min.x), std::abs(at.x - r.max.x)),
                                       std::min(std::abs(at.y - r.min.y), std::abs(at.y - r.max.y)));
            if (nearest < T(0.02)) continue;  // three texels
            const bool hidden = at.x > r.min.x && at.x < r.max.x && at.y > r.min.y && at.y < r.max.y;
            CAPTURE(p.x);
            CAPTURE(p.z);
#ifdef __FAST_MATH__  // ends and width of a kernel of 1/16 texel round apart
            CHECK(std::abs(shadow.visibility(p) - (hidden ? T(0) : T(1))) < T(1e-4));
#else
            CHECK(shadow.visibility(p) == (hidden ? T(0) : T(1)));
#endif
        }
    }
}

TEST_CASE_TEMPLATE("a light larger than the scene is dimmed by little", T, float, double) {
    const RectLight<T> sky{Vec3<T>(T(0), T(8), T(0)), Vec3<T>(T(100), T(0), T(0)), Vec3<T>(T(0), T(0), T(100))};
    const OcclusionTextureShadow<T> shadow({quad<T>(T(3), {Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))})}, sky);
    // kernel 2 · 100 · 3/8 wide, caster 2: (2 / 75)²
    CHECK(static_cast<double>(shadow.visibility(Vec3<T>(T(0), T(0), T(0)))) ==
          doctest::Approx(1 - 4.0 / 5625).epsilon(1e-4));
}

TEST_CASE_TEMPLATE("scaling the scene by a power of two changes no bit", T, float, double) {
    const Mesh<T> mesh = random_triangles<T>(11, 80);
    const auto points = random_points<T>(12, 400);
    const std::vector<T> expected = query(OcclusionTextureShadow<T>({mesh}, light_above<T>()), points);
    for (const T scale : {T(1024), T(1.0 / 1024.0)}) {
        Mesh<T> scaled = mesh;
        auto there = points;
        for (Vec3<T>& p : scaled.positions) p *= scale;
        for (Vec3<T>& p : there) p *= scale;
        CHECK(query(OcclusionTextureShadow<T>({scaled}, light_above<T>(scale)), there) == expected);
    }
}

TEST_CASE_TEMPLATE("scenes scaled by 1e-3 and 1e3 differ by rounding only", T, float, double) {
    const Mesh<T> mesh = random_triangles<T>(11, 80);
    const auto points = random_points<T>(12, 400);
    const std::vector<T> expected = query(OcclusionTextureShadow<T>({mesh}, light_above<T>()), points);
    for (const T scale : {T(1e-3), T(1e3)}) {
        Mesh<T> scaled = mesh;
        auto there = points;
        for (Vec3<T>& p : scaled.positions) p *= scale;
        for (Vec3<T>& p : there) p *= scale;
        const std::vector<T> result = query(OcclusionTextureShadow<T>({scaled}, light_above<T>(scale)), there);
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            sum += static_cast<double>((result[i] - expected[i]) * (result[i] - expected[i]));
        CHECK(std::sqrt(sum / static_cast<double>(points.size())) < 2e-3);  // a few mask texels flip
    }
}

TEST_CASE_TEMPLATE("moving the scene far away changes no bit, where the move itself does not round", T, float, double) {
    const Mesh<T> mesh = random_triangles<T>(13, 80);
    const auto points = random_points<T>(14, 400);
    const std::vector<T> expected = query(OcclusionTextureShadow<T>({mesh}, light_above<T>()), points);
    const Vec3<T> offset(T(131072), T(-65536), T(98304));  // coordinates are multiples of 1/64: exact in float
    Mesh<T> moved = mesh;
    auto there = points;
    for (Vec3<T>& p : moved.positions) p += offset;
    for (Vec3<T>& p : there) p += offset;
    RectLight<T> light = light_above<T>();
    light.center += offset;
    CHECK(query(OcclusionTextureShadow<T>({moved}, light), there) == expected);
}

TEST_CASE("bad arguments are reported by name and value") {
    const auto with = [](auto&& change) {
        Options o;
        change(o);
        return message_of(o);
    };
    CHECK(with([](Options& o) { o.slices = 0; }) == "penumbra: options.slices = 0 is not in [1, 64]");
    CHECK(with([](Options& o) { o.slices = 65; }) == "penumbra: options.slices = 65 is not in [1, 64]");
    CHECK(with([](Options& o) { o.resolution = 0; }) == "penumbra: options.resolution = 0 is not in [1, 16384]");
    CHECK(with([](Options& o) { o.light_cells = 9; }) == "penumbra: options.light_cells = 9 is not in [1, 8]");
    CHECK(with([](Options& o) { o.self_shadow_bias = 0.0F; }) ==
          "penumbra: options.self_shadow_bias = 0 is not in [0.001, 1]");
    CHECK(with([](Options&) {}).empty());

    using Shadow = OcclusionTextureShadow<float>;
    Mesh<float> mesh = quad<float>(3.0F, {Vec2<float>(-1.0F), Vec2<float>(1.0F)});
    mesh.triangles[1].y = 9;
    CHECK_THROWS_WITH_AS(Shadow({mesh}, light_above<float>()),
                         "penumbra: casters[0].triangles[1] uses index 9, but there are 4 positions",
                         std::invalid_argument);
    RectLight<float> skewed = light_above<float>();
    skewed.half_v.x = 1.0F;
    CHECK_THROWS_AS(Shadow({}, skewed), std::invalid_argument);
#ifndef __FAST_MATH__
    RectLight<float> broken = light_above<float>();
    broken.center.y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(Shadow({}, broken), std::invalid_argument);
#endif
}
