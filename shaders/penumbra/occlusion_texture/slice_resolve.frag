// After slice capture: fills solids, and turns captured depths into those that queries read. Four slices at a time.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp
// sampler2DArray;` for ES. Draw full_screen.vert on an image of the slices' size, no blending; layer g of the arrays holds
// slices 4g to 4g + 3. Targets: masks and depths, RGBA8.
// C++: detail::SliceCapture::fill_solids in include/penumbra/occlusion_texture/slices.hpp
uniform sampler2DArray penumbra_masks, penumbra_depths, penumbra_windings;  // as captured
uniform int penumbra_group;

layout(location = 0) out vec4 penumbra_mask;
layout(location = 1) out vec4 penumbra_depth;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float inside = 0.0;  // surfaces of solids entered, less those left, above the slice
    for (int group = 0; group < penumbra_group; ++group)
        inside += dot(texelFetch(penumbra_windings, ivec3(at, group), 0), vec4(1.0));
    vec4 windings = texelFetch(penumbra_windings, ivec3(at, penumbra_group), 0);
    vec4 mask = texelFetch(penumbra_masks, ivec3(at, penumbra_group), 0);
    vec4 depth = mask - texelFetch(penumbra_depths, ivec3(at, penumbra_group), 0);
    for (int c = 0; c < 4; ++c) {
        if (abs(inside) > 0.5) {
            mask[c] = 1.0;
            depth[c] = 0.0;
        }
        inside += windings[c];
    }
    penumbra_mask = mask;
    penumbra_depth = depth;
}
