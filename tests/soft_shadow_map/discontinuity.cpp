#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/soft_shadow_map/discontinuity.hpp>
#include <vector>

using namespace penumbra;

namespace {

template <class T>
constexpr T none = std::numeric_limits<T>::max();

/// is_step between texels 2 and 3 of six.
template <class T>
bool step_of(const std::vector<double>& d, double threshold = 0.01) {
    const auto v = [&](std::size_t i) { return d[i] < 1e30 ? static_cast<T>(d[i]) : none<T>; };
    return is_step(Vec3<T>(v(2), v(1), v(0)), Vec3<T>(v(3), v(4), v(5)), static_cast<T>(threshold), none<T>);
}

/// Depths of a plane that rises by tan(angle) across the image of a map with texels of slope 0.01.
std::vector<double> plane(double degrees, double first) {
    std::vector<double> depths;
    const double rise = std::tan(degrees * std::acos(-1.0) / 180.0);
    for (int i = 0; i < 6; ++i) depths.push_back(5.0 / (1.0 - rise * (first + 0.01 * i)));  // z = 5 + rise x
    return depths;
}

template <class T>
glm::mat<3, 3, T, glm::defaultp> columns(T a, T b, T c) {
    return glm::mat<3, 3, T, glm::defaultp>(Vec3<T>(a, a, a), Vec3<T>(b, b, b), Vec3<T>(c, c, c));
}

}  // namespace

TEST_CASE_TEMPLATE("steps are found", T, float, double) {
    CHECK(step_of<T>({2, 2, 2, 5, 5, 5}));
    CHECK(step_of<T>({5, 5, 5, 2, 2, 2}));
    CHECK(step_of<T>({2, 2, 2, 2.02, 2.02, 2.02}));
    CHECK(!step_of<T>({2, 2, 2, 2.005, 2.005, 2.005}));  // below the threshold
    CHECK(!step_of<T>({2, 2, 2, 2.02, 2.02, 2.02}, 0.5));
    CHECK(step_of<T>({2, 2, 2, 1e38, 1e38, 1e38}));  // against nothing
    CHECK(step_of<T>({1e38, 1e38, 1e38, 2, 2, 2}));
    CHECK(!step_of<T>({1e38, 1e38, 1e38, 1e38, 1e38, 1e38}));
}

TEST_CASE_TEMPLATE("surfaces of one and two texels have steps around them", T, float, double) {
    CHECK(step_of<T>({5, 5, 2, 5, 5, 5}));
    CHECK(step_of<T>({5, 5, 5, 2, 5, 5}));
    CHECK(step_of<T>({5, 2, 2, 5, 5, 5}));
    CHECK(step_of<T>({5, 5, 5, 2, 2, 5}));
    CHECK(step_of<T>({1e38, 1e38, 2, 5, 5, 1e38}));
    // stairs of one texel each
    CHECK(step_of<T>({2, 2, 2, 3, 4, 4}));
    CHECK(step_of<T>({2, 2, 3, 4, 4, 4}));
}

TEST_CASE_TEMPLATE("steep surfaces are one surface, up to 80° and to where perspective makes them steeper", T, float,
                   double) {
    for (double degrees = -80.0; degrees <= 80.0; degrees += 5.0)
        for (double first = -0.6; first < 0.6; first += 0.0137) {
            const std::vector<double> depths = plane(degrees, first);
            if (*std::min_element(depths.begin(), depths.end()) < 0.05) continue;  // behind the light's plane
            CAPTURE(degrees);
            CAPTURE(first);
            CHECK(!step_of<T>(depths, 0.005));
            // with a step on it that is larger than what it rises by
            std::vector<double> cut = depths;
            const double change = std::abs(depths[5] - depths[4]) + std::abs(depths[1] - depths[0]);
            for (int i = 3; i < 6; ++i) cut[static_cast<std::size_t>(i)] += 2.0 * change + 0.1;
            CHECK(step_of<T>(cut, 0.005));
        }
    // a crease from steep to level, wherever it is in the texel
    for (double share = 0.0; share < 1.0; share += 0.125) {
        const double change = 0.2 * share;
        CHECK(!step_of<T>({2.0, 2.2, 2.4, 2.4 + change, 2.4 + change, 2.4 + change}));
        CHECK(!step_of<T>({2.0, 2.0, 2.0, 2.0 - change, 1.8 - change, 1.6 - change}));
    }
}

TEST_CASE_TEMPLATE("the Laplacian: its kernel, steps, and planes", T, float, double) {
    CHECK(laplacian_of_gaussian(columns<T>(3, 3, 3)) == T(0));
    CHECK(laplacian_of_gaussian(columns<T>(1, 2, 3)) == T(0));
    CHECK(laplacian_of_gaussian(columns<T>(2, 2, 6)) == T(1));   // near side of a step by 4
    CHECK(laplacian_of_gaussian(columns<T>(2, 6, 6)) == T(-1));  // far side
    glm::mat<3, 3, T, glm::defaultp> spike(T(0));
    spike[1][1] = T(1);
    CHECK(laplacian_of_gaussian(spike) == T(-0.75));
    spike[1][1] = T(0), spike[0][1] = T(1);
    CHECK(laplacian_of_gaussian(spike) == T(0.125));
    spike[0][1] = T(0), spike[2][2] = T(1);
    CHECK(laplacian_of_gaussian(spike) == T(0.0625));
    // steps where it changes sign, by half the step
    CHECK(is_laplacian_step(T(1), T(-1), T(4)));
    CHECK(is_laplacian_step(T(-1), T(1), T(4)));
    CHECK(!is_laplacian_step(T(1), T(-1), T(4.5)));
    CHECK(!is_laplacian_step(T(2), T(1), T(0.1)));
    CHECK(!is_laplacian_step(T(0), T(0), T(0)));
}
