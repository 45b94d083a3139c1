#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/soft_shadow_map/light_interval.hpp>
#include <utility>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;
using test::Random;

namespace {

using Part = std::pair<double, double>;

/// Length of a union, by sorting.
double measure(std::vector<Part> parts) {
    std::sort(parts.begin(), parts.end());
    double sum = 0.0, end = 0.0;
    for (const Part& part : parts) {
        sum += std::max(0.0, part.second - std::max(end, part.first));
        end = std::max(end, part.second);
    }
    return sum;
}

template <class T>
RowPoint<T> at(double x, double z) {
    return {static_cast<T>(x / z), static_cast<T>(1.0 / z)};
}

/// Is the way from the point (px, pz) to position l on the light blocked by the segment? In double, by signs.
bool blocked(double ax, double az, double bx, double bz, double px, double pz, double l) {
    const auto side = [](double ox, double oz, double tx, double tz, double x, double z) {
        return (tx - ox) * (z - oz) - (tz - oz) * (x - ox);
    };
    const bool across = side(px, pz, l, 0.0, ax, az) * side(px, pz, l, 0.0, bx, bz) < 0.0;
    return across && side(ax, az, bx, bz, px, pz) * side(ax, az, bx, bz, l, 0.0) < 0.0;
}

}  // namespace

TEST_CASE_TEMPLATE("what a segment hides, against rays to positions on the light", T, float, double) {
    Random random(1);
    int hidden = 0, open = 0;
    for (int i = 0; i < 4000; ++i) {
        const double az = random.in(0.5, 6.0), bz = random.in(0.5, 6.0), pz = random.in(1.0, 8.0);
        const double ax = random.in(-3.0, 3.0), bx = random.in(-3.0, 3.0), px = random.in(-3.0, 3.0);
        const double first = random.in(-2.0, 0.0), last = first + random.in(0.2, 3.0);
        const LightInterval<T> interval =
            hidden_interval(at<T>(ax, az), at<T>(bx, bz), at<T>(px, pz), static_cast<T>(first), static_cast<T>(last));
        CHECK(((interval.low >= T(0) && interval.high <= T(1)) || !(interval.low < interval.high)));
        for (int k = 0; k < 16; ++k) {
            const double share = random.in(0.0, 1.0), margin = 2e-4;
            const bool truth = blocked(ax, az, bx, bz, px, pz, first + share * (last - first));
            const bool near = std::abs(static_cast<double>(interval.low) - share) < margin ||
                              std::abs(static_cast<double>(interval.high) - share) < margin;
            if (near) continue;
            const bool inside = static_cast<double>(interval.low) < share && share < static_cast<double>(interval.high);
            CHECK(inside == truth);
            ++(truth ? hidden : open);
        }
    }
    CHECK(hidden > 5000);
    CHECK(open > 5000);
}

TEST_CASE_TEMPLATE("degenerate segments and lights", T, float, double) {
    const RowPoint<T> point = at<T>(0.0, 4.0);
    const auto length = [](const LightInterval<T>& i) { return std::max(i.high - i.low, T(0)); };
    // behind the point, level with it, on it, of no length
    CHECK(length(hidden_interval(at<T>(-1.0, 5.0), at<T>(1.0, 6.0), point, T(-1), T(1))) == T(0));
    CHECK(length(hidden_interval(at<T>(-1.0, 4.0), at<T>(1.0, 4.0), point, T(-1), T(1))) == T(0));
    CHECK(length(hidden_interval(point, point, point, T(-1), T(1))) == T(0));
    CHECK(length(hidden_interval(at<T>(0.0, 2.0), at<T>(0.0, 2.0), point, T(-1), T(1))) == T(0));
    // through the point, away from it: nothing of what lies beyond it on one line
    CHECK(length(hidden_interval(at<T>(0.0, 2.0), at<T>(0.0, 5.0), point, T(-1), T(1))) == T(0));
    // from before the point to behind it: all on one side
    const LightInterval<T> side = hidden_interval(at<T>(0.0, 2.0), at<T>(2.0, 6.0), point, T(-1), T(1));
    CHECK(side.low == doctest::Approx(0.5));
    CHECK(side.high == T(1));
    // a light of no length: all or nothing
    CHECK(length(hidden_interval(at<T>(-1.0, 2.0), at<T>(1.0, 2.0), point, T(0), T(0))) == T(1));
    CHECK(length(hidden_interval(at<T>(1.0, 2.0), at<T>(2.0, 2.0), point, T(0), T(0))) == T(0));
    // wider than the light: exactly all
    const LightInterval<T> all = hidden_interval(at<T>(-9.0, 2.0), at<T>(9.0, 2.0), point, T(-1), T(1));
    CHECK(all.low == T(0));
    CHECK(all.high == T(1));
}

TEST_CASE_TEMPLATE("unions, against sorting", T, float, double) {
    Random random(2);
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    for (int i = 0; i < 4000; ++i) {
        LightUnion<T> all;
        LightMask<T> mask;
        std::vector<Part> parts;
        const int count = random.whole(0, 12);  // never more than capacity with gaps between
        for (int k = 0; k < count; ++k) {
            T low = static_cast<T>(random.whole(0, 3) == 0 ? 0.0 : random.in(0.0, 1.0));
            T high = static_cast<T>(random.whole(0, 3) == 0 ? 1.0 : random.in(0.0, 1.0));
            if (!parts.empty() && random.whole(0, 3) == 0) low = static_cast<T>(parts.back().second);  // abutting
            if (i % 2 == 0) high = std::min(high, low + T(0.1));
            all.add({low, high}), mask.add({low, high});
            if (low < high) parts.emplace_back(static_cast<double>(low), static_cast<double>(high));
        }
        const double truth = measure(parts);
        CHECK(std::abs(static_cast<double>(all.share()) - truth) <= 16.0 * epsilon);
        CHECK(all.is_full() == (truth == 1.0));
        CHECK(std::abs(static_cast<double>(mask.share()) - truth) <= count / 128.0);
        if (mask.is_full()) CHECK(truth > 0.9);
    }
}

TEST_CASE_TEMPLATE("more intervals than a union keeps: the smallest gaps are closed", T, float, double) {
    LightUnion<T> all;
    constexpr int count = 24;
    double covered = 0.0;
    std::vector<double> gaps;
    double from = 0.0;
    for (int k = 0; k < count; ++k) {
        const double gap = 0.005 + 0.001 * ((k * 7) % count), length = 0.01;
        if (k > 0) gaps.push_back(gap);
        from += gap;
        all.add({static_cast<T>(from), static_cast<T>(from + length)});
        covered += length, from += length;
    }
    REQUIRE(from < 1.0);
    const double share = static_cast<double>(all.share());
    CHECK(share > covered);
    // one at a time, in the order of coming: not always the smallest of all, but never more than the largest of them
    std::sort(gaps.begin(), gaps.end());
    double closed = 0.0, largest = 0.0;
    for (int k = 0; k < count - LightUnion<T>::capacity; ++k)
        closed += gaps[static_cast<std::size_t>(k)], largest += gaps[gaps.size() - 1 - static_cast<std::size_t>(k)];
    CHECK(share >= covered + closed - 1e-5);
    CHECK(share <= covered + largest + 1e-5);
}

TEST_CASE_TEMPLATE("masks: cells by their centres, RMS error of one interval 1 / 313", T, float, double) {
    LightMask<T> mask;
    mask.add({T(0), T(1)});
    CHECK(mask.is_full());
    CHECK(mask.share() == T(1));
    LightMask<T> half;
    half.add({T(0), T(0.5)});
    CHECK(half.share() == T(0.5));
    CHECK(!half.is_full());
    half.add({T(0.5), T(0.5)});
    half.add({T(0.7), T(0.2)});
    CHECK(half.share() == T(0.5));
    Random random(4);
    double squares = 0.0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const T a = random.in(T(0), T(1)), b = random.in(T(0), T(1)), low = std::min(a, b), high = std::max(a, b);
        LightMask<T> one;
        one.add({low, high});
        const double error = static_cast<double>(one.share()) - static_cast<double>(high - low);
        CHECK(std::abs(error) <= 1.0 / 128.0 + 1e-6);
        squares += error * error;
    }
    CHECK(std::sqrt(squares / count) == doctest::Approx(1.0 / 313.0).epsilon(0.03));
}
