// Depth maps from positions on a line light, vertex stage: triangles as a map sees them.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Map i is drawn with
// the viewport (0, i resolution, resolution, resolution), without culling and multisampling; light_map.frag says what.
// Row 0 of the image is row 0 of the texture: nothing is flipped. Clip volume: OpenGL's or Direct3D's, its near side at
// z = -w or 0.
// C++: LightMapGeometry in include/penumbra/soft_shadow_map/light_map_geometry.hpp, which has what uniforms want
#include "../light.glsl"
#include "light_map.glsl"

uniform mat4 penumbra_world;  // of the mesh
uniform penumbra_LightFrame penumbra_light;
uniform penumbra_LightMapView penumbra_view;
uniform float penumbra_near;  // what lies before this depth, or half of it, is cut off
uniform float penumbra_from;  // the map's position on the light, from its centre

in vec3 penumbra_position;

void main() {
    vec3 point_ls = penumbra_to_light(penumbra_light, (penumbra_world * vec4(penumbra_position, 1.0)).xyz);
    vec2 from_low = point_ls.xy - vec2(penumbra_from, 0.0) - penumbra_view.slopes.min * point_ls.z;
    vec2 at = from_low / penumbra_extent(penumbra_view.slopes);
    gl_Position = vec4(2.0 * at - vec2(point_ls.z), point_ls.z - penumbra_near, point_ls.z);
}
