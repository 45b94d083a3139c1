// The texels of all maps of a line light: rows are the planes through the light, the same in every map.
//
// Options: none
// Error:   2 roundings; even_position 3
// Source:  W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000
// C++:     include/penumbra/soft_shadow_map/light_map.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_LIGHT_MAP_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_LIGHT_MAP_GLSL

#include "../geometry.glsl"
#include "../numeric.glsl"

// The depth of what is not there.
#define PENUMBRA_LIGHT_MAP_NONE 3.402823466e38f

// The image plane is parallel to the light: columns are slopes (x - position) / z, rows slopes y / z. `slopes` of its
// borders.
struct penumbra_LightMapView {
    penumbra_Rect2 slopes;
    int resolution;
};

bool penumbra_empty(penumbra_LightMapView view) {
    return !(view.slopes.min.x < view.slopes.max.x) || !(view.slopes.min.y < view.slopes.max.y);
}

// In texels; the number of a column is what it rounds down to.
float penumbra_column(penumbra_LightMapView view, float slope) {
    return (slope - view.slopes.min.x) / (view.slopes.max.x - view.slopes.min.x) * float(view.resolution);
}
float penumbra_row(penumbra_LightMapView view, float slope) {
    return (slope - view.slopes.min.y) / (view.slopes.max.y - view.slopes.min.y) * float(view.resolution);
}

// The slopes of a position in texels.
float penumbra_column_slope(penumbra_LightMapView view, float column) {
    return view.slopes.min.x + (view.slopes.max.x - view.slopes.min.x) / float(view.resolution) * column;
}
float penumbra_row_slope(penumbra_LightMapView view, float row) {
    return view.slopes.min.y + (view.slopes.max.y - view.slopes.min.y) / float(view.resolution) * row;
}

// Where on a light of this half length map `map` of `count` >= 2 is, from its centre: evenly from end to end.
float penumbra_even_position(float half_length, int map, int count) {
    return penumbra_mix(-half_length, half_length, float(map) / float(count - 1));
}

#endif
