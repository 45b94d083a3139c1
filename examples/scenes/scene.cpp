#include "scene.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "meshes.hpp"

namespace penumbra::scenes {
namespace {

using Vec = Vec3<float>;

constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

Light light_above(const Vec& center, float half_size) {
    return RectLight<float>{center, Vec(half_size, 0.0F, 0.0F), Vec(0.0F, 0.0F, half_size)};  // emits along −y
}

Light disk_above(const Vec& center, float radius) { return DiskLight<float>{center, Vec(0.0F, -1.0F, 0.0F), radius}; }

/// Along x.
Light line_above(const Vec& center, float half_length) {
    const Vec half(half_length, 0.0F, 0.0F);
    return LinearLight<float>{center - half, center + half};
}

void add_ground(Scene& scene) {
    add_quad(scene.ground, Vec(0.0F, 0.0F, 0.0F), Vec(12.0F, 0.0F, 0.0F), Vec(0.0F, 0.0F, -12.0F));
}

/// `side` × `side` spheres, 1 apart, in a layer above the ground.
std::vector<Mesh<float>> sphere_layer(int side) {
    std::vector<Mesh<float>> meshes;
    const float middle = 0.5F * static_cast<float>(side - 1);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            meshes.push_back(
                make_sphere(Vec(static_cast<float>(column) - middle, 1.5F, static_cast<float>(row) - middle), 0.36F));
    return meshes;
}

Scene spheres() {
    Scene scene;
    scene.about = "9 × 9 spheres of 762 triangles in a layer above a plane.";
    scene.casters = sphere_layer(9);
    scene.light = light_above(Vec(0.0F, 9.0F, 0.0F), 2.0F);
    scene.camera = {Vec(0.0F, 6.5F, 11.0F), Vec(0.0F, 0.6F, 0.6F), 0.50F};
    return scene;
}

Scene foliage() {
    Scene scene;
    scene.about = "50,000 random leaf triangles in the crowns of 24 trees.";
    scene.subject = Subject::occlusion_textures;
    Mesh<float> leaves;
    Random random(20061);
    std::vector<Vec> crowns;
    for (int tree = 0; tree < 24; ++tree)
        crowns.emplace_back(static_cast<float>(tree % 6) * 2.4F - 6.0F + random.in(-0.7F, 0.7F), random.in(4.2F, 5.2F),
                            static_cast<float>(tree / 6) * 2.6F - 4.6F + random.in(-0.7F, 0.7F));
    for (int leaf = 0; leaf < 50000; ++leaf) {
        const Vec& crown = crowns[static_cast<std::size_t>(leaf) % crowns.size()];
        const Vec away = random.direction();
        const Vec at = crown + away * std::cbrt(random.in(0.0F, 1.0F)) * Vec(1.3F, 1.0F, 1.3F);
        const Vec normal = random.direction();
        const float size = random.in(0.04F, 0.08F);
        add_leaf(leaves, at, normal, size, random.in(0.0F, 2.0F * pi<float>));
    }
    scene.casters.push_back(std::move(leaves));
    scene.light = light_above(Vec(0.0F, 12.0F, 0.0F), 1.8F);
    scene.camera = {Vec(0.0F, 4.6F, 10.0F), Vec(0.0F, 1.0F, 1.5F), 0.50F};
    return scene;
}

Scene sheet() {
    Scene scene;
    scene.about = "A thin sheet at 45°: the worst case for leaks between slices.";
    scene.subject = Subject::occlusion_textures;
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
    scene.subject = Subject::occlusion_textures;
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

Scene bunny() {
    Scene scene = load_scene(bunny_file);
    scene.about = fmt::format("The Stanford bunny, {} triangles.", scene.triangle_count());
    return scene;
}

/// The light and the camera of scenes of planar casters.
Scene planar(const std::string& about) {
    Scene scene;
    scene.about = about;
    scene.subject = Subject::overlap;
    scene.light = light_above(Vec(0.0F, 8.0F, 0.0F), 1.5F);
    scene.camera = {Vec(2.2F, 5.6F, 7.6F), Vec(0.0F, 1.5F, 0.0F), 0.42F};
    return scene;
}

/// `count` convex polygons in a cylinder above the ground, the smaller the more there are of them, so that the light is
/// seldom blocked as a whole.
Scene random_polygons(int count) {
    Scene scene = planar(fmt::format("{} polygons at random depths: shadows overlap by chance.", count));
    Random random(2006U + static_cast<std::uint32_t>(count));
    const float size = 1.05F * std::pow(static_cast<float>(count) * 0.5F, -0.3F), spread = 0.9F / size;
    for (int i = 0; i < count; ++i) {
        const float turn = random.in(0.0F, 2.0F * pi<float>);
        const float away = spread * std::sqrt(random.in(0.0F, 1.0F));
        const Vec at(away * std::cos(turn), random.in(1.6F, 4.6F), away * std::sin(turn));
        const Vec normal = glm::normalize(random.direction() * 0.7F + Vec(0.0F, 1.0F, 0.0F));
        const Vec u = any_perpendicular(normal), v = glm::cross(normal, u);
        const int corners = 3 + static_cast<int>(random.in(0.0F, 4.99F));
        const float long_side = size * random.in(0.8F, 1.3F), short_side = size * random.in(0.5F, 0.9F);
        std::vector<Vec> polygon;
        for (int k = 0; k < corners; ++k) {
            const float angle =
                (static_cast<float>(k) + random.in(-0.3F, 0.3F)) * 2.0F * pi<float> / static_cast<float>(corners);
            polygon.push_back(at + long_side * std::cos(angle) * u + short_side * std::sin(angle) * v);
        }
        scene.casters.push_back(make_polygon(polygon));
    }
    return scene;
}

Scene spheres_low() { return low_spheres(9); }
Scene overlap_2() { return random_polygons(2); }
Scene overlap_5() { return random_polygons(5); }
Scene overlap_20() { return random_polygons(20); }
Scene overlap_81() { return random_polygons(81); }

Scene comb() {
    Scene scene = planar("Two combs, each slat of one between two of the other: bounds overlap, slats do not.");
    for (int which = 0; which < 2; ++which) {
        Mesh<float> mesh;
        for (int slat = 0; slat < 7; ++slat)
            add_quad(mesh, Vec(static_cast<float>(2 * slat + which) * 0.22F - 1.43F, 2.5F, 0.0F),
                     Vec(0.08F, 0.0F, 0.0F), Vec(0.0F, 0.0F, -1.4F));
        scene.casters.push_back(std::move(mesh));
    }
    return scene;
}

Scene fan() {
    Scene scene = planar("16 triangles around a point, each sharing its sides with its neighbours: nothing overlaps.");
    constexpr int blades = 16;
    std::array<Vec, blades> rim;
    for (std::size_t i = 0; i < blades; ++i) {
        const float angle = static_cast<float>(i) * 2.0F * pi<float> / blades, size = i % 2 ? 1.1F : 1.7F;
        rim[i] = Vec(size * std::cos(angle), 2.5F + 0.35F * std::cos(angle), -size * std::sin(angle));
    }
    for (std::size_t i = 0; i < blades; ++i)
        scene.casters.push_back(make_polygon({Vec(0.0F, 2.5F, 0.0F), rim[i], rim[(i + 1) % blades]}));
    return scene;
}

/// A star, much smaller than the light, that leaves the less umbra on the ground the higher it is.
Scene concave(float height) {
    Scene scene;
    scene.about = fmt::format("A star of radius 1 under a light of radius 2, {:g} above the ground.", height);
    scene.subject = Subject::volumes;
    scene.casters.push_back(make_star(Vec(0.0F, height, 0.0F), 1.0F, 0.45F, 0.08F, 5));
    scene.light = disk_above(Vec(0.0F, 8.0F, 0.0F), 2.0F);
    scene.camera = {Vec(2.2F, 5.6F, 7.6F), Vec(0.0F, 0.4F + 0.25F * height, 0.0F), 0.36F};
    return scene;
}
Scene concave_near() { return concave(0.6F); }
Scene concave_middle() { return concave(1.4F); }
Scene concave_far() { return concave(3.0F); }

/// Quads under a line light.
Scene lines(const std::string& about) {
    Scene scene;
    scene.about = about;
    scene.subject = Subject::lines;
    scene.light = line_above(Vec(0.0F, 8.0F, 0.0F), 2.0F);
    scene.camera = {Vec(2.2F, 6.6F, 7.6F), Vec(0.0F, 0.9F, 0.0F), 0.42F};
    return scene;
}

Scene blocker() {
    Scene scene = lines("A flat quad, oblique to a line light, as in Heidrich, Brabec & Seidel's Figures 2, 4 and 9.");
    Mesh<float> quad;
    const float angle = 0.5F;
    const Vec u(std::cos(angle), 0.0F, -std::sin(angle)), v(-std::sin(angle), 0.0F, -std::cos(angle));
    add_quad(quad, Vec(0.0F, 2.5F, 0.0F), 1.3F * u, 0.8F * v);
    scene.casters.push_back(std::move(quad));
    return scene;
}

Scene two_blockers() {
    Scene scene = lines("Two quads with a gap, through which many points see the middle of a line light but no end.");
    for (const float side : {-1.0F, 1.0F}) {
        Mesh<float> quad;
        add_quad(quad, Vec(side * 1.4F, 3.0F, 0.0F), Vec(1.15F, 0.0F, 0.0F), Vec(0.0F, 0.0F, -0.8F));
        scene.casters.push_back(std::move(quad));
    }
    return scene;
}

Scene fence() {
    Scene scene = lines("40 bars in a row along a line light, as wide as the gaps between them.");
    constexpr int bars = 40;
    constexpr float half_width = 0.04F;
    Mesh<float> mesh;
    for (int bar = 0; bar < bars; ++bar)
        add_quad(mesh, Vec(4.0F * half_width * (static_cast<float>(bar) - 0.5F * (bars - 1)), 1.2F, 0.0F),
                 Vec(half_width, 0.0F, 0.0F), Vec(0.0F, 0.9F, -0.2F));
    scene.casters.push_back(std::move(mesh));
    scene.light = line_above(Vec(0.0F, 6.0F, -4.0F), 2.0F);
    scene.camera = {Vec(2.2F, 5.6F, 8.0F), Vec(0.0F, 0.4F, 1.0F), 0.42F};
    return scene;
}

/// A scene that was made for another kind of light.
Scene with_light(Scene scene, const std::string& kind) {
    scene.subject = kind == "disk" ? Subject::volumes : kind == "line" ? Subject::lines : Subject::methods;
    scene.light = as_kind(scene.light, kind);
    return scene;
}
Scene spheres_disk() { return with_light(spheres(), "disk"); }
Scene bunny_disk() { return with_light(bunny(), "disk"); }
Scene spheres_line() { return with_light(spheres(), "line"); }
Scene bunny_line() { return with_light(bunny(), "line"); }

struct Named {
    const char* name;
    Scene (*make)();
};
constexpr Named built_in[] = {{"spheres", spheres},
                              {"foliage", foliage},
                              {"sheet", sheet},
                              {"slab", slab},
                              {"boxes", boxes},
                              {"bunny", bunny},
                              {"spheres-low", spheres_low},
                              {"overlap-2", overlap_2},
                              {"overlap-5", overlap_5},
                              {"overlap-20", overlap_20},
                              {"overlap-81", overlap_81},
                              {"comb", comb},
                              {"fan", fan},
                              {"concave-near", concave_near},
                              {"concave", concave_middle},
                              {"concave-far", concave_far},
                              {"spheres-disk", spheres_disk},
                              {"bunny-disk", bunny_disk},
                              {"blocker", blocker},
                              {"two-blockers", two_blockers},
                              {"fence", fence},
                              {"spheres-line", spheres_line},
                              {"bunny-line", bunny_line}};

}  // namespace

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Mesh<float>& mesh : casters) count += mesh.triangles.size();
    return count;
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const Named& scene : built_in) names.emplace_back(scene.name);
    return names;
}

Scene load_scene(const std::string& file) {
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
    scene.light = light_above(Vec(1.5F, 7.0F, 1.5F), 0.8F);
    scene.camera = {Vec(2.5F, 4.5F, 9.0F), Vec(-0.2F, 1.1F, 0.0F), 0.33F};
    add_ground(scene);
    return scene;
}

Scene under(Scene scene, const std::string& kind, float size) {
    if (!kind.empty() && kind != kind_of(scene.light)) {
        scene = with_light(std::move(scene), kind);
        scene.name += ", " + kind;
    }
    if (size != 1.0F) {
        scene.light = scaled(scene.light, size);
        scene.name += fmt::format(", light × {:g}", size);
    }
    return scene;
}

Scene low_spheres(int side) {
    Scene scene;
    scene.about = fmt::format("{} × {} spheres under a low light, which sees them one behind the other.", side, side);
    scene.subject = Subject::overlap;
    scene.casters = sphere_layer(side);
    const Vec at(0.0F, 7.5F, -12.0F), down = glm::normalize(Vec(0.0F, 0.0F, 2.5F) - at), right(1.0F, 0.0F, 0.0F);
    scene.light = RectLight<float>{at, right * 1.5F, glm::cross(down, right) * 1.5F};
    scene.camera = {Vec(0.0F, 5.5F, 13.0F), Vec(0.0F, 0.2F, 3.6F), 0.42F};
    add_ground(scene);
    return scene;
}

Scene make_scene(const std::string& name) {
    for (const Named& named : built_in) {
        if (name != named.name) continue;
        Scene scene = named.make();
        scene.name = name;
        scene.ground = {};
        add_ground(scene);
        return scene;
    }
    throw std::runtime_error(fmt::format("there is no scene '{}'", name));
}

}  // namespace penumbra::scenes
