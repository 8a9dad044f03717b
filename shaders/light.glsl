// Sun, shadow, sky and haze on surfaces.
layout(set = 0, binding = k_binding_shadow) uniform sampler2DArrayShadow shadow_map;

// How much of the sun reaches a place: 3x3 bilinear taps by four gathers over 4x4 texels. `bias` is how far, in
// texels, the place is moved along its normal so that a surface does not shade itself.
float sunlit(vec3 place, vec3 normal, float bias) {
    vec3 near = (frame.shadow_from_world * vec4(place, 1)).xyz;
    vec3 from_middle = abs(near - 0.5);
    bool is_near = max(from_middle.x, max(from_middle.y, from_middle.z)) < 0.495;
    float texel = is_near ? frame.shadow_texels.x : frame.shadow_texels.y;
    vec3 moved = (frame.shadow_from_world * vec4(place + normal * (bias * texel), 1)).xyz;
    vec3 at = is_near ? moved : moved * frame.far_scale.xyz + frame.far_offset.xyz;
    vec2 corner = at.xy * frame.shadow_texels.z - 0.5;
    vec2 base = floor(corner), f = corner - base;
    // The gathers' corners between texels, so that rounding never picks another four.
    vec3 uv = vec3(base * frame.shadow_texels.w, is_near ? 0.0 : 1.0);
    float depth = saturate(at.z);
    float step = frame.shadow_texels.w;
    vec4 a = textureGather(shadow_map, uv, depth);
    vec4 b = textureGather(shadow_map, uv + vec3(2.0 * step, 0, 0), depth);
    vec4 c = textureGather(shadow_map, uv + vec3(0, 2.0 * step, 0), depth);
    vec4 d = textureGather(shadow_map, uv + vec3(2.0 * step, 2.0 * step, 0), depth);
    // Gather's order: (0, 1), (1, 1), (1, 0), (0, 0).
    vec4 row0 = vec4(a.wz, b.wz), row1 = vec4(a.xy, b.xy), row2 = vec4(c.wz, d.wz), row3 = vec4(c.xy, d.xy);
    vec4 columns = vec4(1.0 - f.x, 1, 1, f.x);
    vec4 rows = row0 * (1.0 - f.y) + row1 + row2 + row3 * f.y;
    float lit = dot(columns, rows) * (1.0 / 9.0);
    // Beyond the far map all is lit.
    vec2 off = abs(at.xy - 0.5);
    return max(off.x, off.y) < 0.497 ? lit : 1.0;
}

// Light of sky and ground.
vec3 ambient(vec3 normal) {
    vec4 n = vec4(normal, 1);
    return vec3(dot(frame.ambient[0], n), dot(frame.ambient[1], n), dot(frame.ambient[2], n));
}

// Sky near the horizon and overhead, simple enough for reflections.
vec3 sky_towards(vec3 direction) {
    float towards = dot(direction.xz, frame.sun_direction.xz) * 0.5 + 0.5;
    vec3 horizon = mix(frame.haze_away.xyz, frame.haze_towards.xyz, towards * towards);
    return mix(horizon, frame.zenith.xyz, saturate(direction.y * 1.4));
}

// What glass in a street mirrors: the houses opposite, and the sky above them.
vec3 street_towards(vec3 direction) {
    vec3 houses = 0.22 * ambient(-direction) + 0.05 * frame.sun_light.xyz;
    return mix(houses, sky_towards(direction), smoothstep(0.12, 0.55, direction.y));
}

// Aerial perspective: beyond some metres the air shines, and hides what is behind.
vec3 through_air(vec3 light, vec3 place) {
    vec3 ray = place - frame.eye.xyz;
    float distance = length(ray);
    float depth = max(distance - frame.haze_away.w, 0.0) * frame.haze_towards.w;
    float air = depth / (1.0 + depth);
    float towards = dot(ray.xz, frame.sun_direction.xz) / max(distance, 1e-3) * 0.5 + 0.5;
    return mix(light, mix(frame.haze_away.xyz, frame.haze_towards.xyz, towards * towards), air);
}
