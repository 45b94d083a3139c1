// Around a few points: what all of them have in common.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>

namespace penumbra::detail {

/// Around `count` ≥ 1 points. Eight at a time, coordinate by coordinate, so that it vectorises. Not finite if any point
/// is not.
template <class T>
Box3<T> box_of(const Vec3<T>* points, std::size_t count) {
    constexpr std::size_t many = 8, lanes = 3 * many;
    static_assert(sizeof(Vec3<T>) == 3 * sizeof(T), "three coordinates and nothing else");
    std::array<T, lanes> low, high, sum{}, at;
    for (std::size_t j = 0; j < lanes; ++j) low[j] = high[j] = points[0][static_cast<int>(j % 3)];
    const auto extend_by = [&] {
        for (std::size_t j = 0; j < lanes; ++j) {
            low[j] = at[j] < low[j] ? at[j] : low[j];
            high[j] = at[j] > high[j] ? at[j] : high[j];
            sum[j] += std::abs(at[j]);  // whatever min and max make of what is not finite
        }
    };
    const std::size_t whole = count / many * many;
    for (std::size_t i = 0; i < whole; i += many) {
        std::memcpy(at.data(), points + i, sizeof(at));
        extend_by();
    }
    for (std::size_t j = 0; j < lanes; ++j) at[j] = points[0][static_cast<int>(j % 3)];
    if (whole < count) {
        std::memcpy(at.data(), points + whole, (count - whole) * sizeof(Vec3<T>));
        extend_by();
    }
    Box3<T> box;
    T all = T(0);
    for (std::size_t k = 0; k < 3; ++k) {
        T least = low[k], greatest = high[k], size = T(0);
        for (std::size_t j = k; j < lanes; j += 3) {
            least = low[j] < least ? low[j] : least;
            greatest = high[j] > greatest ? high[j] : greatest;
            size += sum[j];
        }
        box.min[static_cast<int>(k)] = least, box.max[static_cast<int>(k)] = greatest;
        all += size;
    }
    if (!is_finite(all)) box.max.x = std::numeric_limits<T>::infinity();
    return box;
}

/// A box in world space, and what rounding may make of its points' places, in light space.
template <class T>
Box3<T> seen_from(const LightFrame<T>& frame, const Box3<T>& box) {
    const Vec3<T> middle = frame.to_light((box.min + box.max) * T(0.5)), half = (box.max - box.min) * T(0.5);
    const Vec3<T> reach = farthest_of(box) + magnitudes(frame.origin);
    const T margin = T(8) * std::numeric_limits<T>::epsilon() * (reach.x + reach.y + reach.z);
    const Vec3<T> out(glm::dot(magnitudes(frame.u), half) + margin, glm::dot(magnitudes(frame.v), half) + margin,
                      glm::dot(magnitudes(frame.normal), half) + margin);
    return {middle - out, middle + out};
}

}  // namespace penumbra::detail
