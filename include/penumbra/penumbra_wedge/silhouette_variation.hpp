// How what silhouettes block changes between neighbouring points.
//
// A part of the light appears or disappears only where an edge of the outline passes over it. Of an edge that the whole
// box sees, and that nothing hides, visibility changes with the slope of what it sweeps; of one that a border of the
// light or another silhouette hides in part, with some share of that. So the slope is known up to the sum over edges
// that are in doubt, and over what turns and grows as the point comes nearer: all in proportion to the edges' lengths,
// however many there are. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/penumbra_wedge/edge_sweep.hpp>
#include <penumbra/penumbra_wedge/hidden_edges.hpp>
#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// A rectangle of the index's half-size, or the disk in it.
template <class T>
struct LightOutline {
    T area;
    bool is_round;
};

/// Adds up what edges sweep. All in the index's units.
template <class T>
class SweptArea {
  public:
    /// Fewer than unions keep: what is cut at a point's depth comes on top.
    static constexpr std::size_t most_edges = 192, most_pieces = HiddenEdges<T>::most_pieces;

    /// Gives up where what is in doubt is more than `most` as a point moves from the middle of the tile's box to its
    /// farthest corner, and where there are more than most_edges.
    SweptArea(const LightView<T>& view, T most, OverlapChange overlap, bool from_point)
        : view_(view), most_(most), overlap_(overlap), from_point_(from_point) {}

    bool begin_piece(const Box3<T>& box, bool simple, bool solid) {
        if (pieces_ < most_pieces) {
            // IntervalBlender's rectangles overlap only where these do
            const PointTile<T>& tile = view_.tile();
            const bool beyond = box.max.z >= tile.box.min.z;
            const Rect2<T> rect = beyond ? tile.light : intersect(project_box(box, tile.box), tile.light);
            SeenPiece<T>& piece = pieces_seen_[pieces_];
            piece.rect = rect, piece.first = piece.end = edges_, piece.turning = T(0);
            piece.is_simple = from_point_ && simple, piece.is_wound_once = simple || solid;
            piece.is_alone = true, piece.is_turned = piece.is_steady = false;
            for (std::size_t k = 0; k < pieces_; ++k) {
                if (is_apart(rect, pieces_seen_[k].rect)) continue;
                piece.is_alone = pieces_seen_[k].is_alone = false;
            }
        } else {
            for (SeenPiece<T>& piece : pieces_seen_) piece.is_alone = false;
        }
        ++pieces_;
        return overlap_ != OverlapChange::none || (pieces_ <= most_pieces && seen_exactly(pieces_seen_[pieces_ - 1]));
    }

    /// A face that the points do not all see from one side. Without it its piece blocks less, by no more than the
    /// triangle measures on the light.
    void turn(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, T distance) {
        if (pieces_ > most_pieces) return;
        const PointTile<T>& tile = view_.tile();
        const T least = tile.box.min.z, p = tile.box.max.z;
        const T room_a = least - a.z, room_b = least - b.z, room_c = least - c.z;
        SeenPiece<T>& piece = pieces_seen_[pieces_ - 1];
        piece.is_turned = piece.is_turned || view_.is_close(std::min({room_a, room_b, room_c}));
        if (piece.is_turned || !view_.lands_on_light(a, b, c)) return;
        const Vec3<T> normal = glm::cross(b - a, c - a);
        piece.turning += std::sqrt(glm::dot(normal, normal)) * T(0.5) * distance * (p / room_a) * (p / room_b) / room_c;
    }

    /// An edge, and how often it counts.
    bool edge(Vec3<T> a, Vec3<T> b, const CoefficientRange& coefficient) {
        if (++candidates_ > most_edges) return false;
        const Vec3<T> begin = a, end = b;
        if (!view_.clip_to_box(a, b)) return true;
        if (view_.is_close(view_.room(a, b))) return false;
        const T shift = view_.shift_of(a, b);
        if (!view_.clip_to_rim(a, b, shift)) return true;
        SeenEdge<T>& seen = seen_[edges_++];
        seen.begin = begin, seen.end = end, seen.a = a, seen.b = b, seen.whole = view_.sweep(a, b), seen.shift = shift;
        seen.inner = view_.inner_part(a, b, seen.whole, shift);
        seen.sure = saturated_ratio(seen.whole.times(seen.inner), seen.whole.times());
        seen.covered = T(0);
        seen.coefficient = coefficient;
        seen.piece = static_cast<std::uint16_t>(std::min(pieces_, most_pieces + 1) - 1);
        if (pieces_ <= most_pieces) pieces_seen_[pieces_ - 1].end = edges_;
        const T times = static_cast<T>(std::max(std::abs(coefficient.least), std::abs(coefficient.most)));
        const SlopeRange<T> range = view_.slope_range(a, b);
        seen.bending = Vec2<T>(range.across, range.deep) * times;
        bending_ += seen.bending.x * view_.across() + seen.bending.y * view_.deep();
        const bool may_count = pieces_ > most_pieces || !may_be_steady(pieces_seen_[pieces_ - 1]);
        if (may_count || coefficient.least == coefficient.most) doubt_ += half_length(share_of(seen), seen.whole.slope);
        return doubt_ + bending_ <= most_;
    }

    /// As areas on the light.
    Variation<T> result() {
        find_what_is_sure();
        if (pieces_ == 0) return Variation<T>::all_lit();
        Variation<T> result;
        result.known = true;
        // the direction in which most of what is in doubt moves
        T xx = T(0), xy = T(0), yy = T(0);
        std::array<Vec3<T>, most_edges> doubts;
        for (std::size_t e = 0; e < edges_; ++e) {
            const Share share = share_of(seen_[e]);
            result.slope += seen_[e].whole.slope * share.middle;
            const Vec3<T> d = doubts[e] = seen_[e].whole.slope * share.half;
            xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
        }
        const T gap = std::sqrt((xx - yy) * (xx - yy) + T(4) * xy * xy);
        const Vec2<T> axis = xx > yy ? Vec2<T>(xx - yy + gap, T(2) * xy) : Vec2<T>(T(2) * xy, yy - xx + gap);
        const T size = std::sqrt(axis.x * axis.x + axis.y * axis.y);
        if (size > T(0)) result.direction = axis / size;
        for (std::size_t k = 0; k < std::min(pieces_, most_pieces); ++k)
            if (pieces_seen_[k].is_steady) result.turning += pieces_seen_[k].turning;
        for (std::size_t e = 0; e < edges_; ++e) {
            const Vec3<T> d = result.turned(doubts[e]);
            const Vec2<T>& bending = seen_[e].bending;
            result.along += std::abs(d.x) + bending.x, result.across += std::abs(d.y) + bending.x;
            result.deep += std::abs(d.z) + bending.y;
        }
        return result;
    }

  private:
    /// The share of an edge's slope that counts: middle ± half.
    struct Share {
        T middle, half;
    };

    /// Whether a part of what it blocks is what faces that all points see alike do.
    bool may_be_steady(const SeenPiece<T>& piece) const {
        return is_sum(piece, overlap_) || (from_point_ && piece.is_wound_once && overlap_ == OverlapChange::outline);
    }

    /// What of each edge counts in any case, and what other pieces may hide; which pieces to take without their faces
    /// that not all points see alike. What a convex solid still blocks then has the same edges from everywhere.
    void find_what_is_sure() {
        if (pieces_ > most_pieces) {
            for (SeenPiece<T>& piece : pieces_seen_) piece.is_simple = false;
            return;
        }
        std::array<T, most_pieces> doubts{};
        for (std::size_t e = 0; e < edges_; ++e)
            if (seen_[e].coefficient.least != seen_[e].coefficient.most)
                doubts[seen_[e].piece] += half_length(share_of(seen_[e]), seen_[e].whole.slope);
        for (std::size_t k = 0; k < pieces_; ++k) {
            SeenPiece<T>& piece = pieces_seen_[k];
            piece.is_steady = may_be_steady(piece) && !piece.is_turned && T(2) * piece.turning < doubts[k];
        }
        const HiddenEdges<T> hidden(view_, overlap_, pieces_seen_.data(), pieces_, seen_.data(), edges_);
        hidden.find_joints();
        for (std::size_t e = 0; e < edges_; ++e) {
            SeenEdge<T>& edge = seen_[e];
            const SeenPiece<T>& own = pieces_seen_[edge.piece];
            if (edge.covered >= T(1)) continue;
            if (own.is_steady && edge.coefficient.steady == 0)
                edge.bending = Vec2<T>(T(0), T(0));
            else if (is_sum(own, overlap_) && !own.is_alone)
                hidden.find_part(edge);
        }
    }
    Share share_of(const SeenEdge<T>& edge) const {
        const auto between = [](T low, T high) -> Share { return {(low + high) * T(0.5), (high - low) * T(0.5)}; };
        T low = static_cast<T>(edge.coefficient.least), high = static_cast<T>(edge.coefficient.most);
        const bool is_told = edge.piece < most_pieces;
        if (is_told && pieces_seen_[edge.piece].is_steady) low = high = static_cast<T>(edge.coefficient.steady);
        if (is_told && is_sum(pieces_seen_[edge.piece], overlap_)) {
            const T rest = T(1) - edge.covered;
            return between(low > T(0) ? low * edge.sure : low * rest, high < T(0) ? high * edge.sure : high * rest);
        }
        if (overlap_ != OverlapChange::outline) return {T(0), std::max(std::abs(low), std::abs(high))};
        if (!from_point_ || !is_told || !pieces_seen_[edge.piece].is_wound_once) return {T(0), T(1)};
        return between(std::max(std::min(low, T(0)), T(-1)), std::min(std::max(high, T(0)), T(1)));
    }
    T half_length(const Share& share, const Vec3<T>& slope) const {
        return share.half *
               (std::sqrt(slope.x * slope.x + slope.y * slope.y) * view_.across() + std::abs(slope.z) * view_.deep());
    }

    const LightView<T>& view_;
    T most_;
    OverlapChange overlap_;
    bool from_point_;
    T doubt_ = T(0), bending_ = T(0);  ///< of edges so far
    std::size_t pieces_ = 0, edges_ = 0, candidates_ = 0;
    std::array<SeenPiece<T>, most_pieces> pieces_seen_;
    std::array<SeenEdge<T>, most_edges> seen_;
};

/// Points of a box, brought to an index's units when they are needed.
template <class T>
class BoxPoints {
  public:
    static constexpr std::size_t capacity = 256;

    /// `points` in world space; null or more than fit: none.
    BoxPoints(const Vec3<T>* points, std::size_t count, const LightFrame<T>& frame, T scale)
        : points_(points), count_(points != nullptr && count <= capacity ? count : 0), frame_(frame), scale_(scale) {}

    std::size_t size() const { return count_; }
    const Vec3<T>& operator[](std::size_t i) const {
        if (!is_ready_)
            for (std::size_t k = 0; k < count_; ++k) in_light_[k] = to_scaled_light(frame_, points_[k], scale_);
        is_ready_ = true;
        return in_light_[i];
    }

  private:
    const Vec3<T>* points_;
    std::size_t count_;
    const LightFrame<T>& frame_;
    T scale_;
    mutable bool is_ready_ = false;
    mutable std::array<Vec3<T>, capacity> in_light_;
};

/// For casters seen from a box, all in the index's units; changes for each of these units. Unknown where masks would
/// decide, where casters are as near as the box is deep, and where from the box's middle to its corners more than
/// `most` is in doubt. Error: that of the sums.
template <class T>
Variation<T> silhouette_variation(const WedgeIndex<T>& index, const Box3<T>& box, const BoxPoints<T>& points,
                                  const Vec2<T>& half_size, const LightOutline<T>& light, T most,
                                  OverlapChange overlap) {
    PointTile<T> tile;
    tile.cover(box, half_size);
    const LightView<T> view(tile, light.is_round);
    SweptArea<T> swept(view, most * light.area, overlap, index.silhouette() == SilhouetteFrom::point);
    if (!index.visit_candidates(tile, points, swept)) return Variation<T>::unknown();
    Variation<T> result = swept.result();
    const T unit = T(1) / light.area;
    result.along *= unit, result.across *= unit, result.deep *= unit, result.turning *= unit;
    result.slope *= -unit;  // of what is visible
    return result;
}

}  // namespace penumbra::detail
