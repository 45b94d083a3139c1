// Twins of combine.
#pragma once

#include <penumbra/combine.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline void add_combine(std::vector<Function>& list) {
    list.push_back({
        "combine_product, _sum, _max, _mean", "combine", 2, 4,
            GLSL(O(0) = penumbra_combine_product(I(0), I(1)); O(1) = penumbra_combine_sum(I(0), I(1));
                 O(2) = penumbra_combine_max(I(0), I(1)); O(3) = penumbra_combine_mean(I(0), I(1));),
            [](const float* i, float* o) {
                o[0] = combine_product(i[0], i[1]), o[1] = combine_sum(i[0], i[1]);
                o[2] = combine_max(i[0], i[1]), o[3] = combine_mean(i[0], i[1]);
            },
            shares<2>, 2, nullptr
    });
    list.push_back({
        "occlusion_bounds", "combine", 2, 2,
            GLSL(penumbra_OcclusionBounds b = penumbra_occlusion_bounds(I(0), I(1)); O(0) = b.lower; O(1) = b.upper;),
            [](const float* i, float* o) { put(occlusion_bounds(i[0], i[1]), o); }, shares<2>, 0, nullptr
    });
    list.push_back({
        "OcclusionAccumulator", "combine", 3, 6,
            GLSL(penumbra_OcclusionAccumulator a = penumbra_no_occlusion();
                 for (int k = 0; k < 3; ++k) a = penumbra_add(a, I(k)); penumbra_OcclusionBounds b = penumbra_bounds(a);
                 O(0) = b.lower; O(1) = b.upper; O(2) = penumbra_result(a, PENUMBRA_COMBINATION_PRODUCT);
                 O(3) = penumbra_result(a, PENUMBRA_COMBINATION_SUM);
                 O(4) = penumbra_result(a, PENUMBRA_COMBINATION_MAX);
                 O(5) = penumbra_result(a, PENUMBRA_COMBINATION_MEAN);),
            [](const float* i, float* o) {
                const OcclusionAccumulator<float> a = accumulated(i);
                put(a.bounds(), o);
                o[2] = a.result(Combination::product), o[3] = a.result(Combination::sum);
                o[4] = a.result(Combination::max), o[5] = a.result(Combination::mean);
            },
            shares<3>, 4, [](const float*) { return 1.0F; }
    });
}

}  // namespace penumbra::test::functions
