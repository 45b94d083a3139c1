// Twins of occlusion_texture, but for those that read textures.
#pragma once

#include <penumbra/detail/boxes.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline void add_occlusion_texture(std::vector<Function>& list) {
    list.push_back({
        "kernel_scale, kernel_size", "occlusion_texture/kernel", 3, 2,
            GLSL(O(0) = penumbra_kernel_scale(I(0), I(1)); O(1) = penumbra_kernel_size(I(0), I(1), I(2));),
            [](const float* i, float* o) { o[0] = kernel_scale(i[0], i[1]), o[1] = kernel_size(i[0], i[1], i[2]); },
            [](float* i) { moderate_all<3>(i), i[2] = std::abs(i[2]); }, 4, nullptr
    });
    list.push_back({
        "kernel_rect", "occlusion_texture/kernel", 8, 4,
            GLSL(penumbra_Rect2 r = penumbra_kernel_rect(I(0), V3(1), RECT(4)); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(kernel_rect(i[0], v3(i + 1), rect(i + 4)), o); }, moderate_all<8>, 6,
            [](const float* i) { return largest(i + 1, 2) + largest(i + 4, 4); }
    });
    list.push_back({
        "SliceCamera::project", "occlusion_texture/slice_camera", 8, 4,
            GLSL(CAMERA; vec4 v = penumbra_project(c, V3(5)); O(0) = v.x; O(1) = v.y; O(2) = v.z; O(3) = v.w;),
            [](const float* i, float* o) {
                const RasterVertex<float> v = camera(i).project(v3(i + 5));
                o[0] = v.x, o[1] = v.y, o[2] = v.depth, o[3] = v.w;
            },
            [](float* i) { moderate_all<8>(i), i[0] = share(i[0]), i[7] = std::abs(i[7]); }, 6, [](const float* i) {
                const float w = 1.0F + i[0] * i[7];
                return std::max(w, largest(i + 5, 2) * largest(i + 3, 2) + largest(i + 1, 2) * w);
            }
    });
    list.push_back({
        "SliceCamera::footprint", "occlusion_texture/slice_camera", 13, 4,
            GLSL(CAMERA; penumbra_Rect2 r = penumbra_footprint(c, I(5), V3(6), RECT(9)); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(camera(i).footprint(i[5], v3(i + 6), rect(i + 9)), o); },
            camera_and_point, 12, [](const float* i) {
                const float w = 1.0F + i[0] * i[5];
                return largest(i + 1, 2) + (largest(i + 6, 2) + largest(i + 9, 4)) * largest(i + 3, 2) / w;
            }
    });
    list.push_back({
        "SliceRange::top, ::bottom", "occlusion_texture/slices", 4, 2,
            GLSL(RANGE; O(0) = penumbra_top(r, int(I(3))); O(1) = penumbra_bottom(r, int(I(3)));),
            [](const float* i, float* o) {
                o[0] = range(i).top(static_cast<int>(i[3])), o[1] = range(i).bottom(static_cast<int>(i[3]));
            },
            [](float* i) { slices(i), i[3] = whole(i[3], 0, 64); }, 2,
            [](const float* i) { return std::abs(i[0]) + i[1] * 65.0F; }
    });
    list.push_back({
        "SliceRange::slice_of", "occlusion_texture/slices", 4, 1,
            GLSL(RANGE; O(0) = float(penumbra_slice_of(r, I(3)));),
            [](const float* i, float* o) { o[0] = static_cast<float>(range(i).slice_of(i[3])); },
            [](float* i) {  // powers of two, where the division is exact on every driver, so that boundaries agree
                i[0] = std::floor(moderate(i[0])), i[1] = std::ldexp(1.0F, static_cast<int>(whole(i[1], -6, 6)));
                i[2] = std::ldexp(1.0F, static_cast<int>(whole(i[2], 0, 6)));
                i[3] = i[0] + i[1] * (i[2] + 2.0F) * (share(i[3]) - 0.01F);
            },
            0, nullptr
    });
    list.push_back({
        "relative_depth", "occlusion_texture/slices", 3, 1, GLSL(O(0) = penumbra_relative_depth(I(0), I(1), I(2));),
            [](const float* i, float* o) { o[0] = relative_depth(i[0], i[1], i[2]); },
            [](float* i) { moderate_all<3>(i), i[1] = std::abs(i[1]); }, 4, nullptr
    });
    list.push_back({
        "slice_plane_depth", "occlusion_texture/slices", 3, 2,
            GLSL(O(0) = penumbra_slice_plane_depth(I(0), I(1), I(2), PENUMBRA_SLICE_PLANE_BOTTOM);
                 O(1) = penumbra_slice_plane_depth(I(0), I(1), I(2), PENUMBRA_SLICE_PLANE_MIDDLE);),
            [](const float* i, float* o) {
                o[0] = slice_plane_depth(i[0], i[1], i[2], SlicePlane::bottom);
                o[1] = slice_plane_depth(i[0], i[1], i[2], SlicePlane::middle);
            },
            moderate_all<3>, 2, [](const float* i) { return largest(i, 3); }
    });
    list.push_back({
        "slice_weight", "occlusion_texture/slices", 3, 3,
            GLSL(O(0) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_FADE);
                 O(1) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_CLEAR);
                 O(2) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_MEAN_DEPTH);),
            [](const float* i, float* o) {
                o[0] = slice_weight(i[0], i[1], i[2], SelfShadow::fade);
                o[1] = slice_weight(i[0], i[1], i[2], SelfShadow::clear);
                o[2] = slice_weight(i[0], i[1], i[2], SelfShadow::mean_depth);
            },
            [](float* i) { i[0] = 4.0F * share(i[0]), i[1] = share(i[1]), i[2] = std::max(0.001F, share(i[2])); }, 4,
            nullptr
    });
    list.push_back({
        "widen", "detail/boxes", 5, 6,
            GLSL(vec2 s = penumbra_widen(V2(0), I(4)); O(0) = s.x; O(1) = s.y;
                 penumbra_Rect2 r = penumbra_widen(RECT(0)); O(2) = r.min.x; O(3) = r.min.y; O(4) = r.max.x;
                 O(5) = r.max.y;),
            [](const float* i, float* o) {
                o[0] = i[0], o[1] = i[1];
                detail::widen(o[0], o[1], i[4]);
                put(detail::widen(rect(i)), o + 2);
            },
            [](float* i) { i[4] = std::max(0.0625F, share(i[4])); }, 2,
            [](const float* i) { return std::min(largest(i, 4), 65536.0F); }
    });
    list.push_back({
        "square_tiles", "detail/boxes", 4, 6,
            GLSL(penumbra_Tiles t = penumbra_square_tiles(RECT(0)); O(0) = t.first.x; O(1) = t.first.y; O(2) = t.step.x;
                 O(3) = t.step.y; O(4) = t.size; O(5) = float(t.count);),
            [](const float* i, float* o) {
                const detail::Tiles<float> t = detail::square_tiles(rect(i));
                put(t.first, o), put(t.step, o + 2), o[4] = t.size, o[5] = static_cast<float>(t.count);
            },
            [](float* i) {  // sides in eighths: longer / shorter + 1/2 is then no near tie but an exact one
                for (int k = 0; k < 4; ++k) i[k] = whole(i[k], 0, 4000) / 8.0F;
                i[2] = i[0] + 0.125F + i[2], i[3] = i[1] + 0.125F + i[3];
            },
            4, [](const float* i) { return largest(i, 4); }
    });
}

}  // namespace penumbra::test::functions
