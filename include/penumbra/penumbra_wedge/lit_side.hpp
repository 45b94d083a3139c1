// Whether points are on the lit side of a convex caster, or before it.
//
// A convex solid lies behind the plane of each of its faces: it hides nothing of a light that is before such a plane
// from points that are there as well. Points may be behind the plane by what the index takes for on it, if what they
// see through the face is the whole light. Source: ours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/penumbra_wedge/point_tile.hpp>
#include <penumbra/penumbra_wedge/wedge_sight.hpp>
#include <penumbra/penumbra_wedge/wedge_tree.hpp>

namespace penumbra::detail {

/// The light side of one face, in an index's units.
template <class T>
class LitFace {
  public:
    /// `half_size`: of the rectangle around the light. `tolerance`: how far points may be from a plane they are on.
    LitFace(const WedgeFace<T>& face, const Vec2<T>& half_size, T tolerance)
        : face_(face),
          tolerance_(tolerance),
          above_(-glm::dot(face.normal, face.a) - std::abs(face.normal.x) * half_size.x -
                 std::abs(face.normal.y) * half_size.y - T(2) * tolerance),
          half_(half_size) {}

    /// Whether the whole light is before the plane.
    bool faces_light() const { return above_ > T(0); }
    /// Whether the face lets a point see the whole light.
    bool opens(const Vec3<T>& point) const {
        constexpr T rounding = T(8) * std::numeric_limits<T>::epsilon();
        const Vec3<T> way = point - face_.a;
        const T distance = glm::dot(face_.normal, way), off = rounding * (largest_component(way) + tolerance_);
        if (distance > std::max(surely_off<T> * tolerance_, off)) return true;
        if (distance < -surely_on<T> * tolerance_) return false;
        const T across = std::abs(point.x) + half_.x + std::abs(point.y) + half_.y;
        const T around = (std::max(-distance, T(0)) + off) * (across + point.z) / above_;
        return is_inside(way, face_.b - face_.a, face_.c - face_.a, around) &&
               is_inside(way, face_.c - face_.a, face_.b - face_.a, around) &&
               is_inside(way - (face_.b - face_.a), face_.c - face_.b, face_.a - face_.b, around);
    }

  private:
    /// Whether a place is on the same side of an edge from the origin as the third corner, by so much at least.
    bool is_inside(const Vec3<T>& place, const Vec3<T>& edge, const Vec3<T>& corner, T around) const {
        const Vec3<T> in = glm::cross(face_.normal, edge);
        const T side = glm::dot(in, corner) < T(0) ? T(-1) : T(1);
        return side * glm::dot(in, place) >= around * glm::length(edge);
    }

    const WedgeFace<T>& face_;
    T tolerance_, above_;
    Vec2<T> half_;
};

/// Whether a piece, a convex solid that starts at that node, hides nothing from any of the points: size() and [i], at
/// most Points::capacity of them, all in the tile's box. False also where that is not seen.
template <class T, class Points>
bool hides_nothing(const WedgeSight<T>& sight, const PointTile<T>& tile, const Points& points, std::size_t piece) {
    std::array<bool, Points::capacity> is_open;
    std::size_t left = points.size();
    std::fill_n(is_open.begin(), left, false);
    const std::size_t end = left > 0 ? sight.tree.nodes[piece].skip : piece;
    for (std::size_t at = piece; at < end;) {
        const WedgeNode<T>& node = sight.tree.nodes[at];
        if (!sight.touches(tile, node.box)) {
            at = node.skip;
            continue;
        }
        for (std::size_t f = node.first_face; f < node.first_face + node.owned_faces; ++f) {
            const WedgeFace<T>& face = sight.tree.faces[f];
            const LitFace<T> lit(face, tile.light.max, sight.tolerance);
            if (!lit.faces_light() || !sight.touches(tile, box_of(face))) continue;
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (is_open[i] || !lit.opens(points[i])) continue;
                is_open[i] = true;
                if (--left == 0) return true;
            }
        }
        ++at;
    }
    return false;
}

}  // namespace penumbra::detail
