#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/plan.hpp>
#include <string>
#include <vector>

#include "plan/random_scenes.hpp"
#include "support/box_mesh.hpp"
#include "support/error_of.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

using Meshes = std::vector<Mesh<float>>;
using Wedges = PenumbraWedgeShadow<float>;

/// Emits along −z.
RectLight<float> lamp(float height, float half_u, float half_v) {
    return {Vec3<float>(0.0F, 0.0F, height), Vec3<float>(half_u, 0.0F, 0.0F), Vec3<float>(0.0F, -half_v, 0.0F)};
}
Meshes ground(float half = 20.0F) { return {test::level_quad(Vec3<float>(0.0F, 0.0F, 0.0F), half, half)}; }

PlanSettings<Wedges> not_receiving() {
    PlanSettings<Wedges> settings;
    settings.casters_receive = false;
    return settings;
}

/// A plan simulates nothing that another one, for less, does not; without casters it simulates nothing.
template <class Shadow>
bool is_within(const Plan<Shadow>& less, const Plan<Shadow>& more) {
    if (less.casters.empty()) return true;
    bool within = std::includes(more.casters.begin(), more.casters.end(), less.casters.begin(), less.casters.end());
    for (int e = 0; e < effect_count; ++e) {
        const auto effect = static_cast<Effect>(e);
        if (effect == Effect::casters || effect == Effect::every_point) continue;
        within = within && (more.simulates(effect) || !less.simulates(effect));
    }
    return within;
}

template <class Shadow, class Light>
void check_monotone(const test::PlanScene<float>& scene, const Light& light, const typename Shadow::Options& full,
                    std::uint32_t number) {
    PlanSettings<Shadow> settings;
    settings.full = full, settings.casters_receive = scene.casters_receive;
    Plan<Shadow> before;
    for (int k = 0; k < 12; ++k) {
        const float tolerance = k == 0 ? 0.0F : 5e-4F * std::exp2(static_cast<float>(k));
        Plan<Shadow> plan = plan_for<Shadow>(scene.casters, light, scene.receivers, tolerance, settings);
        const bool is_monotone = k == 0 || is_within(plan, before);
        const std::string now = plan.text(), then = k > 0 ? before.text() : "";
        CAPTURE(number);
        CAPTURE(tolerance);
        CAPTURE(now);
        CAPTURE(then);
        CHECK(is_monotone);
        CHECK(plan.bound <= tolerance + 1e-6F);
        before = std::move(plan);
    }
}

float worst_on_ground(const Meshes& casters, const RectLight<float>& light, const PlannedShadow<Wedges>& planned,
                      float reach = 3.2F) {
    const Wedges full(casters, light);
    std::vector<Vec3<float>> points;
    for (int i = 0; i < 4096; ++i)
        points.emplace_back(reach * (static_cast<float>(i / 64 % 8 * 8 + i % 8) / 32.0F - 1.0F),
                            reach * (static_cast<float>(i / 512 * 8 + i / 8 % 8) / 32.0F - 1.0F), 0.0F);
    std::vector<float> expected(points.size()), result(points.size());
    full.visibility(points.data(), points.size(), expected.data());
    planned.visibility(points.data(), points.size(), result.data());
    float worst = 0.0F;
    for (std::size_t i = 0; i < points.size(); ++i) worst = std::max(worst, std::abs(result[i] - expected[i]));
    return worst;
}

}  // namespace

TEST_CASE("a far light and a caster on the ground plan to a hard test where points stand for more than the penumbra") {
    const Meshes casters = {test::box_mesh(Vec3<float>(0.0F, 0.0F, 0.05F), Vec3<float>(0.3F, 0.3F, 0.05F))};
    const RectLight<float> light = lamp(50.0F, 0.2F, 0.1F);
    const float width = 2.0F * 0.2F * 0.1F / (50.0F - 0.1F);  // 0.0008
    PlanSettings<Wedges> settings = not_receiving();
    CHECK(plan(casters, light, ground(), 0.01F, settings).simulates(Effect::penumbra));
    settings.footprint = 0.98F * width;
    CHECK(plan(casters, light, ground(), 0.01F, settings).simulates(Effect::penumbra));
    settings.footprint = 1.02F * width;
    const PlannedShadow<Wedges> planned(casters, plan(casters, light, ground(), 0.01F, settings), ground());
    CHECK_FALSE(planned.plan().simulates(Effect::penumbra));
    CHECK(glm::length(planned.plan().light.half_u) < 0.001F);

    const Wedges full(casters, light);
    for (int i = 0; i < 400; ++i) {  // along x: all or nothing, and right but for the border's surroundings
        const Vec3<float> point(0.299F + 0.00001F * static_cast<float>(i), 0.0F, 0.0F);
        const float v = planned.visibility(point), expected = full.visibility(point);
        const bool is_near = expected > 0.0F && expected < 1.0F;
        CHECK((is_near || std::abs(v - expected) < 1e-3F));
        CHECK((v < 0.01F || v > 0.99F || is_near));
    }
    // the same under a lamp
    CHECK(plan(casters, lamp(2.0F, 0.2F, 0.1F), ground(), 0.01F, settings).simulates(Effect::penumbra));
}

TEST_CASE("boxes apart need no correction of overlap") {
    const auto at = [](float x) { return test::box_mesh(Vec3<float>(x, 0.0F, 0.3F), Vec3<float>(0.3F)); };
    const Meshes apart = {at(-5.0F), at(5.0F)}, close = {at(-0.32F), at(0.32F)};
    const RectLight<float> light = lamp(6.0F, 1.0F, 1.0F);
    const Plan<Wedges> without = plan(apart, light, ground(), 0.0F), with = plan(close, light, ground(), 0.0F);
    CHECK_FALSE(without.simulates(Effect::overlap));
    CHECK(without.options.overlap == OverlapRule::additive);
    CHECK(without.casters.size() == 2);
    CHECK(with.simulates(Effect::overlap));
    CHECK(with.options.overlap == OverlapRule::exact);
}

TEST_CASE("casters that move together get back the correction of overlap in time, and not before their shadows meet") {
    // Plates at depths 1 and 1.5, from x = -1 to 0 and from x = b on, ground at depth 2, the light from -1 to 1.
    // The right one enters the other's wedge on the line from the light's left end past the other's edge: b = 0.5.
    // Shadows meet where the light's right end past 0 and its left one past b see the same: 1 = (4 b - 1) / 3: b = 1.
    // In between boxes say so. From x in [(4 b - 1) / 3, 1] on the ground the left plate ends at -x on the light and
    // the right one begins at 4 b - 3 x: at most -(4 b - 1) / 3, at least 4 b - 3. These meet at b = 0.625.
    const RectLight<float> light = lamp(2.0F, 1.0F, 1.0F);
    int simulated = 0;
    for (int frame = 0; frame < 150; ++frame) {
        const float b = 1.4F - 0.01F * static_cast<float>(frame);
        const Meshes casters = {test::level_quad(Vec3<float>(-0.5F, 0.0F, 1.0F), 0.5F, 0.5F),
                                test::level_quad(Vec3<float>(b + 0.5F, 0.0F, 0.5F), 0.5F, 0.5F)};
        CAPTURE(b);
        const PlannedShadow<Wedges> exact(casters, plan(casters, light, ground(), 0.0F, not_receiving()), ground());
        const bool has = exact.plan().simulates(Effect::overlap);
        if (std::abs(b - 0.625F) > 0.001F) CHECK(has == (b < 0.625F));
        simulated += has ? 1 : 0;
        if (frame % 10 == 0) {
            CHECK(worst_on_ground(casters, light, exact) <= 1e-4F);
            const PlannedShadow<Wedges> rough(casters, plan(casters, light, ground(), 0.03F, not_receiving()),
                                              ground());
            CHECK(worst_on_ground(casters, light, rough) <= 0.0301F);
        }
    }
    CHECK(simulated == 72);
}

TEST_CASE("a plan for a larger tolerance simulates no more") {
    for (std::uint32_t number = 1; number <= 250; ++number) {
        const test::PlanScene<float> any = test::random_scene<float>(number, test::SceneKind::any),
                                     flat = test::random_scene<float>(number, test::SceneKind::flat_layers);
        check_monotone<Wedges>(any, any.rect(), {}, number);
        check_monotone<UmbraVolumeShadow<float>>(any, any.disk(), {}, number);
        UmbraVolumeOptions d_buffer;
        d_buffer.mode = DiskMode::d_buffer;
        check_monotone<UmbraVolumeShadow<float>>(any, any.disk(), d_buffer, number);
        check_monotone<SoftShadowMap<float>>(any, any.line(), {}, number);
        OcclusionTextureOptions slices;
        if (number % 2 == 0) slices.blend = SliceBlend::scattered();
        check_monotone<OcclusionTextureShadow<float>>(any, any.rect(), slices, number);
        check_monotone<OcclusionTextureShadow<float>>(flat, flat.rect(), slices, number);
    }
}

TEST_CASE("a scene that jitters around a threshold does not flicker with the plan of the frame before") {
    // a speck, and a plate beside it, over a patch of the ground
    const float tolerance = 0.02F;
    const RectLight<float> light = lamp(2.0F, 1.0F, 1.0F);
    const auto scene = [](float half) -> Meshes {
        return {test::level_quad(Vec3<float>(0.0F, 0.0F, 1.0F), half, half),
                test::level_quad(Vec3<float>(0.5F, 0.0F, 0.2F), 0.5F, 0.5F)};
    };
    const float patch = 0.01F;
    const Meshes below = ground(patch);
    float least = 1.0F, most = 0.0F;  // where it switches for itself
    for (int i = 0; i < 400; ++i) {
        const float half = 0.0005F * static_cast<float>(i);
        if (plan(scene(half), light, below, tolerance, not_receiving()).casters.size() == 2)
            least = std::min(least, half);
        else
            most = std::max(most, half);
    }
    REQUIRE(least == doctest::Approx(static_cast<double>(most) + 0.0005));
    test::Random random(7);
    Plan<Wedges> kept;
    int flickers = 0, switches = 0, states = 0;
    std::size_t before = 0, stable_before = 0;
    for (int frame = 0; frame < 300; ++frame) {
        // comes from above, stays around the threshold, goes below, comes back to it, and goes
        const float phase = static_cast<float>(frame) / 60.0F;
        const float drift = phase < 1.0F ? 1.5F - 0.5F * phase : phase < 2.0F ? 1.0F : phase < 3.0F ? 0.5F : 1.0F;
        const Meshes casters = scene(least * drift * random.in(0.98F, 1.02F));
        const std::size_t alone = plan(casters, light, below, tolerance, not_receiving()).casters.size();
        PlanSettings<Wedges> settings = not_receiving();
        Plan<Wedges> previous = kept;
        settings.previous = frame > 0 ? &previous : nullptr;
        kept = plan(casters, light, below, tolerance, settings);
        if (frame > 0) flickers += alone != before ? 1 : 0, switches += kept.casters.size() != stable_before ? 1 : 0;
        before = alone, stable_before = kept.casters.size();
        states += kept.casters.size() == 2 ? 1 : 0;
        CHECK(kept.bound <= tolerance + 1e-6F);
        if (frame % 15 == 0) {
            const PlannedShadow<Wedges> planned(casters, kept, below);
            CHECK(worst_on_ground(casters, light, planned, patch) <= kept.bound + 1e-4F);
        }
    }
    CHECK(flickers > 20);
    CHECK(switches <= 3);
    CHECK(states > 50);
    CHECK(states < 280);
}

TEST_CASE("one level quad under a line light is seen by two samples, two quads are not") {
    const LinearLight<float> line{Vec3<float>(-2.0F, 0.0F, 8.0F), Vec3<float>(2.0F, 0.0F, 8.0F)};
    const Meshes one = {test::level_quad(Vec3<float>(0.3F, 0.0F, 2.5F), 1.2F, 0.8F)};
    const auto planned = plan(one, line, ground(6.0F), 0.01F);
    CHECK(!planned.simulates(Effect::extra_samples));
    CHECK(planned.options.most_samples <= planned.options.samples);
    const SoftShadowMap<float> full(one, line, {}, ground(6.0F));
    const PlannedShadow<SoftShadowMap<float>> shadow(one, planned, ground(6.0F));
    CHECK(shadow.shadow().samples() == 2);
    test::Random random(7);
    for (int i = 0; i < 2000; ++i) {
        const float x = random.in(-5.0F, 5.0F), y = random.in(-5.0F, 5.0F);
        const Vec3<float> point(x, y, 0.0F);
        CHECK(std::abs(shadow.visibility(point) - full.visibility(point)) <= 0.01F);
    }

    const Meshes two = {test::level_quad(Vec3<float>(-1.4F, 0.0F, 3.0F), 1.1F, 0.8F),
                        test::level_quad(Vec3<float>(1.4F, 0.0F, 3.0F), 1.1F, 0.8F)};
    CHECK(plan(two, line, ground(6.0F), 0.01F).simulates(Effect::extra_samples));
}

TEST_CASE("a plan says what it decided and by which number") {
    const Meshes casters = {test::box_mesh(Vec3<float>(0.0F, 0.0F, 1.0F), Vec3<float>(0.5F, 0.5F, 0.0F))};
    const Plan<Wedges> made = plan(casters, lamp(2.0F, 1.0F, 1.0F), ground(), 0.01F, not_receiving());
    const std::string text = made.text();
    CAPTURE(text);
    for (const auto& decision : made.decisions) {
        CHECK(text.find(name_of(decision.effect)) != std::string::npos);
        CHECK(decision.text().find("%s") == std::string::npos);
        CHECK(decision.text().find_first_of("0123456789") != std::string::npos);
    }
    CHECK(text.find("the widest penumbra measures 2") != std::string::npos);
    CHECK(std::is_sorted(made.decisions.begin(), made.decisions.end(),
                         [](const auto& a, const auto& b) { return a.effect < b.effect; }));
    CHECK(made.simulates(Effect::slices));  // which it does not have
}

TEST_CASE("plans report what is out of its domain by name") {
    const Meshes casters = {test::box_mesh(Vec3<float>(0.0F, 0.0F, 1.0F), Vec3<float>(0.5F))};
    const RectLight<float> light = lamp(3.0F, 1.0F, 1.0F);
    constexpr std::size_t none = std::string::npos;
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.01F};
    for (const float tolerance : bad)
        CHECK(test::error_of([&] { plan(casters, light, ground(), tolerance); }).find("tolerance = ") != none);
    CHECK(test::error_of([&] { plan(casters, light, ground(), 0.01F); }).empty());
    RectLight<float> skewed = light;
    skewed.half_v = skewed.half_u;
    CHECK(test::error_of([&] { plan(casters, skewed, ground(), 0.01F); }).find("light.half_u") != none);
    PlanSettings<Wedges> settings;
    settings.full.bitmask_size = 7;
    CHECK(test::error_of([&] { plan(casters, light, ground(), 0.01F, settings); }).find("bitmask_size") != none);
}

TEST_CASE("broken meshes are the shadow's to report") {
    Meshes casters = {test::box_mesh<float>(Vec3<float>(0.0F, 0.0F, 2.0F), Vec3<float>(0.3F, 0.3F, 0.3F))};
    casters[0].triangles[3].y = 1000000;
    const Plan<Wedges> planned = plan(casters, lamp(6.0F, 0.5F, 0.5F), ground(), 0.01F, not_receiving());
    CHECK(test::error_of([&] { PlannedShadow<Wedges>(casters, planned); }).find("casters[0]") != std::string::npos);
    casters[0] = test::box_mesh<float>(Vec3<float>(0.0F, 0.0F, 2.0F), Vec3<float>(0.3F, 0.3F, 0.3F));
    casters[0].positions[2].x = std::numeric_limits<float>::quiet_NaN();
    const Plan<Wedges> other = plan(casters, lamp(6.0F, 0.5F, 0.5F), ground(), 0.01F, not_receiving());
    CHECK(test::error_of([&] { PlannedShadow<Wedges>(casters, other); }).find("casters[0]") != std::string::npos);
}

TEST_CASE("nothing casts: nothing is simulated, and everything is lit") {
    const RectLight<float> light = lamp(3.0F, 1.0F, 1.0F);
    const PlannedShadow<Wedges> none({}, plan({}, light, ground(), 0.01F));
    CHECK(none.plan().casters.empty());
    const Vec3<float> points[3] = {Vec3<float>(0.0F), Vec3<float>(1.0F, 0.0F, 0.5F), Vec3<float>(0.0F, 0.0F, 9.0F)};
    float result[3] = {};
    none.visibility(points, 3, result);
    for (const float v : result) CHECK(v >= 1.0F);
    const PlannedShadow<SoftShadowMap<float>> line(
        {}, plan({}, LinearLight<float>{light.center - light.half_u, light.center + light.half_u}, ground(), 0.01F));
    CHECK(line.visibility(points[0]) >= 1.0F);
    const PlannedShadow<UmbraVolumeShadow<float>> disk(
        {}, plan({}, DiskLight<float>{light.center, Vec3<float>(0.0F, 0.0F, -1.0F), 1.0F}, ground(), 0.01F));
    CHECK(disk.visibility(points[0]) >= 1.0F);
}

TEST_CASE("without receivers they are casters, or anywhere") {
    const RectLight<float> light = lamp(3.0F, 1.0F, 1.0F);
    const Meshes one = {test::level_quad(Vec3<float>(0.0F, 0.0F, 1.0F), 0.5F, 0.5F)};
    const Meshes stacked = {one[0], test::level_quad(Vec3<float>(0.0F, 0.0F, 0.5F), 0.5F, 0.5F)};
    CHECK(plan(one, light, {}, 0.0F, not_receiving()).casters == std::vector<std::size_t>{0});
    CHECK(plan(stacked, light, {}, 0.0F).casters.front() == 0);
    // behind the light
    const Meshes behind = {test::box_mesh(Vec3<float>(0.0F, 0.0F, 5.0F), Vec3<float>(0.5F))};
    CHECK(plan(behind, light, ground(), 0.0F).casters.empty());
}
