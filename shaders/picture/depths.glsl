// Places from the depths of a picture with four samples. To be included after common.glsl.
layout(set = 0, binding = k_binding_depth) uniform sampler2DMS depths;

// Metres ahead of the eye; huge where there is sky.
float ahead_at(ivec2 pixel) {
    float depth = texelFetch(depths, clamp(pixel, ivec2(0), ivec2(frame.screen.xy) - 1), 0).x;
    return frame.clip_from_world[3].z / max(depth, 1e-7);
}
