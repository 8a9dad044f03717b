#version 460

// One triangle over the whole picture, at infinity.
void main() {
    vec2 place = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0;
    gl_Position = vec4(place, 0, 1);
}
