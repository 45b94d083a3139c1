// Soft shadow maps as textures, for the queries in GLSL: shaders/penumbra/soft_shadow_map/skin_maps.glsl and
// row_segments.glsl say what is where.
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <penumbra/detail/error.hpp>
#include <penumbra/image.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>
#include <penumbra/soft_shadow_map/skin_maps.hpp>
#include <string>

namespace penumbra {

/// Two textures of 32-bit floats, RGBA, without filtering; `edges` is empty unless transitions are exact.
struct SkinMapTexels {
    Image<glm::vec4> maps, edges;
};

/// The texels of maps and channels. Empty for empty ones. Reports more than 16384 rows of all maps.
inline SkinMapTexels skin_map_texels(const SkinMaps<float>& maps) {
    SkinMapTexels result;
    const int size = maps.view().resolution, rows = size * maps.count();
    if (maps.count() == 0 || !detail::require(rows <= 16384, [&] {
            return std::to_string(maps.count()) + " maps of resolution " + std::to_string(size) +
                   " have more than 16384 rows";
        }))
        return result;
    result.maps = Image<glm::vec4>(size, rows);
    if (maps.has_edges()) result.edges = Image<glm::vec4>(size, rows);
    for (int map = 0; map < maps.count(); ++map)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const LightMapTexel<float>& texel = maps.texels(map)(x, y);
                result.maps(x, y + map * size) = glm::vec4(texel.depth, texel.before, texel.after, maps.position(map));
                if (!maps.has_edges()) continue;
                const LightMapEdges<float>& edges = maps.edges(map)(x, y);
                result.edges(x, y + map * size) = glm::vec4(edges.before.slope, edges.before.inverse_depth,
                                                            edges.after.slope, edges.after.inverse_depth);
            }
    return result;
}

/// A texture of 32-bit floats, RGBA, without filtering.
struct RowSegmentTexels {
    static constexpr int width = 1024;
    Image<glm::vec4> segments;
};

/// The texels of segments. Empty for empty ones. Reports more than 2^24 texels.
inline RowSegmentTexels row_segment_texels(const RowSegments<float>& rows) {
    RowSegmentTexels result;
    const std::size_t first = static_cast<std::size_t>(rows.view().resolution);
    const std::size_t count = first + rows.segments().size();
    if (first == 0 || !detail::require(count <= std::size_t(1) << 24, [&] {
            return std::to_string(rows.segments().size()) + " segments are above 16777216";
        }))
        return result;
    constexpr std::size_t width = RowSegmentTexels::width;
    result.segments = Image<glm::vec4>(RowSegmentTexels::width, static_cast<int>((count + width - 1) / width));
    glm::vec4* const texels = result.segments.data();
    for (std::size_t y = 0; y < first; ++y)
        texels[y] = glm::vec4(static_cast<float>(first + rows.starts()[y]),
                              static_cast<float>(first + rows.starts()[y + 1]), 0.0F, 0.0F);
    for (std::size_t i = 0; i < rows.segments().size(); ++i) {
        const RowSegment<float>& segment = rows.segments()[i];
        texels[first + i] =
            glm::vec4(segment.a.slope, segment.a.inverse_depth, segment.b.slope, segment.b.inverse_depth);
    }
    return result;
}

}  // namespace penumbra
