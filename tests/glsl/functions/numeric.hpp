// Twins of numeric. The same operations in the same order; drivers may round divisions by 2.5 ULP.
#pragma once

#include <penumbra/numeric.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline void add_numeric(std::vector<Function>& list) {
    list.push_back({
        "clamp", "numeric", 3, 1, GLSL(O(0) = penumbra_clamp(I(0), I(1), I(2));),
            [](const float* i, float* o) { o[0] = clamp(i[0], i[1], i[2]); },
            [](float* i) {
                if (i[1] > i[2]) std::swap(i[1], i[2]);
            },
            0, nullptr
    });
    list.push_back({
        "saturate", "numeric", 1, 1, GLSL(O(0) = penumbra_saturate(I(0));),
            [](const float* i, float* o) { o[0] = saturate(i[0]); }, anything, 0, nullptr
    });
    list.push_back({
        "saturated_ratio", "numeric", 2, 1, GLSL(O(0) = penumbra_saturated_ratio(I(0), I(1));),
            [](const float* i, float* o) { o[0] = saturated_ratio(i[0], i[1]); },
            [](float* i) { i[1] = std::min(std::abs(i[1]), 0x1p125F); }, 3, nullptr
    });
    list.push_back({
        "safe_ratio", "numeric", 3, 1, GLSL(O(0) = penumbra_safe_ratio(I(0), I(1), I(2));),
            [](const float* i, float* o) { o[0] = safe_ratio(i[0], i[1], i[2]); },
            [](float* i) { i[0] = moderate(i[0]), i[1] = i[1] == 0.0F ? 0.0F : moderate(i[1]); }, 3, nullptr
    });
    list.push_back({
        "mix", "numeric", 3, 1, GLSL(O(0) = penumbra_mix(I(0), I(1), I(2));),
            [](const float* i, float* o) { o[0] = mix(i[0], i[1], i[2]); },
            [](float* i) { moderate_all<2>(i), i[2] = share(i[2]); }, 2, [](const float* i) { return largest(i, 2); }
    });
    list.push_back({
        "floor_log2", "numeric", 1, 1, GLSL(O(0) = float(penumbra_floor_log2(I(0)));),
            [](const float* i, float* o) { o[0] = static_cast<float>(floor_log2(i[0])); }, endless, 0, nullptr
    });
    list.push_back({
        "exp2_int", "numeric", 1, 1, GLSL(O(0) = penumbra_exp2_int(int(I(0)));),
            [](const float* i, float* o) { o[0] = exp2_int<float>(static_cast<int>(i[0])); },
            [](float* i) { i[0] = whole(i[0], -126, 127); }, 0, nullptr
    });
    list.push_back({
        "is_finite", "numeric", 1, 1, GLSL(O(0) = penumbra_is_finite(I(0)) ? 1.0f : 0.0f;),
            [](const float* i, float* o) { o[0] = is_finite(i[0]) ? 1.0F : 0.0F; }, endless, 0, nullptr
    });
}

}  // namespace penumbra::test::functions
