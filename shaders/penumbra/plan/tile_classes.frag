// What each tile of a picture calls for: nothing where no caster can hide any of the light from its points, less where
// only one can.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int;` for
// ES. Draw ../occlusion_texture/full_screen.vert on an image that has a texel for each tile, the last ones' tiles being
// smaller; no blending. Target: R8UI, PENUMBRA_TILE_LIT, _SINGLE or _SEVERAL as extents.glsl has them; lit where there
// are no points. Points on or behind the light's plane see all of it. For methods that look casters up in an image,
// widen the boxes by two of its texels.
// Options: PENUMBRA_TILE_SIZE  pixels along each side of a tile, 8 by default
// C++: with_caster in include/penumbra/plan/extents.hpp; detail::TileQuery in tile_query.hpp makes boxes as this does
#include "extents.glsl"

#ifndef PENUMBRA_TILE_SIZE
#define PENUMBRA_TILE_SIZE 8
#endif

uniform highp sampler2D penumbra_positions;  // RGBA32F: world space, and 1 where there is something, 0 elsewhere
uniform penumbra_LightFrame penumbra_light;
uniform penumbra_LightExtent penumbra_light_extent;
uniform highp sampler2D penumbra_casters;  // RGBA32F: two texels a box in light space, min and max, row by row
uniform int penumbra_count;                // of casters

layout(location = 0) out highp uint penumbra_class;

vec3 penumbra_caster_texel(int at) {
    int width = textureSize(penumbra_casters, 0).x;
    return texelFetch(penumbra_casters, ivec2(at % width, at / width), 0).xyz;
}

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * PENUMBRA_TILE_SIZE;
    ivec2 end = min(first + PENUMBRA_TILE_SIZE, textureSize(penumbra_positions, 0));
    penumbra_Box3 tile = penumbra_empty_box();
    vec3 reach = vec3(0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 point = texelFetch(penumbra_positions, ivec2(x, y), 0);
            vec3 point_ls = penumbra_to_light(penumbra_light, point.xyz);
            if (point.w == 0.0 || !(point_ls.z > 0.0)) continue;
            tile = penumbra_extend(tile, point_ls);
            reach = max(reach, abs(point.xyz));
        }
    int so_far = PENUMBRA_TILE_LIT;
    if (!penumbra_is_empty(tile)) {
        // what rounding may make of the points' places: 8 units in the last place
        reach += abs(penumbra_light.origin);
        vec3 margin = vec3(9.5367432e-7 * (reach.x + reach.y + reach.z));
        tile = penumbra_box3(tile.min - margin, tile.max + margin);
    }
    for (int k = 0; k < penumbra_count && so_far != PENUMBRA_TILE_SEVERAL; ++k) {
        penumbra_Box3 caster = penumbra_box3(penumbra_caster_texel(2 * k), penumbra_caster_texel(2 * k + 1));
        so_far = penumbra_with_caster(so_far, caster, tile, penumbra_light_extent);
    }
    penumbra_class = uint(so_far);
}
