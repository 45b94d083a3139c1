#include <doctest/doctest.h>

#include <cmath>
#include <penumbra/penumbra_wedge/shadow.hpp>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

using V3 = Vec3<double>;

RectLight<double> light() { return {V3(0.0, 0.0, 5.0), V3(0.4, 0.0, 0.0), V3(0.0, -0.3, 0.0)}; }

Mesh<double> quad(const V3& a, const V3& b, const V3& c, const V3& d) { return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}}; }

Variation<double> variation_around(const PenumbraWedgeShadow<double>& shadow, const V3& middle, double half) {
    const V3 middle_ls = shadow.frame().to_light(middle);
    return shadow.variation({middle_ls - V3(half), middle_ls + V3(half)}, 1e9);
}
double in_doubt(const Variation<double>& variation, double half) { return variation.change(V3(2.0 * half)); }

}  // namespace

TEST_CASE("where sheets join, their outline has no edge") {
    test::Random random(3);
    constexpr double half = 0.05;
    for (int n = 0; n < 200; ++n) {
        CAPTURE(n);
        const V3 a(random.in(-0.1, 0.1), -9.0, random.in(-0.5, 0.5)),
            b(random.in(-0.1, 0.1), 9.0, random.in(-0.5, 0.5));
        const V3 left(-9.0, 0.0, random.in(-1.0, 1.0)), right(9.0, 0.0, random.in(-1.0, 1.0));
        const V3 point(random.in(-0.05, 0.05), random.in(-0.2, 0.2), -3.0);
        const bool turned = random.whole(0, 1) == 0;  // the second, so that both run along the joint in one sense
        const Mesh<double> first = quad(a, b, b + left, a + left);
        const Mesh<double> second = turned ? quad(a, b, b + right, a + right) : quad(b, a, a + right, b + right);
        const PenumbraWedgeShadow<double> joined({first, second}, light());
        REQUIRE(joined.visibility(point) < 1e-9);
        const Variation<double> none = variation_around(joined, point, half);
        REQUIRE(none.known);
        CHECK(in_doubt(none, half) < 1e-9);
        CHECK(glm::length(none.slope) < 1e-9);

        const V3 gap(0.02, 0.0, 0.0);
        const PenumbraWedgeShadow<double> apart({first, quad(b + gap, a + gap, a + gap + right, b + gap + right)},
                                                light());
        const Variation<double> some = variation_around(apart, point, half);
        CHECK((!some.known || in_doubt(some, half) > 1e-3));
    }
}

TEST_CASE("what a caster surely hides of others leaves nothing in doubt") {
    test::Random random(4);
    constexpr double half = 0.02;
    for (int n = 0; n < 200; ++n) {
        CAPTURE(n);
        const Mesh<double> plate = test::box_mesh(V3(-1.9, 0.0, 0.0), V3(2.0, 3.0, 0.1));  // up to x = .1
        Mesh<double> solid = test::icosphere<double>(1);
        const V3 at(random.in(-0.75, -0.65), random.in(-0.3, 0.3), random.in(1.0, 3.0));
        const double size = random.in(0.05, 0.15);
        for (V3& p : solid.positions) p = at + p * size;
        const V3 point(random.in(0.0, 0.1), random.in(-0.1, 0.1), -3.0);
        const PenumbraWedgeShadow<double> alone({plate}, light()), both({plate, solid}, light());
        REQUIRE(alone.visibility(point) == doctest::Approx(both.visibility(point)).epsilon(1e-9));
        REQUIRE(alone.visibility(point) > 0.05);
        const Variation<double> expected = variation_around(alone, point, half);
        const Variation<double> found = variation_around(both, point, half);
        REQUIRE(found.known);
        CHECK(in_doubt(found, half) == doctest::Approx(in_doubt(expected, half)).epsilon(1e-6));
        CHECK(glm::length(found.slope - expected.slope) < 1e-9);
    }
}
