#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/soft_shadow_map/line_lights.hpp>
#include <string>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/error_of.hpp"
#include "support/polygon_area.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

/// How much of a polygonal light parallel to the floor a point sees, by its exact area: one convex caster.
double exact_area(const std::vector<glm::dvec3>& light, const glm::dvec3& point, const Polygon3& caster) {
    const LightFrame<double> frame = light_frame(RectLight<double>{light[0], {1, 0, 0}, {0, 0, 1}});
    Polygon2 corners;
    for (const glm::dvec3& corner : light) corners.push_back(glm::dvec2(frame.to_light(corner)));
    if (area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
    const double whole = area(corners);
    double hidden = 0.0;
    for (const Polygon2& shadow : project(frame, point, {caster})) hidden += area(intersection(shadow, corners));
    return 1.0 - hidden / whole;
}

}  // namespace

TEST_CASE("a triangle of light, the paper's Figure 8: by its edges, and by lines across it") {
    const std::vector<Vec3<float>> triangle{{-0.9F, 6, -0.6F}, {1.0F, 6, -0.5F}, {0.1F, 6, 0.9F}};
    const std::vector<glm::dvec3> exact{glm::dvec3(triangle[0]), glm::dvec3(triangle[1]), glm::dvec3(triangle[2])};
    const Mesh<float> caster = quad_mesh<float>({0.1F, 2.5F, 0}, {0.9F, 0, 0.2F}, {-0.15F, 0, 0.8F});
    const Polygon3 polygon{glm::dvec3(caster.positions[0]), glm::dvec3(caster.positions[1]),
                           glm::dvec3(caster.positions[2]), glm::dvec3(caster.positions[3])};
    const std::vector<Vec3<float>> points = floor_points<float>(3000, 3.0F, 2.5F);
    std::vector<double> truth;
    for (const Vec3<float>& point : points) truth.push_back(exact_area(exact, glm::dvec3(point), polygon));
    CHECK(std::count_if(truth.begin(), truth.end(), [](double v) { return v > 0.0 && v < 1.0; }) > 700);
    const auto rmse = [&](const std::vector<LinearLight<float>>& lines) {
        SoftShadowMapOptions options;
        options.resolution = 512;
        const SoftShadowMaps<float> shadow({caster}, lines, options);
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double error = static_cast<double>(shadow.visibility(points[i])) - truth[i];
            sum += error * error;
        }
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    const double edges = rmse(polygon_edges(triangle)), four = rmse(polygon_lines(triangle, 4)),
                 sixteen = rmse(polygon_lines(triangle, 16));
    MESSAGE("edges ", edges, ", 4 lines ", four, ", 16 lines ", sixteen);
    CHECK(edges < .08);
    CHECK(four < .02);
    CHECK(sixteen < .006);
    CHECK(four < edges);
    CHECK(sixteen < four);
}

TEST_CASE_TEMPLATE("edges and lines of polygons", T, float, double) {
    const std::vector<Vec3<T>> square{Vec3<T>(T(0), T(5), T(0)), Vec3<T>(T(4), T(5), T(0)), Vec3<T>(T(4), T(5), T(2)),
                                      Vec3<T>(T(0), T(5), T(2))};
    const std::vector<LinearLight<T>> edges = polygon_edges(square);
    REQUIRE(edges.size() == 4);
    CHECK(edges[3].a == square[3]);
    CHECK(edges[3].b == square[0]);
    const std::vector<LinearLight<T>> lines = polygon_lines(square, 4);
    REQUIRE(lines.size() == 4);
    T area = T(0);
    for (const LinearLight<T>& line : lines) {
        CHECK(line.a.z == doctest::Approx(static_cast<double>(line.b.z)));  // along the longest side
        CHECK(glm::length(line.b - line.a) == doctest::Approx(4.0));
        area += glm::length(line.b - line.a) * T(0.5);
    }
    CHECK(area == doctest::Approx(8.0));
    CHECK(lines[0].a.z == doctest::Approx(0.25));
    CHECK(polygon_lines(std::vector<Vec3<T>>{square[0], square[1], square[0]}, 3).empty());
}

TEST_CASE_TEMPLATE("means by length, exactly 0 and 1 where all agree", T, float, double) {
    const std::vector<Mesh<T>> caster{
        quad_mesh(Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(1.2), T(0), T(0)), Vec3<T>(T(0), T(0), T(1)))};
    const LinearLight<T> first{Vec3<T>(T(-1), T(6), T(0)), Vec3<T>(T(0.5), T(6), T(0))};
    const LinearLight<T> second{Vec3<T>(T(0), T(6), T(-0.2)), Vec3<T>(T(0.1), T(6), T(0.3))};
    SoftShadowMapOptions options;
    options.resolution = 128;
    const SoftShadowMaps<T> both(caster, {first, second}, options);
    const SoftShadowMap<T> a(caster, first, options), b(caster, second, options);
    const double la = 1.5, lb = std::sqrt(0.01 + 0.25);
    const std::vector<Vec3<T>> points = floor_points<T>(500, 4.0F, 2.0F);
    std::vector<T> batch(points.size());
    both.visibility(points.data(), points.size(), batch.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const T va = a.visibility(points[i]), vb = b.visibility(points[i]);
        if (va == vb && (va == T(0) || va == T(1))) CHECK(batch[i] == va);
        CHECK(static_cast<double>(batch[i]) ==
              doctest::Approx((la * static_cast<double>(va) + lb * static_cast<double>(vb)) / (la + lb)).epsilon(1e-5));
    }
    CHECK(error_of([&] { SoftShadowMaps<T>(caster, {}); }).find("lines is empty") != std::string::npos);
    const LinearLight<T> point{first.a, first.a};  // lights of no length count alike
    const T v = SoftShadowMaps<T>(caster, {point, point}, options).visibility(points[0]);
    CHECK((v == T(0) || v == T(1)));
}
