// The part of an occluding plane through which a point sees the light: what an occlusion texture is averaged over.
//
// Options: none
// Error:   2 roundings
// Source:  E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006, eq. 4
// C++:     include/penumbra/occlusion_texture/kernel.hpp
#ifndef PENUMBRA_KERNEL_GLSL
#define PENUMBRA_KERNEL_GLSL

#include "../geometry.glsl"

// Size of the kernel as a fraction of the light's: (p - z) / p, in [0, 1]. Depths in world units from the light's
// plane. 0 where the occluder is not between light and point; 1 where it touches or lies behind the light.
float penumbra_kernel_scale(float occluder_depth, float point_depth) {
    float scale = penumbra_saturated_ratio(point_depth - occluder_depth, point_depth);
    return point_depth > 0.0f ? scale : 0.0f;
}

// Size of the kernel in the unit of `light_size` (half-extent, extent or radius alike). In [0, light_size].
float penumbra_kernel_size(float occluder_depth, float point_depth, float light_size) {
    return light_size * penumbra_kernel_scale(occluder_depth, point_depth);
}

// The kernel on the plane at `occluder_depth` through which a point sees a part of the light. Light space, world units;
// `light_part_ls` is the whole light, [-S, S], or any cell of it. A kernel of scale 0 is the single point P_xy.
penumbra_Rect2 penumbra_kernel_rect(float occluder_depth, vec3 point_ls, penumbra_Rect2 light_part_ls) {
    float scale = penumbra_kernel_scale(occluder_depth, point_ls.z);
    vec2 shift = vec2(point_ls.x, point_ls.y) * (1.0f - scale);
    return penumbra_rect2(shift + light_part_ls.min * scale, shift + light_part_ls.max * scale);
}

#endif
