// Slice capture, vertex stage: triangles as the slice camera sees them.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Draw every caster,
// without depth test and multisampling, on images of at least camera.width x camera.height texels: what lies beyond
// stays empty. Row 0 of the image is row 0 of the texture: nothing is flipped. No culling; for SliceFaces::facing,
// front faces of closed casters, wound outwards, are culled.
// C++: SliceCamera::project, capture_slices in include/penumbra/occlusion_texture/slices.hpp
#include "../light.glsl"
#include "slice_camera.glsl"

uniform mat4 penumbra_world;  // of the caster
uniform vec3 penumbra_light_origin, penumbra_light_u, penumbra_light_v, penumbra_light_normal;
uniform float penumbra_convergence;
uniform vec2 penumbra_origin_tx, penumbra_scale_tx;
uniform vec2 penumbra_size_tx;    // of the image
uniform float penumbra_farthest;  // at least the depth of every vertex, not 0
// The clip volume: z in [-w, w], OpenGL's; true: z in [0, w], that of Vulkan, Direct3D and glClipControl.
uniform bool penumbra_clip_zero_to_one;

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
    // the near side of the clip volume is the light's plane; w is at least 1
    float z = point_ls.z / penumbra_farthest - (penumbra_clip_zero_to_one ? 0.0 : at.w);
    gl_Position = vec4(2.0 * at.xy / penumbra_size_tx - vec2(at.w), z, at.w);
}
