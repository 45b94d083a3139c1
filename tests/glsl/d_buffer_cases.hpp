// How the query of D-buffers is compared with the C++.
#pragma once

#include <algorithm>
#include <penumbra/light.hpp>
#include <penumbra/umbra_volume/d_buffer_texels.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <string>
#include <vector>

#include "glsl/scenes.hpp"

namespace penumbra::test {

/// Scenes, and those that have edges on both sides of a point's view, or under a light that looms over them.
inline std::vector<Scene> d_buffer_scenes() {
    std::vector<Scene> result = scenes();
    result.push_back({"a strip",
                      {{{{-0.2F, 2, -3}, {0.2F, 2, -3}, {0.2F, 2, 3}, {-0.2F, 2, 3}}, {{0, 2, 1}, {0, 3, 2}}}},
                      {0.6F, 0.6F}});
    result.push_back({"smaller than the light",
                      {box_mesh<float>({0.2F, 1.5F, -0.1F}, {0.3F, 0.3F, 0.2F}),
                       {{{-1, 1, 1}, {-0.6F, 1.4F, 1}, {-0.8F, 1.2F, 0.5F}}, {{0, 1, 2}}}},
                      {1.5F, 1.5F}});
    return result;
}

/// What follows "#define ", for the GLSL.
inline std::vector<std::string> d_buffer_defines(const UmbraVolumeOptions& options) {
    const auto define = [](const char* name, int value) {
        return std::string("PENUMBRA_UMBRA_VOLUME_") + name + " " + std::to_string(value);
    };
    return {define("LAYERS", options.layers), define("VISIBILITY", static_cast<int>(options.visibility)),
            define("SHARE", static_cast<int>(options.share)), define("DEPTH", static_cast<int>(options.depth))};
}
inline std::string d_buffer_name(const UmbraVolumeOptions& options) {
    constexpr const char* forms[] = {"exact", "cubic", "square root"};
    return std::to_string(options.layers) + (options.layers > 1 ? " layers, " : " layer, ") +
           forms[static_cast<int>(options.visibility)] + (options.share == CutShare::edge ? "" : ", from depths") +
           (options.depth == DBufferDepth::light_plane ? "" : ", euclidean");
}

/// A D-buffer of a scene, points in it, and what they see by the C++.
struct DBufferCase {
    DBuffer<float> d_buffer;
    DBufferTexels texels;
    std::vector<Vec3<float>> points_ls;
    std::vector<float> truth;

    DBufferCase(const Scene& scene, const UmbraVolumeOptions& options, int count) {
        const LightFrame<float> frame = light_frame(DiskLight<float>{{0, 4, 0}, {0, -1, 0}, scene.light.x});
        d_buffer = DBuffer<float>(scene.casters, frame, scene.light.x, options.resolution, options.layers,
                                  options.silhouette, options.depth);
        texels = d_buffer_texels(d_buffer);
        for (const Vec3<float>& point : points_in(scene, count)) {
            points_ls.push_back(frame.to_light(point));
            truth.push_back(d_buffer.visibility(points_ls.back(), options.visibility, options.share));
        }
    }

    int penumbrae() const {
        return static_cast<int>(
            std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0F && v < 1.0F; }));
    }
};

}  // namespace penumbra::test
