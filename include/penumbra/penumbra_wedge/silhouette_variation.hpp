// How what silhouettes block changes between neighbouring points.
//
// A part of the light appears or disappears only where an edge of the outline passes over it. Let q be where a point of
// an edge lands on the light's plane, seen from (x, y) of the receiver at depth p, r = z / (p − z), and N = (Δy, −Δx)
// of the edge as it lands, which points outwards. As the receiver moves by d across the axis and by e in depth, q moves
// by −r (d + q e / p). N · q is one number along the edge and r is linear, so that the edge sweeps
//     −(r_a + r_b) / 2 · (N · d + (N · q / p) e),
// exactly so across the axis however far, since N · d stays as it is. Of an edge that the whole box sees, and that
// nothing hides, visibility changes with this slope; of one that a border of the light or another silhouette hides in
// part, with some share of it. So the slope is known up to the sum over edges that are in doubt, and over what turns
// and grows as the point comes nearer: all in proportion to the edges' lengths, however many there are. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// What is made of silhouettes that may overlap.
enum class OverlapChange {
    none,   ///< nothing that is known: masks
    sum,    ///< their sum, limited to the light
    outline ///< the area of all together
};

/// Adds up what edges sweep. All in the index's units.
template <class T>
class SweptArea {
  public:
    static constexpr std::size_t most_edges = 256;

    /// Gives up where what is in doubt is more than `most` as a point moves from the middle of the tile's box to its
    /// farthest corner, and where more than most_edges are in sight.
    SweptArea(const PointTile<T>& tile, T most, OverlapChange overlap, bool from_point)
        : tile_(tile), most_(most), overlap_(overlap), from_point_(from_point) {
        const Vec3<T> half = (tile.box.max - tile.box.min) * T(0.5);
        across_ = std::sqrt(half.x * half.x + half.y * half.y), deep_ = half.z;
        const Vec2<T> light = tile.light.max;
        const auto slope = [&](T at, bool largest) {
            return at / ((at > T(0)) == largest ? tile.box.min.z : tile.box.max.z);
        };
        some_ = {tile.right, tile.left, tile.top, tile.bottom};
        all_ = {slope(tile.box.min.x - light.x, false), slope(tile.box.max.x + light.x, true),
                slope(tile.box.min.y - light.y, false), slope(tile.box.max.y + light.y, true)};
    }

    bool begin_piece(const Box3<T>& box, bool simple, bool solid) {
        if (pieces_ < pieces_seen_.size()) {
            // IntervalBlender's rectangles overlap only where these do
            const bool beyond = box.max.z >= tile_.box.min.z;
            const Rect2<T> rect = beyond ? tile_.light : intersect(project_box(box, tile_.box), tile_.light);
            SeenPiece& piece = pieces_seen_[pieces_] = {rect, from_point_ && simple, simple || solid};
            for (std::size_t k = 0; k < pieces_; ++k) {
                if (is_apart(rect, pieces_seen_[k].rect)) continue;
                piece.is_alone = pieces_seen_[k].is_alone = false;
            }
        } else {
            for (SeenPiece& piece : pieces_seen_) piece.is_alone = false;
        }
        ++pieces_;
        return overlap_ != OverlapChange::none || (pieces_ <= pieces_seen_.size() && pieces_seen_[pieces_ - 1].is_alone);
    }

    /// An edge that counts from `least` to `most` times.
    bool edge(Vec3<T> a, Vec3<T> b, int least, int most) {
        if (!clip(a, b, some_, T(1e-5))) return true;
        const T room = tile_.box.min.z - std::max(a.z, b.z);
        if (!(room > T(4) * deep_) || edges_ == most_edges) return false;
        const Sweep whole = sweep(a, b);
        Vec3<T> from = a, to = b;
        const T sure = clip(from, to, all_, T(-1e-5)) ? std::min(sweep(from, to).times / whole.times, T(1)) : T(0);
        SeenEdge& seen = seen_[edges_++];
        seen.slope = whole.slope, seen.sure = sure > T(0) ? sure : T(0);
        seen.least = static_cast<std::int8_t>(least), seen.most = static_cast<std::int8_t>(most);
        seen.piece = static_cast<std::uint16_t>(std::min(pieces_, pieces_seen_.size() + 1) - 1);
        bend(a, b, room, static_cast<T>(std::max(std::abs(least), std::abs(most))));
        const Share share = share_of(seen);
        doubt_ += half_length(share, seen.slope);
        return doubt_ + bending_ * across_ + deep_bending_ * deep_ <= most_;
    }

    /// As areas on the light.
    Variation<T> result() const {
        if (pieces_ == 0) return Variation<T>::all_lit();
        Variation<T> result;
        result.known = true;
        // the direction in which most of what is in doubt moves
        T xx = T(0), xy = T(0), yy = T(0);
        std::array<Vec3<T>, most_edges> doubts;
        for (std::size_t e = 0; e < edges_; ++e) {
            const Share share = share_of(seen_[e]);
            result.slope += seen_[e].slope * share.middle;
            const Vec3<T> d = doubts[e] = seen_[e].slope * share.half;
            xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
        }
        const T gap = std::sqrt((xx - yy) * (xx - yy) + T(4) * xy * xy);
        const Vec2<T> axis = xx > yy ? Vec2<T>(xx - yy + gap, T(2) * xy) : Vec2<T>(T(2) * xy, yy - xx + gap);
        const T size = std::sqrt(axis.x * axis.x + axis.y * axis.y);
        if (size > T(0)) result.direction = axis / size;
        result.along = result.across = bending_, result.deep = deep_bending_;
        for (std::size_t e = 0; e < edges_; ++e) {
            const Vec3<T> d = result.turned(doubts[e]);
            result.along += std::abs(d.x), result.across += std::abs(d.y), result.deep += std::abs(d.z);
        }
        return result;
    }

  private:
    /// Slopes of the sides of pyramids, which stand on the light's borders.
    struct Sides {
        T right, left, top, bottom;
    };
    struct SeenPiece {
        Rect2<T> rect;
        bool is_alone;  ///< covers nothing twice, nor what another piece covers
        bool is_wound_once;  ///< winds around everything in the same sense
    };
    struct SeenEdge {
        Vec3<T> slope;  ///< what it sweeps, per unit, seen from the middle
        T sure;         ///< the share of it that all points have before the light
        std::int8_t least, most;
        std::uint16_t piece;
    };
    struct Sweep {
        Vec3<T> slope;
        T times;  ///< what the slope is in proportion to along an edge
    };
    /// The share of an edge's slope that counts: middle ± half.
    struct Share {
        T middle, half;
    };

    Share share_of(const SeenEdge& edge) const {
        const auto between = [](T low, T high) -> Share { return {(low + high) * T(0.5), (high - low) * T(0.5)}; };
        T low = static_cast<T>(edge.least), high = static_cast<T>(edge.most);
        const bool is_told = edge.piece < pieces_seen_.size();
        if (is_told && pieces_seen_[edge.piece].is_alone)
            return between(low > T(0) ? low * edge.sure : low, high < T(0) ? high * edge.sure : high);
        const T times = std::max(std::abs(low), std::abs(high));
        if (overlap_ != OverlapChange::outline) return {T(0), times};
        if (!from_point_ || !is_told || !pieces_seen_[edge.piece].is_wound_once) return {T(0), T(1)};
        return between(std::max(std::min(low, T(0)), T(-1)), std::min(std::max(high, T(0)), T(1)));
    }
    T half_length(const Share& share, const Vec3<T>& slope) const {
        return share.half *
               (std::sqrt(slope.x * slope.x + slope.y * slope.y) * across_ + std::abs(slope.z) * deep_);
    }

    Sweep sweep(const Vec3<T>& a, const Vec3<T>& b) const {
        const Vec3<T>& p = tile_.center;
        const T ra = a.z / (p.z - a.z), rb = b.z / (p.z - b.z);
        const Vec2<T> from = Vec2<T>(a.x - p.x, a.y - p.y) * (T(1) + ra), to = Vec2<T>(b.x - p.x, b.y - p.y) * (T(1) + rb);
        const Vec2<T> out(to.y - from.y, from.x - to.x);
        const T mean = (ra + rb) * T(0.5);
        return {Vec3<T>(out.x, out.y, (out.x * from.x + out.y * from.y) / p.z) * -mean,
                mean * std::sqrt(out.x * out.x + out.y * out.y)};
    }
    /// By how much the slope may differ anywhere in the box: bounds of r, its change along the edge, the length on the
    /// light and the distance from there, then their derivatives.
    void bend(const Vec3<T>& a, const Vec3<T>& b, T room, T times) {
        const Vec3<T>& p = tile_.center;
        const T least = tile_.box.min.z, z = std::max(a.z, b.z), r = z / room;
        const T room_a = least - a.z, room_b = least - b.z;
        const T uneven = (least + T(2) * deep_) * std::abs(b.z - a.z) / (room_a * room_b);
        const Vec2<T> ab(b.x - a.x, b.y - a.y), pa(a.x - p.x, a.y - p.y), pb(b.x - p.x, b.y - p.y);
        const T span = std::sqrt(ab.x * ab.x + ab.y * ab.y);
        const T away = std::sqrt(std::max(pa.x * pa.x + pa.y * pa.y, pb.x * pb.x + pb.y * pb.y)) + across_;
        const T grown = T(1) + r, reach = away * grown, length = grown * span + uneven * away;
        const T by_depth = r * (length / room + (length * r + reach * uneven) / least);
        bending_ += times * (r * uneven * across_ + by_depth * deep_);
        deep_bending_ += times * (r * grown * grown * span * across_ + T(4) * r * length * reach / room * deep_) / least;
    }

    /// The part of an edge between the sides, `slack` of its length longer at both ends. False if there is none.
    bool clip(Vec3<T>& a, Vec3<T>& b, const Sides& sides, T slack) const {
        const Vec2<T> half = tile_.light.max;
        const std::array<Vec3<T>, 6> inside = {{Vec3<T>(T(-1), T(0), sides.right), Vec3<T>(T(1), T(0), -sides.left),
                                                Vec3<T>(T(0), T(-1), sides.top), Vec3<T>(T(0), T(1), -sides.bottom),
                                                Vec3<T>(T(0), T(0), T(1)), Vec3<T>(T(0), T(0), T(-1))}};
        const std::array<T, 6> offset = {{half.x, half.x, half.y, half.y, T(0), tile_.box.max.z}};
        T first = T(0), last = T(1);
        for (std::size_t k = 0; k < inside.size(); ++k) {
            const T at_a = glm::dot(inside[k], a) + offset[k], at_b = glm::dot(inside[k], b) + offset[k];
            if (at_a < T(0) && at_b < T(0)) return false;
            if (at_a < T(0)) first = std::max(first, at_a / (at_a - at_b));
            if (at_b < T(0)) last = std::min(last, at_a / (at_a - at_b));
        }
        first -= slack, last += slack;
        if (!(first < last)) return false;
        const Vec3<T> from = a, way = b - a;
        a = from + way * std::max(first, T(0));
        b = from + way * std::min(last, T(1));
        return true;
    }
    static bool is_apart(const Rect2<T>& a, const Rect2<T>& b) {
        const Rect2<T> both = intersect(a, b);
        return !(both.min.x < both.max.x && both.min.y < both.max.y);
    }

    const PointTile<T>& tile_;
    T most_, across_, deep_;
    OverlapChange overlap_;
    bool from_point_;
    Sides some_, all_;
    T doubt_ = T(0), bending_ = T(0), deep_bending_ = T(0);
    std::size_t pieces_ = 0, edges_ = 0;
    std::array<SeenPiece, 32> pieces_seen_;
    std::array<SeenEdge, most_edges> seen_;
};

/// For casters seen from a box, all in the index's units; changes for each of these units. Unknown where masks would
/// decide, where casters are as near as the box is deep, and where from the box's middle to its corners more than `most`
/// is in doubt. Error: that of the sums.
template <class T>
Variation<T> silhouette_variation(const WedgeIndex<T>& index, const Box3<T>& box, const Vec2<T>& half_size,
                                  T light_area, T most, OverlapChange overlap) {
    PointTile<T> tile;
    tile.cover(box, half_size);
    SweptArea<T> swept(tile, most * light_area, overlap, index.silhouette() == SilhouetteFrom::point);
    if (!index.visit_candidates(tile, swept)) return Variation<T>::unknown();
    Variation<T> result = swept.result();
    const T unit = T(1) / light_area;
    result.along *= unit, result.across *= unit, result.deep *= unit;
    result.slope *= -unit;  // of what is visible
    return result;
}

}  // namespace penumbra::detail
