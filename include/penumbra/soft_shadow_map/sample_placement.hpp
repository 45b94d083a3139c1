// Where on a line light maps are needed.
//
// Between two maps a third is drawn, half-way. It tests the two: points on the casters and receivers that it looks at
// are asked without it and with it, and if that differs too much it stays, and both halves are tested in turn, the
// worst first. What no map of a test sees is not found; that is what the rule of the narrowest gap is for: a part of
// the light that a point sees between two casters is at least as long as the gap between these is wide, so that samples
// that close let one map at least look through every gap.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/light_map_maker.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// The width, world units, of the narrowest gap in any row of a map: from the end of a surface to where another begins
/// beside it, at the depth of the nearer, with nothing, or what lies at least `step` behind both, between. The largest
/// number there is if there is none. A gap is taken for one texel narrower than it looks.
template <class T>
T narrowest_gap(const LightMapView<T>& view, const LightMap<T>& map, T step) {
    constexpr T none = LightMap<T>::none;
    const int size = view.resolution;
    const T texel = (view.slopes.max.x - view.slopes.min.x) / static_cast<T>(size);
    T narrowest = none;
    for (int y = 0; y < size; ++y) {
        T before = T(0);  // the depth of what ended last; 0 if nothing did
        int end = 0;
        for (int x = 1; x < size; ++x) {
            const T left = map.caster(x - 1, y), right = map.caster(x, y);
            if (left < none && left + step < right) before = left, end = x;
            if (right < none && right + step < left && before > T(0)) {
                const T width = static_cast<T>(std::max(x - end - 1, 1)) * texel;
                narrowest = std::min(narrowest, width * std::min(before, right));
                before = T(0);
            }
        }
    }
    return narrowest;
}

/// How many samples, evenly from end to end, look through every gap of that width; at most `most`.
template <class T>
int samples_for_gap(T length, T gap, int most) {
    const T pieces = length < gap * static_cast<T>(most) ? std::ceil(length / gap) : static_cast<T>(most);
    return std::max(2, std::min(most, static_cast<int>(pieces) + 1));
}

namespace detail {

/// Finds positions; make(maps) makes what answers queries: make(maps).visibility(point in light space).
template <class T, class Make>
class SamplePlacement {
  public:
    SamplePlacement(const LightMapMaker<T>& maker, const Make& make) : maker_(maker), make_(make) {}

    /// Adds maps between those in `maps`, which are in the order of their positions, until tests differ by less than
    /// `tolerance`, RMS over what is in shadow, or there are `most`.
    void refine(std::vector<LightMap<T>>& maps, int most, T tolerance) const {
        const T length = maps.back().position - maps.front().position;
        if (!(length > T(0)) || static_cast<int>(maps.size()) >= most) return;
        std::vector<Test> tests;
        for (std::size_t i = 0; i + 1 < maps.size(); ++i) tests.push_back(test(maps[i], maps[i + 1], length));
        while (static_cast<int>(maps.size()) < most) {
            T all = T(0);
            std::size_t worst = 0;
            for (std::size_t i = 0; i < tests.size(); ++i) {
                all += tests[i].error * tests[i].error;
                if (tests[i].error > tests[worst].error) worst = i;
            }
            if (!(all > tolerance * tolerance)) return;
            const auto at = static_cast<std::ptrdiff_t>(worst);
            maps.insert(maps.begin() + at + 1, std::move(tests[worst].middle));
            if (static_cast<int>(maps.size()) == most) return;
            tests[worst] = test(maps[worst], maps[worst + 1], length);
            tests.insert(tests.begin() + at + 1, test(maps[worst + 1], maps[worst + 2], length));
        }
    }

  private:
    static constexpr int probe_rows = 24;  // all columns of them: what is seen through a gap may be narrow

    /// What a map in the middle of two would change.
    struct Test {
        LightMap<T> middle;
        T error;
    };

    Test test(const LightMap<T>& first, const LightMap<T>& last, T length) const {
        Test result{maker_.make(T(0.5) * (first.position + last.position)), T(0)};
        const auto without = make_({&first, &last});
        const auto with = make_({&first, &result.middle, &last});
        const int size = maker_.view().resolution, rows = std::min(size, probe_rows);
        const T beyond = static_cast<T>(2.0 * maker_.farthest());  // where there is no receiver
        Difference difference;
        for (int j = 0; j < rows; ++j) {
            const int y = (2 * j + 1) * size / (2 * rows);
            add(without, with, result.middle, y, difference,
                [&](int x) { return std::min(result.middle.receiver(x, y), beyond); });
            add(without, with, result.middle, y, difference, [&](int x) { return result.middle.caster(x, y); });
        }
        result.error = (last.position - first.position) / length * static_cast<T>(difference.rms());
        return result;
    }

    struct Difference {
        double squares = 0.0;
        int shadowed = 0;
        double rms() const { return shadowed > 0 ? std::sqrt(squares / shadowed) : 0.0; }
    };

    /// Adds what points in row y see, one a column at depth_at(column), where that is not none. What half a texel would
    /// change does not count: it stays with any number of maps.
    template <class Answer, class DepthAt>
    void add(const Answer& without, const Answer& with, const LightMap<T>& middle, int y, Difference& difference,
             DepthAt&& depth_at) const {
        const LightMapView<T>& view = maker_.view();
        const std::size_t size = static_cast<std::size_t>(view.resolution);
        std::vector<T> a(size, T(-1)), b(size, T(-1));
        const T row = view.row_slope(static_cast<T>(y) + T(0.5));
        for (std::size_t x = 0; x < size; ++x) {
            const T depth = depth_at(static_cast<int>(x));
            if (!(depth < LightMap<T>::none)) continue;
            const T slope = view.column_slope(static_cast<T>(x) + T(0.5));
            const Vec3<T> point(slope * depth + middle.position, row * depth, depth);
            a[x] = without.visibility(point), b[x] = with.visibility(point);
        }
        for (std::size_t x = 1; x + 1 < size; ++x) {
            if (a[x] < T(0) || (!(a[x] < T(1)) && !(b[x] < T(1)))) continue;
            T around = T(0);
            for (const std::size_t other : {x - 1, x + 1})
                if (!(a[other] < T(0)))
                    around = std::max({around, std::abs(a[other] - a[x]), std::abs(b[other] - b[x])});
            const T change = std::max(std::abs(a[x] - b[x]) - T(0.5) * around, T(0));
            difference.squares += static_cast<double>(change * change);
            ++difference.shadowed;
        }
    }

    const LightMapMaker<T>& maker_;
    const Make& make_;
};

template <class T, class Make>
void refine_samples(const LightMapMaker<T>& maker, std::vector<LightMap<T>>& maps, int most, T tolerance,
                    const Make& make) {
    SamplePlacement<T, Make>(maker, make).refine(maps, most, tolerance);
}

}  // namespace detail
}  // namespace penumbra
