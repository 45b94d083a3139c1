// What boxes around casters and receivers say about shadows: where they can be, how much of a light they can hide.
//
// All limits hold for anything within the boxes. Light space; a light reaches from -half_size to half_size in its
// plane, and is the rectangle, the disk within it, or, with half_size.y = 0, a line.
//
// Options: none
// Error:   1e-5 of the light, and of lengths that of project_box
// Source:  ours
// C++:     include/penumbra/plan/extents.hpp
#ifndef PENUMBRA_PLAN_EXTENTS_GLSL
#define PENUMBRA_PLAN_EXTENTS_GLSL

#include "../light.glsl"

// A light as boxes see it.
struct penumbra_LightExtent {
    vec2 half_size;  // world units, >= 0
    bool disk;
};

// What is a share of a disk's square is at most so many times that of the disk: 4 / pi.
#define PENUMBRA_DISK_OF_SQUARE 1.27323949f

// From where, along one axis, something of a caster at [low, high] can be before a light of half-size h: no further
// than E at depth z is seen past the light's far side, (E + h) p / z - h, p / z being between `shallow` and `most`.
vec2 penumbra_shadow_range(float low, float high, float h, float shallow, float most) {
    float right = high + h;
    float left = low - h;
    return vec2(left * (left < 0.0f ? most : shallow) + h, right * (right > 0.0f ? most : shallow) - h);
}

// The part of the receivers' box from which something in the caster's can be before the light: it holds all of the
// caster's wedges there. Empty if there is none.
penumbra_Box3 penumbra_shadow_box(penumbra_Box3 caster_ls, penumbra_Box3 receivers_ls, vec2 half_size) {
    if (penumbra_is_empty(caster_ls) || penumbra_is_empty(receivers_ls) || !(caster_ls.max.z > 0.0f))
        return penumbra_empty_box();
    float near = caster_ls.min.z > 0.0f ? caster_ls.min.z : 0.0f;
    float deepest = receivers_ls.max.z;
    penumbra_Box3 box = receivers_ls;
    box.min.z = box.min.z > near ? box.min.z : near;
    if (!(near < deepest)) return penumbra_empty_box();
    float far = 1e9f;
    float most = near * far > deepest ? deepest / near : far;
    float nearest = caster_ls.max.z * far > box.min.z ? box.min.z / caster_ls.max.z : far;
    float shallow = nearest > 1.0f ? nearest : 1.0f;
    vec2 x = penumbra_shadow_range(caster_ls.min.x, caster_ls.max.x, half_size.x, shallow, most);
    vec2 y = penumbra_shadow_range(caster_ls.min.y, caster_ls.max.y, half_size.y, shallow, most);
    box.min.x = box.min.x > x.x ? box.min.x : x.x;
    box.max.x = box.max.x < x.y ? box.max.x : x.y;
    box.min.y = box.min.y > y.x ? box.min.y : y.x;
    box.max.y = box.max.y < y.y ? box.max.y : y.y;
    if (penumbra_is_empty(box)) return penumbra_empty_box();
    return box;
}

// The share of a light from -h to h along one axis that anything at [low, high] covers. Of a light without extent: all
// or nothing.
float penumbra_side_share(float low, float high, float h) {
    float margin = 1e-6f * (h + high - low);
    float from = low - margin > -h ? low - margin : -h;
    float to = high + margin < h ? high + margin : h;
    return h > 0.0f ? penumbra_saturated_ratio(to - from, 2.0f * h) : (from <= to ? 1.0f : 0.0f);
}

// The largest share of a light that anything within a rectangle on its plane covers, in [0, 1]. A light without extent
// along an axis is covered there by what comes within 1e-6 of the rectangle's size.
float penumbra_light_share(penumbra_Rect2 covered, penumbra_LightExtent light) {
    if (!(covered.min.x <= covered.max.x && covered.min.y <= covered.max.y)) return 0.0f;
    float share = penumbra_side_share(covered.min.x, covered.max.x, light.half_size.x) *
                  penumbra_side_share(covered.min.y, covered.max.y, light.half_size.y);
    return penumbra_saturate(light.disk ? share * PENUMBRA_DISK_OF_SQUARE : share);
}

// The share of a light from -h to h along one axis that a caster at [low, high] covers, seen from any one point.
float penumbra_side_limit(float low, float high, float h, float larger, float deeper) {
    float reach = h + (-low > high ? -low : high);
    float width = ((high - low) + reach * deeper) * larger;
    return h > 0.0f ? penumbra_saturated_ratio(width, 2.0f * h) : 1.0f;
}

// The largest share of a light that a caster of this size covers, seen from any one of the receivers, wherever it
// appears; in [0, 1]. Each face of its box at depth z appears p / (p - z) times as large; of two, what is on the light
// of one lies that much beside the other. All receivers lie beyond it, else 1.
float penumbra_size_limit(penumbra_Box3 caster_ls, penumbra_Box3 receivers_ls, penumbra_LightExtent light) {
    float near = caster_ls.min.z;
    float p = receivers_ls.min.z;
    float room = p - caster_ls.max.z;
    float far = 1e6f;
    if (!(near > 0.0f) || !(room * far > p)) return 1.0f;
    float larger = p / room;
    float deeper = (caster_ls.max.z - near) / near;
    float share = penumbra_side_limit(caster_ls.min.x, caster_ls.max.x, light.half_size.x, larger, deeper) *
                  penumbra_side_limit(caster_ls.min.y, caster_ls.max.y, light.half_size.y, larger, deeper);
    return penumbra_saturate(light.disk ? share * PENUMBRA_DISK_OF_SQUARE : share);
}

// The largest share of the light that a caster hides from any of the receivers, in [0, 1].
float penumbra_occlusion_limit(penumbra_Box3 caster_ls, penumbra_Box3 receivers_ls, penumbra_LightExtent light) {
    penumbra_Box3 within = penumbra_shadow_box(caster_ls, receivers_ls, light.half_size);
    if (penumbra_is_empty(within)) return 0.0f;
    float by_place = penumbra_light_share(penumbra_project_box(caster_ls, within), light);
    float by_size = penumbra_size_limit(caster_ls, within, light);
    return by_place < by_size ? by_place : by_size;
}

// The largest share of the light that two casters both hide from any of the receivers, in [0, 1]: 0 unless their wedges
// meet there.
float penumbra_overlap_limit(penumbra_Box3 a_ls, penumbra_Box3 b_ls, penumbra_Box3 receivers_ls,
                             penumbra_LightExtent light) {
    penumbra_Box3 of_a = penumbra_shadow_box(a_ls, receivers_ls, light.half_size);
    if (penumbra_is_empty(of_a)) return 0.0f;
    penumbra_Box3 both = penumbra_shadow_box(b_ls, of_a, light.half_size);
    if (penumbra_is_empty(both)) return 0.0f;
    penumbra_Rect2 covered = penumbra_intersect(penumbra_project_box(a_ls, both), penumbra_project_box(b_ls, both));
    float by_place = penumbra_light_share(covered, light);
    float size_a = penumbra_size_limit(a_ls, both, light);
    float size_b = penumbra_size_limit(b_ls, both, light);
    float by_size = size_a < size_b ? size_a : size_b;
    return by_place < by_size ? by_place : by_size;
}

// The widest penumbra that a caster casts on the receivers, world units; 0 if it casts none there, at most 1e9 light
// sizes.
float penumbra_penumbra_width(penumbra_Box3 caster_ls, penumbra_Box3 receivers_ls, vec2 half_size) {
    penumbra_Box3 within = penumbra_shadow_box(caster_ls, receivers_ls, half_size);
    if (penumbra_is_empty(within)) return 0.0f;
    float near = caster_ls.min.z > 0.0f ? caster_ls.min.z : 0.0f;
    float room = within.max.z - near;
    float size = 2.0f * (half_size.x > half_size.y ? half_size.x : half_size.y);
    float far = 1e9f;
    return size * (near * far > room ? room / near : far);
}

// What a tile of receivers calls for.
#define PENUMBRA_TILE_LIT 0      // nothing hides any of the light: visibility is exactly 1
#define PENUMBRA_TILE_SINGLE 1   // one caster may: nothing overlaps but what it covers twice itself
#define PENUMBRA_TILE_SEVERAL 2  // more than one may

// The class of a tile's box, of which casters so far made `so_far`, with one more.
int penumbra_with_caster(int so_far, penumbra_Box3 caster_ls, penumbra_Box3 tile_ls, penumbra_LightExtent light) {
    if (!(penumbra_occlusion_limit(caster_ls, tile_ls, light) > 0.0f)) return so_far;
    return so_far == PENUMBRA_TILE_LIT ? PENUMBRA_TILE_SINGLE : PENUMBRA_TILE_SEVERAL;
}

#endif
