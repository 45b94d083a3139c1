// Programs from the library's shader files, and textures, as tests need them.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <penumbra/mesh.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "context.hpp"
#include "texture_array.hpp"

namespace penumbra::test {

/// The text of a shader file with its `#include "..."` lines resolved, each file once.
inline std::string flatten(const std::filesystem::path& file, std::set<std::filesystem::path>& seen) {
    const std::filesystem::path path = file.lexically_normal();
    if (!seen.insert(path).second) return "";
    std::ifstream in(path);
    if (!in) throw std::runtime_error("cannot read " + path.string());
    std::string text;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("#include \"", 0) == 0)
            text += flatten(path.parent_path() / line.substr(10, line.rfind('"') - 10), seen);
        else
            text += line + "\n";
    }
    return text;
}

/// Of a file below shaders/penumbra. The environment's PENUMBRA_SHADERS puts another tree in its place: mutants.sh.
inline std::string flatten(const std::string& file) {
    std::set<std::filesystem::path> seen;
    const char* other = std::getenv("PENUMBRA_SHADERS");
    return flatten(std::filesystem::path(other != nullptr ? other : PENUMBRA_SHADERS) / "penumbra" / file, seen);
}

/// `depth` layers of one size, zeros at first, without filtering.
class Texture {
  public:
    Texture(GLenum format, int width, int height, int layers, int levels = 1) : width_(width), height_(height) {
        glGenTextures(1, &name_);
        glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
        glTexStorage3D(GL_TEXTURE_2D_ARRAY, levels, format, width, height, layers);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER,
                        levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        const bool integers = format == GL_RGBA32UI || format == GL_R32UI;
        for (int layer = 0; layer < layers; ++layer) {
            attach(layer, 1);
            const GLuint none[4] = {0, 0, 0, 0};
            const GLfloat zero[4] = {0, 0, 0, 0};
            if (integers)
                glClearBufferuiv(GL_COLOR, 0, none);
            else
                glClearBufferfv(GL_COLOR, 0, zero);
        }
    }
    explicit Texture(const Values& values) : Texture(GL_RGBA8, values) { fill(values, GL_RGBA, GL_UNSIGNED_BYTE); }
    explicit Texture(const Sums& sums) : Texture(GL_RGBA32UI, sums) { fill(sums, GL_RGBA_INTEGER, GL_UNSIGNED_INT); }
    ~Texture() { glDeleteTextures(1, &name_); }
    Texture(Texture&& other) noexcept
        : name_(std::exchange(other.name_, 0U)), width_(other.width_), height_(other.height_) {}
    Texture& operator=(Texture&&) = delete;

    void upload(int layer, GLenum format, GLenum type, const void* texels) const {
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, width_, height_, 1, format, type, texels);
    }
    void bind(int unit) const {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
    }
    void bind_image(int unit, GLenum access, GLenum format) const {
        glBindImageTexture(static_cast<GLuint>(unit), name_, 0, GL_TRUE, 0, access, format);
    }
    /// Makes `count` layers from `first` on the targets of what is drawn next.
    void attach(int first, int count) const {
        std::vector<std::pair<const Texture*, int>> layers;
        for (int i = 0; i < count; ++i) layers.emplace_back(this, first + i);
        attach(layers);
    }
    static void attach(const std::vector<std::pair<const Texture*, int>>& layers) {
        static thread_local GLuint framebuffer = 0;
        glDeleteFramebuffers(1, &framebuffer);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        std::vector<GLenum> targets;
        for (const auto& [texture, layer] : layers) {
            targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
            glFramebufferTextureLayer(GL_FRAMEBUFFER, targets.back(), texture->name_, 0, layer);
        }
        glDrawBuffers(static_cast<GLsizei>(targets.size()), targets.data());
        glViewport(0, 0, layers[0].first->width_, layers[0].first->height_);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("the framebuffer is not complete");
    }
    /// Of an RGBA8 layer.
    std::vector<std::uint8_t> bytes(int layer) const {
        std::vector<std::uint8_t> result(texels() * 4);
        read(layer, GL_RGBA, GL_UNSIGNED_BYTE, result.data());
        return result;
    }
    /// Of a layer of a float format.
    std::vector<float> floats(int layer) const {
        std::vector<float> result(texels() * 4);
        read(layer, GL_RGBA, GL_FLOAT, result.data());
        return result;
    }
    /// Of an RGBA32UI or R32UI layer, four numbers a texel.
    std::vector<std::uint32_t> sums(int layer) const {
        std::vector<std::uint32_t> result(texels() * 4);
        read(layer, GL_RGBA_INTEGER, GL_UNSIGNED_INT, result.data());
        return result;
    }

  private:
    template <class Array>
    Texture(GLenum format, const Array& array)
        : Texture(format, array.levels[0].size.x, array.levels[0].size.y, array.layers,
                  static_cast<int>(array.levels.size())) {}
    template <class Array>
    void fill(const Array& array, GLenum format, GLenum type) const {
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
        for (std::size_t l = 0; l < array.levels.size(); ++l)
            glTexSubImage3D(GL_TEXTURE_2D_ARRAY, static_cast<GLint>(l), 0, 0, 0, array.levels[l].size.x,
                            array.levels[l].size.y, array.layers, format, type, array.levels[l].texels.data());
    }
    std::size_t texels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
    void read(int layer, GLenum format, GLenum type, void* result) const {
        attach(layer, 1);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, width_, height_, format, type, result);
        const GLenum error = glGetError();
        if (error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error));
    }

    GLuint name_ = 0;
    int width_, height_;
};

/// The whole text of a shader.
struct Text {
    std::string text;
};

/// A program of the library's whole shaders; options are what follows "#define ".
class Program {
  public:
    using Options = std::vector<std::string>;

    Program(const Context& context, const std::string& vertex, const std::string& fragment, const Options& options) {
        link({compile(GL_VERTEX_SHADER, context, vertex, options),
              compile(GL_FRAGMENT_SHADER, context, fragment, options)});
    }
    /// With a fragment shader of one's own.
    Program(const Context& context, const Text& fragment, const std::string& vertex) {
        link({compile(GL_VERTEX_SHADER, context, vertex, {}), compile_text(GL_FRAGMENT_SHADER, "text", fragment.text)});
    }
    Program(const Context& context, const std::string& compute, const Options& options) {
        link({compile(GL_COMPUTE_SHADER, context, compute, options)});
    }
    explicit Program(const Text& compute) { link({compile_text(GL_COMPUTE_SHADER, "text", compute.text)}); }
    ~Program() { glDeleteProgram(name_); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const { glUseProgram(name_); }
    void set(const char* name, int value) const { glUniform1i(at(name), value); }
    void set(const char* name, float value) const { glUniform1f(at(name), value); }
    void set(const char* name, const glm::ivec2& value) const { glUniform2i(at(name), value.x, value.y); }
    void set(const char* name, const glm::vec2& value) const { glUniform2f(at(name), value.x, value.y); }
    void set(const char* name, const glm::vec3& value) const { glUniform3f(at(name), value.x, value.y, value.z); }
    void set(const char* name, const glm::mat4& value) const {
        glUniformMatrix4fv(at(name), 1, GL_FALSE, glm::value_ptr(value));
    }
    void draw_full_screen() const {
        const Arrays arrays;
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    /// With the attribute penumbra_position.
    void draw_triangles(const Mesh<float>& mesh) const {
        const Arrays arrays;
        GLuint buffers[2];
        glGenBuffers(2, buffers);
        glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.positions.size() * sizeof(Vec3<float>)),
                     mesh.positions.data(), GL_STATIC_DRAW);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(glm::uvec3)),
                     mesh.triangles.data(), GL_STATIC_DRAW);
        const auto position = static_cast<GLuint>(glGetAttribLocation(name_, "penumbra_position"));
        glEnableVertexAttribArray(position);
        glVertexAttribPointer(position, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh.triangles.size()), GL_UNSIGNED_INT, nullptr);
        glDeleteBuffers(2, buffers);
    }

  private:
    struct Arrays {
        GLuint name = 0;
        Arrays() { glGenVertexArrays(1, &name), glBindVertexArray(name); }
        ~Arrays() { glDeleteVertexArrays(1, &name); }
        Arrays(const Arrays&) = delete;
        Arrays& operator=(const Arrays&) = delete;
    };

    GLint at(const char* name) const { return glGetUniformLocation(name_, name); }

    static GLuint compile(GLenum stage, const Context& context, const std::string& file, const Options& options) {
        std::string text = context.version(stage == GL_COMPUTE_SHADER);
        if (context.api() == Api::es && stage == GL_COMPUTE_SHADER) text += "precision highp uimage2DArray;\n";
        for (const std::string& option : options) text += "#define " + option + "\n";
        return compile_text(stage, file, text + flatten(file));
    }

    static GLuint compile_text(GLenum stage, const std::string& name, const std::string& text) {
        const GLuint shader = glCreateShader(stage);
        const char* source = text.c_str();
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        GLint good = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
        char log[2048] = "";
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
        if (good == GL_FALSE) throw std::runtime_error(name + ": " + log);
        return shader;
    }

    void link(std::initializer_list<GLuint> shaders) {
        name_ = glCreateProgram();
        for (const GLuint shader : shaders) glAttachShader(name_, shader), glDeleteShader(shader);
        glLinkProgram(name_);
        GLint good = GL_FALSE;
        glGetProgramiv(name_, GL_LINK_STATUS, &good);
        char log[2048] = "";
        glGetProgramInfoLog(name_, sizeof log, nullptr, log);
        if (good == GL_FALSE) throw std::runtime_error(log);
    }

    GLuint name_ = 0;
};

}  // namespace penumbra::test
