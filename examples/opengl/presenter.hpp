// From visibility to the picture on the screen: shaded, plain, or its difference from the truth.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "../scenes/light.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"
#include "renderer.hpp"

namespace penumbra::opengl {

enum class Picture { shaded, visibility, difference };

/// What is shown of a frame.
struct Show {
    Picture picture = Picture::shaded;
    float split = 1.0F;  ///< the truth is right of this part of the width; differences have no split
    bool light = true;   ///< the light's outline
};

/// Draws into a texture of the frame's size.
class Presenter {
  public:
    Presenter();

    /// `truth`: visibility as Renderer::visibility has it, R32F. `tiles`: classes to be shown, if any.
    void draw(const Renderer& frame, const Texture& truth, const Texture* tiles, const scenes::Scene& scene,
              const Show& show);
    /// The picture in the window's framebuffer, stretched to it.
    void show_in_window(glm::ivec2 size) const;
    const Texture& picture() const { return picture_; }  ///< RGBA8, sRGB-encoded

  private:
    Program shade_, outline_;
    Texture difference_colors_, picture_;
    Framebuffer target_;
};

}  // namespace penumbra::opengl
