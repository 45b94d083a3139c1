// Triangle rasterization on the CPU: occlusion textures, depth maps and D-buffers without a GPU.
//
// Coverage is exact: vertices are snapped to 1/256 texel and edges are integers from there on, so that triangles with a
// common edge leave no gap and hit no texel twice. Source: J. Pineda, "A parallel algorithm for polygon rasterization",
// 1988; top-left rule as in Direct3D and Vulkan.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/geometry.hpp>
#include <type_traits>
#include <utility>

namespace penumbra {

/// A vertex in homogeneous image coordinates: it lands on texel position (x / w, y / w). `depth` is linear over the
/// triangle in space, together with x, y and w.
template <class T>
struct RasterVertex {
    T x, y, depth, w;
};

template <class T>
RasterVertex<T> operator+(const RasterVertex<T>& a, const RasterVertex<T>& b) {
    return {a.x + b.x, a.y + b.y, a.depth + b.depth, a.w + b.w};
}
template <class T>
RasterVertex<T> operator-(const RasterVertex<T>& a, const RasterVertex<T>& b) {
    return {a.x - b.x, a.y - b.y, a.depth - b.depth, a.w - b.w};
}
template <class T>
RasterVertex<T> operator*(const RasterVertex<T>& a, T s) {
    return {a.x * s, a.y * s, a.depth * s, a.w * s};
}

namespace detail {

constexpr int raster_grid = 256;          // snapped positions a texel
constexpr double raster_guard = 65536.0;  // texels; products of snapped differences stay below 2^52
constexpr double raster_largest = 1e290;  // of a vertex's components, so that no product overflows

/// A snapped vertex and what is linear on the image: 1 / w and depth / w, in a unit common to the triangle.
struct SnappedVertex {
    std::int64_t x, y;
    double inverse_w, depth_over_w;
};

/// An edge function: ≥ 0 at texel centres that belong to the triangle's side of the edge.
struct RasterEdge {
    std::int64_t at_origin, step_x, step_y;  // at the centre of texel (0, 0), and from texel to texel

    RasterEdge(const SnappedVertex& a, const SnappedVertex& b) {
        const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
        const bool owns_border = dy < 0 || (dy == 0 && dx > 0);  // left or top
        step_x = -dy * raster_grid;
        step_y = dx * raster_grid;
        at_origin = dx * (raster_grid / 2 - a.y) - dy * (raster_grid / 2 - a.x) - (owns_border ? 0 : 1);
    }
    std::int64_t at(std::int64_t x, std::int64_t y) const { return at_origin + step_x * x + step_y * y; }
    /// Narrows [first, last] to the texels of the row where the function is ≥ 0.
    void narrow(std::int64_t y, std::int64_t& first, std::int64_t& last) const {
        const std::int64_t at = at_origin + step_y * y;
        if (step_x > 0) {
            // first x with at + x step ≥ 0, rounding up
            first = std::max(first, at >= 0 ? -(at / step_x) : (-at + step_x - 1) / step_x);
        } else if (step_x < 0) {
            if (at < 0)
                last = std::min(last, -1 - (-at - 1) / -step_x);
            else
                last = std::min(last, at / -step_x);
        } else if (at < 0) {
            last = first - 1;
        }
    }
};

/// The number of the first texel whose centre is at or beyond a snapped coordinate.
inline std::int64_t first_center(std::int64_t snapped) {
    return (snapped + raster_grid / 2 - 1 + (std::int64_t(1) << 40)) / raster_grid -
           (std::int64_t(1) << 40) / raster_grid;
}

/// Twice the signed area, in squared grid steps: positive if the triangle runs from x to y.
inline std::int64_t snapped_area(const SnappedVertex& a, const SnappedVertex& b, const SnappedVertex& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// A triangle on the grid, ready to walk. `area` is not 0.
struct SnappedTriangle {
    bool positive;
    SnappedVertex a, b, c;
    RasterEdge ab, bc, ca;

    SnappedTriangle(const SnappedVertex& first, const SnappedVertex& second, const SnappedVertex& third,
                    std::int64_t area)
        : positive(area > 0),
          a(positive ? first : second),
          b(positive ? second : first),
          c(third),
          ab(a, b),
          bc(b, c),
          ca(c, a) {}

    bool covers(std::int64_t x, std::int64_t y) const {
        return ab.at(x, y) >= 0 && bc.at(x, y) >= 0 && ca.at(x, y) >= 0;
    }

    /// Calls visit(x, y, depth) for each texel.
    template <class Visit>
    void walk(int width, int height, Visit&& visit) const {
        const std::int64_t y_first = std::max<std::int64_t>(0, first_center(std::min({a.y, b.y, c.y})));
        const std::int64_t y_end = std::min<std::int64_t>(height, first_center(std::max({a.y, b.y, c.y}) + 1));
        const std::int64_t x_first = std::max<std::int64_t>(0, first_center(std::min({a.x, b.x, c.x})));
        const std::int64_t x_end = std::min<std::int64_t>(width, first_center(std::max({a.x, b.x, c.x}) + 1));
        if (x_first >= x_end || y_first >= y_end) return;

        // depth / w and 1 / w as planes over the image: value at a, and slopes a texel
        const double unit = static_cast<double>(raster_grid) / static_cast<double>(snapped_area(a, b, c));
        const auto bx = static_cast<double>(b.x - a.x), by = static_cast<double>(b.y - a.y);
        const auto cx = static_cast<double>(c.x - a.x), cy = static_cast<double>(c.y - a.y);
        const double depth_b = b.depth_over_w - a.depth_over_w, depth_c = c.depth_over_w - a.depth_over_w;
        const double w_b = b.inverse_w - a.inverse_w, w_c = c.inverse_w - a.inverse_w;
        const double depth_dx = (depth_b * cy - depth_c * by) * unit, depth_dy = (depth_c * bx - depth_b * cx) * unit;
        const double w_dx = (w_b * cy - w_c * by) * unit, w_dy = (w_c * bx - w_b * cx) * unit;
        const double ax = static_cast<double>(a.x) / raster_grid - 0.5;
        const double ay = static_cast<double>(a.y) / raster_grid - 0.5;

        for (std::int64_t y = y_first; y < y_end; ++y) {
            std::int64_t first = x_first, last = x_end - 1;
            ab.narrow(y, first, last);
            bc.narrow(y, first, last);
            ca.narrow(y, first, last);
            const double down = static_cast<double>(y) - ay;
            for (std::int64_t x = first; x <= last; ++x) {
                const double right = static_cast<double>(x) - ax;
                const double depth_over_w = a.depth_over_w + depth_dx * right + depth_dy * down;
                const double inverse_w = a.inverse_w + w_dx * right + w_dy * down;
                visit(static_cast<int>(x), static_cast<int>(y), inverse_w > 0.0 ? depth_over_w / inverse_w : 0.0);
            }
        }
    }
};

/// Calls visit(x, y, depth, positive) for each texel of a snapped polygon, once. Snapping can fold a thin corner of a
/// cut polygon over one of its edges, where triangles of the fan then overlap: a texel is hit where those that run the
/// polygon's way are more.
template <class Visit>
void walk_polygon(const SnappedVertex* vertices, std::size_t count, int width, int height, Visit&& visit) {
    std::array<std::int64_t, 8> areas{};
    std::int64_t total = 0;
    for (std::size_t i = 2; i < count; ++i) total += areas[i] = snapped_area(vertices[0], vertices[i - 1], vertices[i]);
    bool folded = false;
    for (std::size_t i = 2; i < count; ++i) folded = folded || (total > 0 ? areas[i] < 0 : areas[i] > 0);
    const auto triangle = [&](std::size_t i) {
        return SnappedTriangle(vertices[0], vertices[i - 1], vertices[i], areas[i]);
    };
    const auto hits = [&](std::size_t i, int x, int y) {
        int way = 0;
        bool earlier = false;
        for (std::size_t k = 2; k < count; ++k) {
            if (areas[k] == 0 || !triangle(k).covers(x, y)) continue;
            const bool along = (areas[k] > 0) == (total > 0);
            way += along ? 1 : -1;
            earlier = earlier || (along && k < i);
        }
        return way > 0 && !earlier;
    };
    for (std::size_t i = 2; i < count; ++i) {
        if (areas[i] == 0 || (areas[i] > 0) != (total > 0)) continue;
        triangle(i).walk(width, height, [&](int x, int y, double depth) {
            if (!folded || hits(i, x, y)) visit(x, y, depth, total > 0);
        });
    }
}

}  // namespace detail

/// Calls fragment(int x, int y, T depth) once for each texel of a width × height image (up to 16384 a side) whose
/// centre the triangle covers, either side seen. Depth is perspective-correct at the texel's centre and stays within
/// the triangle's own range. What lies before `near_depth` is cut off; beyond it w must be positive. Triangles of no
/// area, after snapping, and vertices that are not finite, or beyond 1e290, draw nothing. A fragment that takes a
/// fourth argument, bool, is told whether the snapped triangle runs from x to y: over a closed surface, both answers
/// balance at every texel. Error: positions by 1/512 texel; what is farther than 65536 texels from the image is cut,
/// which moves an edge inside the image by less than that.
template <class T, class Fragment>
void rasterize(const RasterVertex<T>& a, const RasterVertex<T>& b, const RasterVertex<T>& c, int width, int height,
               T near_depth, Fragment&& fragment) {
    using Vertex = RasterVertex<double>;
    constexpr double guard = detail::raster_guard;
    const double near = static_cast<double>(near_depth);
    ConvexPolygon<Vertex, 8> polygon;  // a triangle and one more vertex for each of five cuts
    bool inside = true;
    for (const RasterVertex<T>* source : {&a, &b, &c}) {
        if (!is_finite(source->x) || !is_finite(source->y) || !is_finite(source->depth) || !is_finite(source->w))
            return;
        const Vertex v{static_cast<double>(source->x), static_cast<double>(source->y),
                       static_cast<double>(source->depth), static_cast<double>(source->w)};
        for (const double component : {v.x, v.y, v.depth, v.w})
            if (!(std::abs(component) <= detail::raster_largest)) return;
        inside = inside && v.depth >= near && std::abs(v.x) <= guard * v.w && std::abs(v.y) <= guard * v.w;
        polygon.push(v);
    }
    if (!inside) {
        // settled, since rounding in units of a far vertex would move a cut point by more than the image
        polygon = clip(
            polygon, [&](const Vertex& v) { return v.depth - near; }, [&](Vertex& v) { v.depth = near; });
        for (const double side : {-1.0, 1.0}) {
            polygon = clip(
                polygon, [&](const Vertex& v) { return guard * v.w - side * v.x; },
                [&](Vertex& v) { v.x = side * guard * v.w; });
            polygon = clip(
                polygon, [&](const Vertex& v) { return guard * v.w - side * v.y; },
                [&](Vertex& v) { v.y = side * guard * v.w; });
        }
    }
    double least_w = detail::raster_largest;
    for (std::size_t i = 0; i < polygon.count; ++i) least_w = std::min(least_w, polygon.vertices[i].w);
    if (!(least_w >= std::numeric_limits<double>::min())) return;
    std::array<detail::SnappedVertex, 8> snapped;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vertex& v = polygon.vertices[i];
        constexpr double limit = guard * 1.001;  // cut points may round outwards
        const auto snap = [&](double at) {
            return static_cast<std::int64_t>(std::floor(clamp(at / v.w, -limit, limit) * detail::raster_grid + 0.5));
        };
        const double inverse_w = least_w / v.w;
        snapped[i] = {snap(v.x), snap(v.y), inverse_w, v.depth * inverse_w};
    }
    const T lowest = std::max(near_depth, std::min({a.depth, b.depth, c.depth}));
    const T highest = std::max({a.depth, b.depth, c.depth});
    detail::walk_polygon(snapped.data(), polygon.count, width, height, [&](int x, int y, double depth, bool positive) {
        const T within = clamp(static_cast<T>(depth), lowest, highest);
        if constexpr (std::is_invocable_v<Fragment&, int, int, T, bool>)
            fragment(x, y, within, positive);
        else
            fragment(x, y, within), static_cast<void>(positive);
    });
}

}  // namespace penumbra
