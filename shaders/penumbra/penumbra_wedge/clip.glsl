// From a point through a caster onto the light's plane: edges and triangles, cut to what can matter.
//
// Light space: depth 0 is the light's plane, P has depth p > 0. A caster's vertex E at depth e lands at
// P + (E - P) p / w, w = p - e. Nothing is divided before all cuts are made, by the light's plane and by four planes
// through P and a side of the box each, which leave w >= 0 without any near plane to choose.
//
// Options: none
// Error:   12 epsilon, and 1.5 epsilon length / distance for a side that passes the point
// Source:  J. Blinn & M. Newell, "Clipping using homogeneous coordinates", 1978; I. Sutherland & G. Hodgman, "Reentrant
//          polygon clipping", 1974
// C++:     include/penumbra/penumbra_wedge/clip.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_CLIP_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_CLIP_GLSL

#include "coverage.glsl"

// A caster's vertex as its depth, and by how far it is from the left, right, bottom and top of the box where it lands,
// times w; >= 0 inside.
struct penumbra_SeenVertex {
    float from[5];
};

penumbra_SeenVertex penumbra_see(vec3 vertex_ls, vec3 point_ls, penumbra_Rect2 box) {
    float w = point_ls.z - vertex_ls.z;
    float across = point_ls.z * (vertex_ls.x - point_ls.x);
    float along = point_ls.z * (vertex_ls.y - point_ls.y);
    penumbra_SeenVertex v;
    v.from[0] = vertex_ls.z;
    v.from[1] = (point_ls.x - box.min.x) * w + across;
    v.from[2] = (box.max.x - point_ls.x) * w - across;
    v.from[3] = (point_ls.y - box.min.y) * w + along;
    v.from[4] = (box.max.y - point_ls.y) * w - along;
    return v;
}

// Where the edge from a vertex inside of plane `cut` to one outside meets it. As weighted means: small distances keep
// their digits beside large ones.
penumbra_SeenVertex penumbra_cut_point(int cut, penumbra_SeenVertex inside, penumbra_SeenVertex outside) {
    float whole = inside.from[cut] - outside.from[cut];
    float of_inside = penumbra_safe_ratio(-outside.from[cut], whole, 1.0f);
    float of_outside = penumbra_safe_ratio(inside.from[cut], whole, 0.0f);
    penumbra_SeenVertex v;
    for (int k = 0; k < 5; ++k) v.from[k] = inside.from[k] * of_inside + outside.from[k] * of_outside;
    v.from[cut] = 0.0f;
    return v;
}

// Where a vertex lands, in units of the box: 0 to 1 inside. The middle for w too small to divide by.
vec2 penumbra_land(penumbra_SeenVertex v) {
    return vec2(penumbra_safe_ratio(v.from[1], v.from[1] + v.from[2], 0.5f),
                penumbra_safe_ratio(v.from[3], v.from[3] + v.from[4], 0.5f));
}

// The same place on the light's plane; exact on the box's border.
vec2 penumbra_on_plane(vec2 at, penumbra_Rect2 box) {
    return vec2(penumbra_mix(box.min.x, box.max.x, at.x), penumbra_mix(box.min.y, box.max.y, at.y));
}

// What an edge leaves on the light's plane; `lands` is false, and both ends are the box's middle, if that is nothing.
struct penumbra_ProjectedEdge {
    vec2 a, b;
    bool lands;
};

// Where the edge from a to b, seen from `point_ls`, lands in the columns of `box` on the light's plane: what
// penumbra_edge_coverage needs of it, and all that can be in the box. Light space, world units, point depth > 0, box
// with an area. Parts behind the light's plane, at or beyond the point's depth and beside the box's columns are cut
// off. Where a caster reaches beyond the point, or behind the light, its edges one by one leave its loop open: take
// triangles from one vertex to each edge, by penumbra_triangle_coverage.
penumbra_ProjectedEdge penumbra_project_edge(vec3 a_ls, vec3 b_ls, vec3 point_ls, penumbra_Rect2 box) {
    penumbra_SeenVertex a = penumbra_see(a_ls, point_ls, box);
    penumbra_SeenVertex b = penumbra_see(b_ls, point_ls, box);
    bool lands = true;
    for (int cut = 0; cut < 3; ++cut) {
        bool a_inside = a.from[cut] >= 0.0f;
        bool b_inside = b.from[cut] >= 0.0f;
        lands = lands && (a_inside || b_inside);
        if (lands && a_inside && !b_inside) b = penumbra_cut_point(cut, a, b);
        if (lands && !a_inside && b_inside) a = penumbra_cut_point(cut, b, a);
    }
    lands = lands && a.from[1] + a.from[2] >= PENUMBRA_SMALLEST && a.from[3] + a.from[4] >= PENUMBRA_SMALLEST &&
            b.from[1] + b.from[2] >= PENUMBRA_SMALLEST && b.from[3] + b.from[4] >= PENUMBRA_SMALLEST;
    vec2 middle = vec2(0.5f, 0.5f);
    penumbra_ProjectedEdge edge;
    edge.a = penumbra_on_plane(lands ? penumbra_land(a) : middle, box);
    edge.b = penumbra_on_plane(lands ? penumbra_land(b) : middle, box);
    edge.lands = lands;
    return edge;
}

// What is left of a triangle. Five cuts make 8 vertices of 3, and more where rounding bends what is nearly straight.
#define PENUMBRA_MOST_SEEN 12

struct penumbra_SeenPolygon {
    penumbra_SeenVertex vertices[PENUMBRA_MOST_SEEN];
    int count;
};

// The part of a triangle inside all planes. In one function: drivers copy polygons that functions take and return.
penumbra_SeenPolygon penumbra_cut_triangle(vec3 a_ls, vec3 b_ls, vec3 c_ls, vec3 point_ls, penumbra_Rect2 box) {
    penumbra_SeenPolygon polygon;
    penumbra_SeenPolygon kept;
    polygon.vertices[0] = penumbra_see(a_ls, point_ls, box);
    polygon.vertices[1] = penumbra_see(b_ls, point_ls, box);
    polygon.vertices[2] = penumbra_see(c_ls, point_ls, box);
    polygon.count = 3;
    for (int cut = 0; cut < 5; ++cut) {
        kept.count = 0;
        for (int i = 0; i < polygon.count; ++i) {
            penumbra_SeenVertex a = polygon.vertices[i];
            penumbra_SeenVertex b = polygon.vertices[i + 1 == polygon.count ? 0 : i + 1];
            bool a_inside = a.from[cut] >= 0.0f;
            bool b_inside = b.from[cut] >= 0.0f;
            if (a_inside && kept.count < PENUMBRA_MOST_SEEN) {
                kept.vertices[kept.count] = a;
                ++kept.count;
            }
            if (a_inside != b_inside && kept.count < PENUMBRA_MOST_SEEN) {
                if (a_inside)
                    kept.vertices[kept.count] = penumbra_cut_point(cut, a, b);
                else
                    kept.vertices[kept.count] = penumbra_cut_point(cut, b, a);
                ++kept.count;
            }
        }
        polygon = kept;
    }
    return polygon;
}

// The fraction of `box` that a triangle hides from `point_ls`, signed by the way round: positive if what lands runs
// counter-clockwise in (x, y). In [-1, 1] but for rounding; 0 for a box without area. Light space, world
// units, point depth > 0; the triangle may cross the light's plane and the point's depth, or come as near as 1e-6.
float penumbra_triangle_coverage(vec3 a_ls, vec3 b_ls, vec3 c_ls, vec3 point_ls, penumbra_Rect2 box) {
    penumbra_SeenPolygon polygon = penumbra_cut_triangle(a_ls, b_ls, c_ls, point_ls, box);
    penumbra_Rect2 unit = penumbra_rect2(vec2(0.0f, 0.0f), vec2(1.0f, 1.0f));
    float sum = 0.0f;
    for (int i = 0; i < polygon.count; ++i) {
        vec2 from = penumbra_land(polygon.vertices[i]);
        vec2 to = penumbra_land(polygon.vertices[i + 1 == polygon.count ? 0 : i + 1]);
        sum += penumbra_edge_coverage(from, to, unit);
    }
    return penumbra_area(box) > 0.0f ? sum : 0.0f;
}

#endif
