// The settings of methods that the study measures.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../scenes/scene.hpp"

namespace penumbra::study {

using namespace scenes;

/// A method built for one scene: what is timed is `visibility`, over a whole batch on one thread.
struct Built {
    std::function<void(const Vec3<float>* points, std::size_t count, float* result)> visibility;
    std::size_t bytes = 0;
};

/// Visibility at all points, on all cores.
std::vector<float> ask(const Built& built, const std::vector<Vec3<float>>& points);

/// A setting to measure.
struct Setting {
    std::string method;
    nlohmann::ordered_json knobs;
    bool is_default = false;
    bool (*takes)(const Light&);               ///< is the method for such a light?
    std::function<Built(const Scene&)> build;  ///< for a scene whose light it takes
    std::string special;                       ///< why there is a picture of it in any case; empty if there need not be
};

/// What takes receivers is told of the ground. The scene's light is of the kind that `Shadow` is for.
template <class Shadow>
Shadow make_shadow(const Scene& scene, const typename Shadow::Options& options) {
    const auto& light = std::get<typename Shadow::Light>(scene.light);
    using Meshes = std::vector<Mesh<float>>;
    if constexpr (std::is_constructible_v<Shadow, Meshes, typename Shadow::Light, typename Shadow::Options, Meshes>)
        return Shadow(scene.casters, light, options, {scene.ground});
    else
        return Shadow(scene.casters, light, options);
}

/// The setting of `Shadow`, which is for lights of kind `For`, with the given options. What takes receivers is told of
/// the ground.
template <class Shadow, class For>
Setting make_setting(const std::string& method, const nlohmann::ordered_json& knobs, bool is_default,
                     const typename Shadow::Options& options) {
    return {method,
            knobs,
            is_default,
            [](const Light& light) { return std::holds_alternative<For>(light); },
            [options](const Scene& scene) {
                const auto shadow = std::make_shared<const Shadow>(make_shadow<Shadow>(scene, options));
                return Built{[shadow](const Vec3<float>* points, std::size_t count, float* result) {
                                 shadow->visibility(points, count, result);
                             },
                             shadow->bytes()};
            },
            ""};
}

/// Adds a setting, unless there is one with the same knobs.
void add_new(std::vector<Setting>& all, const Setting& one);

/// How many settings of a method.
enum class Sweep { none, one, few, all };

/// occlusion_texture, penumbra_wedge, umbra_volume, soft_shadow_map.
std::vector<std::string> method_names();

/// Settings of a method, the default first.
std::vector<Setting> settings_of(const std::string& method, Sweep sweep);

/// Settings of the methods that are wanted, of all if none is named, and that are for the scene's light. Methods that
/// are not named get few settings on scenes that are there to compare something else.
std::vector<Setting> settings_for(const Scene& scene, const std::vector<std::string>& wanted, bool quick);

/// OcclusionTextureShadow: slices, rules, filters and the rest, swept around the default.
std::vector<Setting> occlusion_texture_settings(Sweep sweep);

/// PenumbraWedgeShadow: every rule for overlap, with silhouettes from the light's centre and from each point.
std::vector<Setting> penumbra_wedge_settings(Sweep sweep);

/// UmbraVolumeShadow: sums over edges by every rule for overlap, and D-buffers around the paper's and the best.
std::vector<Setting> umbra_volume_settings(Sweep sweep);

/// SoftShadowMap: every mode by fixed numbers of samples, the paper's skins and better ones, and inserted samples.
std::vector<Setting> soft_shadow_map_settings(Sweep sweep);

/// Plain wedges, wedges as the paper blends them, and the default: what pictures and plots of its figures compare.
struct WedgeFigure {
    Setting plain, blended, ours;
};
WedgeFigure wedge_figure();

/// The default, the best of one and of two layers, and the latter with volumes from what the light's centre sees: what
/// costs are compared of, and where light, penumbra and umbra lie.
struct VolumeFigure {
    Setting edge_sum, one_layer, two_layers, from_light_center;
};
VolumeFigure volume_figure(int resolution = UmbraVolumeOptions().resolution);

/// The paper's skins between two samples, what pictures of its figures show; and plain shadow maps, skins with linear
/// and with exact transitions, and intervals of `samples` samples, what costs are compared of.
struct LineFigure {
    Setting paper, plain, linear, exact, intervals;
};
LineFigure line_figure(int samples = 2);

}  // namespace penumbra::study
