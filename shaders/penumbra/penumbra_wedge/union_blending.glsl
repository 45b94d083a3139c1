// What all silhouettes block together: exactly by their edges or by masks, where intervals do not say it already.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_TOLERANCE  overlaps are left out where they can change visibility by no more, 0
//                                             (default) to 1; by masks half a cell in any case
//          PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES: see edge_union.glsl
//          PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE: see bitmask.glsl
// Error:   that of the method; decides as the C++ where the rounding of divisions is the same, and where a point has
//          more edges than fit here, but not there, that of masks
// C++:     include/penumbra/penumbra_wedge/union_blending.hpp
//          with what it stands on: interval_blending.hpp and mask_blending.hpp beside it
#ifndef PENUMBRA_PENUMBRA_WEDGE_UNION_BLENDING_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_UNION_BLENDING_GLSL

#include "bitmask.glsl"
#include "edge_union.glsl"
#include "tile_sums.glsl"
#include "wedge_index.glsl"

#ifndef PENUMBRA_PENUMBRA_WEDGE_TOLERANCE
#define PENUMBRA_PENUMBRA_WEDGE_TOLERANCE 0.0f
#endif

// How many pieces are told apart by where they are.
#define PENUMBRA_WEDGE_KEPT 23

// A piece's rectangle, limited to the light. Edges to the left, to the right and below are not found: where the piece's
// box may reach there, so does the rectangle.
penumbra_Rect2 penumbra_include_hidden_edges(penumbra_WedgePoint p, penumbra_Box3 box, penumbra_Rect2 rect) {
    float depth = p.point.z;
    if (box.max.z >= depth) return p.light;
    float near = depth / (depth - min(box.min.z, 0.5f * depth));
    float far = depth / (depth - box.max.z);
    float left = p.point.x + min((box.min.x - p.point.x) * near, (box.min.x - p.point.x) * far);
    float right = p.point.x + max((box.max.x - p.point.x) * near, (box.max.x - p.point.x) * far);
    float bottom = p.point.y + min((box.min.y - p.point.y) * near, (box.min.y - p.point.y) * far);
    if (left < p.light.min.x) rect.min.x = p.light.min.x;
    if (right > p.light.max.x) rect.max.x = p.light.max.x;
    if (bottom < p.light.min.y) rect.min.y = p.light.min.y;
    if (rect.max.y > p.light.max.y) rect.max.y = p.light.max.y;
    return rect;
}

// What the way through the tree is for.
#define PENUMBRA_WEDGE_BY_INTERVALS 0
#define PENUMBRA_WEDGE_BY_EDGES 1
#define PENUMBRA_WEDGE_BY_MASKS 2

// What all pieces together block of the light, in [0, 1]: exactly, or by masks.
//
// The first way through the tree gives an interval in which the truth lies, from the exact area of each piece and from
// a rectangle around it: two pieces overlap by no more than their rectangles do. Where it is wider than rounding (by
// masks than half a cell) and than the tolerance either way, or a piece may lie over itself, the second way keeps the
// edges, or adds masks; where not all edges fit, a third one adds masks. All are one loop in one function: what it
// calls is large, and drivers copy arrays that functions take and return.
float penumbra_blend_silhouettes(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p,
                                 bool exactly) {
    int size = PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE;
    float least = max(exactly ? 3.814697265625e-06f : 0.5f / float(size * size),
                      2.0f * PENUMBRA_PENUMBRA_WEDGE_TOLERANCE);
    float unit = 1.0f / penumbra_area(p.light);
    // the piece at hand
    float sum = 0.0f;
    penumbra_Rect2 rect = penumbra_empty_rect();
    int first = size, end = 0;
    penumbra_WindingColumn columns[PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE];
    // all pieces
    float areas[PENUMBRA_WEDGE_KEPT];
    vec4 rects[PENUMBRA_WEDGE_KEPT];  // min and max
    areas[0] = 0.0f;  // drivers warn of what is never read before it is set
    rects[0] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    int kept = 0;
    float total = 0.0f, largest = 0.0f, overlap = 0.0f, lower = 0.0f, upper = 0.0f;
    bool folds = false;
    penumbra_EdgeUnion all;
    all.count = 0;
    all.pieces = 0;
    bool is_new = true;
    uint united[PENUMBRA_PENUMBRA_WEDGE_BITMASK_SIZE];
    penumbra_MaskedOcclusion masked = penumbra_no_masked_occlusion();
    int way = PENUMBRA_WEDGE_BY_INTERVALS;
    penumbra_WedgeCursor c = penumbra_first_edge();
    do {
        c = penumbra_next_edge(wedges, info, p, PENUMBRA_WEDGE_PIECE, c);
        int next_way = way;
        if (c.found == PENUMBRA_WEDGE_EDGE) {
            penumbra_ColumnEdge edge = penumbra_column_edge(c.from, c.to, p.light);
            if (way == PENUMBRA_WEDGE_BY_EDGES) {
                if (penumbra_is_over(edge, int(c.coefficient), p.light)) {
                    if (all.count < PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES) {
                        if (is_new) ++all.pieces;
                        is_new = false;
                        all.edges[all.count] = penumbra_union_edge(edge, int(c.coefficient), all.pieces);
                        ++all.count;
                    } else {
                        next_way = PENUMBRA_WEDGE_BY_MASKS;
                    }
                }
            } else {
                sum += c.coefficient * penumbra_covered_below(edge, p.light);
                rect = penumbra_extend(penumbra_extend(rect, c.from), c.to);
            }
            if (way == PENUMBRA_WEDGE_BY_MASKS) {
                penumbra_ColumnLine line = penumbra_column_line(edge);
                bool less = line.rightward == (c.coefficient > 0.0f);
                int line_first = penumbra_first_column(line.left_x, p.light, size);
                int line_end = penumbra_first_column(line.right_x, p.light, size);
                first = min(first, line_first);
                end = max(end, line_end);
                for (int k = line_first; k < line_end; ++k) {
                    uint cells = penumbra_cells_below(line, k, p.light, size);
                    penumbra_WindingColumn winding = columns[k];
                    for (int times = abs(int(c.coefficient)); times > 0; --times)
                        winding = penumbra_add_winding(winding, cells, less);
                    columns[k] = winding;
                }
            }
        } else if (c.found == PENUMBRA_WEDGE_GROUP && way == PENUMBRA_WEDGE_BY_EDGES) {
            is_new = true;
        } else if (c.found == PENUMBRA_WEDGE_GROUP && way == PENUMBRA_WEDGE_BY_MASKS) {
            int wound = 0;
            int winding = 0;
            int fresh = 0;
            for (int k = first; k < end; ++k) {
                uint cells = penumbra_wound_cells(columns[k]);
                wound += penumbra_count_bits(cells);
                winding += penumbra_winding_sum(columns[k]);
                fresh += penumbra_count_bits(cells & ~united[k]);
                united[k] |= cells;
                columns[k] = penumbra_empty_column();
            }
            masked = penumbra_add(masked, penumbra_settle(sum * unit), wound, winding, fresh, size * size);
            sum = 0.0f;
            first = size;
            end = 0;
        } else if (c.found == PENUMBRA_WEDGE_GROUP) {
            float area = penumbra_saturate(penumbra_settle(sum * unit));
            vec4 low = penumbra_wedge_texel(wedges, c.group);
            vec4 high = penumbra_wedge_texel(wedges, c.group + 1);
            bool simple = (int(high.w) & PENUMBRA_WEDGE_SIMPLE) != 0;
            folds = folds || (!simple && penumbra_settle(abs(sum * unit)) > 0.0f);
            if (area > 0.0f) {
                rect = penumbra_include_hidden_edges(p, penumbra_box3(vec3(low), vec3(high)), rect);
                for (int k = 0; k < kept; ++k) {
                    penumbra_Rect2 other = penumbra_rect2(vec2(rects[k].x, rects[k].y), vec2(rects[k].z, rects[k].w));
                    float in_both = penumbra_area(penumbra_intersect(rect, other)) * unit;
                    overlap += min(in_both, min(area, areas[k]));
                }
                total += area;
                largest = max(largest, area);
                if (kept < PENUMBRA_WEDGE_KEPT) {
                    areas[kept] = area;
                    rects[kept] = vec4(rect.min, rect.max);
                    ++kept;
                } else {
                    overlap += area;  // nobody will know where this one is
                }
            }
            sum = 0.0f;
            rect = penumbra_empty_rect();
        } else if (way == PENUMBRA_WEDGE_BY_INTERVALS) {
            upper = penumbra_saturate(total);
            lower = penumbra_clamp(total - overlap, largest, upper);
            if (folds || upper - lower > least)
                next_way = exactly ? PENUMBRA_WEDGE_BY_EDGES : PENUMBRA_WEDGE_BY_MASKS;
        }
        if (next_way != way) {
            way = next_way;
            c = penumbra_first_edge();
            c.found = PENUMBRA_WEDGE_GROUP;  // not over
            for (int k = 0; way == PENUMBRA_WEDGE_BY_MASKS && k < size; ++k) {
                columns[k] = penumbra_empty_column();
                united[k] = 0u;
            }
        }
    } while (c.found != PENUMBRA_WEDGE_NOTHING);
    if (way == PENUMBRA_WEDGE_BY_INTERVALS) return 0.5f * (lower + upper);
    float occlusion = masked.occlusion;
    if (way == PENUMBRA_WEDGE_BY_EDGES)
        occlusion = penumbra_saturate(penumbra_settle(penumbra_area(all, p.light) / penumbra_area(p.light)));
    return penumbra_clamp(occlusion, folds ? 0.0f : lower, folds ? 1.0f : upper);
}

#endif
