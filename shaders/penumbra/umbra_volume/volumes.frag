// D-buffer, silhouette faces and sides of volumes, fragment stage: where rays enter the nearest penumbra and leave the
// nearest umbra, and where the next, past another edge.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. After casters.frag
// and blocking.frag, into the image of crossings (see d_buffer.glsl), RGBA32F with its alpha masked, and a depth
// buffer of its size that keeps the nearest. No blending. Umbrae with the viewport (0, row, resolution, resolution),
// penumbrae with row + resolution; row is 0 for layer 0. For two layers it writes edges to a second target as well,
// R32F with at least the first 2 resolution rows, cleared to -1; then both kinds again, with row = 2 resolution, for
// layer 1, which reads that.
// Options: PENUMBRA_UMBRA_VOLUME_LAYER   which is drawn, 0 or 1; 0
//          PENUMBRA_UMBRA_VOLUME_LAYERS  of all, 1 or 2; 2
//          PENUMBRA_UMBRA_VOLUME_DEPTH   see d_buffer_view.glsl
// C++: detail::DBufferBuilder in include/penumbra/umbra_volume/d_buffer_builder.hpp
#include "d_buffer_view.glsl"

#ifndef PENUMBRA_UMBRA_VOLUME_LAYER
#define PENUMBRA_UMBRA_VOLUME_LAYER 0
#endif
#ifndef PENUMBRA_UMBRA_VOLUME_LAYERS
#define PENUMBRA_UMBRA_VOLUME_LAYERS 2
#endif

uniform penumbra_DBufferView penumbra_view;
uniform bool penumbra_umbra;
uniform int penumbra_row;                    // of the viewport
uniform highp usampler2D penumbra_coverage;  // what casters.frag has made
#if PENUMBRA_UMBRA_VOLUME_LAYER > 0
uniform highp sampler2D penumbra_edges;  // what layer 0 has made
#endif

in float penumbra_stretch;
flat in vec2 penumbra_numbers;
layout(location = 0) out vec4 penumbra_crossing;
#if PENUMBRA_UMBRA_VOLUME_LAYER == 0 && PENUMBRA_UMBRA_VOLUME_LAYERS > 1
layout(location = 1) out float penumbra_edge;
#endif

// Whether the caster, or another whose number is the same but for 128s, blocks the ray.
bool penumbra_is_blocked_by(ivec2 texel, int caster) {
    uvec4 bits = texelFetch(penumbra_coverage, texel, 0);
    int channel = (caster >> 5) & 3;
    uint word = channel == 0 ? bits.x : channel == 1 ? bits.y : channel == 2 ? bits.z : bits.w;
    return (word >> uint(caster & 31) & 1u) == 1u;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy) - ivec2(0, penumbra_row);
    // umbrae only along rays that their own caster blocks: behind its apex an umbra's sides bound nothing
    if (penumbra_umbra && !penumbra_is_blocked_by(texel, int(penumbra_numbers.y))) discard;
#if PENUMBRA_UMBRA_VOLUME_LAYER > 0
    ivec2 first = penumbra_umbra ? texel : ivec2(texel.x, texel.y + penumbra_view.resolution);
    if (texelFetch(penumbra_edges, first, 0).x == penumbra_numbers.x) discard;
#endif
    float depth = 1.0 / gl_FragCoord.w;
    float edge_depth = min(depth, depth / penumbra_stretch);
    float unit = penumbra_depth_of(penumbra_texel_ray(penumbra_view, vec2(texel) + vec2(0.5)));
    penumbra_crossing = vec4(depth * unit, edge_depth * unit, penumbra_numbers.x, 0.0);
#if PENUMBRA_UMBRA_VOLUME_LAYER == 0 && PENUMBRA_UMBRA_VOLUME_LAYERS > 1
    penumbra_edge = penumbra_numbers.x;
#endif
}
