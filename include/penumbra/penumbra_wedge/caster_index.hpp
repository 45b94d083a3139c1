// Casters as an area light sees them, and points asked about together: what shadows by edges have in common, whatever
// the light's shape.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/silhouette_variation.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>
#include <vector>

namespace penumbra::detail {

/// A WedgeIndex of casters in the light's frame, by a power of two brought to a size near 1. Queries are const,
/// allocate nothing, and may run from any number of threads.
template <class T>
class CasterIndex {
  public:
    CasterIndex() = default;
    /// Casters are valid and not empty; `box` is around them, `size` the half-extents of the light.
    CasterIndex(const std::vector<Mesh<T>>& casters, const Box3<T>& box, const LightFrame<T>& frame,
                const Vec2<T>& size, SilhouetteFrom from)
        : frame_(frame) {
        const Vec3<T> reach = farthest_of<T>({box.min - frame.origin, box.max - frame.origin});
        const T radius = std::max({largest_component(reach), size.x, size.y});
        scale_ = exp2_int<T>(exponent_to_unit(radius));
        // a light too small for T is as small as T can tell apart
        constexpr T epsilon = std::numeric_limits<T>::epsilon();
        const T unit = radius * scale_, least = T(64) * epsilon * unit;
        half_size_ = glm::max(size * scale_, Vec2<T>(least, least));
        const Vec3<T> far = farthest_of(box);
        const T tolerance = epsilon * (T(4) * unit + largest_component(far) * scale_);
        std::vector<LitMesh<T>> lit_meshes;
        lit_meshes.reserve(casters.size());
        for (const Mesh<T>& mesh : casters) lit_meshes.push_back(lit_mesh(mesh, frame_, scale_, tolerance));
        index_ = WedgeIndex<T>(lit_meshes, from, tolerance);
    }

    /// Fills in visibility from points in world space: 1 on or behind the light's plane, and for points that are not
    /// finite; elsewhere 1 less what blend(tile, may_give_up, occlusion) fills in, unless it gives up and returns
    /// false.
    template <class Blend>
    void visibility(const Vec3<T>* points, std::size_t count, T* result, const Blend& blend) const {
        std::fill(result, result + count, T(1));
        if (index_.empty()) return;
        std::array<AskedPoint<T>, PointTile<T>::capacity> asked;
        std::size_t n = 0;
        const auto shade_all = [&] {
            split_at_gaps(asked.data(), n, [&](auto* first, std::size_t size) { shade(first, size, result, blend); });
            n = 0;
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_finite(points[i])) continue;
            const Vec3<T> point_ls = to_scaled_light(frame_, points[i], scale_);
            if (!(point_ls.z > T(0)) || !is_finite(point_ls)) continue;
            asked[n++] = {point_ls, i};
            if (n == asked.size()) shade_all();
        }
        if (n > 0) shade_all();
    }

    /// How what casters hide of a light changes between points of a box in light space, world units; see
    /// silhouette_variation(). `points`, if not null, are those of the box that matter, in world space.
    Variation<T> variation(const Box3<T>& box_ls, LightOutline<T> light, T most, OverlapChange overlap,
                           const Vec3<T>* points, std::size_t count) const {
        if (index_.empty()) return Variation<T>::all_lit();
        light.area *= scale_ * scale_;
        constexpr T least =
            T(1024) * std::numeric_limits<T>::epsilon();  // of lights whose shadows are not all rounding
        if (!(half_size_.x > least && half_size_.y > least)) return Variation<T>::unknown();
        Variation<T> result =
            silhouette_variation(index_, {box_ls.min * scale_, box_ls.max * scale_},
                                 BoxPoints<T>(points, count, frame_, scale_), half_size_, light, most, overlap);
        result.along *= scale_, result.across *= scale_, result.deep *= scale_, result.slope *= scale_;
        return result;
    }

    const LightFrame<T>& frame() const { return frame_; }
    /// In the light's frame, times scale().
    const WedgeIndex<T>& index() const { return index_; }
    /// The half-extents of the light that the index takes, times scale().
    Vec2<T> scaled_half_size() const { return half_size_; }
    /// A power of two.
    T scale() const { return scale_; }

  private:
    /// Reorders the points.
    template <class Blend>
    void shade(AskedPoint<T>* points, std::size_t count, T* result, const Blend& blend) const {
        PointTile<T> tile;
        for (std::size_t i = 0; i < count; ++i) tile.push(points[i].point_ls);
        tile.finish(half_size_);
        std::array<T, PointTile<T>::capacity> occlusion;
        if (!blend(tile, count > 1, occlusion.data())) {
            const std::size_t half = halve(points, count);
            shade(points, half, result, blend);
            return shade(points + half, count - half, result, blend);
        }
        for (std::size_t i = 0; i < count; ++i) result[points[i].index] = T(1) - occlusion[i];
    }

    LightFrame<T> frame_{};
    Vec2<T> half_size_ = Vec2<T>(T(0), T(0));  // scaled
    T scale_ = T(1);
    WedgeIndex<T> index_;
};

}  // namespace penumbra::detail
