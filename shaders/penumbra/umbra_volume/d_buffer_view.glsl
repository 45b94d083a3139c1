// The image that a D-buffer is: directions from the light's centre, and depths along them.
//
// Options: PENUMBRA_UMBRA_VOLUME_DEPTH  what depths are: one of PENUMBRA_D_BUFFER_DEPTH_...
// Error:   texels by 4 roundings of the largest slope over the image's
// Source:  the umbra and penumbra volume paper for circular lights
// C++:     include/penumbra/umbra_volume/d_buffer_view.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_D_BUFFER_VIEW_GLSL
#define PENUMBRA_UMBRA_VOLUME_D_BUFFER_VIEW_GLSL

#include "../geometry.glsl"

// From the light's plane, or from its centre.
#define PENUMBRA_D_BUFFER_DEPTH_LIGHT_PLANE 0
#define PENUMBRA_D_BUFFER_DEPTH_EUCLIDEAN 1

#ifndef PENUMBRA_UMBRA_VOLUME_DEPTH
#define PENUMBRA_UMBRA_VOLUME_DEPTH PENUMBRA_D_BUFFER_DEPTH_LIGHT_PLANE
#endif

// The depth of what is not there.
#define PENUMBRA_D_BUFFER_NONE 3.402823466e38f

// The texels of an image from the light's centre: `slopes` x / z and y / z of its borders.
struct penumbra_DBufferView {
    penumbra_Rect2 slopes;
    int resolution;
};

// A point's depth, as the image has depths.
float penumbra_depth_of(vec3 point_ls) {
#if PENUMBRA_UMBRA_VOLUME_DEPTH == PENUMBRA_D_BUFFER_DEPTH_EUCLIDEAN
    return penumbra_safe_length(point_ls);
#else
    return point_ls.z;
#endif
}

// The texel that a point in light space, at depth > 0, lies in.
vec2 penumbra_to_texel(penumbra_DBufferView view, vec3 point_ls) {
    vec2 size = penumbra_extent(view.slopes);
    vec2 slope = vec2(point_ls.x / point_ls.z, point_ls.y / point_ls.z);
    return vec2((slope.x - view.slopes.min.x) / size.x, (slope.y - view.slopes.min.y) / size.y) *
           float(view.resolution);
}

// Where a ray through position (x, y) of the image, in texels, is at distance 1 from the light's plane, in light space.
vec3 penumbra_texel_ray(penumbra_DBufferView view, vec2 at_tx) {
    vec2 slope = view.slopes.min + penumbra_extent(view.slopes) * at_tx / float(view.resolution);
    return vec3(slope.x, slope.y, 1.0f);
}

#endif
