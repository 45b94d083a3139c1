// What several silhouettes block of a radial part together, when of each only an area, a centre of gravity and a
// bounding rectangle are known.
//
// Every rule here spreads a silhouette over its rectangle and takes overlaps as random from there on: evenly (the
// paper), or leaning to its centre of gravity (its future work), one silhouette after the other; or all at once, in any
// order. Parts are in part coordinates, and such as functions make them: pass others through valid_part. Random
// casters' errors are in formulas.md and in the tests: centres of gravity halve them, and so does taking all at once
// where many overlap.
#pragma once

#include <array>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/radial_part.hpp>

namespace penumbra {

/// The area that a and b block both, if each blocks its rectangle evenly: |R_a ∩ R_b| · A_a / |R_a| · A_b / |R_b|, at
/// most either area; 0 if either is empty. The same for (b, a), bit for bit without -ffast-math. Error: 6.5 ε.
/// Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006; the limit is
/// ours.
template <class T>
T overlap_area(const RadialPart<T>& a, const RadialPart<T>& b) {
    const T least = a.area < b.area ? a.area : b.area;
    const T density = saturated_ratio(a.area, area(a.rect)) * saturated_ratio(b.area, area(b.rect));
    return clamp(area(intersect(a.rect, b.rect)) * density, T(0), least);
}

namespace detail {

/// How much denser a part is towards the ends of [low, high] than evenly, along one axis: the density goes from 1 −
/// lean to 1 + lean, which puts the centre of gravity where it is as long as that is in the middle third; never
/// negative.
template <class T>
T lean(T moment, T area, T low, T high) {
    const T centre = saturated_ratio(moment - area * low, area * (high - low));
    return clamp(T(6) * centre - T(3), T(-1), T(1));
}

/// A density within an interval: at its middle, and how much more at its end.
template <class T>
struct LinearDensity {
    T middle, rise;
};

template <class T>
LinearDensity<T> density_within(T low, T high, T lean, T from, T to) {
    const T size = high - low;
    const T at = saturated_ratio(T(0.5) * (from + to) - low, size), share = saturated_ratio(to - from, size);
    return {T(1) + lean * (T(2) * at - T(1)), lean * share};
}

/// What the product of two densities has along an interval: its mean, and its centre of gravity, −1 … 1.
template <class T>
struct CommonDensity {
    T mean, centre;
};

template <class T>
CommonDensity<T> common_density(const LinearDensity<T>& a, const LinearDensity<T>& b) {
    const T mean = a.middle * b.middle + a.rise * b.rise / T(3);
    const T first = (a.middle * b.rise + b.middle * a.rise) / T(3);
    return {mean, clamp(safe_ratio(first, mean, T(0)), T(-1), T(1))};
}

/// What two parts block both: its area and its centre of gravity.
template <class T>
struct CommonArea {
    T area;
    Vec2<T> centre;
};

template <class T>
CommonArea<T> common_area_centroid(const RadialPart<T>& a, const RadialPart<T>& b) {
    const Rect2<T> r = intersect(a.rect, b.rect);
    const T lean_ax = lean(a.moment.x, a.area, a.rect.min.x, a.rect.max.x);
    const T lean_ay = lean(a.moment.y, a.area, a.rect.min.y, a.rect.max.y);
    const T lean_bx = lean(b.moment.x, b.area, b.rect.min.x, b.rect.max.x);
    const T lean_by = lean(b.moment.y, b.area, b.rect.min.y, b.rect.max.y);
    const CommonDensity<T> x = common_density(density_within(a.rect.min.x, a.rect.max.x, lean_ax, r.min.x, r.max.x),
                                              density_within(b.rect.min.x, b.rect.max.x, lean_bx, r.min.x, r.max.x));
    const CommonDensity<T> y = common_density(density_within(a.rect.min.y, a.rect.max.y, lean_ay, r.min.y, r.max.y),
                                              density_within(b.rect.min.y, b.rect.max.y, lean_by, r.min.y, r.max.y));
    const T least = a.area < b.area ? a.area : b.area;
    const T even = area(r) * (saturated_ratio(a.area, area(a.rect)) * saturated_ratio(b.area, area(b.rect)));
    return {clamp(even * (x.mean * y.mean), T(0), least),
            (r.min + r.max) * T(0.5) + (r.max - r.min) * (Vec2<T>(x.centre, y.centre) * T(0.5))};
}

/// Both, less what both block: `overlap` with the moments `common`.
template <class T>
RadialPart<T> unite(const RadialPart<T>& a, const RadialPart<T>& b, T overlap, const Vec2<T>& common) {
    const T most = a.area > b.area ? a.area : b.area, least = a.area > b.area ? b.area : a.area;
    if (!(least > T(0))) return a.area > b.area ? a : b;
    RadialPart<T> result;
    result.rect = {glm::min(a.rect.min, b.rect.min), glm::max(a.rect.max, b.rect.max)};
    const T whole = area(result.rect);
    result.area = clamp(most + (least - overlap), most, whole > most ? whole : most);
    const Vec2<T> low = result.rect.min * result.area, high = result.rect.max * result.area;
    const Vec2<T> moment = (a.moment + b.moment) - common;
    result.moment = Vec2<T>(clamp(moment.x, low.x, high.x), clamp(moment.y, low.y, high.y));
    return result;
}

}  // namespace detail

/// What a and b block together: the sum of their areas less overlap_area, in the rectangle around both.
/// max(A_a, A_b) ≤ area ≤ min(A_a + A_b, |R|, 1), |R| being that rectangle's area; the same for (b, a) likewise;
/// empty_part() changes nothing, full_part() absorbs everything. Silhouettes are blended one after the other:
/// rectangles grow, so that their order matters. Error: 2 ε of the area, beside the model's. Source: as overlap_area.
template <class T>
RadialPart<T> blend(const RadialPart<T>& a, const RadialPart<T>& b) {
    const Rect2<T> common = intersect(a.rect, b.rect);
    const T overlap = overlap_area(a, b);
    return detail::unite(a, b, overlap, (common.min + common.max) * (T(0.5) * overlap));
}

/// overlap_area with densities that change linearly over each rectangle, so that centres of gravity are right: the
/// integral of their product. Domain, range, symmetry and error as there.
template <class T>
T overlap_area_centroid(const RadialPart<T>& a, const RadialPart<T>& b) {
    return detail::common_area_centroid(a, b).area;
}

/// blend with overlap_area_centroid, keeping the blended part's centre of gravity. All that is said there holds.
template <class T>
RadialPart<T> blend_centroid(const RadialPart<T>& a, const RadialPart<T>& b) {
    const detail::CommonArea<T> common = detail::common_area_centroid(a, b);
    return detail::unite(a, b, common.area, common.centre * common.area);
}

/// What any number of silhouettes block together if each blocks its rectangle as at random: ∫ 1 − Π (1 − ρᵢ [x ∈ Rᵢ])
/// dx with ρ = A / |R|, on Cells × Cells cells, which take the share of each that a rectangle covers. No order, fixed
/// memory; exact for rectangles that end on cells' borders. On a wall of spheres in four parts, 4 / 8 / 16 cells err by
/// .030 / .026 / .025, with centres of gravity by .016 / .012 / .011.
template <class T, int Cells = 8>
struct RectangleProduct {
    std::array<T, Cells * Cells> transmission;  ///< Π (1 − share blocked) of each cell, row by row
    T total = T(0);                             ///< Σ areas, not clamped
    T largest = T(0);                           ///< largest area

    RectangleProduct() { transmission.fill(T(1)); }

    /// Adds a silhouette that blocks its rectangle evenly.
    void add(const RadialPart<T>& part) { multiply(part, T(0), T(0)); }
    /// Adds a silhouette whose density leans to its centre of gravity, as overlap_area_centroid's.
    void add_centroid(const RadialPart<T>& part) {
        multiply(part, detail::lean(part.moment.x, part.area, part.rect.min.x, part.rect.max.x),
                 detail::lean(part.moment.y, part.area, part.rect.min.y, part.rect.max.y));
    }
    /// The area that all block: in [largest, min(1, total)]; 0 if nothing was added. Adding a silhouette never lessens
    /// it. Error: 2 Cells ε.
    T area() const {
        T sum = T(0);
        for (const T t : transmission) sum += t;
        return clamp(T(1) - sum / static_cast<T>(Cells * Cells), saturate(largest), saturate(total));
    }

  private:
    /// How much of a part lies in each column or row of cells, in units of a cell that it fills.
    static std::array<T, Cells> along(T low, T high, T lean) {
        std::array<T, Cells> result;
        for (int k = 0; k < Cells; ++k) {
            constexpr T size = T(1) / static_cast<T>(Cells);
            const T from = clamp(low, static_cast<T>(k) * size, static_cast<T>(k + 1) * size);
            const T to = clamp(high, static_cast<T>(k) * size, static_cast<T>(k + 1) * size);
            const T middle = saturated_ratio(T(0.5) * (from + to) - low, high - low);
            result[static_cast<std::size_t>(k)] =
                (to - from) * static_cast<T>(Cells) * (T(1) + lean * (T(2) * middle - T(1)));
        }
        return result;
    }
    void multiply(const RadialPart<T>& part, T lean_x, T lean_y) {
        if (!(part.area > T(0))) return;
        const std::array<T, Cells> columns = along(part.rect.min.x, part.rect.max.x, lean_x);
        const std::array<T, Cells> rows = along(part.rect.min.y, part.rect.max.y, lean_y);
        const T density = saturated_ratio(part.area, penumbra::area(part.rect));
        auto t = transmission.begin();
        for (const T row : rows)
            for (const T column : columns) *t++ *= T(1) - saturate(density * row * column);
        total += part.area;
        largest = part.area > largest ? part.area : largest;
    }
};

}  // namespace penumbra
