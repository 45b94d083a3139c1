// What an edge of a caster sweeps on a light as the point that sees it moves within a box.
//
// Let q be where a point of an edge lands on the light's plane, seen from (x, y) of the receiver at depth p, r = z /
// (p − z), and N = (Δy, −Δx) of the edge as it lands, which points outwards. As the receiver moves by d across the axis
// and by e in depth, q moves by −r (d + q e / p). N · q is one number along the edge and r is linear, so that the edge
// sweeps
//     −(r_a + r_b) / 2 · (N · d + (N · q / p) e),
// exactly so across the axis however far, since N · d stays as it is. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>

namespace penumbra::detail {

/// A part of an edge, from one share of the way to another; empty unless first < last.
template <class T>
struct EdgePart {
    T first, last;
};

template <class T>
EdgePart<T> both(const EdgePart<T>& a, const EdgePart<T>& b) {
    return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// What an edge sweeps, seen from the middle of a box.
template <class T>
struct EdgeSweep {
    Vec3<T> slope;           ///< for each unit that the point moves
    Vec2<T> from, to;        ///< where the edge lands
    T speed_from, speed_to;  ///< r at its ends

    /// What the slope of a part is in proportion to.
    T times(const EdgePart<T>& part) const {
        const T mean = speed_from + (speed_to - speed_from) * (part.first + part.last) * T(0.5);
        return part.first < part.last ? (part.last - part.first) * mean : T(0);
    }
    T times() const { return times({T(0), T(1)}); }
};

/// By how much a slope may differ anywhere in a box: across the axis and in depth.
template <class T>
struct SlopeRange {
    T across, deep;
};

/// The points of a box before a light, all in an index's units.
template <class T>
class LightView {
  public:
    /// Of a tile that covers a box; `is_round`: the light is the disk in its rectangle.
    LightView(const PointTile<T>& tile, bool is_round) : tile_(tile), is_round_(is_round) {
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

    const PointTile<T>& tile() const { return tile_; }
    /// From the box's middle to its corners, across the light's axis and in depth.
    T across() const { return across_; }
    T deep() const { return deep_; }
    /// How much nearer to the light an edge is than all points.
    T room(const Vec3<T>& a, const Vec3<T>& b) const { return tile_.box.min.z - std::max(a.z, b.z); }
    /// Whether what is so much nearer is near enough for nothing to be known.
    bool is_close(T room) const { return !(room > T(4) * deep_); }

    /// Limits an edge to what some point may see before the light's box. False if there is nothing.
    bool clip_to_box(Vec3<T>& a, Vec3<T>& b) const {
        EdgePart<T> part = {T(0), T(1)};
        if (!clip(a, b, some_, T(1e-5), part)) return false;
        const Vec3<T> way = b - a;
        b = a + way * part.last, a += way * part.first;
        return true;
    }
    /// Limits it further to the light, if that is round; `shift` as shift_of() has it.
    bool clip_to_rim(Vec3<T>& a, Vec3<T>& b, T shift) const {
        if (!is_round_) return true;
        EdgePart<T> part = {T(0), T(1)};
        limit_to_rim(sweep(a, b), shift, part);
        if (!(part.first < part.last)) return false;
        const Vec3<T> from = a, way = b - a;
        const EdgePart<T> in_space = {not_landed(a, b, part.first), not_landed(a, b, part.last)};
        if (part.last < T(1)) b = from + way * in_space.last;
        if (part.first > T(0)) a = from + way * in_space.first;
        return true;
    }
    /// The part of an edge that all points see before the light, by where it lands.
    EdgePart<T> inner_part(const Vec3<T>& a, const Vec3<T>& b, const EdgeSweep<T>& whole, T shift) const {
        EdgePart<T> part = {T(0), T(1)};
        if (!clip(a, b, all_, T(-1e-5), part)) return {T(0), T(0)};
        part = {landed(a, b, part.first), landed(a, b, part.last)};
        if (is_round_) limit_to_rim(whole, -shift, part);
        return part.first < part.last ? part : EdgePart<T>{T(0), T(0)};
    }
    /// Which share of an edge as it lands a share of it in space is.
    T landed(const Vec3<T>& a, const Vec3<T>& b, T share) const {
        const T near = tile_.center.z - a.z, far = tile_.center.z - b.z;
        return share * far / (near + (far - near) * share);
    }

    /// The reverse.
    T not_landed(const Vec3<T>& a, const Vec3<T>& b, T landed) const {
        const T near = tile_.center.z - a.z, far = tile_.center.z - b.z;
        return landed * near / (far + (near - far) * landed);
    }

    EdgeSweep<T> sweep(const Vec3<T>& a, const Vec3<T>& b) const {
        const Vec3<T>& p = tile_.center;
        const T ra = a.z / (p.z - a.z), rb = b.z / (p.z - b.z);
        const Vec2<T> from = Vec2<T>(a.x - p.x, a.y - p.y) * (T(1) + ra),
                      to = Vec2<T>(b.x - p.x, b.y - p.y) * (T(1) + rb);
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
    T shift_of(const Vec3<T>& a, const Vec3<T>& b) const {
        const T r = std::max(a.z, b.z) / room(a, b);
        return r * (across_ + farthest(a, b) * (T(1) + r) / tile_.box.min.z * deep_);
    }
    /// By how much the slope may differ anywhere in the box: bounds of r, its change along the edge, the length on the
    /// light and the distance from there, then their derivatives.
    SlopeRange<T> slope_range(const Vec3<T>& a, const Vec3<T>& b) const {
        const T least = tile_.box.min.z, room = this->room(a, b), r = std::max(a.z, b.z) / room;
        const T room_a = least - a.z, room_b = least - b.z;
        const T uneven = (least + T(2) * deep_) * std::abs(b.z - a.z) / (room_a * room_b);
        const Vec2<T> ab(b.x - a.x, b.y - a.y);
        const T span = std::sqrt(ab.x * ab.x + ab.y * ab.y), away = farthest(a, b);
        const T grown = T(1) + r, reach = away * grown, length = grown * span + uneven * away;
        const T by_depth = r * (length / room + (length * r + reach * uneven) / least);
        return {r * uneven * across_ + by_depth * deep_,
                (r * grown * grown * span * across_ + T(4) * r * length * reach / room * deep_) / least};
    }

  private:
    /// Slopes of the sides of pyramids, which stand on the light's borders.
    struct Sides {
        T right, left, top, bottom;
    };

    /// Across the axis, from any point to any of an edge.
    T farthest(const Vec3<T>& a, const Vec3<T>& b) const {
        const Vec3<T>& p = tile_.center;
        const Vec2<T> pa(a.x - p.x, a.y - p.y), pb(b.x - p.x, b.y - p.y);
        return std::sqrt(std::max(pa.x * pa.x + pa.y * pa.y, pb.x * pb.x + pb.y * pb.y)) + across_;
    }
    /// Limits a part of an edge to a circle so much larger than the light.
    void limit_to_rim(const EdgeSweep<T>& edge, T larger, EdgePart<T>& part) const {
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
    /// Limits a part of an edge to what is between the sides, and `slack` of its length more at both ends. False if
    /// there is nothing.
    bool clip(const Vec3<T>& a, const Vec3<T>& b, const Sides& sides, T slack, EdgePart<T>& part) const {
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

    const PointTile<T>& tile_;
    bool is_round_;
    T across_, deep_;
    Sides some_, all_;  ///< that some point, that all points see the light between
};

/// What of an edge may land within a rectangle, or so much around it.
template <class T>
EdgePart<T> part_within(const EdgeSweep<T>& edge, const Rect2<T>& rect, T around) {
    EdgePart<T> part = {T(0), T(1)};
    for (int k = 0; k < 2; ++k) {
        const T from = edge.from[k], way = edge.to[k] - from;
        const T low = rect.min[k] - around - from, high = rect.max[k] + around - from;
        if (std::abs(way) * T(64) <= around) {
            if (low > std::max(way, T(0)) || high < std::min(way, T(0))) return {T(1), T(0)};
            continue;
        }
        part.first = std::max(part.first, (way > T(0) ? low : high) / way);
        part.last = std::min(part.last, (way > T(0) ? high : low) / way);
    }
    return part;
}

}  // namespace penumbra::detail
