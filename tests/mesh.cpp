#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <penumbra/mesh.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/error_of.hpp"
#include "support/random.hpp"

using namespace penumbra;
using penumbra::test::error_of;

namespace {

template <class T>
Mesh<T> tetrahedron() {
    return {
        {Vec3<T>(T(0), T(0), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(1), T(0)), Vec3<T>(T(0), T(0), T(1))},
        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

}  // namespace

TEST_CASE_TEMPLATE("what is wrong with a mesh is told by name, place and value", T, float, double) {
    Mesh<T> mesh = tetrahedron<T>();
    CHECK(validate(mesh));
    CHECK(validate(Mesh<T>()));
    CHECK(validate(std::vector<Mesh<T>>{}));
    mesh.triangles.push_back({0, 4, 1});
    CHECK(error_of([&] { validate(mesh); }) == "penumbra: mesh.triangles[4] uses index 4, but there are 4 positions");
    CHECK(error_of([&] {
              validate(std::vector<Mesh<T>>{tetrahedron<T>(), mesh});
          }) == "penumbra: casters[1].triangles[4] uses index 4, but there are 4 positions");
    CHECK(error_of([] {
              validate(Mesh<T>{{}, {{0, 0xffffffffU, 0}}});
          }) == "penumbra: mesh.triangles[0] uses index 4294967295, but there are 0 positions");
    mesh = tetrahedron<T>();
    mesh.positions[0] = Vec3<T>(std::numeric_limits<T>::max(), -std::numeric_limits<T>::max(), T(0));
    CHECK(validate(mesh));  // large, but finite
    mesh = tetrahedron<T>();
    mesh.positions[2].y = std::numeric_limits<T>::infinity();
    CHECK(error_of([&] { validate(mesh, "bunny"); }) == "penumbra: bunny.positions[2] = (0, inf, 0) is not finite");
    mesh.positions[2].y = std::numeric_limits<T>::quiet_NaN();
    CHECK(error_of([&] { validate(mesh); }).find("mesh.positions[2]") != std::string::npos);
}

TEST_CASE_TEMPLATE("bounds hold the vertices that triangles use, and no others", T, float, double) {
    Mesh<T> mesh = tetrahedron<T>();
    mesh.positions.push_back(Vec3<T>(T(99), T(99), T(99)));
    CHECK(bounds(mesh).min == Vec3<T>(T(0), T(0), T(0)));
    CHECK(bounds(mesh).max == Vec3<T>(T(1), T(1), T(1)));
    CHECK(is_empty(bounds(Mesh<T>())));
    CHECK(is_empty(bounds(std::vector<Mesh<T>>{Mesh<T>(), Mesh<T>()})));
    Mesh<T> moved = tetrahedron<T>();
    for (Vec3<T>& p : moved.positions) p -= Vec3<T>(T(3), T(0), T(0));
    const Box3<T> both = bounds(std::vector<Mesh<T>>{mesh, Mesh<T>(), moved});
    CHECK(both.min == Vec3<T>(T(-3), T(0), T(0)));
    CHECK(both.max == Vec3<T>(T(1), T(1), T(1)));
}

TEST_CASE("adjacency of any triangles is what a map of sides says") {
    // random indices: borders, edges of many faces, duplicates, sides of no length, either winding
    test::Random random(1);
    for (int round = 0; round < 200; ++round) {
        Mesh<float> mesh;
        const int points = random.whole(1, 12), faces = random.whole(0, 40);
        mesh.positions.resize(static_cast<std::size_t>(points));
        for (int f = 0; f < faces; ++f) {
            const auto index = [&] { return static_cast<unsigned>(random.whole(0, points - 1)); };
            const unsigned a = index(), b = index(), c = index();
            mesh.triangles.emplace_back(a, b, c);
        }
        std::map<std::pair<unsigned, unsigned>, std::multiset<std::pair<unsigned, bool>>> truth;
        for (unsigned f = 0; f < mesh.triangles.size(); ++f)
            for (int k = 0; k < 3; ++k) {
                const unsigned from = mesh.triangles[f][k], to = mesh.triangles[f][(k + 1) % 3];
                if (from != to) truth[std::minmax(from, to)].insert({f, from < to});
            }
        const EdgeAdjacency adjacency = edge_adjacency(mesh);
        REQUIRE(adjacency.edges.size() == truth.size());
        auto expected = truth.begin();
        std::uint32_t first = 0;
        bool balanced = true;
        for (const Edge& edge : adjacency.edges) {
            CHECK(std::make_pair(edge.a, edge.b) == std::make_pair(expected->first.first, expected->first.second));
            CHECK(edge.first == first);
            std::multiset<std::pair<unsigned, bool>> found;
            for (std::uint32_t i = 0; i < edge.count; ++i)
                found.insert({adjacency.faces[first + i].face, adjacency.faces[first + i].forward});
            CHECK(found == expected->second);
            const auto forward = std::count_if(found.begin(), found.end(), [](const auto& f) { return f.second; });
            balanced = balanced && 2 * forward == static_cast<std::ptrdiff_t>(found.size());
            first += edge.count;
            ++expected;
        }
        CHECK(adjacency.faces.size() == first);
        CHECK(is_closed(adjacency) == balanced);
    }
}

TEST_CASE("closed: solids and what is glued of them; not: borders, turned faces, doubled faces") {
    const auto closed = [](const Mesh<float>& mesh) { return is_closed(edge_adjacency(mesh)); };
    const Mesh<float> solid = tetrahedron<float>();
    CHECK(closed(solid));
    CHECK(closed(Mesh<float>()));

    Mesh<float> mesh = solid;
    mesh.triangles.pop_back();
    CHECK(!closed(mesh));  // a border
    mesh = solid;
    std::swap(mesh.triangles[1].x, mesh.triangles[1].y);
    CHECK(!closed(mesh));  // one face wound the other way
    mesh = solid;
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    CHECK(closed(mesh));  // inside out, but consistently
    mesh = solid;
    mesh.triangles.push_back(mesh.triangles[0]);
    CHECK(!closed(mesh));  // one face twice
    std::swap(mesh.triangles.back().x, mesh.triangles.back().y);
    mesh.triangles.push_back(mesh.triangles[0]);
    CHECK(closed(mesh));  // both its sides once more: a solid, and a sheet of two sides
    mesh = solid;
    mesh.positions.push_back(mesh.positions[0]);
    mesh.triangles[3].x = 4;
    CHECK(!closed(mesh));  // the same spot under another index
    mesh = Mesh<float>{std::vector<Vec3<float>>(5), {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}}};
    CHECK(!closed(mesh));  // a Möbius strip
    mesh = solid;
    mesh.triangles.emplace_back(2, 2, 2), mesh.triangles.emplace_back(1, 2, 1);
    CHECK(closed(mesh));  // faces without area add nothing
    mesh = solid;         // a second solid on an edge of the first: four faces there
    mesh.positions.emplace_back(-1.0F, -1.0F, -1.0F), mesh.positions.emplace_back(-1.0F, -1.0F, -2.0F);
    for (const glm::uvec3& t : {glm::uvec3(0, 4, 1), glm::uvec3(0, 1, 5), glm::uvec3(1, 4, 5), glm::uvec3(0, 5, 4)})
        mesh.triangles.push_back(t);
    CHECK(closed(mesh));
}

TEST_CASE_TEMPLATE("welding joins vertices of equal coordinates, and nothing else", T, float, double) {
    test::Random random(2);
    for (int round = 0; round < 200; ++round) {
        // few different coordinates, so that many vertices coincide; 0 and −0 are the same place
        Mesh<T> mesh;
        const int points = random.whole(1, 60);
        const auto coordinate = [&] {
            return std::array<T, 4>{T(0), -T(0), T(1),
                                    std::nextafter(T(1), T(2))}[static_cast<std::size_t>(random.whole(0, 3))];
        };
        for (int i = 0; i < points; ++i) {
            const T x = coordinate(), y = coordinate(), z = coordinate();
            mesh.positions.push_back(Vec3<T>(x, y, z));
        }
        for (int f = 0; f < 20; ++f) {
            const auto index = [&] { return static_cast<unsigned>(random.whole(0, points - 1)); };
            const unsigned a = index(), b = index(), c = index();
            mesh.triangles.emplace_back(a, b, c);
        }
        const Mesh<T> welded = weld(mesh);
        std::vector<Vec3<T>> truth;  // in order of first appearance, each searched for among all before it
        for (const Vec3<T>& p : mesh.positions)
            if (std::find(truth.begin(), truth.end(), p) == truth.end()) truth.push_back(p);
        CHECK(welded.positions == truth);
        REQUIRE(welded.triangles.size() == mesh.triangles.size());
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
            for (int k = 0; k < 3; ++k)
                CHECK(welded.positions.at(welded.triangles[f][k]) == mesh.positions[mesh.triangles[f][k]]);
        CHECK(weld(welded).positions == welded.positions);
        CHECK(weld(welded).triangles == welded.triangles);
    }
    CHECK(weld(Mesh<T>()).positions.empty());
    // A solid whose faces come with vertices of their own is closed once it is welded.
    const Mesh<T> solid = tetrahedron<T>();
    Mesh<T> apart;
    for (const glm::uvec3& t : solid.triangles) {
        const auto first = static_cast<unsigned>(apart.positions.size());
        for (int k = 0; k < 3; ++k) apart.positions.push_back(solid.positions[t[k]]);
        apart.triangles.emplace_back(first, first + 1, first + 2);
    }
    CHECK(!is_closed(edge_adjacency(apart)));
    CHECK(weld(apart).positions.size() == 4);
    CHECK(is_closed(edge_adjacency(weld(apart))));
}
