// Twins of penumbra_wedge: bit masks, and what a point is to the index.
#pragma once

#include <penumbra/penumbra_wedge/bitmask.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/tile_sums.hpp>

#include "function.hpp"
#include "penumbra_wedge_packing.hpp"

namespace penumbra::test::functions {

inline WindingColumn column(const float* in) { return {word(in), word(in + 2), word(in + 4), word(in + 6)}; }
inline void put(const WindingColumn& c, float* out) {
    put(c.ones, out), put(c.twos, out + 2), put(c.fours, out + 4), put(c.eights, out + 6);
}

/// A box, three corners, a weight: 64ths, so that edges pass through middles of cells, or any numbers, far ones too.
inline void box_and_triangle(float* in) {
    const bool any = std::abs(in[10]) > 1.0F;
    for (int k = 0; k < 10; ++k)
        in[k] = any ? std::copysign(4.0F * share(in[k]), in[k]) : std::copysign(whole(in[k], 0, 256), in[k]) / 64.0F;
    for (const int k : {4, 5})
        if (in[6] < in[7]) in[k] *= 0x1p20F;
    for (const int k : {0, 1}) in[k + 2] = in[k] + std::max(std::abs(in[k + 2]), 0.25F);
    in[10] = std::copysign(whole(in[10], 0, 3), in[10]);
}

/// Sums up to a number that depends on every word and its place.
inline std::uint32_t digest(const WindingMask<32>& mask) {
    std::uint32_t sum = 0;
    for (const WindingColumn& c : mask.columns) sum = sum * 3U + c.ones + c.twos * 5U + c.fours * 7U + c.eights * 11U;
    return sum;
}

/// An area in [-1, 2], counts as masks of 64 cells give them.
inline void silhouettes(float* in) {
    for (int k = 0; k < 12; k += 4) {
        const int wound = static_cast<int>(whole(in[k + 1], 0, 64));
        in[k] = 3.0F * share(in[k]) - 1.0F;
        in[k + 1] = static_cast<float>(wound);
        in[k + 2] = in[k + 2] < 0.0F ? in[k + 1] : whole(in[k + 2], -64, 128);
        in[k + 3] = whole(in[k + 3], 0, wound);
    }
}
inline void point_and_light(float* in) {
    moderate_all<5>(in);
    for (const int k : {2, 3, 4}) in[k] = std::max(std::abs(in[k]), 0x1p-20F);
}

// What texts begin and end with.
#define WORD(k) (uint(I(k)) | (uint(I(k + 1)) << 16u))
#define PUT_WORD(k, w)        \
    O(k) = float(w & 65535u); \
    O(k + 1) = float(w >> 16u)
#define COLUMN(k)             \
    penumbra_WindingColumn c; \
    c.ones = WORD(k);         \
    c.twos = WORD(k + 2);     \
    c.fours = WORD(k + 4);    \
    c.eights = WORD(k + 6)

inline void add_penumbra_wedge_bitmask(std::vector<Function>& list) {
    list.push_back({
        "count_bits, low_bits", "penumbra_wedge/bitmask", 3, 3,
            GLSL(O(0) = float(penumbra_count_bits(WORD(0))); uint low = penumbra_low_bits(int(I(2)));
                 PUT_WORD(1, low);),
            [](const float* i, float* o) {
                o[0] = static_cast<float>(count_bits(word(i)));
                put(low_bits(static_cast<int>(i[2])), o + 1);
            },
            [](float* in) { words<2>(in), in[2] = whole(in[2], 0, 32); }, 0, nullptr
    });
    list.push_back({
        "add_winding, wound_cells, winding_sum", "penumbra_wedge/bitmask", 11, 11,
            GLSL(COLUMN(0); c = penumbra_add_winding(c, WORD(8), I(10) < 0.5f); PUT_WORD(0, c.ones);
                 PUT_WORD(2, c.twos); PUT_WORD(4, c.fours); PUT_WORD(6, c.eights); uint w = penumbra_wound_cells(c);
                 PUT_WORD(8, w); O(10) = float(penumbra_winding_sum(c));),
            [](const float* i, float* o) {
                const WindingColumn c = add_winding(column(i), word(i + 8), i[10] < 0.5F);
                put(c, o), put(wound_cells(c), o + 8), o[10] = static_cast<float>(winding_sum(c));
            },
            [](float* in) { words<10>(in); }, 0, nullptr
    });
    list.push_back({
        "WindingMask", "penumbra_wedge/bitmask", 11, 4,
            GLSL(penumbra_WindingMask m = penumbra_empty_mask(); penumbra_Rect2 box = RECT(0); int weight = int(I(10));
                 m = penumbra_add(m, V2(4), V2(6), weight, box); m = penumbra_add(m, V2(6), V2(8), weight, box);
                 m = penumbra_add(m, V2(8), V2(4), -1, box); uint sum = 0u;
                 for (int k = 0; k < 32; ++k) sum = sum * 3u + m.columns[k].ones + m.columns[k].twos * 5u +
                                                    m.columns[k].fours * 7u + m.columns[k].eights * 11u;
                 PUT_WORD(0, sum); O(2) = float(penumbra_wound(m)); O(3) = float(penumbra_sum(m));),
            [](const float* i, float* o) {
                WindingMask<32> m;
                const Rect2<float> box = rect(i);
                m.add(v2(i + 4), v2(i + 6), static_cast<int>(i[10]), box);
                m.add(v2(i + 6), v2(i + 8), static_cast<int>(i[10]), box);
                m.add(v2(i + 8), v2(i + 4), -1, box);
                put(digest(m), o), o[2] = static_cast<float>(m.wound()), o[3] = static_cast<float>(m.sum());
            },
            box_and_triangle, 0, nullptr
    });
    list.push_back({
        "MaskedOcclusion", "penumbra_wedge/bitmask", 12, 3,
            GLSL(penumbra_MaskedOcclusion all = penumbra_no_masked_occlusion();
                 for (int k = 0; k < 12; k += 4) all =
                     penumbra_add(all, I(k), int(I(k + 1)), int(I(k + 2)), int(I(k + 3)), 64);
                 O(0) = all.occlusion; O(1) = all.total; O(2) = float(all.united);),
            [](const float* i, float* o) {
                MaskedOcclusion<float> all;
                for (int k = 0; k < 12; k += 4)
                    all.add(i[k], static_cast<int>(i[k + 1]), static_cast<int>(i[k + 2]), static_cast<int>(i[k + 3]),
                            64);
                o[0] = all.occlusion, o[1] = all.total, o[2] = static_cast<float>(all.united);
            },
            silhouettes, 2, nullptr
    });
    list.push_back({
        "PointTile::finish", "penumbra_wedge/point_tile", 5, 8,
            GLSL(penumbra_WedgePoint p = penumbra_wedge_point(V3(0), V2(3)); PUT_RECT(0, p.light); O(4) = p.right;
                 O(5) = p.left; O(6) = p.top; O(7) = p.bottom;),
            [](const float* i, float* o) {
                PointTile<float> tile;
                tile.push(v3(i));
                tile.finish(v2(i + 3));
                put(tile.light, o), o[4] = tile.right, o[5] = tile.left, o[6] = tile.top, o[7] = tile.bottom;
            },
            point_and_light, 2, nullptr
    });
    list.push_back({
        "settle", "penumbra_wedge/tile_sums", 1, 1, GLSL(O(0) = penumbra_settle(I(0));),
            [](const float* i, float* o) { o[0] = detail::settle(i[0]); },
            [](float* in) { in[0] = 3.0F * share(in[0]) - 1.0F; }, 0, nullptr
    });
}

#undef WORD
#undef PUT_WORD
#undef COLUMN

}  // namespace penumbra::test::functions
