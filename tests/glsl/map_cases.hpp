// How the queries of soft shadow maps are compared with the C++.
#pragma once

#include <algorithm>
#include <penumbra/soft_shadow_map/light_map_texels.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <string>
#include <vector>

#include "glsl/scenes.hpp"
#include "soft_shadow_map/line_scenes.hpp"

namespace penumbra::test {

/// Under a light along x: boxes and bars of two heights that overlap as it sees them, and oblique to it.
inline std::vector<Mesh<float>> two_rows_of_bars() {
    std::vector<Mesh<float>> bars;
    for (int i = 0; i < 9; ++i) {
        const float x = static_cast<float>(i) * 0.5F - 2.0F;
        bars.push_back(quad_mesh<float>({x, 1.5F, 0.0F}, {0.1F, 0.02F, 0.0F}, {0.05F, 0.0F, 0.9F}));
        bars.push_back(box_mesh<float>({x * 0.6F + 0.1F, 2.4F, 0.2F}, {0.06F, 0.05F, 0.6F}));
    }
    return bars;
}

/// Scenes, and those with many casters in a row along the light.
inline std::vector<Scene> map_scenes() {
    std::vector<Scene> result = scenes();
    result.push_back({"ten quads", ten_quads<float>().casters, {1.0F, 0.0F}});
    result.push_back({"two blockers", two_blockers<float>().casters, {0.8F, 0.0F}});
    result.push_back({"two rows of bars", two_rows_of_bars(), {0.4F, 0.0F}});
    return result;
}

inline bool has_segments(const SoftShadowMapOptions& options) {
    return options.mode == LinearMode::intervals || options.mode == LinearMode::interval_mask;
}
inline bool has_edges(const SoftShadowMapOptions& options) {
    return options.mode == LinearMode::skins && options.transition == SkinTransition::exact;
}

/// What follows "#define ", for the GLSL.
inline std::vector<std::string> map_defines(const SoftShadowMapOptions& options) {
    const auto define = [](const char* name, bool value) {
        return std::string("PENUMBRA_SOFT_SHADOW_MAP_") + name + (value ? " 1" : " 0");
    };
    if (has_segments(options)) return {define("MASK", options.mode == LinearMode::interval_mask)};
    return {define("HARD", options.mode == LinearMode::hard), define("EDGES", has_edges(options))};
}
inline std::string map_name(const SoftShadowMapOptions& options) {
    constexpr const char* modes[] = {"hard", "skins", "intervals", "interval mask"};
    constexpr const char* transitions[] = {", linear", ", rational", ", exact"};
    return modes[static_cast<int>(options.mode)] +
           std::string(options.mode == LinearMode::skins ? transitions[static_cast<int>(options.transition)] : "");
}

/// The mode, the transition of skins, how many maps, and their resolution.
inline SoftShadowMapOptions map_options(LinearMode mode, SkinTransition transition, int samples, int resolution) {
    SoftShadowMapOptions options;
    options.mode = mode, options.transition = transition;
    options.samples = samples, options.most_samples = 0;
    options.resolution = resolution;
    return options;
}

/// Every query with each of its options.
inline std::vector<SoftShadowMapOptions> all_map_modes(int samples, int resolution) {
    return {map_options(LinearMode::hard, SkinTransition::exact, samples, resolution),
            map_options(LinearMode::skins, SkinTransition::linear, samples, resolution),
            map_options(LinearMode::skins, SkinTransition::exact, samples, resolution),
            map_options(LinearMode::intervals, SkinTransition::exact, samples, resolution),
            map_options(LinearMode::interval_mask, SkinTransition::exact, samples, resolution)};
}

/// A shadow of a scene over a floor, points in it, and what they see by the C++.
struct MapCase {
    SoftShadowMap<float> shadow;
    SkinMapTexels maps;
    RowSegmentTexels segments;
    std::vector<Vec3<float>> points_ls;
    std::vector<float> truth;

    MapCase(const Scene& scene, const SoftShadowMapOptions& options, int count)
        : shadow(scene.casters, {{-scene.light.x, 4, 0}, {scene.light.x, 4, 0}}, options, {line_scene_floor<float>()}),
          maps(skin_map_texels(shadow.maps())),
          segments(row_segment_texels(shadow.segments())) {
        for (const Vec3<float>& point : points_in(scene, count)) {
            points_ls.push_back(shadow.frame().to_light(point));
            truth.push_back(shadow.visibility(point));
        }
    }

    /// Of whichever query the mode has.
    const LightMapView<float>& view() const {
        return has_segments(shadow.options()) ? shadow.segments().view() : shadow.maps().view();
    }
    int penumbrae() const {
        return static_cast<int>(
            std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0F && v < 1.0F; }));
    }
};

}  // namespace penumbra::test
