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
#include <iterator>
#include <limits>
#include <penumbra/combine.hpp>
#include <penumbra/detail/variation.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/kernel_variation.hpp>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/options.hpp>
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
        return std::visit([&](const auto& layers) { return variation(layers, box_ls, most); }, layers_);
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

    /// A slice that holds anything: its mask and, for SelfShadow::mean_depth, its depths.
    template <class Filter>
    struct Layer {
        int slice;
        Rect2<T> occupied_tx;  ///< around all that blocks
        std::vector<Filter> filters;
    };
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
    static constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
    static constexpr T depth_margin = T(1e-4);   ///< of means of depths, slices: more than their rounding
    static constexpr T rounded_up = T(1.00001);  ///< full occlusion stays full through the mean's rounding

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
            Layer<Filter> layer{slice, occupied_rect(mask), {}};
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

    static Rect2<T> occupied_rect(const Image<std::uint8_t>& mask) {
        Rect2<T> rect = empty_rect<T>();
        for (int y = 0; y < mask.height(); ++y) {
            const std::uint8_t *row = mask.row(y), *end = row + mask.width();
            const auto is_set = [](std::uint8_t texel) { return texel != 0; };
            const auto first = std::find_if(row, end, is_set) - row;
            if (first == mask.width()) continue;
            const auto last = std::find_if(std::reverse_iterator(end), std::reverse_iterator(row), is_set).base() - row;
            rect = extend(rect, Vec2<T>(static_cast<T>(first), static_cast<T>(y)));
            rect = extend(rect, Vec2<T>(static_cast<T>(last), static_cast<T>(y + 1)));
        }
        return rect;
    }

    /// No kernel on this slice is larger than a cell of the light seen at the slice's top.
    int levels_needed(int slice) const {
        const T w = T(1) + camera_.convergence * std::max(range_.top(slice), T(0));
        const Vec2<T> kernel = half_size_ * camera_.scale_tx * (T(2) / (w * static_cast<T>(options_.light_cells)));
        return floor_log2(clamp(std::max(kernel.x, kernel.y), T(1), T(16384))) + 2;
    }

    template <class Filter>
    Variation<T> variation(const Layers<Filter>& layers, const Box3<T>& box_ls, T most) const {
        std::array<const Layer<Filter>*, Options::most_slices> touched;
        std::size_t count = 0;
        for (const Layer<Filter>& layer : layers) {
            const T top = range_.top(layer.slice), begin = hidden_to(top);
            if (!(box_ls.max.z > begin)) continue;
            Box3<T> behind = box_ls;
            behind.min.z = std::max(behind.min.z, begin);
            const Rect2<T> reach = detail::kernel_reach(camera_, plane_depth(top, behind.min.z),
                                                        plane_depth(top, behind.max.z), behind, half_size_);
            if (may_touch(reach, layer)) touched[count++] = &layer;
        }
        if (count == 0) return Variation<T>::all_lit();
        if constexpr (std::is_same_v<Filter, SummedArea<std::uint32_t>>)
            return variation(touched.data(), count, box_ls, most);
        else
            return Variation<T>::unknown();
    }

    /// A slice, and how the points of a box see it.
    template <class Filter>
    struct SweptLayer {
        const Layer<Filter>* layer;
        detail::KernelSweep<T> sweep;
        bool passed;            ///< by all points
        bool hidden_from_some;  ///< which have not come to where it counts
    };
    template <class Filter>
    Variation<T> variation(const Layer<Filter>* const* layers, std::size_t count, const Box3<T>& box_ls, T most) const {
        const Combination rule = options_.blend.combination;
        std::array<SweptLayer<Filter>, Options::most_slices> swept;
        std::size_t held = 0;
        for (std::size_t i = count; i > 0; --i) {  // from behind: of slices that hold points least is known
            swept[held] = sweep_over(*layers[i - 1], box_ls, options_.light_cells);
            const auto& [layer, sweep, passed, hidden_from_some] = swept[held];
            if (sweep.is_far()) return Variation<T>::unknown();
            const auto holds = sweep.held(layer->filters[0]);
            if (holds == detail::KernelSweep<T>::Held::nothing || (!passed && lies_behind(swept[held], box_ls)))
                continue;
            if (holds == detail::KernelSweep<T>::Held::all && passed && rule != Combination::mean) return all_dark();
            if (!sweep.is_known() || sweep.is_wild()) return Variation<T>::unknown();
            ++held;
        }
        if (held == 0) return Variation<T>::all_lit();
        const bool is_sum = held == 1 && swept[0].passed;  // means of one slice add up to that over all the light
        const int cells = is_sum ? 1 : options_.light_cells;
        if (is_sum && cells != options_.light_cells) swept[0] = sweep_over(*swept[0].layer, box_ls, cells);
        const auto all = static_cast<std::size_t>(cells * cells);
        std::array<T, most_cells> least;  // that a cell is hidden by one of them
        std::fill_n(least.begin(), all, T(0));
        std::array<T, most_cells * Options::most_slices> greatest;
        const bool one_counts = held > 1 && rule == Combination::max;
        for (std::size_t i = 0; i < held && one_counts; ++i) {
            for (std::size_t cell = 0; cell < all; ++cell) {
                const detail::ValueRange<T> mean = swept[i].sweep.mean(swept[i].layer->filters[0], cell);
                greatest[i * all + cell] = mean.high;
                if (swept[i].passed) least[cell] = std::max(least[cell], mean.low);
            }
        }
        std::array<detail::OcclusionTrend<T>, most_cells> occlusions;
        std::fill_n(occlusions.begin(), all, detail::OcclusionTrend<T>());
        for (std::size_t i = 0; i < held; ++i) {
            const auto add = [&](std::size_t cell, const detail::Trend<T>& blocked) {
                occlusions[cell].add((blocked * rounded_up).up_to_one(), rule);
            };
            const auto is_less = [](T most_of_it, T least_of_others) { return most_of_it < least_of_others; };
            if (one_counts && std::equal(&greatest[i * all], &greatest[i * all] + all, least.begin(), is_less))
                continue;
            visit_trends(swept[i], box_ls, add);
        }
        std::array<detail::ValueRange<T>, 3> gradient{};
        for (std::size_t cell = 0; cell < all; ++cell) {
            const detail::Trend<T> occlusion = occlusions[cell].result(rule);
            for (std::size_t k = 0; k < 3; ++k) gradient[k] = gradient[k] + occlusion.gradient[k];
        }
        const T per_cell = T(0.5) / static_cast<T>(all);
        Vec3<T> off(T(0), T(0), T(0));
        Variation<T> result;
        for (std::size_t k = 0; k < 3; ++k) {
            result.slope[static_cast<int>(k)] = -(gradient[k].low + gradient[k].high) * per_cell;
            off[static_cast<int>(k)] = (gradient[k].high - gradient[k].low) * per_cell;
        }
        result.known = glm::dot(off, box_ls.max - box_ls.min) * T(0.5) <= most;
        result.effort = T(16);
        result.along = off.x, result.across = off.y, result.deep = off.z;
        return result;
    }
    static Variation<T> all_dark() {
        Variation<T> result;
        result.known = true;
        return result;
    }

    template <class Filter>
    SweptLayer<Filter> sweep_over(const Layer<Filter>& layer, const Box3<T>& box_ls, int cells) const {
        const T top = range_.top(layer.slice), begin = hidden_to(top);
        Box3<T> behind = box_ls;
        behind.min.z = std::max(behind.min.z, begin);
        const Vec2<T> planes(plane_depth(top, behind.min.z), plane_depth(top, behind.max.z));
        const T nominal =
            options_.plane == SlicePlane::bottom ? top + range_.thickness : top + range_.thickness * T(0.5);
        const auto slope = [&](T depth) { return (top + depth) * T(0.5) < nominal ? T(0.5) : T(0); };
        const detail::ValueRange<T> slopes{slope(behind.max.z), slope(behind.min.z)};
        return {&layer, detail::KernelSweep<T>(camera_, planes, slopes, behind, half_size_, cells),
                has_passed(layer, box_ls.min.z), box_ls.min.z < begin};
    }

    /// What a slice blocks of each cell, with weights but without rounding.
    template <class Filter, class Add>
    void visit_trends(const SweptLayer<Filter>& swept, const Box3<T>& box_ls, const Add& add) const {
        if (swept.passed) return swept.sweep.visit(swept.layer->filters[0], add);
        const auto add_cell = [&](std::size_t cell, const detail::Trend<T>& blocked) {
            add(cell, swept.hidden_from_some ? join(blocked, detail::Trend<T>::constant(T(0))) : blocked);
        };
        detail::Trend<T> relative{relative_depths(swept, box_ls), {}};
        const T per_depth = T(1) / range_.thickness;
        relative.gradient[2] = {relative.value.high < T(4) ? per_depth : T(0), per_depth};
        if (options_.self_shadow == SelfShadow::mean_depth) return visit_weighed_by_depth(swept, relative, add_cell);
        const T start = options_.self_shadow == SelfShadow::fade ? T(0) : T(1);
        const detail::Trend<T> weight = (relative + detail::Trend<T>::constant(-start)).at_least_zero().up_to_one();
        swept.sweep.visit(swept.layer->filters[0],
                          [&](std::size_t cell, const detail::Trend<T>& mask) { add_cell(cell, mask * weight); });
    }
    /// m weight((relative − d / m − bias) / bias) = (m (relative − bias) − d) / bias, from 0 to m
    template <class Filter, class Add>
    void visit_weighed_by_depth(const SweptLayer<Filter>& swept, const detail::Trend<T>& relative,
                                const Add& add) const {
        const T bias = static_cast<T>(options_.self_shadow_bias);
        std::array<detail::Trend<T>, most_cells> masks;
        swept.sweep.visit(swept.layer->filters[0],
                          [&](std::size_t cell, const detail::Trend<T>& m) { masks[cell] = m; });
        const detail::Trend<T> before = relative + detail::Trend<T>::constant(-bias);
        swept.sweep.visit(swept.layer->filters[1], [&](std::size_t cell, const detail::Trend<T>& d) {
            const detail::Trend<T> seen = (masks[cell] * before + d.negative()) * (T(1) / bias);
            add(cell, lesser(seen.at_least_zero(), masks[cell]));
        });
    }
    /// Whether all that a slice may hide from the points is at their depth or deeper.
    template <class Filter>
    bool lies_behind(const SweptLayer<Filter>& swept, const Box3<T>& box_ls) const {
        if (options_.self_shadow != SelfShadow::mean_depth) return false;
        const auto held = swept.sweep.held_depths(swept.layer->filters[0], swept.layer->filters[1]);
        return relative_depths(swept, box_ls).high - T(options_.self_shadow_bias) <= held.low - depth_margin;
    }
    /// Of points that do not lie before where the slice counts.
    template <class Filter>
    detail::ValueRange<T> relative_depths(const SweptLayer<Filter>& swept, const Box3<T>& box_ls) const {
        const T top = range_.top(swept.layer->slice), least = std::max(box_ls.min.z, hidden_to(top));
        return {relative_depth(top, range_.thickness, least) * (T(1) - rounding),
                relative_depth(top, range_.thickness, box_ls.max.z) * (T(1) + rounding)};
    }

    template <class Filter>
    bool has_passed(const Layer<Filter>& layer, T depth) const {
        return relative_depth(range_.top(layer.slice), range_.thickness, depth) >= passed_depth();
    }
    T plane_depth(T top, T point_depth) const {
        return slice_plane_depth(top, range_.thickness, point_depth, options_.plane);
    }
    /// The depth up to which a slice hides nothing.
    T hidden_to(T top) const {
        const T weight = options_.self_shadow == SelfShadow::fade    ? T(0)
                         : options_.self_shadow == SelfShadow::clear ? T(1)
                                                                     : T(options_.self_shadow_bias);
        return top + weight * (T(1) - rounding) * range_.thickness;
    }
    /// The relative depth from which on a point has a slice behind it: its plane and its weight stay.
    T passed_depth() const {
        const T weight = options_.self_shadow == SelfShadow::fade    ? T(1)
                         : options_.self_shadow == SelfShadow::clear ? T(2)
                                                                     : T(1) + T(2) * T(options_.self_shadow_bias);
        return std::max(weight, options_.plane == SlicePlane::bottom ? T(2) : T(1)) * (T(1) + rounding);
    }

    /// Whether a kernel within these texels may read what a slice holds.
    template <class Filter>
    bool may_touch(const Rect2<T>& kernels_tx, const Layer<Filter>& layer) const {
        const Vec2<T> size = extent(kernels_tx);
        const T cells = static_cast<T>(options_.light_cells), longer = std::max(size.x, size.y);
        const T far = std::max(longer, cells) * static_cast<T>(Filter::reach) / cells + detail::smallest_box<T> * cells;
        const Rect2<T> held = layer.occupied_tx;
        return kernels_tx.min.x - far < held.max.x && kernels_tx.max.x + far > held.min.x &&
               kernels_tx.min.y - far < held.max.y && kernels_tx.max.y + far > held.min.y;
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
            if (!any_blocked(kernels, layer.occupied_tx, static_cast<T>(Filter::reach))) continue;
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

    /// Whether a kernel lies behind the slice's top and so near what the slice holds that a mean may read it. Else all
    /// means are exactly 0. `reach` is the filter's.
    bool any_blocked(const Kernels& kernels, const Rect2<T>& occupied_tx, T reach) const {
        const detail::Boxes<T>& b = kernels.boxes;
        const T cells = static_cast<T>(options_.light_cells);
        const T per_size = reach / cells, widened = detail::smallest_box<T> * cells;
        int any = 0;
        for (std::size_t i = 0; i < b.count; ++i) {
            const T width = b.max_x[i] - b.min_x[i], height = b.max_y[i] - b.min_y[i];
            const T size = width > height ? width : height;
            const T far = (size > cells ? size : cells) * per_size + widened;
            any |= static_cast<int>(kernels.relative[i] > T(0)) &
                   static_cast<int>(b.min_x[i] - far < occupied_tx.max.x) &
                   static_cast<int>(b.max_x[i] + far > occupied_tx.min.x) &
                   static_cast<int>(b.min_y[i] - far < occupied_tx.max.y) &
                   static_cast<int>(b.max_y[i] + far > occupied_tx.min.y);
        }
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
        constexpr T unit = rounded_up / T(255);
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
