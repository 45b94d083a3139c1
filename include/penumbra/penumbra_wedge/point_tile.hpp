// Points that are asked about together: the work on edges and nodes is shared, and loops over points vectorise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/geometry.hpp>

namespace penumbra {

/// Up to 64 points in light space, all at depth > 0, as arrays, with what bounds their pyramids to the light. The
/// nearer they are to each other, the fewer edges they are asked about together.
template <class T>
struct PointTile {
    static constexpr std::size_t capacity = 64;
    using Values = std::array<T, capacity>;

    Values x, y, depth;
    std::size_t count = 0;       ///< points
    std::size_t lanes = 0;       ///< count rounded up to a multiple of 8; the last point stands there again
    Rect2<T> light;              ///< its box
    Box3<T> box;                 ///< around the points
    Vec3<T> center;              ///< of that box
    T radius;                    ///< of the points around it
    T right, left, top, bottom;  ///< slopes of the pyramids' sides: beyond them is none

    void push(const Vec3<T>& point_ls) {
        x[count] = point_ls.x, y[count] = point_ls.y, depth[count] = point_ls.z;
        ++count;
    }
    /// After the last point, of at least one.
    void finish(const Vec2<T>& half_size) {
        light = {-half_size, half_size};
        for (lanes = count; lanes % 8 != 0; ++lanes)
            x[lanes] = x[count - 1], y[lanes] = y[count - 1], depth[lanes] = depth[count - 1];
        constexpr T big = std::numeric_limits<T>::max();
        box = empty_box<T>();
        right = top = -big, left = bottom = big;
        for (std::size_t i = 0; i < count; ++i) {
            box = extend(box, Vec3<T>(x[i], y[i], depth[i]));
            right = std::max(right, (x[i] - half_size.x) / depth[i]);
            left = std::min(left, (x[i] + half_size.x) / depth[i]);
            top = std::max(top, (y[i] - half_size.y) / depth[i]);
            bottom = std::min(bottom, (y[i] + half_size.y) / depth[i]);
        }
        set_middle();
    }
    /// Stands for all points of a box, at depth > 0, and holds none.
    void cover(const Box3<T>& points, const Vec2<T>& half_size) {
        count = lanes = 0;
        light = {-half_size, half_size};
        box = points;
        const auto slope = [&](T across, bool largest) {
            return across / ((across > T(0)) == largest ? box.min.z : box.max.z);
        };
        right = slope(box.max.x - half_size.x, true), left = slope(box.min.x + half_size.x, false);
        top = slope(box.max.y - half_size.y, true), bottom = slope(box.min.y + half_size.y, false);
        set_middle();
    }
    Vec3<T> operator[](std::size_t i) const { return Vec3<T>(x[i], y[i], depth[i]); }

  private:
    void set_middle() {
        center = (box.min + box.max) * T(0.5);
        const Vec3<T> half = (box.max - box.min) * T(0.5);
        radius = std::sqrt(glm::dot(half, half)) * T(1.0001);
    }
};

/// An edge as each lane of a tile sees it on the light's plane. It counts `coefficient` times there: 0 where it is not
/// on the silhouette.
template <class T>
struct TileEdge {
    typename PointTile<T>::Values ax, ay, bx, by, coefficient;
};

namespace detail {

/// A point in light space, and its place in the caller's arrays.
template <class T>
struct AskedPoint {
    Vec3<T> point_ls;
    std::size_t index;
};

template <class T>
Box3<T> box_of(const AskedPoint<T>* points, std::size_t count) {
    Box3<T> box = empty_box<T>();
    for (std::size_t i = 0; i < count; ++i) box = extend(box, points[i].point_ls);
    return box;
}

/// Brings the points on one side of the middle of their longest extent, half of them, to the front. Returns how many.
template <class T>
std::size_t halve(AskedPoint<T>* points, std::size_t count) {
    const Box3<T> box = box_of(points, count);
    const Vec3<T> size = box.max - box.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = count / 2;
    std::nth_element(points, points + half, points + count, [&](const AskedPoint<T>& a, const AskedPoint<T>& b) {
        return a.point_ls[axis] < b.point_ls[axis];
    });
    return half;
}

/// Calls shade(first, count) for groups of the points, which it reorders: split where there is a wide gap between them,
/// since a tile over two surfaces, or two places of a picture, would see what lies before either and between.
template <class T, class Shade>
void split_at_gaps(AskedPoint<T>* points, std::size_t count, Shade&& shade) {
    constexpr int bins = 16;
    constexpr std::size_t least = 8;  // of lanes, which a tile has anyway
    const Box3<T> box = box_of(points, count);
    const Vec3<T> size = box.max - box.min;
    const T wide = T(0.25) * std::max({size.x, size.y, size.z});
    int widest = 1, axis = 0;
    T cut = T(0);
    for (int k = 0; k < 3 && count > least; ++k) {
        if (!(size[k] > wide)) continue;
        const T unit = static_cast<T>(bins) / size[k];
        std::array<bool, bins> used{};
        for (std::size_t i = 0; i < count; ++i)
            used[static_cast<std::size_t>(
                std::min(static_cast<int>((points[i].point_ls[k] - box.min[k]) * unit), bins - 1))] = true;
        int gap = 0;
        for (int bin = 0; bin < bins; ++bin) {
            gap = used[static_cast<std::size_t>(bin)] ? 0 : gap + 1;
            if (gap <= widest) continue;
            widest = gap, axis = k;
            cut = box.min[k] + static_cast<T>(bin) * (size[k] / static_cast<T>(bins));
        }
    }
    AskedPoint<T>* const middle =
        widest == 1
            ? points
            : std::partition(points, points + count, [&](const AskedPoint<T>& p) { return p.point_ls[axis] < cut; });
    const auto first = static_cast<std::size_t>(middle - points);
    if (first == 0 || first == count) return shade(points, count);
    split_at_gaps(points, first, shade);
    split_at_gaps(middle, count - first, shade);
}

}  // namespace detail

}  // namespace penumbra
