#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <string>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/polygon_area.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

const DiskLight<double> unit_disk{{0, 0, 0}, {0, 0, 1}, 1.0};

DiskLight<double> disk(double radius) { return {{0, 0, 0}, {0, 0, 1}, radius}; }

template <class T>
DBuffer<T> buffer(const std::vector<Mesh<T>>& casters, T radius, int resolution, int layers,
                  VolumeSilhouette silhouette = VolumeSilhouette::disk) {
    const LightFrame<T> frame{Vec3<T>(T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0)),
                              Vec3<T>(T(0), T(0), T(1))};
    return DBuffer<T>(casters, frame, radius, resolution, layers, silhouette);
}

std::vector<test::Polygon3> faces(const Mesh<double>& mesh) {
    std::vector<test::Polygon3> result;
    for (const glm::uvec3& t : mesh.triangles)
        result.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
    return result;
}

/// Of a convex solid, what looks away from P.
std::vector<test::Polygon3> away_faces(const Mesh<double>& mesh, const Vec3<double>& p) {
    std::vector<test::Polygon3> result;
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        if (glm::dot(glm::cross(b - a, c - a), p - a) < 0.0) result.push_back({a, b, c});
    }
    return result;
}

/// An L, wound to look at the light, with an inner corner.
Mesh<double> corner(double depth) {
    return {{{-1, -1, depth}, {1, -1, depth}, {1, 0, depth}, {0, 0, depth}, {0, 1, depth}, {-1, 1, depth}},
            {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 5, 4}}};
}

struct Tally {
    int points = 0, lit = 0, dark = 0, wrong_lit = 0, wrong_dark = 0;
    double squares = 0.0;

    void add(double got, double exact) {
        ++points, squares += (got - exact) * (got - exact);
        if (exact >= 1.0 - 1e-12) ++lit, wrong_lit += got != 1.0;
        if (exact <= 1e-12) ++dark, wrong_dark += got != 0.0;
    }
    double rmse() const { return std::sqrt(squares / points); }
};

Tally compare(const DBuffer<double>& d, const Mesh<double>& mesh, double radius, double span, double depth,
              CutVisibility form, CutShare share, bool convex) {
    test::Random random(9);
    Tally tally;
    for (int i = 0; i < 8000; ++i) {
        const Vec3<double> p(random.in(-span, span), random.in(-span, span), depth);
        tally.add(d.visibility(p, form, share),
                  test::exact_visibility(p, disk(radius), convex ? away_faces(mesh, p) : faces(mesh)));
    }
    return tally;
}

}  // namespace

TEST_CASE("a straight edge: exact but for a texel, from the edge and from depths, and better with every texel") {
    for (const double tilt : {0.0, 0.7}) {
        const Mesh<double> half_plane{{{0, -4, 3 - tilt}, {8, -4, 3 - tilt}, {8, 4, 3 + tilt}, {0, 4, 3 + tilt}},
                                      {{0, 1, 2}, {0, 2, 3}}};
        for (const double radius : {0.3, 1.0}) {
            double last_edge = 1.0, last_depths = 1.0;
            for (const int resolution : {128, 256, 512}) {
                const DBuffer<double> d = buffer<double>({half_plane}, radius, resolution, 1);
                const double texel = 6.0 * (d.view().slopes.max.x - d.view().slopes.min.x) / resolution;
                test::Random random(1);
                double worst_edge = 0.0, worst_depths = 0.0;
                Tally edge, depths;
                for (int i = 0; i < 6000; ++i) {
                    const Vec3<double> p(random.in(-2.0, 2.0) * radius, random.in(-0.5, 0.5), 6.0);
                    const double exact = test::exact_visibility(p, disk(radius), faces(half_plane));
                    const double by_edge = d.visibility(p, CutVisibility::exact, CutShare::edge);
                    const double by_depths = d.visibility(p, CutVisibility::exact, CutShare::depths);
                    worst_edge = std::max(worst_edge, std::abs(by_edge - exact));
                    worst_depths = std::max(worst_depths, std::abs(by_depths - exact));
                    edge.add(by_edge, exact), depths.add(by_depths, exact);
                }
                // V changes by 2 / (π r) at most as the edge's line moves over the disk, and it moves as the point does
                const double two_texels = 2.0 * texel * 2.0 / (pi<double> * radius);
                CHECK(worst_edge <= two_texels);
                CHECK(worst_depths <= two_texels + (tilt > 0.0 ? 0.07 : 0.0));
                CHECK(depths.rmse() < last_depths * 0.7);
                CHECK(edge.rmse() <= depths.rmse());
                last_edge = edge.rmse(), last_depths = depths.rmse();
            }
            CHECK(last_edge < 2e-3);
        }
    }
}

TEST_CASE("outside of the penumbra exactly 1, inside of the umbra exactly 0, but for a texel at the border") {
    for (const bool concave : {false, true}) {
        const Mesh<double> mesh =
            concave ? corner(3.0) : test::box_mesh(Vec3<double>(0, 0, 3.5), Vec3<double>(1, 0.8, 0.5));
        for (const double radius : {0.2, 1.5}) {
            const DBuffer<double> d = buffer<double>({mesh}, radius, 1024, 2);
            const double depth = radius < 1.0 ? 6.0 : 4.3;
            const Tally t = compare(d, mesh, radius, 4.0, depth, CutVisibility::exact, CutShare::edge, !concave);
            const std::string name = concave ? "concave" : "convex";
            MESSAGE(name << ", radius " << radius << ": RMSE " << t.rmse() << ", lit " << t.lit << " wrong "
                         << t.wrong_lit << ", dark " << t.dark << " wrong " << t.wrong_dark);
            CHECK(t.rmse() <= (concave ? 0.01 : 0.004));
            CHECK(t.lit > 1000);
            CHECK(t.wrong_lit <= t.lit / 1000 + 2);
            CHECK(t.wrong_dark <= t.dark / 100 + 2);
        }
    }
}

TEST_CASE("under a light wider than the caster a silhouette from its centre fails, this one does not") {
    // a box that the disk sees past on all sides, and a pyramid that it looms over
    const Mesh<double> box = test::box_mesh(Vec3<double>(0, 0, 3.5), Vec3<double>(1, 0.8, 0.5));
    const Mesh<double> pyramid{{{0, 0, 2}, {1, 1, 3}, {-1, 1, 3}, {-1, -1, 3}, {1, -1, 3}},
                               {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}}};
    REQUIRE(is_closed(edge_adjacency(pyramid)));
    for (const bool is_box : {true, false}) {
        const Mesh<double>& mesh = is_box ? box : pyramid;
        const double radius = is_box ? 1.5 : 4.0, depth = is_box ? 4.4 : 3.2;
        int points = 0, wrong[2] = {0, 0};
        double squares[2] = {0.0, 0.0};
        const DBuffer<double> ours = buffer<double>({mesh}, radius, 1024, 2);
        const DBuffer<double> from_center = buffer<double>({mesh}, radius, 1024, 2, VolumeSilhouette::light_center);
        test::Random random(3);
        for (int i = 0; i < 12000; ++i) {
            const Vec3<double> p(random.in(-3.0, 3.0), random.in(-3.0, 3.0), depth);
            const double exact = test::exact_visibility(p, disk(radius), away_faces(mesh, p));
            const auto kind = [](double v) { return v >= 1.0 - 1e-12 ? 2 : v <= 1e-12 ? 0 : 1; };
            ++points;
            for (int k = 0; k < 2; ++k) {
                const double v = (k == 0 ? ours : from_center).visibility(p, CutVisibility::exact, CutShare::edge);
                wrong[k] += kind(v) != kind(exact);
                squares[k] += (v - exact) * (v - exact);
            }
        }
        const std::string name = is_box ? "box" : "pyramid";
        MESSAGE(name << ": lit, dark or between wrongly at " << wrong[0] << " of " << points
                     << " points, from the centre " << wrong[1] << "; RMSE " << std::sqrt(squares[0] / points) << ", "
                     << std::sqrt(squares[1] / points));
        CHECK(wrong[0] <= points / (is_box ? 1000 : 500));  // texels at borders, which the pyramid has more of
        if (is_box) CHECK(wrong[1] > points / 50);
        if (is_box) CHECK(squares[0] * 9.0 < squares[1]);
    }
}

TEST_CASE("distances from the light's centre say the same as depths") {
    const Mesh<double> box = test::box_mesh(Vec3<double>(0.5, 0, 3.5), Vec3<double>(1, 0.8, 0.5));
    const LightFrame<double> frame{Vec3<double>(0.0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const DBuffer<double> depths({box}, frame, 0.5, 1024, 2);
    const DBuffer<double> distances({box}, frame, 0.5, 1024, 2, VolumeSilhouette::disk, DBufferDepth::euclidean);
    for (const CutShare share : {CutShare::edge, CutShare::depths}) {
        test::Random random(11);
        int apart = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3<double> p(random.in(-3.0, 3.0), random.in(-3.0, 3.0), 6.0);
            const double v = depths.visibility(p, CutVisibility::exact, share);
            apart += std::abs(v - distances.visibility(p, CutVisibility::exact, share)) > 0.02;
        }
        CHECK(apart < 10);  // texels at a border
    }
}

TEST_CASE("two layers: a strip that the light sees on both sides") {
    const Mesh<double> strip{{{-0.2, -6, 3}, {0.2, -6, 3}, {0.2, 6, 3}, {-0.2, 6, 3}}, {{0, 2, 1}, {0, 3, 2}}};
    double rmse[2];
    for (int layers = 1; layers <= 2; ++layers) {
        const DBuffer<double> d = buffer<double>({strip}, 1.0, 1024, layers);
        test::Random random(5);
        Tally t;
        for (int i = 0; i < 4000; ++i) {
            const Vec3<double> p(random.in(-2.0, 2.0), random.in(-1.0, 1.0), 6.0);
            t.add(d.visibility(p, CutVisibility::exact, CutShare::edge),
                  test::exact_visibility(p, unit_disk, faces(strip)));
        }
        rmse[layers - 1] = t.rmse();
    }
    MESSAGE("RMSE with one layer " << rmse[0] << ", with two " << rmse[1]);
    CHECK(rmse[0] > 0.05);
    CHECK(rmse[1] < 0.01);
}

TEST_CASE_TEMPLATE("hard shadows without a radius; limits", T, float, double) {
    const Mesh<T> box = test::box_mesh(Vec3<T>(T(0), T(0), T(3)), Vec3<T>(T(1), T(1), T(0.5)));
    const DBuffer<T> d = buffer<T>({box}, T(0), 512, 2);
    const auto at = [&](T x, T y, T z) { return d.visibility(Vec3<T>(x, y, z), CutVisibility::exact, CutShare::edge); };
    CHECK(at(T(0), T(0), T(6)) == T(0));
    CHECK(at(T(2.3), T(0), T(6)) == T(0));
    CHECK(at(T(2.5), T(0), T(6)) == T(1));
    CHECK(at(T(0), T(0), T(2.5)) == T(1));  // on the caster's front
    CHECK(at(T(0), T(0), T(3.5)) == T(0));  // and its back
    CHECK(at(T(0), T(0), T(1)) == T(1));
    CHECK(at(T(0), T(0), T(0)) == T(1));
    CHECK(at(T(0), T(0), T(-5)) == T(1));
    CHECK(at(T(100), T(0), T(6)) == T(1));
    CHECK(DBuffer<T>().visibility(Vec3<T>(T(0), T(0), T(1)), CutVisibility::exact, CutShare::edge) == T(1));
    CHECK(buffer<T>({Mesh<T>{}}, T(1), 16, 1)
              .visibility(Vec3<T>(T(0), T(0), T(1)), CutVisibility::exact, CutShare::edge) == T(1));
    // behind the light, through its plane, touching it, around it: finite and in range
    test::Random random(7);
    for (const T depth : {T(-2), T(0), T(0.3), T(0.5)}) {
        const DBuffer<T> near =
            buffer<T>({test::box_mesh(Vec3<T>(T(0), T(0), depth), Vec3<T>(T(1), T(1), T(0.5)))}, T(0.7), 128, 2);
        for (int i = 0; i < 500; ++i) {
            for (const CutShare share : {CutShare::edge, CutShare::depths}) {
                const T v = near.visibility(random.point(T(-4), T(4)), CutVisibility::exact, share);
                CHECK(v >= T(0));
                CHECK(v <= T(1));
            }
        }
        if (depth == T(-2))
            CHECK(near.visibility(Vec3<T>(T(0), T(0), T(2)), CutVisibility::exact, CutShare::edge) == T(1));
    }
}

TEST_CASE_TEMPLATE("two cuts from edges are those of angles", T, float, double) {
    const HidingEdge<T> left{Vec3<T>(T(-1), T(1), T(2)), Vec3<T>(T(-1), T(-1), T(2)), 0};
    const HidingEdge<T> right{Vec3<T>(T(1), T(-1), T(2)), Vec3<T>(T(1), T(1), T(2)), 0};
    const Vec3<T> p(T(0), T(0), T(4));
    CHECK(std::abs(two_cuts(left, right, p).angle - pi<T>) <= T(1e-6));
    CHECK(two_cuts(left, left, p).angle == T(0));
    // left hides what lies to the right of x = 1 … of its own side: both hide all between them or nothing
    CHECK(two_cuts(left, right, p).convex !=
          two_cuts(HidingEdge<T>{left.b, left.a, 0}, HidingEdge<T>{right.b, right.a, 0}, p).convex);
    CHECK(!two_cuts(left, HidingEdge<T>{right.a, right.b, 1}, p).convex);
    const HidingEdge<T> across{Vec3<T>(T(-1), T(1), T(2)), Vec3<T>(T(1), T(1), T(2)), 0};
    CHECK(std::abs(two_cuts(left, across, p).angle - T(0.5) * pi<T>) <= T(1e-6));
}
