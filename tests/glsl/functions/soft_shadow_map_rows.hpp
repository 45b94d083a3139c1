// Twins of soft_shadow_map: texels of maps, and the plain test of segments.
#pragma once

#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>

#include "soft_shadow_map.hpp"

namespace penumbra::test::functions {

inline LightMapView<float> light_map_view(const float* in) { return {rect(in), static_cast<int>(in[4])}; }

/// Borders, now and then of nothing.
inline void any_borders(float* in) {
    const bool eighths = in[0] < in[1];
    for (int k = 0; k < 4; ++k) {
        const float size = eighths ? whole(in[k], 0, 8) / 8.0F : 16.0F * share(in[k]);
        in[k] = std::copysign(size, in[k]);
    }
    in[4] = 1.0F;
}
inline void order_borders(float* in) {
    any_borders(in);
    for (const int k : {0, 1}) {
        if (in[k + 2] < in[k]) std::swap(in[k], in[k + 2]);
        in[k + 2] = std::max(in[k + 2], in[k] + 0x1p-10F);
    }
}
/// Borders, a resolution and two slopes.
inline void view_and_slopes(float* in) {
    const float texels = whole(in[4], 1, 4096);
    order_borders(in);
    in[4] = texels, in[5] = moderate(in[5]), in[6] = moderate(in[6]);
}
inline float texel_of_slopes(const float* in) {
    const float slope = std::max(std::abs(in[5]), std::abs(in[6])) + largest(in, 4);
    return slope * in[4] / std::min(in[2] - in[0], in[3] - in[1]);
}
/// Borders, a resolution and two positions in and around the image.
inline void view_and_texels(float* in) {
    const float texels = whole(in[4], 1, 4096);
    order_borders(in);
    in[4] = texels;
    for (const int k : {5, 6}) in[k] = std::copysign(2.0F * texels * share(in[k]), in[k]);
}
inline float slope_of_texels(const float* in) { return 4.0F * largest(in, 4); }

/// A segment, a point and a slack: in eighths, with shares and inverse depths that are exact and often on a border of
/// what is just behind; or any, with none near a border, but for segments of no width.
inline void segment_point_and_slack(float* in) {
    const bool any = in[0] < in[1];
    const int at = static_cast<int>(whole(in[4], -2, 10)), behind = static_cast<int>(whole(in[5], -1, 4));
    light_plane(in, 6, {1, 3, 5});
    in[6] = any ? 4.0F * share(in[6]) : whole(in[6], 0, 16) / 8.0F;
    if (!any) {
        in[2] = in[0] + std::copysign(in[2] < in[3] ? 0.5F : 2.0F, in[2]);
        in[4] = mix(in[0], in[2], static_cast<float>(at) / 8.0F);
        const float on_segment = mix(in[1], in[3], static_cast<float>(at) / 8.0F);
        in[5] = std::max(on_segment - static_cast<float>(behind) * 0.5F * in[6], 0.0F);
        return;
    }
    const float width = in[2] - in[0], along = safe_ratio(in[4] - in[0], width, -1.0F);
    const float depth = mix(in[1], in[3], along) - in[5], size = in[1] + in[3] + in[5];
    const float slopes = 1e-5F * (std::abs(in[0]) + std::abs(in[2]) + std::abs(in[4]));
    const float least = std::min(std::abs(in[4] - in[0]), std::abs(in[4] - in[2]));
    const float condition = 1e-5F * size + slopes * std::abs(in[3] - in[1]) / std::max(std::abs(width), 0x1p-60F);
    if (least < slopes || std::min(std::abs(depth), std::abs(depth - in[6])) < condition) in[2] = in[0];
}

/// Half a length, and which of how many maps.
inline void half_length_and_map(float* in) {
    in[0] = std::abs(moderate(in[0]));
    in[2] = whole(in[2], 2, 64);
    in[1] = std::min(whole(in[1], 0, 63), in[2] - 1.0F);
}
inline float half_length(const float* in) { return in[0]; }

// What texts begin with.
#define LIGHT_MAP_VIEW          \
    penumbra_LightMapView view; \
    view.slopes = RECT(0);      \
    view.resolution = int(I(4))
#define ROW_POINT(k) penumbra_row_point(I(k), I(k + 1))

inline void add_soft_shadow_map_rows(std::vector<Function>& list) {
    list.push_back({
        "LightMapView: empty", "soft_shadow_map/light_map", 5, 1,
            GLSL(LIGHT_MAP_VIEW; O(0) = penumbra_empty(view) ? 1.0f : 0.0f;),
            [](const float* i, float* o) { o[0] = light_map_view(i).empty() ? 1.0F : 0.0F; }, any_borders, 0, nullptr
    });
    list.push_back({
        "LightMapView: column, row", "soft_shadow_map/light_map", 7, 2,
            GLSL(LIGHT_MAP_VIEW; O(0) = penumbra_column(view, I(5)); O(1) = penumbra_row(view, I(6));),
            [](const float* i, float* o) { o[0] = light_map_view(i).column(i[5]), o[1] = light_map_view(i).row(i[6]); },
            view_and_slopes, 8, texel_of_slopes
    });
    list.push_back({
        "LightMapView: column_slope, row_slope", "soft_shadow_map/light_map", 7, 2,
            GLSL(LIGHT_MAP_VIEW; O(0) = penumbra_column_slope(view, I(5)); O(1) = penumbra_row_slope(view, I(6));),
            [](const float* i, float* o) {
                o[0] = light_map_view(i).column_slope(i[5]), o[1] = light_map_view(i).row_slope(i[6]);
            },
            view_and_texels, 8, slope_of_texels
    });
    list.push_back({
        "even_position", "soft_shadow_map/light_map", 3, 1,
            GLSL(O(0) = penumbra_even_position(I(0), int(I(1)), int(I(2)));),
            [](const float* i, float* o) {
                o[0] = even_position(i[0], static_cast<int>(i[1]), static_cast<int>(i[2]));
            },
            half_length_and_map, 4, half_length
    });
    list.push_back({
        "may_hide", "soft_shadow_map/row_segments", 8, 1,
            GLSL(penumbra_RowSegment s; s.a = ROW_POINT(0); s.b = ROW_POINT(2);
                 O(0) = penumbra_may_hide(s, ROW_POINT(4), I(6), I(7)) ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                const RowSegment<float> s{row_point(i), row_point(i + 2)};
                o[0] = may_hide(s, row_point(i + 4), i[6], i[7]) ? 1.0F : 0.0F;
            },
            segment_and_light, 0, nullptr
    });
    list.push_back({
        "is_just_behind", "soft_shadow_map/row_segments", 7, 1,
            GLSL(penumbra_RowSegment s; s.a = ROW_POINT(0); s.b = ROW_POINT(2);
                 O(0) = penumbra_is_just_behind(s, ROW_POINT(4), I(6)) ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                const RowSegment<float> s{row_point(i), row_point(i + 2)};
                o[0] = is_just_behind(s, row_point(i + 4), i[6]) ? 1.0F : 0.0F;
            },
            segment_point_and_slack, 0, nullptr
    });
}

#undef LIGHT_MAP_VIEW
#undef ROW_POINT

}  // namespace penumbra::test::functions
