#include <doctest/doctest.h>

#include <cmath>
#include <penumbra/occlusion_texture/slices.hpp>
#include <vector>

#include "../support/box_mesh.hpp"
#include "../support/random.hpp"

using namespace penumbra;

namespace {

/// Light frame of a light at height 8 above the origin that emits down.
template <class T>
LightFrame<T> frame_above() {
    return light_frame(RectLight<T>{Vec3<T>(T(0), T(8), T(0)), Vec3<T>(T(1), T(0), T(0)), Vec3<T>(T(0), T(0), T(1))});
}

template <class T>
Mesh<T> random_triangles(std::uint32_t seed, int count) {
    test::Random random(seed);
    Mesh<T> mesh;
    for (int i = 0; i < count; ++i) {
        const Vec3<T> at = random.point(T(-2), T(2)) + Vec3<T>(T(0), T(3), T(0));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + random.point(T(-0.7), T(0.7)));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

template <class T>
Mesh<T> cube(const Vec3<T>& center, T half) {
    return test::box_mesh(center, Vec3<T>(half, half, half));
}

template <class T>
Slices<T> capture(const std::vector<Mesh<T>>& casters, int count, bool close_leaks, SliceFaces faces = SliceFaces::all,
                  int resolution = 64) {
    const auto triangles = lit_triangles(casters, frame_above<T>(), faces);
    const auto camera =
        fit_slice_camera(triangles.vertices_ls, Vec2<T>(T(1), T(1)), SliceProjection::perspective, resolution, 2);
    return capture_slices(triangles, camera, slice_range(triangles, count), close_leaks);
}

/// Signed distance in texels of a position from the triangle's nearest edge, positive inside; the depth there by
/// intersecting the camera's ray with the triangle's plane. All in double, from the definition.
struct Probe {
    double inside, depth;
};
Probe probe(const SliceCamera<double>& camera, const Vec3<double>* v, double x, double y) {
    Vec2<double> at[3];
    for (int k = 0; k < 3; ++k) {
        const double w = 1.0 + camera.convergence * v[k].z;
        at[k] = Vec2<double>(v[k].x, v[k].y) / w * camera.scale_tx + camera.origin_tx;
    }
    const double twice_area = (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[2].x - at[0].x) * (at[1].y - at[0].y);
    double inside = 1e30;
    for (int k = 0; k < 3; ++k) {
        const Vec2<double> a = at[k], e = at[(k + 1) % 3] - a;
        const double distance = (e.x * (y - a.y) - e.y * (x - a.x)) / glm::length(e);
        inside = std::min(inside, twice_area > 0 ? distance : -distance);
    }
    // the ray: (X, Y) = q (1 + c z) with q the position at depth 0
    const Vec2<double> q = (Vec2<double>(x, y) - camera.origin_tx) / camera.scale_tx;
    const Vec3<double> origin(q.x, q.y, 0.0), direction(q.x * camera.convergence, q.y * camera.convergence, 1.0);
    const Vec3<double> normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    return {inside, glm::dot(normal, v[0] - origin) / glm::dot(normal, direction)};
}

}  // namespace

TEST_CASE_TEMPLATE("every depth has one slice, boundaries belong to the slice behind", T, float, double) {
    const SliceRange<T> range{T(2), T(0.5), 8};
    CHECK(range.slice_of(T(-1)) == 0);
    CHECK(range.slice_of(T(2)) == 0);
    CHECK(range.slice_of(T(6)) == 7);
    CHECK(range.slice_of(T(1e30)) == 7);
    for (int k = 1; k < 8; ++k) CHECK(range.slice_of(range.top(k)) == k);
    test::Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const T depth = random.in(T(2), T(6));
        const int slice = range.slice_of(depth);
        CAPTURE(depth);
        CHECK(depth >= range.top(slice));
        CHECK(depth <= range.bottom(slice));
    }
    CHECK(SliceRange<T>{T(2), T(0), 4}.slice_of(T(2)) == 0);  // no thickness
    CHECK(SliceRange<T>{T(2), T(0), 4}.slice_of(T(3)) == 3);
}

TEST_CASE_TEMPLATE("slice_range covers the casters and keeps flat casters in one slice", T, float, double) {
    const auto triangles = lit_triangles<T>({random_triangles<T>(2, 100)}, frame_above<T>(), SliceFaces::all);
    for (const int count : {1, 3, 16, 64}) {
        const SliceRange<T> range = slice_range(triangles, count);
        T nearest = T(1e9), farthest = T(0);
        for (const Vec3<T>& v : triangles.vertices_ls)
            nearest = std::min(nearest, v.z), farthest = std::max(farthest, v.z);
        CHECK(range.count == count);
        CHECK(range.top(0) <= nearest);
        CHECK(range.bottom(count - 1) >= farthest - T(1e-5));
        CHECK(static_cast<double>(range.thickness * static_cast<T>(count)) ==
              doctest::Approx(static_cast<double>(farthest - nearest)).epsilon(1e-3));
    }
    Mesh<T> flat;
    flat.positions = {{T(-1), T(3), T(-1)}, {T(1), T(3.000001), T(-1)}, {T(0), T(2.999999), T(1)}};
    flat.triangles = {{0, 1, 2}};
    const auto slices = capture<T>({flat}, 16, false);
    int used = 0;
    for (const auto& mask : slices.masks) used += !mask.empty();
    CHECK(used == 1);
}

TEST_CASE_TEMPLATE("the plane stays before the point and is continuous", T, float, double) {
    for (const SlicePlane plane : {SlicePlane::bottom, SlicePlane::middle}) {
        T last = T(0);
        for (int i = 0; i <= 4000; ++i) {
            const T depth = T(2) + static_cast<T>(i) * T(0.001), at = slice_plane_depth(T(2), T(1), depth, plane);
            CHECK(at <= std::max(depth, T(2)));
            CHECK(at <= T(2) + T(1));
            if (i > 0) {
                CHECK(at >= last);
                CHECK(at - last <= T(0.000501));  // half the step
            }
            last = at;
        }
        CHECK(last == (plane == SlicePlane::bottom ? T(3) : T(2.5)));
    }
}

TEST_CASE_TEMPLATE("slice_weight is 0 before the slice, 1 behind it, monotone and continuous between", T, float,
                   double) {
    for (const SelfShadow mode : {SelfShadow::fade, SelfShadow::clear, SelfShadow::mean_depth})
        for (const T bias : {T(0.001), T(0.25), T(1)})
            for (const T mean : {T(0), T(0.3), T(1)}) {
                T last = slice_weight(T(0), mean, bias, mode);
                CHECK(last == T(0));
                const T step = T(0.0005), steepest = mode == SelfShadow::mean_depth ? T(1) / bias : T(1);
                for (T relative = T(0); relative <= T(4); relative += step) {
                    const T weight = slice_weight(relative, mean, bias, mode);
                    CHECK(weight >= last);
                    CHECK(weight - last <= steepest * step * T(1.01) + T(1e-5) * steepest);
                    last = weight;
                }
                CHECK(last == T(1));
                CHECK(slice_weight(T(3), mean, bias, mode) == T(1));
            }
    // the paper's fade, by hand
    CHECK(slice_weight(T(0.5), T(0), T(1), SelfShadow::fade) == T(0.5));
    CHECK(slice_weight(T(1), T(0), T(1), SelfShadow::fade) == T(1));
    // a surface at depth 0.5 does not shadow itself, and shadows in full 2 × 0.25 behind itself
    CHECK(slice_weight(T(0.5), T(0.5), T(0.25), SelfShadow::mean_depth) == T(0));
    CHECK(slice_weight(T(1), T(0.5), T(0.25), SelfShadow::mean_depth) == T(1));
}

TEST_CASE_TEMPLATE("relative_depth counts in slices and passes empty ones at once", T, float, double) {
    CHECK(relative_depth(T(2), T(0.5), T(2.25)) == T(0.5));
    CHECK(relative_depth(T(2), T(0.5), T(1)) == T(0));
    CHECK(relative_depth(T(2), T(0.5), T(1e20)) == T(4));
    CHECK(relative_depth(T(2), T(0), T(2)) == T(0));
    CHECK(relative_depth(T(2), T(0), T(2.5)) == T(4));
}

TEST_CASE("captured masks and depths are what rays of the slice camera meet") {
    const std::vector<Mesh<double>> casters{random_triangles<double>(3, 40)};
    const auto triangles = lit_triangles(casters, frame_above<double>(), SliceFaces::all);
    for (const bool close_leaks : {false, true}) {
        const auto slices = capture(casters, 6, close_leaks);
        int checked = 0, blocked = 0;
        for (int y = 0; y < slices.camera.height; ++y) {
            for (int x = 0; x < slices.camera.width; ++x) {
                std::vector<double> nearest(6, 2.0);  // relative depth; 2 = nothing
                bool doubtful = false;
                for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
                    const Probe p = probe(slices.camera, &triangles.vertices_ls[3 * t], x + 0.5, y + 0.5);
                    if (std::abs(p.inside) < 0.02) doubtful = true;  // within the rasterizer's grid of an edge
                    if (p.inside <= 0.0) continue;
                    const int slice = slices.range.slice_of(p.depth);
                    const double relative = (p.depth - slices.range.top(slice)) / slices.range.thickness;
                    // within the grid's effect on the depth of a boundary (steep triangles)
                    if (relative < 0.05 || relative > 0.95) doubtful = true;
                    auto& here = nearest[static_cast<std::size_t>(slice)];
                    here = std::min(here, relative);
                    if (close_leaks && slice + 1 < 6)
                        nearest[static_cast<std::size_t>(slice) + 1] =
                            std::min(nearest[static_cast<std::size_t>(slice) + 1], 0.0);
                }
                if (doubtful) continue;
                for (std::size_t k = 0; k < 6; ++k) {
                    const auto& mask = slices.masks[k];
                    const bool hit = !mask.empty() && mask(x, y) == 255;
                    CAPTURE(x);
                    CAPTURE(y);
                    CAPTURE(k);
                    CHECK(hit == (nearest[k] < 1.5));
                    ++checked;
                    if (!hit) continue;
                    ++blocked;
                    // half a code, and steep triangles move by the vertex grid
                    CHECK(std::abs(slices.depths[k](x, y) / 255.0 - nearest[k]) <= 0.06);
                }
            }
        }
        CHECK(checked > 5000);
        CHECK(blocked > 500);
    }
}

TEST_CASE_TEMPLATE("closing adds to each slice what the one before it holds", T, float, double) {
    const std::vector<Mesh<T>> casters{random_triangles<T>(4, 200)};
    const auto open = capture(casters, 8, false), closed = capture(casters, 8, true);
    for (std::size_t k = 0; k < 8; ++k) {
        REQUIRE(!open.masks[k].empty());
        int differences = 0;
        for (std::size_t i = 0; i < open.masks[k].size(); ++i) {
            const bool here = open.masks[k].data()[i] != 0, before = k > 0 && open.masks[k - 1].data()[i] != 0;
            differences += (closed.masks[k].data()[i] != 0) != (here || before);
        }
        CHECK(differences == 0);
    }
}

TEST_CASE_TEMPLATE("facing faces of a closed mesh leave no hole in its shadow", T, float, double) {
    const std::vector<Mesh<T>> casters{cube(Vec3<T>(T(0.3), T(3), T(-0.2)), T(1))};
    const auto all = capture(casters, 8, false, SliceFaces::all),
               facing = capture(casters, 8, false, SliceFaces::facing);
    int union_differs = 0, fewer = 0;
    for (std::size_t i = 0; i < all.masks[0].size(); ++i) {
        bool in_all = false, in_facing = false;
        for (std::size_t k = 0; k < 8; ++k) {
            const bool a = !all.masks[k].empty() && all.masks[k].data()[i],
                       f = !facing.masks[k].empty() && facing.masks[k].data()[i];
            in_all |= a, in_facing |= f, fewer += a && !f;
        }
        union_differs += in_all != in_facing;
    }
    CHECK(union_differs == 0);
    CHECK(fewer > 100);  // the bottom is gone
}

TEST_CASE_TEMPLATE("solid and facing apply to closed meshes on the lit side only", T, float, double) {
    for (const SliceFaces wanted : {SliceFaces::solid, SliceFaces::facing}) {
        const auto faces_of = [&](const Mesh<T>& mesh) {
            return lit_triangles<T>({mesh}, frame_above<T>(), wanted).faces;
        };
        const Mesh<T> closed = cube(Vec3<T>(T(0), T(3), T(0)), T(1));
        CHECK(faces_of(closed) == std::vector<SliceFaces>(12, wanted));
        Mesh<T> open = closed;
        open.triangles.pop_back();
        CHECK(faces_of(open) == std::vector<SliceFaces>(11, SliceFaces::all));
        const auto crossing = faces_of(cube(Vec3<T>(T(0), T(8), T(0)), T(1)));  // around the light
        CHECK(!crossing.empty());
        CHECK(crossing == std::vector<SliceFaces>(crossing.size(), SliceFaces::all));
        CHECK(faces_of(cube(Vec3<T>(T(0), T(12), T(0)), T(1))).empty());  // behind the light
    }
}

TEST_CASE("solids are filled: each slice holds what a ray of the slice camera meets of the solid") {
    // two cubes that overlap, and one wound inside out, against slabs of boxes along each ray, in double
    const Vec3<double> centers[] = {{0.3, 3.0, -0.2}, {0.9, 2.4, 0.4}, {-1.1, 3.3, 0.8}};
    const double halves[] = {1.0, 0.7, 0.5};
    std::vector<Mesh<double>> casters;
    for (int k = 0; k < 3; ++k) casters.push_back(cube(centers[k], halves[k]));
    for (glm::uvec3& t : casters[2].triangles) std::swap(t.y, t.z);
    const LightFrame<double> frame = frame_above<double>();
    const auto slices = capture(casters, 7, true, SliceFaces::solid);
    int checked = 0, filled = 0;
    for (int y = 0; y < slices.camera.height; ++y) {
        for (int x = 0; x < slices.camera.width; ++x) {
            const Vec2<double> q = (Vec2<double>(x + 0.5, y + 0.5) - slices.camera.origin_tx) / slices.camera.scale_tx;
            const Vec3<double> origin(q, 0.0), direction(q * slices.camera.convergence, 1.0);
            for (int k = 0; k < slices.range.count; ++k) {
                bool inside = false, doubtful = false;
                for (int c = 0; c < 3; ++c) {
                    const Vec3<double> middle = frame.to_light(centers[c]);
                    double enter = -1e9, leave = 1e9;
                    for (int axis = 0; axis < 3; ++axis) {
                        const double a = (middle[axis] - halves[c] - origin[axis]) / direction[axis];
                        const double b = (middle[axis] + halves[c] - origin[axis]) / direction[axis];
                        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
                    }
                    // rays that graze an edge, and ends within the rasterizer's grid of a boundary (steep sides)
                    const double slack = 0.03;
                    if (std::abs(leave - enter) < 4 * slack) doubtful = true;
                    for (const double end : {enter, leave})
                        if (std::abs(end - slices.range.top(k)) < slack ||
                            std::abs(end - slices.range.bottom(k)) < slack)
                            doubtful = true;
                    inside |= enter < leave && enter < slices.range.bottom(k) && leave > slices.range.top(k);
                }
                if (doubtful) continue;
                const auto& mask = slices.masks[static_cast<std::size_t>(k)];
                CAPTURE(x);
                CAPTURE(y);
                CAPTURE(k);
                CHECK((!mask.empty() && mask(x, y) == 255) == inside);
                ++checked;
                filled += inside;
            }
        }
    }
    CHECK(checked > 10000);
    CHECK(filled > 3000);
}

TEST_CASE("lit_triangles cuts at the light's plane: areas add up") {
    // a vertical triangle from depth −1 to 2, two thirds as tall on the lit side
    Mesh<double> mesh;
    mesh.positions = {{0, 9, 0}, {-1, 6, 0}, {1, 6, 0}};
    mesh.triangles = {{0, 1, 2}};
    const auto triangles = lit_triangles<double>({mesh}, frame_above<double>(), SliceFaces::all);
    double area = 0.0;
    for (std::size_t i = 0; i < triangles.vertices_ls.size(); i += 3) {
        const Vec3<double>* v = &triangles.vertices_ls[i];
        area += 0.5 * glm::length(glm::cross(v[1] - v[0], v[2] - v[0]));
        for (int k = 0; k < 3; ++k) CHECK(v[k].z >= 0.0);
    }
    CHECK(area == doctest::Approx(3.0 - 3.0 / 9.0));  // the whole less the tip, a third as tall
}

TEST_CASE("pack_rgba puts slice 4k + c in channel c of image k") {
    std::vector<Image<std::uint8_t>> slices(6);
    for (std::size_t s = 0; s < 6; ++s) {
        if (s == 2) continue;  // an empty slice
        slices[s] = Image<std::uint8_t>(5, 3);
        for (std::size_t i = 0; i < 15; ++i) slices[s].data()[i] = static_cast<std::uint8_t>(40 * s + i);
    }
    const auto packed = pack_rgba(slices, 5, 3);
    REQUIRE(packed.size() == 2);
    for (std::size_t s = 0; s < 8; ++s)
        for (std::size_t i = 0; i < 15; ++i) {
            const int expected = s < 6 && s != 2 ? static_cast<int>(40 * s + i) : 0;
            CHECK(static_cast<int>(packed[s / 4].data()[i][static_cast<int>(s % 4)]) == expected);
        }
}
