// Twins of penumbra_wedge: radial parts and how they overlap.
#pragma once

#include <penumbra/penumbra_wedge/overlap.hpp>
#include <penumbra/penumbra_wedge/radial_part.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// A part as seven numbers: area, moments, rectangle.
inline RadialPart<float> radial_part(const float* in) { return {in[0], v2(in + 1), rect(in + 3)}; }
inline void put(const RadialPart<float>& part, float* out) {
    out[0] = part.area, put(part.moment, out + 1), put(part.rect, out + 3);
}

/// Valid parts, empty and full ones among them. No number so small that products of a few of them are denormal.
template <int Count>
void radial_parts(float* in) {
    for (int p = 0; p < Count; ++p, in += 7) {
        for (int k = 0; k < 7; ++k) in[k] = share(in[k]) < 0x1p-20F ? 0.0F : share(in[k]);
        for (const int k : {3, 4})
            if (in[k] > in[k + 2]) std::swap(in[k], in[k + 2]);
        const RadialPart<float> any = radial_part(in);
        const float covered = any.area * area(any.rect);
        put(valid_part(RadialPart<float>{covered, (any.rect.min + (any.rect.max - any.rect.min) * any.moment) * covered,
                                         any.rect}),
            in);
    }
}
/// Three corners, now and then a far one, a box, a weight: 64ths, so that corners meet the box's borders, or any
/// numbers.
inline void triangle_and_box(float* in) {
    const bool any = std::abs(in[10]) > 1.0F;
    for (int k = 0; k < 10; ++k)
        in[k] = any ? std::copysign(4.0F * share(in[k]), in[k]) : std::copysign(whole(in[k], 0, 256), in[k]) / 64.0F;
    for (const int k : {0, 1})
        if (in[6] < in[7]) in[k] *= 0x1p20F;  // to be interpolated from the other end
    for (const int k : {6, 7}) in[k + 2] = in[k] + std::max(std::abs(in[k + 2]), 0.25F);
    in[10] = std::copysign(whole(in[10], 0, 2), in[10]);
}
inline RadialPartBuilder<float> triangle_builder(const float* in) {
    RadialPartBuilder<float> builder(rect(in + 6));
    for (int k = 0; k < 3; ++k) builder.add(v2(in + 2 * k), v2(in + (2 * k + 2) % 6), static_cast<int>(in[10]));
    return builder;
}
inline float one(const float*) { return 1.0F; }

// What texts begin and end with.
#define PART(k) penumbra_radial_part(I(k), V2(k + 1), RECT(k + 3))
#define PUT_PART(k, p)     \
    O(k) = p.area;         \
    PUT2(k + 1, p.moment); \
    PUT_RECT(k + 3, p.rect)

inline void add_penumbra_wedge_overlap(std::vector<Function>& list) {
    list.push_back({
        "empty_part, full_part", "penumbra_wedge/radial_part", 1, 14,
            GLSL(penumbra_RadialPart e = penumbra_empty_part(); penumbra_RadialPart f = penumbra_full_part();
                 PUT_PART(0, e); PUT_PART(7, f);),
            [](const float*, float* o) { put(empty_part<float>(), o), put(full_part<float>(), o + 7); }, anything, 0,
            nullptr
    });
    list.push_back({
        "valid_part", "penumbra_wedge/radial_part", 7, 7,
            GLSL(penumbra_RadialPart p = penumbra_valid_part(PART(0)); PUT_PART(0, p);),
            [](const float* i, float* o) { put(valid_part(radial_part(i)), o); }, moderate_all<7>, 0, nullptr
    });
    list.push_back({
        "quadrant", "penumbra_wedge/radial_part", 5, 4,
            GLSL(penumbra_Rect2 r = penumbra_quadrant(RECT(0), int(I(4))); PUT_RECT(0, r);),
            [](const float* i, float* o) { put(quadrant(rect(i), static_cast<int>(i[4])), o); },
            [](float* i) { moderate_all<4>(i), i[4] = whole(i[4], 0, 3); }, 0, nullptr
    });
    list.push_back({
        "RadialPartBuilder: add, finish", "penumbra_wedge/radial_part", 11, 11,
            GLSL(penumbra_RadialPartBuilder b = penumbra_radial_part_builder(RECT(6));
                 b = penumbra_add(b, V2(0), V2(2), int(I(10))); b = penumbra_add(b, V2(2), V2(4), int(I(10)));
                 b = penumbra_add(b, V2(4), V2(0), int(I(10))); penumbra_RadialPart p = penumbra_finish(b);
                 PUT_PART(0, p); for (int k = 0; k < 4; ++k) O(7 + k) = float(b.winding[k]);),
            [](const float* i, float* o) {
                const RadialPartBuilder<float> builder = triangle_builder(i);
                put(builder.finish(), o);
                for (std::size_t k = 0; k < 4; ++k) o[7 + k] = static_cast<float>(builder.winding[k]);
            },
            triangle_and_box, 8, one
    });
    list.push_back({
        "overlap_area", "penumbra_wedge/overlap", 14, 1, GLSL(O(0) = penumbra_overlap_area(PART(0), PART(7));),
            [](const float* i, float* o) { o[0] = overlap_area(radial_part(i), radial_part(i + 7)); }, radial_parts<2>,
            0, nullptr
    });
    list.push_back({
        "overlap_area_centroid", "penumbra_wedge/overlap", 14, 1,
            GLSL(O(0) = penumbra_overlap_area_centroid(PART(0), PART(7));),
            [](const float* i, float* o) { o[0] = overlap_area_centroid(radial_part(i), radial_part(i + 7)); },
            radial_parts<2>, 4, one
    });
    list.push_back({
        "blend", "penumbra_wedge/overlap", 14, 7,
            GLSL(penumbra_RadialPart p = penumbra_blend(PART(0), PART(7)); PUT_PART(0, p);),
            [](const float* i, float* o) { put(blend(radial_part(i), radial_part(i + 7)), o); }, radial_parts<2>, 0,
            nullptr
    });
    list.push_back({
        "blend_centroid", "penumbra_wedge/overlap", 14, 7,
            GLSL(penumbra_RadialPart p = penumbra_blend_centroid(PART(0), PART(7)); PUT_PART(0, p);),
            [](const float* i, float* o) { put(blend_centroid(radial_part(i), radial_part(i + 7)), o); },
            radial_parts<2>, 4, one
    });
    list.push_back({
        "RectangleProduct", "penumbra_wedge/overlap", 21, 11,
            GLSL(penumbra_RectangleProduct r = penumbra_no_rectangles(); O(0) = penumbra_area(r);
                 r = penumbra_add(r, PART(0)); O(1) = penumbra_area(r); r = penumbra_add_centroid(r, PART(7));
                 O(2) = penumbra_area(r); r = penumbra_add(r, PART(14)); O(3) = penumbra_area(r); O(4) = r.total;
                 O(5) = r.largest; for (int k = 0; k < 5; ++k) O(6 + k) = r.transmission[13 * k + 6];),
            [](const float* i, float* o) {
                RectangleProduct<float> product;
                o[0] = product.area();
                product.add(radial_part(i)), o[1] = product.area();
                product.add_centroid(radial_part(i + 7)), o[2] = product.area();
                product.add(radial_part(i + 14)), o[3] = product.area();
                o[4] = product.total, o[5] = product.largest;
                for (std::size_t k = 0; k < 5; ++k) o[6 + k] = product.transmission[13 * k + 6];
            },
            radial_parts<3>, 4, one
    });
}

#undef PART
#undef PUT_PART

}  // namespace penumbra::test::functions
