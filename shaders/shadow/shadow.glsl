// Where things are on a shadow map.
layout(push_constant) uniform Push { mat4 map_from_world; };

layout(constant_id = k_constant_clamp) const int k_clamps = 0;

// What lies before the map throws its shadow from the map's near end.
vec4 on_map(vec3 place) {
    vec4 at = map_from_world * vec4(place, 1);
    return vec4(at.xy * 2.0 - 1.0, k_clamps == 1 ? max(at.z, 0.0) : at.z, 1);
}
