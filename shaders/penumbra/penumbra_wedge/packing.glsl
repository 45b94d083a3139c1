// Radial parts in 32-bit words: what a pass that blends silhouettes keeps of a fragment, eight words for four parts.
//
//     word of `rects`:      min x | min y << 8 | max x << 16 | max y << 24     in 1/255, mins down, maxs up
//     word of `coverages`:  area | width << 16 | height << 24                  in 1/65535 and 1/255, to nearest
//
// Zeros are the empty part: a cleared target. Centres of gravity are not kept.
//
// Options: none
// Error:   1/131070 of the area, or up to 1/255 (width + height) / 2 where the rectangle is filled; 1/255 for corners.
// Source:  V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006
// C++:     include/penumbra/penumbra_wedge/packing.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_PACKING_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_PACKING_GLSL

#include "../geometry.glsl"
#include "radial_part.glsl"

// A part in two words.
struct penumbra_PackedPart {
    uint rect, coverage;
};

penumbra_PackedPart penumbra_packed_part(uint rect, uint coverage) {
    penumbra_PackedPart packed_part;
    packed_part.rect = rect;
    packed_part.coverage = coverage;
    return packed_part;
}

// Four parts, in penumbra_quadrant's order: two targets of four 32-bit channels.
struct penumbra_PackedParts {
    uvec4 rects, coverages;
};

struct penumbra_FourParts {
    penumbra_RadialPart part[4];
};

// The interval that the limits `low` and `high` and the size, whole 255ths, stand for. Among all that are packed so it
// is about the middle, and far from where rounding would make it another; but ends at 0 and 255 stay there if they can.
vec2 penumbra_unpack_interval(uint low, uint high, uint size) {
    int more = int(high) - int(low) - int(size);  // 0, 1 or 2
    bool at_low = low == 0u, at_high = high == 255u, one = at_low != at_high;
    bool keep = more <= 0 || (more == 1 && one);
    float inset = more <= 0 ? 0.125f : (more == 1 ? (one ? 0.75f : 0.375f) : 0.875f);
    return vec2((float(low) + (keep && at_low ? 0.0f : inset)) / 255.0f,
                (float(high) - (keep && at_high ? 0.0f : inset)) / 255.0f);
}

// The rectangle that two words stand for.
penumbra_Rect2 penumbra_unpack_rect(uint rect, uint coverage) {
    vec2 x = penumbra_unpack_interval(rect & 255u, (rect >> 16u) & 255u, (coverage >> 16u) & 255u);
    vec2 y = penumbra_unpack_interval((rect >> 8u) & 255u, rect >> 24u, coverage >> 24u);
    return penumbra_rect2(vec2(x.x, y.x), vec2(x.y, y.y));
}

uint penumbra_round_down(float x) { return uint(floor(x * 255.0f)); }
uint penumbra_round_up(float x) { return uint(ceil(x * 255.0f)); }
uint penumbra_round_nearest(float x) { return uint(floor(x * 255.0f + 0.5f)); }

// Two words for a part, any finite numbers, which go through penumbra_valid_part first. Ties of areas and sizes go up;
// corners on a 255th stay there, give or take a rounding. The area is limited to that of the rectangle as it will be
// unpacked. Exact for the empty and the full part. Packing what unpacking gives of these words gives them again.
penumbra_PackedPart penumbra_pack_part(penumbra_RadialPart part) {
    penumbra_RadialPart valid = penumbra_valid_part(part);
    if (!(valid.area > 0.0f)) return penumbra_packed_part(0u, 0u);
    vec2 size = vec2(valid.rect.max.x - valid.rect.min.x, valid.rect.max.y - valid.rect.min.y);
    uint rect = penumbra_round_down(valid.rect.min.x) | (penumbra_round_down(valid.rect.min.y) << 8u) |
                      (penumbra_round_up(valid.rect.max.x) << 16u) | (penumbra_round_up(valid.rect.max.y) << 24u);
    uint sizes = (penumbra_round_nearest(size.x) << 16u) | (penumbra_round_nearest(size.y) << 24u);
    uint most = uint(floor(penumbra_area(penumbra_unpack_rect(rect, sizes)) * 65535.0f));
    uint covered = uint(floor(valid.area * 65535.0f + 0.5f));
    uint least = covered < most ? covered : most;
    if (least == 0u) return penumbra_packed_part(0u, 0u);
    return penumbra_packed_part(rect, sizes | least);
}

// The part that two words stand for, valid whatever they are. Its centre of gravity is the middle of its rectangle.
penumbra_RadialPart penumbra_unpack_part(penumbra_PackedPart packed_part) {
    if (packed_part.rect == 0xffff0000u && packed_part.coverage == 0xffffffffu) return penumbra_full_part();
    penumbra_RadialPart part;
    part.rect = penumbra_unpack_rect(packed_part.rect, packed_part.coverage);
    part.area = float(packed_part.coverage & 65535u) / 65535.0f;
    part.moment = (part.rect.min + part.rect.max) * (part.area * 0.5f);
    return penumbra_valid_part(part);
}

// penumbra_pack_part of each.
penumbra_PackedParts penumbra_pack_parts(penumbra_FourParts parts) {
    penumbra_PackedPart a = penumbra_pack_part(parts.part[0]), b = penumbra_pack_part(parts.part[1]),
                        c = penumbra_pack_part(parts.part[2]), d = penumbra_pack_part(parts.part[3]);
    penumbra_PackedParts all;
    all.rects = uvec4(a.rect, b.rect, c.rect, d.rect);
    all.coverages = uvec4(a.coverage, b.coverage, c.coverage, d.coverage);
    return all;
}

// penumbra_unpack_part of each.
penumbra_FourParts penumbra_unpack_parts(penumbra_PackedParts all) {
    penumbra_FourParts parts;
    parts.part[0] = penumbra_unpack_part(penumbra_packed_part(all.rects.x, all.coverages.x));
    parts.part[1] = penumbra_unpack_part(penumbra_packed_part(all.rects.y, all.coverages.y));
    parts.part[2] = penumbra_unpack_part(penumbra_packed_part(all.rects.z, all.coverages.z));
    parts.part[3] = penumbra_unpack_part(penumbra_packed_part(all.rects.w, all.coverages.w));
    return parts;
}

#endif
