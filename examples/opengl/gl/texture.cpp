#include "texture.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace penumbra::opengl {
namespace {

/// What glTexImage takes beside an internal format.
struct Layout {
    GLenum layout, type;
};
Layout layout_of(GLenum format) {
    switch (format) {
        case GL_R8:
            return {GL_RED, GL_UNSIGNED_BYTE};
        case GL_R16F:
        case GL_R32F:
            return {GL_RED, GL_FLOAT};
        case GL_RG32F:
            return {GL_RG, GL_FLOAT};
        case GL_R8UI:
            return {GL_RED_INTEGER, GL_UNSIGNED_BYTE};
        case GL_R32UI:
            return {GL_RED_INTEGER, GL_UNSIGNED_INT};
        case GL_RG32UI:
            return {GL_RG_INTEGER, GL_UNSIGNED_INT};
        case GL_RGBA8:
            return {GL_RGBA, GL_UNSIGNED_BYTE};
        case GL_RGBA16F:
        case GL_RGBA32F:
            return {GL_RGBA, GL_FLOAT};
        case GL_RGBA32UI:
            return {GL_RGBA_INTEGER, GL_UNSIGNED_INT};
        case GL_DEPTH_COMPONENT32F:
            return {GL_DEPTH_COMPONENT, GL_FLOAT};
        default:
            throw std::logic_error("no layout for texture format " + std::to_string(format));
    }
}

GLuint generated() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
}

}  // namespace

Texture::Texture(GLenum target, GLenum format, glm::ivec2 size, int layers, int levels)
    : handle_(generated()), target_(target), format_(format), size_(size), layers_(layers) {
    const Layout of = layout_of(format);
    glBindTexture(target, name());
    for (int level = 0; level < levels; ++level) {
        const int width = std::max(size.x >> level, 1), height = std::max(size.y >> level, 1);
        if (target == GL_TEXTURE_2D_ARRAY)
            glTexImage3D(target, level, static_cast<GLint>(format), width, height, layers, 0, of.layout, of.type,
                         nullptr);
        else
            glTexImage2D(target, level, static_cast<GLint>(format), width, height, 0, of.layout, of.type, nullptr);
    }
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, levels - 1);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Texture::Texture(GLenum format, glm::ivec2 size) : Texture(GL_TEXTURE_2D, format, size, 1, 1) {}

Texture Texture::array(GLenum format, glm::ivec2 size, int layers, int levels) {
    return {GL_TEXTURE_2D_ARRAY, format, size, layers, levels};
}

Texture::Texture(const Image<glm::vec4>& texels) : Texture(GL_RGBA32F, {texels.width(), texels.height()}) {
    upload(GL_RGBA, GL_FLOAT, texels.data());
}

Texture::Texture(const Image<glm::u8vec4>& texels) : Texture(GL_RGBA8, {texels.width(), texels.height()}) {
    upload(GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
}

void Texture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target_, name());
}

void Texture::bind_image(int unit, GLenum access) const {
    glBindImageTexture(static_cast<GLuint>(unit), name(), 0, GL_TRUE, 0, access, format_);
}

void Texture::generate_mipmap() const {
    glBindTexture(target_, name());
    glGenerateMipmap(target_);
}

void Texture::set_linear() const {
    glBindTexture(target_, name());
    glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void Texture::upload(GLenum layout, GLenum type, const void* texels, int layer) const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindTexture(target_, name());
    if (target_ == GL_TEXTURE_2D_ARRAY)
        glTexSubImage3D(target_, 0, 0, 0, layer, size_.x, size_.y, 1, layout, type, texels);
    else
        glTexSubImage2D(target_, 0, 0, 0, size_.x, size_.y, layout, type, texels);
}

std::vector<float> Texture::floats(int channels, int layer) const {
    std::vector<float> result(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                              static_cast<std::size_t>(channels));
    const bool is_depth = format_ == GL_DEPTH_COMPONENT32F;
    const Framebuffer source = is_depth ? Framebuffer::depth_only(*this) : Framebuffer({{*this, layer}});
    source.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    const GLenum layouts[] = {GL_NONE, GL_RED, GL_RG, GL_RGB, GL_RGBA};
    glReadPixels(0, 0, size_.x, size_.y, is_depth ? GL_DEPTH_COMPONENT : layouts[channels], GL_FLOAT, result.data());
    return result;
}

std::vector<std::uint8_t> Texture::bytes(int layer) const {
    std::vector<std::uint8_t> result(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * 4);
    const Framebuffer source({{*this, layer}});
    source.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, result.data());
    return result;
}

Framebuffer::Framebuffer(const std::vector<Target>& colors, const Texture* depth) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    handle_ = Handle<Delete>(name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    std::vector<GLenum> targets;
    const auto attach = [&](GLenum at, const Texture& texture, int layer) {
        if (texture.target() == GL_TEXTURE_2D_ARRAY)
            glFramebufferTextureLayer(GL_FRAMEBUFFER, at, texture.name(), 0, layer);
        else
            glFramebufferTexture2D(GL_FRAMEBUFFER, at, GL_TEXTURE_2D, texture.name(), 0);
        size_ = texture.size();
    };
    for (const Target& color : colors) {
        targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
        attach(targets.back(), color.texture, color.layer);
    }
    if (depth != nullptr) attach(GL_DEPTH_ATTACHMENT, *depth, 0);
    if (targets.empty()) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    } else {
        glDrawBuffers(static_cast<GLsizei>(targets.size()), targets.data());
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("a framebuffer of " + std::to_string(colors.size()) + " targets is not complete");
}

Framebuffer Framebuffer::depth_only(const Texture& depth) { return Framebuffer({}, &depth); }

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::clear_color(int target, const glm::vec4& value) const {
    bind();
    glClearBufferfv(GL_COLOR, target, &value.x);
}

void Framebuffer::clear_integers(int target, const glm::uvec4& value) const {
    bind();
    glClearBufferuiv(GL_COLOR, target, &value.x);
}

void Framebuffer::clear_depth(float value) const {
    bind();
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &value);
}

}  // namespace penumbra::opengl
