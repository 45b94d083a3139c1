// What is drawn into maps of a line light, and how: casters and receivers before it, and the image around all shadows.
//
// The CPU draws these meshes; a GPU its own, by the passes shaders/penumbra/soft_shadow_map/light_map.vert and .frag.
#pragma once

#include <algorithm>
#include <limits>
#include <penumbra/detail/lit_casters.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// What comes of one caster: light space.
struct LightMapCaster {
    Mesh<double> mesh;  ///< what lies before the light's plane, welded
    bool solid;         ///< closed: what is inside of it is dark, and what is a little below its surface is not it
};

template <class T>
struct LightMapGeometry {
    static constexpr double widest = 16.0;  ///< slope of the image's borders, at most
    static constexpr int margin_tx = 4;     ///< steps are told by three texels on either side

    LightFrame<T> frame{};                ///< origin in the light's middle, first axis along it
    T half_length{};                      ///< of the light
    LightMapView<T> view;                 ///< empty if nothing casts a shadow
    double near = 0.0;                    ///< what lies at less depth is cut off
    double nearest = 0.0;                 ///< depth of the nearest caster; 0 for none
    double farthest = 0.0;                ///< and of the farthest
    std::vector<LightMapCaster> casters;  ///< as they were given
    std::vector<Mesh<double>> receivers;

    /// The least between two surfaces, world units: `chosen`, or 1/1000 of the farthest caster's depth for 0.
    T step(float chosen) const { return chosen > 0.0F ? static_cast<T>(chosen) : static_cast<T>(1e-3 * farthest); }
};

/// For valid meshes, in the frame of a light that reaches as far in both directions along its first axis. `receivers`
/// are seen but hide nothing.
template <class T>
LightMapGeometry<T> light_map_geometry(const std::vector<Mesh<T>>& casters, const std::vector<Mesh<T>>& receivers,
                                       const LightFrame<T>& frame, T half_length, int resolution) {
    LightMapGeometry<T> result;
    std::vector<Mesh<double>> meshes = detail::in_light_space(casters, frame);
    result.receivers = detail::in_light_space(receivers, frame);
    result.frame = frame, result.half_length = half_length;
    result.near = 1e-6 * std::max(detail::reach_of(meshes), detail::reach_of(result.receivers));
    for (Mesh<double>& mesh : meshes) mesh = detail::lit_part(mesh, result.near);
    for (Mesh<double>& mesh : result.receivers) mesh = detail::lit_part(mesh, result.near);
    const Rect2<double> slopes =
        detail::slopes_around(meshes, Vec2<double>(static_cast<double>(half_length), 0.0), LightMapGeometry<T>::widest,
                              resolution, LightMapGeometry<T>::margin_tx);
    result.view.slopes = {Vec2<T>(slopes.min), Vec2<T>(slopes.max)};
    result.view.resolution = resolution;
    double nearest = std::numeric_limits<double>::max();
    for (Mesh<double>& mesh : meshes) {
        for (const Vec3<double>& p : mesh.positions)
            nearest = std::min(nearest, p.z), result.farthest = std::max(result.farthest, p.z);
        const bool solid = is_closed(edge_adjacency(mesh));
        result.casters.push_back({std::move(mesh), solid});
    }
    if (result.farthest > 0.0) result.nearest = nearest;
    return result;
}

/// The same in the frame that faces the middle of all casters: the light is taken to emit into that half of space.
template <class T>
LightMapGeometry<T> light_map_geometry(const std::vector<Mesh<T>>& casters, const std::vector<Mesh<T>>& receivers,
                                       const LinearLight<T>& light, int resolution) {
    const Box3<T> box = bounds(casters);
    if (is_empty(box)) return {};
    const Vec3<T> half = light.b * T(0.5) - light.a * T(0.5), middle = light.a + half;
    const LightFrame<T> frame = light_frame(light, box.min * T(0.5) + box.max * T(0.5) - middle);
    return light_map_geometry(casters, receivers, frame, safe_length(half), resolution);
}

}  // namespace penumbra
