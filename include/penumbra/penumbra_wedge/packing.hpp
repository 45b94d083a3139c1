// Radial parts in 32-bit words: what a pass that blends silhouettes keeps of a fragment, eight words for four parts.
//
//     word of `rects`:      min x | min y << 8 | max x << 16 | max y << 24     in 1/255, mins down, maxs up
//     word of `coverages`:  area | width << 16 | height << 24                  in 1/65535 and 1/255, to nearest
//
// so that rectangles hold what they are of, and their areas, of which densities are made, do not grow by the rounding
// of corners. Zeros are the empty part: a cleared target. Centres of gravity are not kept. Blending through packed
// words costs at most 2e-4 of RMSE, see the tests. Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by
// penumbra-wedges blending", 2006, section on its implementation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/radial_part.hpp>

namespace penumbra {

/// A part in two words.
struct PackedPart {
    std::uint32_t rect, coverage;
};

/// Four parts, in quadrant()'s order: two targets of four 32-bit channels.
struct PackedParts {
    std::array<std::uint32_t, 4> rects, coverages;
};

namespace detail {

/// The interval that the limits `low` and `high` and the size, whole 255ths, stand for. Among all that are packed so it
/// is about the middle, and far from where rounding would make it another; but ends at 0 and 255 stay there if they
/// can.
template <class T>
struct Interval {
    T low, high;
};

template <class T>
Interval<T> unpack_interval(std::uint32_t low, std::uint32_t high, std::uint32_t size) {
    const int more = static_cast<int>(high) - static_cast<int>(low) - static_cast<int>(size);  // 0, 1 or 2
    const bool at_low = low == 0U, at_high = high == 255U, one = at_low != at_high;
    const bool keep = more <= 0 || (more == 1 && one);
    const T inset = more <= 0 ? T(0.125) : more == 1 ? (one ? T(0.75) : T(0.375)) : T(0.875);
    return {(static_cast<T>(low) + (keep && at_low ? T(0) : inset)) / T(255),
            (static_cast<T>(high) - (keep && at_high ? T(0) : inset)) / T(255)};
}

/// The rectangle that two words stand for.
template <class T>
Rect2<T> unpack_rect(std::uint32_t rect, std::uint32_t coverage) {
    const Interval<T> x = unpack_interval<T>(rect & 255U, (rect >> 16) & 255U, (coverage >> 16) & 255U);
    const Interval<T> y = unpack_interval<T>((rect >> 8) & 255U, rect >> 24, coverage >> 24);
    return {Vec2<T>(x.low, y.low), Vec2<T>(x.high, y.high)};
}

}  // namespace detail

/// Two words for a part, any finite numbers, which go through valid_part first. Ties of areas and sizes go up; corners
/// on a 255th stay there, give or take a rounding of T. The area is limited to that of the rectangle as it will be
/// unpacked. Exact for empty_part() and full_part(). Packing what unpack_part gives of these words gives them again.
/// Error: 1/131070 of the area, or up to 1/255 (width + height) / 2 where the rectangle is filled; 1/255 for corners.
template <class T>
PackedPart pack_part(const RadialPart<T>& part) {
    const RadialPart<T> valid = valid_part(part);
    if (!(valid.area > T(0))) return {0U, 0U};
    const auto down = [](T x) { return static_cast<std::uint32_t>(std::floor(x * T(255))); };
    const auto up = [](T x) { return static_cast<std::uint32_t>(std::ceil(x * T(255))); };
    const auto nearest = [](T x) { return static_cast<std::uint32_t>(std::floor(x * T(255) + T(0.5))); };
    const Vec2<T> size(valid.rect.max.x - valid.rect.min.x, valid.rect.max.y - valid.rect.min.y);
    const std::uint32_t rect = down(valid.rect.min.x) | (down(valid.rect.min.y) << 8) | (up(valid.rect.max.x) << 16) |
                               (up(valid.rect.max.y) << 24);
    const std::uint32_t sizes = (nearest(size.x) << 16) | (nearest(size.y) << 24);
    const auto most = static_cast<std::uint32_t>(std::floor(area(detail::unpack_rect<T>(rect, sizes)) * T(65535)));
    const auto covered = static_cast<std::uint32_t>(std::floor(valid.area * T(65535) + T(0.5)));
    const std::uint32_t least = covered < most ? covered : most;
    return least > 0U ? PackedPart{rect, sizes | least} : PackedPart{0U, 0U};
}

/// The part that two words stand for, valid whatever they are. Its centre of gravity is the middle of its rectangle.
template <class T>
RadialPart<T> unpack_part(const PackedPart& packed) {
    if (packed.rect == 0xffff0000U && packed.coverage == 0xffffffffU) return full_part<T>();
    RadialPart<T> part;
    part.rect = detail::unpack_rect<T>(packed.rect, packed.coverage);
    part.area = static_cast<T>(packed.coverage & 65535U) / T(65535);
    part.moment = (part.rect.min + part.rect.max) * (part.area * T(0.5));
    return valid_part(part);
}

/// pack_part of each.
template <class T>
PackedParts pack_parts(const std::array<RadialPart<T>, 4>& parts) {
    PackedParts packed{};
    for (std::size_t k = 0; k < 4; ++k) {
        const PackedPart one = pack_part(parts[k]);
        packed.rects[k] = one.rect;
        packed.coverages[k] = one.coverage;
    }
    return packed;
}

/// unpack_part of each.
template <class T>
std::array<RadialPart<T>, 4> unpack_parts(const PackedParts& packed) {
    std::array<RadialPart<T>, 4> parts;
    for (std::size_t k = 0; k < 4; ++k) parts[k] = unpack_part<T>({packed.rects[k], packed.coverages[k]});
    return parts;
}

}  // namespace penumbra
