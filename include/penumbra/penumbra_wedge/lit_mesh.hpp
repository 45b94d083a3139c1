// Casters made ready for wedges: in light space, cut at the light's plane, and as pieces that hang together.
//
// What blocks is a chain of faces. Of a solid piece (closed, consistently wound) those that look away from P: a ray
// from P leaves a solid through such a face, whatever else it meets. Of any other piece, a sheet, every face once. The
// chain's boundary is the silhouette: an edge counts with the difference of what its two faces count, which needs no
// rule for borders, edges of three faces and more, or faces that are there twice. Faces without area are dropped.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// In place of a face: nothing, and what closes a solid where the light's plane cuts it, which always looks away.
inline constexpr std::uint32_t no_face = 0xffffffffU, cap_face = 0xfffffffeU;

/// An edge and one face on each side: `left` runs along it from a to b, `right` from b to a.
struct LitEdge {
    std::uint32_t a, b, left, right;
};

/// Faces that hang together by edges.
struct Piece {
    std::vector<std::uint32_t> faces;
    std::vector<LitEdge> edges;
    bool solid = false;
    bool simple = false;  ///< covers no part of the light twice, seen from anywhere: a convex solid, a convex polygon
};

/// A mesh in light space, scaled; solids wound so that the light is outside.
template <class T>
struct LitMesh {
    std::vector<Vec3<T>> vertices;
    std::vector<glm::uvec3> faces;
    std::vector<Piece> pieces;

    Vec3<double> vertex(std::uint32_t i) const { return Vec3<double>(vertices[i]); }
    Vec3<double> normal(std::uint32_t face) const {
        const glm::uvec3& f = faces[face];
        return glm::cross(vertex(f.y) - vertex(f.x), vertex(f.z) - vertex(f.x));
    }
};

/// Cuts faces at depth 0 and keeps what lies on the lit side.
template <class T>
class PlaneCutter {
  public:
    explicit PlaneCutter(LitMesh<T>& mesh) : mesh_(mesh) {}

    void add(const glm::uvec3& face) {
        std::uint32_t kept[4];
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3];
            const T depth_a = depth(a), depth_b = depth(b);
            if (depth_a >= T(0)) kept[count++] = a;
            if ((depth_a > T(0) && depth_b < T(0)) || (depth_a < T(0) && depth_b > T(0))) kept[count++] = between(a, b);
        }
        for (int k = 2; k < count; ++k) push(glm::uvec3(kept[0], kept[k - 1], kept[k]));
    }

  private:
    T depth(std::uint32_t vertex) const { return mesh_.vertices[vertex].z; }
    void push(const glm::uvec3& face) {
        const bool lit = depth(face.x) > T(0) || depth(face.y) > T(0) || depth(face.z) > T(0);
        mesh_.faces.push_back(face);
        const Vec3<double> normal = mesh_.normal(static_cast<std::uint32_t>(mesh_.faces.size() - 1));
        if (!lit || !(glm::dot(normal, normal) > 0.0)) mesh_.faces.pop_back();
    }
    /// The vertex where an edge meets the plane, the same for all its faces.
    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
        const auto [entry, is_new] = cuts_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) {
            const Vec3<double> p = mesh_.vertex(std::min(a, b)), q = mesh_.vertex(std::max(a, b));
            Vec3<T> cut(p + (q - p) * (p.z / (p.z - q.z)));
            cut.z = T(0);
            mesh_.vertices.push_back(cut);
        }
        return entry->second;
    }

    LitMesh<T>& mesh_;
    std::unordered_map<std::uint64_t, std::uint32_t> cuts_;
};

/// Every edge with its faces in pairs that run along it both ways; what is left over has no_face beside it.
template <class T>
std::vector<LitEdge> paired_edges(const LitMesh<T>& mesh) {
    struct Side {
        std::uint32_t a, b, face;
        bool forward;
    };
    std::vector<Side> sides;
    sides.reserve(mesh.faces.size() * 3);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = mesh.faces[f][k], to = mesh.faces[f][(k + 1) % 3];
            if (from != to) sides.push_back({std::min(from, to), std::max(from, to), f, from < to});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        if (x.a != y.a) return x.a < y.a;
        if (x.b != y.b) return x.b < y.b;
        return x.forward != y.forward ? x.forward : x.face < y.face;
    });
    std::vector<LitEdge> edges;
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t middle = first;
        const auto same = [&](std::size_t i) {
            return i < sides.size() && sides[i].a == sides[first].a && sides[i].b == sides[first].b;
        };
        while (same(middle) && sides[middle].forward) ++middle;
        std::size_t end = middle;
        while (same(end)) ++end;
        for (std::size_t i = first, k = middle; i < middle || k < end; ++i, ++k)
            edges.push_back({sides[first].a, sides[first].b, i < middle ? sides[i].face : no_face,
                             k < end ? sides[k].face : no_face});
        first = end;
    }
    return edges;
}

/// Splits faces and edges into pieces.
template <class T>
void find_pieces(LitMesh<T>& mesh) {
    const std::vector<LitEdge> edges = paired_edges(mesh);
    std::vector<std::uint32_t> parent(mesh.faces.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t f) {
        while (parent[f] != f) f = parent[f] = parent[parent[f]];
        return f;
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::uint32_t face = edges[i].left != no_face ? edges[i].left : edges[i].right;
        if (edges[i].left != no_face && edges[i].right != no_face) parent[root(edges[i].right)] = root(face);
        // faces of one edge hang together, however they are paired
        if (i > 0 && edges[i - 1].a == edges[i].a && edges[i - 1].b == edges[i].b)
            parent[root(face)] = root(edges[i - 1].left != no_face ? edges[i - 1].left : edges[i - 1].right);
    }
    std::vector<std::uint32_t> piece_of(mesh.faces.size(), no_face);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        std::uint32_t& piece = piece_of[root(f)];
        if (piece == no_face) {
            piece = static_cast<std::uint32_t>(mesh.pieces.size());
            mesh.pieces.emplace_back();
        }
        mesh.pieces[piece].faces.push_back(f);
    }
    for (const LitEdge& edge : edges)
        mesh.pieces[piece_of[root(edge.left != no_face ? edge.left : edge.right)]].edges.push_back(edge);
}

/// Whether no edge of a solid is a valley, and it has one surface without handles.
template <class T>
bool is_convex(const LitMesh<T>& mesh, const Piece& piece, T tolerance) {
    std::vector<std::uint32_t> used;
    std::size_t caps = 0;
    for (const LitEdge& edge : piece.edges) {
        used.push_back(edge.a), used.push_back(edge.b);
        if (edge.left == cap_face || edge.right == cap_face) {
            ++caps;
            continue;
        }
        const Vec3<double> normal = mesh.normal(edge.left), at = mesh.vertex(edge.a);
        const glm::uvec3& other = mesh.faces[edge.right];
        for (int k = 0; k < 3; ++k)
            if (glm::dot(normal, mesh.vertex(other[k]) - at) > static_cast<double>(tolerance) * glm::length(normal))
                return false;
    }
    std::sort(used.begin(), used.end());
    const auto vertices = std::unique(used.begin(), used.end()) - used.begin();
    const auto faces = static_cast<std::ptrdiff_t>(piece.faces.size() + (caps > 0 ? 1 : 0));
    return vertices - static_cast<std::ptrdiff_t>(piece.edges.size()) + faces == 2;
}

/// Whether a sheet is one convex polygon in a plane, cut into faces that are all wound alike.
template <class T>
bool is_convex_polygon(const LitMesh<T>& mesh, const Piece& piece, T tolerance) {
    if (piece.faces.size() == 1) return true;
    constexpr std::size_t most_faces = 64;  // each border is tried against all: larger sheets are seldom flat
    if (piece.faces.size() > most_faces) return false;
    Vec3<double> sum(0.0, 0.0, 0.0);
    for (const std::uint32_t face : piece.faces) sum += mesh.normal(face);
    const Vec3<double> normal = normalize_or(sum, Vec3<double>(0.0, 0.0, 0.0));
    const double most = static_cast<double>(tolerance);
    const auto all_vertices = [&](auto&& holds) {
        return std::all_of(piece.faces.begin(), piece.faces.end(), [&](std::uint32_t face) {
            const glm::uvec3& f = mesh.faces[face];
            return holds(mesh.vertex(f.x)) && holds(mesh.vertex(f.y)) && holds(mesh.vertex(f.z));
        });
    };
    const Vec3<double> at = mesh.vertex(piece.edges[0].a);
    for (const std::uint32_t face : piece.faces)
        if (!(glm::dot(normal, mesh.normal(face)) > 0.0)) return false;
    if (!all_vertices([&](const Vec3<double>& v) { return std::abs(glm::dot(normal, v - at)) <= most; })) return false;
    std::vector<std::uint32_t> all, border;
    for (const LitEdge& edge : piece.edges) {
        all.push_back(edge.a), all.push_back(edge.b);
        if (edge.left != no_face && edge.right != no_face) continue;
        border.push_back(edge.a), border.push_back(edge.b);
        const bool forward = edge.left != no_face;  // its face runs along it from a to b, and lies to the left
        const Vec3<double> a = mesh.vertex(forward ? edge.a : edge.b), b = mesh.vertex(forward ? edge.b : edge.a);
        const Vec3<double> inwards = normalize_or(glm::cross(normal, b - a), Vec3<double>(0.0, 0.0, 0.0));
        if (!all_vertices([&](const Vec3<double>& v) { return glm::dot(inwards, v - a) >= -most; })) return false;
    }
    const auto different = [](std::vector<std::uint32_t>& vertices) {
        std::sort(vertices.begin(), vertices.end());
        return static_cast<std::size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    };
    // without holes, and its border runs around it once
    return different(all) + piece.faces.size() == piece.edges.size() + 1 && different(border) * 2 == border.size();
}

/// Marks solids, and turns those around whose inside holds the light or that are wound inside out.
template <class T>
void orient(LitMesh<T>& mesh, Piece& piece, T tolerance) {
    const auto on_plane = [&](const LitEdge& e) {
        return mesh.vertices[e.a].z == T(0) && mesh.vertices[e.b].z == T(0);
    };
    piece.solid = true;
    for (LitEdge& edge : piece.edges) {
        if (edge.left != no_face && edge.right != no_face) continue;
        piece.solid = piece.solid && on_plane(edge);
    }
    if (!piece.solid) {
        piece.simple = is_convex_polygon(mesh, piece, tolerance);
        return;
    }
    // from the light's centre, in whose plane caps lie and count for nothing
    double volume = 0.0, angle = 0.0;
    for (const std::uint32_t face : piece.faces) {
        const glm::uvec3& f = mesh.faces[face];
        const Vec3<double> a = mesh.vertex(f.x), b = mesh.vertex(f.y), c = mesh.vertex(f.z);
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double triple = glm::dot(a, glm::cross(b, c));
        volume += triple;
        angle +=
            2.0 * std::atan2(triple, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    const bool inside = std::abs(angle) > pi<double>;  // 2π of a solid cut open at the light, else 0
    const bool turn = (volume < 0.0) != inside;
    for (LitEdge& edge : piece.edges) {
        if (!inside && edge.left == no_face) edge.left = cap_face;
        if (!inside && edge.right == no_face) edge.right = cap_face;
        if (turn) std::swap(edge.left, edge.right);
    }
    if (turn)
        for (const std::uint32_t face : piece.faces) std::swap(mesh.faces[face].y, mesh.faces[face].z);
    piece.simple = !inside && is_convex(mesh, piece, tolerance);
}

/// World space to light space, times `scale`, a power of two. In double: one rounding, so that points on a caster stay
/// on it.
template <class T>
Vec3<T> to_scaled_light(const LightFrame<T>& frame, const Vec3<T>& point_ws, T scale) {
    const LightFrame<double> exact{Vec3<double>(frame.origin), Vec3<double>(frame.u), Vec3<double>(frame.v),
                                   Vec3<double>(frame.normal)};
    return Vec3<T>(exact.to_light(Vec3<double>(point_ws)) * static_cast<double>(scale));
}

/// The lit side of a mesh: world space to light space, times `scale`, a power of two. `tolerance`, in scaled units, is
/// how far a vertex may stand out of a convex solid.
template <class T>
LitMesh<T> lit_mesh(const Mesh<T>& mesh, const LightFrame<T>& frame, T scale, T tolerance) {
    const Mesh<T> welded = weld(mesh);
    LitMesh<T> lit;
    lit.vertices.reserve(welded.positions.size());
    for (const Vec3<T>& p : welded.positions) lit.vertices.push_back(to_scaled_light(frame, p, scale));
    PlaneCutter<T> cutter(lit);
    for (const glm::uvec3& face : welded.triangles) cutter.add(face);
    find_pieces(lit);
    for (Piece& piece : lit.pieces) orient(lit, piece, tolerance);
    return lit;
}

}  // namespace penumbra::detail
