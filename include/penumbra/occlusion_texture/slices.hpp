// Slices of the scene as occlusion textures: which slice a surface belongs to, capture, and what a point
// reads.
//
// The casters' depth range is cut into equal slices. A slice's texture says, for each ray of the slice
// camera, whether any surface blocks it inside the slice: all surfaces count, not only the first. Source: E.
// Eisemann & X. Décoret, "Plausible image based soft shadows using occlusion textures", 2006, section 3.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <penumbra/image.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/occlusion_texture/slice_camera.hpp>
#include <penumbra/raster.hpp>
#include <utility>
#include <vector>

namespace penumbra {

/// The plane that stands for all surfaces of a slice.
enum class SlicePlane {
    bottom,  ///< the side away from the light, as in the paper
    middle,  ///< half the error at few slices
};

/// Which faces are captured.
enum class SliceFaces {
    solid,   ///< closed meshes on the lit side are filled, so that nothing leaks through them; all faces of the others
    all,     ///< the paper; a solid counts as the two surfaces that a ray passes, front and back
    facing,  ///< only faces that look at the slice camera, of closed meshes on the lit side; all faces of the others
};

/// Equal slices of the depth range [first, first + count · thickness], world units from the light's plane.
template <class T>
struct SliceRange {
    T first = T(0), thickness = T(0);
    int count = 0;

    T top(int slice) const { return first + thickness * static_cast<T>(slice); }
    T bottom(int slice) const { return top(slice + 1); }
    /// The slice that a depth belongs to; the nearest one for depths outside. A depth on a boundary belongs
    /// to the slice behind it. Exact up to the rounding of (depth − first) / thickness.
    int slice_of(T depth) const {
        const T slices = static_cast<T>(count);
        const int slice = static_cast<int>(slices * saturated_ratio(depth - first, thickness * slices));
        return slice < count ? slice : count - 1;
    }
};

/// What keeps a surface from shadowing itself in the slice that holds it, where a texture that says "blocked"
/// cannot say whether before or behind the point.
enum class SelfShadow {
    fade,        ///< the paper: weight grows from 0 at the slice's top to 1 at its bottom; surfaces darken
                 ///< themselves
    clear,       ///< weight grows from 0 at the slice's bottom to 1 a slice further on; near contacts are lost
    mean_depth,  ///< what a slice holds counts if its mean depth in the kernel lies before the point; a
                 ///< second texture
};

/// Position of a depth relative to a slice: 0 at its top, 1 at its bottom. In [0, 4]; a slice without
/// thickness is passed at once.
template <class T>
T relative_depth(T top, T thickness, T depth) {
    return T(4) * saturated_ratio(depth - top, thickness * T(4));
}

/// The plane from which a slice is read. Nearer to the light than the slice's own plane while the point is
/// inside: half-way between slice top and point. Continuous in `point_depth`.
template <class T>
T slice_plane_depth(T top, T thickness, T point_depth, SlicePlane plane) {
    const T nominal = plane == SlicePlane::bottom ? top + thickness : top + thickness * T(0.5);
    const T half_way = (top + point_depth) * T(0.5);
    return half_way < nominal ? half_way : nominal;
}

/// How much of a slice counts at a point at `relative` depth, in [0, 1]: 0 in front of the slice, 1 far
/// behind it, monotone and continuous. `fade` and `clear` ignore `mean_depth`, the mean relative depth in [0,
/// 1] of what the kernel covers; `mean_depth` counts what lies more than `bias` before the point, in full
/// from 2 bias on. Lengths in slices.
template <class T>
T slice_weight(T relative, T mean_depth, T bias, SelfShadow mode) {
    if (mode == SelfShadow::fade) return saturate(relative);
    if (mode == SelfShadow::clear) return saturate(relative - T(1));
    return saturated_ratio(relative - mean_depth - bias, bias);
}

/// The casters' triangles in light space, cut at the light's plane, three vertices each.
template <class T>
struct LitTriangles {
    std::vector<Vec3<T>> vertices_ls;
    std::vector<SliceFaces> faces;  ///< one a triangle
};

/// Captured slices, ready to prefilter or to upload.
template <class T>
struct Slices {
    SliceCamera<T> camera;
    SliceRange<T> range;
    std::vector<Image<std::uint8_t>> masks;  ///< one a slice, 0 or 255; an empty image where nothing was captured
    /// One a slice: 255 × relative depth of the surface nearest to the light, 0 where the mask is 0. Its box
    /// mean over the mask's is `mean_depth` of slice_weight.
    std::vector<Image<std::uint8_t>> depths;
};

namespace detail {

/// Six times the signed volume that the triangles from `first` on enclose: negative if they are wound inside out.
template <class T>
T six_volumes(const std::vector<Vec3<T>>& vertices, std::size_t first) {
    T sum = T(0);
    for (std::size_t i = first; i < vertices.size(); i += 3)
        sum += glm::dot(vertices[i] - vertices[first],
                        glm::cross(vertices[i + 1] - vertices[first], vertices[i + 2] - vertices[first]));
    return sum;
}

/// A closed mesh's triangles are turned to look outwards, so that the windings of several solids add up.
template <class T>
void append_lit_triangles(const Mesh<T>& mesh, const LightFrame<T>& frame, SliceFaces faces, LitTriangles<T>& result) {
    const std::size_t first = result.vertices_ls.size();
    bool crosses_light_plane = false;
    for (const glm::uvec3& t : mesh.triangles) {
        ConvexPolygon<Vec3<T>, 4> polygon;
        for (int k = 0; k < 3; ++k) {
            polygon.push(frame.to_light(mesh.positions[t[k]]));
            crosses_light_plane |= polygon.vertices[polygon.count - 1].z < T(0);
        }
        polygon = clip(polygon, [](const Vec3<T>& v) { return v.z; });
        for (std::size_t i = 2; i < polygon.count; ++i)
            for (const std::size_t k : {std::size_t(0), i - 1, i}) result.vertices_ls.push_back(polygon.vertices[k]);
    }
    const bool encloses = faces != SliceFaces::all && !crosses_light_plane && is_closed(edge_adjacency(mesh));
    result.faces.insert(result.faces.end(), (result.vertices_ls.size() - first) / 3,
                        encloses ? faces : SliceFaces::all);
    if (encloses && six_volumes(result.vertices_ls, first) < T(0))
        for (std::size_t i = first; i < result.vertices_ls.size(); i += 3)
            std::swap(result.vertices_ls[i + 1], result.vertices_ls[i + 2]);
}

}  // namespace detail

/// The casters as the light sees them.
template <class T>
LitTriangles<T> lit_triangles(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, SliceFaces faces) {
    LitTriangles<T> result;
    for (const Mesh<T>& mesh : casters) detail::append_lit_triangles(mesh, frame, faces, result);
    return result;
}

/// The depth range of the triangles in `count` slices. It starts 1/4096 of its length before the nearest
/// surface, so that faces that divide the scene evenly, as the sides of boxes do, do not flicker between two
/// slices. Slices are at least 1e-5 of the farthest depth thick: a flat caster parallel to the light falls
/// into one slice, the others stay empty.
template <class T>
SliceRange<T> slice_range(const LitTriangles<T>& triangles, int count) {
    if (triangles.vertices_ls.empty()) return {T(0), T(0), count};
    T nearest = triangles.vertices_ls[0].z, farthest = nearest;
    for (const Vec3<T>& v : triangles.vertices_ls) {
        nearest = std::min(nearest, v.z);
        farthest = std::max(farthest, v.z);
    }
    const T slices = static_cast<T>(count);
    const T length = std::max(farthest - nearest, farthest * T(1e-5) * slices);
    const T lead = length * T(1.0 / 4096.0);
    return {nearest - lead, (length + lead) / slices, count};
}

namespace detail {

/// Slices while they are drawn.
template <class T>
struct SliceCapture {
    Slices<T> slices;
    std::vector<Image<std::int16_t>> windings;  ///< one a slice: surfaces of solids that enter, less those that leave

    SliceCapture(const SliceCamera<T>& camera, const SliceRange<T>& range) : slices{camera, range, {}, {}} {
        slices.masks.resize(static_cast<std::size_t>(range.count));
        slices.depths.resize(static_cast<std::size_t>(range.count));
        windings.resize(static_cast<std::size_t>(range.count));
    }

    template <class U>
    U& texel(std::vector<Image<U>>& images, int slice, int x, int y) const {
        Image<U>& image = images[static_cast<std::size_t>(slice)];
        if (image.empty()) image = Image<U>(slices.camera.width, slices.camera.height);
        return image(x, y);
    }

    /// A surface at `depth`, seen in `slice`.
    void add_surface(int slice, int x, int y, T depth) {
        const T relative = saturated_ratio(depth - slices.range.top(slice), slices.range.thickness);
        const auto coded = static_cast<std::uint8_t>(relative * T(255) + T(0.5));
        std::uint8_t &mask = texel(slices.masks, slice, x, y), &nearest = texel(slices.depths, slice, x, y);
        if (mask == 0 || coded < nearest) nearest = coded;
        mask = 255;
    }

    /// Fills what the surfaces of solids enclose: all that is inside at a slice's top.
    void fill_solids() {
        const bool any =
            std::any_of(windings.begin(), windings.end(), [](const auto& image) { return !image.empty(); });
        if (!any) return;
        Image<std::int16_t> inside(slices.camera.width, slices.camera.height);
        for (int slice = 0; slice < slices.range.count; ++slice) {
            for (int y = 0; y < inside.height(); ++y) {
                for (int x = 0; x < inside.width(); ++x) {
                    if (inside(x, y) == 0) continue;
                    texel(slices.masks, slice, x, y) = 255;
                    texel(slices.depths, slice, x, y) = 0;
                }
            }
            const Image<std::int16_t>& entering = windings[static_cast<std::size_t>(slice)];
            for (std::size_t i = 0; i < entering.size(); ++i)
                inside.data()[i] = static_cast<std::int16_t>(inside.data()[i] + entering.data()[i]);
        }
    }
};

}  // namespace detail

/// Rasterizes every triangle into the slices that hold it, and fills solids. With `close_leaks` the surface of an open
/// mesh is written to the succeeding slice too, so that an oblique surface cut by a slice boundary shows no gap; only
/// the `max` rule does not count it twice.
template <class T>
Slices<T> capture_slices(const LitTriangles<T>& triangles, const SliceCamera<T>& camera, const SliceRange<T>& range,
                         bool close_leaks) {
    detail::SliceCapture<T> capture(camera, range);
    for (std::size_t i = 0; i < triangles.faces.size(); ++i) {
        const Vec3<T>* v = &triangles.vertices_ls[3 * i];
        const SliceFaces faces = triangles.faces[i];
        const Vec3<T> to_camera = -v[0] * camera.convergence - Vec3<T>(T(0), T(0), T(1));
        if (faces == SliceFaces::facing && !(glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), to_camera) > T(0)))
            continue;
        rasterize(camera.project(v[0]), camera.project(v[1]), camera.project(v[2]), camera.width, camera.height, T(0),
                  [&](int x, int y, T depth, bool leaves) {
                      const int slice = range.slice_of(depth);
                      capture.add_surface(slice, x, y, depth);
                      if (faces == SliceFaces::solid) {
                          std::int16_t& winding = capture.texel(capture.windings, slice, x, y);
                          winding = static_cast<std::int16_t>(winding + (leaves ? -1 : 1));
                      } else if (close_leaks && slice + 1 < range.count) {
                          capture.add_surface(slice + 1, x, y, depth);
                      }
                  });
    }
    capture.fill_solids();
    return std::move(capture.slices);
}

/// A texel of four slices.
using SliceTexel = glm::vec<4, std::uint8_t, glm::defaultp>;

/// Four slices to a texel, as they are uploaded: slice 4k + c is channel c of image k. For masks and depths
/// alike; all images of one size, empty ones become zeros.
inline std::vector<Image<SliceTexel>> pack_rgba(const std::vector<Image<std::uint8_t>>& slices, int width, int height) {
    std::vector<Image<SliceTexel>> packed((slices.size() + 3) / 4, Image<SliceTexel>(width, height, SliceTexel(0)));
    for (std::size_t slice = 0; slice < slices.size(); ++slice) {
        SliceTexel* texels = packed[slice / 4].data();
        for (std::size_t i = 0; i < slices[slice].size(); ++i)
            texels[i][static_cast<int>(slice % 4)] = slices[slice].data()[i];
    }
    return packed;
}

}  // namespace penumbra
