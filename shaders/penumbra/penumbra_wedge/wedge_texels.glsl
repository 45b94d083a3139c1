// The index of a shadow as a texture: how to read it. The C++ makes it, and says which texel is what.
//
// Options: none
// Error:   exact
// C++:     include/penumbra/penumbra_wedge/wedge_texels.hpp
#ifndef PENUMBRA_PENUMBRA_WEDGE_WEDGE_TEXELS_GLSL
#define PENUMBRA_PENUMBRA_WEDGE_WEDGE_TEXELS_GLSL

// What a query needs besides the texture: the fields of C++'s WedgeTexels.
struct penumbra_WedgeShadow {
    vec2 half_size;   // of the light, times `scale`
    float scale;      // from light space to that of the texels
    float tolerance;  // how near a face's plane passes to points that are on it, times `scale`
    int nodes;        // how many texels nodes take
};

// The traits of a node, as bits.
#define PENUMBRA_WEDGE_MESH 1
#define PENUMBRA_WEDGE_PIECE 2
#define PENUMBRA_WEDGE_IN_PIECE 4
#define PENUMBRA_WEDGE_SOLID 8
#define PENUMBRA_WEDGE_SIMPLE 16
#define PENUMBRA_WEDGE_BEYOND 512       // only points beyond its box ask,
#define PENUMBRA_WEDGE_NOT_BEYOND 1024  // or only the others

// `wedges`: 32-bit floats; nothing is filtered.
vec4 penumbra_wedge_texel(highp sampler2D wedges, int texel) {
    return texelFetch(wedges, ivec2(texel & 1023, texel >> 10), 0);
}

#endif
