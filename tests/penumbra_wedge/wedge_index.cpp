#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <penumbra/penumbra_wedge/wedge_index.hpp>
#include <type_traits>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

using namespace penumbra;

namespace {

/// Sums what an index hands out.
template <class T>
struct Sums {
    const PointTile<T>& tile;
    std::vector<double> coverage = std::vector<double>(PointTile<T>::capacity, 0.0);
    std::size_t edges_handed = 0, meshes = 0, pieces = 0;
    bool in_mesh = false, in_piece = false, all_simple = true;

    void begin_mesh() {
        REQUIRE(!in_mesh);
        in_mesh = true, ++meshes;
    }
    void begin_piece(const Box3<T>&, bool simple) {
        REQUIRE((in_mesh && !in_piece));
        in_piece = true, ++pieces, all_simple = all_simple && simple;
    }
    void edges(const TileEdge<T>& e) {
        REQUIRE(in_piece);
        ++edges_handed;
        for (std::size_t i = 0; i < tile.count; ++i) {
            if (e.coefficient[i] == T(0)) continue;
            edge(i, Vec2<T>(e.ax[i], e.ay[i]), Vec2<T>(e.bx[i], e.by[i]), e.coefficient[i]);
        }
    }
    void edge(std::size_t lane, const Vec2<T>& from, const Vec2<T>& to, T coefficient) {
        coverage[lane] += static_cast<double>(coefficient * edge_coverage(from, to, tile.light));
    }
    void end_piece() {
        REQUIRE(in_piece);
        in_piece = false;
    }
    void end_mesh() {
        REQUIRE((in_mesh && !in_piece));
        in_mesh = false;
    }
};

const LightFrame<double> identity{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <class T>
WedgeIndex<T> index_of(const std::vector<Mesh<double>>& meshes, SilhouetteFrom from, T tolerance) {
    const LightFrame<T> frame{Vec3<T>(identity.origin), Vec3<T>(identity.u), Vec3<T>(identity.v),
                              Vec3<T>(identity.normal)};
    std::vector<detail::LitMesh<T>> lit;
    for (const Mesh<double>& mesh : meshes) {
        Mesh<T> rounded{{}, mesh.triangles};
        for (const Vec3<double>& p : mesh.positions) rounded.positions.push_back(Vec3<T>(p));
        lit.push_back(detail::lit_mesh(rounded, frame, T(1), tolerance));
    }
    return WedgeIndex<T>(lit, from, tolerance);
}

/// Face by face, in double, from the definition: of solids those that look away from the viewer, of sheets all.
template <class T>
double faces_one_by_one(const std::vector<Mesh<double>>& meshes, const Vec3<double>& point, const Rect2<double>& light,
                        SilhouetteFrom from, double tolerance, bool* unsure) {
    double sum = 0.0;
    for (const Mesh<double>& mesh : meshes) {
        const bool solid = is_closed(edge_adjacency(mesh));
        for (const glm::uvec3& t : mesh.triangles) {
            Vec3<double> v[3];
            for (int k = 0; k < 3; ++k) v[k] = Vec3<double>(Vec3<T>(mesh.positions[t[k]]));  // as T has them
            const Vec3<double> cross = glm::cross(v[1] - v[0], v[2] - v[0]);
            const double size = glm::length(cross);
            if (!(size > 0.0)) continue;
            const double from_point = glm::dot(cross / size, point - v[0]);
            const bool from_light = from == SilhouetteFrom::light_center;
            const double side = from_light ? glm::dot(cross / size, v[0]) : from_point;
            *unsure = *unsure || std::abs(std::abs(from_point) - tolerance) < 0.2 * tolerance ||
                      (from_light && std::abs(side) < 1e-6);
            if (std::abs(from_point) <= tolerance && !from_light) continue;
            const double times = side < 0.0 ? -1.0 : solid ? 0.0 : 1.0;
            if (times != 0.0) sum += times * loop_coverage(v, 3, point, light);
        }
    }
    return sum;
}

Mesh<double> moved(Mesh<double> mesh, const Vec3<double>& scale, const Vec3<double>& by) {
    for (Vec3<double>& p : mesh.positions) p = p * scale + by;
    return mesh;
}

/// Points near each other, as a picture's tile, all in front of the light.
template <class T>
PointTile<T> random_tile(test::Random& random, const Vec2<T>& half_size) {
    PointTile<T> tile;
    const Vec3<double> center(random.in(-4.0, 4.0), random.in(-4.0, 4.0), random.in(0.3, 7.0));
    const double spread = random.whole(0, 3) == 0 ? 3.0 : 0.2;
    const int count = random.whole(0, 2) == 0 ? 1 : random.whole(1, 64);
    for (int i = 0; i < count; ++i) {
        Vec3<double> p = center + random.point(-spread, spread);
        p.z = std::max(p.z, 0.05);
        tile.push(Vec3<T>(p));
    }
    tile.finish(half_size);
    return tile;
}

/// The largest difference between an index and faces one by one, over random tiles; as fractions of the light.
template <class T>
double worst_error(const std::vector<Mesh<double>>& meshes, SilhouetteFrom from, int tiles, std::uint32_t seed) {
    const T tolerance = std::is_same_v<T, float> ? T(1e-5) : T(1e-13);
    const WedgeIndex<T> index = index_of<T>(meshes, from, tolerance);
    test::Random random(seed);
    double worst = 0.0;
    int asked = 0;
    for (int t = 0; t < tiles; ++t) {
        const Vec2<T> half(static_cast<T>(random.in(0.1, 2.0)), static_cast<T>(random.in(0.1, 2.0)));
        const PointTile<T> tile = random_tile<T>(random, half);
        Sums<T> sums{tile};
        index.visit(tile, sums);
        CHECK(!sums.in_mesh);
        const Rect2<double> light{Vec2<double>(tile.light.min), Vec2<double>(tile.light.max)};
        for (std::size_t i = 0; i < tile.count; ++i) {
            bool unsure = false;
            const double truth = faces_one_by_one<T>(meshes, Vec3<double>(tile[i]), light, from,
                                                     static_cast<double>(tolerance), &unsure);
            if (unsure) continue;
            ++asked;
            worst = std::max(worst, std::abs(sums.coverage[i] - truth * area(light)) / area(light));
        }
    }
    CHECK(asked > tiles);
    return worst;
}

std::vector<Mesh<double>> solids() {
    return {moved(test::icosphere<double>(3), Vec3<double>(0.8), {0.2, 0.3, 2.0}),
            test::box_mesh<double>({-1.5, 0.5, 3.0}, {0.5, 0.4, 1.0}),
            moved(test::torus_mesh<double>(24, 12), Vec3<double>(1.2), {1.0, -1.5, 4.0})};
}

}  // namespace

TEST_CASE_TEMPLATE("what an index hands out sums up to what the faces hide, one by one", T, float, double) {
    const double bound = std::is_same_v<T, float> ? 2e-4 : 1e-9;  // casters nearly at the point: see clip.hpp
    for (const SilhouetteFrom from : {SilhouetteFrom::point, SilhouetteFrom::light_center}) {
        CAPTURE(static_cast<int>(from));
        CHECK(worst_error<T>(solids(), from, 150, 1) < bound);
    }
}

TEST_CASE_TEMPLATE("also of open, non-manifold, badly wound and degenerate meshes", T, float, double) {
    const double bound = std::is_same_v<T, float> ? 2e-3 : 1e-8;  // tens of layers add up
    test::Random random(2);
    for (int k = 0; k < 6; ++k) {
        Mesh<double> soup = moved(test::soup<double>(random, 12, 30), Vec3<double>(1.5), {0, 0, 2.2});
        CHECK(worst_error<T>({soup}, SilhouetteFrom::point, 40, static_cast<std::uint32_t>(k)) < bound);
    }
    Mesh<double> open = moved(test::icosphere<double>(2), Vec3<double>(1.0), {0, 0, 2});
    open.triangles.resize(open.triangles.size() / 2);
    CHECK(worst_error<T>({open}, SilhouetteFrom::point, 60, 3) < bound);
}

TEST_CASE_TEMPLATE("a solid around the point hides the light, whatever the tile", T, float, double) {
    const WedgeIndex<T> index =
        index_of<T>({test::box_mesh<double>({0, 0, 3}, {2, 2, 2})}, SilhouetteFrom::point, T(1e-5));
    PointTile<T> tile;
    for (int i = 0; i < 20; ++i) tile.push(Vec3<T>(T(0.01) * static_cast<T>(i), T(0.1), T(3)));
    tile.finish(Vec2<T>(T(0.5), T(0.5)));
    Sums<T> sums{tile};
    index.visit(tile, sums);
    for (std::size_t i = 0; i < tile.count; ++i) CHECK(sums.coverage[i] == doctest::Approx(1.0).epsilon(1e-5));
}

TEST_CASE("solids that the light's plane cuts are closed there; a room around the light does not hide it") {
    const double tolerance = 1e-9;
    const auto coverage = [&](const Mesh<double>& mesh, const Vec3<double>& point) {
        const WedgeIndex<double> index = index_of<double>({mesh}, SilhouetteFrom::point, tolerance);
        PointTile<double> tile;
        tile.push(point);
        tile.finish({1.0, 1.0});
        Sums<double> sums{tile};
        index.visit(tile, sums);
        return sums.coverage[0] / 4.0;
    };
    const Mesh<double> through = test::box_mesh<double>({1.0, 0.0, 0.0}, {1.0, 3.0, 0.5});  // half of the light
    CHECK(coverage(through, {-3.0, 0.0, 1e5}) == doctest::Approx(0.5).epsilon(1e-4));
    Mesh<double> room = test::box_mesh<double>({0.0, 0.0, 0.0}, {5.0, 5.0, 5.0});
    CHECK(coverage(room, {0.5, 0.2, 4.0}) == doctest::Approx(0.0));
    CHECK(coverage(room, {0.5, 0.2, 7.0}) == doctest::Approx(1.0));  // from outside
    for (glm::uvec3& t : room.triangles) std::swap(t.y, t.z);        // wound inwards
    CHECK(coverage(room, {0.5, 0.2, 4.0}) == doctest::Approx(0.0));
    CHECK(coverage(room, {0.5, 0.2, 7.0}) == doctest::Approx(1.0));
}

TEST_CASE("convex solids and single faces are simple, what may lie over itself is not") {
    const auto is_simple = [](const Mesh<double>& mesh) {
        const detail::LitMesh<double> lit = detail::lit_mesh(mesh, identity, 1.0, 1e-9);
        return lit.pieces.size() == 1 && lit.pieces[0].simple;
    };
    CHECK(is_simple(test::box_mesh<double>({0, 0, 3}, {1, 1, 1})));
    CHECK(is_simple(test::box_mesh<double>({0, 3, 0}, {1, 1, 1})));  // cut by the light's plane
    CHECK(is_simple(moved(test::icosphere<double>(3), Vec3<double>(1), {0, 0, 2})));
    CHECK(is_simple({{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}}));
    CHECK(!is_simple(moved(test::torus_mesh<double>(12, 8), Vec3<double>(1), {0, 0, 2})));
    CHECK(!is_simple({{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}}, {{0, 1, 2}, {1, 3, 2}}}));
}

TEST_CASE("pieces that share no edge are told apart; equal places are one vertex") {
    Mesh<double> mesh = test::box_mesh<double>({0, 0, 3}, {1, 1, 1});
    const Mesh<double> other = test::box_mesh<double>({5, 0, 3}, {1, 1, 1});
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + 8U);
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    CHECK(detail::lit_mesh(mesh, identity, 1.0, 1e-9).pieces.size() == 2);
    Mesh<double> unwelded;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(unwelded.positions.size());
        for (int k = 0; k < 3; ++k) unwelded.positions.push_back(mesh.positions[t[k]]);
        unwelded.triangles.emplace_back(first, first + 1, first + 2);
    }
    const detail::LitMesh<double> lit = detail::lit_mesh(unwelded, identity, 1.0, 1e-9);
    REQUIRE(lit.pieces.size() == 2);
    CHECK((lit.pieces[0].solid && lit.pieces[1].solid));
}

namespace {

/// A prism whose rim is a polygon of 16 corners and whose caps are n × n quads inside it.
Mesh<double> prism(int n) {
    Mesh<double> mesh;
    constexpr int rim = 16;
    for (const double depth : {2.0, 2.5}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < rim; ++k)
            mesh.positions.emplace_back(2.0 * std::cos(2.0 * pi<double> * k / rim),
                                        2.0 * std::sin(2.0 * pi<double> * k / rim), depth);
        // rings towards the middle, each of `rim` vertices
        for (int r = 1; r < n; ++r)
            for (int k = 0; k < rim; ++k)
                mesh.positions.push_back(mesh.positions[first + static_cast<std::uint32_t>(k)] *
                                             Vec3<double>(1.0 - double(r) / n, 1.0 - double(r) / n, 0.0) +
                                         Vec3<double>(0, 0, depth));
        mesh.positions.emplace_back(0.0, 0.0, depth);
        const bool up = depth > 2.2;
        const auto push = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh.triangles.emplace_back(a, up ? b : c, up ? c : b);
        };
        const auto middle = static_cast<std::uint32_t>(mesh.positions.size() - 1);
        for (std::uint32_t k = 0; k < rim; ++k) {
            const std::uint32_t next = (k + 1) % rim;
            for (std::uint32_t r = 0; r + 1 < static_cast<std::uint32_t>(n); ++r) {
                const std::uint32_t a = first + r * rim, b = a + rim;
                push(a + k, a + next, b + k), push(a + next, b + next, b + k);
            }
            const std::uint32_t last = first + static_cast<std::uint32_t>(n - 1) * rim;
            push(last + k, last + next, middle);
        }
    }
    const auto half = static_cast<std::uint32_t>(mesh.positions.size() / 2);
    for (std::uint32_t k = 0; k < rim; ++k) {
        const std::uint32_t next = (k + 1) % rim;
        mesh.triangles.emplace_back(k, next, half + k), mesh.triangles.emplace_back(next, half + next, half + k);
    }
    return mesh;
}

}  // namespace

TEST_CASE("edges handed out depend on the silhouette, not on the mesh") {
    std::size_t edges[2] = {0, 0};
    int i = 0;
    for (const int rings : {4, 400}) {
        const Mesh<double> mesh = prism(rings);
        REQUIRE(is_closed(edge_adjacency(mesh)));
        const WedgeIndex<float> index = index_of<float>({mesh}, SilhouetteFrom::point, 1e-5F);
        test::Random random(9);
        for (int t = 0; t < 100; ++t) {
            PointTile<float> tile;
            tile.push(Vec3<float>(random.in(-3.0F, 3.0F), random.in(-3.0F, 3.0F), random.in(4.0F, 6.0F)));
            tile.finish(Vec2<float>(0.7F, 0.7F));
            Sums<float> sums{tile};
            index.visit(tile, sums);
            edges[i] += sums.edges_handed;
        }
        ++i;
    }
    CHECK(edges[0] > 0);
    CHECK(edges[1] <= edges[0]);  // fewer: leaves of small faces are cut to the pyramid more closely
}

TEST_CASE("casters beside the pyramid, or beyond the point, are not even visited") {
    std::vector<Mesh<double>> meshes;
    for (int i = 0; i < 100; ++i)
        meshes.push_back(test::box_mesh<double>({i % 10 * 2.0 - 9.0, i / 10 * 2.0 - 9.0, 3.0}, {0.5, 0.5, 0.5}));
    const WedgeIndex<float> index = index_of<float>(meshes, SilhouetteFrom::point, 1e-5F);
    const auto visited = [&](const Vec3<float>& point) {
        PointTile<float> tile;
        tile.push(point);
        tile.finish(Vec2<float>(0.3F, 0.3F));
        Sums<float> sums{tile};
        index.visit(tile, sums);
        return sums.meshes;
    };
    CHECK(visited({1.0F, 1.0F, 6.0F}) <= 4);
    CHECK(visited({1.0F, 1.0F, 6.0F}) >= 1);
    CHECK(visited({1.0F, 1.0F, 2.0F}) == 0);
    CHECK(visited({40.0F, 1.0F, 6.0F}) == 0);
}
