// What the command line says.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "../scenes/scene.hpp"
#include "presenter.hpp"

namespace penumbra::opengl {

struct Arguments {
    std::string scene = "spheres", mesh, light, method, gl = "4.3";
    std::vector<std::string> knobs;
    float light_size = 1.0F;
    float plan = -1.0F;  ///< the tolerance of a plan; negative: none
    glm::ivec2 size{960, 720};
    bool size_given = false;
    bool ordinary_depth = false;
    Picture picture = Picture::shaded;
    float split = 1.0F;

    std::string out;        ///< a picture
    std::string csv;        ///< milliseconds of each pass and frame
    int frames = 0;         ///< 0: one without a window, no end with one
    int rays = 256;         ///< a point, of the truth in pictures of it
    bool panels = false;    ///< truth, method and difference side by side
    bool compare = false;   ///< print how far the GPU is from the C++
    bool exercise = false;  ///< for tests: turns, resizes and minimises at random
};

/// The scene that is asked for. Throws std::runtime_error with a message for the user.
inline scenes::Scene wanted_scene(const Arguments& arguments) {
    const scenes::Scene scene =
        arguments.mesh.empty() ? scenes::make_scene(arguments.scene) : scenes::load_scene(arguments.mesh);
    return scenes::under(scene, arguments.light, arguments.light_size);
}

}  // namespace penumbra::opengl
