// Silhouette blending, vertex stage: what bounds the shadow of each silhouette, as a closed volume.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. No attributes: draw
// 36 vertices a silhouette, as triangles, with front faces culled, on the targets of silhouette_blend.frag. Each pixel
// of the volume is drawn once, wherever the eye is. With the depth buffer of the surfaces attached, and neither cleared
// nor written, the comparison that keeps what lies beyond a surface passes over pixels whose surface is beyond the
// volume: GL_GREATER, or GL_LESS where near is 1 and far 0.
// Options: PENUMBRA_SILHOUETTE_WITHIN  that of silhouette_blend.frag. 1: the box of the silhouette's mesh; 0 (default):
//                                      all of its shadow
// C++:     include/penumbra/penumbra_wedge/shadow_frustum.hpp
#ifndef PENUMBRA_SILHOUETTE_WITHIN
#define PENUMBRA_SILHOUETTE_WITHIN 0
#endif
#include "../light.glsl"
#include "wedge_texels.glsl"

// Three texels a silhouette, laid out as the index: the frustum's near rectangle, its far one, each as min and max; and
// near depth, far depth, the first texel of the mesh's nodes, that beyond their last (WedgeTexels::meshes). In the
// index's unit.
uniform highp sampler2D penumbra_silhouettes;
uniform highp sampler2D penumbra_wedges;  // WedgeTexels, for boxes
uniform int penumbra_first;  // of the silhouettes that are drawn
uniform penumbra_LightFrame penumbra_light;
uniform float penumbra_scale;  // WedgeTexels::scale
uniform mat4 penumbra_world_to_clip;

flat out ivec2 penumbra_nodes;

// Corners of a box, outwards: bit 0 is its right side, bit 1 its upper one, bit 2 its far one.
const int penumbra_corners[36] = int[36](0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,  //
                                         1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3);

void main() {
    int silhouette = gl_VertexID / 36;
    int corner = penumbra_corners[gl_VertexID - 36 * silhouette];
    int texel = 3 * (penumbra_first + silhouette);
    vec4 near = penumbra_wedge_texel(penumbra_silhouettes, texel);
    vec4 far = penumbra_wedge_texel(penumbra_silhouettes, texel + 1);
    vec4 rest = penumbra_wedge_texel(penumbra_silhouettes, texel + 2);
#if PENUMBRA_SILHOUETTE_WITHIN
    float margin = rest.y * 0.0009765625;  // as that of frusta
    vec3 low = vec3(penumbra_wedge_texel(penumbra_wedges, int(rest.z))) - margin;
    vec3 high = vec3(penumbra_wedge_texel(penumbra_wedges, int(rest.z) + 1)) + margin;
    near = vec4(low.xy, high.xy);
    far = near;
    rest.x = low.z;
    rest.y = high.z;
#endif
    bool is_far = (corner & 4) != 0;
    vec4 rect = is_far ? far : near;
    vec2 at = vec2((corner & 1) != 0 ? rect.z : rect.x, (corner & 2) != 0 ? rect.w : rect.y);
    vec3 point = vec3(at, is_far ? rest.y : rest.x);
    penumbra_nodes = ivec2(int(rest.z), int(rest.w));
    gl_Position = penumbra_world_to_clip * vec4(penumbra_to_world(penumbra_light, point / penumbra_scale), 1.0);
}
