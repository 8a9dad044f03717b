#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common.glsl"
#include "shaders/light.glsl"

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

    // Cloth and skin let light round the edge a little; the rim catches the sky.
    float facing = dot(normal, frame.sun_direction.xyz);
    float wrapped = saturate((facing + 0.2) / 1.2);
    vec3 ray = in_place - frame.eye.xyz;
    float distance = length(ray);
    ray /= distance;
    float sun = wrapped * sunlit(in_place, normal, wrapped, distance, 1.5);
    float grazing = 1.0 - saturate(-dot(ray, normal));
    float rim = 0.06 * grazing * grazing * grazing;
    vec3 sky = ambient(normal);
    vec3 light = albedo * (frame.sun_light.xyz * sun + sky) + rim * (sky + frame.sun_light.xyz * (0.5 * sun));
    out_picture = picture(through_air(light, ray, distance));
}
