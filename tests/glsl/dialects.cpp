// Snippets and passes in every dialect, from the self-contained copies that are installed: GLSL and ES of each version
// by glslang; SPIR-V, and by way of SPIRV-Cross HLSL, MSL and ES 310, of snippets from a program that calls every
// function.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "functions.hpp"
#include "program.hpp"
#include "support/folder.hpp"

namespace fs = std::filesystem;
using namespace penumbra;

namespace {

// "precision" lines are ES's
std::string head(const std::string& version) {
    const std::string precision =
        "precision highp float; precision highp int; precision highp sampler2DArray; precision highp usampler2DArray;"
        "\n#if __VERSION__ > 300\nprecision highp image2DArray; precision highp uimage2DArray;\n#endif\n";
    return "#version " + version + "\n" + (version.find("es") == std::string::npos ? "" : precision);
}

/// All shaders, relative to the folder that holds them.
std::vector<fs::path> files() {
    const fs::path root = fs::path(PENUMBRA_SHADERS) / "penumbra";
    std::vector<fs::path> result;
    for (const auto& entry : fs::recursive_directory_iterator(root))
        if (entry.is_regular_file()) result.push_back(fs::relative(entry.path(), root));
    std::sort(result.begin(), result.end());
    return result;
}

/// The self-contained copy that the build makes and installs.
std::string shipped(const fs::path& file) {
    std::ifstream in(fs::path(PENUMBRA_FLAT_SHADERS) / "penumbra" / file);
    return {std::istreambuf_iterator<char>(in), {}};
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
    result["penumbra_wedge/wedge_texels"] = {"vec4 v = penumbra_wedge_texel(wedges, int(I(0))); " + put};
    const std::string point =
        "penumbra_WedgeShadow w; w.half_size = vec2(I(0), I(1)); w.scale = I(2); w.tolerance = "
        "I(3); w.nodes = int(I(4)); vec3 at = vec3(I(5), I(6), I(7)); ";
    const std::string wedge = point + "penumbra_WedgePoint p = penumbra_wedge_point(at, w.half_size); ";
    result["penumbra_wedge/wedge_index"] = {
        wedge +
        "penumbra_WedgeCursor c = penumbra_next_edge(wedges, w, p, PENUMBRA_WEDGE_MESH, penumbra_first_edge()); "
        "O(0) = float(c.found) + c.coefficient; O(1) = c.from.x + c.from.y; O(2) = c.to.x + c.to.y;"};
    result["penumbra_wedge/union_blending"] = {wedge + "O(0) = penumbra_blend_silhouettes(wedges, w, p, true);",
                                               wedge + "O(0) = penumbra_blend_silhouettes(wedges, w, p, false);"};
    result["penumbra_wedge/blending"] = {
        wedge + "O(0) = penumbra_blend(wedges, w, p);", wedge + "O(0) = penumbra_blend_by_rectangles(wedges, w, p);",
        wedge + "O(0) = penumbra_blend_by_rectangle_product(wedges, w, p);",
        wedge + "O(0) = penumbra_blend_by_areas(wedges, w, p, PENUMBRA_COMBINATION_PRODUCT);"};
    const std::string d_buffer = "penumbra_DBufferView view; view.slopes = " + box +
                                 "; view.resolution = int(I(4)); vec3 at = vec3(I(5), I(6), I(7)); ";
    result["umbra_volume/d_buffer"].push_back(d_buffer + "O(0) = penumbra_visibility(wedges, wedges, view, I(8), at);");
    result["umbra_volume/d_buffer"].push_back(
        d_buffer +
        "penumbra_HidingEdge e = penumbra_hiding_edge(wedges, int(I(8))); O(0) = float(e.mesh + e.chained); "
        "O(1) = penumbra_cut_share(wedges, vec4(at, I(9)), e, at, I(10), I(11) > 0.0, I(12));");
    const std::string light_map = "penumbra_LightMapView view; view.slopes = " + box +
                                  "; view.resolution = int(I(4)); vec3 at = vec3(I(5), I(6), I(7)); ";
    result["soft_shadow_map/skin_maps"] = {light_map +
                                           "O(0) = penumbra_visibility(wedges, wedges, view, int(I(8)), at);"};
    result["soft_shadow_map/visibility_map"] = {
        light_map +
        "penumbra_VisibilityChannel c = penumbra_visibility_channel(wedges, tables, tables, view, ivec2(at.xy), "
        "int(at.z), I(8), I(9), I(10), I(11)); O(0) = c.visible + c.edge.slope + c.edge.inverse_depth;"};
    result["soft_shadow_map/row_segments"].push_back(light_map +
                                                     "O(0) = penumbra_visibility(wedges, view, I(8), I(9), at);");
    result["soft_shadow_map/row_segments"].push_back(
        light_map +
        "penumbra_Settled s = penumbra_settle(wedges, view, penumbra_row_point(I(8), I(9)), int(I(10)), int(I(11))); "
        "O(0) = s.point.slope + s.point.inverse_depth + float(s.own); "
        "penumbra_RowSegment r = penumbra_row_segment(wedges, int(I(12))); O(1) = r.a.slope + r.b.inverse_depth; "
        "vec4 v = penumbra_segment_texel(wedges, int(I(13))); O(2) = v.x;");
    result["penumbra_wedge/shadow"] = {point + "O(0) = penumbra_visibility(wedges, w, at);"};
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
        "layout(set = 0, binding = 4) uniform highp sampler2D wedges;\n"
        "layout(set = 0, binding = 5) uniform highp usampler2D tables;\n"
        "#define I(k) penumbra_in[penumbra_at + (k)]\n#define O(k) penumbra_out[penumbra_at + (k)]\n" +
        shipped(snippet + ".glsl") + "void main() {\n    int penumbra_at = 16 * int(gl_GlobalInvocationID.x);\n";
    for (const std::string& body : bodies) text += "    { " + body + " }\n    penumbra_at += 1000000;\n";
    return text + "}\n";
}

/// Whether SPIR-V for Vulkan comes from a text, is valid, and becomes MSL, and HLSL and ES 310 that compile. `stage`:
/// vert, frag or comp.
bool crosses(const test::Folder& folder, const std::string& text, const std::string& stage) {
    folder.write("s." + stage, text);
    // -R: uniforms outside of blocks, as whole shaders have them
    return folder.run("glslangValidator -V -R --aml --amb --target-env vulkan1.1 s." + stage + " -o s.spv") &&
           folder.run("spirv-val --target-env vulkan1.1 s.spv") &&
           folder.run("spirv-cross s.spv --hlsl --shader-model 50 --output s50.hlsl") &&
           folder.run("spirv-cross s.spv --hlsl --shader-model 60 --output s60.hlsl") &&
           folder.run("glslangValidator -D -V -e main -S " + stage + " s50.hlsl -o again.spv") &&
           folder.run("glslangValidator -D -V -e main -S " + stage + " s60.hlsl -o again.spv") &&
           folder.run("spirv-cross s.spv --msl --msl-version 20100 --output s.metal") &&
           folder.run("spirv-cross s.spv --es --version 310 --output es." + stage) &&
           folder.run("glslangValidator es." + stage);
}

}  // namespace

TEST_CASE("the self-contained copies are what resolving #include lines gives") {
    for (const fs::path& file : files()) {
        CAPTURE(file.string());
        CHECK(shipped(file) == test::flatten(file.string()));
        CHECK(shipped(file).find("#include \"") == std::string::npos);
    }
}

TEST_CASE("every shader compiles in every dialect that it is for") {
    const test::Folder folder;
    const auto all = calls();
    std::ofstream table("glsl-dialects.csv");
    table << "file,dialects\n";
    for (const fs::path& file : files()) {
        CAPTURE(file.string());
        const std::string extension = file.extension().string().substr(1);
        const bool snippet = extension == "glsl", compute = extension == "comp";
        const std::string stage = snippet ? "frag" : extension;
        std::string dialects;
        for (const std::string version : {"330 core", "430 core", "450 core", "300 es", "310 es"}) {
            if (compute && (version == "330 core" || version == "300 es")) continue;  // have none
            CAPTURE(version);
            const std::string end =
                snippet ? "out vec4 penumbra_color;\nvoid main() { penumbra_color = vec4(0.0); }\n" : "";
            folder.write("s." + stage, head(version) + shipped(file) + end);
            const bool good = folder.run("glslangValidator s." + stage);
            CHECK(good);
            if (good) dialects += version + ", ";
        }
        bool good = false;
        if (snippet) {
            const std::string name = (file.parent_path() / file.stem()).string();
            REQUIRE(all.count(name) == 1);
            good = crosses(folder, program(name, all.at(name)), "comp");
        } else {
            good = crosses(folder, "#version 450\n" + shipped(file), stage);
        }
        CHECK(good);
        if (good) dialects += "Vulkan SPIR-V, HLSL 5.0, HLSL 6.0, MSL, ES 310 from SPIR-V";
        std::printf("%-44s %s\n", file.string().c_str(), dialects.c_str());
        table << file.string() << ",\"" << dialects << "\"\n";
    }
}

TEST_CASE("passes and queries compile with every option") {
    const test::Folder folder;
    const auto check = [&](const std::string& file, const std::string& stage, const std::string& version,
                           const std::vector<std::string>& options, const std::string& end) {
        std::string text = head(version);
        for (const std::string& option : options) text += "#define PENUMBRA_" + option + "\n";
        CAPTURE(text);
        folder.write("s." + stage, text + shipped(file) + end);
        CHECK(folder.run("glslangValidator s." + stage));
    };
    const std::string main = "out vec4 penumbra_color;\nvoid main() { penumbra_color = vec4(0.0); }\n";
    for (const std::string version : {"330 core", "300 es"}) {
        for (const std::string capture : {"0", "1", "2"})
            for (const std::string targets : {"1", "2", "3", "4"})
                check("occlusion_texture/slice_capture.frag", "frag", version,
                      {"CAPTURE " + capture, "CAPTURE_TARGETS " + targets}, "");
        for (const std::string filter : {"0", "1", "2"})
            for (const std::string rule : {"0", "1", "2", "3"})
                for (const std::string self : {"0", "1", "2"})
                    check("occlusion_texture/shadow.glsl", "frag", version,
                          {"OCCLUSION_TEXTURE_FILTER " + filter, "OCCLUSION_TEXTURE_COMBINATION " + rule,
                           "OCCLUSION_TEXTURE_SELF_SHADOW " + self, "OCCLUSION_TEXTURE_CHANNELS 1"},
                          main);
        check("penumbra_wedge/overlap.glsl", "frag", version, {"PENUMBRA_WEDGE_CELLS 4"}, main);
        for (int rule = 0; rule < 9; ++rule)
            for (const std::string from : {"0", "1"})
                for (const std::string size : {"8", "16", "32"})
                    check("penumbra_wedge/shadow.glsl", "frag", version,
                          {"PENUMBRA_WEDGE_OVERLAP " + std::to_string(rule), "PENUMBRA_WEDGE_SILHOUETTE " + from,
                           "PENUMBRA_WEDGE_BITMASK_SIZE " + size},
                          main);
        check("penumbra_wedge/shadow.glsl", "frag", version,
              {"PENUMBRA_WEDGE_TOLERANCE 0.02", "PENUMBRA_WEDGE_UNION_EDGES 256"}, main);
        check("plan/tile_classes.frag", "frag", version, {"TILE_SIZE 16"}, "");
        for (const std::string layers : {"1", "2"})
            for (const std::string form : {"0", "1", "2"})
                for (const std::string share : {"0", "1"})
                    for (const std::string depth : {"0", "1"})
                        check("umbra_volume/d_buffer.glsl", "frag", version,
                              {"UMBRA_VOLUME_LAYERS " + layers, "UMBRA_VOLUME_VISIBILITY " + form,
                               "UMBRA_VOLUME_SHARE " + share, "UMBRA_VOLUME_DEPTH " + depth},
                              main);
        for (const std::string a : {"0", "1"}) {
            for (const std::string b : {"0", "1"})
                check("soft_shadow_map/skin_maps.glsl", "frag", version,
                      {"SOFT_SHADOW_MAP_HARD " + a, "SOFT_SHADOW_MAP_EDGES " + b}, main);
            check("soft_shadow_map/row_segments.glsl", "frag", version, {"SOFT_SHADOW_MAP_MASK " + a}, main);
        }
        for (int rule = 0; rule < 6; ++rule)
            for (const std::string pass : {"blend", "copy"})
                check("penumbra_wedge/silhouette_" + pass + ".frag", "frag", version,
                      {"PENUMBRA_WEDGE_OVERLAP " + std::to_string(rule)}, "");
        for (int rule = 0; rule < 6; ++rule)
            check("penumbra_wedge/silhouette_blend.frag", "frag", version,
                  {"PENUMBRA_WEDGE_OVERLAP " + std::to_string(rule), "SILHOUETTE_WITHIN 1"}, "");
        check("penumbra_wedge/silhouette_frustum.vert", "vert", version, {"SILHOUETTE_WITHIN 1"}, "");
        for (const std::string draw : {"0", "1", "2"})
            check("umbra_volume/casters.frag", "frag", version, {"CASTERS " + draw}, "");
        for (const std::string depth : {"0", "1"}) {
            check("umbra_volume/blocking.frag", "frag", version, {"UMBRA_VOLUME_DEPTH " + depth}, "");
            for (const std::string layer : {"0", "1"})
                for (const std::string layers : {"1", "2"})
                    check(
                        "umbra_volume/volumes.frag", "frag", version,
                        {"UMBRA_VOLUME_LAYER " + layer, "UMBRA_VOLUME_LAYERS " + layers, "UMBRA_VOLUME_DEPTH " + depth},
                        "");
        }
        for (const std::string map : {"0", "1", "2"})
            check("soft_shadow_map/light_map.frag", "frag", version, {"LIGHT_MAP " + map}, "");
        for (const std::string detector : {"0", "1"}) {
            const std::string steps = "SOFT_SHADOW_MAP_DETECTOR " + detector;
            check("soft_shadow_map/discontinuities.frag", "frag", version, {steps}, "");
            for (const std::string transition : {"0", "1", "2"})
                for (const std::string hard : {"0", "1"})
                    for (const std::string solid : {"0", "1"})
                        check("soft_shadow_map/skins.frag", "frag", version,
                              {steps, "SOFT_SHADOW_MAP_TRANSITION " + transition, "SOFT_SHADOW_MAP_HARD " + hard,
                               "SOFT_SHADOW_MAP_SOLID " + solid},
                              "");
        }
        // all methods in one shader
        check("penumbra_wedge/shadow.glsl", "frag", version, {},
              shipped("occlusion_texture/shadow.glsl") + shipped("umbra_volume/d_buffer.glsl") +
                  shipped("soft_shadow_map/skin_maps.glsl") + shipped("soft_shadow_map/row_segments.glsl") +
                  shipped("plan/extents.glsl") + main);
    }
    for (const std::string version : {"430 core", "310 es"})
        check("occlusion_texture/summed_area_scan.comp", "comp", version, {"SCAN_COLUMNS 1"}, "");
}
