// The summed-area table of integers, fast.
//
// A running sum is one long chain of additions, a texel a step. Integers may be added in any order, so: neighbours are
// added first, which halves the work; each pair becomes the sum of the 16 pairs that end with it, in two steps of four
// additions, for which there are no chains; then 16 chains run side by side, 32 texels a step. Compilers make vector
// instructions of every loop. Columns are summed where even and odd ones lie apart, and interleaved on the way out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace penumbra::detail {

/// Two texels in memory, and a lane for sums of up to 16 pairs.
template <class U>
using TexelPair = std::conditional_t<std::is_same_v<U, std::uint8_t>, std::uint16_t, std::uint32_t>;

template <class U, class Sum>
inline constexpr bool sums_in_pairs = (std::is_same_v<U, std::uint8_t> ||
                                       std::is_same_v<U, std::uint16_t>)&&std::is_integral_v<Sum> &&
                                      sizeof(Sum) >= sizeof(TexelPair<U>);

inline constexpr int pair_block = 16, pair_strip = 512;  ///< pairs
inline constexpr int pair_margin = 32;                   ///< zeros before a row: a cache line at least

/// Two neighbours, in one lane and apart.
template <class U>
struct Pairs {
    using Pair = TexelPair<U>;
    static constexpr int bits = 8 * sizeof(U);
    static constexpr Pair one = static_cast<U>(~U(0));

    static Pair load(const U* texels) {
        Pair pair;
        std::memcpy(&pair, texels, sizeof pair);
        return pair;
    }
    static Pair sum(Pair pair) { return static_cast<Pair>((pair & one) + (pair >> bits)); }
    static Pair second(Pair pair) {
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
        return static_cast<Pair>(pair & one);
#else
        return static_cast<Pair>(pair >> bits);
#endif
    }
};

/// sums[i] = the sum of pairs i − 15 … i of a row, those before the row being 0.
template <class U, class Pair = TexelPair<U>>
void sum_sixteens(const U* __restrict row, Pair* __restrict ones, Pair* __restrict fours, Pair* __restrict sixteens,
                  int pairs) {
    for (int i = 0; i < pairs; ++i) ones[i] = Pairs<U>::sum(Pairs<U>::load(row + 2 * i));
    for (int i = 0; i < pairs; ++i) fours[i] = static_cast<Pair>(ones[i] + ones[i - 1] + ones[i - 2] + ones[i - 3]);
    for (int i = 0; i < pairs; ++i)
        sixteens[i] = static_cast<Pair>(fours[i] + fours[i - 4] + fours[i - 8] + fours[i - 12]);
}

/// Adds a row to the columns' sums so far, and writes them.
template <class U, class Wide, class Sum, class Pair = TexelPair<U>>
void add_row(const U* __restrict row, const Pair* __restrict sixteens, Wide before, Wide* __restrict even,
             Wide* __restrict odd, Sum* __restrict out, int pairs) {
    Wide sums[pair_block];
    for (Wide& sum : sums) sum = before;
    for (int block = 0; block < pairs; block += pair_block) {
        for (int k = 0; k < pair_block; ++k) {
            const int i = block + k;
            sums[k] += sixteens[i];
            odd[i] += sums[k];
            even[i] += sums[k] - Pairs<U>::second(Pairs<U>::load(row + 2 * i));
            out[2 * i] = static_cast<Sum>(even[i]);
            out[2 * i + 1] = static_cast<Sum>(odd[i]);
        }
    }
}

/// A strip of columns, 2 · pair_strip of them at most, and what lies to the left of it in the table.
template <class U, class Sum>
void build_summed_strip(const U* image, int pairs, int height, std::ptrdiff_t image_stride, Sum* table,
                        std::ptrdiff_t table_stride) {
    using Pair = TexelPair<U>;
    using Wide = std::make_unsigned_t<Sum>;  // may wrap around
    alignas(64) Pair ones[pair_margin + pair_strip] = {}, fours[pair_margin + pair_strip] = {};
    alignas(64) Pair sixteens[pair_margin + pair_strip] = {};
    alignas(64) Wide even[pair_strip] = {}, odd[pair_strip] = {};
    for (int y = 0; y < height; ++y) {
        const U* row = image + y * image_stride;
        const Sum* left = table + y * table_stride;
        Sum* out = table + (y + 1) * table_stride;
        sum_sixteens(row, ones + pair_margin, fours + pair_margin, sixteens + pair_margin, pairs);
        add_row(row, sixteens + pair_margin, static_cast<Wide>(static_cast<Wide>(*out) - static_cast<Wide>(*left)),
                even, odd, out + 1, pairs);
    }
}

/// The columns of a table from 1 on, as many as blocks fill; column 0 and row 0 hold zeros. Returns how many.
template <class U, class Sum>
int build_summed_strips(const U* image, int width, int height, std::ptrdiff_t image_stride, Sum* table,
                        std::ptrdiff_t table_stride) {
    const int pairs = width / 2 / pair_block * pair_block;
    for (int first = 0; first < pairs; first += pair_strip)
        build_summed_strip(image + 2 * first, std::min(pairs - first, pair_strip), height, image_stride,
                           table + 2 * first, table_stride);
    return 2 * pairs;
}

}  // namespace penumbra::detail
