// Boxes in texel units, as the prefilters take them.
//
// Options: none
// Error:   1 rounding
// C++:     include/penumbra/detail/boxes.hpp
#ifndef PENUMBRA_BOXES_GLSL
#define PENUMBRA_BOXES_GLSL

#include "../geometry.glsl"

// The least width and height of a box, texels: the limit of a box without size is what its middle reads.
#define PENUMBRA_SMALLEST_BOX 0.0625f

// A side's two ends (x, y), at least `least` apart about their middle, and where conversions to int are defined.
vec2 penumbra_widen(vec2 side, float least) {
    float low = penumbra_clamp(side.x, -1e9f, 1e9f);
    float high = penumbra_clamp(side.y, -1e9f, 1e9f);
    float middle = penumbra_clamp((low + high) * 0.5f, -65536.0f, 65536.0f);
    bool thin = !(high - low >= least);
    return thin ? vec2(middle - least * 0.5f, middle + least * 0.5f) : vec2(low, high);
}

penumbra_Rect2 penumbra_widen(penumbra_Rect2 box) {
    vec2 x = penumbra_widen(vec2(box.min.x, box.max.x), PENUMBRA_SMALLEST_BOX);
    vec2 y = penumbra_widen(vec2(box.min.y, box.max.y), PENUMBRA_SMALLEST_BOX);
    return penumbra_rect2(vec2(x.x, y.x), vec2(x.y, y.y));
}

// A box cut along its longer side into nearly square tiles, at most 8; more elongated ones are read in part.
struct penumbra_Tiles {
    vec2 first, step;  // centre of the first tile, and from centre to centre
    float size;        // mean of a tile's sides
    int count;
};

penumbra_Tiles penumbra_square_tiles(penumbra_Rect2 box) {
    vec2 size = penumbra_extent(box);
    bool wide = size.x > size.y;
    float longer = wide ? size.x : size.y;
    float shorter = wide ? size.y : size.x;
    penumbra_Tiles tiles;
    if (longer < 1.5f * shorter) {
        tiles.first = (box.min + box.max) * 0.5f;
        tiles.step = vec2(0.0f, 0.0f);
        tiles.size = (longer + shorter) * 0.5f;
        tiles.count = 1;
        return tiles;
    }
    tiles.count = int(penumbra_clamp(longer / shorter + 0.5f, 1.0f, 8.0f));
    float side = longer / float(tiles.count);
    vec2 tile = wide ? vec2(side, size.y) : vec2(size.x, side);
    tiles.step = wide ? vec2(side, 0.0f) : vec2(0.0f, side);
    tiles.first = box.min + tile * 0.5f;
    tiles.size = (side + shorter) * 0.5f;
    return tiles;
}

#endif
