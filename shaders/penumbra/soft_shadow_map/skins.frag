// Soft shadow maps, the last pass: depths and visibility channels of all maps, as skin_maps.glsl reads them.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int;` for
// ES. Draw ../occlusion_texture/full_screen.vert on images of the maps' size; no blending. Targets: `maps` and, for
// exact transitions, `edges`; RGBA32F. Without skins, for plain shadow maps, no discontinuities need be found.
// Options: PENUMBRA_SOFT_SHADOW_MAP_HARD        1: without skins; 0
//          PENUMBRA_SOFT_SHADOW_MAP_SOLID       0: no caster is closed, penumbra_insides is not read; 1
//          PENUMBRA_SOFT_SHADOW_MAP_DETECTOR    see visibility_map.glsl
//          PENUMBRA_SOFT_SHADOW_MAP_TRANSITION  see visibility_map.glsl
// C++: SkinMaps in include/penumbra/soft_shadow_map/skin_maps.hpp
#include "visibility_map.glsl"

#ifndef PENUMBRA_SOFT_SHADOW_MAP_HARD
#define PENUMBRA_SOFT_SHADOW_MAP_HARD 0
#endif
#ifndef PENUMBRA_SOFT_SHADOW_MAP_SOLID
#define PENUMBRA_SOFT_SHADOW_MAP_SOLID 1
#endif

uniform highp sampler2D penumbra_surfaces, penumbra_blocked, penumbra_insides;  // of light_map.frag
uniform highp usampler2D penumbra_onward, penumbra_backward;                    // of discontinuities.frag
uniform highp usampler2D penumbra_rows;                                         // of discontinuity_rows.frag
uniform penumbra_LightMapView penumbra_view;
uniform int penumbra_count;  // of maps
uniform float penumbra_half_length, penumbra_step;
uniform float penumbra_nearest;  // no caster is nearer to the light's plane

layout(location = 0) out vec4 penumbra_map;
#if PENUMBRA_SOFT_SHADOW_MAP_TRANSITION == 2 && !PENUMBRA_SOFT_SHADOW_MAP_HARD
layout(location = 1) out vec4 penumbra_edges;
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int map = at.y / penumbra_view.resolution;
    float position = penumbra_even_position(penumbra_half_length, map, penumbra_count);
    float blocked = abs(texelFetch(penumbra_blocked, at, 0).x);
#if PENUMBRA_SOFT_SHADOW_MAP_SOLID
    blocked = min(blocked, texelFetch(penumbra_insides, at, 0).x);
#endif
#if PENUMBRA_SOFT_SHADOW_MAP_HARD
    penumbra_map = vec4(blocked, 1.0, 1.0, position);
#else
    penumbra_VisibilityChannel before;
    before.visible = 1.0;
    before.edge = penumbra_row_point(0.0, 0.0);
    penumbra_VisibilityChannel after = before;
    if (map > 0)
        before = penumbra_visibility_channel(
            penumbra_surfaces, penumbra_rows, penumbra_onward, penumbra_view, at, at.y - penumbra_view.resolution,
            penumbra_even_position(penumbra_half_length, map - 1, penumbra_count), position, penumbra_nearest,
            penumbra_step);
    if (map + 1 < penumbra_count)
        after = penumbra_visibility_channel(
            penumbra_surfaces, penumbra_rows, penumbra_backward, penumbra_view, at, at.y + penumbra_view.resolution,
            penumbra_even_position(penumbra_half_length, map + 1, penumbra_count), position, penumbra_nearest,
            penumbra_step);
    penumbra_map = vec4(blocked, before.visible, after.visible, position);
#if PENUMBRA_SOFT_SHADOW_MAP_TRANSITION == 2
    penumbra_edges =
        vec4(before.edge.slope, before.edge.inverse_depth, after.edge.slope, after.edge.inverse_depth);
#endif
#endif
}
