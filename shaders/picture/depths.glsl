// Places from the depths of a picture. To be included after common.glsl.
layout(set = 0, binding = k_binding_depth) uniform sampler2D depths;

// Metres ahead of the eye at a sample; huge where there is sky.
float ahead_at(ivec2 at) {
    float depth = texelFetch(depths, clamp(at, ivec2(0), textureSize(depths, 0) - 1), 0).x;
    return frame.clip_from_world[3].z / max(depth, 1e-7);
}
