// From the edges that an index hands out to what all silhouettes block together: a visitor for each kind of rule.
#pragma once

#include <array>
#include <cstddef>
#include <penumbra/combine.hpp>
#include <penumbra/penumbra_wedge/mask_blending.hpp>
#include <penumbra/penumbra_wedge/options.hpp>
#include <penumbra/penumbra_wedge/overlap.hpp>
#include <penumbra/penumbra_wedge/radial_part.hpp>
#include <penumbra/penumbra_wedge/tile_sums.hpp>
#include <penumbra/penumbra_wedge/union_blending.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>
#include <tuple>
#include <type_traits>
#include <utility>

namespace penumbra::detail {

template <class T>
std::array<Rect2<T>, 4> quadrants(const Rect2<T>& light) {
    return {{quadrant(light, 0), quadrant(light, 1), quadrant(light, 2), quadrant(light, 3)}};
}
template <class T>
std::array<RectShape<T>, 4> quadrant_shapes(const Rect2<T>& light) {
    const std::array<Rect2<T>, 4> q = quadrants(light);
    return {{{q[0]}, {q[1]}, {q[2]}, {q[3]}}};
}

/// The rules that need only what each mesh blocks: of the whole light, or of each of its parts, which are of one size.
template <class T, class Shape, std::size_t Parts>
class AreaBlender {
  public:
    AreaBlender(const PointTile<T>& tile, const std::array<Shape, Parts>& parts) : sums_{tile, parts, {}} {}

    void begin_mesh() { sums_.clear(); }
    void begin_piece(const Box3<T>&, bool) {}
    void edges(const TileEdge<T>& e) { sums_.edges(e); }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T c) { sums_.edge(lane, from, to, c); }
    void end_piece() {}
    void end_mesh() {
        for (std::size_t p = 0; p < Parts; ++p) {
            const T unit = T(1) / sums_.shapes[p].area();
            for (std::size_t i = 0; i < sums_.tile.count; ++i)
                all_[p][i].add(saturate(settle(sums_.areas[p][i] * unit)));
        }
    }
    void result(Combination rule, T* occlusion) const {
        for (std::size_t i = 0; i < sums_.tile.count; ++i) {
            T sum = T(0);
            for (std::size_t p = 0; p < Parts; ++p) sum += all_[p][i].result(rule);
            occlusion[i] = sum / static_cast<T>(Parts);
        }
    }

  private:
    AreaSums<T, Shape, Parts> sums_;
    std::array<std::array<OcclusionAccumulator<T>, PointTile<T>::capacity>, Parts> all_{};
};

template <class Value, std::size_t... I>
std::array<Value, sizeof...(I)> repeated(const Value& value, std::index_sequence<I...>) {
    return {{(static_cast<void>(I), value)...}};
}

/// The rules that keep rectangles. `Blended` takes what one mesh after the other blocks of a quadrant with add(), and
/// has the area() of all.
template <class T, class Blended>
class RectangleBlender {
  public:
    explicit RectangleBlender(const PointTile<T>& tile)
        : tile_(tile),
          quadrants_(quadrants(tile.light)),
          builders_{{empty(quadrants_[0]), empty(quadrants_[1]), empty(quadrants_[2]), empty(quadrants_[3])}} {}

    void begin_mesh() {
        for (std::size_t q = 0; q < 4; ++q) builders_[q].fill(RadialPartBuilder<T>(quadrants_[q]));
    }
    void begin_piece(const Box3<T>&, bool) {}
    void edges(const TileEdge<T>& e) {
        for (std::size_t i = 0; i < tile_.count; ++i)
            if (e.coefficient[i] != T(0))
                edge(i, Vec2<T>(e.ax[i], e.ay[i]), Vec2<T>(e.bx[i], e.by[i]), e.coefficient[i]);
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        for (Builders& builders : builders_) builders[lane].add(from, to, static_cast<int>(coefficient));
    }
    void end_piece() {}
    void end_mesh() {
        for (std::size_t q = 0; q < 4; ++q)
            for (std::size_t i = 0; i < tile_.count; ++i) blended_[q][i].add(builders_[q][i].finish());
    }
    void result(T* occlusion) const {
        for (std::size_t i = 0; i < tile_.count; ++i) {
            T sum = T(0);
            for (std::size_t q = 0; q < 4; ++q) sum += blended_[q][i].area();
            occlusion[i] = saturate(settle(T(0.25) * sum));
        }
    }

  private:
    using Builders = std::array<RadialPartBuilder<T>, PointTile<T>::capacity>;
    static Builders empty(const Rect2<T>& quadrant) {
        return repeated(RadialPartBuilder<T>(quadrant), std::make_index_sequence<PointTile<T>::capacity>());
    }

    const PointTile<T>& tile_;
    std::array<Rect2<T>, 4> quadrants_;
    std::array<Builders, 4> builders_;
    std::array<std::array<Blended, PointTile<T>::capacity>, 4> blended_{};
};

/// blend() of one mesh after the other: the paper.
template <class T>
struct SequentialBlend {
    RadialPart<T> all = empty_part<T>();
    void add(const RadialPart<T>& part) { all = blend(all, part); }
    T area() const { return all.area; }
};

/// blend_centroid() likewise: its future work.
template <class T>
struct CentroidBlend {
    RadialPart<T> all = empty_part<T>();
    void add(const RadialPart<T>& part) { all = blend_centroid(all, part); }
    T area() const { return all.area; }
};

/// Fills in what all casters together block of the light from each point of a tile, in [0, 1]. May give up as
/// WedgeIndex::visit does; returns whether it did not.
template <class T>
bool blend(const WedgeIndex<T>& index, const PointTile<T>& tile, const PenumbraWedgeOptions& options, bool may_give_up,
           T* occlusion) {
    const auto by_areas = [&](const auto& parts, Combination rule) {
        AreaBlender<T, RectShape<T>, std::tuple_size<std::decay_t<decltype(parts)>>::value> blender(tile, parts);
        const bool all = index.visit(tile, blender, may_give_up);
        if (all) blender.result(rule, occlusion);
        return all;
    };
    const auto by_rectangles = [&](auto&& blender) {
        const bool all = index.visit(tile, blender, may_give_up);
        if (all) blender.result(occlusion);
        return all;
    };
    const RectShape<T> light{tile.light};
    const std::array<RectShape<T>, 1> whole = {{light}};
    switch (options.overlap) {
        case OverlapRule::additive:
            return by_areas(whole, Combination::sum);
        case OverlapRule::maximum:
            return by_areas(whole, Combination::max);
        case OverlapRule::product:
            return by_areas(whole, Combination::product);
        case OverlapRule::product_quadrants:
            return by_areas(quadrant_shapes(tile.light), Combination::product);
        case OverlapRule::rectangles:
            return by_rectangles(RectangleBlender<T, SequentialBlend<T>>(tile));
        case OverlapRule::rectangles_centroid:
            return by_rectangles(RectangleBlender<T, CentroidBlend<T>>(tile));
        case OverlapRule::rectangle_product:
            return by_rectangles(RectangleBlender<T, RectangleProduct<T>>(tile));
        case OverlapRule::bitmask:
            return blend_by_masks(index, tile, light, options.bitmask_size, static_cast<T>(options.tolerance),
                                  may_give_up, occlusion);
        case OverlapRule::exact:
            break;
    }
    return blend_exactly(index, tile, light, options.bitmask_size, static_cast<T>(options.tolerance), may_give_up,
                         occlusion);
}

}  // namespace penumbra::detail
