// What several silhouettes block of a radial part together, when of each only an area, a centre of gravity and a
// bounding rectangle are known.
//
// Every rule here spreads a silhouette over its rectangle and takes overlaps as random from there on: evenly, or
// leaning to its centre of gravity, one silhouette after the other; or all at once, in any order. Parts are in part
// coordinates.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_CELLS  8   cells along each side of a RectangleProduct
// Error:   overlaps 6.5 ULP, blended areas 2 ULP, RectangleProduct 2 PENUMBRA_PENUMBRA_WEDGE_CELLS ULP of 1; beside
//          what the model errs.
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006; the limits,
//          the centres of gravity and the product are ours.
// C++:     include/penumbra/penumbra_wedge/overlap.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_OVERLAP_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP_GLSL

#include "../geometry.glsl"
#include "radial_part.glsl"

#ifndef PENUMBRA_PENUMBRA_WEDGE_CELLS
#define PENUMBRA_PENUMBRA_WEDGE_CELLS 8
#endif

// The area that a and b block both, if each blocks its rectangle evenly; at most either area; 0 if either is empty. The
// same for (b, a).
float penumbra_overlap_area(penumbra_RadialPart a, penumbra_RadialPart b) {
    float least = a.area < b.area ? a.area : b.area;
    float density = penumbra_saturated_ratio(a.area, penumbra_area(a.rect)) *
                    penumbra_saturated_ratio(b.area, penumbra_area(b.rect));
    return penumbra_clamp(penumbra_area(penumbra_intersect(a.rect, b.rect)) * density, 0.0f, least);
}

// How much denser a part is towards the ends of [low, high] than evenly, along one axis: the density goes from 1 - lean
// to 1 + lean.
float penumbra_lean(float moment, float area, float low, float high) {
    float centre = penumbra_saturated_ratio(moment - area * low, area * (high - low));
    return penumbra_clamp(6.0f * centre - 3.0f, -1.0f, 1.0f);
}

// A density within [from, to]: at its middle, and how much more at its end.
vec2 penumbra_density_within(float low, float high, float lean, float from, float to) {
    float size = high - low;
    float at = penumbra_saturated_ratio(0.5f * (from + to) - low, size);
    float share = penumbra_saturated_ratio(to - from, size);
    return vec2(1.0f + lean * (2.0f * at - 1.0f), lean * share);
}

// What the product of two densities has along an interval: its mean, and its centre of gravity, -1 to 1.
vec2 penumbra_common_density(vec2 a, vec2 b) {
    float mean = a.x * b.x + a.y * b.y / 3.0f;
    float first = (a.x * b.y + b.x * a.y) / 3.0f;
    return vec2(mean, penumbra_clamp(penumbra_safe_ratio(first, mean, 0.0f), -1.0f, 1.0f));
}

// What two parts block both: its area and its centre of gravity.
struct penumbra_CommonArea {
    float area;
    vec2 centre;
};

penumbra_CommonArea penumbra_common_area_centroid(penumbra_RadialPart a, penumbra_RadialPart b) {
    penumbra_Rect2 r = penumbra_intersect(a.rect, b.rect);
    float lean_ax = penumbra_lean(a.moment.x, a.area, a.rect.min.x, a.rect.max.x);
    float lean_ay = penumbra_lean(a.moment.y, a.area, a.rect.min.y, a.rect.max.y);
    float lean_bx = penumbra_lean(b.moment.x, b.area, b.rect.min.x, b.rect.max.x);
    float lean_by = penumbra_lean(b.moment.y, b.area, b.rect.min.y, b.rect.max.y);
    vec2 x = penumbra_common_density(
        penumbra_density_within(a.rect.min.x, a.rect.max.x, lean_ax, r.min.x, r.max.x),
        penumbra_density_within(b.rect.min.x, b.rect.max.x, lean_bx, r.min.x, r.max.x));
    vec2 y = penumbra_common_density(
        penumbra_density_within(a.rect.min.y, a.rect.max.y, lean_ay, r.min.y, r.max.y),
        penumbra_density_within(b.rect.min.y, b.rect.max.y, lean_by, r.min.y, r.max.y));
    float least = a.area < b.area ? a.area : b.area;
    float even = penumbra_area(r) * (penumbra_saturated_ratio(a.area, penumbra_area(a.rect)) *
                                     penumbra_saturated_ratio(b.area, penumbra_area(b.rect)));
    penumbra_CommonArea meet;
    meet.area = penumbra_clamp(even * (x.x * y.x), 0.0f, least);
    meet.centre = (r.min + r.max) * 0.5f + (r.max - r.min) * (vec2(x.y, y.y) * 0.5f);
    return meet;
}

// Both, less what both block: `overlap` with the moments `overlap_moment`.
penumbra_RadialPart penumbra_unite(penumbra_RadialPart a, penumbra_RadialPart b, float overlap,
                                    vec2 overlap_moment) {
    float most = a.area > b.area ? a.area : b.area, least = a.area > b.area ? b.area : a.area;
    if (!(least > 0.0f)) {
        if (a.area > b.area) return a;
        return b;
    }
    penumbra_RadialPart result;
    result.rect = penumbra_rect2(min(a.rect.min, b.rect.min), max(a.rect.max, b.rect.max));
    float whole = penumbra_area(result.rect);
    result.area = penumbra_clamp(most + (least - overlap), most, whole > most ? whole : most);
    vec2 low = result.rect.min * result.area;
    vec2 high = result.rect.max * result.area;
    vec2 moment = (a.moment + b.moment) - overlap_moment;
    result.moment = vec2(penumbra_clamp(moment.x, low.x, high.x), penumbra_clamp(moment.y, low.y, high.y));
    return result;
}

// What a and b block together: the sum of their areas less penumbra_overlap_area, in the rectangle around both.
// max(A_a, A_b) <= area <= min(A_a + A_b, |R|, 1), |R| being that rectangle's area; the empty part changes nothing, the
// full part absorbs everything. Silhouettes are blended one after the other: rectangles grow, so their order matters.
penumbra_RadialPart penumbra_blend(penumbra_RadialPart a, penumbra_RadialPart b) {
    penumbra_Rect2 meet = penumbra_intersect(a.rect, b.rect);
    float overlap = penumbra_overlap_area(a, b);
    return penumbra_unite(a, b, overlap, (meet.min + meet.max) * (0.5f * overlap));
}

// penumbra_overlap_area with densities that change linearly over each rectangle, so that centres of gravity are right.
float penumbra_overlap_area_centroid(penumbra_RadialPart a, penumbra_RadialPart b) {
    return penumbra_common_area_centroid(a, b).area;
}

// penumbra_blend with penumbra_overlap_area_centroid, keeping the blended part's centre of gravity.
penumbra_RadialPart penumbra_blend_centroid(penumbra_RadialPart a, penumbra_RadialPart b) {
    penumbra_CommonArea meet = penumbra_common_area_centroid(a, b);
    return penumbra_unite(a, b, meet.area, meet.centre * meet.area);
}

// What any number of silhouettes block together if each blocks its rectangle as at random, on cells that take the share
// of each that a rectangle covers. No order, fixed memory; exact for rectangles that end on cells' borders.
struct penumbra_RectangleProduct {
    // product of 1 - share blocked of each cell, row by row
    float transmission[PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS];
    float total;    // sum of areas, not clamped
    float largest;  // largest area
};

penumbra_RectangleProduct penumbra_no_rectangles() {
    penumbra_RectangleProduct product;
    for (int k = 0; k < PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS; ++k)
        product.transmission[k] = 1.0f;
    product.total = 0.0f;
    product.largest = 0.0f;
    return product;
}

// How much of a part lies in column or row k of cells, in units of a cell that it fills.
float penumbra_along(float low, float high, float lean, int k) {
    float size = 1.0f / float(PENUMBRA_PENUMBRA_WEDGE_CELLS);
    float from = penumbra_clamp(low, float(k) * size, float(k + 1) * size);
    float to = penumbra_clamp(high, float(k) * size, float(k + 1) * size);
    float middle = penumbra_saturated_ratio(0.5f * (from + to) - low, high - low);
    return (to - from) * float(PENUMBRA_PENUMBRA_WEDGE_CELLS) * (1.0f + lean * (2.0f * middle - 1.0f));
}

// What a part leaves of a cell, as a share.
float penumbra_cell_transmission(penumbra_RadialPart part, float density, float lean_x, float lean_y, int cell) {
    int j = cell / PENUMBRA_PENUMBRA_WEDGE_CELLS;
    float row = penumbra_along(part.rect.min.y, part.rect.max.y, lean_y, j);
    float column =
        penumbra_along(part.rect.min.x, part.rect.max.x, lean_x, cell - PENUMBRA_PENUMBRA_WEDGE_CELLS * j);
    return 1.0f - penumbra_saturate(density * row * column);
}

penumbra_RectangleProduct penumbra_multiply(penumbra_RectangleProduct product, penumbra_RadialPart part, float lean_x,
                                            float lean_y) {
    float density = penumbra_saturated_ratio(part.area, penumbra_area(part.rect));
    int cells = part.area > 0.0f ? PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS : 0;
    for (int k = 0; k < cells; ++k)
        product.transmission[k] *= penumbra_cell_transmission(part, density, lean_x, lean_y, k);
    product.total += part.area;
    product.largest = part.area > product.largest ? part.area : product.largest;
    return product;
}

// With a silhouette more that blocks its rectangle evenly.
penumbra_RectangleProduct penumbra_add(penumbra_RectangleProduct product, penumbra_RadialPart part) {
    return penumbra_multiply(product, part, 0.0f, 0.0f);
}

// With a silhouette more whose density leans to its centre of gravity.
penumbra_RectangleProduct penumbra_add_centroid(penumbra_RectangleProduct product, penumbra_RadialPart part) {
    return penumbra_multiply(product, part,
                             penumbra_lean(part.moment.x, part.area, part.rect.min.x, part.rect.max.x),
                             penumbra_lean(part.moment.y, part.area, part.rect.min.y, part.rect.max.y));
}

// The area that all block, from the sum of the cells' transmission.
float penumbra_product_area(float transmission, float total, float largest) {
    float cells = float(PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS);
    return penumbra_clamp(1.0f - transmission / cells, penumbra_saturate(largest), penumbra_saturate(total));
}

// The area that all block: in [largest, min(1, total)]; 0 if nothing was added.
float penumbra_area(penumbra_RectangleProduct product) {
    float sum = 0.0f;
    for (int k = 0; k < PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS; ++k)
        sum += product.transmission[k];
    return penumbra_product_area(sum, product.total, product.largest);
}

#endif
