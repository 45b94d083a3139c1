// D-buffer: the depths beyond which rays are blocked, from the surfaces that casters.frag has drawn: of a solid the
// middle, so that points on either side of it are clearly before it or behind; of others a little within.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Draw
// full_screen.vert on the rows of layer 0's umbrae (see d_buffer.glsl): the viewport (0, 0, resolution, resolution).
// All other rows are cleared to (3.4e38, 0, 0, 3.4e38). No depth test, no blending.
// Options: PENUMBRA_UMBRA_VOLUME_DEPTH, see d_buffer_view.glsl
// C++: detail::DBufferBuilder in include/penumbra/umbra_volume/d_buffer_builder.hpp
#include "d_buffer_view.glsl"

uniform penumbra_DBufferView penumbra_view;
uniform highp sampler2D penumbra_nearest, penumbra_second;

layout(location = 0) out vec4 penumbra_crossing;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 nearest = texelFetch(penumbra_nearest, at, 0).xy;
    float second = texelFetch(penumbra_second, at, 0).x;
    float blocked = PENUMBRA_D_BUFFER_NONE;
    if (nearest.x > 0.0) {
        blocked = nearest.y < 0.0 && second > 0.0 ? 0.5 / nearest.x + 0.5 / second : abs(nearest.y);
        blocked *= penumbra_depth_of(penumbra_texel_ray(penumbra_view, gl_FragCoord.xy));
    }
    penumbra_crossing = vec4(PENUMBRA_D_BUFFER_NONE, 0.0, 0.0, blocked);
}
