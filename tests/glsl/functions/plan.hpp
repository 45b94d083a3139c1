// Twins of plan.
#pragma once

#include <penumbra/plan/extents.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline LightExtent<float> light_extent(const float* in) { return {v2(in), in[2] > 0.0F}; }
/// Half-extents, either now and then 0, and whether it is a disk.
inline void light_of_any_size(float* in) {
    for (int k = 0; k < 2; ++k) in[k] = in[k] < -1e30F ? 0.0F : 2.0F * moderate_share(in[k]);
}
/// A caster, receivers and a light.
inline void one_caster(float* in) { caster_box(in), receiver_box(in + 6), light_of_any_size(in + 12); }
/// Two casters, half of them one before the other, receivers and a light.
inline void two_casters(float* in) {
    const bool near = in[6] > 0.0F;
    caster_box(in), one_caster(in + 6);
    for (int k = 6; near && k < 12; ++k) in[k] = in[k - 6] + 0.25F * in[k];
}
inline float whole_light(const float*) { return 1.0F; }

inline void add_plan(std::vector<Function>& list) {
    list.push_back({
        "shadow_box", "plan/extents", 15, 6,
            GLSL(penumbra_Box3 b = penumbra_shadow_box(BOX(0), BOX(6), V2(12)); PUT3(0, b.min); PUT3(3, b.max);),
            [](const float* i, float* o) {
                const Box3<float> b = shadow_box(box(i), box(i + 6), v2(i + 12));
                put(b.min, o), put(b.max, o + 3);
            },
            one_caster, 8, [](const float* i) { return largest(i, 14); }
    });
    // 1e-5 of the light: 84 ULP
    list.push_back({
        "light_share", "plan/extents", 7, 1, GLSL(EXTENT(4); O(0) = penumbra_light_share(RECT(0), light);),
            [](const float* i, float* o) { o[0] = light_share(rect(i), light_extent(i + 4)); },
            [](float* i) {
                for (int k = 0; k < 4; ++k) i[k] = 4.0F * std::copysign(moderate_share(i[k]), i[k]);
                light_of_any_size(i + 4);
            },
            84, whole_light
    });
    list.push_back({
        "size_limit", "plan/extents", 15, 1, GLSL(EXTENT(12); O(0) = penumbra_size_limit(BOX(0), BOX(6), light);),
            [](const float* i, float* o) { o[0] = size_limit(box(i), box(i + 6), light_extent(i + 12)); }, one_caster,
            84, whole_light
    });
    list.push_back({
        "occlusion_limit", "plan/extents", 15, 1,
            GLSL(EXTENT(12); O(0) = penumbra_occlusion_limit(BOX(0), BOX(6), light);),
            [](const float* i, float* o) { o[0] = occlusion_limit(box(i), box(i + 6), light_extent(i + 12)); },
            one_caster, 84, whole_light
    });
    list.push_back({
        "overlap_limit", "plan/extents", 21, 1,
            GLSL(EXTENT(18); O(0) = penumbra_overlap_limit(BOX(0), BOX(6), BOX(12), light);),
            [](const float* i, float* o) {
                o[0] = overlap_limit(box(i), box(i + 6), box(i + 12), light_extent(i + 18));
            },
            two_casters, 84, whole_light
    });
    list.push_back({
        "penumbra_width", "plan/extents", 14, 1, GLSL(O(0) = penumbra_penumbra_width(BOX(0), BOX(6), V2(12));),
            [](const float* i, float* o) { o[0] = penumbra_width(box(i), box(i + 6), v2(i + 12)); }, one_caster, 8,
            nullptr
    });
    list.push_back({
        "with_caster", "plan/extents", 16, 1,
            GLSL(EXTENT(12); O(0) = float(penumbra_with_caster(int(I(15)), BOX(0), BOX(6), light));),
            [](const float* i, float* o) {
                const auto so_far = static_cast<TileClass>(static_cast<int>(i[15]));
                o[0] =
                    static_cast<float>(static_cast<int>(with_caster(so_far, box(i), box(i + 6), light_extent(i + 12))));
            },
            [](float* i) { one_caster(i), i[15] = whole(i[15], 0, 2); }, 0, nullptr
    });
}

}  // namespace penumbra::test::functions
