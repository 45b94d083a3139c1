// How much of a box lies inside a closed loop, one edge at a time: what a silhouette blocks of a light.
//
// Green's theorem turns the area inside a loop into a sum over its edges of −∫ y dx. Limited to a box, that is
// −∫ (clamp(y, y₀, y₁) − y₀) dx over clamp(x, x₀, x₁): what lies of the box below the edge, negative for edges that run
// to the right. No edge needs to know of any other, so that edges may come in any order, from any stage, and there is
// no question of "is the centre inside?" whose answer could contradict the sum. What is summed is the winding number:
// a part of the box that a loop encloses twice counts twice.
#pragma once

#include <cmath>
#include <cstddef>
#include <penumbra/geometry.hpp>

namespace penumbra {

namespace detail {

/// An edge within the box's columns, from its nearer end to the farther: both x inside, y not yet limited. Order and
/// `sign` make results change sign bit for bit when an edge is reversed. Interpolates from the nearer end, which keeps
/// ends at 1e5 or 1e18 from drowning what lies in the box.
template <class T>
struct ColumnEdge {
    T x0, y0, x1, y1, sign;
};

template <class T>
ColumnEdge<T> column_edge(T ax, T ay, T bx, T by, const Rect2<T>& box) {
    const T middle_x = (box.min.x + box.max.x) * T(0.5), middle_y = (box.min.y + box.max.y) * T(0.5);
    const T far_a = std::abs(ax - middle_x) + std::abs(ay - middle_y);
    const T far_b = std::abs(bx - middle_x) + std::abs(by - middle_y);
    const bool tie = far_a == far_b, left = ax < bx || (ax == bx && ay < by);
    const bool forward = tie ? left : far_a < far_b;
    const T nx = forward ? ax : bx, ny = forward ? ay : by, fx = forward ? bx : ax, fy = forward ? by : ay;
    const T x0 = clamp(nx, box.min.x, box.max.x), x1 = clamp(fx, box.min.x, box.max.x);
    const T width = fx - nx, slope = (fy - ny) / (width != T(0) ? width : T(1));
    const T y0 = x0 == nx ? ny : ny + (x0 - nx) * slope, y1 = x1 == fx ? fy : ny + (x1 - nx) * slope;
    return {x0, y0, x1, y1, forward ? T(1) : T(-1)};
}

/// edge_coverage without vectors: loops over arrays of edges vectorise.
template <class T>
T edge_coverage(T ax, T ay, T bx, T by, const Rect2<T>& box) {
    const ColumnEdge<T> e = column_edge(ax, ay, bx, by, box);
    const T c0 = clamp(e.y0, box.min.y, box.max.y), c1 = clamp(e.y1, box.min.y, box.max.y);
    // twice the mean of the limited y: its ends' sum, and how much longer it stays at one limit than at the other
    const T rise = e.y1 - e.y0;
    const T lean = clamp(((c0 + c1) - (e.y0 + e.y1)) / (rise != T(0) ? rise : T(1)), T(-1), T(1));
    const T twice_mean = ((c0 - box.min.y) + (c1 - box.min.y)) + lean * (c0 - c1);
    return e.sign * (T(-0.5) * (e.x1 - e.x0) * twice_mean);
}

}  // namespace detail

/// The signed area of the part of `box` below the edge from a to b, between its ends' columns: summed over a closed
/// loop that runs counter-clockwise it is the loop's area inside the box, winding counted. Plane coordinates, any unit;
/// the result is in that unit squared, within ± area(box). Domain: |coordinates| ≤ 1e18, box not empty. Degenerate:
/// 0 for a vertical edge, one of no length, one beside or below the box. Reversing an edge changes the sign of the
/// result and no bit else. Error: 4 ε area(box) for ends within 3 box sizes; a loop's sum stays within 5e-7 (float) and
/// 1e-14 (double) of the box's area up to 32 edges.
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

/// edge_coverage with moments: the limited edge is a polyline of up to three pieces, integrated one by one. Domain,
/// degenerate cases and antisymmetry as edge_coverage. Error: 8 ε of area(box), of area(box) · extent for the moments.
template <class T>
CoverageMoments<T> edge_moments(const Vec2<T>& a, const Vec2<T>& b, const Rect2<T>& box) {
    const detail::ColumnEdge<T> e = detail::column_edge(a.x, a.y, b.x, b.y, box);
    const T c0 = clamp(e.y0, box.min.y, box.max.y), c1 = clamp(e.y1, box.min.y, box.max.y);
    const T rise = e.y1 - e.y0, width = e.x1 - e.x0, safe_rise = rise != T(0) ? rise : T(1);
    // where the edge leaves the first limit and reaches the last; the same place where it stays beyond one limit
    const T enter = c0 == c1 ? T(0) : saturate((c0 - e.y0) / safe_rise);
    const T leave = c0 == c1 ? T(1) : saturate((c1 - e.y0) / safe_rise);
    const T x[4] = {e.x0 - box.min.x, e.x0 - box.min.x + enter * width, e.x0 - box.min.x + leave * width,
                    e.x1 - box.min.x};
    const T h[4] = {c0 - box.min.y, c0 - box.min.y, c1 - box.min.y, c1 - box.min.y};
    CoverageMoments<T> sum{T(0), T(0), T(0)};
    for (int k = 0; k < 3; ++k) {
        const T sixth = e.sign * (x[k] - x[k + 1]) / T(6);
        sum.area += T(3) * sixth * (h[k] + h[k + 1]);
        sum.x += sixth * (h[k] * (T(2) * x[k] + x[k + 1]) + h[k + 1] * (x[k] + T(2) * x[k + 1]));
        sum.y += sixth * (h[k] * h[k] + h[k] * h[k + 1] + h[k + 1] * h[k + 1]);
    }
    return sum;
}

}  // namespace penumbra
