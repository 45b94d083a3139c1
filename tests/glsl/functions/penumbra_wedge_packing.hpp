// Twins of penumbra_wedge: radial parts in words.
#pragma once

#include <penumbra/penumbra_wedge/packing.hpp>

#include "function.hpp"
#include "penumbra_wedge_overlap.hpp"

namespace penumbra::test::functions {

/// A word as two numbers: its lower and its upper half.
inline void put(std::uint32_t word, float* out) {
    out[0] = static_cast<float>(word & 65535U), out[1] = static_cast<float>(word >> 16);
}
inline std::uint32_t word(const float* in) {
    return static_cast<std::uint32_t>(in[0]) | static_cast<std::uint32_t>(in[1]) << 16;
}

/// Parts on and beside 255ths and their ties, for most tuples.
template <int Count>
void parts_on_steps(float* in) {
    for (int p = 0; p < Count; ++p) {
        float* part = in + 7 * p;
        for (int k = 3; k < 7; ++k) {
            const float at = whole(part[k], 0, 512) / 510.0F;
            const float beside = k % 2 == 0 ? at : at * (1.0F + (part[0] > 0.0F ? 0x1p-23F : -0x1p-24F));
            part[k] = part[1] > 0.0F ? beside : part[k];
        }
    }
    radial_parts<Count>(in);
}
template <int Count>
void words(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = whole(in[k], 0, 65535);
}

// What texts begin and end with.
#define PART(k) penumbra_radial_part(I(k), V2(k + 1), RECT(k + 3))
#define PUT_PART(k, p)     \
    O(k) = p.area;         \
    PUT2(k + 1, p.moment); \
    PUT_RECT(k + 3, p.rect)
#define WORD(k) (uint(I(k)) | (uint(I(k + 1)) << 16u))
#define PUT_WORD(k, w)        \
    O(k) = float(w & 65535u); \
    O(k + 1) = float(w >> 16u)

inline void add_penumbra_wedge_packing(std::vector<Function>& list) {
    list.push_back({
        "pack_part", "penumbra_wedge/packing", 7, 4,
            GLSL(penumbra_PackedPart w = penumbra_pack_part(PART(0)); PUT_WORD(0, w.rect); PUT_WORD(2, w.coverage);),
            [](const float* i, float* o) {
                const PackedPart packed = pack_part(radial_part(i));
                put(packed.rect, o), put(packed.coverage, o + 2);
            },
            parts_on_steps<1>, 0, nullptr
    });
    list.push_back({
        "unpack_part, pack_part again", "penumbra_wedge/packing", 4, 11,
            GLSL(penumbra_RadialPart p = penumbra_unpack_part(penumbra_packed_part(WORD(0), WORD(2))); PUT_PART(0, p);
                 penumbra_PackedPart w = penumbra_pack_part(p); PUT_WORD(7, w.rect); PUT_WORD(9, w.coverage);),
            [](const float* i, float* o) {
                const RadialPart<float> part = unpack_part<float>({word(i), word(i + 2)});
                put(part, o);
                const PackedPart packed = pack_part(part);
                put(packed.rect, o + 7), put(packed.coverage, o + 9);
            },
            words<4>, 0, nullptr
    });
    list.push_back({
        "pack_parts", "penumbra_wedge/packing", 28, 16,
            GLSL(penumbra_FourParts p; p.part[0] = PART(0); p.part[1] = PART(7); p.part[2] = PART(14);
                 p.part[3] = PART(21); penumbra_PackedParts w = penumbra_pack_parts(p); for (int k = 0; k < 4; ++k) {
                     PUT_WORD(2 * k, w.rects[k]);
                     PUT_WORD(8 + 2 * k, w.coverages[k]);
                 }),
            [](const float* i, float* o) {
                const PackedParts packed =
                    pack_parts<float>({{radial_part(i), radial_part(i + 7), radial_part(i + 14), radial_part(i + 21)}});
                for (std::size_t k = 0; k < 4; ++k)
                    put(packed.rects[k], o + 2 * k), put(packed.coverages[k], o + 8 + 2 * k);
            },
            parts_on_steps<4>, 0, nullptr
    });
    list.push_back({
        "unpack_parts", "penumbra_wedge/packing", 16, 12,
            GLSL(penumbra_PackedParts w; w.rects = uvec4(WORD(0), WORD(2), WORD(4), WORD(6));
                 w.coverages = uvec4(WORD(8), WORD(10), WORD(12), WORD(14));
                 penumbra_FourParts p = penumbra_unpack_parts(w); for (int k = 0; k < 4; ++k) {
                     O(3 * k) = p.part[k].area;
                     O(3 * k + 1) = p.part[k].moment.x;
                     O(3 * k + 2) = p.part[k].rect.max.y;
                 }),
            [](const float* i, float* o) {
                PackedParts packed{};
                for (std::size_t k = 0; k < 4; ++k)
                    packed.rects[k] = word(i + 2 * k), packed.coverages[k] = word(i + 8 + 2 * k);
                const auto parts = unpack_parts<float>(packed);
                for (std::size_t k = 0; k < 4; ++k) {
                    o[3 * k] = parts[k].area, o[3 * k + 1] = parts[k].moment.x;
                    o[3 * k + 2] = parts[k].rect.max.y;
                }
            },
            words<16>, 0, nullptr
    });
}

#undef PART
#undef PUT_PART
#undef WORD
#undef PUT_WORD

}  // namespace penumbra::test::functions
