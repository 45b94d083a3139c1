#include <doctest/doctest.h>

#include <cstdint>
#include <penumbra/detail/texel.hpp>
#include <type_traits>

using namespace penumbra;

TEST_CASE("ceil_log2 is the least exponent whose power is not smaller") {
    int wrong = 0;
    for (int n = 1; n <= 70000; ++n) {
        const int exponent = detail::ceil_log2(n);
        wrong += (1 << exponent) < n || (exponent > 0 && (1 << (exponent - 1)) >= n);
    }
    CHECK(wrong == 0);
    CHECK(detail::ceil_log2(1 << 30) == 30);
}

TEST_CASE("texels are one value or four, and means are computed in floating point") {
    using Rgba = glm::vec<4, std::uint8_t, glm::defaultp>;
    static_assert(detail::TexelTraits<std::uint16_t>::channels == 1 && detail::TexelTraits<Rgba>::channels == 4);
    static_assert(std::is_same_v<detail::TexelTraits<Rgba>::Value, std::uint8_t>);
    static_assert(std::is_same_v<detail::TexelMean<std::uint8_t, double>, double>);
    static_assert(std::is_same_v<detail::TexelMean<Rgba, float>, glm::vec<4, float, glm::defaultp>>);
    CHECK(sizeof(Rgba) == 4);  // a row of them is a row of bytes
}
