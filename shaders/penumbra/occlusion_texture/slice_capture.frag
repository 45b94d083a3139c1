// Slice capture, fragment stage: every surface into the slices that hold it, four slices to a target.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Draws, which differ
// in PENUMBRA_CAPTURE, formats and blending; then slice_resolve.frag:
//   PENUMBRA_CAPTURE_MASKS     RGBA8     any blending that adds or takes the maximum
//   PENUMBRA_CAPTURE_DEPTHS    RGBA8     GL_MAX
//   PENUMBRA_CAPTURE_SURFACES  RGBA8     GL_MAX; both in one draw: target 2k is masks, target 2k + 1 depths
//   PENUMBRA_CAPTURE_WINDINGS  RGBA16F   GL_FUNC_ADD, GL_ONE, GL_ONE; of closed casters on the lit side only
// Windings are of casters wound outwards; of others, draw with the other glFrontFace.
// Options: PENUMBRA_CAPTURE          which draw; PENUMBRA_CAPTURE_MASKS
//          PENUMBRA_CAPTURE_TARGETS  1 (default) to 4; slices from penumbra_first on; twice as many for surfaces, of
//                                    which ES 300 promises 4
// C++: capture_slices in include/penumbra/occlusion_texture/slices.hpp
#include "slices.glsl"

#define PENUMBRA_CAPTURE_MASKS 0
#define PENUMBRA_CAPTURE_DEPTHS 1
#define PENUMBRA_CAPTURE_WINDINGS 2
#define PENUMBRA_CAPTURE_SURFACES 3
#ifndef PENUMBRA_CAPTURE
#define PENUMBRA_CAPTURE PENUMBRA_CAPTURE_MASKS
#endif
#ifndef PENUMBRA_CAPTURE_TARGETS
#define PENUMBRA_CAPTURE_TARGETS 1
#endif
#if PENUMBRA_CAPTURE == PENUMBRA_CAPTURE_SURFACES
#define PENUMBRA_CAPTURE_OUTPUTS (2 * PENUMBRA_CAPTURE_TARGETS)
#else
#define PENUMBRA_CAPTURE_OUTPUTS PENUMBRA_CAPTURE_TARGETS
#endif

uniform float penumbra_range_first, penumbra_range_thickness;
uniform int penumbra_range_count;
uniform int penumbra_first;         // the first slice of target 0
uniform bool penumbra_close_leaks;  // for surfaces of open casters: into the succeeding slice too

in float penumbra_depth;
layout(location = 0) out vec4 penumbra_target_0;
#if PENUMBRA_CAPTURE_OUTPUTS > 1
layout(location = 1) out vec4 penumbra_target_1;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 2
layout(location = 2) out vec4 penumbra_target_2;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 3
layout(location = 3) out vec4 penumbra_target_3;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 4
layout(location = 4) out vec4 penumbra_target_4;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 5
layout(location = 5) out vec4 penumbra_target_5;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 6
layout(location = 6) out vec4 penumbra_target_6;
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 7
layout(location = 7) out vec4 penumbra_target_7;
#endif

float penumbra_captured(penumbra_SliceRange range, int surface, int slice, int capture) {
    if (capture == PENUMBRA_CAPTURE_WINDINGS) return slice == surface ? (gl_FrontFacing ? -1.0 : 1.0) : 0.0;
    bool held = slice == surface || (penumbra_close_leaks && slice == surface + 1);
    if (!held) return 0.0;
    if (capture == PENUMBRA_CAPTURE_MASKS) return 1.0;
    // the nearest wins: the larger of 1 - relative depth, in bytes
    float relative = penumbra_saturated_ratio(penumbra_depth - penumbra_top(range, slice), range.thickness);
    return (255.0 - floor(relative * 255.0 + 0.5)) / 255.0;
}

// Of target k.
vec4 penumbra_captured_four(penumbra_SliceRange range, int surface, int k) {
#if PENUMBRA_CAPTURE == PENUMBRA_CAPTURE_SURFACES
    int capture = k % 2 == 0 ? PENUMBRA_CAPTURE_MASKS : PENUMBRA_CAPTURE_DEPTHS;
    int slice = penumbra_first + 4 * (k / 2);
#else
    int capture = PENUMBRA_CAPTURE;
    int slice = penumbra_first + 4 * k;
#endif
    vec4 four;
    for (int c = 0; c < 4; ++c) four[c] = penumbra_captured(range, surface, slice + c, capture);
    return four;
}

void main() {
    penumbra_SliceRange range;
    range.first = penumbra_range_first;
    range.thickness = penumbra_range_thickness;
    range.count = penumbra_range_count;
    int surface = penumbra_slice_of(range, penumbra_depth);
    penumbra_target_0 = penumbra_captured_four(range, surface, 0);
#if PENUMBRA_CAPTURE_OUTPUTS > 1
    penumbra_target_1 = penumbra_captured_four(range, surface, 1);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 2
    penumbra_target_2 = penumbra_captured_four(range, surface, 2);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 3
    penumbra_target_3 = penumbra_captured_four(range, surface, 3);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 4
    penumbra_target_4 = penumbra_captured_four(range, surface, 4);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 5
    penumbra_target_5 = penumbra_captured_four(range, surface, 5);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 6
    penumbra_target_6 = penumbra_captured_four(range, surface, 6);
#endif
#if PENUMBRA_CAPTURE_OUTPUTS > 7
    penumbra_target_7 = penumbra_captured_four(range, surface, 7);
#endif
}
