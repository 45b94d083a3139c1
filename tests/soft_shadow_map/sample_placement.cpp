#include <doctest/doctest.h>

#include <algorithm>
#include <penumbra/soft_shadow_map/sample_placement.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <string>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/solids.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

SoftShadowMapOptions options_of(LinearMode mode, int samples, int most) {
    SoftShadowMapOptions options;
    options.mode = mode, options.samples = samples, options.most_samples = most, options.resolution = 512;
    return options;
}

template <class T>
SoftShadowMap<T> shadow_of(const LineScene<T>& scene, const SoftShadowMapOptions& options) {
    return SoftShadowMap<T>(scene.casters, scene.light, options, {line_scene_floor<T>()});
}

template <class T>
detail::LightMapMaker<T> maker_of(const std::vector<Mesh<T>>& casters) {
    const LightFrame<T> frame = light_frame(light_along_x<T>(), Vec3<T>(T(0), T(-1), T(0)));
    return detail::LightMapMaker<T>(light_map_geometry(casters, {}, frame, T(1), 512));
}

}  // namespace

TEST_CASE("Figure 6: from two samples to an RMSE of .01") {
    const LineScene<float> scene = two_blockers<float>();
    // not at the shadow's sides along the light, which are hard, and right to a texel
    const LineTruth<float> truth(scene, floor_points<float>(2000, 5.0F, 1.6F));
    for (const SkinTransition transition : {SkinTransition::linear, SkinTransition::exact}) {
        SoftShadowMapOptions options = options_of(LinearMode::skins, 2, 0);
        options.transition = transition;
        CHECK(truth.rmse(shadow_of(scene, options)) > .1);
        options.most_samples = 64;
        const SoftShadowMap<float> shadow = shadow_of(scene, options);
        const double rmse = truth.rmse(shadow);
        MESSAGE(rmse, " with ", shadow.samples());
        CHECK(rmse <= .01);
        CHECK(shadow.samples() <= 10);
    }
}

TEST_CASE("never more than twice the samples that the best fixed count needs for the same RMSE") {
    LineScene<float> sphere{"a sphere", {icosphere<float>(3)}};
    for (Vec3<float>& p : sphere.casters[0].positions) p = p * 0.7F + Vec3<float>(0, 2, 0);
    for (const LineScene<float>& scene : {wide_blocker<float>(), two_blockers<float>(), ten_quads<float>(),
                                          eight_quads<float>(), fence<float>(), sphere}) {
        const LineTruth<float> truth(scene, floor_points<float>(1000, 5.0F, 1.6F));
        for (const LinearMode mode : {LinearMode::skins, LinearMode::intervals}) {
            const SoftShadowMap<float> shadow = shadow_of(scene, options_of(mode, 2, 64));
            const double rmse = truth.rmse(shadow);
            const std::string name = scene.name, how = mode == LinearMode::skins ? "skins" : "intervals";
            MESSAGE(name, ", ", how, ": ", shadow.samples(), " samples, RMSE ", rmse);
            for (int count = 2; 2 * count < shadow.samples(); ++count) {
                CAPTURE(count);  // even ones, fewer than half: neither as good nor good enough
                CHECK(truth.rmse(shadow_of(scene, options_of(mode, count, 0))) > std::max(rmse, .01));
            }
            CHECK(rmse <= .025);
        }
    }
}

TEST_CASE("insertion goes to where it is needed") {
    // All that is difficult is seen from the light's right half: a gap beside a wall that hides it from the left.
    const LineScene<float> scene{"a gap to the right",
                                 {quad_mesh<float>({1.1F, 3, 0}, {0.5F, 0, 0}, {0, 0, 1}),
                                  quad_mesh<float>({2.3F, 3, 0}, {0.5F, 0, 0}, {0, 0, 1}),
                                  quad_mesh<float>({0.3F, 4.5F, 0}, {0, 0.7F, 0}, {0, 0, 1})}};
    const SoftShadowMap<float> shadow = shadow_of(scene, options_of(LinearMode::skins, 2, 64));
    REQUIRE(shadow.samples() >= 4);
    std::vector<float> steps;
    for (int i = 0; i + 1 < shadow.samples(); ++i)
        steps.push_back(shadow.maps().position(i + 1) - shadow.maps().position(i));
    for (const float step : steps) CHECK(step > 0.0F);
    CHECK(shadow.maps().position(0) == -1.0F);
    CHECK(shadow.maps().position(shadow.samples() - 1) == 1.0F);
    CHECK(*std::max_element(steps.begin(), steps.end()) > 1.5F * *std::min_element(steps.begin(), steps.end()));
}

TEST_CASE("one caster that is seen as a whole needs no more than two maps; a tolerance above 1 inserts none") {
    CHECK(shadow_of(wide_blocker<float>(), options_of(LinearMode::skins, 2, 64)).samples() == 2);
    CHECK(shadow_of(wide_blocker<float>(), options_of(LinearMode::intervals, 2, 64)).samples() == 2);
    CHECK(shadow_of(two_blockers<float>(), options_of(LinearMode::intervals, 2, 64)).samples() == 2);
    SoftShadowMapOptions options = options_of(LinearMode::skins, 2, 64);
    options.tolerance = 1.5F;
    CHECK(shadow_of(fence<float>(), options).samples() == 2);
    CHECK(shadow_of(fence<float>(), options_of(LinearMode::skins, 5, 4)).samples() == 5);
    CHECK(shadow_of(fence<float>(), options_of(LinearMode::skins, 2, 7)).samples() == 7);
}

TEST_CASE_TEMPLATE("the narrowest gap: its width to a texel, never too wide", T, float, double) {
    const auto bars = [](double left, double right, double gap, double depth) {
        // two bars, the gap between them at x = 0
        const auto bar = [&](double center) {
            return quad_mesh(Vec3<T>(static_cast<T>(center), static_cast<T>(6.0 - depth), T(0)),
                             Vec3<T>(T(0.5), T(0), T(0)), Vec3<T>(T(0), T(0), T(1)));
        };
        return std::vector<Mesh<T>>{bar(-0.5 * gap - left), bar(0.5 * gap + right)};
    };
    for (const double gap : {0.05, 0.2, 0.7})
        for (const double depth : {2.0, 4.0}) {
            const detail::LightMapMaker<T> maker = maker_of(bars(0.5, 0.5, gap, depth));
            const LightMap<T> map = maker.make(T(0));
            const T found = narrowest_gap(maker.view(), map, T(0.01));
            const double texel = static_cast<double>(extent(maker.view().slopes).x) / 512.0 * depth;
            CHECK(static_cast<double>(found) <= gap + 1e-6);
            CHECK(static_cast<double>(found) > gap - 2.5 * texel);
        }
    // no gap: one bar, or two that overlap
    const detail::LightMapMaker<T> one = maker_of(std::vector<Mesh<T>>{bars(0.5, 0.5, 0.2, 2.0)[0]});
    CHECK(narrowest_gap(one.view(), one.make(T(0)), T(0.01)) == LightMap<T>::none);
    const detail::LightMapMaker<T> over = maker_of(bars(0.3, 0.3, 0.0, 2.0));
    CHECK(narrowest_gap(over.view(), over.make(T(0)), T(0.01)) == LightMap<T>::none);

    CHECK(samples_for_gap(T(2), T(1), 64) == 3);
    CHECK(samples_for_gap(T(2), T(0.9), 64) == 4);
    CHECK(samples_for_gap(T(2), T(0.001), 64) == 64);
    CHECK(samples_for_gap(T(2), LightMap<T>::none, 64) == 2);
    CHECK(samples_for_gap(T(0), T(1), 64) == 2);
}

TEST_CASE("samples by the narrowest gap see through it, where a test half-way may look past it") {
    // points see a slit of the light that no map between two blockers looks through, but for a few
    const Vec3<float> u(1, 0, 0), v(0, 0, 1);
    const LineScene<float> slit{"a slit",
                                {quad_mesh<float>({-1.05F, 2.5F, 0}, u, v), quad_mesh<float>({1.05F, 2.5F, 0}, u, v)},
                                {{-1.5F, 6, 0}, {1.5F, 6, 0}}};
    const LineTruth<float> truth(slit, floor_points<float>(2000, 3.0F, 1.5F));
    SoftShadowMapOptions options = options_of(LinearMode::skins, 2, 64);
    options.narrowest_gap = true, options.resolution = 256;
    const SoftShadowMap<float> shadow = shadow_of(slit, options);
    const double rmse = truth.rmse(shadow), two = truth.rmse(shadow_of(slit, options_of(LinearMode::skins, 2, 0)));
    MESSAGE("RMSE ", rmse, " with ", shadow.samples(), ", with two ", two);
    CHECK(shadow.samples() >= 31);
    CHECK(rmse < .01);
    CHECK(two > .03);
}
