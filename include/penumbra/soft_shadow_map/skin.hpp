// Skins: from the edge of a caster, as one position on a line light sees it, to the surface seen just behind it. From
// the next position they cover what only part of the light between both reaches.
//
// Source: W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000; depth test and dilation
// are ours, see visibility_map.hpp.
#pragma once

#include <penumbra/numeric.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>

namespace penumbra {

/// A skin in a row of the map that it is drawn into: where its edge and its far end appear in that map (slopes from its
/// position), and their inverse depths.
template <class T>
struct Skin {
    RowPoint<T> edge, far;
};

/// The skin of a discontinuity that a map at `source` on the light sees at `slope`, between surfaces at inverse depths
/// `edge` and `far`, as a map at `target` sees it. Positions in world units; 0 ≤ far ≤ edge. Error: 3 roundings.
template <class T>
Skin<T> warp_skin(T slope, T edge, T far, T source, T target) {
    const T shift = source - target;
    return {{slope + shift * edge, edge}, {slope + shift * far, far}};
}

/// How far along a skin `slope` is in the image: 0 at the edge and before it, 1 at the far end, beyond it, and
/// everywhere for a skin of no width.
template <class T>
T skin_share(const Skin<T>& skin, T slope) {
    const T width = skin.far.slope - skin.edge.slope, along = slope - skin.edge.slope;
    if (width == T(0)) return T(1);
    return width < T(0) ? saturated_ratio(-along, -width) : saturated_ratio(along, width);
}

/// The inverse depth of a skin at `share` in [0, 1]: straight in space, so linear in the image. Error: 2 roundings.
template <class T>
T skin_inverse_depth(const Skin<T>& skin, T share) {
    return mix(skin.edge.inverse_depth, skin.far.inverse_depth, share);
}

/// The inverse depth of a straight receiver where a map at `target` sees it under the skin's edge. The receiver passes
/// through `seen` and `beyond`, two points of it as the light's centre sees them; it is parallel to the light, at the
/// first's depth, where both have one slope. Not below 0 nor above the edge's. Error: a rounding of each product over
/// the difference of the two points.
template <class T>
T receiver_under_edge(const Skin<T>& skin, const RowPoint<T>& seen, const RowPoint<T>& beyond, T target) {
    const T run = beyond.slope - seen.slope, rise = run == T(0) ? T(0) : beyond.inverse_depth - seen.inverse_depth;
    // on the line, and where the edge appears: slope - target * inverse depth = edge's
    const T across = run - target * rise, along = run * seen.inverse_depth + rise * (skin.edge.slope - seen.slope);
    const bool meets = across < T(0) || across > T(0);
    const T inverse = meets ? along / across : seen.inverse_depth;
    return clamp(inverse, T(0), skin.edge.inverse_depth);
}

}  // namespace penumbra
