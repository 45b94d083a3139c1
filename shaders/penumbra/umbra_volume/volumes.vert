// D-buffer, silhouette faces and sides of volumes, vertex stage: as the light's centre sees them. volumes.frag says
// what is drawn.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Vertices are those
// of d_buffer_vertices() (C++), in light space. No culling, no multisampling. Row 0 of the image is row 0 of the
// texture: nothing is flipped.
// C++: detail::DBufferBuilder in include/penumbra/umbra_volume/d_buffer_builder.hpp
#include "d_buffer_view.glsl"

uniform penumbra_DBufferView penumbra_view;
uniform vec2 penumbra_clip_z;  // see casters.vert

in vec3 penumbra_position;
in vec3 penumbra_attribute_1;  // stretch, number of the edge, and of the caster
out float penumbra_stretch;
flat out vec2 penumbra_numbers;

void main() {
    vec3 p = penumbra_position;
    vec2 at = (p.xy - penumbra_view.slopes.min * p.z) / penumbra_extent(penumbra_view.slopes);
    gl_Position = vec4(2.0 * at - vec2(p.z), penumbra_clip_z.x * p.z + penumbra_clip_z.y, p.z);
    penumbra_stretch = penumbra_attribute_1.x;
    penumbra_numbers = penumbra_attribute_1.yz;
}
