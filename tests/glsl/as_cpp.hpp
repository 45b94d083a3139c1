// The very text of the GLSL twins, compiled as C++ through GLM: for debuggers, for sanitizers, and for machines without
// a driver. Everything is in namespace glsl; whole queries with options of their own are in namespaces below it, see
// as_cpp_query.hpp.
//
// Not in namespace penumbra, whose `clamp` and `mix` would hide those of the language.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <vector>

#define highp  // after all of GLM, which has an enumerator of that name

// What the language gives: a namespace of its own, so that arguments do not bring the snippets' functions with them.
namespace glsl_language {

using namespace glm;

/// A texture array with its mip levels. Reads beyond it, which GLSL leaves undefined, throw.
template <class Texel>
struct TextureArray {
    struct Level {
        ivec2 size;
        std::vector<Texel> texels;  ///< layer by layer, row by row
    };
    std::vector<Level> levels;
    int layers = 0;

    TextureArray(int width, int height, int layer_count, int level_count = 1) : layers(layer_count) {
        for (int l = 0; l < level_count; ++l) {
            const ivec2 size(std::max(width >> l, 1), std::max(height >> l, 1));
            levels.push_back({size, std::vector<Texel>(static_cast<std::size_t>(size.x * size.y * layers), Texel(0))});
        }
    }
    Texel& at(ivec3 where, int l) {
        Level& level = levels.at(static_cast<std::size_t>(l));
        if (where.x < 0 || where.y < 0 || where.z < 0 || where.x >= level.size.x || where.y >= level.size.y ||
            where.z >= layers)
            throw std::out_of_range("texelFetch beyond the texture");
        return level.texels[static_cast<std::size_t>((where.z * level.size.y + where.y) * level.size.x + where.x)];
    }
    const Texel& at(ivec3 where, int l) const { return const_cast<TextureArray*>(this)->at(where, l); }
};

/// As GLSL's samplers are: handles, cheap to pass by value.
template <class Texel>
struct Sampler {
    const TextureArray<Texel>* texture;
};
using sampler2DArray = Sampler<vec4>;
using usampler2DArray = Sampler<uvec4>;

template <class Texel>
Texel texelFetch(Sampler<Texel> sampler, ivec3 at, int level) {
    return sampler.texture->at(at, level);
}
template <class Texel>
ivec3 textureSize(Sampler<Texel> sampler, int level) {
    return ivec3(sampler.texture->levels.at(static_cast<std::size_t>(level)).size, sampler.texture->layers);
}

}  // namespace glsl_language

namespace glsl {

using namespace glsl_language;
#include "as_cpp_query.hpp"

}  // namespace glsl
