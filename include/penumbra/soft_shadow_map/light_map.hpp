// Depth maps from positions on a line light: what each sees, in a picture whose rows are the planes through the light.
#pragma once

#include <algorithm>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// The texels of all maps of a light. The image plane is parallel to the light, so that a point in light space appears
/// in the same row in every map: columns are slopes (x − position) / z, rows slopes y / z.
template <class T>
struct LightMapView {
    Rect2<T> slopes{Vec2<T>(T(0), T(0)), Vec2<T>(T(0), T(0))};  ///< of the image's borders
    int resolution = 0;

    bool empty() const { return !(slopes.min.x < slopes.max.x) || !(slopes.min.y < slopes.max.y); }
    /// In texels; the number of a column is what it rounds down to.
    T column(T slope) const {
        return (slope - slopes.min.x) / (slopes.max.x - slopes.min.x) * static_cast<T>(resolution);
    }
    T row(T slope) const { return (slope - slopes.min.y) / (slopes.max.y - slopes.min.y) * static_cast<T>(resolution); }
    /// The slopes of a position in texels.
    T column_slope(T column) const {
        return slopes.min.x + (slopes.max.x - slopes.min.x) / static_cast<T>(resolution) * column;
    }
    T row_slope(T row) const { return slopes.min.y + (slopes.max.y - slopes.min.y) / static_cast<T>(resolution) * row; }
};

/// Where on a light of this half length map `map` of `count` ≥ 2 is, from its centre: evenly from end to end. Error: 3
/// roundings.
template <class T>
T even_position(T half_length, int map, int count) {
    return mix(-half_length, half_length, static_cast<T>(map) / static_cast<T>(count - 1));
}

/// What one position on the light sees; depths from the light's plane, world units, `none` where there is nothing.
template <class T>
struct LightMap {
    static constexpr T none = std::numeric_limits<T>::max();

    T position{};      ///< from the light's centre, world units
    Image<T> blocked;  ///< beyond this the ray is blocked: a little within the nearest caster, so that it is not itself
    Image<T> caster;   ///< the nearest caster
    Image<T> receiver;  ///< the nearest receiver
    Image<T> bend;      ///< what the caster's inverse depth changes by to the next column, at most 2 % of it
    Image<T> slack;     ///< what it changes by over half a row, and no more than to its middle

    /// The nearest of casters and receivers.
    T surface(int x, int y) const { return std::min(caster(x, y), receiver(x, y)); }
    /// 1 over a depth; 0 for none.
    static T inverse(T depth) { return depth < none ? T(1) / depth : T(0); }
};

}  // namespace penumbra
