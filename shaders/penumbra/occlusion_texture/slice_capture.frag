// Slice capture, fragment stage: every surface into the slices that hold it, four slices to a target.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. Three draws, which
// differ in PENUMBRA_CAPTURE, formats and blending; then slice_resolve.frag:
//   PENUMBRA_CAPTURE_MASKS     RGBA8     any blending that adds or takes the maximum
//   PENUMBRA_CAPTURE_DEPTHS    RGBA8     GL_MAX
//   PENUMBRA_CAPTURE_WINDINGS  RGBA16F   GL_FUNC_ADD, GL_ONE, GL_ONE; of closed casters on the lit side only
// Options: PENUMBRA_CAPTURE          which draw; PENUMBRA_CAPTURE_MASKS
//          PENUMBRA_CAPTURE_TARGETS  1 (default) to 4; slices from penumbra_first on
// C++: capture_slices in include/penumbra/occlusion_texture/slices.hpp
#include "slices.glsl"

#define PENUMBRA_CAPTURE_MASKS 0
#define PENUMBRA_CAPTURE_DEPTHS 1
#define PENUMBRA_CAPTURE_WINDINGS 2
#ifndef PENUMBRA_CAPTURE
#define PENUMBRA_CAPTURE PENUMBRA_CAPTURE_MASKS
#endif
#ifndef PENUMBRA_CAPTURE_TARGETS
#define PENUMBRA_CAPTURE_TARGETS 1
#endif

uniform float penumbra_range_first, penumbra_range_thickness;
uniform int penumbra_range_count;
uniform int penumbra_first;        // the first slice of target 0
uniform bool penumbra_close_leaks;  // for surfaces of open casters: into the succeeding slice too

in float penumbra_depth;
layout(location = 0) out vec4 penumbra_target_0;
#if PENUMBRA_CAPTURE_TARGETS > 1
layout(location = 1) out vec4 penumbra_target_1;
#endif
#if PENUMBRA_CAPTURE_TARGETS > 2
layout(location = 2) out vec4 penumbra_target_2;
#endif
#if PENUMBRA_CAPTURE_TARGETS > 3
layout(location = 3) out vec4 penumbra_target_3;
#endif

float penumbra_captured(penumbra_SliceRange range, int surface, int slice) {
#if PENUMBRA_CAPTURE == PENUMBRA_CAPTURE_WINDINGS
    return slice == surface ? (gl_FrontFacing ? -1.0 : 1.0) : 0.0;
#else
    bool held = slice == surface || (penumbra_close_leaks && slice == surface + 1);
    if (!held) return 0.0;
#if PENUMBRA_CAPTURE == PENUMBRA_CAPTURE_MASKS
    return 1.0;
#else
    // the nearest wins: the larger of 1 - relative depth, in bytes
    float relative = penumbra_saturated_ratio(penumbra_depth - penumbra_top(range, slice), range.thickness);
    return (255.0 - floor(relative * 255.0 + 0.5)) / 255.0;
#endif
#endif
}

vec4 penumbra_captured_four(penumbra_SliceRange range, int surface, int slice) {
    return vec4(penumbra_captured(range, surface, slice), penumbra_captured(range, surface, slice + 1),
                penumbra_captured(range, surface, slice + 2), penumbra_captured(range, surface, slice + 3));
}

void main() {
    penumbra_SliceRange range;
    range.first = penumbra_range_first;
    range.thickness = penumbra_range_thickness;
    range.count = penumbra_range_count;
    int surface = penumbra_slice_of(range, penumbra_depth);
    penumbra_target_0 = penumbra_captured_four(range, surface, penumbra_first);
#if PENUMBRA_CAPTURE_TARGETS > 1
    penumbra_target_1 = penumbra_captured_four(range, surface, penumbra_first + 4);
#endif
#if PENUMBRA_CAPTURE_TARGETS > 2
    penumbra_target_2 = penumbra_captured_four(range, surface, penumbra_first + 8);
#endif
#if PENUMBRA_CAPTURE_TARGETS > 3
    penumbra_target_3 = penumbra_captured_four(range, surface, penumbra_first + 12);
#endif
}
