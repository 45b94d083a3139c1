// Silhouettes: the oriented edges of a triangle mesh that bound what it hides from a point.
//
// What hides is a chain of faces: each enters with a winding of −1, 0 or 1, its own way round counting as positive. The
// silhouette is the chain's border, each edge as often as the faces on its two sides differ. So as many edges end at a
// vertex as begin there, whatever the mesh, the point and the rounding; and what a ray from the point to the light
// meets of the chain is what the silhouette winds around it, however its edges are ordered. The rules:
//  - A solid, that is, a closed mesh with a consistent winding: the faces that look away from the point. A ray that
//    comes from outside leaves the solid as often as it enters.
//  - A sheet, that is, any other mesh (with borders, turned faces, edges of three faces): every face once, turned to
//  look
//    at the point. Layers add up: a hollow mesh with a turned face or a hole hides twice, so turn or close it first.
//  - A face without area, or as good as in a plane with the point, hides nothing: a surface does not hide a point on
//  it.
//  - Two faces on the same vertices are two: the chain has them twice, as an edge's `count` says.
//  - Vertices at one place under different indices are different: the faces part there. weld() of mesh.hpp joins them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/mesh.hpp>
#include <vector>

namespace penumbra {

/// Which faces of a mesh hide something.
enum class Surface {
    solid,  ///< those that look away from the point
    sheet,  ///< all of them, each turned to look at the point
};

/// Solid if every edge is run through as often in one direction as in the other, see is_closed.
inline Surface surface_of(const EdgeAdjacency& adjacency) {
    return is_closed(adjacency) ? Surface::solid : Surface::sheet;
}

/// From where silhouettes are seen.
enum class SilhouetteFrom {
    light_center,  ///< the light, by its centre: the paper's, one silhouette for all points
    point          ///< a point of the scene: exact for that point
};

/// The unit normal of a triangle, on the side from which it is counter-clockwise; 0 if it has no area. Any space.
/// Domain: |coordinates| ≤ 1e18. The same, bit for bit, for triangles scaled by a power of two. Error: 2 ε times the
/// product of the sides at `a` over their cross product, so more for needles.
template <class T>
Vec3<T> face_normal(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
    const Vec3<T> ab = b - a, ac = c - a;
    const T largest = glm::max(detail::largest_component(ab), detail::largest_component(ac));
    const T scale = exp2_int<T>(detail::exponent_to_unit(largest));
    return normalize_or(glm::cross(ab * scale, ac * scale), Vec3<T>(T(0), T(0), T(0)));
}

/// Distance up to which a point counts as lying in a face's plane: what rounding moves a point that is computed on a
/// face of a mesh with these bounds. 0 for empty bounds.
template <class T>
T silhouette_tolerance(const Box3<T>& bounds) {
    if (is_empty(bounds)) return T(0);
    const T largest = glm::max(detail::largest_component(bounds.min), detail::largest_component(bounds.max));
    return T(16) * std::numeric_limits<T>::epsilon() * largest;
}

/// With which winding a face enters the chain that hides from `viewpoint`: −1, 0 or 1. `unit_normal` is face_normal,
/// `vertex` any vertex of the face; any right-handed space, `tolerance` ≥ 0 in its unit. 0 for a face without normal
/// and for a viewpoint within `tolerance` of the face's plane.
template <class T>
int face_winding(const Vec3<T>& unit_normal, const Vec3<T>& vertex, const Vec3<T>& viewpoint, T tolerance,
                 Surface surface) {
    const T distance = glm::dot(unit_normal, viewpoint - vertex);
    if (distance < -tolerance) return -1;
    return surface == Surface::sheet && distance > tolerance ? 1 : 0;
}

/// How often an edge belongs to the silhouette, negative for its reverse: the winding of the faces that run along it
/// less that of the faces that run against it; where several do, the sum of theirs. For SilhouetteFrom::light_center
/// the other way round, since points that the light shines on see it from the other side.
inline int edge_winding(int along, int against, SilhouetteFrom from) {
    return from == SilhouetteFrom::point ? along - against : against - along;
}

/// An edge of a silhouette, by vertices of the mesh; `count` ≥ 1 tells how often the silhouette runs along it.
struct SilhouetteEdge {
    std::uint32_t from, to;
    int count;
};

/// The silhouette of a valid mesh, ordered as the adjacency's edges. `viewpoint` is a point of the scene, or the centre
/// of the light, in the mesh's space, which is right-handed. Orientation: seen from a point of the scene, loops run
/// counter-clockwise around what is hidden, so that projected on the light's plane their coverage is positive.
/// `tolerance` is that of face_winding. Empty for an empty mesh and for a solid around the viewpoint, which hides all.
/// Edges one by one tell what the mesh hides if it lies between the light's plane and the point's depth: what reaches
/// beyond leaves a loop open there, see project_edge.
/// Source: V. Forest, L. Barthe & M. Paulin, "Realistic soft shadows by penumbra-wedges blending", 2006.
template <class T>
std::vector<SilhouetteEdge> silhouette(const Mesh<T>& mesh, const EdgeAdjacency& adjacency, const Vec3<T>& viewpoint,
                                       T tolerance, SilhouetteFrom from = SilhouetteFrom::point) {
    const Surface surface = surface_of(adjacency);
    std::vector<int> windings;
    windings.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const Vec3<T>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        windings.push_back(face_winding(face_normal(a, b, c), a, viewpoint, tolerance, surface));
    }
    std::vector<SilhouetteEdge> result;
    for (const Edge& edge : adjacency.edges) {
        int along = 0, against = 0;
        for (std::uint32_t i = 0; i < edge.count; ++i) {
            const EdgeFace& side = adjacency.faces[edge.first + i];
            (side.forward ? along : against) += windings[side.face];
        }
        const int winding = edge_winding(along, against, from);
        if (winding > 0) result.push_back({edge.a, edge.b, winding});
        if (winding < 0) result.push_back({edge.b, edge.a, -winding});
    }
    return result;
}
/// With the tolerance of the mesh's bounds.
template <class T>
std::vector<SilhouetteEdge> silhouette(const Mesh<T>& mesh, const EdgeAdjacency& adjacency, const Vec3<T>& viewpoint,
                                       SilhouetteFrom from = SilhouetteFrom::point) {
    return silhouette(mesh, adjacency, viewpoint, silhouette_tolerance(bounds(mesh)), from);
}

}  // namespace penumbra
