// How much of a disk light a straight edge leaves visible, or two edges do.
//
// Seen from a point, an edge's line cuts the disk. t is the share of the diameter across the line that lies on the
// visible side: 0 none, 1 all. Square roots and polynomials only.
//
// Options: none
// Error:   V(t) 7.3e-8, relative 2.2e-7; two cuts 2.3e-7
// Source:  fits of the closed forms, derived anew
// C++:     include/penumbra/umbra_volume/disk_visibility.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_DISK_VISIBILITY_GLSL
#define PENUMBRA_UMBRA_VOLUME_DISK_VISIBILITY_GLSL

#include "../numeric.glsl"

#define PENUMBRA_DISK_PI 3.14159274f

// (acos u - u sqrt(1 - u^2)) / (pi x sqrt x), u = 1 - 2x, on [0, 1/2]: 4.5e-9.
float penumbra_segment_polynomial(float x) {
    float sum = -0.0289189792474f;
    sum = sum * x + 0.0193219960625f;
    sum = sum * x - 0.0235414629178f;
    sum = sum * x - 0.0148188030782f;
    sum = sum * x - 0.0358054016615f;
    sum = sum * x - 0.0909174699082f;
    sum = sum * x - 0.509296500409f;
    sum = sum * x + 1.69765272899f;
    return sum;
}

// (asin u + u sqrt(1 - u^2)) 2 / (pi u) of u^2 on [0, 1/4]: 2e-9.
float penumbra_middle_polynomial(float x) {
    float sum = -0.00532615960304f;
    sum = sum * x - 0.00484978258107f;
    sum = sum * x - 0.0114604118034f;
    sum = sum * x - 0.0318254405713f;
    sum = sum * x - 0.21220671124f;
    sum = sum * x + 1.27323954515f;
    return sum;
}

// acos(1 - 2x) / sqrt x on [0, 1/2]: 6e-9.
float penumbra_angle_polynomial(float x) {
    float sum = 0.24782698981f;
    sum = sum * x - 0.27183254248f;
    sum = sum * x + 0.214800042603f;
    sum = sum * x - 0.0140411583046f;
    sum = sum * x + 0.071628478568f;
    sum = sum * x + 0.0881832334674f;
    sum = sum * x + 0.150055146327f;
    sum = sum * x + 0.333332284756f;
    sum = sum * x + 2.00000000325f;
    return sum;
}

// sin y / y and cos y of y^2 for |y| <= pi / 4: 3e-9 and 5e-11.
float penumbra_sine_polynomial(float square) {
    float sum = -0.000195035694849f;
    sum = sum * square + 0.00833203320232f;
    sum = sum * square - 0.166666506261f;
    sum = sum * square + 0.999999996905f;
    return sum;
}
float penumbra_cosine_polynomial(float square) {
    float sum = 2.43794126961e-5f;
    sum = sum * square - 0.00138866134784f;
    sum = sum * square + 0.041666616543f;
    sum = sum * square - 0.499999996133f;
    sum = sum * square + 0.999999999952f;
    return sum;
}

// Half the arc on the visible side of a cut, in radians: acos(1 - 2t), in [0, pi].
float penumbra_half_arc(float t) {
    bool above = t > 0.5f;
    float x = above ? 1.0f - t : t;
    float near = sqrt(x) * penumbra_angle_polynomial(x);
    return above ? PENUMBRA_DISK_PI - near : near;
}

// Visibility behind one straight edge: the fraction of a disk on the visible side of a line. Any t, limited to [0, 1];
// exactly 0, 1/2 and 1 at 0, 1/2 and 1.
float penumbra_disk_visibility(float t) {
    float share = penumbra_saturate(t);
    float from_middle = share - 0.5f;
    float u = 2.0f * from_middle;
    float middle = 0.5f + from_middle * penumbra_middle_polynomial(u * u);
    float x = from_middle > 0.0f ? 1.0f - share : share;
    float segment = x * (sqrt(x) * penumbra_segment_polynomial(x));
    return x > 0.25f ? middle : (from_middle > 0.0f ? 1.0f - segment : segment);
}

// The cubic 3t^2 - 2t^3 in place of V(t): off by up to 0.039.
float penumbra_disk_visibility_cubic(float t) {
    float share = penumbra_saturate(t);
    return share * share * (3.0f - 2.0f * share);
}

// sqrt t in place of V(t), meant for small casters: off by up to 0.306.
float penumbra_disk_visibility_sqrt(float t) { return sqrt(penumbra_saturate(t)); }

// Visibility behind two straight edges: the fraction of a disk on the visible sides of both. `angle` is that between the
// directions that point straight into the two visible sides, in radians, limited to [0, pi].
float penumbra_disk_visibility(float t1, float t2, float angle) {
    float share1 = penumbra_saturate(t1);
    float share2 = penumbra_saturate(t2);
    float turn = penumbra_clamp(angle, 0.0f, PENUMBRA_DISK_PI);
    // sine and cosine of half the angle, or of what it lacks to a right angle, which is smaller
    bool obtuse = turn > 0.5f * PENUMBRA_DISK_PI;
    float half_turn = 0.5f * (obtuse ? PENUMBRA_DISK_PI - turn : turn);
    float sine = half_turn * penumbra_sine_polynomial(half_turn * half_turn);
    float cosine = penumbra_cosine_polynomial(half_turn * half_turn);
    // where the cuts cross, along each from its middle
    float u1 = 1.0f - 2.0f * share1;
    float u2 = 1.0f - 2.0f * share2;
    float apart = obtuse ? (1.0f - share1) - share2 : share1 - share2;
    float crossing = apart / (sine * cosine + 1e-30f);
    float lean = sine / cosine;
    float cross1 = obtuse ? crossing - u1 * lean : crossing + u1 * lean;
    float cross2 = obtuse ? crossing - u2 * lean : u2 * lean - crossing;
    float reach1 = 2.0f * sqrt(share1 * (1.0f - share1));
    float reach2 = 2.0f * sqrt(share2 * (1.0f - share2));
    float length1 = reach1 - penumbra_clamp(cross1, -reach1, reach1);
    float length2 = reach2 - penumbra_clamp(cross2, -reach2, reach2);
    // what the two arcs have in common, in one piece or two
    float arc1 = penumbra_half_arc(share1);
    float arc2 = penumbra_half_arc(share2);
    float back = 2.0f * PENUMBRA_DISK_PI - turn;
    float front = penumbra_clamp(turn + arc2, -arc1, arc1) - penumbra_clamp(turn - arc2, -arc1, arc1);
    float rest = penumbra_clamp(arc2 - back, -arc1, arc1) - penumbra_clamp(-arc2 - back, -arc1, arc1);
    float area = ((front + rest) - u1 * length1 - u2 * length2) * (0.5f / PENUMBRA_DISK_PI);
    float v1 = penumbra_disk_visibility(share1);
    float v2 = penumbra_disk_visibility(share2);
    float low = v1 < v2 ? v1 : v2;
    float high = v1 < v2 ? v2 : v1;
    float least = high < 1.0f ? low - (1.0f - high) : low;
    float raised = area > least ? area : least;
    return penumbra_clamp(raised, 0.0f, low);
}

// Visibility past one convex caster between two lines, a strip or a corner: what is on the visible side of either.
float penumbra_disk_visibility_between(float t1, float t2, float angle) {
    return 1.0f - penumbra_disk_visibility(1.0f - penumbra_saturate(t1), 1.0f - penumbra_saturate(t2), angle);
}

#endif
