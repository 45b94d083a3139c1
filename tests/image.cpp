#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/image.hpp>
#include <stdexcept>
#include <string>

#include "support/error_of.hpp"
#include "support/random.hpp"

using namespace penumbra;
using penumbra::test::error_of;

namespace {

/// Tent weights of every texel, borders extended without end: what bilinear interpolation means.
template <class T>
double tents(const Image<T>& image, double x, double y) {
    const auto inside = [](double at, int size) { return std::min(std::max(at, 0.5), size - 0.5); };
    x = inside(x, image.width()), y = inside(y, image.height());
    double sum = 0;
    for (int j = 0; j < image.height(); ++j)
        for (int i = 0; i < image.width(); ++i)
            sum += std::max(0.0, 1 - std::abs(x - i - 0.5)) * std::max(0.0, 1 - std::abs(y - j - 0.5)) *
                   static_cast<double>(image(i, j));
    return sum;
}

}  // namespace

TEST_CASE("an image is a row-major array of its own") {
    Image<int> image(3, 2, 7);
    CHECK(image.width() == 3);
    CHECK(image.height() == 2);
    CHECK(image.size() == 6);
    CHECK(std::count(image.data(), image.data() + 6, 7) == 6);
    image(2, 1) = 1;
    CHECK(image.data()[5] == 1);
    CHECK(image.row(1) == image.data() + 3);
    const Image<int> copy = image;
    image(2, 1) = 2;
    CHECK(copy(2, 1) == 1);
    CHECK(Image<int>().empty());
    CHECK(Image<int>().size() == 0);
}

TEST_CASE("sizes below one are reported by value") {
    CHECK(error_of([] { Image<float>(0, 4); }) == "penumbra: image size 0 × 4 is not positive");
    CHECK(error_of([] { Image<float>(3, -1); }) == "penumbra: image size 3 × -1 is not positive");
    CHECK(error_of([] { Image<float>(1, 1); }).empty());
}

TEST_CASE_TEMPLATE("bilinear is the sum of tents, at every border", T, float, double) {
    test::Random random(1);
    for (const auto& size : {std::pair(1, 1), std::pair(1, 6), std::pair(7, 1), std::pair(17, 13)}) {
        Image<T> image(size.first, size.second);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = random.in(T(-1), T(1));
        double worst = 0;
        for (int i = 0; i < 5000; ++i) {
            const T x = random.in(T(-2), T(size.first + 2)), y = random.in(T(-2), T(size.second + 2));
            const double truth = tents(image, static_cast<double>(x), static_cast<double>(y));
            worst = std::max(worst, std::abs(static_cast<double>(bilinear(image, x, y)) - truth));
        }
        // texels are below 1, and positions exact: x − ½ is representable wherever it is not clamped
        CHECK(worst <= 3 * static_cast<double>(std::numeric_limits<T>::epsilon()));
        for (int y = 0; y < size.second; ++y)
            for (int x = 0; x < size.first; ++x) CHECK(bilinear(image, T(x) + T(0.5), T(y) + T(0.5)) == image(x, y));
        for (const T far : {T(1e6), T(1e30), std::numeric_limits<T>::max()}) {
            CHECK(bilinear(image, far, far) == image(size.first - 1, size.second - 1));
            CHECK(bilinear(image, -far, T(0)) == image(0, 0));
        }
    }
}

TEST_CASE("bilinear stays inside images whose width float cannot hold") {
    const int width = (1 << 24) + 4;  // width − 1 rounds up to width
    for (const bool tall : {false, true}) {
        Image<std::uint8_t> image(tall ? 1 : width, tall ? width : 1, 5);
        image.data()[width - 1] = 9;
        const auto at = [&](float along) { return tall ? bilinear(image, 0.5F, along) : bilinear(image, along, 0.5F); };
        for (const float end : {static_cast<float>(width), 1e9F, 1e30F}) {
#ifdef __FAST_MATH__  // may turn 1 − (x − x0) into (1 + x0) − x, where 1 is lost; the sanitizers see what is read
            CHECK(at(end) >= 0.0F);
            CHECK(at(end) <= 9.0F);
#else
            CHECK(at(end) == 9.0F);
#endif
        }
        CHECK(at(100.0F) == 5.0F);
    }
}

TEST_CASE("bilinear of bytes and of a constant") {
    Image<std::uint8_t> image(2, 1);
    image(1, 0) = 255;
    CHECK(bilinear(image, 1.0F, 0.5F) == 127.5F);
    const Image<std::uint8_t> full(5, 4, 255);
    test::Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const float x = random.in(-1.0F, 6.0F), y = random.in(-1.0F, 5.0F);
        CHECK(std::abs(bilinear(full, x, y) - 255.0F) < 4e-5F);
    }
#ifndef __FAST_MATH__
    CHECK(bilinear(image, std::numeric_limits<float>::quiet_NaN(), 0.5F) == 0.0F);
#endif
}
