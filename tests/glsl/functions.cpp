// Every plain twin on the driver, on 2^20 inputs a function, against the C++ in float. Half of the inputs are special
// values or a few ULP from each other.
#include "functions.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "compute.hpp"
#include "tuples.hpp"

using penumbra::test::Function;
namespace test = penumbra::test;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int full_count = 1 << 14;
#else
constexpr int full_count = 1 << 20;
#endif
/// Fewer for mutants.sh, which runs this a few hundred times.
const bool mutant = std::getenv("PENUMBRA_SHADERS") != nullptr;
const int count = mutant ? 1 << 12 : full_count;

}  // namespace

TEST_CASE("twins on the driver are the C++") {
    const test::Context context;
    std::ofstream table("glsl-parity.csv");
    table << "snippet,function,inputs,worst absolute,worst ulp,bound ulp,worst input\n";
    for (const Function& f : test::functions::all()) {
        const std::vector<float> in = test::make_inputs(f, count);
        const test::Compute compute{
            std::string(f.snippet) + ".glsl", f.inputs, f.outputs, {}, "", f.glsl, test::Route::direct};
        const test::Worst worst = compare(f, in, compute.run(context, in));
        std::printf("%-32s %-36s %8d inputs  worst %.3g, %.3g ULP of %.3g at %s\n", f.snippet, f.name, count,
                    worst.absolute, worst.ulps, f.ulps, worst.input.c_str());
        table << f.snippet << ",\"" << f.name << "\"," << count << "," << worst.absolute << "," << worst.ulps << ","
              << f.ulps << "," << worst.input << "\n";
        CAPTURE(f.name);
        CAPTURE(worst.input);
        CHECK(worst.outside == 0);
    }
}

TEST_CASE("and so is what SPIRV-Cross makes of them, in desktop GLSL and in ES") {
    if (mutant) return;
    for (const test::Api api : {test::Api::desktop, test::Api::es}) {
        const test::Context context(api);
        for (const Function& f : test::functions::all()) {
            const std::vector<float> in = test::make_inputs(f, 1 << 12);
            const test::Compute compute{std::string(f.snippet) + ".glsl", f.inputs, f.outputs, {}, "", f.glsl,
                                        test::Route::spirv_cross};
            const test::Worst worst = compare(f, in, compute.run(context, in));
            CAPTURE(f.name);
            CAPTURE(worst.input);
            CHECK(worst.outside == 0);
        }
    }
}
