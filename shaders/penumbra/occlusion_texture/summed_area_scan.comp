// A summed-area table of four slices in two dispatches: sums along rows, then along columns.
//
// A whole shader for GLSL 430 and ES 310: prepend the version, and `precision highp float; precision highp int;
// precision highp sampler2DArray; precision highp uimage2DArray;` for ES. One workgroup a row and layer: dispatch
// (height + 1) x layers groups with PENUMBRA_SCAN_COLUMNS 0, a memory barrier (GL_SHADER_IMAGE_ACCESS_BARRIER_BIT),
// then (width + 1) x layers groups with 1, from the first table to the second. RGBA32UI, (width + 1) x (height + 1)
// texels.
// Options: PENUMBRA_SCAN_COLUMNS  0: rows, reads the slices (default); 1: columns, reads the sums of rows
//          PENUMBRA_SCAN_CHANNELS  4 (default); 1: columns go to R32UI instead, layer 4g + c from channel c of layer g
// Source: D. Hillis & G. Steele, "Data parallel algorithms", 1986
// C++: build_summed_area in include/penumbra/occlusion_texture/summed_area.hpp
#ifndef PENUMBRA_SCAN_COLUMNS
#define PENUMBRA_SCAN_COLUMNS 0
#endif
#ifndef PENUMBRA_SCAN_CHANNELS
#define PENUMBRA_SCAN_CHANNELS 4
#endif

layout(local_size_x = 128) in;
#if PENUMBRA_SCAN_COLUMNS && PENUMBRA_SCAN_CHANNELS == 1
layout(r32ui, binding = 0) writeonly uniform highp uimage2DArray penumbra_sums;
#else
layout(rgba32ui, binding = 0) writeonly uniform highp uimage2DArray penumbra_sums;
#endif
uniform int penumbra_layer;  // the first
#if PENUMBRA_SCAN_COLUMNS
layout(rgba32ui, binding = 1) readonly uniform highp uimage2DArray penumbra_rows;
#else
uniform highp sampler2DArray penumbra_slices;  // RGBA8
#endif

shared uvec4 penumbra_scan[128];

int penumbra_its_layer() { return penumbra_layer + int(gl_WorkGroupID.y); }

// Value i of line `line`; nothing lies before the first.
uvec4 penumbra_value(int i, int line) {
#if PENUMBRA_SCAN_COLUMNS
    return imageLoad(penumbra_rows, ivec3(line, i, penumbra_its_layer()));
#else
    if (i == 0 || line == 0) return uvec4(0u);
    return uvec4(texelFetch(penumbra_slices, ivec3(i - 1, line - 1, penumbra_its_layer()), 0) * 255.0 + 0.5);
#endif
}

void penumbra_store(ivec2 at, uvec4 sum) {
#if PENUMBRA_SCAN_COLUMNS && PENUMBRA_SCAN_CHANNELS == 1
    for (int c = 0; c < 4; ++c)
        imageStore(penumbra_sums, ivec3(at, 4 * penumbra_its_layer() + c), uvec4(sum[c], 0u, 0u, 0u));
#else
    imageStore(penumbra_sums, ivec3(at, penumbra_its_layer()), sum);
#endif
}

void main() {
    ivec2 size = imageSize(penumbra_sums).xy;
    int line = int(gl_WorkGroupID.x), thread = int(gl_LocalInvocationID.x);
    int count = PENUMBRA_SCAN_COLUMNS == 1 ? size.y : size.x;
    uvec4 carry = uvec4(0u);
    for (int start = 0; start < count; start += 128) {
        int i = start + thread;
        uvec4 sum = i < count ? penumbra_value(i, line) : uvec4(0u);
        penumbra_scan[thread] = sum;
        barrier();
        for (int reach = 1; reach < 128; reach *= 2) {
            uvec4 before = thread >= reach ? penumbra_scan[thread - reach] : uvec4(0u);
            barrier();
            sum += before;
            penumbra_scan[thread] = sum;
            barrier();
        }
        ivec2 at = PENUMBRA_SCAN_COLUMNS == 1 ? ivec2(line, i) : ivec2(i, line);
        if (i < count) penumbra_store(at, carry + sum);
        carry += penumbra_scan[127];
        barrier();
    }
}
