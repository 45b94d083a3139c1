// Images of floats as textures.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec4.hpp>
#include <penumbra/image.hpp>

namespace penumbra::test {

/// Texels of floats, without filtering, bound to a unit.
class FloatTexture {
  public:
    FloatTexture(const Image<glm::vec4>& texels, int unit) {
        const glm::vec4 none(0);
        const int width = texels.empty() ? 1 : texels.width(), height = texels.empty() ? 1 : texels.height();
        glGenTextures(1, &name_);
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_2D, name_);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT,
                        texels.empty() ? &none : texels.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    ~FloatTexture() { glDeleteTextures(1, &name_); }
    FloatTexture(const FloatTexture&) = delete;
    FloatTexture& operator=(const FloatTexture&) = delete;

  private:
    GLuint name_ = 0;
};

}  // namespace penumbra::test
