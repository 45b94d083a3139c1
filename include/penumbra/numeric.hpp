// Arithmetic that stays finite and means the same under every optimisation flag, -ffast-math included.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace penumbra {

/// π, to the precision of T.
template <class T>
inline constexpr T pi = static_cast<T>(3.14159265358979323846L);

/// x limited to [low, high]; low for NaN. Needs low ≤ high. Exact.
template <class T>
constexpr T clamp(T x, T low, T high) {
    return x > low ? (x < high ? x : high) : low;
}

/// x limited to [0, 1]; 0 for NaN. Exact.
template <class T>
constexpr T saturate(T x) {
    return clamp(x, T(0), T(1));
}

/// numerator / denominator limited to [0, 1], without ever dividing by zero or overflowing.
/// Domain: denominator ≥ 0. A zero denominator is the limit "nothing of nothing": 0 for numerator ≤ 0,
/// else 1. Error: one rounding. With -ffast-math, which multiplies by reciprocals, 3 ULP for denominators in
/// [min / ε, max / 4], and only the range [0, 1] beyond.
template <class T>
constexpr T saturated_ratio(T numerator, T denominator) {
    const bool divides = denominator > T(0);  // no branch: loops over it vectorise
    const T ratio = clamp(numerator, T(0), divides ? denominator : T(0)) / (divides ? denominator : T(1));
    return divides ? ratio : (numerator > T(0) ? T(1) : T(0));
}

/// numerator / denominator, or `fallback` where |denominator| < the smallest normal number (zero and
/// denormals, which drivers flush). The quotient may still overflow if numerator is huge; keep |numerator|
/// below 1/ε there.
template <class T>
constexpr T safe_ratio(T numerator, T denominator, T fallback) {
    const T magnitude = denominator < T(0) ? -denominator : denominator;
    return magnitude >= std::numeric_limits<T>::min() ? numerator / denominator : fallback;
}

/// a + t (b − a), exactly a at t = 0 and exactly b at t = 1, for t in [0, 1].
template <class T>
constexpr T mix(T a, T b, T t) {
    return a * (T(1) - t) + b * t;
}

/// a·b − c·d without the cancellation of the plain expression.
/// Error: 1.5 ULP of the result, unless a product overflows or underflows; for double, -ffast-math may undo it.
/// Source: W. Kahan, "On the cost of floating-point computation without extra-precise arithmetic", 2004;
/// for float, products are exact in double.
inline float difference_of_products(float a, float b, float c, float d) {
    return static_cast<float>(static_cast<double>(a) * static_cast<double>(b) -
                              static_cast<double>(c) * static_cast<double>(d));
}
inline double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    const double error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

/// ⌊log₂ x⌋ read from the exponent bits: exact for every normal x > 0, where log2 would round up just below a
/// power of two. The sign is ignored; zero and denormals give −127 (float) or −1023 (double), infinity and
/// NaN one more than the largest exponent.
inline int floor_log2(float x) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return static_cast<int>((bits >> 23) & 0xffU) - 127;
}
inline int floor_log2(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return static_cast<int>((bits >> 52) & 0x7ffU) - 1023;
}

/// 2^exponent, exactly, built from exponent bits. Domain: the normal range of T.
template <class T>
T exp2_int(int exponent) {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>, "float or double");
    T result;
    if constexpr (std::is_same_v<T, float>) {
        const std::uint32_t bits = static_cast<std::uint32_t>(exponent + 127) << 23;
        std::memcpy(&result, &bits, sizeof result);
    } else {
        const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
        std::memcpy(&result, &bits, sizeof result);
    }
    return result;
}

/// True unless x is NaN or infinite. Looks at bits, so that -ffast-math cannot assume the answer.
template <class T>
bool is_finite(T x) {
    return floor_log2(x) <= std::numeric_limits<T>::max_exponent - 1;
}

}  // namespace penumbra
