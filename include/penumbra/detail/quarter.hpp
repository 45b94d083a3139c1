// Means of four, one or many of them: what mip-maps and N-Buffers are built of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace penumbra::detail {

/// A quarter of a sum of four. Bytes round halves up and down in turn, level by level, which leaves no bias.
template <class Value>
Value quarter(Value a, Value b, Value c, Value d, int level) {
    if constexpr (std::is_integral_v<Value>) {
        const unsigned bias = level % 2 == 0 ? 2U : 1U;
        return static_cast<Value>((static_cast<unsigned>(a) + static_cast<unsigned>(b) + static_cast<unsigned>(c) +
                                   static_cast<unsigned>(d) + bias) >>
                                  2);
    } else {
        return ((a + b) + (c + d)) * Value(0.25);
    }
}

/// result[i] = quarter(a[i], b[i], c[i], d[i], level), 0 ≤ i < count. The result overlaps no source.
template <class Value>
void write_quarters(const Value* __restrict a, const Value* __restrict b, const Value* __restrict c,
                    const Value* __restrict d, Value* __restrict result, std::ptrdiff_t count, int level) {
    for (std::ptrdiff_t i = 0; i < count; ++i) result[i] = quarter(a[i], b[i], c[i], d[i], level);
}

/// Small unsigned integers are averaged several at once, in the lanes of a 64-bit word: of such words compilers make
/// vectors, where of bytes they make vectors of wider integers.
template <class Value>
inline constexpr bool fits_lanes = std::is_unsigned_v<Value> && sizeof(Value) <= 2;

template <class Value>
struct Lanes {
    using Word = std::uint64_t;
    static constexpr std::ptrdiff_t count = static_cast<std::ptrdiff_t>(sizeof(Word) / sizeof(Value));
    static constexpr Word ones = ~Word(0) / std::numeric_limits<Value>::max();
    static constexpr Word below_top = ~(ones << (8 * sizeof(Value) - 1));

    static Word load(const Value* values) {
        Word word;
        std::memcpy(&word, values, sizeof word);
        return word;
    }
    static void store(Word word, Value* values) { std::memcpy(values, &word, sizeof word); }

    /// Half of a + b, rounded up, given a ^ b.
    static Word half_up(Word a, Word differs) { return (a | differs) - ((differs >> 1) & below_top); }

    /// quarter() in each lane, for a level of this parity. Halves of halves, all rounded up, are at most 1 too large:
    /// the bits that were lost tell where.
    template <int Parity>
    static Word quarter(Word a, Word b, Word c, Word d) {
        const Word a_b = a ^ b, c_d = c ^ d, ab = half_up(a, a_b), cd = half_up(c, c_d), ab_cd = ab ^ cd;
        const Word excess = Parity == 0 ? ab_cd & (a_b | c_d) : ab_cd | (a_b & c_d);
        return half_up(ab, ab_cd) - (excess & ones);
    }
};

/// Lanes of quarter(a[i], a[i + reach] & mask[i], c[i], c[i + reach] & mask[i]), `count` a multiple of a word's values.
template <int Parity, bool Below, class Value>
void write_masked_words(const Value* __restrict a, const Value* __restrict c, std::ptrdiff_t reach,
                        const Value* __restrict mask, Value* __restrict result, std::ptrdiff_t count) {
    using L = Lanes<Value>;
    for (std::ptrdiff_t i = 0; i < count; i += L::count) {
        const auto inside = L::load(mask + i);
        if constexpr (Below)
            L::store(L::template quarter<Parity>(L::load(a + i), L::load(a + reach + i) & inside, L::load(c + i),
                                                 L::load(c + reach + i) & inside),
                     result + i);
        else
            L::store(L::template quarter<Parity>(L::load(a + i), L::load(a + reach + i) & inside, 0, 0), result + i);
    }
}

/// The same for any count from a cache line on, with a mask that repeats every `period` values, and holds so many more
/// than mask_chunk. Without Below, c is not read.
inline constexpr std::ptrdiff_t mask_chunk = 8192;

template <int Parity, bool Below, class Value>
void write_masked_quarters(const Value* a, const Value* c, std::ptrdiff_t reach, const Value* mask,
                           std::ptrdiff_t period, Value* result, std::ptrdiff_t count) {
    using L = Lanes<Value>;
    constexpr std::ptrdiff_t line = 64 / static_cast<std::ptrdiff_t>(sizeof(Value));
    const auto write = [&](std::ptrdiff_t begin, std::ptrdiff_t size) {
        write_masked_words<Parity, Below>(a + begin, Below ? c + begin : c, reach, mask + begin % period,
                                          result + begin, size);
    };
    const auto round_up = [](std::ptrdiff_t values) { return (values + L::count - 1) / L::count * L::count; };
    // whole cache lines, which are written far faster, between words that may overlap them
    const auto past = static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(result) % 64 / sizeof(Value));
    std::ptrdiff_t begin = line - past;
    write(0, round_up(begin));
    for (std::ptrdiff_t size; (size = std::min((count - begin) / line * line, mask_chunk)) > 0; begin += size)
        write(begin, size);
    const std::ptrdiff_t tail = round_up(count - begin);
    write(count - tail, tail);
}

}  // namespace penumbra::detail
