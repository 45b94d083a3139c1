// What one silhouette blocks of one radial part of the light: an area, a centre of gravity and a bounding rectangle.
//
// The light's box is cut into radial parts. The paper never says how; its "maximum in X and Y" fits axis quadrants, and
// the whole box as one part works too. Part coordinates make a part [0, 1]², x to the right and y up: what is kept of a
// silhouette needs no unit, and quadrants, being of equal size, block the mean of their areas of the light.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/coverage.hpp>

namespace penumbra {

/// What one silhouette, or several that were blended, blocks of one part, in part coordinates: the area, the first
/// moments ∫ x dA and ∫ y dA (over area: the centre of gravity), and a rectangle around all of it. Of every part that
/// functions make: 0 ≤ area ≤ 1, rect within [0, 1]², moment / area within rect.
template <class T>
struct RadialPart {
    T area;
    Vec2<T> moment;
    Rect2<T> rect;
};

/// The part that nothing blocks. Its rectangle is inside out, so that unions leave others as they are.
template <class T>
RadialPart<T> empty_part() {
    return {T(0), Vec2<T>(T(0), T(0)), {Vec2<T>(T(1), T(1)), Vec2<T>(T(0), T(0))}};
}

/// The part that is blocked everywhere.
template <class T>
RadialPart<T> full_part() {
    return {T(1), Vec2<T>(T(0.5), T(0.5)), {Vec2<T>(T(0), T(0)), Vec2<T>(T(1), T(1))}};
}

/// The part with what rounding, packing or any finite numbers violate put right: rect within [0, 1]², 0 ≤ area ≤
/// |rect| ≤ 1, moment / area in rect; empty_part() where the area is less than the smallest normal number, which
/// drivers flush. Exact where nothing is violated.
template <class T>
RadialPart<T> valid_part(const RadialPart<T>& part) {
    RadialPart<T> result;
    result.rect.min = Vec2<T>(saturate(part.rect.min.x), saturate(part.rect.min.y));
    result.rect.max = Vec2<T>(saturate(part.rect.max.x), saturate(part.rect.max.y));
    result.area = clamp(part.area, T(0), area(result.rect));
    if (!(result.area >= std::numeric_limits<T>::min())) return empty_part<T>();
    result.moment.x = clamp(part.moment.x, result.area * result.rect.min.x, result.area * result.rect.max.x);
    result.moment.y = clamp(part.moment.y, result.area * result.rect.min.y, result.area * result.rect.max.y);
    return result;
}

/// The four radial parts of a light's box: bit 0 of `index` is the right half, bit 1 the upper one. The box's unit.
template <class T>
Rect2<T> quadrant(const Rect2<T>& box, int index) {
    const Vec2<T> middle((box.min.x + box.max.x) * T(0.5), (box.min.y + box.max.y) * T(0.5));
    const bool right = (index & 1) != 0, upper = (index & 2) != 0;
    return {Vec2<T>(right ? middle.x : box.min.x, upper ? middle.y : box.min.y),
            Vec2<T>(right ? box.max.x : middle.x, upper ? box.max.y : middle.y)};
}

namespace detail {

/// Where the ends of an edge come to lie in v when its u is limited to [low, high]. From the first end, so that a far
/// second one does not drown it; limits that the edge does not reach give its nearest end.
template <class T>
struct LimitedEnds {
    T first, second;
};

template <class T>
LimitedEnds<T> limited_ends(T u0, T v0, T u1, T v1, T low, T high) {
    const T at0 = clamp(u0, low, high), at1 = clamp(u1, low, high), run = u1 - u0;
    const T t0 = saturate(safe_ratio(at0 - u0, run, T(0))), t1 = saturate(safe_ratio(at1 - u0, run, T(0)));
    return {at0 == u0 ? v0 : v0 + t0 * (v1 - v0), at1 == u1 ? v1 : v0 + t1 * (v1 - v0)};
}

/// −1 for an edge that crosses the column at x rightwards, 1 leftwards.
template <class T>
int column_crossing(T ax, T bx, T x) {
    return (ax > x ? 1 : 0) - (bx > x ? 1 : 0);
}

}  // namespace detail

/// Takes the edges of one silhouette on the light's plane in any order and gives what it blocks of one part.
///
/// The paper's rectangle, around the edges inside the part, is wrong where the silhouette encloses a corner of the part
/// that no edge reaches. Here corners with a winding number other than 0 are in it as well. What runs along the part's
/// border, as cuts leave it behind, does not count: the outermost 16 ε of the part's size are taken for its border.
template <class T>
struct RadialPartBuilder {
    Rect2<T> box;                                 ///< the part on the light's plane, any unit
    Rect2<T> inside;                              ///< without its border
    T area = T(0);                                ///< signed, that unit squared
    Vec2<T> moment = Vec2<T>(T(0), T(0));         ///< about box.min
    Rect2<T> rect = empty_rect<T>();              ///< around the edges inside
    std::array<int, 4> winding = {{0, 0, 0, 0}};  ///< around the corners of `inside`, in quadrant()'s order

    explicit RadialPartBuilder(const Rect2<T>& part_box) : box(part_box) {
        const T border = T(16) * std::numeric_limits<T>::epsilon();
        const Vec2<T> margin((box.max.x - box.min.x) * border, (box.max.y - box.min.y) * border);
        inside = {box.min + margin, box.max - margin};
    }

    /// Adds the edge from a to b `weight` times, reversed if that is negative. All edges together are loops that run
    /// counter-clockwise around what they block, or what is left of such when they are cut to the columns of the
    /// light's box or of the part. Domain: |coordinates| ≤ 1e18, sides of the box in [1e-12, 1e12] for float. An edge
    /// without length adds nothing.
    void add(const Vec2<T>& a, const Vec2<T>& b, int weight) {
        const T times = static_cast<T>(weight);
        const CoverageMoments<T> below = edge_moments(a, b, box);
        area += times * below.area;
        moment.x += times * below.x;
        moment.y += times * below.y;
        // from the nearer end; the same for the reversed edge, bit for bit
        const Vec2<T> middle((box.min.x + box.max.x) * T(0.5), (box.min.y + box.max.y) * T(0.5));
        const T far_a = std::abs(a.x - middle.x) + std::abs(a.y - middle.y);
        const T far_b = std::abs(b.x - middle.x) + std::abs(b.y - middle.y);
        const bool forward = far_a == far_b ? a.x < b.x || (a.x == b.x && a.y < b.y) : far_a < far_b;
        const Vec2<T> p = forward ? a : b, q = forward ? b : a;
        const auto y = detail::limited_ends(p.x, p.y, q.x, q.y, inside.min.x, inside.max.x);
        const auto x = detail::limited_ends(p.y, p.x, q.y, q.x, inside.min.y, inside.max.y);
        const Rect2<T> limited{Vec2<T>(glm::min(x.first, x.second), glm::min(y.first, y.second)),
                               Vec2<T>(glm::max(x.first, x.second), glm::max(y.first, y.second))};
        const Rect2<T> common = intersect(limited, inside);
        if (weight != 0 && common.min.x <= common.max.x && common.min.y <= common.max.y)
            rect = extend(extend(rect, common.min), common.max);
        const T y_left = p.x < q.x ? y.first : y.second, y_right = p.x < q.x ? y.second : y.first;
        const int left = weight * detail::column_crossing(a.x, b.x, inside.min.x);
        const int right = weight * detail::column_crossing(a.x, b.x, inside.max.x);
        winding[0] += y_left > inside.min.y ? left : 0;
        winding[1] += y_right > inside.min.y ? right : 0;
        winding[2] += y_left > inside.max.y ? left : 0;
        winding[3] += y_right > inside.max.y ? right : 0;
    }

    /// What the silhouette blocks of the part: exactly empty_part() or full_part() if no edge comes inside. What the
    /// loops wind around twice counts twice, up to the area of the rectangle. Empty for a box without area, and for
    /// clockwise loops. Error: edge_moments', and 16 ε for the rectangle and for what lies within the border only.
    RadialPart<T> finish() const {
        const Vec2<T> size(box.max.x - box.min.x, box.max.y - box.min.y);
        constexpr T least = std::numeric_limits<T>::min();
        if (!(size.x >= least && size.y >= least && area > T(0))) return empty_part<T>();
        if (!(rect.min.x <= rect.max.x)) return winding[0] > 0 ? full_part<T>() : empty_part<T>();
        const bool left = winding[0] != 0 || winding[2] != 0 || rect.min.x <= inside.min.x;
        const bool right = winding[1] != 0 || winding[3] != 0 || rect.max.x >= inside.max.x;
        const bool lower = winding[0] != 0 || winding[1] != 0 || rect.min.y <= inside.min.y;
        const bool upper = winding[2] != 0 || winding[3] != 0 || rect.max.y >= inside.max.y;
        RadialPart<T> part;
        part.rect.min.x = left ? T(0) : saturated_ratio(rect.min.x - box.min.x, size.x);
        part.rect.min.y = lower ? T(0) : saturated_ratio(rect.min.y - box.min.y, size.y);
        part.rect.max.x = right ? T(1) : saturated_ratio(rect.max.x - box.min.x, size.x);
        part.rect.max.y = upper ? T(1) : saturated_ratio(rect.max.y - box.min.y, size.y);
        part.area = area / size.x / size.y;
        part.moment = Vec2<T>(moment.x / size.x / size.x / size.y, moment.y / size.y / size.x / size.y);
        return valid_part(part);
    }
};

}  // namespace penumbra
