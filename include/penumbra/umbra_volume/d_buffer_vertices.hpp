// What is drawn into a D-buffer as vertices for a GPU: shaders/penumbra/umbra_volume/casters.vert and volumes.vert.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/umbra_volume/d_buffer_geometry.hpp>
#include <vector>

namespace penumbra {

/// Of casters' triangles. Light space.
struct DBufferCasterVertex {
    Vec3<float> position;
    float caster;  ///< its number; of one that is not closed −1 − its number
};

/// Of silhouette faces and sides of volumes, light space. Linear over a triangle in space, depth over `stretch` is the
/// depth of the edge where the tangent plane's ray meets it; of a silhouette face it may be more than the face's, which
/// counts then.
struct DBufferVolumeVertex {
    Vec3<float> position;
    float stretch, edge, caster;  ///< the latter two are numbers, the same at a triangle's vertices
};

struct DBufferVertices {
    std::vector<DBufferCasterVertex> casters;
    std::vector<std::uint32_t> triangles;              ///< of casters, three a triangle
    std::vector<DBufferVolumeVertex> umbra, penumbra;  ///< three a triangle
};

/// Numbers are exact up to 2^24. A light of radius 0 has no volumes: their sides have no width as it sees them.
inline DBufferVertices d_buffer_vertices(const DBufferGeometry<float>& geometry, float radius) {
    DBufferVertices result;
    for (std::size_t m = 0; m < geometry.casters.size(); ++m) {
        const DBufferCaster& caster = geometry.casters[m];
        const auto number = static_cast<float>(m);
        const auto first = static_cast<std::uint32_t>(result.casters.size());
        for (const Vec3<double>& p : caster.mesh.positions)
            result.casters.push_back({Vec3<float>(p), caster.solid ? number : -1.0F - number});
        for (const glm::uvec3& t : caster.mesh.triangles)
            for (int k = 0; k < 3; ++k) result.triangles.push_back(first + t[k]);
        if (!(radius > 0.0F)) continue;
        for (const DBufferFace& face : caster.faces) {
            const HidingEdge<float>& edge = geometry.edges[face.edge];
            for (int k = 0; k < 3; ++k) {
                const Vec3<float> p(caster.mesh.positions[caster.mesh.triangles[face.face][k]]);
                result.umbra.push_back({p, p.z / std::min(edge.a.z, edge.b.z), static_cast<float>(face.edge), number});
            }
        }
        for (const DBufferSide& drawn : caster.sides) {
            const VolumeSide<double>& side = drawn.side;
            auto& vertices = side.kind == VolumeKind::umbra ? result.umbra : result.penumbra;
            const auto add = [&](const Vec3<double>& p, double edge_depth) {
                vertices.push_back(
                    {Vec3<float>(p), static_cast<float>(p.z / edge_depth), static_cast<float>(drawn.edge), number});
            };
            const Vec3<double> far_a = side.far_a(geometry.far), far_b = side.far_b(geometry.far);
            if (!side.is_fan()) add(side.b, side.b.z), add(side.a, side.a.z), add(far_a, side.a.z);
            add(side.b, side.b.z), add(far_a, side.a.z), add(far_b, side.b.z);
        }
    }
    return result;
}

}  // namespace penumbra
