// Snippets and passes in every dialect: GLSL and ES of each version by glslang, and SPIR-V, HLSL, MSL and ES 310 by way
// of SPIRV-Cross from a program that calls every function.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "functions.hpp"
#include "program.hpp"
#include "support/folder.hpp"

namespace fs = std::filesystem;
using namespace penumbra;

namespace {

std::string head(const std::string& version) {
    const std::string precision =
        "precision highp float; precision highp int; precision highp sampler2DArray; "
        "precision highp usampler2DArray;\n";
    return "#version " + version + "\n" + (version.find("es") == std::string::npos ? "" : precision);
}

std::vector<fs::path> files(const std::string& extension) {
    const fs::path root = fs::path(PENUMBRA_SHADERS) / "penumbra";
    std::vector<fs::path> result;
    for (const auto& entry : fs::recursive_directory_iterator(root))
        if (entry.path().extension() == extension) result.push_back(fs::relative(entry.path(), root));
    std::sort(result.begin(), result.end());
    return result;
}

/// Every function of each snippet, called once: bodies that read I(k) and write O(k).
std::map<std::string, std::vector<std::string>> calls() {
    std::map<std::string, std::vector<std::string>> result;
    for (const test::Function& f : test::functions::all()) result[f.snippet].push_back(f.glsl);
    const std::string box = "penumbra_rect2(vec2(I(0), I(1)), vec2(I(2), I(3)))";
    const std::string put = "for (int k = 0; k < 4; ++k) O(k) = float(v[k]);";
    result["occlusion_texture/summed_area"] = {
        "vec4 v = penumbra_summed_area_mean(sums, int(I(4)), " + box + "); " + put,
        "uvec4 v = penumbra_summed_area_sum(sums, 0, ivec2(I(0), I(1)), ivec2(I(2), I(3))); " + put};
    result["occlusion_texture/n_buffer"] = {"vec4 v = penumbra_n_buffer_mean(slices, int(I(4)), int(I(5)), " + box +
                                            "); " + put};
    result["occlusion_texture/mipmap"] = {"vec4 v = penumbra_mipmap_mean(slices, int(I(4)), int(I(5)), " + box + "); " +
                                          put};
    result["occlusion_texture/shadow"] = {
        "penumbra_OcclusionTexture t; t.camera.convergence = I(0); t.camera.origin_tx = vec2(I(1), I(2)); "
        "t.camera.scale_tx = vec2(I(3), I(4)); t.camera.width = 1; t.camera.height = 1; t.range.first = I(5); "
        "t.range.thickness = I(6); t.range.count = int(I(7)); t.half_size = vec2(I(8), I(9)); t.levels = 1; "
        "O(0) = penumbra_visibility(sums, sums, t, vec3(I(10), I(11), I(12)));"};
    return result;
}

/// A compute program that calls them.
std::string program(const std::string& snippet, const std::vector<std::string>& bodies) {
    std::string text =
        "#version 450\nlayout(local_size_x = 64) in;\n"
        "layout(std430, set = 0, binding = 0) readonly buffer In { float penumbra_in[]; };\n"
        "layout(std430, set = 0, binding = 1) buffer Out { float penumbra_out[]; };\n"
        "layout(set = 0, binding = 2) uniform highp sampler2DArray slices;\n"
        "layout(set = 0, binding = 3) uniform highp usampler2DArray sums;\n"
        "#define I(k) penumbra_in[penumbra_at + (k)]\n#define O(k) penumbra_out[penumbra_at + (k)]\n" +
        test::flatten(snippet + ".glsl") + "void main() {\n    int penumbra_at = 16 * int(gl_GlobalInvocationID.x);\n";
    for (const std::string& body : bodies) text += "    { " + body + " }\n    penumbra_at += 1000000;\n";
    return text + "}\n";
}

}  // namespace

TEST_CASE("every snippet compiles as GLSL 330, 430, 450 and ES 300, 310") {
    const test::Folder folder;
    for (const fs::path& file : files(".glsl"))
        for (const std::string version : {"330 core", "430 core", "450 core", "300 es", "310 es"}) {
            CAPTURE(file.string());
            CAPTURE(version);
            folder.write("s.frag", head(version) + test::flatten(file.string()) +
                                       "out vec4 penumbra_color;\nvoid main() { penumbra_color = vec4(0.0); }\n");
            CHECK(folder.run("glslangValidator s.frag"));
        }
}

TEST_CASE("every pass compiles in the versions that it names, with every option") {
    const test::Folder folder;
    const auto check = [&](const fs::path& file, const std::string& version, const std::string& options) {
        CAPTURE(file.string());
        CAPTURE(version);
        CAPTURE(options);
        const std::string name = "p" + file.extension().string();
        std::string text = head(version);
        if (version == "310 es") text += "precision highp uimage2DArray; precision highp image2DArray;\n";
        folder.write(name, text + options + test::flatten(file.string()));
        CHECK(folder.run("glslangValidator " + name));
    };
    for (const std::string extension : {".vert", ".frag"})
        for (const fs::path& file : files(extension))
            for (const std::string version : {"330 core", "430 core", "450 core", "300 es", "310 es"})
                check(file, version, "");
    for (const fs::path& file : files(".comp"))
        for (const std::string version : {"430 core", "450 core", "310 es"}) check(file, version, "");
    for (const std::string version : {"330 core", "300 es"})
        for (const char* capture : {"0", "1", "2"})
            for (const char* targets : {"1", "2", "3", "4"})
                check("occlusion_texture/slice_capture.frag", version,
                      std::string("#define PENUMBRA_CAPTURE ") + capture + "\n#define PENUMBRA_CAPTURE_TARGETS " +
                          targets + "\n");
    for (const std::string version : {"430 core", "310 es"})
        check("occlusion_texture/summed_area_scan.comp", version, "#define PENUMBRA_SCAN_COLUMNS 1\n");
}

TEST_CASE("queries compile with every option") {
    const test::Folder folder;
    for (const std::string version : {"330 core", "300 es"})
        for (const char* filter : {"0", "1", "2"})
            for (const char* rule : {"0", "1", "2", "3"})
                for (const char* self : {"0", "1", "2"}) {
                    folder.write("s.frag",
                                 head(version) + "#define PENUMBRA_OCCLUSION_TEXTURE_FILTER " + filter +
                                     "\n#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION " + rule +
                                     "\n#define PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW " + self +
                                     "\n#define PENUMBRA_OCCLUSION_TEXTURE_CHANNELS 1\n" +
                                     test::flatten("occlusion_texture/shadow.glsl") +
                                     "out vec4 penumbra_color;\nvoid main() { penumbra_color = vec4(0.0); }\n");
                    CHECK(folder.run("glslangValidator s.frag"));
                }
}

TEST_CASE("every snippet goes through SPIR-V to HLSL, MSL and ES 310") {
    const test::Folder folder;
    const auto all = calls();
    for (const fs::path& file : files(".glsl")) {
        const std::string snippet = (file.parent_path() / file.stem()).string();
        CAPTURE(snippet);
        REQUIRE(all.count(snippet) == 1);
        folder.write("s.comp", program(snippet, all.at(snippet)));
        CHECK(folder.run("glslangValidator -V --target-env vulkan1.1 s.comp -o s.spv"));
        CHECK(folder.run("spirv-val --target-env vulkan1.1 s.spv"));
        CHECK(folder.run("spirv-cross s.spv --hlsl --shader-model 50 --output s50.hlsl"));
        CHECK(folder.run("spirv-cross s.spv --hlsl --shader-model 60 --output s60.hlsl"));
        CHECK(folder.run("spirv-cross s.spv --msl --output s.metal"));
        CHECK(folder.run("spirv-cross s.spv --es --version 310 --output es.comp && glslangValidator es.comp"));
    }
}
