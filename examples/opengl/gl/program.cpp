#include "program.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <penumbra/shaders.hpp>
#include <stdexcept>

namespace penumbra::opengl {
namespace {

/// Compiled for as long as it lives: a program keeps what it was linked with.
class Shader {
  public:
    Shader(GLenum stage, const Source& source) : name_(glCreateShader(stage)) {
        std::string text = stage == GL_COMPUTE_SHADER ? "#version 430 core\n" : "#version 330 core\n";
        for (const std::string& option : source.options) text += "#define " + option + "\n";
        for (const std::string_view part : source.texts) text += std::string(part) + "\n";
        const char* const begin = text.c_str();
        glShaderSource(name_, 1, &begin, nullptr);
        glCompileShader(name_);
        GLint good = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &good);
        if (good == GL_TRUE) return;
        char log[4096] = "";
        glGetShaderInfoLog(name_, sizeof log, nullptr, log);
        glDeleteShader(name_);
        throw std::runtime_error(std::string("a shader does not compile: ") + log + "\n" + text);
    }
    ~Shader() { glDeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name() const { return name_; }

  private:
    GLuint name_;
};

GLuint linked(const std::vector<const Shader*>& shaders) {
    const GLuint name = glCreateProgram();
    for (const Shader* shader : shaders) glAttachShader(name, shader->name());
    glBindAttribLocation(name, 0, "penumbra_position");
    glBindAttribLocation(name, 1, "penumbra_attribute_1");
    glBindAttribLocation(name, 2, "penumbra_attribute_2");
    glBindAttribLocation(name, 3, "penumbra_attribute_3");
    glLinkProgram(name);
    GLint good = GL_FALSE;
    glGetProgramiv(name, GL_LINK_STATUS, &good);
    if (good == GL_TRUE) return name;
    char log[4096] = "";
    glGetProgramInfoLog(name, sizeof log, nullptr, log);
    glDeleteProgram(name);
    throw std::runtime_error(std::string("a program does not link: ") + log);
}

GLuint empty_arrays() {  // core profiles draw nothing without one
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
}

}  // namespace

std::string_view library(std::string_view path) {
    for (const shaders::File& file : shaders::files)
        if (file.path == path) return file.text;
    throw std::logic_error("the library has no shader " + std::string(path));
}

Program::Program(const Source& vertex, const Source& fragment) {
    const Shader first(GL_VERTEX_SHADER, vertex), second(GL_FRAGMENT_SHADER, fragment);
    handle_ = Handle<Delete>(linked({&first, &second}));
}

Program::Program(const Source& compute) {
    const Shader shader(GL_COMPUTE_SHADER, compute);
    handle_ = Handle<Delete>(linked({&shader}));
}

Program Program::full_screen(const Source& fragment) {
    return Program(Source{{}, {library("occlusion_texture/full_screen.vert")}}, fragment);
}

void Program::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(at(name), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(const std::string& name, const LightFrame<float>& frame) const {
    set((name + ".origin").c_str(), frame.origin);
    set((name + ".u").c_str(), frame.u);
    set((name + ".v").c_str(), frame.v);
    set((name + ".normal").c_str(), frame.normal);
}

void Program::set(const char* name, int unit, const Texture& texture) const {
    texture.bind(unit);
    set(name, unit);
}

void Program::draw(GLenum primitives, int vertices) const {
    if (arrays_.name() == 0) arrays_ = Handle<DeleteArrays>(empty_arrays());
    glBindVertexArray(arrays_.name());
    glDrawArrays(primitives, 0, vertices);
    glBindVertexArray(0);
}

GLint Program::at(const char* name) const {
    const auto [place, is_new] = locations_.try_emplace(name, -1);
    if (is_new) place->second = glGetUniformLocation(handle_.name(), name);
    return place->second;
}

void State::set() const {
    const auto enable = [](GLenum what, bool on) { on ? glEnable(what) : glDisable(what); };
    enable(GL_DEPTH_TEST, depth != GL_NONE);
    if (depth != GL_NONE) glDepthFunc(depth);
    glDepthMask(write_depth ? GL_TRUE : GL_FALSE);
    enable(GL_BLEND, blend != GL_NONE);
    if (blend != GL_NONE) {
        glBlendEquation(blend);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    enable(GL_CULL_FACE, cull != GL_NONE);
    if (cull != GL_NONE) glCullFace(cull);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_MULTISAMPLE);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace penumbra::opengl
