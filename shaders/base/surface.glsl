// What the first pass keeps of each sample of the picture: what its surface is. shaders/light/light.h lights it.
layout(location = 0) out vec4 out_colour;    // root of the albedo; what is left of its light where things touch
layout(location = 1) out uvec2 out_surface;  // normal, kind; sky, sun, mirror, glow

// On the octahedron about y, flattened: -1..1. Of any length; where there is none, any way.
vec2 flat_octahedron(vec3 n) {
    vec2 at = n.xz / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-6);
    vec2 folded = (1.0 - abs(at.yx)) * vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0);
    return n.y >= 0.0 ? at : folded;
}

// How much a surface sees of sky and ground, and of the sun but for shadows; how much it mirrors; and how much of a
// lit room's light it sends out, against its albedo.
uint packed(float sky, float sun, float mirror, float glow) {
    vec4 rest = vec4(sky, sun, mirror, sqrt(glow * (1.0 / k_most_glow)));
    uvec4 bytes = uvec4(clamp(rest, 0.0, 1.0) * 255.0 + 0.5);
    return bytes.x | bytes.y << 8 | bytes.z << 16 | bytes.w << 24;
}
const uint k_plain = 0xffffu;  // of what sees all, mirrors nothing, and does not glow

// `root`: of the albedo; `kind`: k_kind_*; `rest`: packed().
void keep(vec3 root, vec3 normal, uint kind, uint rest) {
    uvec2 at = uvec2(flat_octahedron(normal) * 2047.0 + 2047.5);
    out_colour = vec4(root, 1);
    out_surface = uvec2(at.x | at.y << 12 | kind << 24, rest);
}
