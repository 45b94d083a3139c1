// How much of a piece of a line light is seen past one edge: on skins by the paper, with a straight receiver, or
// exactly.
//
// What a point sees of a line light is decided in the plane through both. There, points are (slope, inverse depth),
// that is (x / z, 1 / z) in light space: straight lines stay straight; and seen from position p on the light, a point
// appears at slope − p · inverse depth, so that maps from several positions are one picture sheared. Source: W.
// Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000; eq. 1 in these coordinates.
#pragma once

#include <penumbra/numeric.hpp>

namespace penumbra {

/// A point in the plane through it and the light: x / z, and 1 / z ≥ 0. Depth z > 0 and x in world units.
template <class T>
struct RowPoint {
    T slope, inverse_depth;
};

/// Where `point` appears from `position` on the light, which is measured from the light's centre in world units. Error:
/// 2 roundings.
template <class T>
T slope_from(const RowPoint<T>& point, T position) {
    return point.slope - position * point.inverse_depth;
}

/// The fraction of the light between the positions `hidden` and `seen` that `point` sees past an edge whose caster
/// covers the side of `hidden`. In [0, 1], exact for that edge whatever the receiver; 1 if the edge is not nearer to
/// the light than the point. A piece of no length gives 0 or 1. Error: 2 ε · (|slopes| + |positions| inverse depth)
/// over the difference of inverse depths and the length of the piece.
template <class T>
T edge_visibility(const RowPoint<T>& edge, const RowPoint<T>& point, T hidden, T seen) {
    const T nearer = edge.inverse_depth - point.inverse_depth;
    if (!(nearer > T(0))) return T(1);
    const T past = seen * nearer - (edge.slope - point.slope);
    const T piece = seen - hidden;
    return piece < T(0) ? saturated_ratio(-past, -piece * nearer) : saturated_ratio(past, piece * nearer);
}

/// Visibility on a skin, `share` of the way in the image from its edge to its far end: linear, the paper. In [0, 1].
/// Error: (1 − √k) / (1 + √k) on a straight receiver, k being the smaller over the larger difference between the edge's
/// inverse depth and the receiver's at the two ends: .05 on a floor tilted by 30° under a penumbra of moderate width,
/// .3 under a wide one at 60°.
template <class T>
T skin_visibility(T share) {
    return saturate(share);
}

/// Visibility on a skin from an edge at `edge` to a far end at `far`, where the receiver's inverse depth is `receiver`;
/// all inverse depths. Exact with the receiver's own; eq. 1 with that of the straight line between the receiver's
/// depths under both ends. In [0, 1]; 1 where the receiver is not behind the edge.
template <class T>
T skin_visibility(T share, T edge, T far, T receiver) {
    const T behind = edge - receiver;
    return behind > T(0) ? saturated_ratio(share * (edge - far), behind) : T(1);
}

namespace detail {

/// A mean of what is seen of the parts of a light, exactly 1 where all of each is: weights need not sum to exactly 1.
template <class T>
class SeenParts {
  public:
    void add(T weight, T seen) {
        sum_ += weight * seen;
        whole_ = whole_ && seen >= T(1);
    }
    T mean() const { return whole_ ? T(1) : saturate(sum_); }

  private:
    T sum_ = T(0);
    bool whole_ = true;
};

}  // namespace detail
}  // namespace penumbra
