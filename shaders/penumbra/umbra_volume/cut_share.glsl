// t: the share of a disk light's diameter, across an edge's line, on the side that the edge leaves visible.
//
// Options: none
// Error:   edge_cut_share 4 epsilon of |x| |v1 - x| over the distance of x from the edge's line, in units of r; the
//          others a rounding of each difference of depths over the difference
// Source:  the umbra and penumbra volume paper for circular lights, eq. 3, put right
// C++:     include/penumbra/umbra_volume/cut_share.hpp
#ifndef PENUMBRA_UMBRA_VOLUME_CUT_SHARE_GLSL
#define PENUMBRA_UMBRA_VOLUME_CUT_SHARE_GLSL

#include "../geometry.glsl"
#include "../numeric.glsl"

// t at `point` behind the edge from v1 to v2, whose caster lies on its left as seen from the light. Light space of the
// disk. In [0, 1]; 1 or 0 for radius 0; 1/2 for a point on the edge's line.
float penumbra_edge_cut_share(vec3 v1, vec3 v2, vec3 point, float radius) {
    vec3 normal = cross(v1 - point, v2 - v1);
    float across = dot(normal, point);
    float reach = radius * penumbra_safe_length(vec3(normal.x, normal.y, 0.0f));
    bool cuts = reach > 0.0f;
    float u = penumbra_clamp(across, -reach, reach) / (cuts ? reach : 1.0f);
    float side = across > 0.0f ? 1.0f : (across < 0.0f ? -1.0f : 0.0f);
    return 0.5f * (1.0f + (cuts ? u : side));
}

// t past an edge at `silhouette_depth`, at `depth`, on a ray from the light's centre that the caster does not block and
// that enters the penumbra volume at `penumbra_depth`. In [1/2, 1]; 1 up to there.
float penumbra_penumbra_cut_share(float silhouette_depth, float penumbra_depth, float depth) {
    float s = silhouette_depth;
    float p = penumbra_depth;
    float x = depth;
    return 1.0f - 0.5f * penumbra_saturated_ratio((x - p) * s, max((x - s) * p, 0.0f));
}

// The same on a ray that the caster blocks and that leaves the umbra volume at `umbra_depth`. In [0, 1/2]; 0 up to there.
float penumbra_umbra_cut_share(float silhouette_depth, float umbra_depth, float depth) {
    float s = silhouette_depth;
    float u = umbra_depth;
    float x = depth;
    return 0.5f * penumbra_saturated_ratio((x - u) * s, max((x - s) * u, 0.0f));
}

#endif
