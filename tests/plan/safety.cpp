// A plan keeps its word: what is planned differs from what is full by no more than it says, wherever receivers are.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/plan.hpp>
#include <string>
#include <vector>

#include "plan/random_scenes.hpp"

using namespace penumbra;

namespace {

// How many scenes, in shares of which each method has some. To hunt, build with more: -DPENUMBRA_SAFETY_SCENES=5000
#ifndef PENUMBRA_SAFETY_SCENES
#if defined(__SANITIZE_ADDRESS__)
#define PENUMBRA_SAFETY_SCENES 25
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PENUMBRA_SAFETY_SCENES 25
#endif
#endif
#endif
#ifndef PENUMBRA_SAFETY_SCENES
#define PENUMBRA_SAFETY_SCENES 240
#endif
#ifndef PENUMBRA_SAFETY_FIRST
#define PENUMBRA_SAFETY_FIRST 1
#endif
constexpr std::uint32_t scenes = PENUMBRA_SAFETY_SCENES, first_scene = PENUMBRA_SAFETY_FIRST;
constexpr float rounding = 2e-4F;

/// Over all scenes of a method.
struct Tally {
    std::array<int, effect_count> out{}, planned{};    ///< in how many plans an effect was left out, of how many
    std::array<int, effect_count> out_with_casters{};  ///< some of which were kept
    std::array<std::size_t, 3> answers{};              ///< by PointAnswer
    double worst = 0.0;                                ///< of |planned − full| as a share of the bound
    int plans = 0;

    bool spares(Effect effect) const { return out_with_casters[static_cast<std::size_t>(effect)] > 0; }
    std::string text() const {
        std::string result = std::to_string(plans) + " plans; left out";
        for (std::size_t e = 0; e < out.size(); ++e)
            if (planned[e] > 0)
                result += std::string(" ") + name_of(static_cast<Effect>(e)) + " " + std::to_string(out[e]) + " (" +
                          std::to_string(out_with_casters[e]) + ")";
        result += "; points lit " + std::to_string(answers[0]) + ", shared " + std::to_string(answers[1]) + ", own " +
                  std::to_string(answers[2]) + "; " + std::to_string(worst) + " of the bound at worst";
        return result;
    }
};

template <class Shadow, class Meshes, class Light>
Shadow full_shadow(const Meshes& casters, const Light& light, const typename Shadow::Options& options,
                   [[maybe_unused]] const Meshes& receivers) {
    if constexpr (std::is_same_v<Shadow, SoftShadowMap<typename Shadow::Real>>)
        return Shadow(casters, light, options, receivers);
    else
        return Shadow(casters, light, options);
}

/// How far `value` is from all that full has within rounding of a point, where that is a range: N-buffers and mip-maps
/// jump, slices may be hardly thicker than coordinates are exact, and -ffast-math rounds by the place in an array.
template <class Shadow, class T>
T off_around(const Shadow& full, const Vec3<T>& point, T value, T expected) {
    const T step = T(4) * std::numeric_limits<T>::epsilon() * detail::largest_component(point);
    T least = expected, most = expected;
    for (int way = 0; way < 27; ++way) {
        const Vec3<T> to(static_cast<T>(way % 3 - 1), static_cast<T>(way / 3 % 3 - 1), static_cast<T>(way / 9 - 1));
        const T near = full.visibility(point + to * step);
        least = std::min(least, near), most = std::max(most, near);
    }
    return std::max({T(0), value - most, least - value});
}

/// Plans a scene for each tolerance. Every second plan knows another before it, that of the same scene for another
/// tolerance: it may say nothing wrong.
template <class Shadow, class T, class Light>
void check_scene(const test::PlanScene<T>& scene, const Light& light, const typename Shadow::Options& full,
                 std::uint32_t number, Tally& tally) {
    const Shadow shadow = full_shadow<Shadow>(scene.casters, light, full, scene.receivers);
    const Vec3<T> behind = shadow.frame().to_world(Vec3<T>(T(0), T(0), T(-0.5)));
    const std::vector<Vec3<T>> points = test::seen_points(scene, number, behind);
    std::vector<T> expected(points.size()), result(points.size());
    std::vector<PointAnswer> answers(points.size());
    shadow.visibility(points.data(), points.size(), expected.data());
    Plan<Shadow> before;
    for (const T tolerance : {T(0), T(1e-3), T(0.1), T(1e-2), T(2e-2)}) {
        PlanSettings<Shadow> settings;
        settings.full = full, settings.casters_receive = scene.casters_receive;
        if (tolerance > T(0) && number % 2 == 1) settings.previous = &before;
        const PlannedShadow<Shadow> planned(
            scene.casters, plan_for<Shadow>(scene.casters, light, scene.receivers, tolerance, settings),
            scene.receivers);
        const Plan<Shadow>& plan = planned.plan();
        planned.visibility(points.data(), points.size(), result.data(), answers.data());
        const T most = std::min(plan.bound, tolerance) + T(rounding);
        T worst = T(0);
        std::size_t at = 0, single = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool is_share = is_finite(result[i]) && result[i] >= T(0) && result[i] <= T(1);
            T off = is_share ? std::abs(result[i] - expected[i]) : T(2);
            if (is_share && off > most) off = off_around(shadow, points[i], result[i], expected[i]);
            if (off > worst) worst = off, at = i;
            ++tally.answers[static_cast<std::size_t>(answers[i])];
        }
        for (std::size_t i = 0; i < points.size(); i += 97) {
            const T value = planned.visibility(points[i]);
            if (std::abs(value - expected[i]) > most && off_around(shadow, points[i], value, expected[i]) > most)
                ++single;
        }
        ++tally.plans;
        for (const auto& decision : plan.decisions) {
            const auto e = static_cast<std::size_t>(decision.effect);
            ++tally.planned[e];
            tally.out[e] += decision.simulated ? 0 : 1;
            tally.out_with_casters[e] += !decision.simulated && !plan.casters.empty() ? 1 : 0;
        }
        tally.worst = std::max(tally.worst, static_cast<double>(worst / most));
        const bool kept =
            worst <= most && single == 0 && is_finite(plan.bound) && plan.bound <= tolerance + T(rounding);
        if (kept) continue;
        const auto number_of = [](auto value) { return std::to_string(static_cast<double>(value)); };
        const std::string told = "scene " + std::to_string(number) + " for " + number_of(tolerance) + ", bound " +
                                 number_of(plan.bound) + ": point " + std::to_string(at) + " has " +
                                 number_of(result[at]) + ", full " + number_of(expected[at]) + ", off " +
                                 number_of(worst) + ", answer " + number_of(answers[at]) + "\n" + plan.text();
        INFO(told);
        CHECK(worst <= most);
        CHECK(single == 0);
        CHECK(plan.bound <= tolerance + T(rounding));
    }
}

template <class Shadow, class Make>
Tally check_scenes(std::uint32_t count, test::SceneKind kind, const Make& options, std::uint32_t first = first_scene) {
    using T = typename Shadow::Real;
    Tally tally;
    for (std::uint32_t number = first; number < first + count; ++number) {
        const test::PlanScene<T> scene = test::random_scene<T>(number, kind);
        test::Random random(number + 0x9e3779b9U);
        const typename Shadow::Options full = options(random);
        if constexpr (std::is_same_v<typename Shadow::Light, RectLight<T>>)
            check_scene<Shadow>(scene, scene.rect(), full, number, tally);
        else if constexpr (std::is_same_v<typename Shadow::Light, DiskLight<T>>)
            check_scene<Shadow>(scene, scene.disk(), full, number, tally);
        else
            check_scene<Shadow>(scene, scene.line(), full, number, tally);
    }
    const std::string told = tally.text();
    MESSAGE(told);
    return tally;
}

template <class Value, std::size_t N>
Value one_of(test::Random& random, const Value (&values)[N]) {
    return values[random.whole(0, static_cast<int>(N) - 1)];
}

constexpr int mask_sizes[] = {8, 16, 32};
constexpr int resolutions[] = {64, 96, 128};

PenumbraWedgeOptions any_wedges(test::Random& random) {
    PenumbraWedgeOptions full;
    const OverlapRule rules[] = {
        OverlapRule::additive,          OverlapRule::maximum,    OverlapRule::product,
        OverlapRule::product_quadrants, OverlapRule::rectangles, OverlapRule::rectangles_centroid,
        OverlapRule::rectangle_product, OverlapRule::bitmask,    OverlapRule::exact};
    full.overlap = one_of(random, rules);
    full.bitmask_size = one_of(random, mask_sizes);
    if (random.whole(0, 2) == 0) full.silhouette = SilhouetteFrom::light_center;
    if (random.whole(0, 2) == 0) full.tolerance = random.in(0.0F, 0.02F);
    return full;
}

UmbraVolumeOptions any_disk_sum(test::Random& random) {
    UmbraVolumeOptions full;
    const DiskOverlap rules[] = {DiskOverlap::additive, DiskOverlap::maximum, DiskOverlap::product,
                                 DiskOverlap::bitmask, DiskOverlap::exact};
    full.overlap = one_of(random, rules);
    full.bitmask_size = one_of(random, mask_sizes);
    if (random.whole(0, 2) == 0) full.tolerance = random.in(0.0F, 0.02F);
    return full;
}

UmbraVolumeOptions any_d_buffer(test::Random& random) {
    UmbraVolumeOptions full;
    full.mode = DiskMode::d_buffer;
    full.resolution = one_of(random, resolutions);
    full.layers = random.whole(1, 2);
    if (random.whole(0, 3) == 0) full.visibility = CutVisibility::cubic;
    if (random.whole(0, 3) == 0) full.share = CutShare::depths;
    if (random.whole(0, 3) == 0) full.depth = DBufferDepth::euclidean;
    if (random.whole(0, 3) == 0) full.silhouette = VolumeSilhouette::light_center;
    return full;
}

SoftShadowMapOptions any_maps(test::Random& random) {
    SoftShadowMapOptions full;
    const LinearMode modes[] = {LinearMode::intervals, LinearMode::intervals, LinearMode::interval_mask,
                                LinearMode::skins, LinearMode::hard};
    full.mode = one_of(random, modes);
    full.resolution = one_of(random, resolutions);
    full.samples = random.whole(2, 4);
    full.most_samples = random.whole(0, 1) == 0 ? 6 : 0;
    full.narrowest_gap = random.whole(0, 3) == 0;
    const SkinTransition transitions[] = {SkinTransition::exact, SkinTransition::rational, SkinTransition::linear};
    full.transition = one_of(random, transitions);
    return full;
}

OcclusionTextureOptions any_slices(test::Random& random) {
    OcclusionTextureOptions full;
    full.resolution = one_of(random, resolutions);
    const SliceBlend blends[] = {SliceBlend::connected(), SliceBlend::scattered(), SliceBlend::disjoint(),
                                 SliceBlend::unknown()};
    full.blend = one_of(random, blends);
    full.slices = random.whole(0, 1) == 0 ? 8 : random.whole(1, 20);
    const SliceFilter filters[] = {SliceFilter::summed_area, SliceFilter::summed_area, SliceFilter::n_buffer,
                                   SliceFilter::mipmap};
    full.filter = one_of(random, filters);
    full.light_cells = random.whole(0, 1) == 0 ? 2 : random.whole(1, 4);
    if (random.whole(0, 2) == 0) full.plane = SlicePlane::bottom;
    const SelfShadow rules[] = {SelfShadow::mean_depth, SelfShadow::mean_depth, SelfShadow::fade, SelfShadow::clear};
    full.self_shadow = one_of(random, rules);
    return full;
}

/// What every method's tiles save.
/// Of as many scenes as there are without sanitizers: what is tested is not empty.
void happens(bool something) { CHECK((something || scenes < 200)); }

void check_answers(const Tally& tally) {
    happens(tally.answers[static_cast<std::size_t>(PointAnswer::lit)] > 0);
    happens(tally.answers[static_cast<std::size_t>(PointAnswer::own)] > 0);
    happens(tally.spares(Effect::penumbra));  // lights without an extent
}
void check_shares(const Tally& tally) {
    check_answers(tally);
    happens(tally.answers[static_cast<std::size_t>(PointAnswer::shared)] > 0);
}

}  // namespace

TEST_CASE("penumbra wedges as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<PenumbraWedgeShadow<float>>(3 * scenes, test::SceneKind::any,
                                                                 [](test::Random&) { return PenumbraWedgeOptions(); });
    check_shares(tally);
    happens(tally.spares(Effect::casters));
    happens(tally.spares(Effect::overlap));
    happens(tally.out[static_cast<std::size_t>(Effect::silhouettes_per_point)] > 0);
}

TEST_CASE("penumbra wedges by any rule as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<PenumbraWedgeShadow<float>>(2 * scenes, test::SceneKind::any, any_wedges);
    check_shares(tally);
    happens(tally.spares(Effect::casters));
}

TEST_CASE("penumbra wedges in double as planned are as far from full ones as the plan says at most") {
    check_shares(check_scenes<PenumbraWedgeShadow<double>>(scenes / 2, test::SceneKind::any, any_wedges));
}

TEST_CASE("sums over a disk's edges as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<UmbraVolumeShadow<float>>(2 * scenes, test::SceneKind::any,
                                                               [](test::Random&) { return UmbraVolumeOptions(); });
    check_shares(tally);
    happens(tally.spares(Effect::casters));
    happens(tally.spares(Effect::overlap));
}

TEST_CASE("sums over a disk's edges by any rule as planned are as far from full ones as the plan says at most") {
    check_shares(check_scenes<UmbraVolumeShadow<float>>(scenes, test::SceneKind::any, any_disk_sum));
}

TEST_CASE("D-buffers as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<UmbraVolumeShadow<float>>(scenes, test::SceneKind::any, any_d_buffer);
    check_answers(tally);
    for (const Effect effect : {Effect::casters, Effect::second_layer, Effect::volume_silhouette})
        happens(tally.out[static_cast<std::size_t>(effect)] > 0);
}

TEST_CASE("soft shadow maps as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<SoftShadowMap<float>>(2 * scenes, test::SceneKind::any, any_maps);
    check_answers(tally);
    happens(tally.out[static_cast<std::size_t>(Effect::casters)] > 0);
    happens(tally.out[static_cast<std::size_t>(Effect::exact_transition)] > 0);
}

TEST_CASE("occlusion textures as planned are as far from full ones as the plan says at most") {
    const Tally tally = check_scenes<OcclusionTextureShadow<float>>(2 * scenes, test::SceneKind::any, any_slices);
    check_shares(tally);
    happens(tally.out[static_cast<std::size_t>(Effect::casters)] > 0);
}

TEST_CASE("occlusion textures of flat layers do without slices, copies of them and depths") {
    const Tally tally =
        check_scenes<OcclusionTextureShadow<float>>(2 * scenes, test::SceneKind::flat_layers, any_slices);
    check_shares(tally);
    for (const Effect effect : {Effect::slices, Effect::leak_closing, Effect::self_shadow})
        happens(tally.spares(effect));
}
