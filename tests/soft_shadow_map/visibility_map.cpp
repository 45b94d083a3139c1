#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/soft_shadow_map/visibility_map.hpp>
#include <vector>

#include "soft_shadow_map/line_scenes.hpp"

using namespace penumbra;
using namespace penumbra::test;

namespace {

/// Maps made by hand, a row each: depths of casters and receivers.
LightMap<double> map_of(double position, const std::vector<double>& casters, const std::vector<double>& receivers) {
    const int size = static_cast<int>(casters.size());
    LightMap<double> map;
    map.position = position;
    map.caster = map.receiver = Image<double>(size, size, LightMap<double>::none);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            map.caster(x, y) = casters[static_cast<std::size_t>(x)];
            map.receiver(x, y) = receivers[static_cast<std::size_t>(x)];
        }
    map.blocked = map.caster;
    return map;
}

constexpr double none = LightMap<double>::none;

/// 32 texels of slope 1/16 from -1 to 1; a caster at depth 2 over a floor at depth 4, its sides at slopes `left` and
/// `right` as seen from the light's centre.
LightMapView<double> view() { return {{{-1.0, -1.0}, {1.0, 1.0}}, 32}; }

LightMap<double> seen_from(double position, double left, double right) {
    std::vector<double> casters(32, none), floor(32, 4.0);
    for (int x = 0; x < 32; ++x) {
        const double slope = view().column_slope(x + 0.5) + position / 2.0;  // at depth 2, as the centre sees it
        if (slope > left && slope < right) casters[static_cast<std::size_t>(x)] = 2.0;
    }
    return map_of(position, casters, floor);
}

VisibilityChannel<double> channel(const LightMap<double>& source, const LightMap<double>& target,
                                  SkinTransition transition, StepDetector detector = StepDetector::slope_aware) {
    return visibility_channel(view(), source, target, transition, detector, 0.01);
}

}  // namespace

TEST_CASE("a skin from the side that the target sees past, rising from 0 to 1, and 1 everywhere else") {
    // maps at -0.5 and 0.5: disparities 1/4 at the caster, 1/8 at the floor, 4 and 2 texels from the centre's
    const LightMap<double> left = seen_from(-0.5, -0.25, 0.25), right = seen_from(0.5, -0.25, 0.25);
    for (const StepDetector detector : {StepDetector::slope_aware, StepDetector::laplacian})
        for (const SkinTransition transition :
             {SkinTransition::linear, SkinTransition::rational, SkinTransition::exact}) {
            const Image<double> visible = channel(left, right, transition, detector).visible;
            // the right side, at 0.25 + 0.25 in the left map, appears at 0.0 in the right one; the floor behind at 0.25
            for (int x = 0; x < 32; ++x) {
                const double slope = view().column_slope(x + 0.5), expected = clamp(slope / 0.25, 0.0, 1.0);
                CAPTURE(x);
                CHECK(visible(x, 7) == doctest::Approx(right.caster(x, 7) < none ? 1.0 : slope > 0.0 ? expected : 1.0));
            }
            // and mirrored: the other map sees past the left side
            const Image<double> mirrored = channel(right, left, transition, detector).visible;
            for (int x = 0; x < 32; ++x) CHECK(mirrored(31 - x, 7) == doctest::Approx(visible(x, 7)));
        }
}

TEST_CASE("edges are carried for exact transitions only") {
    const LightMap<double> left = seen_from(-0.5, -0.25, 0.25), right = seen_from(0.5, -0.25, 0.25);
    CHECK(channel(left, right, SkinTransition::linear).edges.empty());
    const VisibilityChannel<double> exact = channel(left, right, SkinTransition::exact);
    int parts = 0;
    for (int x = 0; x < 32; ++x) {
        if (!(exact.visible(x, 3) < 1.0)) continue;
        ++parts;
        CHECK(exact.edges(x, 3).slope == doctest::Approx(0.25));
        CHECK(exact.edges(x, 3).inverse_depth == doctest::Approx(0.5));
    }
    CHECK(parts == 4);
}

TEST_CASE("what is in front of a skin stays as it is; the least counts where skins overlap") {
    const LightMap<double> left = seen_from(-0.5, -0.25, 0.25);
    LightMap<double> right = seen_from(0.5, -0.25, 0.25);
    // a receiver before the skin where it would be drawn
    const Image<double> plain = channel(left, right, SkinTransition::linear).visible;
    right.receiver(17, 5) = 2.1;
    const Image<double> covered = channel(left, right, SkinTransition::linear).visible;
    CHECK(plain(17, 5) < 1.0);
    CHECK(covered(17, 5) == 1.0);
    CHECK(covered(18, 5) == plain(18, 5));
    // two casters whose skins overlap: nowhere more than past one alone
    const auto both = [](double position) {
        LightMap<double> first = seen_from(position, -0.25, 0.25);
        const LightMap<double> second = seen_from(position, 0.3, 0.4);
        for (std::size_t i = 0; i < first.caster.size(); ++i)
            first.caster.data()[i] = std::min(first.caster.data()[i], second.caster.data()[i]);
        return first;
    };
    const LightMap<double> target = both(0.5);
    const Image<double> together = channel(both(-0.5), target, SkinTransition::linear).visible;
    for (int x = 0; x < 32; ++x)
        if (!(target.caster(x, 9) < none)) CHECK(together(x, 9) <= plain(x, 9) + 1e-12);
}

TEST_CASE("maps of one position, maps without casters, receivers that hide nothing") {
    const LightMap<double> map = seen_from(0.0, -0.25, 0.25),
                           empty = map_of(1.0, std::vector<double>(32, none), std::vector<double>(32, 4.0));
    for (const LightMap<double>& source : {map, empty}) {
        const Image<double> visible = channel(source, map, SkinTransition::exact).visible;
        for (std::size_t i = 0; i < visible.size(); ++i) CHECK(visible.data()[i] == 1.0);
    }
    // a step of the receiver is no edge of a caster
    std::vector<double> stairs(32, 4.0);
    for (std::size_t x = 0; x < 12; ++x) stairs[x] = 2.0;
    const LightMap<double> a = map_of(-0.5, std::vector<double>(32, none), stairs),
                           b = map_of(0.5, std::vector<double>(32, none), stairs);
    const Image<double> visible = channel(a, b, SkinTransition::linear).visible;
    for (std::size_t i = 0; i < visible.size(); ++i) CHECK(visible.data()[i] == 1.0);
}
