// One triangle that covers the image: draw three vertices, no buffers. A whole shader for GLSL 330 and ES 300: prepend
// the version.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
