// Skinning by a palette of rotations and translations.
layout(std430, set = 0, binding = k_binding_instances) readonly buffer Instances { WalkerInstance instances[]; };
layout(std430, set = 0, binding = k_binding_palette) readonly buffer Palette { JointTransform palette[]; };

vec3 rotate(vec4 q, vec3 v) {
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

vec3 moved_by(uint joint, vec3 v) { return rotate(palette[joint].rotation, v) + palette[joint].translation.xyz; }

struct Skinned {
    vec3 place, normal;
};

// A vertex moved by four of the joints from palette[first] on.
Skinned skinned(uint first, vec3 v, vec3 normal, uvec4 joints, vec4 weights) {
    uint joint = first + joints.x;
    vec4 turn = palette[joint].rotation;
    vec3 place = weights.x * moved_by(joint, v);
    vec4 own = turn;
    turn *= weights.x;
    for (int k = 1; k < 4; ++k) {
        uint other = first + joints[k];
        vec4 q = palette[other].rotation;
        place += weights[k] * (rotate(q, v) + palette[other].translation.xyz);
        turn += weights[k] * (dot(own, q) < 0.0 ? -q : q);
    }
    return Skinned(place, rotate(normalize(turn), normal));
}
