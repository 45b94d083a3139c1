#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <penumbra/penumbra_wedge/edge_sweep.hpp>
#include <penumbra/penumbra_wedge/hidden_edges.hpp>
#include <vector>

#include "support/random.hpp"

using namespace penumbra;

namespace {

using V2 = Vec2<double>;
using V3 = Vec3<double>;

V2 landed(const V3& vertex, const V3& point) {
    const V3 q = point + (vertex - point) * (point.z / (point.z - vertex.z));
    return V2(q.x, q.y);
}
/// Of the quadrilateral between an edge as two points see it.
double swept(const V3& a, const V3& b, const V3& before, const V3& after) {
    const V2 corners[] = {landed(a, before), landed(a, after), landed(b, after), landed(b, before)};
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const V2 p = corners[k], q = corners[(k + 1) % 4];
        sum += p.x * q.y - p.y * q.x;
    }
    return sum * 0.5;
}

PointTile<double> tile_around(const V3& middle, const V3& half) {
    PointTile<double> tile;
    tile.cover({middle - half, middle + half}, V2(3.0, 3.0));
    return tile;
}

}  // namespace

TEST_CASE("an edge sweeps what its slope says: exactly across the axis, at first in depth") {
    test::Random random(5);
    for (int n = 0; n < 2000; ++n) {
        CAPTURE(n);
        const V3 point(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(4.0, 6.0));
        const V3 a = random.point(-1.0, 1.0) + V3(0.0, 0.0, 2.0), b = random.point(-1.0, 1.0) + V3(0.0, 0.0, 2.0);
        const PointTile<double> tile = tile_around(point, V3(0.01));
        const V3 slope = detail::LightView<double>(tile, false).sweep(a, b).slope;
        const V3 across(random.in(-1.0, 1.0), random.in(-1.0, 1.0), 0.0);
        CHECK(std::abs(swept(a, b, point, point + across) - glm::dot(slope, across)) < 1e-12);
        const V3 step = random.point(-1e-4, 1e-4);
        CHECK(std::abs(swept(a, b, point, point + step) - glm::dot(slope, step)) < 1e-7);
    }
}

TEST_CASE("nowhere in a box does the slope differ by more than its range") {
    test::Random random(6);
    double closest = 0.0;
    for (int n = 0; n < 2000; ++n) {
        CAPTURE(n);
        const V3 middle(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(4.0, 6.0));
        const V3 half = random.point(0.0, 1.0) * std::exp(random.in(-6.0, -1.5));
        const V3 a = random.point(-1.0, 1.0) + V3(0.0, 0.0, 1.2), b = random.point(-1.0, 1.0) + V3(0.0, 0.0, 1.2);
        const PointTile<double> tile = tile_around(middle, half);
        const detail::LightView<double> view(tile, false);
        const V3 slope = view.sweep(a, b).slope;
        const detail::SlopeRange<double> range = view.slope_range(a, b);
        for (int k = 0; k < 16; ++k) {
            V3 share = random.point(-1.0, 1.0);
            for (int axis = 0; axis < 3 && k < 8; ++axis) share[axis] = (k >> axis & 1) != 0 ? 1.0 : -1.0;
            const PointTile<double> there = tile_around(middle + half * share, V3(1e-9));
            const V3 off = detail::LightView<double>(there, false).sweep(a, b).slope - slope;
            const double across = std::sqrt(off.x * off.x + off.y * off.y);
            CHECK(across <= range.across + 1e-12);
            CHECK(std::abs(off.z) <= range.deep + 1e-12);
            closest = std::max(closest, across / (range.across + 1e-12));
        }
    }
    MESSAGE(closest);
    CHECK(closest > 0.5);
}

TEST_CASE("parts of an edge measure as much together as they cover") {
    test::Random random(7);
    for (int n = 0; n < 500; ++n) {
        CAPTURE(n);
        detail::EdgeCover<double, 8> cover;
        std::vector<detail::EdgePart<double>> parts;
        for (int k = random.whole(0, 8); k > 0; --k) {
            parts.push_back({random.in(0.0, 1.0), random.in(0.0, 1.0)});
            cover.add(parts.back());
        }
        const detail::EdgePart<double> within = {random.in(0.0, 0.5), random.in(0.3, 1.0)};
        constexpr int steps = 4000;
        double expected = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double at = (i + 0.5) / steps;
            const bool is_in = std::any_of(parts.begin(), parts.end(),
                                           [&](const auto& part) { return part.first < at && at < part.last; });
            expected += is_in && within.first < at && at < within.last ? at / steps : 0.0;
        }
        const double total = cover.sum(within, [](const detail::EdgePart<double>& part) {
            return (part.last * part.last - part.first * part.first) * 0.5;
        });
        CHECK(total == doctest::Approx(expected).epsilon(5e-3));
    }
}
