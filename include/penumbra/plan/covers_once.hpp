// Which casters are known to cover no part of a light twice, before anything is built.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/mesh.hpp>

namespace penumbra::detail {

/// Whether a mesh covers no part of a light twice, seen from anywhere, if that is cheaply known: a triangle, a planar
/// quad of two, a welded convex solid of a few faces, each of which is tried against every vertex.
template <class T>
bool covers_once(const Mesh<T>& mesh) {
    constexpr std::size_t most_faces = 32;
    const std::size_t faces = mesh.triangles.size(), vertices = mesh.positions.size();
    if (faces <= 1) return true;
    for (std::size_t f = 0; f < std::min(faces, most_faces); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangles[f][k] >= vertices) return false;  // for the shadow's constructor to report
    const bool quad = faces == 2 && vertices == 4;
    if (!quad && (faces > most_faces || faces + 4 != 2 * vertices)) return false;
    // every edge runs both ways, or for a quad one does: differences of hashes of edges cancel
    const auto hash = [](std::uint64_t a, std::uint64_t b) {
        const std::uint64_t mixed = (a * 0x9e3779b97f4a7c15U) ^ (b * 0xc2b2ae3d27d4eb4fU + 0x165667b19e3779f9U);
        return (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9U;
    };
    std::uint64_t open = 0;
    bool outwards = true, inwards = true;
    Vec3<T> first_normal(T(0), T(0), T(0));
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) open += hash(t[k], t[(k + 1) % 3]) - hash(t[(k + 1) % 3], t[k]);
        const Vec3<T>& a = mesh.positions[t.x];
        const Vec3<T> normal =
            normalize_or(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a), Vec3<T>(T(0), T(0), T(0)));
        T low = T(0), high = T(0), size = T(0);
        for (const Vec3<T>& p : mesh.positions) {
            const T away = glm::dot(normal, p - a);
            low = std::min(low, away), high = std::max(high, away);
            size = std::max(size, largest_component(p));
        }
        const T slack = T(16) * std::numeric_limits<T>::epsilon() * size;
        outwards = outwards && high <= slack, inwards = inwards && low >= -slack;
        if (quad && glm::dot(normal, first_normal) < T(0)) return false;
        first_normal = normal;
    }
    return quad ? outwards && inwards : open == 0 && (outwards || inwards);
}

}  // namespace penumbra::detail
