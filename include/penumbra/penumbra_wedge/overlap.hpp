// What several silhouettes block of a radial part together, when of each only an area, a centre of gravity and a
// bounding rectangle are known.
#pragma once

#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/radial_part.hpp>

namespace penumbra {

/// The area that a and b block both, if each blocks its rectangle evenly: |R_a ∩ R_b| · A_a / |R_a| · A_b / |R_b|, at
/// most either area. 0 if either area is ≤ 0. Part coordinates; any finite numbers. The same for (b, a), bit for bit.
/// Error: 6 ε of the result. Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges
/// blending", 2006; the limits are ours.
template <class T>
T overlap_area(const RadialPart<T>& a, const RadialPart<T>& b) {
    const T least = a.area < b.area ? a.area : b.area;
    const T density = saturated_ratio(a.area, area(a.rect)) * saturated_ratio(b.area, area(b.rect));
    return clamp(area(intersect(a.rect, b.rect)) * density, T(0), least > T(0) ? least : T(0));
}

namespace detail {

/// Both, less what both block: `overlap` with the moments `common`.
template <class T>
RadialPart<T> unite(const RadialPart<T>& a, const RadialPart<T>& b, T overlap, const Vec2<T>& common) {
    const T most = a.area > b.area ? a.area : b.area, least = a.area > b.area ? b.area : a.area;
    if (!(least > T(0))) return a.area > b.area ? a : b;
    RadialPart<T> result;
    result.rect = {glm::min(a.rect.min, b.rect.min), glm::max(a.rect.max, b.rect.max)};
    result.area = clamp(most + (least - overlap), most, T(1));
    result.moment = (a.moment + b.moment) - common;
    const T x = result.moment.x, y = result.moment.y;
    result.moment.x = clamp(x, result.area * result.rect.min.x, result.area * result.rect.max.x);
    result.moment.y = clamp(y, result.area * result.rect.min.y, result.area * result.rect.max.y);
    return result;
}

}  // namespace detail

/// What a and b block together: the sum of their areas less overlap_area, in the rectangle around both. Part
/// coordinates. max(A_a, A_b) ≤ area ≤ min(A_a + A_b, 1); the same for (b, a); empty_part() changes nothing,
/// full_part() absorbs everything. Several silhouettes are blended one after the other: rectangles grow, so that the
/// order matters; from large to small errs least. Error: 2 ε of the area, beside the model's. Source: as overlap_area.
template <class T>
RadialPart<T> blend(const RadialPart<T>& a, const RadialPart<T>& b) {
    const T overlap = overlap_area(a, b);
    const Rect2<T> common = intersect(a.rect, b.rect);
    return detail::unite(a, b, overlap, (common.min + common.max) * (T(0.5) * overlap));
}

}  // namespace penumbra
