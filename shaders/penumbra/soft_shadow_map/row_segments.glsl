// What maps of a line light see as segments in the planes through the light: how much of it a point sees, exactly.
//
// The host makes the texture by row_segment_texels(), 1024 texels a row: texel y has in .r and .g the numbers of the
// first segment of row y of the maps and of what follows its last; and each segment is a texel,
//     .rg one end: its slope x / z, and 1 over its depth
//     .ba the other
// Points come in light space, as penumbra_to_light gives them.
//
// Options: PENUMBRA_SOFT_SHADOW_MAP_MASK  1: the union of what is hidden as 128 cells of the light; 0: sorted, exact up
//                                         to 16 separate parts
// Error:   that of the maps; from the C++ 1e-6
// Source:  ours
// C++:     include/penumbra/soft_shadow_map/row_segments.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_ROW_SEGMENTS_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_ROW_SEGMENTS_GLSL

#include "../geometry.glsl"
#include "light_interval.glsl"
#include "light_map.glsl"
#include "linear_visibility.glsl"

#ifndef PENUMBRA_SOFT_SHADOW_MAP_MASK
#define PENUMBRA_SOFT_SHADOW_MAP_MASK 0
#endif

struct penumbra_RowSegment {
    penumbra_RowPoint a, b;
};

// A point and the number of the segment that it was put on.
struct penumbra_Settled {
    penumbra_RowPoint point;
    int own;
};

// False if a segment surely hides nothing from `point` of a light between `first` and `last`: the plain test, without a
// division, before penumbra_hidden_interval.
bool penumbra_may_hide(penumbra_RowSegment segment, penumbra_RowPoint point, float first, float last) {
    float nearer = max(segment.a.inverse_depth, segment.b.inverse_depth) - point.inverse_depth;
    if (!(nearer > 0.0f)) return false;
    float low = min(segment.a.slope, segment.b.slope) - point.slope;
    float high = max(segment.a.slope, segment.b.slope) - point.slope;
    return low <= (last > 0.0f ? last * nearer : 0.0f) && high >= (first < 0.0f ? first * nearer : 0.0f);
}

// True if a point is behind a segment, as the light's centre sees it, by at most `slack` of inverse depth.
bool penumbra_is_just_behind(penumbra_RowSegment segment, penumbra_RowPoint point, float slack) {
    float share = penumbra_safe_ratio(point.slope - segment.a.slope, segment.b.slope - segment.a.slope, -1.0f);
    if (!(share >= 0.0f && share <= 1.0f)) return false;
    float behind = penumbra_mix(segment.a.inverse_depth, segment.b.inverse_depth, share) - point.inverse_depth;
    return behind >= 0.0f && behind <= slack;
}

vec4 penumbra_segment_texel(highp sampler2D segments, int i) {
    return texelFetch(segments, ivec2(i & 1023, i >> 10), 0);
}

penumbra_RowSegment penumbra_row_segment(highp sampler2D segments, int i) {
    vec4 both = penumbra_segment_texel(segments, i);
    penumbra_RowSegment segment;
    segment.a.slope = both.x;
    segment.a.inverse_depth = both.y;
    segment.b.slope = both.z;
    segment.b.inverse_depth = both.w;
    return segment;
}

// Puts a point on the nearest segment and says which, if it is nearer than a column's width along the row, and in depth
// than what a surface at 63 degrees to the image changes by from row to row; `end` if there is none.
penumbra_Settled penumbra_settle(highp sampler2D segments, penumbra_LightMapView view, penumbra_RowPoint point,
                                 int first, int end) {
    vec2 size = penumbra_extent(view.slopes);
    vec2 texel = vec2(size.x / float(view.resolution), size.y / float(view.resolution));
    vec2 unit = vec2(1.0f / texel.x, 0.5f / (texel.y * point.inverse_depth));
    penumbra_Settled result;
    result.point = point;
    result.own = end;
    float least = 1.0f;
    for (int i = first; i < end; ++i) {
        penumbra_RowSegment segment = penumbra_row_segment(segments, i);
        float low = min(segment.a.slope, segment.b.slope);
        float high = max(segment.a.slope, segment.b.slope);
        if (low > point.slope + texel.x || high < point.slope - texel.x) continue;
        vec2 along = vec2(segment.b.slope - segment.a.slope, segment.b.inverse_depth - segment.a.inverse_depth) * unit;
        vec2 to = vec2(point.slope - segment.a.slope, point.inverse_depth - segment.a.inverse_depth) * unit;
        float share = penumbra_clamp(penumbra_saturated_ratio(dot(to, along), dot(along, along)), 0.02f, 0.98f);
        vec2 away = to - along * share;
        away.y *= away.y < 0.0f ? 2.0f : 1.0f;
        float distance = dot(away, away);
        if (!(distance < least)) continue;
        least = distance;
        result.own = i;
        result.point.slope = penumbra_mix(segment.a.slope, segment.b.slope, share);
        result.point.inverse_depth = penumbra_mix(segment.a.inverse_depth, segment.b.inverse_depth, share);
    }
    return result;
}

// Of a light between the positions `first` and `last`, from its centre, world units. 1 outside of the image, on the
// plane through the light and behind it, and for points that are not finite.
float penumbra_visibility(highp sampler2D segments, penumbra_LightMapView view, float first, float last,
                          vec3 point_ls) {
    if (!(point_ls.z > 0.0f) || !penumbra_is_finite(point_ls) || penumbra_empty(view)) return 1.0f;
    float row = penumbra_row(view, point_ls.y / point_ls.z);
    if (!(row >= 0.0f && row < float(view.resolution))) return 1.0f;
    penumbra_RowPoint point;
    point.slope = point_ls.x / point_ls.z;
    point.inverse_depth = 1.0f / point_ls.z;
    vec4 range = penumbra_segment_texel(segments, int(row));
    int begin = int(range.x);
    int end = int(range.y);
    penumbra_Settled settled = penumbra_settle(segments, view, point, begin, end);
    float slack = penumbra_extent(view.slopes).y / float(view.resolution) * settled.point.inverse_depth;
#if PENUMBRA_SOFT_SHADOW_MAP_MASK
    penumbra_LightMask hidden = penumbra_no_light_mask();
#else
    penumbra_LightUnion hidden = penumbra_no_light_union();
#endif
    for (int i = begin; i < end; ++i) {
        if (i == settled.own) continue;
        penumbra_RowSegment segment = penumbra_row_segment(segments, i);
        if (!penumbra_may_hide(segment, settled.point, first, last)) continue;
        // its own surface once more, from another map
        if (penumbra_is_just_behind(segment, settled.point, slack)) continue;
        hidden = penumbra_add(hidden, penumbra_hidden_interval(segment.a, segment.b, settled.point, first, last));
        if (penumbra_is_full(hidden)) return 0.0f;
    }
    return 1.0f - penumbra_share(hidden);
}

#endif
