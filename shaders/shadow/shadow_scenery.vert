#version 460

layout(push_constant) uniform Push { mat4 map_from_world; };
layout(location = 0) in vec3 in_place;
layout(location = 2) in vec2 in_uv;
layout(location = 4) in uvec2 in_material;  // k_material_scenery, layer

layout(location = 0) out vec2 out_uv;
layout(location = 1) flat out uint out_layer;

void main() {
    vec4 at = map_from_world * vec4(in_place, 1);
    out_uv = in_uv;
    out_layer = in_material.y;
    gl_Position = vec4(at.xy * 2.0 - 1.0, at.z, 1);
}
