// Soft shadows of a rectangle light from the silhouettes of casters: the query, by the index of a shadow as a texture.
//
// The host makes the texture and what else a query needs by wedge_texels(shadow); points come in light space, as
// penumbra_to_light(shadow.frame(), point) gives them. Points on casters may be off by info.tolerance / info.scale:
// raise it for those that a rasterizer interpolates less exactly.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_OVERLAP: see blending.glsl
//          PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE: see bitmask.glsl
//          PENUMBRA_PENUMBRA_WEDGE_TOLERANCE: see union_blending.glsl
//          PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES: see edge_union.glsl
//          PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE: see wedge_index.glsl
// Error:   that of the method; 2e-6 from the C++, and one cell of a mask where a middle lies on an edge to rounding;
//          masks where a point has more edges than fit
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/shadow.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_SHADOW_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_SHADOW_GLSL

#include "blending.glsl"

// Fraction of the light that a point (light space, world units) sees, in [0, 1]; 1 for points on or behind the light's
// plane, and for points that are not finite.
float penumbra_visibility(highp sampler2D wedges, penumbra_WedgeShadow info, vec3 point_ls) {
    vec3 point = point_ls * info.scale;
    if (!(point.z > 0.0f) || !penumbra_is_finite(point)) return 1.0f;
    return 1.0f - penumbra_blend(wedges, info, penumbra_wedge_point(point, info.half_size));
}

#endif
