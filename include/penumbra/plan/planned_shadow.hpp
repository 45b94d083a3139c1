// A shadow built as planned, whose batches of points pay only for what their places call for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/detail/variation.hpp>
#include <penumbra/plan/planner.hpp>
#include <penumbra/plan/tile_query.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace penumbra {

namespace detail {

/// Casters' boxes, widened by what their images may be off by.
template <class T>
class LitTest {
  public:
    LitTest() = default;
    /// `texel` and `deepest` widen a box by two texels at its farthest depth: slopes.
    LitTest(const SceneExtents<T>& extents, const Vec2<T>& texel) : light_(extents.light) {
        for (Box3<T> box : extents.casters) {
            const Vec2<T> margin = texel * (T(2) * std::max(box.max.z, T(0)));
            box.min.x -= margin.x, box.min.y -= margin.y, box.max.x += margin.x, box.max.y += margin.y;
            if (!is_empty(box)) boxes_.push_back(box);
        }
    }
    Variation<T> operator()(const Box3<T>& tile_ls) const {
        for (const Box3<T>& box : boxes_)
            if (occlusion_limit(box, tile_ls, light_) > T(0)) return Variation<T>::unknown();
        return Variation<T>::all_lit();
    }

  private:
    LightExtent<T> light_{};
    std::vector<Box3<T>> boxes_;
};

template <class T>
Vec2<T> texel_slope(const Rect2<T>& slopes, int resolution) {
    return resolution > 0 ? extent(slopes) / static_cast<T>(resolution) : Vec2<T>(T(0), T(0));
}

}  // namespace detail

/// Visibility as a plan has it: |this − full| ≤ plan().bound at the receivers that the plan was told of. Queries are
/// const, allocate nothing, and may run from any number of threads.
template <class Shadow>
class PlannedShadow {
  public:
    using T = typename Shadow::Real;

    /// The casters and receivers that the plan was made for. Maps of line lights are told of receivers too.
    PlannedShadow(const std::vector<Mesh<T>>& casters, Plan<Shadow> plan, const std::vector<Mesh<T>>& receivers = {})
        : plan_(std::move(plan)), shadow_(built(kept(casters), receivers)), frame_(shadow_.frame()) {
        if constexpr (std::is_same_v<Shadow, SoftShadowMap<T>>) {
            test_boxes(casters, detail::texel_slope(shadow_.view().slopes, shadow_.view().resolution));
        } else if constexpr (std::is_same_v<Shadow, UmbraVolumeShadow<T>>) {
            if (plan_.options.mode == DiskMode::d_buffer)
                test_boxes(casters, detail::texel_slope(shadow_.d_buffer().view().slopes, plan_.options.resolution));
        }
    }

    /// Fraction of the light that `point` (world space) sees, in [0, 1], as the planned method has it.
    T visibility(const Vec3<T>& point) const { return shadow_.visibility(point); }

    /// The same for `count` points, faster if neighbours in the array are neighbours in space: where nothing hides the
    /// light from any of them, or it cannot change by more than the plan allows between them, few are asked.
    /// `answers`, if not null, is told how each came by its visibility.
    void visibility(const Vec3<T>* points, std::size_t count, T* result, PointAnswer* answers = nullptr) const {
        const auto vary = [&](const Box3<T>& box_ls, T most, const Vec3<T>* tile, std::size_t size) {
            return variation(box_ls, most, tile, size);
        };
        detail::TileQuery<T, Shadow, decltype(vary)>(shadow_, vary, frame_, plan_.tile_tolerance)(points, count, result,
                                                                                                  answers);
    }

    const Plan<Shadow>& plan() const { return plan_; }
    const Shadow& shadow() const { return shadow_; }
    std::size_t bytes() const { return shadow_.bytes(); }

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
    void test_boxes(const std::vector<Mesh<T>>& casters, const Vec2<T>& texel) {
        SceneExtents<T> extents;
        extents.light = detail::light_extent(plan_.light);
        for (const std::size_t i : plan_.casters)
            if (i < casters.size()) extents.casters.push_back(detail::seen_box(casters[i], frame_));
        lit_test_ = detail::LitTest<T>(extents, texel);
    }
    Variation<T> variation(const Box3<T>& box_ls, T most, const Vec3<T>* points, std::size_t count) const {
        if constexpr (std::is_same_v<Shadow, SoftShadowMap<T>>) {
            return lit_test_(box_ls);
        } else if constexpr (std::is_same_v<Shadow, UmbraVolumeShadow<T>>) {
            return plan_.options.mode == DiskMode::d_buffer ? lit_test_(box_ls)
                                                            : shadow_.variation(box_ls, most, points, count);
        } else if constexpr (std::is_same_v<Shadow, PenumbraWedgeShadow<T>>) {
            return shadow_.variation(box_ls, most, points, count);
        } else {
            return shadow_.variation(box_ls, most);
        }
    }

    Plan<Shadow> plan_;
    Shadow shadow_;
    LightFrame<T> frame_;
    detail::LitTest<T> lit_test_;
};

}  // namespace penumbra
