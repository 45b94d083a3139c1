// What the prefilters need to know of a texel: one value, or four packed as RGBA.
#pragma once

#include <cstdint>
#include <penumbra/geometry.hpp>
#include <type_traits>

namespace penumbra::detail {

template <class Texel>
struct TexelTraits {
    using Value = Texel;
    static constexpr int channels = 1;
    template <class T>
    using Mean = T;
};
template <class U>
struct TexelTraits<glm::vec<4, U, glm::defaultp>> {
    using Value = U;
    static constexpr int channels = 4;
    template <class T>
    using Mean = glm::vec<4, T, glm::defaultp>;
};

/// The type of a mean over texels, computed in T.
template <class Texel, class T>
using TexelMean = typename TexelTraits<Texel>::template Mean<T>;

/// ⌈log₂ n⌉ for n ≥ 1.
inline int ceil_log2(int n) {
    int exponent = 0;
    while ((1 << exponent) < n) ++exponent;
    return exponent;
}

}  // namespace penumbra::detail
