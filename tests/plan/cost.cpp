// Costs as measured here, plans for a time, and fronts of methods.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <penumbra/plan/cost.hpp>
#include <penumbra/plan/method_front.hpp>
#include <vector>

#include "support/box_mesh.hpp"

using namespace penumbra;

namespace {

const Mesh<float> ground{{{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}}, {{0, 1, 2}, {0, 2, 3}}};
const RectLight<float> rect{{0, 5, 0}, {0.5F, 0, 0}, {0, 0, 0.5F}};

/// One partly before the other, as the ground sees them.
std::vector<Mesh<float>> two_boxes() {
    return {test::box_mesh<float>({-0.5F, 1.5F, 0}, {0.4F, 0.2F, 0.4F}),
            test::box_mesh<float>({0.1F, 2.5F, 0}, {0.4F, 0.2F, 0.4F})};
}

/// A machine on which every effect takes half of the time.
CostTable made_up() {
    CostTable costs;
    for (MethodCost* cost : {&costs.penumbra_wedge, &costs.edge_sum, &costs.d_buffer, &costs.intervals, &costs.skins,
                             &costs.occlusion_texture}) {
        cost->full = 400.0;
        cost->without.fill(200.0);
        cost->per_edge = 1.0;
    }
    costs.occlusion_texture.full = 100.0, costs.occlusion_texture.without.fill(50.0);
    costs.occlusion_texture.per_edge = 0.0;
    costs.edges = 10.0;
    return costs;
}

PlanSettings<PenumbraWedgeShadow<float>> ground_only() {
    PlanSettings<PenumbraWedgeShadow<float>> settings;
    settings.casters_receive = false;
    return settings;
}

}  // namespace

TEST_CASE("costs are measured in a second") {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const CostTable costs = measure_costs<float>();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    MESSAGE(seconds, " s");
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
    CHECK(seconds < 5.0);  // a second where nothing else runs
#endif
    for (const MethodCost* cost : {&costs.penumbra_wedge, &costs.edge_sum, &costs.d_buffer, &costs.intervals,
                                   &costs.skins, &costs.occlusion_texture}) {
        CHECK(cost->full > 0.1);
        CHECK(cost->full < 1e6);
        CHECK(cost->share_without(Effect::casters) == 1.0);
    }
    CHECK(costs.penumbra_wedge.per_edge > 0.0);
    CHECK(costs.penumbra_wedge.share_without(Effect::overlap) > 0.0);
    CHECK(costs.edges > 0.0);
}

TEST_CASE("a plan for a time leaves out what it must, and no more") {
    const std::vector<Mesh<float>> casters = two_boxes();
    const CostTable costs = made_up();
    const auto plan_within = [&](double ns) {
        return plan_for_time(casters, rect, {ground}, ns, costs, 0.0, ground_only());
    };
    const auto all = plan_within(400.0);
    CHECK(all.simulates(Effect::overlap));
    CHECK(all.simulates(Effect::silhouettes_per_point));
    CHECK(std::abs(predicted_ns(all, costs, 400.0) - 400.0) < 1e-6);
    CHECK(!(all.bound > 0.0F));

    const auto one = plan_within(250.0);  // of two that save as much, that which loses less
    CHECK(one.simulates(Effect::overlap) != one.simulates(Effect::silhouettes_per_point));
    CHECK(std::abs(predicted_ns(one, costs, 400.0) - 200.0) < 1e-6);
    CHECK(one.bound > 0.0F);

    const auto both = plan_within(1.0);  // which cannot be reached
    CHECK(!both.simulates(Effect::overlap));
    CHECK(!both.simulates(Effect::silhouettes_per_point));
    CHECK(both.casters.size() == 2);
    CHECK(both.bound >= one.bound);
    CHECK(both.options.overlap == OverlapRule::additive);
    CHECK(both.options.silhouette == SilhouetteFrom::light_center);
}

TEST_CASE("a plan for a time scales with what its owner measured") {
    const CostTable costs = made_up();
    const auto slow = plan_for_time(two_boxes(), rect, {ground}, 400.0, costs, 1000.0, ground_only());
    CHECK(std::abs(predicted_ns(slow, costs, 1000.0) - 250.0) < 1e-6);
}

TEST_CASE("what loses nothing is always left out of a plan for a time") {
    const std::vector<Mesh<float>> apart = {test::box_mesh<float>({-2, 1, 0}, {0.2F, 0.2F, 0.2F}),
                                            test::box_mesh<float>({2, 1, 0}, {0.2F, 0.2F, 0.2F})};
    const auto plan = plan_for_time(apart, rect, {ground}, 1e9, made_up(), 0.0, ground_only());
    CHECK(!plan.simulates(Effect::overlap));
    CHECK(!(plan.bound > 0.0F));
}

TEST_CASE("fronts go from exact to fast") {
    const CostTable costs = made_up();
    const auto check = [](const auto& front) {
        REQUIRE(!front.empty());
        for (std::size_t i = 1; i < front.size(); ++i) {
            CHECK(front[i].bound > front[i - 1].bound);
            CHECK(front[i].ns < front[i - 1].ns);
        }
    };
    const std::vector<Mesh<float>> casters = two_boxes();
    const auto by_rect = method_front(casters, rect, {ground}, costs);
    check(by_rect);
    CHECK(by_rect.front().method == PlannedMethod::penumbra_wedge);
    CHECK(by_rect.back().method == PlannedMethod::occlusion_texture);
    check(method_front(casters, DiskLight<float>{{0, 5, 0}, {0, -1, 0}, 0.5F}, {ground}, costs));
    check(method_front(casters, LinearLight<float>{{-0.5F, 5, 0}, {0.5F, 5, 0}}, {ground}, costs));

    // within a tolerance the fastest, and the most exact where none is
    CHECK(fastest_within(by_rect, 0.0F).method == PlannedMethod::penumbra_wedge);
    CHECK(fastest_within(by_rect, 2.0F).method == PlannedMethod::occlusion_texture);
    const MethodChoice<float> chosen = fastest_within(by_rect, 0.05F);
    CHECK(chosen.bound <= 0.05F);
    for (const auto& other : by_rect) CHECK((other.bound > 0.05F || other.ns >= chosen.ns));
}

TEST_CASE("casters that hide next to nothing make a fast method as good") {
    const std::vector<Mesh<float>> speck = {test::box_mesh<float>({0, 3, 0}, {0.02F, 0.02F, 0.02F})};
    const auto front = method_front(speck, rect, {ground}, made_up(), false);
    const auto chosen = fastest_within(front, 0.05F);
    CHECK(chosen.bound <= 0.05F);
    CHECK(chosen.ns <= 50.0);
}
