// How D-buffers are drawn: casters, the sides of their volumes and silhouette faces, from the light's centre.
//
// All in light space and double; texels keep the type of the D-buffer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/lit_casters.hpp>
#include <penumbra/detail/nearest_surfaces.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/raster.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/hiding_edges.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <penumbra/umbra_volume/volume.hpp>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// Fills in a D-buffer whose radius, layers and kind of depth are set.
template <class T>
class DBufferBuilder {
  public:
    explicit DBufferBuilder(DBuffer<T>& buffer) : buffer_(buffer) {}

    void build(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, int resolution,
               VolumeSilhouette silhouette) {
        std::vector<Mesh<double>> meshes = in_light_space(casters, frame);
        const double reach = reach_of(meshes);
        near_ = 1e-6 * reach;
        for (Mesh<double>& mesh : meshes) mesh = lit_part(mesh, near_);
        const double radius = static_cast<double>(buffer_.radius_), widest = static_cast<double>(DBuffer<T>::widest);
        const Rect2<double> slopes = slopes_around(meshes, Vec2<double>(radius, radius), widest, resolution);
        buffer_.view_.slopes = {Vec2<T>(slopes.min), Vec2<T>(slopes.max)};
        buffer_.view_.resolution = resolution;
        const std::size_t count = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
        buffer_.casters_.assign(count, std::numeric_limits<T>::max());
        buffer_.umbra_.assign(count * buffer_.layer_count(), {});
        buffer_.penumbra_.assign(buffer_.umbra_.size(), {});
        std::vector<NearestSurfaces> surfaces(count);
        blocked_.assign(count, HidingEdge<T>::none);
        for (std::uint32_t m = 0; m < meshes.size(); ++m) draw(meshes[m], m, silhouette, reach, surfaces);
        for (int y = 0; y < resolution; ++y)
            for (int x = 0; x < resolution; ++x) {
                const NearestSurfaces& at = surfaces[buffer_.texel(x, y)];
                if (at.empty()) continue;
                const double between = at.has_inside() ? at.middle() : at.first + at.slack;
                buffer_.casters_[buffer_.texel(x, y)] = static_cast<T>(between * unit(x, y));
            }
    }

  private:
    RasterVertex<double> seen(const Vec3<double>& p) const {
        const Vec2<double> low(buffer_.view_.slopes.min), size(extent(buffer_.view_.slopes));
        const double scale = static_cast<double>(buffer_.view_.resolution);
        return {(p.x - low.x * p.z) * (scale / size.x), (p.y - low.y * p.z) * (scale / size.y), p.z, p.z};
    }
    Vec3<double> at(int x, int y, double depth) const {
        const Vec2<double> low(buffer_.view_.slopes.min), size(extent(buffer_.view_.slopes));
        const double scale = 1.0 / static_cast<double>(buffer_.view_.resolution);
        return Vec3<double>(low.x + size.x * (x + 0.5) * scale, low.y + size.y * (y + 0.5) * scale, 1.0) * depth;
    }
    template <class Fragment>
    void draw_triangle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c, Fragment&& fragment) const {
        rasterize(seen(a), seen(b), seen(c), buffer_.view_.resolution, buffer_.view_.resolution, 0.5 * near_, fragment);
    }

    void draw(const Mesh<double>& mesh, std::uint32_t number, VolumeSilhouette silhouette, double reach,
              std::vector<NearestSurfaces>& surfaces) {
        const EdgeAdjacency adjacency = edge_adjacency(mesh);
        draw_surfaces(mesh, is_closed(adjacency), number, surfaces);
        const double radius = static_cast<double>(buffer_.radius_), far = 1e4 * (reach + radius);
        const DiskLight<double> disk{Vec3<double>(0.0, 0.0, 0.0), Vec3<double>(0.0, 0.0, 1.0), radius};
        const DiskLight<double> seen_from{disk.center, disk.normal,
                                          silhouette == VolumeSilhouette::disk ? radius : 0.0};
        const VolumeSilhouettes silhouettes = volume_silhouettes(mesh, adjacency, seen_from, 1e-12 * reach);
        HidingEdges<T> edges(mesh, adjacency, silhouettes, number, buffer_.edges_);
        draw_faces(mesh, silhouettes.faces, edges);
        for (const VolumeKind kind : {VolumeKind::umbra, VolumeKind::penumbra})
            for (const std::vector<VolumeSide<double>>& loop :
                 volume_sides(mesh.positions, silhouettes, radius, kind, fan_step)) {
                edges.connect(loop);
                for (std::size_t i = 0; i < loop.size(); ++i)
                    if (loop[i].ridge && !loop[i].crossed) draw_side(loop[i], edges.of_side(loop, i), far);
            }
        for (const VolumeEdge& edge : silhouettes.looming) {
            const Vec3<double>&a = mesh.positions[edge.from], &b = mesh.positions[edge.to];
            const Vec3<double> rim = extrusion_points(a, b, disk).penumbra;
            draw_side({a, b, rim, rim, edge.from, edge.to, true, false, VolumeKind::penumbra},
                      edges.of(edge.from, edge.to), far);
        }
    }

    void draw_surfaces(const Mesh<double>& mesh, bool solid, std::uint32_t number,
                       std::vector<NearestSurfaces>& surfaces) {
        const Vec2<double> texel_size =
            extent(Rect2<double>{Vec2<double>(buffer_.view_.slopes.min), Vec2<double>(buffer_.view_.slopes.max)}) *
            (1.0 / static_cast<double>(buffer_.view_.resolution));
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const Vec3<double> normal = glm::cross(b - a, c - a);
            draw_triangle(a, b, c, [&](int x, int y, double depth) {
                surfaces[buffer_.texel(x, y)].add(depth, depth_slack(normal, at(x, y, 1.0), texel_size, depth), solid);
                blocked_[buffer_.texel(x, y)] = number;
            });
        }
    }

    /// Silhouette faces: a ray that leaves a solid through one leaves the umbra there.
    void draw_faces(const Mesh<double>& mesh, const std::vector<VolumeFace>& faces, const HidingEdges<T>& edges) {
        for (const VolumeFace& face : faces) {
            const glm::uvec3& t = mesh.triangles[face.face];
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const double toward = -glm::dot(glm::cross(b - a, c - a), a) * (face.turned ? -1.0 : 1.0);
            const std::uint32_t number = edges.of_face(face.face);
            if (toward > 0.0 || number == HidingEdges<T>::none) continue;
            const HidingEdge<T>& edge = buffer_.edges_[number];
            const auto edge_depth = static_cast<double>(std::min(edge.a.z, edge.b.z));
            draw_triangle(a, b, c, [&](int x, int y, double depth) {
                insert(buffer_.umbra_, x, y, depth, std::min(depth, edge_depth), number);
            });
        }
    }

    /// From depths to those of the image, along a texel's ray.
    double unit(int x, int y) const {
        return buffer_.view_.depth == DBufferDepth::euclidean ? glm::length(at(x, y, 1.0)) : 1.0;
    }
    /// Umbrae only along rays that their own caster blocks: behind its apex an umbra's sides bound nothing.
    void insert(std::vector<Crossing<T>>& layers, int x, int y, double depth, double silhouette_depth,
                std::uint32_t edge) {
        if (&layers == &buffer_.umbra_ && blocked_[buffer_.texel(x, y)] != buffer_.edges_[edge].mesh) return;
        const double to_image = unit(x, y);
        Crossing<T> crossing{static_cast<T>(depth * to_image), static_cast<T>(silhouette_depth * to_image), edge};
        Crossing<T>* const kept = layers.data() + buffer_.texel(x, y) * buffer_.layer_count();
        for (std::size_t k = 0; k < buffer_.layer_count(); ++k) {
            if (kept[k].edge == crossing.edge && kept[k].depth <= crossing.depth) return;  // once is enough
            if (crossing.depth < kept[k].depth) std::swap(crossing, kept[k]);
        }
    }

    void draw_side(const VolumeSide<double>& side, std::uint32_t number, double far) {
        std::vector<Crossing<T>>& layers = side.kind == VolumeKind::umbra ? buffer_.umbra_ : buffer_.penumbra_;
        const auto fragment = [&](int x, int y, double depth) {
            double silhouette_depth = side.a.z;
            if (!side.is_fan()) {
                const Vec3<double> along = side.b - side.a, ray = at(x, y, depth) - side.rim;
                const Vec3<double> across = glm::cross(ray, along);
                const double share = glm::dot(glm::cross(side.a - side.rim, along), across) / glm::dot(across, across);
                const double low = std::min(side.a.z, side.b.z), high = std::max(side.a.z, side.b.z);
                silhouette_depth = clamp(share * depth, low, high);
            }
            insert(layers, x, y, depth, silhouette_depth, number);
        };
        const Vec3<double> far_a = side.far_a(far), far_b = side.far_b(far);
        if (!side.is_fan()) draw_triangle(side.b, side.a, far_a, fragment);
        draw_triangle(side.b, far_a, far_b, fragment);
    }

    static constexpr double fan_step = 0.05;  // radians: an arc's triangle is off by 0.0003 r
    DBuffer<T>& buffer_;
    double near_ = 0.0;
    std::vector<std::uint32_t> blocked_;  // the last mesh that was drawn at a texel
};

}  // namespace penumbra::detail

namespace penumbra {

template <class T>
DBuffer<T>::DBuffer(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, T radius, int resolution,
                    int layers, VolumeSilhouette silhouette, DBufferDepth depth)
    : radius_(radius), layers_(layers) {
    view_.depth = depth;
    detail::DBufferBuilder<T>(*this).build(casters, frame, resolution, silhouette);
}

}  // namespace penumbra
