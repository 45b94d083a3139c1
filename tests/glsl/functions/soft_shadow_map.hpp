// Twins of soft_shadow_map: one edge, one interval, one skin, and unions of intervals.
#pragma once

#include <initializer_list>
#include <penumbra/soft_shadow_map/discontinuity.hpp>
#include <penumbra/soft_shadow_map/light_interval.hpp>
#include <penumbra/soft_shadow_map/linear_visibility.hpp>
#include <penumbra/soft_shadow_map/skin.hpp>

#include "function.hpp"

namespace penumbra::test::functions {

inline RowPoint<float> row_point(const float* in) { return {in[0], in[1]}; }
inline Skin<float> skin(const float* in) { return {row_point(in), row_point(in + 2)}; }

inline bool in_eighths(const float* in, int count) {
    return std::all_of(in, in + count, [](float x) { return x * 8.0F == std::round(x * 8.0F); });
}
/// Slopes, inverse depths and positions, the inverse depths at the places in `inverse`: in eighths, which are exact up
/// to the last division and often equal, or any up to 4.
inline void light_plane(float* in, int count, std::initializer_list<int> inverse) {
    const bool any = in[0] < in[1];
    for (int k = 0; k < count; ++k) {
        in[k] = std::copysign(any ? 4.0F * share(in[k]) : whole(in[k], 0, 32) / 8.0F, in[k]);
        if (std::abs(in[k]) < 0x1p-20F) in[k] = 0.0F;
    }
    for (const int k : inverse) in[k] = std::abs(in[k]);
}
/// How many times its rounding a quotient is, whose parts are differences of numbers of that size.
inline float condition(float size, float divisor) {
    return size < 1e30F * std::abs(divisor) ? 1.0F + size / std::abs(divisor) : 1e30F;
}

/// An edge, a point, and two positions.
inline void edge_and_piece(float* in) { light_plane(in, 6, {1, 3}); }
inline float edge_condition(const float* in) {
    if (in_eighths(in, 6)) return 1.0F;
    const float size = std::max(std::abs(in[0]), std::abs(in[2])) + largest(in + 4, 2) * std::max(in[1], in[3]);
    return condition(size, (in[1] - in[3]) * (in[5] - in[4]));
}
/// A segment, a point, and the ends of a light: now and then of no length; now and then the point is an end, or between
/// both ends.
inline void segment_and_light(float* in) {
    const float chosen = in[7];
    light_plane(in, 8, {1, 3, 5});
    if (in[7] < in[6]) std::swap(in[6], in[7]);
    if (chosen < -1.0F && in_eighths(in, 8))
        for (const int k : {4, 5}) in[k] = chosen < -2.0F ? in[k - 2] : (in[k - 4] + in[k - 2]) * 0.5F;
}
inline float segment_condition(const float* in) {
    if (in_eighths(in, 4) && in_eighths(in + 6, 2)) return 1.0F;
    const float size = std::max(largest(in, 1), std::max(std::abs(in[2]), std::abs(in[4]))) +
                       largest(in + 6, 2) * std::max({in[1], in[3], in[5]});
    const float side_a = in[0] - in[4], side_b = in[2] - in[4], nearer_a = in[1] - in[5], nearer_b = in[3] - in[5];
    // a point as good as on the segment: it is up to rounding what it loses
    const float products = std::abs(side_a * nearer_b) + std::abs(side_b * nearer_a);
    const bool decided = std::abs(side_a * nearer_b - side_b * nearer_a) > 1e-5F * products;
    if ((nearer_a > 0.0F) != (nearer_b > 0.0F) && !decided) return 1e30F;
    const float least =
        nearer_a > 0.0F && nearer_b > 0.0F ? std::min(nearer_a, nearer_b) : std::max(nearer_a, nearer_b);
    return condition(size, least * (in[7] - in[6]));
}

/// Six intervals: any within [0, 1], in 64ths that touch, or a chain over all of the light, now and then without one.
/// A few are empty.
inline void intervals(float* in) {
    const int kind = static_cast<int>(whole(in[0], 0, 3)), missing = static_cast<int>(whole(in[1], 0, 11));
    for (int k = 0; k < 12; ++k) in[k] = kind < 2 ? share(in[k]) : whole(in[k], 0, 64) / 64.0F;
    if (kind % 2 == 1) {
        std::sort(in, in + 12);
        in[0] = 0.0F, in[11] = 1.0F;
        for (int k = 1; k < 11; k += 2) in[k] = in[k + 1];
        std::rotate(in, in + 2 * (missing % 6), in + 12);
        if (missing < 6) in[10] = in[11];
        return;
    }
    const bool some_are_empty = in[11] < in[10];
    for (int k = 0; k < 12; k += 2)
        if (in[k + 1] < in[k] && !(some_are_empty && k == 4)) std::swap(in[k], in[k + 1]);
}
/// What makes intervals of 2^-14ths: where the first begins and how far on the next, sizes, and how uneven gaps are.
inline void many_intervals(float* in) {
    in[0] = whole(in[0], 0, 250), in[1] = whole(in[1], 1, 250);
    in[2] = whole(in[2], 0, 96) / 16384.0F, in[3] = whole(in[3], 0, 4) / 16384.0F;
}

/// 3 x 3 depths, now and then of a plane or of a step.
inline void nine_depths(float* in) {
    const bool flat = in[0] < in[1];
    for (int k = 0; k < 9; ++k) in[k] = flat ? whole(in[k], 0, 2) * 0.5F : std::abs(moderate(in[k]));
}
inline float largest_depth(const float* in) { return largest(in, 9); }
/// Six depths, a threshold, and what is no surface: depths close to each other, or of any size, some of them `none` or
/// beyond. Not where it is up to rounding whether inverse depth changes by 5 / 4 of what it does beside.
inline void row_of_depths(float* in) {
    const bool close = in[0] < in[1];
    const float chosen = in[7];
    in[7] = chosen < 0.0F ? std::numeric_limits<float>::max() : (chosen < 1.0F ? 4.0F : 0x1p21F);
    for (int k = 0; k < 6; ++k) {
        const bool none = in[k] < -4.0F;
        in[k] = close ? whole(in[k], 8, 32) / 8.0F : std::max(std::abs(moderate(in[k])), 0x1p-20F);
        if (none) in[k] = in[k] < 2.0F ? in[7] : std::numeric_limits<float>::max();
    }
    in[6] = close ? whole(in[6], 0, 8) / 8.0F : std::abs(moderate(in[6]));
    const auto change = [in](int a, int b) { return 1.0F / in[b] - 1.0F / in[a]; };
    for (const int side : {0, 3})
        for (const int k : {0, 1}) {
            const float here = std::abs(change(0, 3)), beside = 1.25F * std::abs(change(side + k, side + k + 1));
            const float size = 1.0F / std::min({in[0], in[3], in[side + k], in[side + k + 1]});
            if (std::abs(here - beside) < 1e-5F * size) in[6] = 0x1p22F;
        }
}
/// Two Laplacians and a threshold, often the least that counts.
inline void two_laplacians(float* in) {
    const bool close = in[0] < in[1];
    for (int k = 0; k < 3; ++k) in[k] = close ? std::copysign(whole(in[k], 0, 16) / 8.0F, in[k]) : moderate(in[k]);
    in[2] = std::abs(in[2]);
}

/// A share, and inverse depths of an edge, a far end and a receiver.
inline void skin_and_receiver(float* in) {
    moderate_all<4>(in);
    for (const int k : {1, 2, 3}) in[k] = std::abs(in[k]);
}
/// A slope, inverse depths of an edge and of what lies behind it, and two positions.
inline void discontinuity_from_two(float* in) {
    moderate_all<5>(in);
    for (const int k : {1, 2}) in[k] = std::abs(in[k]);
    if (in[1] < in[2]) std::swap(in[1], in[2]);
}
inline float warped_slope(const float* in) { return std::abs(in[0]) + 2.0F * largest(in + 3, 2) * in[1]; }
/// A skin, now and then of no width, a slope and a share.
inline void skin_and_slope(float* in) {
    moderate_all<6>(in);
    if (in[1] < in[3]) in[2] = in[0];
    for (const int k : {1, 3}) in[k] = std::abs(in[k]);
    in[5] = share(in[5]);
}
inline float of_a_skin(const float* in) { return std::max({1.0F, in[1], in[3]}); }
/// A skin, two points of a receiver, and a position.
inline void skin_and_line(float* in) { light_plane(in, 9, {1, 3, 5, 7}); }
inline float line_condition(const float* in) {
    if (in_eighths(in, 9)) return in[1];
    const float run = in[6] - in[4], rise = in[7] - in[5];
    const float across = std::abs(run) + std::abs(in[8] * rise);
    const float along = std::abs(run * in[5]) + std::abs(rise) * (std::abs(in[0]) + std::abs(in[4]));
    return condition(along + in[1] * across, run - in[8] * rise);
}

// What texts begin and end with.
#define POINT(k) penumbra_row_point(I(k), I(k + 1))
#define SKIN(k)        \
    penumbra_Skin s;   \
    s.edge = POINT(k); \
    s.far = POINT(k + 2)

inline void add_soft_shadow_map(std::vector<Function>& list) {
    list.push_back({
        "slope_from", "soft_shadow_map/linear_visibility", 3, 1, GLSL(O(0) = penumbra_slope_from(POINT(0), I(2));),
            [](const float* i, float* o) { o[0] = slope_from(row_point(i), i[2]); }, moderate_all<3>, 2,
            [](const float* i) { return std::abs(i[0]) + std::abs(i[1] * i[2]); }
    });
    list.push_back({
        "edge_visibility", "soft_shadow_map/linear_visibility", 6, 1,
            GLSL(O(0) = penumbra_edge_visibility(POINT(0), POINT(2), I(4), I(5));),
            [](const float* i, float* o) { o[0] = edge_visibility(row_point(i), row_point(i + 2), i[4], i[5]); },
            edge_and_piece, 4, edge_condition
    });
    list.push_back({
        "skin_visibility", "soft_shadow_map/linear_visibility", 4, 2,
            GLSL(O(0) = penumbra_skin_visibility(I(0)); O(1) = penumbra_skin_visibility(I(0), I(1), I(2), I(3));),
            [](const float* i, float* o) {
                o[0] = skin_visibility(i[0]), o[1] = skin_visibility(i[0], i[1], i[2], i[3]);
            },
            skin_and_receiver, 4, nullptr
    });
    list.push_back({
        "hidden_interval", "soft_shadow_map/light_interval", 8, 2,
            GLSL(penumbra_LightInterval h = penumbra_hidden_interval(POINT(0), POINT(2), POINT(4), I(6), I(7));
                 O(0) = h.low; O(1) = h.high;),
            [](const float* i, float* o) {
                const LightInterval<float> h =
                    hidden_interval(row_point(i), row_point(i + 2), row_point(i + 4), i[6], i[7]);
                o[0] = h.low, o[1] = h.high;
            },
            segment_and_light, 4, segment_condition
    });
    list.push_back({
        "LightUnion", "soft_shadow_map/light_interval", 12, 12,
            GLSL(penumbra_LightUnion all = penumbra_no_light_union(); for (int k = 0; k < 6; ++k) {
                all = penumbra_add(all, penumbra_light_interval(I(2 * k), I(2 * k + 1)));
                O(2 * k) = penumbra_share(all);
                O(2 * k + 1) = penumbra_is_full(all) ? 1.0f : 0.0f;
            }),
            [](const float* i, float* o) {
                LightUnion<float> all;
                for (int k = 0; k < 12; k += 2) {
                    all.add({i[k], i[k + 1]});
                    o[k] = all.share(), o[k + 1] = all.is_full() ? 1.0F : 0.0F;
                }
            },
            intervals, 0, nullptr
    });
    list.push_back({
        "LightUnion of too many", "soft_shadow_map/light_interval", 4, 9,
            GLSL(penumbra_LightUnion all = penumbra_no_light_union(); for (int k = 0; k < 32; ++k) {
                int at = (int(I(0)) + k * int(I(1))) % 251;
                float low = float(at) * 0.00390625f + float(at * at % 7) * I(3);
                all = penumbra_add(all, penumbra_light_interval(low, low + I(2)));
                if (k % 4 == 3) O(k / 4) = penumbra_share(all);
            } O(8) = penumbra_is_full(all) ? 1.0f : 0.0f;),
            [](const float* i, float* o) {
                LightUnion<float> all;
                for (int k = 0; k < 32; ++k) {
                    const int at = (static_cast<int>(i[0]) + k * static_cast<int>(i[1])) % 251;
                    const float low = static_cast<float>(at) / 256.0F + static_cast<float>(at * at % 7) * i[3];
                    all.add({low, low + i[2]});
                    if (k % 4 == 3) o[k / 4] = all.share();
                }
                o[8] = all.is_full() ? 1.0F : 0.0F;
            },
            many_intervals, 0, nullptr
    });
    list.push_back({
        "LightMask", "soft_shadow_map/light_interval", 12, 12,
            GLSL(penumbra_LightMask all = penumbra_no_light_mask(); for (int k = 0; k < 6; ++k) {
                all = penumbra_add(all, penumbra_light_interval(I(2 * k), I(2 * k + 1)));
                O(2 * k) = penumbra_share(all);
                O(2 * k + 1) = penumbra_is_full(all) ? 1.0f : 0.0f;
            }),
            [](const float* i, float* o) {
                LightMask<float> all;
                for (int k = 0; k < 12; k += 2) {
                    all.add({i[k], i[k + 1]});
                    o[k] = all.share(), o[k + 1] = all.is_full() ? 1.0F : 0.0F;
                }
            },
            intervals, 0, nullptr
    });
    list.push_back({
        "laplacian_of_gaussian", "soft_shadow_map/discontinuity", 9, 1,
            GLSL(O(0) = penumbra_laplacian_of_gaussian(mat3(V3(0), V3(3), V3(6)));),
            [](const float* i, float* o) { o[0] = laplacian_of_gaussian(glm::mat3(v3(i), v3(i + 3), v3(i + 6))); },
            nine_depths, 6, largest_depth
    });
    list.push_back({
        "is_laplacian_step", "soft_shadow_map/discontinuity", 3, 1,
            GLSL(O(0) = penumbra_is_laplacian_step(I(0), I(1), I(2)) ? 1.0f : 0.0f;),
            [](const float* i, float* o) { o[0] = is_laplacian_step(i[0], i[1], i[2]) ? 1.0F : 0.0F; }, two_laplacians,
            0, nullptr
    });
    list.push_back({
        "is_step", "soft_shadow_map/discontinuity", 8, 1,
            GLSL(O(0) = penumbra_is_step(V3(0), V3(3), I(6), I(7)) ? 1.0f : 0.0f;),
            [](const float* i, float* o) { o[0] = is_step(v3(i), v3(i + 3), i[6], i[7]) ? 1.0F : 0.0F; }, row_of_depths,
            0, nullptr
    });
    list.push_back({
        "warp_skin", "soft_shadow_map/skin", 5, 4,
            GLSL(penumbra_Skin s = penumbra_warp_skin(I(0), I(1), I(2), I(3), I(4)); O(0) = s.edge.slope;
                 O(1) = s.edge.inverse_depth; O(2) = s.far.slope; O(3) = s.far.inverse_depth;),
            [](const float* i, float* o) {
                const Skin<float> s = warp_skin(i[0], i[1], i[2], i[3], i[4]);
                o[0] = s.edge.slope, o[1] = s.edge.inverse_depth, o[2] = s.far.slope, o[3] = s.far.inverse_depth;
            },
            discontinuity_from_two, 2, warped_slope
    });
    list.push_back({
        "skin_share, skin_inverse_depth", "soft_shadow_map/skin", 6, 2,
            GLSL(SKIN(0); O(0) = penumbra_skin_share(s, I(4)); O(1) = penumbra_skin_inverse_depth(s, I(5));),
            [](const float* i, float* o) {
                o[0] = skin_share(skin(i), i[4]), o[1] = skin_inverse_depth(skin(i), i[5]);
            },
            skin_and_slope, 4, of_a_skin
    });
    list.push_back({
        "receiver_under_edge", "soft_shadow_map/skin", 9, 1,
            GLSL(SKIN(0); O(0) = penumbra_receiver_under_edge(s, POINT(4), POINT(6), I(8));),
            [](const float* i, float* o) {
                o[0] = receiver_under_edge(skin(i), row_point(i + 4), row_point(i + 6), i[8]);
            },
            skin_and_line, 4, line_condition
    });
}

#undef POINT
#undef SKIN

}  // namespace penumbra::test::functions
