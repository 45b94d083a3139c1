// A slice as the points of a box see it: what it blocks of them, and how that changes from one to another.
//
// Beside its kernel's mean, a slice near a point has a weight, and a plane, that change with the point's depth until
// the point has passed it. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/kernel_variation.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/occlusion_texture/slice_layer.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <penumbra/occlusion_texture/trend.hpp>

namespace penumbra::detail {

/// The part of a box from a depth on.
template <class T>
Box3<T> part_behind(const Box3<T>& box_ls, T depth) {
    return {Vec3<T>(box_ls.min.x, box_ls.min.y, std::max(box_ls.min.z, depth)), box_ls.max};
}

/// What decides, beside its texels, what a slice blocks. Refers to what it was made from.
template <class T>
struct SliceSetting {
    static constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();

    const OcclusionTextureOptions& options;
    const SliceCamera<T>& camera;
    const SliceRange<T>& range;
    Vec2<T> half_size;  ///< the light's

    T plane_depth(T top, T point_depth) const {
        return slice_plane_depth(top, range.thickness, point_depth, options.plane);
    }
    /// The depths of the slice's plane for the nearest and the farthest point of a box.
    Vec2<T> plane_depths(T top, const Box3<T>& box_ls) const {
        return Vec2<T>(plane_depth(top, box_ls.min.z), plane_depth(top, box_ls.max.z));
    }
    /// The depth up to which a slice hides nothing.
    T hidden_to(T top) const {
        const T weight = options.self_shadow == SelfShadow::fade    ? T(0)
                         : options.self_shadow == SelfShadow::clear ? T(1)
                                                                    : T(options.self_shadow_bias);
        return top + weight * (T(1) - rounding) * range.thickness;
    }
    /// Whether a point has a slice behind it: its plane and its weight stay.
    bool has_passed(T top, T depth) const {
        const T weight = options.self_shadow == SelfShadow::fade    ? T(1)
                         : options.self_shadow == SelfShadow::clear ? T(2)
                                                                    : T(1) + T(2) * T(options.self_shadow_bias);
        const T passed = std::max(weight, options.plane == SlicePlane::bottom ? T(2) : T(1)) * (T(1) + rounding);
        return relative_depth(top, range.thickness, depth) >= passed;
    }
};

/// A slice whose means are exact, and how the points of a box see it.
template <class T>
class SweptSlice {
  public:
    using Layer = SliceLayer<T, SummedArea<std::uint32_t>>;
    static constexpr int most_cells = OcclusionTextureOptions::most_cells * OcclusionTextureOptions::most_cells;

    SweptSlice() {}
    SweptSlice(const SliceSetting<T>& setting, const Layer& layer, const Box3<T>& box_ls, int cells)
        : layer_(&layer),
          sweep_(sweep(setting, setting.range.top(layer.slice), box_ls, cells)),
          passed_(setting.has_passed(setting.range.top(layer.slice), box_ls.min.z)),
          hidden_from_some_(box_ls.min.z < setting.hidden_to(setting.range.top(layer.slice))) {}

    const Layer& layer() const { return *layer_; }
    const KernelSweep<T>& sweep() const { return sweep_; }
    /// Whether all points have it behind them.
    bool passed() const { return passed_; }
    /// What kernels may read of its mask.
    typename KernelSides<T>::Held held() const { return sweep_.sides().held(layer_->filters[0]); }
    /// Bounds of a cell's mean, 0 to 1.
    ValueRange<T> mean(std::size_t cell) const { return sweep_.sides().mean(layer_->filters[0], cell); }

    /// Whether all that it may hide from the points is at their depth or deeper.
    bool lies_behind(const SliceSetting<T>& setting, const Box3<T>& box_ls) const {
        if (setting.options.self_shadow != SelfShadow::mean_depth) return false;
        const ValueRange<T> depths = sweep_.sides().held_depths(layer_->filters[0], layer_->filters[1]);
        return relative_depths(setting, box_ls).high - T(setting.options.self_shadow_bias) <= depths.low - depth_margin;
    }

    /// What it blocks of each cell, with weights but without rounding.
    template <class Add>
    void visit(const SliceSetting<T>& setting, const Box3<T>& box_ls, const Add& add) const {
        if (passed_) return sweep_.visit(layer_->filters[0], add);
        const auto add_cell = [&](std::size_t cell, const Trend<T>& blocked) {
            add(cell, hidden_from_some_ ? join(blocked, Trend<T>::constant(T(0))) : blocked);
        };
        Trend<T> relative{relative_depths(setting, box_ls), {}};
        const T per_depth = T(1) / setting.range.thickness;
        relative.gradient[2] = {relative.value.high < T(4) ? per_depth : T(0), per_depth};
        const SelfShadow mode = setting.options.self_shadow;
        if (mode == SelfShadow::mean_depth)
            return visit_weighed_by_depth(static_cast<T>(setting.options.self_shadow_bias), relative, add_cell);
        const T start = mode == SelfShadow::fade ? T(0) : T(1);
        const Trend<T> weight = (relative + Trend<T>::constant(-start)).at_least_zero().up_to_one();
        sweep_.visit(layer_->filters[0],
                     [&](std::size_t cell, const Trend<T>& mask) { add_cell(cell, mask * weight); });
    }

  private:
    static constexpr T depth_margin = T(1e-4);  ///< of means of depths, slices: more than their rounding

    static KernelSweep<T> sweep(const SliceSetting<T>& setting, T top, const Box3<T>& box_ls, int cells) {
        const Box3<T> behind = part_behind(box_ls, setting.hidden_to(top));
        const T part = setting.options.plane == SlicePlane::bottom ? T(1) : T(0.5);
        const T nominal = top + setting.range.thickness * part;
        const auto slope = [&](T depth) { return (top + depth) * T(0.5) < nominal ? T(0.5) : T(0); };
        const ValueRange<T> slopes{slope(behind.max.z), slope(behind.min.z)};
        return {setting.camera, setting.plane_depths(top, behind), slopes, behind, setting.half_size, cells};
    }
    /// m weight((relative − d / m − bias) / bias) = (m (relative − bias) − d) / bias, from 0 to m
    template <class Add>
    void visit_weighed_by_depth(T bias, const Trend<T>& relative, const Add& add) const {
        std::array<Trend<T>, most_cells> masks;
        sweep_.visit(layer_->filters[0], [&](std::size_t cell, const Trend<T>& m) { masks[cell] = m; });
        const Trend<T> before = relative + Trend<T>::constant(-bias);
        sweep_.visit(layer_->filters[1], [&](std::size_t cell, const Trend<T>& d) {
            const Trend<T> seen = (masks[cell] * before + d.negative()) * (T(1) / bias);
            add(cell, lesser(seen.at_least_zero(), masks[cell]));
        });
    }
    /// Of points that do not lie before where the slice counts.
    ValueRange<T> relative_depths(const SliceSetting<T>& setting, const Box3<T>& box_ls) const {
        constexpr T rounding = SliceSetting<T>::rounding;
        const T top = setting.range.top(layer_->slice), thickness = setting.range.thickness;
        const T least = std::max(box_ls.min.z, setting.hidden_to(top));
        return {relative_depth(top, thickness, least) * (T(1) - rounding),
                relative_depth(top, thickness, box_ls.max.z) * (T(1) + rounding)};
    }

    const Layer* layer_;
    KernelSweep<T> sweep_;
    bool passed_;
    bool hidden_from_some_;  ///< which have not come to where it counts
};

}  // namespace penumbra::detail
