// How much of a box lies inside a closed loop, one edge at a time: what a silhouette blocks of a light.
//
// Green's theorem turns the area inside a loop into a sum over its edges; no edge needs to know of any other. What is
// summed is the winding number: a part of the box that a loop encloses twice counts twice.
//
// Options: none
// Error:   1.5 epsilon of the box's area an edge with an end within 3 half-sizes of the box's middle; 5e-7 a loop
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006, whose
//          coverage this replaces: theirs asks for the centre
// C++:     include/penumbra/penumbra_wedge/coverage.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_COVERAGE_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_COVERAGE_GLSL

#include "../geometry.glsl"

// What may be divided by: itself, or 2 where it is zero or a denormal.
float penumbra_divisor(float x) { return abs(x) >= PENUMBRA_SMALLEST ? x : 2.0f; }

// An edge within the box's columns: both x limited to the box, y not yet. From the end nearer to the box's middle in y,
// from which it is interpolated, to the other; `sign` is -1 if that is not its own way.
struct penumbra_ColumnEdge {
    float x0, y0, x1, y1, sign;
};

penumbra_ColumnEdge penumbra_column_edge(vec2 a, vec2 b, penumbra_Rect2 box) {
    float middle = (box.min.y + box.max.y) * 0.5f;
    float far_a = abs(a.y - middle);
    float far_b = abs(b.y - middle);
    bool left = a.x < b.x || (a.x == b.x && a.y < b.y);
    bool forward = far_a < far_b || (far_a == far_b && left);
    vec2 start = forward ? a : b;
    vec2 end = forward ? b : a;
    float run = penumbra_divisor(end.x - start.x);
    float rise = end.y - start.y;
    penumbra_ColumnEdge e;
    e.x0 = penumbra_clamp(start.x, box.min.x, box.max.x);
    e.y0 = start.y + (e.x0 - start.x) / run * rise;
    e.x1 = penumbra_clamp(end.x, box.min.x, box.max.x);
    e.y1 = start.y + (e.x1 - start.x) / run * rise;
    e.sign = forward ? 1.0f : -1.0f;
    return e;
}

// What lies of the box below the edge, signed.
float penumbra_covered_below(penumbra_ColumnEdge e, penumbra_Rect2 box) {
    float c0 = penumbra_clamp(e.y0, box.min.y, box.max.y);
    float c1 = penumbra_clamp(e.y1, box.min.y, box.max.y);
    // twice the mean of the limited y: its ends' sum, and how much longer it stays at one limit than at the other
    float rise = e.y1 - e.y0;
    float most = abs(rise);
    float lean = penumbra_clamp((c0 - e.y0) + (c1 - e.y1), -most, most) / penumbra_divisor(rise);
    float twice_mean = ((c0 - box.min.y) + (c1 - box.min.y)) + lean * (c0 - c1);
    return e.sign * (0.5f * (e.x0 - e.x1) * twice_mean);
}

// The signed area of the part of `box` below the edge from a to b, between its ends' columns: summed over a closed loop
// that runs counter-clockwise it is the loop's area inside the box, winding counted. Plane coordinates, any unit, up to
// 1e18. 0 for a vertical edge, one of no length, one beside or below the box.
float penumbra_edge_coverage(vec2 a, vec2 b, penumbra_Rect2 box) {
    return penumbra_covered_below(penumbra_column_edge(a, b, box), box);
}

// Area and first moments of what lies of a box below an edge, signed as penumbra_edge_coverage; x and y are integrals
// measured from box.min. Over area, the centre of gravity.
struct penumbra_CoverageMoments {
    float area, x, y;
};

penumbra_CoverageMoments penumbra_edge_moments(vec2 a, vec2 b, penumbra_Rect2 box) {
    penumbra_ColumnEdge e = penumbra_column_edge(a, b, box);
    float y0 = penumbra_clamp(e.y0, box.min.y, box.max.y);
    float y1 = penumbra_clamp(e.y1, box.min.y, box.max.y);
    // the shares of the way at which the edge leaves the first limit and reaches the last; any, if it stays at one
    float rise = abs(e.y1 - e.y0);
    float safe_rise = penumbra_divisor(rise);
    float run = e.x1 - e.x0;
    float enter = penumbra_clamp(abs(y0 - e.y0), 0.0f, rise) / safe_rise;
    float leave = penumbra_clamp(abs(y1 - e.y0), 0.0f, rise) / safe_rise;
    // means along the way of the height, of height times share of the way, of height squared
    float h0 = y0 - box.min.y;
    float h1 = y1 - box.min.y;
    float before = enter * h0;
    float between = leave - enter;
    float after = (1.0f - leave) * h1;
    float mean = before + between * (h0 + h1) * 0.5f + after;
    float mean_way = 0.5f * (before * enter + after * (1.0f + leave)) +
                     between * (h0 * (2.0f * enter + leave) + h1 * (enter + 2.0f * leave)) * (1.0f / 6.0f);
    float mean_square = before * h0 + between * (h0 * h0 + h0 * h1 + h1 * h1) * (1.0f / 3.0f) + after * h1;
    float along = -e.sign * run;
    penumbra_CoverageMoments m;
    m.area = along * mean;
    m.x = along * ((e.x0 - box.min.x) * mean + run * mean_way);
    m.y = along * 0.5f * mean_square;
    return m;
}

#endif
