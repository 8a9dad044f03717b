#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/views/paint.glsl"

layout(location = 0) in vec3 in_place;
layout(location = 1) in vec4 in_colour;
layout(location = 3) in vec4 in_normal;
layout(location = 6) in vec4 in_id;

layout(location = 0) out vec4 out_colour;

void main() {
    out_colour = painted(in_normal.xyz, paint == k_paint_ids ? in_id.rgb : in_colour.rgb,
                         in_place - frame.eye.xyz);
    gl_Position = nearer(frame.clip_from_world * vec4(in_place, 1));
}
