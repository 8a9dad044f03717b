// Skinning by a palette of rotations and translations.
layout(std430, set = 0, binding = k_binding_instances) readonly buffer Instances { WalkerInstance instances[]; };
layout(std430, set = 0, binding = k_binding_palette) readonly buffer Palette { JointTransform palette[]; };

layout(constant_id = k_constant_bones) const int k_bones = 4;

vec3 rotate(vec4 q, vec3 v) {
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

vec3 moved_by(uint joint, vec3 v) { return rotate(palette[joint].rotation, v) + palette[joint].translation.xyz; }
