#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <penumbra/penumbra_wedge/overlap.hpp>
#include <penumbra/penumbra_wedge/packing.hpp>
#include <vector>

#include "../support/polygon_union.hpp"
#include "../support/random.hpp"

using namespace penumbra;
using test::Polygon2;

namespace {

template <class T>
RadialPart<T> even_part(T x0, T y0, T x1, T y1, T share) {
    const T size = (x1 - x0) * (y1 - y0) * share;
    return valid_part(RadialPart<T>{
        size, Vec2<T>((x0 + x1) * T(0.5) * size, (y0 + y1) * T(0.5) * size), {Vec2<T>(x0, y0), Vec2<T>(x1, y1)}});
}

template <class T>
RadialPart<T> random_part(test::Random& random) {
    T corner[4];
    for (T& c : corner) {
        const T steps = static_cast<T>(random.whole(0, 255)) / T(255);
        const int kind = random.whole(0, 7);
        c = kind == 0 ? T(0) : kind == 1 ? T(1) : kind == 2 ? steps : random.in(T(0), T(1));
        if (kind == 3) c = saturate(steps + random.in(T(-2), T(2)) * std::numeric_limits<T>::epsilon());
    }
    const T share = random.whole(0, 3) == 0 ? T(1) : random.in(T(0), T(1));
    return even_part(std::min(corner[0], corner[2]), std::min(corner[1], corner[3]), std::max(corner[0], corner[2]),
                     std::max(corner[1], corner[3]), share);
}

template <class T>
bool same(const RadialPart<T>& a, const RadialPart<T>& b) {
    return a.area == b.area && a.moment == b.moment && a.rect.min == b.rect.min && a.rect.max == b.rect.max;
}
bool same(const PackedPart& a, const PackedPart& b) { return a.rect == b.rect && a.coverage == b.coverage; }

std::uint32_t byte(std::uint32_t word, int k) { return (word >> (8 * k)) & 255U; }

}  // namespace

TEST_CASE_TEMPLATE("words lie where the layout says", T, float, double) {
    const T tenth = T(25.5) / T(255);
    const PackedPart packed = pack_part(even_part(tenth, T(2) * tenth, T(5) * tenth, T(8) * tenth, T(0.5)));
    CHECK(byte(packed.rect, 0) == 25);  // 25.5 down
    CHECK(std::abs(static_cast<int>(byte(packed.rect, 1)) - 51) <= 1);
    CHECK(byte(packed.rect, 2) == 128);  // 127.5 up
    CHECK(byte(packed.rect, 3) >= 204);
    CHECK(byte(packed.coverage, 2) == 102);  // 127.5 − 25.5
    CHECK(byte(packed.coverage, 3) == 153);
    CHECK((packed.coverage & 65535U) == 7864);  // 0.4 · 0.6 · 0.5 · 65535 = 7864.2
}

TEST_CASE_TEMPLATE("empty and full survive, and zeros are empty", T, float, double) {
    const PackedPart empty = pack_part(empty_part<T>()), full = pack_part(full_part<T>());
    CHECK(empty.rect == 0U);
    CHECK(empty.coverage == 0U);
    CHECK(full.rect == 0xffff0000U);
    CHECK(full.coverage == 0xffffffffU);
    CHECK(same(unpack_part<T>(empty), empty_part<T>()));
    CHECK(same(unpack_part<T>(full), full_part<T>()));
    // on the way there: nothing that is not all becomes more than it was
    CHECK(pack_part(even_part(T(0), T(0), T(1), T(1), T(1) - T(1) / T(200000))).coverage == 0xffffffffU);
    CHECK(pack_part(even_part(T(0), T(0), T(1), T(1), T(1) - T(1) / T(100000))).coverage == 0xfffffffeU);
    CHECK(pack_part(even_part(T(0), T(0), T(1), T(1), T(1) / T(131000))).coverage == 0xffff0001U);
    CHECK(pack_part(even_part(T(0), T(0), T(1), T(1), T(1) / T(132000))).coverage == 0U);
}

TEST_CASE_TEMPLATE("every coverage comes back, and ties go up", T, float, double) {
    for (std::uint32_t c = 0; c < 65536; ++c) {
        const RadialPart<T> part = unpack_part<T>({0xffff0000U, 0xffff0000U | c});
        CHECK(part.area == static_cast<T>(c) / T(65535));
        const PackedPart again = pack_part(part);
        CHECK(again.coverage == (c == 0 ? 0U : 0xffff0000U | c));
        if (c == 0) continue;
        // the tie below c, if it is a number, and its neighbours in T
        const double tie = (c - 0.5) / 65535;
        const T at = static_cast<T>(tie);
        for (const T area : {std::nextafter(at, T(0)), at, std::nextafter(at, T(1))}) {
            RadialPart<T> near = full_part<T>();
            near.area = area;
            // the product's rounding is the only one: half an ULP of c
            const double exact = static_cast<double>(area) * 65535 + 0.5;
            const double slack = c * static_cast<double>(std::numeric_limits<T>::epsilon());
            const std::uint32_t got = pack_part(near).coverage & 65535U;
            CHECK(got >= static_cast<std::uint32_t>(std::floor(exact - slack)));
            CHECK(got <= static_cast<std::uint32_t>(std::floor(exact + slack)));
        }
    }
    // exact ties of T: odd multiples of 1/2 in 65535ths do not exist; of sizes, 51/510 = 0.1 neither; so by hand
    const T half = T(0.5);  // 127.5 / 255, 32767.5 / 65535
    const PackedPart tie = pack_part(even_part(T(0), T(0), half, T(1), T(1)));
    CHECK(byte(tie.coverage, 2) == 128);
    CHECK(byte(tie.rect, 2) == 128);
    RadialPart<T> covered = full_part<T>();
    covered.area = half;
    CHECK((pack_part(covered).coverage & 65535U) == 32768);
}

TEST_CASE_TEMPLATE("limits hold the rectangle, sizes are to nearest: at and beside every 255th and every tie", T, float,
                   double) {
    const T epsilon = std::numeric_limits<T>::epsilon();
    for (int low = 0; low <= 510; ++low)
        for (int high = low + 1; high <= 510; ++high)
            for (int nudge = -1; nudge <= 1; ++nudge) {
                T x0 = static_cast<T>(low) / T(510), x1 = static_cast<T>(high) / T(510);
                if (nudge != 0) x0 = saturate(std::nextafter(x0, nudge > 0 ? T(2) : T(-1)));
                if (nudge != 0) x1 = saturate(std::nextafter(x1, nudge > 0 ? T(-1) : T(2)));
                const PackedPart packed = pack_part(even_part(x0, T(0), x1, T(1), T(0.5)));
                CAPTURE(low);
                CAPTURE(high);
                CAPTURE(nudge);
                const T q0 = static_cast<T>(byte(packed.rect, 0)), q1 = static_cast<T>(byte(packed.rect, 2));
                const T size = static_cast<T>(byte(packed.coverage, 2));
                // one rounding of T, in 255ths
                CHECK(q0 <= x0 * T(255) * (T(1) + epsilon));
                CHECK(q0 > x0 * T(255) - T(1) - T(255) * epsilon);
                CHECK(q1 >= x1 * T(255) * (T(1) - epsilon));
                CHECK(q1 < x1 * T(255) + T(1) + T(255) * epsilon);
                CHECK(std::abs(size - (x1 - x0) * T(255)) <= T(0.5) + T(512) * epsilon);
                if (low % 2 == 0 && high % 2 == 0 && nudge == 0) CHECK(size == static_cast<T>((high - low) / 2));
                CHECK(same(pack_part(unpack_part<T>(packed)), packed));
            }
}

TEST_CASE_TEMPLATE("packing what was unpacked gives the same words: every limit and size of an axis", T, float,
                   double) {
    test::Random random(1);
    for (std::uint32_t low = 0; low < 255; ++low)
        for (std::uint32_t high = low + 1; high <= 255; ++high)
            for (std::uint32_t more = 0; more <= 2 && more <= high - low; ++more) {
                if (more == 2 && (low == 0 || high == 255)) continue;  // never packed: an end of 0 or 1 is exact
                const std::uint32_t size = high - low - more;
                const std::uint32_t y0 = static_cast<std::uint32_t>(random.whole(0, 100)), y1 = y0 + 99;
                const std::uint32_t rect = low | y0 << 8 | high << 16 | y1 << 24, sizes = size << 16 | 98U << 24;
                CAPTURE(low);
                CAPTURE(high);
                CAPTURE(more);
                const Rect2<T> r = detail::unpack_rect<T>(rect, sizes);
                // what pack_part allows, or one less where that is a matter of rounding (-ffast-math)
                const T slack = T(1) - T(8) * std::numeric_limits<T>::epsilon();
                const auto most = static_cast<std::uint32_t>(std::floor(area(r) * T(65535) * slack));
                if (size == 0 && most == 0) continue;
                for (const std::uint32_t covered : {1U, most / 2 + 1, most}) {
                    if (covered > most) continue;
                    const PackedPart packed{rect, sizes | covered};
                    CHECK(same(pack_part(unpack_part<T>(packed)), packed));
                }
            }
}

TEST_CASE_TEMPLATE("a round trip keeps the part within its steps, and the next changes nothing", T, float, double) {
    test::Random random(2);
    double worst_area = 0, worst_filled = 0;
    const double step = 1.0 / 255;
    for (int i = 0; i < 200000; ++i) {
        const RadialPart<T> part = random_part<T>(random);
        const PackedPart packed = pack_part(part);
        const RadialPart<T> back = unpack_part<T>(packed);
        CAPTURE(i);
        CHECK(same(pack_part(back), packed));
        CHECK(same(unpack_part<T>(pack_part(back)), back));
        CHECK(back.area <= area(back.rect));
        const double size = static_cast<double>(area(part.rect)), lost = static_cast<double>(part.area - back.area);
        const Vec2<T> extents = part.rect.max - part.rect.min;
        const double border =
            part.area > T(0) ? static_cast<double>(extents.x + extents.y) * step / 2 + step * step : 0;
        CHECK(lost >= -0.505 / 65535);  // a tie, and a rounding of 65535 times the area
        if (static_cast<double>(part.area) < size - border)
            worst_area = std::max(worst_area, lost);
        else
            worst_filled = std::max(worst_filled, lost);
        // a filled rectangle may lose half a step of either size, and 1/65535 by rounding down
        CHECK(lost <= border + 1.001 / 65535);
        if (static_cast<double>(part.area) < size - border) CHECK(lost <= 1.001 / 65535);
        if (!(back.area > T(0))) continue;
        const double margin = step * 1.0001;
        CHECK(std::abs(static_cast<double>(back.rect.min.x - part.rect.min.x)) <= margin);
        CHECK(std::abs(static_cast<double>(back.rect.min.y - part.rect.min.y)) <= margin);
        CHECK(std::abs(static_cast<double>(back.rect.max.x - part.rect.max.x)) <= margin);
        CHECK(std::abs(static_cast<double>(back.rect.max.y - part.rect.max.y)) <= margin);
        const Vec2<T> unpacked = back.rect.max - back.rect.min;
        // sizes that are packed alike span a step
        CHECK(std::abs(static_cast<double>(unpacked.x - extents.x)) <= 0.7501 * step);
        CHECK(std::abs(static_cast<double>(unpacked.y - extents.y)) <= 0.7501 * step);
        if (part.rect.min.x == T(0) && part.rect.max.x < T(0.99)) CHECK(back.rect.min.x == T(0));
        if (part.rect.max.y == T(1) && part.rect.min.y > T(0.01)) CHECK(back.rect.max.y == T(1));
    }
    std::printf("packed: area less by at most %.2g, of filled rectangles by %.2g\n", worst_area, worst_filled);
}

TEST_CASE_TEMPLATE("any words give a valid part, and any numbers give words", T, float, double) {
    test::Random random(3);
    for (int i = 0; i < 200000; ++i) {
        PackedPart words{};
        for (std::uint32_t* word : {&words.rect, &words.coverage})
            for (int k = 0; k < 4; ++k) *word = *word << 8 | static_cast<std::uint32_t>(random.whole(0, 255));
        const RadialPart<T> part = unpack_part<T>(words);
        CAPTURE(words.rect);
        CAPTURE(words.coverage);
        CHECK(same(valid_part(part), part));
        // of words that pack_part does not make, too, those that it makes of them stay
        const PackedPart packed = pack_part(part);
        CHECK(same(pack_part(unpack_part<T>(packed)), packed));
        RadialPart<T> garbage;
        const auto number = [&] { return random.in(T(-3), T(3)) * exp2_int<T>(random.whole(-60, 60)); };
        garbage.area = number();
        for (Vec2<T>* v : {&garbage.moment, &garbage.rect.min, &garbage.rect.max}) v->x = number(), v->y = number();
        CHECK(same(pack_part(garbage), pack_part(valid_part(garbage))));
    }
}

TEST_CASE_TEMPLATE("four parts are four times one", T, float, double) {
    test::Random random(4);
    std::array<RadialPart<T>, 4> parts;
    for (RadialPart<T>& part : parts) part = random_part<T>(random);
    const PackedParts packed = pack_parts(parts);
    const std::array<RadialPart<T>, 4> back = unpack_parts<T>(packed);
    for (std::size_t k = 0; k < 4; ++k) {
        const PackedPart one = pack_part(parts[k]);
        CHECK(same(one, {packed.rects[k], packed.coverages[k]}));
        CHECK(same(back[k], unpack_part<T>(one)));
    }
}

TEST_CASE_TEMPLATE("blending through packed words errs by at most 1e-4 more", T, float, double) {
    // Random triangles in front of the light: the sizes of overlap.cpp, silhouettes one after the other in four parts,
    // the sum packed after each.
    const Rect2<T> light{Vec2<T>(T(-1), T(-1)), Vec2<T>(T(1), T(1))};
    for (const int count : {2, 5, 20}) {
        test::Random random(5);
        const int scenes = 2000 / count;
        double exact = 0, packed = 0, apart = 0, worst = 0;
        for (int s = 0; s < scenes; ++s) {
            std::vector<Polygon2> loops;
            std::array<RadialPart<T>, 4> sums, direct;
            sums.fill(empty_part<T>()), direct.fill(empty_part<T>());
            PackedParts words = pack_parts(sums);
            for (int c = 0; c < count; ++c) {
                const double size = (count == 2 ? 1.1 : count == 5 ? 0.7 : 0.4) * random.in(0.5, 1.5);
                const double x = random.in(-1.2, 1.2), y = random.in(-1.2, 1.2);
                const glm::dvec2 middle(x, y);
                std::array<double, 3> angles;
                for (double& angle : angles) angle = random.in(0.0, 6.28);
                std::sort(angles.begin(), angles.end());
                Polygon2 loop;
                for (const double angle : angles)
                    loop.push_back(middle + size * glm::dvec2(std::cos(angle), std::sin(angle)));
                loops.push_back(loop);
                sums = unpack_parts<T>(words);
                for (int k = 0; k < 4; ++k) {
                    RadialPartBuilder<T> builder(quadrant(light, k));
                    for (std::size_t i = 0; i < 3; ++i) builder.add(Vec2<T>(loop[i]), Vec2<T>(loop[(i + 1) % 3]), 1);
                    const auto q = static_cast<std::size_t>(k);
                    sums[q] = blend(sums[q], builder.finish()), direct[q] = blend(direct[q], builder.finish());
                }
                words = pack_parts(sums);
            }
            const double truth = test::union_area(loops, {{-1, -1}, {1, 1}}) / 4;
            double by_words = 0, by_parts = 0;
            for (const RadialPart<T>& part : unpack_parts<T>(words)) by_words += static_cast<double>(part.area) / 4;
            for (const RadialPart<T>& part : direct) by_parts += static_cast<double>(part.area) / 4;
            exact += (by_parts - truth) * (by_parts - truth) / scenes;
            packed += (by_words - truth) * (by_words - truth) / scenes;
            apart += (by_words - by_parts) * (by_words - by_parts) / scenes;
            worst = std::max(worst, std::abs(by_words - by_parts));
        }
        exact = std::sqrt(exact), packed = std::sqrt(packed), apart = std::sqrt(apart);
        std::printf("%2d casters: RMSE %.5f, packed %.5f; apart RMS %.5f, worst %.4f\n", count, exact, packed, apart,
                    worst);
        CHECK(packed <= exact + 1e-4);
        CHECK(apart <= 1e-3);
    }
}
