// Slices of the scene as occlusion textures: which slice a surface belongs to, and how much of a slice a point reads.
//
// Options: none
// Error:   2 roundings
// Source:  E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006, section 3
// C++:     include/penumbra/occlusion_texture/slices.hpp
#ifndef PENUMBRA_SLICES_GLSL
#define PENUMBRA_SLICES_GLSL

#include "../numeric.glsl"

// Equal slices of the depth range [first, first + count thickness], world units from the light's plane.
struct penumbra_SliceRange {
    float first, thickness;
    int count;
};

float penumbra_top(penumbra_SliceRange range, int slice) { return range.first + range.thickness * float(slice); }

float penumbra_bottom(penumbra_SliceRange range, int slice) { return penumbra_top(range, slice + 1); }

// The slice that a depth belongs to; the nearest one for depths outside. A depth on a boundary belongs to the slice
// behind it.
int penumbra_slice_of(penumbra_SliceRange range, float depth) {
    float slices = float(range.count);
    int slice = int(slices * penumbra_saturated_ratio(depth - range.first, range.thickness * slices));
    return slice < range.count ? slice : range.count - 1;
}

// Position of a depth relative to a slice: 0 at its top, 1 at its bottom. In [0, 4]; a slice without thickness is
// passed at once.
float penumbra_relative_depth(float top, float thickness, float depth) {
    return 4.0f * penumbra_saturated_ratio(depth - top, thickness * 4.0f);
}

// The plane that stands for all surfaces of a slice.
#define PENUMBRA_SLICE_PLANE_BOTTOM 0
#define PENUMBRA_SLICE_PLANE_MIDDLE 1

// The plane from which a slice is read. Nearer to the light than the slice's own plane while the point is inside:
// half-way between slice top and point. Continuous in `point_depth`.
float penumbra_slice_plane_depth(float top, float thickness, float point_depth, int plane) {
    float nominal = plane == PENUMBRA_SLICE_PLANE_BOTTOM ? top + thickness : top + thickness * 0.5f;
    float half_way = (top + point_depth) * 0.5f;
    return half_way < nominal ? half_way : nominal;
}

// What keeps a surface from shadowing itself in the slice that holds it.
#define PENUMBRA_SELF_SHADOW_FADE 0
#define PENUMBRA_SELF_SHADOW_CLEAR 1
#define PENUMBRA_SELF_SHADOW_MEAN_DEPTH 2

// How much of a slice counts at a point at `relative` depth, in [0, 1]: 0 in front of the slice, 1 far behind it. Fade
// and clear ignore `mean_depth`, the mean relative depth in [0, 1] of what the kernel covers; mean depth counts what
// lies more than `bias` before the point, in full from 2 bias on. Lengths in slices.
float penumbra_slice_weight(float relative, float mean_depth, float bias, int mode) {
    if (mode == PENUMBRA_SELF_SHADOW_FADE) return penumbra_saturate(relative);
    if (mode == PENUMBRA_SELF_SHADOW_CLEAR) return penumbra_saturate(relative - 1.0f);
    return penumbra_saturated_ratio(relative - mean_depth - bias, bias);
}

#endif
