// Slice capture, vertex stage: triangles as the slice camera sees them.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Draw every caster,
// without culling, depth test and multisampling, on images of camera.width x camera.height texels. Row 0 of the image is
// row 0 of the texture: nothing is flipped. Clip volume: OpenGL's, z in [-w, w].
// C++: SliceCamera::project, capture_slices in include/penumbra/occlusion_texture/slices.hpp
#include "../light.glsl"
#include "slice_camera.glsl"

uniform mat4 penumbra_world;  // of the caster
uniform vec3 penumbra_light_origin, penumbra_light_u, penumbra_light_v, penumbra_light_normal;
uniform float penumbra_convergence;
uniform vec2 penumbra_origin_tx, penumbra_scale_tx;
uniform vec2 penumbra_size_tx;
uniform float penumbra_farthest;  // at least the depth of every vertex

in vec3 penumbra_position;
out float penumbra_depth;

void main() {
    penumbra_LightFrame frame =
        penumbra_make_frame(penumbra_light_origin, penumbra_light_u, penumbra_light_v, penumbra_light_normal);
    vec3 point_ls = penumbra_to_light(frame, (penumbra_world * vec4(penumbra_position, 1.0)).xyz);
    penumbra_SliceCamera camera;
    camera.convergence = penumbra_convergence;
    camera.origin_tx = penumbra_origin_tx;
    camera.scale_tx = penumbra_scale_tx;
    vec4 at = penumbra_project(camera, point_ls);
    penumbra_depth = point_ls.z;
    // the near side of the clip volume, z = -w, is the light's plane
    gl_Position = vec4(2.0 * at.xy / penumbra_size_tx - vec2(at.w), point_ls.z / penumbra_farthest - at.w, at.w);
}
