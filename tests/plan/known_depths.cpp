#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <penumbra/plan/known_depths.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

/// A pyramid of random depths, and what its texels have.
struct Depths {
    int size;
    std::vector<detail::KnownDepths<double>> texels;
    detail::KnownDepthPyramid<double> pyramid;

    Depths(int resolution, int shift, test::Random& random) : size(resolution), pyramid(resolution, shift) {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double blocked = random.in(1.0, 2.0);
                texels.push_back({random.in(0.5, 1.0), blocked, random.in(2.0, 3.0)});
                pyramid.around(x, y).join(texels.back());
            }
        pyramid.finish();
    }
    detail::KnownDepths<double> of(int x0, int y0, int x1, int y1) const {
        detail::KnownDepths<double> known;
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) known.join(texels[static_cast<std::size_t>(y * size + x)]);
        return known;
    }
};

bool says_no_more(const detail::KnownDepths<double>& some, const detail::KnownDepths<double>& all) {
    return some.lit_until <= all.lit_until && some.dark_after >= all.dark_after && some.dark_until <= all.dark_until;
}

/// One map of which all is lit up to depth 2, dark from 3 to 4.
detail::KnownPlaces<double> even_places(double position = 0.0) {
    detail::KnownPlaces<double> places;
    places.slopes = {Vec2<double>(-1.0, -1.0), Vec2<double>(1.0, 1.0)}, places.resolution = 32;
    places.maps.push_back({position, detail::KnownDepthPyramid<double>(32, 2)});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) places.maps[0].depths.square(x, y) = {2.0, 3.0, 4.0};
    places.maps[0].depths.finish();
    return places;
}

Box3<double> around(const Vec3<double>& p, double half) {
    return {p - Vec3<double>(half, half, half), p + Vec3<double>(half, half, half)};
}
bool is_lit(const Variation<double>& v) { return v.known && v.lit; }
bool is_dark(const Variation<double>& v) { return v.known && !v.lit && v.change(Vec3<double>(1e9, 1e9, 1e9)) <= 0.0; }

}  // namespace

TEST_CASE("of any texels a pyramid says no more than all of them say") {
    test::Random random(1);
    for (const int size : {1, 2, 3, 5, 8, 31, 32, 100})
        for (const int shift : {0, 1, 2, 3}) {
            const Depths depths(size, shift, random);
            int wrong = 0;
            for (int n = 0; n < 400; ++n) {
                int x0 = random.whole(0, size - 1), x1 = random.whole(0, size - 1);
                int y0 = random.whole(0, size - 1), y1 = random.whole(0, size - 1);
                if (x1 < x0) std::swap(x0, x1);
                if (y1 < y0) std::swap(y0, y1);
                wrong += says_no_more(depths.pyramid.of(x0, y0, x1, y1), depths.of(x0, y0, x1, y1)) ? 0 : 1;
            }
            CAPTURE(size);
            CAPTURE(shift);
            CHECK(wrong == 0);
            const int end = std::min(1 << shift, size) - 1;
            CHECK(says_no_more(depths.of(0, 0, end, end), depths.pyramid.of(0, 0, end, end)));
            CHECK(says_no_more(depths.of(0, 0, size - 1, size - 1), depths.pyramid.of(0, 0, size - 1, size - 1)));
        }
}

TEST_CASE("boxes are lit before a depth, dark between two, and else not known") {
    const detail::KnownPlaces<double> places = even_places();
    CHECK(is_lit(places(around(Vec3<double>(0.3, -0.4, 1.5), 0.1))));
    CHECK(is_dark(places(around(Vec3<double>(0.3, -0.4, 3.5), 0.1))));
    for (const double depth : {2.0, 2.5, 3.0, 4.0, 5.0}) {
        CAPTURE(depth);
        CHECK_FALSE(places(around(Vec3<double>(0.3, -0.4, depth), 0.1)).known);
    }
    CHECK(is_lit(detail::KnownPlaces<double>()(around(Vec3<double>(0.0, 0.0, 1.0), 0.1))));
}

TEST_CASE("boxes behind the light are lit, and those on its plane not known") {
    const detail::KnownPlaces<double> places = even_places();
    CHECK(is_lit(places(around(Vec3<double>(0.0, 0.0, -1.0), 0.5))));
    CHECK_FALSE(places(around(Vec3<double>(0.0, 0.0, 0.0), 0.5)).known);
    CHECK_FALSE(places({Vec3<double>(0.0, 0.0, 1e-12), Vec3<double>(1.0, 1.0, 1.0)}).known);
    CHECK_FALSE(places(around(Vec3<double>(5.0, 0.0, 1e-200), 1e-201)).known);
}

TEST_CASE("boxes beside the image are lit, and dark only within it") {
    detail::KnownPlaces<double> places = even_places();
    for (const Vec2<double> way :
         {Vec2<double>(1.0, 0.0), Vec2<double>(-1.0, 0.0), Vec2<double>(0.0, 1.0), Vec2<double>(0.0, -1.0)}) {
        const auto beside = [&](double slope) {
            return places(around(Vec3<double>(way.x * slope * 3.5, way.y * slope * 3.5, 3.5), 0.1));
        };
        CHECK(is_dark(beside(0.9)));
        CHECK_FALSE(beside(1.0).known);
        CHECK(is_lit(beside(1.1)));
    }
    places.has_sides = false;
    CHECK_FALSE(places(around(Vec3<double>(5.0, 0.0, 3.5), 0.1)).known);
    CHECK(is_lit(places(around(Vec3<double>(0.0, 5.0, 3.5), 0.1))));
}

TEST_CASE("all maps must agree") {
    detail::KnownPlaces<double> places = even_places(-0.5);
    places.maps.push_back({0.5, detail::KnownDepthPyramid<double>(32, 2)});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) places.maps[1].depths.square(x, y) = {1.0, 3.5, 5.0};
    places.maps[1].depths.finish();
    CHECK(is_lit(places(around(Vec3<double>(0.0, 0.0, 0.8), 0.1))));
    CHECK_FALSE(places(around(Vec3<double>(0.0, 0.0, 1.5), 0.1)).known);
    CHECK_FALSE(places(around(Vec3<double>(0.0, 0.0, 3.3), 0.1)).known);
    CHECK(is_dark(places(around(Vec3<double>(0.0, 0.0, 3.7), 0.1))));
    // at slope 1.03 from the light's middle, within what the second sees
    CHECK_FALSE(places(around(Vec3<double>(3.8, 0.0, 3.7), 0.02)).known);
}

TEST_CASE("depths may be distances from the light's middle") {
    detail::KnownPlaces<double> places = even_places();
    places.by_distance = true;
    CHECK(is_lit(places(around(Vec3<double>(0.0, 0.0, 1.98), 0.01))));
    CHECK_FALSE(places(around(Vec3<double>(1.0, 1.0, 1.9), 0.01)).known);
    CHECK(is_dark(places(around(Vec3<double>(1.0, 1.0, 2.9), 0.01))));
}
