// Which tiles of a frame need no query: none where no caster's box can be before the light.
#pragma once

#include <penumbra/geometry.hpp>
#include <vector>

#include "method.hpp"

namespace penumbra::opengl {

/// Boxes of the scene's casters in light space, as a method's images may have them: two texels wider, a slice deeper,
/// and the rounding of the vertices.
std::vector<Box3<float>> caster_boxes(const scenes::Scene& scene, const TileView& view);

/// An image of shaders/penumbra/plan/tile_classes.frag.
class TileClasses {
  public:
    static constexpr int size = 8;  ///< pixels along each side of a tile

    /// What only the host can do, whenever light, casters or the method's images have changed.
    void prepare(const scenes::Scene& scene, const TileView& view);
    void draw(const Frame& frame);
    /// R8UI: 0 lit, 1 single, 2 several.
    const Texture& classes() const { return classes_; }

  private:
    TileView view_;
    int count_ = 0;
    Program classify_;
    Texture casters_, classes_;
    Framebuffer target_;
};

}  // namespace penumbra::opengl
