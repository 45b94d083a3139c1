// Soft shadows of a disk light: by umbra and penumbra volumes, or exactly, by the edges that a point sees.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/edge_sum.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <vector>

namespace penumbra {

/// Visibility of a disk light past casters.
///
/// DiskMode::edge_sum is exact for what one mesh hides: see edge_sum.hpp. DiskMode::d_buffer takes one edge for the
/// silhouette, or two: exact for a long straight edge, boundaries of umbra and penumbra within a texel; for casters
/// smaller than the light as seen from the point, edges that are not looked up are missing.
/// Source: the umbra and penumbra volume paper for circular lights.
template <class T>
class UmbraVolumeShadow {
  public:
    using Real = T;
    using Light = DiskLight<T>;
    using Options = UmbraVolumeOptions;

    /// Reports meshes, lights and options out of their domain by name. No casters: everything is visible. Radius 0:
    /// hard shadows.
    UmbraVolumeShadow(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light, const Options& options = {})
        : options_(options) {
        if (!validate(options) || !validate(light) || !validate(casters)) return;
        if (is_empty(bounds(casters))) return;
        frame_ = light_frame(light);
        if (options.mode == DiskMode::edge_sum)
            edge_sum_ = detail::DiskEdgeSum<T>(casters, light, options), radius_ = light.radius;
        else
            d_buffer_ = DBuffer<T>(casters, frame_, light.radius, options.resolution, options.layers,
                                   options.silhouette, options.depth);
    }

    /// Fraction of the light's area that `point` (world space) sees, in [0, 1]. 1 for points on or behind the light's
    /// plane, and for points that are not finite.
    T visibility(const Vec3<T>& point) const {
        T result;
        visibility(&point, 1, &result);
        return result;
    }
    /// The same for `count` points; for sums over edges faster, the more so if neighbours in the array are neighbours
    /// in space.
    void visibility(const Vec3<T>* points, std::size_t count, T* result) const {
        if (options_.mode == DiskMode::edge_sum) return edge_sum_.visibility(points, count, result);
        for (std::size_t i = 0; i < count; ++i)
            result[i] = is_finite(points[i])
                            ? d_buffer_.visibility(frame_.to_light(points[i]), options_.visibility, options_.share)
                            : T(1);
    }

    /// How much visibility can change between points of a box in light space; unknown where it is more than `most`, and
    /// for D-buffers, whose answers change from texel to texel.
    Variation<T> variation(const Box3<T>& box_ls, T most, const Vec3<T>* points = nullptr,
                           std::size_t count = 0) const {
        const bool is_exact = options_.mode == DiskMode::edge_sum && options_.overlap != DiskOverlap::maximum &&
                              options_.overlap != DiskOverlap::product;
        return is_exact ? edge_sum_.variation(box_ls, radius_, most, points, count) : Variation<T>::unknown();
    }

    const Options& options() const { return options_; }
    const LightFrame<T>& frame() const { return frame_; }
    /// Empty unless options().mode is DiskMode::d_buffer.
    const DBuffer<T>& d_buffer() const { return d_buffer_; }
    std::size_t bytes() const { return edge_sum_.bytes() + d_buffer_.bytes(); }

  private:
    Options options_;
    LightFrame<T> frame_{};
    T radius_ = T(0);
    detail::DiskEdgeSum<T> edge_sum_;
    DBuffer<T> d_buffer_;
};

}  // namespace penumbra
