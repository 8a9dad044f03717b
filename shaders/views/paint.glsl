// What the views for work paint instead of light; display-ready.
layout(push_constant) uniform Push { uint paint; };

const float k_ink_pull = 0.004;  // share of its distance that ink is nearer than its paper

// `own`: what the surface is painted with, sRGB; `ray`: from the eye to it.
vec4 painted(vec3 normal, vec3 own, vec3 ray) {
    if (paint == k_paint_normals) return vec4(normal * 0.5 + 0.5, 1);
    if (paint == k_paint_ids) return vec4(own, 1);
    if (paint == k_paint_count) return vec4(0.16, 0.08, 0.035, 0);
    if (paint == k_paint_ink) return vec4(own * 0.5, 1);
    if (paint == k_paint_paper) {
        float light = 0.86 + 0.09 * normal.y + 0.05 * normal.x;
        return vec4(mix(vec3(light), own, 0.2), 1);
    }
    float edge = 1.0 - abs(dot(normalize(ray), normal));
    return vec4(mix(own, vec3(0.85, 0.92, 1.0), 0.65), 0.10 + 0.6 * edge * edge * edge);
}

vec4 nearer(vec4 at) {
    if (paint == k_paint_ink) at.z *= 1.0 + k_ink_pull;
    return at;
}
