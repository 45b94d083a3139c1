// Soft shadows of a rectangle light from the silhouettes of casters.
//
// Build: bring casters to light space, index their edges. Query: project the silhouette edges that matter to a point
// onto the light, integrate what each object blocks, exactly, and combine the objects by the overlap rule. Source:
// V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006; with silhouettes from
// each point, and bit masks, exact but for where three cells of a mask would tell more than one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <penumbra/combine.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/penumbra_wedge/blending.hpp>
#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>
#include <vector>

namespace penumbra {

/// Visibility of a rectangle light. Building takes O(n log n) for n triangles; a query grows with the silhouettes near
/// the pyramid from the point to the light, and with log n. Queries are const, allocate nothing, and may run from any
/// number of threads.
///
/// Closed, consistently wound casters are solid; others are sheets. Faces whose plane passes within
///     ε (4 R + W),   R = how far casters reach from the light's centre along an axis, W = their largest coordinate,
/// of a point hide nothing from it, so that points may lie on casters.
template <class T>
class PenumbraWedgeShadow {
  public:
    using Options = PenumbraWedgeOptions;

    /// Reports meshes, lights and options out of their domain by name. No casters: everything is visible. A light
    /// without size casts hard shadows, and looks towards the casters' centre if both its sides are zero.
    PenumbraWedgeShadow(const std::vector<Mesh<T>>& casters, const RectLight<T>& light, const Options& options = {})
        : options_(options) {
        if (!validate(options) || !validate(light) || !validate(casters)) return;
        const Box3<T> box = bounds(casters);
        if (is_empty(box)) return;
        frame_ = light_frame(light, (box.min + box.max) * T(0.5) - light.center);
        const Vec2<T> size = half_size(light);
        const Vec3<T> reach = glm::max(glm::abs(box.min - light.center), glm::abs(box.max - light.center));
        const T radius = std::max({detail::largest_component(reach), size.x, size.y});
        scale_ = exp2_int<T>(detail::exponent_to_unit(radius));
        // a light too small for T is as small as T can tell apart
        constexpr T epsilon = std::numeric_limits<T>::epsilon();
        const T unit = radius * scale_, least = T(64) * epsilon * unit;
        half_size_ = glm::max(size * scale_, Vec2<T>(least, least));
        const Vec3<T> far = glm::max(glm::abs(box.min), glm::abs(box.max));
        const T tolerance = epsilon * (T(4) * unit + detail::largest_component(far) * scale_);
        std::vector<detail::LitMesh<T>> lit_meshes;
        lit_meshes.reserve(casters.size());
        for (const Mesh<T>& mesh : casters) lit_meshes.push_back(detail::lit_mesh(mesh, frame_, scale_, tolerance));
        index_ = WedgeIndex<T>(lit_meshes, options.silhouette, tolerance);
    }

    /// Fraction of the light's area that `point` (world space) sees, in [0, 1]. 1 for points on or behind the
    /// light's plane, and for points that are not finite.
    T visibility(const Vec3<T>& point) const {
        T result;
        visibility(&point, 1, &result);
        return result;
    }

    /// The same for `count` points; faster, the more so if neighbours in the array are neighbours in space.
    void visibility(const Vec3<T>* points, std::size_t count, T* result) const {
        std::fill(result, result + count, T(1));
        if (index_.empty()) return;
        std::array<detail::AskedPoint<T>, PointTile<T>::capacity> asked;
        std::size_t n = 0;
        const auto shade_all = [&] {
            detail::split_at_gaps(asked.data(), n, [&](auto* first, std::size_t size) { shade(first, size, result); });
            n = 0;
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_finite(points[i])) continue;
            const Vec3<T> point_ls = detail::to_scaled_light(frame_, points[i], scale_);
            if (!(point_ls.z > T(0)) || !is_finite(point_ls)) continue;
            asked[n++] = {point_ls, i};
            if (n == asked.size()) shade_all();
        }
        if (n > 0) shade_all();
    }

    const Options& options() const { return options_; }
    const LightFrame<T>& frame() const { return frame_; }
    /// In the light's frame, times scale().
    const WedgeIndex<T>& index() const { return index_; }
    /// The half-extents of the light that the index takes, times scale().
    Vec2<T> scaled_half_size() const { return half_size_; }
    /// A power of two.
    T scale() const { return scale_; }
    /// Memory of the index.
    std::size_t bytes() const { return index_.bytes(); }

  private:
    /// Reorders the points.
    void shade(detail::AskedPoint<T>* points, std::size_t count, T* result) const {
        PointTile<T> tile;
        for (std::size_t i = 0; i < count; ++i) tile.push(points[i].point_ls);
        tile.finish(half_size_);
        std::array<T, PointTile<T>::capacity> occlusion;
        if (!detail::blend(index_, tile, options_, count > 1, occlusion.data())) {
            const std::size_t half = detail::halve(points, count);
            shade(points, half, result);
            return shade(points + half, count - half, result);
        }
        for (std::size_t i = 0; i < count; ++i) result[points[i].index] = T(1) - occlusion[i];
    }

    Options options_;
    LightFrame<T> frame_{};
    Vec2<T> half_size_ = Vec2<T>(T(0), T(0));  // scaled
    T scale_ = T(1);                           // a power of two that brings the scene to a size near 1
    WedgeIndex<T> index_;
};

}  // namespace penumbra
