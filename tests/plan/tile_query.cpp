#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/plan/planned_shadow.hpp>
#include <penumbra/plan/tile_query.hpp>
#include <string>
#include <vector>

#include "plan/random_scenes.hpp"
#include "support/box_mesh.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

/// What is seen of how visibility changes in boxes.
struct Seen {
    int known = 0, lit = 0, changing = 0;
    double closest = 0.0;  ///< of the bound that was reached
};

/// Points of small boxes around receivers see no more change than the shadow says there may be.
template <class Shadow>
void check_variation(const Shadow& shadow, const std::vector<Vec3<double>>& points, test::Random& random, Seen& seen) {
    constexpr std::size_t samples = 24;
    for (int n = 0; n < 24; ++n) {
        const std::size_t at = static_cast<std::size_t>(random.whole(0, static_cast<int>(points.size()) - 1));
        const Vec3<double> middle = shadow.frame().to_light(points[at]);
        const double size = std::exp(random.in(-7.0, -0.5));
        Vec3<double> half = random.point(0.0, 1.0) * size;
        const int flat = random.whole(0, 3);
        if (flat < 3) half[flat] = 0.0;
        const Box3<double> box{middle - half, middle + half};
        if (!(box.min.z > 0.0)) continue;
        const Variation<double> variation = shadow.variation(box, n % 2 == 0 ? 0.2 : 1e9);
        if (!variation.known) continue;
        ++seen.known, seen.lit += variation.lit ? 1 : 0;
        std::vector<Vec3<double>> at_ls, at_ws;
        for (std::size_t i = 0; i < samples; ++i) {
            Vec3<double> share = random.point(-1.0, 1.0);
            for (int k = 0; k < 3 && i < 8; ++k) share[k] = (i >> k & 1) != 0 ? 1.0 : -1.0;
            at_ls.push_back(middle + half * share * 0.999999);
            at_ws.push_back(shadow.frame().to_world(at_ls.back()));
        }
        std::vector<double> v(samples);
        shadow.visibility(at_ws.data(), samples, v.data());
        double excess = 0.0, change = 0.0, share = 0.0;
        for (std::size_t i = 0; i < samples; ++i)
            for (std::size_t k = 0; k < i; ++k) {
                const Vec3<double> step = at_ls[i] - at_ls[k];
                const double bound = variation.lit ? 0.0 : variation.change(variation.turned(step));
                const double off = std::abs(v[i] - v[k] - glm::dot(variation.slope, step));
                excess = std::max(excess, off - bound), change = std::max(change, off);
                share = std::max(share, off / (bound + 1e-3));
            }
        seen.changing += change > 1e-3 ? 1 : 0;
        seen.closest = std::max(seen.closest, share);
        const double least = *std::min_element(v.begin(), v.end());
        CAPTURE(n);
        CAPTURE(size);
        CAPTURE(change);
        CAPTURE(variation.lit);
        CHECK(excess <= 1e-5);
        if (variation.lit) CHECK(least >= 1.0);
    }
}

template <class Shadow, class Make>
void check_variations(test::SceneKind kind, const Make& make) {
    Seen seen;
    for (std::uint32_t number = 1; number <= 300; ++number) {
        CAPTURE(number);
        const test::PlanScene<double> scene = test::random_scene<double>(number, kind);
        const Shadow shadow = make(scene);
        test::Random random(number);
        check_variation(shadow, test::seen_points(scene, 2 * number + 1, scene.center), random, seen);
    }
    const std::string told = std::to_string(seen.known) + " known, " + std::to_string(seen.lit) + " lit, " +
                             std::to_string(seen.changing) + " changing, " + std::to_string(seen.closest) +
                             " of bounds";
    MESSAGE(told);
    CHECK(seen.lit > 100);
    CHECK(seen.known > seen.lit + 100);
    CHECK(seen.changing > 50);
    CHECK(seen.closest > 0.05);
}

/// Parallelograms that join at their sides, together or one by one.
void add_fold(std::vector<Mesh<double>>& casters, Vec3<double> at, double size, test::Random& random) {
    const Vec3<double> along = random.point(-1.0, 1.0) * size;
    const bool is_one = random.whole(0, 1) == 0;
    Mesh<double> mesh;
    for (int k = random.whole(2, 4); k > 0; --k) {
        const Vec3<double> next = at + random.point(-1.0, 1.0) * size;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {at, at + along, next + along, next});
        mesh.triangles.emplace_back(first, first + 1, first + 2),
            mesh.triangles.emplace_back(first, first + 2, first + 3);
        at = next;
        if (!is_one) casters.push_back(mesh), mesh = {};
    }
    if (is_one) casters.push_back(mesh);
}

/// Convex casters, so many before a light that few of their edges are in nobody's way, and receivers behind.
test::PlanScene<double> crowd(std::uint32_t number) {
    test::PlanScene<double> scene = test::random_scene<double>(number, test::SceneKind::flat_layers);
    test::Random random(number);
    const RectLight<double> light = scene.rect();
    const LightFrame<double> frame = light_frame(light, Vec3<double>(0.0, 0.0, -1.0));
    scene.casters.clear();
    const int count = random.whole(2, 9);
    for (int k = 0; k < count; ++k) {
        const double size = random.in(0.1, 1.5);
        const Vec3<double> at = frame.to_world(random.point(-1.0, 1.0) + Vec3<double>(0.0, 0.0, random.in(1.5, 4.0)));
        const int kind = random.whole(0, 4);
        if (kind < 2) {
            scene.casters.push_back(test::box_mesh(at, at + random.point(0.1, 1.0) * size));
            continue;
        }
        if (kind == 2) {
            Mesh<double> solid = test::icosphere<double>(random.whole(0, 1));
            const Vec3<double> half = random.point(0.2, 1.0) * size;
            for (Vec3<double>& p : solid.positions) p = at + p * half;
            scene.casters.push_back(solid);
            continue;
        }
        if (kind == 3) {
            add_fold(scene.casters, at, size, random);
            continue;
        }
        const Vec3<double> u = random.point(-1.0, 1.0) * size, v = random.point(-1.0, 1.0) * size;
        Mesh<double> quad;
        quad.positions = {at, at + u, at + u + v, at + v};
        quad.triangles = {{0, 1, 2}, {0, 2, 3}};
        scene.casters.push_back(quad);
    }
    return scene;
}

constexpr double slope_along = 0.11, slope_across = 0.03, slope_deep = 0.02;

/// Visibility that changes evenly in light space, and is 1 beyond x = 0.
class EvenShadow {
  public:
    explicit EvenShadow(const LightFrame<double>& frame) : frame_(frame) {}

    double at(const Vec3<double>& point) const {
        const Vec3<double> p = turn().turned(frame_.to_light(point));
        if (!is_finite(point) || !(frame_.to_light(point).z > 0.0) || frame_.to_light(point).x >= 0.0) return 1.0;
        return 0.5 + slope_along * std::sin(p.x) + slope_across * std::sin(p.y) + slope_deep * std::sin(p.z);
    }
    void visibility(const Vec3<double>* points, std::size_t count, double* result) const {
        for (std::size_t i = 0; i < count; ++i) result[i] = at(points[i]);
        asked += count;
    }
    static Variation<double> turn() {
        Variation<double> result;
        result.known = true, result.direction = Vec2<double>(0.6, 0.8);
        result.along = slope_along, result.across = slope_across, result.deep = slope_deep;
        return result;
    }
    static Variation<double> variation(const Box3<double>& box_ls, double most) {
        if (box_ls.min.x > 0.0) return Variation<double>::all_lit();
        const Vec3<double> half = (box_ls.max - box_ls.min) * 0.5;
        const bool is_known = box_ls.max.x < 0.0 && slope_along * glm::length(half) <= most;
        return is_known ? turn() : Variation<double>::unknown();
    }

    mutable std::size_t asked = 0;

  private:
    LightFrame<double> frame_;
};

LightFrame<double> a_frame() {
    const Vec3<double> normal = glm::normalize(Vec3<double>(0.3, -0.5, -0.8)), u = any_perpendicular(normal);
    return {Vec3<double>(1.0, 2.0, 5.0), u, glm::cross(normal, u), normal};
}

/// Rows of 8 × 8 tiles on a plane in light space.
std::vector<Vec3<double>> tiled_points(std::size_t count, const LightFrame<double>& frame) {
    std::vector<Vec3<double>> points;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t tile = i / 64;
        const double x = static_cast<double>(tile % 4 * 8 + i % 8), y = static_cast<double>(tile / 4 * 8 + i / 8 % 8);
        points.push_back(frame.to_world(Vec3<double>(0.05 * x - 0.83, 0.05 * y, 4.0 + 0.01 * x)));
    }
    return points;
}

}  // namespace

TEST_CASE("visibility past silhouettes changes by no more than the variation of wedges") {
    check_variations<PenumbraWedgeShadow<double>>(test::SceneKind::any, [](const test::PlanScene<double>& scene) {
        return PenumbraWedgeShadow<double>(scene.casters, scene.rect());
    });
    check_variations<PenumbraWedgeShadow<double>>(test::SceneKind::any, [](const test::PlanScene<double>& scene) {
        PenumbraWedgeOptions options;
        options.overlap = OverlapRule::additive, options.silhouette = SilhouetteFrom::light_center;
        return PenumbraWedgeShadow<double>(scene.casters, scene.rect(), options);
    });
}

TEST_CASE("visibility of a disk changes by no more than the variation of sums over edges") {
    check_variations<UmbraVolumeShadow<double>>(test::SceneKind::any, [](const test::PlanScene<double>& scene) {
        return UmbraVolumeShadow<double>(scene.casters, scene.disk());
    });
}

TEST_CASE("behind casters that hide each other visibility changes by no more than the variation") {
    Seen rectangles, disks;
    for (std::uint32_t number = 1; number <= 400; ++number) {
        CAPTURE(number);
        const test::PlanScene<double> scene = crowd(number);
        const LightFrame<double> frame = light_frame(scene.rect(), Vec3<double>(0.0, 0.0, -1.0));
        test::Random random(number);
        std::vector<Vec3<double>> points;
        for (int i = 0; i < 40; ++i)
            points.push_back(
                frame.to_world(random.point(-1.0, 1.0) * 2.0 + Vec3<double>(0.0, 0.0, random.in(6.0, 9.0))));
        check_variation(PenumbraWedgeShadow<double>(scene.casters, scene.rect()), points, random, rectangles);
        check_variation(UmbraVolumeShadow<double>(scene.casters, scene.disk()), points, random, disks);
    }
    for (const Seen& seen : {rectangles, disks}) {
        const std::string told = std::to_string(seen.known) + " known, " + std::to_string(seen.changing) +
                                 " changing, " + std::to_string(seen.closest) + " of bounds";
        MESSAGE(told);
        CHECK(seen.changing > 500);
        CHECK(seen.closest > 0.5);
    }
}

TEST_CASE("means over kernels change by no more than the variation of occlusion textures") {
    for (const SliceBlend blend : {SliceBlend::connected(), SliceBlend::scattered(), SliceBlend::unknown()})
        check_variations<OcclusionTextureShadow<double>>(
            test::SceneKind::flat_layers, [&](const test::PlanScene<double>& scene) {
                OcclusionTextureOptions options;
                options.resolution = 128, options.blend = blend;
                return OcclusionTextureShadow<double>(scene.casters, scene.rect(), options);
            });
}

TEST_CASE("points on either side of a face do not see the same") {
    // its edges lie beside all that they see of the light
    const std::vector<Mesh<float>> casters = {test::box_mesh(Vec3<float>(0.0F), Vec3<float>(1.0F))};
    const RectLight<float> light{Vec3<float>(10.0F, 0.5F, -0.5F), Vec3<float>(0.0F, 0.0F, 0.3F),
                                 Vec3<float>(0.0F, 0.3F, 0.0F)};
    const PenumbraWedgeShadow<float> shadow(casters, light);
    const Vec3<float> outside(1.02F, 0.5F, -0.5F), inside(0.98F, 0.5F, -0.5F);
    REQUIRE(shadow.visibility(outside) > 0.999F);
    REQUIRE(shadow.visibility(inside) < 0.001F);
    const Vec3<float> half(0.001F), at_face = shadow.frame().to_light(Vec3<float>(1.0F, 0.5F, -0.5F));
    for (const float deep : {0.02F, 0.1F, 0.5F}) {
        const Vec3<float> around(0.01F, 0.01F, deep);
        CHECK_FALSE(shadow.variation({at_face - around, at_face + around}, 1.0F).known);
    }
    CHECK(
        shadow.variation({shadow.frame().to_light(outside) - half, shadow.frame().to_light(outside) + half}, 1.0F).lit);
}

TEST_CASE("batches of any size are answered within the tolerance, whoever is told how") {
    const LightFrame<double> frame = a_frame();
    const EvenShadow shadow(frame);
    const auto vary = [](const Box3<double>& box, double most, const Vec3<double>*, std::size_t) {
        return EvenShadow::variation(box, most);
    };
    std::vector<std::size_t> counts = {1023, 1024, 1025, 3000};
    for (std::size_t count = 0; count <= 130; ++count) counts.push_back(count);
    for (const double tolerance : {1e-3, 1e-2, 0.1})
        for (const std::size_t count : counts) {
            const std::vector<Vec3<double>> points = tiled_points(count, frame);
            std::vector<double> told(count + 1, -1.0), untold(count + 1, -1.0);
            std::vector<PointAnswer> answers(count + 1, PointAnswer::own);
            detail::TileQuery<double, EvenShadow, decltype(vary)> query(shadow, vary, frame, tolerance, 1);
            query(points.data(), count, told.data(), answers.data());
            query(points.data(), count, untold.data(), nullptr);
            double worst = 0.0, apart = 0.0;
            int wrong = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const double off = std::abs(told[i] - shadow.at(points[i]));
                worst = std::max(worst, off), apart = std::max(apart, std::abs(told[i] - untold[i]));
                wrong += answers[i] != PointAnswer::shared && off > 1e-12 ? 1 : 0;
            }
            CAPTURE(tolerance);
            CAPTURE(count);
            CHECK(worst <= tolerance * 1.000001);
            CHECK(apart <= 0.0);
            CHECK(wrong == 0);
            CHECK(told[count] < 0.0);  // nothing is written beyond
        }
}

TEST_CASE("neighbours that see nearly the same are asked once") {
    const LightFrame<double> frame = a_frame();
    const std::vector<Vec3<double>> points = tiled_points(1024, frame);
    const auto vary = [](const Box3<double>& box, double most, const Vec3<double>*, std::size_t) {
        return EvenShadow::variation(box, most);
    };
    std::vector<double> result(points.size());
    std::vector<PointAnswer> answers(points.size());
    std::size_t before = points.size();
    for (const double tolerance : {1e-3, 1e-2, 0.1}) {
        const EvenShadow shadow(frame);
        detail::TileQuery<double, EvenShadow, decltype(vary)> query(shadow, vary, frame, tolerance, 1);
        query(points.data(), points.size(), result.data(), answers.data());
        const auto own = static_cast<std::size_t>(std::count(answers.begin(), answers.end(), PointAnswer::own));
        CHECK(shadow.asked == own);
        CHECK(own <= before);
        before = own;
        CHECK(std::count(answers.begin(), answers.end(), PointAnswer::lit) > 200);
    }
    CHECK(before < 400);
}

TEST_CASE("of tiles that see two surfaces each is asked by itself") {
    const LightFrame<double> frame = a_frame();
    const auto vary = [](const Box3<double>& box, double most, const Vec3<double>*, std::size_t) {
        return EvenShadow::variation(box, most);
    };
    std::vector<Vec3<double>> points;
    for (std::size_t i = 0; i < 256; ++i) {  // every third point lies far behind, some of them where all is lit
        const double x = -0.9 + 0.002 * static_cast<double>(i % 8), y = 0.002 * static_cast<double>(i / 8 % 8);
        const bool behind = i % 3 == 0;
        points.push_back(frame.to_world(
            Vec3<double>(behind ? x + 0.6 * static_cast<double>(i / 64) : x, y, behind ? 300.0 + y : 4.0)));
    }
    const EvenShadow shadow(frame);
    std::vector<double> result(points.size());
    std::vector<PointAnswer> answers(points.size());
    detail::TileQuery<double, EvenShadow, decltype(vary)> query(shadow, vary, frame, 0.01, 1);
    query(points.data(), points.size(), result.data(), answers.data());
    CHECK(shadow.asked < 20);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, std::abs(result[i] - shadow.at(points[i])));
    CHECK(worst <= 0.0100001);
    CHECK(std::count(answers.begin(), answers.end(), PointAnswer::lit) > 40);
}

TEST_CASE("points without a place see all of the light, and others what they see") {
    const LightFrame<double> frame = a_frame();
    const EvenShadow shadow(frame);
    const auto vary = [](const Box3<double>& box, double most, const Vec3<double>*, std::size_t) {
        return EvenShadow::variation(box, most);
    };
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
    test::Random random(3);
    for (int n = 0; n < 200; ++n) {
        const std::size_t count = static_cast<std::size_t>(random.whole(1, 1400));
        std::vector<Vec3<double>> points = tiled_points(count, frame);
        for (int k = random.whole(1, 4); k > 0; --k) {
            const auto at = static_cast<std::size_t>(random.whole(0, static_cast<int>(count) - 1));
            points[at][random.whole(0, 2)] = bad[random.whole(0, 2)];
        }
        std::vector<double> result(count);
        detail::TileQuery<double, EvenShadow, decltype(vary)> query(shadow, vary, frame, 0.01, 1);
        query(points.data(), count, result.data(), nullptr);
        double worst = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            worst = std::max(worst, is_finite(result[i]) ? std::abs(result[i] - shadow.at(points[i])) : 1.0);
        CHECK(worst <= 0.0100001);
    }
}

TEST_CASE("without a tolerance points share what surely is the same") {
    const std::vector<Mesh<float>> casters = {test::box_mesh(Vec3<float>(0.0F), Vec3<float>(1.0F))};
    const RectLight<float> light{Vec3<float>(0.0F, 0.0F, 5.0F), Vec3<float>(0.1F, 0.0F, 0.0F),
                                 Vec3<float>(0.0F, -0.1F, 0.0F)};
    const std::vector<Mesh<float>> ground = {test::level_quad(Vec3<float>(0.0F, 0.0F, -1.5F), 5.0F, 5.0F)};
    const PlannedShadow<PenumbraWedgeShadow<float>> planned(casters, plan(casters, light, ground, 0.0F), ground);
    std::vector<Vec3<float>> points;
    for (int i = 0; i < 256; ++i)  // all in the umbra
        points.emplace_back(0.01F * static_cast<float>(i % 8), 0.01F * static_cast<float>(i / 8 % 8), -1.5F);
    std::vector<float> result(points.size());
    planned.visibility(points.data(), points.size(), result.data());
    for (const float v : result) CHECK(v < 1e-4F);
}
