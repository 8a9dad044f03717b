// Light on people, to be included after light.glsl. Cloth and skin let light round the edge a little; the rim
// catches the sky. `shaded` is where the sun's shadow is looked up.
vec4 lit_person(vec3 place, vec3 shaded, vec3 normal, vec3 albedo) {
    float facing = dot(normal, frame.sun_direction.xyz);
    float wrapped = saturate((facing + 0.2) / 1.2);
    vec3 ray = place - frame.eye.xyz;
    float distance = length(ray);
    ray /= distance;
    float sun = wrapped * sunlit(shaded, normal, wrapped, distance, 1.5);
    float grazing = 1.0 - saturate(-dot(ray, normal));
    float rim = 0.06 * grazing * grazing * grazing;
    vec3 sky = ambient(normal);
    vec3 light = albedo * (frame.sun_light.xyz * sun + sky) + rim * (sky + frame.sun_light.xyz * (0.5 * sun));
    return picture(through_air(light, ray, distance));
}
