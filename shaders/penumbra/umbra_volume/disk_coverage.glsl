// How much of a disk lies inside a closed loop, one edge at a time: what a silhouette blocks of a disk light.
//
// An edge's share is what lies of the disk below it, negative for edges that run to the right: a trapezium down to
// y = 0, half of the disk between its columns, and the columns beside it where it comes in or goes out above. No edge
// needs to know of any other. What is summed is the winding number: a part of the disk that a loop encloses twice
// counts twice.
//
// Options: none
// Error:   2.2 epsilon of the disk's area an edge with an end within 4 radii of the centre; 5e-7 a loop
// Source:  Green's theorem, derived anew
// C++:     include/penumbra/umbra_volume/disk_coverage.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_DISK_COVERAGE_GLSL
#define PENUMBRA_UMBRA_VOLUME_DISK_COVERAGE_GLSL

#include "../geometry.glsl"
#include "../numeric.glsl"
#include "disk_visibility.glsl"

// The share of the disk left of x, limited to the radius, less 1/2; `half_unit` is 1 / (2 radius).
float penumbra_left_of(float x, float radius, float half_unit) {
    float rest = abs(0.5f - abs(penumbra_clamp(x, -radius, radius)) * half_unit);
    float segment = rest * (sqrt(rest) * penumbra_segment_polynomial(rest));
    return x < 0.0f ? -(0.5f - segment) : 0.5f - segment;
}

// The signed area of the part of a disk around the origin that lies below the edge from a to b, towards -y, between its
// ends' columns: summed over a closed loop that runs counter-clockwise it is the loop's area inside the disk, winding
// counted. Plane coordinates, any unit; radius in [0, 1e18], coordinates up to 1e18 radii. 0 for a vertical edge, one
// of no length, one beside or below the disk, and for radius 0.
float penumbra_disk_edge_coverage(vec2 a, vec2 b, float radius) {
    // by a power of two to a radius from 1 to 2
    bool has_area = radius >= PENUMBRA_SMALLEST;
    float scale = has_area ? penumbra_exp2_int(penumbra_exponent_to_unit(radius)) : 0.0f;
    float scaled = has_area ? radius * scale : 1.0f;
    float area = has_area ? PENUMBRA_DISK_PI * radius * radius : 0.0f;
    float half_unit = 0.5f / scaled;
    float most = scaled * 1.15292150e18f;
    bool rightward = a.x < b.x;
    vec2 start = rightward ? a : b;
    vec2 end = rightward ? b : a;
    vec2 l = vec2(penumbra_clamp(start.x * scale, -most, most), penumbra_clamp(start.y * scale, -most, most));
    vec2 r = vec2(penumbra_clamp(end.x * scale, -most, most), penumbra_clamp(end.y * scale, -most, most));
    // the way from left to right, by a power of two to a length near 1; 0 if it has none, or a denormal
    float run = r.x - l.x;
    float rise = r.y - l.y;
    float size = abs(rise);
    float longer = run > size ? run : size;
    float shorten = longer >= PENUMBRA_SMALLEST ? penumbra_exp2_int(-penumbra_floor_log2(longer)) : 0.0f;
    float dx = run * shorten;
    float dy = rise * shorten;
    float inverse = 1.0f / (dx * dx + dy * dy + 16.0f * PENUMBRA_SMALLEST);
    // the line's point nearest to the centre, from the nearer end
    vec2 near = l.x * l.x + l.y * l.y <= r.x * r.x + r.y * r.y ? l : r;
    float moment = near.x * dy - near.y * dx;
    float across = moment * inverse;
    float foot_x = across * dy;
    float foot_y = -(across * dx);
    // from there to the rim, in units of dx and dy; 0 beside the disk
    float chord = (scaled * scaled - moment * across) * inverse;
    float reach = sqrt(chord > 0.0f ? chord : 0.0f);
    // the ends: those outside move along the line to the rim
    float along_l = (l.x * dx + l.y * dy) * inverse;
    float along_r = (r.x * dx + r.y * dy) * inverse;
    bool inside_l = reach - abs(along_l) >= 0.0f;
    bool inside_r = reach - abs(along_r) >= 0.0f;
    float along_0 = penumbra_clamp(along_l, -reach, reach);
    float along_1 = penumbra_clamp(along_r, -reach, reach);
    float x0 = inside_l ? l.x : foot_x + along_0 * dx;
    float y0 = inside_l ? l.y : foot_y + along_0 * dy;
    float x1 = inside_r ? r.x : foot_x + along_1 * dx;
    float y1 = inside_r ? r.y : foot_y + along_1 * dy;
    // 1 where the line comes in above, and where it goes out above
    float above_l = !inside_l && y0 >= 0.0f ? 1.0f : 0.0f;
    float above_r = !inside_r && y1 >= 0.0f ? 1.0f : 0.0f;
    float strips =
        above_r * penumbra_left_of(r.x, scaled, half_unit) - above_l * penumbra_left_of(l.x, scaled, half_unit);
    float halves = (above_l - 0.5f) * penumbra_left_of(x0, scaled, half_unit) +
                   (0.5f - above_r) * penumbra_left_of(x1, scaled, half_unit);
    float trapezium = (y0 + y1) * (x1 - x0) * (2.0f * half_unit * half_unit / PENUMBRA_DISK_PI);
    float below = (strips + halves + trapezium) * area;
    float counted = dx >= PENUMBRA_SMALLEST ? below : 0.0f;
    return rightward ? -counted : counted;
}

#endif
