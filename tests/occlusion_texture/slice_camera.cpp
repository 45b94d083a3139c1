#include <doctest/doctest.h>

#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <vector>

#include "../support/random.hpp"

using namespace penumbra;

namespace {

constexpr int margin = 2;

template <class T>
std::vector<Vec3<T>> cloud(std::uint32_t seed, int count, T spread) {
    test::Random random(seed);
    std::vector<Vec3<T>> points;
    for (int i = 0; i < count; ++i)
        points.emplace_back(random.in(-spread, spread), random.in(-spread, spread), random.in(T(1), T(6)));
    return points;
}

template <class T>
Vec2<T> texel(const SliceCamera<T>& camera, const Vec3<T>& p) {
    const RasterVertex<T> v = camera.project(p);
    return Vec2<T>(v.x / v.w, v.y / v.w);
}

}  // namespace

TEST_CASE_TEMPLATE("every fitted vertex lands inside the margin", T, float, double) {
    for (const SliceProjection projection : {SliceProjection::perspective, SliceProjection::orthographic})
        for (const Vec2<T>& light : {Vec2<T>(T(1), T(1)), Vec2<T>(T(2), T(0.5)), Vec2<T>(T(1), T(0)),
                                     Vec2<T>(T(0), T(0)), Vec2<T>(T(50), T(50))})
            for (const int resolution : {1, 7, 64, 500}) {
                const auto points = cloud<T>(3, 300, T(4));
                const auto camera = fit_slice_camera(points, light, projection, resolution, margin);
                CAPTURE(resolution);
                CAPTURE(light.y);
                CHECK(camera.width <= std::max(resolution, 2 * margin + 1));
                CHECK(camera.height <= std::max(resolution, 2 * margin + 1));
                const T slack = T(1e-3);  // texels, of coordinates up to 500 in float
                for (const Vec3<T>& p : points) {
                    const Vec2<T> at = texel(camera, p);
                    CHECK(at.x >= T(margin) - slack);
                    CHECK(at.y >= T(margin) - slack);
                    CHECK(at.x <= static_cast<T>(camera.width - margin) + slack);
                    CHECK(at.y <= static_cast<T>(camera.height - margin) + slack);
                }
            }
}

TEST_CASE_TEMPLATE("the frustum runs through the light's edges and no wider than needed", T, float, double) {
    // one vertex at (4, 0) and depth 6, light of half-size 1: opening (1 + 6 c) must reach 4, so c = 1/2
    const std::vector<Vec3<T>> points{{T(0), T(0), T(1)}, {T(4), T(0), T(6)}};
    const auto camera = fit_slice_camera(points, Vec2<T>(T(1), T(1)), SliceProjection::perspective, 256, margin);
    CHECK(camera.convergence == doctest::Approx(0.5).epsilon(1e-6));
    // a scene narrower than the light needs no perspective
    const std::vector<Vec3<T>> narrow{{T(0.5), T(0), T(1)}, {T(-0.5), T(0), T(6)}};
    CHECK(fit_slice_camera(narrow, Vec2<T>(T(1), T(1)), SliceProjection::perspective, 256, margin).convergence == T(0));
    // a point light would need an infinite one: limited to 16 over the depth
    CHECK(fit_slice_camera(points, Vec2<T>(T(0), T(0)), SliceProjection::perspective, 256, margin).convergence ==
          doctest::Approx(16.0 / 6.0).epsilon(1e-6));
    CHECK(fit_slice_camera(points, Vec2<T>(T(1), T(1)), SliceProjection::orthographic, 256, margin).convergence ==
          T(0));
}

TEST_CASE_TEMPLATE("the footprint is the kernel seen by the camera", T, float, double) {
    const auto points = cloud<T>(4, 100, T(4));
    const Vec2<T> half(T(1.5), T(1));
    const Rect2<T> light{-half, half};
    test::Random random(5);
    for (const SliceProjection projection : {SliceProjection::perspective, SliceProjection::orthographic}) {
        const auto camera = fit_slice_camera(points, half, projection, 256, margin);
        for (int i = 0; i < 10000; ++i) {
            const Vec3<T> p(random.in(T(-6), T(6)), random.in(T(-6), T(6)), random.in(T(1), T(12)));
            const T z = p.z * random.in(T(0), T(1));
            const Rect2<T> kernel = kernel_rect(z, p, light), box = camera.footprint(z, p, light);
            const Vec2<T> min = texel(camera, Vec3<T>(kernel.min, z)), max = texel(camera, Vec3<T>(kernel.max, z));
            const double tolerance = 512 * 8 * static_cast<double>(std::numeric_limits<T>::epsilon());
            CHECK(std::abs(static_cast<double>(box.min.x - min.x)) <= tolerance);
            CHECK(std::abs(static_cast<double>(box.min.y - min.y)) <= tolerance);
            CHECK(std::abs(static_cast<double>(box.max.x - max.x)) <= tolerance);
            CHECK(std::abs(static_cast<double>(box.max.y - max.y)) <= tolerance);
        }
    }
}

TEST_CASE("the footprint in normalised coordinates is the one derived for the paper's camera") {
    // centre d P z / (S p (z + d)), half-size d (p − z) / (p (z + d)); equality |centre| + half = 1 on the frustum's
    // side
    const double S = 1.25, d = 2.0;
    SliceCamera<double> camera;
    camera.convergence = 1.0 / d;
    camera.scale_tx = {1.0 / S, 1.0 / S};  // normalised: the frustum's sides at ±1
    const Rect2<double> light{{-S, -S}, {S, S}};
    test::Random random(6);
    for (int i = 0; i < 10000; ++i) {
        const double p = random.in(0.5, 20.0), z = p * random.in(0.0, 1.0), side = S * (1.0 + p / d);
        const double x = side * random.in(-1.0, 1.0);
        const Rect2<double> box = camera.footprint(z, {x, side, p}, light);
        const double half = d * (p - z) / (p * (z + d));
        CHECK((box.min.x + box.max.x) / 2 == doctest::Approx(d * x * z / (S * p * (z + d))));
        CHECK((box.max.x - box.min.x) / 2 == doctest::Approx(half));
        CHECK(box.max.y == doctest::Approx(1.0));  // on the border: no slack at all
        CHECK(box.max.x <= 1.0 + 1e-12);
        CHECK(box.min.x >= -1.0 - 1e-12);
    }
}

TEST_CASE("kernels of rectangular lights are square in texels, up to 8 : 1") {
    const auto points = cloud<double>(7, 100, 4.0);
    for (const double ratio : {1.0, 0.5, 0.2, 0.125, 5.0}) {
        const Vec2<double> half(1.0, ratio);
        const auto camera = fit_slice_camera(points, half, SliceProjection::perspective, 512, margin);
        const Rect2<double> box = camera.footprint(2.0, {0.3, 0.2, 8.0}, {-half, half});
        CAPTURE(ratio);
        CHECK((box.max.x - box.min.x) == doctest::Approx(box.max.y - box.min.y));
    }
}

TEST_CASE_TEMPLATE("scaling the scene by a power of two changes no texel position", T, float, double) {
    const auto points = cloud<T>(8, 100, T(4));
    auto scaled = points;
    for (Vec3<T>& p : scaled) p *= T(1024);
    const auto a = fit_slice_camera(points, Vec2<T>(T(1), T(1)), SliceProjection::perspective, 256, margin);
    const auto b = fit_slice_camera(scaled, Vec2<T>(T(1024), T(1024)), SliceProjection::perspective, 256, margin);
    CHECK(a.width == b.width);
    CHECK(a.height == b.height);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(texel(a, points[i]) == texel(b, scaled[i]));
}

TEST_CASE_TEMPLATE("a camera without vertices or for a single one is small but usable", T, float, double) {
    const auto none = fit_slice_camera<T>({}, Vec2<T>(T(1), T(1)), SliceProjection::perspective, 256, margin);
    CHECK(none.width == 1);
    CHECK(none.height == 1);
    const auto one = fit_slice_camera<T>({Vec3<T>(T(3), T(4), T(0))}, Vec2<T>(T(1), T(1)), SliceProjection::perspective,
                                         256, margin);
    CHECK(one.width == 2 * margin + 1);
    CHECK(is_finite(texel(one, Vec3<T>(T(3), T(4), T(0)))));
}
