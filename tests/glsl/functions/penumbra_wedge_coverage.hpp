// Twins of penumbra_wedge: coverage and clip.
#pragma once

#include <penumbra/penumbra_wedge/clip.hpp>
#include <penumbra/penumbra_wedge/coverage.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// Two ends and a box. Most ends within 4 half-sizes of the box's middle, many on its borders; one in four far away.
inline void edge_and_box(float* in) {
    for (int k = 4; k < 8; ++k) in[k] = std::copysign(share(in[k]), in[k]);
    const Vec2<float> middle(4.0F * in[4], 4.0F * in[5]), half(0.0625F + std::abs(in[6]), 0.0625F + std::abs(in[7]));
    for (int k = 0; k < 4; ++k) {
        const float near = 2.0F * std::copysign(share(in[k]), in[k]), across = k % 2 == 0 ? middle.x : middle.y;
        const bool far = in[6] < 0.0F && k / 2 == (in[7] < 0.0F ? 1 : 0);
        in[k] = far ? moderate(in[k]) : across + 2.0F * near * (k % 2 == 0 ? half.x : half.y);
    }
    put(Rect2<float>{middle - half, middle + half}, in + 4);
}
inline float box_area(const float* in) { return area(rect(in + 4)); }

/// Vertices, a point, a box: eighths, of which first cuts decide exactly on every driver.
template <int Vertices>
void casters_and_box(float* in) {
    const auto eighths = [](float x, int most) { return std::copysign(whole(x, 0, 8 * most) / 8.0F, x); };
    constexpr int point = 3 * Vertices, box = point + 3;
    for (int k = 0; k < box; ++k) in[k] = eighths(in[k], 4);
    if (in[0] < in[1])  // in front of the light
        for (int k = 2; k < point; k += 3) in[k] = std::abs(in[k]);
    in[point + 2] = 0.125F + 2.0F * std::abs(in[point + 2]);
    const Vec2<float> low(eighths(in[box], 2), eighths(in[box + 1], 2));
    const Vec2<float> size(whole(in[box + 2], 0, 16) / 8.0F, whole(in[box + 3], 0, 16) / 8.0F);
    put(Rect2<float>{low, low + size}, in + box);
}

inline void add_penumbra_wedge_coverage(std::vector<Function>& list) {
    list.push_back({
        "column_edge: columns and order", "penumbra_wedge/coverage", 8, 3,
            GLSL(penumbra_ColumnEdge e = penumbra_column_edge(V2(0), V2(2), RECT(4)); O(0) = e.x0; O(1) = e.x1;
                 O(2) = e.sign;),
            [](const float* i, float* o) {
                const detail::ColumnEdge<float> e = detail::column_edge(i[0], i[1], i[2], i[3], rect(i + 4));
                o[0] = e.x0, o[1] = e.x1, o[2] = e.sign;
            },
            edge_and_box, 0, nullptr
    });
    list.push_back({
        "edge_coverage", "penumbra_wedge/coverage", 8, 1, GLSL(O(0) = penumbra_edge_coverage(V2(0), V2(2), RECT(4));),
            [](const float* i, float* o) { o[0] = edge_coverage(v2(i), v2(i + 2), rect(i + 4)); }, edge_and_box, 8,
            box_area
    });
    list.push_back({
        "edge_moments", "penumbra_wedge/coverage", 8, 3,
            GLSL(penumbra_CoverageMoments m = penumbra_edge_moments(V2(0), V2(2), RECT(4)); O(0) = m.area; O(1) = m.x;
                 O(2) = m.y;),
            [](const float* i, float* o) {
                const CoverageMoments<float> m = edge_moments(v2(i), v2(i + 2), rect(i + 4));
                o[0] = m.area, o[1] = m.x, o[2] = m.y;
            },
            edge_and_box, 8, [](const float* i) {
                const Vec2<float> size = extent(rect(i + 4));
                return box_area(i) * std::max(1.0F, std::max(size.x, size.y));
            }
    });
    list.push_back({
        "project_edge", "penumbra_wedge/clip", 13, 5,
            GLSL(penumbra_ProjectedEdge e = penumbra_project_edge(V3(0), V3(3), V3(6), RECT(9)); PUT2(0, e.a);
                 PUT2(2, e.b); O(4) = e.lands ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                const ProjectedEdge<float> e = project_edge(v3(i), v3(i + 3), v3(i + 6), rect(i + 9));
                put(e.a, o), put(e.b, o + 2), o[4] = e.lands ? 1.0F : 0.0F;
            },
            casters_and_box<2>, 64, [](const float*) { return 8.0F; }
    });
    list.push_back({
        "triangle_coverage", "penumbra_wedge/clip", 16, 1,
            GLSL(O(0) = penumbra_triangle_coverage(V3(0), V3(3), V3(6), V3(9), RECT(12));),
            [](const float* i, float* o) {
                o[0] = triangle_coverage(v3(i), v3(i + 3), v3(i + 6), v3(i + 9), rect(i + 12));
            },
            casters_and_box<3>, 64, [](const float*) { return 1.0F; }
    });
}

}  // namespace penumbra::test::functions
