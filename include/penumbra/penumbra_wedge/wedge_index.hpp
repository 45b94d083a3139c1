// Which edges matter to a point: a tree over everything that casts, in light space.
//
// A point sees the light through a pyramid. Casters beside it do not matter, nor do those beyond the point. Of a caster
// that does, an edge matters if it is on the silhouette and lies in the pyramid's columns, not below it: it then adds
// what lies of the light below it (coverage.hpp), so that edges above the pyramid say whether the caster blocks all or
// nothing. Subtrees whose faces all look away, or all do not, hold no silhouette and are passed over: cost grows with
// the silhouette and the logarithm of the mesh.
//
// Faces that reach from the near side of the point's depth to the far one cannot be projected edge by edge. They are
// left out of the chain, which then has its border where they were, and are cut one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/clip.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/wedge_candidates.hpp>
#include <penumbra/penumbra_wedge/wedge_sight.hpp>
#include <penumbra/penumbra_wedge/wedge_tree.hpp>
#include <vector>

namespace penumbra {

/// Built once; queried from any number of threads, without allocation.
template <class T>
class WedgeIndex {
  public:
    using Values = typename PointTile<T>::Values;

    WedgeIndex() = default;
    /// `lit_meshes`: what detail::lit_mesh makes of each mesh. A face is on a point, and hides nothing from it, if its
    /// plane passes within `tolerance` of it.
    WedgeIndex(const std::vector<detail::LitMesh<T>>& lit_meshes, SilhouetteFrom from, T tolerance)
        : from_(from), tolerance_(tolerance) {
        detail::WedgeTreeBuilder<T>(lit_meshes, from, tree_);
    }

    bool empty() const { return tree_.nodes.empty(); }
    std::size_t bytes() const { return tree_.bytes(); }
    const detail::WedgeTree<T>& tree() const { return tree_; }
    SilhouetteFrom silhouette() const { return from_; }
    T tolerance() const { return tolerance_; }

    /// Calls, for each mesh that may block, visitor.begin_mesh(); for each of its pieces begin_piece(bool simple),
    /// where simple pieces cover no part of the light twice; edges(const TileEdge<T>&) for edges, and edge(lane, from,
    /// to, coefficient) for those of faces that are cut one by one; then end_piece() and end_mesh(). The sum of
    /// coefficient · edge_coverage over a piece is what it blocks of tile.light, winding counted.
    /// If it may, gives up, with false and a part of all that handed out, where most of the work is on faces that only
    /// few of the tile's points see otherwise than the rest: a mesh so fine asks for smaller tiles.
    template <class Visitor>
    bool visit(const PointTile<T>& tile, Visitor& visitor, bool may_give_up = false) const {
        const detail::WedgeSight<T> sight = this->sight();
        Work work;
        const auto end = static_cast<std::uint32_t>(tree_.nodes.size());
        std::uint32_t mesh_end = 0, piece_end = 0;  // of those that are open, else 0
        const auto leave = [&](std::uint32_t at) {
            if (piece_end > 0 && at >= piece_end) visitor.end_piece(), piece_end = 0;
            if (mesh_end > 0 && at >= mesh_end) visitor.end_mesh(), mesh_end = 0;
        };
        for (std::uint32_t at = 0; at < end;) {
            leave(at);
            const Node& node = tree_.nodes[at];
            const bool is_part = node.in_piece && !node.piece_root;
            if (sight.misses(tile, node.box, is_part) || (node.in_piece && sight.has_no_silhouette(tile, node))) {
                at = node.skip;
                continue;
            }
            if (node.mesh_root) visitor.begin_mesh(), mesh_end = node.skip;
            if (node.piece_root) visitor.begin_piece(node.box, node.simple), piece_end = node.skip;
            if (node.edge_count > 0) visit_leaf(tile, node, visitor, work);
            if (may_give_up && work.is_wasted(tile)) return false;
            ++at;
        }
        leave(end);
        return true;
    }

    /// For all points of a tile's box: calls visitor.begin_piece(box, simple, solid) for pieces that may reach into
    /// their pyramids, and visitor.edge(a, b, coefficient) for every edge there, and some beside, that may be on the
    /// silhouette from any of them, with the CoefficientRange of its coefficient; before them turn(a, b, c, distance)
    /// for faces that may look at some points from one side and at some from the other, none of which is farther from
    /// the face's plane. Stops where the visitor answers false, and at a face that the points may lie on both sides of.
    /// Returns whether it did not. `points`, if not empty, are those of the box that matter: size(), at most capacity,
    /// and [i], in light space; convex solids on whose lit side they are stand aside.
    template <class Visitor, class Points>
    bool visit_candidates(const PointTile<T>& tile, const Points& points, Visitor& visitor) const {
        return detail::WedgeCandidates<T, Points, Visitor>(sight(), tile, points, visitor).visit();
    }

  private:
    using Node = detail::WedgeNode<T>;
    using Face = detail::WedgeFace<T>;

    /// Of a visit: faces that a tile's points do not all see alike, and edges and cut faces times the points that they
    /// count for.
    struct Work {
        std::size_t uneven = 0, used = 0;
        bool is_wasted(const PointTile<T>& tile) const {
            return uneven > 96 && used * 20 < uneven * tile.count && tile.count > 1;
        }
    };

    /// The coefficients of a leaf's faces: one for all lanes, or one for each.
    struct Coefficients {
        static constexpr std::size_t most = detail::WedgeTree<T>::most_faces;
        std::array<bool, most> uniform;
        std::array<T, most> value;
        std::array<Values, most> lanes;
    };

    template <class Visitor>
    void visit_leaf(const PointTile<T>& tile, const Node& node, Visitor& visitor, Work& work) const {
        Coefficients coefficients;
        coefficients.uniform[0] = coefficients.uniform[1] = true;
        coefficients.value[0] = T(0), coefficients.value[1] = T(-1);
        for (std::size_t f = 0; f < node.face_count; ++f) {
            const Face& face = tree_.faces[node.first_face + f];
            find_coefficients(tile, face, coefficients, f + 2);
            work.uneven += coefficients.uniform[f + 2] ? 0 : 1;
            if (f < node.owned_faces && face.depth_max >= tile.box.min.z && face.depth_min < tile.box.max.z)
                work.used += cut_face(tile, face, visitor);
        }
        TileEdge<T> seen;
        for (std::size_t e = 0; e < node.edge_count; ++e) {
            const detail::WedgeEdge<T>& edge = tree_.edges[node.first_edge + e];
            if (const std::size_t lanes = count_lanes(tile, coefficients, edge.left, edge.right, seen.coefficient)) {
                work.used += lanes;
                see(tile, edge.a, seen.coefficient, seen.ax, seen.ay);
                see(tile, edge.b, seen.coefficient, seen.bx, seen.by);
                visitor.edges(seen);
            }
        }
    }

    void find_coefficients(const PointTile<T>& tile, const Face& face, Coefficients& c, std::size_t f) const {
        const bool from_light = from_ == SilhouetteFrom::light_center;
        const T middle = glm::dot(face.normal, tile.center - face.a);
        const T room = sight().spread(tile, detail::magnitudes(face.normal), detail::magnitudes(tile.center - face.a));
        const bool away_all = middle + room < -tolerance_;
        const bool front_all = middle - room > (face.solid ? -tolerance_ : tolerance_);
        const bool one_side = from_light ? !sight().touches(tile, detail::box_of(face)) : away_all || front_all;
        const bool before_all = face.depth_max < tile.box.min.z, before_none = face.depth_max >= tile.box.max.z;
        c.uniform[f] = before_none || (before_all && one_side);
        c.value[f] = before_none  ? T(0)
                     : from_light ? static_cast<T>(face.from_light)
                                  : sight().coefficient_of(face, middle);
        if (c.uniform[f]) return;
        Values& lanes = c.lanes[f];
        const T fixed = static_cast<T>(face.from_light), front_value = face.solid ? T(0) : T(1);
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            const T distance = face.normal.x * (tile.x[i] - face.a.x) + face.normal.y * (tile.y[i] - face.a.y) +
                               face.normal.z * (tile.depth[i] - face.a.z);
            const bool away = distance<-tolerance_, front = distance> tolerance_;
            const T seen = away ? T(-1) : front ? front_value : T(0);
            const T value = from_light ? (one_side || away || front ? fixed : T(0)) : seen;
            lanes[i] = face.depth_max < tile.depth[i] ? value : T(0);
        }
    }
    /// Fills in how often an edge counts. In how many lanes it does.
    static std::size_t count_lanes(const PointTile<T>& tile, const Coefficients& c, std::size_t left, std::size_t right,
                                   Values& coefficient) {
        if (c.uniform[left] && c.uniform[right]) {
            const T value = c.value[left] - c.value[right];
            if (value == T(0)) return 0;
            for (std::size_t i = 0; i < tile.lanes; ++i) coefficient[i] = value;
            return tile.lanes;
        }
        if (c.uniform[left] || c.uniform[right]) {
            const Values& lanes = c.uniform[left] ? c.lanes[right] : c.lanes[left];
            const T sign = c.uniform[left] ? T(-1) : T(1), value = c.uniform[left] ? c.value[left] : -c.value[right];
            for (std::size_t i = 0; i < tile.lanes; ++i) coefficient[i] = sign * lanes[i] + value;
        } else {
            for (std::size_t i = 0; i < tile.lanes; ++i) coefficient[i] = c.lanes[left][i] - c.lanes[right][i];
        }
        int used = 0;
        for (std::size_t i = 0; i < tile.lanes; ++i) used += static_cast<int>(coefficient[i] != T(0));
        return static_cast<std::size_t>(used);
    }

    /// Where a vertex lands; anywhere finite in lanes where the edge does not count.
    static void see(const PointTile<T>& tile, const Vec3<T>& vertex, const Values& coefficient, Values& x, Values& y) {
        const T vx = vertex.x, vy = vertex.y, vz = vertex.z;
        for (std::size_t i = 0; i < tile.lanes; ++i) {
            const T px = tile.x[i], py = tile.y[i], p = tile.depth[i], w = p - vz;
            const bool lands = (coefficient[i] != T(0)) & (w > T(0));  // no &&, which branches
            const T grown = p / (lands ? w : p);
            x[i] = px + (vx - px) * grown;
            y[i] = py + (vy - py) * grown;
        }
    }

    /// For how many points it does.
    template <class Visitor>
    std::size_t cut_face(const PointTile<T>& tile, const Face& face, Visitor& visitor) const {
        const Vec3<T> loop[3] = {face.a, face.b, face.c};
        const bool one_side = from_ == SilhouetteFrom::light_center && !sight().touches(tile, detail::box_of(face));
        std::size_t used = 0;
        for (std::size_t i = 0; i < tile.count; ++i) {
            const Vec3<T> point = tile[i];
            if (!(face.depth_max >= point.z && face.depth_min < point.z)) continue;
            const T value = one_side ? static_cast<T>(face.from_light)
                                     : sight().coefficient_of(face, glm::dot(face.normal, point - face.a));
            if (value == T(0) || is_beside(loop, point, tile.light.max)) continue;
            ++used;
            project_loop(loop, 3, point, tile.light,
                         [&](const Vec2<T>& from, const Vec2<T>& to) { visitor.edge(i, from, to, value); });
        }
        return used;
    }
    /// Whether a triangle lies beyond one side of the pyramid.
    static bool is_beside(const Vec3<T> (&loop)[3], const Vec3<T>& point, const Vec2<T>& half) {
        int right = 0, left = 0, top = 0, bottom = 0;
        for (const Vec3<T>& v : loop) {
            right += (v.x - half.x) * point.z > v.z * (point.x - half.x);
            left += (v.x + half.x) * point.z < v.z * (point.x + half.x);
            top += (v.y - half.y) * point.z > v.z * (point.y - half.y);
            bottom += (v.y + half.y) * point.z < v.z * (point.y + half.y);
        }
        return right == 3 || left == 3 || top == 3 || bottom == 3;
    }

    detail::WedgeSight<T> sight() const { return {tree_, from_, tolerance_}; }

    detail::WedgeTree<T> tree_;
    SilhouetteFrom from_ = SilhouetteFrom::point;
    T tolerance_ = T(0);
};

}  // namespace penumbra
