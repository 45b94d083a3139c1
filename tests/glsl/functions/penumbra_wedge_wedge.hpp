// Twins of penumbra_wedge: silhouettes and wedges.
#pragma once

#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <penumbra/penumbra_wedge/wedge.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// Small whole numbers, whose dot products are exact on every driver, so that decisions agree.
template <int Count>
void small_whole(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = std::copysign(whole(in[k], 0, 64), in[k]);
}

inline void put(const Plane<float>& plane, float* out) { put(plane.normal, out), out[3] = plane.offset; }
/// Two ends, half of the light's size, a point in front of the light: whole numbers times a power of two, exact as
/// well.
inline void edge_and_point(float* in) {
    const float unit = std::ldexp(1.0F, static_cast<int>(whole(in[0], -20, 20)));
    small_whole<11>(in);
    in[6] = std::abs(in[6]), in[7] = std::abs(in[7]), in[10] = 1.0F + std::abs(in[10]);
    if (in[9] > 0.0F) in[2] = std::abs(in[2]), in[5] = std::abs(in[5]);  // often in front of the light
    for (int k = 0; k < 11; ++k) in[k] *= unit;
}
/// Two ends, half of the light's size, bounds of receivers, number of a vertex.
inline void edge_and_receivers(float* in) {
    small_whole<14>(in);
    in[6] = std::abs(in[6]), in[7] = std::abs(in[7]);
    in[2] = std::abs(in[2]);  // often in front of the light
    for (int k = 8; k < 11; ++k)
        if (in[k] > in[k + 3]) std::swap(in[k], in[k + 3]);
    in[13] = 1.0F + std::abs(in[13]);
    if (in[8] > 0.0F)  // at and beside the limit beyond which the receivers' box is the bound
        in[2] = 1.0F, in[5] = std::abs(in[5]), in[13] = 131072.0F + std::copysign(1024.0F, in[5]) * in[9];
    in[14] = whole(in[14], 0, 11);
}

// What texts begin and end with.
#define WEDGE penumbra_Wedge w = penumbra_wedge(V3(0), V3(3), V2(6))
#define PUT_PLANE(k, p) \
    PUT3(k, p.normal);  \
    O(k + 3) = p.offset
#define PUT_HALF(which)                                   \
    penumbra_HalfWedge h = penumbra_half_wedge(w, which); \
    PUT_PLANE(0, h.shadow);                               \
    PUT_PLANE(4, h.outside[0]);                           \
    PUT_PLANE(8, h.outside[1]);                           \
    PUT_PLANE(12, h.outside[2])

inline void put_half(const float* in, WedgeHalf which, float* out) {
    const HalfWedge<float> half = half_wedge(wedge(v3(in), v3(in + 3), v2(in + 6)), which);
    put(half.shadow, out), put(half.outside[0], out + 4);
    put(half.outside[1], out + 8), put(half.outside[2], out + 12);
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
            GLSL(O(0) = float(penumbra_edge_winding(int(I(0)), int(I(1)), PENUMBRA_SILHOUETTE_POINT));
                 O(1) = float(penumbra_edge_winding(int(I(0)), int(I(1)), PENUMBRA_SILHOUETTE_LIGHT_CENTER));),
            [](const float* i, float* o) {
                const int along = static_cast<int>(i[0]), against = static_cast<int>(i[1]);
                o[0] = static_cast<float>(edge_winding(along, against, SilhouetteFrom::point));
                o[1] = static_cast<float>(edge_winding(along, against, SilhouetteFrom::light_center));
            },
            small_whole<2>, 0, nullptr
    });
    list.push_back({
        "wedge: planes through the edge", "penumbra_wedge/wedge", 11, 15,
            GLSL(WEDGE; PUT_PLANE(0, w.shadow); PUT_PLANE(4, w.inner); PUT_PLANE(8, w.outer); PUT2(12, w.half_size);
                 O(14) = w.reach;),
            [](const float* i, float* o) {
                const Wedge<float> w = wedge(v3(i), v3(i + 3), v2(i + 6));
                put(w.shadow, o), put(w.inner, o + 4), put(w.outer, o + 8), put(w.half_size, o + 12), o[14] = w.reach;
            },
            edge_and_point, 0, nullptr
    });
    list.push_back({
        "wedge: planes at its ends", "penumbra_wedge/wedge", 11, 16,
            GLSL(WEDGE; PUT_PLANE(0, w.right); PUT_PLANE(4, w.top); PUT_PLANE(8, w.left); PUT_PLANE(12, w.bottom);),
            [](const float* i, float* o) {
                const Wedge<float> w = wedge(v3(i), v3(i + 3), v2(i + 6));
                put(w.right, o), put(w.top, o + 4), put(w.left, o + 8), put(w.bottom, o + 12);
            },
            edge_and_point, 0, nullptr
    });
    list.push_back({
        "half_wedge: inner", "penumbra_wedge/wedge", 11, 16, GLSL(WEDGE; PUT_HALF(PENUMBRA_WEDGE_HALF_INNER);),
            [](const float* i, float* o) { put_half(i, WedgeHalf::inner, o); }, edge_and_point, 0, nullptr
    });
    list.push_back({
        "half_wedge: outer", "penumbra_wedge/wedge", 11, 16, GLSL(WEDGE; PUT_HALF(PENUMBRA_WEDGE_HALF_OUTER);),
            [](const float* i, float* o) { put_half(i, WedgeHalf::outer, o); }, edge_and_point, 0, nullptr
    });
    list.push_back({
        "contains(Wedge, HalfWedge)", "penumbra_wedge/wedge", 11, 4,
            GLSL(WEDGE; O(0) = penumbra_contains(w, V3(8)) ? 1.0f : 0.0f;
                 O(1) = penumbra_contains(penumbra_half_wedge(w, PENUMBRA_WEDGE_HALF_INNER), V3(8)) ? 1.0f : 0.0f;
                 O(2) = penumbra_contains(penumbra_half_wedge(w, PENUMBRA_WEDGE_HALF_OUTER), V3(8)) ? 1.0f : 0.0f;
                 O(3) = penumbra_wedge_slack(V3(8), w.reach);),
            [](const float* i, float* o) {
                const Wedge<float> w = wedge(v3(i), v3(i + 3), v2(i + 6));
                o[0] = contains(w, v3(i + 8)) ? 1.0F : 0.0F;
                o[1] = contains(half_wedge(w, WedgeHalf::inner), v3(i + 8)) ? 1.0F : 0.0F;
                o[2] = contains(half_wedge(w, WedgeHalf::outer), v3(i + 8)) ? 1.0F : 0.0F;
                o[3] = detail::wedge_slack(v3(i + 8), w.reach);
            },
            edge_and_point, 0, nullptr
    });
    list.push_back({
        "wedge_vertex", "penumbra_wedge/wedge", 15, 3,
            GLSL(vec3 v = penumbra_wedge_vertex(V3(0), V3(3), V2(6), penumbra_box3(V3(8), V3(11)), int(I(14)));
                 PUT3(0, v);),
            [](const float* i, float* o) {
                const Box3<float> receivers{v3(i + 8), v3(i + 11)};
                put(wedge_vertex(v3(i), v3(i + 3), v2(i + 6), receivers, static_cast<int>(i[14])), o);
            },
            edge_and_receivers, 8, [](const float* i) {
                const float near_depth = std::max(std::min(i[2], i[5]), 1.0F);
                return 2.0F * largest(i, 8) * std::max(i[13] / near_depth, 1.0F);
            }
    });
}

#undef WEDGE
#undef PUT_PLANE
#undef PUT_HALF

}  // namespace penumbra::test::functions
