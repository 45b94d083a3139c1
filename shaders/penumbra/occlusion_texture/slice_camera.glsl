// The camera that sees all slices: centred behind the light, so that one image serves every point of the light.
//
// In light space a point (X, Y, z) lands on (X, Y) / (1 + c z), where c is the camera's convergence, 1 / its distance
// behind the light; c = 0 is orthographic. fit_slice_camera (C++) finds one for a scene.
//
// Options: none
// Error:   texel positions by 4 roundings of their largest part
// Source:  E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006, section 3.2
// C++:     include/penumbra/occlusion_texture/slice_camera.hpp
#ifndef PENUMBRA_SLICE_CAMERA_GLSL
#define PENUMBRA_SLICE_CAMERA_GLSL

#include "kernel.glsl"

// Maps light space to the texels that all slices share.
struct penumbra_SliceCamera {
    float convergence;  // 1 / distance of the centre behind the light; 0 is orthographic
    vec2 origin_tx;     // texel position of the optical axis
    vec2 scale_tx;      // texels per world unit at the light's plane
    int width, height;  // texels
};

// Homogeneous texel position of a point in light space: (x, y, depth, w). w > 0 for every point on the lit side.
vec4 penumbra_project(penumbra_SliceCamera camera, vec3 point_ls) {
    float w = 1.0f + camera.convergence * point_ls.z;
    return vec4(point_ls.x * camera.scale_tx.x + camera.origin_tx.x * w,
                point_ls.y * camera.scale_tx.y + camera.origin_tx.y * w, point_ls.z, w);
}

// The kernel of a point for a part of the light (see kernel_rect), in texels. Depths on the lit side.
penumbra_Rect2 penumbra_footprint(penumbra_SliceCamera camera, float occluder_depth, vec3 point_ls,
                                  penumbra_Rect2 light_part_ls) {
    float w = 1.0f + camera.convergence * (occluder_depth > 0.0f ? occluder_depth : 0.0f);
    vec2 scale = camera.scale_tx * (1.0f / w);
    penumbra_Rect2 kernel = penumbra_kernel_rect(occluder_depth, point_ls, light_part_ls);
    return penumbra_rect2(kernel.min * scale + camera.origin_tx, kernel.max * scale + camera.origin_tx);
}

#endif
