#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../support/box_mean.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

constexpr std::pair<int, int> awkward[] = {{1, 1}, {1, 6}, {6, 1}, {17, 13}, {100, 300}};

template <class T>
Rect2<T> box(T x0, T y0, T x1, T y1) {
    return {Vec2<T>(x0, y0), Vec2<T>(x1, y1)};
}

template <class T>
Rect2<T> square(T x, T y, T size) {
    return box(x, y, x + size, y + size);
}

/// RMS error of means of squares of `low` to `high` texels inside the image, of the largest value.
template <class Filter>
double rms_of(const Filter& filter, const Image<std::uint8_t>& image, test::Random& random, double low, double high,
              double aspect = 1) {
    double sum = 0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const double size = low * std::pow(high / low, random.in(0.0, 1.0));
        const bool wide = random.whole(0, 1) == 0;
        const double w = wide ? size * aspect : size, h = wide ? size : size * aspect;
        const double x = random.in(0.0, image.width() - w), y = random.in(0.0, image.height() - h);
        const Rect2<double> b = box(x, y, x + w, y + h);
        const double error = (filter.mean(b) - test::box_mean(image, b)) / 255;
        sum += error * error;
    }
    return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE_TEMPLATE("every texel of every level is the mean of its block, zeros outside", T, float, double) {
    test::Random random(1);
    for (const auto& size : awkward) {
        Image<T> image(size.first, size.second);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = random.in(T(0), T(1));
        const NBuffer<T> buffer(image);
        const int largest = std::max(size.first, size.second);
        CHECK((1 << (buffer.levels() - 1)) >= largest);  // the top block covers the image
        CHECK((buffer.levels() == 1 || (1 << (buffer.levels() - 2)) < largest));
        CHECK(buffer.bytes() == sizeof(T) * image.size() * static_cast<std::size_t>(buffer.levels()));
        double worst = 0;
        for (int l = 0; l < buffer.levels(); ++l)
            for (int y = 0; y < size.second; y += 1 + size.second / 40)
                for (int x = 0; x < size.first; x += 1 + size.first / 40) {
                    const double truth = test::box_mean(image, square<double>(x, y, 1 << l));
                    worst = std::max(worst, std::abs(static_cast<double>(buffer.level(l)(x, y)) - truth));
                }
        CHECK(worst < 10 * static_cast<double>(std::numeric_limits<T>::epsilon()));
    }
}

TEST_CASE_TEMPLATE("levels of integers: off by at most half a level's number, without bias", Texel, std::uint8_t,
                   std::uint16_t) {
    test::Random random(2);
    for (const auto& size : {std::pair(17, 13), std::pair(100, 300), std::pair(65, 3), std::pair(257, 130)}) {
        Image<Texel> image(size.first, size.second);
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] = static_cast<Texel>(random.whole(0, std::numeric_limits<Texel>::max()));
        const NBuffer<Texel> buffer(image);
        for (int l = 0; l < buffer.levels(); ++l) {
            double worst = 0, sum = 0, squares = 0;
            int count = 0;
            for (int y = 0; y < size.second; y += 1 + size.second / 60)
                for (int x = 0; x < size.first; x += 1 + size.first / 60) {
                    const double truth = test::box_mean(image, square<double>(x, y, 1 << l));
                    const double error = static_cast<double>(buffer.level(l)(x, y)) - truth;
                    worst = std::max(worst, std::abs(error));
                    sum += error, squares += error * error, ++count;
                }
            CAPTURE(size.first);
            CAPTURE(l);
            CHECK(worst <= 0.5 * l + 1e-9);
            // halves go up from level 0 to 1, down from 1 to 2, and so on: 1/8, then 0 again
            if (l > 1 && l < 6 && size.second > 50) CHECK(std::abs(sum / count - (l % 2 == 0 ? 0.0 : 0.125)) < 0.05);
            CHECK(std::sqrt(squares / count) <= 0.45 * std::sqrt(static_cast<double>(l)) + 1e-9);
        }
    }
}

TEST_CASE("rounding is that of the formula, value for value, in rows of every length") {
    // quarter() is stated in integers here; builders may take several values at once
    test::Random random(3);
    for (int width = 1; width <= 150; ++width) {
        const Image<std::uint8_t> image = test::random_bytes(random, width, 19);
        const NBuffer<std::uint8_t> buffer(image);
        int wrong = 0;
        for (int l = 0; l + 1 < buffer.levels(); ++l) {
            const Image<std::uint8_t>& in = buffer.level(l);
            const auto at = [&](int x, int y) { return x < width && y < 19 ? int(in(x, y)) : 0; };
            const int step = 1 << l;
            for (int y = 0; y < 19; ++y)
                for (int x = 0; x < width; ++x) {
                    const int sum = at(x, y) + at(x + step, y) + at(x, y + step) + at(x + step, y + step);
                    wrong += int(buffer.level(l + 1)(x, y)) != (sum + (l % 2 == 0 ? 2 : 1)) / 4;
                }
        }
        CAPTURE(width);
        CHECK(wrong == 0);
    }
}

TEST_CASE("the free builder keeps to its strides and channels") {
    test::Random random(4);
    const Image<std::uint8_t> image = test::random_bytes(random, 90, 9);
    for (const int channels : {1, 2, 4}) {
        const int width = 80 / channels;
        std::vector<std::uint8_t> out(90 * 9, 77);
        build_n_buffer_level(image.data(), out.data(), width, 9, 90, channels, 1);
        int wrong = 0;
        for (int y = 0; y < 9; ++y)
            for (int i = 0; i < 90; ++i) {
                const auto at = [&](int j, int k) {
                    return j < width * channels && k < 9 ? int(image.data()[90 * k + j]) : 0;
                };
                const int sum = at(i, y) + at(i + 2 * channels, y) + at(i, y + 2) + at(i + 2 * channels, y + 2);
                const int truth = i < width * channels ? (sum + 1) / 4 : 77;
                wrong += int(out[static_cast<std::size_t>(90 * y + i)]) != truth;
            }
        CAPTURE(channels);
        CHECK(wrong == 0);
    }
}

TEST_CASE_TEMPLATE("squares of a power of two, at whole positions inside, are read as they are", T, float, double) {
    test::Random random(5);
    Image<T> image(33, 41);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = random.in(T(0), T(1));
    const NBuffer<T> buffer(image);
    double worst = 0;
    for (int size = 1; size <= 32; size *= 2)
        for (int y = 0; y + size <= 41; ++y)
            for (int x = 0; x + size <= 33; ++x) {
                const Rect2<T> b = square(static_cast<T>(x), static_cast<T>(y), static_cast<T>(size));
                worst = std::max(worst, std::abs(static_cast<double>(buffer.mean(b)) - test::box_mean(image, b)));
            }
    CHECK(worst < 20 * static_cast<double>(std::numeric_limits<T>::epsilon()));
}

TEST_CASE("the stated errors: across an edge, in noise, for long boxes") {
    test::Random random(6);
    double edges = 0, long_edges = 0;
    constexpr int rounds = 12;
    for (int i = 0; i < rounds; ++i) {
        const Image<std::uint8_t> image = test::edge_bytes(256, random.in(0.0, 6.3), random.in(-30.0, 30.0));
        const NBuffer<std::uint8_t> buffer(image);
        edges += std::pow(rms_of(buffer, image, random, 3, 60), 2);
        long_edges += std::pow(rms_of(buffer, image, random, 3, 30, 5), 2);
    }
    const Image<std::uint8_t> noise = test::random_bytes(random, 256, 256, true);
    const NBuffer<std::uint8_t> buffer(noise);
    const double in_edges = std::sqrt(edges / rounds), in_noise = rms_of(buffer, noise, random, 3, 60);
    const double in_long = std::sqrt(long_edges / rounds), in_long_noise = rms_of(buffer, noise, random, 3, 30, 5);
    MESSAGE("RMS: edge " << in_edges << ", noise " << in_noise << ", long boxes " << in_long << " and "
                         << in_long_noise);
    CHECK(in_edges < 0.010);
    CHECK(in_noise < 0.025);
    CHECK(in_long < 0.010);
    CHECK(in_long_noise < 0.025);
}

TEST_CASE_TEMPLATE("means stay in the range of the texels, for any box", T, float, double) {
    test::Random random(7);
    const Image<std::uint8_t> image = test::random_bytes(random, 50, 31, true);
    const NBuffer<std::uint8_t> buffer(image);
    int outside = 0;
    for (int i = 0; i < 50000; ++i) {
        const int range = random.whole(0, 12);
        const T reach = std::ldexp(T(1), range);
        const T x0 = random.in(-reach, reach), x1 = random.in(-reach, reach);
        const T y0 = random.in(-reach, reach), y1 = random.in(-reach, reach);
        const T mean = buffer.mean(box(x0, y0, x1, y1));
        outside += !(mean >= T(0) && mean <= T(255.01));
    }
    CHECK(outside == 0);
    const T huge = T(1e30);
    CHECK(buffer.mean(box(T(51), T(0), T(90), T(5))) == T(0));
    CHECK(buffer.mean(box(huge, huge, huge, huge)) == T(0));
    CHECK(buffer.mean(box(-huge, -huge, huge, huge)) < T(1e-6));
    const T middle = static_cast<T>(image(7, 9));
    CHECK(std::abs(buffer.mean(box(T(7.5), T(9.5), T(7.5), T(9.5))) - middle) < T(1e-3));
#ifndef __FAST_MATH__
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const Rect2<T>& b : {box(nan, nan, nan, nan), box(T(1), nan, T(2), T(3)), box(T(1), T(1), nan, T(3))}) {
        CHECK(buffer.mean(b) >= T(0));
        CHECK(buffer.mean(b) <= T(255));
    }
#endif
}

TEST_CASE("continuous: a box that moves or grows a little changes its mean a little") {
    test::Random random(8);
    const Image<std::uint8_t> image = test::random_bytes(random, 64, 64, true);
    const NBuffer<std::uint8_t> buffer(image);
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const double x = random.in(2.0, 30.0), y = random.in(2.0, 30.0);
        // sizes beside powers of two, where levels change
        const double size = std::ldexp(1.0, random.whole(1, 4)) * (1 + 1e-6 * random.in(-1.0, 1.0));
        const double here = buffer.mean(square(x, y, size)) / 255;
        worst = std::max(worst, std::abs(buffer.mean(square(x, y, size + 2e-6)) / 255 - here));
        worst = std::max(worst, std::abs(buffer.mean(square(x + 2e-6, y, size)) / 255 - here));
    }
    CHECK(worst < 1e-4);
}

TEST_CASE("a constant field inside, fewer levels, four channels as four images") {
    const NBuffer<std::uint8_t> full(Image<std::uint8_t>(37, 21, 255));
    test::Random random(9);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x0 = random.in(0.1, 36.0), y0 = random.in(0.1, 20.0), x1 = random.in(x0, 36.9),
                     y1 = random.in(y0, 20.9);
        worst = std::max(worst, std::abs(full.mean(box(x0, y0, x1, y1)) - 255) / 255);
    }
    CHECK(worst < 0.01);  // blocks larger than the image, in bytes

    Image<glm::vec<4, std::uint8_t, glm::defaultp>> rgba(29, 18);
    std::vector<Image<std::uint8_t>> single;
    for (int c = 0; c < 4; ++c) {
        single.push_back(test::random_bytes(random, 29, 18));
        for (std::size_t i = 0; i < rgba.size(); ++i) rgba.data()[i][c] = single.back().data()[i];
    }
    const NBuffer<glm::vec<4, std::uint8_t, glm::defaultp>> packed(rgba);
    int different = 0;
    for (int c = 0; c < 4; ++c) {
        const NBuffer<std::uint8_t> alone(single[static_cast<std::size_t>(c)]);
        REQUIRE(alone.levels() == packed.levels());
        for (int l = 0; l < alone.levels(); ++l)
            for (std::size_t i = 0; i < rgba.size(); ++i)
                different += packed.level(l).data()[i][c] != alone.level(l).data()[i];
        for (int i = 0; i < 500; ++i) {
            const double x = random.in(-2.0, 25.0), y = random.in(-2.0, 15.0), size = random.in(0.0, 12.0);
            different += std::abs(packed.mean(square(x, y, size))[c] - alone.mean(square(x, y, size))) > 1e-10;
        }
    }
    CHECK(different == 0);

    // three levels serve boxes up to 4 texels
    const NBuffer<std::uint8_t> few(single[0], 3), all(single[0]);
    CHECK(few.levels() == 3);
    for (int i = 0; i < 500; ++i) {
        const double x = random.in(0.0, 25.0), y = random.in(0.0, 14.0);
        const double size = random.in(0.2, 3.99);
        CHECK(few.mean(square(x, y, size)) == doctest::Approx(all.mean(square(x, y, size))));
    }
}

TEST_CASE("bad arguments are reported, an empty buffer reads 0, and rebuilding replaces") {
    CHECK_THROWS_WITH_AS(NBuffer<float>(Image<float>()), "penumbra: image is empty", std::invalid_argument);
    CHECK_THROWS_WITH_AS(NBuffer<float>(Image<float>(2, 2), 0), "penumbra: levels = 0 is not positive",
                         std::invalid_argument);
    NBuffer<float> buffer;
    CHECK(buffer.mean(square(0.0, 0.0, 4.0)) == 0.0);
    CHECK(buffer.bytes() == 0);
    buffer.rebuild(Image<float>(30, 20, 3.0F));
    buffer.rebuild(Image<float>(4, 5, 7.0F));
    CHECK(buffer.levels() == 4);
    CHECK(buffer.level(2).width() == 4);
    CHECK(buffer.mean(square(0.0, 0.0, 4.0)) == 7.0);
}
