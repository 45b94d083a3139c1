// Arithmetic that stays finite and means the same on every driver.
//
// Options: none
// Error:   exact, but for the one rounding of each division; GLSL promises 2.5 ULP there.
// C++:     include/penumbra/numeric.hpp
#ifndef PENUMBRA_NUMERIC_GLSL
#define PENUMBRA_NUMERIC_GLSL

// The smallest normal number: drivers flush what is below.
#define PENUMBRA_SMALLEST 1.17549435e-38f

// x limited to [low, high]; low for NaN, where the driver keeps NaN. Needs low <= high.
float penumbra_clamp(float x, float low, float high) { return x > low ? (x < high ? x : high) : low; }

// x limited to [0, 1].
float penumbra_saturate(float x) { return penumbra_clamp(x, 0.0f, 1.0f); }

// numerator / denominator limited to [0, 1], without ever dividing by zero or overflowing. Domain: denominator >= 0. A
// zero denominator is the limit "nothing of nothing": 0 for numerator <= 0, else 1.
float penumbra_saturated_ratio(float numerator, float denominator) {
    bool divides = denominator > 0.0f;
    float limit = divides ? denominator : 0.0f;
    float ratio = penumbra_clamp(numerator, 0.0f, limit) / (divides ? denominator : 1.0f);
    return divides ? penumbra_saturate(ratio) : (numerator > 0.0f ? 1.0f : 0.0f);
}

// numerator / denominator, or `fallback` where |denominator| is zero or a denormal.
float penumbra_safe_ratio(float numerator, float denominator, float fallback) {
    float magnitude = denominator < 0.0f ? -denominator : denominator;
    return magnitude >= PENUMBRA_SMALLEST ? numerator / denominator : fallback;
}

// a + t (b - a), exactly a at t = 0 and exactly b at t = 1, for t in [0, 1].
float penumbra_mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }

// floor(log2(x)) from the exponent bits, for every normal x > 0. The sign is ignored; zero and denormals give -127,
// infinity and NaN 128.
int penumbra_floor_log2(float x) { return int((floatBitsToUint(x) >> 23u) & 255u) - 127; }

// 2^exponent from exponent bits, -126 <= exponent <= 127.
float penumbra_exp2_int(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23u); }

// True unless x is NaN or infinite.
bool penumbra_is_finite(float x) { return penumbra_floor_log2(x) <= 127; }

#endif
