// How D-buffers are drawn on the CPU: casters, the sides of their volumes and silhouette faces, from the light's
// centre.
//
// All in light space and double; texels keep the type of the D-buffer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/detail/nearest_surfaces.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/raster.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/d_buffer_geometry.hpp>
#include <penumbra/umbra_volume/hiding_edges.hpp>
#include <penumbra/umbra_volume/volume.hpp>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// Fills in a D-buffer whose radius, layers and kind of depth are set.
template <class T>
class DBufferBuilder {
  public:
    explicit DBufferBuilder(DBuffer<T>& buffer) : buffer_(buffer) {}

    void build(DBufferGeometry<T> geometry, int resolution) {
        buffer_.view_.slopes = geometry.slopes;
        buffer_.view_.resolution = resolution;
        buffer_.edges_ = std::move(geometry.edges);
        near_ = geometry.near, far_ = geometry.far;
        const std::size_t count = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
        buffer_.casters_.assign(count, std::numeric_limits<T>::max());
        buffer_.umbra_.assign(count * buffer_.layer_count(), {});
        buffer_.penumbra_.assign(buffer_.umbra_.size(), {});
        std::vector<NearestSurfaces> surfaces(count);
        blocked_.assign(count, HidingEdge<T>::none);
        for (std::uint32_t m = 0; m < geometry.casters.size(); ++m) {
            const DBufferCaster& caster = geometry.casters[m];
            draw_surfaces(caster.mesh, caster.solid, m, surfaces);
            for (const DBufferFace& face : caster.faces) draw_face(caster.mesh, face);
            for (const DBufferSide& side : caster.sides) draw_side(side.side, side.edge);
        }
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

    void draw_face(const Mesh<double>& mesh, const DBufferFace& face) {
        const glm::uvec3& t = mesh.triangles[face.face];
        const HidingEdge<T>& edge = buffer_.edges_[face.edge];
        const auto edge_depth = static_cast<double>(std::min(edge.a.z, edge.b.z));
        draw_triangle(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], [&](int x, int y, double depth) {
            insert(buffer_.umbra_, x, y, depth, std::min(depth, edge_depth), face.edge);
        });
    }

    /// From depths to those of the image, along a texel's ray.
    double unit(int x, int y) const {
        return buffer_.view_.depth == DBufferDepth::euclidean ? glm::length(at(x, y, 1.0)) : 1.0;
    }
    /// Keeps the nearest crossings of different edges, whatever the order of drawing. Umbrae only along rays that their
    /// own caster blocks: behind its apex an umbra's sides bound nothing.
    void insert(std::vector<Crossing<T>>& layers, int x, int y, double depth, double silhouette_depth,
                std::uint32_t edge) {
        if (&layers == &buffer_.umbra_ && blocked_[buffer_.texel(x, y)] != buffer_.edges_[edge].mesh) return;
        const double to_image = unit(x, y);
        Crossing<T> crossing{static_cast<T>(depth * to_image), static_cast<T>(silhouette_depth * to_image), edge};
        Crossing<T>* const kept = layers.data() + buffer_.texel(x, y) * buffer_.layer_count();
        for (std::size_t k = 0; k < buffer_.layer_count(); ++k) {
            const bool again = kept[k].edge == crossing.edge;
            if (crossing.depth < kept[k].depth) std::swap(crossing, kept[k]);
            if (again) return;
        }
    }

    void draw_side(const VolumeSide<double>& side, std::uint32_t number) {
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
        const Vec3<double> far_a = side.far_a(far_), far_b = side.far_b(far_);
        if (!side.is_fan()) draw_triangle(side.b, side.a, far_a, fragment);
        draw_triangle(side.b, far_a, far_b, fragment);
    }

    DBuffer<T>& buffer_;
    double near_ = 0.0, far_ = 0.0;
    std::vector<std::uint32_t> blocked_;  // the last mesh that was drawn at a texel
};

}  // namespace penumbra::detail

namespace penumbra {

template <class T>
DBuffer<T>::DBuffer(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, T radius, int resolution,
                    int layers, VolumeSilhouette silhouette, DBufferDepth depth)
    : radius_(radius), layers_(layers) {
    view_.depth = depth;
    detail::DBufferBuilder<T>(*this).build(d_buffer_geometry(casters, frame, radius, resolution, silhouette),
                                           resolution);
}

}  // namespace penumbra
