// The query of D-buffers on the driver, by the texels of the C++: in compute shaders for every option, and by way of
// SPIRV-Cross.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "compute.hpp"
#include "d_buffer_cases.hpp"
#include "float_texture.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::DBufferCase;
using test::Difference;
using test::FloatTexture;
using test::Program;
using test::Route;

namespace {

const bool mutant = std::getenv("PENUMBRA_SHADERS") != nullptr;
const int points = mutant ? 1024 : 8192;  // a scene

void set_uniforms(const DBuffer<float>& d_buffer, const Program& program) {
    const DBufferView<float>& view = d_buffer.view();
    program.set("crossings", 0), program.set("edges", 1);
    program.set("low", view.slopes.min), program.set("high", view.slopes.max);
    program.set("resolution", view.resolution), program.set("radius", d_buffer.radius());
}

/// All scenes by one program.
Difference difference(const Context& context, const UmbraVolumeOptions& options, Route route) {
    Difference result;
    const test::Compute compute{
        "umbra_volume/d_buffer.glsl",
        3,
        1,
        test::d_buffer_defines(options),
        "uniform highp sampler2D crossings, edges; uniform vec2 low, high; uniform int resolution; "
        "uniform float radius;\n",
        "penumbra_DBufferView view; view.slopes = penumbra_rect2(low, high); view.resolution = resolution; "
        "O(0) = penumbra_visibility(crossings, edges, view, radius, vec3(I(0), I(1), I(2)));",
        route};
    const Program program = compute.program(context);
    for (const test::Scene& scene : test::d_buffer_scenes()) {
        const DBufferCase query(scene, options, points);
        const FloatTexture crossings(query.texels.crossings, 0), edges(query.texels.edges, 1);
        std::vector<float> in;
        for (const Vec3<float>& p : query.points_ls) in.insert(in.end(), {p.x, p.y, p.z});
        const std::vector<float> out =
            compute.run(program, in, [&](const Program& used) { set_uniforms(query.d_buffer, used); });
        for (std::size_t i = 0; i < out.size(); ++i) result.add(out[i], query.truth[i]);
    }
    return result;
}

/// Distances from the centre are rounded, and t may come from how they differ a little behind an edge. All other
/// decisions, texels among them, are as in the C++. √t lifts what is small.
double bound_of(const UmbraVolumeOptions& options) {
    const bool rounded = options.share == CutShare::depths && options.depth == DBufferDepth::euclidean;
    return (rounded ? 2e-5 : 1e-6) * (options.visibility == CutVisibility::square_root ? 2.0 : 1.0);
}

void check(const UmbraVolumeOptions& options, Api api, Route route) {
    const Difference got = difference(Context(api), options, route);
    const std::string name = test::d_buffer_name(options);
    std::printf("%-42s %-8s%-14s worst %.3g of %.3g\n", name.c_str(), api == Api::es ? "ES" : "desktop",
                route == Route::direct ? "" : " SPIRV-Cross", got.worst, bound_of(options));
    CAPTURE(name);
    CAPTURE(static_cast<int>(api));
    CAPTURE(static_cast<int>(route));
    CHECK(got.worst <= bound_of(options));
}

/// Layers, V(t), t, depths.
UmbraVolumeOptions chosen(int layers, CutVisibility visibility, CutShare share, DBufferDepth depth) {
    UmbraVolumeOptions options;
    options.resolution = 128;
    options.layers = layers, options.visibility = visibility, options.share = share, options.depth = depth;
    return options;
}

}  // namespace

TEST_CASE("visibility is that of the C++, with one layer and two, by every V(t), from edges and from depths") {
    for (const int layers : {1, 2})
        for (const CutVisibility form : {CutVisibility::exact, CutVisibility::cubic, CutVisibility::square_root})
            for (const CutShare share : {CutShare::edge, CutShare::depths})
                for (const DBufferDepth depth : {DBufferDepth::light_plane, DBufferDepth::euclidean}) {
                    // mutants.sh runs this a few hundred times
                    if (mutant && (layers < 2 || static_cast<int>(form) != static_cast<int>(share))) continue;
                    check(chosen(layers, form, share, depth), Api::desktop, Route::direct);
                }
}

TEST_CASE("and so it is in ES, and in what SPIRV-Cross makes of it") {
    if (mutant) return;
    for (const Api api : {Api::desktop, Api::es})
        for (const Route route : test::routes()) {
            if (api == Api::desktop && route == Route::direct) continue;
            check(chosen(2, CutVisibility::exact, CutShare::edge, DBufferDepth::light_plane), api, route);
            check(chosen(2, CutVisibility::cubic, CutShare::depths, DBufferDepth::euclidean), api, route);
            check(chosen(1, CutVisibility::square_root, CutShare::edge, DBufferDepth::light_plane), api, route);
        }
}
