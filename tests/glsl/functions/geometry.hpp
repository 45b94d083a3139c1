// Twins of geometry.
#pragma once

#include <penumbra/geometry.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline void add_geometry(std::vector<Function>& list) {
    list.push_back({
        "is_finite(Vec2, Vec3)", "geometry", 3, 2,
            GLSL(O(0) = penumbra_is_finite(V2(0)) ? 1.0f : 0.0f;
                 O(1) = penumbra_is_finite(vec3(I(1), I(2), I(0))) ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                o[0] = is_finite(v2(i)) ? 1.0F : 0.0F;
                o[1] = is_finite(Vec3<float>(i[1], i[2], i[0])) ? 1.0F : 0.0F;
            },
            [](float* i) { endless(i), endless(i + 1), endless(i + 2); }, 0, nullptr
    });
    list.push_back({
        "normalize_or", "geometry", 6, 3, GLSL(vec3 v = penumbra_normalize_or(V3(0), V3(3)); PUT3(0, v);),
            [](const float* i, float* o) { put(normalize_or(v3(i), v3(i + 3)), o); }, anything, 8,
            [](const float*) { return 1.0F; }
    });
    list.push_back({
        "safe_length", "geometry", 3, 1, GLSL(O(0) = penumbra_safe_length(V3(0));),
            [](const float* i, float* o) { o[0] = safe_length(v3(i)); },
            [](float* i) {
                for (int k = 0; k < 3; ++k) i[k] = std::abs(i[k]) > 0x1p126F ? 1.0F : i[k];
            },
            6, nullptr
    });
    list.push_back({
        "any_perpendicular", "geometry", 3, 3, GLSL(vec3 v = penumbra_any_perpendicular(V3(0)); PUT3(0, v);),
            [](const float* i, float* o) { put(any_perpendicular(v3(i)), o); }, unit, 6,
            [](const float*) { return 1.0F; }
    });
    list.push_back({
        "empty_rect", "geometry", 1, 4, GLSL(penumbra_Rect2 r = penumbra_empty_rect(); PUT_RECT(0, r);),
            [](const float*, float* o) { put(empty_rect<float>(), o); }, anything, 0, nullptr
    });
    list.push_back({
        "extent", "geometry", 4, 2, GLSL(vec2 v = penumbra_extent(RECT(0)); PUT2(0, v);),
            [](const float* i, float* o) { put(extent(rect(i)), o); }, moderate_all<4>, 0, nullptr
    });
    list.push_back({
        "extend(Rect2)", "geometry", 6, 4, GLSL(penumbra_Rect2 r = penumbra_extend(RECT(0), V2(4)); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(extend(rect(i), v2(i + 4)), o); }, anything, 0, nullptr
    });
    list.push_back({
        "intersect", "geometry", 8, 4, GLSL(penumbra_Rect2 r = penumbra_intersect(RECT(0), RECT(4)); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(intersect(rect(i), rect(i + 4)), o); }, anything, 0, nullptr
    });
    list.push_back({
        "area", "geometry", 4, 1, GLSL(O(0) = penumbra_area(RECT(0));),
            [](const float* i, float* o) { o[0] = area(rect(i)); }, moderate_all<4>, 0, nullptr
    });
    list.push_back({
        "empty_box, is_empty, extend(Box3)", "geometry", 6, 10,
            GLSL(penumbra_Box3 b = penumbra_empty_box(); O(0) = penumbra_is_empty(b) ? 1.0f : 0.0f; O(8) = b.min.y;
                 O(9) = b.max.z; b = penumbra_extend(penumbra_extend(b, V3(0)), V3(3)); for (int k = 0; k < 3; ++k) {
                     O(1 + k) = b.min[k];
                     O(4 + k) = b.max[k];
                 } O(7) = penumbra_is_empty(penumbra_box3(V3(0), V3(3))) ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                Box3<float> b = empty_box<float>();
                o[0] = is_empty(b) ? 1.0F : 0.0F, o[8] = b.min.y, o[9] = b.max.z;
                b = extend(extend(b, v3(i)), v3(i + 3));
                put(b.min, o + 1), put(b.max, o + 4);
                o[7] = is_empty(Box3<float>{v3(i), v3(i + 3)}) ? 1.0F : 0.0F;
            },
            anything, 0, nullptr
    });
    list.push_back({
        "signed_distance", "geometry", 7, 1,
            GLSL(penumbra_Plane p; p.normal = V3(0); p.offset = I(3); O(0) = penumbra_signed_distance(p, V3(4));),
            [](const float* i, float* o) {
                o[0] = signed_distance(Plane<float>{v3(i), i[3]}, v3(i + 4));
            },
            moderate_all<7>, 4,
            [](const float* i) { return std::max(std::abs(i[3]), largest(i, 3) * largest(i + 4, 3)); }
    });
}

}  // namespace penumbra::test::functions
