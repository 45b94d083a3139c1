// What maps say that is known is what shadows answer, exactly.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/plan/known_maps.hpp>
#include <penumbra/umbra_volume/shadow.hpp>
#include <string>
#include <vector>

#include "plan/random_scenes.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

struct Seen {
    int boxes = 0, lit = 0, dark = 0, wrong = 0;
};

/// Points of small boxes around receivers and casters.
template <class Shadow>
void check(const Shadow& shadow, const detail::KnownPlaces<double>& places, const std::vector<Vec3<double>>& points,
           test::Random& random, Seen& seen) {
    constexpr std::size_t samples = 24;
    for (int n = 0; n < 40; ++n) {
        const auto at = static_cast<std::size_t>(random.whole(0, static_cast<int>(points.size()) - 1));
        const Vec3<double> middle = shadow.frame().to_light(points[at]);
        const double size = std::exp(random.in(-9.0, -1.0));
        const Vec3<double> half = random.point(0.0, 1.0) * size;
        const Box3<double> box{middle - half, middle + half};
        const Variation<double> variation = places(box);
        ++seen.boxes;
        if (!variation.known) continue;
        ++(variation.lit ? seen.lit : seen.dark);
        std::array<Vec3<double>, samples> at_ws;
        for (std::size_t i = 0; i < samples; ++i) {
            Vec3<double> share = random.point(-1.0, 1.0);
            for (int k = 0; k < 3 && i < 8; ++k) share[k] = (i >> k & 1) != 0 ? 1.0 : -1.0;
            at_ws[i] = shadow.frame().to_world(middle + half * share * 0.999999);
        }
        std::array<double, samples> v;
        shadow.visibility(at_ws.data(), samples, v.data());
        const double expected = variation.lit ? 1.0 : 0.0;
        for (const double visible : v) seen.wrong += std::abs(visible - expected) > 0.0 ? 1 : 0;
    }
}

/// `answers` = whether what is dark can be known.
template <class Make, class Places>
void check_scenes(bool knows_dark, const Make& make, const Places& places_of) {
    Seen seen;
    for (std::uint32_t number = 1; number <= 150; ++number) {
        const test::PlanScene<double> scene = test::random_scene<double>(number, test::SceneKind::any);
        test::Random random(number + 17);
        const auto shadow = make(scene, random);
        check(shadow, places_of(shadow), test::seen_points(scene, 2 * number + 1, scene.center), random, seen);
    }
    const std::string told = std::to_string(seen.boxes) + " boxes, " + std::to_string(seen.lit) + " lit, " +
                             std::to_string(seen.dark) + " dark";
    MESSAGE(told);
    CHECK(seen.wrong == 0);
    CHECK(seen.lit > seen.boxes / 10);
    CHECK((seen.dark > 20) == knows_dark);
}

void check_maps(LinearMode mode, SkinTransition transition) {
    check_scenes(
        mode == LinearMode::skins || mode == LinearMode::hard,
        [&](const test::PlanScene<double>& scene, test::Random& random) {
            SoftShadowMapOptions options;
            options.mode = mode, options.transition = transition;
            options.resolution = random.whole(1, 160), options.samples = random.whole(2, 4);
            options.most_samples = random.whole(0, 6);
            return SoftShadowMap<double>(scene.casters, scene.line(), options, scene.receivers);
        },
        [](const SoftShadowMap<double>& shadow) { return detail::known_places(shadow); });
}

}  // namespace

TEST_CASE("what D-buffers know of boxes is what they answer") {
    for (const DBufferDepth depth : {DBufferDepth::light_plane, DBufferDepth::euclidean})
        check_scenes(
            true,
            [&](const test::PlanScene<double>& scene, test::Random& random) {
                UmbraVolumeOptions options;
                options.mode = DiskMode::d_buffer, options.depth = depth;
                options.resolution = random.whole(1, 160), options.layers = random.whole(1, 2);
                return UmbraVolumeShadow<double>(scene.casters, scene.disk(), options);
            },
            [](const UmbraVolumeShadow<double>& shadow) { return detail::known_places(shadow.d_buffer()); });
}

TEST_CASE("what intervals know of boxes is what they answer") {
    check_maps(LinearMode::intervals, SkinTransition::exact);
    check_maps(LinearMode::interval_mask, SkinTransition::exact);
}

TEST_CASE("what skins know of boxes is what they answer") {
    check_maps(LinearMode::hard, SkinTransition::exact);
    for (const SkinTransition transition : {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact})
        check_maps(LinearMode::skins, transition);
}

TEST_CASE("without casters everything is lit") {
    const Box3<float> box{Vec3<float>(-1.0F), Vec3<float>(1.0F)};
    const SoftShadowMap<float> maps({}, {Vec3<float>(0.0F), Vec3<float>(1.0F)});
    CHECK(detail::known_places(maps)(box).lit);
    CHECK(detail::known_places(DBuffer<float>())(box).lit);
}
