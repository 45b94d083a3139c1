// How the occlusions of several casters combine when only their sizes are known, not where they overlap.
//
// The fraction of the light that two casters block together lies in [max(a, b), min(1, a + b)]. Every rule here stays
// in that interval.
//
// Options: none
// Error:   2 ULP
// Source:  E. Eisemann & X. Decoret, "Plausible image based soft shadows using occlusion textures", 2006, eq. 5
// C++:     include/penumbra/combine.hpp
#ifndef PENUMBRA_COMBINE_GLSL
#define PENUMBRA_COMBINE_GLSL

#include "numeric.glsl"

// Right when the casters' overlap on the light is as random: 1 - (1-a)(1-b). Occlusions in [0, 1] to [0, 1].
float penumbra_combine_product(float occlusion_a, float occlusion_b) {
    float high = occlusion_a > occlusion_b ? occlusion_a : occlusion_b;
    float low = occlusion_a > occlusion_b ? occlusion_b : occlusion_a;
    return penumbra_saturate(high + low * (1.0f - high));
}

// Right when the casters block disjoint parts: min(1, a + b).
float penumbra_combine_sum(float occlusion_a, float occlusion_b) {
    return penumbra_saturate(occlusion_a + occlusion_b);
}

// Right when one caster hides behind the other: max(a, b).
float penumbra_combine_max(float occlusion_a, float occlusion_b) {
    return penumbra_saturate(occlusion_a > occlusion_b ? occlusion_a : occlusion_b);
}

// The middle of the interval. Halves the worst case.
float penumbra_combine_mean(float occlusion_a, float occlusion_b) {
    return 0.5f * (penumbra_combine_max(occlusion_a, occlusion_b) + penumbra_combine_sum(occlusion_a, occlusion_b));
}

// The interval in which the true occlusion of the union lies.
struct penumbra_OcclusionBounds {
    float lower, upper;
};

penumbra_OcclusionBounds penumbra_occlusion_bounds(float occlusion_a, float occlusion_b) {
    penumbra_OcclusionBounds bounds;
    bounds.lower = penumbra_combine_max(occlusion_a, occlusion_b);
    bounds.upper = penumbra_combine_sum(occlusion_a, occlusion_b);
    return bounds;
}

// The four rules by name.
#define PENUMBRA_COMBINATION_PRODUCT 0
#define PENUMBRA_COMBINATION_SUM 1
#define PENUMBRA_COMBINATION_MAX 2
#define PENUMBRA_COMBINATION_MEAN 3

// Takes occlusions one at a time, in any order, and gives every rule's answer for all of them together.
struct penumbra_OcclusionAccumulator {
    float transmission;  // product of 1 - occlusion
    float total;         // sum of occlusions, not clamped
    float largest;
};

penumbra_OcclusionAccumulator penumbra_no_occlusion() {
    penumbra_OcclusionAccumulator all;
    all.transmission = 1.0f;
    all.total = 0.0f;
    all.largest = 0.0f;
    return all;
}

// With an occlusion in [0, 1] more.
penumbra_OcclusionAccumulator penumbra_add(penumbra_OcclusionAccumulator all, float occlusion) {
    all.transmission *= 1.0f - occlusion;
    all.total += occlusion;
    all.largest = occlusion > all.largest ? occlusion : all.largest;
    return all;
}

penumbra_OcclusionBounds penumbra_bounds(penumbra_OcclusionAccumulator all) {
    penumbra_OcclusionBounds bounds;
    bounds.lower = penumbra_saturate(all.largest);
    bounds.upper = penumbra_saturate(all.total);
    return bounds;
}

// The combined occlusion in [0, 1]; 0 if nothing was added.
float penumbra_result(penumbra_OcclusionAccumulator all, int rule) {
    float lower = penumbra_saturate(all.largest);
    float upper = penumbra_saturate(all.total);
    // the difference loses occlusions below 1 ULP of 1, the interval does not
    if (rule == PENUMBRA_COMBINATION_PRODUCT) return penumbra_clamp(1.0f - all.transmission, lower, upper);
    if (rule == PENUMBRA_COMBINATION_SUM) return upper;
    if (rule == PENUMBRA_COMBINATION_MAX) return lower;
    return 0.5f * (lower + upper);
}

#endif
