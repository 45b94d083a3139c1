// Pictures from visibility: grey, shaded, signed difference with its legend, and several side by side.
//
// Visibility comes as an image with one value a pixel, negative where nothing was asked (no surface there, or
// one that looks away from the light).
#pragma once

#include <cstdint>
#include <filesystem>
#include <penumbra/geometry.hpp>
#include <penumbra/image.hpp>
#include <string>
#include <vector>

namespace penumbra::pictures {

/// An sRGB-encoded colour.
using Rgb = glm::vec<3, std::uint8_t, glm::defaultp>;

/// Linear light in [0, 1], clamped, as the sRGB code that makes a screen emit it: 0.5 becomes 188, not 128.
Rgb encode(const Vec3<float>& linear);

/// Visibility as emitted light: a point that sees half of the light is half as bright, as a diffuse white
/// surface would be. Pixels that were not asked are black.
Image<Rgb> visibility_picture(const Image<float>& visibility);

/// base · (ambient + (1 − ambient) · visibility · cosine), `base` being linear RGB and `cosine` that of the
/// angle between surface normal and light direction. A negative cosine marks pixels without a surface, shown
/// as their base; a surface that was not asked gets the ambient part only. The three images are of equal
/// size.
Image<Rgb> shaded_picture(const Image<float>& visibility, const Image<float>& cosine, const Image<Vec3<float>>& base,
                          float ambient = 0.06F);

/// The colour of an error: blue where the method is too dark, red where it is too bright, near-white at 0,
/// darkest from ±scale on. Safe for the colour-blind: lightness falls alike on both sides, and hues are blue
/// against orange-red. Source: F. Crameri, "Scientific colour maps", 2018, map "vik", with its centre lifted
/// to white.
Rgb difference_color(float error, float scale);

/// method − truth, with a legend below. Pixels that were not asked are grey.
Image<Rgb> difference_picture(const Image<float>& method, const Image<float>& truth, float scale = 0.25F);

/// A picture and what is written above it; lines after the first ('\n') are smaller.
struct Panel {
    std::string title;
    Image<Rgb> picture;
};

/// The panels in one row, tops aligned, on white.
Image<Rgb> side_by_side(const std::vector<Panel>& panels);

/// Throws std::runtime_error if the file cannot be written.
void write_png(const std::filesystem::path& file, const Image<Rgb>& picture);

}  // namespace penumbra::pictures
