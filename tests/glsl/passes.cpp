// The passes that build occlusion textures, run on the driver, against the C++: N-Buffers and tables bit for bit,
// captured slices but for texels on edges.
#include <doctest/doctest.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <string>
#include <utility>
#include <vector>

#include "context.hpp"
#include "program.hpp"
#include "support/box_mesh.hpp"
#include "support/random.hpp"

using namespace penumbra;
using penumbra::test::Api;
using penumbra::test::Context;
using penumbra::test::Program;
using penumbra::test::Texture;

namespace {

using Texel = SliceTexel;

Image<Texel> random_slices(int width, int height) {
    return pack_rgba(test::random_slices(width, height, 4), width, height)[0];
}

constexpr std::pair<int, int> sizes[] = {{1, 1}, {6, 1}, {17, 13}, {100, 130}, {257, 130}};

/// Layers of the levels of an N-Buffer, level by level.
template <class Build>
int wrong_levels(const Image<Texel>& image, Build&& build) {
    const NBuffer<Texel> truth(image);
    const Texture levels(GL_RGBA8, image.width(), image.height(), truth.levels());
    levels.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
    int wrong = 0;
    for (int l = 1; l < truth.levels(); ++l) {
        build(levels, l);
        const std::vector<std::uint8_t> result = levels.bytes(l);
        const auto* expected = reinterpret_cast<const std::uint8_t*>(truth.level(l).data());
        for (std::size_t i = 0; i < result.size(); ++i) wrong += result[i] != expected[i];
    }
    return wrong;
}

/// Of a table of four slices, or of four tables of one.
int wrong_sums(const Texture& table, const Image<Texel>& image, int channels) {
    int wrong = 0;
    for (int c = 0; c < 4; ++c) {
        const std::vector<std::uint32_t> result = table.sums(channels == 4 ? 0 : c);
        Image<std::uint8_t> slice(image.width(), image.height());
        for (std::size_t i = 0; i < slice.size(); ++i) slice.data()[i] = image.data()[i][c];
        const SummedArea<std::uint32_t> truth(slice);
        for (std::size_t i = 0; i < result.size() / 4; ++i)
            wrong += result[4 * i + static_cast<std::size_t>(channels == 4 ? c : 0)] != truth.data()[i];
    }
    return wrong;
}

/// Draws what slice_capture.frag captures of the casters, `capture` being one of its draws.
void draw_capture(const Context& context, const std::vector<Mesh<float>>& casters, const LightFrame<float>& frame,
                  const SliceCamera<float>& camera, const SliceRange<float>& range, int capture,
                  const std::vector<std::pair<const Texture*, int>>& targets) {
    const int groups = (range.count + 3) / 4;
    const Program program(
        context, "occlusion_texture/slice_capture.vert", "occlusion_texture/slice_capture.frag",
        {"PENUMBRA_CAPTURE " + std::to_string(capture), "PENUMBRA_CAPTURE_TARGETS " + std::to_string(groups)});
    program.use();
    program.set("penumbra_world", glm::mat4(1.0F));
    program.set("penumbra_light_origin", frame.origin);
    program.set("penumbra_light_u", frame.u);
    program.set("penumbra_light_v", frame.v);
    program.set("penumbra_light_normal", frame.normal);
    program.set("penumbra_convergence", camera.convergence);
    program.set("penumbra_origin_tx", camera.origin_tx);
    program.set("penumbra_scale_tx", camera.scale_tx);
    program.set("penumbra_size_tx", Vec2<float>(static_cast<float>(camera.width), static_cast<float>(camera.height)));
    program.set("penumbra_farthest", range.bottom(range.count - 1) * 1.1F);
    program.set("penumbra_range_first", range.first);
    program.set("penumbra_range_thickness", range.thickness);
    program.set("penumbra_range_count", range.count);
    program.set("penumbra_first", 0);
    Texture::attach(targets);
    glEnable(GL_BLEND);
    glBlendEquation(capture == 1 || capture == 3 ? GL_MAX : GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    for (const Mesh<float>& mesh : casters) {
        const bool closed = is_closed(edge_adjacency(mesh));
        if (capture == 2 && !closed) continue;
        program.set("penumbra_close_leaks", closed ? 0 : 1);
        program.draw_triangles(mesh);
    }
    glDisable(GL_BLEND);
}

}  // namespace

TEST_CASE("N-Buffer levels of fragment and compute passes are the C++'s, bit for bit") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        CAPTURE(context.version(false));
        for (const auto& size : sizes) {
            const Image<Texel> image = random_slices(size.first, size.second);
            CAPTURE(size.first);
            const Program fragment(context, "occlusion_texture/full_screen.vert",
                                   "occlusion_texture/n_buffer_level.frag", {});
            CHECK(wrong_levels(image, [&](const Texture& levels, int l) {
                      fragment.use();
                      levels.bind(0);
                      fragment.set("penumbra_levels", 0);
                      fragment.set("penumbra_layer", l - 1);
                      fragment.set("penumbra_level", l - 1);
                      levels.attach(l, 1);
                      fragment.draw_full_screen();
                  }) == 0);
            const Program compute(context, "occlusion_texture/n_buffer_level.comp", {});
            CHECK(wrong_levels(image, [&](const Texture& levels, int l) {
                      compute.use();
                      levels.bind_image(0, GL_READ_ONLY, GL_RGBA8);
                      levels.bind_image(1, GL_WRITE_ONLY, GL_RGBA8);
                      compute.set("penumbra_layers", glm::ivec2(l - 1, l));
                      compute.set("penumbra_level", l - 1);
                      glDispatchCompute(static_cast<GLuint>(size.first + 7) / 8,
                                        static_cast<GLuint>(size.second + 7) / 8, 1);
                      glMemoryBarrier(GL_ALL_BARRIER_BITS);
                  }) == 0);
        }
    }
}

TEST_CASE("summed-area tables of fragment and compute passes are the C++'s, bit for bit") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        CAPTURE(context.version(false));
        for (const auto& size : sizes) {
            const Image<Texel> image = random_slices(size.first, size.second);
            CAPTURE(size.first);
            const int width = size.first + 1, height = size.second + 1;
            const Texture slices(GL_RGBA8, size.first, size.second, 1);
            slices.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, image.data());

            const Texture tables[2] = {{GL_RGBA32UI, width, height, 1}, {GL_RGBA32UI, width, height, 1}};
            const Texture apart(GL_R32UI, width, height, 4);
            const Program step(context, "occlusion_texture/full_screen.vert", "occlusion_texture/summed_area_step.frag",
                               {});
            const Program last(context, "occlusion_texture/full_screen.vert", "occlusion_texture/summed_area_step.frag",
                               {"PENUMBRA_STEP_CHANNELS 1"});
            std::vector<glm::ivec2> reaches{{0, 0}};
            for (int reach = 1; reach < width; reach *= 4) reaches.emplace_back(reach, 0);
            for (int reach = 1; reach < height; reach *= 4) reaches.emplace_back(0, reach);
            int written = 0;
            const auto draw = [&](const Program& program, const Texture& sums, const glm::ivec2& reach) {
                program.use();
                slices.bind(0), sums.bind(1);
                program.set("penumbra_slices", 0), program.set("penumbra_sums", 1);
                program.set("penumbra_layer", 0), program.set("penumbra_reach", reach);
                program.draw_full_screen();
            };
            for (const glm::ivec2& reach : reaches) {
                if (reach == reaches.back()) {
                    apart.attach(0, 4);
                    draw(last, tables[written], reach);
                }
                written = 1 - written;
                tables[written].attach(0, 1);
                draw(step, tables[1 - written], reach);
            }
            CHECK(wrong_sums(tables[written], image, 4) == 0);
            CHECK(wrong_sums(apart, image, 1) == 0);

            const Program rows(context, "occlusion_texture/summed_area_scan.comp", {"PENUMBRA_SCAN_COLUMNS 0"});
            const Program columns(context, "occlusion_texture/summed_area_scan.comp", {"PENUMBRA_SCAN_COLUMNS 1"});
            rows.use();
            slices.bind(0), rows.set("penumbra_slices", 0), rows.set("penumbra_layer", 0);
            tables[0].bind_image(0, GL_WRITE_ONLY, GL_RGBA32UI);
            glDispatchCompute(static_cast<GLuint>(height), 1, 1);
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
            columns.use();
            columns.set("penumbra_layer", 0);
            tables[1].bind_image(0, GL_WRITE_ONLY, GL_RGBA32UI);
            tables[0].bind_image(1, GL_READ_ONLY, GL_RGBA32UI);
            glDispatchCompute(static_cast<GLuint>(width), 1, 1);
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
            CHECK(wrong_sums(tables[1], image, 4) == 0);

            const Program one_each(context, "occlusion_texture/summed_area_scan.comp",
                                   {"PENUMBRA_SCAN_COLUMNS 1", "PENUMBRA_SCAN_CHANNELS 1"});
            const Texture one_a_layer(GL_R32UI, width, height, 4);
            one_each.use();
            one_each.set("penumbra_layer", 0);
            one_a_layer.bind_image(0, GL_WRITE_ONLY, GL_R32UI);
            tables[0].bind_image(1, GL_READ_ONLY, GL_RGBA32UI);
            glDispatchCompute(static_cast<GLuint>(width), 1, 1);
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
            CHECK(wrong_sums(one_a_layer, image, 1) == 0);
        }
    }
}

TEST_CASE("slices captured on the driver are the C++'s, but for texels on edges") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        CAPTURE(context.version(false));
        const std::vector<Mesh<float>> casters{
            test::box_mesh<float>({0.3F, 3.0F, -0.2F}, {1, 1, 1}),
            test::box_mesh<float>({0.9F, 2.4F, 0.4F}, {0.7F, 0.7F, 0.7F}),
            test::box_mesh<float>({-1.4F, 2.0F, 0.8F}, {0.4F, 1.1F, 0.5F}),
            {{{-2, 1, -2}, {2, 2, -2}, {2, 2, -1}, {-2, 1, -1}}, {{0, 1, 2}, {0, 2, 3}}}};  // the last is open
        const RectLight<float> light{{0, 8, 0}, {1, 0, 0}, {0, 0, 1}};
        const LightFrame<float> frame = light_frame(light);
        const auto triangles = lit_triangles(casters, frame, SliceFaces::solid);
        const auto camera =
            fit_slice_camera(triangles.vertices_ls, half_size(light), SliceProjection::perspective, 256, 2);
        const auto range = slice_range(triangles, 7);
        const Slices<float> truth = capture_slices(triangles, camera, range, true);
        const int groups = 2;
        const Texture masks(GL_RGBA8, camera.width, camera.height, groups),
            depths(GL_RGBA8, camera.width, camera.height, groups),
            windings(GL_RGBA16F, camera.width, camera.height, groups);
        const Texture* captured[] = {&masks, &depths, &windings};
        for (int capture = 0; capture < 3; ++capture)
            draw_capture(context, casters, frame, camera, range, capture,
                         {{captured[capture], 0}, {captured[capture], 1}});
        const Texture masks_at_once(GL_RGBA8, camera.width, camera.height, groups),
            depths_at_once(GL_RGBA8, camera.width, camera.height, groups);
        draw_capture(context, casters, frame, camera, range, 3,
                     {{&masks_at_once, 0}, {&depths_at_once, 0}, {&masks_at_once, 1}, {&depths_at_once, 1}});
        for (int group = 0; group < groups; ++group) {
            CHECK(masks_at_once.bytes(group) == masks.bytes(group));
            CHECK(depths_at_once.bytes(group) == depths.bytes(group));
        }

        const Texture final_masks(GL_RGBA8, camera.width, camera.height, groups),
            final_depths(GL_RGBA8, camera.width, camera.height, groups);
        const Program resolve(context, "occlusion_texture/full_screen.vert", "occlusion_texture/slice_resolve.frag",
                              {});
        for (int group = 0; group < groups; ++group) {
            resolve.use();
            masks.bind(0), depths.bind(1), windings.bind(2);
            resolve.set("penumbra_masks", 0), resolve.set("penumbra_depths", 1), resolve.set("penumbra_windings", 2);
            resolve.set("penumbra_group", group);
            Texture::attach({{&final_masks, group}, {&final_depths, group}});
            resolve.draw_full_screen();
        }
        int masked = 0, different = 0, deeper = 0, partial = 0;
        for (int group = 0; group < groups; ++group) {
            const std::vector<std::uint8_t> mask = final_masks.bytes(group), depth = final_depths.bytes(group);
            for (int c = 0; c < 4 && 4 * group + c < range.count; ++c) {
                const auto slice = static_cast<std::size_t>(4 * group + c);
                for (std::size_t i = 0; i < truth.masks[slice].size(); ++i) {
                    const int m = mask[4 * i + static_cast<std::size_t>(c)],
                              d = depth[4 * i + static_cast<std::size_t>(c)];
                    masked += m == 255;
                    partial += m != 0 && m != 255;
                    if (m != truth.masks[slice].data()[i])
                        ++different;
                    else
                        deeper += std::abs(d - truth.depths[slice].data()[i]) > 2;
                }
            }
        }
        MESSAGE(masked << " texels blocked, " << different << " different, " << deeper << " of another depth");
        CHECK(partial == 0);
        CHECK(masked > 20000);
        CHECK(different < masked / 200);
        CHECK(deeper < masked / 100);
    }
}
