// Runs a few lines of GLSL on arrays of numbers.
#pragma once

#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "program.hpp"
#include "support/folder.hpp"

namespace penumbra::test {

/// How a text reaches the driver.
enum class Route { direct, spirv_cross };

/// All of them; direct only for mutants.sh, which runs tests a few hundred times.
inline std::vector<Route> routes() {
    if (std::getenv("PENUMBRA_SHADERS") != nullptr) return {Route::direct};
    return {Route::direct, Route::spirv_cross};
}

/// The text of a compute shader, without a version, as glslang and SPIRV-Cross make it for a context's language.
inline std::string crossed(const Context& context, const std::string& text) {
    const Folder folder;
    folder.write("in.comp", "#version 450\n" + text);
    const bool es = context.api() == Api::es;
    const std::string language = es ? "--es --version 310" : "--no-es --version 430";
    if (!folder.run("glslangValidator -G --aml in.comp -o in.spv") ||
        !folder.run("spirv-cross in.spv " + language + " --output out.comp"))
        throw std::runtime_error("glslang or SPIRV-Cross rejects the text");
    return folder.read("out.comp");
}

/// `body` reads the numbers I(0) … I(inputs − 1) of its tuple, and writes O(0) … O(outputs − 1).
struct Compute {
    std::string snippet;  ///< below shaders/penumbra
    int inputs, outputs;
    Program::Options options;
    std::string uniforms, body;
    Route route = Route::direct;

    std::vector<float> run(
        const Context& context, const std::vector<float>& in,
        const std::function<void(const Program&)>& set_uniforms = [](const Program&) {}) const {
        return run(program(context), in, set_uniforms);
    }
    /// To run many times.
    Program program(const Context& context) const {
        return Program(Text{route == Route::direct ? context.version(true) + text() : crossed(context, text())});
    }
    std::vector<float> run(const Program& program, const std::vector<float>& in,
                           const std::function<void(const Program&)>& set_uniforms) const {
        const std::size_t tuples = in.size() / static_cast<std::size_t>(inputs);
        std::vector<float> out(tuples * static_cast<std::size_t>(outputs));
        const auto bytes = static_cast<GLsizeiptr>(out.size() * sizeof(float));
        GLuint buffers[2];
        glGenBuffers(2, buffers);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(in.size() * sizeof(float)), in.data(),
                     GL_STATIC_DRAW);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_STATIC_READ);
        program.use();
        set_uniforms(program);
        program.set("penumbra_tuples", static_cast<int>(tuples));
        glDispatchCompute(static_cast<GLuint>((tuples + 63) / 64), 1, 1);
        glMemoryBarrier(GL_ALL_BARRIER_BITS);
        const void* result = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes, GL_MAP_READ_BIT);
        const GLenum error = glGetError();
        if (result == nullptr || error != GL_NO_ERROR)
            throw std::runtime_error("OpenGL error " + std::to_string(error));
        std::memcpy(out.data(), result, static_cast<std::size_t>(bytes));
        glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
        glDeleteBuffers(2, buffers);
        return out;
    }

  private:
    std::string text() const {
        std::string all;
        for (const std::string& option : options) all += "#define " + option + "\n";
        return all + "layout(local_size_x = 64) in;\nuniform int penumbra_tuples;\n" + uniforms +
               "layout(std430, binding = 0) readonly buffer In { float penumbra_in[]; };\n"
               "layout(std430, binding = 1) writeonly buffer Out { float penumbra_out[]; };\n"
               "#define I(k) penumbra_in[penumbra_tuple * " +
               std::to_string(inputs) + " + (k)]\n#define O(k) penumbra_out[penumbra_tuple * " +
               std::to_string(outputs) + " + (k)]\n" + flatten(snippet) +
               "void main() {\n    int penumbra_tuple = int(gl_GlobalInvocationID.x);\n"
               "    if (penumbra_tuple >= penumbra_tuples) return;\n    " +
               body + "\n}\n";
    }
};

}  // namespace penumbra::test
