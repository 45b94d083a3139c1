// How the segments of a row are found in the maps of a light.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <penumbra/soft_shadow_map/row_segments.hpp>
#include <vector>

namespace penumbra::detail {

template <class T>
class RowSegmentFinder {
  public:
    RowSegmentFinder(const LightMapView<T>& view, T step)
        : view_(view), step_(step), seen_(static_cast<std::size_t>(view.resolution)) {}

    /// Of what the maps see in row y.
    const std::vector<RowSegment<T>>& find(const std::vector<const LightMap<T>*>& maps, int y) {
        found_.clear(), shifted_.clear();
        for (const LightMap<T>* map : maps) {
            mark_seen(*map, y);
            for (const LightMap<T>* other : {maps.front(), maps.back()})
                if (other != map) mark_better_seen(*map, *other, y);
            for (int first = 0; first < view_.resolution;) {
                const int end = end_of_run(*map, first, y);
                add_new(*map, y, first, end);
                first = std::max(end, first + 1);
            }
        }
        return shifted_;
    }

  private:
    static constexpr double tolerance = 5e-4;     // of inverse depths, between a run and its segments
    static constexpr double same_surface = 2e-3;  // of inverse depths, between what two maps see

    bool is_seen(int x) const { return seen_[static_cast<std::size_t>(x)] != 0; }
    static T inverse(const LightMap<T>& map, int x, int y) { return LightMap<T>::inverse(map.caster(x, y)); }

    /// Which texels show what was found in maps before.
    void mark_seen(const LightMap<T>& map, int y) {
        std::fill(seen_.begin(), seen_.end(), char(0));
        const T size = static_cast<T>(view_.resolution);
        for (const RowSegment<T>& segment : found_) {
            const T at_a = view_.column(slope_from(segment.a, map.position));
            const T at_b = view_.column(slope_from(segment.b, map.position));
            const T low = std::min(at_a, at_b), high = std::max(at_a, at_b);
            const T bend = high > low ? (segment.b.inverse_depth - segment.a.inverse_depth) / (at_b - at_a) : T(0);
            const int first = static_cast<int>(std::ceil(clamp(low - T(0.5), T(0), size)));
            for (int x = first; x < view_.resolution && static_cast<T>(x) + T(0.5) <= high; ++x) {
                const T here = inverse(map, x, y);
                const T there = segment.a.inverse_depth + bend * (static_cast<T>(x) + T(0.5) - at_a);
                const T most = static_cast<T>(same_surface) * here + std::abs(bend);
                if (std::abs(there - here) <= most) seen_[static_cast<std::size_t>(x)] = 1;
            }
        }
    }

    /// Which texels the other map sees less obliquely: there are more of them there.
    void mark_better_seen(const LightMap<T>& map, const LightMap<T>& other, int y) {
        for (int x = 0; x < view_.resolution; ++x) {
            const T here = inverse(map, x, y), bend = std::abs(map.bend(x, y));
            if (!(here > T(0)) || !(bend > T(0))) continue;
            const T slope = view_.column_slope(static_cast<T>(x) + T(0.5)) + (map.position - other.position) * here;
            const T column = view_.column(slope);
            if (!(column >= T(0) && column < static_cast<T>(view_.resolution))) continue;
            const int at = static_cast<int>(column);
            const T there = inverse(other, at, y), other_bend = std::abs(other.bend(at, y));
            const bool same = std::abs(there - here) <= static_cast<T>(same_surface) * here + other_bend;
            if (same && other_bend < T(0.7) * bend) seen_[static_cast<std::size_t>(x)] = 1;
        }
    }

    /// One past the last texel of the surface that texel `first` shows; `first` where it shows none. Surfaces go on
    /// where inverse depth changes by as much as their planes say, or by less than `step`.
    int end_of_run(const LightMap<T>& map, int first, int y) const {
        constexpr T none = LightMap<T>::none;
        if (!(map.caster(first, y) < none)) return first;
        int end = first + 1;
        for (; end < view_.resolution && map.caster(end, y) < none; ++end) {
            if (std::abs(map.caster(end, y) - map.caster(end - 1, y)) <= step_) continue;
            const T change = inverse(map, end, y) - inverse(map, end - 1, y);
            const T left = map.bend(end - 1, y), right = map.bend(end, y);
            const T most = T(0.25) * std::max(std::abs(left), std::abs(right));
            if (change < std::min(left, right) - most || change > std::max(left, right) + most) break;
        }
        return end;
    }

    /// The parts of a run that are new, joined to what is known. A single texel beside what is known is but its border,
    /// seen to fall to the other side of a texel's centre.
    void add_new(const LightMap<T>& map, int y, int first, int end) {
        for (int from = first; from < end;) {
            if (is_seen(from)) {
                ++from;
                continue;
            }
            int to = from + 1;
            while (to < end && !is_seen(to)) ++to;
            const bool joins_before = from > first, joins_after = to < end;
            if (to - from > 1 || (!joins_before && !joins_after))
                add_run(map, y, joins_before ? from - 1 : from, joins_after ? to + 1 : to);
            from = to;
        }
    }

    /// A point of a run as it is, and by how much its inverse depth is taken less, so that it does not hide itself.
    struct Vertex {
        T column;
        RowPoint<T> point;
        T slack;

        RowPoint<T> shifted() const {
            return {point.slope, point.inverse_depth * (T(1) - static_cast<T>(tolerance)) - slack};
        }
    };

    void add_run(const LightMap<T>& map, int y, int first, int end) {
        vertices_.clear();
        const auto add = [&](T column, T inverse_depth, int x) {
            const T slope = view_.column_slope(column) + map.position * inverse_depth;
            vertices_.push_back({column, {slope, inverse_depth}, map.slack(x, y)});
        };
        const int last = end - 1;
        add(static_cast<T>(first), inverse(map, first, y) - T(0.5) * map.bend(first, y), first);
        for (int x = first; x < end; ++x) add(static_cast<T>(x) + T(0.5), inverse(map, x, y), x);
        add(static_cast<T>(end), inverse(map, last, y) + T(0.5) * map.bend(last, y), last);
        add_segments();
    }

    /// Few segments along the vertices: each as far as it passes all between, which bound its direction.
    void add_segments() {
        for (std::size_t from = 0; from + 1 < vertices_.size();) {
            T lowest = T(0), highest = T(0);
            std::size_t to = from + 1;
            for (std::size_t next = to; next < vertices_.size(); ++next) {
                const T away = vertices_[next].column - vertices_[from].column;
                const T change = vertices_[next].point.inverse_depth - vertices_[from].point.inverse_depth;
                const T most = static_cast<T>(tolerance) * vertices_[next].point.inverse_depth;
                const T low = (change - most) / away, high = (change + most) / away;
                const bool is_first = next == from + 1;
                if (!is_first && (change < lowest * away || change > highest * away)) break;
                lowest = is_first ? low : std::max(lowest, low), highest = is_first ? high : std::min(highest, high);
                to = next;
            }
            found_.push_back({vertices_[from].point, vertices_[to].point});
            shifted_.push_back({vertices_[from].shifted(), vertices_[to].shifted()});
            from = to;
        }
    }

    const LightMapView<T>& view_;
    T step_;
    std::vector<RowSegment<T>> found_, shifted_;
    std::vector<Vertex> vertices_;
    std::vector<char> seen_;
};

}  // namespace penumbra::detail
