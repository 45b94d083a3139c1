// A D-buffer as textures, for the query in GLSL: shaders/penumbra/umbra_volume/d_buffer.glsl says what is where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <penumbra/detail/error.hpp>
#include <penumbra/image.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// Two textures of 32-bit floats, RGBA, without filtering.
struct DBufferTexels {
    static constexpr int width = 1024;  ///< of `edges`
    Image<glm::vec4> crossings, edges;
};

/// The second of them alone, for those who draw the first. Reports more than 2^22 edges, 16384 rows, and is empty then.
inline Image<glm::vec4> hiding_edge_texels(const std::vector<HidingEdge<float>>& edges) {
    if (!detail::require(edges.size() <= std::size_t(1) << 22,
                         [&] { return "a D-buffer of " + std::to_string(edges.size()) + " edges is above 4194304"; }))
        return {};
    const int count = static_cast<int>(edges.size()) * 4;
    Image<glm::vec4> result(DBufferTexels::width, count / DBufferTexels::width + 1);
    const auto number = [](std::uint32_t edge) {
        return edge == HidingEdge<float>::none ? -1.0F : static_cast<float>(edge);
    };
    for (int i = 0; i < count; i += 4) {
        const HidingEdge<float>& edge = edges[static_cast<std::size_t>(i / 4)];
        const int x = i % DBufferTexels::width, y = i / DBufferTexels::width;
        result(x, y) = glm::vec4(edge.a, static_cast<float>(edge.mesh));
        result(x + 1, y) = glm::vec4(edge.b, number(edge.chained));
        result(x + 2, y) = glm::vec4(number(edge.corner), number(edge.before), number(edge.after), 0.0F);
    }
    return result;
}

/// The texels of a D-buffer. PENUMBRA_UMBRA_VOLUME_LAYERS must be its number of layers; the query takes its view() and
/// radius() as well. Empty for an empty one, and for more edges than hiding_edge_texels takes.
inline DBufferTexels d_buffer_texels(const DBuffer<float>& d_buffer) {
    DBufferTexels result;
    if (d_buffer.empty()) return result;
    result.edges = hiding_edge_texels(d_buffer.edges());
    if (result.edges.empty()) return result;
    const int size = d_buffer.view().resolution, layers = d_buffer.layers();
    result.crossings = Image<glm::vec4>(size, 2 * layers * size);
    for (int layer = 0; layer < layers; ++layer)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const auto put = [&](const Crossing<float>& c, int row) {
                    result.crossings(x, y + row * size) =
                        glm::vec4(c.depth, c.silhouette_depth, static_cast<float>(c.edge), d_buffer.caster(x, y));
                };
                put(d_buffer.umbra(x, y, layer), 2 * layer);
                put(d_buffer.penumbra(x, y, layer), 2 * layer + 1);
            }
    return result;
}

}  // namespace penumbra
