// Extrusion points: where the planes through a caster's edge that touch a disk light touch it.
//
// The penumbra plane has the disk and the caster on opposite sides, the umbra plane has both on one side. No special case
// for edges that are parallel to the light.
//
// Options: none
// Error:   4 epsilon r from being tangent where the edge's line meets the light's plane beyond 2 r, 40 at 1.001 r
// Source:  the umbra and penumbra volume paper for circular lights; derived anew, homogeneous
// C++:     include/penumbra/umbra_volume/extrusion.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_EXTRUSION_GLSL
#define PENUMBRA_UMBRA_VOLUME_EXTRUSION_GLSL

#include "../light.glsl"

// Points of a disk's rim, world space. Not valid where the edge's line meets the disk.
struct penumbra_ExtrusionPoints {
    vec3 umbra, penumbra;
    bool valid;
};

// The extrusion points of the edge from v1 to v2, for a disk of that radius around the frame's origin. World space. The
// caster lies on the left of the edge as seen from the light, that is, on the side of the plane through v1, v2 and a
// point p of the disk where dot(cross(v1 - p, v2 - p), q - p) < 0. Not valid where the edge's line meets the disk: both
// points are then the rim's nearest to where it does, or the centre.
penumbra_ExtrusionPoints penumbra_extrusion_points(vec3 v1, vec3 v2, penumbra_LightFrame frame, float radius) {
    vec3 a = penumbra_to_light(frame, v1);
    vec3 b = penumbra_to_light(frame, v2);
    // from the nearer vertex, so that one far away does not drown what lies at the light
    float distance1 = dot(a, a);
    float distance2 = dot(b, b);
    bool by_order = a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z);
    bool forward = distance1 < distance2 || (distance1 == distance2 && by_order);
    vec3 start = forward ? a : b;
    // e turned, not the difference of what was turned
    vec3 along_ws = forward ? v2 - v1 : v1 - v2;
    vec3 scaled = along_ws * penumbra_exp2_int(penumbra_exponent_to_unit(penumbra_largest_component(along_ws)));
    vec3 along = vec3(dot(scaled, frame.u), dot(scaled, frame.v), dot(scaled, frame.normal));
    vec2 across = vec2(start.z * along.x - along.z * start.x, start.z * along.y - along.z * start.y);
    float reach = penumbra_safe_length(vec3(across.x, across.y, 0.0f));
    float slope = -along.z;
    bool has_direction = reach >= PENUMBRA_SMALLEST;
    float divisor = has_direction ? reach : 1.0f;
    vec2 outward = vec2(has_direction ? across.x / divisor : 0.0f, has_direction ? across.y / divisor : 0.0f);
    float limit = radius * abs(slope);
    float cosine = penumbra_clamp(radius * slope / divisor, -1.0f, 1.0f);
    penumbra_ExtrusionPoints points;
    points.valid = has_direction && reach > limit;
    float sine = points.valid ? sqrt((reach - limit) * (reach + limit)) / divisor : 0.0f;
    float side = forward ? sine : -sine;
    vec3 foot = vec3(outward.x * (radius * cosine), outward.y * (radius * cosine), 0.0f);
    vec3 aside = vec3(-outward.y * (radius * side), outward.x * (radius * side), 0.0f);
    points.umbra = penumbra_to_world(frame, foot + aside);
    points.penumbra = penumbra_to_world(frame, foot - aside);
    return points;
}

// The same for a disk light.
penumbra_ExtrusionPoints penumbra_extrusion_points(vec3 v1, vec3 v2, penumbra_DiskLight light) {
    return penumbra_extrusion_points(v1, v2, penumbra_light_frame(light), light.radius);
}

#endif
