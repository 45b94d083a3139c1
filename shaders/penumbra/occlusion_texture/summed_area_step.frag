// A step of a summed-area table of four slices: adds the sums `penumbra_reach` texels before, along one axis.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int; precision
// highp usampler2DArray; precision highp sampler2DArray;` for ES. Draw full_screen.vert on images of (width + 1) x
// (height + 1) texels of RGBA32UI, two in turn: first with reach (0, 0), which reads the slices; then reach (1, 0),
// (2, 0), (4, 0) ... while below the width + 1; then (0, 1), (0, 2) ... likewise. No blending.
// Source: J. Hensley et al., "Fast summed-area table generation and its applications", 2005
// C++: build_summed_area in include/penumbra/occlusion_texture/summed_area.hpp
uniform sampler2DArray penumbra_slices;  // RGBA8
uniform usampler2DArray penumbra_sums;   // of the step before
uniform int penumbra_layer;              // of both
uniform ivec2 penumbra_reach;

layout(location = 0) out uvec4 penumbra_sum;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (penumbra_reach == ivec2(0)) {
        bool border = at.x == 0 || at.y == 0;  // nothing lies before the first row and column
        vec4 texel = texelFetch(penumbra_slices, ivec3(max(at - 1, ivec2(0)), penumbra_layer), 0);
        penumbra_sum = border ? uvec4(0u) : uvec4(texel * 255.0 + 0.5);
        return;
    }
    ivec2 before = at - penumbra_reach;
    penumbra_sum = texelFetch(penumbra_sums, ivec3(at, penumbra_layer), 0);
    if (before.x >= 0 && before.y >= 0) penumbra_sum += texelFetch(penumbra_sums, ivec3(before, penumbra_layer), 0);
}
