// How a twin that reads no texture, compiled as C++, is compared with its C++.
//
// Both do the same operations in the same order, so they agree bit for bit; where the compiler may fuse or reorder
// (-ffast-math, machines that fuse by themselves), to a few ULP of the largest number that goes in.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <penumbra/geometry.hpp>
#include <string>
#include <vector>

#include "as_cpp.hpp"
#include "support/random.hpp"

namespace penumbra::test::as_cpp {

#if defined(__FAST_MATH__) || defined(__FP_FAST_FMAF)
constexpr bool same_bits = false;
#else
constexpr bool same_bits = true;
#endif

constexpr int tries = 1 << 15;
using Floats = std::vector<float>;
using Change = void (*)(float* in);
using Call = Floats (*)(const float* in);
using Size = float (*)(const float* in);

// --- Results as numbers -------------------------------------------------------------------------------------
inline void put(Floats& out, float x) { out.push_back(x); }
inline void put(Floats& out, int x) { out.push_back(static_cast<float>(x)); }
inline void put(Floats& out, bool x) { out.push_back(x ? 1.0F : 0.0F); }
template <int N>
inline void put(Floats& out, const glm::vec<N, float, glm::defaultp>& v) {
    for (int k = 0; k < N; ++k) out.push_back(v[k]);
}
template <class... Part>
inline Floats floats(const Part&... parts) {
    Floats out;
    (put(out, parts), ...);
    return out;
}
template <class Box>
inline Floats ends(const Box& box) {
    return floats(box.min, box.max);
}
template <class Frame>
inline Floats axes(const Frame& f) {
    return floats(f.origin, f.u, f.v, f.normal);
}
template <class Bounds>
inline Floats interval(const Bounds& b) {
    return floats(b.lower, b.upper);
}
template <class Tiles>
inline Floats tiles(const Tiles& t) {
    return floats(t.first, t.step, t.size, t.count);
}

// --- Inputs -------------------------------------------------------------------------------------------------
inline Vec2<float> v2(const float* in) { return {in[0], in[1]}; }
inline Vec3<float> v3(const float* in) { return {in[0], in[1], in[2]}; }

inline float nudged(penumbra::test::Random& random, float x) {
    std::int32_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    if ((bits & 0x7fffffff) > 8 && (bits & 0x7fffffff) < 0x7f7ffff0) bits += random.whole(-3, 3);
    std::memcpy(&x, &bits, sizeof bits);
    return x;
}

inline float any_size(penumbra::test::Random& random) {
    const bool wide = random.whole(0, 3) == 0;
    const int exponent = wide ? random.whole(-126, 127) : random.whole(-12, 12);
    const float magnitude = std::ldexp(random.in(1.0F, 2.0F), exponent);
    return random.whole(0, 1) == 0 ? magnitude : -magnitude;
}

/// Half of the tuples of any size, half from special values, or within a few ULP of these or of each other.
inline void fill(penumbra::test::Random& random, bool plain, float* in, int count) {
    constexpr float least = std::numeric_limits<float>::min(), most = std::numeric_limits<float>::max();
    constexpr float special[] = {0.0F, -0.0F,   least,       -least, most,  -most,    1.0F, -1.0F,
                                 0.5F, 0.0625F, 1.0F / 3.0F, 255.0F, 1e-6F, 65536.0F, 1e9F, 2.0F};
    for (int k = 0; k < count; ++k) {
        const int kind = plain ? 0 : random.whole(0, 3);
        if (kind == 0) in[k] = any_size(random);
        if (kind == 1 || (kind == 3 && k == 0)) in[k] = special[random.whole(0, 15)];
        if (kind == 2) in[k] = nudged(random, special[random.whole(0, 15)]);
        if (kind == 3 && k > 0) in[k] = nudged(random, in[random.whole(0, k - 1)]);
    }
}

inline void anything(float*) {}
/// To 2^-20 … 2^20, where no product of several overflows or vanishes.
inline float moderate(float x) {
    if (!(std::abs(x) > 0.0F)) return 0.0F;
    int exponent = 0;
    const float mantissa = std::frexp(x, &exponent);
    return std::ldexp(mantissa, penumbra::clamp(exponent, -20, 20));
}
template <int Count>
inline void moderate_all(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = moderate(in[k]);
}
/// To [0, 1], both included.
inline float share(float x) { return std::abs(x) <= 1.0F ? std::abs(x) : 1.0F / std::abs(x); }
template <int Count>
inline void shares(float* in) {
    for (int k = 0; k < Count; ++k) in[k] = share(in[k]);
}
/// A whole number from `low` to `high`.
inline float whole(float x, int low, int high) {
    return static_cast<float>(low + static_cast<int>(std::abs(moderate(x)) * 977.0F) % (high - low + 1));
}
inline void put_unit(float* in) {
    const Vec3<float> n = penumbra::normalize_or(v3(in), Vec3<float>(0, 0, 1));
    for (int k = 0; k < 3; ++k) in[k] = n[k];
}
inline float largest(const float* in, int count) {
    float result = 0.0F;
    for (int k = 0; k < count; ++k) result = std::max(result, std::abs(in[k]));
    return result;
}
template <int Count>
inline float largest_of(const float* in) {
    return largest(in, Count);
}
inline float one(const float*) { return 1.0F; }

// --- Comparison ---------------------------------------------------------------------------------------------
/// Where bits may differ: `ulps` of size(in), or of the result itself without one. 0: bit for bit under every flag.
template <int Inputs>
inline void compare(const char* name, Call cpp, Call twin, Change domain, double ulps = 0, Size size = nullptr) {
    penumbra::test::Random random(7);
    int wrong = 0;
    double worst = 0;
    std::string worst_in;
    for (int i = 0; i < tries; ++i) {
        float in[Inputs];
        fill(random, i % 2 == 0, in, Inputs);
        domain(in);
        const Floats a = cpp(in), b = twin(in);
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k) {
            if (a[k] == b[k] || std::memcmp(&a[k], &b[k], sizeof(float)) == 0) continue;
            const float scale =
                size == nullptr ? std::max(std::abs(a[k]), std::numeric_limits<float>::min()) : size(in);
            const double error = std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k])) /
                                 (static_cast<double>(scale) * std::ldexp(1.0, -23));
            wrong += same_bits || !(error <= ulps) ? 1 : 0;
            if (error <= worst) continue;
            worst = error;
            worst_in.clear();
            for (const float x : in) {
                char hex[40];
                std::snprintf(hex, sizeof hex, "%a ", static_cast<double>(x));
                worst_in += hex;
            }
        }
    }
    std::printf("%-28s %d inputs  worst %.3g ULP %s\n", name, tries, worst, worst_in.c_str());
    CAPTURE(name);
    CAPTURE(worst_in);
    CHECK(wrong == 0);
}

// A call with numbers for arguments.
#define CALL [](const float* i) -> Floats

inline glsl::penumbra_Rect2 rect_twin(const float* i) { return glsl::penumbra_rect2(v2(i), v2(i + 2)); }
inline Rect2<float> rect(const float* i) { return {v2(i), v2(i + 2)}; }

}  // namespace penumbra::test::as_cpp
