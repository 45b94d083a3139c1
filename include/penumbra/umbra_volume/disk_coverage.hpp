// How much of a disk lies inside a closed loop, one edge at a time: what a silhouette blocks of a disk light.
//
// As the sum of penumbra_wedge/coverage.hpp, with the rim in place of a box's border: an edge's share is what lies of
// the disk below it, negative for edges that run to the right. Let F(x) be the disk left of x, and let the edge run in
// it from (x₀, y₀) to (x₁, y₁), between columns l and r. Below it are
//     a trapezium down to y = 0 and half the disk:   (y₀ + y₁) (x₁ − x₀) / 2 + (F(x₁) − F(x₀)) / 2
//     beside it, where it comes in or goes out above:   F(x₀) − F(l),   F(r) − F(x₁).
// An edge beside the disk has x₀ = x₁. No edge needs to know of any other, and there are no angles.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/numeric.hpp>
#include <penumbra/umbra_volume/disk_visibility.hpp>
#include <type_traits>

namespace penumbra {

namespace detail {

// Loops over what follows vectorise. It has no errno; no calls, since all parts are marked to stay in line; and no
// choices but between numbers that exist already: those between constants, or with arithmetic for one side, become
// branches.

/// √x as the language has it: for one edge.
struct PlainRoot {
    template <class T>
    T operator()(T x) const {
        return std::sqrt(x);
    }
};

/// √x of x ≥ 0, for loops over edges: std::sqrt sets errno. 1 ULP above 1e-12, and 1e-10 below. Newton's method from
/// halved bits: 3.4e-2, 1.8e-3, 4.7e-6, 3.3e-11.
struct LaneRoot {
    template <class T>
    [[gnu::always_inline]] T operator()(T x) const {
        constexpr bool is_float = std::is_same_v<T, float>;
        using Bits = std::conditional_t<is_float, std::uint32_t, std::uint64_t>;
        constexpr auto start = static_cast<Bits>(is_float ? 0x5f375a86U : 0x5fe6eb50c7b537a9U);
        const T positive = x + (is_float ? T(1e-18) : T(1e-60));  // powers of its inverse are in range
        Bits bits = 0;
        std::memcpy(&bits, &positive, sizeof bits);
        bits = start - (bits >> 1);
        T inverse;
        std::memcpy(&inverse, &bits, sizeof bits);
        const T half = T(0.5) * positive;
        for (int k = 0; k < (is_float ? 2 : 3); ++k) inverse = inverse * (T(1.5) - half * inverse * inverse);
        const T root = x * inverse;
        return root + T(0.5) * inverse * (x - root * root);
    }
};

/// x limited to [low, high].
template <class T>
[[gnu::always_inline]] inline T within(T x, T low, T high) {
    const T raised = x > low ? x : low;
    return raised < high ? raised : high;
}
/// ½ for x ≥ 0, −½ below.
template <class T>
[[gnu::always_inline]] inline T half_sign(T x) {
    return std::copysign(T(0.5), x + T(0));  // 0 in place of −0
}
/// a where `first` is 1, b where it is 0.
template <class T>
[[gnu::always_inline]] inline T pick(T first, T a, T b) {
    return first * a + (T(1) - first) * b;
}

/// What depends on a disk's radius alone.
template <class T>
struct DiskUnits {
    T area;
    T scale;      ///< a power of two that brings the radius to 1 … 2; 0 for radius 0. What follows is times that
    T radius;     ///< 1 for radius 0
    T square;     ///< radius²
    T half;       ///< ½ of the radius' reciprocal
    T most;       ///< farther coordinates are limited to it, so that squares are in range
    T trapezium;  ///< 1 / (2 π radius²)

    explicit DiskUnits(T disk_radius) {
        const bool has_area = disk_radius >= std::numeric_limits<T>::min();
        scale = has_area ? exp2_int<T>(exponent_to_unit(disk_radius)) : T(0);
        radius = has_area ? disk_radius * scale : T(1);
        area = has_area ? pi<T> * disk_radius * disk_radius : T(0);
        square = radius * radius, half = T(0.5) / radius, trapezium = T(2) * half * half / pi<T>;
        most = radius * exp2_int<T>(std::numeric_limits<T>::max_exponent / 2 - 4);
    }
};

/// The share of the disk left of x, limited to ± radius, less ½: disk_visibility without its exact ½.
template <class T, class Root>
[[gnu::always_inline]] inline T left_of(T x, const DiskUnits<T>& disk, Root root) {
    const T rest = std::abs(T(0.5) - std::abs(within(x, -disk.radius, disk.radius)) * disk.half);
    return T(2) * half_sign(x) * (T(0.5) - rest * (root(rest) * segment_polynomial(rest)));
}

/// penumbra::disk_edge_coverage without vectors.
template <class T, class Root>
[[gnu::always_inline]] inline T disk_edge_coverage(T ax, T ay, T bx, T by, const DiskUnits<T>& disk, Root root) {
    constexpr T least = std::numeric_limits<T>::min(), one = T(1), half = T(0.5);
    const bool rightward = ax < bx;
    const T left_x = rightward ? ax : bx, left_y = rightward ? ay : by;
    const T right_x = rightward ? bx : ax, right_y = rightward ? by : ay;
    const T lx = within(left_x * disk.scale, -disk.most, disk.most);
    const T ly = within(left_y * disk.scale, -disk.most, disk.most);
    const T rx = within(right_x * disk.scale, -disk.most, disk.most);
    const T ry = within(right_y * disk.scale, -disk.most, disk.most);
    // the way from left to right, by a power of two to a length near 1; 0 if it has none, or a denormal
    const T run = rx - lx, rise = ry - ly, size = std::abs(rise), longer = run > size ? run : size;
    const T step = exp2_int<T>(-floor_log2(longer)) * (half + half_sign(longer - least));
    const T dx = run * step, dy = rise * step, inverse = one / (dx * dx + dy * dy + T(16) * least);
    // the line's point nearest to the centre, from the nearer end: one far away does not drown what lies in the disk
    const bool left_is_near = lx * lx + ly * ly <= rx * rx + ry * ry;
    const T nx = left_is_near ? lx : rx, ny = left_is_near ? ly : ry;
    const T cross = nx * dy - ny * dx, across = cross * inverse, foot_x = across * dy, foot_y = -(across * dx);
    // from there to the rim, in units of dx and dy; 0 beside the disk
    const T chord = (disk.square - cross * across) * inverse, reach = root(half * (chord + std::abs(chord)));
    // the ends, and 1 for those in the disk; others move along the line to the rim
    const T along_l = (lx * dx + ly * dy) * inverse, along_r = (rx * dx + ry * dy) * inverse;
    const T inside_l = half + half_sign(reach - std::abs(along_l));
    const T inside_r = half + half_sign(reach - std::abs(along_r));
    const T along_0 = within(along_l, -reach, reach), along_1 = within(along_r, -reach, reach);
    const T x0 = pick(inside_l, lx, foot_x + along_0 * dx), y0 = pick(inside_l, ly, foot_y + along_0 * dy);
    const T x1 = pick(inside_r, rx, foot_x + along_1 * dx), y1 = pick(inside_r, ry, foot_y + along_1 * dy);
    // 1 where the line comes in above, and where it goes out above
    const T above_l = (one - inside_l) * (half + half_sign(y0)), above_r = (one - inside_r) * (half + half_sign(y1));
    const T strips = above_r * left_of(rx, disk, root) - above_l * left_of(lx, disk, root);
    const T halves = (above_l - half) * left_of(x0, disk, root) + (half - above_r) * left_of(x1, disk, root);
    const T trapezium = (y0 + y1) * (x1 - x0) * disk.trapezium;
    const T counts = half + half_sign(dx - least);
    return std::copysign(counts, ax - bx) * (((strips + halves) + trapezium) * disk.area);
}

}  // namespace detail

/// The signed area of the part of a disk around the origin that lies below the edge from a to b, towards −y, between
/// its ends' columns: summed over a closed loop that runs counter-clockwise it is the loop's area inside the disk,
/// winding counted. Plane coordinates, any unit; the result is in that unit squared, within ± π radius² but for 2 ε.
/// Domain: radius in [0, 1e18], |coordinates| ≤ 1e18 radii; farther ones count as 2^60 radii, 2^508 in double.
/// Degenerate: 0 for a vertical edge, one of no length, one beside or below the disk, and for radius 0. Reversing an
/// edge changes the sign of the result and no bit else; scaling by a power of two is exact. Error in units of the
/// disk's area: 2.2 ε for an edge with an end within 4 radii of the centre, wherever the other is; else ε times the
/// distance of the nearer end. Measured of loops of up to 6 edges: 4.3e-7 and 8e-16 for each time that a loop runs
/// around, 4.9e-7 and 1e-15 with -ffast-math. Sums of edges that cancel, above the disk, leave their rounding.
/// Source: Green's theorem, as coverage of a box in penumbra_wedge/coverage.hpp; the segments by disk_visibility.
template <class T>
T disk_edge_coverage(const Vec2<T>& a, const Vec2<T>& b, T radius) {
    return detail::disk_edge_coverage(a.x, a.y, b.x, b.y, detail::DiskUnits<T>(radius), detail::PlainRoot());
}

}  // namespace penumbra
