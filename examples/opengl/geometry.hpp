// A scene's meshes on the GPU.
#pragma once

#include <cstddef>
#include <vector>

#include "../scenes/scene.hpp"
#include "gl/program.hpp"

namespace penumbra::opengl {

/// Triangles in one buffer: attribute 0, penumbra_position, world space. Casters first, in the scene's order, then the
/// ground.
class Geometry {
  public:
    Geometry() = default;
    explicit Geometry(const scenes::Scene& scene);

    void draw_casters() const;
    void draw_casters(std::size_t first, std::size_t end) const;  ///< meshes [first, end)
    void draw_ground() const;
    std::size_t caster_count() const { return first_.size() - 2; }

  private:
    void draw(std::size_t from, std::size_t to) const;

    struct DeleteBuffer {
        void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
    };
    struct DeleteArrays {
        void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
    };
    Handle<DeleteBuffer> positions_, indices_;
    Handle<DeleteArrays> arrays_;
    std::vector<std::size_t> first_;  // the first index of each mesh, and what follows the last
};

}  // namespace penumbra::opengl
