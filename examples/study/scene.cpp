#include "scene.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace penumbra::study {
namespace {

using Vec = Vec3<float>;

constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

/// Uniform numbers from a fixed seed, the same on every standard library.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float in(float low, float high) {
        return low + (high - low) * static_cast<float>(engine_() >> 8) * (1.0F / 16777216.0F);
    }
    Vec direction() {
        const float y = in(-1.0F, 1.0F), angle = in(0.0F, 2.0F * pi<float>), r = std::sqrt(1.0F - y * y);
        return Vec(r * std::cos(angle), y, r * std::sin(angle));
    }

  private:
    std::mt19937 engine_;
};

/// A parallelogram at `center` spanned by two half-sides, counter-clockwise seen against cross(u, v).
void add_quad(Mesh<float>& mesh, const Vec& center, const Vec& u, const Vec& v) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec& corner : {center - u - v, center + u - v, center + u + v, center - u + v})
        mesh.positions.push_back(corner);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// A closed box with half-sides u, v, w (right-handed), welded.
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

/// A sphere of 762 triangles of about equal size: two poles and 17 rings of 381 vertices in all.
Mesh<float> make_sphere(const Vec& center, float radius) {
    constexpr int rings = 17, ring_vertices = 381;
    Mesh<float> mesh;
    mesh.positions.push_back(center + Vec(0.0F, radius, 0.0F));
    std::vector<std::uint32_t> first, count;
    double wanted = 0.0, sines = 0.0;
    for (int i = 1; i <= rings; ++i) sines += std::sin(pi<double> * i / (rings + 1));
    std::uint32_t placed = 0;
    for (int i = 1; i <= rings; ++i) {
        const double theta = pi<double> * i / (rings + 1);
        wanted += ring_vertices * std::sin(theta) / sines;
        const auto n = static_cast<std::uint32_t>(std::lround(wanted)) - placed;
        placed += n;
        first.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        count.push_back(n);
        for (std::uint32_t k = 0; k < n; ++k) {
            const double angle = 2.0 * pi<double> * k / n;
            mesh.positions.push_back(center + radius * Vec(static_cast<float>(std::sin(theta) * std::cos(angle)),
                                                           static_cast<float>(std::cos(theta)),
                                                           static_cast<float>(-std::sin(theta) * std::sin(angle))));
        }
    }
    mesh.positions.push_back(center - Vec(0.0F, radius, 0.0F));
    const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::uint32_t k = 0; k < count.front(); ++k)
        mesh.triangles.emplace_back(0U, first.front() + k, first.front() + (k + 1) % count.front());
    for (std::size_t ring = 0; ring + 1 < first.size(); ++ring) {
        const std::uint32_t a0 = first[ring], an = count[ring], b0 = first[ring + 1], bn = count[ring + 1];
        // walk both rings by angle; each step makes one triangle
        for (std::uint32_t i = 0, j = 0; i < an || j < bn;) {
            const bool step_a = j == bn || (i < an && (i + 1) * bn <= (j + 1) * an);
            if (step_a) {
                mesh.triangles.emplace_back(a0 + i % an, b0 + j % bn, a0 + (i + 1) % an);
                ++i;
            } else {
                mesh.triangles.emplace_back(a0 + i % an, b0 + j % bn, b0 + (j + 1) % bn);
                ++j;
            }
        }
    }
    for (std::uint32_t k = 0; k < count.back(); ++k)
        mesh.triangles.emplace_back(south, first.back() + (k + 1) % count.back(), first.back() + k);
    return mesh;
}

RectLight<float> light_above(const Vec& center, float half_size) {
    return {center, Vec(half_size, 0.0F, 0.0F), Vec(0.0F, 0.0F, half_size)};  // emits along −y
}

Scene spheres() {
    Scene scene;
    scene.about = "9 × 9 spheres of 762 triangles in a layer above a plane.";
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 9; ++column)
            scene.casters.push_back(
                make_sphere(Vec(static_cast<float>(column - 4), 1.5F, static_cast<float>(row - 4)), 0.36F));
    scene.light = light_above(Vec(0.0F, 9.0F, 0.0F), 2.0F);
    scene.camera = {Vec(0.0F, 6.5F, 11.0F), Vec(0.0F, 0.6F, 0.6F), 0.50F};
    return scene;
}

Scene foliage() {
    Scene scene;
    scene.about = "50,000 random leaf triangles in the crowns of 24 trees.";
    Mesh<float> leaves;
    Random random(20061);
    std::vector<Vec> crowns;
    for (int tree = 0; tree < 24; ++tree)
        crowns.emplace_back(static_cast<float>(tree % 6) * 2.4F - 6.0F + random.in(-0.7F, 0.7F), random.in(4.2F, 5.2F),
                            static_cast<float>(tree / 6) * 2.6F - 4.6F + random.in(-0.7F, 0.7F));
    for (int leaf = 0; leaf < 50000; ++leaf) {
        const Vec& crown = crowns[static_cast<std::size_t>(leaf) % crowns.size()];
        const Vec at = crown + random.direction() * std::cbrt(random.in(0.0F, 1.0F)) * Vec(1.3F, 1.0F, 1.3F);
        const Vec normal = random.direction(), side = any_perpendicular(normal), up = glm::cross(normal, side);
        const float size = random.in(0.04F, 0.08F), turn = random.in(0.0F, 2.0F * pi<float>);
        const auto first = static_cast<std::uint32_t>(leaves.positions.size());
        for (int corner = 0; corner < 3; ++corner) {
            const float angle = turn + static_cast<float>(corner) * 2.0F * pi<float> / 3.0F;
            leaves.positions.push_back(at + size * (std::cos(angle) * side + std::sin(angle) * up));
        }
        leaves.triangles.emplace_back(first, first + 1, first + 2);
    }
    scene.casters.push_back(std::move(leaves));
    scene.light = light_above(Vec(0.0F, 12.0F, 0.0F), 1.8F);
    scene.camera = {Vec(0.0F, 4.6F, 10.0F), Vec(0.0F, 1.0F, 1.5F), 0.50F};
    return scene;
}

Scene sheet() {
    Scene scene;
    scene.about = "A thin sheet at 45°: the worst case for leaks between slices.";
    Mesh<float> quad;
    add_quad(quad, Vec(0.0F, 2.0F, 0.0F), Vec(1.2F, 1.2F, 0.0F), Vec(0.0F, 0.0F, -1.6F));
    scene.casters.push_back(std::move(quad));
    scene.light = light_above(Vec(0.0F, 7.0F, 0.0F), 1.0F);
    scene.camera = {Vec(5.0F, 5.0F, 7.5F), Vec(0.0F, 0.8F, 0.0F), 0.42F};
    return scene;
}

Scene slab() {
    Scene scene;
    scene.about = "A thick slab parallel to the ground.";
    scene.casters.push_back(
        make_box(Vec(0.0F, 2.0F, 0.0F), Vec(1.5F, 0.0F, 0.3F), Vec(0.0F, 0.35F, 0.0F), Vec(-0.2F, 0.0F, 1.0F)));
    scene.light = light_above(Vec(0.0F, 7.0F, 0.0F), 1.0F);
    scene.camera = {Vec(4.0F, 5.0F, 8.0F), Vec(0.0F, 0.7F, 0.0F), 0.42F};
    return scene;
}

Scene boxes() {
    Scene scene;
    scene.about = "40 boxes of all sizes, standing on the ground.";
    Random random(1963);
    for (int i = 0; i < 40; ++i) {
        const float angle = random.in(0.0F, pi<float>);
        const Vec half(random.in(0.12F, 0.4F), random.in(0.1F, 1.1F), random.in(0.12F, 0.4F));
        const Vec at(static_cast<float>(i % 8) * 1.1F - 3.85F + random.in(-0.3F, 0.3F), half.y,
                     static_cast<float>(i / 8) * 1.3F - 2.6F + random.in(-0.3F, 0.3F));
        const Vec u(std::cos(angle), 0.0F, -std::sin(angle)), w(std::sin(angle), 0.0F, std::cos(angle));
        scene.casters.push_back(make_box(at, u * half.x, Vec(0.0F, half.y, 0.0F), w * half.z));
    }
    scene.light = light_above(Vec(-1.0F, 9.0F, 1.0F), 1.5F);
    scene.camera = {Vec(0.0F, 8.0F, 10.5F), Vec(0.0F, 0.4F, 0.2F), 0.45F};
    return scene;
}

/// Every mesh of the file as one caster, vertices at one place welded.
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

}  // namespace

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Mesh<float>& mesh : casters) count += mesh.triangles.size();
    return count;
}

std::string Scene::light_text() const {
    return fmt::format("rectangle {:.3g} × {:.3g}, {:.3g} above the ground", 2.0F * glm::length(light.half_u),
                       2.0F * glm::length(light.half_v), light.center.y);
}

std::vector<std::string> scene_names() { return {"spheres", "foliage", "sheet", "slab", "boxes", "bunny"}; }

Scene load_scene(const std::string& file, float light_size) {
    Mesh<float> mesh = import_mesh(file);
    const Box3<float> box = bounds(mesh);
    const Vec size = box.max - box.min;
    const float largest = std::max({size.x, size.y, size.z});
    if (!(largest > 0.0F)) throw std::runtime_error(fmt::format("mesh '{}' is a single point", file));
    const Vec base((box.min.x + box.max.x) * 0.5F, box.min.y, (box.min.z + box.max.z) * 0.5F);
    for (Vec& p : mesh.positions) p = (p - base) * (3.0F / largest) + Vec(0.0F, 0.2F, 0.0F);

    Scene scene;
    scene.name = file.substr(file.find_last_of('/') + 1);
    scene.about = fmt::format("{} triangles, scaled to 3 units, above the ground.", mesh.triangles.size());
    scene.casters.push_back(std::move(mesh));
    scene.light = light_above(Vec(1.5F, 7.0F, 1.5F), 0.8F * light_size);
    scene.camera = {Vec(2.5F, 4.5F, 9.0F), Vec(-0.2F, 1.1F, 0.0F), 0.33F};
    add_quad(scene.ground, Vec(0.0F, 0.0F, 0.0F), Vec(12.0F, 0.0F, 0.0F), Vec(0.0F, 0.0F, -12.0F));
    return scene;
}

Scene make_scene(const std::string& name, float light_size) {
    if (name == "bunny") {
        Scene scene = load_scene(bunny_file, light_size);
        scene.name = name;
        scene.about = fmt::format("The Stanford bunny, {} triangles.", scene.triangle_count());
        return scene;
    }
    static const std::map<std::string, Scene (*)()> makers = {
        {"spheres", spheres}, {"foliage", foliage}, {"sheet", sheet}, {"slab", slab}, {"boxes", boxes}};
    const auto maker = makers.find(name);
    if (maker == makers.end()) throw std::runtime_error(fmt::format("there is no scene '{}'", name));
    Scene scene = maker->second();
    scene.name = name;
    scene.light.half_u *= light_size;
    scene.light.half_v *= light_size;
    add_quad(scene.ground, Vec(0.0F, 0.0F, 0.0F), Vec(12.0F, 0.0F, 0.0F), Vec(0.0F, 0.0F, -12.0F));
    return scene;
}

}  // namespace penumbra::study
