// Every plain twin on the driver, on 2^20 inputs a function, against the C++ in float. Half of the inputs are special
// values or a few ULP from each other.
#include "functions.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "compute.hpp"
#include "support/random.hpp"

using namespace penumbra;
using test::Function;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int full_count = 1 << 14;
#else
constexpr int full_count = 1 << 20;
#endif
/// Fewer for mutants.sh, which runs this a few hundred times.
const int count = std::getenv("PENUMBRA_SHADERS") != nullptr ? 1 << 12 : full_count;

constexpr float smallest = std::numeric_limits<float>::min(), biggest = std::numeric_limits<float>::max();

float of_any_size(test::Random& random) {
    const int exponent = random.whole(-125, 126), narrow = random.whole(-4, 4);
    const float mantissa = random.in(1.0F, 2.0F), sign = random.whole(0, 1) == 0 ? 1.0F : -1.0F;
    return sign * std::ldexp(mantissa, random.whole(0, 1) == 0 ? exponent : narrow);
}

/// x moved by up to 4 ULP, and kept a normal number or 0, since drivers may flush what is smaller.
float nudged(test::Random& random, float x) {
    const int steps = random.whole(-4, 4);
    for (int k = 0; k < std::abs(steps); ++k) x = std::nextafter(x, steps < 0 ? -biggest : biggest);
    return std::abs(x) < smallest ? 0.0F : x;
}

std::vector<float> make_inputs(const Function& f) {
    constexpr float special[] = {0.0F, -0.0F, smallest, -smallest,   biggest, -biggest, 1.0F,     -1.0F,
                                 0.5F, 2.0F,  0.0625F,  1.0F / 3.0F, 255.0F,  1e-6F,    65536.0F, 1e9F};
    test::Random random(1);
    const auto inputs = static_cast<std::size_t>(f.inputs);
    std::vector<float> in(inputs * static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
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

std::string hex(const float* values, int n) {
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

Worst compare(const Function& f, const std::vector<float>& in, const std::vector<float>& out) {
    Worst worst;
    float truth[16];
    for (int i = 0; i < count; ++i) {
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

}  // namespace

TEST_CASE("twins on the driver are the C++") {
    const test::Context context;
    std::ofstream table("glsl-parity.csv");
    table << "snippet,function,inputs,worst absolute,worst ulp,bound ulp,worst input\n";
    for (const Function& f : test::functions::all()) {
        const std::vector<float> in = make_inputs(f);
        const test::Compute compute{std::string(f.snippet) + ".glsl", f.inputs, f.outputs, {}, "", f.glsl};
        const Worst worst = compare(f, in, compute.run(context, in));
        std::printf("%-32s %-36s %8d inputs  worst %.3g, %.3g ULP of %.3g at %s\n", f.snippet, f.name, count,
                    worst.absolute, worst.ulps, f.ulps, worst.input.c_str());
        table << f.snippet << ",\"" << f.name << "\"," << count << "," << worst.absolute << "," << worst.ulps << ","
              << f.ulps << "," << worst.input << "\n";
        CAPTURE(f.name);
        CAPTURE(worst.input);
        CHECK(worst.outside == 0);
    }
}
