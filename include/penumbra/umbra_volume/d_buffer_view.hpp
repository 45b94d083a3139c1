// The image that a D-buffer is: directions from the light's centre, and depths along them.
#pragma once

#include <penumbra/geometry.hpp>
#include <penumbra/umbra_volume/options.hpp>

namespace penumbra {

/// The texels of an image from the light's centre: direction (x / z, y / z) in light space to texels.
template <class T>
struct DBufferView {
    Rect2<T> slopes;  ///< of the image's borders
    int resolution;
    DBufferDepth depth = DBufferDepth::light_plane;

    /// A point's depth, as the image has depths.
    T depth_of(const Vec3<T>& point_ls) const {
        return depth == DBufferDepth::euclidean ? safe_length(point_ls) : point_ls.z;
    }

    Vec2<T> to_texel(const Vec3<T>& point_ls) const {
        const Vec2<T> size = extent(slopes), slope(point_ls.x / point_ls.z, point_ls.y / point_ls.z);
        return Vec2<T>((slope.x - slopes.min.x) / size.x, (slope.y - slopes.min.y) / size.y) *
               static_cast<T>(resolution);
    }
};

}  // namespace penumbra
