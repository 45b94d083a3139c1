// How visibility through slices changes between neighbouring points.
//
// Of each slice follow bounds of what it blocks, and of that one's gradient, cell by cell of the light (SweptSlice);
// the rule by which slices combine makes one of them (OcclusionTrend), and cells add up. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/combine.hpp>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/kernel_variation.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/slice_layer.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <penumbra/occlusion_texture/swept_slice.hpp>
#include <penumbra/occlusion_texture/trend.hpp>
#include <type_traits>
#include <vector>

namespace penumbra::detail {

/// See OcclusionTextureShadow::variation(); for points of one box, which outlives it.
template <class T>
class SliceVariation {
  public:
    SliceVariation(const SliceSetting<T>& setting, const Box3<T>& box_ls) : setting_(setting), box_(box_ls) {}

    /// The slices that hold anything, from the light on.
    template <class Filter>
    Variation<T> of(const std::vector<SliceLayer<T, Filter>>& layers, T most) const {
        std::array<const SliceLayer<T, Filter>*, most_slices> touched;
        std::size_t count = 0;
        for (const SliceLayer<T, Filter>& layer : layers)
            if (may_touch(layer)) touched[count++] = &layer;
        if (count == 0) return Variation<T>::all_lit();
        if constexpr (std::is_same_v<SliceLayer<T, Filter>, Layer>)
            return of_touched(touched.data(), count, most);
        else
            return Variation<T>::unknown();
    }

  private:
    using Swept = SweptSlice<T>;
    using Layer = typename Swept::Layer;
    using Held = typename KernelSides<T>::Held;
    static constexpr int most_slices = OcclusionTextureOptions::most_slices, most_cells = Swept::most_cells;

    using Slices = std::array<Swept, most_slices>;
    using Occlusions = std::array<OcclusionTrend<T>, most_cells>;

    /// Whether a kernel of a point may read what the slice holds, where that counts.
    template <class Filter>
    bool may_touch(const SliceLayer<T, Filter>& layer) const {
        const T top = setting_.range.top(layer.slice), begin = setting_.hidden_to(top);
        if (!(box_.max.z > begin)) return false;
        const Box3<T> behind = part_behind(box_, begin);
        const Vec2<T> planes = setting_.plane_depths(top, behind);
        return SliceReach<T>(layer, setting_.options.light_cells)
            .may_touch(kernel_reach(setting_.camera, planes.x, planes.y, behind, setting_.half_size));
    }

    Variation<T> of_touched(const Layer* const* layers, std::size_t count, T most) const {
        const Combination rule = setting_.options.blend.combination;
        int cells = setting_.options.light_cells;
        Slices slices;
        std::size_t held = 0;
        for (std::size_t i = count; i > 0; --i) {  // from behind: of slices that hold points least is known
            Swept& slice = slices[held] = Swept(setting_, *layers[i - 1], box_, cells);
            if (slice.sweep().is_far()) return Variation<T>::unknown();
            const Held holds = slice.held();
            if (holds == Held::nothing || (!slice.passed() && slice.lies_behind(setting_, box_))) continue;
            if (holds == Held::all && slice.passed() && rule != Combination::mean) return Variation<T>::unchanging();
            if (!(most > T(0)) || !slice.sweep().is_known() || slice.sweep().is_wild()) return Variation<T>::unknown();
            ++held;
        }
        if (held == 0) return Variation<T>::all_lit();
        if (held == 1 && slices[0].passed() && cells != 1) {  // its means add up to that over all the light
            cells = 1;
            slices[0] = Swept(setting_, slices[0].layer(), box_, cells);
        }
        const auto all = static_cast<std::size_t>(cells * cells);
        Occlusions occlusions;
        combine(slices, held, all, occlusions);
        return add_up(occlusions, all, most);
    }

    /// What the first `held` slices block of each cell.
    void combine(const Slices& slices, std::size_t held, std::size_t cells, Occlusions& occlusions) const {
        const Combination rule = setting_.options.blend.combination;
        std::array<T, most_cells> least;  // that a cell is hidden by one of them
        std::fill_n(least.begin(), cells, T(0));
        std::array<T, most_cells * most_slices> greatest;
        const bool one_counts = held > 1 && rule == Combination::max;
        for (std::size_t i = 0; i < held && one_counts; ++i) {
            for (std::size_t cell = 0; cell < cells; ++cell) {
                const ValueRange<T> mean = slices[i].mean(cell);
                greatest[i * cells + cell] = mean.high;
                if (slices[i].passed()) least[cell] = std::max(least[cell], mean.low);
            }
        }
        std::fill_n(occlusions.begin(), cells, OcclusionTrend<T>());
        for (std::size_t i = 0; i < held; ++i) {
            const auto add = [&](std::size_t cell, const Trend<T>& blocked) {
                occlusions[cell].add((blocked * full_rounded_up<T>).up_to_one(), rule);
            };
            const auto is_less = [](T most_of_it, T least_of_others) { return most_of_it < least_of_others; };
            const T* of_it = greatest.data() + i * cells;
            if (one_counts && std::equal(of_it, of_it + cells, least.begin(), is_less)) continue;
            slices[i].visit(setting_, box_, add);
        }
    }

    /// The variation of the cells' mean; unknown if more than `most` is in doubt.
    Variation<T> add_up(const Occlusions& occlusions, std::size_t cells, T most) const {
        std::array<ValueRange<T>, 3> gradient{};
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const Trend<T> occlusion = occlusions[cell].result(setting_.options.blend.combination);
            for (std::size_t k = 0; k < 3; ++k) gradient[k] = gradient[k] + occlusion.gradient[k];
        }
        const T per_cell = T(0.5) / static_cast<T>(cells);
        Vec3<T> off(T(0), T(0), T(0));
        Variation<T> result;
        for (std::size_t k = 0; k < 3; ++k) {
            result.slope[static_cast<int>(k)] = -(gradient[k].low + gradient[k].high) * per_cell;
            off[static_cast<int>(k)] = (gradient[k].high - gradient[k].low) * per_cell;
        }
        result.known = glm::dot(off, box_.max - box_.min) * T(0.5) <= most;
        result.along = off.x, result.across = off.y, result.deep = off.z;
        return result;
    }

    SliceSetting<T> setting_;
    const Box3<T>& box_;
};

}  // namespace penumbra::detail
