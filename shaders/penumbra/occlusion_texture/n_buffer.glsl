// N-Buffers: the mean over every block of 2^l x 2^l texels, at every position, of four slices at once.
//
// The levels are an array of RGBA textures of one size. Level l of slices 4g .. 4g + 3 is layer l * groups + g. Taps
// are interpolated here, not by the sampler, whose weights have 8 bits only.
//
// Options: none
// Error:   .01 RMS across an edge, .02 in noise of single texels, of the largest value
// Source:  X. Decoret, "N-Buffers for efficient depth map query", 2005
//          E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006, section 4
// C++:     include/penumbra/occlusion_texture/n_buffer.hpp
#ifndef PENUMBRA_N_BUFFER_GLSL
#define PENUMBRA_N_BUFFER_GLSL

#include "../detail/boxes.glsl"

// The block of 2^level texels a side around a centre, moved into the image; a block larger than the image is the image.
vec4 penumbra_n_buffer_block(highp sampler2DArray levels, int groups, int group, int level, vec2 center_tx) {
    ivec3 size = textureSize(levels, 0);
    float block = penumbra_exp2_int(level);
    vec2 room = vec2(float(size.x) - block, float(size.y) - block);
    vec2 start = center_tx - vec2(block * 0.5f, block * 0.5f);
    vec2 at = vec2(penumbra_clamp(start.x, 0.0f, max(room.x, 0.0f)), penumbra_clamp(start.y, 0.0f, max(room.y, 0.0f)));
    ivec2 low = ivec2(at);
    ivec2 high = ivec2(low.x + 1 < size.x ? low.x + 1 : low.x, low.y + 1 < size.y ? low.y + 1 : low.y);
    vec2 fraction = at - vec2(low);
    int layer = level * groups + group;
    vec4 top = texelFetch(levels, ivec3(low.x, low.y, layer), 0) * (1.0f - fraction.x) +
               texelFetch(levels, ivec3(high.x, low.y, layer), 0) * fraction.x;
    vec4 bottom = texelFetch(levels, ivec3(low.x, high.y, layer), 0) * (1.0f - fraction.x) +
                  texelFetch(levels, ivec3(high.x, high.y, layer), 0) * fraction.x;
    // from the mean over the block to the mean over the part in the image
    float scale_x = room.x < 0.0f ? block / float(size.x) : 1.0f;
    float scale_y = room.y < 0.0f ? block / float(size.y) : 1.0f;
    return (top * (1.0f - fraction.y) + bottom * fraction.y) * (scale_x * scale_y);
}

// Means over a box in texel units, in the texture's unit; zeros outside the image. Blocks of the two levels next to the
// box's size are interpolated; elongated boxes are read as up to 8 square tiles. Boxes thinner than 1/16 texel are
// widened to that. `groups` layers make a level.
vec4 penumbra_n_buffer_mean(highp sampler2DArray levels, int groups, int group, penumbra_Rect2 box_tx) {
    vec4 sum = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    ivec3 size = textureSize(levels, 0);
    penumbra_Rect2 box = penumbra_widen(box_tx);
    penumbra_Rect2 image = penumbra_rect2(vec2(0.0f, 0.0f), vec2(float(size.x), float(size.y)));
    penumbra_Rect2 inside = penumbra_intersect(box, image);
    float share = penumbra_area(inside);
    if (!(share > 0.0f)) return sum;
    penumbra_Tiles tiles = penumbra_square_tiles(inside);
    float side = max(tiles.size, 1.0f);
    int top_level = size.z / groups - 1;
    int low = min(penumbra_floor_log2(side), top_level);
    int high = min(low + 1, top_level);
    // 1 / size runs linearly between the levels: that keeps the slope across an edge
    float weight = penumbra_saturate(2.0f - 2.0f * penumbra_exp2_int(low) / side);
    for (int i = 0; i < tiles.count; ++i) {
        vec2 center = tiles.first + tiles.step * float(i);
        sum += penumbra_n_buffer_block(levels, groups, group, low, center) * (1.0f - weight) +
               penumbra_n_buffer_block(levels, groups, group, high, center) * weight;
    }
    vec2 extent = penumbra_extent(box);
    return sum * (share / (extent.x * extent.y * float(tiles.count)));
}

#endif
