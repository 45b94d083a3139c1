// Silhouette blending: brings what silhouette_blend.frag has drawn to the textures that it reads.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, `precision highp float; precision highp int;` for ES.
// Drawn by silhouette_frustum.vert, for the silhouettes that were drawn since, with the same state.
// Options: PENUMBRA_PENUMBRA_WEDGE_OVERLAP  see silhouette_blend.frag; PENUMBRA_OVERLAP_RECTANGLES, 4, or _CENTROID, 5
// C++:     none
#ifndef PENUMBRA_PENUMBRA_WEDGE_OVERLAP
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP 4
#endif

uniform highp usampler2D penumbra_rects, penumbra_coverages;
layout(location = 0) out uvec4 penumbra_out_rects;
layout(location = 1) out uvec4 penumbra_out_coverages;
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == 5
uniform highp usampler2D penumbra_centres;
layout(location = 2) out uvec4 penumbra_out_centres;
#endif

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    penumbra_out_rects = texelFetch(penumbra_rects, texel, 0);
    penumbra_out_coverages = texelFetch(penumbra_coverages, texel, 0);
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == 5
    penumbra_out_centres = texelFetch(penumbra_centres, texel, 0);
#endif
}
