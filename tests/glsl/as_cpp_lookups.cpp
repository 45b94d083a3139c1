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
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "cases.hpp"

using penumbra::Image;
using penumbra::MipMap;
using penumbra::NBuffer;
using penumbra::Rect2;
using penumbra::SliceTexel;
using penumbra::SummedArea;
using namespace penumbra::test;

namespace {

constexpr int lookups = 20480;
glsl::penumbra_Rect2 twin_of(const Rect2<float>& box) { return glsl::penumbra_rect2(box.min, box.max); }

// Same operations, same order: the same bits.
#ifdef __FP_FAST_FMAF  // unless compilers fuse products and sums as they please
constexpr double tolerance = 2e-5;
#else
constexpr double tolerance = 0;
#endif

/// Largest difference between means of the twin and of the C++, of the largest texel. One filter a channel.
template <class Filter, class Mean>
double worst_mean(const SliceImages& slices, Mean&& mean) {
    std::vector<Filter> filters;
    for (const auto& slice : slices) filters.emplace_back(slice);
    double worst = 0;
    for (const Rect2<float>& box : boxes(slices[0].width(), slices[0].height(), lookups)) {
        const glm::vec4 twin = mean(twin_of(box));
        for (int c = 0; c < 4; ++c) {
            const auto truth = static_cast<double>(filters[static_cast<std::size_t>(c)].mean(box));
            const double error = std::abs(static_cast<double>(twin[c]) - truth) / 255;
            worst = error <= worst ? worst : error;  // NaN stays
        }
    }
    return worst;
}

/// Slices 4 to 7 of 8, which are layer 1.
SliceImages second(const SliceImages& slices) { return {slices.begin() + 4, slices.end()}; }

void report(const char* name, int width, int height, double worst) {
    std::printf("%-18s %d x %d  %d boxes  worst %.3g of the largest texel\n", name, width, height, lookups, worst);
    CHECK(worst <= tolerance);
}

}  // namespace

TEST_CASE("summed-area sums and means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
        const SliceImages slices = random_slices(width, height, 8);
        const Sums tables = tables_of(slices, width, height, 4);
        const auto mean = [&tables](const glsl::penumbra_Rect2& box) {
            return glsl::penumbra_summed_area_mean({&tables}, 1, box);
        };
        report("summed_area_mean", width, height, worst_mean<SummedArea<std::uint32_t>>(second(slices), mean));

        Random random(3);
        std::vector<SummedArea<std::uint32_t>> truth;
        for (const auto& slice : second(slices)) truth.emplace_back(slice);
        int wrong = 0;
        for (int i = 0; i < lookups; ++i) {
            const int x0 = random.whole(-5, width + 5), x1 = random.whole(-5, width + 5);
            const int y0 = random.whole(-5, height + 5), y1 = random.whole(-5, height + 5);
            const glm::uvec4 sum = glsl::penumbra_summed_area_sum({&tables}, 1, {x0, y0}, {x1, y1});
            for (int c = 0; c < 4; ++c)
                wrong += sum[c] != truth[static_cast<std::size_t>(c)].sum(x0, y0, x1, y1) ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("N-Buffer means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
        const SliceImages slices = random_slices(width, height, 8);
        const Values levels = n_buffers_of(slices, width, height, 4);
        const auto mean = [&levels](const glsl::penumbra_Rect2& box) {
            return glsl::penumbra_n_buffer_mean({&levels, 1.0F}, 2, 1, box);
        };
        report("n_buffer_mean", width, height, worst_mean<NBuffer<std::uint8_t>>(second(slices), mean));
    }
}

TEST_CASE("mip-map means") {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(16, 64), std::pair(128, 128)}) {
        const SliceImages slices = random_slices(width, height, 8);
        const Values map = mipmaps_of(slices, width, height, 4);
        const auto mean = [&map](const glsl::penumbra_Rect2& box) {
            return glsl::penumbra_mipmap_mean({&map, 1.0F}, static_cast<int>(map.levels.size()), 1, box);
        };
        report("mipmap_mean", width, height, worst_mean<MipMap<std::uint8_t>>(second(slices), mean));
    }
}

namespace {

glsl::sampler2DArray sampler_of(const Values& texture) { return {&texture, 1.0F / 255.0F}; }
glsl::usampler2DArray sampler_of(const Sums& texture) { return {&texture}; }

/// Largest difference of visibility between a query of the C++ and one of the twin, with the same textures.
template <class Query>
void compare_queries(const char* name) {
    penumbra::OcclusionTextureOptions options;
    options.slices = 7, options.resolution = 96, options.light_cells = Query::cells;
    options.filter = static_cast<penumbra::SliceFilter>(Query::filter);
    options.blend = {static_cast<penumbra::Combination>(Query::combination), false};
    options.plane = static_cast<penumbra::SlicePlane>(Query::plane);
    options.self_shadow = static_cast<penumbra::SelfShadow>(Query::self_shadow);
    options.self_shadow_bias = Query::bias;
    const QueryCase query(options, Query::channels, lookups);

    const auto& camera = query.shadow.camera();
    typename Query::Info info;
    info.camera = {camera.convergence, camera.origin_tx, camera.scale_tx, camera.width, camera.height};
    info.range = {query.shadow.range().first, query.shadow.range().thickness, query.shadow.range().count};
    info.half_size = penumbra::half_size(query.light);
    info.levels = query.levels();
    using Texture = std::conditional_t<std::is_same_v<typename Query::Slices, glsl::usampler2DArray>, Sums, Values>;
    const Texture &masks = std::get<Texture>(query.masks), &depths = std::get<Texture>(query.depths);

    double worst = 0;
    for (std::size_t i = 0; i < query.truth.size(); ++i) {
        const float twin = Query::visibility(sampler_of(masks), sampler_of(depths), info, query.points_ls[i]);
        const double error = std::abs(static_cast<double>(query.truth[i]) - static_cast<double>(twin));
        worst = error <= worst ? worst : error;
    }
    std::printf("visibility  %-18s %d points, %d in penumbra  worst %.3g\n", name, lookups, query.penumbrae(), worst);
    CAPTURE(name);
    CHECK(worst <= 2e-6);
    CHECK(query.penumbrae() > lookups / 10);
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
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture, 1.0F}, {4, 0, 0}, 0), std::out_of_range);
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture, 1.0F}, {0, 0, 2}, 0), std::out_of_range);
    CHECK_THROWS_AS(glsl::texelFetch(glsl::sampler2DArray{&texture, 1.0F}, {0, 0, 0}, 1), std::out_of_range);
}
