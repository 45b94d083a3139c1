// Numbers to call twins with, and how far results are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "glsl/functions/function.hpp"
#include "support/random.hpp"

namespace penumbra::test {

inline constexpr float smallest = std::numeric_limits<float>::min(), biggest = std::numeric_limits<float>::max();

inline float of_any_size(Random& random) {
    const int exponent = random.whole(-125, 126), narrow = random.whole(-4, 4);
    const float mantissa = random.in(1.0F, 2.0F), sign = random.whole(0, 1) == 0 ? 1.0F : -1.0F;
    return sign * std::ldexp(mantissa, random.whole(0, 1) == 0 ? exponent : narrow);
}

/// x moved by up to 4 ULP, and kept a normal number or 0, since drivers may flush what is smaller.
inline float nudged(Random& random, float x) {
    const int steps = random.whole(-4, 4);
    for (int k = 0; k < std::abs(steps); ++k) x = std::nextafter(x, steps < 0 ? -biggest : biggest);
    return std::abs(x) < smallest ? 0.0F : x;
}

/// Half of the tuples of any size; the others special values, or a few ULP from these or from each other.
inline std::vector<float> make_inputs(const Function& f, int tuples) {
    constexpr float special[] = {0.0F, -0.0F, smallest, -smallest,   biggest, -biggest, 1.0F,     -1.0F,
                                 0.5F, 2.0F,  0.0625F,  1.0F / 3.0F, 255.0F,  1e-6F,    65536.0F, 1e9F};
    Random random(1);
    const auto inputs = static_cast<std::size_t>(f.inputs);
    std::vector<float> in(inputs * static_cast<std::size_t>(tuples));
    for (std::size_t i = 0; i < static_cast<std::size_t>(tuples); ++i) {
        float* tuple = &in[i * inputs];
        for (std::size_t k = 0; k < inputs; ++k) {
            const int kind = i % 2 == 0 ? 0 : random.whole(1, 3);
            if (kind == 0 || (kind == 3 && k == 0)) tuple[k] = of_any_size(random);
            if (kind == 1) tuple[k] = special[random.whole(0, 15)];
            if (kind == 2) tuple[k] = nudged(random, special[random.whole(0, 15)]);
            if (kind == 3 && k > 0) tuple[k] = nudged(random, tuple[random.whole(0, static_cast<int>(k) - 1)]);
        }
        f.domain(tuple);
        for (std::size_t k = 0; k < inputs; ++k)
            if (std::abs(tuple[k]) < smallest) tuple[k] = 0.0F;
    }
    return in;
}

inline std::string hex(const float* values, int n) {
    std::string text;
    for (int k = 0; k < n; ++k) {
        std::uint32_t bits;
        std::memcpy(&bits, values + k, sizeof bits);
        char word[16];
        std::snprintf(word, sizeof word, "%s%08x", k == 0 ? "" : " ", bits);
        text += word;
    }
    return text;
}

struct Worst {
    double absolute = 0, ulps = 0;
    int outside = 0;
    std::string input = "-";  // of the largest error in ULP
};

inline Worst compare(const Function& f, const std::vector<float>& in, const std::vector<float>& out) {
    Worst worst;
    float truth[16];
    const int tuples = static_cast<int>(in.size()) / f.inputs;
    for (int i = 0; i < tuples; ++i) {
        const float* tuple = &in[static_cast<std::size_t>(i * f.inputs)];
        f.cpp(tuple, truth);
        for (int k = 0; k < f.outputs; ++k) {
            const float got = out[static_cast<std::size_t>(i * f.outputs + k)];
            const double error = std::abs(static_cast<double>(got) - static_cast<double>(truth[k]));
            const float size = std::max({std::abs(truth[k]), f.scale == nullptr ? 0.0F : f.scale(tuple), smallest});
            const double ulps = std::ldexp(error, 23 - floor_log2(std::min(size, biggest)));
            // results below the smallest normal number may be flushed; is_finite: NaN never compares
            const bool flushed = error < static_cast<double>(smallest) * 1.0001 && f.ulps > 0;
            if (!flushed && !(ulps <= f.ulps)) ++worst.outside;
            worst.absolute = std::max(worst.absolute, error);
            if (!flushed && ulps > worst.ulps) worst.ulps = ulps, worst.input = hex(tuple, f.inputs);
        }
    }
    return worst;
}

}  // namespace penumbra::test
