// Casters as maps from a light draw them: in its space, in double, and only what lies before its plane.
#pragma once

#include <algorithm>
#include <cstdint>
#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <vector>

namespace penumbra::detail {

template <class T>
LightFrame<double> exact_frame(const LightFrame<T>& frame) {
    return {Vec3<double>(frame.origin), Vec3<double>(frame.u), Vec3<double>(frame.v), Vec3<double>(frame.normal)};
}

template <class T>
std::vector<Mesh<double>> in_light_space(const std::vector<Mesh<T>>& meshes, const LightFrame<T>& frame) {
    const LightFrame<double> exact = exact_frame(frame);
    std::vector<Mesh<double>> result;
    for (const Mesh<T>& mesh : meshes) {
        result.push_back({{}, mesh.triangles});
        for (const Vec3<T>& p : mesh.positions) result.back().positions.push_back(exact.to_light(Vec3<double>(p)));
    }
    return result;
}

/// The largest coordinate of any vertex.
inline double reach_of(const std::vector<Mesh<double>>& meshes) {
    double reach = 0.0;
    for (const Mesh<double>& mesh : meshes)
        for (const Vec3<double>& p : mesh.positions) reach = std::max(reach, largest_component(p));
    return reach;
}

/// What of a mesh lies at depth `near` or beyond, welded.
inline Mesh<double> lit_part(const Mesh<double>& mesh, double near) {
    Mesh<double> result;
    for (const glm::uvec3& t : mesh.triangles) {
        ConvexPolygon<Vec3<double>, 4> polygon;
        for (int k = 0; k < 3; ++k) polygon.push(mesh.positions[t[k]]);
        polygon = clip(
            polygon, [&](const Vec3<double>& v) { return v.z - near; }, [&](Vec3<double>& v) { v.z = near; });
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (std::uint32_t k = 0; k < polygon.count; ++k) {
            result.positions.push_back(polygon.vertices[k]);
            if (k >= 2) result.triangles.emplace_back(first, first + k - 1, first + k);
        }
    }
    return weld(result);
}

/// Slopes x / z and y / z around all that casts a shadow of a light that reaches from −half_size to half_size in its
/// plane, at most `widest`, with `margin_tx` texels to spare.
inline Rect2<double> slopes_around(const std::vector<Mesh<double>>& lit, const Vec2<double>& half_size, double widest,
                                   int resolution, int margin_tx = 1) {
    Rect2<double> slopes = empty_rect<double>();
    for (const Mesh<double>& mesh : lit)
        for (const Vec3<double>& p : mesh.positions)
            for (const double way : {-1.0, 1.0})
                slopes = extend(slopes, Vec2<double>((p.x + way * half_size.x) / p.z, (p.y + way * half_size.y) / p.z));
    const Vec2<double> most(widest, widest);
    slopes = intersect(slopes, {-most, most});
    const Vec2<double> margin = (slopes.max - slopes.min) * (double(margin_tx) / resolution) + Vec2<double>(1e-9, 1e-9);
    return {slopes.min - margin, slopes.max + margin};
}

}  // namespace penumbra::detail
