// What is drawn into a D-buffer: casters, silhouette faces, and the sides of umbra and penumbra volumes.
//
// Light space and double throughout. The CPU draws it as it is; d_buffer_vertices.hpp makes it vertices for a GPU.
#pragma once

#include <cstdint>
#include <penumbra/detail/lit_casters.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>
#include <penumbra/umbra_volume/hiding_edges.hpp>
#include <penumbra/umbra_volume/options.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <penumbra/umbra_volume/volume.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// A silhouette face that a ray may leave a solid through, which leaves its umbra there.
struct DBufferFace {
    std::uint32_t face;  ///< DBufferCaster::mesh
    std::uint32_t edge;  ///< that hides past it: DBufferGeometry::edges
};

/// A side of a volume, and the edge that hides past it.
struct DBufferSide {
    VolumeSide<double> side;
    std::uint32_t edge;
};

/// What comes of one caster.
struct DBufferCaster {
    Mesh<double> mesh;  ///< what lies before the light's plane, welded
    bool solid;         ///< closed
    std::vector<DBufferFace> faces;
    std::vector<DBufferSide> sides;
};

template <class T>
struct DBufferGeometry {
    static constexpr T widest = T(16);  ///< slope of the image's borders, at most

    Rect2<T> slopes;   ///< x / z and y / z of the image's borders
    double near, far;  ///< depths: of no caster's vertex below, and of where the sides of volumes end
    std::vector<DBufferCaster> casters;
    std::vector<HidingEdge<T>> edges;
};

namespace detail {

/// Silhouette faces, the sides of volumes and edges of caster `number` of a geometry.
template <class T>
void add_volumes(DBufferGeometry<T>& geometry, std::uint32_t number, const EdgeAdjacency& adjacency, double radius,
                 VolumeSilhouette silhouette, double tolerance) {
    constexpr double fan_step = 0.05;  // radians: an arc's triangle is off by 0.0003 r
    DBufferCaster& caster = geometry.casters[number];
    const Mesh<double>& mesh = caster.mesh;
    const DiskLight<double> disk{Vec3<double>(0.0, 0.0, 0.0), Vec3<double>(0.0, 0.0, 1.0), radius};
    const DiskLight<double> seen_from{disk.center, disk.normal, silhouette == VolumeSilhouette::disk ? radius : 0.0};
    const VolumeSilhouettes silhouettes = volume_silhouettes(mesh, adjacency, seen_from, tolerance);
    HidingEdges<T> edges(mesh, adjacency, silhouettes, number, geometry.edges);
    for (const VolumeFace& face : silhouettes.faces) {
        const glm::uvec3& t = mesh.triangles[face.face];
        const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        const double toward = -glm::dot(glm::cross(b - a, c - a), a) * (face.turned ? -1.0 : 1.0);
        const std::uint32_t edge = edges.of_face(face.face);
        if (!(toward > 0.0) && edge != HidingEdges<T>::none) caster.faces.push_back({face.face, edge});
    }
    for (const VolumeKind kind : {VolumeKind::umbra, VolumeKind::penumbra})
        for (const std::vector<VolumeSide<double>>& loop :
             volume_sides(mesh.positions, silhouettes, radius, kind, fan_step)) {
            edges.connect(loop);
            for (std::size_t i = 0; i < loop.size(); ++i)
                if (loop[i].ridge && !loop[i].crossed) caster.sides.push_back({loop[i], edges.of_side(loop, i)});
        }
    for (const VolumeEdge& edge : silhouettes.looming) {
        const Vec3<double>&a = mesh.positions[edge.from], &b = mesh.positions[edge.to];
        const Vec3<double> rim = extrusion_points(a, b, disk).penumbra;
        caster.sides.push_back(
            {{a, b, rim, rim, edge.from, edge.to, true, false, VolumeKind::penumbra}, edges.of(edge.from, edge.to)});
    }
}

}  // namespace detail

/// For valid casters and a valid light, in `frame`; arguments as DBuffer's. Casters are cut off at `near`. Without any
/// before the light's plane `slopes` is empty.
template <class T>
DBufferGeometry<T> d_buffer_geometry(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, T radius,
                                     int resolution, VolumeSilhouette silhouette = VolumeSilhouette::disk) {
    std::vector<Mesh<double>> meshes = detail::in_light_space(casters, frame);
    const double reach = detail::reach_of(meshes), exact_radius = static_cast<double>(radius);
    DBufferGeometry<T> result;
    result.near = 1e-6 * reach;
    result.far = 1e4 * (reach + exact_radius);
    for (Mesh<double>& mesh : meshes) mesh = detail::lit_part(mesh, result.near);
    const Rect2<double> slopes = detail::slopes_around(meshes, Vec2<double>(exact_radius, exact_radius),
                                                       static_cast<double>(DBufferGeometry<T>::widest), resolution);
    result.slopes = {Vec2<T>(slopes.min), Vec2<T>(slopes.max)};
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
        const EdgeAdjacency adjacency = edge_adjacency(meshes[m]);
        result.casters.push_back({std::move(meshes[m]), is_closed(adjacency), {}, {}});
        detail::add_volumes(result, m, adjacency, exact_radius, silhouette, 1e-12 * reach);
    }
    return result;
}

}  // namespace penumbra
