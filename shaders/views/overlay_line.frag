#version 460

layout(location = 0) in vec2 in_at;
layout(location = 1) flat in vec4 in_shape;
layout(location = 2) flat in vec4 in_colour;

layout(location = 0) out vec4 out_picture;

// A line with round ends that may taper; rods of some radius are shaded as if round.
void main() {
    float along = clamp(in_at.x, 0.0, in_shape.x);
    float radius = mix(in_shape.y, in_shape.z, in_shape.x > 0.0 ? along / in_shape.x : 0.0);
    float from_middle = length(vec2(in_at.x - along, in_at.y));
    float cover = clamp(radius - from_middle + 0.5, 0.0, 1.0) * min(2.0 * radius, 1.0);
    float bulge = clamp(1.0 - from_middle * from_middle / (radius * radius), 0.0, 1.0);
    float shade = mix(1.0, 0.55 + 0.45 * sqrt(bulge), in_shape.w * clamp(radius - 1.0, 0.0, 1.0));
    out_picture = vec4(in_colour.rgb * shade, in_colour.a * cover);
}
