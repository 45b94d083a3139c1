// Intervals of a line light that are hidden from a point, and their union: sorted and exact, or as a mask of cells.
//
// Positions on the light are shares of it, 0 at one end and 1 at the other.
//
// Options: none
// Error:   hidden_interval 4 epsilon (|slopes| + |positions| inverse depth) over the difference of inverse depths and
//          the light's length; a LightUnion rounds its sum; a LightMask has 1 / 313 RMS an interval, at most 1 / 128
// Source:  ours
// C++:     include/penumbra/soft_shadow_map/light_interval.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_LIGHT_INTERVAL_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_LIGHT_INTERVAL_GLSL

#include "../numeric.glsl"
#include "linear_visibility.glsl"

// Shares of a light from low to high; empty unless low < high.
struct penumbra_LightInterval {
    float low, high;
};

penumbra_LightInterval penumbra_light_interval(float low, float high) {
    penumbra_LightInterval interval;
    interval.low = low;
    interval.high = high;
    return interval;
}

// What the segment from a to b hides from `point` of a light between the positions `first` and `last`, world units from
// its centre, first <= last. Only what is nearer to the light than the point hides. Empty if nothing is hidden. A light
// of no length is hidden as a whole or not at all; a point on the segment loses what lies to one side, or nothing.
penumbra_LightInterval penumbra_hidden_interval(penumbra_RowPoint a, penumbra_RowPoint b, penumbra_RowPoint point,
                                                float first, float last) {
    float nearer_a = a.inverse_depth - point.inverse_depth;
    float nearer_b = b.inverse_depth - point.inverse_depth;
    if (!(nearer_a > 0.0f) && !(nearer_b > 0.0f)) return penumbra_light_interval(1.0f, 0.0f);
    float side_a = a.slope - point.slope;
    float side_b = b.slope - point.slope;
    float length_of_light = last - first;
    float at_a = penumbra_saturated_ratio(side_a - first * nearer_a, length_of_light * nearer_a);
    float at_b = penumbra_saturated_ratio(side_b - first * nearer_b, length_of_light * nearer_b);
    if (nearer_a > 0.0f && nearer_b > 0.0f)
        return penumbra_light_interval(at_a < at_b ? at_a : at_b, at_a < at_b ? at_b : at_a);
    // one end is behind the point: towards where the segment passes it, the interval goes on beyond the light
    float at = nearer_a > 0.0f ? at_a : at_b;
    float passes = nearer_a > 0.0f ? side_b * nearer_a - side_a * nearer_b : side_a * nearer_b - side_b * nearer_a;
    if (passes == 0.0f) return penumbra_light_interval(1.0f, 0.0f);
    return passes > 0.0f ? penumbra_light_interval(at, 1.0f) : penumbra_light_interval(0.0f, at);
}

// One more than a union keeps.
#define PENUMBRA_LIGHT_UNION_PARTS 17

// A union of intervals, sorted. Exact up to 16 intervals with gaps between them; of more, those with the smallest gap
// become one, which hides that gap.
struct penumbra_LightUnion {
    float low[PENUMBRA_LIGHT_UNION_PARTS];
    float high[PENUMBRA_LIGHT_UNION_PARTS];
    int count;
};

penumbra_LightUnion penumbra_no_light_union() {
    penumbra_LightUnion all;
    for (int i = 0; i < PENUMBRA_LIGHT_UNION_PARTS; ++i) {
        all.low[i] = 0.0f;
        all.high[i] = 0.0f;
    }
    all.count = 0;
    return all;
}

// With one part less: two become one. Needs two.
penumbra_LightUnion penumbra_close_smallest_gap(penumbra_LightUnion all) {
    int best = 0;
    for (int i = 1; i + 1 < all.count; ++i)
        if (all.low[i + 1] - all.high[i] < all.low[best + 1] - all.high[best]) best = i;
    all.high[best] = all.high[best + 1];
    for (int i = best + 1; i + 1 < all.count; ++i) {
        all.low[i] = all.low[i + 1];
        all.high[i] = all.high[i + 1];
    }
    --all.count;
    return all;
}

// With an interval within [0, 1] more, or as it was if that is empty.
penumbra_LightUnion penumbra_add(penumbra_LightUnion all, penumbra_LightInterval interval) {
    if (!(interval.low < interval.high)) return all;
    float low = interval.low;
    float high = interval.high;
    int first = 0;  // the first that ends at or after low; from there on, all that begin up to high are united
    while (first < all.count && all.high[first] < low) ++first;
    int last = first;
    for (; last < all.count && !(all.low[last] > high); ++last) {
        low = all.low[last] < low ? all.low[last] : low;
        high = all.high[last] > high ? all.high[last] : high;
    }
    int change = 1 - (last - first);
    if (change > 0)
        for (int i = all.count; i > first; --i) {
            all.low[i] = all.low[i - 1];
            all.high[i] = all.high[i - 1];
        }
    if (change < 0)
        for (int i = last; i < all.count; ++i) {
            all.low[i + change] = all.low[i];
            all.high[i + change] = all.high[i];
        }
    all.low[first] = low;
    all.high[first] = high;
    all.count += change;
    if (all.count == PENUMBRA_LIGHT_UNION_PARTS) all = penumbra_close_smallest_gap(all);
    return all;
}

// The share of the light that is hidden, in [0, 1].
float penumbra_share(penumbra_LightUnion all) {
    float sum = 0.0f;
    for (int i = 0; i < all.count; ++i) sum += all.high[i] - all.low[i];
    return penumbra_saturate(sum);
}

// True if all of the light is hidden.
bool penumbra_is_full(penumbra_LightUnion all) {
    return all.count == 1 && all.low[0] <= 0.0f && all.high[0] >= 1.0f;
}

// A union of intervals as 128 cells of the light, each hidden or not by its centre.
struct penumbra_LightMask {
    uvec4 words;
};

penumbra_LightMask penumbra_no_light_mask() {
    penumbra_LightMask all;
    all.words = uvec4(0u, 0u, 0u, 0u);
    return all;
}

// The first cell whose centre is at or after a share of the light.
int penumbra_first_light_cell(float share) { return int(penumbra_clamp(share, 0.0f, 1.0f) * 128.0f + 0.5f); }

// Those of a word's cells that come before one.
uint penumbra_light_cells_below(int end) {
    return end <= 0 ? 0u : (end >= 32 ? 0xffffffffu : (1u << uint(end)) - 1u);
}

// All cells before one.
uvec4 penumbra_light_words_below(int end) {
    return uvec4(penumbra_light_cells_below(end), penumbra_light_cells_below(end - 32),
                 penumbra_light_cells_below(end - 64), penumbra_light_cells_below(end - 96));
}

// With the cells whose centres lie in an interval hidden.
penumbra_LightMask penumbra_add(penumbra_LightMask all, penumbra_LightInterval interval) {
    if (!(interval.low < interval.high)) return all;
    int first = penumbra_first_light_cell(interval.low);
    int end = penumbra_first_light_cell(interval.high);
    all.words |= penumbra_light_words_below(end) & ~penumbra_light_words_below(first);
    return all;
}

// The share of the light that is hidden, in [0, 1].
float penumbra_share(penumbra_LightMask all) {
    uvec4 word = all.words;
    word = word - ((word >> 1u) & 0x55555555u);
    word = (word & 0x33333333u) + ((word >> 2u) & 0x33333333u);
    word = (((word + (word >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u;
    return float(word.x + word.y + word.z + word.w) * 0.0078125f;
}

// True if all of the light is hidden.
bool penumbra_is_full(penumbra_LightMask all) {
    return (all.words.x & all.words.y & all.words.z & all.words.w) == 0xffffffffu;
}

#endif
