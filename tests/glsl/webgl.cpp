// The twins that read textures, in WebGL2 in a browser without a window, against the C++.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cases.hpp"
#include "d_buffer_cases.hpp"
#include "program.hpp"
#include "support/folder.hpp"
#include "wedge_cases.hpp"

using namespace penumbra;
using test::QueryCase;
using test::Sums;
using test::Values;

namespace {

constexpr int count = 64 * 64;  // as the page draws

std::string hex(const void* data, std::size_t bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) {
        const unsigned byte = static_cast<const unsigned char*>(data)[i];
        text += "0123456789abcdef"[byte >> 4U];
        text += "0123456789abcdef"[byte & 15U];
    }
    return text;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' ? std::string("\\n") : std::string(1, c);
    }
    return result + "\"";
}

template <class Texel>
std::string texture(const char* name, const test::TextureArray<Texel>& array) {
    const bool sums = sizeof(Texel) == 16;
    std::string text = std::string("{name: \"") + name + "\", kind: \"" + (sums ? "sums" : "bytes") +
                       "\", layers: " + std::to_string(array.layers) + ", levels: [";
    for (const auto& level : array.levels)
        text += "{width: " + std::to_string(level.size.x) + ", height: " + std::to_string(level.size.y) +
                ", texels: \"" + hex(level.texels.data(), level.texels.size() * sizeof(Texel)) + "\"},\n";
    return text + "]}";
}

std::string texture(const char* name, const Image<glm::vec4>& image) {
    return std::string("{name: \"") + name + "\", kind: \"floats\", levels: [{width: " + std::to_string(image.width()) +
           ", height: " + std::to_string(image.height()) + ", texels: \"" +
           hex(image.data(), image.size() * sizeof(glm::vec4)) + "\"}]}";
}

/// A fragment shader over the image, and what its first `channels` outputs should be.
struct Job {
    std::string name, snippet, defines, body;  ///< body: reads penumbra_in, makes vec4 v
    std::vector<std::string> textures;
    std::string sampler;
    std::vector<float> inputs;  ///< four for each output
    int channels;
    std::vector<double> truth;
    double bound;
};

std::string script(const Job& job) {
    const std::string head =
        "#version 300 es\nprecision highp float; precision highp int; precision highp sampler2DArray; "
        "precision highp usampler2DArray; precision highp sampler2D;\n";
    std::string samplers;
    for (const char* name : {"masks", "depths"}) samplers += "uniform " + job.sampler + " " + name + ";\n";
    const std::string fragment = head + job.defines + test::flatten(job.snippet) + samplers +
                                 "uniform sampler2D inputs;\nlayout(location = 0) out uvec4 result;\nvoid main() {\n"
                                 "    vec4 penumbra_in = texelFetch(inputs, ivec2(gl_FragCoord.xy), 0);\n    " +
                                 job.body + "\n    result = floatBitsToUint(v);\n}\n";
    std::string text = "{name: " + quoted(job.name) +
                       ", vertex: " + quoted(head + test::flatten("occlusion_texture/full_screen.vert")) +
                       ", fragment: " + quoted(fragment) + ", inputs: \"" +
                       hex(job.inputs.data(), job.inputs.size() * sizeof(float)) + "\", textures: [";
    for (const std::string& one : job.textures) text += one + ",\n";
    return text + "]},\n";
}

/// What the browser leaves in the page.
std::string page_after(const std::vector<Job>& jobs) {
    const test::Folder folder;
    std::string text = "\"use strict\";\nconst jobs = [\n";
    for (const Job& job : jobs) text += script(job);
    folder.write("jobs.js", text + "];\n");
    std::filesystem::copy_file(PENUMBRA_WEBGL_PAGE, folder.path / "page.html");
    // ANGLE on the machine's own driver: SwiftShader takes minutes to compile a query
    const std::string options =
        " --headless --no-sandbox --disable-dev-shm-usage --use-gl=angle --use-angle=gl-egl --ignore-gpu-blocklist "
        "--user-data-dir=profile --dump-dom";
    const bool ran = folder.run("timeout 200 $(command -v chromium || command -v chromium-browser) " + options +
                                " file://" + (folder.path / "page.html").string() + " >after.html");
    return ran ? folder.read("after.html") : "";
}

/// Largest difference from the truth, infinite where there is no result. What is no number has no truth.
double worst(const Job& job, const std::string& page) {
    const std::string begin = "<pre>" + job.name + " result ";
    const std::size_t at = page.find(begin);
    if (at == std::string::npos) {
        const std::size_t error = page.find("<pre>" + job.name);
        std::printf("%s: no result: %s\n", job.name.c_str(),
                    error == std::string::npos ? "" : page.substr(error, 2000).c_str());
        return HUGE_VAL;
    }
    double result = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < job.channels; ++c) {
            const auto word = 4 * i + static_cast<std::size_t>(c);
            const auto bits =
                static_cast<std::uint32_t>(std::stoul(page.substr(at + begin.size() + 8 * word, 8), nullptr, 16));
            float got;
            std::memcpy(&got, &bits, sizeof got);
            const double truth = job.truth[i * static_cast<std::size_t>(job.channels) + static_cast<std::size_t>(c)];
            if (std::isnan(truth)) continue;
            const double error = std::abs(static_cast<double>(got) - truth);
            result = error <= result ? result : error;  // NaN stays
        }
    return result;
}

template <class Filter>
Job means(const std::string& name, int width, int height, const std::string& texture_text,
          const test::SliceImages& slices, const std::string& sampler, const std::string& call, double unit) {
    Job job{name,
            "occlusion_texture/" + name + ".glsl",
            "",
            "vec4 v = " + call + ";",
            {texture_text},
            sampler,
            {},
            4,
            {},
            1e-5 * unit};
    std::vector<Filter> filters;
    for (std::size_t c = 0; c < 4; ++c) filters.emplace_back(slices[4 + c]);
    for (const Rect2<float>& box : test::boxes(width, height, count)) {
        job.inputs.insert(job.inputs.end(), {box.min.x, box.min.y, box.max.x, box.max.y});
        const bool number = !std::isnan(box.min.y) && !std::isnan(box.max.y);
        for (const Filter& filter : filters)
            job.truth.push_back(number ? static_cast<double>(filter.mean(box)) * unit / 255
                                       : std::numeric_limits<double>::quiet_NaN());
    }
    return job;
}

/// The bits of a float as an expression.
std::string exact(float x) {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return "uintBitsToFloat(" + std::to_string(bits) + "u)";
}
std::string exact(const Vec2<float>& v) { return "vec2(" + exact(v.x) + ", " + exact(v.y) + ")"; }

Job visibility(const std::string& name, SliceFilter filter, int channels) {
    OcclusionTextureOptions options;
    options.filter = filter, options.slices = 6, options.resolution = 64;
    const QueryCase query(options, channels, count);
    const auto& camera = query.shadow.camera();
    const auto& range = query.shadow.range();
    Job job{name, "occlusion_texture/shadow.glsl",
            "",   "",
            {},   query.sums() ? "usampler2DArray" : "sampler2DArray",
            {},   1,
            {},   2e-6};
    for (const std::string& define : query.defines()) job.defines += "#define " + define + "\n";
    job.body =
        "penumbra_OcclusionTexture info; info.camera.convergence = " + exact(camera.convergence) +
        "; info.camera.origin_tx = " + exact(camera.origin_tx) + "; info.camera.scale_tx = " + exact(camera.scale_tx) +
        "; info.range.first = " + exact(range.first) + "; info.range.thickness = " + exact(range.thickness) +
        "; info.range.count = " + std::to_string(range.count) + "; info.half_size = " + exact(half_size(query.light)) +
        "; info.levels = " + std::to_string(query.levels()) +
        "; vec4 v = vec4(penumbra_visibility(masks, depths, info, penumbra_in.xyz));";
    std::visit([&](const auto& masks) { job.textures.push_back(texture("masks", masks)); }, query.masks);
    std::visit([&](const auto& depths) { job.textures.push_back(texture("depths", depths)); }, query.depths);
    for (const Vec3<float>& p : query.points_ls) job.inputs.insert(job.inputs.end(), {p.x, p.y, p.z, 0.0F});
    for (const float v : query.truth) job.truth.push_back(static_cast<double>(v));
    return job;
}

Job wedges(const std::string& name, const test::Scene& scene, const PenumbraWedgeOptions& options) {
    const test::WedgeCase query(scene, options, count);
    const WedgeTexels& texels = query.texels;
    Job job{name, "penumbra_wedge/shadow.glsl", "", "", {texture("masks", texels.texels)}, "sampler2D", {}, 1, {},
            2e-6};
    for (const std::string& define : test::wedge_defines(options)) job.defines += "#define " + define + "\n";
    job.body = "penumbra_WedgeShadow info; info.half_size = " + exact(texels.half_size) +
               "; info.scale = " + exact(texels.scale) + "; info.tolerance = " + exact(texels.tolerance) +
               "; info.nodes = " + std::to_string(texels.nodes) +
               "; vec4 v = vec4(penumbra_visibility(masks, info, penumbra_in.xyz));";
    for (const Vec3<float>& p : query.points_ls) job.inputs.insert(job.inputs.end(), {p.x, p.y, p.z, 0.0F});
    for (const float v : query.truth) job.truth.push_back(static_cast<double>(v));
    return job;
}

Job d_buffer(const std::string& name, const test::Scene& scene, const UmbraVolumeOptions& options) {
    const test::DBufferCase query(scene, options, count);
    const DBufferView<float>& view = query.d_buffer.view();
    Job job{name, "umbra_volume/d_buffer.glsl", "", "", {}, "sampler2D", {}, 1, {}, 1e-6};
    for (const std::string& define : test::d_buffer_defines(options)) job.defines += "#define " + define + "\n";
    job.body = "penumbra_DBufferView view; view.slopes = penumbra_rect2(" + exact(view.slopes.min) + ", " +
               exact(view.slopes.max) + "); view.resolution = " + std::to_string(view.resolution) +
               "; vec4 v = vec4(penumbra_visibility(masks, depths, view, " + exact(query.d_buffer.radius()) +
               ", penumbra_in.xyz));";
    job.textures = {texture("masks", query.texels.crossings), texture("depths", query.texels.edges)};
    for (const Vec3<float>& p : query.points_ls) job.inputs.insert(job.inputs.end(), {p.x, p.y, p.z, 0.0F});
    for (const float v : query.truth) job.truth.push_back(static_cast<double>(v));
    return job;
}

}  // namespace

TEST_CASE("lookups and queries in WebGL2") {
    const std::string box = "penumbra_rect2(penumbra_in.xy, penumbra_in.zw)";
    const test::SliceImages slices = test::random_slices(17, 13, 8), square = test::random_slices(64, 16, 8);
    const Values map = test::mipmaps_of(square, 64, 16, 4);
    UmbraVolumeOptions d_buffer_options;
    d_buffer_options.resolution = 64;
    const std::vector<Job> jobs{
        means<SummedArea<std::uint32_t>>("summed_area", 17, 13, texture("masks", test::tables_of(slices, 17, 13, 4)),
                                         slices, "usampler2DArray", "penumbra_summed_area_mean(masks, 1, " + box + ")",
                                         255),
        means<NBuffer<std::uint8_t>>("n_buffer", 17, 13, texture("masks", test::n_buffers_of(slices, 17, 13, 4)),
                                     slices, "sampler2DArray", "penumbra_n_buffer_mean(masks, 2, 1, " + box + ")", 1),
        means<MipMap<std::uint8_t>>(
            "mipmap", 64, 16, texture("masks", map), square, "sampler2DArray",
            "penumbra_mipmap_mean(masks, " + std::to_string(map.levels.size()) + ", 1, " + box + ")", 1),
        visibility("visibility_summed_area", SliceFilter::summed_area, 4),
        visibility("visibility_n_buffer", SliceFilter::n_buffer, 4),
        visibility("visibility_mipmap", SliceFilter::mipmap, 1),
        wedges("wedges_exact", test::scenes()[1], {}),
        wedges("wedges_bitmask", test::scenes()[1], {OverlapRule::bitmask, 32, SilhouetteFrom::point}),
        wedges("wedges_rectangles", test::scenes()[4], {OverlapRule::rectangles, 32, SilhouetteFrom::light_center}),
        d_buffer("d_buffer", test::scenes()[1], d_buffer_options),
    };
    const std::string page = page_after(jobs);
    for (const Job& job : jobs) {
        const double difference = worst(job, page);
        std::printf("%-24s %d inputs  worst %.3g of %.3g\n", job.name.c_str(), count, difference, job.bound);
        CAPTURE(job.name);
        CHECK(difference <= job.bound);
    }
}
