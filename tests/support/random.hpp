// Random numbers for tests: a fixed seed gives the same numbers on every standard library.
#pragma once

#include <cstdint>
#include <penumbra/geometry.hpp>
#include <random>

namespace penumbra::test {

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    /// Uniform in [low, high).
    template <class T>
    T in(T low, T high) {
        return low + (high - low) * static_cast<T>(static_cast<double>(engine_() >> 8) / 16777216.0);
    }
    /// Uniform in {low, …, high}.
    int whole(int low, int high) {
        const std::uint32_t count = static_cast<std::uint32_t>(high) - static_cast<std::uint32_t>(low) + 1U;
        return low + static_cast<int>(engine_() % count);
    }
    template <class T>
    Vec3<T> point(T low, T high) {
        const T x = in(low, high), y = in(low, high), z = in(low, high);
        return Vec3<T>(x, y, z);
    }

  private:
    std::mt19937 engine_;
};

}  // namespace penumbra::test
