#include <doctest/doctest.h>

#include <bitset>
#include <cmath>
#include <penumbra/penumbra_wedge/bitmask.hpp>
#include <vector>

#include "support/polygon_union.hpp"
#include "support/random.hpp"

using namespace penumbra;

namespace {

const Rect2<double> box_d{{-1, -1}, {1, 1}};

template <class T>
Rect2<T> unit_box() {
    return {Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))};
}

template <class T, int Size>
WindingMask<Size> mask_of(const test::Polygon2& polygon, int weight = 1) {
    WindingMask<Size> mask;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        mask.add(Vec2<T>(polygon[i]), Vec2<T>(polygon[(i + 1) % polygon.size()]), weight, unit_box<T>());
    return mask;
}

int winding_of(const WindingColumn& column, int cell) {
    const auto digit = [&](std::uint32_t word) { return static_cast<int>((word >> cell) & 1U); };
    return digit(column.ones) + 2 * digit(column.twos) + 4 * digit(column.fours) - 8 * digit(column.eights);
}

/// Angles summed up around the point, in double.
int true_winding(const test::Polygon2& polygon, const glm::dvec2& at) {
    double turn = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - at, b = polygon[(i + 1) % polygon.size()] - at;
        turn += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return static_cast<int>(std::lround(turn / (2.0 * pi<double>)));
}

double distance_to(const test::Polygon2& polygon, const glm::dvec2& at) {
    double least = 1e9;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i], d = polygon[(i + 1) % polygon.size()] - a;
        const double t = glm::clamp(glm::dot(at - a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
        least = std::min(least, glm::length(at - a - d * t));
    }
    return least;
}

test::Polygon2 random_polygon(test::Random& random, double center, double radius, int corners) {
    const glm::dvec2 at(random.in(-center, center), random.in(-center, center));
    const double start = random.in(0.0, 2.0 * pi<double>);
    test::Polygon2 polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = start + 2.0 * pi<double> * i / corners, r = radius * random.in(0.6, 1.0);
        polygon.push_back(at + r * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return polygon;
}

/// As float sees it.
test::Polygon2 rounded(test::Polygon2 polygon) {
    for (glm::dvec2& v : polygon) v = glm::dvec2(Vec2<float>(v));
    return polygon;
}

/// Cells whose winding number is wrong, other than those whose middle is on an edge to rounding.
template <class T, int Size>
int wrong_cells(const test::Polygon2& polygon, double tolerance) {
    const WindingMask<Size> mask = mask_of<T, Size>(polygon);
    int wrong = 0;
    for (int x = 0; x < Size; ++x) {
        for (int y = 0; y < Size; ++y) {
            const glm::dvec2 middle(-1.0 + (x + 0.5) * 2.0 / Size, -1.0 + (y + 0.5) * 2.0 / Size);
            const int got = winding_of(mask.columns[static_cast<std::size_t>(x)], y);
            wrong += got != true_winding(polygon, middle) && distance_to(polygon, middle) > tolerance;
        }
    }
    return wrong;
}

}  // namespace

TEST_CASE("bits are counted and made as the standard library does") {
    test::Random random(1);
    for (int count = 0; count <= 32; ++count) {
        const std::uint64_t expected = (std::uint64_t(1) << count) - 1;
        CHECK(low_bits(count) == static_cast<std::uint32_t>(expected));
    }
    for (int i = 0; i < 10000; ++i) {
        const auto word = static_cast<std::uint32_t>(random.whole(0, 0x7fffffff)) * 2654435761U;
        CHECK(count_bits(word) == static_cast<int>(std::bitset<32>(word).count()));
    }
    CHECK(count_bits(0xffffffffU) == 32);
}

TEST_CASE("winding columns count modulo 16, up and down") {
    test::Random random(2);
    WindingColumn column;
    int truth[32] = {};
    for (int step = 0; step < 2000; ++step) {
        const std::uint32_t cells = static_cast<std::uint32_t>(random.whole(0, 0x7fffffff)) * 2654435761U;
        const bool less = random.whole(0, 1) == 1;
        column = add_winding(column, cells, less);
        int sum = 0;
        std::uint32_t wound = 0;
        for (int cell = 0; cell < 32; ++cell) {
            if ((cells >> cell) & 1U) truth[cell] = (truth[cell] + (less ? 15 : 1)) % 16;
            sum += truth[cell] < 8 ? truth[cell] : truth[cell] - 16;
            wound |= truth[cell] != 0 ? 1U << cell : 0U;
        }
        REQUIRE(wound_cells(column) == wound);
        REQUIRE(winding_sum(column) == sum);
    }
}

TEST_CASE_TEMPLATE("each cell has the winding number of its middle", T, float, double) {
    test::Random random(3);
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const test::Polygon2 polygon = rounded(random_polygon(random, 1.3, random.in(0.1, 2.5), random.whole(3, 9)));
        wrong += wrong_cells<T, 8>(polygon, 1e-6) + wrong_cells<T, 16>(polygon, 1e-6);
        wrong += wrong_cells<T, 32>(polygon, 1e-6);
    }
    CHECK(wrong == 0);
}

TEST_CASE_TEMPLATE("also of loops that cross themselves, reach far out or run along cells", T, float, double) {
    const auto wrong = [](const test::Polygon2& polygon, double tolerance) {
        return wrong_cells<T, 8>(polygon, tolerance) + wrong_cells<T, 16>(polygon, tolerance) +
               wrong_cells<T, 32>(polygon, tolerance);
    };
    test::Polygon2 star;  // wound twice in its middle
    for (int i = 0; i < 5; ++i)
        star.emplace_back(0.9 * std::cos(4.0 * pi<double> * i / 5), 0.9 * std::sin(4.0 * pi<double> * i / 5));
    CHECK(wrong(rounded(star), 1e-6) == 0);
    CHECK(mask_of<T, 32>(rounded(star)).sum() > mask_of<T, 32>(rounded(star)).wound());
    CHECK(wrong({{-1e5, -1e5}, {1e5, -1e5}, {0.3, 0.7}}, 0.02) == 0);  // float has no more digits at 1e5
    CHECK(wrong({{-1e18, -1e18}, {1e18, -1e18}, {1e18, 1e18}, {-1e18, 1e18}}, 0.0) == 0);
    CHECK(wrong({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, 0.0) == 0);
    CHECK(wrong({{0.2, -3.0}, {0.2, 3.0}, {0.2 + 1e-6, 0.0}}, 1e-5) == 0);
    CHECK(wrong({{0.2, 0.2}, {0.2, 0.2}, {0.2, 0.2}}, 0.0) == 0);
}

TEST_CASE_TEMPLATE("reversed edges take away what edges add, also where middles lie on them", T, float, double) {
    test::Random random(4);
    for (int i = 0; i < 20000; ++i) {
        const auto coordinate = [&] {
            const T at = static_cast<T>(random.whole(-40, 40)) / T(32);  // borders and middles of cells, and between
            return random.whole(0, 9) == 0 ? at * T(1e5) : random.whole(0, 1) == 0 ? at : at * T(0.97);
        };
        const Vec2<T> a(coordinate(), coordinate()), b(coordinate(), coordinate());
        WindingMask<32> mask;
        mask.add(a, b, 2, unit_box<T>());
        mask.add(b, a, 1, unit_box<T>());
        mask.add(a, b, -1, unit_box<T>());
        REQUIRE(mask.wound() == 0);
    }
}

TEST_CASE_TEMPLATE("masks of boxes that share a side are disjoint and leave no gap", T, float, double) {
    test::Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const double x = random.in(-1.0, 1.0), tilt = random.in(-0.5, 0.5);
        const glm::dvec2 low(x + tilt, -1.5), high(x - tilt, 1.5);
        const auto left = mask_of<T, 16>({{-2, -1.5}, low, high, {-2, 1.5}});
        const auto right = mask_of<T, 16>({low, {2, -1.5}, {2, 1.5}, high});
        for (std::size_t c = 0; c < 16; ++c)
            REQUIRE((wound_cells(left.columns[c]) ^ wound_cells(right.columns[c])) == 0xffffU);
    }
}

namespace {

/// As shadow.hpp adds silhouettes, for casters that are polygons on the light.
template <int Size>
struct Blend {
    MaskedOcclusion<float> all;
    std::array<std::uint32_t, Size> united{};
    double sum = 0.0, largest = 0.0;

    void add(const test::Polygon2& polygon) {
        const WindingMask<Size> mask = mask_of<float, Size>(polygon);
        std::vector<Vec2<float>> loop(polygon.begin(), polygon.end());
        const float area = loop_coverage(loop.data(), loop.size(), unit_box<float>());
        int fresh = 0;
        for (std::size_t c = 0; c < Size; ++c) {
            const std::uint32_t cells = wound_cells(mask.columns[c]);
            fresh += count_bits(cells & ~united[c]);
            united[c] |= cells;
        }
        all.add(area, mask.wound(), mask.sum(), fresh, Size * Size);
        sum += static_cast<double>(area), largest = std::max(largest, static_cast<double>(area));
    }
};

/// RMSE of masks, and of the sum alone.
struct Errors {
    double masks, sum;
};
template <int Size>
Errors blend_error(int casters, double radius) {
    test::Random random(6);
    double squares = 0.0, sum_squares = 0.0;
    constexpr int trials = 1000;
    for (int t = 0; t < trials; ++t) {
        std::vector<test::Polygon2> polygons;
        Blend<Size> blend;
        for (int k = 0; k < casters; ++k) {
            polygons.push_back(rounded(random_polygon(random, 1.1, radius * random.in(0.5, 1.5), random.whole(3, 6))));
            blend.add(polygons.back());
        }
        const double truth = test::union_area(polygons, box_d) / 4.0;
        squares += std::pow(static_cast<double>(blend.all.occlusion) - truth, 2);
        sum_squares += std::pow(std::min(blend.sum, 1.0) - truth, 2);
    }
    return {std::sqrt(squares / trials), std::sqrt(sum_squares / trials)};
}

}  // namespace

TEST_CASE("areas by masks: errors of random casters against the exact union") {
    // of sizes at which the sum alone is wrong by at least .035, .046 and .071
    const double radius[] = {1.05, 0.65, 0.33}, sums[] = {.035, .046, .071};
    const double bounds[3][3] = {{.015, .0054, .0019}, {.020, .0072, .0026}, {.029, .010, .0037}};
    const int casters[] = {2, 5, 20};
    for (int k = 0; k < 3; ++k) {
        const Errors errors[] = {blend_error<8>(casters[k], radius[k]), blend_error<16>(casters[k], radius[k]),
                                 blend_error<32>(casters[k], radius[k])};
        MESSAGE(casters[k], " casters: sum ", errors[0].sum, ", 8² ", errors[0].masks, ", 16² ", errors[1].masks,
                ", 32² ", errors[2].masks);
        CHECK(errors[0].sum >= sums[k]);
        for (int size = 0; size < 3; ++size) CHECK(errors[size].masks <= bounds[k][size]);
    }
}

TEST_CASE("areas by masks: never brighter with a caster more, between the largest and the sum, in [0, 1]") {
    test::Random random(7);
    for (int t = 0; t < 2000; ++t) {
        Blend<16> blend;
        for (int k = 0; k < 12; ++k) {
            const float before = blend.all.occlusion;
            blend.add(random_polygon(random, 1.2, random.in(0.0, 1.2), random.whole(3, 7)));
            const auto now = static_cast<double>(blend.all.occlusion);
            REQUIRE(now >= static_cast<double>(before));
            REQUIRE(now >= blend.largest - 1e-6);
            REQUIRE(now <= std::min(1.0, blend.sum + 1e-6));
        }
    }
}

TEST_CASE("areas by masks: exact where nothing overlaps, and for the same caster twice") {
    test::Random random(8);
    for (int t = 0; t < 500; ++t) {
        const test::Polygon2 polygon = random_polygon(random, 0.8, random.in(0.05, 1.0), 5);
        Blend<32> twice, halves;
        twice.add(polygon);
        const float once = twice.all.occlusion;
        twice.add(polygon);
        CHECK(twice.all.occlusion == once);
        const double x = random.in(-1.0, 1.0);
        halves.add({{-2, -2}, {x, -2}, {x, 2}, {-2, 2}});
        halves.add({{x, -2}, {2, -2}, {2, 2}, {x, 2}});
        CHECK(static_cast<double>(halves.all.occlusion) == doctest::Approx(1.0).epsilon(1e-6));
    }
}

TEST_CASE("areas by masks: what lies over itself counts once") {
    MaskedOcclusion<float> all;
    all.add(0.75F, 500, 750, 500, 1024);
    CHECK(all.occlusion == doctest::Approx(0.5));
    MaskedOcclusion<float> dark;  // all cells blocked, some twice
    dark.add(1.37F, 1024, 1400, 1024, 1024);
    CHECK(dark.occlusion == 1.0F);
    MaskedOcclusion<float> backwards;  // a silhouette that runs the wrong way round still blocks
    backwards.add(-0.25F, 256, -256, 256, 1024);
    CHECK(backwards.occlusion == 0.25F);
    MaskedOcclusion<float> sliver;  // between the cells' middles
    sliver.add(0.001F, 0, 0, 0, 1024);
    CHECK(sliver.occlusion == 0.001F);
}
