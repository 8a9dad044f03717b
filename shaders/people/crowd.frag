#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/light.glsl"
#include "shaders/people/person.glsl"

layout(constant_id = k_constant_textured) const int k_textured = 0;
layout(set = 0, binding = k_binding_textures) uniform sampler2DArray textures;

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec3 in_colour;
layout(location = 3) in vec2 in_uv;
layout(location = 4) flat in uint in_layer;

layout(location = 0) out vec4 out_picture;

void main() {
    vec3 normal = normalize(in_normal);
    vec3 albedo = in_colour;
    if (k_textured == 1) {
        vec4 texel = texture(textures, vec3(in_uv, float(in_layer)));
        if (texel.a < 0.5) discard;
        albedo *= texel.rgb;
    }

    vec3 ray = in_place - frame.eye.xyz;
    float distance = length(ray);
    ray /= distance;
    float sun = wrapped(dot(normal, frame.sun_direction.xyz));
    sun *= sunlit_once(in_place, normal, 1.5);
    vec3 light = light_from(albedo, normal, sun, -dot(ray, normal));
    if (k_light == k_light_night) light += albedo * lamplight(lamps_at(in_place, vec3(0)), normal);
    out_picture = picture(through_air(light, ray, distance));
}
