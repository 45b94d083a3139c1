// Shadow maps of points on a line light with visibility channels: how much of the light a point sees.
//
// The host makes the textures by skin_map_texels(); or a renderer draws them: texel (x, y) of map i is texel
// (x, y + i resolution), the maps being in the order of their positions on the light, and has in `maps`
//     .r  the depth beyond which the ray is blocked
//     .g  the fraction that its surface sees of the light between this map and the one before, 1 for the first
//     .b  and of that between this map and the one after, 1 for the last
//     .a  the map's position on the light, from its centre, world units
// and in `edges`, read only with PENUMBRA_SOFT_SHADOW_MAP_EDGES and where these fractions are neither 0 nor 1,
//     .rg what hides the rest of the first: its slope x / z, and 1 over its depth
//     .ba and of the second
// Points come in light space, as penumbra_to_light gives them.
//
// Options: PENUMBRA_SOFT_SHADOW_MAP_HARD   1: plain shadow maps, each that sees a point adds its part; 0: with channels
//          PENUMBRA_SOFT_SHADOW_MAP_EDGES  1: exact transitions, from `edges`; 0: the channels as they are, `edges` is
//                                          not read
// Error:   that of the method; from the C++ 1e-6
// Source:  W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000; edges are ours
// C++:     include/penumbra/soft_shadow_map/skin_maps.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_SKIN_MAPS_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_SKIN_MAPS_GLSL

#include "../geometry.glsl"
#include "light_map.glsl"
#include "linear_visibility.glsl"

#ifndef PENUMBRA_SOFT_SHADOW_MAP_HARD
#define PENUMBRA_SOFT_SHADOW_MAP_HARD 0
#endif
#ifndef PENUMBRA_SOFT_SHADOW_MAP_EDGES
#define PENUMBRA_SOFT_SHADOW_MAP_EDGES 1
#endif

bool penumbra_is_part(float visible) { return visible > 0.0f && visible < 1.0f; }

// Exactly 0 and 1 where nothing and all is seen; 1 outside of the image, on the plane through the light and behind it,
// and for points that are not finite. `count` maps, 2 or more.
float penumbra_visibility(highp sampler2D maps, highp sampler2D edges, penumbra_LightMapView view, int count,
                          vec3 point_ls) {
    if (!(point_ls.z > 0.0f) || !penumbra_is_finite(point_ls) || penumbra_empty(view)) return 1.0f;
    penumbra_RowPoint point;
    point.slope = point_ls.x / point_ls.z;
    point.inverse_depth = 1.0f / point_ls.z;
    float row = penumbra_row(view, point_ls.y / point_ls.z);
    float size = float(view.resolution);
    if (!(row >= 0.0f && row < size)) return 1.0f;
    int y = int(row);
    float first = texelFetch(maps, ivec2(0, 0), 0).w;
    float last = texelFetch(maps, ivec2(0, (count - 1) * view.resolution), 0).w;
    float sum = 0.0f;
    float earlier = 0.0f;
    float earlier_position = first;
    bool whole = true;  // as weights need not sum to exactly 1
    for (int i = 0; i < count; ++i) {
        float position = texelFetch(maps, ivec2(0, i * view.resolution), 0).w;
        float column = penumbra_column(view, penumbra_slope_from(point, position));
        float before = 1.0f;
        float after = 1.0f;
        if (column >= 0.0f && column < size) {
            ivec2 at = ivec2(int(column), y + i * view.resolution);
            vec4 texel = texelFetch(maps, at, 0);
            bool sees = !(point_ls.z > texel.x);
            before = sees ? texel.y : 0.0f;
            after = sees ? texel.z : 0.0f;
#if PENUMBRA_SOFT_SHADOW_MAP_EDGES && !PENUMBRA_SOFT_SHADOW_MAP_HARD
            if (penumbra_is_part(before) || penumbra_is_part(after)) {
                vec4 both = texelFetch(edges, at, 0);
                penumbra_RowPoint edge;
                edge.slope = both.x;
                edge.inverse_depth = both.y;
                if (penumbra_is_part(before))
                    before = penumbra_edge_visibility(edge, point, earlier_position, position);
                edge.slope = both.z;
                edge.inverse_depth = both.w;
                if (penumbra_is_part(after)) {
                    float next = texelFetch(maps, ivec2(0, (i + 1) * view.resolution), 0).w;
                    after = penumbra_edge_visibility(edge, point, next, position);
                }
            }
#endif
        }
        if (i > 0) {
#if PENUMBRA_SOFT_SHADOW_MAP_HARD
            float seen = 0.5f * (earlier + before);
#else
            float seen = min(1.0f, earlier + before);
#endif
            float length_of_light = last - first;
            float weight =
                length_of_light > 0.0f ? (position - earlier_position) / length_of_light : 1.0f / float(count - 1);
            sum += weight * seen;
            whole = whole && seen >= 1.0f;
        }
        earlier = after;
        earlier_position = position;
    }
    return whole ? 1.0f : penumbra_saturate(sum);
}

#endif
