// Twins of penumbra_wedge: unions of silhouettes, by their edges.
#pragma once

#include <algorithm>
#include <penumbra/penumbra_wedge/edge_union.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// A box, two triangles, their weights: 64ths, so that edges lie on each other and cross in corners, or any numbers.
inline void box_and_triangles(float* in) {
    const bool any = std::abs(in[16]) > 1.0F;
    for (int k = 0; k < 16; ++k)
        in[k] = any ? std::copysign(4.0F * share(in[k]), in[k]) : std::copysign(whole(in[k], 0, 256), in[k]) / 64.0F;
    for (const int k : {0, 1}) in[k + 2] = in[k] + std::max(std::abs(in[k + 2]), 0.25F);
    for (const int k : {16, 17}) in[k] = std::copysign(whole(in[k], 0, 2), in[k]);
}
inline float area_of_box(const float* in) { return area(rect(in)); }

/// How often one triangle is added: up to more edges than fit, and half of them pieces of their own.
inline void box_and_times(float* in) {
    in[16] = whole(in[17], 0, 23), in[17] = 1.0F;
    const float times = in[16];
    box_and_triangles(in);
    in[16] = times;
}

inline void add_penumbra_wedge_union(std::vector<Function>& list) {
    list.push_back({
        "EdgeUnion", "penumbra_wedge/edge_union", 18, 3,
            GLSL(penumbra_EdgeUnion u = penumbra_no_edges(); penumbra_Rect2 box = RECT(0);
                 for (int k = 0; k < 6; ++k) {
                     if (k == 3) u = penumbra_begin_piece(u);
                     int a = 4 + 2 * k; int b = k == 2 ? 4 : (k == 5 ? 10 : a + 2);
                     u = penumbra_add(u, V2(a), V2(b), int(I(k < 3 ? 16 : 17)), box);
                 } O(0) = penumbra_area(u, box);
                 O(1) = float(u.count); O(2) = u.is_full ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                EdgeUnion<float, 64> u;
                const Rect2<float> box = rect(i);
                for (int k = 0; k < 6; ++k) {
                    if (k == 3) u.begin_piece();
                    const int a = 4 + 2 * k, b = k == 2 ? 4 : k == 5 ? 10 : a + 2;
                    u.add(v2(i + a), v2(i + b), static_cast<int>(i[k < 3 ? 16 : 17]), box);
                }
                o[0] = u.area([&](float ax, float ay, float bx, float by) {
                    return edge_coverage(Vec2<float>(ax, ay), Vec2<float>(bx, by), box);
                });
                o[1] = static_cast<float>(u.count()), o[2] = 0.0F;
            },
            box_and_triangles, 16, area_of_box
    });
    list.push_back({
        "EdgeUnion, full", "penumbra_wedge/edge_union", 18, 3,
            GLSL(penumbra_EdgeUnion u = penumbra_no_edges(); penumbra_Rect2 box = RECT(0);
                 for (int k = 0; k < int(I(16)); ++k) {
                     if (k - k / 2 * 2 == 0) u = penumbra_begin_piece(u);
                     u = penumbra_add(u, V2(4), V2(6), 1, box); u = penumbra_add(u, V2(6), V2(8), 1, box);
                     u = penumbra_add(u, V2(8), V2(4), 1, box);
                 } O(0) = u.is_full ? 0.0f : penumbra_area(u, box);
                 O(1) = float(u.count); O(2) = u.is_full ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                EdgeUnion<float, 64> u;
                const Rect2<float> box = rect(i);
                bool fits = true;
                for (int k = 0; k < static_cast<int>(i[16]); ++k) {
                    if (k % 2 == 0) u.begin_piece();
                    fits = u.add(v2(i + 4), v2(i + 6), 1, box) && fits;
                    fits = u.add(v2(i + 6), v2(i + 8), 1, box) && fits;
                    fits = u.add(v2(i + 8), v2(i + 4), 1, box) && fits;
                }
                o[0] = fits ? u.area([&](float ax, float ay, float bx, float by) {
                    return edge_coverage(Vec2<float>(ax, ay), Vec2<float>(bx, by), box);
                })
                            : 0.0F;
                o[1] = static_cast<float>(u.count()), o[2] = fits ? 0.0F : 1.0F;
            },
            box_and_times, 64, area_of_box
    });
}

}  // namespace penumbra::test::functions
