// The very text of the GLSL twins, compiled as C++ through GLM: for debuggers, for sanitizers, and for machines without
// a driver. Everything is in namespace glsl; whole queries with options of their own are in namespaces below it, see
// as_cpp_query.hpp.
//
// Not in namespace penumbra, whose `clamp` and `mix` would hide those of the language.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <penumbra/image.hpp>
#include <stdexcept>

#include "glsl/texture_array.hpp"

#define highp  // after all of GLM, which has an enumerator of that name

// What the language gives: a namespace of its own, so that arguments do not bring the snippets' functions with them.
namespace glsl_language {

using namespace glm;

/// As GLSL's samplers are: handles, cheap to pass by value.
struct sampler2DArray {
    const penumbra::test::Values* texture;
    float unit;  ///< 1 / 255 as in GLSL, or 1 to read whole numbers
};
struct usampler2DArray {
    const penumbra::test::Sums* texture;
};

struct sampler2D {
    const penumbra::Image<vec4>* texture;
    std::size_t* reads = nullptr;  ///< counts them, if it is there
};

inline vec4 texelFetch(sampler2D sampler, ivec2 at, int) {
    const auto& texture = *sampler.texture;
    if (sampler.reads != nullptr) ++*sampler.reads;
    if (at.x < 0 || at.y < 0 || at.x >= texture.width() || at.y >= texture.height())
        throw std::out_of_range("texelFetch beyond the texture");
    return texture(at.x, at.y);
}
inline vec4 texelFetch(sampler2DArray sampler, ivec3 at, int level) {
    return vec4(sampler.texture->at(at, level)) * sampler.unit;
}
inline uvec4 texelFetch(usampler2DArray sampler, ivec3 at, int level) { return sampler.texture->at(at, level); }
template <class Sampler>
ivec3 textureSize(Sampler sampler, int level) {
    const auto& texture = *sampler.texture;
    return ivec3(texture.levels.at(static_cast<std::size_t>(level)).size, texture.layers);
}

}  // namespace glsl_language

namespace glsl {

using namespace glsl_language;
#include "as_cpp_query.hpp"

}  // namespace glsl
