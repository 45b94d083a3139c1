// Twins of umbra_volume.
#pragma once

#include <penumbra/umbra_volume/disk_coverage.hpp>
#include <penumbra/umbra_volume/disk_visibility.hpp>
#include <penumbra/umbra_volume/extrusion.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

/// Two shares of a diameter, most within [0, 1], and an angle, most within [0, π].
inline void cuts(float* in) {
    for (int k = 0; k < 2; ++k) in[k] = 1.0625F * share(in[k]) - 0.03125F;
    in[2] = 3.25F * share(in[2]) - 0.03125F;
}
inline float whole_disk(const float*) { return 1.0F; }

/// A disk light of center, normal along an axis and radius, and an edge: eighths, which decide exactly on every driver
/// whether the edge's line meets the disk. Lines within a tenth of the rim are left out.
inline void disk_and_edge(float* in) {
    const auto eighths = [](float x, int most) { return std::copysign(whole(x, 0, 8 * most) / 8.0F, x); };
    const int axis = static_cast<int>(whole(in[3], 0, 2));
    const float sign = std::copysign(1.0F, in[4]);
    for (int k = 0; k < 3; ++k) in[k] = eighths(in[k], 4), in[3 + k] = k == axis ? sign : 0.0F;
    in[6] = whole(in[6], 0, 32) / 8.0F;
    for (int k = 7; k < 13; ++k) in[k] = in[(k - 7) % 3] + eighths(in[k], 4);
    const LightFrame<float> frame = light_frame(DiskLight<float>{v3(in), v3(in + 3), in[6]});
    const Vec3<float> a = frame.to_light(v3(in + 7)), along = frame.to_light(v3(in + 10)) - a;
    const float x = a.z * along.x - along.z * a.x, y = a.z * along.y - along.z * a.y;
    const float reach = std::sqrt(x * x + y * y), limit = in[6] * std::abs(along.z);
    for (const float share : {1.0F, 0.5F})  // the test halves the radius too
        if (std::abs(reach - share * limit) < 0.1F * limit) in[6] *= 1.5F;
}
inline float disk_size(const float* in) { return 1.0F + largest(in, 3) + in[6]; }

/// Two ends and a radius, now and then 0. Most ends within 2 radii of the centre along either axis, many on the rim;
/// one in four far away.
inline void edge_and_disk(float* in) {
    const float chosen = in[4];
    in[4] = chosen == 0.0F ? 0.0F : 0.0625F + 4.0F * share(chosen);
    for (int k = 0; k < 4; ++k) {
        const bool far = chosen < 0.0F && k / 2 == (chosen < -1.0F ? 1 : 0);
        in[k] = far ? moderate(in[k]) : 2.0F * in[4] * std::copysign(share(in[k]), in[k]);
    }
}
inline float disk_area(const float* in) { return pi<float> * in[4] * in[4]; }

inline void add_umbra_volume(std::vector<Function>& list) {
    list.push_back({
        "disk_visibility, _cubic, _sqrt", "umbra_volume/disk_visibility", 1, 3,
            GLSL(O(0) = penumbra_disk_visibility(I(0)); O(1) = penumbra_disk_visibility_cubic(I(0));
                 O(2) = penumbra_disk_visibility_sqrt(I(0));),
            [](const float* i, float* o) {
                o[0] = disk_visibility(i[0]), o[1] = disk_visibility_cubic(i[0]), o[2] = disk_visibility_sqrt(i[0]);
            },
            anything, 8, nullptr
    });
    list.push_back({
        "disk_visibility(t1, t2, angle), _between", "umbra_volume/disk_visibility", 3, 2,
            GLSL(O(0) = penumbra_disk_visibility(I(0), I(1), I(2));
                 O(1) = penumbra_disk_visibility_between(I(0), I(1), I(2));),
            [](const float* i, float* o) {
                o[0] = disk_visibility(i[0], i[1], i[2]), o[1] = disk_visibility_between(i[0], i[1], i[2]);
            },
            cuts, 8, whole_disk
    });
    list.push_back({
        "disk_edge_coverage", "umbra_volume/disk_coverage", 5, 1,
            GLSL(O(0) = penumbra_disk_edge_coverage(V2(0), V2(2), I(4));),
            [](const float* i, float* o) { o[0] = disk_edge_coverage(v2(i), v2(i + 2), i[4]); }, edge_and_disk, 8,
            disk_area
    });
    list.push_back({
        "extrusion_points", "umbra_volume/extrusion", 13, 14,
            GLSL(penumbra_DiskLight light; light.center = V3(0); light.normal = V3(3); light.radius = I(6);
                 penumbra_ExtrusionPoints p = penumbra_extrusion_points(V3(7), V3(10), light); PUT3(0, p.umbra);
                 PUT3(3, p.penumbra); O(6) = p.valid ? 1.0f : 0.0f;
                 p = penumbra_extrusion_points(V3(10), V3(7), penumbra_light_frame(light), 0.5f * light.radius);
                 PUT3(7, p.umbra); PUT3(10, p.penumbra); O(13) = p.valid ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                const DiskLight<float> light{v3(i), v3(i + 3), i[6]};
                ExtrusionPoints<float> p = extrusion_points(v3(i + 7), v3(i + 10), light);
                put(p.umbra, o), put(p.penumbra, o + 3), o[6] = p.valid ? 1.0F : 0.0F;
                p = extrusion_points(v3(i + 10), v3(i + 7), light_frame(light), 0.5F * light.radius);
                put(p.umbra, o + 7), put(p.penumbra, o + 10), o[13] = p.valid ? 1.0F : 0.0F;
            },
            disk_and_edge, 64, disk_size
    });
}

}  // namespace penumbra::test::functions
