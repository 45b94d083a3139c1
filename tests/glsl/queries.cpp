// Whole queries on the driver, by the textures of the C++: in compute shaders for every option, by way of SPIRV-Cross,
// and in a fragment shader that stores visibility in the formats of render targets.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cases.hpp"
#include "compute.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::Program;
using test::QueryCase;
using test::Route;
using test::Texture;

namespace {

constexpr int points = 8192;
constexpr double bound = 2e-6;

Texture upload(const std::variant<test::Values, test::Sums>& array) {
    return std::visit([](const auto& texture) { return Texture(texture); }, array);
}

std::string uniforms(const QueryCase& query) {
    return std::string("uniform highp ") + (query.sums() ? "usampler2DArray" : "sampler2DArray") +
           " masks;\nuniform highp " + (query.sums() ? "usampler2DArray" : "sampler2DArray") +
           " depths;\nuniform float convergence; uniform vec2 origin_tx, scale_tx, half_size; uniform vec2 range; "
           "uniform int slices; uniform int levels;\n";
}
const char* const info_text =
    "penumbra_OcclusionTexture info; info.camera.convergence = convergence; info.camera.origin_tx = origin_tx; "
    "info.camera.scale_tx = scale_tx; info.range.first = range.x; info.range.thickness = range.y; "
    "info.range.count = slices; info.half_size = half_size; info.levels = levels; ";

void set_uniforms(const QueryCase& query, const Program& program) {
    const auto& camera = query.shadow.camera();
    const auto& range = query.shadow.range();
    program.set("masks", 0), program.set("depths", 1);
    program.set("convergence", camera.convergence);
    program.set("origin_tx", camera.origin_tx), program.set("scale_tx", camera.scale_tx);
    program.set("half_size", half_size(query.light));
    program.set("range", Vec2<float>(range.first, range.thickness));
    program.set("slices", range.count), program.set("levels", query.levels());
}

/// Largest difference of visibility.
double worst(const Context& context, const QueryCase& query, Route route) {
    const Texture masks = upload(query.masks), depths = upload(query.depths);
    masks.bind(0), depths.bind(1);
    std::vector<float> in;
    for (const Vec3<float>& p : query.points_ls) in.insert(in.end(), {p.x, p.y, p.z});
    const test::Compute compute{
        "occlusion_texture/shadow.glsl",
        3,
        1,
        query.defines(),
        uniforms(query),
        std::string(info_text) + "O(0) = penumbra_visibility(masks, depths, info, vec3(I(0), I(1), I(2)));",
        route};
    const std::vector<float> out =
        compute.run(context, in, [&](const Program& program) { set_uniforms(query, program); });
    double result = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double error = std::abs(static_cast<double>(out[i]) - static_cast<double>(query.truth[i]));
        result = error <= result ? result : error;  // NaN stays
    }
    return result;
}

}  // namespace

TEST_CASE("in compute shaders, for every option") {
    double largest = 0;
    for (const SliceFilter filter : {SliceFilter::summed_area, SliceFilter::n_buffer, SliceFilter::mipmap})
        for (const Combination rule : {Combination::product, Combination::sum, Combination::max, Combination::mean})
            for (const SelfShadow self : {SelfShadow::fade, SelfShadow::clear, SelfShadow::mean_depth}) {
                OcclusionTextureOptions options;
                options.resolution = 128;
                options.slices = 7;
                options.filter = filter;
                options.blend = {rule, rule == Combination::max};
                options.self_shadow = self;
                options.light_cells = self == SelfShadow::clear ? 3 : 2;
                options.plane = rule == Combination::sum ? SlicePlane::bottom : SlicePlane::middle;
                options.self_shadow_bias = rule == Combination::mean ? 0.25F : 0.5F;
                const QueryCase query(options, rule == Combination::product ? 1 : 4, points);
                CHECK(query.penumbrae() > points / 10);
                for (const Api api : {Api::desktop, Api::es}) {
                    const Context context(api);
                    for (const Route route : test::routes()) {
                        if (route != Route::direct && self != SelfShadow::mean_depth) continue;
                        const double difference = worst(context, query, route);
                        CAPTURE(static_cast<int>(filter));
                        CAPTURE(static_cast<int>(rule));
                        CAPTURE(static_cast<int>(self));
                        CAPTURE(static_cast<int>(route));
                        CHECK(difference <= bound);
                        largest = std::max(largest, difference);
                    }
                }
            }
    std::printf("visibility, every option: worst %.3g of %.3g\n", largest, bound);
}

TEST_CASE("in a fragment shader, into bytes, half floats and floats, row 0 first") {
    const QueryCase query({}, 4, 1);
    const auto height_of = [](int y) { return -4.0F + 8.0F * (static_cast<float>(y) + 0.5F) / 32.0F; };
    const auto width_of = [](int x) { return -4.0F + 8.0F * (static_cast<float>(x) + 0.5F) / 64.0F; };
    struct Format {
        const char* name;
        GLenum format;
        double bound;  // bytes are rounded, half floats may be cut off
        bool in_es;
    };
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        const Texture masks = upload(query.masks), depths = upload(query.depths);
        std::string text = context.version(false);
        for (const std::string& option : query.defines()) text += "#define " + option + "\n";
        text += uniforms(query) + "out vec4 color;\n" + test::flatten("occlusion_texture/shadow.glsl") +
                "void main() { " + info_text +
                "vec2 at = vec2(-4.0, -4.0) + 8.0 * gl_FragCoord.xy / vec2(64.0, 32.0); "
                "color = vec4(penumbra_visibility(masks, depths, info, vec3(at, 8.0))); }\n";
        const Program program(context, test::Text{text}, "occlusion_texture/full_screen.vert");
        for (const Format& format :
             {Format{"bytes", GL_RGBA8, 0.5 / 255, true},
              Format{"half floats", GL_RGBA16F, std::ldexp(1.0, -11), false}, Format{"floats", GL_RGBA32F, 0, false}}) {
            if (api == Api::es && !format.in_es) continue;  // needs an extension there
            const Texture target(format.format, 64, 32, 1);
            target.attach(0, 1);
            program.use();
            set_uniforms(query, program);
            masks.bind(0), depths.bind(1);
            program.draw_full_screen();
            std::vector<float> stored;
            if (format.format == GL_RGBA8)
                for (const std::uint8_t byte : target.bytes(0)) stored.push_back(static_cast<float>(byte) / 255.0F);
            else
                stored = target.floats(0);

            const LightFrame<float> frame = light_frame(query.light);
            double largest = 0;
            int extremes = 0, moved = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 64; ++x) {
                    const float truth = query.shadow.visibility(frame.to_world({width_of(x), height_of(y), 8.0F}));
                    const float got = stored[static_cast<std::size_t>(4 * (64 * y + x))];
                    largest = std::max(largest, std::abs(static_cast<double>(got) - static_cast<double>(truth)));
                    if (truth == 0.0F || truth == 1.0F) ++extremes, moved += got != truth;
                }
            std::printf("visibility in %-12s worst %.3g of %.3g; 0 and 1 at %d of 2048 points, %d of them moved\n",
                        format.name, largest, format.bound + bound, extremes, moved);
            CHECK(largest <= format.bound + bound);
            CHECK(extremes > 100);
            CHECK(moved == 0);
        }
    }
}
