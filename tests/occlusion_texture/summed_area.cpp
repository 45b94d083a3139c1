#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../support/box_mean.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

constexpr std::pair<int, int> awkward[] = {{1, 1}, {1, 6}, {6, 1}, {17, 13}};

template <class Sum, class Texel>
Sum brute_force(const Image<Texel>& image, int x0, int y0, int x1, int y1) {
    Sum sum = Sum(0);
    for (int y = std::max(y0, 0); y < std::min(y1, image.height()); ++y)
        for (int x = std::max(x0, 0); x < std::min(x1, image.width()); ++x)
            sum = static_cast<Sum>(sum + static_cast<Sum>(image(x, y)));
    return sum;
}

template <class T>
Rect2<T> box(T x0, T y0, T x1, T y1) {
    return {Vec2<T>(x0, y0), Vec2<T>(x1, y1)};
}

}  // namespace

TEST_CASE_TEMPLATE("every box of awkward sizes, and beyond their borders, is summed exactly", Sum, std::uint32_t,
                   std::uint64_t, float, double) {
    test::Random random(1);
    for (const auto& size : awkward) {
        const Image<std::uint8_t> image = test::random_bytes(random, size.first, size.second);
        const SummedArea<Sum> table(image);
        int wrong = 0;
        for (int y0 = -2; y0 <= size.second + 2; ++y0)
            for (int y1 = -2; y1 <= size.second + 2; ++y1)
                for (int x0 = -2; x0 <= size.first + 2; ++x0)
                    for (int x1 = -2; x1 <= size.first + 2; ++x1)
                        wrong += table.sum(x0, y0, x1, y1) != brute_force<Sum>(image, x0, y0, x1, y1);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a larger table, entry by entry, from every type of texel") {
    test::Random random(2);
    const auto check = [&](auto texel, auto sum, int width, int height) {
        using Texel = decltype(texel);
        using Sum = decltype(sum);
        Image<Texel> image(width, height);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<Texel>(random.whole(0, 255));
        const SummedArea<Sum> table(image);
        int wrong = 0;
        std::vector<Sum> columns(static_cast<std::size_t>(width), Sum(0));
        const Sum* entry = table.data();
        for (int y = 0; y <= height; ++y) {
            Sum row = Sum(0);
            for (int x = 0; x <= width; ++x) {
                wrong += *entry++ != row;
                if (x < width) row = static_cast<Sum>(row + columns[static_cast<std::size_t>(x)]);
            }
            for (int x = 0; y < height && x < width; ++x) {
                Sum& column = columns[static_cast<std::size_t>(x)];
                column = static_cast<Sum>(column + static_cast<Sum>(image(x, y)));
            }
        }
        CHECK(wrong == 0);
        CHECK(table.bytes() ==
              sizeof(Sum) * static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1));
    };
    for (const auto& size : {std::pair(100, 300), std::pair(300, 100), std::pair(1025, 3), std::pair(2063, 5)}) {
        check(std::uint8_t(), std::uint32_t(), size.first, size.second);
        check(std::uint8_t(), std::uint64_t(), size.first, size.second);
        check(std::uint16_t(), std::uint64_t(), size.first, size.second);
        check(std::uint16_t(), std::uint32_t(), size.first, size.second);
        check(float(), double(), size.first, size.second);
        check(float(), float(), size.first, size.second);
    }
}

TEST_CASE("the free builder keeps to its strides") {
    test::Random random(3);
    const Image<std::uint8_t> image = test::random_bytes(random, 40, 7);
    std::vector<std::uint32_t> table(50 * 6, 77U);
    build_summed_area(image.data() + 3, 33, 5, 40, table.data(), 50);
    int wrong = 0;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 50; ++x) {
            std::uint32_t truth = 77;
            if (x <= 33) {
                truth = 0;
                for (int j = 0; j < y; ++j)
                    for (int i = 0; i < x; ++i) truth += image(3 + i, j);
            }
            wrong += table[static_cast<std::size_t>(50 * y + x)] != truth;
        }
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("boxes at fractional positions: the exact mean, at borders too", T, float, double) {
    test::Random random(4);
    const auto run = [&](int width, int height, int count) {
        const Image<std::uint8_t> image = test::random_bytes(random, width, height);
        const SummedArea<std::uint32_t> table(image);
        double worst = 0;
        for (int i = 0; i < count; ++i) {
            const T margin = T(3), w = static_cast<T>(width), h = static_cast<T>(height);
            T x0 = random.in(-margin, w + margin), x1 = random.in(-margin, w + margin);
            T y0 = random.in(-margin, h + margin), y1 = random.in(-margin, h + margin);
            if (i % 2 == 0) x1 = x0 + random.in(T(0.1), T(2)), y1 = y0 + random.in(T(0.1), T(2));
            if (i % 5 == 0) x0 = std::floor(x0), y1 = std::floor(y1) + T(9);
            const Rect2<T> b = box(std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1));
            if (extent(b).x < T(0.0625) || extent(b).y < T(0.0625)) continue;
            const double truth = test::box_mean(image, b);
            worst = std::max(worst, std::abs(static_cast<double>(table.mean(b)) - truth) / 255);
        }
        return worst;
    };
    // fractions lose what positions round: a box of .1 texel at 300 has 300 ε / .1 of itself
    const double bound = static_cast<double>(std::numeric_limits<T>::epsilon()) * 4000;
    for (const auto& size : awkward) CHECK(run(size.first, size.second, 20000) < bound);
    CHECK(run(100, 300, 3000) < bound);
}

TEST_CASE_TEMPLATE("grey values at 4096²: 1e-6 in float, 1e-14 in double, where float tables fail", T, float, double) {
    test::Random random(5);
    Image<std::uint8_t> image = test::random_bytes(random, 4096, 4096);
    const SummedArea<std::uint32_t> table(image);
    const SummedArea<float> floats(image);
    double worst = 0, worst_float = 0;
    for (int i = 0; i < 20000; ++i) {
        // positions with 8 bits of fraction, exact in float
        const T x = std::floor(random.in(T(4000), T(4090)) * T(256)) / T(256);
        const T y = std::floor(random.in(T(4000), T(4090)) * T(256)) / T(256);
        const Rect2<T> b = box(x, y, x + T(4), y + T(4));
        const double truth = test::box_mean(image, b);
        worst = std::max(worst, std::abs(static_cast<double>(table.mean(b)) - truth) / 255);
        worst_float = std::max(worst_float, std::abs(static_cast<double>(floats.mean(b)) - truth) / 255);
    }
    CHECK(worst < (sizeof(T) == 4 ? 1e-6 : 1e-14));
    CHECK(worst_float > 1e-2);
    // large boxes as well
    const Rect2<T> half = box(T(0.5), T(0.25), T(4095), T(2047.5));
    CHECK(std::abs(static_cast<double>(table.mean(half)) - test::box_mean(image, half)) / 255 <
          (sizeof(T) == 4 ? 1e-6 : 1e-14));
}

TEST_CASE("sums that wrap around stay exact while the box's own sum fits") {
    Image<std::uint16_t> image(1200, 400, 65535);  // 3.1e10 in all: the table wraps 7 times
    image(1100, 390) = 1;
    const SummedArea<std::uint32_t> table(image);
    CHECK(table.sum(1000, 300, 1200, 400) == 200U * 100U * 65535U - 65534U);
    CHECK(table.mean(box(1000.0, 200.0, 1050.0, 250.0)) == 65535.0);
    CHECK(table.mean(box(1100.0, 390.0, 1101.0, 391.0)) == 1.0);
}

TEST_CASE_TEMPLATE("a constant field is exact for every box inside, full or empty", T, float, double) {
    const SummedArea<std::uint32_t> full(Image<std::uint8_t>(37, 21, 255)), none(Image<std::uint8_t>(37, 21, 0));
    test::Random random(6);
    double worst = 0;
    bool nothing = true;
    for (int i = 0; i < 20000; ++i) {
        const T x0 = random.in(T(0), T(36)), y0 = random.in(T(0), T(20));
        const T x1 = random.in(x0, T(37)), y1 = random.in(y0, T(21));
        const Rect2<T> b = box(x0, y0, x1, y1);
        nothing = nothing && none.mean(b) == T(0);
        if (x0 < T(0.04) || y0 < T(0.04) || x1 > T(36.96) || y1 > T(20.96)) continue;  // widened beyond the border
        worst = std::max(worst, std::abs(static_cast<double>(full.mean(b)) - 255) / 255);
    }
    CHECK(nothing);
    CHECK(worst < 100 * static_cast<double>(std::numeric_limits<T>::epsilon()));
}

TEST_CASE_TEMPLATE("boxes without size, far away, endless, or not numbers", T, float, double) {
    test::Random random(7);
    const Image<std::uint8_t> image = test::random_bytes(random, 20, 10);
    const SummedArea<std::uint32_t> table(image);
    CHECK(std::abs(table.mean(box(T(3.5), T(4.5), T(3.5), T(4.5))) - static_cast<T>(image(3, 4))) < T(1e-3));
    const Rect2<T> thin = box(T(3.5), T(2), T(3.5), T(8)), widened = box(T(3.46875), T(2), T(3.53125), T(8));
    CHECK(table.mean(thin) == table.mean(widened));
    CHECK(table.mean(box(T(3.53125), T(2), T(3.46875), T(8))) == table.mean(widened));  // ends swapped by a little
    const T huge = T(1e30);
    CHECK(table.mean(box(T(21), T(0), T(25), T(5))) == T(0));
    CHECK(table.mean(box(huge, huge, huge, huge)) == T(0));
    CHECK(table.mean(box(-huge, -huge, -huge, -huge)) == T(0));
    const T all = table.mean(box(-huge, -huge, huge, huge));
    CHECK(all >= T(0));
    CHECK(all < T(1e-9));
    CHECK(table.mean(box(T(-1e5), T(0), T(1e5), T(10))) ==
          doctest::Approx(static_cast<double>(table.sum(0, 0, 20, 10)) / 2e6).epsilon(1e-5));
#ifndef __FAST_MATH__
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const Rect2<T>& b : {box(nan, nan, nan, nan), box(T(1), nan, T(2), T(3)), box(T(1), T(1), T(2), nan)}) {
        const T mean = table.mean(b);
        CHECK(mean >= T(0));
        CHECK(mean <= T(255));
    }
#endif
}

TEST_CASE_TEMPLATE("a grid of boxes is each of its boxes", T, float, double) {
    test::Random random(8);
    const Image<std::uint8_t> image = test::random_bytes(random, 64, 48);
    const SummedArea<std::uint32_t> table(image);
    for (int cells = 1; cells <= 8; ++cells) {
        detail::Boxes<T> boxes;
        while (boxes.count < 61) {
            const T x = random.in(T(-5), T(60)), y = random.in(T(-5), T(40));
            boxes.push(box(x, y, x + random.in(T(0), T(20)), y + random.in(T(0), T(20))));
        }
        detail::BoxGrid<T> grid;
        grid.set(boxes, cells);
        std::vector<std::array<T, detail::Boxes<T>::capacity>> result(static_cast<std::size_t>(cells * cells));
        table.mean(grid, result.data());
        T worst = T(0);
        for (int row = 0; row < cells; ++row)
            for (int column = 0; column < cells; ++column)
                for (std::size_t i = 0; i < grid.count; ++i)
                    worst = std::max(worst, std::abs(result[static_cast<std::size_t>(row * cells + column)][i] -
                                                     table.mean(grid.box(column, row, i))));
        CHECK(worst < T(255) * std::numeric_limits<T>::epsilon() * T(1000));
    }
}

TEST_CASE("an empty image is reported, an empty table reads 0, and rebuilding replaces") {
    CHECK_THROWS_WITH_AS(SummedArea<std::uint32_t>(Image<std::uint8_t>()), "penumbra: image is empty",
                         std::invalid_argument);
    SummedArea<std::uint32_t> table;
    CHECK(table.sum(0, 0, 5, 5) == 0U);
    CHECK(table.mean(box(0.0, 0.0, 5.0, 5.0)) == 0.0);
    CHECK(table.bytes() == 0);
    table.rebuild(Image<std::uint8_t>(30, 20, 3));
    table.rebuild(Image<std::uint8_t>(4, 5, 7));
    CHECK(table.width() == 4);
    CHECK(table.height() == 5);
    CHECK(table.sum(0, 0, 99, 99) == 4U * 5U * 7U);
}
