// Twins of umbra_volume: what D-buffers and their edges are made of.
#pragma once

#include <penumbra/umbra_volume/cut_share.hpp>
#include <penumbra/umbra_volume/d_buffer.hpp>
#include <penumbra/umbra_volume/silhouette.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline float eighths(float x, int most) { return std::copysign(whole(x, 0, 8 * most) / 8.0F, x); }
/// ± one of the axes, or nothing.
inline void axis_or_nothing(float* in) {
    const int axis = static_cast<int>(whole(in[0], 0, 3));
    const float sign = std::copysign(1.0F, in[1]);
    for (int k = 0; k < 3; ++k) in[k] = k == axis ? sign : 0.0F;
}
inline DiskLight<float> disk_light(const float* in) { return {v3(in), v3(in + 3), in[6]}; }

/// A normal and a disk light. The light's is an axis, so that what is across it keeps its digits, or at a clear angle.
inline void normal_and_disk(float* in) {
    moderate_all<10>(in);
    in[9] = std::abs(in[9]);
    if (in[6] < in[7]) {
        axis_or_nothing(in + 6);
    } else {
        const Vec3<float> zero(0, 0, 0), axis = normalize_or(v3(in + 6), zero), n = normalize_or(v3(in), zero);
        if (glm::length(glm::cross(axis, n)) < 0.1F) put(normalize_or(any_perpendicular(axis), zero), in);
    }
}
inline float center_and_radius(const float* in) { return 1.0F + largest(in + 3, 3) + in[9]; }
/// A unit normal or none, a vertex and a disk light.
inline void face_and_disk(float* in) {
    moderate_all<13>(in);
    put(normalize_or(v3(in), Vec3<float>(0, 0, 0)), in);
    in[12] = std::abs(in[12]);
}
inline float reach_of_disk(const float* in) { return 1.0F + largest(in + 3, 6) + in[12]; }
/// The same and a tolerance, in eighths along axes: distances are exact and often the tolerance. Or with an oblique
/// normal, and no distance near the tolerance.
inline void face_and_disk_in_eighths(float* in) {
    const bool oblique = std::abs(in[13]) > 2.0F;
    axis_or_nothing(in), axis_or_nothing(in + 9);
    if (oblique) in[0] *= 0.6F, in[1] = 0.8F * in[1], in[2] = in[2] * 0.6F, in[1] = in[0] != 0.0F ? 0.8F : in[1];
    for (int k = 3; k < 9; ++k) in[k] = eighths(in[k], 4);
    in[12] = whole(in[12], 0, 32) / 8.0F, in[13] = whole(in[13], 0, 8) / 8.0F;
    if (!oblique) return;
    const DiskDistances<float> d = disk_distances(v3(in), v3(in + 3), disk_light(in + 6));
    while (std::min(std::abs(d.least - in[13]), std::abs(d.largest - in[13])) < 1e-3F) in[13] += 1.0F / 64.0F;
}

/// An edge, a point and a radius: in eighths, which are exact up to the last division, or any within 4.
inline void edge_point_and_radius(float* in) {
    const bool any = in[8] < in[9];
    for (int k = 0; k < 9; ++k) in[k] = any ? std::copysign(4.0F * share(in[k]), in[k]) : eighths(in[k], 4);
    for (int k = 0; k < 9; ++k) in[k] = std::abs(in[k]) < 0x1p-20F ? 0.0F : in[k];
    in[9] = any ? 0x1p-10F + 4.0F * share(in[9]) : whole(in[9], 0, 32) / 8.0F;
}
/// How many times its rounding a product of three is, in units of the radius.
inline float edge_cut_condition(const float* in) {
    const Vec3<float> from = v3(in) - v3(in + 6), along = v3(in + 3) - v3(in), normal = glm::cross(from, along);
    const float size = largest(&from.x, 3) * largest(&along.x, 3) * std::max(largest(in + 6, 3), 1.0F);
    const float reach = in[9] * safe_length(Vec3<float>(normal.x, normal.y, 0.0F));
    if (reach == 0.0F) return 1.0F;  // whatever the size, only a sign matters, and it is exact
    return size < 1e30F * reach ? 1.0F + size / reach : 1e30F;
}
/// Depths of an edge, of a volume behind it, and of any point.
inline void three_depths(float* in) {
    for (int k = 0; k < 3; ++k) in[k] = moderate(in[k]);
    for (const int k : {0, 1}) in[k] = std::max(std::abs(in[k]), 0x1p-20F);
    if (in[1] < in[0]) std::swap(in[0], in[1]);
}
inline float one_share(const float*) { return 1.0F; }

/// Two edges and a point in eighths, and whether the edges are of one mesh: not where it is up to rounding on which
/// side of one the other lies.
inline void two_edges_and_point(float* in) {
    for (int k = 0; k < 15; ++k) in[k] = eighths(in[k], 4);
    in[15] = whole(in[15], 0, 1);
    const Vec3<float> point = v3(in + 12);
    for (const int k : {0, 6}) {
        const float *self = in + k, *other = in + (6 - k);
        const Vec3<float> normal = glm::cross(v3(self) - point, v3(self + 3) - v3(self));
        const float side = glm::dot(normal, (v3(other) + v3(other + 3)) * 0.5F - point);  // exact
        if (side == 0.0F && normal != Vec3<float>(0, 0, 0)) in[15] = 0.0F;
    }
}
inline HidingEdge<float> hiding_edge(const float* in, std::uint32_t mesh) { return {v3(in), v3(in + 3), mesh}; }

/// Borders, a resolution and a point.
inline void view_and_point(float* in) {
    for (int k = 0; k < 4; ++k) in[k] = std::copysign(16.0F * share(in[k]), in[k]);
    for (const int k : {0, 1}) {
        if (in[k + 2] < in[k]) std::swap(in[k], in[k + 2]);
        in[k + 2] = std::max(in[k + 2], in[k] + 0x1p-10F);
    }
    in[4] = whole(in[4], 1, 4096);
    for (int k = 5; k < 8; ++k) in[k] = moderate(in[k]);
    in[7] = std::max(std::abs(in[7]), 0x1p-20F);
}
inline DBufferView<float> view_of(const float* in) { return {rect(in), static_cast<int>(in[4])}; }
inline float texel_of_point(const float* in) {
    const float slope = std::max(std::abs(in[5]), std::abs(in[6])) / in[7] + largest(in, 4);
    return slope * in[4] / std::min(in[2] - in[0], in[3] - in[1]);
}

// What texts begin and end with.
#define DISK(k)               \
    penumbra_DiskLight light; \
    light.center = V3(k);     \
    light.normal = V3(k + 3); \
    light.radius = I(k + 6)
#define HIDING_EDGE(name, k, m) \
    penumbra_HidingEdge name;   \
    name.a = V3(k);             \
    name.b = V3(k + 3);         \
    name.mesh = int(m);         \
    name.chained = -1;          \
    name.corner = -1;           \
    name.before = -1;           \
    name.after = -1

inline void add_umbra_volume_d_buffer(std::vector<Function>& list) {
    list.push_back({
        "near_far_points", "umbra_volume/silhouette", 10, 6,
            GLSL(DISK(3); penumbra_NearFarPoints p = penumbra_near_far_points(V3(0), light); PUT3(0, p.near);
                 PUT3(3, p.far);),
            [](const float* i, float* o) {
                const NearFarPoints<float> p = near_far_points(v3(i), disk_light(i + 3));
                put(p.near, o), put(p.far, o + 3);
            },
            normal_and_disk, 8, center_and_radius
    });
    list.push_back({
        "disk_distances", "umbra_volume/silhouette", 13, 2,
            GLSL(DISK(6); penumbra_DiskDistances d = penumbra_disk_distances(V3(0), V3(3), light); O(0) = d.least;
                 O(1) = d.largest;),
            [](const float* i, float* o) {
                const DiskDistances<float> d = disk_distances(v3(i), v3(i + 3), disk_light(i + 6));
                o[0] = d.least, o[1] = d.largest;
            },
            face_and_disk, 8, reach_of_disk
    });
    list.push_back({
        "disk_sight", "umbra_volume/silhouette", 14, 1,
            GLSL(DISK(6); int sight = penumbra_disk_sight(V3(0), V3(3), light, I(13)); O(0) = float(sight);),
            [](const float* i, float* o) {
                o[0] = static_cast<float>(disk_sight(v3(i), v3(i + 3), disk_light(i + 6), i[13]));
            },
            face_and_disk_in_eighths, 0, nullptr
    });
    list.push_back({
        "edge_cut_share", "umbra_volume/cut_share", 10, 1,
            GLSL(O(0) = penumbra_edge_cut_share(V3(0), V3(3), V3(6), I(9));),
            [](const float* i, float* o) { o[0] = edge_cut_share(v3(i), v3(i + 3), v3(i + 6), i[9]); },
            edge_point_and_radius, 4, edge_cut_condition
    });
    list.push_back({
        "penumbra_cut_share, umbra_cut_share", "umbra_volume/cut_share", 3, 2,
            GLSL(O(0) = penumbra_penumbra_cut_share(I(0), I(1), I(2));
                 O(1) = penumbra_umbra_cut_share(I(0), I(1), I(2));),
            [](const float* i, float* o) {
                o[0] = penumbra_cut_share(i[0], i[1], i[2]), o[1] = umbra_cut_share(i[0], i[1], i[2]);
            },
            three_depths, 8, one_share
    });
    list.push_back({
        "two_cuts", "umbra_volume/d_buffer", 16, 2,
            GLSL(HIDING_EDGE(first, 0, 1.0f); HIDING_EDGE(second, 6, I(15));
                 penumbra_TwoCuts c = penumbra_two_cuts(first, second, V3(12)); O(0) = c.angle;
                 O(1) = c.convex ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                const TwoCuts<float> c =
                    two_cuts(hiding_edge(i, 1), hiding_edge(i + 6, static_cast<std::uint32_t>(i[15])), v3(i + 12));
                o[0] = c.angle, o[1] = c.convex ? 1.0F : 0.0F;
            },
            two_edges_and_point, 8, one_share
    });
    list.push_back({
        "DBufferView: to_texel, depth_of", "umbra_volume/d_buffer_view", 8, 3,
            GLSL(penumbra_DBufferView view; view.slopes = RECT(0); view.resolution = int(I(4));
                 vec2 at = penumbra_to_texel(view, V3(5)); PUT2(0, at); O(2) = penumbra_depth_of(V3(5));),
            [](const float* i, float* o) {
                put(view_of(i).to_texel(v3(i + 5)), o), o[2] = view_of(i).depth_of(v3(i + 5));
            },
            view_and_point, 8, texel_of_point
    });
    list.push_back({
        "cut_visibility", "umbra_volume/d_buffer", 2, 1, GLSL(O(0) = penumbra_cut_visibility(I(0), int(I(1)));),
            [](const float* i, float* o) {
                o[0] = cut_visibility(i[0], static_cast<CutVisibility>(static_cast<int>(i[1])));
            },
            [](float* i) { i[1] = whole(i[1], 0, 2); }, 8, nullptr
    });
}

}  // namespace penumbra::test::functions

#undef DISK
#undef HIDING_EDGE
