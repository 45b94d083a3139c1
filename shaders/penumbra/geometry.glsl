// Vectors, rectangles, boxes and planes.
//
// Options: none
// Error:   3.5 ULP a component for unit vectors, and the driver's sqrt and division; the rest is exact or one rounding.
// Source:  T. Duff et al., "Building an orthonormal basis, revisited", 2017 (any_perpendicular)
// C++:     include/penumbra/geometry.hpp
#ifndef PENUMBRA_GEOMETRY_GLSL
#define PENUMBRA_GEOMETRY_GLSL

#include "numeric.glsl"

// True unless a component is NaN or infinite.
bool penumbra_is_finite(vec2 v) { return penumbra_is_finite(v.x) && penumbra_is_finite(v.y); }
bool penumbra_is_finite(vec3 v) {
    return penumbra_is_finite(v.x) && penumbra_is_finite(v.y) && penumbra_is_finite(v.z);
}

float penumbra_largest_component(vec3 v) {
    vec3 magnitude = abs(v);
    return max(magnitude.x, max(magnitude.y, magnitude.z));
}

// The exponent of the power of two that brings `largest` near 1, where squares neither overflow nor vanish.
int penumbra_exponent_to_unit(float largest) { return clamp(-penumbra_floor_log2(largest), -126, 126); }

// v / |v|, or `fallback` where v is too short to have a direction (length below the smallest normal number), or not
// finite. Scales before squaring.
vec3 penumbra_normalize_or(vec3 v, vec3 fallback) {
    float largest = penumbra_largest_component(v);
    if (!(largest >= PENUMBRA_SMALLEST) || !penumbra_is_finite(largest)) return fallback;
    vec3 scaled = v * penumbra_exp2_int(penumbra_exponent_to_unit(largest));
    return scaled / sqrt(dot(scaled, scaled));
}

// |v|, also where the squares of its coordinates would overflow or vanish.
float penumbra_safe_length(vec3 v) {
    int exponent = penumbra_exponent_to_unit(penumbra_largest_component(v));
    vec3 scaled = v * penumbra_exp2_int(exponent);
    return sqrt(dot(scaled, scaled)) * penumbra_exp2_int(-exponent);
}

// A unit vector perpendicular to the unit vector n. Continuous except where n.z changes sign.
vec3 penumbra_any_perpendicular(vec3 n) {
    float s = n.z < 0.0f ? -1.0f : 1.0f;
    float a = -1.0f / (s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

// An axis-aligned rectangle, closed; empty where max < min in a coordinate.
struct penumbra_Rect2 {
    vec2 min, max;
};

penumbra_Rect2 penumbra_rect2(vec2 low, vec2 high) {
    penumbra_Rect2 r;
    r.min = low;
    r.max = high;
    return r;
}

// The rectangle that contains nothing and that `extend` may start from.
penumbra_Rect2 penumbra_empty_rect() {
    float big = 3.40282347e+38f;
    return penumbra_rect2(vec2(big, big), vec2(-big, -big));
}

vec2 penumbra_extent(penumbra_Rect2 r) { return r.max - r.min; }

penumbra_Rect2 penumbra_extend(penumbra_Rect2 r, vec2 point) {
    return penumbra_rect2(min(r.min, point), max(r.max, point));
}

penumbra_Rect2 penumbra_intersect(penumbra_Rect2 a, penumbra_Rect2 b) {
    return penumbra_rect2(max(a.min, b.min), min(a.max, b.max));
}

// Area of r; 0 for an empty one.
float penumbra_area(penumbra_Rect2 r) {
    vec2 size = penumbra_extent(r);
    return size.x > 0.0f && size.y > 0.0f ? size.x * size.y : 0.0f;
}

// An axis-aligned box, closed; empty where max < min in a coordinate.
struct penumbra_Box3 {
    vec3 min, max;
};

penumbra_Box3 penumbra_box3(vec3 low, vec3 high) {
    penumbra_Box3 b;
    b.min = low;
    b.max = high;
    return b;
}

// The box that contains nothing and that `extend` may start from.
penumbra_Box3 penumbra_empty_box() {
    float big = 3.40282347e+38f;
    return penumbra_box3(vec3(big, big, big), vec3(-big, -big, -big));
}

bool penumbra_is_empty(penumbra_Box3 b) { return !(b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z); }

penumbra_Box3 penumbra_extend(penumbra_Box3 b, vec3 point) {
    return penumbra_box3(min(b.min, point), max(b.max, point));
}

// The plane { x : dot(normal, x) + offset = 0 }; its inside is where the left side is >= 0.
struct penumbra_Plane {
    vec3 normal;
    float offset;
};

// Signed distance of `point` in units of |normal|; >= 0 inside.
float penumbra_signed_distance(penumbra_Plane plane, vec3 point) { return dot(plane.normal, point) + plane.offset; }

#endif
