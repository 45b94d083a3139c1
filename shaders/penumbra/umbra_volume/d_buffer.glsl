// D-buffer of a disk light: how much of it a point sees, by the D-buffer and its edges as textures.
//
// The host makes both by d_buffer_texels(); or a renderer draws the crossings (volumes.frag says how), and the host
// makes the edges by hiding_edge_texels(). Crossings are as wide as the image and higher by 2 layers: texel (x, y) of
// layer l is texel (x, y + 2 l resolution) for umbrae, resolution further down for penumbrae, and has in
//     .r  the depth of the crossing; above 3e38 where there is none
//     .g  the depth of the edge where the tangent plane's ray through the crossing meets it
//     .b  the edge's number
//     .a  of umbrae in layer 0 the depth beyond which a ray is blocked, above 3e38 where it is not
// An edge e is in texels 4 e to 4 e + 2 of `edges`, 1024 a row: a and the caster's number; b and the number of the
// edge that is chained to it; of a corner whose first edge this is, the number of the second, then those of its
// neighbours around outer corners, before and after; -1 where there is none. Points come in light space, as
// penumbra_to_light gives them.
//
// Options: PENUMBRA_UMBRA_VOLUME_LAYERS      edges on each side of a caster, 1 or 2
//          PENUMBRA_UMBRA_VOLUME_VISIBILITY  V(t): one of PENUMBRA_CUT_VISIBILITY_...
//          PENUMBRA_UMBRA_VOLUME_SHARE       where t comes from: one of PENUMBRA_CUT_SHARE_...
//          and d_buffer_view.glsl's
// Error:   that of the method; from the C++ 1e-6, 2e-6 by the square root, where depths are distances from the centre
//          and t comes from them a rounding of these over the depth behind the edge
// Source:  the umbra and penumbra volume paper for circular lights; second layer, edges and rules for two cuts are ours
// C++:     include/penumbra/umbra_volume/d_buffer.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_D_BUFFER_GLSL
#define PENUMBRA_UMBRA_VOLUME_D_BUFFER_GLSL

#include "../geometry.glsl"
#include "cut_share.glsl"
#include "d_buffer_view.glsl"
#include "disk_visibility.glsl"

#define PENUMBRA_CUT_VISIBILITY_EXACT 0
#define PENUMBRA_CUT_VISIBILITY_CUBIC 1
#define PENUMBRA_CUT_VISIBILITY_SQUARE_ROOT 2

#define PENUMBRA_CUT_SHARE_EDGE 0
#define PENUMBRA_CUT_SHARE_DEPTHS 1

#ifndef PENUMBRA_UMBRA_VOLUME_LAYERS
#define PENUMBRA_UMBRA_VOLUME_LAYERS 2
#endif
#ifndef PENUMBRA_UMBRA_VOLUME_VISIBILITY
#define PENUMBRA_UMBRA_VOLUME_VISIBILITY PENUMBRA_CUT_VISIBILITY_EXACT
#endif
#ifndef PENUMBRA_UMBRA_VOLUME_SHARE
#define PENUMBRA_UMBRA_VOLUME_SHARE PENUMBRA_CUT_SHARE_EDGE
#endif

// A straight edge that hides part of the light, its caster on the left as seen from the light. Light space. `chained`
// is the number of the edge beyond the silhouette faces at this one, or -1; `corner`, of a corner whose first edge
// this is, that of its second; `before` and `after` those of its neighbours around outer corners.
struct penumbra_HidingEdge {
    vec3 a, b;
    int mesh, chained, corner, before, after;
};

// Two edges as a point sees them: the angle between their visible sides, and whether each lies where the other hides.
struct penumbra_TwoCuts {
    float angle;
    bool convex;
};

// How two edges lie to each other from `point`, all in light space. Edges of different casters never hide as one.
penumbra_TwoCuts penumbra_two_cuts(penumbra_HidingEdge first, penumbra_HidingEdge second, vec3 point) {
    vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    vec3 n1 = penumbra_normalize_or(cross(first.a - point, first.b - first.a), zero);
    vec3 n2 = penumbra_normalize_or(cross(second.a - point, second.b - second.a), zero);
    vec3 way1 = penumbra_normalize_or(vec3(n1.x, n1.y, 0.0f), vec3(1.0f, 0.0f, 0.0f));
    vec3 way2 = penumbra_normalize_or(vec3(n2.x, n2.y, 0.0f), vec3(1.0f, 0.0f, 0.0f));
    // from the shorter of two chords: acos of a cosine loses digits at both ends, and may be that of more than 1
    bool obtuse = dot(way1, way2) < 0.0f;
    vec3 chord = obtuse ? way1 + way2 : way1 - way2;
    float turn = penumbra_half_arc(0.25f * dot(chord, chord));
    // on the other's plane counts as hidden: of an edge there and back between is nothing
    vec3 to1 = (first.a + first.b) * 0.5f - point;
    vec3 to2 = (second.a + second.b) * 0.5f - point;
    bool hidden1 = dot(n2, to1) >= -3.814697265625e-6f * penumbra_largest_component(to1);
    bool hidden2 = dot(n1, to2) >= -3.814697265625e-6f * penumbra_largest_component(to2);
    penumbra_TwoCuts cuts;
    cuts.angle = obtuse ? PENUMBRA_DISK_PI - turn : turn;
    cuts.convex = first.mesh == second.mesh && hidden1 && hidden2;
    return cuts;
}

// V(t) by one of its forms, PENUMBRA_CUT_VISIBILITY_...
float penumbra_cut_visibility(float t, int form) {
    if (form == PENUMBRA_CUT_VISIBILITY_EXACT) return penumbra_disk_visibility(t);
    return form == PENUMBRA_CUT_VISIBILITY_CUBIC ? penumbra_disk_visibility_cubic(t) : penumbra_disk_visibility_sqrt(t);
}

penumbra_HidingEdge penumbra_hiding_edge(highp sampler2D edges, int number) {
    ivec2 texel = ivec2((4 * number) & 1023, (4 * number) >> 10);
    vec4 first = texelFetch(edges, texel, 0);
    vec4 second = texelFetch(edges, ivec2(texel.x + 1, texel.y), 0);
    penumbra_HidingEdge edge;
    edge.a = vec3(first.x, first.y, first.z);
    edge.b = vec3(second.x, second.y, second.z);
    edge.mesh = int(first.w);
    edge.chained = int(second.w);
    vec4 third = texelFetch(edges, ivec2(texel.x + 2, texel.y), 0);
    edge.corner = int(third.x);
    edge.before = int(third.y);
    edge.after = int(third.z);
    return edge;
}

// t of an edge and of what is chained to it.
float penumbra_share_of(highp sampler2D edges, penumbra_HidingEdge edge, vec3 point, float radius) {
    float t = penumbra_edge_cut_share(edge.a, edge.b, point, radius);
    if (edge.chained < 0) return t;
    penumbra_HidingEdge other = penumbra_hiding_edge(edges, edge.chained);
    if (!(max(other.a.z, other.b.z) < point.z)) return t;
    return min(t, penumbra_edge_cut_share(other.a, other.b, point, radius));
}

// t past a crossing and its edge.
float penumbra_cut_share(highp sampler2D edges, vec4 crossing, penumbra_HidingEdge edge, vec3 point, float depth,
                         bool behind, float radius) {
#if PENUMBRA_UMBRA_VOLUME_SHARE == PENUMBRA_CUT_SHARE_EDGE
    return penumbra_share_of(edges, edge, point, radius);
#else
    return behind ? penumbra_umbra_cut_share(crossing.y, crossing.x, depth)
                  : penumbra_penumbra_cut_share(crossing.y, crossing.x, depth);
#endif
}

// What two edges leave.
float penumbra_past_two(penumbra_HidingEdge first, penumbra_HidingEdge second, float t1, float t2, vec3 point) {
    penumbra_TwoCuts cuts = penumbra_two_cuts(first, second, point);
#if PENUMBRA_UMBRA_VOLUME_VISIBILITY == PENUMBRA_CUT_VISIBILITY_EXACT
    return cuts.convex ? penumbra_disk_visibility_between(t1, t2, cuts.angle)
                       : penumbra_disk_visibility(t1, t2, cuts.angle);
#else
    float v1 = penumbra_cut_visibility(t1, PENUMBRA_UMBRA_VOLUME_VISIBILITY);
    float v2 = penumbra_cut_visibility(t2, PENUMBRA_UMBRA_VOLUME_VISIBILITY);
    return cuts.convex ? max(v1, v2) : min(v1, v2);
#endif
}

// What an edge leaves with its neighbour `number`, where that looks at least half as long as the light's radius; or 0.
float penumbra_past_neighbour(highp sampler2D edges, penumbra_HidingEdge edge, int number, float t, vec3 point,
                              float radius) {
    if (number < 0) return 0.0f;
    penumbra_HidingEdge other = penumbra_hiding_edge(edges, number);
    if (!(max(other.a.z, other.b.z) < point.z)) return 0.0f;
    float grown_a = point.z / (point.z - other.a.z);
    float grown_b = point.z / (point.z - other.b.z);
    vec2 along = vec2((other.b.x - point.x) * grown_b - (other.a.x - point.x) * grown_a,
                      (other.b.y - point.y) * grown_b - (other.a.y - point.y) * grown_a);
    if (!(dot(along, along) > 0.25f * radius * radius)) return 0.0f;
    return penumbra_past_two(edge, other, t, penumbra_share_of(edges, other, point, radius), point);
}

// The fraction of the light that a point in light space sees past one edge or two. `radius` is the light's. Exactly 1
// before the penumbra and outside of the image, exactly 0 within the umbra; 1 on and behind the light's plane, and for
// points that are not finite.
float penumbra_visibility(highp sampler2D crossings, highp sampler2D edges, penumbra_DBufferView view, float radius,
                          vec3 point) {
    if (!(point.z > 0.0f) || !penumbra_is_finite(point) || !(view.slopes.min.x < view.slopes.max.x) ||
        !(view.slopes.min.y < view.slopes.max.y))
        return 1.0f;
    vec2 at = penumbra_to_texel(view, point);
    float size = float(view.resolution);
    if (!(at.x >= 0.0f && at.x < size && at.y >= 0.0f && at.y < size)) return 1.0f;
    ivec2 texel = ivec2(int(at.x), int(at.y));
    vec4 first = texelFetch(crossings, texel, 0);
    float depth = penumbra_depth_of(point);
    bool behind = depth > first.w;
    if (!behind) texel.y += view.resolution;
    if (!behind) first = texelFetch(crossings, texel, 0);
    // what an edge leaves that was not crossed yet: nothing of the light, or all
    float uncrossed = behind ? 0.0f : 1.0f;
    if (!(first.x < 3.0e38f) || !(first.x < depth)) return uncrossed;
    penumbra_HidingEdge edge1 = penumbra_hiding_edge(edges, int(first.z));
    float t1 = penumbra_cut_share(edges, first, edge1, point, depth, behind, radius);
#if PENUMBRA_UMBRA_VOLUME_SHARE == PENUMBRA_CUT_SHARE_EDGE
    if (edge1.corner >= 0) {
        penumbra_HidingEdge beyond = penumbra_hiding_edge(edges, edge1.corner);
        return penumbra_past_two(edge1, beyond, t1, penumbra_share_of(edges, beyond, point, radius), point);
    }
#endif
    float v1 = penumbra_cut_visibility(t1, PENUMBRA_UMBRA_VOLUME_VISIBILITY);
#if PENUMBRA_UMBRA_VOLUME_SHARE == PENUMBRA_CUT_SHARE_EDGE
    v1 = max(v1, penumbra_past_neighbour(edges, edge1, edge1.before, t1, point, radius));
    v1 = max(v1, penumbra_past_neighbour(edges, edge1, edge1.after, t1, point, radius));
#endif
#if PENUMBRA_UMBRA_VOLUME_LAYERS < 2
    return v1;
#else
    vec4 second = texelFetch(crossings, ivec2(texel.x, texel.y + 2 * view.resolution), 0);
    if (!(second.x < 3.0e38f) || !(second.y < depth)) return v1;
    penumbra_HidingEdge edge2 = penumbra_hiding_edge(edges, int(second.z));
    bool crossed = second.x < depth;
    if (!crossed && edge1.mesh == edge2.mesh) return v1;
    float t2 = uncrossed;
    if (crossed) t2 = penumbra_cut_share(edges, second, edge2, point, depth, behind, radius);
    return penumbra_past_two(edge1, edge2, t1, t2, point);
#endif
}

#endif
