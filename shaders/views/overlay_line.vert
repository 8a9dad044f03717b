#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"

layout(location = 0) in vec4 in_a;  // metres, or shares of the picture; radius, metres
layout(location = 1) in vec4 in_b;
layout(location = 2) in vec4 in_shifts;  // of a and of b, pixels
layout(location = 3) in float in_pixels;
layout(location = 4) in vec4 in_colour;
layout(location = 5) in uint in_place;  // GizmoPlace

layout(location = 0) out vec2 out_at;  // pixels along the line from a, and across
layout(location = 1) flat out vec4 out_shape;  // length, radii at a and b, roundness; pixels
layout(location = 2) flat out vec4 out_colour;

layout(push_constant) uniform Push { float shown; };  // 1, or how much is left of lines behind things

const uint k_in_world_hidden = 1u, k_on_picture = 2u;
const vec2 k_corners[6] = {vec2(0, -1), vec2(0, 1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(1, -1)};
const float k_pull = 0.03, k_far_pull = 0.004;  // nearer to the eye: metres, and a share of the distance
const float k_nearest = 0.12;                   // metres ahead of the eye

struct End {
    vec2 at;  // pixels
    float depth, radius;
};

End end_of(vec4 clip, vec2 shift, float radius) {
    End end;
    end.at = (clip.xy / clip.w * 0.5 + 0.5) * frame.screen.xy + shift;
    end.depth = min(clip.z / max(clip.w * (1.0 - k_far_pull) - k_pull, 0.5 * clip.w), 1.0);
    end.radius = max(radius / (frame.ray_forward.w * clip.w), 0.5 * in_pixels);
    return end;
}

void main() {
    out_colour = in_colour;
    out_colour.a *= shown;
    End a, b;
    bool is_seen = true;
    if (in_place == k_on_picture) {
        a = End(in_a.xy * frame.screen.xy + in_shifts.xy, 1.0, 0.5 * in_pixels);
        b = End(in_b.xy * frame.screen.xy + in_shifts.zw, 1.0, 0.5 * in_pixels);
    } else {
        vec4 clip_a = frame.clip_from_world * vec4(in_a.xyz, 1);
        vec4 clip_b = frame.clip_from_world * vec4(in_b.xyz, 1);
        is_seen = max(clip_a.w, clip_b.w) > k_nearest;
        float along = (k_nearest - clip_a.w) / (clip_b.w - clip_a.w);
        if (clip_a.w < k_nearest) clip_a = mix(clip_a, clip_b, along);
        else if (clip_b.w < k_nearest) clip_b = mix(clip_a, clip_b, along);
        a = end_of(clip_a, in_shifts.xy, in_a.w);
        b = end_of(clip_b, in_shifts.zw, in_b.w);
        if (shown < 1.0 && in_place == k_in_world_hidden) is_seen = false;
    }
    vec2 way = b.at - a.at;
    float span = length(way);
    way = span > 1e-3 ? way / span : vec2(1, 0);
    vec2 corner = k_corners[gl_VertexIndex];
    float reach = max(a.radius, b.radius) + 1.0;
    out_at = vec2(mix(-reach, span + reach, corner.x), corner.y * reach);
    out_shape = vec4(span, a.radius, b.radius, in_a.w + in_b.w > 0.0 ? 1.0 : 0.0);
    vec2 at = (a.at + way * out_at.x + vec2(-way.y, way.x) * out_at.y) / frame.screen.xy * 2.0 - 1.0;
    gl_Position = is_seen ? vec4(at, mix(a.depth, b.depth, corner.x), 1) : vec4(0, 0, -1, 1);
}
