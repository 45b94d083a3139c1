// Means over boxes on the driver, by the textures of the C++, in both languages and by way of SPIRV-Cross.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "compute.hpp"

using namespace penumbra;
using test::Api;
using test::Context;
using test::Route;
using test::SliceImages;
using test::Texture;

namespace {

constexpr int lookups = 1 << 14;

std::vector<float> inputs(const std::vector<Rect2<float>>& boxes) {
    std::vector<float> in;
    for (const Rect2<float>& box : boxes) in.insert(in.end(), {box.min.x, box.min.y, box.max.x, box.max.y});
    return in;
}
/// The lookups take NaN; drivers need not keep it. What comes must be finite, and come at all.
bool is_number(const Rect2<float>& box) {
    return !std::isnan(box.min.x) && !std::isnan(box.min.y) && !std::isnan(box.max.x) && !std::isnan(box.max.y);
}

const std::string box_text = "penumbra_rect2(vec2(I(0), I(1)), vec2(I(2), I(3)))";
const std::string put_text = "; for (int k = 0; k < 4; ++k) O(k) = v[k];";

struct Lookup {
    const char *name, *snippet, *sampler;
    std::string call;  ///< of layer 1, which holds slices 4 to 7
    float unit;        ///< from the twin's to the C++'s
};

/// Compares means of slices 4 to 7 by every route.
template <class Filter, class Array>
void compare_means(const Lookup& lookup, const SliceImages& slices, const Array& array, double bound) {
    const int width = slices[0].width(), height = slices[0].height();
    const std::vector<Rect2<float>> boxes = test::boxes(width, height, lookups);
    std::vector<Filter> filters;
    for (std::size_t c = 0; c < 4; ++c) filters.emplace_back(slices[4 + c]);
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        const Texture texture(array);
        texture.bind(0);
        for (const Route route : test::routes()) {
            const test::Compute compute{std::string("occlusion_texture/") + lookup.snippet,
                                        4,
                                        4,
                                        {},
                                        std::string("uniform highp ") + lookup.sampler + " slices;\n",
                                        "vec4 v = " + lookup.call + put_text,
                                        route};
            const std::vector<float> out = compute.run(context, inputs(boxes));
            double worst = 0;
            for (std::size_t i = 0; i < boxes.size(); ++i)
                for (std::size_t c = 0; c < 4; ++c) {
                    const float got = out[4 * i + c] * lookup.unit;
                    const auto truth = static_cast<double>(filters[c].mean(boxes[i]));
                    const double error = std::abs(static_cast<double>(got) - truth) / 255;
                    if (!is_finite(got) || is_number(boxes[i])) worst = error <= worst ? worst : error;  // NaN stays
                }
            std::printf("%-36s %3d x %3d  %d boxes  worst %.3g of the largest texel\n", lookup.name, width, height,
                        lookups, worst);
            CAPTURE(lookup.name);
            CAPTURE(static_cast<int>(route));
            CHECK(worst < bound);
        }
    }
}

}  // namespace

TEST_CASE("means over boxes") {
    for (const auto& size : {std::pair(1, 1), std::pair(17, 13), std::pair(100, 130)}) {
        const SliceImages slices = test::random_slices(size.first, size.second, 8);
        compare_means<SummedArea<std::uint32_t>>({"summed_area_mean", "summed_area.glsl", "usampler2DArray",
                                                  "penumbra_summed_area_mean(slices, 1, " + box_text + ")", 1.0F},
                                                 slices, test::tables_of(slices, size.first, size.second, 4), 1e-6);
        compare_means<NBuffer<std::uint8_t>>({"n_buffer_mean", "n_buffer.glsl", "sampler2DArray",
                                              "penumbra_n_buffer_mean(slices, 2, 1, " + box_text + ")", 255.0F},
                                             slices, test::n_buffers_of(slices, size.first, size.second, 4), 1e-5);
    }
    for (const auto& size : {std::pair(1, 1), std::pair(4, 256), std::pair(256, 4), std::pair(128, 128)}) {
        const SliceImages slices = test::random_slices(size.first, size.second, 8);
        const auto map = test::mipmaps_of(slices, size.first, size.second, 4);
        compare_means<MipMap<std::uint8_t>>(
            {"mipmap_mean", "mipmap.glsl", "sampler2DArray",
             "penumbra_mipmap_mean(slices, " + std::to_string(map.levels.size()) + ", 1, " + box_text + ")", 255.0F},
            slices, map, 1e-5);
    }
}

TEST_CASE("sums are exact") {
    const SliceImages slices = test::random_slices(100, 130, 8);
    const auto table = test::tables_of(slices, 100, 130, 4);
    std::vector<SummedArea<std::uint32_t>> truth;
    for (std::size_t c = 0; c < 4; ++c) truth.emplace_back(slices[4 + c]);
    test::Random random(3);
    std::vector<float> in;
    for (int i = 0; i < 4 * lookups; ++i) in.push_back(static_cast<float>(random.whole(-5, i % 2 == 0 ? 105 : 135)));
    for (const Api api : {Api::desktop, Api::es}) {
        const Context context(api);
        const Texture texture(table);
        texture.bind(0);
        for (const Route route : test::routes()) {
            const test::Compute compute{"occlusion_texture/summed_area.glsl",
                                        4,
                                        4,
                                        {},
                                        "uniform highp usampler2DArray slices;\n",
                                        "uvec4 v = penumbra_summed_area_sum(slices, 1, ivec2(I(0), I(1)), ivec2(I(2), "
                                        "I(3))); for (int k = 0; k < 4; ++k) O(k) = float(v[k]);",
                                        route};
            const std::vector<float> out = compute.run(context, in);
            int wrong = 0;
            const auto whole = [&](std::size_t i) { return static_cast<int>(in[i]); };
            for (std::size_t i = 0; i < in.size(); ++i)
                wrong += out[i] != static_cast<float>(truth[i % 4].sum(whole(i / 4 * 4), whole(i / 4 * 4 + 1),
                                                                       whole(i / 4 * 4 + 2), whole(i / 4 * 4 + 3)));
            CHECK(wrong == 0);
        }
    }
}
