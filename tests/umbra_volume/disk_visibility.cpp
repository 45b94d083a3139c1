#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <penumbra/umbra_volume/disk_visibility.hpp>
#include <vector>

#include "../support/polygon_area.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

/// Set PENUMBRA_LONG_TESTS to go through every float instead of one in some hundred.
bool is_long() { return std::getenv("PENUMBRA_LONG_TESTS") != nullptr; }

/// How far V may fall from one float to the next: one ULP; two where -ffast-math changes the order of products.
float allowed_after(float v) {
#if defined(__FAST_MATH__)
    v = std::nextafter(v, -1.0F);
#endif
    return std::nextafter(v, -1.0F);
}

const double turn = std::acos(-1.0);

/// V(t) = (a − sin a) / 2π of the arc a, whose cancellation a series avoids.
double exact_below_half(double t) {
    const double a = 4.0 * std::asin(std::sqrt(t));
    if (a > 1.0) return (a - std::sin(a)) / (2.0 * turn);
    double term = a * a * a / 6.0, sum = 0.0;
    for (int k = 4; std::abs(term) > 1e-18 * sum && k < 40; k += 2) {
        sum += term;
        term *= -a * a / (k * (k + 1));
    }
    return sum / (2.0 * turn);
}
double exact_visibility(double t) { return t > 0.5 ? 1.0 - exact_below_half(1.0 - t) : exact_below_half(t); }

/// The unit disk on the far side of two lines, by cutting a square and integrating around its rim.
double exact_visibility(double t1, double t2, double angle) {
    const glm::dvec2 n1(1.0, 0.0), n2(std::cos(angle), std::sin(angle));
    test::Polygon2 rest{{-3.0, -3.0}, {3.0, -3.0}, {3.0, 3.0}, {-3.0, 3.0}};
    rest = test::cut(rest, [&](const glm::dvec2& p) { return glm::dot(p, n1) - (1.0 - 2.0 * t1); });
    rest = test::cut(rest, [&](const glm::dvec2& p) { return glm::dot(p, n2) - (1.0 - 2.0 * t2); });
    return rest.size() < 3 ? 0.0 : test::area_in_circle(rest, 1.0) / turn;
}

/// The same by quadrature: chords across the first line, each cut by the second. Trapezia in an angle: error 1e-7.
double quadrature(double t1, double t2, double angle) {
    const int steps = 20000;
    const double first = std::asin(1.0 - 2.0 * t1), last = 0.5 * turn, c = std::cos(angle), s = std::sin(angle);
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double a = first + (last - first) * (k + 0.5) / steps, x = std::sin(a), h = std::cos(a);
        const double cut = 1.0 - 2.0 * t2 - c * x;  // s y ≥ cut
        const double low = s > 1e-12 ? std::min(std::max(cut / s, -h), h) : cut <= 0.0 ? -h : h;
        sum += (h - low) * h;
    }
    return sum * (last - first) / steps / turn;
}

/// Shares of the diameter that are hard, and their neighbours.
template <class T>
std::vector<T> hard_shares() {
    std::vector<T> result{T(0.1), T(0.25), T(0.7), T(0.9), T(1e-3), T(1e-6)};
    for (const T t : {T(0), T(0.5), T(1)})
        for (const T towards : {T(-1), T(2)}) {
            result.push_back(t);
            T next = t;
            for (int k = 0; k < 2; ++k) {
                next = std::nextafter(next, towards);
                if (next >= std::numeric_limits<T>::min() && next <= T(1)) result.push_back(next);
            }
        }
    return result;
}

template <class T>
std::vector<T> hard_angles() {
    std::vector<T> result{T(0), T(0.5) * pi<T>, pi<T>, T(1), T(2)};
    for (T d = T(0.1); d > T(1e-9); d *= T(0.1)) {
        result.push_back(d);
        result.push_back(pi<T> - d);
        result.push_back(T(0.5) * pi<T> + d);
        result.push_back(T(0.5) * pi<T> - d);
    }
    return result;
}

template <class T>
constexpr double two_cuts_allowed = sizeof(T) == 4 ? 4e-7 : 2e-15;

}  // namespace

TEST_CASE("V(t) of every float is exact to 1.5e-7, relative 4e-7, and never falls by more than one ULP") {
    std::uint32_t one = 0;
    const float highest = 1.0F;
    std::memcpy(&one, &highest, sizeof one);
    const std::uint32_t step = is_long() ? 1 : 331;
    double worst = 0, worst_relative = 0;
    float before = 0, at = 0, at_relative = 0, most_fall = 0;
    std::uint32_t falls = 0;
    for (std::uint32_t bits = 0; bits <= one; bits += step) {
        float t = 0;
        std::memcpy(&t, &bits, sizeof t);
        const float v = disk_visibility(t);
        const double truth = exact_visibility(static_cast<double>(t));
        const double error = std::abs(static_cast<double>(v) - truth);
        if (error > worst) worst = error, at = t;
        if (truth >= static_cast<double>(std::numeric_limits<float>::min()) && error > worst_relative * truth)
            worst_relative = error / truth, at_relative = t;
        if (v < before && v < allowed_after(before)) ++falls, most_fall = std::max(most_fall, before - v);
        before = std::max(before, v);
    }
    INFO("absolute " << worst << " at " << at << ", relative " << worst_relative << " at " << at_relative);
    INFO(falls << " falls, the most " << most_fall);
    CHECK(worst <= 1.5e-7);
    CHECK(worst_relative <= 4e-7);
    CHECK(falls == 0);
}

TEST_CASE("V(t) never falls by more than one ULP between neighbours") {
    test::Random random(1);
    for (int n = 0; n < 2000; ++n) {
        float t = n % 3 == 0 ? 0.5F - 1e-5F * random.in(0.0F, 1.0F) : random.in(0.0F, 1.0F);
        float most = disk_visibility(t);
        for (int k = 0; k < 300; ++k) {
            t = std::nextafter(t, 2.0F);
            const float v = disk_visibility(t);
            REQUIRE_MESSAGE(v >= allowed_after(most), t);
            most = std::max(most, v);
        }
    }
}

TEST_CASE("V(t) in double is exact to rounding") {
    test::Random random(2);
    double worst = 0, worst_relative = 0;
    for (int n = 0; n < 200000; ++n) {
        double t = random.in(0.0, 1.0) + random.in(0.0, 1.0 / 16777216.0);
        if (n % 2 == 0) t = std::ldexp(t, -random.whole(0, 300));
        const double error = std::abs(disk_visibility(t) - exact_visibility(t));
        worst = std::max(worst, error);
        worst_relative = std::max(worst_relative, error / exact_visibility(t));
    }
    INFO("absolute " << worst << ", relative " << worst_relative);
    CHECK(worst <= 1e-15);
    CHECK(worst_relative <= 4e-15);
}

TEST_CASE_TEMPLATE("none, half and all of a disk are exact, and shares are limited", T, float, double) {
    for (const auto& f : {&disk_visibility<T>, &disk_visibility_cubic<T>}) {
        CHECK(f(T(0)) == T(0));
        CHECK(f(T(0.5)) == T(0.5));
        CHECK(f(T(1)) == T(1));
        CHECK(f(T(-3)) == T(0));
        CHECK(f(T(7)) == T(1));
        CHECK(f(std::numeric_limits<T>::max()) == T(1));
        CHECK(f(-std::numeric_limits<T>::max()) == T(0));
    }
    CHECK(disk_visibility_sqrt(T(-1)) == T(0));
    CHECK(disk_visibility_sqrt(T(0.25)) == T(0.5));
    CHECK(disk_visibility_sqrt(T(2)) == T(1));
}

TEST_CASE_TEMPLATE("the cubic is off by 0.039 and the square root by 0.306", T, float, double) {
    double cubic = 0, root = 0;
    for (int k = 0; k <= 10000; ++k) {
        const T t = T(k) / T(10000);
        const double truth = exact_visibility(static_cast<double>(t));
        cubic = std::max(cubic, std::abs(static_cast<double>(disk_visibility_cubic(t)) - truth));
        root = std::max(root, std::abs(static_cast<double>(disk_visibility_sqrt(t)) - truth));
    }
    CHECK(cubic == doctest::Approx(0.039).epsilon(0.02));
    CHECK(root == doctest::Approx(0.306).epsilon(0.002));
}

TEST_CASE_TEMPLATE("two cuts leave the area of the disk beyond both", T, float, double) {
    test::Random random(3);
    const int count = is_long() ? 4000000 : 300000;
    double worst = 0;
    T at[3] = {};
    for (int n = 0; n < count; ++n) {
        T t1 = random.in(T(0), T(1)), t2 = random.in(T(0), T(1)), angle = random.in(T(0), pi<T>);
        const T small = std::ldexp(random.in(T(-1), T(1)), -random.whole(0, 22));
        if (n % 8 == 1) angle = std::abs(small);                                     // almost parallel
        if (n % 8 == 2) angle = pi<T> - std::abs(small);                             // almost opposite
        if (n % 8 == 3) t2 = clamp(t1 + small, T(0), T(1)), angle *= small * small;  // almost coincident
        if (n % 8 == 4) t2 = clamp(T(1) - t1 + small, T(0), T(1)), angle = pi<T> - angle * small * small;
        if (n % 8 == 5) t1 = std::abs(small);
        const double truth =
            exact_visibility(static_cast<double>(t1), static_cast<double>(t2), static_cast<double>(angle));
        const double error = std::abs(static_cast<double>(disk_visibility(t1, t2, angle)) - truth);
        if (error > worst) worst = error, at[0] = t1, at[1] = t2, at[2] = angle;
    }
    INFO("worst " << worst << " at " << at[0] << " " << at[1] << " " << at[2]);
    CHECK(worst <= two_cuts_allowed<T>);
}

TEST_CASE_TEMPLATE("two cuts agree with quadrature, and the truth of the other tests does", T, float, double) {
    test::Random random(4);
    double worst = 0;
    for (int n = 0; n < 200; ++n) {
        const double t1 = random.in(0.0, 1.0), t2 = random.in(0.0, 1.0), angle = random.in(0.0, turn);
        const double truth = quadrature(t1, t2, angle);
        CHECK(exact_visibility(t1, t2, angle) == doctest::Approx(truth).epsilon(1e-6));
        worst = std::max(worst, std::abs(static_cast<double>(disk_visibility(T(t1), T(t2), T(angle))) - truth));
    }
    CHECK(worst <= 1e-6);  // of which the quadrature's own 2e-7
}

TEST_CASE_TEMPLATE("two cuts at hard shares and angles: parallel, opposite, coincident, at the rim", T, float, double) {
    double worst = 0;
    T at[3] = {};
    for (const T t1 : hard_shares<T>())
        for (const T t2 : hard_shares<T>())
            for (const T angle : hard_angles<T>()) {
                const double truth =
                    exact_visibility(static_cast<double>(t1), static_cast<double>(t2), static_cast<double>(angle));
                const T v = disk_visibility(t1, t2, angle);
                const double error = std::abs(static_cast<double>(v) - truth);
                if (error > worst) worst = error, at[0] = t1, at[1] = t2, at[2] = angle;
                const T v1 = disk_visibility(t1), v2 = disk_visibility(t2),
                        past = disk_visibility_between(t1, t2, angle);
                REQUIRE((v >= T(0) && v <= std::min(v1, v2)));
                REQUIRE((past >= std::max(v1, v2) - std::numeric_limits<T>::epsilon() && past <= T(1)));
                REQUIRE(std::abs(static_cast<double>(v1 + v2 - v - past)) <= 2.0 * two_cuts_allowed<T>);
                if (t1 == T(0) || t2 == T(0)) REQUIRE(v == T(0));
                if (t1 == T(1)) REQUIRE(v == v2);
                if (t2 == T(1)) REQUIRE(v == v1);
                if (t1 == T(1) || t2 == T(1)) REQUIRE(past == T(1));
            }
    INFO("worst " << worst << " at " << at[0] << " " << at[1] << " " << at[2]);
    CHECK(worst <= two_cuts_allowed<T>);
}

TEST_CASE_TEMPLATE("angles are limited to [0, π]", T, float, double) {
    CHECK(disk_visibility(T(0.3), T(0.6), T(-1)) == disk_visibility(T(0.3), T(0.6), T(0)));
    CHECK(disk_visibility(T(0.7), T(0.6), T(9)) == disk_visibility(T(0.7), T(0.6), pi<T>));
}
