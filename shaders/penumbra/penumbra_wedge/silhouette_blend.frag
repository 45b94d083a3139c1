// Silhouette blending, fragment stage: what one silhouette, as the light's centre sees it, blocks of the light from the
// surfaces in its shadow; blended with what those before it block.
//
// The paper draws a volume for each edge, and sums what edges block by blending. Here a fragment sums a silhouette's
// edges, those that matter to it: one write a silhouette, in place of up to eight blended targets an edge.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, `precision highp float; precision highp int;` for ES.
// Drawn by silhouette_frustum.vert. Targets, and how they blend:
//   ADDITIVE             R32F, from 0          GL_FUNC_ADD, GL_ONE, GL_ONE
//   MAXIMUM              R32F, from 0          GL_MAX
//   PRODUCT              R32F, from 1          GL_FUNC_ADD, GL_ZERO, GL_ONE_MINUS_SRC_COLOR; what is left of the light
//   PRODUCT_QUADRANTS    RGBA32F, from 1       the same, of each quarter
//   RECTANGLES           RGBA32UI twice, from 0  none: penumbra_PackedParts
//   RECTANGLES_CENTROID  RGBA32UI three times, from 0: and each part's centre of gravity, x + 65536 y in 65535ths
// All silhouettes are one draw where targets blend. Rectangles are read from other textures than those drawn to: draw
// silhouettes no two of which may_meet(), copy them to the textures by silhouette_copy.frag, and so on. There the order
// of those that meet matters.
// Options: PENUMBRA_PENUMBRA_WEDGE_OVERLAP  see blending.glsl; PENUMBRA_OVERLAP_RECTANGLES
//          PENUMBRA_SILHOUETTE_WITHIN       1: surfaces within the box of the silhouette's mesh, most of them its own;
//                                           0 (default): all others, by less work
// Error:   2e-6 and packing's from PenumbraWedgeShadow's with SilhouetteFrom::light_center
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/blending.hpp, packing.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_OVERLAP
#define PENUMBRA_PENUMBRA_WEDGE_OVERLAP PENUMBRA_OVERLAP_RECTANGLES
#endif
#ifndef PENUMBRA_SILHOUETTE_WITHIN
#define PENUMBRA_SILHOUETTE_WITHIN 0
#endif
#define PENUMBRA_PENUMBRA_WEDGE_SILHOUETTE PENUMBRA_SILHOUETTE_LIGHT_CENTER
#include "../light.glsl"
#include "blending.glsl"
#include "packing.glsl"

#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP > PENUMBRA_OVERLAP_RECTANGLES_CENTROID
#error "RECTANGLE_PRODUCT, BITMASK and EXACT need hundreds of numbers a pixel: use shadow.glsl"
#endif

uniform highp sampler2D penumbra_positions;  // world space; w is 0 where nothing is asked
uniform highp sampler2D penumbra_wedges;     // WedgeTexels
uniform penumbra_WedgeShadow penumbra_shadow;
uniform penumbra_LightFrame penumbra_light;

flat in highp ivec2 penumbra_nodes;  // of the silhouette's mesh: their first texel, and that beyond their last

#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP < PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
layout(location = 0) out float penumbra_blocked;
#elif PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
layout(location = 0) out vec4 penumbra_blocked;
#else
uniform highp usampler2D penumbra_rects, penumbra_coverages;
layout(location = 0) out highp uvec4 penumbra_out_rects;
layout(location = 1) out highp uvec4 penumbra_out_coverages;
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_RECTANGLES_CENTROID
uniform highp usampler2D penumbra_centres;
layout(location = 2) out highp uvec4 penumbra_out_centres;
#endif
#endif

// What the silhouette's edges add up to.
struct penumbra_Sums {
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP <= PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
    vec4 areas;
#else
    penumbra_RadialPartBuilder builders[4];
#endif
};

penumbra_Sums penumbra_no_sums(penumbra_WedgePoint p) {
    penumbra_Sums sums;
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP <= PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
    sums.areas = vec4(0.0);
#else
    for (int q = 0; q < 4; ++q) sums.builders[q] = penumbra_radial_part_builder(penumbra_quadrant(p.light, q));
#endif
    return sums;
}

penumbra_Sums penumbra_add(penumbra_Sums sums, penumbra_WedgePoint p, vec2 from, vec2 to, float coefficient) {
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP <= PENUMBRA_OVERLAP_PRODUCT_QUADRANTS
    for (int part = 0; part < PENUMBRA_WEDGE_PARTS; ++part)
        sums.areas[part] += coefficient * penumbra_edge_coverage(from, to, penumbra_light_part(p.light, part));
#else
    for (int q = 0; q < 4; ++q) sums.builders[q] = penumbra_add(sums.builders[q], from, to, int(coefficient));
#endif
    return sums;
}

// The mesh's fixed silhouette, whose nodes are the first of the mesh's. What of it is beyond the point is cut off. `p`
// is mirrored in y if `mirrored`, and so is the silhouette then.
penumbra_Sums penumbra_sum(penumbra_WedgePoint p, bool mirrored) {
    vec3 mirror = vec3(1.0, mirrored ? -1.0 : 1.0, 1.0);
    penumbra_Sums sums = penumbra_no_sums(p);
    int node = penumbra_nodes.x, edge = 0, edge_end = 0;
    int end = int(penumbra_wedge_texel(penumbra_wedges, node).w);
    while (edge < edge_end || node < end) {
        if (edge < edge_end) {
            vec4 a = penumbra_wedge_texel(penumbra_wedges, edge);
            vec4 b = penumbra_wedge_texel(penumbra_wedges, edge + 1);
            vec3 from = vec3(a) * mirror, to = vec3(b) * mirror;
            penumbra_ProjectedEdge seen;
            seen.lands = true;
            if (PENUMBRA_SILHOUETTE_WITHIN == 0 && max(from.z, to.z) < p.point.z) {
                seen.a = penumbra_on_light(p, from);
                seen.b = penumbra_on_light(p, to);
            } else {
                seen = penumbra_project_edge(from, to, p.point, p.light);
            }
            // beside the light, or below it, an edge adds nothing
            bool matters = seen.lands && max(seen.a.y, seen.b.y) > p.light.min.y &&
                           max(seen.a.x, seen.b.x) > p.light.min.x && min(seen.a.x, seen.b.x) < p.light.max.x;
            if (matters) sums = penumbra_add(sums, p, seen.a, seen.b, (a.w - b.w) * mirror.y);
            edge += 2;
        } else {
            vec4 low = penumbra_wedge_texel(penumbra_wedges, node);
            vec4 high = penumbra_wedge_texel(penumbra_wedges, node + 1);
            vec4 items = penumbra_wedge_texel(penumbra_wedges, node + 4);
            vec3 corner = vec3(low) * mirror, opposite = vec3(high) * mirror;
            penumbra_Box3 box = penumbra_box3(min(corner, opposite), max(corner, opposite));
            int traits = int(high.w) & (PENUMBRA_WEDGE_IN_PIECE + PENUMBRA_WEDGE_PIECE);
            // nor do whole pieces above the light matter, if nothing is cut off of them
            bool is_open = PENUMBRA_SILHOUETTE_WITHIN == 1 || traits == PENUMBRA_WEDGE_IN_PIECE;
            bool misses = penumbra_misses(p, box, is_open);
            node = misses ? int(low.w) : node + 5;
            edge = int(items.x);
            edge_end = misses ? edge : int(items.y);
        }
    }
    return sums;
}

#if PENUMBRA_SILHOUETTE_WITHIN

// Closes a silhouette that is cut off at the point's depth. The cut is seen beyond all bounds. It matters where it
// crosses the light's columns, and above the light: in faces that are in line with the point along y, on the upper
// side. There what a face's edges leave of the columns is as wide as the light, or nothing. Faces that the point is on
// do not count: their edges do, against the silhouette. All edges go the same way through the same function, so that
// those that are nearly in the point's plane cancel.
penumbra_Sums penumbra_close(penumbra_WedgePoint p, penumbra_Sums sums) {
    float room = penumbra_shadow.tolerance * 2.0, unit = 0.5 / p.light.max.x, closed = 0.0;
    int node = int(penumbra_wedge_texel(penumbra_wedges, penumbra_nodes.x).w);  // beyond the fixed silhouette
    while (node < penumbra_nodes.y) {
        vec4 low = penumbra_wedge_texel(penumbra_wedges, node);
        vec4 high = penumbra_wedge_texel(penumbra_wedges, node + 1);
        vec4 items = penumbra_wedge_texel(penumbra_wedges, node + 4);
        bool in_line = p.point.x >= low.x - room && p.point.x <= high.x + room && p.point.z >= low.z - room &&
                       p.point.z <= high.z + room;
        node = in_line ? node + 5 : int(low.w);
        int end = in_line ? int(items.w) : 0;
        for (int face = int(items.z); face < end; face += 4) {
            vec4 normal = penumbra_wedge_texel(penumbra_wedges, face);
            vec4 a = penumbra_wedge_texel(penumbra_wedges, face + 1);
            vec3 b = vec3(penumbra_wedge_texel(penumbra_wedges, face + 2));
            vec3 c = vec3(penumbra_wedge_texel(penumbra_wedges, face + 3));
            vec3 least = min(min(vec3(a), b), c) - room, most = max(max(vec3(a), b), c) + room;
            if (a.w == 0.0 || p.point.x < least.x || p.point.x > most.x || p.point.z < least.z || p.point.z > most.z)
                continue;
            bool is_on = 0.0 == penumbra_face_coefficient(penumbra_wedges, vec3(normal), face, p,
                                                          penumbra_shadow.tolerance);
            // by its plane only where it may pass on either side: that of others may hold the point
            bool is_above = least.y + room > p.point.y ||
                            (most.y - room > p.point.y && dot(vec3(normal), p.point - vec3(a)) * normal.y < 0.0);
            float open = 0.0;
            for (int k = 0; k < 3; ++k) {
                vec3 from = k == 0 ? vec3(a) : (k == 1 ? b : c), to = k == 0 ? b : (k == 1 ? c : vec3(a));
                penumbra_ProjectedEdge seen = penumbra_project_edge(from, to, p.point, p.light);
                if (seen.lands) open += (seen.b.x - seen.a.x) * unit;
                if (seen.lands && is_on) sums = penumbra_add(sums, p, seen.a, seen.b, -a.w);
            }
            if (is_above && !is_on) closed += floor(open + 0.5) * a.w;
        }
    }
    vec2 above = p.light.max * 2.0;
    return penumbra_add(sums, p, above, vec2(-above.x, above.y), closed);
}

#endif

#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP <= PENUMBRA_OVERLAP_PRODUCT_QUADRANTS

// Whether the silhouette blocks anything.
bool penumbra_blend(penumbra_Sums sums, penumbra_WedgePoint p, bool mirrored) {
    float unit = float(PENUMBRA_WEDGE_PARTS) / penumbra_area(p.light);
    vec4 areas = vec4(0.0);
    for (int part = 0; part < PENUMBRA_WEDGE_PARTS; ++part)
        areas[part] = penumbra_saturate(penumbra_settle(sums.areas[part] * unit));
#if PENUMBRA_WEDGE_PARTS == 1
    penumbra_blocked = areas.x;
#else
    penumbra_blocked = mirrored ? areas.zwxy : areas;
#endif
    return areas.x + areas.y + areas.z + areas.w > 0.0;
}

#else

penumbra_RadialPart penumbra_mirrored(penumbra_RadialPart part) {
    penumbra_Rect2 rect = part.rect;
    part.rect = penumbra_rect2(vec2(rect.min.x, 1.0 - rect.max.y), vec2(rect.max.x, 1.0 - rect.min.y));
    part.moment.y = part.area - part.moment.y;
    return part;
}

#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_RECTANGLES_CENTROID

penumbra_RadialPart penumbra_with_centre(penumbra_RadialPart part, uint centre) {
    part.moment = vec2(float(centre & 65535u), float(centre >> 16u)) * (part.area / 65535.0);
    return penumbra_valid_part(part);
}
uint penumbra_centre(penumbra_RadialPart part) {
    float x = penumbra_saturated_ratio(part.moment.x, part.area);
    float y = penumbra_saturated_ratio(part.moment.y, part.area);
    return uint(x * 65535.0 + 0.5) | (uint(y * 65535.0 + 0.5) << 16u);
}

#endif

// Whether the silhouette blocks anything.
bool penumbra_blend(penumbra_Sums sums, penumbra_WedgePoint p, bool mirrored) {
    penumbra_FourParts silhouette;
    float area = 0.0;
    for (int q = 0; q < 4; ++q) {
        silhouette.part[q] = penumbra_finish(sums.builders[q]);
        area += silhouette.part[q].area;
    }
    if (!(area > 0.0)) return false;
    if (mirrored) {
        penumbra_FourParts other = silhouette;
        for (int q = 0; q < 4; ++q) silhouette.part[q] = penumbra_mirrored(other.part[q ^ 2]);
    }
    ivec2 texel = ivec2(gl_FragCoord.xy);
    penumbra_PackedParts before;
    before.rects = texelFetch(penumbra_rects, texel, 0);
    before.coverages = texelFetch(penumbra_coverages, texel, 0);
    penumbra_FourParts parts = penumbra_unpack_parts(before);
#if PENUMBRA_PENUMBRA_WEDGE_OVERLAP == PENUMBRA_OVERLAP_RECTANGLES_CENTROID
    uvec4 centres = texelFetch(penumbra_centres, texel, 0);
    for (int q = 0; q < 4; ++q) {
        penumbra_RadialPart part = penumbra_with_centre(parts.part[q], centres[q]);
        parts.part[q] = penumbra_blend_centroid(part, silhouette.part[q]);
        centres[q] = penumbra_centre(parts.part[q]);
    }
    penumbra_out_centres = centres;
#else
    for (int q = 0; q < 4; ++q) parts.part[q] = penumbra_blend(parts.part[q], silhouette.part[q]);
#endif
    penumbra_PackedParts after = penumbra_pack_parts(parts);
    penumbra_out_rects = after.rects;
    penumbra_out_coverages = after.coverages;
    return true;
}

#endif

void main() {
    vec4 point = texelFetch(penumbra_positions, ivec2(gl_FragCoord.xy), 0);
    vec3 point_ls = penumbra_to_light(penumbra_light, point.xyz) * penumbra_shadow.scale;
    if (!(point.w > 0.0) || !(point_ls.z > 0.0) || !penumbra_is_finite(point_ls)) discard;
    vec3 low = vec3(penumbra_wedge_texel(penumbra_wedges, penumbra_nodes.x)) - penumbra_shadow.tolerance * 2.0;
    vec3 high = vec3(penumbra_wedge_texel(penumbra_wedges, penumbra_nodes.x + 1)) + penumbra_shadow.tolerance * 2.0;
    bool reaches_depth = point_ls.z <= high.z;
    bool within = reaches_depth && point_ls.x >= low.x && point_ls.x <= high.x && point_ls.y >= low.y &&
                  point_ls.y <= high.y;
    if (within != (PENUMBRA_SILHOUETTE_WITHIN == 1)) discard;
    // away from a mesh at its depth, what is open is seen far below the light, or far above: there it does not matter
    bool mirrored = reaches_depth && !within && point_ls.y < 0.5 * (low.y + high.y);
    if (mirrored) point_ls.y = -point_ls.y;
    penumbra_WedgePoint p = penumbra_wedge_point(point_ls, penumbra_shadow.half_size);
    penumbra_Sums sums = penumbra_sum(p, mirrored);
#if PENUMBRA_SILHOUETTE_WITHIN
    sums = penumbra_close(p, sums);
#endif
    if (!penumbra_blend(sums, p, mirrored)) discard;
}
