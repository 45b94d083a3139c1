// How fast the prefilters are built, against a memcpy that moves as many bytes, and how fast they are read.
//
// Builds, size × images: each iteration times the memcpy and then the build, single-threaded, for one image after the
// other. A single image stays in the cache; several are what slices are, and do not. `ratio` is the median over
// iterations of build / memcpy; the times of both are medians too. Lookups: for single boxes of a size, anywhere in the
// image.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <penumbra/occlusion_texture/mipmap.hpp>
#include <penumbra/occlusion_texture/n_buffer.hpp>
#include <penumbra/occlusion_texture/summed_area.hpp>
#include <random>
#include <vector>

#if defined(PENUMBRA_BENCHMARK_OPENCV)
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#endif

namespace {

using penumbra::Image;
using Bytes = Image<std::uint8_t>;

/// Blots of shadow, and noise at their edges.
Bytes random_image(int size) {
    std::mt19937 engine(1);
    Bytes image(size, size);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = static_cast<std::uint8_t>(((i / 64 + i / 65536) % 3 == 0 ? 255U : 0U) ^ (engine() >> 28));
    return image;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

template <class Work>
double seconds(Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    benchmark::ClobberMemory();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times copy(i) and build(i), i = 0, 1, … images − 1, 0, …
template <class Copy, class Build>
void compare(benchmark::State& state, Copy copy, Build build) {
    const auto images = static_cast<std::size_t>(state.range(1));
    std::vector<double> copies, builds, ratios;
    for (std::size_t i = 0; i < images; ++i) copy(i), build(i);
    std::size_t i = 0;
    for (auto _ : state) {
        const auto copied = [&] { copy(i); };
        const auto built = [&] { build(i); };
        copies.push_back(seconds(copied));
        builds.push_back(seconds(built));
        ratios.push_back(builds.back() / copies.back());
        state.SetIterationTime(builds.back());
        i = (i + 1) % images;
    }
    state.counters["ratio"] = median(ratios);
    state.counters["build_us"] = 1e6 * median(builds);
    state.counters["memcpy_us"] = 1e6 * median(copies);
}

std::vector<Bytes> random_images(const benchmark::State& state) {
    return std::vector<Bytes>(static_cast<std::size_t>(state.range(1)), random_image(static_cast<int>(state.range(0))));
}

/// A memcpy that reads and writes as many bytes as a build does, both together.
class EqualCopy {
  public:
    EqualCopy(std::size_t images, std::size_t bytes_read_and_written)
        : from_(images, std::vector<char>(bytes_read_and_written / 2, 1)), to_(from_) {}
    void operator()(std::size_t i) {
        std::memcpy(to_[i].data(), from_[i].data(), from_[i].size());
        benchmark::DoNotOptimize(to_[i].data());
    }

  private:
    std::vector<std::vector<char>> from_, to_;
};

/// All levels but the image itself; the memcpy is one from each level to the next, in the same memory.
void build_n_buffer(benchmark::State& state) {
    const std::vector<Bytes> images = random_images(state);
    const penumbra::NBuffer<std::uint8_t> first(images[0]);
    std::vector<std::vector<Bytes>> buffers(images.size());
    for (std::vector<Bytes>& levels : buffers)
        for (int level = 0; level < first.levels(); ++level) levels.push_back(first.level(level));
    const int size = images[0].width();
    const auto copy = [&](std::size_t i) {
        std::vector<Bytes>& levels = buffers[i];
        for (std::size_t l = 1; l < levels.size(); ++l) {
            std::memcpy(levels[l].data(), levels[l - 1].data(), levels[l].size());
            benchmark::DoNotOptimize(levels[l].data());
        }
    };
    const auto build = [&](std::size_t i) {
        std::vector<Bytes>& levels = buffers[i];
        for (std::size_t l = 1; l < levels.size(); ++l)
            penumbra::build_n_buffer_level(levels[l - 1].data(), levels[l].data(), size, size, size, 1,
                                           static_cast<int>(l) - 1);
    };
    compare(state, copy, build);
}

void build_summed_area(benchmark::State& state) {
    const std::vector<Bytes> images = random_images(state);
    std::vector<penumbra::SummedArea<std::uint32_t>> tables;
    for (const Bytes& image : images) tables.emplace_back(image);
    compare(state, EqualCopy(images.size(), images[0].size() + tables[0].bytes()),
            [&](std::size_t i) { tables[i].rebuild(images[i]); });
}

void build_mipmap(benchmark::State& state) {
    const std::vector<Bytes> images = random_images(state);
    std::vector<penumbra::MipMap<std::uint8_t>> mipmaps;
    for (const Bytes& image : images) mipmaps.emplace_back(image);
    compare(state, EqualCopy(images.size(), 2 * mipmaps[0].bytes()),
            [&](std::size_t i) { mipmaps[i].rebuild(images[i]); });
}

#if defined(PENUMBRA_BENCHMARK_OPENCV)
void build_opencv_integral(benchmark::State& state) {
    cv::setNumThreads(1);
    std::vector<Bytes> images = random_images(state);
    std::vector<cv::Mat> tables(images.size());
    const int size = images[0].width();
    const std::size_t bytes = images[0].size() + static_cast<std::size_t>((size + 1) * (size + 1)) * sizeof(int);
    compare(state, EqualCopy(images.size(), bytes),
            [&](std::size_t i) { cv::integral(cv::Mat(size, size, CV_8U, images[i].data()), tables[i], CV_32S); });
}
#endif

void build_sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({256, 1})->Args({1024, 1})->Args({1024, 8})->UseManualTime()->Unit(benchmark::kMicrosecond);
}
BENCHMARK(build_n_buffer)->Apply(build_sizes);
BENCHMARK(build_summed_area)->Apply(build_sizes);
#if defined(PENUMBRA_BENCHMARK_OPENCV)
BENCHMARK(build_opencv_integral)->Apply(build_sizes);
#endif
BENCHMARK(build_mipmap)->Apply(build_sizes);

template <class Filter>
void look_up(benchmark::State& state) {
    using Box = penumbra::Rect2<float>;
    const Bytes image = random_image(1024);
    const Filter filter(image);
    const auto side = static_cast<float>(state.range(0));
    std::mt19937 engine(2);
    std::vector<Box> boxes;
    for (int i = 0; i < 4096; ++i) {
        const auto x = static_cast<float>(engine() >> 8) * (1024.0F / 16777216.0F);
        const auto y = static_cast<float>(engine() >> 8) * (1024.0F / 16777216.0F);
        boxes.push_back({{x, y}, {x + side, y + side}});
    }
    for (auto _ : state)
        for (const Box& box : boxes) benchmark::DoNotOptimize(filter.mean(box));
    state.counters["ns_per_box"] =
        benchmark::Counter(static_cast<double>(boxes.size()) * 1e-9,  // inverted: seconds · 1e9 a box
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void box_sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->RangeMultiplier(4)->Range(1, 256)->Unit(benchmark::kMicrosecond);
}
BENCHMARK_TEMPLATE(look_up, penumbra::MipMap<std::uint8_t>)->Apply(box_sizes);
BENCHMARK_TEMPLATE(look_up, penumbra::NBuffer<std::uint8_t>)->Apply(box_sizes);
BENCHMARK_TEMPLATE(look_up, penumbra::SummedArea<std::uint32_t>)->Apply(box_sizes);

}  // namespace

BENCHMARK_MAIN();
