// Visibility channels: for each texel of a map, how much of the light towards the next map its surface sees, by the
// skins of that map's discontinuities.
//
// Textures are those of the passes beside this file. `surfaces`, of light_map.frag, has in row y + i resolution what
// map i sees: the depth of the nearest caster or, negative, of a receiver before it. `marks`, of discontinuities.frag,
// has in the same row a texel for 32 columns: which of them end a caster whose skin leads into the target's map, and
// the columns of that map that these skins cover. `rows`, of discontinuity_rows.frag, has which of these texels mark
// any. Skins are looked up where they may be, not drawn: no blending.
//
// Options: PENUMBRA_SOFT_SHADOW_MAP_DETECTOR    0: is_step; 1: is_laplacian_step, the paper
//          PENUMBRA_SOFT_SHADOW_MAP_TRANSITION  0: linear, the paper; 1: rational; 2: exact
// Error:   that of the method; a texel's columns are those of the C++ but where a skin ends within a rounding of one
// Source:  W. Heidrich, S. Brabec & H.-P. Seidel, "Soft shadow maps for linear lights", 2000
// C++:     include/penumbra/soft_shadow_map/visibility_map.hpp
#ifndef PENUMBRA_SOFT_SHADOW_MAP_VISIBILITY_MAP_GLSL
#define PENUMBRA_SOFT_SHADOW_MAP_VISIBILITY_MAP_GLSL

#include "discontinuity.glsl"
#include "light_map.glsl"
#include "linear_visibility.glsl"
#include "skin.glsl"

#ifndef PENUMBRA_SOFT_SHADOW_MAP_DETECTOR
#define PENUMBRA_SOFT_SHADOW_MAP_DETECTOR 0
#endif
#ifndef PENUMBRA_SOFT_SHADOW_MAP_TRANSITION
#define PENUMBRA_SOFT_SHADOW_MAP_TRANSITION 2
#endif

// What a texel's surface sees, in [0, 1], and what hides the rest: only for exact transitions.
struct penumbra_VisibilityChannel {
    float visible;
    penumbra_RowPoint edge;
};

// The nearest of casters and receivers; `none` outside of the row.
float penumbra_surface_depth(highp sampler2D surfaces, int resolution, ivec2 at) {
    if (at.x < 0 || at.x >= resolution) return PENUMBRA_LIGHT_MAP_NONE;
    return abs(texelFetch(surfaces, at, 0).x);
}

float penumbra_inverse_depth(float depth) { return depth < PENUMBRA_LIGHT_MAP_NONE ? 1.0f / depth : 0.0f; }

// Of the depths around a texel; nothing counts as what is at twice the farthest around.
float penumbra_surface_laplacian(highp sampler2D surfaces, int resolution, ivec2 at) {
    int first_row = at.y / resolution * resolution;
    mat3 depths;
    float farthest = 0.0f;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            int x = clamp(at.x + i - 1, 0, resolution - 1);
            int y = clamp(at.y + j - 1, first_row, first_row + resolution - 1);
            depths[i][j] = abs(texelFetch(surfaces, ivec2(x, y), 0).x);
            if (depths[i][j] < PENUMBRA_LIGHT_MAP_NONE) farthest = max(farthest, depths[i][j]);
        }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(depths[i][j] < PENUMBRA_LIGHT_MAP_NONE)) depths[i][j] = 2.0f * farthest;
    return penumbra_laplacian_of_gaussian(depths);
}

// Is there a step between columns at.x and at.x + 1?
bool penumbra_steps(highp sampler2D surfaces, int resolution, ivec2 at, float threshold) {
#if PENUMBRA_SOFT_SHADOW_MAP_DETECTOR == 0
    vec3 left, right;
    for (int i = 0; i < 3; ++i) {
        left[i] = penumbra_surface_depth(surfaces, resolution, at - ivec2(i, 0));
        right[i] = penumbra_surface_depth(surfaces, resolution, at + ivec2(i + 1, 0));
    }
    return penumbra_is_step(left, right, threshold, PENUMBRA_LIGHT_MAP_NONE);
#else
    float left = penumbra_surface_laplacian(surfaces, resolution, at);
    float right = penumbra_surface_laplacian(surfaces, resolution, at + ivec2(1, 0));
    return penumbra_is_laplacian_step(left, right, threshold);
#endif
}

// From texel `near`, whose caster ends there, to texel `far` beside it.
penumbra_Skin penumbra_skin_between(highp sampler2D surfaces, penumbra_LightMapView view, ivec2 near, ivec2 far,
                                    float source, float target) {
    float edge = penumbra_inverse_depth(abs(texelFetch(surfaces, near, 0).x));
    float behind = penumbra_inverse_depth(abs(texelFetch(surfaces, far, 0).x));
    return penumbra_warp_skin(penumbra_column_slope(view, float(max(near.x, far.x))), edge, behind, source, target);
}

// The first column that a skin covers, and what follows the last: one more at both ends.
ivec2 penumbra_skin_columns(penumbra_LightMapView view, penumbra_Skin skin) {
    float edge = penumbra_column(view, skin.edge.slope);
    float far = penumbra_column(view, skin.far.slope);
    float size = float(view.resolution);
    return ivec2(int(penumbra_clamp(floor(min(edge, far)) - 1.0f, 0.0f, size)),
                 int(penumbra_clamp(floor(max(edge, far)) + 2.0f, 0.0f, size)));
}

// Under the skin's edge, of a receiver that goes on as it is seen behind it.
float penumbra_receiver_under(highp sampler2D surfaces, penumbra_LightMapView view, penumbra_Skin skin, ivec2 far,
                              ivec2 beyond, float source, float target, float threshold) {
    if (beyond.x < 0 || beyond.x >= view.resolution ||
        penumbra_steps(surfaces, view.resolution, ivec2(min(far.x, beyond.x), far.y), threshold))
        return skin.far.inverse_depth;
    float seen = penumbra_inverse_depth(abs(texelFetch(surfaces, far, 0).x));
    float next = penumbra_inverse_depth(abs(texelFetch(surfaces, beyond, 0).x));
    float seen_slope = penumbra_column_slope(view, float(far.x) + 0.5f) + source * seen;
    float next_slope = penumbra_column_slope(view, float(beyond.x) + 0.5f) + source * next;
    return penumbra_receiver_under_edge(skin, penumbra_row_point(seen_slope, seen),
                                        penumbra_row_point(next_slope, next), target);
}

// What column `at` of the target's map, whose surface is at `depth`, sees past the skin that begins where `column` of
// row `row` of `surfaces` ends; 1 where that skin does not hide it.
penumbra_VisibilityChannel penumbra_past_skin(highp sampler2D surfaces, penumbra_LightMapView view, int at,
                                              float depth, int column, int row, float source, float target,
                                              float threshold) {
    penumbra_VisibilityChannel result;
    result.visible = 1.0f;
    result.edge = penumbra_row_point(0.0f, 0.0f);
    bool onward = source < target;
    ivec2 near = ivec2(onward ? column : column + 1, row);
    ivec2 far = ivec2(onward ? column + 1 : column, row);
    penumbra_Skin skin = penumbra_skin_between(surfaces, view, near, far, source, target);
    ivec2 columns = penumbra_skin_columns(view, skin);
    if (at < columns.x || at >= columns.y || !(depth > 1.0f / skin.edge.inverse_depth + threshold)) return result;
    float share = penumbra_skin_share(skin, penumbra_column_slope(view, float(at) + 0.5f));
    float inverse = penumbra_inverse_depth(depth);
    if (!(inverse < penumbra_skin_inverse_depth(skin, share))) return result;
#if PENUMBRA_SOFT_SHADOW_MAP_TRANSITION == 0
    result.visible = penumbra_skin_visibility(share);
#else
#if PENUMBRA_SOFT_SHADOW_MAP_TRANSITION == 1
    float at_edge =
        penumbra_receiver_under(surfaces, view, skin, far, far + (far - near), source, target, threshold);
    inverse = penumbra_mix(at_edge, skin.far.inverse_depth, share);
#endif
    result.visible = penumbra_skin_visibility(share, skin.edge.inverse_depth, skin.far.inverse_depth, inverse);
#endif
    result.edge = penumbra_row_point(skin.edge.slope + target * skin.edge.inverse_depth, skin.edge.inverse_depth);
    return result;
}

// The number of the lowest bit that is set. Domain: not 0.
int penumbra_lowest_bit(uint bits) { return penumbra_floor_log2(float(bits & (~bits + 1u))); }

// The bits of a word from number `first` to number `last`; word `word` begins with number 32 word.
uint penumbra_bits_between(int word, int first, int last) {
    int low = max(first - 32 * word, 0);
    int high = min(last - 32 * word, 31);
    return low > high ? 0u : (0xffffffffu << uint(low)) & (0xffffffffu >> uint(31 - high));
}

// Of texel `at` of the map at `target`, in row at.y of `surfaces`, towards the map at `source`, in row `row` of all. No
// caster is nearer than `nearest`; positions and depths in world units.
penumbra_VisibilityChannel penumbra_visibility_channel(highp sampler2D surfaces, highp usampler2D rows,
                                                       highp usampler2D marks, penumbra_LightMapView view, ivec2 at,
                                                       int row, float source, float target, float nearest,
                                                       float threshold) {
    penumbra_VisibilityChannel result;
    result.visible = 1.0f;
    result.edge = penumbra_row_point(0.0f, 0.0f);
    if (source == target) return result;
    float depth = abs(texelFetch(surfaces, at, 0).x);
    // columns of discontinuities whose skins may reach here
    float reach = (source - target) / nearest * float(view.resolution) / penumbra_extent(view.slopes).x;
    float end = float(view.resolution - 1);
    int first = int(penumbra_clamp(float(at.x) - 4.0f - max(reach, 0.0f), 0.0f, end)) / 32;
    int last = int(penumbra_clamp(float(at.x) + 2.0f - min(reach, 0.0f), 0.0f, end)) / 32;
    for (int word = first / 32; word <= last / 32; ++word) {
        uvec2 both = texelFetch(rows, ivec2(word, row), 0).xy;
        uint some = (source < target ? both.x : both.y) & penumbra_bits_between(word, first, last);
        for (; some != 0u; some &= some - 1u) {
            int i = 32 * word + penumbra_lowest_bit(some);
            uvec2 mark = texelFetch(marks, ivec2(i, row), 0).xy;
            if (at.x < int(mark.y & 65535u) || at.x >= int(mark.y >> 16u)) continue;
            for (uint columns = mark.x; columns != 0u; columns &= columns - 1u) {
                int column = 32 * i + penumbra_lowest_bit(columns);
                penumbra_VisibilityChannel past =
                    penumbra_past_skin(surfaces, view, at.x, depth, column, row, source, target, threshold);
                if (past.visible < result.visible) result = past;
            }
        }
    }
    return result;
}

#endif
