// Soft shadows of a rectangle light from occlusion textures: the query, for textures that were captured and
// prefiltered.
//
// Options: PENUMBRA_OCCLUSION_TEXTURE_FILTER       PENUMBRA_FILTER_SUMMED_AREA (default), _N_BUFFER or _MIPMAP
//          PENUMBRA_OCCLUSION_TEXTURE_COMBINATION  PENUMBRA_COMBINATION_MAX (default), _PRODUCT, _SUM or _MEAN
//          PENUMBRA_OCCLUSION_TEXTURE_CHANNELS     slices to a layer of the textures: 4 (default) or 1, which suits
//                                                  tables: R32UI, a quarter of the bandwidth
//          PENUMBRA_OCCLUSION_TEXTURE_CELLS        the light is split in n x n cells; 2
//          PENUMBRA_OCCLUSION_TEXTURE_PLANE        PENUMBRA_SLICE_PLANE_MIDDLE (default) or _BOTTOM
//          PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW  PENUMBRA_SELF_SHADOW_MEAN_DEPTH (default), _CLEAR or _FADE
//          PENUMBRA_OCCLUSION_TEXTURE_BIAS         of mean depth, in slices; 0.5f
// Error:   that of the method; 1e-5 from the C++ with the same textures
// Source:  E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006
// C++:     include/penumbra/occlusion_texture/shadow.hpp
#ifndef PENUMBRA_OCCLUSION_TEXTURE_SHADOW_GLSL
#define PENUMBRA_OCCLUSION_TEXTURE_SHADOW_GLSL

#include "../combine.glsl"
#include "mipmap.glsl"
#include "n_buffer.glsl"
#include "slice_camera.glsl"
#include "slices.glsl"
#include "summed_area.glsl"

#define PENUMBRA_FILTER_MIPMAP 0
#define PENUMBRA_FILTER_N_BUFFER 1
#define PENUMBRA_FILTER_SUMMED_AREA 2

#ifndef PENUMBRA_OCCLUSION_TEXTURE_FILTER
#define PENUMBRA_OCCLUSION_TEXTURE_FILTER PENUMBRA_FILTER_SUMMED_AREA
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_COMBINATION
#define PENUMBRA_OCCLUSION_TEXTURE_COMBINATION PENUMBRA_COMBINATION_MAX
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_CHANNELS
#define PENUMBRA_OCCLUSION_TEXTURE_CHANNELS 4
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_CELLS
#define PENUMBRA_OCCLUSION_TEXTURE_CELLS 2
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_PLANE
#define PENUMBRA_OCCLUSION_TEXTURE_PLANE PENUMBRA_SLICE_PLANE_MIDDLE
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW
#define PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW PENUMBRA_SELF_SHADOW_MEAN_DEPTH
#endif
#ifndef PENUMBRA_OCCLUSION_TEXTURE_BIAS
#define PENUMBRA_OCCLUSION_TEXTURE_BIAS 0.5f
#endif

#if PENUMBRA_OCCLUSION_TEXTURE_FILTER == PENUMBRA_FILTER_SUMMED_AREA
#define PENUMBRA_SLICE_SAMPLER usampler2DArray
#else
#define PENUMBRA_SLICE_SAMPLER sampler2DArray
#endif

// What a query needs besides the textures.
struct penumbra_OcclusionTexture {
    penumbra_SliceCamera camera;
    penumbra_SliceRange range;
    vec2 half_size;  // of the light, world units
    int levels;      // of mip-maps; the other filters ignore it
};

// Mean of a slice over a box, 0 to 1.
float penumbra_slice_mean(highp PENUMBRA_SLICE_SAMPLER slices, penumbra_OcclusionTexture info, int slice,
                          penumbra_Rect2 box_tx) {
    int layer = slice / PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
    int channel = slice - layer * PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
#if PENUMBRA_OCCLUSION_TEXTURE_FILTER == PENUMBRA_FILTER_SUMMED_AREA
    vec4 mean = penumbra_summed_area_mean(slices, layer, box_tx) * (1.0f / 255.0f);
#elif PENUMBRA_OCCLUSION_TEXTURE_FILTER == PENUMBRA_FILTER_N_BUFFER
    int layers = (info.range.count + PENUMBRA_OCCLUSION_TEXTURE_CHANNELS - 1) / PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
    vec4 mean = penumbra_n_buffer_mean(slices, layers, layer, box_tx);
#else
    vec4 mean = penumbra_mipmap_mean(slices, info.levels, layer, box_tx);
#endif
    return mean[channel];
}

// The kernel of a point on a slice, texels; no cell of it is thinner than the filters' least.
penumbra_Rect2 penumbra_slice_kernel(penumbra_OcclusionTexture info, int slice, vec3 point_ls) {
    float top = penumbra_top(info.range, slice);
    float plane = penumbra_slice_plane_depth(top, info.range.thickness, point_ls.z, PENUMBRA_OCCLUSION_TEXTURE_PLANE);
    penumbra_Rect2 light = penumbra_rect2(info.half_size * -1.0f, info.half_size);
    penumbra_Rect2 kernel = penumbra_footprint(info.camera, plane, point_ls, light);
    float cells = float(PENUMBRA_OCCLUSION_TEXTURE_CELLS);
    vec2 x = penumbra_widen(vec2(kernel.min.x, kernel.max.x), PENUMBRA_SMALLEST_BOX * cells);
    vec2 y = penumbra_widen(vec2(kernel.min.y, kernel.max.y), PENUMBRA_SMALLEST_BOX * cells);
    return penumbra_rect2(vec2(x.x, y.x), vec2(x.y, y.y));
}

// False if no cell of the kernel reads anything: most slices of most points, known from one sum.
bool penumbra_slice_may_block(highp PENUMBRA_SLICE_SAMPLER masks, penumbra_OcclusionTexture info, int slice,
                              penumbra_Rect2 kernel_tx) {
#if PENUMBRA_OCCLUSION_TEXTURE_FILTER == PENUMBRA_FILTER_SUMMED_AREA
    int layer = slice / PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
    int channel = slice - layer * PENUMBRA_OCCLUSION_TEXTURE_CHANNELS;
    // a texel more on each side than whole ones: cells are rounded
    ivec2 low = ivec2(clamp(kernel_tx.min, -65536.0f, 65536.0f)) - 2;
    ivec2 high = ivec2(clamp(kernel_tx.max, -65536.0f, 65536.0f)) + 2;
    return penumbra_summed_area_sum(masks, layer, low, high)[channel] != 0u;
#else
    return true;
#endif
}

// What a slice blocks of a cell of the light, in [0, 1].
float penumbra_slice_occlusion(highp PENUMBRA_SLICE_SAMPLER masks, highp PENUMBRA_SLICE_SAMPLER depths,
                               penumbra_OcclusionTexture info, int slice, ivec2 cell, penumbra_Rect2 kernel_tx,
                               vec3 point_ls) {
    float relative = penumbra_relative_depth(penumbra_top(info.range, slice), info.range.thickness, point_ls.z);
    vec2 corner = kernel_tx.min;
    vec2 step = (kernel_tx.max - kernel_tx.min) / float(PENUMBRA_OCCLUSION_TEXTURE_CELLS);
    penumbra_Rect2 box = penumbra_rect2(corner + step * vec2(cell), corner + step * vec2(cell + 1));

    float mask = penumbra_slice_mean(masks, info, slice, box);
    float mean_depth = 0.0f;
#if PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW == PENUMBRA_SELF_SHADOW_MEAN_DEPTH
    if (relative < 1.0f + 2.0f * PENUMBRA_OCCLUSION_TEXTURE_BIAS)
        mean_depth = penumbra_saturated_ratio(penumbra_slice_mean(depths, info, slice, box), mask);
#endif
    float weight = penumbra_slice_weight(relative, mean_depth, PENUMBRA_OCCLUSION_TEXTURE_BIAS,
                                         PENUMBRA_OCCLUSION_TEXTURE_SELF_SHADOW);
    return penumbra_saturate(mask * weight * 1.00001f);  // full occlusion stays full through the mean's rounding
}

// Fraction of the light that a point (light space) sees, in [0, 1]; 1 for points on or behind the light's plane.
// `depths` is read for PENUMBRA_SELF_SHADOW_MEAN_DEPTH only: pass `masks` twice otherwise.
float penumbra_visibility(highp PENUMBRA_SLICE_SAMPLER masks, highp PENUMBRA_SLICE_SAMPLER depths,
                          penumbra_OcclusionTexture info, vec3 point_ls) {
    if (!(point_ls.z > 0.0f)) return 1.0f;
    const int side = PENUMBRA_OCCLUSION_TEXTURE_CELLS, cells = side * side;
    penumbra_OcclusionAccumulator all[cells];
    for (int cell = 0; cell < cells; ++cell) all[cell] = penumbra_no_occlusion();
    for (int slice = 0; slice < info.range.count; ++slice) {
        if (!(point_ls.z > penumbra_top(info.range, slice))) continue;
        penumbra_Rect2 kernel = penumbra_slice_kernel(info, slice, point_ls);
        if (!penumbra_slice_may_block(masks, info, slice, kernel)) continue;
        for (int cell = 0; cell < cells; ++cell) {
            ivec2 at = ivec2(cell % side, cell / side);
            all[cell] = penumbra_add(all[cell],
                                     penumbra_slice_occlusion(masks, depths, info, slice, at, kernel, point_ls));
        }
    }
    float occluded = 0.0f;
    for (int cell = 0; cell < cells; ++cell)
        occluded += penumbra_result(all[cell], PENUMBRA_OCCLUSION_TEXTURE_COMBINATION);
    return penumbra_saturate((float(cells) - occluded) / float(cells));
}

#endif
