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
#include <limits>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/penumbra_wedge/lit_mesh.hpp>
#include <penumbra/penumbra_wedge/wedge_index.hpp>

namespace penumbra::detail {

/// A rectangle of the index's half-size, or the disk in it.
template <class T>
struct LightOutline {
    T area;
    bool is_round;
};

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
    static constexpr std::size_t most_edges = 256, most_pieces = 32;

    /// Gives up where what is in doubt is more than `most` as a point moves from the middle of the tile's box to its
    /// farthest corner, and where more than most_edges are in sight.
    SweptArea(const PointTile<T>& tile, bool is_round, T most, OverlapChange overlap, bool from_point)
        : tile_(tile), is_round_(is_round), most_(most), overlap_(overlap), from_point_(from_point) {
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
        if (pieces_ < most_pieces) {
            // IntervalBlender's rectangles overlap only where these do
            const bool beyond = box.max.z >= tile_.box.min.z;
            const Rect2<T> rect = beyond ? tile_.light : intersect(project_box(box, tile_.box), tile_.light);
            SeenPiece& piece = pieces_seen_[pieces_] = {rect, from_point_ && simple, simple || solid, true, false, T(0), false,
                                                           edges_, edges_};
            for (std::size_t k = 0; k < pieces_; ++k) {
                if (is_apart(rect, pieces_seen_[k].rect)) continue;
                piece.is_alone = pieces_seen_[k].is_alone = false;
            }
        } else {
            for (SeenPiece& piece : pieces_seen_) piece.is_alone = false;
        }
        ++pieces_;
        return overlap_ != OverlapChange::none || (pieces_ <= most_pieces && is_exact(pieces_seen_[pieces_ - 1]));
    }

    /// A face that the points do not all see from one side. To take it as the middle does changes what its piece blocks
    /// by no more than the triangle measures on the light.
    void turn(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, T distance) {
        if (pieces_ > most_pieces) return;
        const T least = tile_.box.min.z, p = tile_.box.max.z;
        const T room_a = least - a.z, room_b = least - b.z, room_c = least - c.z;
        SeenPiece& piece = pieces_seen_[pieces_ - 1];
        piece.is_turned = piece.is_turned || !(std::min({room_a, room_b, room_c}) > T(4) * deep_);
        if (piece.is_turned || !lands_on_light(a, b, c)) return;
        const Vec3<T> normal = glm::cross(b - a, c - a);
        piece.turning += std::sqrt(glm::dot(normal, normal)) * T(0.5) * distance * (p / room_a) * (p / room_b) / room_c;
    }

    /// An edge, and how often it counts.
    bool edge(Vec3<T> a, Vec3<T> b, const CoefficientRange& coefficient) {
        Part part = {T(0), T(1)};
        if (!clip(a, b, some_, T(1e-5), part)) return true;
        const Vec3<T> way = b - a;
        b = a + way * part.last, a += way * part.first;
        const T room = tile_.box.min.z - std::max(a.z, b.z);
        if (!(room > T(4) * deep_) || edges_ == most_edges) return false;
        const T shift = shift_of(a, b, room);
        if (is_round_ && !clip_to_rim(a, b, shift)) return true;
        SeenEdge& seen = seen_[edges_++];
        seen.a = a, seen.b = b, seen.whole = sweep(a, b), seen.shift = shift;
        seen.hidden = seen.covered = T(0);
        find_inner_part(seen);
        seen.coefficient = coefficient;
        seen.piece = static_cast<std::uint16_t>(std::min(pieces_, most_pieces + 1) - 1);
        if (pieces_ <= most_pieces) pieces_seen_[pieces_ - 1].end = edges_;
        bend(a, b, room, static_cast<T>(std::max(std::abs(coefficient.least), std::abs(coefficient.most))));
        const bool may_freeze = pieces_ <= most_pieces && is_sum(pieces_seen_[pieces_ - 1]);
        if (!may_freeze || coefficient.least == coefficient.most)
            doubt_ += half_length(share_of(seen), seen.whole.slope);
        return doubt_ + bending_ * across_ + deep_bending_ * deep_ <= most_;
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
            if (pieces_seen_[k].is_frozen) result.turning += T(2) * pieces_seen_[k].turning;
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
    /// A part of an edge, from one share of it to another.
    struct Part {
        T first, last;
    };
    struct SeenPiece {
        Rect2<T> rect;
        bool is_simple;      ///< covers nothing twice
        bool is_wound_once;  ///< winds around everything in the same sense
        bool is_alone;       ///< covers nothing that another piece covers
        bool is_turned;      ///< by a face that is too near to say what it measures on the light
        T turning;           ///< faces that look here and there, as areas on the light
        bool is_frozen;      ///< whether that is less than what their edges leave in doubt
        std::size_t first, end;  ///< its edges
    };
    /// What an edge sweeps, seen from the middle.
    struct Sweep {
        Vec3<T> slope;           ///< per unit that the point moves
        Vec2<T> from, to;        ///< where it lands
        T speed_from, speed_to;  ///< r at its ends

        /// What the slope is in proportion to, on the part from one share of the way to another.
        T times(T first, T last) const {
            return (last - first) * (speed_from + (speed_to - speed_from) * (first + last) * T(0.5));
        }
    };
    struct SeenEdge {
        Vec3<T> a, b;        ///< its ends
        Sweep whole;
        T inner_first, inner_last;  ///< the part that all points have before the light
        T sure;              ///< the share of its slope that counts in any case
        T hidden;            ///< the share that other pieces may hide
        T covered;           ///< the share that another piece surely hides
        T shift;             ///< how far it may be from where the middle sees it
        CoefficientRange coefficient;
        std::uint16_t piece;
    };
    /// The share of an edge's slope that counts: middle ± half.
    struct Share {
        T middle, half;
    };

    static bool is_exact(const SeenPiece& piece) { return piece.is_simple && piece.is_alone; }
    /// Whether what a piece blocks is the sum over its edges where no other piece is.
    bool is_sum(const SeenPiece& piece) const {
        return is_exact(piece) || (piece.is_simple && overlap_ == OverlapChange::outline);
    }

    /// What of each edge counts in any case, and what other pieces may hide; whether to take faces that turn as the
    /// middle sees them, or their edges as in doubt.
    void find_what_is_sure() {
        if (pieces_ > most_pieces) {
            for (SeenPiece& piece : pieces_seen_) piece.is_simple = false;
            return;
        }
        std::array<T, most_pieces> doubts{};
        for (std::size_t e = 0; e < edges_; ++e) {
            SeenEdge& edge = seen_[e];
            const SeenPiece& own = pieces_seen_[edge.piece];
            if (!is_sum(own)) continue;
            if (!own.is_alone) find_hidden_part(edge, own);
            if (edge.coefficient.least != edge.coefficient.most)
                doubts[edge.piece] += half_length(share_of(edge), edge.whole.slope);
        }
        for (std::size_t k = 0; k < pieces_; ++k) {
            SeenPiece& piece = pieces_seen_[k];
            piece.is_frozen = is_sum(piece) && !piece.is_turned && T(2) * piece.turning < doubts[k];
        }
    }
    void find_hidden_part(SeenEdge& edge, const SeenPiece& own) const {
        std::array<Part, most_pieces> hidden;
        std::size_t count = 0;
        Part covered = {T(0), T(0)};
        for (std::size_t k = 0; k < pieces_; ++k) {
            const SeenPiece& other = pieces_seen_[k];
            if (k == edge.piece || is_apart(own.rect, other.rect)) continue;
            Part& part = hidden[count] = part_within(edge.whole, other.rect, edge.shift);
            Part inside = part;
            bool is_sure = false;
            for (std::size_t e = other.first; other.is_simple && e < other.end && part.first < part.last; ++e) {
                cut_by_border(edge, seen_[e], part, inside);
                is_sure = is_sure || seen_[e].inner_first < seen_[e].inner_last;
            }
            if (!(part.first < part.last)) continue;
            ++count;
            if (is_sure && overlap_ == OverlapChange::outline &&
                inside.last - inside.first > covered.last - covered.first)
                covered = inside;
        }
        // each but what is covered, in whole and before the light from all points
        T in_whole = T(0), in_inner = T(0);
        const Part inner = {edge.inner_first, edge.inner_last};
        for (std::size_t k = 0; k < count; ++k) {
            for (const Part beside : {Part{T(0), covered.first}, Part{covered.last, T(1)}}) {
                const Part part = both(hidden[k], beside);
                in_whole += times(edge.whole, part), in_inner += times(edge.whole, both(part, inner));
            }
        }
        const T all = edge.whole.times(T(0), T(1));
        edge.covered = saturated_ratio(times(edge.whole, covered), all);
        edge.hidden = std::min(saturated_ratio(in_whole, all), T(1) - edge.covered);
        edge.sure = clamp(edge.sure - saturated_ratio(in_inner + times(edge.whole, both(covered, inner)), all), T(0),
                          T(1) - edge.hidden - edge.covered);
    }
    static Part both(const Part& a, const Part& b) { return {std::max(a.first, b.first), std::min(a.last, b.last)}; }
    static T times(const Sweep& edge, const Part& part) {
        return part.first < part.last ? edge.times(part.first, part.last) : T(0);
    }
    /// What of an edge may land within a rectangle, or so much around it.
    static Part part_within(const Sweep& edge, const Rect2<T>& rect, T around) {
        Part part = {T(0), T(1)};
        for (int k = 0; k < 2; ++k) {
            const T from = edge.from[k], way = edge.to[k] - from;
            const T low = rect.min[k] - around - from, high = rect.max[k] + around - from;
            if (std::abs(way) * T(64) < around) {
                if (low > std::max(way, T(0)) || high < std::min(way, T(0))) return {T(1), T(0)};
                continue;
            }
            part.first = std::max(part.first, (way > T(0) ? low : high) / way);
            part.last = std::min(part.last, (way > T(0) ? high : low) / way);
        }
        return part;
    }
    /// Leaves of `some` what may lie inside an edge of a convex piece, and of `all` what surely does, from wherever in
    /// the box: on which side of the plane through three points a fourth one lies is linear in it.
    void cut_by_border(const SeenEdge& edge, const SeenEdge& border, Part& some, Part& all) const {
        const CoefficientRange& c = border.coefficient;
        if (c.least < 0 && c.most > 0) {
            all.last = all.first;
            return;
        }
        const T sign = c.most > 0 ? T(1) : T(-1);
        const Vec3<T> half = (tile_.box.max - tile_.box.min) * T(0.5), along = border.b - border.a;
        const Vec3<T> way = tile_.center - border.a;
        constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
        const T least = rounding * glm::length(along) * glm::length(way);
        const Vec3<T> normal_a = glm::cross(along, edge.a - border.a), normal_b = glm::cross(along, edge.b - border.a);
        const T room_a = glm::dot(glm::abs(normal_a), half) + least, room_b = glm::dot(glm::abs(normal_b), half) + least;
        const T inside_a = sign * glm::dot(normal_a, way), inside_b = sign * glm::dot(normal_b, way);
        keep_positive(edge, inside_a - room_a, inside_b - room_b, all);
        if (c.least == c.most) keep_positive(edge, inside_a + room_a, inside_b + room_b, some);
    }
    /// Limits a part of an edge to where what is linear along it in space is positive, as the middle sees it land.
    void keep_positive(const SeenEdge& edge, T at_a, T at_b, Part& part) const {
        if (at_a >= T(0) && at_b >= T(0)) return;
        if (at_a <= T(0) && at_b <= T(0)) {
            part.last = part.first;
            return;
        }
        const T near = tile_.center.z - edge.a.z, far = tile_.center.z - edge.b.z;
        const T share = at_a / (at_a - at_b), landed = share * far / (near + (far - near) * share);
        if (at_a > T(0))
            part.last = std::min(part.last, landed);
        else
            part.first = std::max(part.first, landed);
    }

    Share share_of(const SeenEdge& edge) const {
        const auto between = [](T low, T high) -> Share { return {(low + high) * T(0.5), (high - low) * T(0.5)}; };
        T low = static_cast<T>(edge.coefficient.least), high = static_cast<T>(edge.coefficient.most);
        const T middle = static_cast<T>(edge.coefficient.middle);
        const bool is_told = edge.piece < most_pieces;
        if (is_told && is_sum(pieces_seen_[edge.piece])) {
            const T rest = T(1) - edge.covered;
            if (!pieces_seen_[edge.piece].is_frozen)
                return between(low > T(0) ? low * edge.sure : low * rest, high < T(0) ? high * edge.sure : high * rest);
            const T border = rest - edge.sure - edge.hidden;
            return between(
                middle * edge.sure + std::min(middle, T(0)) * border + std::min(low, T(0)) * edge.hidden,
                middle * edge.sure + std::max(middle, T(0)) * border + std::max(high, T(0)) * edge.hidden);
        }
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
        const Vec2<T> at(p.x, p.y);
        return {Vec3<T>(out.x, out.y, (out.x * from.x + out.y * from.y) / p.z) * (T(-0.5) * (ra + rb)), from + at,
                to + at, ra, rb};
    }
    /// Whether a triangle may hide any of the light from a point of the box.
    bool lands_on_light(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) const {
        const Vec3<T>& p = tile_.center;
        Rect2<T> rect = empty_rect<T>();
        T around = T(0);
        for (const Vec3<T>& v : {a, b, c}) {
            const T r = v.z / (tile_.box.min.z - v.z), x = v.x - p.x, y = v.y - p.y;
            const T grown = p.z / (p.z - v.z), reach = (std::sqrt(x * x + y * y) + across_) * (T(1) + r);
            rect = extend(rect, Vec2<T>(p.x + x * grown, p.y + y * grown));
            around = std::max(around, r * (across_ + reach / tile_.box.min.z * deep_));
        }
        const Rect2<T>& light = tile_.light;
        return rect.min.x - around < light.max.x && rect.max.x + around > light.min.x &&
               rect.min.y - around < light.max.y && rect.max.y + around > light.min.y;
    }
    /// How far from where the middle sees them the points of an edge may land.
    T shift_of(const Vec3<T>& a, const Vec3<T>& b, T room) const {
        const Vec3<T>& p = tile_.center;
        const Vec2<T> pa(a.x - p.x, a.y - p.y), pb(b.x - p.x, b.y - p.y);
        const T r = std::max(a.z, b.z) / room;
        const T away = std::sqrt(std::max(pa.x * pa.x + pa.y * pa.y, pb.x * pb.x + pb.y * pb.y)) + across_;
        return r * (across_ + away * (T(1) + r) / tile_.box.min.z * deep_);
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

    void find_inner_part(SeenEdge& edge) const {
        edge.inner_first = edge.inner_last = edge.sure = T(0);
        Part part = {T(0), T(1)};
        if (!clip(edge.a, edge.b, all_, T(-1e-5), part)) return;
        const T near = tile_.center.z - edge.a.z, far = tile_.center.z - edge.b.z;
        const auto landed = [&](T at) { return at * far / (near + (far - near) * at); };
        part = {landed(part.first), landed(part.last)};
        if (is_round_) limit_to_rim(edge.whole, -edge.shift, part);
        if (!(part.first < part.last)) return;
        edge.inner_first = part.first, edge.inner_last = part.last;
        edge.sure = saturated_ratio(edge.whole.times(part.first, part.last), edge.whole.times(T(0), T(1)));
    }
    /// The part of an edge that some point of the box may see before a disk. False if there is none.
    bool clip_to_rim(Vec3<T>& a, Vec3<T>& b, T shift) const {
        Part part = {T(0), T(1)};
        limit_to_rim(sweep(a, b), shift, part);
        if (!(part.first < part.last)) return false;
        const T near = tile_.center.z - a.z, far = tile_.center.z - b.z;
        const auto share = [&](T landed) { return landed * near / (far + (near - far) * landed); };
        const Vec3<T> from = a, way = b - a;
        if (part.last < T(1)) b = from + way * share(part.last);
        if (part.first > T(0)) a = from + way * share(part.first);
        return true;
    }
    /// Limits a part of an edge to a circle so much larger than the light.
    void limit_to_rim(const Sweep& edge, T larger, Part& part) const {
        const T radius = tile_.light.max.x + larger;
        const Vec2<T> way = edge.to - edge.from;
        const T length = way.x * way.x + way.y * way.y, along = edge.from.x * way.x + edge.from.y * way.y;
        const T out = edge.from.x * edge.from.x + edge.from.y * edge.from.y - radius * radius;
        const T chord = along * along - length * out;
        if (!(radius > T(0)) || !(length > T(0)) || !(chord > T(0))) {
            part.last = part.first;
            return;
        }
        const T reach = std::sqrt(chord);
        part.first = std::max(part.first, (-along - reach) / length);
        part.last = std::min(part.last, (reach - along) / length);
    }
    /// The part of an edge between the sides, `slack` of its length longer at both ends. False if there is none.
    bool clip(const Vec3<T>& a, const Vec3<T>& b, const Sides& sides, T slack, Part& part) const {
        const Vec2<T> half = tile_.light.max;
        const std::array<Vec3<T>, 6> inside = {{Vec3<T>(T(-1), T(0), sides.right), Vec3<T>(T(1), T(0), -sides.left),
                                                Vec3<T>(T(0), T(-1), sides.top), Vec3<T>(T(0), T(1), -sides.bottom),
                                                Vec3<T>(T(0), T(0), T(1)), Vec3<T>(T(0), T(0), T(-1))}};
        const std::array<T, 6> offset = {{half.x, half.x, half.y, half.y, T(0), tile_.box.max.z}};
        for (std::size_t k = 0; k < inside.size(); ++k) {
            const T at_a = glm::dot(inside[k], a) + offset[k], at_b = glm::dot(inside[k], b) + offset[k];
            if (at_a < T(0) && at_b < T(0)) return false;
            if (at_a < T(0)) part.first = std::max(part.first, at_a / (at_a - at_b));
            if (at_b < T(0)) part.last = std::min(part.last, at_a / (at_a - at_b));
        }
        part.first = std::max(part.first - slack, T(0)), part.last = std::min(part.last + slack, T(1));
        return part.first < part.last;
    }
    static bool is_apart(const Rect2<T>& a, const Rect2<T>& b) {
        const Rect2<T> both = intersect(a, b);
        return !(both.min.x < both.max.x && both.min.y < both.max.y);
    }

    const PointTile<T>& tile_;
    bool is_round_;
    T most_, across_, deep_;
    OverlapChange overlap_;
    bool from_point_;
    Sides some_, all_;
    T doubt_ = T(0), bending_ = T(0), deep_bending_ = T(0);
    std::size_t pieces_ = 0, edges_ = 0;
    std::array<SeenPiece, most_pieces> pieces_seen_;
    std::array<SeenEdge, most_edges> seen_;
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
/// decide, where casters are as near as the box is deep, and where from the box's middle to its corners more than `most`
/// is in doubt. Error: that of the sums.
template <class T>
Variation<T> silhouette_variation(const WedgeIndex<T>& index, const Box3<T>& box, const BoxPoints<T>& points,
                                  const Vec2<T>& half_size, const LightOutline<T>& light, T most, OverlapChange overlap) {
    PointTile<T> tile;
    tile.cover(box, half_size);
    SweptArea<T> swept(tile, light.is_round, most * light.area, overlap, index.silhouette() == SilhouetteFrom::point);
    if (!index.visit_candidates(tile, points, swept)) return Variation<T>::unknown();
    Variation<T> result = swept.result();
    const T unit = T(1) / light.area;
    result.along *= unit, result.across *= unit, result.deep *= unit, result.turning *= unit;
    result.slope *= -unit;  // of what is visible
    return result;
}

}  // namespace penumbra::detail
