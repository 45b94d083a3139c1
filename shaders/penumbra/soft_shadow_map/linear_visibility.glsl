// How much of a piece of a line light is seen past one edge: on skins by the paper, with a straight receiver, or
// exactly.
//
// In the plane through a point and the light, points are (slope, inverse depth), that is (x / z, 1 / z) in light space;
// seen from position p on the light, a point appears at slope - p * inverse depth. Positions are world units from the
// light's centre.
//
// Options: none
// Error:   slope_from 2 ULP of what it subtracts; edge_visibility 4 epsilon (|slopes| + |positions| inverse depth) over
//          the difference of inverse depths and the length of the piece; skin_visibility a rounding of each difference
// Source:  W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000, eq. 1
// C++:     include/penumbra/soft_shadow_map/linear_visibility.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_LINEAR_VISIBILITY_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_LINEAR_VISIBILITY_GLSL

#include "../numeric.glsl"

// A point in the plane through it and the light: x / z, and 1 / z >= 0.
struct penumbra_RowPoint {
    float slope, inverse_depth;
};

penumbra_RowPoint penumbra_row_point(float slope, float inverse_depth) {
    penumbra_RowPoint point;
    point.slope = slope;
    point.inverse_depth = inverse_depth;
    return point;
}

// Where `point` appears from `position` on the light.
float penumbra_slope_from(penumbra_RowPoint point, float position) {
    return point.slope - position * point.inverse_depth;
}

// The fraction of the light between the positions `hidden` and `seen` that `point` sees past an edge whose caster
// covers the side of `hidden`. In [0, 1]; 1 if the edge is not nearer to the light than the point. A piece of no length
// gives 0 or 1.
float penumbra_edge_visibility(penumbra_RowPoint edge, penumbra_RowPoint point, float hidden, float seen) {
    float nearer = edge.inverse_depth - point.inverse_depth;
    if (!(nearer > 0.0f)) return 1.0f;
    float past = seen * nearer - (edge.slope - point.slope);
    float piece = seen - hidden;
    return piece < 0.0f ? penumbra_saturated_ratio(-past, -piece * nearer)
                        : penumbra_saturated_ratio(past, piece * nearer);
}

// Visibility on a skin, `share` of the way in the image from its edge to its far end: linear, the paper. In [0, 1].
float penumbra_skin_visibility(float share) { return penumbra_saturate(share); }

// The same on a skin from an edge at `edge` to a far end at `far`, where the receiver's inverse depth is `receiver`;
// all inverse depths. In [0, 1]; 1 where the receiver is not behind the edge.
float penumbra_skin_visibility(float share, float edge, float far, float receiver) {
    float behind = edge - receiver;
    return behind > 0.0f ? penumbra_saturated_ratio(share * (edge - far), behind) : 1.0f;
}

#endif
