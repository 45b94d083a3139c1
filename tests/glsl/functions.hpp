// Every twin that is a plain function, beside its C++: how to call both, with what, and how far apart they may be.
#pragma once

#include <cmath>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/light.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <vector>

namespace penumbra::test {

/// `glsl` reads I(k), writes O(k); `cpp` does the same. `domain` moves any inputs into the documented domain.
struct Function {
    const char *name, *snippet;
    int inputs, outputs;
    const char* glsl;
    void (*cpp)(const float* in, float* out);
    void (*domain)(float* in);
    /// Outputs may differ by `ulps` units in the last place of the largest number that goes into them, which is the
    /// output itself if `scale` is null. 0: bit for bit, but for the sign of zero.
    double ulps;
    float (*scale)(const float* in);
};

namespace functions {

inline Vec2<float> vec2(const float* in) { return {in[0], in[1]}; }
inline Vec3<float> vec3(const float* in) { return {in[0], in[1], in[2]}; }
inline Rect2<float> rect(const float* in) { return {vec2(in), vec2(in + 2)}; }
inline void put(const Vec2<float>& v, float* out) { out[0] = v.x, out[1] = v.y; }
inline void put(const Vec3<float>& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }
inline void put(const Rect2<float>& r, float* out) { put(r.min, out), put(r.max, out + 2); }
inline void put(const LightFrame<float>& f, float* out) {
    put(f.origin, out), put(f.u, out + 3), put(f.v, out + 6), put(f.normal, out + 9);
}
inline void put(const OcclusionBounds<float>& b, float* out) { out[0] = b.lower, out[1] = b.upper; }
inline SliceCamera<float> camera(const float* in) {
    SliceCamera<float> c;
    c.convergence = in[0], c.origin_tx = vec2(in + 1), c.scale_tx = vec2(in + 3);
    return c;
}
inline SliceRange<float> range(const float* in) { return {in[0], in[1], static_cast<int>(in[2])}; }
inline OcclusionAccumulator<float> accumulated(const float* in) {
    OcclusionAccumulator<float> all;
    for (int k = 0; k < 3; ++k) all.add(in[k]);
    return all;
}

inline void anything(float*) {}
/// Infinity in place of the largest number: for what reads exponents.
inline void endless(float* in) {
    if (std::abs(in[0]) == std::numeric_limits<float>::max()) in[0] = std::numeric_limits<float>::infinity();
}
/// |x| to 2^-20 … 2^20, which keeps products of several from overflowing.
inline float moderate(float x) {
    const float magnitude = std::abs(x);
    if (!(magnitude > 0.0F)) return 0.0F;
    const int exponent = floor_log2(magnitude);
    return std::copysign(std::ldexp(magnitude, clamp(exponent, -20, 20) - exponent), x);
}
template <int Count>
void moderate_all(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = moderate(in[k]);
}
/// To [0, 1], 0 and 1 included.
inline float share(float x) {
    const float magnitude = std::abs(x);
    return magnitude <= 1.0F ? magnitude : 1.0F / magnitude;
}
template <int Count>
void shares(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = share(in[k]);
}
/// A whole number from `low` to `high`.
inline float whole(float x, int low, int high) {
    const float magnitude = std::abs(moderate(x));
    return static_cast<float>(low + static_cast<int>(magnitude * 977.0F) % (high - low + 1));
}
inline void unit(float* in) { put(normalize_or(vec3(in), Vec3<float>(0, 0, 1)), in); }
/// A right-handed frame from any two vectors.
inline void frame(float* in) {
    for (int k = 0; k < 12; ++k) in[k] = moderate(in[k]);
    put(light_frame(DiskLight<float>{vec3(in), vec3(in + 3), 1.0F}), in);
}
inline LightFrame<float> frame_of(const float* in) { return {vec3(in), vec3(in + 3), vec3(in + 6), vec3(in + 9)}; }
inline void side_by_side(float* in) {  // half_v at a right angle to half_u, now and then of no size
    for (int k = 0; k < 12; ++k) in[k] = moderate(in[k]);
    for (const int k : {3, 9})  // no size, no aim
        if (in[k] == 0.0F) in[k + 1] = in[k + 2] = 0.0F;
    const Vec3<float> u = vec3(in + 3), v = vec3(in + 6), direction = normalize_or(u, Vec3<float>(0, 0, 0));
    Vec3<float> across = v - direction * glm::dot(v, direction);
    across = across - direction * glm::dot(across, direction);
    if (glm::dot(across, across) < 1e-6F * glm::dot(v, v)) across = Vec3<float>(0, 0, 0);
    put(across, in + 6);
}
inline void camera_and_point(float* in) {
    moderate_all<13>(in);
    in[0] = share(in[0]);
    in[3] = std::abs(in[3]), in[4] = std::abs(in[4]);
    in[5] = std::abs(in[5]), in[8] = std::abs(in[8]);  // depths of the lit side
}
inline float largest(const float* in, int count) {
    float result = 0;
    for (int k = 0; k < count; ++k) result = std::max(result, std::abs(in[k]));
    return result;
}
inline void slices(float* in) {
    in[0] = moderate(in[0]), in[1] = std::abs(moderate(in[1])), in[2] = whole(in[2], 1, 64);
    in[3] = moderate(in[3]);
}

#define PENUMBRA_FRAME \
    "penumbra_make_frame(vec3(I(0),I(1),I(2)), vec3(I(3),I(4),I(5)), vec3(I(6),I(7),I(8)), vec3(I(9),I(10),I(11)))"
#define PENUMBRA_RECT(k) "penumbra_rect2(vec2(I(" #k "), I(" #k " + 1)), vec2(I(" #k " + 2), I(" #k " + 3)))"
#define PENUMBRA_PUT_RECT "O(0) = r.min.x; O(1) = r.min.y; O(2) = r.max.x; O(3) = r.max.y;"
#define PENUMBRA_PUT_FRAME                                                                                             \
    "for (int k = 0; k < 3; ++k) { O(k) = f.origin[k]; O(3 + k) = f.u[k]; O(6 + k) = f.v[k]; O(9 + k) = f.normal[k]; " \
    "}"
#define PENUMBRA_CAMERA \
    "penumbra_SliceCamera c; c.convergence = I(0); c.origin_tx = vec2(I(1), I(2)); c.scale_tx = vec2(I(3), I(4)); "
#define PENUMBRA_RANGE "penumbra_SliceRange r; r.first = I(0); r.thickness = I(1); r.count = int(I(2)); "
#define PENUMBRA_ACCUMULATED                                                                    \
    "penumbra_OcclusionAccumulator a = penumbra_no_occlusion(); for (int k = 0; k < 3; ++k) a " \
    "= penumbra_add(a, I(k)); "

inline std::vector<Function> all() {
    std::vector<Function> f;
    // numeric: the same operations in the same order; drivers may round divisions by 2.5 ULP
    f.push_back({"clamp", "numeric", 3, 1, "O(0) = penumbra_clamp(I(0), I(1), I(2));",
                 [](const float* i, float* o) { o[0] = clamp(i[0], i[1], i[2]); },
                 [](float* i) {
                     if (i[1] > i[2]) std::swap(i[1], i[2]);
                 },
                 0, nullptr});
    f.push_back({"saturate", "numeric", 1, 1, "O(0) = penumbra_saturate(I(0));",
                 [](const float* i, float* o) { o[0] = saturate(i[0]); }, anything, 0, nullptr});
    f.push_back({"saturated_ratio", "numeric", 2, 1, "O(0) = penumbra_saturated_ratio(I(0), I(1));",
                 [](const float* i, float* o) { o[0] = saturated_ratio(i[0], i[1]); },
                 [](float* i) { i[1] = std::min(std::abs(i[1]), 0x1p125F); }, 3, nullptr});
    f.push_back({"safe_ratio", "numeric", 3, 1, "O(0) = penumbra_safe_ratio(I(0), I(1), I(2));",
                 [](const float* i, float* o) { o[0] = safe_ratio(i[0], i[1], i[2]); },
                 [](float* i) { i[0] = moderate(i[0]), i[1] = i[1] == 0.0F ? 0.0F : moderate(i[1]); }, 3, nullptr});
    f.push_back({"mix", "numeric", 3, 1, "O(0) = penumbra_mix(I(0), I(1), I(2));",
                 [](const float* i, float* o) { o[0] = mix(i[0], i[1], i[2]); },
                 [](float* i) { moderate_all<2>(i), i[2] = share(i[2]); }, 2,
                 [](const float* i) { return largest(i, 2); }});
    f.push_back({"floor_log2", "numeric", 1, 1, "O(0) = float(penumbra_floor_log2(I(0)));",
                 [](const float* i, float* o) { o[0] = static_cast<float>(floor_log2(i[0])); }, endless, 0, nullptr});
    f.push_back({"exp2_int", "numeric", 1, 1, "O(0) = penumbra_exp2_int(int(I(0)));",
                 [](const float* i, float* o) { o[0] = exp2_int<float>(static_cast<int>(i[0])); },
                 [](float* i) { i[0] = whole(i[0], -126, 127); }, 0, nullptr});
    f.push_back({"is_finite", "numeric", 1, 1, "O(0) = penumbra_is_finite(I(0)) ? 1.0 : 0.0;",
                 [](const float* i, float* o) { o[0] = is_finite(i[0]) ? 1.0F : 0.0F; }, endless, 0, nullptr});
    // geometry
    f.push_back({"is_finite(Vec2, Vec3)", "geometry", 3, 2,
                 "O(0) = penumbra_is_finite(vec2(I(0), I(1))) ? 1.0 : 0.0; "
                 "O(1) = penumbra_is_finite(vec3(I(1), I(2), I(0))) ? 1.0 : 0.0;",
                 [](const float* i, float* o) {
                     o[0] = is_finite(vec2(i)) ? 1.0F : 0.0F;
                     o[1] = is_finite(Vec3<float>(i[1], i[2], i[0])) ? 1.0F : 0.0F;
                 },
                 [](float* i) { endless(i), endless(i + 1), endless(i + 2); }, 0, nullptr});
    f.push_back({"normalize_or", "geometry", 6, 3,
                 "vec3 v = penumbra_normalize_or(vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5))); "
                 "O(0) = v.x; O(1) = v.y; O(2) = v.z;",
                 [](const float* i, float* o) { put(normalize_or(vec3(i), vec3(i + 3)), o); }, anything, 8,
                 [](const float*) { return 1.0F; }});
    f.push_back({"safe_length", "geometry", 3, 1, "O(0) = penumbra_safe_length(vec3(I(0), I(1), I(2)));",
                 [](const float* i, float* o) { o[0] = safe_length(vec3(i)); },
                 [](float* i) {
                     for (int k = 0; k < 3; ++k) i[k] = std::abs(i[k]) > 0x1p126F ? 1.0F : i[k];
                 },
                 6, nullptr});
    f.push_back({"any_perpendicular", "geometry", 3, 3,
                 "vec3 v = penumbra_any_perpendicular(vec3(I(0), I(1), I(2))); O(0) = v.x; O(1) = v.y; O(2) = v.z;",
                 [](const float* i, float* o) { put(any_perpendicular(vec3(i)), o); }, unit, 6,
                 [](const float*) { return 1.0F; }});
    f.push_back({"empty_rect", "geometry", 1, 4, "penumbra_Rect2 r = penumbra_empty_rect(); " PENUMBRA_PUT_RECT,
                 [](const float*, float* o) { put(empty_rect<float>(), o); }, anything, 0, nullptr});
    f.push_back({"extent", "geometry", 4, 2, "vec2 v = penumbra_extent(" PENUMBRA_RECT(0) "); O(0) = v.x; O(1) = v.y;",
                 [](const float* i, float* o) { put(extent(rect(i)), o); }, moderate_all<4>, 0, nullptr});
    f.push_back({"extend(Rect2)", "geometry", 6, 4,
                 "penumbra_Rect2 r = penumbra_extend(" PENUMBRA_RECT(0) ", vec2(I(4), I(5))); " PENUMBRA_PUT_RECT,
                 [](const float* i, float* o) { put(extend(rect(i), vec2(i + 4)), o); }, anything, 0, nullptr});
    f.push_back(
        {"intersect", "geometry", 8, 4,
         "penumbra_Rect2 r = penumbra_intersect(" PENUMBRA_RECT(0) ", " PENUMBRA_RECT(4) "); " PENUMBRA_PUT_RECT,
         [](const float* i, float* o) { put(intersect(rect(i), rect(i + 4)), o); }, anything, 0, nullptr});
    f.push_back({"area", "geometry", 4, 1, "O(0) = penumbra_area(" PENUMBRA_RECT(0) ");",
                 [](const float* i, float* o) { o[0] = area(rect(i)); }, moderate_all<4>, 0, nullptr});
    f.push_back({"empty_box, is_empty, extend(Box3)", "geometry", 6, 10,
                 "penumbra_Box3 b = penumbra_empty_box(); O(0) = penumbra_is_empty(b) ? 1.0 : 0.0; "
                 "O(8) = b.min.y; O(9) = b.max.z; "
                 "b = penumbra_extend(penumbra_extend(b, vec3(I(0), I(1), I(2))), vec3(I(3), I(4), I(5))); "
                 "for (int k = 0; k < 3; ++k) { O(1 + k) = b.min[k]; O(4 + k) = b.max[k]; } "
                 "O(7) = penumbra_is_empty(penumbra_box3(vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5)))) ? 1.0 : 0.0;",
                 [](const float* i, float* o) {
                     Box3<float> b = empty_box<float>();
                     o[0] = is_empty(b) ? 1.0F : 0.0F, o[8] = b.min.y, o[9] = b.max.z;
                     b = extend(extend(b, vec3(i)), vec3(i + 3));
                     put(b.min, o + 1), put(b.max, o + 4);
                     o[7] = is_empty(Box3<float>{vec3(i), vec3(i + 3)}) ? 1.0F : 0.0F;
                 },
                 anything, 0, nullptr});
    f.push_back({"signed_distance", "geometry", 7, 1,
                 "penumbra_Plane p; p.normal = vec3(I(0), I(1), I(2)); p.offset = I(3); "
                 "O(0) = penumbra_signed_distance(p, vec3(I(4), I(5), I(6)));",
                 [](const float* i, float* o) {
                     o[0] = signed_distance(Plane<float>{vec3(i), i[3]}, vec3(i + 4));
                 },
                 moderate_all<7>, 4,
                 [](const float* i) { return std::max(std::abs(i[3]), largest(i, 3) * largest(i + 4, 3)); }});
    // light
    f.push_back({"LightFrame::to_light", "light", 15, 3,
                 "vec3 v = penumbra_to_light(" PENUMBRA_FRAME ", vec3(I(12), I(13), I(14))); "
                 "O(0) = v.x; O(1) = v.y; O(2) = v.z;",
                 [](const float* i, float* o) { put(frame_of(i).to_light(vec3(i + 12)), o); },
                 [](float* i) { frame(i), moderate_all<3>(i + 12); }, 6,
                 [](const float* i) { return largest(i, 3) + largest(i + 12, 3); }});
    f.push_back({"LightFrame::to_world", "light", 15, 3,
                 "vec3 v = penumbra_to_world(" PENUMBRA_FRAME ", vec3(I(12), I(13), I(14))); "
                 "O(0) = v.x; O(1) = v.y; O(2) = v.z;",
                 [](const float* i, float* o) { put(frame_of(i).to_world(vec3(i + 12)), o); },
                 [](float* i) { frame(i), moderate_all<3>(i + 12); }, 6,
                 [](const float* i) { return largest(i, 3) + largest(i + 12, 3); }});
    f.push_back({"half_size", "light", 9, 2,
                 "penumbra_RectLight l; l.center = vec3(I(0), I(1), I(2)); l.half_u = vec3(I(3), I(4), I(5)); "
                 "l.half_v = vec3(I(6), I(7), I(8)); vec2 v = penumbra_half_size(l); O(0) = v.x; O(1) = v.y;",
                 [](const float* i, float* o) {
                     put(half_size(RectLight<float>{vec3(i), vec3(i + 3), vec3(i + 6)}), o);
                 },
                 moderate_all<9>, 6, nullptr});
    f.push_back(
        {"light_frame(RectLight)", "light", 12, 12,
         "penumbra_RectLight l; l.center = vec3(I(0), I(1), I(2)); l.half_u = vec3(I(3), I(4), I(5)); "
         "l.half_v = vec3(I(6), I(7), I(8)); penumbra_LightFrame f = penumbra_light_frame(l, vec3(I(9), I(10), "
         "I(11))); f.origin -= l.center; " PENUMBRA_PUT_FRAME,
         [](const float* i, float* o) {
             LightFrame<float> made = light_frame(RectLight<float>{vec3(i), vec3(i + 3), vec3(i + 6)}, vec3(i + 9));
             made.origin -= vec3(i);
             put(made, o);
         },
         // an aim near the only side: more than the rounding of unit vectors
         side_by_side, 500, [](const float*) { return 1.0F; }});
    f.push_back({"light_frame(DiskLight)", "light", 6, 12,
                 "penumbra_DiskLight l; l.center = vec3(I(0), I(1), I(2)); l.normal = vec3(I(3), I(4), I(5)); "
                 "penumbra_LightFrame f = penumbra_light_frame(l); f.origin -= l.center; " PENUMBRA_PUT_FRAME,
                 [](const float* i, float* o) {
                     LightFrame<float> made = light_frame(DiskLight<float>{vec3(i), vec3(i + 3), 1.0F});
                     made.origin -= vec3(i);
                     put(made, o);
                 },
                 moderate_all<6>, 16, [](const float*) { return 1.0F; }});
    f.push_back({"light_frame(LinearLight)", "light", 9, 9,
                 "penumbra_LinearLight l; l.a = vec3(I(0), I(1), I(2)); l.b = vec3(I(3), I(4), I(5)); "
                 "penumbra_LightFrame f = penumbra_light_frame(l, vec3(I(6), I(7), I(8))); "
                 "for (int k = 0; k < 3; ++k) { O(k) = f.u[k]; O(3 + k) = f.v[k]; O(6 + k) = f.normal[k]; }",
                 [](const float* i, float* o) {
                     const LightFrame<float> made = light_frame(LinearLight<float>{vec3(i), vec3(i + 3)}, vec3(i + 6));
                     put(made.u, o), put(made.v, o + 3), put(made.normal, o + 6);
                 },
                 moderate_all<9>, 500, [](const float*) { return 1.0F; }});
    f.push_back({"light_frame(LinearLight): origin", "light", 6, 3,
                 "penumbra_LinearLight l; l.a = vec3(I(0), I(1), I(2)); l.b = vec3(I(3), I(4), I(5)); "
                 "vec3 v = penumbra_light_frame(l, vec3(0.0, 0.0, 1.0)).origin; O(0) = v.x; O(1) = v.y; O(2) = v.z;",
                 [](const float* i, float* o) {
                     put(light_frame(LinearLight<float>{vec3(i), vec3(i + 3)}).origin, o);
                 },
                 moderate_all<6>, 2, [](const float* i) { return largest(i, 6); }});
    // combine
    f.push_back({"combine_product, _sum, _max, _mean", "combine", 2, 4,
                 "O(0) = penumbra_combine_product(I(0), I(1)); O(1) = penumbra_combine_sum(I(0), I(1)); "
                 "O(2) = penumbra_combine_max(I(0), I(1)); O(3) = penumbra_combine_mean(I(0), I(1));",
                 [](const float* i, float* o) {
                     o[0] = combine_product(i[0], i[1]), o[1] = combine_sum(i[0], i[1]);
                     o[2] = combine_max(i[0], i[1]), o[3] = combine_mean(i[0], i[1]);
                 },
                 shares<2>, 2, nullptr});
    f.push_back({"occlusion_bounds", "combine", 2, 2,
                 "penumbra_OcclusionBounds b = penumbra_occlusion_bounds(I(0), I(1)); O(0) = b.lower; O(1) = b.upper;",
                 [](const float* i, float* o) { put(occlusion_bounds(i[0], i[1]), o); }, shares<2>, 0, nullptr});
    f.push_back(
        {"OcclusionAccumulator", "combine", 3, 6,
         PENUMBRA_ACCUMULATED
         "penumbra_OcclusionBounds b = penumbra_bounds(a); O(0) = b.lower; O(1) = b.upper; "
         "O(2) = penumbra_result(a, PENUMBRA_COMBINATION_PRODUCT); O(3) = penumbra_result(a, "
         "PENUMBRA_COMBINATION_SUM); "
         "O(4) = penumbra_result(a, PENUMBRA_COMBINATION_MAX); O(5) = penumbra_result(a, PENUMBRA_COMBINATION_MEAN);",
         [](const float* i, float* o) {
             const OcclusionAccumulator<float> a = accumulated(i);
             put(a.bounds(), o);
             o[2] = a.result(Combination::product), o[3] = a.result(Combination::sum);
             o[4] = a.result(Combination::max), o[5] = a.result(Combination::mean);
         },
         shares<3>, 4, [](const float*) { return 1.0F; }});
    // occlusion_texture
    f.push_back(
        {"kernel_scale, kernel_size", "occlusion_texture/kernel", 3, 2,
         "O(0) = penumbra_kernel_scale(I(0), I(1)); O(1) = penumbra_kernel_size(I(0), I(1), I(2));",
         [](const float* i, float* o) { o[0] = kernel_scale(i[0], i[1]), o[1] = kernel_size(i[0], i[1], i[2]); },
         [](float* i) { moderate_all<3>(i), i[2] = std::abs(i[2]); }, 4, nullptr});
    f.push_back({"kernel_rect", "occlusion_texture/kernel", 8, 4,
                 "penumbra_Rect2 r = penumbra_kernel_rect(I(0), vec3(I(1), I(2), I(3)), " PENUMBRA_RECT(
                     4) "); " PENUMBRA_PUT_RECT,
                 [](const float* i, float* o) { put(kernel_rect(i[0], vec3(i + 1), rect(i + 4)), o); }, moderate_all<8>,
                 6, [](const float* i) { return largest(i + 1, 2) + largest(i + 4, 4); }});
    f.push_back({"SliceCamera::project", "occlusion_texture/slice_camera", 8, 4,
                 PENUMBRA_CAMERA "vec4 v = penumbra_project(c, vec3(I(5), I(6), I(7))); "
                                 "O(0) = v.x; O(1) = v.y; O(2) = v.z; O(3) = v.w;",
                 [](const float* i, float* o) {
                     const RasterVertex<float> v = camera(i).project(vec3(i + 5));
                     o[0] = v.x, o[1] = v.y, o[2] = v.depth, o[3] = v.w;
                 },
                 [](float* i) { moderate_all<8>(i), i[0] = share(i[0]), i[7] = std::abs(i[7]); }, 6,
                 [](const float* i) {
                     const float w = 1.0F + i[0] * i[7];
                     return std::max(w, largest(i + 5, 2) * largest(i + 3, 2) + largest(i + 1, 2) * w);
                 }});
    f.push_back({"SliceCamera::footprint", "occlusion_texture/slice_camera", 13, 4,
                 PENUMBRA_CAMERA
                 "penumbra_Rect2 r = penumbra_footprint(c, I(5), vec3(I(6), I(7), I(8)), " PENUMBRA_RECT(
                     9) "); " PENUMBRA_PUT_RECT,
                 [](const float* i, float* o) { put(camera(i).footprint(i[5], vec3(i + 6), rect(i + 9)), o); },
                 camera_and_point, 12,
                 [](const float* i) {
                     const float w = 1.0F + i[0] * i[5];
                     return largest(i + 1, 2) + (largest(i + 6, 2) + largest(i + 9, 4)) * largest(i + 3, 2) / w;
                 }});
    f.push_back({"SliceRange::top, ::bottom", "occlusion_texture/slices", 4, 2,
                 PENUMBRA_RANGE "O(0) = penumbra_top(r, int(I(3))); O(1) = penumbra_bottom(r, int(I(3)));",
                 [](const float* i, float* o) {
                     o[0] = range(i).top(static_cast<int>(i[3])), o[1] = range(i).bottom(static_cast<int>(i[3]));
                 },
                 [](float* i) { slices(i), i[3] = whole(i[3], 0, 64); }, 2,
                 [](const float* i) { return std::abs(i[0]) + i[1] * 65.0F; }});
    f.push_back({"SliceRange::slice_of", "occlusion_texture/slices", 4, 1,
                 PENUMBRA_RANGE "O(0) = float(penumbra_slice_of(r, I(3)));",
                 [](const float* i, float* o) { o[0] = static_cast<float>(range(i).slice_of(i[3])); },
                 [](float* i) {  // powers of two, where the division is exact on every driver, so that boundaries agree
                     i[0] = std::floor(moderate(i[0])), i[1] = std::ldexp(1.0F, static_cast<int>(whole(i[1], -6, 6)));
                     i[2] = std::ldexp(1.0F, static_cast<int>(whole(i[2], 0, 6)));
                     i[3] = i[0] + i[1] * (i[2] + 2.0F) * (share(i[3]) - 0.01F);
                 },
                 0, nullptr});
    f.push_back({"relative_depth", "occlusion_texture/slices", 3, 1,
                 "O(0) = penumbra_relative_depth(I(0), I(1), I(2));",
                 [](const float* i, float* o) { o[0] = relative_depth(i[0], i[1], i[2]); },
                 [](float* i) { moderate_all<3>(i), i[1] = std::abs(i[1]); }, 4, nullptr});
    f.push_back({"slice_plane_depth", "occlusion_texture/slices", 3, 2,
                 "O(0) = penumbra_slice_plane_depth(I(0), I(1), I(2), PENUMBRA_SLICE_PLANE_BOTTOM); "
                 "O(1) = penumbra_slice_plane_depth(I(0), I(1), I(2), PENUMBRA_SLICE_PLANE_MIDDLE);",
                 [](const float* i, float* o) {
                     o[0] = slice_plane_depth(i[0], i[1], i[2], SlicePlane::bottom);
                     o[1] = slice_plane_depth(i[0], i[1], i[2], SlicePlane::middle);
                 },
                 moderate_all<3>, 2, [](const float* i) { return largest(i, 3); }});
    f.push_back({"slice_weight", "occlusion_texture/slices", 3, 3,
                 "O(0) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_FADE); "
                 "O(1) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_CLEAR); "
                 "O(2) = penumbra_slice_weight(I(0), I(1), I(2), PENUMBRA_SELF_SHADOW_MEAN_DEPTH);",
                 [](const float* i, float* o) {
                     o[0] = slice_weight(i[0], i[1], i[2], SelfShadow::fade);
                     o[1] = slice_weight(i[0], i[1], i[2], SelfShadow::clear);
                     o[2] = slice_weight(i[0], i[1], i[2], SelfShadow::mean_depth);
                 },
                 [](float* i) { i[0] = 4.0F * share(i[0]), i[1] = share(i[1]), i[2] = std::max(0.001F, share(i[2])); },
                 4, nullptr});
    // detail/boxes
    f.push_back({"widen", "detail/boxes", 5, 6,
                 "vec2 s = penumbra_widen(vec2(I(0), I(1)), I(4)); O(0) = s.x; O(1) = s.y; "
                 "penumbra_Rect2 r = penumbra_widen(" PENUMBRA_RECT(
                     0) "); "
                        "O(2) = r.min.x; O(3) = r.min.y; O(4) = r.max.x; O(5) = r.max.y;",
                 [](const float* i, float* o) {
                     o[0] = i[0], o[1] = i[1];
                     detail::widen(o[0], o[1], i[4]);
                     put(detail::widen(rect(i)), o + 2);
                 },
                 [](float* i) { i[4] = std::max(0.0625F, share(i[4])); }, 2,
                 [](const float* i) { return std::min(largest(i, 4), 65536.0F); }});
    f.push_back({"square_tiles", "detail/boxes", 4, 6,
                 "penumbra_Tiles t = penumbra_square_tiles(" PENUMBRA_RECT(
                     0) "); O(0) = t.first.x; O(1) = t.first.y; "
                        "O(2) = t.step.x; O(3) = t.step.y; O(4) = t.size; O(5) = float(t.count);",
                 [](const float* i, float* o) {
                     const detail::Tiles<float> t = detail::square_tiles(rect(i));
                     put(t.first, o), put(t.step, o + 2), o[4] = t.size, o[5] = static_cast<float>(t.count);
                 },
                 [](float* i) {  // sides in eighths: longer / shorter + 1/2 is then no near tie but an exact one
                     for (int k = 0; k < 4; ++k) i[k] = whole(i[k], 0, 4000) / 8.0F;
                     i[2] = i[0] + 0.125F + i[2], i[3] = i[1] + 0.125F + i[3];
                 },
                 4, [](const float* i) { return largest(i, 4); }});
    return f;
}

#undef PENUMBRA_FRAME
#undef PENUMBRA_RECT
#undef PENUMBRA_PUT_RECT
#undef PENUMBRA_PUT_FRAME
#undef PENUMBRA_CAMERA
#undef PENUMBRA_RANGE
#undef PENUMBRA_ACCUMULATED

}  // namespace functions
}  // namespace penumbra::test
