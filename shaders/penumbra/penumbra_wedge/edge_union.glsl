// What several silhouettes cover together, exactly: a sweep over their edges.
//
// From left to right the light falls into strips without ends of edges and crossings. In a strip edges lie above each
// other in one order; going down, each begins or ends a silhouette, and is on the outline of all together where nothing
// else covers what is above or below it. What lies of the light below the outline, signed, is the area.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES  how many edges fit: 64 (default), at most 32767. 52 bytes each, in
//                                               arrays of the invocation
// Error:   1e-6 of the box's area for up to 20 pieces of 15 edges; bit for bit the C++ where the driver's division is
// C++:     include/penumbra/penumbra_wedge/edge_union.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_EDGE_UNION_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_EDGE_UNION_GLSL

#include "coverage.glsl"

#ifndef PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES
#define PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES 64
#endif

// An edge within the box's columns, left to right: y at x is y0 + (x - x0) slope.
struct penumbra_UnionEdge {
    float x0, y0, x1, slope;
    int piece;
    int weight;  // by how much the winding number is higher below than above
};

// The edges that matter to one point, in any order; pieces count from 1. Add edges in place, one that does not fit is
// lost: drivers copy arrays that functions take and return.
//     if (penumbra_is_over(edge, weight, box) && all.count < PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES) {
//         all.edges[all.count] = penumbra_union_edge(edge, weight, piece);
//         ++all.count;
//     }
struct penumbra_EdgeUnion {
    penumbra_UnionEdge edges[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];
    int count;
    int pieces;
};

// As an edge of a piece, one that counts `weight` times; closed loops that run counter-clockwise cover their inside.
// Domain: |coordinates| <= 1e18, a box with an area.
penumbra_UnionEdge penumbra_union_edge(penumbra_ColumnEdge e, int weight, int piece) {
    bool ascends = e.x0 < e.x1;
    bool leftward = ascends != (e.sign > 0.0f);
    penumbra_UnionEdge edge;
    edge.x0 = ascends ? e.x0 : e.x1;
    edge.y0 = ascends ? e.y0 : e.y1;
    edge.x1 = ascends ? e.x1 : e.x0;
    edge.slope = penumbra_clamp((e.y1 - e.y0) / penumbra_divisor(e.x1 - e.x0), -1e30f, 1e30f);
    edge.piece = piece;
    edge.weight = leftward ? weight : -weight;
    return edge;
}

// Whether an edge is over the box's bottom, so that it matters.
bool penumbra_is_over(penumbra_ColumnEdge e, int weight, penumbra_Rect2 box) {
    return e.x0 != e.x1 && weight != 0 && !(e.y0 <= box.min.y && e.y1 <= box.min.y);
}

// Where an edge of the union is at x.
float penumbra_y_at(penumbra_UnionEdge edge, float x) { return edge.y0 + (x - edge.x0) * edge.slope; }

// What lies of the box below a part of the outline, signed: covered below on side 1, above on side -1; 0 on side 0.
float penumbra_below_outline(penumbra_UnionEdge edge, float since, float x, int side, penumbra_Rect2 box) {
    if (side == 0) return 0.0f;
    vec2 from = vec2(x, penumbra_y_at(edge, x));
    vec2 to = vec2(since, penumbra_y_at(edge, since));
    float area = penumbra_edge_coverage(from, to, box);
    return side > 0 ? area : -area;
}

// Where two neighbours cross in a strip from x to `first`, the upper one by `left` and `right` higher at its ends, if
// what is in the wrong order to one side of the crossing is more than `least`; else `first`.
float penumbra_crossing(float left, float right, float x, float end, float first, float least) {
    if ((left >= 0.0f) == (right >= 0.0f)) return first;
    float share = left / penumbra_divisor(left - right);
    float width = end - x;
    float cut = x + width * share;
    float wrong = width * min(abs(left) * share, abs(right) * (1.0f - share));
    return cut > x && cut < first && wrong > least ? cut : first;
}

// The area of the part of the box that is covered: a piece covers what its edges wind around.
float penumbra_area(penumbra_EdgeUnion all, penumbra_Rect2 box) {
    float least = penumbra_area(box) * 1.490116119384765625e-08f;
    int starts[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];        // edges by where they start
    float since[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];       // from where on an edge is on the outline,
    int sides[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];         // and what it has covered, see above
    int order[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];         // edges in the strip at hand, the highest first,
    float left[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];        // and their y at its ends
    float right[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES];
    int windings[PENUMBRA_PENUMBRA_WEDGE_UNION_EDGES + 1];  // of pieces
    starts[0] = 0;  // drivers warn of what is never read before it is set
    since[0] = 0.0f;
    order[0] = 0;
    left[0] = 0.0f;
    right[0] = 0.0f;
    for (int k = 0; k <= all.pieces; ++k) windings[k] = 0;
    for (int k = 0; k < all.count; ++k) {
        sides[k] = 0;
        int to = k;
        for (; to > 0; --to) {
            if (!(all.edges[starts[to - 1]].x0 > all.edges[k].x0)) break;
            starts[to] = starts[to - 1];
        }
        starts[to] = k;
    }
    float sum = 0.0f;
    float x = 0.0f;
    int alive = 0, next = 0, cuts = 64 * all.count;
    for (int strips = 66 * all.count; strips > 0; --strips) {
        if (next == all.count && alive == 0) break;
        if (alive == 0) x = all.edges[starts[next]].x0;
        for (; next < all.count; ++next) {
            if (all.edges[starts[next]].x0 > x) break;
            order[alive] = starts[next];
            left[alive] = penumbra_y_at(all.edges[starts[next]], x);
            ++alive;
        }
        float end = next < all.count ? all.edges[starts[next]].x0 : 3.402823466e+38f;
        for (int k = 0; k < alive; ++k) end = min(end, all.edges[order[k]].x1);
        bool is_cut = true;
        while (is_cut) {
            // by height at the middle of the strip
            for (int k = 0; k < alive; ++k) {
                int edge = order[k];
                float edge_left = left[k];
                float edge_right = penumbra_y_at(all.edges[edge], end);
                float height = edge_left + edge_right;
                int to = k;
                for (; to > 0; --to) {
                    if (!(height > left[to - 1] + right[to - 1])) break;
                    order[to] = order[to - 1];
                    left[to] = left[to - 1];
                    right[to] = right[to - 1];
                }
                order[to] = edge;
                left[to] = edge_left;
                right[to] = edge_right;
            }
            float cut = end;
            for (int k = 1; k < alive; ++k)
                cut = penumbra_crossing(left[k - 1] - left[k], right[k - 1] - right[k], x, end, cut, least);
            is_cut = cut < end && cuts > 0;
            if (is_cut) {
                end = cut;
                --cuts;
            }
        }
        // going down, what is on the outline from x on
        int covering = 0;
        for (int k = 0; k < alive; ++k) {
            int edge = order[k];
            int piece = all.edges[edge].piece;
            int upper = windings[piece];
            int lower = upper + all.edges[edge].weight;
            int before = covering;
            windings[piece] = lower;
            covering += (lower != 0 ? 1 : 0) - (upper != 0 ? 1 : 0);
            int side = (covering != 0 ? 1 : 0) - (before != 0 ? 1 : 0);
            if (side != sides[edge]) {
                sum += penumbra_below_outline(all.edges[edge], since[edge], x, sides[edge], box);
                sides[edge] = side;
                since[edge] = x;
            }
        }
        for (int k = 0; k < alive; ++k) windings[all.edges[order[k]].piece] = 0;
        // on to the next strip, without edges that end
        x = end;
        int kept = 0;
        for (int k = 0; k < alive; ++k) {
            int edge = order[k];
            if (all.edges[edge].x1 > x) {
                order[kept] = edge;
                left[kept] = right[k];
                ++kept;
            } else {
                sum += penumbra_below_outline(all.edges[edge], since[edge], all.edges[edge].x1, sides[edge], box);
            }
        }
        alive = kept;
    }
    return sum;
}

#endif
