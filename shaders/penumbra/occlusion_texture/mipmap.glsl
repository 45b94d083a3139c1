// Mip-maps as a box filter, of four slices at once: the least memory, and the largest error.
//
// The slices are an array of RGBA textures with their mip levels; sides are powers of two, so that each level is
// exactly half of the one before. Taps are interpolated here, not by the sampler, whose weights have 8 bits only.
//
// Options: none
// Error:   .03 RMS across an edge, .05 in noise of single texels, of the largest value
// Source:  L. Williams, "Pyramidal parametrics", 1983
// C++:     include/penumbra/occlusion_texture/mipmap.hpp
#ifndef PENUMBRA_MIPMAP_GLSL
#define PENUMBRA_MIPMAP_GLSL

#include "../detail/boxes.glsl"

// Width and height of a level. Not textureSize(slices, level), which Mesa's software driver answers for one level at a
// time where invocations ask for several.
ivec2 penumbra_mipmap_size(highp sampler2DArray slices, int level) {
    ivec3 size = textureSize(slices, 0);
    return ivec2(max(size.x >> level, 1), max(size.y >> level, 1));
}

// The texel (x, y) of a level, zeros outside.
vec4 penumbra_mipmap_texel(highp sampler2DArray slices, int layer, int level, ivec2 at) {
    ivec2 size = penumbra_mipmap_size(slices, level);
    bool inside = at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
    ivec2 held = clamp(at, ivec2(0, 0), ivec2(size.x - 1, size.y - 1));
    vec4 texel = texelFetch(slices, ivec3(held.x, held.y, layer), level);
    return inside ? texel : vec4(0.0f, 0.0f, 0.0f, 0.0f);
}

// Bilinear tap of a level at a position of level 0, zeros outside.
vec4 penumbra_mipmap_tap(highp sampler2DArray slices, int layer, int level, vec2 center_tx) {
    ivec2 size = penumbra_mipmap_size(slices, level);
    float scale = 1.0f / penumbra_exp2_int(level);
    float x = penumbra_clamp(center_tx.x * scale - 0.5f, -2.0f, float(size.x) + 1.0f);
    float y = penumbra_clamp(center_tx.y * scale - 0.5f, -2.0f, float(size.y) + 1.0f);
    int x0 = int(x + 2.0f) - 2, y0 = int(y + 2.0f) - 2;
    float fx = x - float(x0), fy = y - float(y0);
    vec4 top = penumbra_mipmap_texel(slices, layer, level, ivec2(x0, y0)) * (1.0f - fx) +
               penumbra_mipmap_texel(slices, layer, level, ivec2(x0 + 1, y0)) * fx;
    vec4 bottom = penumbra_mipmap_texel(slices, layer, level, ivec2(x0, y0 + 1)) * (1.0f - fx) +
                  penumbra_mipmap_texel(slices, layer, level, ivec2(x0 + 1, y0 + 1)) * fx;
    return top * (1.0f - fy) + bottom * fy;
}

// Means over a box in texel units, in the texture's unit; zeros outside the image. Trilinear, between the levels next
// to 2^-0.8 times the box's size: a bilinear tap of a level is already wider than its texels. Elongated boxes are read
// as up to 8 square tiles. Boxes thinner than 1/16 texel are widened to that. `levels` are in the texture.
vec4 penumbra_mipmap_mean(highp sampler2DArray slices, int levels, int layer, penumbra_Rect2 box_tx) {
    vec4 sum = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    penumbra_Tiles tiles = penumbra_square_tiles(penumbra_widen(box_tx));
    float size = penumbra_clamp(tiles.size * 0.574349177498517f, 1.0f, penumbra_exp2_int(levels - 1));
    int low = penumbra_floor_log2(size);
    int high = min(low + 1, levels - 1);
    float weight = size / penumbra_exp2_int(low) - 1.0f;
    for (int i = 0; i < tiles.count; ++i) {
        vec2 center = tiles.first + tiles.step * float(i);
        sum += penumbra_mipmap_tap(slices, layer, low, center) * (1.0f - weight) +
               penumbra_mipmap_tap(slices, layer, high, center) * weight;
    }
    return sum / float(tiles.count);
}

#endif
