// The twins that read textures, and whole queries, on the driver with the textures of the C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <penumbra/occlusion_texture/shadow.hpp>

#include "compute.hpp"
#include "support/box_mesh.hpp"
#include "support/random.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::Texture;

namespace {

constexpr std::size_t lookups = 1 << 14;

Image<SliceTexel> random_slices(int width, int height) {
    test::Random random(1);
    Image<SliceTexel> image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        for (int c = 0; c < 4; ++c) image.data()[i][c] = static_cast<std::uint8_t>(random.whole(0, 255));
    return image;
}

Image<std::uint8_t> channel(const Image<SliceTexel>& image, int c) {
    Image<std::uint8_t> slice(image.width(), image.height());
    for (std::size_t i = 0; i < slice.size(); ++i) slice.data()[i] = image.data()[i][c];
    return slice;
}

/// Of every size and place: inside, across borders, beyond them, without size, at whole positions.
std::vector<float> boxes(int width, int height) {
    test::Random random(2);
    std::vector<float> result;
    for (std::size_t i = 0; i < lookups; ++i) {
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        float x = random.in(-0.2F * w, 1.2F * w), y = random.in(-0.2F * h, 1.2F * h);
        float size_x = w * std::exp2(random.in(-9.0F, 0.5F)), size_y = h * std::exp2(random.in(-9.0F, 0.5F));
        if (i % 4 == 1) x = std::floor(x), y = std::floor(y), size_x = std::ceil(size_x), size_y = std::ceil(size_y);
        if (i % 4 == 2) size_x = size_y = std::ldexp(1.0F, random.whole(0, 6));
        if (i % 16 == 3) size_x = 0.0F;
        if (i % 64 == 7) x = -1e30F, size_x = 2e30F;
        for (const float value : {x, y, x + size_x, y + size_y}) result.push_back(value);
    }
    return result;
}

Rect2<float> box_at(const std::vector<float>& in, std::size_t i) {
    return {Vec2<float>(in[4 * i], in[4 * i + 1]), Vec2<float>(in[4 * i + 2], in[4 * i + 3])};
}

const std::string box_text = "penumbra_rect2(vec2(I(0), I(1)), vec2(I(2), I(3)))";
const std::string put_text = "for (int k = 0; k < 4; ++k) O(k) = v[k];";

/// Largest difference of means, of the largest texel. `truth` is the filter of one channel.
template <class Filter>
double worst_mean(const std::vector<float>& in, const std::vector<float>& out, double unit,
                  const std::array<Filter, 4>& filters) {
    double worst = 0;
    for (std::size_t i = 0; i < lookups; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            const double truth = static_cast<double>(filters[c].mean(box_at(in, i)));
            worst = std::max(worst, std::abs(static_cast<double>(out[4 * i + c]) * unit - truth) / 255);
        }
    return worst;
}

template <class Filter>
std::array<Filter, 4> filters_of(const Image<SliceTexel>& image) {
    return {Filter(channel(image, 0)), Filter(channel(image, 1)), Filter(channel(image, 2)), Filter(channel(image, 3))};
}

Texture table_of(const std::vector<Image<std::uint8_t>>& slices, int width, int height) {
    const int layers = static_cast<int>(slices.size() + 3) / 4;
    Texture texture(GL_RGBA32UI, width + 1, height + 1, layers);
    const auto sums = static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1);
    for (int layer = 0; layer < layers; ++layer) {
        std::vector<std::uint32_t> texels(4 * sums, 0);
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t slice = 4 * static_cast<std::size_t>(layer) + c;
            if (slice >= slices.size() || slices[slice].empty()) continue;
            const SummedArea<std::uint32_t> table(slices[slice]);
            for (std::size_t i = 0; i < sums; ++i) texels[4 * i + c] = table.data()[i];
        }
        texture.upload(layer, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.data());
    }
    return texture;
}

Texture n_buffers_of(const std::vector<Image<SliceTexel>>& groups) {
    const NBuffer<SliceTexel> first(groups[0]);
    const int layers = static_cast<int>(groups.size());
    Texture texture(GL_RGBA8, groups[0].width(), groups[0].height(), first.levels() * layers);
    for (int group = 0; group < layers; ++group) {
        const NBuffer<SliceTexel> buffer(groups[static_cast<std::size_t>(group)]);
        for (int l = 0; l < buffer.levels(); ++l)
            texture.upload(l * layers + group, GL_RGBA, GL_UNSIGNED_BYTE, buffer.level(l).data());
    }
    return texture;
}

}  // namespace

TEST_CASE("summed-area sums are exact, means to 1e-6") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        for (const auto& size : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
            const Image<SliceTexel> image = random_slices(size.first, size.second);
            const auto filters = filters_of<SummedArea<std::uint32_t>>(image);
            std::vector<Image<std::uint8_t>> slices;
            for (int c = 0; c < 4; ++c) slices.push_back(channel(image, c));
            const Texture table = table_of(slices, size.first, size.second);
            table.bind(0);
            const std::vector<float> in = boxes(size.first, size.second);
            test::Compute compute{"occlusion_texture/summed_area.glsl", 4, 4, {}, {}, {}, Route::direct};
            compute.uniforms = "uniform highp usampler2DArray slices;\n";
            compute.body = "vec4 v = penumbra_summed_area_mean(slices, 0, " + box_text + "); " + put_text;
            const double worst = worst_mean(in, compute.run(context, in), 1.0, filters);
            std::printf("summed_area_mean  %d x %d  worst %.3g of the largest texel\n", size.first, size.second, worst);
            CHECK(worst < 1e-6);
            compute.body =
                "uvec4 v = penumbra_summed_area_sum(slices, 0, ivec2(clamp(I(0), -9.0, 999.0), clamp(I(1), "
                "-9.0, 999.0)), ivec2(clamp(I(2), -9.0, 999.0), clamp(I(3), -9.0, 999.0))); "
                "for (int k = 0; k < 4; ++k) O(k) = float(v[k]);";
            const std::vector<float> sums = compute.run(context, in);
            int wrong = 0;
            const auto whole = [](float x) { return static_cast<int>(clamp(x, -9.0F, 999.0F)); };
            for (std::size_t i = 0; i < lookups; ++i)
                for (std::size_t c = 0; c < 4; ++c)
                    wrong += sums[4 * i + c] !=
                             static_cast<float>(filters[c].sum(whole(in[4 * i]), whole(in[4 * i + 1]),
                                                               whole(in[4 * i + 2]), whole(in[4 * i + 3])));
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("N-Buffer and mip-map means to 1e-5") {
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        for (const auto& size : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
            const Image<SliceTexel> image = random_slices(size.first, size.second);
            const Texture levels = n_buffers_of({image});
            levels.bind(0);
            const std::vector<float> in = boxes(size.first, size.second);
            test::Compute compute{"occlusion_texture/n_buffer.glsl", 4, 4, {}, {}, {}, Route::direct};
            compute.uniforms = "uniform highp sampler2DArray slices;\n";
            compute.body = "vec4 v = penumbra_n_buffer_mean(slices, 1, 0, " + box_text + "); " + put_text;
            const double worst =
                worst_mean(in, compute.run(context, in), 255.0, filters_of<NBuffer<std::uint8_t>>(image));
            std::printf("n_buffer_mean  %d x %d  worst %.3g of the largest texel\n", size.first, size.second, worst);
            CHECK(worst < 1e-5);
        }
        for (const auto& size : {std::pair(1, 1), std::pair(4, 256), std::pair(256, 4), std::pair(128, 128)}) {
            const Image<SliceTexel> image = random_slices(size.first, size.second);
            const MipMap<SliceTexel> map(image);
            const Texture texture(GL_RGBA8, size.first, size.second, 1, map.levels());
            for (int l = 0; l < map.levels(); ++l)
                texture.upload_level(l, map.level(l).width(), map.level(l).height(), map.level(l).data());
            texture.bind(0);
            const std::vector<float> in = boxes(size.first, size.second);
            test::Compute compute{"occlusion_texture/mipmap.glsl", 4, 4, {}, {}, {}, Route::direct};
            compute.uniforms = "uniform highp sampler2DArray slices;\n";
            compute.body = "vec4 v = penumbra_mipmap_mean(slices, " + std::to_string(map.levels()) + ", 0, " +
                           box_text + "); " + put_text;
            const double worst =
                worst_mean(in, compute.run(context, in), 255.0, filters_of<MipMap<std::uint8_t>>(image));
            std::printf("mipmap_mean  %d x %d  worst %.3g of the largest texel\n", size.first, size.second, worst);
            CHECK(worst < 1e-5);
        }
    }
}

namespace {

/// A query of the C++ and of the driver at the same points.
struct Query {
    std::vector<Mesh<float>> casters{test::box_mesh<float>({0.3F, 3.0F, -0.2F}, {1, 1, 1}),
                                     test::box_mesh<float>({-1.4F, 2.0F, 0.8F}, {0.4F, 1.1F, 0.5F}),
                                     {{{-2, 1, -2}, {2, 2, -2}, {2, 2, -1}, {-2, 1, -1}}, {{0, 1, 2}, {0, 2, 3}}}};
    RectLight<float> light{{0, 8, 0}, {1.5F, 0, 0}, {0, 0, 1}};

    std::vector<Vec3<float>> points() const {
        test::Random random(3);
        std::vector<Vec3<float>> result;
        for (int i = 0; i < 8192; ++i) {
            const float x = random.in(-3.0F, 3.0F), y = i % 2 == 0 ? 0.0F : random.in(-0.5F, 9.0F);
            result.emplace_back(x, y, random.in(-3.0F, 3.0F));
        }
        return result;
    }

    /// Returns the largest difference of visibility.
    double worst(const Context& context, const OcclusionTextureOptions& options) const {
        const OcclusionTextureShadow<float> shadow(casters, light, options);
        const std::vector<Vec3<float>> at = points();
        std::vector<float> truth(at.size());
        shadow.visibility(at.data(), at.size(), truth.data());

        const LightFrame<float> frame = light_frame(light);
        const auto triangles = lit_triangles(casters, frame, options.faces);
        const auto& camera = shadow.camera();
        const auto slices = capture_slices(triangles, camera, shadow.range(), options.blend.close_leaks);
        const bool sums = options.filter == SliceFilter::summed_area;
        const Texture masks = sums ? table_of(slices.masks, camera.width, camera.height)
                                   : n_buffers_of(pack_rgba(slices.masks, camera.width, camera.height));
        const Texture depths = sums ? table_of(slices.depths, camera.width, camera.height)
                                    : n_buffers_of(pack_rgba(slices.depths, camera.width, camera.height));
        masks.bind(0), depths.bind(1);

        std::vector<float> in;
        for (const Vec3<float>& p : at) {
            const Vec3<float> point_ls = frame.to_light(p);
            in.insert(in.end(), {point_ls.x, point_ls.y, point_ls.z});
        }
        const std::string sampler = sums ? "usampler2DArray" : "sampler2DArray";
        test::Compute compute{"occlusion_texture/shadow.glsl", 3, 1, {}, {}, {}, Route::direct};
        compute.options = {
            "PENUMBRA_OCCLUSION_TEXTURE_FILTER " + std::to_string(sums ? 2 : 1),
            "PENUMBRA_OCCLUSION_TEXTURE_COMBINATION " + std::to_string(static_cast<int>(options.blend.combination)),
            "PENUMBRA_OCCLUSION_TEXTURE_CELLS " + std::to_string(options.light_cells),
            "PENUMBRA_OCCLUSION_TEXTURE_PLANE " + std::to_string(static_cast<int>(options.plane)),
            "PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW " + std::to_string(static_cast<int>(options.self_shadow)),
            "PENUMBRA_OCCLUSION_TEXTURE_BIAS " + std::to_string(options.self_shadow_bias)};
        compute.uniforms = "uniform highp " + sampler +
                           " masks, depths;\nuniform float convergence; uniform vec2 origin_tx, "
                           "scale_tx, half_size; uniform vec2 range; uniform int slices;\n";
        compute.body =
            "penumbra_OcclusionTexture info; info.camera.convergence = convergence; info.camera.origin_tx = origin_tx; "
            "info.camera.scale_tx = scale_tx; info.range.first = range.x; info.range.thickness = range.y; "
            "info.range.count = slices; info.half_size = half_size; info.levels = 1; "
            "O(0) = penumbra_visibility(masks, depths, info, vec3(I(0), I(1), I(2)));";
        const std::vector<float> out = compute.run(context, in, [&](const test::Program& program) {
            program.set("masks", 0), program.set("depths", 1);
            program.set("convergence", camera.convergence);
            program.set("origin_tx", camera.origin_tx), program.set("scale_tx", camera.scale_tx);
            program.set("half_size", half_size(light));
            program.set("range", Vec2<float>(shadow.range().first, shadow.range().thickness));
            program.set("slices", shadow.range().count);
        });
        double result = 0;
        for (std::size_t i = 0; i < at.size(); ++i)
            result = std::max(result, std::abs(static_cast<double>(out[i]) - static_cast<double>(truth[i])));
        return result;
    }
};

}  // namespace

TEST_CASE("whole queries are the C++'s, for every option") {
    const Query query;
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        double largest = 0;
        for (const SliceFilter filter : {SliceFilter::summed_area, SliceFilter::n_buffer})
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
                    const double worst = query.worst(context, options);
                    CAPTURE(static_cast<int>(filter));
                    CAPTURE(static_cast<int>(rule));
                    CAPTURE(static_cast<int>(self));
                    CHECK(worst < 2e-4);
                    largest = std::max(largest, worst);
                }
        std::printf("visibility, every option: worst %.3g of %.3g\n", largest, 2e-4);
    }
}
