// Meshes that scenes are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <penumbra/mesh.hpp>
#include <random>
#include <string>
#include <vector>

namespace penumbra::scenes {

/// Uniform numbers from a fixed seed, the same on every standard library.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float in(float low, float high);
    Vec3<float> direction();  ///< uniform on the sphere

  private:
    std::mt19937 engine_;
};

/// Adds a parallelogram at `center` spanned by two half-sides, counter-clockwise seen against cross(u, v).
void add_quad(Mesh<float>& mesh, const Vec3<float>& center, const Vec3<float>& u, const Vec3<float>& v);

/// Adds an equilateral triangle with corners at `size` from `center`, turned by `angle` in its plane.
void add_leaf(Mesh<float>& mesh, const Vec3<float>& center, const Vec3<float>& normal, float size, float angle);

/// A planar convex polygon, as a fan of triangles around its first corner.
Mesh<float> make_polygon(const std::vector<Vec3<float>>& corners);

/// A closed box with half-sides u, v, w (right-handed), welded.
Mesh<float> make_box(const Vec3<float>& center, const Vec3<float>& u, const Vec3<float>& v, const Vec3<float>& w);

/// A horizontal ring of `count` vertices of a turned solid, `y` above its centre.
struct Ring {
    float radius, y;
    std::uint32_t count;
};

/// A closed solid turned about the vertical axis: a top pole, rings from top to bottom, a bottom pole; neighbouring
/// rings may differ in their number of vertices.
Mesh<float> make_turned(const Vec3<float>& center, float top, const std::vector<Ring>& rings, float bottom);

/// A sphere of so many triangles, of about equal size: two poles, and rings of half as many vertices in all.
Mesh<float> make_sphere(const Vec3<float>& center, float radius, std::size_t triangles = 762);

/// A prism on a regular polygon of `rim` corners, its caps raised by `dome` in their middle and cut in about
/// `triangles` triangles in all, with no new vertex on the rim.
Mesh<float> make_prism(const Vec3<float>& center, float radius, float half_height, std::uint32_t rim,
                       std::size_t triangles, float dome);

/// A prism on a star: `spikes` corners at `outer` from its axis, the first towards +x, as many between them at `inner`.
Mesh<float> make_star(const Vec3<float>& center, float outer, float inner, float half_height, std::uint32_t spikes);

/// Every mesh of a file that assimp reads as one mesh, vertices at one place welded. Throws std::runtime_error with a
/// message for the user.
Mesh<float> import_mesh(const std::string& file);

}  // namespace penumbra::scenes
