#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../support/box_mean.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

template <class T>
Rect2<T> box(T x0, T y0, T x1, T y1) {
    return {Vec2<T>(x0, y0), Vec2<T>(x1, y1)};
}

double rms_of(const MipMap<std::uint8_t>& filter, const Image<std::uint8_t>& image, test::Random& random,
              double aspect) {
    double sum = 0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const double size = 3 * std::pow(60 / aspect / 3, random.in(0.0, 1.0));
        const bool wide = random.whole(0, 1) == 0;
        const double w = wide ? size * aspect : size, h = wide ? size : size * aspect;
        const double x = random.in(0.0, image.width() - w), y = random.in(0.0, image.height() - h);
        const Rect2<double> b = box(x, y, x + w, y + h);
        sum += std::pow((filter.mean(b) - test::box_mean(image, b)) / 255, 2);
    }
    return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE_TEMPLATE("every texel of every level is the mean of its block, zeros outside", Texel, float, double,
                   std::uint8_t) {
    test::Random random(1);
    for (const auto& size : {std::pair(1, 1), std::pair(1, 6), std::pair(17, 13), std::pair(100, 300)}) {
        Image<Texel> image(size.first, size.second);
        for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = static_cast<Texel>(random.whole(0, 255));
        const MipMap<Texel> map(image);
        const int top = map.levels() - 1;
        CHECK((1 << top) >= std::max(size.first, size.second));
        CHECK(map.level(top).size() == 1);
        for (int l = 0; l <= top; ++l) {
            double worst = 0;
            for (int y = 0; y < map.level(l).height(); ++y)
                for (int x = 0; x < map.level(l).width(); ++x) {
                    const double side = 1 << l;
                    const double truth = test::box_mean(image, box(x * side, y * side, (x + 1) * side, (y + 1) * side));
                    worst = std::max(worst, std::abs(static_cast<double>(map.level(l)(x, y)) - truth));
                }
            CAPTURE(l);
            CHECK(worst <= (std::is_integral_v<Texel> ? 0.5 * l + 1e-9 : 2e-4));
        }
    }
}

TEST_CASE("the stated errors: across an edge, in noise, for long boxes") {
    test::Random random(2);
    double edges = 0, long_edges = 0;
    constexpr int rounds = 12;
    for (int i = 0; i < rounds; ++i) {
        const Image<std::uint8_t> image = test::edge_bytes(256, random.in(0.0, 6.3), random.in(-30.0, 30.0));
        const MipMap<std::uint8_t> map(image);
        edges += std::pow(rms_of(map, image, random, 1), 2);
        long_edges += std::pow(rms_of(map, image, random, 5), 2);
    }
    const Image<std::uint8_t> noise = test::random_bytes(random, 256, 256, true);
    const MipMap<std::uint8_t> map(noise);
    const double in_edges = std::sqrt(edges / rounds), in_noise = rms_of(map, noise, random, 1);
    const double in_long = std::sqrt(long_edges / rounds), in_long_noise = rms_of(map, noise, random, 5);
    MESSAGE("RMS: edge " << in_edges << ", noise " << in_noise << ", long boxes " << in_long << " and "
                         << in_long_noise);
    CHECK(in_edges < 0.02);
    CHECK(in_noise < 0.055);
    CHECK(in_long < 0.02);
    CHECK(in_long_noise < 0.055);
}

TEST_CASE_TEMPLATE("means stay in the range of the texels, and are finite, for any box", T, float, double) {
    test::Random random(3);
    const Image<std::uint8_t> image = test::random_bytes(random, 50, 31, true);
    const MipMap<std::uint8_t> map(image);
    int outside = 0;
    for (int i = 0; i < 50000; ++i) {
        const int range = random.whole(0, 12);
        const T reach = std::ldexp(T(1), range);
        const T x0 = random.in(-reach, reach), x1 = random.in(-reach, reach);
        const T y0 = random.in(-reach, reach), y1 = random.in(-reach, reach);
        const T mean = map.mean(box(x0, y0, x1, y1));
        outside += !(mean >= T(0) && mean <= T(255.01));
    }
    CHECK(outside == 0);
    const T huge = T(1e30);
    CHECK(map.mean(box(T(60), T(0), T(62), T(2))) == T(0));
    CHECK(map.mean(box(huge, huge, huge, huge)) == T(0));
    CHECK(map.mean(box(-huge, -huge, huge, huge)) <= T(255));
    // a box without size reads its texel
    CHECK(std::abs(map.mean(box(T(7.5), T(9.5), T(7.5), T(9.5))) - static_cast<T>(image(7, 9))) < T(1e-3));
#ifndef __FAST_MATH__
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const Rect2<T>& b : {box(nan, nan, nan, nan), box(T(1), nan, T(2), T(3)), box(T(1), T(1), nan, T(3))}) {
        CHECK(map.mean(b) >= T(0));
        CHECK(map.mean(b) <= T(255));
    }
#endif
}

TEST_CASE("continuous where levels change; a constant field far from borders; four channels as four images") {
    test::Random random(4);
    const Image<std::uint8_t> image = test::random_bytes(random, 128, 128, true);
    const MipMap<std::uint8_t> map(image);
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const double x = random.in(2.0, 60.0), y = random.in(2.0, 60.0);
        const double size = std::exp2(random.whole(1, 4) + 0.8) * (1 + 1e-6 * random.in(-1.0, 1.0));
        const double here = map.mean(box(x, y, x + size, y + size)) / 255;
        worst = std::max(worst, std::abs(map.mean(box(x, y, x + size + 2e-6, y + size)) / 255 - here));
    }
    CHECK(worst < 1e-4);
    const MipMap<std::uint8_t> full(Image<std::uint8_t>(64, 64, 255));
    for (const double size : {0.0, 1.0, 3.7, 8.0, 11.0})
        CHECK(full.mean(box(30.0 - size / 2, 30.0 - size / 2, 30.0 + size / 2, 30.0 + size / 2)) ==
              doctest::Approx(255));
    Image<glm::vec<4, std::uint8_t, glm::defaultp>> rgba(29, 18);
    std::vector<Image<std::uint8_t>> single;
    for (int c = 0; c < 4; ++c) {
        single.push_back(test::random_bytes(random, 29, 18));
        for (std::size_t i = 0; i < rgba.size(); ++i) rgba.data()[i][c] = single.back().data()[i];
    }
    const MipMap<glm::vec<4, std::uint8_t, glm::defaultp>> packed(rgba);
    int different = 0;
    for (int c = 0; c < 4; ++c) {
        const MipMap<std::uint8_t> alone(single[static_cast<std::size_t>(c)]);
        for (int i = 0; i < 500; ++i) {
            const double x = random.in(-2.0, 25.0), y = random.in(-2.0, 15.0), size = random.in(0.0, 12.0);
            const Rect2<double> b = box(x, y, x + size, y + size);
            different += std::abs(packed.mean(b)[c] - alone.mean(b)) > 1e-10;
        }
    }
    CHECK(different == 0);
}

TEST_CASE("an empty image is reported, an empty map reads 0, and rebuilding replaces") {
    CHECK_THROWS_WITH_AS(MipMap<float>(Image<float>()), "penumbra: image is empty", std::invalid_argument);
    MipMap<float> map;
    CHECK(map.mean(box(0.0, 0.0, 4.0, 4.0)) == 0.0);
    map.rebuild(Image<float>(30, 20, 3.0F));
    map.rebuild(Image<float>(4, 4, 7.0F));
    CHECK(map.levels() == 3);
    CHECK(map.mean(box(1.0, 1.0, 2.0, 2.0)) == 7.0);
}
