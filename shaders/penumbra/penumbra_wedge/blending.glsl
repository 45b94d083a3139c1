// From the edges that matter to a point to what all silhouettes block together, by any rule.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_OVERLAP  how what several meshes block combines; PENUMBRA_OVERLAP_EXACT (default),
//                                           _ADDITIVE, _MAXIMUM, _PRODUCT, _PRODUCT_QUADRANTS, _RECTANGLES,
//                                           _RECTANGLES_CENTROID, _RECTANGLE_PRODUCT or _BITMASK
// Error:   that of the method
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/blending.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_BLENDING_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_BLENDING_GLSL

#include "../combine.glsl"
#include "overlap.glsl"
#include "union_blending.glsl"

#define PENUMBRA_OVERLAP_ADDITIVE 0
#define PENUMBRA_OVERLAP_MAXIMUM 1
#define PENUMBRA_OVERLAP_PRODUCT 2
#define PENUMBRA_OVERLAP_PRODUCT_QUADRANTS 3
#define PENUMBRA_OVERLAP_RECTANGLES 4
#define PENUMBRA_OVERLAP_RECTANGLES_CENTROID 5
#define PENUMBRA_OVERLAP_RECTANGLE_PRODUCT 6
#define PENUMBRA_OVERLAP_BITMASK 7
#define PENUMBRA_OVERLAP_EXACT 8

#ifndef PENUMBRA_PENUMBRA_WEDGE_OVERLAP
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_EXACT
#endif

#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
#define PENUMBRA_WEDGE_PARTS 4
#else
#define PENUMBRA_WEDGE_PARTS 1
#endif

// A part of the light that is looked at by itself.
penumbra_Rect2 penumbra_light_part(penumbra_Rect2 light, int part) {
#if PENUMBRA_WEDGE_PARTS == 1
    return light;
#else
    return penumbra_quadrant(light, part);
#endif
}

// By what each mesh blocks: of the whole light, or of each quadrant.
float penumbra_blend_by_areas(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p, int rule) {
    float areas[PENUMBRA_WEDGE_PARTS];
    penumbra_OcclusionAccumulator all[PENUMBRA_WEDGE_PARTS];
    for (int part = 0; part < PENUMBRA_WEDGE_PARTS; ++part) {
        areas[part] = 0.0f;
        all[part] = penumbra_no_occlusion();
    }
    penumbra_WedgeCursor c = penumbra_first_edge();
    do {
        c = penumbra_next_edge(wedges, info, p, PENUMBRA_WEDGE_MESH, c);
        for (int part = 0; part < PENUMBRA_WEDGE_PARTS; ++part) {
            penumbra_Rect2 box = penumbra_light_part(p.light, part);
            if (c.found == PENUMBRA_WEDGE_EDGE) {
                areas[part] += c.coefficient * penumbra_edge_coverage(c.from, c.to, box);
            } else if (c.found == PENUMBRA_WEDGE_GROUP) {
                float unit = 1.0f / penumbra_area(box);
                all[part] = penumbra_add(all[part], penumbra_saturate(penumbra_settle(areas[part] * unit)));
                areas[part] = 0.0f;
            }
        }
    } while (c.found != PENUMBRA_WEDGE_NOTHING);
    float sum = 0.0f;
    for (int part = 0; part < PENUMBRA_WEDGE_PARTS; ++part) sum += penumbra_result(all[part], rule);
    return sum / float(PENUMBRA_WEDGE_PARTS);
}

// By a rectangle around what each mesh blocks of each quadrant: one mesh after the other.
float penumbra_blend_by_rectangles(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p) {
    penumbra_RadialPartBuilder builders[4];
    penumbra_RadialPart all[4];
    for (int q = 0; q < 4; ++q) {
        builders[q] = penumbra_radial_part_builder(penumbra_quadrant(p.light, q));
        all[q] = penumbra_empty_part();
    }
    penumbra_WedgeCursor c = penumbra_first_edge();
    do {
        c = penumbra_next_edge(wedges, info, p, PENUMBRA_WEDGE_MESH, c);
        for (int q = 0; q < 4; ++q) {
            if (c.found == PENUMBRA_WEDGE_EDGE) {
                builders[q] = penumbra_add(builders[q], c.from, c.to, int(c.coefficient));
            } else if (c.found == PENUMBRA_WEDGE_GROUP) {
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_RECTANGLES_CENTROID
                all[q] = penumbra_blend_centroid(all[q], penumbra_finish(builders[q]));
#else
                all[q] = penumbra_blend(all[q], penumbra_finish(builders[q]));
#endif
                builders[q] = penumbra_radial_part_builder(penumbra_quadrant(p.light, q));
            }
        }
    } while (c.found != PENUMBRA_WEDGE_NOTHING);
    float sum = 0.0f;
    for (int q = 0; q < 4; ++q) sum += all[q].area;
    return penumbra_saturate(penumbra_settle(0.25f * sum));
}

#define PENUMBRA_WEDGE_ALL_CELLS (PENUMBRA_PENUMBRA_WEDGE_CELLS * PENUMBRA_PENUMBRA_WEDGE_CELLS)

// The same in any order: a RectangleProduct of each quadrant, all in one array, since drivers copy arrays that
// functions take and return.
float penumbra_blend_by_rectangle_product(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p) {
    penumbra_RadialPartBuilder builders[4];
    float transmission[4 * PENUMBRA_WEDGE_ALL_CELLS];
    float total[4];
    float largest[4];
    for (int q = 0; q < 4; ++q) {
        builders[q] = penumbra_radial_part_builder(penumbra_quadrant(p.light, q));
        total[q] = 0.0f;
        largest[q] = 0.0f;
    }
    for (int k = 0; k < 4 * PENUMBRA_WEDGE_ALL_CELLS; ++k) transmission[k] = 1.0f;
    penumbra_WedgeCursor c = penumbra_first_edge();
    do {
        c = penumbra_next_edge(wedges, info, p, PENUMBRA_WEDGE_MESH, c);
        for (int q = 0; q < 4; ++q) {
            if (c.found == PENUMBRA_WEDGE_EDGE) {
                builders[q] = penumbra_add(builders[q], c.from, c.to, int(c.coefficient));
            } else if (c.found == PENUMBRA_WEDGE_GROUP) {
                penumbra_RadialPart part = penumbra_finish(builders[q]);
                float density = penumbra_saturated_ratio(part.area, penumbra_area(part.rect));
                int cells = part.area > 0.0f ? PENUMBRA_WEDGE_ALL_CELLS : 0;
                for (int k = 0; k < cells; ++k)
                    transmission[q * PENUMBRA_WEDGE_ALL_CELLS + k] *=
                        penumbra_cell_transmission(part, density, 0.0f, 0.0f, k);
                total[q] += part.area;
                largest[q] = max(largest[q], part.area);
                builders[q] = penumbra_radial_part_builder(penumbra_quadrant(p.light, q));
            }
        }
    } while (c.found != PENUMBRA_WEDGE_NOTHING);
    float sum = 0.0f;
    for (int q = 0; q < 4; ++q) {
        float part_sum = 0.0f;
        for (int k = 0; k < PENUMBRA_WEDGE_ALL_CELLS; ++k) part_sum += transmission[q * PENUMBRA_WEDGE_ALL_CELLS + k];
        sum += penumbra_product_area(part_sum, total[q], largest[q]);
    }
    return penumbra_saturate(penumbra_settle(0.25f * sum));
}

// What all casters together block of the light from a point, in [0, 1].
float penumbra_blend(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p) {
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP >= PENUMBRA_OVERLAP_BITMASK
    return penumbra_blend_silhouettes(wedges, info, p, PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_EXACT);
#elif PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_RECTANGLE_PRODUCT
    return penumbra_blend_by_rectangle_product(wedges, info, p);
#elif PENUMBRA_PENUMBRA_WEDGE_OVERLAP >= PENUMBRA_OVERLAP_RECTANGLES
    return penumbra_blend_by_rectangles(wedges, info, p);
#elif PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_ADDITIVE
    return penumbra_blend_by_areas(wedges, info, p, PENUMBRA_COMBINATION_SUM);
#elif PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_MAXIMUM
    return penumbra_blend_by_areas(wedges, info, p, PENUMBRA_COMBINATION_MAX);
#else
    return penumbra_blend_by_areas(wedges, info, p, PENUMBRA_COMBINATION_PRODUCT);
#endif
}

#endif
