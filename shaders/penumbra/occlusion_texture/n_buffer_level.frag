// A level of an N-Buffer from the one before: four lookups, 2^level texels apart; zeros outside. Rounds as C++ does.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp
// sampler2DArray;` for ES. Draw full_screen.vert on layer `penumbra_layer` + layers of a level; the level before must
// be in another texture or layer that is not written. RGBA8, no blending.
// C++: build_n_buffer_level in include/penumbra/occlusion_texture/n_buffer.hpp
uniform sampler2DArray penumbra_levels;
uniform int penumbra_layer;  // of the level before
uniform int penumbra_level;  // its number

layout(location = 0) out vec4 penumbra_mean;

ivec4 penumbra_bytes(ivec2 at, ivec2 size) {
    bool inside = at.x < size.x && at.y < size.y;
    vec4 texel = texelFetch(penumbra_levels, ivec3(min(at, size - 1), penumbra_layer), 0);
    return inside ? ivec4(texel * 255.0 + 0.5) : ivec4(0);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(penumbra_levels, 0).xy;
    int reach = 1 << penumbra_level;
    ivec4 sum = penumbra_bytes(at, size) + penumbra_bytes(at + ivec2(reach, 0), size) +
                penumbra_bytes(at + ivec2(0, reach), size) + penumbra_bytes(at + ivec2(reach, reach), size);
    // halves go up and down in turn, level by level, which leaves no bias
    int bias = (penumbra_level & 1) == 0 ? 2 : 1;
    penumbra_mean = vec4((sum + bias) >> 2) / 255.0;
}
