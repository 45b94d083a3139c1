// Depth maps from positions on a line light: what each sees, in a picture whose rows are the planes through the light.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/detail/lit_casters.hpp>
#include <penumbra/detail/nearest_surfaces.hpp>
#include <penumbra/image.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <penumbra/raster.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <vector>

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

namespace detail {

/// Draws maps of a scene. What lies behind the light's plane, or at slopes above `widest`, is not in them.
template <class T>
class LightMapMaker {
  public:
    static constexpr double widest = 16.0;
    static constexpr int margin_tx = 4;  ///< steps are told by three texels on either side

    LightMapMaker() = default;
    /// Receivers are seen but hide nothing. `half_length` is that of the light.
    LightMapMaker(const std::vector<Mesh<T>>& casters, const std::vector<Mesh<T>>& receivers,
                  const LightFrame<T>& frame, T half_length, int resolution)
        : casters_(in_light_space(casters, frame)), receivers_(in_light_space(receivers, frame)) {
        near_ = 1e-6 * std::max(reach_of(casters_), reach_of(receivers_));
        for (Mesh<double>& mesh : casters_) mesh = lit_part(mesh, near_);
        for (Mesh<double>& mesh : receivers_) mesh = lit_part(mesh, near_);
        for (const Mesh<double>& mesh : casters_) {
            solid_.push_back(is_closed(edge_adjacency(mesh)));
            for (const Vec3<double>& p : mesh.positions) farthest_ = std::max(farthest_, p.z);
        }
        const Rect2<double> slopes =
            slopes_around(casters_, Vec2<double>(static_cast<double>(half_length), 0.0), widest, resolution, margin_tx);
        view_.slopes = {Vec2<T>(slopes.min), Vec2<T>(slopes.max)};
        view_.resolution = resolution;
    }

    const LightMapView<T>& view() const { return view_; }
    /// The depth of the farthest caster.
    double farthest() const { return farthest_; }

    LightMap<T> make(T position) const {
        constexpr T none = LightMap<T>::none;
        const int size = view_.resolution;
        const double at = static_cast<double>(position);
        LightMap<T> map;
        map.position = position;
        map.blocked = map.caster = map.receiver = Image<T>(size, size, none);
        map.bend = map.slack = Image<T>(size, size);
        Image<NearestSurfaces> nearest(size, size);
        const Vec2<double> low(view_.slopes.min);
        const Vec2<double> texel = (Vec2<double>(view_.slopes.max) - low) / static_cast<double>(size);
        for (std::size_t m = 0; m < casters_.size(); ++m)
            draw(casters_[m], at, [&](int x, int y, double depth, const Vec3<double>& normal) {
                const Vec3<double> ray(low.x + (x + 0.5) * texel.x, low.y + (y + 0.5) * texel.y, 1.0);
                if (!nearest(x, y).add(depth, depth_slack(normal, ray, texel, depth), solid_[m])) return;
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
        for (const Mesh<double>& mesh : receivers_)
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
        const Vec2<double> low(view_.slopes.min);
        const Vec2<double> scale = static_cast<double>(view_.resolution) / (Vec2<double>(view_.slopes.max) - low);
        const auto seen = [&](const Vec3<double>& p) {
            return RasterVertex<double>{(p.x - position - low.x * p.z) * scale.x, (p.y - low.y * p.z) * scale.y, p.z,
                                        p.z};
        };
        for (const glm::uvec3& t : mesh.triangles) {
            const Vec3<double>&a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
            const Vec3<double> normal = glm::cross(b - a, c - a);
            rasterize(seen(a), seen(b), seen(c), view_.resolution, view_.resolution, 0.5 * near_,
                      [&](int x, int y, double depth) { fragment(x, y, depth, normal); });
        }
    }

    std::vector<Mesh<double>> casters_, receivers_;
    std::vector<bool> solid_;
    double near_ = 0.0, farthest_ = 0.0;
    LightMapView<T> view_;
};

}  // namespace detail
}  // namespace penumbra
