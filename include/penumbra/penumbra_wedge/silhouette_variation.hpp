// How much what silhouettes block can change between neighbouring points.
//
// A part of the light appears or disappears only where a silhouette passes over it. As a point moves, an edge that is
// on the silhouette sweeps its length on the light times its way across itself; edges that are on the silhouette from
// no point of the box sweep nothing. The sum over all others bounds the change, whatever hides behind what.
//
// A vertex at depth z moves on the light's plane by −z / (p − z) for each unit that the point moves across the light's
// axis, and by |where it lands − where it is| / (p − z) for each in depth. So along a long straight edge a point may
// move far, and visibility changes in one direction only. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// Adds up what edges sweep. All in the index's units.
template <class T>
class SweptArea {
  public:
    /// Gives up where edges sweep more than `most` as a point moves from the middle of the tile's box to its farthest
    /// corner.
    SweptArea(const PointTile<T>& tile, T most) : tile_(tile), most_(most) {
        const Vec3<T> half = (tile.box.max - tile.box.min) * T(0.5);
        across_ = std::sqrt(half.x * half.x + half.y * half.y), deep_ = half.z;
    }

    bool begin_piece(const Box3<T>& box, bool simple) {
        simple_ = simple;
        // where masks may be asked for, IntervalBlender's rectangles overlap: these hold those
        const bool beyond = box.max.z >= tile_.box.min.z;
        const Rect2<T> rect = beyond ? tile_.light : intersect(project_box(box, tile_.box), tile_.light);
        for (std::size_t k = 0; k < pieces_ && !overlaps_; ++k) overlaps_ = !is_apart(rect, seen_[k]);
        overlaps_ = overlaps_ || pieces_ == seen_.size();
        if (!overlaps_) seen_[pieces_] = rect;
        ++pieces_;
        return true;
    }
    bool edge(Vec3<T> a, Vec3<T> b, int weight) {
        if (!clip_to_pyramids(a, b)) return true;
        const T room_a = tile_.box.min.z - a.z, room_b = tile_.box.min.z - b.z, room = std::min(room_a, room_b);
        if (!(room > T(4) * deep_)) return false;
        // a fold, or casters that overlap: masks say how much, and masks change by whole cells
        if (!simple_ || overlaps_) return false;
        const Vec2<T> from = seen_from_middle(a), to = seen_from_middle(b), along = to - from;
        const T speed = std::max(a.z / room_a, b.z / room_b);
        const T sinking = std::max(distance(from, a) / room_a, distance(to, b) / room_b);
        // both ends stay within `way` of where they are now, and `sinking` grows by no more than it does
        const T way = (across_ * speed + deep_ * sinking) / (T(1) - deep_ / room), times = static_cast<T>(weight);
        const T length = std::sqrt(along.x * along.x + along.y * along.y);
        const T turn = T(4) * way * speed * times;  // the edge may turn and grow by as much
        turning_ += turn;
        sinking_ += (length + T(2) * way) * (sinking + way / room) * times;
        if (edges_ < across_edges_.size())
            across_edges_[edges_++] = Vec2<T>(-along.y, along.x) * (speed * times);
        else
            turning_ += length * speed * times;
        total_ += length * speed * times + turn;
        return total_ * across_ + sinking_ * deep_ <= most_;
    }

    bool is_exact() const { return !overlaps_ || !(total_ > T(0)); }
    /// Changes as areas on the light.
    Variation<T> result() const {
        if (pieces_ == 0) return Variation<T>::all_lit();
        // the direction in which most of the edges' normals lie
        T xx = T(0), xy = T(0), yy = T(0);
        for (std::size_t e = 0; e < edges_; ++e) {
            const Vec2<T>& n = across_edges_[e];
            xx += n.x * n.x, xy += n.x * n.y, yy += n.y * n.y;
        }
        Variation<T> result;
        result.known = true;
        const T gap = std::sqrt((xx - yy) * (xx - yy) + T(4) * xy * xy);
        const Vec2<T> axis = xx > yy ? Vec2<T>(xx - yy + gap, T(2) * xy) : Vec2<T>(T(2) * xy, yy - xx + gap);
        const T size = std::sqrt(axis.x * axis.x + axis.y * axis.y);
        if (size > T(0)) result.direction = axis / size;
        result.along = result.across = turning_, result.deep = sinking_;
        for (std::size_t e = 0; e < edges_; ++e) {
            const Vec3<T> n = result.turned(Vec3<T>(across_edges_[e].x, across_edges_[e].y, T(0)));
            result.along += std::abs(n.x), result.across += std::abs(n.y);
        }
        return result;
    }

  private:
    static T distance(const Vec2<T>& seen, const Vec3<T>& at) {
        const T x = seen.x - at.x, y = seen.y - at.y;
        return std::sqrt(x * x + y * y);
    }
    Vec2<T> seen_from_middle(const Vec3<T>& at) const {
        const Vec3<T>& p = tile_.center;
        const T m = p.z / (p.z - at.z);
        return Vec2<T>(p.x + (at.x - p.x) * m, p.y + (at.y - p.y) * m);
    }
    /// The part of an edge that some point of the box may see before the light.
    bool clip_to_pyramids(Vec3<T>& a, Vec3<T>& b) const {
        const Vec2<T> half = tile_.light.max;
        const std::array<Vec3<T>, 6> inside = {{Vec3<T>(T(-1), T(0), tile_.right), Vec3<T>(T(1), T(0), -tile_.left),
                                                Vec3<T>(T(0), T(-1), tile_.top), Vec3<T>(T(0), T(1), -tile_.bottom),
                                                Vec3<T>(T(0), T(0), T(1)), Vec3<T>(T(0), T(0), T(-1))}};
        const std::array<T, 6> offset = {{half.x, half.x, half.y, half.y, T(0), tile_.box.max.z}};
        T first = T(0), last = T(1);
        for (std::size_t k = 0; k < inside.size(); ++k) {
            const T at_a = glm::dot(inside[k], a) + offset[k], at_b = glm::dot(inside[k], b) + offset[k];
            if (at_a < T(0) && at_b < T(0)) return false;
            if (at_a < T(0)) first = std::max(first, at_a / (at_a - at_b));
            if (at_b < T(0)) last = std::min(last, at_a / (at_a - at_b));
        }
        constexpr T slack = T(1e-5);  // of rounding
        if (first > last + slack) return false;
        const Vec3<T> way = b - a;
        b = a + way * std::min(last + slack, T(1));
        a = a + way * std::max(first - slack, T(0));
        return true;
    }
    static bool is_apart(const Rect2<T>& a, const Rect2<T>& b) {
        const Rect2<T> both = intersect(a, b);
        return !(both.min.x < both.max.x && both.min.y < both.max.y);
    }

    const PointTile<T>& tile_;
    T most_, across_, deep_;
    T total_ = T(0), turning_ = T(0), sinking_ = T(0);
    bool simple_ = false, overlaps_ = false;
    std::size_t pieces_ = 0, edges_ = 0;
    std::array<Rect2<T>, 16> seen_;
    std::array<Vec2<T>, 64> across_edges_;  ///< perpendicular to an edge, as long as what it sweeps in a unit's way
};

/// For casters seen from a box, all in the index's units; changes for each of these units. Bounds what exact sums
/// change by: unknown where masks would decide, where casters are as near as the box is deep, and where from the box's
/// middle to its corners it is more than `most`. Error: that of the sums.
template <class T>
Variation<T> silhouette_variation(const WedgeIndex<T>& index, const Box3<T>& box, const Vec2<T>& half_size,
                                  T light_area, T most) {
    PointTile<T> tile;
    tile.cover(box, half_size);
    SweptArea<T> swept(tile, most * light_area);
    if (!index.visit_candidates(tile, swept) || !swept.is_exact()) return Variation<T>::unknown();
    Variation<T> result = swept.result();
    const T unit = T(1) / light_area;
    result.along *= unit, result.across *= unit, result.deep *= unit;
    return result;
}

}  // namespace penumbra::detail
