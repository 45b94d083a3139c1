// Exact areas of polygons of any shape inside a box: the truth for silhouettes. A union comes by vertical slabs, in
// double; one loop with its winding by cuts and the shoelace formula, in long double. Shares no code with the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <penumbra/geometry.hpp>
#include <utility>
#include <vector>

#include "polygon_area.hpp"

namespace penumbra::test {

/// ∫ w dA, ∫ w (x − box.min.x) dA and ∫ w (y − box.min.y) dA over a box, w being the winding number of a loop.
template <class Real>
struct WindingMoments {
    Real area, x, y;
};

/// Of the closed loop, which may cross itself; positive counter-clockwise. Points have members x and y. Real must hold
/// about twice the digits of the farthest coordinate in units of the box; for ends at 1e18 that is `Quad`.
template <class Real = long double, class Point>
WindingMoments<Real> winding_moments(const std::vector<Point>& loop, const Rect2<double>& box) {
    struct Vertex {
        Real x, y;
    };
    std::vector<Vertex> polygon, kept;
    for (const Point& p : loop)
        polygon.push_back({static_cast<Real>(p.x) - static_cast<Real>(box.min.x),
                           static_cast<Real>(p.y) - static_cast<Real>(box.min.y)});
    const Real width = static_cast<Real>(box.max.x) - static_cast<Real>(box.min.x),
               height = static_cast<Real>(box.max.y) - static_cast<Real>(box.min.y);
    for (int side = 0; side < 4; ++side) {
        const auto inside = [&](const Vertex& v) {
            return side == 0 ? v.x : side == 1 ? width - v.x : side == 2 ? v.y : height - v.y;
        };
        kept.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vertex &a = polygon[i], &b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
            const Real da = inside(a), db = inside(b);
            if (da >= 0) kept.push_back(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0))
                kept.push_back({(a.x * db - b.x * da) / (db - da), (a.y * db - b.y * da) / (db - da)});
        }
        polygon.swap(kept);
    }
    WindingMoments<Real> sum{0, 0, 0};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vertex &a = polygon[i], &b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        const Real cross = a.x * b.y - a.y * b.x;
        sum.area += cross / 2, sum.x += cross * (a.x + b.x) / 6, sum.y += cross * (a.y + b.y) / 6;
    }
    return sum;
}

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
#else
using Quad = long double;
#endif

/// ∫ w dA over the box.
template <class Point>
double winding_area(const std::vector<Point>& loop, const Rect2<double>& box) {
    return static_cast<double>(winding_moments(loop, box).area);
}

namespace union_area_detail {

/// A part of a border within the box, from left to right; `step` is what crossing it upwards adds to the winding.
struct Border {
    double x0, y0, x1, y1, slope;
    int step;
    std::size_t owner;
    double at(double x) const { return y0 + (x - x0) * slope; }
};

/// Cut to the box's columns; what is above or below the box runs along its top or bottom.
inline void add_edge(std::vector<Border>& borders, glm::dvec2 a, glm::dvec2 b, std::size_t owner,
                     const Rect2<double>& box) {
    const int step = a.x < b.x ? 1 : -1;
    if (step < 0) std::swap(a, b);
    const double left = std::max(a.x, box.min.x), right = std::min(b.x, box.max.x);
    if (!(left < right)) return;
    const double slope = (b.y - a.y) / (b.x - a.x);
    const auto y_at = [&](double x) {  // from the nearer end
        const double y = x - a.x < b.x - x ? a.y + (x - a.x) * slope : b.y - (b.x - x) * slope;
        return std::clamp(y, std::min(a.y, b.y), std::max(a.y, b.y));
    };
    const auto x_at = [&](double y) {
        if (!(std::min(a.y, b.y) < y && y < std::max(a.y, b.y))) return left;
        const double x = std::abs(y - a.y) < std::abs(b.y - y) ? a.x + (y - a.y) / slope : b.x - (b.y - y) / slope;
        return std::clamp(x, left, right);
    };
    double cuts[4] = {left, x_at(box.min.y), x_at(box.max.y), right};
    std::sort(cuts, cuts + 4);
    for (int k = 0; k < 3; ++k) {
        if (!(cuts[k] < cuts[k + 1])) continue;
        const double y0 = std::clamp(y_at(cuts[k]), box.min.y, box.max.y);
        const double y1 = std::clamp(y_at(cuts[k + 1]), box.min.y, box.max.y);
        borders.push_back({cuts[k], y0, cuts[k + 1], y1, (y1 - y0) / (cuts[k + 1] - cuts[k]), step, owner});
    }
}

}  // namespace union_area_detail

/// Area of the part of the box that at least one shape covers. A shape is what any number of loops together wind
/// around, non-zero winding: polygons of any orientation, also such that cross themselves, with holes, touching.
/// Error about 1e-14 of the box for coordinates within some box sizes.
inline double union_area_of_shapes(const std::vector<std::vector<Polygon2>>& shapes, const Rect2<double>& box) {
    using union_area_detail::Border;
    std::vector<Border> borders;
    for (std::size_t s = 0; s < shapes.size(); ++s)
        for (const Polygon2& loop : shapes[s])
            for (std::size_t i = 0; i < loop.size(); ++i)
                union_area_detail::add_edge(borders, loop[i], loop[i + 1 == loop.size() ? 0 : i + 1], s, box);
    std::sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) { return a.x0 < b.x0; });

    std::vector<double> xs;
    for (std::size_t i = 0; i < borders.size(); ++i) {
        const Border& a = borders[i];
        xs.push_back(a.x0), xs.push_back(a.x1);
        for (std::size_t j = i + 1; j < borders.size() && borders[j].x0 < a.x1; ++j) {
            const Border& b = borders[j];
            const double left = b.x0, right = std::min(a.x1, b.x1);
            const double before = a.at(left) - b.at(left), after = a.at(right) - b.at(right);
            if ((before < 0) != (after < 0)) xs.push_back(left + (right - left) * (before / (before - after)));
        }
    }
    std::sort(xs.begin(), xs.end());

    struct Crossing {
        double y;
        const Border* border;
    };
    std::vector<Crossing> active;  // sorted by y, which changes little from one slab to the next
    std::vector<int> winding(shapes.size(), 0);
    std::size_t next = 0;
    double sum = 0;
    for (std::size_t k = 0; k + 1 < xs.size(); ++k) {
        const double width = xs[k + 1] - xs[k], middle = xs[k] + width * 0.5;
        if (!(xs[k] < middle && middle < xs[k + 1])) continue;  // too narrow to hold anything
        active.erase(
            std::remove_if(active.begin(), active.end(), [&](const Crossing& c) { return c.border->x1 <= middle; }),
            active.end());
        for (; next < borders.size() && borders[next].x0 < middle; ++next)
            if (borders[next].x1 > middle) active.push_back({0, &borders[next]});
        for (std::size_t i = 0; i < active.size(); ++i) {
            const Crossing c{active[i].border->at(middle), active[i].border};
            std::size_t j = i;
            for (; j > 0 && active[j - 1].y > c.y; --j) active[j] = active[j - 1];
            active[j] = c;
        }
        int covered = 0;
        for (std::size_t i = 0; i < active.size(); ++i) {
            if (covered > 0) sum += width * (active[i].y - active[i - 1].y);  // a trapezoid by its middle
            int& w = winding[active[i].border->owner];
            covered -= w != 0;
            w += active[i].border->step;
            covered += w != 0;
        }
    }
    return sum;
}

/// The same for shapes of one loop each.
inline double union_area(const std::vector<Polygon2>& polygons, const Rect2<double>& box) {
    std::vector<std::vector<Polygon2>> shapes;
    for (const Polygon2& polygon : polygons) shapes.push_back({polygon});
    return union_area_of_shapes(shapes, box);
}

}  // namespace penumbra::test
