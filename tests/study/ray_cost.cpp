#include "../../examples/study/ray_cost.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace penumbra::study;

namespace {

/// Errors e · n^−p at c ns a ray: straight lines in log-log, so that interpolation has a closed form.
void add_sampler(std::vector<RayRow>& rows, const char* name, int packet, double e, double p, double c) {
    for (int n = 1024; n >= 4; n /= 2) rows.push_back({"scene", name, packet, n, e * std::pow(n, -p), c * n});
}

std::vector<RayRow> two_samplers() {
    std::vector<RayRow> rows;
    add_sampler(rows, "sobol", 16, 0.5, 0.75, 3.0);
    add_sampler(rows, "stratified", 1, 0.4, 0.5, 2.0);
    rows.push_back({"another scene", "sobol", 1, 4, 0.001, 0.001});
    return rows;
}

// Six products and powers in double; 1e-12 is far above their rounding and far below any figure shown.
doctest::Approx near(double x) { return doctest::Approx(x).epsilon(1e-12); }

}  // namespace

TEST_CASE("cost at equal error is exact where error and time are powers of the number of rays") {
    const std::vector<RayRow> rows = two_samplers();
    for (const double rmse : {0.15, 0.1, 0.05, 0.02, 0.013}) {
        CAPTURE(rmse);
        const double sobol_rays = std::pow(rmse / 0.5, -1.0 / 0.75), stratified_rays = std::pow(rmse / 0.4, -2.0);
        const bool sobol_wins = 3.0 * sobol_rays < 2.0 * stratified_rays;
        const RayCost cost = ray_cost(rows, "scene", rmse);
        CHECK(cost.bound == Bound::none);
        CHECK(cost.rays == near(sobol_wins ? sobol_rays : stratified_rays));
        CHECK(cost.ns == near(sobol_wins ? 3.0 * sobol_rays : 2.0 * stratified_rays));
        CHECK(cost.sampler == (sobol_wins ? "sobol, packets of 16" : "stratified"));
    }
}

TEST_CASE("cost at equal error is the row itself at the error of a row") {
    std::vector<RayRow> rows;
    add_sampler(rows, "r2", 1, 0.5, 0.75, 3.0);
    for (const RayRow& row : rows) {
        CAPTURE(row.rays);
        const RayCost cost = ray_cost(rows, "scene", row.rmse);
        CHECK(cost.bound == Bound::none);
        CHECK(cost.ns == near(row.ns_per_point));
        CHECK(cost.rays == near(row.rays));
    }
}

TEST_CASE("cost at equal error is bounded, never extrapolated, outside of the sweep") {
    const std::vector<RayRow> rows = two_samplers();
    const RayCost fewer = ray_cost(rows, "scene", 0.9);  // both have less error with 4 rays: 12 and 8 ns
    CHECK(fewer.bound == Bound::upper);
    CHECK(fewer.ns == near(8.0));
    CHECK(fewer.rays == near(4.0));
    const RayCost more = ray_cost(rows, "scene", 1e-6);  // both have more error with 1024 rays: 3072 and 2048 ns
    CHECK(more.bound == Bound::lower);
    CHECK(more.ns == near(2048.0));
    CHECK(more.rays == near(1024.0));
    CHECK(ray_cost(rows, "scene", 0.0).bound == Bound::lower);
}

TEST_CASE("cost at equal error comes from a sampler that reaches it, though a cheaper one ends before") {
    const std::vector<RayRow> rows = two_samplers();
    const double rmse = 0.004;  // stratified ends at .0125
    const RayCost cost = ray_cost(rows, "scene", rmse);
    CHECK(cost.bound == Bound::none);
    CHECK(cost.sampler == "sobol, packets of 16");
    CHECK(cost.ns == near(3.0 * std::pow(rmse / 0.5, -1.0 / 0.75)));
}

TEST_CASE("a bound comes from the samplers that were swept furthest, though others end cheaper") {
    std::vector<RayRow> rows = two_samplers();
    for (int n = 4; n <= 256; n *= 2) rows.push_back({"scene", "r2", 1, n, 0.45 * std::pow(n, -0.5), 2.5 * n});
    const RayCost cost = ray_cost(rows, "scene", 1e-6);  // r2 ends at 640 ns
    CHECK(cost.bound == Bound::lower);
    CHECK(cost.rays == near(1024.0));
    CHECK(cost.ns == near(2048.0));
}

TEST_CASE("cost at equal error survives an error of zero and a scene without rays") {
    const std::vector<RayRow> rows = {{"scene", "r2", 1, 4, 0.1, 40.0}, {"scene", "r2", 1, 8, 0.0, 80.0}};
    const RayCost exact = ray_cost(rows, "scene", 0.0), between = ray_cost(rows, "scene", 0.05);
    CHECK(exact.bound == Bound::none);
    CHECK(exact.ns == near(80.0));
    CHECK(between.ns == near(80.0));  // no logarithm of 0: the row that is accurate enough
    CHECK_FALSE(ray_cost(rows, "nowhere", 0.1).ns > 0.0);
}
