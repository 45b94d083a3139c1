// Textures and the framebuffers that they are drawn through.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <penumbra/image.hpp>
#include <utility>
#include <vector>

namespace penumbra::opengl {

/// A name of OpenGL's that is deleted at the end of its life. 0 is none.
template <class Delete>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint name) : name_(name) {}
    ~Handle() {
        if (name_ != 0) Delete()(name_);
    }
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0U)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    GLuint name() const { return name_; }

  private:
    GLuint name_ = 0;
};

/// A 2D texture, or an array of them, read without filtering unless said otherwise.
class Texture {
  public:
    Texture() = default;
    /// GL_R8, R16F, R32F, RG32F, R8UI, R32UI, RG32UI, RGBA8, RGBA16F, RGBA32F, RGBA32UI, or DEPTH_COMPONENT32F.
    /// Contents are undefined.
    Texture(GLenum format, glm::ivec2 size);
    static Texture array(GLenum format, glm::ivec2 size, int layers, int levels = 1);
    /// RGBA32F or RGBA8 from texels, row 0 first.
    explicit Texture(const Image<glm::vec4>& texels);
    explicit Texture(const Image<glm::u8vec4>& texels);

    GLuint name() const { return handle_.name(); }
    GLenum target() const { return target_; }
    GLenum format() const { return format_; }
    glm::ivec2 size() const { return size_; }
    int layers() const { return layers_; }
    bool empty() const { return handle_.name() == 0; }

    void bind(int unit) const;
    void bind_image(int unit, GLenum access) const;  ///< all layers, for compute shaders
    void generate_mipmap() const;
    void set_linear() const;  ///< bilinear between texels, clamped at the border
    void upload(GLenum layout, GLenum type, const void* texels, int layer = 0) const;
    std::vector<float> floats(int channels, int layer = 0) const;  ///< row 0 first; waits for the GPU
    std::vector<std::uint8_t> bytes(int layer = 0) const;          ///< of RGBA8

  private:
    Texture(GLenum target, GLenum format, glm::ivec2 size, int layers, int levels);

    struct Delete {
        void operator()(GLuint name) const { glDeleteTextures(1, &name); }
    };
    Handle<Delete> handle_;
    GLenum target_ = GL_TEXTURE_2D, format_ = GL_NONE;
    glm::ivec2 size_{0, 0};
    int layers_ = 1;
};

/// Layers of textures that are drawn to together. The textures outlive it.
class Framebuffer {
  public:
    struct Target {
        const Texture& texture;
        int layer = 0;
    };
    Framebuffer() = default;
    explicit Framebuffer(const std::vector<Target>& colors, const Texture* depth = nullptr);
    static Framebuffer depth_only(const Texture& depth);

    /// With a viewport of its size.
    void bind() const;
    void clear_color(int target, const glm::vec4& value) const;
    void clear_integers(int target, const glm::uvec4& value) const;
    void clear_depth(float value) const;
    glm::ivec2 size() const { return size_; }

  private:
    struct Delete {
        void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
    };
    Handle<Delete> handle_;
    glm::ivec2 size_{0, 0};
};

}  // namespace penumbra::opengl
