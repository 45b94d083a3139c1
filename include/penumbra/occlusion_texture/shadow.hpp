// Soft shadows of a rectangle light from occlusion textures.
//
// Build: capture the casters in slices, prefilter each slice. Query: for each slice between light and point,
// average its texture over the part through which the point sees the light, and combine the averages. Source:
// E. Eisemann & X. Décoret, "Plausible image based soft shadows using occlusion textures", 2006.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/combine.hpp>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/detail/variation.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/options.hpp>
#include <penumbra/occlusion_texture/slice_layer.hpp>
#include <penumbra/occlusion_texture/slice_variation.hpp>
#include <penumbra/occlusion_texture/slices.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace penumbra {

/// Visibility of a rectangle light. Building takes O(triangles + slices · resolution²); a query O(slices ·
/// light_cells²). Queries are const, allocate nothing, and may run from any number of threads.
template <class T>
class OcclusionTextureShadow {
  public:
    using Real = T;
    using Light = RectLight<T>;
    using Options = OcclusionTextureOptions;

    /// Reports meshes, lights and options out of their domain by name. No casters: everything is visible. A
    /// light without size casts hard shadows, and looks towards the casters' centre if both its sides are
    /// zero.
    OcclusionTextureShadow(const std::vector<Mesh<T>>& casters, const RectLight<T>& light, const Options& options = {})
        : options_(options) {
        if (!validate(options) || !validate(light) || !validate(casters)) return;
        const Box3<T> box = bounds(casters);
        if (is_empty(box)) return;
        frame_ = light_frame(light, (box.min + box.max) * T(0.5) - light.center);
        half_size_ = half_size(light);
        const LitTriangles<T> triangles = lit_triangles(casters, frame_, options.faces);
        camera_ = fit_slice_camera(triangles.vertices_ls, half_size_, options.projection, options.resolution, margin);
        range_ = slice_range(triangles, options.slices);
        prefilter(capture_slices(triangles, camera_, range_, options.blend.close_leaks));
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
        std::visit(
            [&](const auto& layers) {
                for (std::size_t first = 0; first < count; first += block)
                    shade(layers, points + first, std::min(block, count - first), result + first);
            },
            layers_);
    }

    /// How visibility changes between points of a box in light space, up to the 1e-5 by which full occlusion is rounded
    /// up; unknown where more than `most` is in doubt from its middle to its corners, where kernels are thin or sweep
    /// over many texels, and for filters that are not exact.
    Variation<T> variation(const Box3<T>& box_ls, T most) const {
        const detail::SliceVariation<T> variation_in_box({options_, camera_, range_, half_size_}, box_ls);
        return std::visit([&](const auto& layers) { return variation_in_box.of(layers, most); }, layers_);
    }

    const Options& options() const { return options_; }
    const LightFrame<T>& frame() const { return frame_; }
    const SliceCamera<T>& camera() const { return camera_; }
    const SliceRange<T>& range() const { return range_; }
    /// Memory of the prefiltered slices.
    std::size_t bytes() const {
        return std::visit(
            [](const auto& layers) {
                std::size_t sum = 0;
                for (const auto& layer : layers)
                    for (const auto& filter : layer.filters) sum += filter.bytes();
                return sum;
            },
            layers_);
    }

  private:
    static constexpr int margin = 2;  // empty texels around the casters: one for bilinear taps, one for rounding

    template <class Filter>
    using Layer = detail::SliceLayer<T, Filter>;
    template <class Filter>
    using Layers = std::vector<Layer<Filter>>;

    /// Points are shaded in blocks, as arrays, so that all but the reads of textures vectorises.
    static constexpr std::size_t block = detail::Boxes<T>::capacity;
    using Values = std::array<T, block>;
    struct Points {
        Values x, y, depth;
        std::size_t count;
    };
    struct Occlusions {
        Values transmission, total, largest;

        void clear() { transmission.fill(T(1)), total.fill(T(0)), largest.fill(T(0)); }
        void add(const Values& blocked, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) {
                transmission[i] *= T(1) - blocked[i];
                total[i] += blocked[i];
                largest[i] = blocked[i] > largest[i] ? blocked[i] : largest[i];
            }
        }
    };
    struct Kernels {
        detail::Boxes<T> boxes;
        Values relative;  ///< the point's depth in slices below the slice's top, 0 if it is not below
    };
    static constexpr int most_cells = Options::most_cells * Options::most_cells;

    void prefilter(const Slices<T>& slices) {
        switch (options_.filter) {
            case SliceFilter::mipmap:
                layers_.template emplace<Layers<MipMap<std::uint8_t>>>();
                break;
            case SliceFilter::n_buffer:
                layers_.template emplace<Layers<NBuffer<std::uint8_t>>>();
                break;
            case SliceFilter::summed_area:
                layers_.template emplace<Layers<SummedArea<std::uint32_t>>>();
                break;
        }
        std::visit([&](auto& layers) { prefilter(slices, layers); }, layers_);
    }

    template <class Filter>
    void prefilter(const Slices<T>& slices, Layers<Filter>& layers) const {
        for (int slice = 0; slice < range_.count; ++slice) {
            const Image<std::uint8_t>& mask = slices.masks[static_cast<std::size_t>(slice)];
            if (mask.empty()) continue;
            Layer<Filter> layer{slice, detail::occupied_rect<T>(mask), {}};
            const auto add = [&](const Image<std::uint8_t>& image) {
                if constexpr (std::is_same_v<Filter, NBuffer<std::uint8_t>>)
                    layer.filters.emplace_back(image, levels_needed(slice));
                else
                    layer.filters.emplace_back(image);
            };
            add(mask);
            if (options_.self_shadow == SelfShadow::mean_depth) add(slices.depths[static_cast<std::size_t>(slice)]);
            layers.push_back(std::move(layer));
        }
    }

    /// No kernel on this slice is larger than a cell of the light seen at the slice's top.
    int levels_needed(int slice) const {
        const T w = T(1) + camera_.convergence * std::max(range_.top(slice), T(0));
        const Vec2<T> kernel = half_size_ * camera_.scale_tx * (T(2) / (w * static_cast<T>(options_.light_cells)));
        return floor_log2(clamp(std::max(kernel.x, kernel.y), T(1), T(16384))) + 2;
    }

    template <class Filter>
    void shade(const Layers<Filter>& layers, const Vec3<T>* points, std::size_t count, T* result) const {
        Points p;
        p.count = count;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3<T> point_ls = frame_.to_light(points[i]);
            p.x[i] = point_ls.x, p.y[i] = point_ls.y, p.depth[i] = point_ls.z;
        }
        const auto cells = static_cast<std::size_t>(options_.light_cells * options_.light_cells);
        std::array<Occlusions, most_cells> occlusions;
        for (std::size_t cell = 0; cell < cells; ++cell) occlusions[cell].clear();
        Kernels kernels;
        detail::BoxGrid<T> grid;
        std::array<Values, most_cells> blocked;
        for (const Layer<Filter>& layer : layers) {
            find_kernels(range_.top(layer.slice), p, kernels);
            if (!any_blocked(kernels, detail::SliceReach<T>(layer, options_.light_cells))) continue;
            grid.set(kernels.boxes, options_.light_cells);
            layer.filters[0].mean(grid, blocked.data());
            self_shadow(layer, kernels, grid, blocked);
            for (std::size_t cell = 0; cell < cells; ++cell) occlusions[cell].add(blocked[cell], count);
        }
        Values sum{};
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const Occlusions& o = occlusions[cell];
            for (std::size_t i = 0; i < count; ++i)
                sum[i] += OcclusionAccumulator<T>{o.transmission[i], o.total[i], o.largest[i]}.result(
                    options_.blend.combination);
        }
        const T all = static_cast<T>(cells);
        for (std::size_t i = 0; i < count; ++i) result[i] = saturate((all - sum[i]) / all);
    }

    void find_kernels(T top, const Points& p, Kernels& kernels) const {
        const Rect2<T> light_ls{-half_size_, half_size_};
        const SliceCamera<T> camera = camera_;
        const T thickness = range_.thickness;
        const SlicePlane plane = options_.plane;
        detail::Boxes<T>& boxes = kernels.boxes;
        boxes.count = p.count;
        for (std::size_t i = 0; i < p.count; ++i) {
            const T depth = p.depth[i];
            const Rect2<T> box = camera.footprint(slice_plane_depth(top, thickness, depth, plane),
                                                  Vec3<T>(p.x[i], p.y[i], depth), light_ls);
            boxes.min_x[i] = box.min.x, boxes.min_y[i] = box.min.y, boxes.max_x[i] = box.max.x,
            boxes.max_y[i] = box.max.y;
            kernels.relative[i] = depth > T(0) ? relative_depth(top, thickness, depth) : T(0);
        }
    }

    /// Whether a kernel lies behind the slice's top and where a mean may read what the slice holds. Else all means are
    /// exactly 0.
    static bool any_blocked(const Kernels& kernels, const detail::SliceReach<T>& reach) {
        const detail::Boxes<T>& b = kernels.boxes;
        int any = 0;
        for (std::size_t i = 0; i < b.count; ++i)
            any |= static_cast<int>(kernels.relative[i] > T(0)) &
                   reach.may_touch(b.min_x[i], b.min_y[i], b.max_x[i], b.max_y[i]);
        return any != 0;
    }

    /// From the means of a slice's mask, 0 to 255, what the slice blocks of each kernel, 0 to 1.
    template <class Filter>
    void self_shadow(const Layer<Filter>& layer, const Kernels& kernels, const detail::BoxGrid<T>& grid,
                     std::array<Values, most_cells>& blocked) const {
        const auto cells = static_cast<std::size_t>(grid.cells * grid.cells);
        const SelfShadow mode = options_.self_shadow;
        const T bias = static_cast<T>(options_.self_shadow_bias);
        if (mode == SelfShadow::mean_depth) weigh_by_depth(layer.filters[1], kernels, grid, blocked);
        constexpr T unit = detail::full_rounded_up<T> / T(255);
        Values weight;
        for (std::size_t i = 0; i < grid.count; ++i) {
            const T relative = kernels.relative[i];
            weight[i] = unit * (mode == SelfShadow::mean_depth ? (relative > bias ? T(1) : T(0))
                                                               : slice_weight(relative, T(0), bias, mode));
        }
        for (std::size_t cell = 0; cell < cells; ++cell)
            for (std::size_t i = 0; i < grid.count; ++i) blocked[cell][i] = saturate(blocked[cell][i] * weight[i]);
    }

    /// Weighs what the slice blocks of points that it may hold, and of no others.
    template <class Filter>
    void weigh_by_depth(const Filter& depths, const Kernels& kernels, const detail::BoxGrid<T>& grid,
                        std::array<Values, most_cells>& blocked) const {
        const T bias = static_cast<T>(options_.self_shadow_bias), passed = T(1) + T(2) * bias;
        const auto cells = static_cast<std::size_t>(grid.cells);
        std::array<std::size_t, block> held;
        detail::BoxGrid<T> part;
        part.cells = grid.cells;
        for (std::size_t i = 0; i < grid.count; ++i) {
            if (!(kernels.relative[i] > bias && kernels.relative[i] < passed)) continue;
            for (std::size_t k = 0; k <= cells; ++k) {
                part.x[k][part.count] = grid.x[k][i];
                part.y[k][part.count] = grid.y[k][i];
            }
            held[part.count++] = i;
        }
        if (part.count == 0) return;
        std::array<Values, most_cells> means;
        depths.mean(part, means.data());
        for (std::size_t cell = 0; cell < cells * cells; ++cell) {
            for (std::size_t k = 0; k < part.count; ++k) {
                T& value = blocked[cell][held[k]];
                const T mean_depth = saturated_ratio(means[cell][k], value);
                value *= slice_weight(kernels.relative[held[k]], mean_depth, bias, SelfShadow::mean_depth);
            }
        }
    }

    Options options_;
    LightFrame<T> frame_{};
    Vec2<T> half_size_ = Vec2<T>(T(0), T(0));
    SliceCamera<T> camera_;
    SliceRange<T> range_;
    std::variant<Layers<MipMap<std::uint8_t>>, Layers<NBuffer<std::uint8_t>>, Layers<SummedArea<std::uint32_t>>>
        layers_;
};

}  // namespace penumbra
