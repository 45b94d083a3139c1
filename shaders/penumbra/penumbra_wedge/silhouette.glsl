// What faces and edges add to a silhouette. The mesh's adjacency is the host's; so is the choice of solid or sheet.
//
// Options: none
// Error:   face_normal 2 ULP times the product of the sides at `a` over their cross product; the rest decides by one
//          rounded dot product.
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/silhouette.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE_GLSL

#include "../geometry.glsl"

// Which faces of a mesh hide something: those that look away from the point, of a closed mesh with a consistent
// winding; or all of them, each turned to look at the point.
#define PENUMBRA_SURFACE_SOLID 0
#define PENUMBRA_SURFACE_SHEET 1

// Where the silhouette is taken from: a point of the scene, or the centre of the light.
#define PENUMBRA_SILHOUETTE_LIGHT_CENTER 0
#define PENUMBRA_SILHOUETTE_POINT 1

// The unit normal of a triangle, on the side from which it is counter-clockwise; 0 if it has no area. Any space.
// Domain: |coordinates| <= 1e18.
vec3 penumbra_face_normal(vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a;
    vec3 ac = c - a;
    float largest = max(penumbra_largest_component(ab), penumbra_largest_component(ac));
    float scale = penumbra_exp2_int(penumbra_exponent_to_unit(largest));
    return penumbra_normalize_or(cross(ab * scale, ac * scale), vec3(0.0f, 0.0f, 0.0f));
}

// Distance up to which a point counts as lying in a face's plane, for meshes with these bounds. 0 for empty bounds.
float penumbra_silhouette_tolerance(penumbra_Box3 bounds) {
    float largest = max(penumbra_largest_component(bounds.min), penumbra_largest_component(bounds.max));
    return penumbra_is_empty(bounds) ? 0.0f : 1.9073486328125e-6f * largest;
}

// With which winding a face enters the chain that hides from `viewpoint`: -1, 0 or 1. `unit_normal` is face_normal,
// `vertex` any vertex of the face; any right-handed space, `tolerance` >= 0 in its unit. 0 for a face without normal and
// for a viewpoint within `tolerance` of the face's plane.
int penumbra_face_winding(vec3 unit_normal, vec3 vertex, vec3 viewpoint, float tolerance, int surface) {
    float distance = dot(unit_normal, viewpoint - vertex);
    if (distance < -tolerance) return -1;
    return surface == PENUMBRA_SURFACE_SHEET && distance > tolerance ? 1 : 0;
}

// How often an edge belongs to the silhouette, negative for its reverse: the winding of the faces that run along it less
// that of the faces that run against it. For PENUMBRA_SILHOUETTE_LIGHT_CENTER the other way round.
int penumbra_edge_winding(int along, int against, int from) {
    return from == PENUMBRA_SILHOUETTE_POINT ? along - against : against - along;
}

#endif
