// How D-buffers are drawn: casters, the sides of their volumes and silhouette faces, from the light's centre.
//
// All in light space and double; texels keep the type of the D-buffer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/raster.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>
#include <penumbra/umbra_volume/volume.hpp>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace penumbra::detail {

/// Fills in a D-buffer whose radius, layers and kind of depth are set.
template <class T>
class DBufferBuilder {
  public:
    explicit DBufferBuilder(DBuffer<T>& buffer)
        : view_(buffer.view_),
          radius_(buffer.radius_),
          layers_(buffer.layers_),
          casters_(buffer.casters_),
          umbra_(buffer.umbra_),
          penumbra_(buffer.penumbra_),
          edges_(buffer.edges_) {}

    void build(const std::vector<Mesh<T>>& casters, const LightFrame<T>& frame, int resolution,
               VolumeSilhouette silhouette) {
        const LightFrame<double> exact{Vec3<double>(frame.origin), Vec3<double>(frame.u), Vec3<double>(frame.v),
                                       Vec3<double>(frame.normal)};
        double reach = 0.0;
        std::vector<Mesh<double>> meshes;
        for (const Mesh<T>& mesh : casters) {
            Mesh<double> mesh_ls{{}, mesh.triangles};
            for (const Vec3<T>& p : mesh.positions) {
                mesh_ls.positions.push_back(exact.to_light(Vec3<double>(p)));
                reach = std::max(reach, largest_component(mesh_ls.positions.back()));
            }
            meshes.push_back(mesh_ls);
        }
        near_ = 1e-6 * reach;
        for (Mesh<double>& mesh : meshes) mesh = lit_part(mesh);
        look_at(meshes, resolution);
        const std::size_t count = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
        casters_.assign(count, std::numeric_limits<T>::max());
        umbra_.assign(count * layer_count(), {});
        penumbra_.assign(umbra_.size(), {});
        std::vector<Surface> surfaces(count);
        blocked_.assign(count, HidingEdge<T>::none);
        for (std::uint32_t m = 0; m < meshes.size(); ++m) draw(meshes[m], m, silhouette, reach, surfaces);
        for (int y = 0; y < resolution; ++y)
            for (int x = 0; x < resolution; ++x) {
                const double between = surfaces[texel(x, y)].between();
                constexpr auto none = static_cast<double>(std::numeric_limits<T>::max());
                casters_[texel(x, y)] = static_cast<T>(between < none ? between * unit(x, y) : none);
            }
    }

  private:
    /// The two surfaces of a texel nearest to the light.
    struct Surface {
        double first = std::numeric_limits<double>::max(), second = std::numeric_limits<double>::max();
        double slack = 0.0;  ///< of the first: what its depth changes by over the texel
        bool solid = false;

        void add(double depth, double change, bool of_solid) {
            if (depth < first)
                second = first, first = depth, slack = change, solid = of_solid;
            else
                second = std::min(second, depth);
        }
        double between() const {
            constexpr auto none = static_cast<double>(std::numeric_limits<T>::max());
            if (!(first < none)) return none;
            return solid && second < none ? 0.5 * (first + second) : first + slack;
        }
    };

    using EdgeNumbers = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

    std::size_t layer_count() const { return static_cast<std::size_t>(layers_); }
    std::size_t texel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.resolution) + static_cast<std::size_t>(x);
    }

    /// What of a mesh lies before the light's plane.
    Mesh<double> lit_part(const Mesh<double>& mesh) const {
        Mesh<double> result;
        for (const glm::uvec3& t : mesh.triangles) {
            ConvexPolygon<Vec3<double>, 4> polygon;
            for (int k = 0; k < 3; ++k) polygon.push(mesh.positions[t[k]]);
            polygon = clip(
                polygon, [&](const Vec3<double>& v) { return v.z - near_; }, [&](Vec3<double>& v) { v.z = near_; });
            const auto first = static_cast<std::uint32_t>(result.positions.size());
            for (std::uint32_t k = 0; k < polygon.count; ++k) {
                result.positions.push_back(polygon.vertices[k]);
                if (k >= 2) result.triangles.emplace_back(first, first + k - 1, first + k);
            }
        }
        return weld(result);
    }

    /// Slopes around all that volumes may reach.
    void look_at(const std::vector<Mesh<double>>& meshes, int resolution) {
        Rect2<double> slopes = empty_rect<double>();
        const double radius = static_cast<double>(radius_);
        for (const Mesh<double>& mesh : meshes)
            for (const Vec3<double>& p : mesh.positions)
                for (const double way : {-radius, radius})
                    slopes = extend(slopes, Vec2<double>((p.x + way) / p.z, (p.y + way) / p.z));
        const Vec2<double> most(static_cast<double>(DBuffer<T>::widest), static_cast<double>(DBuffer<T>::widest));
        slopes = intersect(slopes, {-most, most});
        const Vec2<double> margin = (slopes.max - slopes.min) * (1.0 / resolution) + Vec2<double>(1e-9, 1e-9);
        view_.slopes = {Vec2<T>(slopes.min - margin), Vec2<T>(slopes.max + margin)};
        view_.resolution = resolution;
    }

    RasterVertex<double> seen(const Vec3<double>& p) const {
        const Vec2<double> low(view_.slopes.min), size(extent(view_.slopes));
        const double scale = static_cast<double>(view_.resolution);
        return {(p.x - low.x * p.z) * (scale / size.x), (p.y - low.y * p.z) * (scale / size.y), p.z, p.z};
    }
    Vec3<double> at(int x, int y, double depth) const {
        const Vec2<double> low(view_.slopes.min), size(extent(view_.slopes));
        const double scale = 1.0 / static_cast<double>(view_.resolution);
        return Vec3<double>(low.x + size.x * (x + 0.5) * scale, low.y + size.y * (y + 0.5) * scale, 1.0) * depth;
    }
    template <class Fragment>
    void draw_triangle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c, Fragment&& fragment) const {
        rasterize(seen(a), seen(b), seen(c), view_.resolution, view_.resolution, 0.5 * near_, fragment);
    }

    void draw(const Mesh<double>& mesh, std::uint32_t number, VolumeSilhouette silhouette, double reach,
              std::vector<Surface>& surfaces) {
        const EdgeAdjacency adjacency = edge_adjacency(mesh);
        const bool solid = is_closed(adjacency);
        const Vec2<double> texel_size =
            extent(Rect2<double>{Vec2<double>(view_.slopes.min), Vec2<double>(view_.slopes.max)}) *
            (1.0 / static_cast<double>(view_.resolution));
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const Vec3<double> normal = glm::cross(b - a, c - a);
            draw_triangle(a, b, c, [&](int x, int y, double depth) {
                // along the plane, depth is k / (n · slope)
                const double facing = std::abs(glm::dot(normal, at(x, y, 1.0)));
                const double change = (std::abs(normal.x) * texel_size.x + std::abs(normal.y) * texel_size.y) * depth;
                const double slack = std::min(change, facing * 0.05 * depth) / std::max(facing, 1e-300);
                surfaces[texel(x, y)].add(depth, slack, solid);
                blocked_[texel(x, y)] = number;
            });
        }
        const double radius = static_cast<double>(radius_), far = 1e4 * (reach + radius);
        const DiskLight<double> light{Vec3<double>(0.0, 0.0, 0.0), Vec3<double>(0.0, 0.0, 1.0),
                                      silhouette == VolumeSilhouette::disk ? radius : 0.0};
        const VolumeSilhouettes silhouettes = volume_silhouettes(mesh, adjacency, light, 1e-12 * reach);
        EdgeNumbers numbers;
        for (const std::vector<VolumeEdge>* edges : {&silhouettes.umbra, &silhouettes.penumbra, &silhouettes.looming})
            for (const VolumeEdge& e : *edges)
                if (numbers.try_emplace({e.from, e.to}, static_cast<std::uint32_t>(edges_.size())).second)
                    edges_.push_back({Vec3<T>(mesh.positions[e.from]), Vec3<T>(mesh.positions[e.to]), number});
        draw_faces(mesh, adjacency, silhouettes, numbers);
        for (const VolumeKind kind : {VolumeKind::umbra, VolumeKind::penumbra})
            for (const std::vector<VolumeSide<double>>& loop :
                 volume_sides(mesh.positions, silhouettes, radius, kind, fan_step))
                draw(loop, number, numbers, far);
        const DiskLight<double> disk{light.center, light.normal, radius};
        for (const VolumeEdge& edge : silhouettes.looming) {
            const Vec3<double>&a = mesh.positions[edge.from], &b = mesh.positions[edge.to];
            const Vec3<double> rim = extrusion_points(a, b, disk).penumbra;
            draw({a, b, rim, rim, edge.from, edge.to, true, false, VolumeKind::penumbra},
                 numbers.at({edge.from, edge.to}), far);
        }
    }

    /// Silhouette faces: a ray that leaves a solid through one leaves the umbra there. What hides from beyond is the
    /// chain of edges of which the faces lie between, as far as the next of either silhouette; such edges are chained.
    void draw_faces(const Mesh<double>& mesh, const EdgeAdjacency& adjacency, const VolumeSilhouettes& silhouettes,
                    const EdgeNumbers& numbers) {
        constexpr std::uint32_t none = HidingEdge<T>::none;
        std::vector<bool> is_some(mesh.triangles.size(), false);
        for (const VolumeFace& face : silhouettes.faces) is_some[face.face] = true;
        // for each face, the edge of the penumbra and of the umbra to which the faces between turn least
        std::vector<std::array<std::uint32_t, 2>> nearest(mesh.triangles.size(), {none, none});
        std::vector<std::vector<std::uint32_t>> neighbours(mesh.triangles.size());
        for (const Edge& edge : adjacency.edges)
            for (std::uint32_t i = 0; i < edge.count; ++i)
                for (std::uint32_t k = 0; k < edge.count; ++k) {
                    const std::uint32_t f = adjacency.faces[edge.first + i].face;
                    const std::uint32_t g = adjacency.faces[edge.first + k].face;
                    if (f != g && is_some[f] && is_some[g]) neighbours[f].push_back(g);
                }
        const auto normal = [&](std::uint32_t face) {
            const glm::uvec3& t = mesh.triangles[face];
            const Vec3<double>& a = mesh.positions[t.x];
            return normalize_or(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a), Vec3<double>(0, 0, 0));
        };
        for (std::size_t k = 0; k < 2; ++k) {
            using Step = std::tuple<double, std::uint32_t, std::uint32_t>;  // turn so far, face, edge
            std::priority_queue<Step, std::vector<Step>, std::greater<Step>> open;
            for (const VolumeEdge& e : k == 0 ? silhouettes.penumbra : silhouettes.umbra)
                for_faces_at(adjacency, e, [&](std::uint32_t face) {
                    if (is_some[face]) open.emplace(0.0, face, numbers.at({e.from, e.to}));
                });
            while (!open.empty()) {
                const auto [turn, face, edge] = open.top();
                open.pop();
                if (nearest[face][k] != none) continue;
                nearest[face][k] = edge;
                for (const std::uint32_t next : neighbours[face])
                    if (nearest[next][k] == none)
                        open.emplace(turn + 1.0 - glm::dot(normal(face), normal(next)), next, edge);
            }
        }
        for (std::size_t k = 0; k < 2; ++k)
            for (const VolumeEdge& e : k == 0 ? silhouettes.penumbra : silhouettes.umbra)
                for_faces_at(adjacency, e, [&](std::uint32_t face) {
                    HidingEdge<T>& edge = edges_[numbers.at({e.from, e.to})];
                    if (is_some[face] && nearest[face][1 - k] != none && &edges_[nearest[face][1 - k]] != &edge)
                        edge.chained = nearest[face][1 - k];
                });
        for (const VolumeFace& face : silhouettes.faces) {
            const glm::uvec3& t = mesh.triangles[face.face];
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const double toward = -glm::dot(glm::cross(b - a, c - a), a) * (face.turned ? -1.0 : 1.0);
            const std::uint32_t lit = nearest[face.face][0], dark = nearest[face.face][1];
            const std::uint32_t number = lit != none ? lit : dark;
            if (toward > 0.0 || number == none) continue;
            const HidingEdge<T>& edge = edges_[number];
            draw_triangle(a, b, c, [&](int x, int y, double depth) {
                insert(umbra_, x, y, depth, std::min(depth, static_cast<double>(std::min(edge.a.z, edge.b.z))), number);
            });
        }
    }
    template <class Use>
    static void for_faces_at(const EdgeAdjacency& adjacency, const VolumeEdge& e, Use&& use) {
        const std::uint32_t a = std::min(e.from, e.to), b = std::max(e.from, e.to);
        const auto edge = std::lower_bound(adjacency.edges.begin(), adjacency.edges.end(), std::make_pair(a, b),
                                           [](const Edge& x, const std::pair<std::uint32_t, std::uint32_t>& y) {
                                               return x.a != y.first ? x.a < y.first : x.b < y.second;
                                           });
        for (std::uint32_t i = 0; i < edge->count; ++i) use(adjacency.faces[edge->first + i].face);
    }

    /// From depths to those of the image, along a texel's ray.
    double unit(int x, int y) const {
        return view_.depth == DBufferDepth::euclidean ? glm::length(at(x, y, 1.0)) : 1.0;
    }
    /// Umbrae only along rays that their own caster blocks: behind its apex an umbra's sides bound nothing.
    void insert(std::vector<Crossing<T>>& layers, int x, int y, double depth, double silhouette_depth,
                std::uint32_t edge) {
        if (&layers == &umbra_ && blocked_[texel(x, y)] != edges_[edge].mesh) return;
        const double to_image = unit(x, y);
        Crossing<T> crossing{static_cast<T>(depth * to_image), static_cast<T>(silhouette_depth * to_image), edge};
        Crossing<T>* const kept = layers.data() + texel(x, y) * layer_count();
        for (std::size_t k = 0; k < layer_count(); ++k) {
            if (kept[k].edge == crossing.edge && kept[k].depth <= crossing.depth) return;  // once is enough
            if (crossing.depth < kept[k].depth) std::swap(crossing, kept[k]);
        }
    }

    /// Whether sides belong to one edge, there and back.
    static bool are_one(const VolumeSide<double>& x, const VolumeSide<double>& y) {
        return x.from == y.to && x.to == y.from;
    }
    /// Neighbours around outer corners, of the edges of a loop.
    void connect(const std::vector<VolumeSide<double>>& loop, const EdgeNumbers& numbers) {
        const std::size_t count = loop.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (loop[i].is_fan()) continue;
            bool outer = true;
            std::size_t k = (i + 1) % count;
            for (; loop[k].is_fan(); k = (k + 1) % count)
                outer = outer && loop[k].crossed == (loop[k].kind == VolumeKind::umbra);
            if (!outer || k == i || are_one(loop[i], loop[k])) continue;
            const std::uint32_t edge = numbers.at({loop[i].from, loop[i].to});
            const std::uint32_t next = numbers.at({loop[k].from, loop[k].to});
            edges_[edge].after = next, edges_[next].before = edge;
        }
    }

    /// Quads with their edges; fans with the corner between two, at a tip with the tangent of their arc.
    void draw(const std::vector<VolumeSide<double>>& loop, std::uint32_t mesh, const EdgeNumbers& numbers, double far) {
        const std::size_t count = loop.size();
        const auto is_fan = [](const VolumeSide<double>& side) { return side.is_fan(); };
        const bool tip = std::all_of(loop.begin(), loop.end(), is_fan);
        if (!tip) connect(loop, numbers);
        std::uint32_t corner = HidingEdge<T>::none;  // of the fan that is being drawn
        for (std::size_t i = 0; i < count; ++i) {
            const VolumeSide<double>& side = loop[i];
            if (!side.is_fan()) {
                corner = HidingEdge<T>::none;
                if (side.ridge) draw(side, numbers.at({side.from, side.to}), far);
                continue;
            }
            if (!side.ridge || side.crossed) continue;
            std::size_t before = i, after = i;
            while (!tip && loop[before].is_fan()) before = (before + count - 1) % count;
            while (!tip && loop[after].is_fan()) after = (after + 1) % count;
            if (tip || are_one(loop[before], loop[after])) {
                const std::array<Vec3<double>, 2> edge = side.hiding_edge();
                edges_.push_back({Vec3<T>(edge[0]), Vec3<T>(edge[1]), mesh});
                draw(side, static_cast<std::uint32_t>(edges_.size() - 1), far);
                continue;
            }
            if (corner == HidingEdge<T>::none) {
                HidingEdge<T> edge = edges_[numbers.at({loop[before].from, loop[before].to})];
                edge.corner = numbers.at({loop[after].from, loop[after].to});
                corner = static_cast<std::uint32_t>(edges_.size());
                edges_.push_back(edge);
            }
            draw(side, corner, far);
        }
    }

    void draw(const VolumeSide<double>& side, std::uint32_t number, double far) {
        std::vector<Crossing<T>>& layers = side.kind == VolumeKind::umbra ? umbra_ : penumbra_;
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
    DBufferView<T>& view_;
    const T radius_;
    const int layers_;
    std::vector<T>& casters_;
    std::vector<Crossing<T>>&umbra_, &penumbra_;
    std::vector<HidingEdge<T>>& edges_;
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
