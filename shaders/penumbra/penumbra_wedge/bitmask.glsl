// Where on the light a silhouette blocks, cell by cell.
//
// The light's box has up to 32 x 32 cells; a column of cells is one word, its lowest cell the lowest bit. An edge
// raises or lowers the winding number of all cells whose middle lies below it, as edge_coverage does with areas.
// Winding numbers are kept for a column's 32 cells at once, as four words of binary digits, modulo 16, and a cell is
// blocked where its number is not 0. Masks of several silhouettes unite by "or", and then say how much of the sum of
// exact areas to believe.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE  cells along each side of a mask: 8, 16 or 32 (default)
// Error:   exact, but for cells whose middle lies within 8 ULP of the box's size of an edge
// C++:     include/penumbra/penumbra_wedge/bitmask.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_BITMASK_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_BITMASK_GLSL

#include "coverage.glsl"

#ifndef PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE
#define PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE 32
#endif

// The number of bits that are set.
int penumbra_count_bits(uint word) {
    word = word - ((word >> 1u) & 0x55555555u);
    word = (word & 0x33333333u) + ((word >> 2u) & 0x33333333u);
    word = (word + (word >> 4u)) & 0x0f0f0f0fu;
    return int((word * 0x01010101u) >> 24u);
}

// The `count` lowest bits, 0 to 32.
uint penumbra_low_bits(int count) { return count > 0 ? (2u << uint(count - 1)) - 1u : 0u; }

// Winding numbers of 32 cells, modulo 16: one word for each binary digit.
struct penumbra_WindingColumn {
    uint ones, twos, fours, eights;
};

penumbra_WindingColumn penumbra_empty_column() {
    penumbra_WindingColumn column;
    column.ones = 0u;
    column.twos = 0u;
    column.fours = 0u;
    column.eights = 0u;
    return column;
}

// With 1 more at each of `cells`, or 1 less. Exact modulo 16.
penumbra_WindingColumn penumbra_add_winding(penumbra_WindingColumn column, uint cells, bool less) {
    uint flip = less ? 0xffffffffu : 0u;  // a digit borrows where it is 0, and carries where it is 1
    uint to_twos = (column.ones ^ flip) & cells;
    uint to_fours = (column.twos ^ flip) & to_twos;
    uint to_eights = (column.fours ^ flip) & to_fours;
    column.ones ^= cells;
    column.twos ^= to_twos;
    column.fours ^= to_fours;
    column.eights ^= to_eights;
    return column;
}

// The cells whose winding number is not 0.
uint penumbra_wound_cells(penumbra_WindingColumn column) {
    return column.ones | column.twos | column.fours | column.eights;
}

// The sum of all 32 winding numbers, each from -8 to 7.
int penumbra_winding_sum(penumbra_WindingColumn column) {
    return penumbra_count_bits(column.ones) + 2 * penumbra_count_bits(column.twos) +
           4 * penumbra_count_bits(column.fours) - 8 * penumbra_count_bits(column.eights);
}

// An edge on its way across columns, left to right: y at x is left_y + (x - left_x) slope.
struct penumbra_ColumnLine {
    float left_x, right_x, left_y, slope;
    bool rightward;
};

penumbra_ColumnLine penumbra_column_line(penumbra_ColumnEdge e) {
    bool ascends = e.x0 < e.x1;
    penumbra_ColumnLine line;
    line.left_x = ascends ? e.x0 : e.x1;
    line.left_y = ascends ? e.y0 : e.y1;
    line.right_x = ascends ? e.x1 : e.x0;
    float right_y = ascends ? e.y1 : e.y0;
    line.slope = (right_y - line.left_y) / penumbra_divisor(line.right_x - line.left_x);
    line.rightward = ascends == (e.sign > 0.0f);
    return line;
}

// The first of `size` columns whose middle is at x or to the right of it; `size` if none is.
int penumbra_first_column(float x, penumbra_Rect2 box, int size) {
    float columns = float(size) / (box.max.x - box.min.x);
    return int(penumbra_clamp((x - box.min.x) * columns + 0.5f, 0.0f, float(size)));
}

// Of that column's `size` cells, those whose middle lies below the line.
uint penumbra_cells_below(penumbra_ColumnLine line, int column, penumbra_Rect2 box, int size) {
    float x = box.min.x + (float(column) + 0.5f) * ((box.max.x - box.min.x) / float(size));
    float y = line.left_y + (x - line.left_x) * line.slope;
    float cells = float(size) / (box.max.y - box.min.y);
    return penumbra_low_bits(int(penumbra_clamp((y - box.min.y) * cells + 0.5f, 0.0f, float(size))));
}

// Winding numbers over a box. Box and edges share a plane's coordinates.
struct penumbra_WindingMask {
    penumbra_WindingColumn columns[PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE];
};

penumbra_WindingMask penumbra_empty_mask() {
    penumbra_WindingMask mask;
    for (int column = 0; column < PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE; ++column)
        mask.columns[column] = penumbra_empty_column();
    return mask;
}

// With an edge from a to b, `weight` times; over a closed loop that runs counter-clockwise, 1 for each cell whose
// middle is inside. Domain: |coordinates| <= 1e18, a box with an area.
penumbra_WindingMask penumbra_add(penumbra_WindingMask mask, vec2 a, vec2 b, int weight, penumbra_Rect2 box) {
    int size = PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE;
    penumbra_ColumnLine line = penumbra_column_line(penumbra_column_edge(a, b, box));
    bool less = line.rightward == (weight > 0);
    int end = penumbra_first_column(line.right_x, box, size);
    for (int column = penumbra_first_column(line.left_x, box, size); column < end; ++column) {
        uint cells = penumbra_cells_below(line, column, box, size);
        penumbra_WindingColumn winding = mask.columns[column];
        for (int k = abs(weight); k > 0; --k) winding = penumbra_add_winding(winding, cells, less);
        mask.columns[column] = winding;
    }
    return mask;
}

// The number of cells whose winding number is not 0.
int penumbra_wound(penumbra_WindingMask mask) {
    int sum = 0;
    for (int column = 0; column < PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE; ++column)
        sum += penumbra_count_bits(penumbra_wound_cells(mask.columns[column]));
    return sum;
}

// The sum of all winding numbers, each from -8 to 7.
int penumbra_sum(penumbra_WindingMask mask) {
    int sum = 0;
    for (int column = 0; column < PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE; ++column)
        sum += penumbra_winding_sum(mask.columns[column]);
    return sum;
}

// What several silhouettes block together, from their exact areas and from where their masks lie.
struct penumbra_MaskedOcclusion {
    float occlusion;  // of all so far, in [0, 1]
    float total;      // the sum of each for itself
    int united;       // cells that are blocked
};

penumbra_MaskedOcclusion penumbra_no_masked_occlusion() {
    penumbra_MaskedOcclusion sum;
    sum.occlusion = 0.0f;
    sum.total = 0.0f;
    sum.united = 0;
    return sum;
}

// With a silhouette that by its edges blocks `area`, a fraction of the light in which what it covers twice counts
// twice, and by its mask `wound` of `all` cells, with winding numbers that sum up to `winding`; `fresh` of them were
// not blocked before. It counts with the fresh share of its area: never brightens, stays between the largest and the
// sum, exact where nothing overlaps.
penumbra_MaskedOcclusion penumbra_add(penumbra_MaskedOcclusion sum, float area, int wound, int winding, int fresh,
                                      int all) {
    float blocked = area;
    if (winding != wound) {  // it lies over itself: the mask says how much
        float share = float(wound) / float(winding > 0 ? winding : all);
        blocked = wound == all ? 1.0f : (winding > 0 ? area * share : share);
    }
    blocked = penumbra_saturate(blocked);
    sum.total += blocked;
    sum.united += fresh;
    float more = wound > 0 ? blocked * (float(fresh) / float(wound)) : blocked;
    float upper = penumbra_saturate(sum.total);
    float lower = sum.occlusion > blocked ? sum.occlusion : blocked;
    bool full = sum.united == all && upper == 1.0f;
    sum.occlusion = full ? 1.0f : penumbra_clamp(sum.occlusion + more, lower, upper);
    return sum;
}

#endif
