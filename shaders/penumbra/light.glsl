// The three lights, and the frame in which a light sees the scene.
//
// Options: none
// Error:   4 ULP a component of a frame; positions in it by 3 roundings of the offset from the light; of project_box,
//          see there.
// C++:     include/penumbra/light.hpp
#ifndef PENUMBRA_LIGHT_GLSL
#define PENUMBRA_LIGHT_GLSL

#include "geometry.glsl"

// A rectangle that emits along cross(half_u, half_v). World space, world units; half_u is perpendicular to half_v.
struct penumbra_RectLight {
    vec3 center, half_u, half_v;
};

// A disk that emits along `normal`, which need not be of unit length. World space, world units.
struct penumbra_DiskLight {
    vec3 center, normal;
    float radius;
};

// A line segment from a to b that emits in every direction. World space, world units.
struct penumbra_LinearLight {
    vec3 a, b;
};

// An orthonormal, right-handed frame whose third axis is the light's emission direction. In light space (_ls) the third
// coordinate is the depth: 0 on the light's plane, positive on the lit side.
struct penumbra_LightFrame {
    vec3 origin, u, v, normal;
};

// World space to light space.
vec3 penumbra_to_light(penumbra_LightFrame frame, vec3 point_ws) {
    vec3 offset = point_ws - frame.origin;
    return vec3(dot(offset, frame.u), dot(offset, frame.v), dot(offset, frame.normal));
}

// Light space to world space.
vec3 penumbra_to_world(penumbra_LightFrame frame, vec3 point_ls) {
    return frame.origin + point_ls.x * frame.u + point_ls.y * frame.v + point_ls.z * frame.normal;
}

// Half-extents of a rectangle light along its frame's u and v, world units.
vec2 penumbra_half_size(penumbra_RectLight light) {
    return vec2(penumbra_safe_length(light.half_u), penumbra_safe_length(light.half_v));
}

penumbra_LightFrame penumbra_make_frame(vec3 origin, vec3 u, vec3 v, vec3 normal) {
    penumbra_LightFrame frame;
    frame.origin = origin;
    frame.u = u;
    frame.v = v;
    frame.normal = normal;
    return frame;
}

// The frame of a rectangle light. A zero-size side takes any direction perpendicular to the other; a light with no size
// at all emits along `aim` (world space, any length), or along -z where `aim` has no direction either.
penumbra_LightFrame penumbra_light_frame(penumbra_RectLight light, vec3 aim) {
    vec3 zero = vec3(0.0f, 0.0f, 0.0f);
    vec3 u = penumbra_normalize_or(light.half_u, zero);
    vec3 v = penumbra_normalize_or(light.half_v, zero);
    bool has_u = dot(u, u) > 0.0f, has_v = dot(v, v) > 0.0f;
    vec3 direction = penumbra_normalize_or(aim, vec3(0.0f, 0.0f, -1.0f));
    if (!has_u || !has_v) {
        // with a side missing, the normal is the part of `aim` perpendicular to the side that is there
        vec3 side = has_u ? u : (has_v ? v : zero);
        vec3 across = direction - side * dot(direction, side);
        vec3 normal =
            dot(across, across) > 1e-6f ? penumbra_normalize_or(across, direction) : penumbra_any_perpendicular(side);
        // again: what rounding left along the side is large beside an `across` of 1e-3
        normal = penumbra_normalize_or(normal - side * dot(normal, side), normal);
        if (!has_u && !has_v) u = penumbra_any_perpendicular(normal);
        if (!has_u && has_v) u = cross(v, normal);
        return penumbra_make_frame(light.center, u, cross(normal, u), normal);
    }
    vec3 normal = penumbra_normalize_or(cross(u, v), direction);
    return penumbra_make_frame(light.center, u, cross(normal, u), normal);
}

// The frame of a disk light: third axis along its normal (-z where it has none), first axis arbitrary.
penumbra_LightFrame penumbra_light_frame(penumbra_DiskLight light) {
    vec3 normal = penumbra_normalize_or(light.normal, vec3(0.0f, 0.0f, -1.0f));
    vec3 u = penumbra_any_perpendicular(normal);
    return penumbra_make_frame(light.center, u, cross(normal, u), normal);
}

// The frame of a linear light: origin at its midpoint, first axis along b - a, third axis the part of `aim`
// perpendicular to it (any perpendicular where `aim` runs along the light).
penumbra_LightFrame penumbra_light_frame(penumbra_LinearLight light, vec3 aim) {
    penumbra_RectLight line;
    line.half_u = light.b * 0.5f - light.a * 0.5f;  // halved first: b - a may overflow
    line.half_v = vec3(0.0f, 0.0f, 0.0f);
    line.center = light.a + line.half_u;
    return penumbra_light_frame(line, aim);
}

// The ends, along one axis, of where points of a caster at [low, high] appear from receivers at [from, to], on the
// light's plane. E appears at E + (E - P)(m - 1) from P, m = p / (p - z) being between `least` and `most`.
vec2 penumbra_project_range(float low, float high, float from, float to, float least, float most) {
    float left = low - to;
    float right = high - from;
    return vec2(low + left * ((left < 0.0f ? most : least) - 1.0f),
                high + right * ((right > 0.0f ? most : least) - 1.0f));
}

// Where on the light's plane any point of a caster's box may appear from any point of the receivers' box, both in light
// space. What the caster has behind the light's plane, and beyond the receivers, is left out; empty if nothing is left.
// Where some receiver lies no deeper than the caster, the rectangle reaches 1e9 times as far as they are apart. Error:
// 4 roundings of the largest coordinate, times p / (p - z).
penumbra_Rect2 penumbra_project_box(penumbra_Box3 caster_ls, penumbra_Box3 receivers_ls) {
    float near = caster_ls.min.z > 0.0f ? caster_ls.min.z : 0.0f;
    if (penumbra_is_empty(caster_ls) || penumbra_is_empty(receivers_ls) || !(near < receivers_ls.max.z) ||
        !(caster_ls.max.z > 0.0f))
        return penumbra_empty_rect();
    float far = 1e9f;
    float room = receivers_ls.min.z - caster_ls.max.z;
    float least = receivers_ls.max.z / (receivers_ls.max.z - near);
    float most = room * far > receivers_ls.min.z ? receivers_ls.min.z / room : far;
    most = most > least ? most : least;
    vec2 x = penumbra_project_range(caster_ls.min.x, caster_ls.max.x, receivers_ls.min.x, receivers_ls.max.x, least,
                                    most);
    vec2 y = penumbra_project_range(caster_ls.min.y, caster_ls.max.y, receivers_ls.min.y, receivers_ls.max.y, least,
                                    most);
    return penumbra_rect2(vec2(x.x, y.x), vec2(x.y, y.y));
}

#endif
