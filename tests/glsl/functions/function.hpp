// A twin that reads no texture, beside its C++: how to call both, with what, and how far apart they may be.
#pragma once

#include <vector>

#include "glsl/as_cpp.hpp"
#include "glsl/functions/domains.hpp"

namespace penumbra::test {

/// The numbers of a call, written I(k) and O(k) in both languages.
struct In {
    const float* values;
    float operator()(int k) const { return values[k]; }
};
struct Out {
    float* values;
    float& operator()(int k) const { return values[k]; }
};

struct Function {
    const char *name, *snippet;
    int inputs, outputs;
    const char* glsl;                            ///< text that reads I(k) and writes O(k)
    void (*twin)(const In& in, const Out& out);  ///< the same text, compiled as C++
    void (*cpp)(const float* in, float* out);
    void (*domain)(float* in);  ///< moves any inputs into the documented domain
    /// Outputs may differ by `ulps` units in the last place of the largest number that goes into them, which is the
    /// output itself if `scale` is null. 0: bit for bit, but for the sign of zero.
    double ulps;
    float (*scale)(const float* in);
};

}  // namespace penumbra::test

// Two members of a Function from one text. Undefined at the end of functions.hpp, as what follows.
#define PENUMBRA_TEXT(...) #__VA_ARGS__
#define GLSL(...)                                                                               \
    PENUMBRA_TEXT(__VA_ARGS__), [](const penumbra::test::In& I, const penumbra::test::Out& O) { \
        using namespace glsl;                                                                   \
        static_cast<void>(I);                                                                   \
        __VA_ARGS__                                                                             \
    }

// What texts begin and end with.
#define V2(k) vec2(I(k), I(k + 1))
#define V3(k) vec3(I(k), I(k + 1), I(k + 2))
#define RECT(k) penumbra_rect2(V2(k), V2(k + 2))
#define BOX(k) penumbra_box3(V3(k), V3(k + 3))
#define FRAME penumbra_make_frame(V3(0), V3(3), V3(6), V3(9))
#define EXTENT(k)               \
    penumbra_LightExtent light; \
    light.half_size = V2(k);    \
    light.disk = I(k + 2) > 0.0f
#define CAMERA              \
    penumbra_SliceCamera c; \
    c.convergence = I(0);   \
    c.origin_tx = V2(1);    \
    c.scale_tx = V2(3)
#define RANGE              \
    penumbra_SliceRange r; \
    r.first = I(0);        \
    r.thickness = I(1);    \
    r.count = int(I(2))
#define PUT2(k, v) \
    O(k) = v.x;    \
    O(k + 1) = v.y
#define PUT3(k, v) \
    PUT2(k, v);    \
    O(k + 2) = v.z
#define PUT_RECT(k, r) \
    PUT2(k, r.min);    \
    PUT2(k + 2, r.max)
