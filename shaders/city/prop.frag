#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/light.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec3 in_normal;
layout(location = 2) flat in vec4 in_colour;

layout(location = 0) out vec4 out_picture;

// Trees and street furniture: many small triangles, of which a CPU shades whole blocks of pixels; so little is done
// for each.
void main() {
    vec3 normal = normalize(in_normal);
    vec3 ray = in_place - frame.eye.xyz;
    float inverse = inversesqrt(dot(ray, ray)), distance = inverse * dot(ray, ray);
    ray *= inverse;
    float facing = dot(normal, frame.sun_direction.xyz);
    float sun = saturate(facing) * sunlit_once(in_place, normal, 2.0);
    vec3 light = in_colour.rgb * (frame.sun_light.xyz * sun + ambient(normal));
    if (k_light == k_light_night) light += in_colour.rgb * lamplight(lamps_at(in_place, normal), normal);
    if (in_colour.w > 0.0) {
        float grazing = 1.0 - saturate(-dot(ray, normal));
        grazing *= grazing;
        light = mix(light, sky_towards(reflect(ray, normal)),
                    min(in_colour.w, 0.08) * (0.1 + 0.9 * grazing * grazing));
    }
    if (k_light == k_light_night && in_colour.w > 1.0) light = frame.window_light.xyz * 6.0;
    out_picture = picture(through_air(light, ray, distance));
}
