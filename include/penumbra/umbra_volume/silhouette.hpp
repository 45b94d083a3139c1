// Silhouettes for a disk light: the edges of a mesh from which umbra and penumbra begin.
//
// A point in a plane that touches the disk sees an edge on the disk's rim. Where the plane has the disk and the caster
// on opposite sides, the penumbra begins: of the edge's faces one sees all of the disk, the other does not. Where it
// has both on one side, the umbra ends: one face sees none of the disk, the other some. The two silhouettes differ by
// the faces that see some, the silhouette faces; a silhouette from the light's centre lies somewhere among them. Where
// the disk looms over an edge, planes part the two though neither face sees all; such edges count for the penumbra if
// the loops stay closed with them, as they do on convex casters. Rules:
//  - A solid (closed, a consistent winding, inside out or not) has the outside of its faces.
//  - Any other mesh is a sheet: a solid without thickness, which has both sides of every face. Around an edge, sides
//    belong together that look at each other, whatever their winding; a border is closed by a face without width that
//    looks away from its only face. So edges of three and more faces need no rule of their own.
//  - A face without area sees what the face beyond its longest side sees.
//  - Vertices at one place under different indices are different: weld() first.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>
#include <vector>

namespace penumbra {

/// How much of a disk lies in front of a face's plane.
enum class DiskSight { none, some, all };

/// The points of a disk light nearest to and farthest from a face: those where dot(normal, p) is least and largest, on
/// its rim. World space; `normal` is the face's, any length. Both are the centre for a plane parallel to the disk's.
/// Source: the umbra and penumbra volume paper for circular lights, eq. 1a and 1b, with sign and length put right.
template <class T>
struct NearFarPoints {
    Vec3<T> near, far;
};
template <class T>
NearFarPoints<T> near_far_points(const Vec3<T>& normal, const DiskLight<T>& light) {
    const Vec3<T> zero(T(0), T(0), T(0));
    const Vec3<T> n = normalize_or(normal, zero), axis = normalize_or(light.normal, zero);
    const Vec3<T> aside = normalize_or(glm::cross(axis, glm::cross(n, axis)), zero) * light.radius;
    return {light.center - aside, light.center + aside};
}

/// The least and the largest signed distance of a disk's points from a plane through `vertex`: n·(c − q) ± r |n × n_c|,
/// without the points where they are reached. World space and unit; `unit_normal` of length 1. Error: 4 ε of the
/// distance from vertex to light and of the radius.
template <class T>
struct DiskDistances {
    T least, largest;
};
template <class T>
DiskDistances<T> disk_distances(const Vec3<T>& unit_normal, const Vec3<T>& vertex, const DiskLight<T>& light) {
    const Vec3<T> axis = normalize_or(light.normal, Vec3<T>(T(0), T(0), T(0)));
    const T middle = glm::dot(unit_normal, light.center - vertex);
    const T reach = light.radius * safe_length(glm::cross(unit_normal, axis));
    return {middle - reach, middle + reach};
}

/// How much of the disk a face sees: all if every point lies in front of its plane by more than `tolerance`, none if no
/// point does. Arguments as disk_distances; a face without normal sees none.
template <class T>
DiskSight disk_sight(const Vec3<T>& unit_normal, const Vec3<T>& vertex, const DiskLight<T>& light, T tolerance = T(0)) {
    const DiskDistances<T> distances = disk_distances(unit_normal, vertex, light);
    return distances.least > tolerance     ? DiskSight::all
           : distances.largest > tolerance ? DiskSight::some
                                           : DiskSight::none;
}

/// An edge of a volume's silhouette, by vertices of the mesh, with the caster on its left as seen from the light: as
/// extrusion_points takes it. Not a ridge: the faces on its two sides form a valley, behind which nothing ends.
struct VolumeEdge {
    std::uint32_t from, to;
    bool ridge;
};

/// A side of a face, counter-clockwise as the mesh has it or turned.
struct VolumeFace {
    std::uint32_t face;
    bool turned;
};

/// What bounds umbra and penumbra of one mesh. Each silhouette runs in closed loops: as many of its edges end at a
/// vertex as begin there.
struct VolumeSilhouettes {
    std::vector<VolumeEdge> umbra;     ///< between sides that see none of the disk and others
    std::vector<VolumeEdge> penumbra;  ///< between sides that see all of it and others, or by planes that part the two
    std::vector<VolumeEdge> looming;   ///< by planes that part the two, but in no closed loops
    /// Vertices that the disk rolls around without touching an edge: tips that it looms over, where no side sees all of
    /// it, and tips that hang so far below that no side near them sees none. A cone through each is a part of the
    /// volume.
    std::vector<std::uint32_t> umbra_tips, penumbra_tips;
    std::vector<VolumeFace> lit;    ///< sides that see all
    std::vector<VolumeFace> faces;  ///< silhouette faces: sides that see some
};

namespace detail {

/// What the two sides of each face see: fronts at 2 f, backs at 2 f + 1.
template <class T>
std::vector<DiskSight> sights(const Mesh<T>& mesh, const EdgeAdjacency& adjacency, const DiskLight<double>& light,
                              double tolerance) {
    const std::size_t count = mesh.triangles.size();
    std::vector<DiskSight> result(2 * count, DiskSight::none);
    std::vector<std::uint32_t> flat;
    const auto vertex = [&](std::size_t face, int k) { return Vec3<double>(mesh.positions[mesh.triangles[face][k]]); };
    for (std::size_t f = 0; f < count; ++f) {
        const Vec3<double> a = vertex(f, 0), ab = vertex(f, 1) - a, ac = vertex(f, 2) - a;
        const Vec3<double> normal = normalize_or(glm::cross(ab, ac), Vec3<double>(0.0, 0.0, 0.0));
        const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ac - ab, ac - ab)});
        const double area = glm::dot(glm::cross(ab, ac), normal);
        if (!(area > 4.0 * static_cast<double>(std::numeric_limits<T>::epsilon()) * longest)) {
            flat.push_back(static_cast<std::uint32_t>(f));
            continue;
        }
        result[2 * f] = disk_sight(normal, a, light, tolerance);
        result[2 * f + 1] = disk_sight(-normal, a, light, tolerance);
    }
    // flat faces, from the other side of their longest edge: in any order, as often as one may hang on another
    if (flat.empty()) return result;
    std::vector<std::uint32_t> beyond(count, 0xffffffffU);
    std::vector<double> longest(count, -1.0);
    std::vector<bool> turned(count, false);
    for (const Edge& edge : adjacency.edges) {
        const Vec3<double> along(mesh.positions[edge.b] - mesh.positions[edge.a]);
        for (std::uint32_t i = 0; i < edge.count; ++i) {
            const EdgeFace& self = adjacency.faces[edge.first + i];
            for (std::uint32_t k = 0; k < edge.count; ++k) {
                const EdgeFace& other = adjacency.faces[edge.first + k];
                if (other.face == self.face || glm::dot(along, along) <= longest[self.face]) continue;
                longest[self.face] = glm::dot(along, along);
                beyond[self.face] = other.face;
                turned[self.face] = other.forward == self.forward;
            }
        }
    }
    for (int pass = 0; pass < 8; ++pass) {
        for (const std::uint32_t f : flat) {
            if (beyond[f] == 0xffffffffU) continue;
            result[2 * f] = result[2 * beyond[f] + (turned[f] ? 1 : 0)];
            result[2 * f + 1] = result[2 * beyond[f] + (turned[f] ? 0 : 1)];
        }
    }
    return result;
}

/// A face at an edge a → b: its angle around it, and what its sides see that look at growing and at falling angles.
struct EdgeSides {
    double angle;
    DiskSight ahead, behind;
    bool ahead_inside, behind_inside;  ///< of a solid
};

/// Whether as many edges end at a vertex as begin there.
inline bool runs_in_loops(const std::vector<VolumeEdge>& edges) {
    std::vector<std::uint32_t> from, to;
    for (const VolumeEdge& edge : edges) from.push_back(edge.from), to.push_back(edge.to);
    std::sort(from.begin(), from.end()), std::sort(to.begin(), to.end());
    return from == to;
}

/// Adds the edge to a silhouette if one of two sides that look at each other is in the chain.
inline void add_between(std::vector<VolumeEdge>& edges, std::uint32_t a, std::uint32_t b, bool first, bool second,
                        bool ridge) {
    if (first && !second) edges.push_back({a, b, ridge});
    if (second && !first) edges.push_back({b, a, ridge});
}

/// Adds tips: vertices at which planes that touch the disk, tried all around it, have all neighbours on the side of the
/// disk (umbra) or on the other.
template <class T>
void find_tips(const Mesh<T>& mesh, const EdgeAdjacency& adjacency, const DiskLight<double>& light,
               VolumeSilhouettes& silhouettes) {
    constexpr std::size_t tries = 8;
    std::array<Vec3<double>, tries> outward;
    for (std::size_t k = 0; k < tries; ++k) {
        const double turn = 2.0 * pi<double> * static_cast<double>(k) / static_cast<double>(tries);
        outward[k] = Vec3<double>(std::cos(turn), std::sin(turn), 0.0);
    }
    const LightFrame<double> frame = light_frame(light);
    std::vector<Vec3<double>> vertices;
    vertices.reserve(mesh.positions.size());
    for (const Vec3<T>& p : mesh.positions) vertices.push_back(frame.to_light(Vec3<double>(p)));
    enum : std::uint8_t { unused, tip, other };
    std::vector<std::uint8_t> umbra(vertices.size(), unused), penumbra(vertices.size(), unused);
    const auto rule_out = [&](std::uint32_t at, std::uint32_t neighbour) {
        const Vec3<double>&v = vertices[at], way = vertices[neighbour] - v;
        if (umbra[at] == unused) umbra[at] = penumbra[at] = v.z > 0.0 ? tip : other;
        for (std::size_t k = 0; k < tries && (umbra[at] == tip || penumbra[at] == tip); ++k) {
            const Vec3<double>& out = outward[k];
            const Vec3<double> rim = out * light.radius;
            const Vec3<double> normal = glm::cross(Vec3<double>(-out.y, out.x, 0.0), v - rim);
            const double side = glm::dot(normal, way) * -glm::dot(normal, rim);  // > 0 on the disk's
            if (!(side >= 0.0)) umbra[at] = other;
            if (!(side <= 0.0)) penumbra[at] = other;
        }
    };
    for (const Edge& edge : adjacency.edges) {
        rule_out(edge.a, edge.b);
        rule_out(edge.b, edge.a);
    }
    for (const VolumeEdge& edge : silhouettes.umbra) umbra[edge.from] = umbra[edge.to] = other;
    for (const VolumeEdge& edge : silhouettes.penumbra) penumbra[edge.from] = penumbra[edge.to] = other;
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        if (umbra[v] == tip) silhouettes.umbra_tips.push_back(v);
        if (penumbra[v] == tip) silhouettes.penumbra_tips.push_back(v);
    }
}

}  // namespace detail

/// The silhouettes of a valid mesh, in world space, ordered as the adjacency's edges. Radius 0: umbra and penumbra are
/// the silhouette of a point light. Empty for an empty mesh; for a solid around the light, whose inside it lights.
/// `tolerance` ≥ 0 is that of disk_sight.
/// Source: the umbra and penumbra volume paper for circular lights; the rules are ours.
template <class T>
VolumeSilhouettes volume_silhouettes(const Mesh<T>& mesh, const EdgeAdjacency& adjacency, const DiskLight<T>& light,
                                     T tolerance = T(0)) {
    using detail::EdgeSides;
    const bool solid = is_closed(adjacency);
    double volume = 0.0;
    for (const glm::uvec3& t : mesh.triangles)
        volume += glm::dot(Vec3<double>(mesh.positions[t.x] - light.center),
                           glm::cross(Vec3<double>(mesh.positions[t.y] - light.center),
                                      Vec3<double>(mesh.positions[t.z] - light.center)));
    const std::size_t outside = volume < 0.0 ? 1 : 0;
    const DiskLight<double> exact{Vec3<double>(light.center), Vec3<double>(light.normal),
                                  static_cast<double>(light.radius)};
    const auto exact_tolerance = static_cast<double>(tolerance);
    const std::vector<DiskSight> sights = detail::sights(mesh, adjacency, exact, exact_tolerance);
    VolumeSilhouettes result;
    std::vector<EdgeSides> around;
    std::vector<Vec3<double>> ways;  // from the edge to the third vertices of its faces
    std::vector<VolumeEdge> parting;
    // most edges of a solid: between faces that all see all of the disk, or none
    const auto is_inside = [&](const Edge& edge) {
        const DiskSight first = sights[2 * adjacency.faces[edge.first].face + outside];
        bool alike = first != DiskSight::some;
        for (std::uint32_t i = 1; i < edge.count; ++i)
            alike = alike && sights[2 * adjacency.faces[edge.first + i].face + outside] == first;
        return alike;
    };
    for (const Edge& edge : adjacency.edges) {
        if (solid && is_inside(edge)) continue;
        const Vec3<double> a(mesh.positions[edge.a]), axis = Vec3<double>(mesh.positions[edge.b]) - a;
        const double length2 = glm::dot(axis, axis);
        if (!(length2 > 0.0)) continue;
        const Vec3<double> unit = axis / std::sqrt(length2);
        const Vec3<double> right = any_perpendicular(unit), up = glm::cross(unit, right);
        around.clear(), ways.clear();
        for (std::uint32_t i = 0; i < edge.count; ++i) {
            const EdgeFace& side = adjacency.faces[edge.first + i];
            const glm::uvec3& t = mesh.triangles[side.face];
            if (t.x == t.y || t.y == t.z || t.z == t.x) continue;  // there and back
            const std::uint32_t third = t.x != edge.a && t.x != edge.b   ? t.x
                                        : t.y != edge.a && t.y != edge.b ? t.y
                                                                         : t.z;
            const Vec3<double> way = Vec3<double>(mesh.positions[third]) - a;
            ways.push_back(way);
            // the front of a face that runs along the edge looks at growing angles
            const std::size_t front = 2 * std::size_t(side.face) + (side.forward ? 0 : 1);
            const std::size_t back = front ^ 1U;
            around.push_back({std::atan2(glm::dot(way, up), glm::dot(way, right)), sights[front], sights[back],
                              solid && (front & 1U) != outside, solid && (back & 1U) != outside});
        }
        std::sort(around.begin(), around.end(),
                  [](const EdgeSides& x, const EdgeSides& y) { return x.angle < y.angle; });
        const auto add = [&](DiskSight first, DiskSight second, bool ridge) {
            detail::add_between(result.penumbra, edge.a, edge.b, first == DiskSight::all, second == DiskSight::all,
                                ridge);
            detail::add_between(result.umbra, edge.a, edge.b, first != DiskSight::none, second != DiskSight::none,
                                ridge);
        };
        // the plane through the edge, either way round, that has the disk on one side and all else on the other
        const auto add_parting = [&](std::uint32_t from, std::uint32_t to) {
            const Vec3<double> v1(mesh.positions[from]), v2(mesh.positions[to]);
            const ExtrusionPoints<double> rim = extrusion_points(v1, v2, exact);
            bool parts = rim.valid;
            for (const Vec3<double>& way : ways)
                parts = parts && glm::dot(glm::cross(v1 - rim.penumbra, v2 - rim.penumbra), way) <= 0.0;
            if (parts) parting.push_back({from, to, true});
        };
        for (std::size_t i = 0; i < around.size(); ++i) {
            const EdgeSides &first = around[i], &second = around[i + 1 == around.size() ? 0 : i + 1];
            if (first.ahead_inside || second.behind_inside) continue;
            if (around.size() == 1) {
                const Vec3<double> rim = -(std::cos(first.angle) * right + std::sin(first.angle) * up);
                const DiskSight sight = disk_sight(rim, a, exact, exact_tolerance);
                add(first.ahead, sight, true), add(sight, second.behind, true);
                add_parting(edge.a, edge.b), add_parting(edge.b, edge.a);
                continue;
            }
            const double opening = second.angle - first.angle + (i + 1 == around.size() ? 2.0 * pi<double> : 0.0);
            const bool ridge = opening > pi<double>;
            add(first.ahead, second.behind, ridge);
            if (ridge) add_parting(edge.a, edge.b), add_parting(edge.b, edge.a);
        }
    }
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t side = 0; side < 2; ++side) {
            const DiskSight sight = sights[2 * f + side];
            if (sight == DiskSight::none || (solid && side != outside)) continue;
            (sight == DiskSight::all ? result.lit : result.faces).push_back({f, side == 1});
        }
    }
    if (light.radius > T(0)) {
        if (detail::runs_in_loops(parting))
            result.penumbra = parting;
        else
            for (const VolumeEdge& edge : parting)
                if (std::none_of(result.penumbra.begin(), result.penumbra.end(),
                                 [&](const VolumeEdge& e) { return e.from == edge.from && e.to == edge.to; }))
                    result.looming.push_back(edge);
        detail::find_tips(mesh, adjacency, exact, result);
    }
    return result;
}
template <class T>
VolumeSilhouettes volume_silhouettes(const Mesh<T>& mesh, const DiskLight<T>& light) {
    return volume_silhouettes(mesh, edge_adjacency(mesh), light);
}

}  // namespace penumbra
