// What one silhouette blocks of one radial part of the light: an area, a centre of gravity and a bounding rectangle.
//
// The light's box is cut into radial parts: axis quadrants, or the whole box as one part. Part coordinates make a part
// [0, 1]^2, x to the right and y up.
//
// Options: none
// Error:   areas and moments as edge_moments'; rectangles 16 ULP of 1, and as much for what lies within the border.
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006, corrected
// C++:     include/penumbra/penumbra_wedge/radial_part.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_RADIAL_PART_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_RADIAL_PART_GLSL

#include "../geometry.glsl"
#include "coverage.glsl"

// What one silhouette, or several that were blended, blocks of one part, in part coordinates: the area, the first
// moments (over area: the centre of gravity), and a rectangle around all of it.
struct penumbra_RadialPart {
    float area;
    vec2 moment;
    penumbra_Rect2 rect;
};

penumbra_RadialPart penumbra_radial_part(float area, vec2 moment, penumbra_Rect2 rect) {
    penumbra_RadialPart part;
    part.area = area;
    part.moment = moment;
    part.rect = rect;
    return part;
}

// The part that nothing blocks. Its rectangle is inside out, so that unions leave others as they are.
penumbra_RadialPart penumbra_empty_part() {
    return penumbra_radial_part(0.0f, vec2(0.0f, 0.0f), penumbra_rect2(vec2(1.0f, 1.0f), vec2(0.0f, 0.0f)));
}

// The part that is blocked everywhere.
penumbra_RadialPart penumbra_full_part() {
    return penumbra_radial_part(1.0f, vec2(0.5f, 0.5f), penumbra_rect2(vec2(0.0f, 0.0f), vec2(1.0f, 1.0f)));
}

// The part with what rounding, packing or any finite numbers violate put right: rect within [0, 1]^2, 0 <= area <=
// |rect|, moment / area in rect; the empty part where the area is less than the smallest normal number.
penumbra_RadialPart penumbra_valid_part(penumbra_RadialPart part) {
    vec2 low = vec2(penumbra_saturate(part.rect.min.x), penumbra_saturate(part.rect.min.y));
    vec2 high = vec2(penumbra_saturate(part.rect.max.x), penumbra_saturate(part.rect.max.y));
    penumbra_Rect2 rect = penumbra_rect2(low, high);
    float area = penumbra_clamp(part.area, 0.0f, penumbra_area(rect));
    if (!(area >= PENUMBRA_SMALLEST)) return penumbra_empty_part();
    vec2 moment = vec2(penumbra_clamp(part.moment.x, area * low.x, area * high.x),
                       penumbra_clamp(part.moment.y, area * low.y, area * high.y));
    return penumbra_radial_part(area, moment, rect);
}

// The four radial parts of a light's box: bit 0 of `index` is the right half, bit 1 the upper one. The box's unit.
penumbra_Rect2 penumbra_quadrant(penumbra_Rect2 box, int index) {
    vec2 middle = vec2((box.min.x + box.max.x) * 0.5f, (box.min.y + box.max.y) * 0.5f);
    bool right = (index & 1) != 0, upper = (index & 2) != 0;
    return penumbra_rect2(vec2(right ? middle.x : box.min.x, upper ? middle.y : box.min.y),
                          vec2(right ? box.max.x : middle.x, upper ? box.max.y : middle.y));
}

// Where the ends of an edge come to lie in v when its u is limited to [low, high], from the first end; limits that the
// edge does not reach give its nearest end.
vec2 penumbra_limited_ends(float u0, float v0, float u1, float v1, float low, float high) {
    float at0 = penumbra_clamp(u0, low, high), at1 = penumbra_clamp(u1, low, high), run = u1 - u0;
    float t0 = penumbra_saturate(penumbra_safe_ratio(at0 - u0, run, 0.0f));
    float t1 = penumbra_saturate(penumbra_safe_ratio(at1 - u0, run, 0.0f));
    return vec2(at0 == u0 ? v0 : v0 + t0 * (v1 - v0), at1 == u1 ? v1 : v0 + t1 * (v1 - v0));
}

// 1 for an edge that crosses the column at x leftwards, -1 rightwards.
int penumbra_column_crossing(float ax, float bx, float x) { return (ax > x ? 1 : 0) - (bx > x ? 1 : 0); }

// Takes the edges of one silhouette on the light's plane in any order and gives what it blocks of one part. The
// outermost 16 ULP of the part's size are taken for its border, along which nothing counts.
struct penumbra_RadialPartBuilder {
    penumbra_Rect2 box;     // the part on the light's plane, any unit
    penumbra_Rect2 inside;  // without its border
    float area;             // signed, that unit squared
    vec2 moment;            // about box.min
    penumbra_Rect2 rect;    // around the edges inside
    ivec4 winding;          // around the corners of `inside`, in penumbra_quadrant's order
};

penumbra_RadialPartBuilder penumbra_radial_part_builder(penumbra_Rect2 part_box) {
    penumbra_RadialPartBuilder builder;
    float border = 1.9073486328125e-6f;
    vec2 margin = vec2((part_box.max.x - part_box.min.x) * border, (part_box.max.y - part_box.min.y) * border);
    builder.box = part_box;
    builder.inside = penumbra_rect2(part_box.min + margin, part_box.max - margin);
    builder.area = 0.0f;
    builder.moment = vec2(0.0f, 0.0f);
    builder.rect = penumbra_empty_rect();
    builder.winding = ivec4(0, 0, 0, 0);
    return builder;
}

// With the edge from a to b `weight` times, reversed if that is negative. All edges together are loops that run
// counter-clockwise around what they block, or what is left of such when they are cut to the columns of the light's box
// or of the part. Domain: |coordinates| <= 1e18, sides of the box in [1e-12, 1e12].
penumbra_RadialPartBuilder penumbra_add(penumbra_RadialPartBuilder builder, vec2 a, vec2 b, int weight) {
    penumbra_Rect2 box = builder.box, inside = builder.inside;
    float times = float(weight);
    penumbra_CoverageMoments below = penumbra_edge_moments(a, b, box);
    builder.area += times * below.area;
    builder.moment.x += times * below.x;
    builder.moment.y += times * below.y;
    // from the nearer end; the same for the reversed edge, bit for bit
    vec2 middle = vec2((box.min.x + box.max.x) * 0.5f, (box.min.y + box.max.y) * 0.5f);
    float far_a = abs(a.x - middle.x) + abs(a.y - middle.y);
    float far_b = abs(b.x - middle.x) + abs(b.y - middle.y);
    bool forward = far_a == far_b ? a.x < b.x || (a.x == b.x && a.y < b.y) : far_a < far_b;
    vec2 p = forward ? a : b;
    vec2 q = forward ? b : a;
    vec2 y = penumbra_limited_ends(p.x, p.y, q.x, q.y, inside.min.x, inside.max.x);
    vec2 x = penumbra_limited_ends(p.y, p.x, q.y, q.x, inside.min.y, inside.max.y);
    penumbra_Rect2 limited = penumbra_rect2(vec2(min(x.x, x.y), min(y.x, y.y)), vec2(max(x.x, x.y), max(y.x, y.y)));
    penumbra_Rect2 meet = penumbra_intersect(limited, inside);
    if (weight != 0 && meet.min.x <= meet.max.x && meet.min.y <= meet.max.y)
        builder.rect = penumbra_extend(penumbra_extend(builder.rect, meet.min), meet.max);
    float y_left = p.x < q.x ? y.x : y.y, y_right = p.x < q.x ? y.y : y.x;
    int left = weight * penumbra_column_crossing(a.x, b.x, inside.min.x);
    int right = weight * penumbra_column_crossing(a.x, b.x, inside.max.x);
    builder.winding.x += y_left > inside.min.y ? left : 0;
    builder.winding.y += y_right > inside.min.y ? right : 0;
    builder.winding.z += y_left > inside.max.y ? left : 0;
    builder.winding.w += y_right > inside.max.y ? right : 0;
    return builder;
}

// What the silhouette blocks of the part: exactly the empty or the full part if no edge comes inside. What the loops
// wind around twice counts twice, up to the area of the rectangle. Empty for a box without area, and for clockwise
// loops.
penumbra_RadialPart penumbra_finish(penumbra_RadialPartBuilder builder) {
    penumbra_Rect2 box = builder.box, inside = builder.inside, rect = builder.rect;
    ivec4 winding = builder.winding;
    vec2 size = vec2(box.max.x - box.min.x, box.max.y - box.min.y);
    if (!(size.x >= PENUMBRA_SMALLEST && size.y >= PENUMBRA_SMALLEST && builder.area > 0.0f))
        return penumbra_empty_part();
    if (!(rect.min.x <= rect.max.x)) {
        if (winding.x > 0) return penumbra_full_part();
        return penumbra_empty_part();
    }
    bool left = winding.x != 0 || winding.z != 0 || rect.min.x <= inside.min.x;
    bool right = winding.y != 0 || winding.w != 0 || rect.max.x >= inside.max.x;
    bool lower = winding.x != 0 || winding.y != 0 || rect.min.y <= inside.min.y;
    bool upper = winding.z != 0 || winding.w != 0 || rect.max.y >= inside.max.y;
    penumbra_RadialPart part;
    part.rect.min.x = left ? 0.0f : penumbra_saturated_ratio(rect.min.x - box.min.x, size.x);
    part.rect.min.y = lower ? 0.0f : penumbra_saturated_ratio(rect.min.y - box.min.y, size.y);
    part.rect.max.x = right ? 1.0f : penumbra_saturated_ratio(rect.max.x - box.min.x, size.x);
    part.rect.max.y = upper ? 1.0f : penumbra_saturated_ratio(rect.max.y - box.min.y, size.y);
    part.area = builder.area / size.x / size.y;
    part.moment =
        vec2(builder.moment.x / size.x / size.x / size.y, builder.moment.y / size.y / size.x / size.y);
    return penumbra_valid_part(part);
}

#endif
