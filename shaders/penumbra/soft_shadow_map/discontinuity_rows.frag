// Soft shadow maps, after discontinuities.frag: where in each row there are any, so that skins.frag passes over the
// rest.
//
// A whole shader for GLSL 330 and ES 300: prepend the version, and `precision highp float; precision highp int;` for
// ES. Draw ../occlusion_texture/full_screen.vert on an image that has a texel for 1024 columns, the last for fewer, and
// all rows of all maps; no blending. Target: RG32UI, a bit for each texel of the pass before, the lowest the first's:
//     .r those with skins that lead into the map after this one
//     .g and into that before it
// Options: none
// C++: none; an index to detail::SkinPainter's discontinuities
uniform highp usampler2D penumbra_onward, penumbra_backward;  // of discontinuities.frag

layout(location = 0) out highp uvec2 penumbra_rows;

void main() {
    int row = int(gl_FragCoord.y);
    int begin = 32 * int(gl_FragCoord.x);
    int end = min(begin + 32, textureSize(penumbra_onward, 0).x);
    penumbra_rows = uvec2(0u);
    for (int i = begin; i < end; ++i) {
        uint bit = 1u << uint(i - begin);
        if (texelFetch(penumbra_onward, ivec2(i, row), 0).x != 0u) penumbra_rows.x |= bit;
        if (texelFetch(penumbra_backward, ivec2(i, row), 0).x != 0u) penumbra_rows.y |= bit;
    }
}
