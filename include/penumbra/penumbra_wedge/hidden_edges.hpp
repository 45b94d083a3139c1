// What silhouettes hide of each other, seen from a box of points.
//
// Of an edge another piece may hide a part: at most what may lie inside all of its edges from some point of the box, at
// least what lies inside them from every one. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/numeric.hpp>
#include <penumbra/penumbra_wedge/edge_sweep.hpp>
#include <penumbra/penumbra_wedge/wedge_candidates.hpp>

namespace penumbra::detail {

/// What is made of silhouettes that may overlap.
enum class OverlapChange {
    none,    ///< nothing that is known: masks
    sum,     ///< their sum, limited to the light
    outline  ///< the area of all together
};

/// Parts of an edge, at most so many, that may overlap.
template <class T, std::size_t most_parts>
class EdgeCover {
  public:
    void add(const EdgePart<T>& part) {
        if (!(part.first < part.last)) return;
        std::size_t at = count_++;
        for (; at > 0 && parts_[at - 1].first > part.first; --at) parts_[at] = parts_[at - 1];
        parts_[at] = part;
    }
    /// A measure of all of them together, within a part; of one, measure(part).
    template <class Measure>
    T sum(const EdgePart<T>& within, const Measure& measure) const {
        T sum = T(0);
        EdgePart<T> rest = within;
        for (std::size_t k = 0; k < count_; ++k) {
            const EdgePart<T> part = both(parts_[k], rest);
            if (!(part.first < part.last)) continue;
            sum += measure(part), rest.first = part.last;
        }
        return sum;
    }

  private:
    std::array<EdgePart<T>, most_parts> parts_;  ///< in the order in which they begin
    std::size_t count_ = 0;
};

/// A caster, or a part of one, that may hide some of the light.
template <class T>
struct SeenPiece {
    Rect2<T> rect;
    bool is_simple;          ///< covers nothing twice
    bool is_wound_once;      ///< winds around everything in the same sense
    bool is_alone;           ///< covers nothing that another piece covers
    bool is_turned;          ///< by a face that is too near to say what it measures on the light
    T turning;               ///< faces that not all points see alike, as areas on the light
    bool is_steady;          ///< taken without these: that is less than what their edges leave in doubt
    std::size_t first, end;  ///< its edges
};
/// An edge of a piece that may land on the light.
template <class T>
struct SeenEdge {
    Vec3<T> begin, end;  ///< of all of it
    Vec3<T> a, b;        ///< the ends of what some point sees before the light
    EdgeSweep<T> whole;
    EdgePart<T> inner;  ///< what all points have before the light
    T sure;             ///< the share of its slope that counts in any case
    Vec2<T> bending;    ///< by how much its slope may differ, across the axis and in depth
    T covered;          ///< the share that another piece surely hides
    T shift;            ///< how far it may be from where the middle sees it
    CoefficientRange coefficient;
    std::uint16_t piece;
};

template <class T>
bool is_apart(const Rect2<T>& a, const Rect2<T>& b) {
    const Rect2<T> both = intersect(a, b);
    return !(both.min.x < both.max.x && both.min.y < both.max.y);
}
template <class T>
bool seen_exactly(const SeenPiece<T>& piece) {
    return piece.is_simple && piece.is_alone;
}
/// Whether what a piece blocks is the sum over its edges where no other piece is.
template <class T>
bool is_sum(const SeenPiece<T>& piece, OverlapChange overlap) {
    return seen_exactly(piece) || (piece.is_simple && overlap == OverlapChange::outline);
}

/// Edges of at most `most_pieces` pieces, piece by piece; refers to them.
template <class T>
class HiddenEdges {
  public:
    static constexpr std::size_t most_pieces = 32;

    HiddenEdges(const LightView<T>& view, OverlapChange overlap, const SeenPiece<T>* pieces, std::size_t piece_count,
                SeenEdge<T>* edges, std::size_t edge_count)
        : view_(view),
          overlap_(overlap),
          pieces_(pieces),
          edges_(edges),
          piece_count_(piece_count),
          edge_count_(edge_count) {}

    /// Where one convex piece ends and another begins, their outline has no edge.
    void find_joints() const {
        if (overlap_ != OverlapChange::outline) return;
        for (std::size_t e = 0; e < edge_count_; ++e) {
            SeenEdge<T>& edge = edges_[e];
            const SeenPiece<T>& own = pieces_[edge.piece];
            if (own.is_alone || !is_sum(own, overlap_) || edge.coefficient.least != edge.coefficient.most) continue;
            for (std::size_t k = own.end; k < edge_count_; ++k) {
                SeenEdge<T>& other = edges_[k];
                if (other.begin.x + other.end.x != edge.begin.x + edge.end.x) continue;  // most are told apart by this
                const bool is_same = other.begin == edge.begin && other.end == edge.end;
                if (!is_same && !(other.begin == edge.end && other.end == edge.begin)) continue;
                const CoefficientRange& c = other.coefficient;
                const int turned = is_same ? -edge.coefficient.least : edge.coefficient.least;
                if (!is_sum(pieces_[other.piece], overlap_) || c.least != turned || c.most != turned) continue;
                for (SeenEdge<T>* joined : {&edge, &other}) {
                    joined->covered = T(1), joined->sure = T(0);
                    joined->bending = Vec2<T>(T(0), T(0));
                }
            }
        }
    }
    /// What other pieces hide, or may hide, of an edge.
    void find_part(SeenEdge<T>& edge) const {
        const SeenPiece<T>& own = pieces_[edge.piece];
        EdgeCover<T, most_pieces> hidden, covered;
        for (std::size_t k = 0; k < piece_count_; ++k) {
            const SeenPiece<T>& other = pieces_[k];
            if (k == edge.piece || is_apart(own.rect, other.rect)) continue;
            EdgePart<T> part = part_within(edge.whole, other.rect, edge.shift);
            EdgePart<T> inside = part;
            bool is_sure = false;
            for (std::size_t e = other.first; other.is_simple && e < other.end && part.first < part.last; ++e) {
                cut_by_border(edge, edges_[e], part, inside);
                is_sure =
                    is_sure || (edges_[e].coefficient.steady != 0 && edges_[e].inner.first < edges_[e].inner.last);
            }
            hidden.add(part);
            if (is_sure && overlap_ == OverlapChange::outline) covered.add(inside);
        }
        const EdgePart<T> whole = {T(0), T(1)};
        const auto times = [&](const EdgePart<T>& part) { return edge.whole.times(part); };
        const auto in_space = [&](const EdgePart<T>& part) {
            return view_.not_landed(edge.a, edge.b, part.last) - view_.not_landed(edge.a, edge.b, part.first);
        };
        const T all = edge.whole.times(), in_whole = hidden.sum(whole, times);
        const T in_inner = hidden.sum(edge.inner, times), in_covered = covered.sum(whole, times);
        edge.bending *= std::max(T(1) - covered.sum(whole, in_space), T(0));
        edge.covered = saturated_ratio(in_covered, all);
        const T may_be_hidden = std::min(saturated_ratio(in_whole - in_covered, all), T(1) - edge.covered);
        edge.sure = clamp(edge.sure - saturated_ratio(in_inner, all), T(0), T(1) - may_be_hidden - edge.covered);
    }

  private:
    /// Leaves of `some` what may lie inside an edge of a convex piece, and of `all` what surely does, from wherever in
    /// the box: on which side of the plane through three points a fourth one lies is linear in it. What is to the left
    /// of all edges that a piece has without its turning faces, and at least one of them, lies in what these leave.
    void cut_by_border(const SeenEdge<T>& edge, const SeenEdge<T>& border, EdgePart<T>& some, EdgePart<T>& all) const {
        const CoefficientRange& c = border.coefficient;
        if (c.steady == 0) return;
        const T sign = c.steady > 0 ? T(1) : T(-1);
        const Box3<T>& box = view_.tile().box;
        const Vec3<T> half = (box.max - box.min) * T(0.5), along = border.b - border.a;
        const Vec3<T> way = view_.tile().center - border.a;
        constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
        const T least = rounding * glm::length(along) * glm::length(way);
        const Vec3<T> normal_a = glm::cross(along, edge.a - border.a), normal_b = glm::cross(along, edge.b - border.a);
        const T room_a = glm::dot(magnitudes(normal_a), half) + least,
                room_b = glm::dot(magnitudes(normal_b), half) + least;
        const T inside_a = sign * glm::dot(normal_a, way), inside_b = sign * glm::dot(normal_b, way);
        keep_positive(edge, inside_a - room_a, inside_b - room_b, all);
        if (c.least == c.most) keep_positive(edge, inside_a + room_a, inside_b + room_b, some);
    }
    /// Limits a part of an edge to where what is linear along it in space is positive, as the middle sees it land.
    void keep_positive(const SeenEdge<T>& edge, T at_a, T at_b, EdgePart<T>& part) const {
        if (at_a >= T(0) && at_b >= T(0)) return;
        if (at_a <= T(0) && at_b <= T(0)) {
            part.last = part.first;
            return;
        }
        const T landed = view_.landed(edge.a, edge.b, at_a / (at_a - at_b));
        if (at_a > T(0))
            part.last = std::min(part.last, landed);
        else
            part.first = std::max(part.first, landed);
    }

    const LightView<T>& view_;
    OverlapChange overlap_;
    const SeenPiece<T>* pieces_;
    SeenEdge<T>* edges_;
    std::size_t piece_count_, edge_count_;
};

}  // namespace penumbra::detail
