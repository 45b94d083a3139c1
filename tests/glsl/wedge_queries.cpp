// The query of penumbra wedges on the driver, by the texels of the C++: in compute shaders for every option, and by way
// of SPIRV-Cross.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "compute.hpp"
#include "float_texture.hpp"
#include "wedge_cases.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::Difference;
using test::FloatTexture;
using test::Program;
using test::Route;
using test::WedgeCase;

namespace {

const bool mutant = std::getenv("PENUMBRA_SHADERS") != nullptr;
const int points = mutant ? 192 : 768;  // a scene

constexpr auto kept_edges = static_cast<int>(penumbra::detail::UnionBlender<float>::most_edges);

void set_uniforms(const WedgeTexels& texels, const Program& program) {
    program.set("wedges", 0);
    program.set("half_size", texels.half_size), program.set("scale", texels.scale);
    program.set("tolerance", texels.tolerance), program.set("nodes", texels.nodes);
}

/// All scenes by one program.
Difference difference(const Context& context, const PenumbraWedgeOptions& options, Route route, int union_edges) {
    Difference result;
    const std::vector<test::Scene> scenes = test::scenes();
    const test::Compute compute{
        "penumbra_wedge/shadow.glsl",
        3,
        1,
        test::wedge_defines(options, union_edges),
        "uniform highp sampler2D wedges; uniform vec2 half_size; uniform float scale, tolerance; uniform int nodes;\n",
        "penumbra_WedgeShadow info; info.half_size = half_size; info.scale = scale; info.tolerance = tolerance; "
        "info.nodes = nodes; O(0) = penumbra_visibility(wedges, info, vec3(I(0), I(1), I(2)));",
        route};
    const Program program = compute.program(context);
    for (const test::Scene& scene : scenes) {
        const WedgeCase query(scene, options, points);
        const FloatTexture texture(query.texels.texels, 0);
        std::vector<float> in;
        for (const Vec3<float>& p : query.points_ls) in.insert(in.end(), {p.x, p.y, p.z});
        const std::vector<float> out =
            compute.run(program, in, [&](const Program& used) { set_uniforms(query.texels, used); });
        for (std::size_t i = 0; i < out.size(); ++i) result.add(out[i], query.truth[i]);
    }
    return result;
}

/// Masks may take a cell otherwise where its middle is on an edge to rounding: at few points, and by a cell or two.
void check(const PenumbraWedgeOptions& options, Api api, Route route) {
    const Difference got = difference(Context(api), options, route, kept_edges);
    const bool masks = options.overlap == OverlapRule::bitmask;
    const double bound = masks ? 2.0 / (options.bitmask_size * options.bitmask_size) : 2e-6;
    const std::string name = test::wedge_name(options);
    std::printf("%-34s %-8s%-14s worst %.3g, cells taken otherwise at %d points\n", name.c_str(),
                api == Api::es ? "ES" : "desktop", route == Route::direct ? "" : " SPIRV-Cross", got.worst, got.flips);
    CAPTURE(name);
    CAPTURE(static_cast<int>(api));
    CAPTURE(static_cast<int>(route));
    CHECK(got.worst <= bound);
    CHECK(got.flips <= (masks ? points / 256 : 0));
}

}  // namespace

TEST_CASE("visibility is that of the C++, by every rule, with silhouettes from points and from the light") {
    std::vector<PenumbraWedgeOptions> all;
    for (int rule = 0; rule < 7; ++rule) all.push_back({static_cast<OverlapRule>(rule), 32, SilhouetteFrom::point});
    all.push_back({OverlapRule::exact, 32, SilhouetteFrom::point});
    for (const int size : {8, 16, 32}) all.push_back({OverlapRule::bitmask, size, SilhouetteFrom::point});
    for (const OverlapRule rule :
         {OverlapRule::additive, OverlapRule::rectangles, OverlapRule::bitmask, OverlapRule::exact})
        all.push_back({rule, 16, SilhouetteFrom::light_center});
    for (const OverlapRule rule : {OverlapRule::bitmask, OverlapRule::exact})
        all.push_back({rule, 32, SilhouetteFrom::point, 0.02F});
    if (mutant)  // mutants.sh runs this a few hundred times
        all = {{OverlapRule::bitmask, 32, SilhouetteFrom::point},
               {OverlapRule::exact, 32, SilhouetteFrom::point},
               {OverlapRule::additive, 32, SilhouetteFrom::light_center}};
    for (const PenumbraWedgeOptions& options : all) check(options, Api::desktop, Route::direct);
}

TEST_CASE("where a point has more edges than fit, masks take over") {
    const PenumbraWedgeOptions exact{OverlapRule::exact, 32, SilhouetteFrom::point};
    const Context context(Api::desktop);
    const Difference few = difference(context, exact, Route::direct, 64);
    const Difference fewer = difference(context, exact, Route::direct, 8);
    std::printf("room for 64 edges: %d points by masks, worst %.3g; for 8: %d, %.3g\n", few.flips, few.worst,
                fewer.flips, fewer.worst);
    CHECK(few.flips < points / 8);
    CHECK(fewer.flips > points / 8);
    CHECK(few.worst < 0.02);
    CHECK(fewer.worst < 0.02);
}

TEST_CASE("and so it is in ES, and in what SPIRV-Cross makes of it") {
    if (mutant) return;
    for (const Api api : {Api::desktop, Api::es})
        for (const Route route : test::routes()) {
            if (api == Api::desktop && route == Route::direct) continue;
            check({OverlapRule::bitmask, 32, SilhouetteFrom::point}, api, route);
            check({OverlapRule::exact, 32, SilhouetteFrom::point}, api, route);
            check({OverlapRule::rectangle_product, 32, SilhouetteFrom::point}, api, route);
            check({OverlapRule::product_quadrants, 32, SilhouetteFrom::light_center}, api, route);
        }
}
