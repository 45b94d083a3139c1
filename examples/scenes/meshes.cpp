#include "meshes.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <stdexcept>

namespace penumbra::scenes {
namespace {

using Vec = Vec3<float>;

/// Triangles between two neighbouring rings of vertices, a0 … a0 + an − 1 above b0 … b0 + bn − 1, without dents: sides
/// of both rings in the order of the directions in which they look.
void stitch(Mesh<float>& mesh, std::uint32_t a0, std::uint32_t an, std::uint32_t b0, std::uint32_t bn) {
    for (std::uint64_t i = 0, j = 0; i < an || j < bn;) {
        const auto a = static_cast<std::uint32_t>(a0 + i % an), b = static_cast<std::uint32_t>(b0 + j % bn);
        if (j == bn || (i < an && (2 * i + 1) * bn <= (2 * j + 1) * an)) {
            ++i;
            mesh.triangles.emplace_back(a, b, static_cast<std::uint32_t>(a0 + i % an));
        } else {
            ++j;
            mesh.triangles.emplace_back(a, b, static_cast<std::uint32_t>(b0 + j % bn));
        }
    }
}

}  // namespace

float Random::in(float low, float high) {
    return low + (high - low) * static_cast<float>(engine_() >> 8) * (1.0F / 16777216.0F);
}

Vec Random::direction() {
    const float y = in(-1.0F, 1.0F), angle = in(0.0F, 2.0F * pi<float>), r = std::sqrt(1.0F - y * y);
    return Vec(r * std::cos(angle), y, r * std::sin(angle));
}

void add_quad(Mesh<float>& mesh, const Vec& center, const Vec& u, const Vec& v) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec& corner : {center - u - v, center + u - v, center + u + v, center - u + v})
        mesh.positions.push_back(corner);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

void add_leaf(Mesh<float>& mesh, const Vec& center, const Vec& normal, float size, float angle) {
    const Vec side = any_perpendicular(normal), up = glm::cross(normal, side);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 3; ++corner) {
        const float at = angle + static_cast<float>(corner) * 2.0F * pi<float> / 3.0F;
        mesh.positions.push_back(center + size * (std::cos(at) * side + std::sin(at) * up));
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

Mesh<float> make_polygon(const std::vector<Vec>& corners) {
    Mesh<float> mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 2; i < corners.size(); ++i) mesh.triangles.emplace_back(0U, i - 1, i);
    return mesh;
}

Mesh<float> make_box(const Vec& center, const Vec& u, const Vec& v, const Vec& w) {
    Mesh<float> mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.push_back(center + ((i & 1U) ? u : -u) + ((i & 2U) ? v : -v) + ((i & 4U) ? w : -w));
    constexpr std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.emplace_back(q[0], q[1], q[2]);
        mesh.triangles.emplace_back(q[0], q[2], q[3]);
    }
    return mesh;
}

Mesh<float> make_turned(const Vec& center, float top, const std::vector<Ring>& rings, float bottom) {
    Mesh<float> mesh;
    mesh.positions.push_back(center + Vec(0.0F, top, 0.0F));
    for (const Ring& ring : rings) {
        for (std::uint32_t k = 0; k < ring.count; ++k) {
            const double angle = 2.0 * pi<double> * k / ring.count;
            mesh.positions.push_back(center + Vec(ring.radius * static_cast<float>(std::cos(angle)), ring.y,
                                                  ring.radius * static_cast<float>(-std::sin(angle))));
        }
    }
    mesh.positions.push_back(center + Vec(0.0F, bottom, 0.0F));
    std::uint32_t above = 0, above_count = 1, first = 1;
    for (const Ring& ring : rings) {
        if (above_count == 1)
            for (std::uint32_t k = 0; k < ring.count; ++k)
                mesh.triangles.emplace_back(0U, first + k, first + (k + 1) % ring.count);
        else
            stitch(mesh, above, above_count, first, ring.count);
        above = first, above_count = ring.count, first += ring.count;
    }
    for (std::uint32_t k = 0; k < above_count; ++k)
        mesh.triangles.emplace_back(first, above + (k + 1) % above_count, above + k);
    return mesh;
}

Mesh<float> make_sphere(const Vec& center, float radius, std::size_t triangles) {
    const double ring_vertices = static_cast<double>(triangles / 2);
    const int rings = static_cast<int>(std::lround(0.87 * std::sqrt(ring_vertices)));
    std::vector<Ring> profile;
    double wanted = 0.0, sines = 0.0;
    for (int i = 1; i <= rings; ++i) sines += std::sin(pi<double> * i / (rings + 1));
    std::uint32_t placed = 0;
    for (int i = 1; i <= rings; ++i) {
        const double theta = pi<double> * i / (rings + 1);
        wanted += ring_vertices * std::sin(theta) / sines;
        const auto count = static_cast<std::uint32_t>(std::lround(wanted)) - placed;
        placed += count;
        profile.push_back(
            {radius * static_cast<float>(std::sin(theta)), radius * static_cast<float>(std::cos(theta)), count});
    }
    return make_turned(center, radius, profile, -radius);
}

Mesh<float> make_prism(const Vec& center, float radius, float half_height, std::uint32_t rim, std::size_t triangles,
                       float dome) {
    // ring i of a cap has 6 i vertices, so n rings make about 6 n² triangles
    const int rings = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 12.0))));
    // so far inside the rim's polygon that no triangle between the last ring and the rim folds over
    const float inside = radius * std::cos(2.0F * pi<float> / static_cast<float>(rim));
    std::vector<Ring> profile;
    for (int i = 1; i < rings; ++i) {
        const float at = static_cast<float>(i) / static_cast<float>(rings);
        profile.push_back({at * inside, half_height + dome * (1.0F - at * at), static_cast<std::uint32_t>(6 * i)});
    }
    profile.push_back({radius, half_height, rim});
    for (std::size_t i = profile.size(); i-- > 0;)
        profile.push_back({profile[i].radius, -profile[i].y, profile[i].count});
    return make_turned(center, half_height + dome, profile, -half_height - dome);
}

Mesh<float> make_star(const Vec& center, float outer, float inner, float half_height, std::uint32_t spikes) {
    const std::uint32_t corners = 2 * spikes;
    Mesh<float> mesh =
        make_turned(center, half_height, {{outer, half_height, corners}, {outer, -half_height, corners}}, -half_height);
    for (std::uint32_t k = 1; k < 2 * corners; k += 2) {  // between the poles
        Vec& dent = mesh.positions[1 + k];
        for (const int axis : {0, 2}) dent[axis] = mix(center[axis], dent[axis], inner / outer);
    }
    return mesh;
}

Mesh<float> import_mesh(const std::string& file) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TEXCOORDS |
                                                            aiComponent_COLORS | aiComponent_TANGENTS_AND_BITANGENTS);
    const aiScene* imported =
        importer.ReadFile(file, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                    aiProcess_PreTransformVertices | aiProcess_SortByPType);
    if (imported == nullptr)
        throw std::runtime_error(fmt::format("cannot read mesh '{}': {}", file, importer.GetErrorString()));
    Mesh<float> mesh;
    for (unsigned m = 0; m < imported->mNumMeshes; ++m) {
        const aiMesh& part = *imported->mMeshes[m];
        if (!(part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) continue;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (unsigned i = 0; i < part.mNumVertices; ++i)
            mesh.positions.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            const aiFace& face = part.mFaces[f];
            if (face.mNumIndices == 3)
                mesh.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1],
                                            first + face.mIndices[2]);
        }
    }
    if (mesh.triangles.empty()) throw std::runtime_error(fmt::format("mesh '{}' has no triangles", file));
    if (!validate(mesh, file)) throw std::runtime_error(fmt::format("mesh '{}' is not valid", file));
    return mesh;
}

}  // namespace penumbra::scenes
