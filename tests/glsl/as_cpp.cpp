// The twins that read no texture, compiled as C++, against the C++ in float.
#include <doctest/doctest.h>

#include <cstdio>

#include "functions.hpp"
#include "tuples.hpp"

namespace test = penumbra::test;

TEST_CASE("the twins' own text, compiled as C++, gives the bits of the C++") {
    for (test::Function f : test::functions::all()) {
#ifndef __FP_FAST_FMAF  // there compilers fuse products and sums as they please
        f.ulps = 0;
#endif
        const std::vector<float> in = test::make_inputs(f, 1 << 15);
        std::vector<float> out(in.size() / static_cast<std::size_t>(f.inputs) * static_cast<std::size_t>(f.outputs));
        for (std::size_t i = 0, o = 0; i < in.size(); i += static_cast<std::size_t>(f.inputs)) {
            f.twin({&in[i]}, {&out[o]});
            o += static_cast<std::size_t>(f.outputs);
        }
        const test::Worst worst = test::compare(f, in, out);
        std::printf("%-32s %-36s %8d inputs  worst %.3g, %.3g ULP\n", f.snippet, f.name, 1 << 15, worst.absolute,
                    worst.ulps);
        CAPTURE(f.name);
        CAPTURE(worst.input);
        CHECK(worst.outside == 0);
    }
}
