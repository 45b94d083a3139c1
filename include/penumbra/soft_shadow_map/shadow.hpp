// Soft shadows of a line light, from shadow maps of a few of its points.
#pragma once

#include <cstddef>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/soft_shadow_map/light_interval.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/light_map_geometry.hpp>
#include <penumbra/soft_shadow_map/light_map_maker.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>
#include <penumbra/soft_shadow_map/sample_placement.hpp>
#include <penumbra/soft_shadow_map/skin_maps.hpp>
#include <vector>

namespace penumbra {

/// Visibility of a line light past casters.
///
/// LinearMode::intervals unites what all surfaces in the maps hide from a point: right for any receiver, as far as the
/// maps see the casters' sides and their texels are small. LinearMode::skins is the paper: wrong where the hidden part
/// of the light between two maps is not one interval with an end in view. The light is taken to emit into the half of
/// space before it that the middle of all casters lies in: nothing behind casts a shadow or receives one. Casters
/// beyond slopes of 16, seen along the light, are left out. Source: W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow
/// maps for linear lights", 2000; intervals, transitions but the first, and where maps are needed are ours.
template <class T>
class SoftShadowMap {
  public:
    using Real = T;
    using Light = LinearLight<T>;
    using Options = SoftShadowMapOptions;

    /// Reports meshes, lights and options out of their domain by name. No casters: everything is visible. A light of no
    /// length: hard shadows. `receivers` hide nothing; what is known of them serves skins, whose transitions need it
    /// unless exact, and the choice of samples.
    SoftShadowMap(const std::vector<Mesh<T>>& casters, const LinearLight<T>& light, const Options& options = {},
                  const std::vector<Mesh<T>>& receivers = {})
        : options_(options) {
        if (!validate(options) || !validate(light) || !validate(casters) || !validate(receivers)) return;
        const detail::LightMapMaker<T> maker(light_map_geometry(casters, receivers, light, options.resolution));
        const LightMapGeometry<T>& geometry = maker.geometry();
        frame_ = geometry.frame;
        if (geometry.view.empty()) return;
        view_ = geometry.view;
        const T half_length = geometry.half_length, step = geometry.step(options.step);
        if (is_exact())
            segments_ =
                build(maker, half_length, step, [&](const Maps& maps) { return RowSegments<T>(view_, maps, step); });
        else
            maps_ = build(maker, half_length, step, [&](const Maps& maps) {
                return SkinMaps<T>(view_, maps, options_.mode, options_.transition, options_.detector, step);
            });
    }

    /// Fraction of the light's length that `point` (world space) sees, in [0, 1]. 1 for points on the plane through the
    /// light or behind it, and for points that are not finite.
    T visibility(const Vec3<T>& point) const {
        if (!is_finite(point) || view_.empty()) return T(1);
        const Vec3<T> point_ls = frame_.to_light(point);
        if (!(point_ls.z > T(0))) return T(1);
        switch (options_.mode) {
            case LinearMode::intervals:
                return segments_.template visibility<LightUnion<T>>(point_ls);
            case LinearMode::interval_mask:
                return segments_.template visibility<LightMask<T>>(point_ls);
            case LinearMode::hard:
            case LinearMode::skins:
                break;
        }
        return maps_.visibility(point_ls);
    }
    /// The same for `count` points.
    void visibility(const Vec3<T>* points, std::size_t count, T* result) const {
        for (std::size_t i = 0; i < count; ++i) result[i] = visibility(points[i]);
    }

    const Options& options() const { return options_; }
    const LightFrame<T>& frame() const { return frame_; }
    /// The texels of its maps; empty without casters.
    const LightMapView<T>& view() const { return view_; }
    /// How many maps were drawn of points on the light; 0 without casters.
    int samples() const { return samples_; }
    /// Empty unless options().mode is LinearMode::hard or skins.
    const SkinMaps<T>& maps() const { return maps_; }
    /// Empty unless options().mode is LinearMode::intervals or interval_mask.
    const RowSegments<T>& segments() const { return segments_; }
    std::size_t bytes() const { return maps_.bytes() + segments_.bytes(); }

  private:
    using Maps = std::vector<const LightMap<T>*>;

    bool is_exact() const {
        return options_.mode == LinearMode::intervals || options_.mode == LinearMode::interval_mask;
    }

    /// What `make` makes of maps, of more where they change what it answers.
    template <class Make>
    auto build(const detail::LightMapMaker<T>& maker, T half_length, T step, const Make& make) {
        std::vector<LightMap<T>> maps = even_maps(maker, half_length, options_.samples);
        if (options_.narrowest_gap && options_.most_samples > options_.samples) {
            T gap = LightMap<T>::none;
            for (const LightMap<T>& map : maps) gap = std::min(gap, narrowest_gap(view_, map, step));
            const int count = samples_for_gap(T(2) * half_length, gap, options_.most_samples);
            if (count > options_.samples) maps = even_maps(maker, half_length, count);
        }
        detail::refine_samples(maker, maps, options_.most_samples, static_cast<T>(options_.tolerance), make);
        Maps all;
        for (const LightMap<T>& map : maps) all.push_back(&map);
        samples_ = static_cast<int>(maps.size());
        return make(all);
    }
    static std::vector<LightMap<T>> even_maps(const detail::LightMapMaker<T>& maker, T half_length, int count) {
        std::vector<LightMap<T>> maps;
        for (int i = 0; i < count; ++i) maps.push_back(maker.make(even_position(half_length, i, count)));
        return maps;
    }

    Options options_;
    LightFrame<T> frame_{};
    LightMapView<T> view_;
    int samples_ = 0;
    SkinMaps<T> maps_;
    RowSegments<T> segments_;
};

}  // namespace penumbra
