// D-buffer, casters, fragment stage: the two nearest surfaces of each texel, and the casters that block it. Three draws
// of the same triangles, which differ in PENUMBRA_CASTERS:
//   PENUMBRA_CASTERS_NEAREST   into RG32F cleared to 0, with a depth buffer that keeps the nearest: its inverse depth;
//                              and the depth beyond which the ray is blocked, a little within it, negative for a solid
//   PENUMBRA_CASTERS_SECOND    the next behind: into R32F cleared to 0, with another depth buffer: its inverse depth
//   PENUMBRA_CASTERS_COVERAGE  without depth test, by a logical or (glLogicOp), into RGBA32UI cleared to 0, or R32UI for
//                              32 casters at most: a bit for each that covers the texel, the same for each 128th
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float;` for ES. No blending. Where
// there is no logical or, as in ES, up to 32 casters can have a channel each of eight RGBA8 targets, by GL_MAX.
// Options: PENUMBRA_CASTERS  which draw; PENUMBRA_CASTERS_NEAREST
// C++: detail::NearestSurfaces in include/penumbra/detail/nearest_surfaces.hpp
#define PENUMBRA_CASTERS_NEAREST 0
#define PENUMBRA_CASTERS_SECOND 1
#define PENUMBRA_CASTERS_COVERAGE 2
#ifndef PENUMBRA_CASTERS
#define PENUMBRA_CASTERS PENUMBRA_CASTERS_NEAREST
#endif

flat in float penumbra_caster;  // its number; of one that is not closed -1 - its number
#if PENUMBRA_CASTERS == PENUMBRA_CASTERS_NEAREST
layout(location = 0) out vec2 penumbra_surface;
#elif PENUMBRA_CASTERS == PENUMBRA_CASTERS_SECOND
uniform highp sampler2D penumbra_nearest;  // what the first draw has made
layout(location = 0) out float penumbra_inverse_depth;
#else
layout(location = 0) out highp uvec4 penumbra_bits;
#endif

void main() {
#if PENUMBRA_CASTERS == PENUMBRA_CASTERS_NEAREST
    float depth = 1.0 / gl_FragCoord.w;
    // what it changes by over the texel, up to 5 %: inverse depth is linear in the image
    float slack = clamp((abs(dFdx(gl_FragCoord.w)) + abs(dFdy(gl_FragCoord.w))) * depth, 1e-5, 0.05) * depth;
    penumbra_surface = vec2(gl_FragCoord.w, penumbra_caster < 0.0 ? depth + slack : -depth - slack);
#elif PENUMBRA_CASTERS == PENUMBRA_CASTERS_SECOND
    if (gl_FragCoord.w >= texelFetch(penumbra_nearest, ivec2(gl_FragCoord.xy), 0).x) discard;
    penumbra_inverse_depth = gl_FragCoord.w;
#else
    int number = int(penumbra_caster < 0.0 ? -1.0 - penumbra_caster : penumbra_caster);
    uint bit = 1u << uint(number & 31);
    int channel = (number >> 5) & 3;
    penumbra_bits = uvec4(channel == 0 ? bit : 0u, channel == 1 ? bit : 0u, channel == 2 ? bit : 0u,
                          channel == 3 ? bit : 0u);
#endif
}
