// The points that a camera sees: where visibility is asked, measured and drawn.
#pragma once

#include <cstddef>
#include <penumbra/reference/embree.hpp>
#include <vector>

#include "../scenes/scene.hpp"

namespace penumbra::study {

using namespace scenes;

/// What the camera sees, in tiles of 8 × 8 pixels, 4 × 4 of them in Z-order, as a renderer would shade them; pixels
/// count row by row from the top. Only pixels that show a surface with the light's centre in front of it are asked; all
/// others are black whatever the visibility, and count in no figure.
struct View {
    int width = 0, height = 0;
    std::vector<Vec3<float>> points;  ///< world space, one an asked pixel
    std::vector<std::size_t> pixel;   ///< which pixel each point belongs to
    std::vector<float> cosine;        ///< of the angle between surface normal and light direction, one a point
    std::vector<bool> on_caster;      ///< else on the ground, one a point
    std::vector<bool> hit;            ///< any surface at all, one a pixel
};

View look(const Scene& scene, int width, int height);

/// About `count` of the points, in runs of neighbours spread evenly through the picture; runs come in an order whose
/// beginning is spread likewise.
std::vector<std::size_t> spread(const View& view, std::size_t count, std::size_t run);

}  // namespace penumbra::study
