// How the points of a tile see nodes and faces of a tree over casters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/silhouette.hpp>
#include <penumbra/penumbra_wedge/wedge_tree.hpp>

namespace penumbra::detail {

/// In tolerances: points farther from a plane surely are not on it, nearer ones surely are, however distances round.
template <class T>
constexpr T surely_off = T(1.0625);
template <class T>
constexpr T surely_on = T(0.9375);

/// Refers to the tree. A face is on a point if its plane passes within `tolerance` of it.
template <class T>
struct WedgeSight {
    using Node = WedgeNode<T>;
    using Face = WedgeFace<T>;

    const WedgeTree<T>& tree;
    SilhouetteFrom from;
    T tolerance;

    /// Whether nothing in a box can be in a pyramid; for a part of a piece, nor above one.
    static bool misses(const PointTile<T>& tile, const Box3<T>& box, bool is_part) {
        const T near = box.min.z, far = std::min(box.max.z, tile.box.max.z);
        if (near >= tile.box.max.z) return true;
        const Vec2<T> half = tile.light.max;
        return box.min.x - half.x > std::max(tile.right * near, tile.right * far) ||
               box.max.x + half.x < std::min(tile.left * near, tile.left * far) ||
               box.max.y + half.y < std::min(tile.bottom * near, tile.bottom * far) ||
               (!is_part && box.min.y - half.y > std::max(tile.top * near, tile.top * far));
    }

    /// How far the signed distances of a tile's points from planes may be from those of its centre, rounding included;
    /// `normal` bounds the components of the planes' unit normals, `way` those from the planes to the centre.
    static T spread(const PointTile<T>& tile, const Vec3<T>& normal, const Vec3<T>& way) {
        const Vec3<T> half = (tile.box.max - tile.box.min) * T(0.5);
        return std::min(tile.radius, glm::dot(normal, half)) +
               T(4) * std::numeric_limits<T>::epsilon() * glm::dot(normal, way + half);
    }
    /// Whether points may be on what is in a box.
    bool touches(const PointTile<T>& tile, const Box3<T>& box) const {
        return touch({tile.box.min - tolerance * T(2), tile.box.max + tolerance * T(2)}, box);
    }

    /// Whether all faces of a node count the same for every point, so that none of its edges does.
    bool has_no_silhouette(const PointTile<T>& tile, const Node& node) const {
        int least = node.least, most = node.most;
        if (from == SilhouetteFrom::light_center) {
            if (least != most || (least != 0 && touches(tile, node.box))) return false;
        } else {
            const Vec3<T> middle = (node.box.min + node.box.max) * T(0.5), way = tile.center - middle;
            const Vec3<T> a = way * node.normal_min, b = way * node.normal_max;
            const Vec3<T> low = glm::min(a, b), high = glm::max(a, b);
            const T room = spread(tile, glm::max(magnitudes(node.normal_min), magnitudes(node.normal_max)),
                                  magnitudes(way) + (node.box.max - middle));
            const T nearest = low.x + low.y + low.z + node.offset_min - room;
            const T farthest = high.x + high.y + high.z + node.offset_max + room;
            const bool away = farthest<-tolerance, not_away = nearest> - tolerance;
            const bool front = nearest > tolerance, edge_on = not_away && farthest < tolerance;
            if (!away && !(node.solid ? not_away : front || edge_on)) return false;
            const int coefficient = away ? -1 : front && !node.solid ? 1 : 0;
            least = std::min(least, coefficient), most = std::max(most, coefficient);
        }
        const bool none_reaches_beyond = node.box.max.z < tile.box.min.z;
        return least == most && (none_reaches_beyond || least == 0);
    }

    /// How often a face counts for points that see it from one side, or else edge-on.
    int count_of(const Face& face, bool away, bool front) const {
        if (from == SilhouetteFrom::light_center) return away || front ? face.from_light : 0;
        return away ? -1 : front && !face.solid ? 1 : 0;
    }
    /// From a face's plane: how often it counts for a point at this signed distance from it.
    T coefficient_of(const Face& face, T distance) const {
        const bool away = distance < -tolerance;
        return static_cast<T>(count_of(face, away, distance > tolerance));
    }
};

}  // namespace penumbra::detail
