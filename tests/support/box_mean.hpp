// The truth for box filters, in double: every texel counts by the area that lies in the box, zeros outside the image.
#pragma once

#include <algorithm>
#include <cstddef>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>

#include "random.hpp"

namespace penumbra::test {

template <class Texel, class T>
double box_mean(const Image<Texel>& image, const Rect2<T>& box) {
    const double x0 = static_cast<double>(box.min.x), x1 = static_cast<double>(box.max.x);
    const double y0 = static_cast<double>(box.min.y), y1 = static_cast<double>(box.max.y);
    const int first_x = static_cast<int>(std::max(x0, 0.0)), first_y = static_cast<int>(std::max(y0, 0.0));
    double sum = 0;
    for (int y = first_y; y < image.height() && y < y1; ++y) {
        const double height = std::min(y1, y + 1.0) - std::max(y0, static_cast<double>(y));
        double row = 0;
        for (int x = first_x; x < image.width() && x < x1; ++x)
            row += (std::min(x1, x + 1.0) - std::max(x0, static_cast<double>(x))) * static_cast<double>(image(x, y));
        sum += row * height;
    }
    return sum / ((x1 - x0) * (y1 - y0));
}

/// Bytes: all values, or 0 and 255.
inline Image<std::uint8_t> random_bytes(Random& random, int width, int height, bool binary = false) {
    Image<std::uint8_t> image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = static_cast<std::uint8_t>(binary ? 255 * random.whole(0, 1) : random.whole(0, 255));
    return image;
}

/// Black and white on the two sides of a line at any angle: what the edge of a shadow is filtered from.
inline Image<std::uint8_t> edge_bytes(int size, double turn, double shift) {
    Image<std::uint8_t> image(size, size);
    const double nx = std::cos(turn), ny = std::sin(turn);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            image(x, y) = (x + 0.5 - size / 2.0) * nx + (y + 0.5 - size / 2.0) * ny > shift ? 255 : 0;
    return image;
}

}  // namespace penumbra::test
