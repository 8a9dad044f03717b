// What the first pass keeps of each sample of the picture: what its surface is. shaders/light/light.h lights it.
layout(location = 0) out vec4 out_colour;    // root of the albedo; what is left of its light where things touch
layout(location = 1) out uvec2 out_surface;  // normal, kind; sky, sun, mirror, glow

struct Surface {
    vec3 albedo;   // linear
    vec3 normal;   // unit
    uint kind;     // k_kind_*
    float sky;     // how much of sky and ground it sees
    float sun;     // how much of the sun it sees, but for shadows
    float mirror;  // how much it mirrors
    float glow;    // how much of a lit room's light it sends out, against its albedo
};

// On the octahedron about y, flattened: -1..1.
vec2 flat_octahedron(vec3 n) {
    vec2 at = n.xz / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(at.yx)) * vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0);
    return n.y >= 0.0 ? at : folded;
}

void keep(Surface s) {
    uvec2 at = uvec2(flat_octahedron(s.normal) * 2047.0 + 2047.5);
    vec4 rest = vec4(s.sky, s.sun, s.mirror, sqrt(s.glow * (1.0 / k_most_glow)));
    uvec4 bytes = uvec4(clamp(rest, 0.0, 1.0) * 255.0 + 0.5);
    out_colour = vec4(sqrt(s.albedo), 1);
    out_surface = uvec2(at.x | at.y << 12 | s.kind << 24, bytes.x | bytes.y << 8 | bytes.z << 16 | bytes.w << 24);
}
