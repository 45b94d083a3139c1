// The twins that read textures, and whole queries, compiled as C++, against the C++ with the same textures.
#include <doctest/doctest.h>

#include "as_cpp.hpp"

namespace glsl {

namespace summed_area_fade {
#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION PENUMBRA_COMBINATION_PRODUCT
#define PENUMBRA_OCCLUSION_TEXTURE_CELLS 3
#define PENUMBRA_OCCLUSION_TEXTURE_PLANE PENUMBRA_SLICE_PLANE_BOTTOM
#define PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW PENUMBRA_SELF_SHADOW_FADE
#include "as_cpp_query.hpp"
}  // namespace summed_area_fade

namespace n_buffer {
#define PENUMBRA_OCCLUSION_TEXTURE_FILTER PENUMBRA_FILTER_N_BUFFER
#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION PENUMBRA_COMBINATION_MEAN
#define PENUMBRA_OCCLUSION_TEXTURE_BIAS 0.25f
#include "as_cpp_query.hpp"
}  // namespace n_buffer

namespace n_buffer_clear {
#define PENUMBRA_OCCLUSION_TEXTURE_FILTER PENUMBRA_FILTER_N_BUFFER
#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION PENUMBRA_COMBINATION_SUM
#define PENUMBRA_OCCLUSION_TEXTURE_CHANNELS 1
#define PENUMBRA_OCCLUSION_TEXTURE_CELLS 1
#define PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW PENUMBRA_SELF_SHADOW_CLEAR
#include "as_cpp_query.hpp"
}  // namespace n_buffer_clear

namespace mipmap {
#define PENUMBRA_OCCLUSION_TEXTURE_FILTER PENUMBRA_FILTER_MIPMAP
#include "as_cpp_query.hpp"
}  // namespace mipmap

namespace mipmap_single {
#define PENUMBRA_OCCLUSION_TEXTURE_FILTER PENUMBRA_FILTER_MIPMAP
#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION PENUMBRA_COMBINATION_PRODUCT
#define PENUMBRA_OCCLUSION_TEXTURE_CHANNELS 1
#define PENUMBRA_OCCLUSION_TEXTURE_PLANE PENUMBRA_SLICE_PLANE_BOTTOM
#include "as_cpp_query.hpp"
}  // namespace mipmap_single

}  // namespace glsl

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"

using penumbra::Image;
using penumbra::MipMap;
using penumbra::NBuffer;
using penumbra::Rect2;
using penumbra::SliceTexel;
using penumbra::SummedArea;
using penumbra::Vec2;
using penumbra::Vec3;
using Values = glsl::TextureArray<glm::vec4>;
using Sums = glsl::TextureArray<glm::uvec4>;
using Slices = std::vector<Image<std::uint8_t>>;

namespace {

// --- Textures -----------------------------------------------------------------------------------------------
Slices random_slices(int width, int height, int count) {
    penumbra::test::Random random(1);
    Slices slices;
    for (int s = 0; s < count; ++s) {
        slices.emplace_back(width, height);
        for (std::size_t i = 0; i < slices.back().size(); ++i)
            slices.back().data()[i] = static_cast<std::uint8_t>(random.whole(0, 255));
    }
    return slices;
}

/// Calls write(layer, channel, slice) for every slice that holds anything, `channels` slices to a layer.
template <class Write>
void for_each_slice(const Slices& slices, int channels, Write&& write) {
    for (int s = 0; s < static_cast<int>(slices.size()); ++s)
        if (const auto& slice = slices[static_cast<std::size_t>(s)]; !slice.empty())
            write(s / channels, s % channels, slice);
}
int layers_of(const Slices& slices, int channels) {
    return (static_cast<int>(slices.size()) + channels - 1) / channels;
}

Sums table_of(const Slices& slices, int width, int height, int channels) {
    Sums texture(width + 1, height + 1, layers_of(slices, channels));
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        const SummedArea<std::uint32_t> table(slice);
        for (int y = 0; y <= height; ++y)
            for (int x = 0; x <= width; ++x) texture.at({x, y, layer}, 0)[channel] = table.data()[y * (width + 1) + x];
    });
    return texture;
}

void copy(const Image<std::uint8_t>& from, Values& to, int layer, int channel, int level, float unit) {
    for (int y = 0; y < from.height(); ++y)
        for (int x = 0; x < from.width(); ++x)
            to.at({x, y, layer}, level)[channel] = static_cast<float>(from(x, y)) * unit;
}

/// Texels of 255 become 255 `unit`.
Values n_buffers_of(const Slices& slices, int width, int height, int channels, float unit) {
    const int groups = layers_of(slices, channels);
    const int levels = NBuffer<std::uint8_t>(Image<std::uint8_t>(width, height)).levels();
    Values texture(width, height, levels * groups);
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        const NBuffer<std::uint8_t> buffer(slice);
        for (int l = 0; l < levels; ++l) copy(buffer.level(l), texture, l * groups + layer, channel, 0, unit);
    });
    return texture;
}

/// Sides become powers of two.
Values mipmaps_of(const Slices& slices, int width, int height, int channels, float unit) {
    const int wide = 1 << penumbra::detail::ceil_log2(width), high = 1 << penumbra::detail::ceil_log2(height);
    const int levels = penumbra::detail::ceil_log2(std::max(width, height)) + 1;
    Values texture(wide, high, layers_of(slices, channels), levels);
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        Image<std::uint8_t> padded(wide, high);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) padded(x, y) = slice(x, y);
        const MipMap<std::uint8_t> map(padded);
        for (int l = 0; l < levels; ++l) copy(map.level(l), texture, layer, channel, l, unit);
    });
    return texture;
}

// --- Boxes --------------------------------------------------------------------------------------------------
constexpr int lookups = 20480;

/// Inside, across borders, beyond them, without size, inside out, at whole positions, a few ULP below these, and NaN.
std::vector<Rect2<float>> boxes(int width, int height) {
    penumbra::test::Random random(2);
    std::vector<Rect2<float>> result;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    for (int i = 0; i < lookups; ++i) {
        Vec2<float> at(random.in(-0.2F * w, 1.2F * w), random.in(-0.2F * h, 1.2F * h));
        Vec2<float> size(w * std::exp2(random.in(-9.0F, 0.5F)), h * std::exp2(random.in(-9.0F, 0.5F)));
        if (i % 4 == 1) at = glm::floor(at), size = glm::ceil(size);
        if (i % 4 == 2) size = Vec2<float>(std::ldexp(1.0F, random.whole(0, 6)));
        if (i % 16 == 1) at *= 1.0F - 0x1p-23F, size *= 1.0F + 0x1p-23F;
        if (i % 16 == 3) size.x = 0.0F;
        if (i % 32 == 11) size = -size;
        if (i % 64 == 7) at.x = -1e30F, size.x = 2e30F;
#ifndef __FAST_MATH__
        if (i % 128 == 15) at.y = std::numeric_limits<float>::quiet_NaN();
        if (i % 128 == 31) size.y = std::numeric_limits<float>::infinity();
#endif
        result.push_back({at, at + size});
    }
    return result;
}
glsl::penumbra_Rect2 twin_of(const Rect2<float>& box) { return glsl::penumbra_rect2(box.min, box.max); }

// Same operations, same order; without -ffast-math the same bits. Boxes of 1/16 texel divide by 1/256.
#if defined(__FAST_MATH__) || defined(__FP_FAST_FMAF)
constexpr double filter_tolerance = 1e-5, sum_tolerance = 2e-5;
#else
constexpr double filter_tolerance = 0, sum_tolerance = 0;
#endif

/// Largest difference between means of the twin and of the C++, one filter a channel, of the largest texel.
template <class Filter, class Mean>
double worst_mean(const Slices& slices, Mean&& mean) {
    std::vector<Filter> filters;
    for (const auto& slice : slices) filters.emplace_back(slice);
    double worst = 0;
    for (const Rect2<float>& box : boxes(slices[0].width(), slices[0].height())) {
        const glm::vec4 twin = mean(twin_of(box));
        for (int c = 0; c < 4; ++c) {
            const auto truth = static_cast<double>(filters[static_cast<std::size_t>(c)].mean(box));
            const double error = std::abs(static_cast<double>(twin[c]) - truth) / 255;
            worst = error <= worst ? worst : error;  // NaN stays
        }
    }
    return worst;
}

template <class Packed>
Image<SliceTexel> pack(const Packed& slices) {
    return penumbra::pack_rgba(slices, slices[0].width(), slices[0].height())[0];
}

}  // namespace

TEST_CASE("summed-area sums and means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
        const Slices slices = random_slices(width, height, 8);
        const Slices second(slices.begin() + 4, slices.end());
        const Sums table = table_of(slices, width, height, 4);
        const double worst = worst_mean<SummedArea<std::uint32_t>>(
            second, [&](const glsl::penumbra_Rect2& box) { return glsl::penumbra_summed_area_mean({&table}, 1, box); });
        std::printf("summed_area_mean  %d x %d  worst %.3g of the largest texel\n", width, height, worst);
        CHECK(worst <= sum_tolerance);

        penumbra::test::Random random(3);
        std::vector<SummedArea<std::uint32_t>> truth;
        for (const auto& slice : second) truth.emplace_back(slice);
        int wrong = 0;
        for (int i = 0; i < lookups; ++i) {
            const int x0 = random.whole(-5, width + 5), x1 = random.whole(-5, width + 5);
            const int y0 = random.whole(-5, height + 5), y1 = random.whole(-5, height + 5);
            const glm::uvec4 sum = glsl::penumbra_summed_area_sum({&table}, 1, {x0, y0}, {x1, y1});
            for (int c = 0; c < 4; ++c)
                wrong += sum[c] != truth[static_cast<std::size_t>(c)].sum(x0, y0, x1, y1) ? 1 : 0;
        }
        CHECK(wrong == 0);
        const auto corner = glsl::penumbra_summed_area_corner({&table}, 1, {width - 1, height - 1});
        CHECK(corner.texel == glm::vec4(pack(second)(width - 1, height - 1)));
    }
}

TEST_CASE("N-Buffer means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
        const Slices slices = random_slices(width, height, 8);
        const Slices second(slices.begin() + 4, slices.end());
        const Values levels = n_buffers_of(slices, width, height, 4, 1.0F);
        const auto mean = [&levels = levels](const glsl::penumbra_Rect2& box) {
            return glsl::penumbra_n_buffer_mean({&levels}, 2, 1, box);
        };
        const double worst = worst_mean<NBuffer<std::uint8_t>>(second, mean);
        std::printf("n_buffer_mean  %d x %d  worst %.3g of the largest texel\n", width, height, worst);
        CHECK(worst <= filter_tolerance);
        const NBuffer<SliceTexel> packed(pack(second));
        for (const Rect2<float>& box : {Rect2<float>{{0, 0}, {1, 1}}, Rect2<float>{{-3, 0.5F}, {9, 5}}})
            CHECK(glm::length(mean(twin_of(box)) - packed.mean(box)) <= 255.0F * static_cast<float>(filter_tolerance));
    }
}

TEST_CASE("mip-map means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(16, 64), std::pair(128, 128)}) {
        const Slices slices = random_slices(width, height, 8);
        const Slices second(slices.begin() + 4, slices.end());
        const Values texture = mipmaps_of(slices, width, height, 4, 1.0F);
        const int levels = static_cast<int>(texture.levels.size());
        const auto mean = [&texture = texture, levels](const glsl::penumbra_Rect2& box) {
            return glsl::penumbra_mipmap_mean({&texture}, levels, 1, box);
        };
        const double worst = worst_mean<MipMap<std::uint8_t>>(second, mean);
        std::printf("mipmap_mean  %d x %d  worst %.3g of the largest texel\n", width, height, worst);
        CHECK(worst <= filter_tolerance);
        const MipMap<SliceTexel> packed(pack(second));
        REQUIRE(packed.levels() == levels);
        for (const Rect2<float>& box : {Rect2<float>{{0, 0}, {1, 1}}, Rect2<float>{{-3, 0.5F}, {9, 5}}})
            CHECK(glm::length(mean(twin_of(box)) - packed.mean(box)) <= 255.0F * static_cast<float>(filter_tolerance));
    }
}

namespace {

/// Largest difference of visibility between a query of the C++ and one of the twin, with the same textures.
template <class Query>
void compare_queries(const char* name) {
    using penumbra::test::box_mesh;
    const std::vector<penumbra::Mesh<float>> casters{box_mesh<float>({0.3F, 3.0F, -0.2F}, {1, 1, 1}),
                                                     box_mesh<float>({-1.4F, 2.0F, 0.8F}, {0.4F, 1.1F, 0.5F}),
                                                     box_mesh<float>({1.2F, 1.0F, 1.1F}, {0.3F, 0.2F, 0.9F})};
    const penumbra::RectLight<float> light{{0, 8, 0}, {1.5F, 0, 0}, {0, 0, 1}};
    penumbra::OcclusionTextureOptions options;
    options.slices = 7, options.resolution = 96, options.light_cells = Query::cells;
    options.filter = static_cast<penumbra::SliceFilter>(Query::filter);
    options.blend = {static_cast<penumbra::Combination>(Query::combination), false};
    options.plane = static_cast<penumbra::SlicePlane>(Query::plane);
    options.self_shadow = static_cast<penumbra::SelfShadow>(Query::self_shadow);
    options.self_shadow_bias = Query::bias;
    const penumbra::OcclusionTextureShadow<float> shadow(casters, light, options);

    const auto frame = penumbra::light_frame(light);
    const auto& camera = shadow.camera();
    const auto slices = penumbra::capture_slices(penumbra::lit_triangles(casters, frame, options.faces), camera,
                                                 shadow.range(), options.blend.close_leaks);
    const auto texture_of = [&](const Slices& images) {
        const int w = camera.width, h = camera.height;
        if constexpr (std::is_same_v<typename Query::Slices, glsl::usampler2DArray>)
            return table_of(images, w, h, Query::channels);
        else
            return options.filter == penumbra::SliceFilter::n_buffer
                       ? n_buffers_of(images, w, h, Query::channels, 1.0F / 255.0F)
                       : mipmaps_of(images, w, h, Query::channels, 1.0F / 255.0F);
    };
    const auto masks = texture_of(slices.masks), depths = texture_of(slices.depths);
    typename Query::Info info;
    info.camera = {camera.convergence, camera.origin_tx, camera.scale_tx, camera.width, camera.height};
    info.range = {shadow.range().first, shadow.range().thickness, shadow.range().count};
    info.half_size = penumbra::half_size(light);
    info.levels = static_cast<int>(masks.levels.size());

    penumbra::test::Random random(3);
    double worst = 0;
    int penumbrae = 0;
    for (int i = 0; i < lookups; ++i) {
        const float x = random.in(-3.0F, 3.0F), y = i % 2 == 0 ? 0.0F : random.in(-0.5F, 9.0F);
        const Vec3<float> point(x, y, random.in(-3.0F, 3.0F));
        const float truth = shadow.visibility(point);
        const float twin = Query::visibility({&masks}, {&depths}, info, frame.to_light(point));
        const double error = std::abs(static_cast<double>(truth) - static_cast<double>(twin));
        worst = error <= worst ? worst : error;
        penumbrae += truth > 0.0F && truth < 1.0F ? 1 : 0;
    }
    std::printf("visibility  %-18s %d points, %d in penumbra  worst %.3g\n", name, lookups, penumbrae, worst);
    CAPTURE(name);
    CHECK(worst <= 1e-4);
    CHECK(penumbrae > lookups / 10);
}

}  // namespace

TEST_CASE("visibility") {
    compare_queries<glsl::Query>("defaults");
    compare_queries<glsl::summed_area_fade::Query>("summed_area_fade");
    compare_queries<glsl::n_buffer::Query>("n_buffer");
    compare_queries<glsl::n_buffer_clear::Query>("n_buffer_clear");
    compare_queries<glsl::mipmap::Query>("mipmap");
    compare_queries<glsl::mipmap_single::Query>("mipmap_single");
}

TEST_CASE("reads beyond a texture are noticed") {
    const Values texture(4, 4, 2);
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture}, {4, 0, 0}, 0), std::out_of_range);
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture}, {0, 0, 2}, 0), std::out_of_range);
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture}, {0, 0, 0}, 1), std::out_of_range);
}
