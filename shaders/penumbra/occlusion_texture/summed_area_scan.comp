// A summed-area table of four slices in two dispatches: sums along rows, then along columns.
//
// A whole shader for GLSL 430 and ES 310: prepend the version, and `precision highp float; precision highp int; precision
// highp sampler2DArray; precision highp uimage2DArray;` for ES. One workgroup a row: dispatch height + 1 groups with
// PENUMBRA_SCAN_COLUMNS 0, a memory barrier (GL_SHADER_IMAGE_ACCESS_BARRIER_BIT), then width + 1 groups with 1, from the
// first table to the second. RGBA32UI, (width + 1) x (height + 1) texels.
// Options: PENUMBRA_SCAN_COLUMNS  0: rows, reads the slices (default); 1: columns, reads the sums of rows
// Source: D. Hillis & G. Steele, "Data parallel algorithms", 1986
// C++: build_summed_area in include/penumbra/occlusion_texture/summed_area.hpp
#ifndef PENUMBRA_SCAN_COLUMNS
#define PENUMBRA_SCAN_COLUMNS 0
#endif

layout(local_size_x = 128) in;
layout(rgba32ui, binding = 0) writeonly uniform highp uimage2DArray penumbra_sums;
uniform int penumbra_layer;
#if PENUMBRA_SCAN_COLUMNS
layout(rgba32ui, binding = 1) readonly uniform highp uimage2DArray penumbra_rows;
#else
uniform highp sampler2DArray penumbra_slices;  // RGBA8
#endif

shared uvec4 penumbra_scan[128];

// Value i of line `line`; nothing lies before the first.
uvec4 penumbra_value(int i, int line) {
#if PENUMBRA_SCAN_COLUMNS
    return imageLoad(penumbra_rows, ivec3(line, i, penumbra_layer));
#else
    if (i == 0 || line == 0) return uvec4(0u);
    return uvec4(texelFetch(penumbra_slices, ivec3(i - 1, line - 1, penumbra_layer), 0) * 255.0 + 0.5);
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
        if (i < count) imageStore(penumbra_sums, ivec3(at, penumbra_layer), carry + sum);
        carry += penumbra_scan[127];
        barrier();
    }
}
