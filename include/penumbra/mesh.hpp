// Triangle meshes: the type, its check, its bounds, and which faces meet at which edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <penumbra/detail/error.hpp>
#include <penumbra/geometry.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// An indexed triangle mesh in world space. One mesh is one object. Faces are counter-clockwise seen from
/// outside, where a method asks for sides at all. Empty meshes and zero-area faces are allowed.
template <class T>
struct Mesh {
    std::vector<Vec3<T>> positions;
    std::vector<glm::uvec3> triangles;
};

/// Reports (see detail/error.hpp) the first position that is not finite or index out of range. True if there
/// is none. `name` is what the message calls the mesh.
template <class T>
bool validate(const Mesh<T>& mesh, const std::string& name = "mesh") {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3<T>& p = mesh.positions[i];
        if (!is_finite(p)) {
            detail::fail(name + ".positions[" + std::to_string(i) + "] = " + detail::text(p) + " is not finite");
            return false;
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const std::uint32_t largest = std::max({t.x, t.y, t.z});
        if (largest >= mesh.positions.size()) {
            detail::fail(name + ".triangles[" + std::to_string(i) + "] uses index " + std::to_string(largest) +
                         ", but there are " + std::to_string(mesh.positions.size()) + " positions");
            return false;
        }
    }
    return true;
}

/// Validates every mesh of a list, named casters[0], casters[1], …
template <class T>
bool validate(const std::vector<Mesh<T>>& casters) {
    for (std::size_t i = 0; i < casters.size(); ++i)
        if (!validate(casters[i], "casters[" + std::to_string(i) + "]")) return false;
    return true;
}

/// The smallest box around the vertices that triangles use; empty_box() if there are none.
template <class T>
Box3<T> bounds(const Mesh<T>& mesh) {
    Box3<T> box = empty_box<T>();
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) box = extend(box, mesh.positions[t[k]]);
    return box;
}

/// The smallest box around all meshes of a list.
template <class T>
Box3<T> bounds(const std::vector<Mesh<T>>& meshes) {
    Box3<T> box = empty_box<T>();
    for (const Mesh<T>& mesh : meshes) {
        const Box3<T> part = bounds(mesh);
        if (!is_empty(part)) box = extend(extend(box, part.min), part.max);
    }
    return box;
}

/// The mesh with every position once: vertices whose coordinates are all equal (0 and −0 are) become one, the first of
/// them, and what no triangle uses is kept. Triangles keep their number and order; those whose corners fall together
/// lose their area. For a valid mesh. O(n log n), deterministic.
template <class T>
Mesh<T> weld(const Mesh<T>& mesh) {
    const std::vector<Vec3<T>>& all = mesh.positions;
    std::vector<std::uint32_t> order(all.size()), index(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
        const Vec3<T>&a = all[i], &b = all[k];
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z != b.z ? a.z < b.z : i < k;
    });
    for (std::size_t i = 0; i < order.size(); ++i)  // the first vertex at each vertex's place
        index[order[i]] = i > 0 && all[order[i]] == all[order[i - 1]] ? index[order[i - 1]] : order[i];
    Mesh<T> result;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool first = index[i] == i;  // else it comes after its first, whose index is new already
        if (first) result.positions.push_back(all[i]);
        index[i] = first ? static_cast<std::uint32_t>(result.positions.size() - 1) : index[index[i]];
    }
    result.triangles.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) result.triangles.emplace_back(index[t.x], index[t.y], index[t.z]);
    return result;
}

/// An undirected edge a < b and the slice [first, first + count) of EdgeAdjacency::faces that meet at it.
struct Edge {
    std::uint32_t a, b;
    std::uint32_t first, count;
};

/// A face at an edge; `forward` if the face runs along it from a to b.
struct EdgeFace {
    std::uint32_t face;
    bool forward;
};

/// Every edge of a mesh once, ordered by (a, b), with all faces that meet there: one on a border, two on a
/// manifold, any number elsewhere. Sides of zero length (equal indices) are left out.
struct EdgeAdjacency {
    std::vector<Edge> edges;
    std::vector<EdgeFace> faces;
};

/// Builds the adjacency of a valid mesh by sorting: O(n log n), deterministic.
template <class T>
EdgeAdjacency edge_adjacency(const Mesh<T>& mesh) {
    struct Side {
        std::uint32_t a, b;
        EdgeFace face;
    };
    std::vector<Side> sides;
    sides.reserve(mesh.triangles.size() * 3);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = mesh.triangles[f][k], to = mesh.triangles[f][(k + 1) % 3];
            if (from == to) continue;
            sides.push_back({std::min(from, to), std::max(from, to), {static_cast<std::uint32_t>(f), from < to}});
        }
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& x, const Side& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    EdgeAdjacency result;
    result.faces.reserve(sides.size());
    for (const Side& side : sides) {
        if (result.edges.empty() || result.edges.back().a != side.a || result.edges.back().b != side.b)
            result.edges.push_back({side.a, side.b, static_cast<std::uint32_t>(result.faces.size()), 0});
        ++result.edges.back().count;
        result.faces.push_back(side.face);
    }
    return result;
}

/// True if every edge is run through as often in one direction as in the other: the surface has no border and
/// a consistent winding, so that each line enters it as often as it leaves. Vertices that lie on the same
/// spot but have different indices count as different: weld first. An empty mesh is closed.
inline bool is_closed(const EdgeAdjacency& adjacency) {
    for (const Edge& edge : adjacency.edges) {
        int balance = 0;
        for (std::uint32_t i = 0; i < edge.count; ++i) balance += adjacency.faces[edge.first + i].forward ? 1 : -1;
        if (balance != 0) return false;
    }
    return true;
}

}  // namespace penumbra
