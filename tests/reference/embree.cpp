#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/reference/embree.hpp>
#include <string>
#include <thread>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/error_of.hpp"
#include "../support/polygon_area.hpp"
#include "../support/random.hpp"

using namespace penumbra;
using penumbra::test::error_of;
using namespace penumbra::reference;
using glm::dvec3;
using test::exact_visibility;
using Vec = Vec3<float>;
using Meshes = std::vector<Mesh<float>>;

namespace {

constexpr Sampler samplers[] = {Sampler::stratified, Sampler::r2, Sampler::sobol};
constexpr Rays modes[] = {Rays::single, Rays::packet16, Rays::coherent16};

SampleOptions with(int samples, Sampler sampler = Sampler::sobol, Rays rays = Rays::coherent16,
                   std::uint32_t seed = 0) {
    SampleOptions options;
    options.samples = samples, options.sampler = sampler, options.rays = rays, options.seed = seed;
    return options;
}

/// A convex polygon as a fan of triangles.
template <class T>
Mesh<T> fan(const std::vector<Vec3<T>>& corners) {
    Mesh<T> mesh{corners, {}};
    for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.triangles.emplace_back(0U, i - 1, i);
    return mesh;
}

/// A horizontal square, counter-clockwise seen from above (y).
Mesh<float> tile(const Vec& center, float half) {
    const Vec u(half, 0.0F, 0.0F), v(0.0F, 0.0F, half);
    return fan<float>({center - u - v, center - u + v, center + u + v, center + u - v});
}

RectLight<float> square_above(float height, float half) {  // emits along −y
    return {Vec(0.0F, height, 0.0F), Vec(half, 0.0F, 0.0F), Vec(0.0F, 0.0F, half)};
}

/// A light, a point in front of it, and a few convex polygons between them.
template <class Light>
struct Case {
    Light light;
    Vec point;
    Meshes casters;
    double exact;
};

RectLight<double> widen(const RectLight<float>& l) { return {dvec3(l.center), dvec3(l.half_u), dvec3(l.half_v)}; }
DiskLight<double> widen(const DiskLight<float>& l) {
    return {dvec3(l.center), dvec3(l.normal), static_cast<double>(l.radius)};
}
LinearLight<double> widen(const LinearLight<float>& l) { return {dvec3(l.a), dvec3(l.b)}; }

void shape(RectLight<float>& light, const LightFrame<float>& f, test::Random& random) {
    const float width = random.in(0.3F, 1.5F), height = random.in(0.3F, 1.5F);
    light = {f.origin, f.u * width, f.v * height};
}
void shape(DiskLight<float>& light, const LightFrame<float>& f, test::Random& random) {
    const float length = random.in(0.5F, 2.0F), radius = random.in(0.3F, 1.5F);
    light = {f.origin, f.normal * length, radius};
}
void shape(LinearLight<float>& light, const LightFrame<float>& f, test::Random& random) {
    const Vec half = f.u * random.in(0.3F, 1.5F);
    light = {f.origin - half, f.origin + half};
}

template <class Light>
std::vector<Case<Light>> random_cases(int count, std::uint32_t seed) {
    test::Random random(seed);
    std::vector<Case<Light>> cases;
    while (static_cast<int>(cases.size()) < count) {
        Case<Light> c;
        const Vec center = random.point(-2.0F, 2.0F);
        const Vec normal = normalize_or(random.point(-1.0F, 1.0F), Vec(1.0F, 0.0F, 0.0F));
        const LightFrame<float> frame = light_frame(DiskLight<float>{center, normal, 1.0F});
        shape(c.light, frame, random);
        const Vec spot = random.point(-1.5F, 1.5F);
        c.point = frame.to_world(Vec(spot.x, spot.y, random.in(2.0F, 5.0F)));
        std::vector<test::Polygon3> polygons;
        for (int k = random.whole(1, 4); k > 0; --k) {
            const float along = random.in(0.2F, 0.8F);
            const Vec middle = center + (c.point - center) * along + random.point(-0.4F, 0.4F);
            std::vector<Vec> corners;
            for (int corner = 0; corner < 3; ++corner) corners.push_back(middle + random.point(-0.6F, 0.6F));
            if (random.whole(0, 1) == 1) corners.push_back(corners[0] + corners[2] - corners[1]);
            c.casters.push_back(fan(corners));
            polygons.emplace_back(corners.begin(), corners.end());
        }
        c.exact = exact_visibility(dvec3(c.point), widen(c.light), polygons);
        if (c.exact > 0.02 && c.exact < 0.98) cases.push_back(c);
    }
    return cases;
}

/// Error of visibility on the cases, root mean square and mean, over a few seeds.
struct Errors {
    double rmse = 0.0, mean = 0.0;
    int count = 0;
};
template <class Light>
Errors errors(const std::vector<Case<Light>>& cases, const SampleOptions& options, int seeds) {
    Errors e;
    for (const Case<Light>& c : cases) {
        const Scene scene(c.casters);
        for (int k = 0; k < seeds; ++k) {
            SampleOptions seeded = options;
            seeded.seed = static_cast<std::uint32_t>(k);
            const double error = static_cast<double>(scene.visibility(c.point, c.light, seeded)) - c.exact;
            e.rmse += error * error, e.mean += error, ++e.count;
        }
    }
    e.rmse = std::sqrt(e.rmse / e.count), e.mean /= e.count;
    return e;
}

/// A closed convex mesh: a cube, or a sphere of 2 · 24 · 15 triangles; half-size or radius 1 around the origin.
Mesh<double> cube() { return test::box_mesh(Vec3<double>(0.0), Vec3<double>(1.0)); }
Mesh<double> sphere() {
    constexpr std::uint32_t around = 24, rings = 16;
    Mesh<double> mesh;
    for (std::uint32_t j = 0; j <= rings; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double theta = pi<double> * j / rings, phi = 2.0 * pi<double> * i / around;
            mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                                        std::sin(theta) * std::sin(phi));
        }
    for (std::uint32_t j = 0; j < rings; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around;
            if (j > 0) mesh.triangles.emplace_back(a, b, b + around);
            if (j + 1 < rings) mesh.triangles.emplace_back(a, b + around, a + around);
        }
    return mesh;
}

template <class T>
Mesh<T> place(const Mesh<double>& mesh, double scale, const dvec3& offset) {
    Mesh<T> placed;
    for (const dvec3& p : mesh.positions) placed.positions.emplace_back(p * scale + offset);
    placed.triangles = mesh.triangles;
    return placed;
}

}  // namespace

TEST_CASE("the polygons' own truth: what can be told by hand") {
    const RectLight<double> rect{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)};  // emits along +z
    const DiskLight<double> disk{dvec3(0, 0, 0), dvec3(0, 0, 1), 1.0};
    const LinearLight<double> line{dvec3(-1, 0, 0), dvec3(1, 0, 0)};
    const dvec3 p(0, 0, 2);
    // halfway between light and point everything shows at twice its size
    const auto box = [](double x0, double y0, double x1, double y1, double z = 1.0) {
        return test::Polygon3{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    };
    CHECK(exact_visibility(p, rect, {}) == 1.0);
    CHECK(exact_visibility(p, rect, {box(-1, -1, 1, 1)}) == 0.0);
    CHECK(exact_visibility(p, rect, {box(0, -1, 1, 1)}) == doctest::Approx(0.5));
    CHECK(exact_visibility(p, rect, {box(0, 0, 0.25, 0.25)}) == doctest::Approx(1.0 - 0.25 / 4.0));
    CHECK(exact_visibility(p, disk, {box(0, -1, 1, 1)}) == doctest::Approx(0.5));
    CHECK(exact_visibility(p, disk, {box(0, 0, 1, 1)}) == doctest::Approx(0.75));
    CHECK(exact_visibility(p, disk, {box(0, 0, 0.25, 0.25)}) == doctest::Approx(1.0 - 0.25 / pi<double>));
    // the segment beyond half of the radius: acos ½ − ½ √¾
    CHECK(exact_visibility(p, disk, {box(0.25, -1, 1, 1)}) ==
          doctest::Approx(1.0 - (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / pi<double>));
    CHECK(exact_visibility(p, line, {box(0, -1, 1, 1)}) == doctest::Approx(0.5));
    CHECK(exact_visibility(p, line, {box(0, -1, 0.25, 1)}) == doctest::Approx(0.75));
    CHECK(exact_visibility(p, line, {box(0, 0.1, 0.25, 1)}) == 1.0);
    // overlaps count once: three boxes, two of them over each other, at different depths
    const std::vector<test::Polygon3> three{box(0, -1, 1, 1), box(0.25, -1, 1, 1), box(-1.5, 0, 0, 1.5, 0.5)};
    CHECK(exact_visibility(p, rect, three) == doctest::Approx(0.25));
    CHECK(exact_visibility(p, disk, three) == doctest::Approx(0.25));
    CHECK(exact_visibility(p, line, three) == doctest::Approx(0.5));  // the third only touches the line
    // behind the light and beyond the point there is nothing to hide it; astride, the part in front counts
    CHECK(exact_visibility(p, rect, {box(-9, -9, 9, 9, -1), box(-9, -9, 9, 9, 3)}) == 1.0);
    CHECK(exact_visibility(p, rect, {{{0, -9, -1}, {0, 9, -1}, {1, 9, 3}, {1, -9, 3}}}) == doctest::Approx(0.625));
}

TEST_CASE_TEMPLATE("rays converge to the exact area, with every sampler and every way to trace", Light,
                   RectLight<float>, DiskLight<float>, LinearLight<float>) {
    const auto cases = random_cases<Light>(60, 11);
    // Root mean square at 1024 rays: measured .0028 to .0037 and .0005 to .0008, of random rays about .011.
    const double limit = std::is_same_v<Light, LinearLight<float>> ? 0.0012 : 0.005;
    for (const Sampler sampler : samplers)
        for (const Rays rays : modes) {
            const Errors e = errors(cases, with(1024, sampler, rays), 4);
            CAPTURE(static_cast<int>(sampler));
            CAPTURE(static_cast<int>(rays));
            CHECK(e.rmse < limit);
            CHECK(std::abs(e.mean) < 4.0 * e.rmse / std::sqrt(e.count));  // four standard errors
        }
}

TEST_CASE_TEMPLATE("errors fall faster with the number of rays than random ones do", Light, RectLight<float>,
                   DiskLight<float>, LinearLight<float>) {
    const auto cases = random_cases<Light>(100, 12);
    // Expected n^-3/4 for an edge in the square, n^-1 on a line; of random samples n^-1/2. Measured .70 to .76 and .92
    // to 1.01 over several sets of cases.
    const double power = std::is_same_v<Light, LinearLight<float>> ? 0.85 : 0.66;
    for (const Sampler sampler : samplers) {
        const double few = errors(cases, with(16, sampler), 4).rmse, many = errors(cases, with(4096, sampler), 4).rmse;
        CAPTURE(static_cast<int>(sampler));
        CAPTURE(few);
        CAPTURE(many);
        CHECK(many < few * std::pow(256.0, -power));
    }
}

TEST_CASE("the noise estimate is the error that is there") {
    // 320 errors and 280 degrees of freedom: both have a standard error of about 5 %
    const auto cases = random_cases<RectLight<float>>(40, 13);
    for (const Sampler sampler : samplers) {
        double estimate = 0.0;
        for (const auto& c : cases) {
            const double noise = Scene(c.casters).noise(&c.point, 1, c.light, with(256, sampler), 8);
            estimate += noise * noise / 40.0;
        }
        CHECK(std::sqrt(estimate) == doctest::Approx(errors(cases, with(256, sampler), 8).rmse).epsilon(0.2));
    }
    const Scene empty{Meshes{}};
    const Vec p(0.0F, 0.0F, 0.0F);
    CHECK(empty.noise(&p, 1, square_above(1.0F, 1.0F)) == 0.0);
    CHECK(empty.noise(&p, 0, square_above(1.0F, 1.0F)) == 0.0);
}

TEST_CASE("nothing in the way is exactly 1, everything in the way exactly 0") {
    const RectLight<float> rect = square_above(4.0F, 1.0F);
    const DiskLight<float> disk{rect.center, Vec(0.0F, -1.0F, 0.0F), 1.0F};
    const LinearLight<float> line{Vec(-1.0F, 4.0F, 0.0F), Vec(1.0F, 4.0F, 0.0F)};
    const Vec p(0.1F, 0.0F, 0.2F);
    // A roof of 2 · 64² triangles, edges and corners everywhere; no ray may slip between them.
    Mesh<float> roof;
    constexpr std::uint32_t n = 65;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            roof.positions.emplace_back(static_cast<float>(i) / 16.0F - 2.0F, 2.0F + 0.01F * static_cast<float>(i % 3),
                                        static_cast<float>(j) / 16.0F - 2.0F);
    for (std::uint32_t a = 0; a + n < n * n; ++a) {
        if (a % n + 1 == n) continue;
        roof.triangles.emplace_back(a, a + 1, a + n);
        roof.triangles.emplace_back(a + 1, a + n + 1, a + n);
    }
    const Scene none{Meshes{}}, hollow{Meshes{{}, {{p}, {}}}}, beside{Meshes{tile(Vec(9.0F, 2.0F, 0.0F), 1.0F)}};
    const Scene covered{Meshes{roof}};
    for (const Sampler sampler : samplers) {
        const SampleOptions options = with(16384, sampler);
        for (const Scene* scene : {&none, &hollow, &beside}) {
            CHECK(scene->visibility(p, rect, options) == 1.0F);
            CHECK(scene->visibility(p, disk, options) == 1.0F);
            CHECK(scene->visibility(p, line, options) == 1.0F);
        }
        CHECK(covered.visibility(p, rect, options) == 0.0F);
        CHECK(covered.visibility(p, disk, options) == 0.0F);
        CHECK(covered.visibility(p, line, options) == 0.0F);
    }
}

TEST_CASE("no ray slips out of a closed mesh, not even when aimed at its corners and edges") {
    const Mesh<float> shell = place<float>(sphere(), 1.0, dvec3(0.1, 0.2, 0.3));
    const Scene scene(Meshes{shell});
    test::Random random(71);
    for (const glm::uvec3& t : shell.triangles) {
        const Vec a = shell.positions[t.x], b = shell.positions[t.y];
        const Vec p = Vec(0.1F, 0.2F, 0.3F) + random.point(-0.5F, 0.5F);
        for (const float along : {0.0F, 0.5F, random.in(0.0F, 1.0F)}) {
            const Vec aim = a + (b - a) * along, light = p + (aim - p) * random.in(2.0F, 4.0F);
            CAPTURE(along);
            CHECK(scene.visibility(p, LinearLight<float>{light, light}) == 0.0F);
        }
    }
}

TEST_CASE_TEMPLATE("a point on a caster is lit and shadowed as it should be, at any scale and far from the origin", T,
                   float, double) {
    struct Place {
        double scale;
        dvec3 offset;
    };
    // far away, float coordinates are 2^-7 apart: the scene must be larger for that to be a sphere or a cube at all
    const Place places[] = {{1.0, dvec3(0.0)},
                            {1e-3, dvec3(0.0)},
                            {1e3, dvec3(0.0)},
                            {1e-3, dvec3(1.0, -1.0, 0.5)},
                            {100.0, dvec3(1e5, 0.0, -1e5)},
                            {std::is_same_v<T, float> ? 100.0 : 1.0, dvec3(-1e5, 1e5, 1e5)}};
    test::Random random(21);
    const glm::dmat3 tilt(glm::dvec3(0.8, 0.6, 0.0), glm::dvec3(-0.48, 0.64, 0.6), glm::dvec3(0.36, -0.48, 0.8));
    for (const Mesh<double>& solid : {cube(), sphere()})
        for (const bool tilted : {false, true})
            for (const Place& at : places) {
                Mesh<double> turned = solid;
                if (tilted)
                    for (dvec3& p : turned.positions) p = tilt * p;
                const Mesh<T> mesh = place<T>(turned, at.scale, at.offset);
                const Scene scene(std::vector<Mesh<T>>{mesh});
                int lit = 0, dark = 0, grazing = 0;
                for (int k = 0; k < 300; ++k) {
                    const auto& t = mesh.triangles[static_cast<std::size_t>(
                        random.whole(0, static_cast<int>(mesh.triangles.size()) - 1))];
                    double u = random.in(0.0, 1.0), v = random.in(0.0, 1.0);
                    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
                    if (k % 5 == 0) v = 0.0;       // on an edge
                    if (k % 25 == 0) u = 1.0 - v;  // on a corner or another edge
                    const dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
                    const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
                    const Vec3<T> point(a + (b - a) * u + (c - a) * v);
                    // a light outside of the solid, facing the point
                    const dvec3 out = glm::normalize(random.point(-1.0, 1.0));
                    const dvec3 center = at.offset + out * random.in(2.5, 8.0) * at.scale;
                    const dvec3 away = glm::normalize(center - dvec3(point));
                    const LightFrame<double> frame = light_frame(DiskLight<double>{center, -away, 1.0});
                    const double size = random.in(0.01, 0.3) * at.scale;
                    const RectLight<T> light{Vec3<T>(center), Vec3<T>(frame.u * size), Vec3<T>(frame.v * size)};
                    double lowest = 1.0, highest = -1.0;  // sine of the light's elevation over the triangle
                    for (const double x : {-1.0, 1.0})
                        for (const double y : {-1.0, 1.0}) {
                            const dvec3 corner = center + (x * frame.u + y * frame.v) * size - dvec3(point);
                            const double sine = glm::dot(corner, normal) / glm::length(corner);
                            lowest = std::min(lowest, sine), highest = std::max(highest, sine);
                        }
                    CAPTURE(tilted);
                    CAPTURE(at.scale);
                    CAPTURE(at.offset.x);
                    CAPTURE(lowest);
                    CAPTURE(highest);
                    CAPTURE(k);
                    // On an edge the neighbour decides as well, so only lit is sure there, and only from above both.
                    const bool inside = k % 5 != 0;
                    for (const Rays rays : modes) {
                        const T seen = scene.visibility(point, light, with(64, Sampler::sobol, rays));
                        if (lowest > 0.01) {
                            CHECK(seen == T(1));
                            ++lit;
                            grazing += lowest < 0.1;
                        } else if (highest < -0.01 && inside) {
                            CHECK(seen == T(0));
                            ++dark;
                        }
                    }
                }
                CHECK(lit > 200);
                CHECK(dark > 200);
                CHECK(grazing > 10);
            }
}

TEST_CASE("gaps above the tolerance are resolved, gaps below it are not") {
    for (const float scale : {1e-3F, 1.0F, 1e3F})
        for (const float offset : {0.0F, 1e5F}) {
            if (offset > 0.0F && scale < 1e3F) continue;  // no float coordinates in between
            // 16 ε · half diagonal + 4 ε · largest coordinate, see the header
            const float half = scale, tolerance = 0x1p-20F * half * 1.41421F + 0x1p-22F * (half + offset);
            const RectLight<float> light{Vec(offset, 3.0F * scale, 0.0F), Vec(0.3F * scale, 0.0F, 0.0F),
                                         Vec(0.0F, 0.0F, 0.3F * scale)};
            const auto seen_past_gap = [&](float gap, Rays rays) {
                const Meshes casters{tile(Vec(offset, 0.0F, 0.0F), half), tile(Vec(offset, gap, 0.0F), half)};
                return Scene(casters).visibility(Vec(offset, 0.0F, 0.0F), light, with(64, Sampler::r2, rays));
            };
            CAPTURE(scale);
            CAPTURE(offset);
            for (const Rays rays : modes) {
                CHECK(seen_past_gap(1.5F * tolerance, rays) == 0.0F);
                CHECK(seen_past_gap(0.5F * tolerance, rays) == 1.0F);
            }
        }
}

TEST_CASE("a caster that coincides with the light does not hide it, one just in front does") {
    const RectLight<float> light = square_above(4.0F, 1.0F);
    test::Random random(31);
    for (int k = 0; k < 50; ++k) {
        const Vec p(random.in(-3.0F, 3.0F), random.in(-1.0F, 2.0F), random.in(-3.0F, 3.0F));
        CHECK(Scene(Meshes{tile(light.center, 1.0F)}).visibility(p, light, with(256)) == 1.0F);
        CHECK(Scene(Meshes{tile(Vec(0.0F, 3.999F, 0.0F), 1.0F)}).visibility(p, light, with(256)) < 0.01F);
    }
}

TEST_CASE("the limits: behind the light, on its plane, without size, not finite") {
    const Scene scene(Meshes{tile(Vec(0.0F, 2.0F, 0.0F), 1.0F), tile(Vec(0.0F, 6.0F, 0.0F), 1.0F)});
    const RectLight<float> rect = square_above(4.0F, 0.5F);
    const DiskLight<float> disk{rect.center, Vec(0.0F, -2.0F, 0.0F), 0.5F};
    const LinearLight<float> line{Vec(-0.5F, 4.0F, 0.0F), Vec(0.5F, 4.0F, 0.0F)};
    for (const float height : {4.0F, 5.0F, 9.0F}) {  // 9: beyond a caster
        CHECK(scene.visibility(Vec(0.0F, height, 0.0F), rect) == 1.0F);
        CHECK(scene.visibility(Vec(0.0F, height, 0.0F), disk) == 1.0F);
    }
    CHECK(scene.visibility(Vec(0.0F, 9.0F, 0.0F), line) == 0.0F);  // emits to all sides
    CHECK(scene.visibility(Vec(0.0F, 0.0F, 0.0F), line) == 0.0F);
    CHECK(scene.visibility(Vec(0.25F, 4.0F, 0.0F), line) == 1.0F);  // on the light itself

    // without size: looks at the casters' middle
    const Scene below(Meshes{tile(Vec(0.0F, 2.0F, 0.0F), 1.0F)});
    const Vec zero(0.0F, 0.0F, 0.0F);
    for (const float x : {0.0F, 1.9F, 2.1F, 5.0F}) {  // a point light casts the shadow of half-size 2
        const float hard = x < 2.0F ? 0.0F : 1.0F;
        const Vec p(x, 0.0F, 0.3F);
        CAPTURE(x);
        CHECK(below.visibility(p, RectLight<float>{rect.center, zero, zero}) == hard);
        CHECK(below.visibility(p, RectLight<float>{rect.center, zero, Vec(0.0F, 0.0F, 1e-4F)}) == hard);
        CHECK(below.visibility(p, DiskLight<float>{rect.center, disk.normal, 0.0F}) == hard);
        CHECK(below.visibility(p, LinearLight<float>{rect.center, rect.center}) == hard);
    }
    // a rectangle without height is a line
    const Vec p(1.7F, 0.0F, 0.0F);
    const float flat = below.visibility(p, RectLight<float>{rect.center, rect.half_u, zero});
    CHECK(std::abs(flat - below.visibility(p, line)) < 2e-3F);
    CHECK(flat > 0.1F);
    CHECK(flat < 0.9F);

    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity}) CHECK(scene.visibility(Vec(0.0F, bad, 0.0F), rect) == 1.0F);
}

TEST_CASE("the result depends on the point, the options and the seed, not on order, batch or thread") {
    const auto cases = random_cases<RectLight<float>>(1, 41);
    const Scene scene(cases[0].casters);
    const RectLight<float>& light = cases[0].light;
    test::Random random(42);
    std::vector<Vec> points;
    for (int k = 0; k < 101; ++k) points.push_back(cases[0].point + random.point(-1.0F, 1.0F));
    points[3] = light.center;  // not traced
    for (const Rays rays : modes)
        for (const int samples : {1, 3, 4, 16, 17, 100}) {
            const SampleOptions options = with(samples, Sampler::sobol, rays, 7);
            std::vector<float> batch(points.size()), reversed(points.size()), threaded(points.size());
            scene.visibility(points.data(), points.size(), light, options, batch.data());
            std::vector<Vec> backwards(points.rbegin(), points.rend());
            scene.visibility(backwards.data(), points.size(), light, options, reversed.data());
            std::reverse(reversed.begin(), reversed.end());
            std::vector<std::thread> threads;
            for (std::size_t first = 0; first < points.size(); first += 26)
                threads.emplace_back([&, first] {
                    scene.visibility(&points[first], std::min<std::size_t>(26, points.size() - first), light, options,
                                     &threaded[first]);
                });
            for (std::thread& thread : threads) thread.join();
            CAPTURE(samples);
            CAPTURE(static_cast<int>(rays));
            CHECK(batch == reversed);
            CHECK(batch == threaded);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const float one = scene.visibility(points[i], light, options);
                CHECK(batch[i] == one);
                const float rays_seen = one * static_cast<float>(samples);
                CHECK(std::abs(rays_seen - std::round(rays_seen)) < 1e-4F);  // a whole number of rays
            }
            if (samples == 100) {
                std::vector<float> other(points.size());
                scene.visibility(points.data(), points.size(), light, with(samples, Sampler::sobol, rays, 8),
                                 other.data());
                CHECK(batch != other);
            }
        }
}

TEST_CASE("every way to trace sees the same rays") {
    // edges between triangles aside: the intersectors may round differently there
    for (const auto& c : random_cases<DiskLight<float>>(40, 51)) {
        const Scene scene(c.casters);
        const float single = scene.visibility(c.point, c.light, with(1000, Sampler::r2, Rays::single));
        for (const Rays rays : {Rays::packet16, Rays::coherent16})
            CHECK(std::abs(scene.visibility(c.point, c.light, with(1000, Sampler::r2, rays)) - single) < 1.5e-3F);
    }
}

TEST_CASE_TEMPLATE("the result is right at any scale that the coordinates can hold", T, float, double) {
    const auto c = random_cases<RectLight<float>>(1, 61)[0];
    const auto seen = [&](double scale) {
        std::vector<Mesh<T>> casters;
        for (const Mesh<float>& mesh : c.casters) {
            casters.emplace_back();
            for (const Vec& p : mesh.positions) casters.back().positions.emplace_back(Vec3<T>(dvec3(p) * scale));
            casters.back().triangles = mesh.triangles;
        }
        const auto scaled = [&](const Vec& v) { return Vec3<T>(dvec3(v) * scale); };
        const RectLight<T> light{scaled(c.light.center), scaled(c.light.half_u), scaled(c.light.half_v)};
        return static_cast<double>(Scene(casters).visibility(scaled(c.point), light, with(65536)));
    };
    // measured noise at 65536 rays: 1e-4
    for (const double scale : {0x1p-40, 0x1p-10, 0x1p10, 0x1p40})
        CHECK(seen(scale) == doctest::Approx(c.exact).epsilon(1e-3));
}

TEST_CASE("the first hit: where, on which triangle, and which way it faces") {
    // the mesh in the middle is empty but keeps its number
    const Meshes casters{tile(Vec(0.0F, 0.0F, 0.0F), 1.0F), {}, tile(Vec(0.0F, 2.0F, 0.0F), 1.0F)};
    const Scene scene(casters);
    const Vec down(0.0F, -1.0F, 0.0F);
    const auto top = scene.closest_hit(Vec(0.3F, 5.0F, -0.2F), down);
    REQUIRE(top);
    CHECK(top->mesh == 2);
    CHECK(top->distance == doctest::Approx(3.0));
    CHECK(glm::length(top->point - Vec(0.3F, 2.0F, -0.2F)) < 1e-6F);
    CHECK(glm::length(top->normal - Vec(0.0F, 1.0F, 0.0F)) < 1e-6F);
    const auto below = scene.closest_hit(Vec(0.3F, 1.0F, -0.2F), down * 4.0F);  // a quarter of its length
    REQUIRE(below);
    CHECK(below->mesh == 0);
    CHECK(below->distance == doctest::Approx(0.25));
    const auto back = scene.closest_hit(Vec(0.3F, 1.0F, -0.2F), -down);  // from behind, the normal stays
    REQUIRE(back);
    CHECK(back->mesh == 2);
    CHECK(back->normal.y == doctest::Approx(1.0));
    CHECK_FALSE(scene.closest_hit(Vec(3.0F, 5.0F, 0.0F), down));
    CHECK_FALSE(scene.closest_hit(Vec(0.3F, 5.0F, -0.2F), -down));
    CHECK_FALSE(Scene(Meshes{}).closest_hit(Vec(0.0F, 5.0F, 0.0F), down));

    // which of the two triangles, by its own corners
    for (const float x : {-0.5F, 0.5F}) {
        const auto hit = scene.closest_hit(Vec(x, 5.0F, 0.0F), down);
        REQUIRE(hit);
        const glm::uvec3 t = casters[2].triangles[hit->triangle];
        Vec low(9.0F, 9.0F, 9.0F), high = -low;
        for (const std::uint32_t i : {t.x, t.y, t.z})
            low = glm::min(low, casters[2].positions[i]), high = glm::max(high, casters[2].positions[i]);
        const Vec middle = (casters[2].positions[t.x] + casters[2].positions[t.y] + casters[2].positions[t.z]) / 3.0F;
        CHECK((middle.x < 0.0F) == (x < 0.0F));
    }
}

TEST_CASE("a scene can be moved") {
    Scene a(Meshes{tile(Vec(0.0F, 2.0F, 0.0F), 9.0F)});
    const Scene b(std::move(a));
    CHECK(b.visibility(Vec(0.0F, 0.0F, 0.0F), square_above(4.0F, 1.0F)) == 0.0F);
    a = Scene(Meshes{});
    CHECK(a.visibility(Vec(0.0F, 0.0F, 0.0F), square_above(4.0F, 1.0F)) == 1.0F);
}

#if PENUMBRA_HAS_EXCEPTIONS
TEST_CASE("bad arguments are reported by name and value") {
    const Scene scene(Meshes{tile(Vec(0.0F, 2.0F, 0.0F), 1.0F)});
    const Vec p(0.0F, 0.0F, 0.0F);
    const RectLight<float> light = square_above(4.0F, 1.0F);
    CHECK(error_of([&] { scene.visibility(p, light, with(0)); }) == "penumbra: options.samples = 0 is not at least 1");
    CHECK(error_of([&] { scene.visibility(p, light, with(-3)); }) ==
          "penumbra: options.samples = -3 is not at least 1");
    CHECK(error_of([&] {
              scene.visibility(p, DiskLight<float>{p, Vec(0.0F, 1.0F, 0.0F), -1.0F});
          }).find("light.radius = -1") != std::string::npos);
    Mesh<float> bad = tile(p, 1.0F);
    bad.triangles[1].z = 17;
    CHECK(error_of([&] {
              Scene{Meshes{tile(p, 1.0F), bad}};
          }).find("casters[1].triangles[1] uses index 17, but there are 4 positions") != std::string::npos);
    bad = tile(p, 1.0F);
    bad.positions[2].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(error_of([&] { Scene{Meshes{bad}}; }).find("casters[0].positions[2]") != std::string::npos);
}
#endif
