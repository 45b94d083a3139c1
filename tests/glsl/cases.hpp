// Boxes and scenes by which twins that read textures are compared with the C++.
#pragma once

#include <cmath>
#include <limits>
#include <penumbra/occlusion_texture/shadow.hpp>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "glsl/texture_array.hpp"
#include "support/box_mesh.hpp"

namespace penumbra::test {

/// Inside, across borders, beyond them, without size, inside out, endless, at whole positions and a few ULP from them;
/// of the last of each 128, some are not numbers.
inline std::vector<Rect2<float>> boxes(int width, int height, int count) {
    Random random(2);
    std::vector<Rect2<float>> result;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    for (int i = 0; i < count; ++i) {
        Vec2<float> at, size;
        at.x = random.in(-0.2F * w, 1.2F * w), at.y = random.in(-0.2F * h, 1.2F * h);
        size.x = w * std::exp2(random.in(-9.0F, 0.5F)), size.y = h * std::exp2(random.in(-9.0F, 0.5F));
        if (i % 4 == 1) at = glm::floor(at), size = glm::ceil(size);
        if (i % 4 == 2) size = Vec2<float>(std::ldexp(1.0F, random.whole(0, 6)));
        if (i % 16 == 1) at *= 1.0F - 0x1p-23F, size *= 1.0F + 0x1p-23F;
        if (i % 16 == 5) at.x = random.whole(0, 1) == 0 ? -1e-8F : w * (1.0F - 0x1p-24F), size.x = 1e-8F;  // at borders
        if (i % 16 == 3) size.x = 0.0F;
        if (i % 32 == 11) size = -size;
        if (i % 64 == 7) at.x = -1e30F, size.x = 2e30F;
        if (i % 128 == 126) at.y = std::numeric_limits<float>::quiet_NaN();
        if (i % 128 == 127) size.y = std::numeric_limits<float>::infinity();
        result.push_back({at, at + size});
    }
    return result;
}

/// Boxes and slabs below a light, points in and around their shadows, and the visibility by the C++.
struct QueryCase {
    RectLight<float> light{{0, 8, 0}, {1.5F, 0, 0}, {0, 0, 1}};
    OcclusionTextureOptions options;
    int channels;  ///< slices to a layer
    OcclusionTextureShadow<float> shadow;
    std::vector<Vec3<float>> points_ls;
    std::vector<float> truth;
    std::variant<Values, Sums> masks, depths;

    QueryCase(const OcclusionTextureOptions& chosen, int slices_a_layer, int count)
        : options(chosen),
          channels(slices_a_layer),
          shadow(casters(), light, options),
          masks(Values(1, 1, 1)),
          depths(Values(1, 1, 1)) {
        const LightFrame<float> frame = light_frame(light);
        const auto slices = capture_slices(lit_triangles(casters(), frame, options.faces), shadow.camera(),
                                           shadow.range(), options.blend.close_leaks);
        masks = texture_of(slices.masks), depths = texture_of(slices.depths);

        Random random(3);
        std::vector<Vec3<float>> points;
        for (int i = 0; i < count; ++i) {
            const float x = random.in(-3.0F, 3.0F), y = i % 2 == 0 ? 0.0F : random.in(-0.5F, 9.0F);
            points.emplace_back(x, y, random.in(-3.0F, 3.0F));
            points_ls.push_back(frame.to_light(points.back()));
        }
        truth.resize(points.size());
        shadow.visibility(points.data(), points.size(), truth.data());
    }

    bool sums() const { return options.filter == SliceFilter::summed_area; }
    /// Mip levels.
    int levels() const {
        return std::visit([](const auto& texture) { return static_cast<int>(texture.levels.size()); }, masks);
    }
    /// What follows "#define ", for the GLSL.
    std::vector<std::string> defines() const {
        const auto define = [](const char* name, auto value) {
            return std::string("PENUMBRA_OCCLUSION_TEXTURE_") + name + " " + std::to_string(value);
        };
        return {define("FILTER", static_cast<int>(options.filter)),
                define("COMBINATION", static_cast<int>(options.blend.combination)),
                define("CHANNELS", channels),
                define("CELLS", options.light_cells),
                define("PLANE", static_cast<int>(options.plane)),
                define("SELF_SHADOW", static_cast<int>(options.self_shadow)),
                define("BIAS", options.self_shadow_bias)};
    }
    int penumbrae() const {
        return static_cast<int>(
            std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0F && v < 1.0F; }));
    }

  private:
    static std::vector<Mesh<float>> casters() {
        return {box_mesh<float>({0.3F, 3.0F, -0.2F}, {1, 1, 1}),
                box_mesh<float>({-1.4F, 2.0F, 0.8F}, {0.4F, 1.1F, 0.5F}),
                box_mesh<float>({1.2F, 1.0F, 1.1F}, {0.3F, 0.2F, 0.9F}),
                {{{-2, 1, -2}, {2, 2, -2}, {2, 2, -1}, {-2, 1, -1}}, {{0, 1, 2}, {0, 2, 3}}},
                {{{-1, 7.6F, 0.5F}, {0, 7.6F, 0.5F}, {0, 7.6F, 1.0F}, {-1, 7.6F, 1.0F}}, {{0, 1, 2}, {0, 2, 3}}}};
    }
    std::variant<Values, Sums> texture_of(const SliceImages& slices) const {
        const int w = shadow.camera().width, h = shadow.camera().height;
        if (sums()) return tables_of(slices, w, h, channels);
        if (options.filter == SliceFilter::n_buffer) return n_buffers_of(slices, w, h, channels);
        return mipmaps_of(slices, w, h, channels);
    }
};

}  // namespace penumbra::test
