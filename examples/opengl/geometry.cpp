#include "geometry.hpp"

#include <cstdint>

namespace penumbra::opengl {

Geometry::Geometry(const scenes::Scene& scene) {
    std::vector<Vec3<float>> positions;
    std::vector<std::uint32_t> indices;
    const auto add = [&](const Mesh<float>& mesh) {
        first_.push_back(indices.size());
        const auto base = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) indices.push_back(base + t[k]);
    };
    for (const Mesh<float>& mesh : scene.casters) add(mesh);
    add(scene.ground);
    first_.push_back(indices.size());

    GLuint buffers[2], arrays = 0;
    glGenVertexArrays(1, &arrays);
    glGenBuffers(2, buffers);
    arrays_ = Handle<DeleteArrays>(arrays);
    positions_ = Handle<DeleteBuffer>(buffers[0]);
    indices_ = Handle<DeleteBuffer>(buffers[1]);
    glBindVertexArray(arrays);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(positions.size() * sizeof(Vec3<float>)), positions.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindVertexArray(0);
}

void Geometry::draw(std::size_t from, std::size_t to) const {
    glBindVertexArray(arrays_.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(to - from), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(from * sizeof(std::uint32_t)));
    glBindVertexArray(0);
}

void Geometry::draw_casters() const { draw(0, first_[caster_count()]); }
void Geometry::draw_casters(std::size_t first, std::size_t end) const { draw(first_[first], first_[end]); }
void Geometry::draw_ground() const { draw(first_[caster_count()], first_.back()); }

}  // namespace penumbra::opengl
