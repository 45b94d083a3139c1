// Soft shadow maps, after light_map.frag: which columns of each row end a caster, as skins.frag wants them.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int;` for
// ES. Draw ../occlusion_texture/full_screen.vert on images that have a texel for 32 columns, the last for fewer, and
// all rows of all maps; no blending. Targets: RG32UI,
//     .r a bit for each column that differs from the next one: the lowest is the first column's
//     .g the first column that their skins cover in the target's map, and times 65536, what follows the last
// skins that lead into the map after this one, and into that before it. Resolution: up to 65535.
// Options: PENUMBRA_SOFT_SHADOW_MAP_DETECTOR  see visibility_map.glsl
// C++: detail::SkinPainter in include/penumbra/soft_shadow_map/visibility_map.hpp
#include "visibility_map.glsl"

uniform highp sampler2D penumbra_surfaces;
uniform penumbra_LightMapView penumbra_view;
uniform int penumbra_count;  // of maps
uniform float penumbra_half_length, penumbra_step;

layout(location = 0) out highp uvec2 penumbra_onward;
layout(location = 1) out highp uvec2 penumbra_backward;

// A mark with a column more.
uvec2 penumbra_marked(uvec2 mark, int bit, ivec2 columns) {
    if (columns.x >= columns.y) return mark;  // out of the image
    uint first = uint(columns.x);
    uint end = uint(columns.y);
    if (mark.x != 0u) {
        first = min(first, mark.y & 65535u);
        end = max(end, mark.y >> 16u);
    }
    return uvec2(mark.x | (1u << uint(bit)), first | (end << 16u));
}

void main() {
    int row = int(gl_FragCoord.y);
    int map = row / penumbra_view.resolution;
    int begin = 32 * int(gl_FragCoord.x);
    int end = min(begin + 32, penumbra_view.resolution - 1);
    float position = penumbra_even_position(penumbra_half_length, map, penumbra_count);
    float before = penumbra_even_position(penumbra_half_length, map - 1, penumbra_count);
    float after = penumbra_even_position(penumbra_half_length, map + 1, penumbra_count);
    penumbra_onward = uvec2(0u);
    penumbra_backward = uvec2(0u);
    float right = texelFetch(penumbra_surfaces, ivec2(begin, row), 0).x;
    for (int x = begin; x < end; ++x) {
        ivec2 at = ivec2(x, row);
        float left = right;
        right = texelFetch(penumbra_surfaces, at + ivec2(1, 0), 0).x;
        // a caster, which is positive, before anything
        bool onward = left > 0.0 && left < abs(right) && map + 1 < penumbra_count;
        bool backward = right > 0.0 && right < abs(left) && map > 0;
        if (!(onward || backward) || !penumbra_steps(penumbra_surfaces, penumbra_view.resolution, at, penumbra_step))
            continue;
        ivec2 next = at + ivec2(1, 0);
        penumbra_Skin skin = penumbra_skin_between(penumbra_surfaces, penumbra_view, onward ? at : next,
                                                   onward ? next : at, position, onward ? after : before);
        ivec2 columns = penumbra_skin_columns(penumbra_view, skin);
        if (onward)
            penumbra_onward = penumbra_marked(penumbra_onward, x - begin, columns);
        else
            penumbra_backward = penumbra_marked(penumbra_backward, x - begin, columns);
    }
}
