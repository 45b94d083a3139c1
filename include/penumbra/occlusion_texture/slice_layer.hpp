// A prefiltered slice of the casters, and which kernels may read what it holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <penumbra/detail/boxes.hpp>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <vector>

namespace penumbra::detail {

/// A slice that holds anything: its mask and, for SelfShadow::mean_depth, its depths.
template <class T, class Filter>
struct SliceLayer {
    int slice;
    Rect2<T> occupied_tx;  ///< around all that blocks
    std::vector<Filter> filters;
};

/// What a slice blocks is multiplied by this, and limited to 1: full occlusion stays full through the mean's rounding.
template <class T>
inline constexpr T full_rounded_up = T(1.00001);

/// Around all texels that are set.
template <class T>
Rect2<T> occupied_rect(const Image<std::uint8_t>& mask) {
    Rect2<T> rect = empty_rect<T>();
    for (int y = 0; y < mask.height(); ++y) {
        const std::uint8_t *row = mask.row(y), *end = row + mask.width();
        const auto is_set = [](std::uint8_t texel) { return texel != 0; };
        const auto first = std::find_if(row, end, is_set) - row;
        if (first == mask.width()) continue;
        const auto last = std::find_if(std::reverse_iterator(end), std::reverse_iterator(row), is_set).base() - row;
        rect = extend(rect, Vec2<T>(static_cast<T>(first), static_cast<T>(y)));
        rect = extend(rect, Vec2<T>(static_cast<T>(last), static_cast<T>(y + 1)));
    }
    return rect;
}

/// Where means over kernels in cells × cells parts may read what a slice holds. Refers to the layer.
template <class T>
class SliceReach {
  public:
    template <class Filter>
    SliceReach(const SliceLayer<T, Filter>& layer, int cells)
        : held_(layer.occupied_tx),
          cells_(static_cast<T>(cells)),
          per_size_(static_cast<T>(Filter::reach) / cells_),
          widened_(smallest_box<T> * cells_) {}

    /// 1 if a kernel within a rectangle may, else 0; without a branch, for loops over many.
    int may_touch(T min_x, T min_y, T max_x, T max_y) const {
        const T width = max_x - min_x, height = max_y - min_y;
        const T size = width > height ? width : height;
        const T far = (size > cells_ ? size : cells_) * per_size_ + widened_;
        return static_cast<int>(min_x - far < held_.max.x) & static_cast<int>(max_x + far > held_.min.x) &
               static_cast<int>(min_y - far < held_.max.y) & static_cast<int>(max_y + far > held_.min.y);
    }
    bool may_touch(const Rect2<T>& kernels_tx) const {
        return may_touch(kernels_tx.min.x, kernels_tx.min.y, kernels_tx.max.x, kernels_tx.max.y) != 0;
    }

  private:
    const Rect2<T>& held_;
    T cells_, per_size_, widened_;
};

}  // namespace penumbra::detail
