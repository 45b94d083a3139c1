// Arguments as numbers, results as numbers, and what moves any numbers into the domain of a function.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/light.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slices.hpp>

namespace penumbra::test::functions {

inline Vec2<float> v2(const float* in) { return {in[0], in[1]}; }
inline Vec3<float> v3(const float* in) { return {in[0], in[1], in[2]}; }
inline Rect2<float> rect(const float* in) { return {v2(in), v2(in + 2)}; }
inline void put(const Vec2<float>& v, float* out) { out[0] = v.x, out[1] = v.y; }
inline void put(const Vec3<float>& v, float* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }
inline Box3<float> box(const float* in) { return {v3(in), v3(in + 3)}; }
inline void put(const Rect2<float>& r, float* out) { put(r.min, out), put(r.max, out + 2); }
inline void put(const LightFrame<float>& f, float* out) {
    put(f.origin, out), put(f.u, out + 3), put(f.v, out + 6), put(f.normal, out + 9);
}
inline void put(const OcclusionBounds<float>& b, float* out) { out[0] = b.lower, out[1] = b.upper; }
inline SliceCamera<float> camera(const float* in) {
    SliceCamera<float> c;
    c.convergence = in[0], c.origin_tx = v2(in + 1), c.scale_tx = v2(in + 3);
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
inline void unit(float* in) { put(normalize_or(v3(in), Vec3<float>(0, 0, 1)), in); }
/// A right-handed frame from any two vectors.
inline void frame(float* in) {
    for (int k = 0; k < 12; ++k) in[k] = moderate(in[k]);
    put(light_frame(DiskLight<float>{v3(in), v3(in + 3), 1.0F}), in);
}
inline LightFrame<float> frame_of(const float* in) { return {v3(in), v3(in + 3), v3(in + 6), v3(in + 9)}; }
inline void side_by_side(float* in) {  // half_v at a right angle to half_u, now and then of no size
    for (int k = 0; k < 12; ++k) in[k] = moderate(in[k]);
    for (const int k : {3, 9})  // no size, no aim
        if (in[k] == 0.0F) in[k + 1] = in[k + 2] = 0.0F;
    const Vec3<float> u = v3(in + 3), v = v3(in + 6), direction = normalize_or(u, Vec3<float>(0, 0, 0));
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

/// 0, or 2^-20 to 1: products and ratios of a few are normal numbers.
inline float moderate_share(float x) { return moderate(share(x)); }
/// A box in light space, before the light or behind it, now and then flat, seldom empty.
inline void caster_box(float* in) {
    for (int k = 0; k < 3; ++k) {
        const float low = in[k], size = in[3 + k];
        in[k] = (k == 2 && low < 0.0F ? 1.0F : 4.0F) * std::copysign(moderate_share(low), low);
        in[3 + k] = in[k] + (size < -1e30F ? -1.0F : 4.0F * moderate_share(size));
    }
}
/// Around points that casters are before, most of them.
inline void receiver_box(float* in) {
    const float away = in[2] < 0.0F ? 0.0F : 4.0F;
    caster_box(in);
    in[2] += away, in[5] += away;
}

}  // namespace penumbra::test::functions
