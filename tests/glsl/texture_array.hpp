// Texture arrays on the CPU, and the prefiltered slices of the C++ as the textures that twins read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <stdexcept>
#include <vector>

#include "support/random.hpp"

namespace penumbra::test {

/// Layers with their mip levels. Reads beyond it, which GLSL leaves undefined, throw.
template <class Texel>
struct TextureArray {
    struct Level {
        glm::ivec2 size;
        std::vector<Texel> texels;  ///< layer by layer, row by row
    };
    std::vector<Level> levels;
    int layers = 0;

    TextureArray(int width, int height, int layer_count, int level_count = 1) : layers(layer_count) {
        for (int l = 0; l < level_count; ++l) {
            const glm::ivec2 size(std::max(width >> l, 1), std::max(height >> l, 1));
            levels.push_back({size, std::vector<Texel>(static_cast<std::size_t>(size.x * size.y * layers), Texel(0))});
        }
    }
    Texel& at(glm::ivec3 where, int l) {
        Level& level = levels.at(static_cast<std::size_t>(l));
        if (where.x < 0 || where.y < 0 || where.z < 0 || where.x >= level.size.x || where.y >= level.size.y ||
            where.z >= layers)
            throw std::out_of_range("texelFetch beyond the texture");
        return level.texels[static_cast<std::size_t>((where.z * level.size.y + where.y) * level.size.x + where.x)];
    }
    const Texel& at(glm::ivec3 where, int l) const { return const_cast<TextureArray*>(this)->at(where, l); }
    /// Of one layer at a level.
    const Texel* layer(int z, int l) const {
        const Level& level = levels[static_cast<std::size_t>(l)];
        return level.texels.data() + z * level.size.x * level.size.y;
    }
};
using Values = TextureArray<glm::u8vec4>;
using Sums = TextureArray<glm::uvec4>;

using SliceImages = std::vector<Image<std::uint8_t>>;  ///< of one size, or empty

inline SliceImages random_slices(int width, int height, int count) {
    Random random(1);
    SliceImages slices;
    for (int s = 0; s < count; ++s) {
        slices.emplace_back(width, height);
        for (std::size_t i = 0; i < slices.back().size(); ++i)
            slices.back().data()[i] = static_cast<std::uint8_t>(random.whole(0, 255));
    }
    return slices;
}

inline int layers_of(const SliceImages& slices, int channels) {
    return (static_cast<int>(slices.size()) + channels - 1) / channels;
}

/// Calls write(layer, channel, slice) for every slice that holds anything, `channels` slices to a layer.
template <class Write>
void for_each_slice(const SliceImages& slices, int channels, Write&& write) {
    for (int s = 0; s < static_cast<int>(slices.size()); ++s)
        if (const auto& slice = slices[static_cast<std::size_t>(s)]; !slice.empty())
            write(s / channels, s % channels, slice);
}

inline void copy(const Image<std::uint8_t>& from, Values& to, int layer, int channel, int level) {
    for (int y = 0; y < from.height(); ++y)
        for (int x = 0; x < from.width(); ++x) to.at({x, y, layer}, level)[channel] = from(x, y);
}

inline Sums tables_of(const SliceImages& slices, int width, int height, int channels) {
    Sums texture(width + 1, height + 1, layers_of(slices, channels));
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        const SummedArea<std::uint32_t> table(slice);
        for (int y = 0; y <= height; ++y)
            for (int x = 0; x <= width; ++x) texture.at({x, y, layer}, 0)[channel] = table.data()[y * (width + 1) + x];
    });
    return texture;
}

inline Values n_buffers_of(const SliceImages& slices, int width, int height, int channels) {
    const int groups = layers_of(slices, channels);
    const int levels = NBuffer<std::uint8_t>(Image<std::uint8_t>(width, height)).levels();
    Values texture(width, height, levels * groups);
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        const NBuffer<std::uint8_t> buffer(slice);
        for (int l = 0; l < levels; ++l) copy(buffer.level(l), texture, l * groups + layer, channel, 0);
    });
    return texture;
}

/// Sides become powers of two.
inline Values mipmaps_of(const SliceImages& slices, int width, int height, int channels) {
    const int wide = 1 << penumbra::detail::ceil_log2(width), high = 1 << penumbra::detail::ceil_log2(height);
    const int levels = penumbra::detail::ceil_log2(std::max(width, height)) + 1;
    Values texture(wide, high, layers_of(slices, channels), levels);
    for_each_slice(slices, channels, [&](int layer, int channel, const auto& slice) {
        Image<std::uint8_t> padded(wide, high);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) padded(x, y) = slice(x, y);
        const MipMap<std::uint8_t> map(padded);
        for (int l = 0; l < levels; ++l) copy(map.level(l), texture, layer, channel, l);
    });
    return texture;
}

}  // namespace penumbra::test
