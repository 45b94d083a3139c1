// What boxes around casters and receivers say about shadows: where they can be, how much of a light they can hide.
//
// All limits hold for anything within the boxes. Light space; a light reaches from −half_size to half_size in its
// plane, and is the rectangle, the disk within it, or, with half_size.y = 0, a line. Error: 1e-5 of the light, and of
// lengths that of project_box. Source: ours.
#pragma once

#include <penumbra/geometry.hpp>
#include <penumbra/light.hpp>
#include <penumbra/numeric.hpp>

namespace penumbra {

/// A light as boxes see it.
template <class T>
struct LightExtent {
    Vec2<T> half_size;  ///< world units, ≥ 0
    bool disk = false;
};

/// The part of the receivers' box from which something in the caster's can be before the light: it holds all of the
/// caster's wedges there. Empty if there is none.
template <class T>
Box3<T> shadow_box(const Box3<T>& caster_ls, const Box3<T>& receivers_ls, const Vec2<T>& half_size) {
    if (is_empty(caster_ls) || is_empty(receivers_ls) || !(caster_ls.max.z > T(0))) return empty_box<T>();
    const T near = caster_ls.min.z > T(0) ? caster_ls.min.z : T(0), deepest = receivers_ls.max.z;
    Box3<T> box = receivers_ls;
    box.min.z = box.min.z > near ? box.min.z : near;
    if (!(near < deepest)) return empty_box<T>();
    // from E at depth z, seen past the light's far side: (E + h) p / z − h, for p / z from 1 up
    constexpr T far = T(1e9);
    const T most = near * far > deepest ? deepest / near : far;
    const T nearest = caster_ls.max.z * far > box.min.z ? box.min.z / caster_ls.max.z : far;
    const T shallow = nearest > T(1) ? nearest : T(1);
    for (int k = 0; k < 2; ++k) {
        const T h = half_size[k], high = caster_ls.max[k] + h, low = caster_ls.min[k] - h;
        const T right = high * (high > T(0) ? most : shallow) - h, left = low * (low < T(0) ? most : shallow) + h;
        box.max[k] = box.max[k] < right ? box.max[k] : right;
        box.min[k] = box.min[k] > left ? box.min[k] : left;
    }
    return is_empty(box) ? empty_box<T>() : box;
}

/// The largest share of a light that anything within a rectangle on its plane covers, in [0, 1]. A light without extent
/// along an axis is covered there by what comes within 1e-6 of the rectangle's size.
template <class T>
T light_share(const Rect2<T>& covered, const LightExtent<T>& light) {
    if (!(covered.min.x <= covered.max.x && covered.min.y <= covered.max.y)) return T(0);
    constexpr T slack = T(1e-6), of_square = T(4) / pi<T>;
    T share = T(1);
    for (int k = 0; k < 2; ++k) {
        const T h = light.half_size[k], margin = slack * (h + covered.max[k] - covered.min[k]);
        const T low = covered.min[k] - margin > -h ? covered.min[k] - margin : -h;
        const T high = covered.max[k] + margin < h ? covered.max[k] + margin : h;
        share *= h > T(0) ? saturated_ratio(high - low, T(2) * h) : (low <= high ? T(1) : T(0));
    }
    return saturate(light.disk ? share * of_square : share);
}

/// The largest share of a light that a caster of this size covers, seen from any one of the receivers, wherever it
/// appears; in [0, 1]. Each face of its box at depth z appears p / (p − z) times as large; of two, what is on the light
/// of one lies that much beside the other. All receivers lie beyond it, else 1.
template <class T>
T size_limit(const Box3<T>& caster_ls, const Box3<T>& receivers_ls, const LightExtent<T>& light) {
    const T near = caster_ls.min.z, p = receivers_ls.min.z, room = p - caster_ls.max.z;
    constexpr T far = T(1e6);
    if (!(near > T(0)) || !(room * far > p)) return T(1);
    const T larger = p / room, deeper = (caster_ls.max.z - near) / near;
    T share = T(1);
    for (int k = 0; k < 2; ++k) {
        const T h = light.half_size[k], low = caster_ls.min[k], high = caster_ls.max[k];
        const T reach = h + (-low > high ? -low : high), width = ((high - low) + reach * deeper) * larger;
        share *= h > T(0) ? saturated_ratio(width, T(2) * h) : T(1);
    }
    constexpr T of_square = T(4) / pi<T>;
    return saturate(light.disk ? share * of_square : share);
}

/// The largest share of the light that a caster hides from any of the receivers, in [0, 1].
template <class T>
T occlusion_limit(const Box3<T>& caster_ls, const Box3<T>& receivers_ls, const LightExtent<T>& light) {
    const Box3<T> within = shadow_box(caster_ls, receivers_ls, light.half_size);
    if (is_empty(within)) return T(0);
    const T by_place = light_share(project_box(caster_ls, within), light);
    const T by_size = size_limit(caster_ls, within, light);
    return by_place < by_size ? by_place : by_size;
}

/// The largest share of the light that two casters both hide from any of the receivers, in [0, 1]: 0 unless their
/// wedges meet there.
template <class T>
T overlap_limit(const Box3<T>& a_ls, const Box3<T>& b_ls, const Box3<T>& receivers_ls, const LightExtent<T>& light) {
    const Box3<T> of_a = shadow_box(a_ls, receivers_ls, light.half_size);
    const Box3<T> both = is_empty(of_a) ? of_a : shadow_box(b_ls, of_a, light.half_size);
    if (is_empty(both)) return T(0);
    const T by_place = light_share(intersect(project_box(a_ls, both), project_box(b_ls, both)), light);
    const T size_a = size_limit(a_ls, both, light), size_b = size_limit(b_ls, both, light);
    const T by_size = size_a < size_b ? size_a : size_b;
    return by_place < by_size ? by_place : by_size;
}

/// The widest penumbra that a caster casts on the receivers, world units; 0 if it casts none there, at most 1e9 light
/// sizes.
template <class T>
T penumbra_width(const Box3<T>& caster_ls, const Box3<T>& receivers_ls, const Vec2<T>& half_size) {
    const Box3<T> within = shadow_box(caster_ls, receivers_ls, half_size);
    if (is_empty(within)) return T(0);
    const T near = caster_ls.min.z > T(0) ? caster_ls.min.z : T(0), room = within.max.z - near;
    const T size = T(2) * (half_size.x > half_size.y ? half_size.x : half_size.y);
    constexpr T far = T(1e9);
    return size * (near * far > room ? room / near : far);
}

/// What a tile of receivers calls for.
enum class TileClass {
    lit,     ///< nothing hides any of the light: visibility is exactly 1
    single,  ///< one caster may: nothing overlaps but what it covers twice itself
    several  ///< more than one may
};

/// The class of a tile's box, of which casters so far made `so_far`, with one more.
template <class T>
TileClass with_caster(TileClass so_far, const Box3<T>& caster_ls, const Box3<T>& tile_ls, const LightExtent<T>& light) {
    if (!(occlusion_limit(caster_ls, tile_ls, light) > T(0))) return so_far;
    return so_far == TileClass::lit ? TileClass::single : TileClass::several;
}

}  // namespace penumbra
