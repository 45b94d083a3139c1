#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <penumbra/numeric.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

/// Zero, the ends of the range, powers of two and their neighbours, both signs.
template <class T>
std::vector<T> special_values() {
    using Limits = std::numeric_limits<T>;
    std::vector<T> values{T(0), Limits::min(), Limits::max(), Limits::epsilon(), T(1) / T(3)};
#ifndef __FAST_MATH__  // flushes them
    values.push_back(Limits::denorm_min());
#endif
    for (const int exponent : {-100, -24, -1, 0, 1, 23, 24, 100}) {
        const T power = std::ldexp(T(1), exponent);
        values.insert(values.end(), {std::nextafter(power, T(0)), power, std::nextafter(power, Limits::max())});
    }
    for (std::size_t i = 0, n = values.size(); i < n; ++i) values.push_back(-values[i]);
    return values;
}

/// Of every magnitude, both signs.
template <class T>
T any(test::Random& random) {
    const int range = std::numeric_limits<T>::max_exponent - 2;
    const T mantissa = random.in(T(0.5), T(1));
    const int exponent = random.whole(-range, range), sign = random.whole(0, 1);
    return std::ldexp(sign == 0 ? mantissa : -mantissa, exponent);
}

template <class T>
long double wide(T x) {
    return static_cast<long double>(x);
}

/// |a − b| in units of b's last place.
template <class T>
double ulps(T a, long double b) {
    int exponent = 0;
    std::frexp(b, &exponent);
    return static_cast<double>(std::ldexp(std::abs(wide(a) - b), std::numeric_limits<T>::digits - exponent));
}

}  // namespace

TEST_CASE_TEMPLATE("clamp and saturate are exact, and in range for every input", T, float, double) {
    const std::vector<T> values = special_values<T>();
    for (const T x : values) {
        CAPTURE(x);
        CHECK(saturate(x) == std::min(std::max(x, T(0)), T(1)));
        for (const T low : values)
            for (const T high : values)
                if (low <= high && clamp(x, low, high) != std::min(std::max(x, low), high))
                    FAIL("clamp(" << x << ", " << low << ", " << high << ")");
    }
#ifndef __FAST_MATH__
    CHECK(clamp(std::numeric_limits<T>::quiet_NaN(), T(2), T(3)) == T(2));
    CHECK(saturate(std::numeric_limits<T>::quiet_NaN()) == T(0));
    CHECK(saturate(std::numeric_limits<T>::infinity()) == T(1));
    CHECK(saturate(-std::numeric_limits<T>::infinity()) == T(0));
#endif
    static_assert(saturate(T(7)) == T(1) && clamp(T(-1), T(2), T(3)) == T(2), "usable in constant expressions");
}

TEST_CASE_TEMPLATE("saturated_ratio is the quotient's rounding, and has limits at zero", T, float, double) {
    test::Random random(1);
    double worst = 0;
    int outside = 0, inside = 0;
    for (int i = 0; i < 400000; ++i) {
        const T b = std::abs(any<T>(random));
        const T a = i % 2 == 0 ? any<T>(random) : b * random.in(T(-0.5), T(1.5));
        const T ratio = saturated_ratio(a, b);
        outside += !(ratio >= T(0) && ratio <= T(1));
        const long double truth = wide(a) / wide(b);
        if (truth <= 0.0L || truth >= 1.0L) {
            outside += ratio != (truth <= 0.0L ? T(0) : T(1));
        } else if (truth > wide(std::numeric_limits<T>::min())) {
            worst = std::max(worst, ulps(ratio, truth));
            ++inside;
        }
    }
    CHECK(outside == 0);
    CHECK(inside > 50000);
#ifdef __FAST_MATH__  // reciprocals
    CHECK(worst < 3.0);
#else
    CHECK(worst < 0.51);
#endif
    for (const T x : special_values<T>()) CHECK(saturated_ratio(x, T(0)) == (x > T(0) ? T(1) : T(0)));
}

TEST_CASE_TEMPLATE("saturated_ratio is in range in vectorised loops over the whole range", T, float, double) {
    using Limits = std::numeric_limits<T>;
    std::vector<T> edges = special_values<T>();
    for (int k = 1; k < 9; ++k) {  // where a reciprocal is a denormal, or its own reciprocal overflows
        edges.insert(edges.end(), {Limits::max() / static_cast<T>(k), Limits::min() * static_cast<T>(k)});
        edges.insert(edges.end(), {T(1) / Limits::epsilon() * static_cast<T>(k), Limits::denorm_min() * T(1000 * k)});
    }
    std::vector<T> ratio(edges.size());
    int outside = 0, off = 0;
    for (const T denominator : edges) {
        if (denominator < T(0)) continue;
        for (std::size_t i = 0; i < edges.size(); ++i) ratio[i] = saturated_ratio(edges[i], denominator);
#ifdef __FAST_MATH__
        if (denominator < Limits::min() || denominator > Limits::max() / T(4)) {
            for (const T r : ratio) outside += !is_finite(r) || !(r >= T(0) && r <= T(1));
            continue;
        }
        const T bound = T(3) * Limits::epsilon() + (denominator * Limits::epsilon() < Limits::min() ? T(1e-3) : T(0));
#else
        const T bound = Limits::epsilon() / T(2);
#endif
        for (std::size_t i = 0; i < edges.size(); ++i) {
            outside += !is_finite(ratio[i]) || !(ratio[i] >= T(0) && ratio[i] <= T(1));
            const long double quotient =
                denominator > T(0) ? wide(edges[i]) / wide(denominator) : (edges[i] > T(0) ? 1.0L : 0.0L);
            off += std::abs(wide(ratio[i]) - std::min(std::max(quotient, 0.0L), 1.0L)) > wide(bound);
        }
    }
    CHECK(outside == 0);
    CHECK(off == 0);
}

TEST_CASE_TEMPLATE("safe_ratio is the quotient, and finite for numerators below 1/ε", T, float, double) {
    test::Random random(4);
    double worst = 0;
    int infinite = 0, fell_back = 0;
    for (int i = 0; i < 100000; ++i) {
        const T a = any<T>(random), b = any<T>(random);
        if (std::min(std::abs(a), std::abs(b)) < std::numeric_limits<T>::min()) continue;  // see below
        const long double truth = wide(a) / wide(b), size = std::abs(truth);
        const bool fits = size > wide(std::numeric_limits<T>::min()) * 4 && size < wide(std::numeric_limits<T>::max());
        const T ratio = safe_ratio(a, b, T(9));
        if (fits) worst = std::max(worst, ulps(ratio, truth));
        // the largest quotient that the comment allows: 1 / (ε · smallest) does not fit, so |b| ≥ 4 / (ε max)
        const T small = std::copysign(random.in(T(0), T(1)) / std::numeric_limits<T>::epsilon(), a);
        const T least = T(4) / (std::numeric_limits<T>::epsilon() * std::numeric_limits<T>::max());
        infinite += std::abs(b) >= least && !is_finite(safe_ratio(small, b, T(9)));
        fell_back += ratio == T(9);
    }
    CHECK(infinite == 0);
    CHECK(fell_back == 0);
#ifdef __FAST_MATH__
    CHECK(worst < 3.0);
#else
    CHECK(worst < 0.51);
#endif
}

TEST_CASE_TEMPLATE("safe_ratio falls back where the denominator is no normal number", T, float, double) {
    constexpr T smallest = std::numeric_limits<T>::min();
    for (const T sign : {T(1), T(-1)}) {
        CHECK(safe_ratio(T(3), sign * T(2), T(9)) == sign * T(1.5));
        CHECK(safe_ratio(T(1), sign * smallest, T(9)) ==
              doctest::Approx(static_cast<double>(sign / smallest)).epsilon(1e-6));
        CHECK(safe_ratio(T(1), sign * T(0), T(9)) == T(9));
        CHECK(safe_ratio(T(0), sign * T(0), T(9)) == T(9));
#ifndef __FAST_MATH__
        CHECK(safe_ratio(T(1), std::nextafter(sign * smallest, T(0)), T(9)) == T(9));
#endif
    }
}

TEST_CASE_TEMPLATE("mix hits both ends exactly and stays between them", T, float, double) {
    test::Random random(2);
    int wrong = 0;
    for (int i = 0; i < 100000; ++i) {
        const T a = random.in(T(-5), T(5)), b = random.in(T(-5), T(5)), t = random.in(T(0), T(1));
        wrong += mix(a, b, T(0)) != a || mix(a, b, T(1)) != b;
        const long double truth = wide(a) + wide(t) * (wide(b) - wide(a));
        const T bound = T(2) * std::numeric_limits<T>::epsilon() * std::max(std::abs(a), std::abs(b));
        wrong += std::abs(wide(mix(a, b, t)) - truth) > wide(bound);
    }
    CHECK(wrong == 0);
}

TEST_CASE("difference_of_products keeps its digits where the products cancel") {
    test::Random random(3);
    double worst = 0, worst_plain = 0;
    for (int i = 0; i < 200000; ++i) {
        const float a = random.in(0.5F, 2.0F), b = random.in(0.5F, 2.0F), c = random.in(0.5F, 2.0F);
        const float nudge = random.in(-3e-7F, 3e-7F);
        const float d = a * b / c * (1 + nudge);
        const long double truth = wide(a) * wide(b) - wide(c) * wide(d);
        if (truth == 0.0L) continue;
        worst = std::max(worst, ulps(difference_of_products(a, b, c, d), truth));
        worst_plain = std::max(worst_plain, ulps(static_cast<float>(a * b) - static_cast<float>(c * d), truth));
    }
    CHECK(worst <= 1.5);
    CHECK(worst_plain > 1000);  // the inputs do cancel
    // in double, factors of 27 bits: products of 54 bits are exact in integers, not in double
    worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const std::int64_t a = random.whole(1 << 26, (1 << 27) - 1), b = random.whole(1 << 26, (1 << 27) - 1);
        const std::int64_t c = a + random.whole(-3, 3), d = b + random.whole(-3, 3);
        const std::int64_t truth = a * b - c * d;
        const double result = difference_of_products(static_cast<double>(a), static_cast<double>(b),
                                                     static_cast<double>(c), static_cast<double>(d));
        worst = std::max(worst, std::abs(result - static_cast<double>(truth)));
    }
#ifdef __FAST_MATH__  // may take the correction away again
    CHECK(worst <= 8.0);
#else
    CHECK(worst == 0.0);
#endif
}

#ifndef __FAST_MATH__
TEST_CASE("difference_of_products of doubles is within 1.5 ULP, cancelling or not") {
    test::Random random(5);
    double worst = 0, worst_plain = 0;
    for (int i = 0; i < 50000; ++i) {
        const double size = static_cast<double>(any<float>(random));  // products far from the ends of the range
        const double a = size * random.in(0.5, 1.0), b = random.in(0.5, 1.0) / size;
        const double c = a * random.in(0.5, 1.0), nudge = random.in(-1.0, 1.0);
        const double d = i % 2 == 0 ? a * b / c * (1 + nudge * 1e-15) : b * nudge;
        // each product as a sum of two long doubles, exactly
        const long double ab = wide(a) * wide(b), cd = wide(c) * wide(d);
        const long double rest = std::fma(wide(a), wide(b), -ab) - std::fma(wide(c), wide(d), -cd);
        const long double truth = (ab - cd) + rest;
        if (truth == 0.0L) continue;
        worst = std::max(worst, ulps(difference_of_products(a, b, c, d), truth));
        const volatile double plain_ab = a * b, plain_cd = c * d;  // volatile: not fused
        worst_plain = std::max(worst_plain, ulps(plain_ab - plain_cd, truth));
    }
    CHECK(worst <= 1.5);
    CHECK(worst_plain > 1000);  // the inputs do cancel
}
#endif

TEST_CASE_TEMPLATE("floor_log2 is exact at and beside every power of two", T, float, double) {
    using Limits = std::numeric_limits<T>;
    for (int exponent = Limits::min_exponent - 1; exponent < Limits::max_exponent; ++exponent) {
        CAPTURE(exponent);
        const T power = std::ldexp(T(1), exponent);
        CHECK(exp2_int<T>(exponent) == power);
        CHECK(floor_log2(power) == exponent);
        CHECK(floor_log2(-power) == exponent);
        CHECK(floor_log2(std::nextafter(power, Limits::max())) == exponent);
        if (exponent > Limits::min_exponent - 1) CHECK(floor_log2(std::nextafter(power, T(0))) == exponent - 1);
    }
    CHECK(floor_log2(T(0)) == Limits::min_exponent - 2);
    CHECK(floor_log2(Limits::infinity()) == Limits::max_exponent);
    CHECK(floor_log2(Limits::quiet_NaN()) == Limits::max_exponent);
    CHECK(floor_log2(Limits::denorm_min()) == Limits::min_exponent - 2);
}

TEST_CASE_TEMPLATE("is_finite reads bits, under every flag", T, float, double) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const auto from_bits = [](Bits bits) {
        T x;
        std::memcpy(&x, &bits, sizeof x);
        return x;
    };
    constexpr int mantissa = std::numeric_limits<T>::digits - 1;
    constexpr Bits exponent = (~Bits(0) >> 1) >> mantissa << mantissa, sign = Bits(1) << (sizeof(T) * 8 - 1);
    for (const Bits side : {Bits(0), sign}) {
        CHECK(!is_finite(from_bits(side | exponent)));      // infinity
        CHECK(!is_finite(from_bits(side | exponent | 1)));  // NaNs
        CHECK(!is_finite(from_bits(side | ~sign)));
        CHECK(is_finite(from_bits(side | (exponent - 1))));  // the largest
        CHECK(is_finite(from_bits(side | 1)));               // the smallest
        CHECK(is_finite(from_bits(side)));
    }
}
