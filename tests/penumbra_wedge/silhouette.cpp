#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <penumbra/penumbra_wedge/clip.hpp>
#include <penumbra/penumbra_wedge/coverage.hpp>
#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <set>
#include <utility>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/polygon_union.hpp"
#include "../support/random.hpp"
#include "../support/solids.hpp"

using namespace penumbra;

namespace {

template <class T>
std::vector<SilhouetteEdge> seen(const Mesh<T>& mesh, const Vec3<T>& viewpoint,
                                 SilhouetteFrom from = SilhouetteFrom::point) {
    return silhouette(mesh, edge_adjacency(mesh), viewpoint, from);
}

/// As many edges end at each vertex as begin there; each edge is there once, and of the mesh.
template <class T>
bool is_balanced(const Mesh<T>& mesh, const std::vector<SilhouetteEdge>& edges) {
    std::map<std::uint32_t, int> balance;
    std::set<std::pair<std::uint32_t, std::uint32_t>> once, sides;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) sides.insert(std::minmax(t[k], t[(k + 1) % 3]));
    bool good = true;
    for (const SilhouetteEdge& e : edges) {
        balance[e.from] += e.count, balance[e.to] -= e.count;
        const auto edge = std::minmax(e.from, e.to);
        good = good && e.count > 0 && e.from != e.to && sides.count(edge) == 1 && once.insert(edge).second;
    }
    for (const auto& vertex : balance) good = good && vertex.second == 0;
    return good;
}

/// The number of loops if every vertex has one way in and out; 0 if one has more.
int loops(const std::vector<SilhouetteEdge>& edges) {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const SilhouetteEdge& e : edges)
        if (e.count != 1 || !next.insert({e.from, e.to}).second) return 0;
    int count = 0;
    for (; !next.empty(); ++count)
        for (auto at = next.begin(); at != next.end();) {
            const std::uint32_t to = at->second;
            next.erase(at);
            at = next.find(to);
        }
    return count;
}

/// The points that tests ask from: all around, near, far, and on the mesh.
template <class T>
std::vector<Vec3<T>> viewpoints(const Mesh<T>& mesh, test::Random& random) {
    std::vector<Vec3<T>> points;
    for (const T size : {T(0.5), T(2), T(1e6)})
        for (int k = 0; k < 4; ++k) points.push_back(random.point(-size, size));
    points.push_back(Vec3<T>(T(0), T(0), T(0)));
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<T>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        points.insert(points.end(), {a, (a + b) * T(0.5), (a + b + c) / T(3), c + (c - a)});
        if (points.size() > 60) break;
    }
    return points;
}

/// The share of the box, winding counted, that a silhouette in light space hides from the point.
template <class T>
double coverage(const Mesh<T>& mesh, const std::vector<SilhouetteEdge>& edges, const Vec3<T>& point,
                const Rect2<T>& box) {
    T sum = T(0);
    for (const SilhouetteEdge& e : edges) {
        const ProjectedEdge<T> p = project_edge(mesh.positions[e.from], mesh.positions[e.to], point, box);
        if (p.lands) sum += static_cast<T>(e.count) * edge_coverage(p.a, p.b, box);
    }
    return static_cast<double>(sum / area(box));
}

/// Where each triangle lands, exactly; the mesh lies between the light's plane and the point's depth.
template <class T>
std::vector<test::Polygon2> landed(const Mesh<T>& mesh, const Vec3<T>& point) {
    const glm::dvec3 p(point);
    std::vector<test::Polygon2> result;
    for (const glm::uvec3& t : mesh.triangles) {
        test::Polygon2 polygon;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 v(mesh.positions[t[k]]);
            polygon.push_back(glm::dvec2(p) + glm::dvec2(v - p) * (p.z / (p.z - v.z)));
        }
        result.push_back(polygon);
    }
    return result;
}

/// A light, and points that see it past what is between depths 0.5 and 3.5.
template <class T>
Vec3<T> any_point(test::Random& random) {
    const Vec3<T> p = random.point(T(-3), T(3));
    return Vec3<T>(p.x, p.y, T(5) + p.z * T(0.3));
}
template <class T>
Vec3<T> any_center(test::Random& random) {
    return random.point(T(-0.8), T(0.8)) + Vec3<T>(T(0), T(0), T(2));
}
const Rect2<double> light{{-1.0, -0.7}, {1.0, 0.7}};
template <class T>
const Rect2<T> box{Vec2<T>(T(-1), T(-0.7)), Vec2<T>(T(1), T(0.7))};
/// Coordinates of some 6 box sizes, projected; and faces within the tolerance of being edge-on, which may be left out.
template <class T>
const double rounding = 100.0 * static_cast<double>(std::numeric_limits<T>::epsilon());

}  // namespace

TEST_CASE_TEMPLATE("as many silhouette edges end at a vertex as begin there, whatever the mesh", T, float, double) {
    test::Random random(1);
    std::vector<Mesh<T>> meshes{{},
                                test::tetrahedron_mesh<T>(),
                                test::box_mesh(Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(1), T(1))),
                                test::icosphere<T>(2),
                                test::torus_mesh<T>(12, 8)};
    for (std::size_t i = 1; i < 5; ++i) {
        Mesh<T> open = meshes[i], turned = meshes[i], doubled = meshes[i], flat = meshes[i], fins = meshes[i];
        open.triangles.resize(open.triangles.size() / 2);
        for (std::size_t f = 0; f < turned.triangles.size(); f += 3)
            std::swap(turned.triangles[f].x, turned.triangles[f].y);
        for (const glm::uvec3& t : meshes[i].triangles) {  // every face again, half of them the other way round
            doubled.triangles.push_back(t);
            if (t.x % 2 == 0) std::swap(doubled.triangles.back().x, doubled.triangles.back().y);
        }
        for (std::size_t v = 1; v < flat.positions.size(); v += 2) flat.positions[v] = flat.positions[v - 1];
        for (std::uint32_t k = 0; k < 3; ++k)  // edges of three and four faces
            fins.triangles.emplace_back(k, k + 1, fins.positions.size() - 1), fins.triangles.emplace_back(k + 1, k, k);
        for (const Mesh<T>& mesh : {open, turned, doubled, flat, fins}) meshes.push_back(mesh);
    }
    // A Möbius strip, and faces without area alone.
    meshes.push_back({test::icosphere<T>(0).positions, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}}});
    meshes.push_back(
        {std::vector<Vec3<T>>(4, Vec3<T>(T(1), T(2), T(3))), {{0, 1, 2}, {1, 2, 3}, {2, 2, 3}, {3, 3, 3}}});
    meshes.push_back({{Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(3), T(0), T(0))}, {{0, 1, 2}}});
    for (int k = 0; k < 100; ++k) {
        const int vertices = random.whole(1, 12), triangles = random.whole(0, 40);
        meshes.push_back(test::soup<T>(random, vertices, triangles));
    }
    int edges = 0, multiple = 0;
    for (const Mesh<T>& mesh : meshes) {
        const EdgeAdjacency adjacency = edge_adjacency(mesh);
        for (const Vec3<T>& viewpoint : viewpoints(mesh, random))
            for (const SilhouetteFrom from : {SilhouetteFrom::point, SilhouetteFrom::light_center})
                for (const T tolerance : {T(0), T(1e-3), T(0.3), T(1e9)}) {
                    const auto result = silhouette(mesh, adjacency, viewpoint, tolerance, from);
                    CHECK(is_balanced(mesh, result));
                    CHECK((tolerance < T(1e9) || result.empty()));
                    for (const SilhouetteEdge& e : result) ++edges, multiple += e.count > 1;
                }
    }
    CHECK(edges > 100000);
    CHECK(multiple > 1000);
}

TEST_CASE_TEMPLATE("a convex mesh's silhouette covers what the mesh hides", T, float, double) {
    test::Random random(2);
    const std::vector<Mesh<T>> meshes{test::tetrahedron_mesh<T>(), test::icosphere<T>(0), test::icosphere<T>(1),
                                      test::box_mesh(Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0.6), T(0.2)))};
    double worst = 0;
    int partial = 0;
    for (int round = 0; round < 400; ++round) {
        const std::size_t kind = static_cast<std::size_t>(random.whole(0, 3));
        const T size = random.in(T(0.1), T(0.4));
        const Mesh<T> mesh = test::placed(meshes[kind], random, size, any_center<T>(random));
        const Vec3<T> point = any_point<T>(random);
        const auto edges = seen(mesh, point);
        CHECK(loops(edges) == 1);
        const double truth = test::union_area(landed(mesh, point), light) / area(light);  // of all faces
        const double found = coverage(mesh, edges, point, box<T>);
        worst = std::max(worst, std::abs(found - truth));
        partial += truth > 0.01 && truth < 0.99;
        CAPTURE(round);
        CAPTURE(truth);
        CHECK(std::abs(found - truth) <= rounding<T>);
    }
    CHECK(partial > 100);
    MESSAGE("worst " << worst);
}

TEST_CASE_TEMPLATE("any mesh's silhouette covers the sum of the faces that hide, each in full", T, float, double) {
    test::Random random(3);
    double worst = 0;
    int layered = 0;
    for (int round = 0; round < 400; ++round) {
        Mesh<T> mesh = round % 4 == 0 ? test::torus_mesh<T>(10, 6) : test::soup<T>(random, 12, round % 4 * 4);
        if (round % 8 == 4) mesh.triangles.push_back(mesh.triangles[0]);  // not a solid any more
        const T size = random.in(T(0.2), T(0.6));
        mesh = test::placed(mesh, random, size, any_center<T>(random));
        const Vec3<T> point = any_point<T>(random);
        const EdgeAdjacency adjacency = edge_adjacency(mesh);
        CHECK(surface_of(adjacency) == (round % 8 == 0 ? Surface::solid : Surface::sheet));
        double truth = 0;
        for (const test::Polygon2& face : landed(mesh, point)) {
            // faces that look at the point land counter-clockwise
            const double winding = test::winding_area(face, light) / area(light);
            truth += surface_of(adjacency) == Surface::sheet ? std::abs(winding) : std::max(-winding, 0.0);
        }
        const double found = coverage(mesh, silhouette(mesh, adjacency, point), point, box<T>);
        worst = std::max(worst, std::abs(found - truth));
        layered += truth > test::union_area(landed(mesh, point), light) / area(light) + 0.05;
        CAPTURE(round);
        CAPTURE(truth);
        CHECK(std::abs(found - truth) <= 4 * rounding<T>);  // up to 60 faces, in some 5 layers
    }
    CHECK(layered > 30);
    MESSAGE("worst " << worst);
}

TEST_CASE_TEMPLATE("seen from the light, loops run so that points behind the mesh get positive coverage", T, float,
                   double) {
    test::Random random(4);
    const Vec3<T> center(T(0), T(0), T(0));
    for (int round = 0; round < 100; ++round) {
        // across the light's axis, and so thin that both see it the same way
        Mesh<T> flat = test::box_mesh(any_center<T>(random), Vec3<T>(T(0.5), T(0.3), T(1e-4)));
        const T slope = random.in(T(-0.2), T(0.2));
        for (Vec3<T>& p : flat.positions) p.z += slope * p.x;
        const Vec3<T> point = any_point<T>(random);
        const auto from_light = seen(flat, center, SilhouetteFrom::light_center), from_point = seen(flat, point);
        CAPTURE(round);
        CHECK(loops(from_light) == 1);
        CHECK(std::abs(coverage(flat, from_light, point, box<T>) - coverage(flat, from_point, point, box<T>)) < 2e-3);
        // the same faces for both: only the orientation differs
        auto reversed = seen(flat, center, SilhouetteFrom::point);
        REQUIRE(reversed.size() == from_light.size());
        for (std::size_t i = 0; i < reversed.size(); ++i) {
            CHECK(reversed[i].from == from_light[i].to);
            CHECK(reversed[i].to == from_light[i].from);
        }
    }
}

TEST_CASE_TEMPLATE("known solids have known silhouettes", T, float, double) {
    const auto count = [](const Mesh<T>& mesh, T x, T y, T z) {
        const auto edges = seen(mesh, Vec3<T>(x, y, z));
        CHECK(loops(edges) == (edges.empty() ? 0 : 1));
        return edges.size();
    };
    const Mesh<T> cube = test::box_mesh(Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(1), T(1)));
    CHECK(count(cube, T(0.3), T(-0.2), T(5)) == 4);  // one face in view
    CHECK(count(cube, T(3), T(0.1), T(5)) == 6);     // two
    CHECK(count(cube, T(3), T(4), T(5)) == 6);       // three
    CHECK(count(cube, T(3e6), T(4e6), T(5e6)) == 6);
    CHECK(count(cube, T(0.2), T(-0.4), T(1)) == 4);  // on a face: as seen from outside that face alone
    CHECK(count(cube, T(1), T(0.5), T(1)) == 6);     // on an edge
    CHECK(count(cube, T(1), T(1), T(1)) == 6);       // on a vertex
    CHECK(count(cube, T(1), T(7), T(0)) == 6);       // in a face's plane, beside it: as if in view
    CHECK(count(cube, T(0.99), T(7), T(0)) == 4);
    CHECK(count(cube, T(0.2), T(0.4), T(-0.3)) == 0);
    const Mesh<T> tetrahedron = test::tetrahedron_mesh<T>();
    CHECK(count(tetrahedron, T(9), T(9), T(8)) == 3);      // three faces in view
    CHECK(count(tetrahedron, T(9), T(0.1), T(0.2)) == 4);  // two
    CHECK(count(tetrahedron, T(-9), T(-9), T(-8)) == 3);   // one
    CHECK(count(tetrahedron, T(1), T(1), T(1)) == 3);
    CHECK(count(tetrahedron, T(0), T(0), T(0)) == 0);
    const Mesh<T> icosahedron = test::icosphere<T>(0);
    CHECK(count(icosahedron, T(0), T(0), T(1.1)) == 5);  // five faces around a vertex in view
    CHECK(count(icosahedron, T(0), T(0), T(99)) == 10);  // ten, a zigzag around them
    const Mesh<T> triangle{{Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0))},
                           {{0, 1, 2}}};
    CHECK(count(triangle, T(0), T(0), T(1)) == 3);
    CHECK(count(triangle, T(0), T(0), T(-1)) == 3);
    CHECK(count(triangle, T(0.2), T(0.2), T(0)) == 0);
    CHECK(count(triangle, T(5), T(9), T(0)) == 0);
    CHECK(seen(triangle, Vec3<T>(T(0), T(0), T(1)))[0].from == 0);  // counter-clockwise from both sides
    CHECK(seen(triangle, Vec3<T>(T(0), T(0), T(-1)))[0].from == 1);
}

TEST_CASE_TEMPLATE("a sphere's silhouette is the border between what looks away and what does not", T, float, double) {
    test::Random random(5);
    const Mesh<T> sphere = test::icosphere<T>(4);
    const long double tolerance = 2 * static_cast<long double>(silhouette_tolerance(bounds(sphere)));
    int clear = 0;
    for (int round = 0; round < 60; ++round) {
        const T distance = std::exp2(random.in(T(0.5), T(10)));
        const Vec3<T> point = distance * normalize_or(random.point(T(-1), T(1)), sphere.positions[0]);
        // in long double, face by face
        std::vector<bool> away;
        bool edge_on = false;
        for (const glm::uvec3& t : sphere.triangles) {
            using Exact = Vec3<long double>;
            const Exact a(sphere.positions[t.x]), b(sphere.positions[t.y]), c(sphere.positions[t.z]);
            const Exact normal = glm::cross(b - a, c - a);
            const long double above = glm::dot(normal, Exact(point) - a) / glm::length(normal);
            away.push_back(above < 0);
            edge_on = edge_on || std::abs(above) < tolerance * static_cast<long double>(distance);
        }
        if (edge_on) continue;  // either answer is right
        ++clear;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
        for (std::size_t f = 0; f < sphere.triangles.size(); ++f)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t from = sphere.triangles[f][k], to = sphere.triangles[f][(k + 1) % 3];
                sides[std::minmax(from, to)] += !away[f] ? 0 : from < to ? -1 : 1;
            }
        std::set<std::pair<std::uint32_t, std::uint32_t>> truth, found;
        for (const auto& [edge, winding] : sides) {
            if (winding > 0) truth.insert(edge);
            if (winding < 0) truth.insert({edge.second, edge.first});
        }
        const auto edges = seen(sphere, point);
        for (const SilhouetteEdge& e : edges) found.insert({e.from, e.to});
        CHECK(found == truth);
        CHECK(loops(edges) == 1);
        Mesh<T> scaled = sphere;
        for (Vec3<T>& p : scaled.positions) p *= T(1024);
        CHECK(seen(scaled, point * T(1024)).size() == edges.size());
    }
    CHECK(clear > 20);
}

TEST_CASE_TEMPLATE("points computed on a face lie on it, at any distance from the origin", T, float, double) {
    test::Random random(6);
    double worst = 0;
    for (int round = 0; round < 20000; ++round) {
        const T away = round % 2 == 0 ? T(0) : std::exp2(random.in(T(0), T(10)));
        const Mesh<T> any = round % 3 == 0 ? test::icosphere<T>(0) : test::soup<T>(random, 20, 20);
        const Mesh<T> mesh = test::placed(any, random, T(1), away * random.point(T(-1), T(1)));
        const T tolerance = silhouette_tolerance(bounds(mesh));
        const glm::uvec3& t = mesh.triangles[static_cast<std::size_t>(random.whole(0, 19))];
        const Vec3<T>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        T u = random.in(T(0), T(1)), v = random.in(T(0), T(1));
        if (u + v > T(1)) u = T(1) - u, v = T(1) - v;
        const Vec3<T> point = round % 4 < 2 ? a + u * (b - a) + v * (c - a) : a * (T(1) - u - v) + u * b + v * c;
        const Vec3<T> normal = face_normal(a, b, c);
        if (normal == Vec3<T>(T(0), T(0), T(0))) continue;
        const T distance = glm::dot(normal, point - a);
        worst = std::max(worst, static_cast<double>(std::abs(distance) / tolerance));
        for (const Surface surface : {Surface::solid, Surface::sheet}) {
            CHECK(face_winding(normal, a, point, tolerance, surface) == 0);
            CHECK(face_winding(normal, a, point + normal * (T(4) * tolerance), tolerance, surface) ==
                  (surface == Surface::solid ? 0 : 1));
            CHECK(face_winding(normal, a, point - normal * (T(4) * tolerance), tolerance, surface) == -1);
        }
    }
    CHECK(worst > 0.1);  // the tolerance is not much larger than it needs to be
    MESSAGE("worst " << worst);
    CHECK(silhouette_tolerance(empty_box<T>()) == T(0));
}

TEST_CASE_TEMPLATE("a face's normal is of unit length at any size, and 0 only without area", T, float, double) {
    test::Random random(7);
    const Vec3<T> zero(T(0), T(0), T(0));
    double worst = 0;
    for (int round = 0; round < 100000; ++round) {
        const Vec3<T> a = random.point(T(-1), T(1)), b = random.point(T(-1), T(1)), c = random.point(T(-1), T(1));
        const Vec3<T> n = face_normal(a, b, c);
        const Vec3<long double> ab(Vec3<long double>(b) - Vec3<long double>(a)),
            ac(Vec3<long double>(c) - Vec3<long double>(a)), cross = glm::cross(ab, ac);
        const long double area = glm::length(cross), sharp = glm::length(ab) * glm::length(ac) / area;
        const long double error = glm::length(Vec3<long double>(n) - cross / area) / sharp;
        worst = std::max(worst, static_cast<double>(error) / static_cast<double>(std::numeric_limits<T>::epsilon()));
        const T scale = exp2_int<T>(random.whole(-60, 60));
        CHECK(face_normal(a * scale, b * scale, c * scale) == n);
    }
    CHECK(worst <= 2.0);
    MESSAGE("worst " << worst << " epsilon");
    CHECK(face_normal(zero, zero, zero) == zero);
    CHECK(face_normal(zero, Vec3<T>(T(1), T(2), T(3)), Vec3<T>(T(2), T(4), T(6))) == zero);
    CHECK(face_normal(zero, Vec3<T>(T(1e18), T(0), T(0)), Vec3<T>(T(0), T(-1e-18), T(0))) ==
          Vec3<T>(T(0), T(0), T(-1)));
    CHECK(face_normal(zero, Vec3<T>(T(1e-30), T(0), T(0)), Vec3<T>(T(0), T(1e-30), T(0))) == Vec3<T>(T(0), T(0), T(1)));
}
