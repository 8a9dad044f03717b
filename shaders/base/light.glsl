// Sun, shadow, sky and haze on surfaces.
#extension GL_EXT_control_flow_attributes : require
layout(set = 0, binding = k_binding_shadow) uniform sampler2DArrayShadow shadow_map;
layout(set = 0, binding = k_binding_lamps) uniform sampler2D lamp_map;

const float k_fine_texel = 3.0;  // pixels: shadow texels wider than this are filtered twice as wide

// How plainly people's shadows are seen at a place within the near map: they fade before the distance from where on
// nobody throws any.
float people_shown(vec3 place) {
    vec3 ray = place - frame.eye.xyz;
    return saturate(frame.people_shadows.x - frame.people_shadows.y * dot(ray, ray));
}

// How much of the sun reaches a place: a bilinear tap by one gather, with no way round it, for most lanes take it.
// `bias` is how far, in texels, the place is moved along its normal so that a surface does not shade itself.
float sunlit_once(vec3 place, vec3 normal, float bias) {
    if (k_light == k_light_plain) return 1.0;
    mat3 turn = mat3(frame.shadow_from_world);
    vec3 near = turn * place + frame.shadow_from_world[3].xyz;
    vec3 from_middle = abs(near - 0.5);
    bool is_near = max(from_middle.x, max(from_middle.y, from_middle.z)) < 0.495;
    vec3 at = near + turn * (normal * (bias * (is_near ? frame.shadow_texels.x : frame.shadow_texels.y)));
    at = is_near ? at : at * frame.far_scale.xyz + frame.far_offset.xyz;
    vec2 corner = at.xy * frame.shadow_texels.z - 0.5, base = floor(corner), f = corner - base;
    // The gather's corner between texels, so that rounding never picks another four. Its order: (0, 1), (1, 1),
    // (1, 0), (0, 0).
    float shown = people_shown(place);
    float layer = float(is_near ? (shown > 0.0 ? k_near_layer : k_still_layer) : k_far_layer);
    vec3 middle = vec3((base + 1.0) * frame.shadow_texels.w, layer);
    vec4 four = textureGather(shadow_map, middle, saturate(at.z));
    ONLY_IF(is_near && shown > 0.0 && shown < 1.0) {
        middle.z = float(k_still_layer);
        four = mix(textureGather(shadow_map, middle, saturate(at.z)), four, shown);
    }
    vec2 rows = mix(four.wz, four.xy, f.y), off = abs(at.xy - 0.5);
    return max(off.x, off.y) < 0.497 ? mix(rows.x, rows.y, f.x) : 1.0;  // beyond the far map all is lit
}

// The same by 3x3 bilinear taps, in four gathers over 4x4 texels, where texels are large on the picture. `facing` is
// the cosine to the sun: where it is not above 0 all is dark.
float sunlit(vec3 place, vec3 normal, float facing, float distance, float bias) {
    if (k_light == k_light_plain) return 1.0;
    mat3 turn = mat3(frame.shadow_from_world);
    vec3 near = turn * place + frame.shadow_from_world[3].xyz;
    vec3 from_middle = abs(near - 0.5);
    bool is_near = max(from_middle.x, max(from_middle.y, from_middle.z)) < 0.495;
    float texel = is_near ? frame.shadow_texels.x : frame.shadow_texels.y;
    vec3 at = near + turn * (normal * (bias * texel));
    at = is_near ? at : at * frame.far_scale.xyz + frame.far_offset.xyz;
    bool is_wide = texel > k_fine_texel * frame.ray_forward.w * distance;
    vec2 corner = at.xy * frame.shadow_texels.z - 0.5;
    vec2 base = floor(corner), f = corner - base;
    // The gathers' corners between texels, so that rounding never picks another four.
    float step = frame.shadow_texels.w, depth = saturate(at.z), shown = people_shown(place);
    float layer = float(is_near ? (shown > 0.0 ? k_near_layer : k_still_layer) : k_far_layer);
    bool is_fading = is_near && shown > 0.0 && shown < 1.0;  // each gather with people, and without
    vec2 first = (is_wide ? base : base + 1.0) * step;
    // Beyond the far map all is lit.
    vec2 off = abs(at.xy - 0.5);
    bool is_inside = max(off.x, off.y) < 0.497;
    int gathers = (facing <= 0.0 || !is_inside ? 0 : is_wide ? 4 : 1) << int(is_fading);
    float lit = 0.0;
    [[dont_unroll]] for (int pass = 0; pass < gathers; ++pass) {
        int i = pass >> int(is_fading);
        bool is_still = is_fading && (pass & 1) != 0;
        float share = is_fading ? (is_still ? 1.0 - shown : shown) : 1.0;
        float from = is_still ? float(k_still_layer) : layer;
        bvec2 is_second = bvec2((i & 1) != 0, i > 1);
        vec2 low = mix(1.0 - f, vec2(1), is_second), high = mix(is_wide ? vec2(1) : f, f, is_second);
        vec4 a = textureGather(shadow_map, vec3(first + mix(vec2(0), vec2(2.0 * step), is_second), from), depth);
        // Gather's order: (0, 1), (1, 1), (1, 0), (0, 0).
        lit += ((a.w * low.x + a.z * high.x) * low.y + (a.x * low.x + a.y * high.x) * high.y) * share;
    }
    return is_inside ? lit * (is_wide ? 1.0 / 9.0 : 1.0) : 1.0;
}

// Light of sky and ground.
vec3 ambient(vec3 normal) {
    vec4 n = vec4(normal, 1);
    return vec3(dot(frame.ambient[0], n), dot(frame.ambient[1], n), dot(frame.ambient[2], n));
}

// The lamp map's light and way to it at a place with a surface of this normal, less the higher above the ground.
vec3 lamps_at(vec3 place, vec3 normal) {
    vec2 before = place.xz + normal.xz * 0.7;  // out of the wall
    vec4 lamps = textureLod(lamp_map, before * frame.lamp_map.xy + frame.lamp_map.zw, 0.0);
    float above = max(place.y - lamps.w - 3.0, 0.0) * 0.4;
    return lamps.xyz * (1.0 / (1.0 + above * above));
}

// What a white surface reflects of it: some of it comes from all round.
vec3 lamplight(vec3 lamps, vec3 normal) {
    return frame.lamp_light.xyz * (max(dot(lamps, normal), 0.0) + 0.14 * min(length(lamps), 0.7));
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

// Aerial perspective: beyond some metres the air shines, and hides what is behind. `ray` is a unit vector.
vec3 through_air(vec3 light, vec3 ray, float distance) {
    if (k_light == k_light_plain) return light;
    float depth = max(distance - frame.haze_away.w, 0.0) * frame.haze_towards.w;
    float air = depth / (1.0 + depth);
    float towards = dot(ray.xz, frame.sun_direction.xz) * 0.5 + 0.5;
    return mix(light, mix(frame.haze_away.xyz, frame.haze_towards.xyz, towards * towards), air);
}
