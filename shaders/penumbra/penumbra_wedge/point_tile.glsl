// A point that asks, with what bounds its pyramid to the light. C++ asks for tiles of points; here each invocation asks
// for its own.
//
// Options: none
// Error:   2 roundings
// C++:     include/penumbra/penumbra_wedge/point_tile.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_POINT_TILE_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_POINT_TILE_GLSL

#include "../geometry.glsl"

struct penumbra_WedgePoint {
    vec3 point;                      // light space, scaled; depth > 0
    penumbra_Rect2 light;            // its box
    float right, left, top, bottom;  // slopes of the pyramid's sides
};

penumbra_WedgePoint penumbra_wedge_point(vec3 point, vec2 half_size) {
    penumbra_WedgePoint p;
    p.point = point;
    p.light = penumbra_rect2(half_size * -1.0f, half_size);
    p.right = (point.x - half_size.x) / point.z;
    p.left = (point.x + half_size.x) / point.z;
    p.top = (point.y - half_size.y) / point.z;
    p.bottom = (point.y + half_size.y) / point.z;
    return p;
}

#endif
