// A shadow built as planned, whose batches of points pay only for what their places call for.
#pragma once

#include <cstddef>
#include <penumbra/detail/variation.hpp>
#include <penumbra/plan/known_depths.hpp>
#include <penumbra/plan/known_maps.hpp>
#include <penumbra/plan/known_tiles.hpp>
#include <penumbra/plan/planner.hpp>
#include <penumbra/plan/tile_query.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace penumbra {

/// Visibility as a plan has it: |this − full| ≤ plan().bound at the receivers that the plan was told of. Queries are
/// const, allocate nothing, and may run from any number of threads.
template <class Shadow>
class PlannedShadow {
  public:
    using T = typename Shadow::Real;

    /// The casters and receivers that the plan was made for. Maps of line lights are told of receivers too.
    PlannedShadow(const std::vector<Mesh<T>>& casters, Plan<Shadow> plan, const std::vector<Mesh<T>>& receivers = {})
        : plan_(std::move(plan)), shadow_(built(kept(casters), receivers)), frame_(shadow_.frame()) {
        if constexpr (std::is_same_v<Shadow, SoftShadowMap<T>>)
            known_ = detail::known_places(shadow_);
        else if constexpr (std::is_same_v<Shadow, UmbraVolumeShadow<T>>)
            known_ = detail::known_places(shadow_.d_buffer());
    }

    /// Fraction of the light that `point` (world space) sees, in [0, 1], as the planned method has it.
    T visibility(const Vec3<T>& point) const { return shadow_.visibility(point); }

    /// The same for `count` points, faster if neighbours in the array are neighbours in space: where nothing hides the
    /// light from any of them, or it cannot change by more than the plan allows between them, few are asked.
    /// `answers`, if not null, is told how each came by its visibility.
    void visibility(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers = nullptr) const {
        if (is_by_maps()) {
            const detail::KnownTiles<T, Shadow, detail::KnownPlaces<T>> query(shadow_, known_, frame_);
            return query(points, count, result, answers);
        }
        if constexpr (!std::is_same_v<Shadow, SoftShadowMap<T>>) {
            const auto vary = [&](const Box3<T>& box_ls, T most, [[maybe_unused]] const Vec3<T>* tile,
                                  [[maybe_unused]] std::size_t size) {
                if constexpr (std::is_same_v<Shadow, OcclusionTextureShadow<T>>)
                    return shadow_.variation(box_ls, most);
                else
                    return shadow_.variation(box_ls, most, tile, size);
            };
            constexpr std::size_t effort = std::is_same_v<Shadow, OcclusionTextureShadow<T>> ? 16 : 1;
            detail::TileQuery<T, Shadow, decltype(vary)>(shadow_, vary, frame_, plan_.tile_tolerance, effort)(
                points, count, result, answers);
        }
    }

    const Plan<Shadow>& plan() const { return plan_; }
    const Shadow& shadow() const { return shadow_; }
    std::size_t bytes() const { return shadow_.bytes() + known_.bytes(); }

  private:
    std::vector<Mesh<T>> kept(const std::vector<Mesh<T>>& casters) const {
        std::vector<Mesh<T>> result;
        for (const std::size_t i : plan_.casters)
            if (i < casters.size()) result.push_back(casters[i]);
        return result;
    }
    Shadow built(const std::vector<Mesh<T>>& casters, const std::vector<Mesh<T>>& receivers) const {
        if constexpr (std::is_same_v<Shadow, SoftShadowMap<T>>)
            return Shadow(casters, plan_.light, plan_.options, receivers);
        else
            return Shadow(casters, plan_.light, plan_.options);
    }
    /// Whether what it answers changes from texel to texel.
    bool is_by_maps() const {
        if constexpr (std::is_same_v<Shadow, SoftShadowMap<T>>)
            return true;
        else if constexpr (std::is_same_v<Shadow, UmbraVolumeShadow<T>>)
            return plan_.options.mode == DiskMode::d_buffer;
        else
            return false;
    }

    Plan<Shadow> plan_;
    Shadow shadow_;
    LightFrame<T> frame_;
    detail::KnownPlaces<T> known_;  ///< to shadows by maps, without which everything is lit
};

}  // namespace penumbra
