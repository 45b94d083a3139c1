#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/reference/sampling.hpp>
#include <set>
#include <vector>

#include "../support/random.hpp"

using namespace penumbra;
using namespace penumbra::reference;

namespace {

struct Samples {
    std::vector<float> x, y;
};

Samples take(const SampleSet& set, const Scramble& scramble) {
    Samples samples{std::vector<float>(set.size()), std::vector<float>(set.size())};
    set.write(0, set.size(), scramble, samples.x.data(), samples.y.data());
    return samples;
}

/// The scramble of the k-th of some points.
Scramble scramble_of(std::uint32_t k) { return scramble(Vec3<float>(static_cast<float>(k), 1.0F, 2.0F), 9); }

/// Star discrepancy over the boxes [0, x) × [0, y) whose corners are taken from a grid fine enough for n samples.
double discrepancy(const Samples& s) {
    constexpr int grid = 127;  // not a power of two: those lines Sobol samples meet exactly
    const auto n = static_cast<double>(s.x.size());
    std::vector<int> below((grid + 1) * (grid + 1), 0);
    const auto at = [&](int i, int j) -> int& { return below[static_cast<std::size_t>(j * (grid + 1) + i)]; };
    for (std::size_t k = 0; k < s.x.size(); ++k)
        ++at(static_cast<int>(s.x[k] * grid) + 1, static_cast<int>(s.y[k] * grid) + 1);
    double worst = 0.0;
    for (int j = 1; j <= grid; ++j)
        for (int i = 1; i <= grid; ++i) {
            at(i, j) += at(i - 1, j) + at(i, j - 1) - at(i - 1, j - 1);
            worst = std::max(worst, std::abs(at(i, j) / n - static_cast<double>(i * j) / (grid * grid)));
        }
    return worst;
}

constexpr Sampler samplers[] = {Sampler::stratified, Sampler::r2, Sampler::sobol};

}  // namespace

TEST_CASE("every sample lies in [0, 1), for any count and scramble") {
    for (const Sampler sampler : samplers)
        for (const int count : {1, 2, 3, 7, 16, 17, 100, 4096})
            for (const int dimensions : {1, 2})
                for (const Scramble s : {Scramble{0, 0}, Scramble{~0U, ~0U}, scramble_of(1)}) {
                    CAPTURE(static_cast<int>(sampler));
                    CAPTURE(count);
                    const SampleSet set(sampler, count, dimensions);
                    REQUIRE(set.size() == static_cast<std::size_t>(count));
                    const Samples samples = take(set, s);
                    const auto [x0, x1] = std::minmax_element(samples.x.begin(), samples.x.end());
                    const auto [y0, y1] = std::minmax_element(samples.y.begin(), samples.y.end());
                    CHECK(*x0 >= 0.0F);
                    CHECK(*x1 < 1.0F);
                    CHECK(*y0 >= 0.0F);
                    CHECK(*y1 < 1.0F);
                }
}

TEST_CASE("writing in parts gives the same samples as writing all at once") {
    for (const Sampler sampler : samplers) {
        const SampleSet set(sampler, 100);
        const Samples all = take(set, scramble_of(3));
        Samples parts{std::vector<float>(100), std::vector<float>(100)};
        for (std::size_t first = 0; first < 100; first += 16)
            set.write(first, std::min<std::size_t>(16, 100 - first), scramble_of(3), &parts.x[first], &parts.y[first]);
        CHECK(all.x == parts.x);
        CHECK(all.y == parts.y);
    }
}

TEST_CASE("scrambled Sobol samples keep one sample in every dyadic rectangle of area 1/n") {
    for (int log = 0; log <= 12; ++log) {
        const int n = 1 << log;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Samples s = take(SampleSet(Sampler::sobol, n), scramble_of(k));
            for (int columns_log = 0; columns_log <= log; ++columns_log) {
                const int columns = 1 << columns_log, rows = n / columns;
                std::set<int> cells;
                for (std::size_t i = 0; i < s.x.size(); ++i)
                    cells.insert(static_cast<int>(s.x[i] * static_cast<float>(columns)) +
                                 columns * static_cast<int>(s.y[i] * static_cast<float>(rows)));
                CAPTURE(n);
                CAPTURE(columns);
                CHECK(cells.size() == static_cast<std::size_t>(n));
            }
        }
    }
}

TEST_CASE("stratified samples of a square count have one sample in every cell of the square grid") {
    for (const int side : {1, 2, 3, 5, 8, 10, 64}) {
        const Samples s = take(SampleSet(Sampler::stratified, side * side), scramble_of(5));
        std::set<int> cells;
        for (std::size_t i = 0; i < s.x.size(); ++i)
            cells.insert(static_cast<int>(s.x[i] * static_cast<float>(side)) +
                         side * static_cast<int>(s.y[i] * static_cast<float>(side)));
        CAPTURE(side);
        CHECK(cells.size() == s.x.size());
    }
}

TEST_CASE("stratified cells follow the aspect of the light: a strip is cut along its length") {
    // width : height = 16 : 1 and 64 samples: 2 rows of 32, cells twice as high as wide
    for (const bool upright : {false, true}) {
        const Samples s = take(SampleSet(Sampler::stratified, 64, 2, upright ? 1.0 / 16.0 : 16.0), scramble_of(6));
        std::set<int> cells;
        for (std::size_t i = 0; i < s.x.size(); ++i)
            cells.insert(static_cast<int>(s.x[i] * (upright ? 2.0F : 32.0F)) * 32 +
                         static_cast<int>(s.y[i] * (upright ? 32.0F : 2.0F)));
        CHECK(cells.size() == 64);
    }
    // on a line, and on rectangles without height, everything goes along
    for (const int dimensions : {1, 2}) {
        Samples s = take(SampleSet(Sampler::stratified, 50, dimensions, 1e9), scramble_of(7));
        std::sort(s.x.begin(), s.x.end());
        for (std::size_t i = 0; i < 50; ++i) CHECK(static_cast<std::size_t>(s.x[i] * 50.0F) == i);
    }
}

TEST_CASE("each sampler is unbiased: over many scrambles, samples fill the square evenly") {
    for (const Sampler sampler : samplers)
        for (const int count : {7, 16}) {  // 7: stratified rows of different lengths
            const SampleSet set(sampler, count);
            std::vector<double> below_x(8, 0.0), below_y(8, 0.0);
            for (std::uint32_t k = 0; k < 4000; ++k) {
                const Samples s = take(set, scramble_of(k));
                for (std::size_t i = 0; i < s.x.size(); ++i) {
                    below_x[static_cast<std::size_t>(s.x[i] * 8.0F)] += 1.0 / (4000.0 * count);
                    below_y[static_cast<std::size_t>(s.y[i] * 8.0F)] += 1.0 / (4000.0 * count);
                }
            }
            CAPTURE(static_cast<int>(sampler));
            CAPTURE(count);
            // each bin: a fraction of 1/8 from at least 4000 independent numbers, standard error ≤ .0052
            for (std::size_t bin = 0; bin < 8; ++bin) {
                CHECK(below_x[bin] == doctest::Approx(0.125).epsilon(0.19));
                CHECK(below_y[bin] == doctest::Approx(0.125).epsilon(0.19));
            }
        }
}

TEST_CASE("over many scrambles a sample is uniform in the square, both coordinates independent") {
    // stratified: of the one cell of a single sample
    for (const Sampler sampler : samplers) {
        const SampleSet set(sampler, sampler == Sampler::stratified ? 1 : 16);
        std::vector<int> bins(64, 0);
        for (std::uint32_t k = 0; k < 6400; ++k) {
            float x = 0.0F, y = 0.0F;
            set.write(set.size() / 3, 1, scramble_of(k), &x, &y);
            ++bins[static_cast<std::size_t>(x * 8.0F) * 8 + static_cast<std::size_t>(y * 8.0F)];
        }
        double chi_squared = 0.0;
        for (const int bin : bins) chi_squared += (bin - 100.0) * (bin - 100.0) / 100.0;
        CAPTURE(static_cast<int>(sampler));
        CHECK(chi_squared < 119.0);  // 63 degrees of freedom: mean 63, and five times its deviation of 11.2
    }
}

TEST_CASE("discrepancy is below that of random samples, and falls faster than n^-1/2") {
    // Ratios to random samples, five scrambles each. Limits are a third above what was measured at 64 samples, and let
    // the ratio fall a little slower than it does: n^-.2, n^-.3 and n^-.4.
    constexpr double limit[] = {0.66, 0.53, 0.33}, power[] = {0.15, 0.25, 0.35};
    test::Random random(1);
    for (const int n : {64, 256, 1024, 4096}) {
        double of_random = 0.0, of[3] = {};
        for (std::uint32_t k = 0; k < 5; ++k) {
            Samples uniform;
            for (int i = 0; i < n; ++i) {
                uniform.x.push_back(random.in(0.0F, 1.0F));
                uniform.y.push_back(random.in(0.0F, 1.0F));
            }
            of_random += discrepancy(uniform);
            for (const Sampler sampler : samplers)
                of[static_cast<int>(sampler)] += discrepancy(take(SampleSet(sampler, n), scramble_of(k)));
        }
        CAPTURE(n);
        for (int sampler = 0; sampler < 3; ++sampler) {
            CAPTURE(sampler);
            CHECK(of[sampler] / of_random < limit[sampler] * std::pow(64.0 / n, power[sampler]));
        }
    }
}

TEST_CASE("sixteen neighbours in a set cover a small part of the square") {
    // A sixteenth of 1024 samples would fill a square of side 1/8 = .125 if the square were cut perfectly.
    for (const Sampler sampler : samplers) {
        const Samples s = take(SampleSet(sampler, 1024), Scramble{0, 0});
        double mean_side = 0.0;
        for (std::size_t first = 0; first < 1024; first += 16) {
            const auto [x0, x1] = std::minmax_element(&s.x[first], &s.x[first] + 16);
            const auto [y0, y1] = std::minmax_element(&s.y[first], &s.y[first] + 16);
            mean_side += static_cast<double>(std::max(*x1 - *x0, *y1 - *y0)) / 64.0;
        }
        CAPTURE(static_cast<int>(sampler));
        CHECK(mean_side < 0.25);
    }
}

TEST_CASE("scrambles differ between points, between seeds and between the axes, and repeat for the same point") {
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 1000; ++i)
        for (const std::uint32_t seed : {0U, 1U}) {
            const Scramble s = scramble(Vec3<float>(static_cast<float>(i) * 1e-3F, 0.0F, 0.0F), seed);
            seen.insert(s.x);
            seen.insert(s.y);
        }
    CHECK(seen.size() == 4000);  // 4000 of 2^32: a collision has probability .002
    const Vec3<double> p(0.1, 0.2, 0.3), q(0.1, 0.2, std::nextafter(0.3, 1.0));
    CHECK(scramble(p, 4).x == scramble(p, 4).x);
    CHECK(scramble(p, 4).x != scramble(q, 4).x);
    // swapped coordinates are another point
    CHECK(scramble(Vec3<float>(1.0F, 2.0F, 3.0F), 0).x != scramble(Vec3<float>(2.0F, 1.0F, 3.0F), 0).x);
}

TEST_CASE("hash bits flip half of the time for each input bit") {
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
        int flipped = 0;
        for (std::uint32_t x = 0; x < 1000; ++x) {
            std::uint32_t changed = mix_bits(x * 2654435761U) ^ mix_bits(x * 2654435761U ^ (1U << bit));
            for (; changed != 0; changed &= changed - 1) ++flipped;
        }
        CAPTURE(bit);
        CHECK(flipped / 32000.0 == doctest::Approx(0.5).epsilon(0.02));  // standard error .0028
    }
}

TEST_CASE("the square maps onto the disk: radius and angle by the definition, in double") {
    for (int j = -50; j <= 50; ++j)
        for (int i = -50; i <= 50; ++i) {
            const double a = i / 50.0, b = j / 50.0, quarter = std::acos(-1.0) / 4.0;
            const bool wide = std::abs(a) > std::abs(b);
            const double r = wide ? a : b, angle = r == 0.0 ? 0.0 : wide ? quarter * b / a : quarter * (2.0 - a / b);
            float x = static_cast<float>(a), y = static_cast<float>(b);
            to_disk(x, y);
            CAPTURE(a);
            CAPTURE(b);
            CHECK(std::abs(static_cast<double>(x) - r * std::cos(angle)) < 2e-7);
            CHECK(std::abs(static_cast<double>(y) - r * std::sin(angle)) < 2e-7);
        }
}

TEST_CASE("a light without size has one sample; one without height is sampled along its width") {
    const Vec3<float> zero(0.0F, 0.0F, 0.0F), x(1.0F, 0.0F, 0.0F);
    const auto count = [&](const auto& light) { return sample_set(emitter(light, zero), Sampler::sobol, 64).size(); };
    CHECK(count(RectLight<float>{x, zero, zero}) == 1);
    CHECK(count(DiskLight<float>{x, x, 0.0F}) == 1);
    CHECK(count(LinearLight<float>{x, x}) == 1);
    CHECK(count(RectLight<float>{zero, x, zero}) == 64);
    CHECK(count(RectLight<float>{zero, zero, x}) == 64);
    const SampleSet flat = sample_set(emitter(RectLight<float>{zero, x, zero}, zero), Sampler::stratified, 50);
    Samples s = take(flat, scramble_of(1));
    std::sort(s.x.begin(), s.x.end());
    for (std::size_t i = 0; i < 50; ++i) CHECK(static_cast<std::size_t>(s.x[i] * 50.0F) == i);
}
