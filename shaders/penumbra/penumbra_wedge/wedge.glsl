// Penumbra wedges: the points from which an edge lies before the light, P = E + s (E - q) for E on the edge, q on the
// light and s >= 0. Six half-spaces, exactly: four planes through an end of the edge and a side of the light, two through
// the edge and a corner of the light.
//
// Options: none
// Error:   contains: 32 epsilon of the largest coordinate, on the safe side
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/wedge.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_WEDGE_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_WEDGE_GLSL

#include "../geometry.glsl"

// The six outside planes of a wedge, which point inwards, and the plane that parts it. A plane with normal and offset 0
// has everything inside. Normals are not of unit length; the shorter, the less well a plane is known.
struct penumbra_Wedge {
    penumbra_Plane shadow;                    // through the light's centre and the edge; >= 0 in the inner half
    penumbra_Plane inner, outer;              // through the edge and a corner of the light, one for each half
    penumbra_Plane right, top, left, bottom;  // through an end and a side of the light, by where they bound the wedge
    vec2 half_size;                           // of the light
    float reach;                              // largest coordinate of what the planes go through, for their rounding
};

// Half of a wedge, between the shadow plane and three outside planes; all point inwards.
struct penumbra_HalfWedge {
    penumbra_Plane shadow;
    penumbra_Plane outside[3];
    float reach;
};

// Points from which the edge does, or does not, leave the light's centre to its left.
#define PENUMBRA_WEDGE_HALF_INNER 0
#define PENUMBRA_WEDGE_HALF_OUTER 1

penumbra_Plane penumbra_plane(vec3 normal, float offset) {
    penumbra_Plane plane;
    plane.normal = normal;
    plane.offset = offset;
    return plane;
}

penumbra_Plane penumbra_plane_of_nothing() { return penumbra_plane(vec3(0.0f, 0.0f, 0.0f), -3.40282347e+38f); }

// An edge from its end a nearer to the light. `along` is b - a times a power of two; `at` an end that is lit; `reaches`
// tells on which sides (right, top, left, bottom) of every slice b's rectangle lies farther out than that of a, or, if
// the edge crosses the light's plane, of where it does.
struct penumbra_OrderedEdge {
    vec3 a, b, along, at;
    bool lit, crosses, swapped;
    bool reaches[4];
};

penumbra_OrderedEdge penumbra_ordered_edge(vec3 a_ls, vec3 b_ls, vec2 half_size) {
    penumbra_OrderedEdge edge;
    edge.swapped = b_ls.z < a_ls.z;
    edge.a = edge.swapped ? b_ls : a_ls;
    edge.b = edge.swapped ? a_ls : b_ls;
    edge.lit = edge.b.z >= 0.0f;
    edge.crosses = edge.lit && edge.a.z < 0.0f;
    bool b_is_near = penumbra_largest_component(edge.b) < penumbra_largest_component(edge.a);
    edge.at = edge.crosses || b_is_near ? edge.b : edge.a;
    edge.along = edge.b - edge.a;
    edge.along = edge.along * penumbra_exp2_int(penumbra_exponent_to_unit(penumbra_largest_component(edge.along)));
    vec3 low = edge.crosses ? edge.b : edge.a;
    float depth = edge.along.z > 0.0f ? low.z : 1.0f;
    float shift_x = edge.along.x * depth;
    float shift_y = edge.along.y * depth;
    edge.reaches[0] = (low.x + half_size.x) * edge.along.z < shift_x;
    edge.reaches[1] = (low.y + half_size.y) * edge.along.z < shift_y;
    edge.reaches[2] = (low.x - half_size.x) * edge.along.z > shift_x;
    edge.reaches[3] = (low.y - half_size.y) * edge.along.z > shift_y;
    return edge;
}

// Which way corner k of a slice lies; it ends side k and begins side k + 1, counter-clockwise.
vec2 penumbra_slice_corner(int k) { return vec2(k == 0 || k == 3 ? 1.0f : -1.0f, k < 2 ? 1.0f : -1.0f); }

// One side of all slices, through an end of the edge and a side of the light. There is none where an edge crosses the
// light's plane and b does not reach farther: what is nearly in the plane throws its shadow without limit.
penumbra_Plane penumbra_side_plane(penumbra_OrderedEdge edge, int side, vec2 half_size) {
    bool of_b = edge.reaches[side];
    bool is_x = side == 0 || side == 2;
    if (edge.crosses && !of_b) return penumbra_plane(vec3(0.0f, 0.0f, 0.0f), 0.0f);
    vec3 end = of_b ? edge.b : edge.a;
    float s = side < 2 ? 1.0f : -1.0f;
    float size = is_x ? half_size.x : half_size.y;
    float rise = s * (is_x ? end.x : end.y) + size;
    float scale = penumbra_exp2_int(penumbra_exponent_to_unit(max(end.z, abs(rise))));
    float across = end.z * scale;
    return penumbra_plane(vec3(is_x ? -s * across : 0.0f, is_x ? 0.0f : -s * across, rise * scale), -(across * size));
}

float penumbra_wedge_slack(vec3 point_ls, float reach) {
    return 3.814697265625e-6f * (penumbra_largest_component(point_ls) + reach);
}

// The wedge of the edge from a to b, an edge of a silhouette: counter-clockwise around what is hidden. Light space,
// `half_size` >= 0. Domain: |coordinates| <= 1e18. What of the edge lies behind the light is cut off at depth 0.
// Degenerate: an edge behind the light has an empty wedge; one in the light's plane nothing or, if it meets the light,
// everything; a light without area a flat wedge, which reaches back to the light. An edge of no length, or in line with
// the light's centre, has no shadow plane: its wedge is all outer half.
penumbra_Wedge penumbra_wedge(vec3 a_ls, vec3 b_ls, vec2 half_size) {
    penumbra_OrderedEdge edge = penumbra_ordered_edge(a_ls, b_ls, half_size);
    penumbra_Plane nothing = penumbra_plane_of_nothing();
    penumbra_Plane everything = penumbra_plane(vec3(0.0f, 0.0f, 0.0f), 0.0f);
    penumbra_Wedge result;
    result.half_size = half_size;
    result.reach = max(penumbra_largest_component(edge.at), max(half_size.x, half_size.y));
    result.shadow = everything;
    result.inner = nothing;
    result.outer = nothing;
    result.right = nothing;
    result.top = nothing;
    result.left = nothing;
    result.bottom = nothing;
    if (!edge.lit) return result;
    result.inner = everything;
    result.outer = everything;
    vec3 from_center = edge.at * penumbra_exp2_int(penumbra_exponent_to_unit(penumbra_largest_component(edge.at)));
    result.shadow.normal = edge.swapped ? cross(edge.along, from_center) : cross(from_center, edge.along);
    result.right = penumbra_side_plane(edge, 0, half_size);
    result.top = penumbra_side_plane(edge, 1, half_size);
    result.left = penumbra_side_plane(edge, 2, half_size);
    result.bottom = penumbra_side_plane(edge, 3, half_size);
    for (int k = 0; k < 4; ++k) {
        bool here = edge.reaches[k];
        bool next = edge.reaches[k < 3 ? k + 1 : 0];
        if (here == next) continue;
        vec2 toward = penumbra_slice_corner(k);  // seen through the edge, the light is upside down
        vec3 corner = vec3(-toward.x * half_size.x, -toward.y * half_size.y, 0.0f) - edge.at;
        vec3 ray = corner * penumbra_exp2_int(penumbra_exponent_to_unit(penumbra_largest_component(corner)));
        vec3 normal = next ? cross(edge.along, ray) : cross(ray, edge.along);
        penumbra_Plane plane = penumbra_plane(normal, -dot(normal, edge.at));
        if (next == edge.swapped)
            result.inner = plane;
        else
            result.outer = plane;
    }
    return result;
}

// One half of a wedge by three outside planes, as the paper has it: the plane through the edge, and one side plane at
// each end, those that leave least outside the half; all three sides where the edge points at the light. Contains the
// half, and 3 % more, measured over random edges in a box around edge and light.
penumbra_HalfWedge penumbra_half_wedge(penumbra_Wedge wedge, int which) {
    bool is_inner = which == PENUMBRA_WEDGE_HALF_INNER;
    vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    vec3 normal = is_inner ? wedge.shadow.normal : -wedge.shadow.normal;
    penumbra_HalfWedge result;
    result.reach = wedge.reach;
    result.shadow = penumbra_plane(normal, 0.0f);
    if (is_inner && normal == zero) result.shadow = penumbra_plane_of_nothing();
    penumbra_Plane through = wedge.outer;
    if (is_inner) through = wedge.inner;
    // of the sides next to the corner that lies farthest out, both, or one and the side across
    bool to_right = normal.x >= 0.0f;
    bool to_top = normal.y >= 0.0f;
    float out_x = abs(normal.x) * wedge.half_size.x;
    float out_y = abs(normal.y) * wedge.half_size.y;
    penumbra_Plane x = wedge.left;
    penumbra_Plane y = wedge.bottom;
    penumbra_Plane across = wedge.top;
    if (to_right) x = wedge.right;
    if (to_top) y = wedge.top;
    if (to_top) across = wedge.bottom;
    if (out_x <= out_y) {
        across = wedge.right;
        if (to_right) across = wedge.left;
    }
    result.outside[0] = through;
    result.outside[1] = y;
    result.outside[2] = across;
    if (through.normal == zero && through.offset == 0.0f) {
        result.outside[0] = x;
    } else if (out_x < 3.0f * out_y && out_y < 3.0f * out_x) {
        result.outside[1] = x;
        result.outside[2] = y;
    } else if (out_x <= out_y) {
        result.outside[1] = x;
    }
    return result;
}

// Whether a point of depth > 0 may be in the wedge. Light space. Never false for a point of the wedge; true for those
// outside only within 32 epsilon of the largest coordinate, farther where an edge points at a corner of the light.
bool penumbra_contains(penumbra_Wedge wedge, vec3 point_ls) {
    float through =
        min(penumbra_signed_distance(wedge.inner, point_ls), penumbra_signed_distance(wedge.outer, point_ls));
    float x = min(penumbra_signed_distance(wedge.right, point_ls), penumbra_signed_distance(wedge.left, point_ls));
    float y = min(penumbra_signed_distance(wedge.top, point_ls), penumbra_signed_distance(wedge.bottom, point_ls));
    return min(through, min(x, y)) >= -penumbra_wedge_slack(point_ls, wedge.reach);
}

// Whether a point of depth > 0 may be in the half of a wedge. Never false for a point of it.
bool penumbra_contains(penumbra_HalfWedge part, vec3 point_ls) {
    float first =
        min(penumbra_signed_distance(part.shadow, point_ls), penumbra_signed_distance(part.outside[0], point_ls));
    float second =
        min(penumbra_signed_distance(part.outside[1], point_ls), penumbra_signed_distance(part.outside[2], point_ls));
    return min(first, second) >= -penumbra_wedge_slack(point_ls, part.reach);
}

// Vertex `index` of 12 of the geometry that bounds what of a wedge lies within `receivers_ls`: the wedge itself up to the
// receivers' largest depth. Light space. Its 20 triangles are wedge_triangles of the C++. A wedge that reaches sideways
// without limit, because its edge comes within 64 epsilon of that depth to the light's plane, is bounded by the
// receivers' box. All vertices are one point where no receiver is beyond the edge.
vec3 penumbra_wedge_vertex(vec3 a_ls, vec3 b_ls, vec2 half_size, penumbra_Box3 receivers_ls, int index) {
    penumbra_OrderedEdge edge = penumbra_ordered_edge(a_ls, b_ls, half_size);
    float depth = receivers_ls.max.z;
    bool deep = index >= 6;
    int slot = deep ? index - 6 : index;
    if (!edge.lit || !(depth > edge.a.z)) return edge.a;
    if (edge.crosses || edge.a.z <= 7.62939453125e-6f * depth) {
        vec2 side = penumbra_slice_corner(slot < 3 ? slot : 3);
        return vec3(side.x > 0.0f ? receivers_ls.max.x : receivers_ls.min.x,
                    side.y > 0.0f ? receivers_ls.max.y : receivers_ls.min.y, deep ? depth : receivers_ls.min.z);
    }
    bool of_b = false;
    int corner = 0;
    int last = -1;
    for (int k = 0; k < 4; ++k) {  // 4 or 6 vertices, the last again and again
        bool here = edge.reaches[k];
        bool next = edge.reaches[k < 3 ? k + 1 : 0];
        if (slot > last) {
            of_b = here;
            corner = k;
        }
        ++last;
        if (here == next) continue;
        if (slot > last) {
            of_b = next;
            corner = k;
        }
        ++last;
    }
    vec3 end = of_b ? edge.b : edge.a;
    if (end.z > depth) {
        end = edge.a + (edge.b - edge.a) * ((depth - edge.a.z) / (edge.b.z - edge.a.z));
        end.z = depth;
    }
    if (!deep || end.z == depth) return end;
    vec2 toward = penumbra_slice_corner(corner);
    float ratio = depth / end.z;
    float out_x = toward.x * half_size.x;
    float out_y = toward.y * half_size.y;
    return vec3((end.x + out_x) * ratio - out_x, (end.y + out_y) * ratio - out_y, depth);
}

#endif
