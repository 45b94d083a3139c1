// Scenes of all kinds for plans, and points where a camera sees what receives shadows in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <penumbra/light.hpp>
#include <penumbra/mesh.hpp>
#include <utility>
#include <vector>

#include "support/box_mesh.hpp"
#include "support/random.hpp"
#include "support/solids.hpp"

namespace penumbra::test {

/// What a scene is drawn from besides its number.
enum class SceneKind {
    any,         ///< anything; a third are `specks`
    specks,      ///< small casters high above a receiving ground below a light that is not, and a few larger ones
    flat_layers  ///< flat casters at a few heights below a light that is parallel to them, over a receiving ground
};

/// Casters, what receives, and where the light is: any shape of light takes its size from the two sides.
template <class T>
struct PlanScene {
    std::vector<Mesh<T>> casters, receivers;
    bool casters_receive = true;
    Vec3<T> center, half_u, half_v;

    RectLight<T> rect() const { return {center, half_u, half_v}; }
    DiskLight<T> disk() const {
        return {center, normalize_or(glm::cross(half_u, half_v), Vec3<T>(T(0), T(0), T(-1))), glm::length(half_u)};
    }
    LinearLight<T> line() const { return {center - half_u, center + half_u}; }
};

/// An outline, counterclockwise, seen whole from `middle`, from z = −half to z = half; wound outwards.
template <class T>
Mesh<T> prism(const std::vector<Vec2<T>>& outline, const Vec2<T>& middle, T half) {
    Mesh<T> mesh;
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const T z : {-half, half})
        for (const Vec2<T>& p : outline) mesh.positions.emplace_back(p.x, p.y, z);
    for (const T z : {-half, half}) mesh.positions.emplace_back(middle.x, middle.y, z);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = (i + 1) % n;
        for (const glm::uvec3& t : {glm::uvec3(2 * n, k, i), glm::uvec3(2 * n + 1, n + i, n + k),
                                    glm::uvec3(i, k, n + k), glm::uvec3(i, n + k, n + i)})
            mesh.triangles.push_back(t);
    }
    return mesh;
}

template <class T>
Mesh<T> convex_polygon(Random& random, int corners) {
    Mesh<T> mesh;
    const T turn = T(6.2831853), first = random.in(T(0), turn);
    for (int i = 0; i < corners; ++i) {
        const T angle = first + turn * static_cast<T>(i) / static_cast<T>(corners);
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), T(0));
    }
    for (std::uint32_t i = 2; i < static_cast<std::uint32_t>(corners); ++i) mesh.triangles.emplace_back(0, i - 1, i);
    return mesh;
}

/// Around 0, about as large as 1.
template <class T>
Mesh<T> random_solid(Random& random) {
    switch (random.whole(0, 8)) {
        case 0:
            return convex_polygon<T>(random, 4);
        case 1: {
            const int corners = random.whole(3, 8);
            return convex_polygon<T>(random, corners);
        }
        case 2:
            return tetrahedron_mesh<T>();
        case 3:
            return prism<T>({{T(-1), T(-1)}, {T(1), T(-1)}, {T(1), T(0)}, {T(0), T(0)}, {T(0), T(1)}, {T(-1), T(1)}},
                            {T(-0.5), T(-0.5)}, random.in(T(0.1), T(1)));
        case 4: {
            const int tips = random.whole(3, 6);
            const T inner = random.in(T(0.2), T(0.7)), half = random.in(T(0.05), T(0.6));
            std::vector<Vec2<T>> outline;
            for (int i = 0; i < 2 * tips; ++i) {
                const T angle = T(3.14159265) * static_cast<T>(i) / static_cast<T>(tips), r = i % 2 == 0 ? T(1) : inner;
                outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
            }
            return prism<T>(outline, {T(0), T(0)}, half);
        }
        case 5:
            return icosphere<T>(random.whole(0, 1));
        case 6:
            return soup<T>(random, 6, 3);
        default:
            return box_mesh<T>(Vec3<T>(T(0), T(0), T(0)), random.point(T(0.1), T(1)));
    }
}

template <class T>
void append(Mesh<T>& to, const Mesh<T>& from) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (const glm::uvec3& t : from.triangles) to.triangles.push_back(t + first);
}

/// Each triangle with vertices of its own.
template <class T>
Mesh<T> unwelded(const Mesh<T>& mesh) {
    Mesh<T> result;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (int k = 0; k < 3; ++k) result.positions.push_back(mesh.positions[t[k]]);
        result.triangles.emplace_back(first, first + 1, first + 2);
    }
    return result;
}

template <class T>
Mesh<T> moved(Mesh<T> mesh, const Vec3<T>& by) {
    for (Vec3<T>& p : mesh.positions) p += by;
    return mesh;
}

/// Horizontal, facing up.
template <class T>
Mesh<T> level_quad(const Vec3<T>& center, T half_x, T half_y) {
    const Vec3<T> x(half_x, T(0), T(0)), y(T(0), half_y, T(0));
    return {{center - x - y, center + x - y, center + x + y, center - x + y}, {{0, 1, 2}, {0, 2, 3}}};
}

namespace detail {

/// Between low and high, each order of magnitude as often.
template <class T>
T size_in(Random& random, T low, T high) {
    return low * std::exp(random.in(T(0), T(1)) * std::log(high / low));
}

template <class T>
void place_light(Random& random, PlanScene<T>& scene, T height, T tilt) {
    const T x = random.in(T(-3), T(3)), y = random.in(T(-3), T(3));
    scene.center = Vec3<T>(x, y, height);
    const Vec3<T> aside = random.point(T(-1), T(1)) * tilt;
    const Vec3<T> normal = normalize_or(Vec3<T>(aside.x, aside.y, T(-1)), Vec3<T>(T(0), T(0), T(-1)));
    const Vec3<T> a = any_perpendicular(normal), b = glm::cross(normal, a);
    const T turn = random.in(T(0), T(6.28)), aspect = random.in(T(0.3), T(1));
    const int kind = random.whole(0, 31);
    const T size = kind == 0   ? T(0)
                   : kind < 8  ? size_in(random, T(0.002), T(0.03))
                   : kind < 20 ? size_in(random, T(0.03), T(0.3))
                               : size_in(random, T(0.3), T(2));
    scene.half_u = (a * std::cos(turn) + b * std::sin(turn)) * size;
    scene.half_v = (b * std::cos(turn) - a * std::sin(turn)) * (kind == 8 ? T(0) : size * aspect);
}

template <class T>
Mesh<T> random_caster(Random& random, T spread, T height) {
    const T size = size_in(random, T(0.01), T(1.2));
    Mesh<T> mesh;
    const int parts = random.whole(0, 7) == 0 ? random.whole(2, 4) : 1;
    for (int k = 0; k < parts; ++k) {
        Mesh<T> part = random_solid<T>(random);
        const bool turned = random.whole(0, 1) == 0;
        if (turned) part = placed(part, random, T(1), Vec3<T>(T(0), T(0), T(0)));
        append(mesh, k == 0 ? part : moved(part, random.point(T(-2), T(2))));
    }
    for (Vec3<T>& p : mesh.positions) p *= size;
    if (random.whole(0, 9) == 0) mesh = unwelded(mesh);
    const T lowest = bounds(mesh).min.z, x = random.in(-spread, spread), y = random.in(-spread, spread);
    const bool stands = random.whole(0, 2) == 0;
    const T share = random.in(T(0), random.whole(0, 9) == 0 ? T(1.3) : T(0.85));
    return moved(mesh, Vec3<T>(x, y, stands ? -lowest : share * height));
}

}  // namespace detail

/// The same for the same number.
template <class T>
PlanScene<T> random_scene(std::uint32_t number, SceneKind kind = SceneKind::any) {
    Random random(number);
    PlanScene<T> scene;
    const bool flat = kind == SceneKind::flat_layers;
    const bool specks = kind == SceneKind::specks || (kind == SceneKind::any && number % 3 == 0);
    const T height = detail::size_in(random, T(2), T(9));
    detail::place_light(random, scene, height, flat || specks ? T(0) : random.whole(0, 4) == 0 ? T(2) : T(0.4));
    if (specks && random.whole(0, 7) != 0) {  // a light much larger than they are
        const T size = detail::size_in(random, T(0.3), T(2)), aspect = random.in(T(0.3), T(1));
        scene.half_u = normalize_or(scene.half_u, Vec3<T>(T(1), T(0), T(0))) * size;
        scene.half_v = glm::cross(Vec3<T>(T(0), T(0), T(-1)), scene.half_u) * aspect;
    }
    const int count = random.whole(0, 3) == 0 ? 1 : random.whole(2, 12);
    const T spreads[] = {T(0.3), T(1), T(3), T(7)}, spread = spreads[random.whole(0, 3)];
    if (flat) {
        const int layers = random.whole(1, 3);
        const T lowest = random.in(T(0.1), T(0.5)) * height, apart = random.in(T(0.02), T(0.15)) * height;
        for (int i = 0; i < count; ++i) {
            Mesh<T> mesh = convex_polygon<T>(random, random.whole(3, 6));
            const T size = detail::size_in(random, T(0.02), T(1));
            const T x = random.in(-spread, spread), y = random.in(-spread, spread);
            for (Vec3<T>& p : mesh.positions) p = p * size + Vec3<T>(x, y, lowest + apart * static_cast<T>(i % layers));
            scene.casters.push_back(std::move(mesh));
        }
    } else if (specks) {
        const T size_of_light = glm::length(scene.half_u);
        for (int i = 0; i < count; ++i) {
            Mesh<T> mesh = random_solid<T>(random);
            const bool large = random.whole(0, 3) == 0, turned = random.whole(0, 1) == 0;
            if (turned) mesh = placed(mesh, random, T(1), Vec3<T>(T(0), T(0), T(0)));
            const T size = size_of_light * (large ? detail::size_in(random, T(0.05), T(0.5))
                                                  : detail::size_in(random, T(0.002), T(0.1)));
            const T reach = std::min(spread, T(1)), x = random.in(-reach, reach), y = random.in(-reach, reach);
            const T z = random.in(T(0.2), T(0.6)) * height;
            for (Vec3<T>& p : mesh.positions) p = p * size + Vec3<T>(x, y, z);
            scene.casters.push_back(std::move(mesh));
        }
    } else {
        for (int i = 0; i < count; ++i) scene.casters.push_back(detail::random_caster(random, spread, height));
        if (random.whole(0, 5) == 0) {  // all of them one mesh
            Mesh<T> all;
            for (const Mesh<T>& mesh : scene.casters) append(all, mesh);
            scene.casters = {std::move(all)};
        }
    }
    scene.casters_receive = !flat && !specks && random.whole(0, 1) == 0;
    const T ground_x = random.in(T(2), T(12)), ground_y = random.in(T(2), T(12));
    if (!scene.casters_receive || random.whole(0, 7) != 0)
        scene.receivers.push_back(level_quad<T>(Vec3<T>(T(0), T(0), T(0)), ground_x, ground_y));
    if (!flat && !specks && random.whole(0, 3) == 0) {
        const T x = random.in(T(-4), T(4)), y = random.in(T(-4), T(4)), z = random.in(T(0), height);
        scene.receivers.push_back(
            placed(level_quad<T>(Vec3<T>(T(0), T(0), T(0)), T(1), T(1)), random, T(1.5), Vec3<T>(x, y, z)));
    }
    return scene;
}

namespace detail {

/// Where a ray meets what receives.
template <class T>
class Seen {
  public:
    explicit Seen(const PlanScene<T>& scene) {
        for (const Mesh<T>& mesh : scene.receivers) add(mesh);
        if (scene.casters_receive)
            for (const Mesh<T>& mesh : scene.casters) add(mesh);
    }
    bool hit(const Vec3<T>& from, const Vec3<T>& way, Vec3<T>& at) const {
        T nearest = std::numeric_limits<T>::max();
        for (const Object& object : objects_) {
            const Vec3<T> across = glm::cross(object.center - from, way);
            if (glm::dot(across, across) > object.radius * object.radius * glm::dot(way, way) * T(1.01)) continue;
            for (const glm::uvec3& t : object.mesh->triangles) hit_triangle(*object.mesh, t, from, way, nearest, at);
        }
        return nearest < std::numeric_limits<T>::max();
    }
    Vec3<T> anywhere(Random& random) const {
        const Mesh<T>& mesh = *objects_[static_cast<std::size_t>(random.whole(0, last()))].mesh;
        const int triangle = random.whole(0, static_cast<int>(mesh.triangles.size()) - 1);
        T b = random.in(T(0), T(1)), c = random.in(T(0), T(1));
        if (b + c > T(1)) b = T(1) - b, c = T(1) - c;
        return on(mesh, mesh.triangles[static_cast<std::size_t>(triangle)], b, c);
    }

  private:
    struct Object {
        const Mesh<T>* mesh;
        Vec3<T> center;
        T radius;
    };
    int last() const { return static_cast<int>(objects_.size()) - 1; }
    void add(const Mesh<T>& mesh) {
        const Box3<T> box = bounds(mesh);
        objects_.push_back({&mesh, (box.min + box.max) * T(0.5), glm::length(box.max - box.min) * T(0.5)});
    }
    static Vec3<T> on(const Mesh<T>& mesh, const glm::uvec3& t, T b, T c) {
        const Vec3<T>& a = mesh.positions[t.x];
        const Vec3<T> p = a + (mesh.positions[t.y] - a) * b + (mesh.positions[t.z] - a) * c;
        const Box3<T> box = bounds(Mesh<T>{mesh.positions, {t}});
        return glm::min(glm::max(p, box.min), box.max);
    }
    static void hit_triangle(const Mesh<T>& mesh, const glm::uvec3& t, const Vec3<T>& from, const Vec3<T>& way,
                             T& nearest, Vec3<T>& at) {
        const Vec3<T>& a = mesh.positions[t.x];
        const Vec3<T> ab = mesh.positions[t.y] - a, ac = mesh.positions[t.z] - a, p = glm::cross(way, ac), s = from - a;
        const T d = glm::dot(ab, p);
        if (!(std::abs(d) > T(1e-9))) return;
        const T b = glm::dot(s, p) / d;
        const Vec3<T> q = glm::cross(s, ab);
        const T c = glm::dot(way, q) / d, distance = glm::dot(ac, q) / d;
        if (!(b >= T(0) && c >= T(0) && b + c <= T(1) && distance > T(0) && distance < nearest)) return;
        nearest = distance, at = on(mesh, t, b, c);
    }

    std::vector<Object> objects_;
};

}  // namespace detail

/// Where a camera sees receivers, 32 by 32 pixels in tiles of 8 by 8, then some in any order. Now and then points
/// without a place, and `behind` the light, which see all of it.
template <class T>
std::vector<Vec3<T>> seen_points(const PlanScene<T>& scene, std::uint32_t number, const Vec3<T>& behind) {
    Random random(number + 0x5bd1e995U);
    const detail::Seen<T> seen(scene);
    const T far = detail::size_in(random, T(2), T(20)), turn = random.in(T(0), T(6.28)), up = random.in(T(0.1), T(1.5));
    const auto middle = static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.casters.size()) - 1));
    const Box3<T> box = bounds(scene.casters[middle]);
    const T x = random.in(T(-1), T(1)), y = random.in(T(-1), T(1));
    const Vec3<T> target = Vec3<T>((box.min.x + box.max.x) * T(0.5) + x, (box.min.y + box.max.y) * T(0.5) + y, T(0));
    const Vec3<T> eye =
        target + Vec3<T>(std::cos(turn) * std::cos(up), std::sin(turn) * std::cos(up), std::sin(up)) * far;
    const Vec3<T> ahead = glm::normalize(target - eye), right = any_perpendicular(ahead),
                  over = glm::cross(right, ahead);
    const T zoom = detail::size_in(random, T(0.03), T(0.8));
    std::vector<Vec3<T>> points;
    Vec3<T> at = seen.anywhere(random);
    for (int i = 0; i < 1024; ++i) {
        const int tile = i / 64, px = tile % 4 * 8 + i % 8, py = tile / 4 * 8 + i / 8 % 8;
        const T u = zoom * (static_cast<T>(px) / T(15.5) - T(1)), v = zoom * (static_cast<T>(py) / T(15.5) - T(1));
        seen.hit(eye, ahead + right * u + over * v, at);
        points.push_back(at);
    }
    for (int i = 0; i < 77; ++i) points.push_back(seen.anywhere(random));
    if (number % 8 == 0) {
        points[static_cast<std::size_t>(random.whole(0, 1023))] = behind;
        points[static_cast<std::size_t>(random.whole(0, 1023))].y = std::numeric_limits<T>::quiet_NaN();
    }
    return points;
}

}  // namespace penumbra::test
