#include "method.hpp"

#include <stdexcept>

#include "tile_classes.hpp"

namespace penumbra::opengl {
namespace {

struct Named {
    const char* name;
    std::unique_ptr<Method> (*make)(const Capabilities&);
};
constexpr Named methods[] = {{"occlusion_texture", make_occlusion_texture},
                             {"penumbra_wedge", make_penumbra_wedge},
                             {"umbra_volume", make_umbra_volume},
                             {"soft_shadow_map", make_soft_shadow_map},
                             {"pcss", make_pcss}};

}  // namespace

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const Named& method : methods) names.emplace_back(method.name);
    return names;
}

std::unique_ptr<Method> make_method(const std::string& name, const Capabilities& capabilities) {
    for (const Named& method : methods)
        if (name == method.name) return method.make(capabilities);
    throw std::runtime_error("there is no method '" + name + "'");
}

void tell_points(const Program& program, const Frame& frame) {
    constexpr int unit = 8;  // also where there are no tiles: samplers of two types may not have the same
    program.set("positions", 0, frame.positions);
    program.set("tile_classes", unit);
    program.set("tile_size", frame.tiles != nullptr ? TileClasses::size : 0);
    if (frame.tiles != nullptr) frame.tiles->bind(unit);
}

}  // namespace penumbra::opengl
