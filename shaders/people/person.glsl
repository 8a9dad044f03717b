// Light on people, to be included after light.glsl. Cloth and skin let light round the edge a little; the rim
// catches the sky.

// How much of the sun a surface takes whose normal has this cosine to it.
float wrapped(float facing) { return saturate((facing + 0.2) / 1.2); }

// `sun`: wrapped(), less what is in shadow; `towards`: the cosine between normal and viewer. Plain light has no rim.
vec3 light_from(vec3 albedo, vec3 normal, float sun, float towards) {
    float grazing = k_light == k_light_plain ? 0.0 : 1.0 - saturate(towards);
    float rim = 0.06 * grazing * grazing * grazing;
    vec3 sky = ambient(normal);
    return albedo * (frame.sun_light.xyz * sun + sky) + rim * (sky + frame.sun_light.xyz * (0.5 * sun));
}
