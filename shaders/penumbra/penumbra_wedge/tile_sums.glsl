// What a point loses of the light by the edges of one silhouette: sums of exact areas, and their rounding.
//
// Options: none
// Error:   16 units of 2^-23
// C++:     include/penumbra/penumbra_wedge/tile_sums.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_TILE_SUMS_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_TILE_SUMS_GLSL

// Carries sums of edges over their rounding: what is nearly 0 becomes at most 0, what is nearly 1 at least 1, and
// others move by less than 16 units of 2^-23.
float penumbra_settle(float occlusion) { return occlusion * 1.000003814697265625f - 1.9073486328125e-06f; }

#endif
