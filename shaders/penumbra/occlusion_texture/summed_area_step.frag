// A step of a summed-area table of four slices: adds the sums 1, 2 and 3 times `penumbra_reach` texels before, along
// one axis.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int;
// precision highp usampler2DArray; precision highp sampler2DArray;` for ES. Draw full_screen.vert on images of (width +
// 1) x (height + 1) texels of RGBA32UI, two in turn: first with reach (0, 0), which reads the slices; then reach (1,
// 0), (4, 0), (16, 0) ... while below the width + 1; then (0, 1), (0, 4) ... likewise. No blending.
// Options: PENUMBRA_STEP_CHANNELS  4 (default); 1: to four R32UI targets instead, one a channel, for the last step
// Source: J. Hensley et al., "Fast summed-area table generation and its applications", 2005
// C++: build_summed_area in include/penumbra/occlusion_texture/summed_area.hpp
#ifndef PENUMBRA_STEP_CHANNELS
#define PENUMBRA_STEP_CHANNELS 4
#endif

uniform sampler2DArray penumbra_slices;  // RGBA8
uniform usampler2DArray penumbra_sums;   // of the step before
uniform int penumbra_layer;              // of the slices, or of the sums
uniform ivec2 penumbra_reach;

#if PENUMBRA_STEP_CHANNELS == 1
layout(location = 0) out uint penumbra_sum_0;
layout(location = 1) out uint penumbra_sum_1;
layout(location = 2) out uint penumbra_sum_2;
layout(location = 3) out uint penumbra_sum_3;
#else
layout(location = 0) out uvec4 penumbra_sum;
#endif

uvec4 penumbra_stepped(ivec2 at) {
    if (penumbra_reach == ivec2(0)) {
        bool border = at.x == 0 || at.y == 0;  // nothing lies before the first row and column
        vec4 texel = texelFetch(penumbra_slices, ivec3(max(at - 1, ivec2(0)), penumbra_layer), 0);
        return border ? uvec4(0u) : uvec4(texel * 255.0 + 0.5);
    }
    uvec4 sum = texelFetch(penumbra_sums, ivec3(at, penumbra_layer), 0);
    for (int k = 1; k < 4; ++k) {
        ivec2 before = at - k * penumbra_reach;
        if (before.x >= 0 && before.y >= 0) sum += texelFetch(penumbra_sums, ivec3(before, penumbra_layer), 0);
    }
    return sum;
}

void main() {
    uvec4 sum = penumbra_stepped(ivec2(gl_FragCoord.xy));
#if PENUMBRA_STEP_CHANNELS == 1
    penumbra_sum_0 = sum.x;
    penumbra_sum_1 = sum.y;
    penumbra_sum_2 = sum.z;
    penumbra_sum_3 = sum.w;
#else
    penumbra_sum = sum;
#endif
}
