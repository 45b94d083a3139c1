// Soft shadows of a rectangle light from the silhouettes of casters.
//
// Build: bring casters to light space, index their edges. Query: project the silhouette edges that matter to a point
// onto the light, integrate what each object blocks, exactly, and combine the objects by the overlap rule. Source:
// V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006; with silhouettes from
// each point, and the exact area of all together.
#pragma once

#include <cstddef>
#include <penumbra/combine.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/penumbra_wedge/blending.hpp>
#include <penumbra/penumbra_wedge/caster_index.hpp>
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
    using Real = T;
    using Light = RectLight<T>;
    using Options = PenumbraWedgeOptions;

    /// Reports meshes, lights and options out of their domain by name. No casters: everything is visible. A light
    /// without size casts hard shadows, and looks towards the casters' centre if both its sides are zero.
    PenumbraWedgeShadow(const std::vector<Mesh<T>>& casters, const RectLight<T>& light, const Options& options = {})
        : options_(options) {
        if (!validate(options) || !validate(light) || !validate(casters)) return;
        const Box3<T> box = bounds(casters);
        if (is_empty(box)) return;
        const LightFrame<T> frame = light_frame(light, (box.min + box.max) * T(0.5) - light.center);
        casters_ = detail::CasterIndex<T>(casters, box, frame, half_size(light), options.silhouette);
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
        casters_.visibility(points, count, result, [&](const PointTile<T>& tile, bool may_give_up, T* occlusion) {
            return detail::blend(casters_.index(), tile, options_, may_give_up, occlusion);
        });
    }

    /// How visibility changes between points of a box in light space; unknown where more than `most` is in doubt from
    /// its middle to its corners, and by rules that are not right for casters which do not overlap. `points`, if not
    /// null, are all that are asked about, in world space and in the box: so tiles on a face are told from its other
    /// side.
    Variation<T> variation(const Box3<T>& box_ls, T most, const Vec3<T>* points = nullptr,
                           std::size_t count = 0) const {
        const OverlapRule rule = options_.overlap;
        if (rule != OverlapRule::exact && rule != OverlapRule::bitmask && rule != OverlapRule::additive)
            return Variation<T>::unknown();
        const Vec2<T> half = casters_.scaled_half_size() / casters_.scale();
        return casters_.variation(box_ls, {T(4) * half.x * half.y, false}, most,
                                  rule == OverlapRule::exact     ? detail::OverlapChange::outline
                                  : rule == OverlapRule::bitmask ? detail::OverlapChange::none
                                                                 : detail::OverlapChange::sum,
                                  points, count);
    }

    const Options& options() const { return options_; }
    const LightFrame<T>& frame() const { return casters_.frame(); }
    /// In the light's frame, times scale().
    const WedgeIndex<T>& index() const { return casters_.index(); }
    /// The half-extents of the light that the index takes, times scale().
    Vec2<T> scaled_half_size() const { return casters_.scaled_half_size(); }
    /// A power of two.
    T scale() const { return casters_.scale(); }
    /// Memory of the index.
    std::size_t bytes() const { return casters_.index().bytes(); }

  private:
    Options options_;
    detail::CasterIndex<T> casters_;
};

}  // namespace penumbra
