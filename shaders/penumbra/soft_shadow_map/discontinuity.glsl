// Where neighbouring texels of a depth map belong to different surfaces.
//
// Depths and thresholds are in world units; only differences between neighbours count, whatever the resolution.
//
// Options: none
// Error:   laplacian_of_gaussian 6 epsilon of the largest depth; the others a rounding of each difference and inverse
// Source:  D. Marr & E. Hildreth, "Theory of edge detection", 1980; W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow
//          maps for linear lights", 2000
// C++:     include/penumbra/soft_shadow_map/discontinuity.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_DISCONTINUITY_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_DISCONTINUITY_GLSL

// The Laplacian of a Gaussian of 3 x 3 depths: positive where the middle is nearer than what is around it. Kernel
// (1 2 1; 2 -12 2; 1 2 1) / 16. A step of height h along a column's or a row's border gives h / 4 on its near side and
// -h / 4 on the far one; planes 0.
float penumbra_laplacian_of_gaussian(mat3 depths) {
    float corners = (depths[0][0] + depths[0][2]) + (depths[2][0] + depths[2][2]);
    float sides = (depths[0][1] + depths[2][1]) + (depths[1][0] + depths[1][2]);
    return (corners + 2.0f * sides - 12.0f * depths[1][1]) * 0.0625f;
}

// Is there a step between two neighbours with these Laplacians? Where they change sign, and differ as by a step of at
// least `threshold`.
bool penumbra_is_laplacian_step(float left, float right, float threshold) {
    if ((left > 0.0f) == (right > 0.0f)) return false;
    float difference = left > right ? left - right : right - left;
    return difference >= 0.5f * threshold;
}

// Is there a step between two neighbours along a row or column? `left` and `right` are three depths on either side,
// those at the border first. There is if depth changes by more than `threshold`, and inverse depth by more than 5 / 4
// of what it does within either side in the same sense, between all three. `none` and beyond is no surface, steps to
// which always count. Domain: depths > 0.
bool penumbra_is_step(vec3 left, vec3 right, float threshold, float none) {
    if (!(left.x < none) || !(right.x < none)) return left.x < none || right.x < none;
    if (!((left.x < right.x ? right.x - left.x : left.x - right.x) > threshold)) return false;
    float side = right.x < left.x ? 1.0f : -1.0f;
    float l = 1.0f / left.x;
    float r = 1.0f / right.x;
    float before = 0.0f;
    float after = 0.0f;
    if (left.y < none && left.z < none)
        before = min(side * (l - 1.0f / left.y), side * (1.0f / left.y - 1.0f / left.z));
    if (right.y < none && right.z < none)
        after = min(side * (1.0f / right.y - r), side * (1.0f / right.z - 1.0f / right.y));
    float change = side * (r - l);
    return change > 1.25f * before && change > 1.25f * after;
}

#endif
