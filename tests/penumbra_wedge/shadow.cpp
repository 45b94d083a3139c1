#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <penumbra/reference/embree.hpp>
#include <string>
#include <thread>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/error_of.hpp"
#include "support/polygon_area.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

constexpr OverlapRule rules[] = {
    OverlapRule::additive,          OverlapRule::maximum,    OverlapRule::product,
    OverlapRule::product_quadrants, OverlapRule::rectangles, OverlapRule::rectangles_centroid,
    OverlapRule::rectangle_product, OverlapRule::bitmask,    OverlapRule::exact};
constexpr SilhouetteFrom views[] = {SilhouetteFrom::light_center, SilhouetteFrom::point};

PenumbraWedgeOptions with(OverlapRule rule, int size = 32, SilhouetteFrom from = SilhouetteFrom::point) {
    return {rule, size, from};
}

/// Emits along −y, as lamps do.
template <class T>
RectLight<T> lamp(T height, T half_u, T half_v) {
    return {Vec3<T>(T(0), height, T(0)), Vec3<T>(half_u, T(0), T(0)), Vec3<T>(T(0), T(0), half_v)};
}

template <class T>
Mesh<T> quad(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& d) {
    return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

template <class T>
Mesh<T> ball(const Vec3<T>& center, T radius, int level = 3) {
    Mesh<T> mesh = test::icosphere<T>(level);
    for (Vec3<T>& p : mesh.positions) p = p * radius + center;
    return mesh;
}

template <class T>
std::vector<Vec3<T>> points_on_ground(int count, std::uint32_t seed, T reach = T(4)) {
    test::Random random(seed);
    std::vector<Vec3<T>> points;
    for (int i = 0; i < count; ++i) points.emplace_back(random.in(-reach, reach), T(0), random.in(-reach, reach));
    return points;
}

template <class T>
std::vector<T> shade(const PenumbraWedgeShadow<T>& shadow, const std::vector<Vec3<T>>& points) {
    std::vector<T> result(points.size());
    shadow.visibility(points.data(), points.size(), result.data());
    return result;
}

std::vector<float> trace(const std::vector<Mesh<float>>& casters, const RectLight<float>& light,
                         const std::vector<Vec3<float>>& points, int rays = 4096) {
    const reference::Scene scene(casters);
    reference::SampleOptions options;
    options.samples = rays;
    options.sampler = reference::Sampler::stratified;
    std::vector<float> result(points.size());
    scene.visibility(points.data(), points.size(), light, options, result.data());
    return result;
}

double rmse(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<Mesh<float>> many_balls() {
    std::vector<Mesh<float>> balls;
    for (int i = 0; i < 49; ++i)
        balls.push_back(
            ball<float>(Vec3<float>(static_cast<float>(i % 7 - 3), 1.5F, static_cast<float>(i / 7 - 3)), 0.36F));
    return balls;
}

std::vector<Mesh<float>> standing_boxes() {
    test::Random random(11);
    std::vector<Mesh<float>> boxes;
    for (int i = 0; i < 25; ++i) {
        const Vec3<float> half(random.in(0.12F, 0.4F), random.in(0.1F, 1.1F), random.in(0.12F, 0.4F));
        boxes.push_back(test::box_mesh<float>(
            Vec3<float>(static_cast<float>(i % 5) * 1.2F - 2.4F, half.y, static_cast<float>(i / 5) * 1.2F - 2.4F),
            half));
    }
    return boxes;
}

}  // namespace

TEST_CASE_TEMPLATE("a planar caster: exact, by every rule", T, float, double) {
    const RectLight<double> light = lamp(6.0, 0.8, 0.5);
    test::Random random(1);
    double worst = 0.0;
    for (int k = 0; k < 30; ++k) {
        std::vector<glm::dvec3> corners;
        for (int i = 0; i < 3; ++i)
            corners.push_back(Vec3<double>(Vec3<float>(random.point(-1.5, 1.5) + Vec3<double>(0, 3.2, 0))));
        const Mesh<T> mesh{{Vec3<T>(corners[0]), Vec3<T>(corners[1]), Vec3<T>(corners[2])}, {{0, 1, 2}}};
        for (const OverlapRule rule : rules) {
            const PenumbraWedgeShadow<T> shadow({mesh}, lamp(T(6), static_cast<T>(0.8), T(0.5)), with(rule));
            for (int i = 0; i < 20; ++i) {
                const Vec3<T> point = static_cast<Vec3<T>>(random.point(-2.0, 2.0) * Vec3<double>(1, 0.7, 1));
                const double truth = test::exact_visibility(Vec3<double>(point), light, {corners});
                worst = std::max(worst, std::abs(static_cast<double>(shadow.visibility(point)) - truth));
            }
        }
    }
    CHECK(worst < (std::is_same_v<T, float> ? 2e-5 : 1e-6));  // of exact_visibility's own near plane
}

TEST_CASE("several planar casters: their union exactly, and nearly by masks") {
    const RectLight<double> light = lamp(6.0, 1.0, 1.0);
    test::Random random(2);
    double squares = 0.0, worst = 0.0, worst_exact = 0.0;
    int asked = 0;
    for (int k = 0; k < 60; ++k) {
        std::vector<test::Polygon3> polygons;
        std::vector<Mesh<float>> meshes;
        for (int m = 0; m < 5; ++m) {
            const Vec3<double> center = random.point(-1.0, 1.0) + Vec3<double>(0, 3, 0);
            test::Polygon3 corners;
            for (int i = 0; i < 3; ++i) corners.push_back(Vec3<double>(Vec3<float>(center + random.point(-0.8, 0.8))));
            meshes.push_back(
                {{Vec3<float>(corners[0]), Vec3<float>(corners[1]), Vec3<float>(corners[2])}, {{0, 1, 2}}});
            polygons.push_back(corners);
        }
        const PenumbraWedgeShadow<float> exact(meshes, lamp(6.0F, 1.0F, 1.0F));
        const PenumbraWedgeShadow<float> masks(meshes, lamp(6.0F, 1.0F, 1.0F), with(OverlapRule::bitmask));
        for (const Vec3<float>& point : points_on_ground<float>(40, static_cast<std::uint32_t>(k), 2.0F)) {
            const double truth = test::exact_visibility(Vec3<double>(point), light, polygons);
            const double error = static_cast<double>(masks.visibility(point)) - truth;
            worst_exact = std::max(worst_exact, std::abs(static_cast<double>(exact.visibility(point)) - truth));
            squares += error * error, worst = std::max(worst, std::abs(error)), ++asked;
        }
    }
    const double error = std::sqrt(squares / asked);
    MESSAGE("exact: worst ", worst_exact, "; masks: RMSE ", error, ", worst ", worst);
    CHECK(worst_exact < 1e-5);
    CHECK(error < .002);
    CHECK(worst < .02);
}

TEST_CASE("solids against ray tracing, small and large lights: RMSE at most .006") {
    for (const bool boxes : {false, true}) {
        const std::vector<Mesh<float>> casters = boxes ? standing_boxes() : many_balls();
        for (const float size : {0.2F, 1.5F, 5.0F}) {
            const RectLight<float> light = lamp(8.0F, size, size);
            std::vector<Vec3<float>> points = points_on_ground<float>(400, 3);
            test::Random random(4);
            const reference::Scene scene(casters);
            for (int i = 0; i < 400; ++i) {  // on casters, seen from above
                const auto hit = scene.closest_hit(Vec3<float>(random.in(-3.0F, 3.0F), 7.0F, random.in(-3.0F, 3.0F)),
                                                   Vec3<float>(random.in(-0.5F, 0.5F), -1, random.in(-0.5F, 0.5F)));
                if (hit) points.push_back(hit->point);
            }
            const PenumbraWedgeShadow<float> shadow(casters, light);
            const double error = rmse(shade(shadow, points), trace(casters, light, points, 1024));
            MESSAGE((boxes ? "boxes" : "balls"), ", light half-size ", size, ": RMSE ", error);
            CHECK(error < .006);
        }
    }
}

TEST_CASE("concave solids and open sheets against ray tracing") {
    Mesh<float> ring = test::torus_mesh<float>(32, 16), open = ball<float>(Vec3<float>(0, 1.5F, 0), 1.0F);
    for (Vec3<float>& p : ring.positions) p = Vec3<float>(p.x, p.z + p.y * 0.7F, p.y) + Vec3<float>(0, 1.6F, 0);
    open.triangles.resize(open.triangles.size() / 2);
    const RectLight<float> light = lamp(6.0F, 1.0F, 1.0F);
    for (const Mesh<float>& mesh : {ring, open}) {
        const std::vector<Vec3<float>> points = points_on_ground<float>(400, 5, 2.5F);
        const double error =
            rmse(shade(PenumbraWedgeShadow<float>({mesh}, light), points), trace({mesh}, light, points, 1024));
        CHECK(error < .006);
    }
}

TEST_CASE("the paper's settings: blending is thrice as right as plain wedges where silhouettes overlap") {
    std::vector<Mesh<float>> casters = many_balls(), above = many_balls();
    for (Mesh<float>& mesh : above) {
        for (Vec3<float>& p : mesh.positions) p += Vec3<float>(0.2F, 1.2F, 0.15F);
        casters.push_back(mesh);
    }
    const RectLight<float> light = lamp(8.0F, 1.0F, 1.0F);
    const std::vector<Vec3<float>> points = points_on_ground<float>(600, 6, 3.0F);
    const std::vector<float> truth = trace(casters, light, points, 1024);
    const auto error = [&](OverlapRule rule) {
        const auto options = with(rule, 32, SilhouetteFrom::light_center);
        return rmse(shade(PenumbraWedgeShadow<float>(casters, light, options), points), truth);
    };
    const double plain = error(OverlapRule::additive), blended = error(OverlapRule::rectangles);
    const double centroid = error(OverlapRule::rectangles_centroid), product = error(OverlapRule::rectangle_product);
    MESSAGE("plain ", plain, ", rectangles ", blended, ", centroid ", centroid, ", product ", product);
    CHECK(3.0 * blended < plain);
    CHECK(3.0 * centroid < plain);
    CHECK(3.0 * product < plain);
}

TEST_CASE_TEMPLATE("full and no occlusion are exactly 0 and 1; everything is in [0, 1]", T, float, double) {
    const std::vector<Mesh<T>> casters = {ball<T>(Vec3<T>(T(0), T(2), T(0)), T(1)),
                                          quad<T>(Vec3<T>(T(2), T(1), T(-1)), Vec3<T>(T(3), T(1.1), T(-1)),
                                                  Vec3<T>(T(3), T(1), T(1)), Vec3<T>(T(2), T(1), T(1)))};
    const RectLight<T> light = lamp(T(6), T(0.3), T(0.3));
    for (const OverlapRule rule : rules) {
        for (const SilhouetteFrom from : views) {
            const PenumbraWedgeShadow<T> shadow(casters, light, with(rule, 16, from));
            CAPTURE(static_cast<int>(rule));
            CHECK(shadow.visibility(Vec3<T>(T(0), T(0), T(0))) == T(0));
            CHECK(shadow.visibility(Vec3<T>(T(2.9), T(0), T(0))) == T(0));
            CHECK(shadow.visibility(Vec3<T>(T(-4), T(0), T(0))) == T(1));
            CHECK(shadow.visibility(Vec3<T>(T(0), T(4), T(0))) == T(1));
            for (const T v : shade(shadow, points_on_ground<T>(500, 7))) CHECK((v >= T(0) && v <= T(1)));
        }
    }
}

TEST_CASE("batches of any size give what single points give") {
    const PenumbraWedgeShadow<float> shadow(standing_boxes(), lamp(8.0F, 1.0F, 1.0F));
    const std::vector<Vec3<float>> points = points_on_ground<float>(300, 8);
    const std::vector<float> all = shade(shadow, points);
    int different = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        different += std::abs(all[i] - shadow.visibility(points[i])) > 2e-6F;
    CHECK(different == 0);
    std::vector<float> from_threads(points.size());
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
        threads.emplace_back([&, t] { shadow.visibility(&points[t * 75], 75, &from_threads[t * 75]); });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(std::abs(all[i] - from_threads[i]) <= 2e-6F);
}

TEST_CASE_TEMPLATE("scaling by a power of two changes no bit", T, float, double) {
    for (const int exponent : {-10, 10, 40}) {
        const T scale = std::ldexp(T(1), exponent);
        std::vector<Mesh<T>> casters = {
            ball<T>(Vec3<T>(T(0.2), T(1.4), T(0)), T(0.8), 2),
            test::box_mesh<T>(Vec3<T>(T(1), T(0.5), T(1)), Vec3<T>(T(0.4), T(0.5), T(0.3)))};
        RectLight<T> light = lamp(T(6), T(1), T(0.7));
        std::vector<Vec3<T>> points = points_on_ground<T>(200, 9);
        const std::vector<T> before = shade(PenumbraWedgeShadow<T>(casters, light), points);
        for (Mesh<T>& mesh : casters)
            for (Vec3<T>& p : mesh.positions) p *= scale;
        light.center *= scale, light.half_u *= scale, light.half_v *= scale;
        for (Vec3<T>& p : points) p *= scale;
        CHECK(shade(PenumbraWedgeShadow<T>(casters, light), points) == before);
    }
}

TEST_CASE("rotated, mirrored and far away: the same to rounding") {
    const std::vector<Mesh<float>> casters = standing_boxes();
    const RectLight<float> light = lamp(8.0F, 1.0F, 1.0F);
    const std::vector<Vec3<float>> points = points_on_ground<float>(400, 10);
    const std::vector<float> before = shade(PenumbraWedgeShadow<float>(casters, light), points);
    const auto error = [&](auto&& move, bool mirrors) {
        std::vector<Mesh<float>> moved = casters;
        for (Mesh<float>& mesh : moved) {
            for (Vec3<float>& p : mesh.positions) p = move(p);
            if (mirrors)
                for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
        }
        const Vec3<float> origin = move(Vec3<float>(0, 0, 0));
        RectLight<float> lamp_there{move(light.center), move(light.half_u) - origin, move(light.half_v) - origin};
        if (mirrors) std::swap(lamp_there.half_u, lamp_there.half_v);
        std::vector<Vec3<float>> there;
        for (const Vec3<float>& p : points) there.push_back(move(p));
        return rmse(shade(PenumbraWedgeShadow<float>(moved, lamp_there), there), before);
    };
    CHECK(
        error([](const Vec3<float>& p) { return Vec3<float>(0.6F * p.x + 0.8F * p.z, p.y, -0.8F * p.x + 0.6F * p.z); },
              false) < 1e-4);
    CHECK(error([](const Vec3<float>& p) { return Vec3<float>(-p.x, p.y, p.z); }, true) < 1e-4);
    // at 1e5 an ULP is .008: some points come to lie on the other side of a wall
    CHECK(error([](const Vec3<float>& p) { return p + Vec3<float>(1e5F, 1e5F, 1e5F); }, false) < 0.08);
}

TEST_CASE("two halves that touch have no seam; coincident casters are one") {
    const RectLight<float> light = lamp(6.0F, 1.0F, 1.0F);
    test::Random random(12);
    for (int k = 0; k < 50; ++k) {
        const float x = random.in(-0.5F, 0.5F), tilt = random.in(-0.4F, 0.4F);
        const Vec3<float> low(x + tilt, 3, -3), high(x - tilt, 3, 3);
        const Mesh<float> left = quad<float>({-3, 3, -3}, low, high, {-3, 3, 3});
        const Mesh<float> right = quad<float>(low, {3, 3, -3}, {3, 3, 3}, high);
        for (const OverlapRule rule : {OverlapRule::additive, OverlapRule::bitmask, OverlapRule::exact}) {
            const PenumbraWedgeShadow<float> shadow({left, right}, light, with(rule));
            const float most =
                rule == OverlapRule::bitmask ? 0.25F / (32 * 32) : 1e-6F;  // what masks are not asked for
            for (const Vec3<float>& point : points_on_ground<float>(20, static_cast<std::uint32_t>(k), 0.9F))
                CHECK(shadow.visibility(point) <= most);
        }
        const PenumbraWedgeShadow<float> once({left}, light), twice({left, left}, light);
        for (const Vec3<float>& point : points_on_ground<float>(20, static_cast<std::uint32_t>(k), 2.0F))
            CHECK(std::abs(twice.visibility(point) - once.visibility(point)) < 4e-6F);
    }
}

TEST_CASE("points on casters: their own face hides nothing, the solid behind it does") {
    const std::vector<Mesh<float>> casters = {ball<float>(Vec3<float>(0, 2, 0), 1.0F, 4)};
    const RectLight<float> light = lamp(8.0F, 0.5F, 0.5F);
    const reference::Scene scene(casters);
    std::vector<Vec3<float>> points;
    test::Random random(13);
    for (int i = 0; i < 1000; ++i) {
        const Vec3<float> from = random.point(-4.0F, 4.0F) + Vec3<float>(0, 2, 0);
        if (const auto hit = scene.closest_hit(from, Vec3<float>(0, 2, 0) + random.point(-0.5F, 0.5F) - from))
            points.push_back(hit->point);
    }
    REQUIRE(points.size() > 700);
    const std::vector<float> truth = trace(casters, light, points, 1024);
    for (const SilhouetteFrom from : views) {
        const std::vector<float> got =
            shade(PenumbraWedgeShadow<float>(casters, light, with(OverlapRule::bitmask, 32, from)), points);
        double worst = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<double>(got[i]) - static_cast<double>(truth[i])));
        CAPTURE(static_cast<int>(from));
        CHECK(rmse(got, truth) < (from == SilhouetteFrom::point ? .003 : .04));
        if (from == SilhouetteFrom::point) CHECK(worst < 0.05);
    }
}

TEST_CASE_TEMPLATE("hard cases have documented limits", T, float, double) {
    const Mesh<T> box = test::box_mesh<T>(Vec3<T>(T(0), T(2), T(0)), Vec3<T>(T(1), T(0.5), T(1)));
    const RectLight<T> light = lamp(T(6), T(0.5), T(0.5));
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    constexpr T big = std::numeric_limits<T>::max();
    for (const OverlapRule rule : rules) {
        for (const SilhouetteFrom from : views) {
            const auto options = with(rule, 8, from);
            const PenumbraWedgeShadow<T> shadow({box}, light, options);
            CHECK(shadow.visibility(Vec3<T>(T(0), T(6), T(0))) == T(1));  // on the light's plane
            CHECK(shadow.visibility(Vec3<T>(T(0), T(9), T(0))) == T(1));  // behind it
            CHECK(shadow.visibility(Vec3<T>(nan, T(0), T(0))) == T(1));
            CHECK(shadow.visibility(Vec3<T>(T(0), -inf, T(0))) == T(1));
            const T far = shadow.visibility(Vec3<T>(T(0), -big, big));
            CHECK((far >= T(0) && far <= T(1)));
            CHECK(shadow.visibility(Vec3<T>(T(0), T(2), T(0))) == T(0));  // inside the caster
            const PenumbraWedgeShadow<T> empty({}, light, options), no_faces({Mesh<T>{}}, light, options);
            CHECK(empty.visibility(Vec3<T>(T(0), T(0), T(0))) == T(1));
            CHECK(no_faces.visibility(Vec3<T>(T(0), T(0), T(0))) == T(1));
            // no size: a hard shadow; huge: nothing but finite
            const PenumbraWedgeShadow<T> hard({box}, lamp(T(6), T(0), T(0)), options);
            CHECK(hard.visibility(Vec3<T>(T(1.4), T(0), T(0))) == T(0));
            CHECK(hard.visibility(Vec3<T>(T(1.9), T(0), T(0))) == T(1));
            const PenumbraWedgeShadow<T> line({box}, lamp(T(6), T(1), T(0)), options);
            const T in_penumbra = line.visibility(Vec3<T>(T(1.6), T(0), T(0)));
            CHECK((in_penumbra > T(0) && in_penumbra < T(1)));
            const PenumbraWedgeShadow<T> sky({box}, lamp(T(6), T(1e4), T(1e4)), options);
            CHECK(sky.visibility(Vec3<T>(T(0), T(0), T(0))) > T(0.99));
        }
    }
}

TEST_CASE_TEMPLATE("the light inside a solid is hidden from outside, and seen from inside", T, float, double) {
    const Mesh<T> room = test::box_mesh<T>(Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(4), T(4), T(4)));
    const Mesh<T> lampshade = test::box_mesh<T>(Vec3<T>(T(0), T(6), T(0)), Vec3<T>(T(1), T(0.5), T(1)));
    const RectLight<T> light = lamp(T(6), T(0.5), T(0.5));
    CHECK(PenumbraWedgeShadow<T>({room}, light).visibility(Vec3<T>(T(1), T(0), T(1))) == T(1));
    CHECK(PenumbraWedgeShadow<T>({room}, light).visibility(Vec3<T>(T(1), T(-2), T(1))) == T(0));
    CHECK(PenumbraWedgeShadow<T>({lampshade}, light).visibility(Vec3<T>(T(1), T(0), T(1))) == T(0));
    CHECK(PenumbraWedgeShadow<T>({room, lampshade}, light).visibility(Vec3<T>(T(1), T(0), T(1))) == T(0));
}

TEST_CASE("a caster more never brightens, by rules that keep no places; by others hardly") {
    const std::vector<Mesh<float>> all = standing_boxes();
    const RectLight<float> light = lamp(8.0F, 1.5F, 1.5F);
    const std::vector<Vec3<float>> points = points_on_ground<float>(150, 14, 3.0F);
    for (const OverlapRule rule : rules) {
        const bool exact = rule == OverlapRule::additive || rule == OverlapRule::maximum || rule == OverlapRule::exact;
        const float slack = exact                                                                    ? 1e-6F
                            : rule == OverlapRule::product || rule == OverlapRule::product_quadrants ? 2e-6F
                            : rule == OverlapRule::bitmask
                                ? 0.02F
                                : 0.05F;  // another order of casters; masks: some of 256 cells
        std::vector<float> before(points.size(), 1.0F);
        for (std::size_t n = 1; n <= all.size(); n += 4) {
            const std::vector<Mesh<float>> casters(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n));
            const std::vector<float> now = shade(PenumbraWedgeShadow<float>(casters, light, with(rule, 16)), points);
            CAPTURE(static_cast<int>(rule));
            for (std::size_t i = 0; i < points.size(); ++i) CHECK(now[i] <= before[i] + slack);
            before = now;
        }
    }
}

TEST_CASE("bad arguments are reported by name and value") {
    const Mesh<float> good = test::box_mesh<float>({0, 2, 0}, {1, 1, 1});
    const RectLight<float> light = lamp(6.0F, 1.0F, 1.0F);
    Mesh<float> bad = good;
    bad.positions[3].x = std::numeric_limits<float>::quiet_NaN();
    PenumbraWedgeOptions options;
    options.bitmask_size = 12;
    using Shadow = PenumbraWedgeShadow<float>;
    CHECK(test::error_of([&] { Shadow({good, bad}, light); }).find("casters[1].positions[3]") != std::string::npos);
    CHECK(test::error_of([&] { Shadow({good}, light, options); }).find("options.bitmask_size = 12") !=
          std::string::npos);
    CHECK(test::error_of([&] {
              Shadow({good}, {{0, 6, 0}, {1, 0, 0}, {1, 0, 1}});
          }).find("light.half_u") != std::string::npos);
}
