// Twins of penumbra_wedge: silhouettes and wedges.
#pragma once

#include <penumbra/penumbra_wedge/silhouette.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// Small whole numbers, whose dot products are exact on every driver, so that decisions agree.
template <int Count>
void small_whole(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = std::copysign(whole(in[k], 0, 64), in[k]);
}

inline void add_penumbra_wedge_wedge(std::vector<Function>& list) {
    list.push_back({
        "face_normal", "penumbra_wedge/silhouette", 9, 3,
            GLSL(vec3 v = penumbra_face_normal(V3(0), V3(3), V3(6)); PUT3(0, v);),
            [](const float* i, float* o) { put(face_normal(v3(i), v3(i + 3), v3(i + 6)), o); }, moderate_all<9>, 8,
            [](const float* i) {  // needles lose what their area lacks
                const Vec3<double> a(v3(i)), ab = Vec3<double>(v3(i + 3)) - a, ac = Vec3<double>(v3(i + 6)) - a;
                const double area = glm::length(glm::cross(ab, ac));
                return static_cast<float>(std::min(glm::length(ab) * glm::length(ac) / std::max(area, 1e-30), 1e30));
            }
    });
    list.push_back({
        "silhouette_tolerance", "penumbra_wedge/silhouette", 6, 2,
            GLSL(O(0) = penumbra_silhouette_tolerance(penumbra_box3(V3(0), V3(3)));
                 O(1) = penumbra_silhouette_tolerance(penumbra_empty_box());),
            [](const float* i, float* o) {
                o[0] = silhouette_tolerance(Box3<float>{v3(i), v3(i + 3)}),
                o[1] = silhouette_tolerance(empty_box<float>());
            },
            [](float* i) {
                moderate_all<6>(i);
                for (int k = 0; k < 3; ++k)
                    if (share(i[5]) > 0.1F && i[k] > i[k + 3]) std::swap(i[k], i[k + 3]);
            },
            0, nullptr
    });
    list.push_back({
        "face_winding", "penumbra_wedge/silhouette", 10, 2,
            GLSL(O(0) = float(penumbra_face_winding(V3(0), V3(3), V3(6), I(9), PENUMBRA_SURFACE_SOLID));
                 O(1) = float(penumbra_face_winding(V3(0), V3(3), V3(6), I(9), PENUMBRA_SURFACE_SHEET));),
            [](const float* i, float* o) {
                o[0] = static_cast<float>(face_winding(v3(i), v3(i + 3), v3(i + 6), i[9], Surface::solid));
                o[1] = static_cast<float>(face_winding(v3(i), v3(i + 3), v3(i + 6), i[9], Surface::sheet));
            },
            [](float* i) { small_whole<10>(i), i[9] = std::abs(i[9]); }, 0, nullptr
    });
    list.push_back({
        "edge_winding", "penumbra_wedge/silhouette", 2, 2,
            GLSL(O(0) = float(penumbra_edge_winding(int(I(0)), int(I(1)), PENUMBRA_VIEWER_POINT));
                 O(1) = float(penumbra_edge_winding(int(I(0)), int(I(1)), PENUMBRA_VIEWER_LIGHT));),
            [](const float* i, float* o) {
                const int along = static_cast<int>(i[0]), against = static_cast<int>(i[1]);
                o[0] = static_cast<float>(edge_winding(along, against, Viewer::point));
                o[1] = static_cast<float>(edge_winding(along, against, Viewer::light));
            },
            small_whole<2>, 0, nullptr
    });
}

}  // namespace penumbra::test::functions
