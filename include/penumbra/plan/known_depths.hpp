// Up to which depth an image of a light sees all lit, and from where on all dark: for boxes of points.
//
// A texel of a map says of a ray that what lies on it is lit up to some depth, and dark between two others. Squares of
// texels say what holds for all of theirs, larger ones what holds for four. Source: ours, after the pyramids of
// G. Greene, M. Kass & G. Miller, "Hierarchical Z-buffer visibility", 1993.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <penumbra/detail/variation.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/numeric.hpp>
#include <vector>

namespace penumbra::detail {

/// Points at depths up to `lit_until` are lit, those beyond `dark_after` and up to `dark_until` dark. Of nothing yet:
/// whatever the depth.
template <class T>
struct KnownDepths {
    T lit_until = std::numeric_limits<T>::max(), dark_after = T(0), dark_until = std::numeric_limits<T>::max();

    /// What holds here and there.
    void join(const KnownDepths& other) {
        lit_until = other.lit_until < lit_until ? other.lit_until : lit_until;
        dark_after = other.dark_after > dark_after ? other.dark_after : dark_after;
        dark_until = other.dark_until < dark_until ? other.dark_until : dark_until;
    }
};

/// Of squares of texels of an image, of larger ones, up to all of it.
template <class T>
class KnownDepthPyramid {
  public:
    /// Of 2^`shift` texels a side.
    KnownDepthPyramid(int resolution, int shift) : shift_(shift) {
        for (int side = ((resolution - 1) >> shift) + 1;; side = (side + 1) / 2) {
            levels_.push_back({side, std::vector<KnownDepths<T>>(static_cast<std::size_t>(side * side))});
            if (side == 1) break;
        }
    }
    int squares_a_side() const { return levels_[0].side; }
    /// The square of so many texels that x and y, counted in squares, are of.
    KnownDepths<T>& square(int x, int y) { return levels_[0].at(x, y); }
    KnownDepths<T>& around(int x_tx, int y_tx) { return square(x_tx >> shift_, y_tx >> shift_); }
    /// Once all squares are set.
    void finish() {
        for (std::size_t l = 1; l < levels_.size(); ++l)
            for (int y = 0; y < levels_[l - 1].side; ++y)
                for (int x = 0; x < levels_[l - 1].side; ++x) levels_[l].at(x / 2, y / 2).join(levels_[l - 1].at(x, y));
    }
    /// Of texels x0 to x1 and y0 to y1, inclusive, all in the image.
    KnownDepths<T> of(int x0, int y0, int x1, int y1) const {
        x0 >>= shift_, y0 >>= shift_, x1 >>= shift_, y1 >>= shift_;
        std::size_t level = 0;
        for (; x1 - x0 > 2 || y1 - y0 > 2; ++level) x0 >>= 1, y0 >>= 1, x1 >>= 1, y1 >>= 1;
        KnownDepths<T> known;
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) known.join(levels_[level].at(x, y));
        return known;
    }
    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const Level& level : levels_) sum += level.squares.size() * sizeof(KnownDepths<T>);
        return sum;
    }

  private:
    struct Level {
        int side;
        std::vector<KnownDepths<T>> squares;

        KnownDepths<T>& at(int x, int y) { return squares[static_cast<std::size_t>(y * side + x)]; }
        const KnownDepths<T>& at(int x, int y) const { return squares[static_cast<std::size_t>(y * side + x)]; }
    };

    int shift_;
    std::vector<Level> levels_;
};

/// A map that looks from (position, 0, 0) in light space.
template <class T>
struct KnownMap {
    T position;
    KnownDepthPyramid<T> depths;
};

/// What maps of one image say of boxes in light space: lit where all of them say so, and everything is; dark where all
/// of them do, and nothing changes. Asked from any number of threads.
template <class T>
struct KnownPlaces {
    std::vector<KnownMap<T>> maps;  ///< none: everything is lit
    Rect2<T> slopes{};              ///< of the image's borders
    int resolution = 0;
    T spread_tx = T(0);        ///< columns to either side that a point may be asked at
    bool has_sides = true;     ///< what lies beyond the image's first and last column is lit; else as these
    bool by_distance = false;  ///< depths are distances from the light's centre

    Variation<T> operator()(const Box3<T>& box_ls) const {
        if (maps.empty() || !(box_ls.max.z > T(0))) return Variation<T>::all_lit();
        if (!is_before(box_ls)) return Variation<T>::unknown();
        const T size = static_cast<T>(resolution);
        const Vec2<T> rows = range(box_ls, 1, T(0), T(0));
        if (!(rows.x < size && rows.y >= T(0))) return Variation<T>::all_lit();
        const Vec2<T> depths = by_distance ? distances(box_ls) : Vec2<T>(box_ls.min.z, box_ls.max.z);
        const auto number = [&](T at) { return static_cast<int>(clamp(at, T(0), size - T(1))); };
        bool lit = true, dark = rows.x >= T(0) && rows.y < size;
        for (const KnownMap<T>& map : maps) {
            const Vec2<T> columns = range(box_ls, 0, map.position, spread_tx);
            dark = dark && columns.x >= T(0) && columns.y < size;
            if (has_sides && !(columns.x < size && columns.y >= T(0))) continue;
            const KnownDepths<T> known =
                map.depths.of(number(columns.x), number(rows.x), number(columns.y), number(rows.y));
            lit = lit && depths.y <= known.lit_until;
            dark = dark && depths.x > known.dark_after && depths.y <= known.dark_until;
            if (!lit && !dark) return Variation<T>::unknown();
        }
        return lit ? Variation<T>::all_lit() : Variation<T>::unchanging();
    }
    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const KnownMap<T>& map : maps) sum += map.depths.bytes();
        return sum;
    }

  private:
    /// Whether a box lies before the light, and at slopes that can be told apart.
    bool is_before(const Box3<T>& box) const {
        constexpr T steepest = T(1e6);
        const Vec3<T> out = farthest_of(box);
        const T half_length = std::max(std::abs(maps.front().position), std::abs(maps.back().position));
        return box.min.z > T(0) && out.x + out.y + half_length < steepest * box.min.z;
    }
    /// From which column (axis 0) or row to which a box is seen from a place on the axis, and what rounding may make of
    /// it. Neither need be in the image.
    Vec2<T> range(const Box3<T>& box, int axis, T from, T spread) const {
        const T least = slopes.min[axis], size = static_cast<T>(resolution);
        const T texels = size / (slopes.max[axis] - least), nearest = T(1) / box.min.z, farthest = T(1) / box.max.z;
        T low = box.min[axis] - from, high = box.max[axis] - from;
        low *= low < T(0) ? nearest : farthest, high *= high > T(0) ? nearest : farthest;
        const T reach = std::abs(low) + std::abs(high) + std::abs(least) + T(2) * std::abs(from) * nearest;
        const T margin = T(8) * std::numeric_limits<T>::epsilon() * (reach * texels + size) + spread;
        return Vec2<T>((low - least) * texels - margin, (high - least) * texels + margin);
    }
    /// From the light's centre to the nearest and the farthest point of a box.
    static Vec2<T> distances(const Box3<T>& box) {
        const Vec3<T> zero(T(0), T(0), T(0));
        const Vec3<T> far = farthest_of(box);
        const Vec3<T> near = glm::max(zero, glm::max(box.min, -box.max));
        constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
        return Vec2<T>(safe_length(near) * (T(1) - slack), safe_length(far) * (T(1) + slack));
    }
};

}  // namespace penumbra::detail
