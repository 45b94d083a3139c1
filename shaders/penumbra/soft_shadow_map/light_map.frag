// Depth maps from positions on a line light, fragment stage. Images are R32F, as wide as a map and as high as all of
// them, cleared to PENUMBRA_LIGHT_MAP_NONE (light_map.glsl); with depth buffers of 32-bit floats, cleared to 1, that
// compare by GL_LESS. Three draws:
//   PENUMBRA_LIGHT_MAP_CASTERS    every caster, into two images: the depth of the nearest; and that beyond which the
//                                 ray is blocked, a little within it, negative where it is a solid
//   PENUMBRA_LIGHT_MAP_INSIDES    if one is solid, every caster again, into a third image with a depth buffer of its
//                                 own: where the nearest is a solid, the middle between it and the next surface
//   PENUMBRA_LIGHT_MAP_RECEIVERS  what is shaded but casts no shadow, into the first image with the first depth
//                                 buffer: its depth, negative, where no caster is nearer
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. No blending.
// Options: PENUMBRA_LIGHT_MAP  which draw; PENUMBRA_LIGHT_MAP_CASTERS
// C++: detail::LightMapMaker in include/penumbra/soft_shadow_map/light_map_maker.hpp
#define PENUMBRA_LIGHT_MAP_CASTERS 0
#define PENUMBRA_LIGHT_MAP_INSIDES 1
#define PENUMBRA_LIGHT_MAP_RECEIVERS 2
#ifndef PENUMBRA_LIGHT_MAP
#define PENUMBRA_LIGHT_MAP PENUMBRA_LIGHT_MAP_CASTERS
#endif

uniform float penumbra_farthest;  // depth of the farthest caster
#if PENUMBRA_LIGHT_MAP == PENUMBRA_LIGHT_MAP_CASTERS
uniform bool penumbra_solid;  // is the mesh closed?
#elif PENUMBRA_LIGHT_MAP == PENUMBRA_LIGHT_MAP_INSIDES
uniform highp sampler2D penumbra_surfaces, penumbra_blocked;  // the first two images
#endif

layout(location = 0) out float penumbra_depth;
#if PENUMBRA_LIGHT_MAP == PENUMBRA_LIGHT_MAP_CASTERS
layout(location = 1) out float penumbra_blocked;
#endif

void main() {
    float depth = 1.0 / gl_FragCoord.w;
    // in proportion to depths of casters, below 1 wherever a receiver is; no near plane but the light's
    gl_FragDepth = depth / (depth + penumbra_farthest);
#if PENUMBRA_LIGHT_MAP == PENUMBRA_LIGHT_MAP_CASTERS
    // over the texel, by its plane, up to 5 %: inverse depth is linear in the image
    float slack = clamp((abs(dFdx(gl_FragCoord.w)) + abs(dFdy(gl_FragCoord.w))) * depth, 1e-5, 0.05) * depth;
    penumbra_depth = depth;
    penumbra_blocked = penumbra_solid ? -(depth + slack) : depth + slack;
#elif PENUMBRA_LIGHT_MAP == PENUMBRA_LIGHT_MAP_INSIDES
    ivec2 at = ivec2(gl_FragCoord.xy);
    float nearest = texelFetch(penumbra_surfaces, at, 0).x;
    // itself, which another program's rounding may put a little elsewhere
    if (depth <= nearest * 1.000001 || texelFetch(penumbra_blocked, at, 0).x >= 0.0) discard;
    penumbra_depth = 0.5 * (nearest + depth);
#else
    penumbra_depth = -depth;
#endif
}
