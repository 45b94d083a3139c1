// The surfaces along a map's rays that are nearest to its light, and where between them a caster is.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <penumbra/geometry.hpp>

namespace penumbra::detail {

/// The two surfaces of a texel nearest to the light; depths from its plane.
struct NearestSurfaces {
    static constexpr double none = std::numeric_limits<double>::max();
    double first = none, second = none;
    double slack = 0.0;  ///< of the first: what its depth changes by over the texel
    bool solid = false;  ///< the first belongs to a closed mesh

    /// True if the surface is the first now.
    bool add(double depth, double change, bool of_solid) {
        const bool nearest = depth < first;
        if (nearest)
            second = first, first = depth, slack = change, solid = of_solid;
        else
            second = std::min(second, depth);
        return nearest;
    }
    bool empty() const { return !(first < none); }
    bool has_inside() const { return solid && second < none; }
    double middle() const { return 0.5 * (first + second); }
};

/// What the depth of a plane with this normal changes by over a texel of a map whose ray has slope (x / z, y / z, 1),
/// at `depth`; at least 1e-5 of it, for what renderers round of points on the plane, and at most 5 %. Any length of the
/// normal.
inline double depth_slack(const Vec3<double>& normal, const Vec3<double>& ray, const Vec2<double>& texel_size,
                          double depth) {
    // along the plane, depth is k / (n · slope)
    const double facing = std::abs(glm::dot(normal, ray));
    const double change = (std::abs(normal.x) * texel_size.x + std::abs(normal.y) * texel_size.y) * depth;
    return std::max(std::min(change, facing * 0.05 * depth) / std::max(facing, 1e-300), 1e-5 * depth);
}

}  // namespace penumbra::detail
