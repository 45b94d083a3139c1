// Skins: from the edge of a caster, as one position on a line light sees it, to the surface seen just behind it. From
// the next position they cover what only part of the light between both reaches.
//
// Options: none
// Error:   a rounding of each sum, product and quotient; receiver_under_edge those of its sums over `across`
// Source:  W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000; depth test and dilation
//          are ours
// C++:     include/penumbra/soft_shadow_map/skin.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_SKIN_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_SKIN_GLSL

#include "../numeric.glsl"
#include "linear_visibility.glsl"

// A skin in a row of the map that it is drawn into: where its edge and its far end appear, and their inverse depths.
struct penumbra_Skin {
    penumbra_RowPoint edge, far;
};

// The skin of a discontinuity that a map at `source` on the light sees at `slope`, between surfaces at inverse depths
// `edge` and `far`, as a map at `target` sees it. Positions in world units; 0 <= far <= edge.
penumbra_Skin penumbra_warp_skin(float slope, float edge, float far, float source, float target) {
    float shift = source - target;
    penumbra_Skin skin;
    skin.edge = penumbra_row_point(slope + shift * edge, edge);
    skin.far = penumbra_row_point(slope + shift * far, far);
    return skin;
}

// How far along a skin `slope` is in the image: 0 at the edge and before it, 1 at the far end, beyond it, and
// everywhere for a skin of no width.
float penumbra_skin_share(penumbra_Skin skin, float slope) {
    float width = skin.far.slope - skin.edge.slope;
    float along = slope - skin.edge.slope;
    if (width == 0.0f) return 1.0f;
    return width < 0.0f ? penumbra_saturated_ratio(-along, -width) : penumbra_saturated_ratio(along, width);
}

// The inverse depth of a skin at `share`: straight in space, so linear in the image.
float penumbra_skin_inverse_depth(penumbra_Skin skin, float share) {
    return penumbra_mix(skin.edge.inverse_depth, skin.far.inverse_depth, share);
}

// The inverse depth of a straight receiver where a map at `target` sees it under the skin's edge. The receiver passes
// through `far` and `beyond`, two points of it; through the first in parallel to the light where both have one slope.
// Not below 0 nor above the edge.
float penumbra_receiver_under_edge(penumbra_Skin skin, penumbra_RowPoint seen, penumbra_RowPoint beyond, float target) {
    float run = beyond.slope - seen.slope;
    float rise = run == 0.0f ? 0.0f : beyond.inverse_depth - seen.inverse_depth;
    // on the line, and where the edge appears: slope - target * inverse depth = edge's
    float across = run - target * rise;
    float along = run * seen.inverse_depth + rise * (skin.edge.slope - seen.slope);
    bool meets = across < 0.0f || across > 0.0f;
    float inverse = meets ? along / across : seen.inverse_depth;
    return penumbra_clamp(inverse, 0.0f, skin.edge.inverse_depth);
}

#endif
