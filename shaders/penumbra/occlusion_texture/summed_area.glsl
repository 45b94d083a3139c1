// Summed-area tables: the exact mean over any box, at fractional positions too, of four slices at once.
//
// A table is an array of RGBA32UI textures, a layer for four slices, of (width + 1) x (height + 1) texels: texel (x, y)
// is the sum over [0, x) x [0, y). Nothing is filtered, so no driver needs to filter integers.
//
// Options: none
// Error:   1e-6 of the largest texel: sums are differenced in integers before they are rounded
// Source:  F. Crow, "Summed-area tables for texture mapping", 1984
// C++:     include/penumbra/occlusion_texture/summed_area.hpp
#ifndef PENUMBRA_SUMMED_AREA_GLSL
#define PENUMBRA_SUMMED_AREA_GLSL

#include "../detail/boxes.glsl"

// Sums of the texels [low, high), cut to the image; 0 if it is empty. Exact while they fit 32 bits.
uvec4 penumbra_summed_area_sum(highp usampler2DArray table, int layer, ivec2 low, ivec2 high) {
    ivec3 size = textureSize(table, 0);
    ivec2 last = ivec2(size.x - 1, size.y - 1);
    ivec2 a = clamp(low, ivec2(0, 0), last), b = clamp(high, ivec2(0, 0), last);
    if (b.x <= a.x || b.y <= a.y) return uvec4(0u, 0u, 0u, 0u);
    uvec4 right = texelFetch(table, ivec3(b.x, b.y, layer), 0) - texelFetch(table, ivec3(b.x, a.y, layer), 0);
    uvec4 left = texelFetch(table, ivec3(a.x, b.y, layer), 0) - texelFetch(table, ivec3(a.x, a.y, layer), 0);
    return right - left;
}

// A corner of a box: the sums before its whole texels, of the column below that up to them, of the row beside it, and
// its texel.
struct penumbra_SummedAreaCorner {
    uvec4 sum, column, row;
    vec4 texel;
};

penumbra_SummedAreaCorner penumbra_summed_area_corner(highp usampler2DArray table, int layer, ivec2 at) {
    uvec4 first = texelFetch(table, ivec3(at.x, at.y, layer), 0);
    uvec4 right = texelFetch(table, ivec3(at.x + 1, at.y, layer), 0);
    uvec4 below = texelFetch(table, ivec3(at.x, at.y + 1, layer), 0);
    uvec4 both = texelFetch(table, ivec3(at.x + 1, at.y + 1, layer), 0);
    penumbra_SummedAreaCorner corner;
    corner.sum = first;
    corner.column = right - first;
    corner.row = below - first;
    corner.texel = vec4(both - below - corner.column);
    return corner;
}

// Means over a box in texel units, in the texels' unit. Texels count by the area that lies in the box; outside the
// image there are zeros. Boxes thinner than 1/16 texel are widened to that.
vec4 penumbra_summed_area_mean(highp usampler2DArray table, int layer, penumbra_Rect2 box_tx) {
    penumbra_Rect2 box = penumbra_widen(box_tx);
    ivec3 sums = textureSize(table, 0);
    ivec2 size = ivec2(sums.x - 1, sums.y - 1);
    vec2 limit = vec2(size);
    vec2 low = clamp(box.min, vec2(0.0f, 0.0f), limit), high = clamp(box.max, vec2(0.0f, 0.0f), limit);
    ivec2 first = min(ivec2(low), size - 1), last = min(ivec2(high), size - 1);
    vec2 before = low - vec2(first), beyond = high - vec2(last);

    penumbra_SummedAreaCorner a = penumbra_summed_area_corner(table, layer, ivec2(first.x, first.y));
    penumbra_SummedAreaCorner b = penumbra_summed_area_corner(table, layer, ivec2(last.x, first.y));
    penumbra_SummedAreaCorner c = penumbra_summed_area_corner(table, layer, ivec2(first.x, last.y));
    penumbra_SummedAreaCorner d = penumbra_summed_area_corner(table, layer, ivec2(last.x, last.y));
    vec4 whole = vec4((d.sum - c.sum) - (b.sum - a.sum)) + beyond.x * vec4(d.column - b.column) -
                 before.x * vec4(c.column - a.column);
    vec4 rows_below = vec4(d.row - c.row) + beyond.x * d.texel - before.x * c.texel;
    vec4 rows_above = vec4(b.row - a.row) + beyond.x * b.texel - before.x * a.texel;
    vec4 sum = whole + beyond.y * rows_below - before.y * rows_above;
    vec2 extent = penumbra_extent(box);
    return max(sum, vec4(0.0f, 0.0f, 0.0f, 0.0f)) / (extent.x * extent.y);
}

#endif
