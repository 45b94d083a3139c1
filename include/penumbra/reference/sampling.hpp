// Where rays end: stratified, R2 and Sobol samples of the unit square, scrambled for each point, and how the square
// lies on a light. Needs no ray tracer.
//
// A set is built once. For each point asked it is only shifted (R2), XORed (Sobol) or jittered (stratified), in 32-bit
// fixed point and loops that vectorise. It is kept in Morton order, which all three scramblings respect: sixteen
// neighbours in the set cover a compact part of the light, so that packets of rays stay coherent.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <penumbra/light.hpp>
#include <utility>
#include <vector>

namespace penumbra::reference {

enum class Sampler {
    stratified,  ///< one random sample in each of n cells of equal area; for n that is not a square, rows differ by one
    r2,          ///< additive recurrence with the plastic number, randomly rotated
    sobol,       ///< first two dimensions, randomly XORed; best for powers of two
};

/// A hash in which every input bit flips every output bit about half of the time.
/// Source: C. Wellons, "Prospecting for hash functions", 2018 (lowbias32).
inline std::uint32_t mix_bits(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

/// What makes the samples of one point independent of those of another.
struct Scramble {
    std::uint32_t x, y;
};

/// The scramble of a point: a hash of its coordinates' bits and the seed, the same in whatever order points come.
template <class T>
Scramble scramble(const Vec3<T>& point, std::uint32_t seed) {
    std::uint32_t words[3 * sizeof(T) / 4];
    std::memcpy(words, &point.x, sizeof(T));
    std::memcpy(words + sizeof(T) / 4, &point.y, sizeof(T));
    std::memcpy(words + 2 * sizeof(T) / 4, &point.z, sizeof(T));
    std::uint32_t hash = mix_bits(seed + 0x9e3779b9U);
    for (const std::uint32_t word : words) hash = mix_bits(hash ^ word) + 0x9e3779b9U;
    return {mix_bits(hash), mix_bits(hash ^ 0x85ebca6bU)};
}

/// A set of samples of the unit square, or of the unit interval (then every y is the scramble alone: ignore it).
class SampleSet {
  public:
    /// `count` ≥ 1 samples. `aspect` = width / height ≥ 0 of what the square is stretched to: the cells of stratified
    /// samples become as square as can be there. Cost O(count log count).
    SampleSet(Sampler sampler, int count, int dimensions = 2, double aspect = 1.0) : sampler_(sampler) {
        const auto n = static_cast<std::uint32_t>(std::max(count, 1));
        x_.resize(n), y_.resize(n);
        switch (sampler) {
            case Sampler::stratified:
                stratify(n, dimensions, aspect);
                break;
            case Sampler::r2:
                recur(n, dimensions);
                break;
            case Sampler::sobol:
                sobol(n, dimensions);
                break;
        }
        sort();
    }

    std::size_t size() const { return x_.size(); }

    /// Writes `count` samples from the `first` on, in [0, 1): multiples of 2^-24.
    void write(std::size_t first, std::size_t count, const Scramble& scramble, float* x, float* y) const {
        const std::uint32_t *px = x_.data() + first, *py = y_.data() + first;
        switch (sampler_) {
            case Sampler::stratified: {
                const std::uint32_t *wx = width_.data() + first, *wy = height_.data() + first;
                const auto start = static_cast<std::uint32_t>(first) + scramble.x;
                for (std::size_t i = 0; i < count; ++i) {
                    const std::uint32_t random = mix_bits((start + static_cast<std::uint32_t>(i)) * 0x9e3779b9U);
                    x[i] = to_unit(px[i] + scale(random, wx[i]));
                    y[i] = to_unit(py[i] + scale(mix_bits(random ^ scramble.y), wy[i]));
                }
                break;
            }
            case Sampler::r2:
                for (std::size_t i = 0; i < count; ++i) x[i] = to_unit(px[i] + scramble.x);
                for (std::size_t i = 0; i < count; ++i) y[i] = to_unit(py[i] + scramble.y);
                break;
            case Sampler::sobol:
                for (std::size_t i = 0; i < count; ++i) x[i] = to_unit(px[i] ^ scramble.x);
                for (std::size_t i = 0; i < count; ++i) y[i] = to_unit(py[i] ^ scramble.y);
                break;
        }
    }

  private:
    static float to_unit(std::uint32_t bits) {
        return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * (1.0F / 16777216.0F);
    }
    /// random · width / 2^32
    static std::uint32_t scale(std::uint32_t random, std::uint32_t width) {
        return static_cast<std::uint32_t>((std::uint64_t{random} * width) >> 32);
    }

    /// Rows of ⌊n/rows⌋ or ⌈n/rows⌉ cells, each row as high as its share of cells: n cells of area 1/n for any n.
    void stratify(std::uint32_t n, int dimensions, double aspect) {
        const double ideal = std::sqrt(n / std::max(aspect, 1e-9));
        const auto rows =
            dimensions == 1 ? 1U : static_cast<std::uint32_t>(clamp(ideal + 0.5, 1.0, static_cast<double>(n)));
        const auto part = [](std::uint64_t i, std::uint64_t of) { return (i << 32) / of; };
        width_.resize(n), height_.resize(n);
        for (std::uint64_t row = 0, cell = 0; row < rows; ++row) {
            const std::uint64_t first = row * n / rows, last = (row + 1) * n / rows;
            for (; cell < last; ++cell) {
                const std::uint64_t left = part(cell - first, last - first), below = part(first, n);
                x_[cell] = static_cast<std::uint32_t>(left);
                y_[cell] = static_cast<std::uint32_t>(below);
                width_[cell] = static_cast<std::uint32_t>(part(cell - first + 1, last - first) - left - 1);
                height_[cell] = static_cast<std::uint32_t>(part(last, n) - below - 1);
            }
        }
    }

    /// Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018. g³ = g + 1 in two
    /// dimensions, g² = g + 1 in one; the steps are 2^64 / g and 2^64 / g².
    void recur(std::uint32_t n, int dimensions) {
        const std::uint64_t step_x = dimensions == 1 ? 0x9e3779b97f4a7c15U : 0xc13fa9a902a6328fU;
        const std::uint64_t step_y = dimensions == 1 ? 0U : 0x91e10da5c79e7b1cU;
        for (std::uint64_t i = 0; i < n; ++i) {
            x_[i] = static_cast<std::uint32_t>((i * step_x) >> 32);
            y_[i] = static_cast<std::uint32_t>((i * step_y) >> 32);
        }
    }

    /// Dimension 1 is the radical inverse: direction numbers 2^31, 2^30, … Dimension 2 belongs to the primitive
    /// polynomial z + 1: each direction number is the previous one XORed with its half.
    /// Source: I. M. Sobol, "On the distribution of points in a cube", 1967.
    void sobol(std::uint32_t n, int dimensions) {
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t x = 0, y = 0, direction_x = 1U << 31, direction_y = 1U << 31;
            for (std::uint32_t bits = i; bits != 0; bits >>= 1) {
                if (bits & 1U) x ^= direction_x, y ^= direction_y;
                direction_x >>= 1;
                direction_y ^= direction_y >> 1;
            }
            x_[i] = x;
            y_[i] = dimensions == 1 ? 0 : y;
        }
    }

    /// Bits of a 16-bit number moved to the even places.
    static std::uint32_t spread(std::uint32_t x) {
        x = (x | (x << 8)) & 0x00ff00ffU;
        x = (x | (x << 4)) & 0x0f0f0f0fU;
        x = (x | (x << 2)) & 0x33333333U;
        return (x | (x << 1)) & 0x55555555U;
    }

    void sort() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> order(x_.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {spread(x_[i] >> 16) << 1 | spread(y_[i] >> 16), i};
        std::sort(order.begin(), order.end());
        for (std::vector<std::uint32_t>* values : {&x_, &y_, &width_, &height_}) {
            if (values->empty()) continue;
            const std::vector<std::uint32_t> old = *values;
            for (std::size_t i = 0; i < order.size(); ++i) (*values)[i] = old[order[i].second];
        }
    }

    Sampler sampler_;
    std::vector<std::uint32_t> x_, y_;           // fixed point, 2^32 = 1; of stratified cells the lower corner
    std::vector<std::uint32_t> width_, height_;  // of stratified cells, less 2^-32
};

/// The square [−1, 1]² onto the unit disk, equal areas to equal areas, (0, 0) to (0, 0). Error below 2e-7. No branches
/// and no library calls, so that loops over it vectorise; sine and cosine of up to π/4 are power series.
/// Source: P. Shirley & K. Chiu, "A low distortion map between disk and square", 1997.
inline void to_disk(float& a, float& b) {
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = wide ? a : b, other = wide ? b : a;
    const float q = other / (radius != 0.0F ? radius : 1.0F), t = q * q;
    const float sine = q * (7.85398163e-1F +
                            t * (-8.07455122e-2F + t * (2.49039457e-3F + t * (-3.65762042e-5F + t * 3.13361689e-7F))));
    const float cosine =
        1.0F + t * (-3.08425138e-1F + t * (1.58543442e-2F + t * (-3.25991887e-4F + t * 3.59086045e-6F)));
    a = radius * (wide ? cosine : sine);
    b = radius * (wide ? sine : cosine);
}

/// A light as samples see it: frame.origin + a · u + b · v with (a, b) in [−1, 1]², or in the unit disk if round.
template <class T>
struct Emitter {
    LightFrame<T> frame;
    Vec3<T> u, v;
    int dimensions;  ///< 1 for a line: v is zero
    bool round;
    bool one_sided;  ///< emits on the positive side of its plane only
};

/// `middle` is where lights without a direction of their own look to (see light_frame).
template <class T>
Emitter<T> emitter(const RectLight<T>& light, const Vec3<T>& middle) {
    return {light_frame(light, middle - light.center), light.half_u, light.half_v, 2, false, true};
}
template <class T>
Emitter<T> emitter(const DiskLight<T>& light, const Vec3<T>&) {
    const LightFrame<T> frame = light_frame(light);
    return {frame, frame.u * light.radius, frame.v * light.radius, 2, true, true};
}
template <class T>
Emitter<T> emitter(const LinearLight<T>& light, const Vec3<T>& middle) {
    const Vec3<T> half = (light.b - light.a) * T(0.5);
    return {light_frame(light, middle - light.a), half, Vec3<T>(T(0), T(0), T(0)), 1, false, false};
}

/// The samples that suit the shape of an emitter; one sample if it has no size.
template <class T>
SampleSet sample_set(const Emitter<T>& emitter, Sampler sampler, int count) {
    const double width = static_cast<double>(glm::length(emitter.u));
    const double height = static_cast<double>(glm::length(emitter.v));
    if (!(width + height > 0.0)) return SampleSet(sampler, 1, 1);
    return SampleSet(sampler, count, emitter.dimensions, width / std::max(height, 1e-9 * width));
}

}  // namespace penumbra::reference
