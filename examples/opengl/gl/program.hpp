// Programs from the library's shaders and one's own lines; and the fixed-function state that they run in.
#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <penumbra/light.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "texture.hpp"

namespace penumbra::opengl {

/// A shader's text: options, each what follows "#define ", then texts in turn. The version line comes from Program.
struct Source {
    std::vector<std::string> options;
    std::vector<std::string_view> texts;
};

/// A whole shader of the library, or a snippet, flattened: "occlusion_texture/slice_capture.frag". Throws where there
/// is none of that name.
std::string_view library(std::string_view path);

/// Vertex and fragment shaders are GLSL 330, compute shaders 430. Attributes: penumbra_position at location 0,
/// penumbra_attribute_1 to _3 at 1 to 3.
class Program {
  public:
    Program() = default;
    Program(const Source& vertex, const Source& fragment);
    explicit Program(const Source& compute);
    /// Draws one triangle over the whole target.
    static Program full_screen(const Source& fragment);

    bool empty() const { return handle_.name() == 0; }
    void use() const { glUseProgram(handle_.name()); }
    /// Of the program that is in use. Names that the shader does not use are ignored.
    void set(const char* name, bool value) const { glUniform1i(at(name), value ? 1 : 0); }
    void set(const char* name, int value) const { glUniform1i(at(name), value); }
    void set(const char* name, float value) const { glUniform1f(at(name), value); }
    void set(const char* name, const glm::ivec2& value) const { glUniform2i(at(name), value.x, value.y); }
    void set(const char* name, const glm::vec2& value) const { glUniform2f(at(name), value.x, value.y); }
    void set(const char* name, const glm::vec3& value) const { glUniform3f(at(name), value.x, value.y, value.z); }
    void set(const char* name, const glm::vec4& value) const {
        glUniform4f(at(name), value.x, value.y, value.z, value.w);
    }
    void set(const char* name, const glm::mat4& value) const;
    /// A penumbra_LightFrame.
    void set(const std::string& name, const LightFrame<float>& frame) const;
    /// A sampler, and the texture that it reads through a unit.
    void set(const char* name, int unit, const Texture& texture) const;

    // after use(), of a program without attributes
    void draw_triangles(int vertices) const { draw(GL_TRIANGLES, vertices); }
    void draw_lines(int vertices) const { draw(GL_LINES, vertices); }
    void draw_full_screen() const { draw_triangles(3); }  ///< of a program that full_screen() made

  private:
    GLint at(const char* name) const;
    void draw(GLenum primitives, int vertices) const;

    struct Delete {
        void operator()(GLuint name) const { glDeleteProgram(name); }
    };
    struct DeleteArrays {
        void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
    };
    Handle<Delete> handle_;
    mutable Handle<DeleteArrays> arrays_;  // an empty one
    mutable std::unordered_map<std::string, GLint> locations_;
};

/// Everything fixed that passes use, set as a whole, so that no pass inherits another's. No stencil, no scissor.
struct State {
    GLenum depth = GL_NONE;  ///< the comparison; GL_NONE: no test, and nothing is written
    bool write_depth = true;
    GLenum blend = GL_NONE;  ///< the equation, both factors being 1; GL_NONE: the last fragment stays
    GLenum cull = GL_NONE;   ///< which face is left out
    void set() const;
};

}  // namespace penumbra::opengl
