// Which edges matter to a point: the way through the tree of all casters' edges, one edge after the other.
//
// Options: PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE  from where silhouettes are seen, as the texels were made:
//                                              PENUMBRA_SILHOUETTE_POINT (default) or _LIGHT_CENTER
// Error:   2 roundings of where vertices land; bit for bit the C++ where the driver's division is
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/wedge_index.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_WEDGE_INDEX_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_WEDGE_INDEX_GLSL

#include "clip.glsl"
#include "point_tile.glsl"
#include "silhouette.glsl"
#include "wedge_texels.glsl"

#ifndef PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_POINT
#endif

// Whether nothing in a box can be in the pyramid; for a part of a piece, nor above it.
bool penumbra_misses(penumbra_WedgePoint p, penumbra_Box3 box, bool is_part) {
    float near = box.min.z;
    float far = min(box.max.z, p.point.z);
    return near >= p.point.z || box.min.x - p.light.max.x > max(p.right * near, p.right * far) ||
           box.max.x + p.light.max.x < min(p.left * near, p.left * far) ||
           box.max.y + p.light.max.y < min(p.bottom * near, p.bottom * far) ||
           (!is_part && box.min.y - p.light.max.y > max(p.top * near, p.top * far));
}

// Whether faces in a box may be so near to the point that it is on them.
bool penumbra_touches(penumbra_WedgePoint p, penumbra_Box3 box, float tolerance) {
    vec3 low = p.point - tolerance * 2.0f;
    vec3 high = p.point + tolerance * 2.0f;
    return box.min.x <= high.x && box.max.x >= low.x && box.min.y <= high.y && box.max.y >= low.y &&
           box.min.z <= high.z && box.max.z >= low.z;
}

// Whether all faces below a node count as often, so that no edge there is on the silhouette.
bool penumbra_has_no_silhouette(highp sampler2D wedges, penumbra_WedgePoint p, int node, int traits,
                                penumbra_Box3 box, float tolerance) {
    int least = ((traits >> 5) & 3) - 1;
    int most = ((traits >> 7) & 3) - 1;
#if PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE == PENUMBRA_SILHOUETTE_LIGHT_CENTER
    if (least != most || penumbra_touches(p, box, tolerance)) return false;
#else
    vec4 low = penumbra_wedge_texel(wedges, node + 2);
    vec4 high = penumbra_wedge_texel(wedges, node + 3);
    vec3 way = p.point - (box.min + box.max) * 0.5f;
    vec3 a = way * vec3(low);
    vec3 b = way * vec3(high);
    vec3 least_way = min(a, b);
    vec3 most_way = max(a, b);
    // how near a plane may pass to the point before it must be asked
    float room = tolerance * 2.0f + 9.5367431640625e-07f * (abs(way.x) + abs(way.y) + abs(way.z));
    bool front = least_way.x + least_way.y + least_way.z + low.w > room;
    bool away = most_way.x + most_way.y + most_way.z + high.w < -room;
    if (!front && !away) return false;
    int coefficient = away ? -1 : ((traits & PENUMBRA_WEDGE_SOLID) != 0 ? 0 : 1);
    least = min(least, coefficient);
    most = max(most, coefficient);
#endif
    bool none_reaches_beyond = box.max.z < p.point.z;
    return least == most && (none_reaches_beyond || least == 0);
}

// How often a face counts for a point, wherever it lies: 0 for one that is on it.
float penumbra_face_coefficient(highp sampler2D wedges, vec3 normal, int face, penumbra_WedgePoint p, float tolerance) {
    vec4 a = penumbra_wedge_texel(wedges, face + 1);
    float distance = normal.x * (p.point.x - a.x) + normal.y * (p.point.y - a.y) + normal.z * (p.point.z - a.z);
    bool away = distance < -tolerance;
    bool front = distance > tolerance;
#if PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE == PENUMBRA_SILHOUETTE_LIGHT_CENTER
    if (away || front) return a.w;
    vec3 b = vec3(penumbra_wedge_texel(wedges, face + 2));
    vec3 c = vec3(penumbra_wedge_texel(wedges, face + 3));
    penumbra_Box3 box = penumbra_box3(min(min(vec3(a), b), c), max(max(vec3(a), b), c));
    return penumbra_touches(p, box, tolerance) ? 0.0f : a.w;
#else
    return away ? -1.0f : (front ? a.w : 0.0f);
#endif
}

// How often what lies beside an edge counts: a face, if it lies before the point; else 0, or -1 for a cap.
float penumbra_side_coefficient(highp sampler2D wedges, int side, penumbra_WedgePoint p, float tolerance) {
    if (side <= 0) return float(side);
    vec4 normal = penumbra_wedge_texel(wedges, side);
    return normal.w < p.point.z ? penumbra_face_coefficient(wedges, vec3(normal), side, p, tolerance) : 0.0f;
}

// Where a vertex before the point lands.
vec2 penumbra_on_light(penumbra_WedgePoint p, vec3 vertex) {
    float grown = p.point.z / (p.point.z - vertex.z);
    return vec2(p.point.x + (vertex.x - p.point.x) * grown, p.point.y + (vertex.y - p.point.y) * grown);
}

// Whether a triangle lies beyond one side of the pyramid.
bool penumbra_is_beside(penumbra_WedgePoint p, vec3 a, vec3 b, vec3 c) {
    vec3 x = vec3(a.x, b.x, c.x);
    vec3 y = vec3(a.y, b.y, c.y);
    vec3 depth = vec3(a.z, b.z, c.z);
    vec2 half_size = p.light.max;
    return all(greaterThan((x - half_size.x) * p.point.z, depth * (p.point.x - half_size.x))) ||
           all(lessThan((x + half_size.x) * p.point.z, depth * (p.point.x + half_size.x))) ||
           all(greaterThan((y - half_size.y) * p.point.z, depth * (p.point.y - half_size.y))) ||
           all(lessThan((y + half_size.y) * p.point.z, depth * (p.point.y + half_size.y)));
}

// What a cursor found.
#define PENUMBRA_WEDGE_NOTHING 0  // there is no more
#define PENUMBRA_WEDGE_EDGE 1     // an edge of the open group
#define PENUMBRA_WEDGE_GROUP 2    // the end of a group

// The way through the tree.
struct penumbra_WedgeCursor {
    int found;
    vec2 from, to;      // the edge on the light's plane,
    float coefficient;  // and how often it counts
    int group;          // the group's root: a node
    int node;           // that is next
    int group_end;      // the first node beyond the group, 0 if none is open
    int edge, edge_end;
    int face, face_end;
    vec2 loop[PENUMBRA_MOST_SEEN];  // what lands of a face,
    int corner, corner_end;         // as corners that are left
};

penumbra_WedgeCursor penumbra_first_edge() {
    penumbra_WedgeCursor c;
    c.found = PENUMBRA_WEDGE_NOTHING;
    c.from = vec2(0.0f, 0.0f);
    c.to = vec2(0.0f, 0.0f);
    c.coefficient = 0.0f;
    c.group = 0;
    c.node = 0;
    c.group_end = 0;
    c.edge = 0;
    c.edge_end = 0;
    c.face = 0;
    c.face_end = 0;
    c.corner = 0;
    c.corner_end = 0;
    return c;
}

// With the next face of a leaf that reaches from before the point to beyond it, cut by the pyramid.
penumbra_WedgeCursor penumbra_next_face(highp sampler2D wedges, penumbra_WedgePoint p, float tolerance,
                                        penumbra_WedgeCursor c) {
    vec4 normal = penumbra_wedge_texel(wedges, c.face);
    vec4 low = penumbra_wedge_texel(wedges, c.face + 2);
    if (normal.w >= p.point.z && low.w < p.point.z) {
        vec3 a_ls = vec3(penumbra_wedge_texel(wedges, c.face + 1));
        vec3 c_ls = vec3(penumbra_wedge_texel(wedges, c.face + 3));
        c.coefficient = penumbra_face_coefficient(wedges, vec3(normal), c.face, p, tolerance);
        if (c.coefficient != 0.0f && !penumbra_is_beside(p, a_ls, vec3(low), c_ls)) {
            penumbra_SeenPolygon polygon = penumbra_cut_triangle(a_ls, vec3(low), c_ls, p.point, p.light);
            for (int k = 0; k < polygon.count; ++k)
                c.loop[k] = penumbra_on_plane(penumbra_land(polygon.vertices[k]), p.light);
            c.corner = 0;
            c.corner_end = polygon.count;
        }
    }
    c.face += 4;
    return c;
}

// With the next edge of a leaf, if it is on the silhouette.
penumbra_WedgeCursor penumbra_next_leaf_edge(highp sampler2D wedges, penumbra_WedgePoint p, float tolerance,
                                             penumbra_WedgeCursor c) {
    vec4 a = penumbra_wedge_texel(wedges, c.edge);
    vec4 b = penumbra_wedge_texel(wedges, c.edge + 1);
    c.edge += 2;
    c.coefficient = penumbra_side_coefficient(wedges, int(a.w), p, tolerance) -
                    penumbra_side_coefficient(wedges, int(b.w), p, tolerance);
    if (c.coefficient == 0.0f) return c;
    c.found = PENUMBRA_WEDGE_EDGE;
    c.from = penumbra_on_light(p, vec3(a));
    c.to = penumbra_on_light(p, vec3(b));
    return c;
}

// With the next node, and its edges and faces if it is a leaf that matters.
penumbra_WedgeCursor penumbra_next_node(highp sampler2D wedges, penumbra_WedgePoint p, float tolerance, int groups,
                                        penumbra_WedgeCursor c) {
    vec4 low = penumbra_wedge_texel(wedges, c.node);
    vec4 high = penumbra_wedge_texel(wedges, c.node + 1);
    penumbra_Box3 box = penumbra_box3(vec3(low), vec3(high));
    int node = c.node, traits = int(high.w);
    bool in_piece = (traits & PENUMBRA_WEDGE_IN_PIECE) != 0;
    bool is_part = in_piece && (traits & PENUMBRA_WEDGE_PIECE) == 0;
    c.node = int(low.w);
    if (penumbra_misses(p, box, is_part)) return c;
#if PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE == PENUMBRA_SILHOUETTE_LIGHT_CENTER
    int not_for = p.point.z > high.z + tolerance * 2.0f ? PENUMBRA_WEDGE_NOT_BEYOND : PENUMBRA_WEDGE_BEYOND;
    if ((traits & not_for) != 0) return c;
#endif
    if (in_piece && penumbra_has_no_silhouette(wedges, p, node, traits, box, tolerance)) return c;
    if ((traits & groups) != 0) {
        c.group = node;
        c.group_end = c.node;
    }
    c.node = node + 5;
    vec4 items = penumbra_wedge_texel(wedges, node + 4);
    c.edge = int(items.x);
    c.edge_end = int(items.y);
    c.face = int(items.z);
    c.face_end = high.z >= p.point.z ? int(items.w) : c.face;
    return c;
}

// On to the next edge that matters, or to the end of a group, which is what `groups` says: PENUMBRA_WEDGE_MESH or
// _PIECE. Only groups that may block are entered. The sum of coefficient * edge_coverage over a group's edges is what
// it blocks of p.light, winding counted. Begin with penumbra_first_edge(), and end with PENUMBRA_WEDGE_NOTHING.
penumbra_WedgeCursor penumbra_next_edge(highp sampler2D wedges, penumbra_WedgeShadow info, penumbra_WedgePoint p,
                                        int groups, penumbra_WedgeCursor c) {
    c.found = PENUMBRA_WEDGE_NOTHING;
    bool is_over = false;
    while (c.found == PENUMBRA_WEDGE_NOTHING && !is_over) {
        if (c.corner < c.corner_end) {
            c.from = c.loop[c.corner];
            ++c.corner;
            c.to = c.loop[c.corner < c.corner_end ? c.corner : 0];
            c.found = PENUMBRA_WEDGE_EDGE;
        } else if (c.face < c.face_end) {
            c = penumbra_next_face(wedges, p, info.tolerance, c);
        } else if (c.edge < c.edge_end) {
            c = penumbra_next_leaf_edge(wedges, p, info.tolerance, c);
        } else if (c.group_end > 0 && c.node >= c.group_end) {
            c.found = PENUMBRA_WEDGE_GROUP;
            c.group_end = 0;
        } else if (c.node < info.nodes) {
            c = penumbra_next_node(wedges, p, info.tolerance, groups, c);
        } else {
            is_over = true;
        }
    }
    return c;
}

#endif
