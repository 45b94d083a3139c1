// Twins of light.
#pragma once

#include <penumbra/light.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline void add_light(std::vector<Function>& list) {
    list.push_back({
        "LightFrame::to_light", "light", 15, 3, GLSL(vec3 v = penumbra_to_light(FRAME, V3(12)); PUT3(0, v);),
            [](const float* i, float* o) { put(frame_of(i).to_light(v3(i + 12)), o); },
            [](float* i) { frame(i), moderate_all<3>(i + 12); }, 6,
            [](const float* i) { return largest(i, 3) + largest(i + 12, 3); }
    });
    list.push_back({
        "LightFrame::to_world", "light", 15, 3, GLSL(vec3 v = penumbra_to_world(FRAME, V3(12)); PUT3(0, v);),
            [](const float* i, float* o) { put(frame_of(i).to_world(v3(i + 12)), o); },
            [](float* i) { frame(i), moderate_all<3>(i + 12); }, 6,
            [](const float* i) { return largest(i, 3) + largest(i + 12, 3); }
    });
    list.push_back({
        "half_size", "light", 9, 2,
            GLSL(penumbra_RectLight l; l.center = V3(0); l.half_u = V3(3); l.half_v = V3(6);
                 vec2 v = penumbra_half_size(l); PUT2(0, v);),
            [](const float* i, float* o) {
                put(half_size(RectLight<float>{v3(i), v3(i + 3), v3(i + 6)}), o);
            },
            moderate_all<9>, 6, nullptr
    });
    list.push_back({
        "light_frame(RectLight)", "light", 12, 12,
            GLSL(penumbra_RectLight l; l.center = V3(0); l.half_u = V3(3); l.half_v = V3(6);
                 penumbra_LightFrame f = penumbra_light_frame(l, V3(9)); f.origin -= l.center; PUT3(0, f.origin);
                 PUT3(3, f.u); PUT3(6, f.v); PUT3(9, f.normal);),
            [](const float* i, float* o) {
                LightFrame<float> made = light_frame(RectLight<float>{v3(i), v3(i + 3), v3(i + 6)}, v3(i + 9));
                made.origin -= v3(i);
                put(made, o);
            },
            // an aim near the only side: more than the rounding of unit vectors
            side_by_side, 500, [](const float*) { return 1.0F; }
    });
    list.push_back({
        "light_frame(DiskLight)", "light", 6, 12,
            GLSL(penumbra_DiskLight l; l.center = V3(0); l.normal = V3(3);
                 penumbra_LightFrame f = penumbra_light_frame(l); f.origin -= l.center; PUT3(0, f.origin); PUT3(3, f.u);
                 PUT3(6, f.v); PUT3(9, f.normal);),
            [](const float* i, float* o) {
                LightFrame<float> made = light_frame(DiskLight<float>{v3(i), v3(i + 3), 1.0F});
                made.origin -= v3(i);
                put(made, o);
            },
            moderate_all<6>, 16, [](const float*) { return 1.0F; }
    });
    list.push_back({
        "light_frame(LinearLight)", "light", 9, 9,
            GLSL(penumbra_LinearLight l; l.a = V3(0); l.b = V3(3);
                 penumbra_LightFrame f = penumbra_light_frame(l, V3(6)); for (int k = 0; k < 3; ++k) {
                     O(k) = f.u[k];
                     O(3 + k) = f.v[k];
                     O(6 + k) = f.normal[k];
                 }),
            [](const float* i, float* o) {
                const LightFrame<float> made = light_frame(LinearLight<float>{v3(i), v3(i + 3)}, v3(i + 6));
                put(made.u, o), put(made.v, o + 3), put(made.normal, o + 6);
            },
            moderate_all<9>, 500, [](const float*) { return 1.0F; }
    });
    list.push_back({
        "light_frame(LinearLight): origin", "light", 6, 3,
            GLSL(penumbra_LinearLight l; l.a = V3(0); l.b = V3(3);
                 vec3 v = penumbra_light_frame(l, vec3(0.0f, 0.0f, 1.0f)).origin; PUT3(0, v);),
            [](const float* i, float* o) {
                put(light_frame(LinearLight<float>{v3(i), v3(i + 3)}).origin, o);
            },
            moderate_all<6>, 2, [](const float* i) { return largest(i, 6); }
    });
    list.push_back({
        "project_box", "light", 12, 4, GLSL(penumbra_Rect2 r = penumbra_project_box(BOX(0), BOX(6)); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(project_box(box(i), box(i + 6)), o); },
            [](float* i) { caster_box(i), receiver_box(i + 6); }, 8, [](const float* i) {
                float projected[4];
                put(project_box(box(i), box(i + 6)), projected);
                return std::max(largest(i, 12), largest(projected, 4));
            }
    });
}

}  // namespace penumbra::test::functions
