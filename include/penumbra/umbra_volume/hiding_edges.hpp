// The edges that a D-buffer knows, and which of them hide together: chains over silhouette faces, neighbours, corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <penumbra/geometry.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <penumbra/umbra_volume/volume.hpp>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace penumbra {

/// A straight edge that hides part of the light, its caster on the left as seen from the light. Light space.
template <class T>
struct HidingEdge {
    static constexpr std::uint32_t none = 0xffffffffU;
    Vec3<T> a, b;
    std::uint32_t mesh;
    std::uint32_t chained = none;  ///< the edge beyond the silhouette faces at this one, which hides as well
    std::uint32_t corner = none;   ///< of a corner, whose first edge this is: its second
    std::uint32_t before = none, after = none;  ///< its neighbours around outer corners
};

namespace detail {

/// Adds the edges of one mesh to those of all, and tells their numbers there. In light space.
template <class T>
class HidingEdges {
  public:
    static constexpr std::uint32_t none = HidingEdge<T>::none;

    /// `number` is the mesh's.
    HidingEdges(const Mesh<double>& mesh, const EdgeAdjacency& adjacency, const VolumeSilhouettes& silhouettes,
                std::uint32_t number, std::vector<HidingEdge<T>>& all)
        : mesh_(number), all_(all) {
        for (const std::vector<VolumeEdge>* edges : {&silhouettes.umbra, &silhouettes.penumbra, &silhouettes.looming})
            for (const VolumeEdge& e : *edges)
                if (numbers_.try_emplace({e.from, e.to}, next_number()).second)
                    all_.push_back({Vec3<T>(mesh.positions[e.from]), Vec3<T>(mesh.positions[e.to]), mesh_});
        if (!silhouettes.faces.empty()) chain(mesh, adjacency, silhouettes);
    }

    std::uint32_t of(std::uint32_t from, std::uint32_t to) const { return numbers_.at({from, to}); }

    /// What hides past a silhouette face: the nearest edge of the penumbra, else of the umbra, else none.
    std::uint32_t of_face(std::uint32_t face) const {
        return nearest_[face][0] != none ? nearest_[face][0] : nearest_[face][1];
    }

    /// Past a side of a loop: its own edge; of a fan the corner between two, and where there is none, at a tip or
    /// around an edge's end, the tangent of its arc.
    std::uint32_t of_side(const std::vector<VolumeSide<double>>& loop, std::size_t i) {
        const VolumeSide<double>& side = loop[i];
        if (!side.is_fan()) return of(side.from, side.to);
        const VolumeSide<double>& before = loop[quad_beside(loop, i, loop.size() - 1)];
        const VolumeSide<double>& after = loop[quad_beside(loop, i, 1)];
        const std::uint32_t added = next_number();
        if (before.is_fan() || are_one(before, after)) {
            const std::array<Vec3<double>, 2> tangent = side.hiding_edge();
            all_.push_back({Vec3<T>(tangent[0]), Vec3<T>(tangent[1]), mesh_});
            return added;
        }
        const std::uint32_t first = of(before.from, before.to), second = of(after.from, after.to);
        const auto [corner, is_new] = corners_.try_emplace({first, second}, added);
        if (is_new) {
            HidingEdge<T> edge = all_[first];
            edge.corner = second;
            all_.push_back(edge);
        }
        return corner->second;
    }

    /// Makes a loop's edges neighbours around its outer corners.
    void connect(const std::vector<VolumeSide<double>>& loop) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const VolumeSide<double>&side = loop[i], &fan = loop[(i + 1) % loop.size()];
            if (side.is_fan()) continue;
            const VolumeSide<double>& next = loop[quad_beside(loop, i, 1)];
            const bool outer = !fan.is_fan() || fan.crossed == (fan.kind == VolumeKind::umbra);
            if (!outer || &next == &side || are_one(side, next)) continue;
            const std::uint32_t edge = of(side.from, side.to), after = of(next.from, next.to);
            all_[edge].after = after, all_[after].before = edge;
        }
    }

  private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    std::uint32_t next_number() const { return static_cast<std::uint32_t>(all_.size()); }
    /// Whether sides belong to one edge, there and back.
    static bool are_one(const VolumeSide<double>& x, const VolumeSide<double>& y) {
        return x.from == y.to && x.to == y.from;
    }
    template <class Use>
    static void for_faces_at(const EdgeAdjacency& adjacency, const VolumeEdge& e, Use&& use) {
        const Pair ends(std::min(e.from, e.to), std::max(e.from, e.to));
        const auto edge = std::lower_bound(adjacency.edges.begin(), adjacency.edges.end(), ends,
                                           [](const Edge& x, const Pair& y) { return Pair(x.a, x.b) < y; });
        for (std::uint32_t i = 0; i < edge->count; ++i) use(adjacency.faces[edge->first + i].face);
    }

    /// Finds for each silhouette face the edges of either silhouette to which the faces between turn least, and chains
    /// the edges at silhouette faces to those of the other silhouette beyond.
    void chain(const Mesh<double>& mesh, const EdgeAdjacency& adjacency, const VolumeSilhouettes& silhouettes) {
        std::vector<bool> is_some(mesh.triangles.size(), false);
        for (const VolumeFace& face : silhouettes.faces) is_some[face.face] = true;
        std::vector<std::vector<std::uint32_t>> neighbours(mesh.triangles.size());
        for (const Edge& edge : adjacency.edges)
            for (std::uint32_t i = 0; i < edge.count; ++i)
                for (std::uint32_t k = 0; k < edge.count; ++k) {
                    const std::uint32_t f = adjacency.faces[edge.first + i].face;
                    const std::uint32_t g = adjacency.faces[edge.first + k].face;
                    if (f != g && is_some[f] && is_some[g]) neighbours[f].push_back(g);
                }
        const auto normal = [&](std::uint32_t face) {
            const glm::uvec3& t = mesh.triangles[face];
            const Vec3<double>& a = mesh.positions[t.x];
            return normalize_or(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a), Vec3<double>(0, 0, 0));
        };
        const std::array<const std::vector<VolumeEdge>*, 2> both{&silhouettes.penumbra, &silhouettes.umbra};
        nearest_.assign(mesh.triangles.size(), {none, none});
        for (std::size_t k = 0; k < 2; ++k) {
            using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // turn so far, face, edge
            std::priority_queue<Step, std::vector<Step>, std::greater<Step>> open;
            for (const VolumeEdge& e : *both[k])
                for_faces_at(adjacency, e, [&](std::uint32_t face) {
                    if (is_some[face]) open.emplace(0.0, face, of(e.from, e.to));
                });
            while (!open.empty()) {
                const auto [turn, face, edge] = open.top();
                open.pop();
                if (nearest_[face][k] != none) continue;
                nearest_[face][k] = edge;
                for (const std::uint32_t next : neighbours[face])
                    if (nearest_[next][k] == none)
                        open.emplace(turn + 1.0 - glm::dot(normal(face), normal(next)), next, edge);
            }
        }
        for (std::size_t k = 0; k < 2; ++k)
            for (const VolumeEdge& e : *both[k])
                for_faces_at(adjacency, e, [&](std::uint32_t face) {
                    const std::uint32_t edge = of(e.from, e.to), beyond = nearest_[face][1 - k];
                    if (is_some[face] && beyond != none && beyond != edge) all_[edge].chained = beyond;
                });
    }

    std::uint32_t mesh_;
    std::vector<HidingEdge<T>>& all_;
    std::map<Pair, std::uint32_t> numbers_, corners_;    // by vertices, and by edges
    std::vector<std::array<std::uint32_t, 2>> nearest_;  // of each face, on the penumbra's silhouette and the umbra's
};

}  // namespace detail

}  // namespace penumbra
