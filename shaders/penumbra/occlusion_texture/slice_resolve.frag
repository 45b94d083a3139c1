// After slice capture: fills solids, and turns captured depths into those that queries read. Four slices at a time.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp
// sampler2DArray;` for ES. Draw full_screen.vert on an image of the slices' size, no blending; layer g of the arrays
// holds slices 4g to 4g + 3. Targets: masks and depths, RGBA8. Without solids and depths nothing needs to be resolved.
// Options: PENUMBRA_RESOLVE_SOLIDS  1: fills by windings (default); 0: no caster is closed
//          PENUMBRA_RESOLVE_DEPTHS  1 (default); 0: masks only
// C++: detail::SliceCapture::fill_solids in include/penumbra/occlusion_texture/slices.hpp
#ifndef PENUMBRA_RESOLVE_SOLIDS
#define PENUMBRA_RESOLVE_SOLIDS 1
#endif
#ifndef PENUMBRA_RESOLVE_DEPTHS
#define PENUMBRA_RESOLVE_DEPTHS 1
#endif

uniform sampler2DArray penumbra_masks, penumbra_depths, penumbra_windings;  // as captured
uniform int penumbra_group;

layout(location = 0) out vec4 penumbra_mask;
#if PENUMBRA_RESOLVE_DEPTHS
layout(location = 1) out vec4 penumbra_depth;
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 mask = texelFetch(penumbra_masks, ivec3(at, penumbra_group), 0);
#if PENUMBRA_RESOLVE_SOLIDS
    float entered = 0.0;  // surfaces of solids entered, less those left, above the slice
    for (int group = 0; group < penumbra_group; ++group)
        entered += dot(texelFetch(penumbra_windings, ivec3(at, group), 0), vec4(1.0));
    vec4 windings = texelFetch(penumbra_windings, ivec3(at, penumbra_group), 0);
    vec4 filled = vec4(0.0);
    for (int c = 0; c < 4; ++c) {
        if (abs(entered) > 0.5) filled[c] = 1.0;
        entered += windings[c];
    }
    mask = max(mask, filled);
#else
    vec4 filled = vec4(0.0);
#endif
    penumbra_mask = mask;
#if PENUMBRA_RESOLVE_DEPTHS
    vec4 nearness = texelFetch(penumbra_depths, ivec3(at, penumbra_group), 0);
    penumbra_depth = (mask - nearness) * (1.0 - filled);
#endif
}
