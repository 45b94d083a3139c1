// Three ways to the text of a shader. Prints a fragment shader; the argument says which way: file, header or embedded.
#include <cstdio>
#include <embedding_shaders.hpp>  // penumbra_embed_shaders(embedding ...) in CMakeLists.txt: what this program needs
#include <fstream>
#include <iterator>
#include <penumbra/shaders.hpp>  // everything; made by the build and installed
#include <string>

int main(int argc, char** argv) {
    const std::string way = argc > 1 ? argv[1] : "embedded";
    std::string snippet;
    if (way == "file") {  // self-contained copies: penumbra_FLAT_SHADER_DIR in CMake
        std::ifstream file(PENUMBRA_FLAT_SHADERS "/penumbra/combine.glsl");
        snippet.assign(std::istreambuf_iterator<char>(file), {});
    } else {
        snippet = way == "header" ? penumbra::shaders::combine : embedding_shaders::combine;
    }
    std::printf(
        "#version 330 core\n%sin vec2 occlusions;\nout vec4 color;\n"
        "void main() { color = vec4(1.0 - penumbra_combine_product(occlusions.x, occlusions.y)); }\n",
        snippet.c_str());
}
