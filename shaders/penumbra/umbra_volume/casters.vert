// D-buffer, casters, vertex stage: as the light's centre sees them. casters.frag says what is drawn.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Vertices and
// triangles are those of d_buffer_vertices() (C++), in light space. No culling, no multisampling. Row 0 of the image is
// row 0 of the texture: nothing is flipped.
// C++: detail::DBufferBuilder in include/penumbra/umbra_volume/d_buffer_builder.hpp
#include "d_buffer_view.glsl"

uniform penumbra_DBufferView penumbra_view;
// Clip space has z = x w + y, w being the depth from the light's plane: depths from n to f in a depth buffer with near
// at 1, for clip volumes with z from 0 to w, by vec2(-n, n f) / (f - n); near at 0, and z from -w to w, by
// vec2(f + n, -2 n f) / (f - n). The former keeps all digits, the latter loses a factor of depth / n.
uniform vec2 penumbra_clip_z;

in vec3 penumbra_position;
in float penumbra_attribute_1;  // the caster
flat out float penumbra_caster;

invariant gl_Position;  // a second draw knows what the first has drawn

void main() {
    vec3 p = penumbra_position;
    vec2 at = (p.xy - penumbra_view.slopes.min * p.z) / penumbra_extent(penumbra_view.slopes);
    gl_Position = vec4(2.0 * at - vec2(p.z), penumbra_clip_z.x * p.z + penumbra_clip_z.y, p.z);
    penumbra_caster = penumbra_attribute_1;
}
