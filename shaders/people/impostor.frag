#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/light.glsl"
#include "shaders/people/person.glsl"
#include "shaders/people/impostor.glsl"

layout(set = 0, binding = k_binding_atlas) uniform usampler2D atlas;

layout(location = 0) centroid in vec2 in_texel;
layout(location = 1) in float in_lit;
layout(location = 2) flat in uint in_number;
layout(location = 3) flat in vec4 in_view;
layout(location = 4) flat in vec4 in_air;
layout(location = 5) flat in vec3 in_lamps;

layout(location = 0) out vec4 out_picture;

void main() {
    uint texel = texelFetch(atlas, ivec2(in_texel), 0).x;
    if (texel == k_empty_texel) discard;
    vec3 tint = linear_from_srgb(unpackUnorm4x8(impostors[in_number].tints[tint_of(texel)]).rgb);
    vec3 seen = normal_of(texel), normal = axes_of(in_view.xy, in_view.zw) * seen;
    float sun = wrapped(dot(normal, frame.sun_direction.xyz)) * in_lit;
    vec3 albedo = base_of(texel) * tint, light = light_from(albedo, normal, sun, seen.z);
    if (k_light == k_light_night) light += albedo * lamplight(in_lamps, normal);
    out_picture = picture(light * in_air.w + in_air.xyz);
}
