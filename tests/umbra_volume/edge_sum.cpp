#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <penumbra/umbra_volume/edge_sum.hpp>
#include <string>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/polygon_area.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int scenes = 12;
#else
constexpr int scenes = 60;
#endif

constexpr DiskOverlap rules[] = {DiskOverlap::additive, DiskOverlap::maximum, DiskOverlap::product,
                                 DiskOverlap::bitmask, DiskOverlap::exact};

template <class T>
using Points = std::vector<Vec3<T>>;

template <class T>
detail::DiskEdgeSum<T> shadow_of(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light,
                                 DiskOverlap overlap = DiskOverlap::exact, int size = 32) {
    UmbraVolumeOptions options;
    options.overlap = overlap, options.bitmask_size = size;
    return detail::DiskEdgeSum<T>(casters, light, options);
}
template <class T>
std::vector<T> shade(const detail::DiskEdgeSum<T>& shadow, const Points<T>& points) {
    std::vector<T> result(points.size());
    shadow.visibility(points.data(), points.size(), result.data());
    return result;
}
template <class T>
T shade(const detail::DiskEdgeSum<T>& shadow, const Vec3<T>& point) {
    return shade(shadow, Points<T>{point})[0];
}

/// Emits along −y, as lamps do.
template <class T>
DiskLight<T> lamp(T height, T radius) {
    return {Vec3<T>(T(0), height, T(0)), Vec3<T>(T(0), T(-1), T(0)), radius};
}

enum class Solid { box, tetrahedron, quad, sphere };
constexpr Solid solids[] = {Solid::box, Solid::tetrahedron, Solid::quad, Solid::sphere};
constexpr const char* names[] = {"box", "tetrahedron", "quad", "sphere"};

/// Turned at random, of a size of about 1 times `scale`.
template <class T>
Mesh<T> convex(Solid solid, test::Random& random, T scale, const Vec3<T>& center) {
    Mesh<T> mesh;
    if (solid == Solid::box)
        mesh = test::box_mesh<T>(Vec3<T>(T(0)), Vec3<T>(random.in(T(0.2), T(1)), random.in(T(0.2), T(1)), T(0.5)));
    if (solid == Solid::tetrahedron) mesh = test::tetrahedron_mesh<T>();
    if (solid == Solid::quad)
        mesh = {{Vec3<T>(T(-1), T(-0.7), T(0)), Vec3<T>(T(1), T(-0.4), T(0)), Vec3<T>(T(0.8), T(0.9), T(0)),
                 Vec3<T>(T(-0.9), T(0.6), T(0))},
                {{0, 1, 2}, {0, 2, 3}}};
    if (solid == Solid::sphere) mesh = test::icosphere<T>(1);
    return test::placed(mesh, random, scale, center);
}

/// Faces that a convex solid's shadow from `point` consists of, without overlap: those that look away; of sheets all,
/// and of solids that reach behind the light.
template <class T>
void add_faces(const Mesh<T>& mesh, const Vec3<T>& point, bool all, std::vector<test::Polygon3>& faces) {
    const bool solid = is_closed(edge_adjacency(mesh));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        if (all || !solid || glm::dot(glm::cross(b - a, c - a), glm::dvec3(point) - a) < 0.0)
            faces.push_back({a, b, c});
    }
}
template <class T>
double truth_of(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light, const Vec3<T>& point,
                bool all = false) {
    std::vector<test::Polygon3> faces;
    for (const Mesh<T>& mesh : casters) add_faces(mesh, point, all, faces);
    const DiskLight<double> exact{glm::dvec3(light.center), glm::dvec3(light.normal),
                                  static_cast<double>(light.radius)};
    return test::exact_visibility(glm::dvec3(point), exact, faces);
}

/// Where rays from the light past the casters' middle end: many in the penumbra.
template <class T>
Points<T> points_behind(const std::vector<Mesh<T>>& casters, const DiskLight<T>& light, test::Random& random, int count,
                        T spread) {
    const LightFrame<T> frame = light_frame(light);
    Points<T> points;
    for (int i = 0; i < count; ++i) {
        const Mesh<T>& mesh = casters[static_cast<std::size_t>(random.whole(0, static_cast<int>(casters.size()) - 1))];
        const auto vertex = [&] {
            return mesh
                .positions[static_cast<std::size_t>(random.whole(0, static_cast<int>(mesh.positions.size()) - 1))];
        };
        const Vec3<T> first = vertex(), second = vertex();
        const Vec3<T> target = (first + second) * T(0.5) + random.point(T(-1), T(1)) * spread;
        const T turn = random.in(T(0), T(6.2831853)), r = light.radius * std::sqrt(random.in(T(0), T(1)));
        const Vec3<T> source = light.center + frame.u * (r * std::cos(turn)) + frame.v * (r * std::sin(turn));
        const Vec3<T> along = target - source;
        if (!(glm::dot(along, frame.normal) > T(0))) continue;
        points.push_back(target + along * random.in(T(0.3), T(2)));
    }
    return points;
}

struct Errors {
    double square = 0, worst = 0;
    int count = 0, penumbra = 0;
    void add(double got, double truth) {
        const double error = std::abs(got - truth);
        square += error * error, worst = std::max(worst, error), ++count;
        penumbra += truth > 1e-3 && truth < 1 - 1e-3;
    }
    double rmse() const { return std::sqrt(square / std::max(count, 1)); }
};

}  // namespace

TEST_CASE("cells on a disk: nearly its share of the square, symmetric") {
    for (const int size : {8, 16, 32}) {
        const detail::DiskCells cells(size);
        CHECK(std::abs(cells.count / double(size * size) - std::acos(-1.0) / 4) < 0.03);
        for (int j = 0; j < size; ++j) {
            const auto column = [&](int k) { return cells.columns[static_cast<std::size_t>(k)]; };
            CHECK(column(j) == column(size - 1 - j));
            for (int k = 0; k < size; ++k) CHECK((column(j) >> k & 1U) == (column(k) >> j & 1U));
        }
    }
}

TEST_CASE_TEMPLATE("one convex caster of any size: exact", T, float, double) {
    test::Random random(1);
    for (const Solid solid : solids)
        for (const T radius : {T(0.02), T(0.3), T(1), T(3), T(40)}) {
            Errors errors;
            for (int k = 0; k < scenes; ++k) {
                const Vec3<T> center = random.point(T(-2), T(2));
                const DiskLight<T> light{center, random.point(T(-1), T(1)), radius};
                const LightFrame<T> frame = light_frame(light);
                const Vec3<T> at = center + frame.normal * random.in(T(1.8), T(6)) +
                                   frame.u * (random.in(T(-1), T(1)) * (T(1) + radius)) +
                                   frame.v * random.in(T(-1), T(1));
                const std::vector<Mesh<T>> casters{convex(solid, random, T(0.9), at)};
                const Points<T> points = points_behind(casters, light, random, 40, std::min(T(0.3), radius));
                const std::vector<T> got =
                    shade(shadow_of(casters, light, rules[static_cast<std::size_t>(k) % 5]), points);
                for (std::size_t i = 0; i < points.size(); ++i)
                    errors.add(static_cast<double>(got[i]), truth_of(casters, light, points[i]));
            }
            const std::string name = names[static_cast<std::size_t>(solid)];
            CAPTURE(name);
            CAPTURE(radius);
            CAPTURE(errors.worst);
            CHECK(errors.penumbra > errors.count / (radius < T(0.1) ? 100 : 8));
            CHECK(errors.rmse() < (sizeof(T) == 4 ? 4e-6 : 1e-9));  // of which most is the truth's
        }
}

TEST_CASE_TEMPLATE("several casters, by masks and exactly, against their union", T, float, double) {
    for (const int size : {8, 16, 32, 0})  // 0: exactly
        for (const T radius : {T(0.1), T(0.6), T(2)}) {
            test::Random random(2);
            Errors errors;
            for (int k = 0; k < scenes; ++k) {
                const DiskLight<T> light = lamp(T(8), radius);
                std::vector<Mesh<T>> casters;
                for (int i = random.whole(2, 5); i > 0; --i) {
                    const Vec3<T> at(random.in(T(-0.6), T(0.6)), random.in(T(1.5), T(5)), random.in(T(-0.6), T(0.6)));
                    casters.push_back(convex(solids[random.whole(0, 2)], random, random.in(T(0.2), T(0.6)), at));
                }
                const Points<T> points = points_behind(casters, light, random, 30, T(0.3));
                const std::vector<T> got = shade(size == 0 ? shadow_of(casters, light, DiskOverlap::exact)
                                                           : shadow_of(casters, light, DiskOverlap::bitmask, size),
                                                 points);
                for (std::size_t i = 0; i < points.size(); ++i)
                    errors.add(static_cast<double>(got[i]), truth_of(casters, light, points[i]));
            }
            CAPTURE(size);
            CAPTURE(radius);
            CAPTURE(errors.worst);
            CHECK(errors.rmse() < (size == 8        ? .012
                                   : size == 16     ? .006
                                   : size == 32     ? .003
                                   : sizeof(T) == 4 ? 4e-6
                                                    : 1e-9));
            if (size == 0) CHECK(errors.worst < (sizeof(T) == 4 ? 1e-4 : 1e-8));
        }
}

TEST_CASE_TEMPLATE("concave solids and sheets that lie over themselves, against rays", T, float, double) {
    Mesh<T> ring = test::torus_mesh<T>(8, 5);
    for (Vec3<T>& p : ring.positions) p = Vec3<T>(p.x, p.z + p.y * T(0.7), p.y) + Vec3<T>(T(0), T(2), T(0));
    test::Random random(3);
    Mesh<T> soup = test::soup<T>(random, 9, 12);
    for (Vec3<T>& p : soup.positions) p = p + Vec3<T>(T(0), T(2), T(0));
    const DiskLight<T> light = lamp(T(6), T(0.8));
    for (const Mesh<T>& mesh : {ring, soup}) {
        const Points<T> points = points_behind<T>({mesh}, light, random, scenes, T(0.5));
        const std::vector<T> got = shade(shadow_of<T>({mesh}, light), points);
        Errors errors;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3 p(points[i]);
            int seen = 0;
            const int rays = 64;  // along a radius, and around
            for (int k = 0; k < rays * rays; ++k) {
                const double r = 0.8 * std::sqrt((k / rays + random.in(0.0, 1.0)) / rays);
                const double turn = 2 * pi<double> * (k % rays + random.in(0.0, 1.0)) / rays;
                const glm::dvec3 d = glm::dvec3(r * std::cos(turn), 6, r * std::sin(turn)) - p;
                bool hit = false;
                for (const glm::uvec3& t : mesh.triangles) {
                    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
                    const glm::dvec3 n = glm::cross(b - a, c - a);
                    const double slope = glm::dot(n, d);
                    if (slope == 0.0) continue;
                    const double s = glm::dot(n, a - p) / slope;
                    const glm::dvec3 at = p + d * s;
                    hit = hit ||
                          (s > 0 && s < 1 && glm::dot(glm::cross(b - a, at - a), n) >= 0 &&
                           glm::dot(glm::cross(c - b, at - b), n) >= 0 && glm::dot(glm::cross(a - c, at - c), n) >= 0);
                }
                seen += !hit;
            }
            errors.add(static_cast<double>(got[i]), seen / double(rays * rays));
        }
        CAPTURE(errors.worst);
        CHECK(errors.penumbra > errors.count / 4);
        CHECK(errors.rmse() < .012);
    }
}

TEST_CASE_TEMPLATE("rules: the sum, the largest, the product of what each hides", T, float, double) {
    test::Random random(4);
    const DiskLight<T> light = lamp(T(6), T(1));
    const Mesh<T> a = convex(Solid::box, random, T(0.7), Vec3<T>(T(0.1), T(2), T(0)));
    const Mesh<T> b = convex(Solid::tetrahedron, random, T(0.6), Vec3<T>(T(-0.4), T(3), T(0.2)));
    const Points<T> points = points_behind<T>({a, b}, light, random, 400, T(0.5));
    const std::vector<T> past_a = shade(shadow_of<T>({a}, light), points),
                         past_b = shade(shadow_of<T>({b}, light), points);
    const auto past_both = [&](DiskOverlap rule) { return shade(shadow_of<T>({a, b}, light, rule), points); };
    const std::vector<T> sum = past_both(DiskOverlap::additive), largest = past_both(DiskOverlap::maximum);
    const std::vector<T> product = past_both(DiskOverlap::product), masks = past_both(DiskOverlap::bitmask),
                         exact = past_both(DiskOverlap::exact);
    constexpr T room = T(32) * std::numeric_limits<T>::epsilon();
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(std::abs(sum[i] - std::max(T(0), past_a[i] + past_b[i] - T(1))) <= room);
        CHECK(std::abs(largest[i] - std::min(past_a[i], past_b[i])) <= room);
        CHECK(std::abs(product[i] - past_a[i] * past_b[i]) <= room);
        CHECK((masks[i] >= sum[i] - room && masks[i] <= largest[i] + room));
        CHECK((exact[i] >= sum[i] - room && exact[i] <= largest[i] + room));
    }
}

TEST_CASE_TEMPLATE("full and no occlusion are exactly 0 and 1; everything is in [0, 1]", T, float, double) {
    Mesh<T> ball = test::icosphere<T>(4);
    for (Vec3<T>& p : ball.positions) p = p + Vec3<T>(T(0), T(2), T(0));
    const Mesh<T> sheet{{Vec3<T>(T(2), T(1), T(-1)), Vec3<T>(T(3), T(1.1), T(-1)), Vec3<T>(T(3), T(1), T(1)),
                         Vec3<T>(T(2), T(1), T(1))},
                        {{0, 1, 2}, {0, 2, 3}}};
    const DiskLight<T> light = lamp(T(6), T(0.3));
    test::Random random(5);
    for (const DiskOverlap rule : rules) {
        const auto shadow = shadow_of<T>({ball, sheet}, light, rule, 16);
        CAPTURE(static_cast<int>(rule));
        CHECK(shade(shadow, Vec3<T>(T(0), T(0), T(0))) == T(0));
        CHECK(shade(shadow, Vec3<T>(T(0.2), T(0), T(0.3))) == T(0));
        CHECK(shade(shadow, Vec3<T>(T(2.9), T(0), T(0))) == T(0));
        CHECK(shade(shadow, Vec3<T>(T(-4), T(0), T(0))) == T(1));
        CHECK(shade(shadow, Vec3<T>(T(0), T(4), T(0))) == T(1));
        Points<T> points;
        for (int i = 0; i < 3000; ++i) points.push_back(random.point(T(-4), T(7)));
        for (const T v : shade(shadow, points)) CHECK((v >= T(0) && v <= T(1)));
    }
}

TEST_CASE_TEMPLATE("points on the caster, and in the planes of its faces", T, float, double) {
    test::Random random(6);
    Errors on, beside;
    for (int k = 0; k < scenes; ++k) {
        const DiskLight<T> light = lamp(T(6), random.in(T(0.1), T(2)));
        const Solid solid = solids[k % 4];
        const std::vector<Mesh<T>> casters{
            convex(solid, random, T(0.8), Vec3<T>(random.in(T(-1), T(1)), T(2), random.in(T(-1), T(1))))};
        const Mesh<T>& mesh = casters[0];
        const auto shadow = shadow_of(casters, light);
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3<T> a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            const Vec3<T> normal = normalize_or(glm::cross(b - a, c - a), Vec3<T>(T(0)));
            const T u = random.in(T(0), T(1)), v = random.in(T(0), T(1)) * (T(1) - u);
            const Vec3<T> inside = a + (b - a) * u + (c - a) * v, outside = a + (b - a) * T(-1.5) + (c - a) * v;
            // a face in whose plane the point lies is seen edge-on: it hides nothing; of solids the others do
            const auto truth = [&](const Vec3<T>& point) {
                return truth_of(casters, light, point + normal * (solid == Solid::quad ? T(0) : T(1e-5)));
            };
            if (solid != Solid::quad && glm::dot(normal, light.center - inside) > T(0))
                on.add(static_cast<double>(shade(shadow, inside)), 1.0 - (1.0 - truth(inside)));
            if (solid != Solid::quad) beside.add(static_cast<double>(shade(shadow, outside)), truth(outside));
            if (solid == Solid::quad) on.add(static_cast<double>(shade(shadow, inside)), 1.0);
            const T below = shade(shadow, inside - normal * T(0.01));
            CHECK((below >= T(0) && below <= T(1)));
        }
    }
    CAPTURE(on.worst);
    CAPTURE(beside.worst);
    CHECK(on.count > 100);
    CHECK(on.rmse() < .006);
    CHECK(beside.rmse() < .006);
}

TEST_CASE_TEMPLATE("casters that touch the light, cut its plane, or reach beyond the point", T, float, double) {
    test::Random random(7);
    Errors errors;
    for (int k = 0; k < 2 * scenes; ++k) {
        const DiskLight<T> light = lamp(T(6), random.in(T(0.3), T(2)));
        // a sheet, or an upright box, from below the points to above the light; or with its top on the light's plane
        const T top = k % 3 == 0 ? T(6) : T(7), bottom = k % 2 == 0 ? T(3) : T(-2), x = random.in(T(-1), T(1));
        const T z = random.in(T(-1), T(0.5)), width = random.in(T(0.1), T(1));
        std::vector<Mesh<T>> casters{
            test::box_mesh<T>(Vec3<T>(x, (top + bottom) / T(2), z), Vec3<T>(width, (top - bottom) / T(2), T(0.2)))};
        if (k % 4 == 3)
            casters = {{{Vec3<T>(x, top, z), Vec3<T>(x + width, bottom, z), Vec3<T>(x + T(0.3), bottom, z + width)},
                        {{0, 1, 2}}}};
        Points<T> points;
        for (int i = 0; i < 20; ++i) points.emplace_back(random.in(T(-3), T(3)), T(0), random.in(T(-3), T(3)));
        points.erase(std::remove_if(points.begin(), points.end(),
                                    [&](const Vec3<T>& p) {  // in the box
                                        return std::abs(p.x - x) < T(1.01) * width && std::abs(p.z - z) < T(0.21);
                                    }),
                     points.end());
        const std::vector<T> got = shade(shadow_of(casters, light), points);
        for (std::size_t i = 0; i < points.size(); ++i)
            errors.add(static_cast<double>(got[i]), truth_of(casters, light, points[i], true));
    }
    CAPTURE(errors.worst);
    CHECK(errors.penumbra > errors.count / 8);
    CHECK(errors.rmse() < (sizeof(T) == 4 ? 1e-5 : 1e-6));  // the truth stops 1e-6 short of the point's depth
}

TEST_CASE_TEMPLATE("the light inside a solid is hidden from outside, and seen from inside", T, float, double) {
    const Mesh<T> room = test::box_mesh<T>(Vec3<T>(T(0), T(3), T(0)), Vec3<T>(T(4), T(4), T(4)));
    const Mesh<T> lampshade = test::box_mesh<T>(Vec3<T>(T(0), T(6), T(0)), Vec3<T>(T(1), T(0.5), T(1)));
    const DiskLight<T> light = lamp(T(6), T(0.5));
    const Vec3<T> inside(T(1), T(0), T(1)), below(T(1), T(-2), T(1));
    for (const DiskOverlap rule : rules) {
        CHECK(shade(shadow_of<T>({room}, light, rule), inside) == T(1));
        CHECK(shade(shadow_of<T>({room}, light, rule), below) == T(0));
        CHECK(shade(shadow_of<T>({lampshade}, light, rule), inside) == T(0));
        CHECK(shade(shadow_of<T>({room, lampshade}, light, rule), inside) == T(0));
    }
}

TEST_CASE_TEMPLATE("hard cases have documented limits", T, float, double) {
    const Mesh<T> box = test::box_mesh<T>(Vec3<T>(T(0), T(2), T(0)), Vec3<T>(T(1), T(0.5), T(1)));
    constexpr T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
    constexpr T big = std::numeric_limits<T>::max();
    for (const DiskOverlap rule : rules) {
        const auto shadow = shadow_of<T>({box}, lamp(T(6), T(0.5)), rule, 8);
        CHECK(shade(shadow, Vec3<T>(T(0), T(6), T(0))) == T(1));  // on the light's plane
        CHECK(shade(shadow, Vec3<T>(T(0), T(9), T(0))) == T(1));  // behind it
        CHECK(shade(shadow, Vec3<T>(nan, T(0), T(0))) == T(1));
        CHECK(shade(shadow, Vec3<T>(T(0), -inf, T(0))) == T(1));
        CHECK(shade(shadow, Vec3<T>(T(0), T(2), T(0))) == T(0));  // inside the caster
        for (const Vec3<T>& far : {Vec3<T>(T(0), -big, big), Vec3<T>(big, T(0), T(1)), Vec3<T>(T(-1e18), T(-3), T(1e9)),
                                   Vec3<T>(T(1e7), T(5.9), T(0)), Vec3<T>(T(0), T(-1e18), T(0))}) {
            const T v = shade(shadow, far);
            CHECK((v >= T(0) && v <= T(1)));
        }
        CHECK(shade(detail::DiskEdgeSum<T>(), Vec3<T>(T(0))) == T(1));
        CHECK(shade(shadow_of<T>({}, lamp(T(6), T(1)), rule), Vec3<T>(T(0))) == T(1));
        CHECK(shade(shadow_of<T>({Mesh<T>{}}, lamp(T(6), T(1)), rule), Vec3<T>(T(0))) == T(1));
        // no size: a hard shadow; huge: nothing but finite
        const auto hard = shadow_of<T>({box}, lamp(T(6), T(0)), rule);
        CHECK(shade(hard, Vec3<T>(T(1.4), T(0), T(0))) == T(0));
        CHECK(shade(hard, Vec3<T>(T(1.9), T(0), T(0))) == T(1));
        CHECK(shade(shadow_of<T>({box}, lamp(T(6), T(1e6)), rule), Vec3<T>(T(0))) > T(0.99));
    }
}

TEST_CASE_TEMPLATE("radius 0 is what one ray sees", T, float, double) {
    test::Random random(8);
    int wrong = 0, hidden = 0, all = 0;
    for (int k = 0; k < scenes; ++k) {
        const std::vector<Mesh<T>> casters{convex(solids[k % 4], random, T(0.8), Vec3<T>(T(0), T(2), T(0)))};
        const auto shadow = shadow_of(casters, lamp(T(6), T(0)));
        Points<T> points;
        for (int i = 0; i < 50; ++i) points.emplace_back(random.in(T(-2), T(2)), T(0), random.in(T(-2), T(2)));
        const std::vector<T> got = shade(shadow, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double small = truth_of(casters, lamp(T(6), T(1e-3)), points[i]);
            if (small > 0 && small < 1) continue;  // at the border
            ++all, hidden += got[i] == T(0), wrong += std::abs(static_cast<double>(got[i]) - small) > 1e-6;
        }
    }
    CHECK(wrong == 0);
    CHECK(hidden > all / 20);
    CHECK(hidden < all);
}

TEST_CASE_TEMPLATE("scenes of any size and anywhere", T, float, double) {
    test::Random random(9);
    const std::vector<Mesh<T>> casters{convex(Solid::box, random, T(0.8), Vec3<T>(T(0.1), T(2), T(0))),
                                       convex(Solid::sphere, random, T(0.5), Vec3<T>(T(-0.4), T(3), T(0.2)))};
    const DiskLight<T> light = lamp(T(6), T(0.75));
    const Points<T> points = points_behind(casters, light, random, 300, T(0.5));
    const std::vector<T> before = shade(shadow_of(casters, light), points);
    const auto moved = [&](T scale, const Vec3<T>& by) {
        std::vector<Mesh<T>> there = casters;
        Points<T> points_there = points;
        DiskLight<T> light_there = light;
        for (Mesh<T>& mesh : there)
            for (Vec3<T>& p : mesh.positions) p = p * scale + by;
        for (Vec3<T>& p : points_there) p = p * scale + by;
        light_there.center = light.center * scale + by, light_there.radius *= scale;
        Errors errors;
        const std::vector<T> got = shade(shadow_of(there, light_there), points_there);
        for (std::size_t i = 0; i < points.size(); ++i)
            errors.add(static_cast<double>(got[i]),
                       by.x > T(0) ? truth_of(there, light_there, points_there[i]) : static_cast<double>(before[i]));
        return errors;
    };
    for (const int exponent : {-20, 10, 20, 40})  // bit for bit
        CHECK(moved(std::ldexp(T(1), exponent), Vec3<T>(T(0))).worst == 0.0);
    CHECK(moved(T(1e6), Vec3<T>(T(0))).rmse() < .002);  // radius 7.5e5; another grid of cells
    // at 1e5 an ULP of float is .008: the truth is that of the rounded scene, and faces within 0.01 of a point hide
    // nothing
    const Errors far = moved(T(1), Vec3<T>(T(1e5)));
    CAPTURE(far.worst);
    CHECK(far.rmse() < .012);
}

TEST_CASE("batches of any size give what single points give") {
    test::Random random(10);
    std::vector<Mesh<float>> casters;
    for (int i = 0; i < 12; ++i)
        casters.push_back(convex(solids[i % 4], random, 0.4F, random.point(-1.0F, 1.0F) + Vec3<float>(0, 2.5F, 0)));
    const DiskLight<float> light = lamp(6.0F, 1.0F);
    const Points<float> points = points_behind(casters, light, random, 300, 0.5F);
    const auto shadow = shadow_of(casters, light);
    CHECK(shadow.bytes() > 0);
    const std::vector<float> all = shade(shadow, points);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(std::abs(all[i] - shade(shadow, points[i])) <= 2e-6F);
}

TEST_CASE("turning the scene around the disk's axis changes nothing beyond masks") {
    test::Random random(11);
    const std::vector<Mesh<float>> casters{convex(Solid::tetrahedron, random, 0.8F, Vec3<float>(0.1F, 2, 0))};
    const DiskLight<float> light = lamp(6.0F, 0.75F);
    const Points<float> points = points_behind(casters, light, random, 300, 0.5F);
    const std::vector<float> before = shade(shadow_of(casters, light), points);
    for (const float turn : {0.3F, 1.2F, 2.8F}) {
        const auto turned = [&](const Vec3<float>& p) {
            return Vec3<float>(std::cos(turn) * p.x + std::sin(turn) * p.z, p.y,
                               std::cos(turn) * p.z - std::sin(turn) * p.x);
        };
        std::vector<Mesh<float>> there = casters;
        Points<float> points_there = points;
        for (Vec3<float>& p : there[0].positions) p = turned(p);
        for (Vec3<float>& p : points_there) p = turned(p);
        const std::vector<float> got = shade(shadow_of(there, light), points_there);
        for (std::size_t i = 0; i < points.size(); ++i) CHECK(std::abs(got[i] - before[i]) < 2e-5F);
    }
}
