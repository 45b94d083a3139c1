// The simplest solid.
#pragma once

#include <penumbra/mesh.hpp>

namespace penumbra::test {

/// A closed box, wound outwards, welded.
template <class T>
Mesh<T> box_mesh(const Vec3<T>& center, const Vec3<T>& half) {
    Mesh<T> mesh;
    for (unsigned i = 0; i < 8; ++i) {
        const Vec3<T> corner((i & 1U) ? T(1) : T(-1), (i & 2U) ? T(1) : T(-1), (i & 4U) ? T(1) : T(-1));
        mesh.positions.push_back(center + half * corner);
    }
    constexpr std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.emplace_back(q[0], q[1], q[2]);
        mesh.triangles.emplace_back(q[0], q[2], q[3]);
    }
    return mesh;
}

}  // namespace penumbra::test
