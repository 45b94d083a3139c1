// Which edges may matter to any point of a box: the candidates for silhouettes, and how often each may count.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/lit_side.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/wedge_sight.hpp>
#include <penumbra/penumbra_wedge/wedge_tree.hpp>

namespace penumbra {

/// How often a face or an edge counts for points of a box: at least, at most, and without the faces that they do not
/// all see alike.
struct CoefficientRange {
    int least, most, steady;
};

namespace detail {

/// See WedgeIndex::visit_candidates(). Refers to all that it is made of.
template <class T, class Points, class Visitor>
class WedgeCandidates {
  public:
    WedgeCandidates(const WedgeSight<T>& sight, const PointTile<T>& tile, const Points& points, Visitor& visitor)
        : sight_(sight), tile_(tile), points_(points), visitor_(visitor) {}

    bool visit() const {
        const auto end = static_cast<std::uint32_t>(sight_.tree.nodes.size());
        for (std::uint32_t at = 0; at < end;) {
            const Node& node = sight_.tree.nodes[at];
            const bool is_part = node.in_piece && !node.piece_root;
            if (sight_.misses(tile_, node.box, is_part)) {
                at = node.skip;
                continue;
            }
            if (node.piece_root && stands_aside(at)) {
                at = node.skip;
                continue;
            }
            if (node.piece_root && !visitor_.begin_piece(node.box, node.simple, node.solid)) return false;
            if (node.in_piece && sight_.has_no_silhouette(tile_, node)) {
                at = node.skip;
                continue;
            }
            if (node.edge_count > 0 && !visit_leaf(node)) return false;
            ++at;
        }
        return true;
    }

  private:
    using Node = WedgeNode<T>;
    using Face = WedgeFace<T>;

    /// Whether a piece is a convex solid and the points are on its lit side.
    bool stands_aside(std::uint32_t piece) const {
        const Node& node = sight_.tree.nodes[piece];
        return sight_.from == SilhouetteFrom::point && node.simple && node.solid && sight_.touches(tile_, node.box) &&
               hides_nothing(sight_, tile_, points_, piece);
    }
    bool visit_leaf(const Node& node) const {
        using Range = CoefficientRange;
        std::array<Range, WedgeTree<T>::most_faces> ranges;
        ranges[0] = {0, 0, 0}, ranges[1] = {-1, -1, -1};
        for (std::size_t f = 0; f < node.face_count; ++f) {
            const Face& face = sight_.tree.faces[node.first_face + f];
            Range& range = ranges[f + 2];
            range = {0, 0, 0};
            if (face.depth_min >= tile_.box.max.z) continue;  // beyond all points
            const T middle = glm::dot(face.normal, tile_.center - face.a);
            const T room = sight_.spread(tile_, magnitudes(face.normal), magnitudes(tile_.center - face.a));
            const bool away_all = middle + room<-sight_.tolerance, away_none = middle - room> - sight_.tolerance;
            const bool front_all = middle - room > sight_.tolerance;
            if (away_all || (face.solid ? away_none : front_all)) {
                range = range_of(face, away_all, front_all);
            } else if (!find_range(face, range)) {
                if (touch(tile_.box, box_of(face))) return false;
                const int fixed = face.from_light;
                if (sight_.from == SilhouetteFrom::point)
                    range = {face.solid || !away_none ? -1 : 0, face.solid ? 0 : 1, 0};
                else if (sight_.touches(tile_, box_of(face)))
                    range = {std::min(fixed, 0), std::max(fixed, 0), 0};
                else
                    range = {fixed, fixed, fixed};
                if (f < node.owned_faces && range.least != range.most)
                    visitor_.turn(face.a, face.b, face.c, std::abs(middle) + room);
            }
        }
        for (std::size_t e = 0; e < node.edge_count; ++e) {
            const WedgeEdge<T>& edge = sight_.tree.edges[node.first_edge + e];
            const Range left = ranges[edge.left], right = ranges[edge.right];
            const Range range = {left.least - right.most, left.most - right.least, left.steady - right.steady};
            if ((range.least != 0 || range.most != 0) && !visitor_.edge(edge.a, edge.b, range)) return false;
        }
        return true;
    }
    /// How a face counts that all points look at from one side, or edge-on.
    CoefficientRange range_of(const Face& face, bool away, bool front) const {
        const int count = sight_.count_of(face, away, front);
        return {count, count, count};
    }
    /// Whether each of the points looks at a face from the same side, by more than rounding, and how it counts then.
    bool find_range(const Face& face, CoefficientRange& range) const {
        const T most = sight_.tolerance * surely_off<T>, least = sight_.tolerance * surely_on<T>;
        const bool is_solid = face.solid && sight_.from == SilhouetteFrom::point;
        bool away = true, front = true, not_away = true, edge_on = true;
        const auto include = [&](const Vec3<T>& point) {
            const T distance = glm::dot(face.normal, point - face.a);
            away = away && distance < -most, front = front && distance > most;
            not_away = not_away && distance > -least, edge_on = edge_on && std::abs(distance) < least;
            return away || front || edge_on || (is_solid && not_away);
        };
        if (points_.size() == 0 || !include(points_[0]) || !include(points_[points_.size() - 1])) return false;
        for (std::size_t i = 1; i + 1 < points_.size(); ++i)
            if (!include(points_[i])) return false;
        range = range_of(face, away, front);
        return true;
    }

    WedgeSight<T> sight_;
    const PointTile<T>& tile_;
    const Points& points_;
    Visitor& visitor_;
};

}  // namespace detail
}  // namespace penumbra
