#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <penumbra/umbra_volume/shadow.hpp>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/error_of.hpp"
#include "../support/polygon_area.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

UmbraVolumeOptions by_d_buffer(int resolution = 256) {
    UmbraVolumeOptions options;
    options.mode = DiskMode::d_buffer;
    options.resolution = resolution;
    return options;
}

const std::vector<UmbraVolumeOptions>& both_modes() {
    static const std::vector<UmbraVolumeOptions> modes{UmbraVolumeOptions{}, by_d_buffer()};
    return modes;
}

}  // namespace

TEST_CASE("a box under a turned light, by both modes, against its exact area") {
    const Mesh<float> box = test::box_mesh(Vec3<float>(0, 2, 0), Vec3<float>(0.8F, 0.3F, 0.6F));
    const DiskLight<float> light{Vec3<float>(0.5F, 5, 0.3F), Vec3<float>(-0.1F, -2, 0.05F), 0.6F};
    const DiskLight<double> exact{Vec3<double>(light.center), Vec3<double>(light.normal),
                                  static_cast<double>(light.radius)};
    for (const UmbraVolumeOptions& options : {UmbraVolumeOptions{}, by_d_buffer(1024)}) {
        const UmbraVolumeShadow<float> shadow({box}, light, options);
        test::Random random(1);
        double squares = 0.0;
        int partly = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3<float> p(random.in(-2.5F, 2.5F), 0.0F, random.in(-2.5F, 2.5F));
            std::vector<test::Polygon3> away;
            for (const glm::uvec3& t : box.triangles) {
                const Vec3<double> a(box.positions[t.x]), b(box.positions[t.y]), c(box.positions[t.z]);
                if (glm::dot(glm::cross(b - a, c - a), Vec3<double>(p) - a) < 0.0) away.push_back({a, b, c});
            }
            const double v = test::exact_visibility(Vec3<double>(p), exact, away);
            partly += v > 0.01 && v < 0.99;
            squares += std::pow(static_cast<double>(shadow.visibility(p)) - v, 2);
        }
        CHECK(partly > 300);
        CHECK(std::sqrt(squares / 3000) <= (options.mode == DiskMode::edge_sum ? 1e-5 : 0.02));
    }
}

TEST_CASE_TEMPLATE("limits: no casters, behind the light, not finite, no radius, around the light", T, float, double) {
    const DiskLight<T> light{Vec3<T>(T(0), T(5), T(0)), Vec3<T>(T(0), T(-1), T(0)), T(0.5)};
    const Mesh<T> box = test::box_mesh(Vec3<T>(T(0), T(2), T(0)), Vec3<T>(T(1), T(0.2), T(1)));
    const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    for (UmbraVolumeOptions options : both_modes()) {
        CHECK(UmbraVolumeShadow<T>({}, light, options).visibility(Vec3<T>(T(0))) == T(1));
        CHECK(UmbraVolumeShadow<T>({Mesh<T>{}}, light, options).visibility(Vec3<T>(T(0))) == T(1));
        const UmbraVolumeShadow<T> shadow({box}, light, options);
        CHECK(shadow.visibility(Vec3<T>(T(0))) == T(0));
        CHECK(shadow.visibility(Vec3<T>(T(0), T(5), T(1))) == T(1));
        CHECK(shadow.visibility(Vec3<T>(T(0), T(9), T(0))) == T(1));
        CHECK(shadow.visibility(Vec3<T>(nan, T(0), T(0))) == T(1));
        CHECK(shadow.visibility(Vec3<T>(T(0), -infinity, T(0))) == T(1));
        CHECK(shadow.visibility(Vec3<T>(T(0), T(2.2), T(0))) == T(1));  // on the caster's lit side
        CHECK(shadow.visibility(Vec3<T>(T(0), T(1.8), T(0))) == T(0));  // and on the other
        CHECK(shadow.bytes() > 0);
        const UmbraVolumeShadow<T> hard({box}, {light.center, light.normal, T(0)}, options);
        CHECK(hard.visibility(Vec3<T>(T(1.5), T(0), T(0.1))) == T(0));
        CHECK(hard.visibility(Vec3<T>(T(2), T(0), T(0.1))) == T(1));
        // a room around light and point: nothing stands between them
        const Mesh<T> room = test::box_mesh(Vec3<T>(T(0)), Vec3<T>(T(9), T(9), T(9)));
        CHECK(UmbraVolumeShadow<T>({room}, light, options).visibility(Vec3<T>(T(1), T(0), T(2))) == T(1));
        // a solid around the light: everything outside is dark
        const Mesh<T> shade = test::box_mesh(light.center, Vec3<T>(T(1), T(1), T(1)));
        CHECK(UmbraVolumeShadow<T>({shade}, light, options).visibility(Vec3<T>(T(0.5), T(0), T(0.3))) == T(0));
    }
}

TEST_CASE_TEMPLATE("many points are answered as one by one, and any scene in range", T, float, double) {
    test::Random random(2);
    for (const UmbraVolumeOptions& options : both_modes()) {
        for (int scene = 0; scene < 12; ++scene) {
            const T unit = scene % 3 == 2 ? T(1e3) : T(1);  // gaps of a thousandth of the depth
            const std::vector<Mesh<T>> casters{
                test::placed(test::torus_mesh<T>(12, 6), random, unit, random.point(T(-1), T(1)) * unit),
                test::placed(test::soup<T>(random, 9, 12), random, unit, random.point(T(-1), T(1)) * unit)};
            // through the casters, above them, at them
            const DiskLight<T> light{Vec3<T>(T(0), static_cast<T>(scene % 4), T(0)) * unit,
                                     Vec3<T>(T(0), T(-1), scene % 2 == 0 ? T(0) : T(0.3)), unit * T(0.7)};
            const UmbraVolumeShadow<T> shadow(casters, light, options);
            std::vector<Vec3<T>> points;
            for (int i = 0; i < 200; ++i) points.push_back(random.point(T(-3), T(3)) * unit);
            for (const Vec3<T>& p : casters[0].positions) points.push_back(p);
            std::vector<T> all(points.size());
            shadow.visibility(points.data(), points.size(), all.data());
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK(all[i] >= T(0));
                CHECK(all[i] <= T(1));
                CHECK(std::abs(all[i] - shadow.visibility(points[i])) <= T(2e-3));  // a cell of a mask at most
            }
        }
    }
}

TEST_CASE("options reach the D-buffer") {
    const Mesh<float> box = test::box_mesh(Vec3<float>(0, 2, 0), Vec3<float>(1, 0.3F, 1));
    UmbraVolumeOptions options = by_d_buffer(64);
    options.layers = 1;
    options.depth = DBufferDepth::euclidean;
    const UmbraVolumeShadow<float> shadow({box}, {Vec3<float>(0, 5, 0), Vec3<float>(0, -1, 0), 0.5F}, options);
    CHECK(shadow.d_buffer().view().resolution == 64);
    CHECK(shadow.d_buffer().view().depth == DBufferDepth::euclidean);
    CHECK(shadow.d_buffer().layers() == 1);
    CHECK(shadow.d_buffer().radius() == 0.5F);
}

TEST_CASE("bad arguments are named") {
    const Mesh<float> box = test::box_mesh(Vec3<float>(0, 2, 0), Vec3<float>(1, 1, 1));
    const DiskLight<float> light{Vec3<float>(0, 5, 0), Vec3<float>(0, -1, 0), 0.5F};
    const auto with = [&](auto change) {
        UmbraVolumeOptions options;
        change(options);
        return test::error_of([&] { UmbraVolumeShadow<float>({box}, light, options); });
    };
    CHECK(with([](auto& o) { o.bitmask_size = 7; }) == "penumbra: options.bitmask_size = 7 is not 8, 16 or 32");
    CHECK(with([](auto& o) { o.resolution = 0; }) == "penumbra: options.resolution = 0 is not from 1 to 16384");
    CHECK(with([](auto& o) { o.layers = 3; }) == "penumbra: options.layers = 3 is not 1 or 2");
    CHECK(test::error_of([&] {
              UmbraVolumeShadow<float>({box}, {light.center, light.normal, -1.0F});
          }) == "penumbra: light.radius = -1 is not a finite number ≥ 0");
}
