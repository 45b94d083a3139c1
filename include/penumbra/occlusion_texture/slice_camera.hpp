// The camera that sees all slices: centred behind the light, so that one image serves every point of the
// light.
//
// In light space a point (X, Y, z) lands on (X, Y) / (1 + c z), where c = 1/d is the camera's convergence and
// d its distance behind the light. c = 0 is an orthographic camera. At depth 0 the image plane coincides with
// the light's plane, so lengths there are world lengths. There is no singularity on the lit side.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/geometry.hpp>
#include <penumbra/occlusion_texture/kernel.hpp>
#include <penumbra/raster.hpp>
#include <vector>

namespace penumbra {

/// Maps light space to the texels that all slices share.
template <class T>
struct SliceCamera {
    T convergence = T(0);               ///< 1 / distance of the centre behind the light; 0 is orthographic
    Vec2<T> origin_tx = Vec2<T>(0, 0);  ///< texel position of the optical axis
    Vec2<T> scale_tx = Vec2<T>(1, 1);   ///< texels per world unit at the light's plane
    int width = 1, height = 1;          ///< texels

    /// Homogeneous texel position of a point in light space. w > 0 for every point on the lit side.
    RasterVertex<T> project(const Vec3<T>& point_ls) const {
        const T w = T(1) + convergence * point_ls.z;
        return {point_ls.x * scale_tx.x + origin_tx.x * w, point_ls.y * scale_tx.y + origin_tx.y * w, point_ls.z, w};
    }

    /// The kernel of a point for a part of the light (see kernel_rect), in texels. Depths on the lit side.
    /// Source: Eisemann & Décoret 2006, section 3.2; in NDC: centre d P z / (S p (z + d)), half-size
    /// d (p − z) / (p (z + d)).
    Rect2<T> footprint(T occluder_depth, const Vec3<T>& point_ls, const Rect2<T>& light_part_ls) const {
        const T w = T(1) + convergence * (occluder_depth > T(0) ? occluder_depth : T(0));
        const Vec2<T> scale = scale_tx * (T(1) / w);
        const Rect2<T> kernel = kernel_rect(occluder_depth, point_ls, light_part_ls);
        return {kernel.min * scale + origin_tx, kernel.max * scale + origin_tx};
    }
};

/// How the slice camera is placed.
enum class SliceProjection {
    perspective,   ///< frustum through the light's edges, as wide as the scene needs
    orthographic,  ///< for comparison: spends texels where no point looks
};

namespace detail {

/// The light's proportions, longer side 1, shorter side at least 1/8; (1, 1) for a light without size.
template <class T>
Vec2<T> light_aspect(const Vec2<T>& half_size) {
    const T longer = std::max(half_size.x, half_size.y);
    if (!(longer >= std::numeric_limits<T>::min())) return Vec2<T>(T(1), T(1));
    return Vec2<T>(std::max(half_size.x / longer, T(0.125)), std::max(half_size.y / longer, T(0.125)));
}

/// The smallest convergence whose frustum through the light's edges holds `vertices_ls`, at most 16 / (their
/// depth).
template <class T>
T frustum_convergence(const std::vector<Vec3<T>>& vertices_ls, const Vec2<T>& half_size) {
    T depth = T(0);
    for (const Vec3<T>& v : vertices_ls) depth = std::max(depth, v.z);
    if (!(depth >= std::numeric_limits<T>::min())) return T(0);
    const T limit = T(16) / depth;
    T fraction = T(0);  // of the limit; the wanted value is (|X| − S) / (S z), never divided where it is larger
    for (const Vec3<T>& v : vertices_ls) {
        const Vec2<T> reach = half_size * (v.z * limit);
        fraction = std::max({fraction, saturated_ratio(std::abs(v.x) - half_size.x, reach.x),
                             saturated_ratio(std::abs(v.y) - half_size.y, reach.y)});
    }
    return limit * fraction;
}

}  // namespace detail

/// The camera for a light of half-extents `half_size` that sees every vertex of `vertices_ls` (light space,
/// depth ≥ 0), on at most `resolution` texels a side.
///
/// Perspective: the frustum runs through the light's edges and is just wide enough; its opening is limited to
/// 16 times the light's size at the farthest vertex. The image is then cut to the vertices' own rectangle,
/// plus `margin` empty texels on each side, so that a bilinear tap at the border reads "not blocked". Texels
/// take the light's proportions (up to 8 : 1), so that kernels are square in texels. No vertices: one texel.
template <class T>
SliceCamera<T> fit_slice_camera(const std::vector<Vec3<T>>& vertices_ls, const Vec2<T>& half_size,
                                SliceProjection projection, int resolution, int margin) {
    SliceCamera<T> camera;
    if (vertices_ls.empty()) return camera;
    if (projection == SliceProjection::perspective)
        camera.convergence = detail::frustum_convergence(vertices_ls, half_size);

    Rect2<T> window = empty_rect<T>();
    for (const Vec3<T>& v : vertices_ls) window = extend(window, Vec2<T>(v.x, v.y) / (T(1) + camera.convergence * v.z));
    const Vec2<T> size = extent(window), aspect = detail::light_aspect(half_size);
    const T inner = static_cast<T>(std::max(1, resolution - 2 * margin));
    const T tiny = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
    const T texel = std::max({size.x / aspect.x, size.y / aspect.y, tiny}) / inner;  // at aspect 1
    camera.scale_tx = T(1) / (aspect * texel);
    const Vec2<T> texels = glm::clamp(glm::ceil(size * camera.scale_tx), T(1), inner);
    camera.width = static_cast<int>(texels.x) + 2 * margin;
    camera.height = static_cast<int>(texels.y) + 2 * margin;
    const Vec2<T> middle(static_cast<T>(camera.width) * T(0.5), static_cast<T>(camera.height) * T(0.5));
    camera.origin_tx = middle - (window.min + window.max) * T(0.5) * camera.scale_tx;
    return camera;
}

}  // namespace penumbra
