// What the study looks at: casters, a receiver, a light that fits them, and a camera.
#pragma once

#include <cstddef>
#include <penumbra/mesh.hpp>
#include <string>
#include <vector>

#include "light.hpp"

namespace penumbra::scenes {

/// A pinhole camera; `width_tan` is the tangent of half the horizontal field of view.
struct Camera {
    Vec3<float> eye, target;
    float width_tan = 0.4F;
};

/// What a scene is there to compare.
enum class Subject {
    methods,             ///< all of them, with all their settings
    occlusion_textures,  ///< their settings; other methods by their defaults
    overlap,             ///< what rules make of casters that one sees before each other
    volumes,             ///< where umbra and penumbra begin under a disk light
    lines                ///< what few samples of a line light miss
};

/// World space, y up, the ground at y = 0. The ground receives but does not cast.
struct Scene {
    std::string name;
    std::string about;  ///< one sentence for the report
    std::vector<Mesh<float>> casters;
    Mesh<float> ground;
    Light light;
    Camera camera;
    Subject subject = Subject::methods;

    std::size_t triangle_count() const;
};

/// The built-in scenes, in the order of the report.
std::vector<std::string> scene_names();

/// A built-in scene by name. Throws std::runtime_error with a message for the user if there is none of that name or if
/// the bunny's package is missing.
Scene make_scene(const std::string& name);

/// Any mesh file that assimp reads, scaled and stood on the ground under a light that fits it.
Scene load_scene(const std::string& file);

/// The scene under a light of `kind` made of its own (see as_kind), its own if none is given, scaled by `size`. What is
/// not the scene's own goes into its name; another kind makes methods for it the subject.
Scene under(Scene scene, const std::string& kind, float size);

/// The scene `spheres-low`, with `side` × `side` spheres.
Scene low_spheres(int side);

}  // namespace penumbra::scenes
