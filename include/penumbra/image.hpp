// A plain two-dimensional array of texels, and bilinear lookup.
#pragma once

#include <cstddef>
#include <penumbra/detail/aligned.hpp>
#include <penumbra/detail/error.hpp>
#include <penumbra/numeric.hpp>
#include <string>
#include <vector>

namespace penumbra {

/// A width × height image, row 0 first, rows contiguous. Texel (x, y) covers [x, x+1) × [y, y+1) in texel
/// units
/// (_tx), so that its centre is at (x + ½, y + ½). A default-made image is empty; any other has at least one
/// texel.
template <class T>
class Image {
  public:
    using value_type = T;

    Image() = default;

    /// Every texel is `fill`. Reports width or height below 1.
    Image(int width, int height, const T& fill = T()) {
        if (!detail::require(width > 0 && height > 0, [&] {
                return "image size " + std::to_string(width) + " × " + std::to_string(height) + " is not positive";
            }))
            return;
        width_ = width;
        height_ = height;
        texels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return texels_.empty(); }
    std::size_t size() const { return texels_.size(); }

    T* data() { return texels_.data(); }
    const T* data() const { return texels_.data(); }
    T* row(int y) { return texels_.data() + static_cast<std::ptrdiff_t>(y) * width_; }
    const T* row(int y) const { return texels_.data() + static_cast<std::ptrdiff_t>(y) * width_; }

    /// Unchecked: 0 ≤ x < width(), 0 ≤ y < height().
    T& operator()(int x, int y) { return row(y)[x]; }
    const T& operator()(int x, int y) const { return row(y)[x]; }

  private:
    std::vector<T, detail::AlignedAllocator<T>> texels_;
    int width_ = 0, height_ = 0;
};

/// Bilinear interpolation between texel centres at (x_tx, y_tx), clamped to the border's texels; what
/// GL_LINEAR with GL_CLAMP_TO_EDGE returns, without the 8-bit weights of hardware. NaN reads the first texel.
/// The image must not be empty. Error: 3 ε of the largest texel read. Sides above 2^24 texels are read safely, but
/// float cannot tell their texels apart, and -ffast-math may lose a weight there.
template <class U, class T>
T bilinear(const Image<U>& image, T x_tx, T y_tx) {
    const T x = clamp(x_tx - T(0.5), T(0), static_cast<T>(image.width() - 1));
    const T y = clamp(y_tx - T(0.5), T(0), static_cast<T>(image.height() - 1));
    // beyond 2^24 texels the last one's position may round up to the size
    const int x0 = clamp(static_cast<int>(x), 0, image.width() - 1);
    const int y0 = clamp(static_cast<int>(y), 0, image.height() - 1);
    const int x1 = x0 + 1 < image.width() ? x0 + 1 : x0, y1 = y0 + 1 < image.height() ? y0 + 1 : y0;
    const T fx = x - static_cast<T>(x0), fy = y - static_cast<T>(y0);
    const T top = mix(static_cast<T>(image(x0, y0)), static_cast<T>(image(x1, y0)), fx);
    const T bottom = mix(static_cast<T>(image(x0, y1)), static_cast<T>(image(x1, y1)), fx);
    return mix(top, bottom, fy);
}

}  // namespace penumbra
