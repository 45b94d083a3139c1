// What occlusion textures may leave out: slices that hold nothing of their own, copies of surfaces, depths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/plan/candidate_search.hpp>
#include <vector>

namespace penumbra::detail {

/// The slices that casters fall into, for `count` of them over the same depths.
template <class T>
class SliceLayout {
  public:
    SliceLayout(const SceneExtents<T>& extents, int count) : range_{T(0), T(0), count} {
        T nearest = std::numeric_limits<T>::max(), farthest = T(0);
        for (const Box3<T>& c : extents.casters) {
            if (is_empty(c) || !(c.max.z > T(0))) continue;
            nearest = std::min(nearest, std::max(c.min.z, T(0))), farthest = std::max(farthest, c.max.z);
        }
        if (!(farthest > T(0))) return;
        const T slices = static_cast<T>(count), length = std::max(farthest - nearest, farthest * T(1e-5) * slices);
        const T lead = length * T(1.0 / 4096.0);
        range_ = {nearest - lead, (length + lead) / slices, count};
    }
    /// The slice that holds all of a caster, with room for what rounding does to either; −1 if none surely does.
    int slice_of(const Box3<T>& caster) const {
        const T room = range_.thickness * T(0.02);
        const int first = range_.slice_of(caster.min.z - room), last = range_.slice_of(caster.max.z + room);
        return first == last ? first : -1;
    }
    const SliceRange<T>& range() const { return range_; }
    T plane(int slice, SlicePlane plane) const {
        return range_.top(slice) + range_.thickness * (plane == SlicePlane::middle ? T(0.5) : T(1));
    }
    /// From which depth on no slice holds a point, by any rule for those that do.
    T passed_depth() const { return range_.bottom(range_.count - 1) + T(2) * range_.thickness; }

  private:
    SliceRange<T> range_;
};

/// Occlusion textures, in a scene.
template <class T>
class SliceCandidates {
  public:
    SliceCandidates(const OcclusionTextureOptions& full, CandidateSearch<T>& search)
        : full_(full), search_(search), extents_(search.extents), fine_(extents_, full.slices) {
        for (const Box3<T>& r : extents_.receivers)
            if (r.max.z > T(0)) nearest_ = std::min(nearest_, std::max(r.min.z, T(0)));
    }

    /// A point behind all slices asks for no depths.
    void find_self_shadow() {
        const T behind = nearest_ - fine_.passed_depth();
        if (behind >= T(0))
            search_.add(Effect::self_shadow, T(0), "receivers lie at least %s behind what a slice may hold", behind);
        else
            search_.add_of_images(Effect::self_shadow);
    }
    /// If all casters lie in one slice, a copy in the next is the same on another plane; in the last there is none.
    void find_leak_closing() {
        const int layer = only_layer(fine_);
        const bool has_copy = layer + 1 < full_.slices;
        if (layer >= 0)
            search_.add(Effect::leak_closing, has_copy ? moved_loss(plane(layer), plane(layer + 1)) : T(0),
                        "all casters lie in slice %s", static_cast<T>(layer));
        else
            search_.add_of_images(Effect::leak_closing);
    }
    /// Fewer slices change nothing but the planes that casters are projected on, if each lies in one slice and those of
    /// different slices stay in different ones: the fewest of which that holds within the budget.
    void find_slices() {
        for (int count = 1; count < full_.slices; ++count) {
            const SliceLayout<T> coarse(extents_, count);
            const T loss = nearest_ >= coarse.passed_depth() ? loss_of(coarse) : T(1);
            if (loss > search_.budget) continue;
            search_.add(Effect::slices, loss, "%s hold all layers of casters, each in its own", static_cast<T>(count));
            search_.found.back().has_own_budget = true;
            return;
        }
        search_.add(Effect::slices, T(1), "casters reach through slices: none of %s can be spared",
                    static_cast<T>(full_.slices));
    }

  private:
    T plane(int slice) const { return fine_.plane(slice, full_.plane); }

    int only_layer(const SliceLayout<T>& layout) const {
        int layer = -1;
        for (std::size_t i = 0; i < extents_.casters.size(); ++i) {
            const int slice = layout.slice_of(extents_.casters[i]);
            if (slice < 0 || (i > 0 && slice != layer)) return -1;
            layer = slice;
        }
        return layer;
    }

    /// The change of a mean over a part of the kernel, on a plane that moves from depth `a` to depth `b`. Filters that
    /// are not exact jump.
    T moved_loss(T a, T b) const {
        if (full_.filter != SliceFilter::summed_area) return a < b || a > b ? T(1) : T(0);
        const T cells = static_cast<T>(full_.light_cells);
        T worst = T(0);
        for (const Box3<T>& r : extents_.receivers) {
            const T moved = std::abs(b - a) / r.min.z, most = std::max(a, b) / r.min.z;
            if (!(r.min.z > T(0)) || !(most < T(1))) return T(1);
            T loss = T(0);
            for (int k = 0; k < 2; ++k) {
                const T h = extents_.light.half_size[k];
                const T out = std::max(std::abs(r.min[k]), std::abs(r.max[k])) + h;
                loss += saturated_ratio((out * cells + T(2) * h) * moved, T(2) * h * (T(1) - most));
            }
            worst = std::max(worst, saturate(loss));
        }
        return worst;
    }
    T loss_of(const SliceLayout<T>& coarse) const {
        if (full_.blend.close_leaks) {  // copies would meet other layers
            const int before = only_layer(fine_), after = only_layer(coarse);
            if (before < 0 || after < 0) return T(1);
            T loss = T(0);
            for (int i = before; i <= std::min(before + 1, full_.slices - 1); ++i)
                for (int j = after; j <= std::min(after + 1, coarse.range().count - 1); ++j)
                    loss = std::max(loss, moved_loss(plane(i), coarse.plane(j, full_.plane)));
            return loss;
        }
        std::vector<int> held(static_cast<std::size_t>(coarse.range().count), -1);
        T loss = T(0);
        for (const Box3<T>& c : extents_.casters) {
            const int before = fine_.slice_of(c), after = coarse.slice_of(c);
            if (before < 0 || after < 0) return T(1);
            int& holder = held[static_cast<std::size_t>(after)];
            if (holder >= 0 && holder != before) return T(1);
            if (holder < 0) loss += moved_loss(plane(before), coarse.plane(after, full_.plane));
            holder = before;
        }
        return loss;
    }

    const OcclusionTextureOptions& full_;
    CandidateSearch<T>& search_;
    const SceneExtents<T>& extents_;
    SliceLayout<T> fine_;
    T nearest_ = std::numeric_limits<T>::max();
};

}  // namespace penumbra::detail
