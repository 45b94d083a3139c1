// What maps see of casters as straight segments in the planes through the light: what the exact mode asks.
//
// Neighbouring texels of one surface are a run, which goes half a texel beyond them on both sides, and as few segments
// as stay within 1/2000 of its inverse depths. Of what several maps see, the first map's is kept, so that borders that
// fall to either side of a texel's centre in different maps do not grow. Segments lie as far behind their surfaces as
// these may differ from them in the row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <penumbra/soft_shadow_map/light_interval.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <vector>

namespace penumbra {

template <class T>
struct RowSegment {
    RowPoint<T> a, b;
};

/// False if a segment surely hides nothing from `point` of a light between `first` and `last`: the plain test, without
/// a division, before hidden_interval.
template <class T>
bool may_hide(const RowSegment<T>& segment, const RowPoint<T>& point, T first, T last) {
    const RowPoint<T>&a = segment.a, &b = segment.b;
    const T nearer = (a.inverse_depth > b.inverse_depth ? a.inverse_depth : b.inverse_depth) - point.inverse_depth;
    if (!(nearer > T(0))) return false;
    const T low = (a.slope < b.slope ? a.slope : b.slope) - point.slope;
    const T high = (a.slope < b.slope ? b.slope : a.slope) - point.slope;
    return low <= (last > T(0) ? last * nearer : T(0)) && high >= (first < T(0) ? first * nearer : T(0));
}

/// True if a point is behind a segment, as the light's centre sees it, by at most `slack` of inverse depth.
template <class T>
bool is_just_behind(const RowSegment<T>& segment, const RowPoint<T>& point, T slack) {
    const RowPoint<T>&a = segment.a, &b = segment.b;
    const T share = safe_ratio(point.slope - a.slope, b.slope - a.slope, T(-1));
    if (!(share >= T(0) && share <= T(1))) return false;
    const T behind = mix(a.inverse_depth, b.inverse_depth, share) - point.inverse_depth;
    return behind >= T(0) && behind <= slack;
}

namespace detail {
template <class T>
class RowSegmentFinder;
}  // namespace detail

/// The segments of all rows. Looked up from any number of threads.
template <class T>
class RowSegments {
  public:
    RowSegments() = default;
    /// Of what maps of one view see, in the order of their positions, of which the first and the last are the light's
    /// ends. `step`, world units, is the least between two surfaces.
    RowSegments(const LightMapView<T>& view, const std::vector<const LightMap<T>*>& maps, T step)
        : view_(view), first_(maps.front()->position), last_(maps.back()->position) {
        detail::RowSegmentFinder<T> finder(view, step);
        for (int y = 0; y < view.resolution; ++y) {
            starts_.push_back(static_cast<std::uint32_t>(segments_.size()));
            const std::vector<RowSegment<T>>& found = finder.find(maps, y);
            segments_.insert(segments_.end(), found.begin(), found.end());
        }
        starts_.push_back(static_cast<std::uint32_t>(segments_.size()));
    }

    const LightMapView<T>& view() const { return view_; }
    /// The light's ends, from its centre, world units.
    T first() const { return first_; }
    T last() const { return last_; }
    /// All segments, row by row; row y has those from starts()[y] up to starts()[y + 1].
    const std::vector<RowSegment<T>>& segments() const { return segments_; }
    const std::vector<std::uint32_t>& starts() const { return starts_; }
    std::size_t bytes() const {
        return segments_.size() * sizeof(RowSegment<T>) + starts_.size() * sizeof(std::uint32_t);
    }

    /// The fraction of the light that a point in light space at depth > 0 sees, as 1 less what `Hidden`, a LightUnion
    /// or a LightMask, makes of all segments in the point's row. 1 outside of the image.
    template <class Hidden>
    T visibility(const Vec3<T>& point_ls) const {
        const T row = view_.row(point_ls.y / point_ls.z);
        if (!(row >= T(0) && row < static_cast<T>(view_.resolution))) return T(1);
        const auto y = static_cast<std::size_t>(row);
        RowPoint<T> point{point_ls.x / point_ls.z, T(1) / point_ls.z};
        const std::size_t own = settle(point, starts_[y], starts_[y + 1]);
        const T slack =
            (view_.slopes.max.y - view_.slopes.min.y) / static_cast<T>(view_.resolution) * point.inverse_depth;
        Hidden hidden;
        for (std::size_t i = starts_[y]; i < starts_[y + 1]; ++i) {
            if (i == own || !may_hide(segments_[i], point, first_, last_)) continue;
            if (is_just_behind(segments_[i], point, slack)) continue;  // its own surface once more, from another map
            hidden.add(hidden_interval(segments_[i].a, segments_[i].b, point, first_, last_));
            if (hidden.is_full()) return T(0);
        }
        return T(1) - hidden.share();
    }
    T visibility(const Vec3<T>& point_ls) const { return visibility<LightUnion<T>>(point_ls); }

  private:
    /// Puts a point on the nearest segment and says which, if it is nearer than a column's width along the row, and in
    /// depth than what a surface at 63° to the image changes by from row to row; the end of the row if there is none.
    /// What is but a little below its own surface in the row's middle would be hidden by it.
    std::size_t settle(RowPoint<T>& point, std::size_t first, std::size_t end) const {
        const Vec2<T> texel = extent(view_.slopes) / static_cast<T>(view_.resolution);
        const Vec2<T> unit(T(1) / texel.x, T(0.5) / (texel.y * point.inverse_depth));
        std::size_t nearest = end;
        T least = T(1);
        RowPoint<T> settled = point;
        for (std::size_t i = first; i < end; ++i) {
            const RowPoint<T>&a = segments_[i].a, &b = segments_[i].b;
            if (std::min(a.slope, b.slope) > point.slope + texel.x ||
                std::max(a.slope, b.slope) < point.slope - texel.x)
                continue;
            const Vec2<T> along = Vec2<T>(b.slope - a.slope, b.inverse_depth - a.inverse_depth) * unit;
            const Vec2<T> to = Vec2<T>(point.slope - a.slope, point.inverse_depth - a.inverse_depth) * unit;
            const T share = clamp(saturated_ratio(glm::dot(to, along), glm::dot(along, along)), T(0.02), T(0.98));
            Vec2<T> away = to - along * share;
            away.y *= away.y < T(0) ? T(2) : T(1);
            const T distance = glm::dot(away, away);
            if (!(distance < least)) continue;
            least = distance, nearest = i;
            settled = {mix(a.slope, b.slope, share), mix(a.inverse_depth, b.inverse_depth, share)};
        }
        point = settled;
        return nearest;
    }

    LightMapView<T> view_;
    T first_{}, last_{};
    std::vector<RowSegment<T>> segments_;
    std::vector<std::uint32_t> starts_;
};

}  // namespace penumbra

#include <penumbra/soft_shadow_map/row_segment_finder.hpp>  // what the constructor does
