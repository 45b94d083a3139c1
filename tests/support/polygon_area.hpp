// Exact visibility of a light behind a few convex polygons, in double: the truth that ray tracing itself is checked
// against. Each polygon is projected from the point on the light's plane and cut to the light; areas of unions come by
// inclusion and exclusion. Shares no code with the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <penumbra/light.hpp>
#include <utility>
#include <vector>

namespace penumbra::test {

using Polygon2 = std::vector<glm::dvec2>;
using Polygon3 = std::vector<glm::dvec3>;

/// The part of a convex polygon where `side` ≥ 0, `side` being linear.
template <class Polygon, class Side>
Polygon cut(const Polygon& polygon, Side side) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = side(a), db = side(b);
        if (da >= 0.0) result.push_back(a);
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Signed area, positive counter-clockwise.
inline double area(const Polygon2& polygon) {
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return 0.5 * twice;
}

/// Intersection of two convex polygons, both counter-clockwise.
inline Polygon2 intersection(Polygon2 a, const Polygon2& b) {
    if (b.size() < 3) return {};
    for (std::size_t i = 0; i < b.size() && !a.empty(); ++i) {
        const glm::dvec2 from = b[i], along = b[(i + 1) % b.size()] - from;
        a = cut(a, [&](const glm::dvec2& p) { return cross(along, p - from); });
    }
    return a;
}

/// Signed area of the triangle (0, a, b) inside the circle of radius r around 0.
inline double triangle_in_circle(const glm::dvec2& a, const glm::dvec2& b, double r) {
    const auto sector = [&](const glm::dvec2& p, const glm::dvec2& q) {
        return 0.5 * r * r * std::atan2(cross(p, q), glm::dot(p, q));
    };
    const glm::dvec2 d = b - a;
    const double dd = glm::dot(d, d), ad = glm::dot(a, d), inside = r * r * dd - cross(a, b) * cross(a, b);
    if (!(dd > 0.0) || inside <= 0.0) return sector(a, b);
    const double t0 = (-ad - std::sqrt(inside)) / dd, t1 = (-ad + std::sqrt(inside)) / dd;
    if (t1 <= 0.0 || t0 >= 1.0) return sector(a, b);
    const glm::dvec2 enter = t0 > 0.0 ? a + d * t0 : a, leave = t1 < 1.0 ? a + d * t1 : b;
    return (t0 > 0.0 ? sector(a, enter) : 0.0) + 0.5 * cross(enter, leave) + (t1 < 1.0 ? sector(leave, b) : 0.0);
}

/// Area of a polygon inside that circle; as area() for a radius beyond every vertex.
inline double area_in_circle(const Polygon2& polygon, double r) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += triangle_in_circle(polygon[i], polygon[(i + 1) % polygon.size()], r);
    return sum;
}

/// measure(union of the polygons), for any additive `measure` of convex polygons. Cost 2^polygons at worst.
template <class Measure>
double union_measure(const std::vector<Polygon2>& polygons, Measure measure) {
    double sum = 0.0;
    const auto add = [&](const auto& self, const Polygon2& common, std::size_t next, double sign) -> void {
        for (std::size_t i = next; i < polygons.size(); ++i) {
            const Polygon2 both = common.empty() ? polygons[i] : intersection(common, polygons[i]);
            if (both.size() < 3) continue;
            sum += sign * measure(both);
            self(self, both, i + 1, -sign);
        }
    };
    add(add, {}, 0, 1.0);
    return sum;
}

/// The shadows of `casters` that P throws back on the light's plane, in the plane's coordinates, counter-clockwise.
/// P lies at positive depth; only what lies between the plane and P counts.
inline std::vector<Polygon2> project(const LightFrame<double>& frame, const glm::dvec3& point_ws,
                                     const std::vector<Polygon3>& casters) {
    const glm::dvec3 p = frame.to_light(point_ws);
    std::vector<Polygon2> result;
    for (const Polygon3& caster_ws : casters) {
        Polygon3 caster;
        for (const glm::dvec3& v : caster_ws) caster.push_back(frame.to_light(v));
        caster = cut(caster, [](const glm::dvec3& v) { return v.z; });
        caster = cut(caster, [&](const glm::dvec3& v) { return p.z * (1.0 - 1e-6) - v.z; });
        Polygon2 shadow;
        for (const glm::dvec3& v : caster)
            shadow.push_back(glm::dvec2(p) + (glm::dvec2(v) - glm::dvec2(p)) * (p.z / (p.z - v.z)));
        if (area(shadow) < 0.0) std::reverse(shadow.begin(), shadow.end());
        if (shadow.size() >= 3) result.push_back(shadow);
    }
    return result;
}

/// Fraction of the light that P sees past convex, planar polygons. P lies in front of the light.
inline double exact_visibility(const glm::dvec3& point, const RectLight<double>& light,
                               const std::vector<Polygon3>& casters) {
    const LightFrame<double> frame = light_frame(light);
    const double w = glm::length(light.half_u), h = glm::length(light.half_v);
    std::vector<Polygon2> shadows = project(frame, point, casters);
    for (Polygon2& shadow : shadows) shadow = intersection(shadow, {{-w, -h}, {w, -h}, {w, h}, {-w, h}});
    return 1.0 - union_measure(shadows, area) / (4.0 * w * h);
}

inline double exact_visibility(const glm::dvec3& point, const DiskLight<double>& light,
                               const std::vector<Polygon3>& casters) {
    const double r = light.radius;
    const std::vector<Polygon2> shadows = project(light_frame(light), point, casters);
    return 1.0 -
           union_measure(shadows, [&](const Polygon2& p) { return area_in_circle(p, r); }) / (std::acos(-1.0) * r * r);
}

inline double exact_visibility(const glm::dvec3& point, const LinearLight<double>& light,
                               const std::vector<Polygon3>& casters) {
    // In any plane through the light the shadow of a convex polygon cuts the light's line in one interval.
    const LightFrame<double> frame = light_frame(light, point - light.a);
    const double half = 0.5 * glm::length(light.b - light.a);
    std::vector<std::pair<double, double>> hidden;
    for (const Polygon2& shadow : project(frame, point, casters)) {
        double low = half, high = -half;
        for (std::size_t i = 0; i < shadow.size(); ++i) {
            const glm::dvec2 a = shadow[i], b = shadow[(i + 1) % shadow.size()];
            if ((a.y < 0.0) == (b.y < 0.0)) continue;
            const double x = std::clamp(a.x + (b.x - a.x) * (a.y / (a.y - b.y)), -half, half);
            low = std::min(low, x), high = std::max(high, x);
        }
        if (low < high) hidden.emplace_back(low, high);
    }
    std::sort(hidden.begin(), hidden.end());
    double covered = 0.0, end = -half;
    for (const auto& [low, high] : hidden) {
        covered += std::max(high - std::max(low, end), 0.0);
        end = std::max(end, high);
    }
    return 1.0 - covered / (2.0 * half);
}

}  // namespace penumbra::test
