// Depths and visibility channels of all maps of a light, as queries read them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/image.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/soft_shadow_map/visibility_map.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// A texel of a map: the depth beyond which its ray is blocked, and how much its surface sees of the light between the
/// map and the one before, and the one after.
template <class T>
struct LightMapTexel {
    T depth, before, after;
};

/// What edges hide of these two parts, where that is neither nothing nor all.
template <class T>
struct LightMapEdges {
    RowPoint<T> before, after;
};

/// Maps in the order of their positions. Looked up from any number of threads.
template <class T>
class SkinMaps {
  public:
    SkinMaps() = default;
    /// Of two maps or more of one view. Without skins (LinearMode::hard) each map that sees a point adds its part.
    SkinMaps(const LightMapView<T>& view, const std::vector<const LightMap<T>*>& maps, LinearMode mode,
             SkinTransition transition, StepDetector detector, T step)
        : view_(view), hard_(mode == LinearMode::hard) {
        const T length = maps.back()->position - maps.front()->position;
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const LightMap<T>& map = *maps[i];
            positions_.push_back(map.position);
            if (i > 0)
                weights_.push_back(length > T(0) ? (map.position - maps[i - 1]->position) / length
                                                 : T(1) / static_cast<T>(maps.size() - 1));
            VisibilityChannel<T> before, after;
            if (!hard_ && i > 0) before = visibility_channel(view, *maps[i - 1], map, transition, detector, step);
            if (!hard_ && i + 1 < maps.size())
                after = visibility_channel(view, *maps[i + 1], map, transition, detector, step);
            add(map.blocked, before, after);
            if (!hard_ && transition == SkinTransition::exact) add_edges(before.edges, after.edges);
        }
    }

    const LightMapView<T>& view() const { return view_; }
    int count() const { return static_cast<int>(positions_.size()); }
    T position(int map) const { return positions_[static_cast<std::size_t>(map)]; }
    const Image<LightMapTexel<T>>& texels(int map) const { return texels_[static_cast<std::size_t>(map)]; }
    /// Empty unless transitions are exact.
    const Image<LightMapEdges<T>>& edges(int map) const { return edges_[static_cast<std::size_t>(map)]; }
    bool has_edges() const { return !edges_.empty(); }
    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const auto& map : texels_) sum += map.size() * sizeof(LightMapTexel<T>);
        for (const auto& map : edges_) sum += map.size() * sizeof(LightMapEdges<T>);
        return sum;
    }

    /// The fraction of the light, from the first map to the last, that a point in light space at depth > 0 sees. 1
    /// outside of the image.
    T visibility(const Vec3<T>& point_ls) const {
        const RowPoint<T> point{point_ls.x / point_ls.z, T(1) / point_ls.z};
        const T row = view_.row(point_ls.y / point_ls.z), size = static_cast<T>(view_.resolution);
        if (!(row >= T(0) && row < size)) return T(1);
        const int y = static_cast<int>(row);
        detail::SeenParts<T> parts;
        T earlier = T(0);
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const T column = view_.column(slope_from(point, positions_[i]));
            LightMapTexel<T> texel{LightMap<T>::none, T(1), T(1)};
            if (column >= T(0) && column < size) texel = texels_[i](static_cast<int>(column), y);
            const bool sees = !(point_ls.z > texel.depth);
            T before = sees ? texel.before : T(0), after = sees ? texel.after : T(0);
            if (has_edges() && (is_part(before) || is_part(after))) {
                const LightMapEdges<T>& edge = edges_[i](static_cast<int>(column), y);
                if (is_part(before)) before = edge_visibility(edge.before, point, positions_[i - 1], positions_[i]);
                if (is_part(after)) after = edge_visibility(edge.after, point, positions_[i + 1], positions_[i]);
            }
            const T both = earlier + before;
            if (i > 0) parts.add(weights_[i - 1], hard_ ? T(0.5) * both : std::min(T(1), both));
            earlier = after;
        }
        return parts.mean();
    }

  private:
    static bool is_part(T visible) { return visible > T(0) && visible < T(1); }

    void add(const Image<T>& depths, const VisibilityChannel<T>& before, const VisibilityChannel<T>& after) {
        Image<LightMapTexel<T>> texels(view_.resolution, view_.resolution);
        for (std::size_t k = 0; k < texels.size(); ++k)
            texels.data()[k] = {depths.data()[k], before.visible.empty() ? T(1) : before.visible.data()[k],
                                after.visible.empty() ? T(1) : after.visible.data()[k]};
        texels_.push_back(std::move(texels));
    }
    void add_edges(const Image<RowPoint<T>>& before, const Image<RowPoint<T>>& after) {
        Image<LightMapEdges<T>> edges(view_.resolution, view_.resolution);
        for (std::size_t k = 0; k < edges.size(); ++k)
            edges.data()[k] = {before.empty() ? RowPoint<T>{} : before.data()[k],
                               after.empty() ? RowPoint<T>{} : after.data()[k]};
        edges_.push_back(std::move(edges));
    }

    LightMapView<T> view_;
    bool hard_ = false;
    std::vector<T> positions_, weights_;
    std::vector<Image<LightMapTexel<T>>> texels_;
    std::vector<Image<LightMapEdges<T>>> edges_;
};

}  // namespace penumbra
