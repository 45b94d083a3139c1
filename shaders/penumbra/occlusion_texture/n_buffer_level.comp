// A level of an N-Buffer from the one before: four lookups, 2^level texels apart; zeros outside. Rounds as C++ does.
//
// A whole shader for GLSL 430 and ES 310: prepend the version, and `precision highp float; precision highp
// image2DArray;` for ES. One invocation a texel: dispatch ceil(width / 8) x ceil(height / 8) x layers of a level. A
// memory barrier (GL_SHADER_IMAGE_ACCESS_BARRIER_BIT) after each level.
// C++: build_n_buffer_level in include/penumbra/occlusion_texture/n_buffer.hpp
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba8, binding = 0) readonly uniform highp image2DArray penumbra_before;
layout(rgba8, binding = 1) writeonly uniform highp image2DArray penumbra_after;
uniform ivec2 penumbra_layers;  // first ones, of the level before, and of the one to write
uniform int penumbra_level;     // number of the level before

ivec4 penumbra_bytes(ivec2 at, ivec2 size) {
    if (at.x >= size.x || at.y >= size.y) return ivec4(0);
    return ivec4(imageLoad(penumbra_before, ivec3(at, penumbra_layers.x + int(gl_WorkGroupID.z))) * 255.0 + 0.5);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(penumbra_after).xy;
    if (at.x >= size.x || at.y >= size.y) return;
    int reach = 1 << penumbra_level;
    ivec4 sum = penumbra_bytes(at, size) + penumbra_bytes(at + ivec2(reach, 0), size) +
                penumbra_bytes(at + ivec2(0, reach), size) + penumbra_bytes(at + ivec2(reach, reach), size);
    // halves go up and down in turn, level by level, which leaves no bias
    int bias = (penumbra_level & 1) == 0 ? 2 : 1;
    imageStore(penumbra_after, ivec3(at, penumbra_layers.y + int(gl_WorkGroupID.z)),
               vec4((sum + bias) >> 2) / 255.0);
}
