// How much of a box lies inside a closed loop, one edge at a time: what a silhouette blocks of a light.
//
// Green's theorem turns the area inside a loop into a sum over its edges of −∫ y dx. Limited to a box, that is
// −∫ (clamp(y, y₀, y₁) − y₀) dx over clamp(x, x₀, x₁): what lies of the box below the edge, negative for edges that run
// to the right. No edge needs to know of any other, so that edges may come in any order, from any stage, and there is
// no question of "is the centre inside?" whose answer could contradict the sum. What is summed is the winding number:
// a part of the box that a loop encloses twice counts twice.
//
// Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006, whose coverage
// this replaces: theirs asks for the centre.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/geometry.hpp>

namespace penumbra {

namespace detail {

/// x limited to [low, high]: `clamp` as two choices in a row, without a branch, so that loops vectorise.
template <class T>
inline T limit(T x, T low, T high) {
    const T raised = x > low ? x : low;
    return raised < high ? raised : high;
}

/// What may be divided by: itself, or 2 where it is zero or a denormal, which drivers flush and whose reciprocal is
/// infinite. Not 1, which compilers take for a reason to branch.
template <class T>
inline T divisor(T x) {
    return std::abs(x) >= std::numeric_limits<T>::min() ? x : T(2);
}

/// An edge within the box's columns: both x limited to the box, y not yet. From the end nearer to the box's middle in
/// y, from which it is interpolated, to the other: ends at 1e5 or 1e18 then do not drown what lies in the box. This
/// order and `sign` make results change sign bit for bit when an edge is reversed.
template <class T>
struct ColumnEdge {
    T x0, y0, x1, y1, sign;
};

template <class T>
inline ColumnEdge<T> column_edge(T ax, T ay, T bx, T by, const Rect2<T>& box) {
    const T middle = (box.min.y + box.max.y) * T(0.5);
    const T far_a = std::abs(ay - middle), far_b = std::abs(by - middle);
    const bool left = (ax < bx) | ((ax == bx) & (ay < by));  // no && and ||, which branch
    const bool forward = (far_a < far_b) | ((far_a == far_b) & left);
    const T nx = forward ? ax : bx, ny = forward ? ay : by, fx = forward ? bx : ax, fy = forward ? by : ay;
    const T run = divisor(fx - nx), rise = fy - ny;
    const T x0 = limit(nx, box.min.x, box.max.x), x1 = limit(fx, box.min.x, box.max.x);
    return {x0, ny + (x0 - nx) / run * rise, x1, ny + (x1 - nx) / run * rise, forward ? T(1) : T(-1)};
}

/// What lies of the box below the edge, signed.
template <class T>
inline T covered_below(const ColumnEdge<T>& e, const Rect2<T>& box) {
    const T c0 = limit(e.y0, box.min.y, box.max.y), c1 = limit(e.y1, box.min.y, box.max.y);
    // twice the mean of the limited y: its ends' sum, and how much longer it stays at one limit than at the other
    const T rise = e.y1 - e.y0, most = std::abs(rise);
    const T lean = limit((c0 - e.y0) + (c1 - e.y1), -most, most) / divisor(rise);
    const T twice_mean = ((c0 - box.min.y) + (c1 - box.min.y)) + lean * (c0 - c1);
    return e.sign * (T(0.5) * (e.x0 - e.x1) * twice_mean);
}

/// edge_coverage without vectors: loops over arrays of edges vectorise.
template <class T>
inline T edge_coverage(T ax, T ay, T bx, T by, const Rect2<T>& box) {
    return covered_below(column_edge(ax, ay, bx, by, box), box);
}

}  // namespace detail

/// The signed area of the part of `box` below the edge from a to b, between its ends' columns: summed over a closed
/// loop that runs counter-clockwise it is the loop's area inside the box, winding counted. Plane coordinates, any unit;
/// the result is in that unit squared, within ± area(box) but for 2 ε. Domain: |coordinates| ≤ 1e18, box not empty.
/// Degenerate: 0 for a vertical edge, one of no length, one beside or below the box, and in a box without area.
/// Reversing an edge changes the sign of the result and no bit else; scaling by a power of two is exact. Error in units
/// of area(box): 1.5 ε for an edge with an end within 3 half-sizes of the box's middle, wherever the other is; else ε
/// times the distance of the nearer end. Measured of loops of up to 6 edges: 2.5 ε (3.0e-7, 4.7e-16), below 5e-7 and
/// 1e-14 for each time that a loop runs around. Sums of edges that cancel, above the box, leave their rounding.
template <class T>
T edge_coverage(const Vec2<T>& a, const Vec2<T>& b, const Rect2<T>& box) {
    return detail::edge_coverage(a.x, a.y, b.x, b.y, box);
}

/// The sum of edge_coverage over the closed loop of `count` vertices, in units of the box's area: the fraction of the
/// box inside, winding counted. 0 for a box without area.
template <class T>
T loop_coverage(const Vec2<T>* loop, std::size_t count, const Rect2<T>& box) {
    T sum = T(0);
    for (std::size_t i = 0; i < count; ++i) sum += edge_coverage(loop[i], loop[i + 1 == count ? 0 : i + 1], box);
    return safe_ratio(sum, area(box), T(0));
}

/// Area and first moments of what lies of a box below an edge, signed as edge_coverage. `x` and `y` are ∫ x dA and
/// ∫ y dA measured from box.min; over area, the centre of gravity.
template <class T>
struct CoverageMoments {
    T area, x, y;
};

template <class T>
CoverageMoments<T> operator+(const CoverageMoments<T>& a, const CoverageMoments<T>& b) {
    return {a.area + b.area, a.x + b.x, a.y + b.y};
}

/// edge_coverage with moments: the limited edge is a polyline of up to three pieces. Domain, degenerate cases, exact
/// signs and scales as edge_coverage; `area` differs from it by rounding. Error as there, for moments in units of
/// area(box) · extent.
template <class T>
inline CoverageMoments<T> edge_moments(const Vec2<T>& a, const Vec2<T>& b, const Rect2<T>& box) {
    const detail::ColumnEdge<T> e = detail::column_edge(a.x, a.y, b.x, b.y, box);
    const T y0 = detail::limit(e.y0, box.min.y, box.max.y), y1 = detail::limit(e.y1, box.min.y, box.max.y);
    // the shares of the way at which the edge leaves the first limit and reaches the last; any, if it stays at one
    const T rise = std::abs(e.y1 - e.y0), safe_rise = detail::divisor(rise), run = e.x1 - e.x0;
    const T enter = detail::limit(std::abs(y0 - e.y0), T(0), rise) / safe_rise;
    const T leave = detail::limit(std::abs(y1 - e.y0), T(0), rise) / safe_rise;
    // means along the way of the height, of height times share of the way, of height squared
    const T h0 = y0 - box.min.y, h1 = y1 - box.min.y;
    const T before = enter * h0, between = leave - enter, after = (T(1) - leave) * h1;
    const T mean = before + between * (h0 + h1) * T(0.5) + after;
    const T mean_way = T(0.5) * (before * enter + after * (T(1) + leave)) +
                       between * (h0 * (T(2) * enter + leave) + h1 * (enter + T(2) * leave)) * T(1.0 / 6.0);
    const T mean_square = before * h0 + between * (h0 * h0 + h0 * h1 + h1 * h1) * T(1.0 / 3.0) + after * h1;
    const T along = -e.sign * run;
    return {along * mean, along * ((e.x0 - box.min.x) * mean + run * mean_way), along * T(0.5) * mean_square};
}

}  // namespace penumbra
