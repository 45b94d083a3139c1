// How maps of a line light are drawn on the CPU.
#pragma once

#include <algorithm>
#include <cmath>
#include <penumbra/detail/nearest_surfaces.hpp>
#include <penumbra/image.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/raster.hpp>
#include <penumbra/soft_shadow_map/light_map.hpp>
#include <penumbra/soft_shadow_map/light_map_geometry.hpp>
#include <utility>

namespace penumbra::detail {

/// Draws maps of a scene on the CPU.
template <class T>
class LightMapMaker {
  public:
    explicit LightMapMaker(LightMapGeometry<T> geometry) : geometry_(std::move(geometry)) {}

    const LightMapGeometry<T>& geometry() const { return geometry_; }
    const LightMapView<T>& view() const { return geometry_.view; }
    /// The depth of the farthest caster.
    double farthest() const { return geometry_.farthest; }

    LightMap<T> make(T position) const {
        constexpr T none = LightMap<T>::none;
        const LightMapView<T>& view = geometry_.view;
        const int size = view.resolution;
        const double at = static_cast<double>(position);
        LightMap<T> map;
        map.position = position;
        map.blocked = map.caster = map.receiver = Image<T>(size, size, none);
        map.bend = map.slack = Image<T>(size, size);
        Image<NearestSurfaces> nearest(size, size);
        const Vec2<double> low(view.slopes.min);
        const Vec2<double> texel = (Vec2<double>(view.slopes.max) - low) / static_cast<double>(size);
        for (const LightMapCaster& caster : geometry_.casters)
            draw(caster.mesh, at, [&](int x, int y, double depth, const Vec3<double>& normal) {
                const Vec3<double> ray(low.x + (x + 0.5) * texel.x, low.y + (y + 0.5) * texel.y, 1.0);
                if (!nearest(x, y).add(depth, depth_slack(normal, ray, texel, depth), caster.solid)) return;
                map.slack(x, y) = static_cast<T>(row_slack(normal, ray, at, texel.y, depth));
                map.bend(x, y) = static_cast<T>(bend(normal, ray, texel.x) / depth);
            });
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const NearestSurfaces& here = nearest(x, y);
                if (here.empty()) continue;
                map.caster(x, y) = static_cast<T>(here.first);
                map.blocked(x, y) = static_cast<T>(here.first + here.slack);
                if (!here.has_inside()) continue;
                const double inside = 1.0 / here.first - 1.0 / here.middle();
                map.blocked(x, y) = std::min(map.blocked(x, y), static_cast<T>(here.middle()));
                map.slack(x, y) = std::min(map.slack(x, y), static_cast<T>(inside));
            }
        for (const Mesh<double>& mesh : geometry_.receivers)
            draw(mesh, at, [&](int x, int y, double depth, const Vec3<double>&) {
                map.receiver(x, y) = std::min(map.receiver(x, y), static_cast<T>(depth));
            });
        return map;
    }

  private:
    /// What the inverse depth of a plane, (n · ray) / k, changes by over a column, as a part of it.
    static double bend(const Vec3<double>& normal, const Vec3<double>& ray, double column) {
        const double facing = glm::dot(normal, ray);
        const double change = normal.x * column * (facing < 0.0 ? -1.0 : 1.0), most = 0.02 * std::abs(facing);
        return clamp(change, -most, most) / std::max(std::abs(facing), 1e-300);
    }
    /// What the inverse depth of a plane changes by over half a row at one slope from the light's centre, so that it is
    /// the same in all maps; at most 2 % of it.
    static double row_slack(const Vec3<double>& normal, const Vec3<double>& ray, double position, double row,
                            double depth) {
        const double facing = std::abs(glm::dot(normal, ray + Vec3<double>(position / depth, 0.0, 0.0)));
        return std::min(0.5 * std::abs(normal.y) * row, 0.02 * facing) / std::max(facing * depth, 1e-300);
    }

    template <class Fragment>
    void draw(const Mesh<double>& mesh, double position, Fragment&& fragment) const {
        const LightMapView<T>& view = geometry_.view;
        const Vec2<double> low(view.slopes.min);
        const Vec2<double> scale = static_cast<double>(view.resolution) / (Vec2<double>(view.slopes.max) - low);
        const auto seen = [&](const Vec3<double>& p) {
            return RasterVertex<double>{(p.x - position - low.x * p.z) * scale.x, (p.y - low.y * p.z) * scale.y, p.z,
                                        p.z};
        };
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const Vec3<double> normal = glm::cross(b - a, c - a);
            rasterize(seen(a), seen(b), seen(c), view.resolution, view.resolution, 0.5 * geometry_.near,
                      [&](int x, int y, double depth) { fragment(x, y, depth, normal); });
        }
    }

    LightMapGeometry<T> geometry_;
};

}  // namespace penumbra::detail
