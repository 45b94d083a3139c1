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

inline void add_penumbra_wedge_union(std::vector<Function>& list) {
    list.push_back({
        "EdgeUnion", "penumbra_wedge/edge_union", 18, 2,
            GLSL(penumbra_EdgeUnion u; u.count = 0; u.pieces = 2; penumbra_Rect2 box = RECT(0);
                 for (int k = 0; k < 6; ++k) {
                     int a = 4 + 2 * k;
                     int b = k == 2 ? 4 : (k == 5 ? 10 : a + 2);
                     penumbra_ColumnEdge edge = penumbra_column_edge(V2(a), V2(b), box);
                     int weight = int(I(k < 3 ? 16 : 17));
                     if (penumbra_is_over(edge, weight, box)) {
                         u.edges[u.count] = penumbra_union_edge(edge, weight, k < 3 ? 1 : 2);
                         ++u.count;
                     }
                 } O(0) = penumbra_area(u, box);
                 O(1) = float(u.count);),
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
                o[1] = static_cast<float>(u.count());
            },
            box_and_triangles, 16, area_of_box
    });
}

}  // namespace penumbra::test::functions
