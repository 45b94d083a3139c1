#include <doctest/doctest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>
#include <penumbra/combine.hpp>
#include <utility>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

constexpr Combination rules[] = {Combination::product, Combination::sum, Combination::max, Combination::mean};

template <class T>
T pair_of(Combination rule, T a, T b) {
    switch (rule) {
        case Combination::product:
            return combine_product(a, b);
        case Combination::sum:
            return combine_sum(a, b);
        case Combination::max:
            return combine_max(a, b);
        case Combination::mean:
            break;
    }
    return combine_mean(a, b);
}

/// The rules from their definitions, in long double.
template <class T>
long double truth_of(Combination rule, const std::vector<T>& occlusions) {
    long double either = 0, total = 0, largest = 0;
    for (const T occlusion : occlusions) {
        const auto o = static_cast<long double>(occlusion);
        either += o * (1 - either);
        total += o;
        largest = std::max(largest, o);
    }
    total = std::min(total, 1.0L);
    switch (rule) {
        case Combination::product:
            return either;
        case Combination::sum:
            return total;
        case Combination::max:
            return largest;
        case Combination::mean:
            break;
    }
    return (largest + total) / 2;
}

template <class T>
std::vector<T> occlusions_of_note() {
    constexpr T tiny = std::numeric_limits<T>::min(), step = std::numeric_limits<T>::epsilon();
    return {T(0), tiny, step, step / 2, T(0.25), T(0.5), T(1) / T(3), T(1) - step, T(1) - step / 2, T(1)};
}

}  // namespace

TEST_CASE_TEMPLATE("each pair stays in [max, min(1, sum)], whatever is rounded", T, float, double) {
    test::Random random(1);
    std::vector<T> values = occlusions_of_note<T>();
    for (int i = 0; i < 300; ++i) {
        const T share = random.in(T(0), T(1));
        values.push_back(i % 2 == 0 ? share : std::ldexp(share, -random.whole(0, 60)));
    }
    int wrong = 0;
    for (const T a : values) {
        for (const T b : values) {
            const OcclusionBounds<T> bounds = occlusion_bounds(a, b);
            wrong += bounds.lower != std::max(a, b) || bounds.upper != std::min(T(1), a + b);
            for (const Combination rule : rules) {
                const T both = pair_of(rule, a, b);
                wrong += both < bounds.lower || both > bounds.upper;  // hence in [0, 1]
                wrong += both != pair_of(rule, b, a);
                const auto error = std::abs(static_cast<long double>(both) - truth_of<T>(rule, {a, b}));
                const T bound =
                    T(2) * std::numeric_limits<T>::epsilon() * std::max(both, std::numeric_limits<T>::min());
                wrong += error > static_cast<long double>(bound);
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("nothing and everything are exact", T, float, double) {
    for (const Combination rule : rules) {
        for (const T a : occlusions_of_note<T>()) {
            CAPTURE(a);
            CHECK(pair_of(rule, a, T(0)) == a);
            CHECK(pair_of(rule, a, T(1)) == T(1));
        }
        CHECK(combine<T>(nullptr, 0, rule) == T(0));
        const T none[] = {T(0), T(0), T(0)}, full[] = {T(0.3), T(1), T(0)};
        CHECK(combine(none, 3, rule) == T(0));
        CHECK(combine(full, 3, rule) == T(1));
    }
}

TEST_CASE_TEMPLATE("any number: the definitions, in any order, more casters never brighten", T, float, double) {
    test::Random random(2);
    double worst = 0;
    int brighter = 0, outside = 0;
#ifdef __FAST_MATH__  // adds up in another order each time
    const T slack = T(64) * std::numeric_limits<T>::epsilon();
#else
    const T slack = T(0);
#endif
    for (int i = 0; i < 20000; ++i) {
        std::vector<T> occlusions(static_cast<std::size_t>(random.whole(1, 64)));
        const T largest = i % 3 == 0 ? T(1) : i % 3 == 1 ? T(0.05) : std::exp2(random.in(T(-60), T(0)));
        for (T& o : occlusions) o = random.in(T(0), largest);
        for (const Combination rule : rules) {
            const T all = combine(occlusions.data(), occlusions.size(), rule);
            const auto truth = truth_of(rule, occlusions);
            worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(all) - truth)));
            // of the same order, which decides how sums are rounded
            const OcclusionBounds<T> bounds = occlusion_bounds(occlusions.data(), occlusions.size());
            const T fewer = combine(occlusions.data(), occlusions.size() - 1, rule);
            brighter += all < fewer - slack;
            if (i % 2 == 0) std::reverse(occlusions.begin(), occlusions.end());
            for (std::size_t k = occlusions.size() - 1; k > 0; --k)
                std::swap(occlusions[k], occlusions[static_cast<std::size_t>(random.whole(0, static_cast<int>(k)))]);
            worst = std::max(worst,
                             static_cast<double>(std::abs(combine(occlusions.data(), occlusions.size(), rule) - all)));
            outside += all < bounds.lower - slack || all > bounds.upper + slack;
        }
    }
    CHECK(worst < 64 * static_cast<double>(std::numeric_limits<T>::epsilon()));  // a rounding each
    CHECK(brighter == 0);
    CHECK(outside == 0);
}

TEST_CASE_TEMPLATE("one caster is itself, however faint, and faint ones do not vanish", T, float, double) {
    test::Random random(4);
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const T faint = std::exp2(random.in(T(-120), T(0))), more[] = {faint, faint};
        for (const Combination rule : rules) {
            wrong += combine(&faint, 1, rule) != faint;
            wrong += combine(more, 2, rule) < faint || combine(more, 2, rule) > T(2) * faint;
        }
    }
    CHECK(wrong == 0);
    static_assert(combine_product(T(0.5), T(0.5)) == T(0.75) && combine_sum(T(0.75), T(0.5)) == T(1) &&
                      combine_max(T(0.25), T(0.5)) == T(0.5) && combine_mean(T(0.5), T(0.5)) == T(0.75),
                  "usable in constant expressions");
}

TEST_CASE_TEMPLATE("the interval holds the union of intervals on a line, sorted and measured", T, float, double) {
    test::Random random(5);
    int outside = 0, between = 0;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::pair<double, double>> parts;
        std::vector<T> occlusions;
        const int casters = random.whole(1, 12);
        const double longest = i % 2 == 0 ? 1.0 : 0.1;
        for (int k = 0; k < casters; ++k) {
            const double start = random.in(0.0, 1.0), length = random.in(0.0, longest);
            parts.emplace_back(start, std::min(1.0, start + length));
            occlusions.push_back(static_cast<T>(parts.back().second - start));
        }
        std::sort(parts.begin(), parts.end());
        double truth = 0, end = 0;
        for (const auto& [low, high] : parts) {
            truth += std::max(0.0, high - std::max(low, end));
            end = std::max(end, high);
        }
        const OcclusionBounds<T> bounds = occlusion_bounds(occlusions.data(), occlusions.size());
        const double slack = 12 * static_cast<double>(std::numeric_limits<T>::epsilon());  // a rounding each
        outside += truth < static_cast<double>(bounds.lower) - slack;
        outside += truth > static_cast<double>(bounds.upper) + slack;
        between += truth > static_cast<double>(bounds.lower) + 0.01 && truth < static_cast<double>(bounds.upper) - 0.01;
    }
    CHECK(outside == 0);
    CHECK(between > 5000);
}

TEST_CASE("the interval holds the union of any casters, and the product is its mean over random ones") {
    // casters are random parts of a light of 512 cells: the union is counted
    test::Random random(3);
    constexpr std::size_t cells = 512;
    int outside = 0, touched_low = 0, touched_high = 0;
    double sum_union = 0, sum_product = 0;
    for (int i = 0; i < 4000; ++i) {
        std::bitset<cells> together;
        std::vector<double> occlusions;
        const int casters = random.whole(1, 6), kind = i % 3;
        for (int k = 0; k < casters; ++k) {
            std::bitset<cells> caster;
            const int size = random.whole(0, 150), start = kind == 0 ? 0 : kind == 1 ? 80 * k : 0;
            for (int c = 0; c < size; ++c)
                caster.set(static_cast<std::size_t>(kind == 2 ? random.whole(0, 511) : (start + c) % 512));
            occlusions.push_back(static_cast<double>(caster.count()) / cells);
            together |= caster;
        }
        const double truth = static_cast<double>(together.count()) / cells;
        const auto bounds = occlusion_bounds(occlusions.data(), occlusions.size());
        outside += truth < bounds.lower || truth > bounds.upper;
        touched_low += kind == 0 && truth == bounds.lower;
        touched_high += kind == 1 && truth == bounds.upper;
        if (kind == 2) {
            sum_union += truth;
            sum_product += combine(occlusions.data(), occlusions.size(), Combination::product);
        }
    }
    CHECK(outside == 0);
    CHECK(touched_low > 1000);  // nested: max is right
    CHECK(touched_high > 300);  // side by side: sum is right
    CHECK(sum_product / sum_union == doctest::Approx(1).epsilon(0.005));
}
