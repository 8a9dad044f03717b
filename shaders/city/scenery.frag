#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/light.glsl"

layout(set = 0, binding = k_binding_scenery) uniform sampler2DArray pictures;

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec2 in_uv;
layout(location = 4) flat in uint in_layer;

layout(location = 0) out vec4 out_picture;

void main() {
    vec4 texel = texture(pictures, vec3(in_uv, float(in_layer)));
    if (texel.a < 0.5) discard;
    vec3 albedo = in_colour * texel.rgb;

    vec3 normal = normalize(in_normal);
    vec3 ray = in_place - frame.eye.xyz;
    float distance = length(ray);
    ray /= distance;
    float facing = dot(normal, frame.sun_direction.xyz);
    float sun = saturate(facing) * sunlit_once(in_place, normal, 2.0);
    vec3 light = albedo * (frame.sun_light.xyz * sun + ambient(normal));
    if (k_light == k_light_night) light += albedo * lamplight(lamps_at(in_place, normal), normal);
    out_picture = picture(through_air(light, ray, distance));
}
