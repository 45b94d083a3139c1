// Where maps say for sure that all of a light is seen, or nothing of it: of D-buffers and soft shadow maps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/plan/known_depths.hpp>
#include <penumbra/soft_shadow_map/options.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>
#include <penumbra/soft_shadow_map/shadow.hpp>
#include <penumbra/soft_shadow_map/skin_maps.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// Texels along a side of a square, as a power of two.
inline constexpr int known_shift = 2;

/// Points before the first penumbra are lit; those in an umbra dark.
template <class T>
KnownPlaces<T> known_places(const DBuffer<T>& buffer) {
    KnownPlaces<T> places;
    if (buffer.empty()) return places;
    const DBufferView<T>& view = buffer.view();
    places.slopes = view.slopes, places.resolution = view.resolution;
    places.by_distance = view.depth == DBufferDepth::euclidean;
    KnownDepthPyramid<T> depths(view.resolution, known_shift);
    for (int y = 0; y < view.resolution; ++y)
        for (int x = 0; x < view.resolution; ++x) {
            const T caster = buffer.caster(x, y);
            depths.around(x, y).join(
                {std::min(caster, buffer.penumbra(x, y, 0).depth), caster, buffer.umbra(x, y, 0).depth});
        }
    depths.finish();
    places.maps.push_back({T(0), std::move(depths)});
    return places;
}

/// Points are lit that all maps see, and not past a skin; those dark that none sees.
template <class T>
KnownPlaces<T> known_places(const SkinMaps<T>& maps) {
    constexpr T rounding = T(1) - T(8) * std::numeric_limits<T>::epsilon();
    KnownPlaces<T> places;
    places.slopes = maps.view().slopes, places.resolution = maps.view().resolution;
    for (int i = 0; i < maps.count(); ++i) {
        KnownDepthPyramid<T> depths(places.resolution, known_shift);
        const auto past = [&](T visible, const RowPoint<T>& edge) {  // up to where a skin hides nothing
            if (visible >= T(1)) return std::numeric_limits<T>::max();
            return visible > T(0) && edge.inverse_depth > T(0) ? rounding / edge.inverse_depth : T(0);
        };
        for (int y = 0; y < places.resolution; ++y)
            for (int x = 0; x < places.resolution; ++x) {
                const LightMapTexel<T>& texel = maps.texels(i)(x, y);
                T lit = texel.depth;
                if (texel.before < T(1) || texel.after < T(1)) {
                    const LightMapEdges<T> edges = maps.has_edges() ? maps.edges(i)(x, y) : LightMapEdges<T>{};
                    lit = std::min({lit, past(texel.before, edges.before), past(texel.after, edges.after)});
                }
                depths.around(x, y).join({lit, texel.depth, std::numeric_limits<T>::max()});
            }
        depths.finish();
        places.maps.push_back({maps.position(i), std::move(depths)});
    }
    return places;
}

/// Up to which inverse depth some rows' segments may hide the light from a point, by squares of slopes. With (slope,
/// inverse depth) = (s, w), a point has one of (s', w') before the light of half length h only if |s − s'| ≤ h (w' −
/// w).
template <class T>
class SegmentWedges {
  public:
    SegmentWedges(const RowSegments<T>& rows, int squares, T width)
        : first_(rows.view().slopes.min.x),
          width_(width),
          half_length_(std::max(std::abs(rows.first()), std::abs(rows.last()))),
          segments_(static_cast<std::size_t>(squares)),
          wedges_(segments_.size()) {}

    void clear() { std::fill(segments_.begin(), segments_.end(), T(0)); }
    void add(const RowSegment<T>& segment) {
        const bool ascends = segment.a.slope < segment.b.slope;
        const RowPoint<T>&a = ascends ? segment.a : segment.b, &b = ascends ? segment.b : segment.a;
        const T farther = std::abs(a.inverse_depth) + std::abs(b.inverse_depth);
        const T reach = std::abs(a.slope) + std::abs(b.slope) + std::abs(first_) + half_length_ * farther;
        const T margin = slack * reach, most = std::max(a.inverse_depth, b.inverse_depth);
        const T bend = safe_ratio(b.inverse_depth - a.inverse_depth, b.slope - a.slope, T(0));
        const std::size_t begin = square(a.slope - margin), last = square(b.slope + margin);
        for (std::size_t i = begin; i <= last; ++i) {
            T nearest = most;
            if (i > begin && i < last) {
                const T from = first_ + width_ * static_cast<T>(i) - a.slope;
                const T rise = std::max(bend * (from - margin), bend * (from + width_ + margin));
                nearest = std::min(most, a.inverse_depth + rise + slack * farther);
            }
            segments_[i] = std::max(segments_[i], nearest);
        }
    }
    /// Of each square, once all segments are added.
    const std::vector<T>& spread() {
        constexpr T far = std::numeric_limits<T>::max();
        const T drop = half_length_ > T(0) ? width_ * (T(1) - slack) / half_length_ : far;
        T left = T(0), right = T(0);  // at the square's sides
        wedges_ = segments_;
        for (std::size_t i = 0, k = segments_.size() - 1; i < segments_.size(); ++i, --k) {
            wedges_[i] = std::max(wedges_[i], left), left = std::max(left - drop, segments_[i]);
            wedges_[k] = std::max(wedges_[k], right), right = std::max(right - drop, segments_[k]);
        }
        return wedges_;
    }

  private:
    static constexpr T slack = T(16) * std::numeric_limits<T>::epsilon();

    std::size_t square(T slope) const {
        return static_cast<std::size_t>(clamp((slope - first_) / width_, T(0), static_cast<T>(segments_.size() - 1)));
    }

    T first_, width_, half_length_;
    std::vector<T> segments_, wedges_;
};

/// Points are lit that lie in no segment's wedge.
template <class T>
KnownPlaces<T> known_places(const RowSegments<T>& rows) {
    constexpr T far = std::numeric_limits<T>::max(), nothing = T(4) * std::numeric_limits<T>::min();
    const LightMapView<T>& view = rows.view();
    KnownPlaces<T> places;
    places.slopes = view.slopes, places.resolution = view.resolution;
    // points are settled on segments up to a column away, and farther by up to two rows
    const Vec2<T> texel = extent(view.slopes) / static_cast<T>(view.resolution);
    const T settled = std::max(T(1) - T(2) * texel.y - T(16) * std::numeric_limits<T>::epsilon(), T(0));
    places.spread_tx = T(1), places.has_sides = false;
    KnownDepthPyramid<T> depths(view.resolution, known_shift);
    const int squares = depths.squares_a_side(), many = 1 << known_shift;
    SegmentWedges<T> wedges(rows, squares, texel.x * static_cast<T>(many));
    for (int y = 0; y < squares; ++y) {
        wedges.clear();
        const int end = std::min((y + 1) * many, view.resolution);
        for (std::size_t i = rows.starts()[static_cast<std::size_t>(y * many)];
             i < rows.starts()[static_cast<std::size_t>(end)]; ++i)
            wedges.add(rows.segments()[i]);
        const std::vector<T>& inverse = wedges.spread();
        for (int x = 0; x < squares; ++x) {
            const T w = inverse[static_cast<std::size_t>(x)];
            depths.square(x, y) = {w > nothing ? settled / w : far, far, T(0)};  // where it is dark is not known
        }
    }
    depths.finish();
    places.maps.push_back({T(0), std::move(depths)});
    return places;
}

template <class T>
KnownPlaces<T> known_places(const SoftShadowMap<T>& shadow) {
    if (shadow.view().empty()) return {};
    const LinearMode mode = shadow.options().mode;
    const bool is_exact = mode == LinearMode::intervals || mode == LinearMode::interval_mask;
    return is_exact ? known_places(shadow.segments()) : known_places(shadow.maps());
}

}  // namespace penumbra::detail
