#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <string>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"
#include "support/box_mesh.hpp"
#include "support/error_of.hpp"
#include "support/solids.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

constexpr LinearMode all_modes[] = {LinearMode::hard, LinearMode::skins, LinearMode::intervals,
                                    LinearMode::interval_mask};

SoftShadowMapOptions fixed(LinearMode mode, int samples, SkinTransition transition = SkinTransition::exact) {
    SoftShadowMapOptions options;
    options.mode = mode, options.samples = samples, options.most_samples = 0, options.transition = transition;
    options.resolution = 512;
    return options;
}

template <class T>
SoftShadowMap<T> shadow_of(const LineScene<T>& scene, const SoftShadowMapOptions& options) {
    return SoftShadowMap<T>(scene.casters, scene.light, options, {line_scene_floor<T>()});
}

template <class T>
Mesh<T> sphere_mesh(T radius, const Vec3<T>& center, int level = 3) {
    Mesh<T> mesh = icosphere<T>(level);
    for (Vec3<T>& p : mesh.positions) p = p * radius + center;
    return mesh;
}

}  // namespace

TEST_CASE("RMSE with 2, 3, 5 and 9 samples: at least that of the table in formulas.md, and better than plain maps") {
    struct Line {
        LineScene<float> scene;
        double skins[4];  // the table's; hard samples with the same maps there .102 to .139 with two
        double intervals;
    };
    // Two samples may fail where the hidden part is not one interval with an end in view: not on these scenes, by much.
    const Line lines[] = {{wide_blocker<float>(), {.004, .003, .004, .003}, .004},
                          {ten_quads<float>(), {.095, .031, .016, .012}, .010},
                          {eight_quads<float>(), {.184, .048, .019, .012}, .010}};
    constexpr int samples[] = {2, 3, 5, 9};
    for (const Line& line : lines) {
        const LineTruth<float> truth(line.scene, floor_points<float>(2500, 5.0F, 2.0F));
        for (std::size_t i = 0; i < 4; ++i) {
            const double hard = truth.rmse(shadow_of(line.scene, fixed(LinearMode::hard, samples[i])));
            const double skins = truth.rmse(shadow_of(line.scene, fixed(LinearMode::skins, samples[i])));
            const double linear =
                truth.rmse(shadow_of(line.scene, fixed(LinearMode::skins, samples[i], SkinTransition::linear)));
            const double exact = truth.rmse(shadow_of(line.scene, fixed(LinearMode::intervals, samples[i])));
            const double mask = truth.rmse(shadow_of(line.scene, fixed(LinearMode::interval_mask, samples[i])));
            const std::string name = line.scene.name;
            MESSAGE(name, ", ", samples[i], " samples: hard ", hard, "  skins ", skins, ", linear ", linear,
                    "  intervals ", exact, ", mask ", mask);
            CHECK(hard > .015);
            CHECK(skins <= line.skins[i]);
            CHECK(skins < hard);
            CHECK(linear < hard);
            CHECK(exact <= line.intervals);
            CHECK(mask <= line.intervals + .002);
        }
    }
}

TEST_CASE("intervals: .01 with two samples past single casters, .02 with nine through a fence") {
    const LineScene<float> scenes[] = {
        wide_blocker<float>(),
        {"a box", {box_mesh<float>({0.3F, 1.5F, 0}, {0.6F, 0.8F, 0.5F})}},
        {"a sphere", {sphere_mesh<float>(0.7F, {0, 2, 0})}},
        {"a small sphere", {sphere_mesh<float>(0.15F, {0.5F, 3, 0.2F})}},
        {"a tilted quad", {quad_mesh<float>({0, 2, 0}, {0.5F, 0.8F, 0}, {0, 0.4F, 0.7F})}},
        {"under a long light", {box_mesh<float>({0, 2, 0}, {0.5F, 0.5F, 0.5F})}, {{-5, 6, 0}, {5, 6, 0}}},
        {"under an oblique light", {box_mesh<float>({0, 2, 0}, {0.5F, 0.5F, 0.5F})}, {{-1, 5, -1}, {1.5F, 7, 0.5F}}}};
    for (const LineScene<float>& scene : scenes) {
        const LineTruth<float> truth(scene, floor_points<float>(1000, 5.0F, 2.0F));
        const double rmse = truth.rmse(shadow_of(scene, fixed(LinearMode::intervals, 2)));
        const double mask = truth.rmse(shadow_of(scene, fixed(LinearMode::interval_mask, 2)));
        const std::string name = scene.name;
        MESSAGE(name, ": ", rmse, ", mask ", mask);
        CHECK(rmse <= .01);
        CHECK(mask <= .01);
    }
    const LineTruth<float> truth(fence<float>(), floor_points<float>(1500, 5.0F, 2.0F));
    const double rmse = truth.rmse(shadow_of(fence<float>(), fixed(LinearMode::intervals, 9)));
    MESSAGE("a fence: ", rmse);
    CHECK(rmse <= .02);
}

TEST_CASE("receivers tilted from 0° to 80°: exact transitions and eq. 1 stay as good, linear ones do not") {
    double worst_linear = 0.0;
    for (const double degrees : {0.0, 30.0, 45.0, 60.0, 70.0, 80.0}) {
        const double angle = degrees * std::acos(-1.0) / 180.0;
        const Vec3<float> along(static_cast<float>(std::cos(angle)), static_cast<float>(-std::sin(angle)), 0.0F);
        const LineScene<float> scene{
            "a quad", {quad_mesh<float>({0.8F, 3, 0}, {0.25F, 0, 0}, {0, 0, 1})}, {{0.6F, 6, 0}, {1.8F, 6, 0}}};
        const std::vector<Mesh<float>> receiver{quad_mesh<float>({0, 0, 0}, along * 60.0F, {0, 0, -9})};
        Random random(5);
        std::vector<Vec3<float>> points;
        for (int i = 0; i < 3000; ++i) {
            const Vec3<float> across(0, 0, random.in(-1.2F, 1.2F));
            const Vec3<float> point = along * random.in(-2.5F, 3.5F) + across;
            if (point.y < 2.6F) points.push_back(point);
        }
        const LineTruth<float> truth(scene, points);
        double rmse[3];
        for (const SkinTransition transition :
             {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact})
            rmse[static_cast<int>(transition)] = truth.rmse(
                SoftShadowMap<float>(scene.casters, scene.light, fixed(LinearMode::skins, 2, transition), receiver));
        const double intervals =
            truth.rmse(SoftShadowMap<float>(scene.casters, scene.light, fixed(LinearMode::intervals, 2), receiver));
        MESSAGE(degrees, "°: linear ", rmse[0], ", eq. 1 ", rmse[1], ", exact ", rmse[2], ", intervals ", intervals);
        CHECK(rmse[1] <= rmse[0] + .001);
        if (degrees < 80.0) CHECK(rmse[1] < .004);  // there some rays behind the quad's sides miss the receiver
        CHECK(rmse[2] < .008);
        CHECK(intervals < .008);
        worst_linear = std::max(worst_linear, rmse[0]);
    }
    CHECK(worst_linear > .03);
}

TEST_CASE("no seams: two texels from a border everything is exactly lit or exactly dark") {
    const LineScene<float> scenes[] = {wide_blocker<float>(),
                                       ten_quads<float>(),
                                       two_blockers<float>(),
                                       {"a box", {box_mesh<float>({0.3F, 1.5F, 0}, {0.9F, 0.8F, 0.7F})}}};
    for (const LineScene<float>& scene : scenes) {
        constexpr int columns = 160, rows = 80;
        constexpr float half_x = 5.0F, half_z = 2.0F;
        std::vector<Vec3<float>> points;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i)
                points.emplace_back((2.0F * (static_cast<float>(i) + 0.5F) / columns - 1.0F) * half_x, 0.0F,
                                    (2.0F * (static_cast<float>(j) + 0.5F) / rows - 1.0F) * half_z);
        const LineTruth<float> truth(scene, points);
        // texels on the floor are smaller than the grid's cells: neighbours of a kind leave two texels and more
        const SoftShadowMap<float> any = shadow_of(scene, fixed(LinearMode::hard, 2));
        const Vec2<float> texel = extent(any.maps().view().slopes) * (6.0F / 512.0F);
        REQUIRE(2.0F * half_x / columns > texel.x);
        REQUIRE(2.0F * half_z / rows > texel.y);
        const auto kind = [&](int i, int j) {
            const double v = truth.visible[static_cast<std::size_t>(j * columns + i)];
            return v <= 1e-9 ? 0 : v >= 1.0 - 1e-9 ? 2 : 1;
        };
        std::vector<std::size_t> lit, dark;
        for (int j = 2; j + 2 < rows; ++j)
            for (int i = 2; i + 2 < columns; ++i) {
                bool same = kind(i, j) != 1;
                for (int dj = -2; dj <= 2; ++dj)
                    for (int di = -2; di <= 2; ++di) same = same && kind(i + di, j + dj) == kind(i, j);
                if (same) (kind(i, j) == 2 ? lit : dark).push_back(static_cast<std::size_t>(j * columns + i));
            }
        CHECK(lit.size() > 1000);
        for (const LinearMode mode : all_modes)
            for (const SkinTransition transition :
                 {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact})
                for (const int samples : {2, 5}) {
                    if (mode != LinearMode::skins && transition != SkinTransition::exact) continue;
                    const SoftShadowMap<float> shadow = shadow_of(scene, fixed(mode, samples, transition));
                    const auto wrong = [&](const std::vector<std::size_t>& which, float right) {
                        return std::count_if(which.begin(), which.end(),
                                             [&](std::size_t i) { return shadow.visibility(points[i]) != right; });
                    };
                    const std::string name = scene.name;
                    CAPTURE(name);
                    CAPTURE(static_cast<int>(mode));
                    CAPTURE(static_cast<int>(transition));
                    CAPTURE(samples);
                    CHECK(wrong(lit, 1.0F) == 0);
                    CHECK(wrong(dark, 0.0F) == 0);
                }
    }
}

TEST_CASE("casters do not shadow the side that looks at the light, and do shadow the other") {
    const LineScene<float> scene{
        "a box and a sphere",
        {box_mesh<float>({-1, 1.5F, 0}, {0.5F, 0.5F, 0.5F}), sphere_mesh<float>(0.7F, {1.2F, 2, 0}, 4)}};
    for (const LinearMode mode : all_modes) {
        const SoftShadowMap<float> shadow = shadow_of(scene, fixed(mode, 3));
        Random random(6);
        int lit = 0, dark = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3<float> top(random.in(-1.45F, -0.55F), 2.0F, random.in(-0.45F, 0.45F));
            lit += shadow.visibility(top) == 1.0F;
            const Vec3<float> below(-1.0F + 0.7F * (top.x + 1.0F), 1.0F, top.z);  // edges are known to a texel
            dark += shadow.visibility(below) == 0.0F;
            // the upper cap of the sphere, which sees all of the light past its own horizon
            const float around = random.in(0.0F, 6.28F), away = 0.3F * std::sqrt(random.in(0.0F, 1.0F));
            const Vec3<float> normal(away * std::cos(around), std::sqrt(1.0F - away * away), away * std::sin(around));
            lit += shadow.visibility(Vec3<float>(1.2F, 2, 0) + normal * 0.7F) == 1.0F;
            dark += shadow.visibility(Vec3<float>(1.2F, 2, 0) - normal * 0.7F) == 0.0F;
        }
        CAPTURE(static_cast<int>(mode));
        CHECK(lit >= 7960);
        CHECK(dark >= 7960);
    }
}

TEST_CASE("edges parallel to the light have no penumbra, those across it do") {
    // a quad wider than all rows that are asked, one edge along the light
    const LineScene<float> scene{"a quad", {quad_mesh<float>({0, 3, 1}, {20, 0, 0}, {0, 0, 1})}};
    for (const LinearMode mode : all_modes) {
        const SoftShadowMap<float> shadow = shadow_of(scene, fixed(mode, 2));
        for (float z = -1.0F; z < 1.0F; z += 0.013F) {
            const float v = shadow.visibility({0.1F, 0, z});
            CHECK((v == 0.0F || v == 1.0F));
            if (std::abs(z) > 0.1F) CHECK(v == (z < 0.0F ? 1.0F : 0.0F));
        }
    }
    const LineScene<float> across{"a quad", {quad_mesh<float>({1, 3, 0}, {1, 0, 0}, {0, 0, 20})}};
    for (const LinearMode mode : {LinearMode::skins, LinearMode::intervals})
        CHECK(shadow_of(across, fixed(mode, 2)).visibility({0, 0, 0}) == doctest::Approx(0.5).epsilon(0.03));
}

TEST_CASE("a receiver in a plane through the light, all of whose points share a row") {
    const LineScene<float> scene{"a box", {box_mesh<float>({0.2F, 3, 0.02F}, {0.4F, 0.3F, 0.5F})}};
    Random random(8);
    std::vector<Vec3<float>> points;
    for (int i = 0; i < 2000; ++i) {
        const float x = random.in(-4.0F, 4.0F);
        points.emplace_back(x, random.in(-1.0F, 2.6F), 0.0F);
    }
    const LineTruth<float> truth(scene, points);
    // a solid's silhouette is another one from each end of the light: skins know but two of them
    for (const LinearMode mode : {LinearMode::skins, LinearMode::intervals, LinearMode::interval_mask})
        CHECK(truth.rmse(SoftShadowMap<float>(scene.casters, scene.light, fixed(mode, 2))) <
              (mode == LinearMode::skins ? .03 : .006));
}

TEST_CASE_TEMPLATE("a light of no length casts hard shadows", T, float, double) {
    LineScene<T> scene = wide_blocker<T>();
    scene.light.a = scene.light.b = Vec3<T>(T(0), T(6), T(0));
    const std::vector<Vec3<T>> points = floor_points<T>(2000, 4.0F, 2.0F);
    LineScene<T> nearly = scene;
    nearly.light.b.x += T(1e-4);
    const LineTruth<T> truth(nearly, points);
    for (const LinearMode mode : all_modes) {
        const SoftShadowMap<T> shadow = shadow_of(scene, fixed(mode, 3));
        int right = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const T v = shadow.visibility(points[i]);
            CHECK((v == T(0) || v == T(1)));
            right += std::abs(static_cast<double>(v) - truth.visible[i]) < 0.01;
        }
        CHECK(right > 1980);
    }
}

TEST_CASE_TEMPLATE("where there is nothing to say: no casters, behind the light, end-on, not finite", T, float,
                   double) {
    const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    const LinearLight<T> light{Vec3<T>(T(-1), T(6), T(0)), Vec3<T>(T(1), T(6), T(0))};
    const std::vector<Mesh<T>> nothing{{}, Mesh<T>{{Vec3<T>(T(0), T(1), T(0))}, {}}};
    for (const LinearMode mode : all_modes) {
        CHECK(SoftShadowMap<T>({}, light, fixed(mode, 2)).visibility({T(0), T(0), T(0)}) == T(1));
        CHECK(SoftShadowMap<T>(nothing, light, fixed(mode, 2)).visibility({T(0), T(0), T(0)}) == T(1));
        const SoftShadowMap<T> shadow(wide_blocker<T>().casters, light, fixed(mode, 2));
        CHECK(shadow.visibility({T(0), T(7), T(0)}) == T(1));    // behind
        CHECK(shadow.visibility({T(9), T(6), T(0)}) == T(1));    // end-on: in the light's own line
        CHECK(shadow.visibility({T(0.3), T(6), T(0)}) == T(1));  // on the light
        CHECK(shadow.visibility({T(500), T(0), T(0)}) == T(1));  // outside of the image
        CHECK(shadow.visibility({T(0), T(0), T(-500)}) == T(1));
        for (const Vec3<T>& point :
             {Vec3<T>(nan, T(0), T(0)), Vec3<T>(T(0), infinity, T(0)), Vec3<T>(T(0), -infinity, nan)})
            CHECK(shadow.visibility(point) == T(1));
        // no triangle before the light
        const Mesh<T> above = box_mesh<T>(Vec3<T>(T(0), T(6), T(0)), Vec3<T>(T(0.1), T(0.1), T(0.1)));
        CHECK(is_finite(SoftShadowMap<T>({above}, light, fixed(mode, 2)).visibility({T(0), T(0), T(0)})));
    }
}

TEST_CASE("casters across the light's plane and line, huge ones, depth ranges of 1e5, a million units away") {
    const LineScene<float> scenes[] = {
        {"across the light's line",
         {quad_mesh<float>({0, 6, 0}, {0, 1, 0}, {0, 0, 1}), wide_blocker<float>().casters[0]}},
        {"across the light's plane", {quad_mesh<float>({2, 5, 0}, {0, 3, 0}, {0, 0, 1})}},
        {"larger than any map", {quad_mesh<float>({1000, 3, 0}, {1000, 0, 0}, {0, 0, 1000})}},
        {"near and far",
         {quad_mesh<float>({0, 5.999F, 0}, {1e-4F, 0, 0}, {0, 0, 1e-4F}),
          quad_mesh<float>({0, -90, 0}, {30, 0, 0}, {0, 0, 30})}},
        {"nearer to the floor than a texel", {quad_mesh<float>({0, 0.004F, 0}, {1, 0, 0}, {0, 0, 1})}}};
    for (const LineScene<float>& scene : scenes)
        for (const LinearMode mode : all_modes) {
            const SoftShadowMap<float> shadow = shadow_of(scene, fixed(mode, 3));
            for (const Vec3<float>& point : floor_points<float>(500, 4.0F, 2.0F)) {
                const float v = shadow.visibility(point);
                CHECK((v >= 0.0F && v <= 1.0F));
            }
        }
    // what is larger than a map is cut at its border, beyond slopes of 16; within, it is right
    const SoftShadowMap<float> large = shadow_of(scenes[2], fixed(LinearMode::intervals, 2));
    CHECK(large.visibility({20, 0, 0}) == 0.0F);
    CHECK(large.visibility({-20, 0, 0}) == 1.0F);
    // within a texel's depth behind a caster, points count as on it
    CHECK(shadow_of(scenes[4], fixed(LinearMode::intervals, 2)).visibility({0.3F, 0, 0.2F}) == 1.0F);
    const LineScene<float> higher{"a little higher", {quad_mesh<float>({0, 0.1F, 0}, {1, 0, 0}, {0, 0, 1})}};
    CHECK(shadow_of(higher, fixed(LinearMode::intervals, 2)).visibility({0.3F, 0, 0.2F}) == 0.0F);

    LineScene<double> away = wide_blocker<double>();
    const Vec3<double> offset(1e6, -2e6, 3e6);
    const LineTruth<double> truth(away, floor_points<double>(1000, 4.0F, 2.0F));
    for (Mesh<double>& mesh : away.casters)
        for (Vec3<double>& p : mesh.positions) p += offset;
    away.light.a += offset, away.light.b += offset;
    const SoftShadowMap<double> shadow(away.casters, away.light, fixed(LinearMode::intervals, 2));
    LineTruth<double> moved = truth;
    for (Vec3<double>& p : moved.points) p += offset;
    CHECK(moved.rmse(shadow) < .006);
}

TEST_CASE("options out of their domain are named") {
    const LineScene<float> scene = wide_blocker<float>();
    const auto error = [&](auto&& change) {
        SoftShadowMapOptions options;
        change(options);
        return error_of([&] { SoftShadowMap<float>(scene.casters, scene.light, options); });
    };
    CHECK(error([](auto&) {}).empty());
    CHECK(error([](auto& o) { o.resolution = 0; }).find("options.resolution = 0") != std::string::npos);
    CHECK(error([](auto& o) { o.resolution = 20000; }).find("options.resolution") != std::string::npos);
    CHECK(error([](auto& o) { o.samples = 1; }).find("options.samples = 1") != std::string::npos);
    CHECK(error([](auto& o) { o.samples = 65; }).find("options.samples") != std::string::npos);
    CHECK(error([](auto& o) { o.most_samples = 65; }).find("options.most_samples") != std::string::npos);
    CHECK(error([](auto& o) { o.tolerance = 0.0F; }).find("options.tolerance = 0") != std::string::npos);
    CHECK(error([](auto& o) { o.step = -1.0F; }).find("options.step = -1") != std::string::npos);
    CHECK(error([](auto& o) { o.step = std::numeric_limits<float>::quiet_NaN(); }).find("options.step") !=
          std::string::npos);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(error_of([&] {
              SoftShadowMap<float>(scene.casters, {{nan, 0, 0}, {1, 0, 0}});
          }).find("light.a") != std::string::npos);
    CHECK(error_of([&] {
              SoftShadowMap<float>({{{{0, 0, 0}}, {{0, 1, 2}}}}, scene.light);
          }).find("casters[0]") != std::string::npos);
}
