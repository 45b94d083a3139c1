// The queries of soft shadow maps on the driver, by the texels of the C++: in compute shaders for every option, and by
// way of SPIRV-Cross.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "compute.hpp"
#include "float_texture.hpp"
#include "map_cases.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::Difference;
using test::FloatTexture;
using test::MapCase;
using test::Program;
using test::Route;

namespace {

const bool mutant = std::getenv("PENUMBRA_SHADERS") != nullptr;
const int points = mutant ? 1024 : 8192;  // a scene

void set_uniforms(const MapCase& query, const Program& program) {
    const LightMapView<float>& view = query.view();
    program.set("low", view.slopes.min), program.set("high", view.slopes.max);
    program.set("resolution", view.resolution);
    if (test::has_segments(query.shadow.options())) {
        program.set("segments", 0);
        program.set("first", query.shadow.segments().first()), program.set("last", query.shadow.segments().last());
    } else {
        program.set("maps", 0), program.set("edges", 1);
        program.set("count", query.shadow.maps().count());
    }
}

test::Compute compute_of(const SoftShadowMapOptions& options, Route route) {
    const std::string view =
        "penumbra_LightMapView view; view.slopes = penumbra_rect2(low, high); view.resolution = resolution; ";
    const std::string borders = "uniform vec2 low, high; uniform int resolution; ";
    if (test::has_segments(options))
        return {"soft_shadow_map/row_segments.glsl",
                3,
                1,
                test::map_defines(options),
                borders + "uniform highp sampler2D segments; uniform float first, last;\n",
                view + "O(0) = penumbra_visibility(segments, view, first, last, vec3(I(0), I(1), I(2)));",
                route};
    return {"soft_shadow_map/skin_maps.glsl",
            3,
            1,
            test::map_defines(options),
            borders + "uniform highp sampler2D maps, edges; uniform int count;\n",
            view + "O(0) = penumbra_visibility(maps, edges, view, count, vec3(I(0), I(1), I(2)));",
            route};
}

/// A rounding of a weight, a share or a sum. Rows, columns and cells are those of the C++, also of points on their
/// borders: a driver that rounds its divisions as it pleases, as 2.5 ULP allow, may take a neighbour there.
constexpr double bound = 1e-6;

/// All scenes by one program.
Difference difference(const Context& context, const SoftShadowMapOptions& options, Route route) {
    Difference result;
    const test::Compute compute = compute_of(options, route);
    const Program program = compute.program(context);
    for (const test::Scene& scene : test::map_scenes()) {
        const MapCase query(scene, options, points);
        const FloatTexture first(test::has_segments(options) ? query.segments.segments : query.maps.maps, 0);
        const FloatTexture edges(query.maps.edges, 1);
        std::vector<float> in;
        for (const Vec3<float>& p : query.points_ls) in.insert(in.end(), {p.x, p.y, p.z});
        const std::vector<float> out =
            compute.run(program, in, [&](const Program& used) { set_uniforms(query, used); });
        for (std::size_t i = 0; i < out.size(); ++i) result.add(out[i], query.truth[i]);
    }
    return result;
}

void check(const SoftShadowMapOptions& options, Api api, Route route) {
    const Difference got = difference(Context(api), options, route);
    const std::string name = test::map_name(options);
    std::printf("%-16s %d of %3d, %-8s%-14s worst %.3g of %.3g\n", name.c_str(), options.samples, options.resolution,
                api == Api::es ? "ES" : "desktop", route == Route::direct ? "" : " SPIRV-Cross", got.worst, bound);
    CAPTURE(name);
    CAPTURE(static_cast<int>(api));
    CAPTURE(static_cast<int>(route));
    CHECK(got.worst <= bound);
}

}  // namespace

TEST_CASE("visibility is that of the C++, in every mode, with two maps and more") {
    for (const SoftShadowMapOptions& options : test::all_map_modes(3, 128)) check(options, Api::desktop, Route::direct);
    if (mutant) return;  // mutants.sh runs this a few hundred times
    for (const SoftShadowMapOptions& options : test::all_map_modes(2, 256)) check(options, Api::desktop, Route::direct);
    for (const SoftShadowMapOptions& options : test::all_map_modes(5, 97)) check(options, Api::desktop, Route::direct);
}

TEST_CASE("and so it is in ES, and in what SPIRV-Cross makes of it") {
    if (mutant) return;
    for (const Api api : {Api::desktop, Api::es})
        for (const Route route : test::routes()) {
            if (api == Api::desktop && route == Route::direct) continue;
            for (const SoftShadowMapOptions& options : test::all_map_modes(3, 128)) check(options, api, route);
        }
}
