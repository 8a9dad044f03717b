// Light on what a picture shows, written once for GLSL and for C++ over lanes: a pixel is lit by a shader
// where the device is a GPU, and by the host where it is a CPU, to the same colours. The words are those of
// both languages and of dialect.glsl; numbers are `real`, of which C++ has many at once, so an `if` asks for
// some() and what depends on a pixel goes through select(). Only + - x / sqrt, min, max, abs and floor, which
// a CPU's lanes and its Vulkan driver round alike; a GPU may round quotients and roots otherwise, so nothing
// jumps where a number differs by its last bit, but for the choice of edges to smooth.
//
// Whoever includes it has `frame` and these, of whole numbers:
//   Block shadow_texels(real layer, real x, real y)  four rows of four of the shadow map from x and y on,
//   0..65535 Lamp lamp_texel(real x, real y)                   of the lamp map, nothing beyond its edges
//   real3 sky_corner(real column, real row)           of the sky's grid

// One sample of the picture as it is kept: bytes, and a normal's numbers 0..4094.
struct Kept {
    real red, green, blue, open, normal_u, normal_v, kind, sky, sun, mirror, glow, depth;
};

// Quotients are products with it, to which drivers turn them anyway.
SHARED real inverse(real x) { return real(1.0f) / x; }
SHARED real inner(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }  // summed in this order
SHARED real square(real x) { return x * x; }
SHARED truth is_kind(Kept kept, uint kind) { return abs(kept.kind - real(float(kind))) < real(0.5f); }
// Where there is no surface, what else was kept says nothing, but at night.
SHARED truth is_nothing(Kept kept) { return kept.depth <= real(0.0f); }
SHARED real inverse_length(real3 v) { return inverse(sqrt(max(inner(v, v), real(1e-20f)))); }
SHARED real3 scaled(vec4 v, real by) { return make3(real(v.x) * by, real(v.y) * by, real(v.z) * by); }
SHARED real3 reflected(real3 ray, real3 normal) { return ray - normal * (real(2.0f) * inner(ray, normal)); }

// The sRGB numbers of light by Hejl and Burgess-Dawson's filmic curve (2010), its black point left at black.
SHARED real toned(real x) {
    return x * (real(6.2f) * x + real(0.5f)) * inverse(x * (real(6.2f) * x + real(1.7f)) + real(0.06f));
}
SHARED real3 tone_curve(real3 light) {
    real grey = (light.x * real(0.2126f) + light.y * real(0.7152f) + light.z * real(0.0722f)) * real(0.16f);
    real3 x = light * real(0.84f) + make3(grey, grey, grey);
    return make3(toned(x.x), toned(x.y), toned(x.z));
}

// A place on the picture, 0..1, as a ray that is 1 metre long along the way ahead.
SHARED real3 ray_through(real u, real v) {
    return scaled(frame.ray_forward, real(1.0f)) + scaled(frame.ray_right, u * real(2.0f) - real(1.0f)) +
           scaled(frame.ray_down, v * real(2.0f) - real(1.0f));
}

SHARED real3 normal_of(Kept kept) {
    real x = (kept.normal_u - real(2047.0f)) * real(1.0f / 2047.0f);
    real z = (kept.normal_v - real(2047.0f)) * real(1.0f / 2047.0f);
    real y = real(1.0f) - abs(x) - abs(z), below = max(real(0.0f) - y, real(0.0f));
    real3 n = make3(x + select(x < real(0.0f), below, real(0.0f) - below), y,
                    z + select(z < real(0.0f), below, real(0.0f) - below));
    return n * inverse_length(n);
}

// Shadows

// How much of a filter lies on each of four texels, which reaches from within the first two to within the
// last two.
struct Taps {
    real a, b, c, d;
};
SHARED Taps taps_between(real low, real high) {
    Taps t;
    t.a = real(1.0f) - saturate(low);
    t.b = real(1.0f) - saturate(low - real(1.0f));
    t.c = saturate(high - real(2.0f));
    t.d = saturate(high - real(3.0f));
    return t;
}
// Whether something is lit past a texel, softly over two steps of the map; `from` is 1 - half its depth.
SHARED real is_past(real texel, real from) { return saturate(texel * real(0.5f) + from); }
SHARED real row_lit(Row row, Taps across, real from) {
    return is_past(row.a, from) * across.a + is_past(row.b, from) * across.b +
           is_past(row.c, from) * across.c + is_past(row.d, from) * across.d;
}

// How much of the sun reaches a place on a map, filtered `width` texels wide, 1..3.
SHARED real map_lit(real layer, real3 at, real width) {
    real resolution = real(frame.shadow_texels.z), last = resolution - real(4.0f);
    real x = at.x * resolution, y = at.y * resolution;
    real left = min(max(floor(x - real(1.5f)), real(0.0f)), last);
    real top = min(max(floor(y - real(1.5f)), real(0.0f)), last);
    real reach = width * real(0.5f), from = real(1.0f) - saturate(at.z) * real(32767.5f);
    Taps across = taps_between(x - left - reach, x - left + reach);
    Taps down = taps_between(y - top - reach, y - top + reach);
    Block four = shadow_texels(layer, left, top);
    real lit = row_lit(four.a, across, from) * down.a + row_lit(four.b, across, from) * down.b +
               row_lit(four.c, across, from) * down.c + row_lit(four.d, across, from) * down.d;
    return lit * inverse(width * width);
}

SHARED real from_middle(real3 at) {
    return max(abs(at.x - real(0.5f)), max(abs(at.y - real(0.5f)), abs(at.z - real(0.5f))));
}

// The same in both maps, which fade into each other and, where the far one ends, into light. `bias` is how
// far, in texels, the place is moved along its normal so that a surface does not shade itself.
SHARED real sunlit(real3 place, real3 normal, real bias, real distance) {
    real3 at = scaled(frame.shadow_from_world[0], place.x) + scaled(frame.shadow_from_world[1], place.y) +
               scaled(frame.shadow_from_world[2], place.z) + scaled(frame.shadow_from_world[3], real(1.0f));
    real3 along = scaled(frame.shadow_from_world[0], normal.x) +
                  scaled(frame.shadow_from_world[1], normal.y) + scaled(frame.shadow_from_world[2], normal.z);
    real near_share = saturate((real(0.495f) - from_middle(at)) * real(50.0f));
    truth is_near = near_share > real(0.0f);
    // People's shadows fade before the distance from where on nobody throws any.
    real people = saturate(real(frame.people_shadows.x) - real(frame.people_shadows.y) * square(distance));
    real layer =
        select(is_near, select(people > real(0.0f), real(frame.shadow_layers.x), real(frame.shadow_layers.y)),
               real(frame.shadow_layers.z));
    // They are filtered the wider the larger they are on the picture.
    real pixels = inverse(real(frame.ray_forward.w) * distance * real(1.5f));
    real near_width = min(max(real(frame.shadow_texels.x) * pixels, real(1.0f)), real(3.0f));
    real far_width = min(max(real(frame.shadow_texels.y) * pixels, real(1.0f)), real(3.0f));
    real3 near = at + along * (bias * real(frame.shadow_texels.x));
    real3 far = at + along * (bias * real(frame.shadow_texels.y));
    far = make3(far.x * real(frame.far_scale.x) + real(frame.far_offset.x),
                far.y * real(frame.far_scale.y) + real(frame.far_offset.y),
                far.z * real(frame.far_scale.z) + real(frame.far_offset.z));
    real lit = map_lit(layer, select(is_near, near, far), select(is_near, near_width, far_width));
    truth is_fading = both(is_near, both(people > real(0.0f), people < real(1.0f)));
    if (some(is_fading))
        lit =
            select(is_fading, lerp(map_lit(real(frame.shadow_layers.y), near, near_width), lit, people), lit);
    real beyond = max(abs(far.x - real(0.5f)), abs(far.y - real(0.5f)));
    real far_share = saturate((real(0.497f) - beyond) * real(50.0f));
    lit = select(is_near, lit, lerp(real(1.0f), lit, far_share));
    truth is_both = both(is_near, near_share < real(1.0f));
    if (some(is_both)) {
        real far_lit = lerp(real(1.0f), map_lit(real(frame.shadow_layers.z), far, far_width), far_share);
        lit = select(is_both, lerp(far_lit, lit, near_share), lit);
    }
    return lit;
}

// Sky, lamps, air

// What a white surface reflects of sky and ground.
SHARED real ambient_of(vec4 colour, real3 normal) {
    return real(colour.x) * normal.x + real(colour.y) * normal.y + real(colour.z) * normal.z + real(colour.w);
}
SHARED real3 ambient(real3 normal) {
    return make3(ambient_of(frame.ambient[0], normal), ambient_of(frame.ambient[1], normal),
                 ambient_of(frame.ambient[2], normal));
}

// What a white surface reflects of the lamps about a place, less the higher above the ground; some of it
// comes from all round. Walls are lit by what the map says before them.
SHARED real3 lamplight(real3 place, real3 normal, real before) {
    real u = ((place.x + normal.x * before) * real(frame.lamp_map.x) + real(frame.lamp_map.z)) - real(0.5f);
    real v = ((place.z + normal.z * before) * real(frame.lamp_map.y) + real(frame.lamp_map.w)) - real(0.5f);
    real x = floor(u), y = floor(v), s = u - x, t = v - y;
    Lamp a = lamp_texel(x, y), b = lamp_texel(x + real(1.0f), y);
    Lamp c = lamp_texel(x, y + real(1.0f)), d = lamp_texel(x + real(1.0f), y + real(1.0f));
    real3 lamps = lerp(lerp(a.light, b.light, s), lerp(c.light, d.light, s), t);
    real ground = lerp(lerp(a.ground, b.ground, s), lerp(c.ground, d.ground, s), t);
    real height = place.y - ground, above = max(height - real(3.0f), real(0.0f)) * real(0.4f);
    lamps = lamps * inverse(real(1.0f) + above * above);
    // From above the lamps they shine up.
    lamps = make3(lamps.x, lamps.y * (real(1.0f) - real(2.0f) * saturate((height - real(3.5f)) * real(0.3f))),
                  lamps.z);
    real length = sqrt(inner(lamps, lamps));
    return scaled(frame.lamp_light,
                  max(inner(lamps, normal), real(0.0f)) + real(0.14f) * min(length, real(0.7f)));
}

// How much a level way leads towards the sun, 0..1, squared.
SHARED real sunward(real3 way) {
    return square((way.x * real(frame.sun_direction.x) + way.z * real(frame.sun_direction.z)) * real(0.5f) +
                  real(0.5f));
}

// Sky near the horizon and overhead, simple enough for reflections.
SHARED real3 sky_towards(real3 way) {
    real3 horizon =
        lerp(scaled(frame.haze_away, real(1.0f)), scaled(frame.haze_towards, real(1.0f)), sunward(way));
    return lerp(horizon, scaled(frame.zenith, real(1.0f)), saturate(way.y * real(1.4f)));
}

// What glass in a street mirrors: the houses opposite, and the sky above them.
SHARED real3 street_towards(real3 way) {
    real3 houses = ambient(make3(real(0.0f) - way.x, real(0.0f) - way.y, real(0.0f) - way.z)) * real(0.22f) +
                   scaled(frame.sun_light, real(0.05f));
    real up = saturate((way.y - real(0.12f)) * real(1.0f / 0.43f));
    return lerp(houses, sky_towards(way), up * up * (real(3.0f) - real(2.0f) * up));
}

// Beyond some metres the air shines, and hides what is behind. `ray` is a unit vector.
SHARED real3 through_air(real3 light, real3 ray, real distance) {
    real depth = max(distance - real(frame.haze_away.w), real(0.0f)) * real(frame.haze_towards.w);
    real3 air =
        lerp(scaled(frame.haze_away, real(1.0f)), scaled(frame.haze_towards, real(1.0f)), sunward(ray));
    return lerp(light, air, depth * inverse(real(1.0f) + depth));
}

// What lies at infinity: the grid's light, and the sun's disc, softened. At night surfaces' red holds stars,
// and green noise, without which dark skies show bands.
SHARED real3 sky_seen(Kept kept, real u, real v, real3 ray) {
    real x = u * real(float(k_sky_columns)), y = v * real(float(k_sky_rows));
    real column = min(floor(x), real(float(k_sky_columns - 1))),
         row = min(floor(y), real(float(k_sky_rows - 1)));
    real s = x - column, t = y - row;
    real3 above = lerp(sky_corner(column, row), sky_corner(column + real(1.0f), row), s);
    real3 below =
        lerp(sky_corner(column, row + real(1.0f)), sky_corner(column + real(1.0f), row + real(1.0f)), s);
    real3 light = lerp(above, below, t);
    real towards = (ray.x * real(frame.sun_direction.x) + ray.y * real(frame.sun_direction.y) +
                    ray.z * real(frame.sun_direction.z)) *
                   inverse_length(ray);
    real disc = saturate((towards - real(0.99985f)) * real(12000.0f)) * real(frame.sun_light.w);
    real star = kept.red * (real(0.5f / 255.0f) * real(frame.window_light.w));
    light = light + scaled(frame.sun_light, disc) + make3(star, star, star);
    real noise = (kept.green - real(127.5f)) * (real(1.0f / 65025.0f) * real(frame.way.x));
    return tone_curve(light) + make3(noise, noise, noise);
}

// What a surface sends to the eye.
SHARED real3 surface_lit(Kept kept, real3 ray, real distance, real3 place) {
    real3 normal = normal_of(kept);
    real3 albedo = make3(square(kept.red), square(kept.green), square(kept.blue)) * real(1.0f / 65025.0f);
    truth is_ground = is_kind(kept, k_kind_ground), is_wall = is_kind(kept, k_kind_wall);
    truth is_impostor = is_kind(kept, k_kind_impostor);
    truth is_body = either(is_impostor, is_kind(kept, k_kind_person));
    real facing = normal.x * real(frame.sun_direction.x) + normal.y * real(frame.sun_direction.y) +
                  normal.z * real(frame.sun_direction.z);
    // Cloth and skin let light round the edge a little.
    real sun = select(is_body, saturate((facing + real(0.2f)) * real(1.0f / 1.2f)), saturate(facing));
    sun = sun * kept.sun * real(1.0f / 255.0f);
    real towards = real(0.0f) - inner(ray, normal), grazing = real(1.0f) - saturate(towards);
    real3 sky = ambient(normal);
    if (frame.way.y > 0.0f)
        return albedo * (scaled(frame.sun_light, sun) + sky * (kept.sky * real(1.0f / 255.0f)));
    if (some(sun > real(0.0f))) {
        real bias = select(is_ground,
                           real(0.25f) + real(2.0f) * saturate(real(1.0f) - normal.y) *
                                             (real(1.0f) - real(0.4f) * saturate(facing)),
                           select(is_body, real(1.5f), real(2.0f)));
        // Pictures of bodies stand in the shadows that they throw: a girth towards the sun leads out of them.
        real girth = select(is_impostor, real(0.3f), real(0.0f));
        real3 before = place + scaled(frame.sun_direction, girth);
        sun = sun * sunlit(before, normal, select(is_impostor, real(0.0f), bias), distance);
    }
    real3 sunlight = scaled(frame.sun_light, sun);
    real3 arriving = sunlight + sky * (kept.sky * real(1.0f / 255.0f));
    if (frame.way.x > 0.0f) {
        real before = select(is_body, real(0.0f), real(0.7f));
        arriving = arriving + lamplight(place, normal, before) * (kept.sun * real(1.0f / 255.0f));
        arriving = arriving + scaled(frame.window_light, square(kept.glow) * real(k_most_glow / 65025.0f));
    }
    if (some(kept.glow > real(250.0f))) {
        // Lenses that are lit are seen by day too; windows are of walls.
        real seen = select(is_kind(kept, k_kind_thing),
                           select(kept.glow > real(250.0f), real(1.3f), real(0.0f)), real(0.0f));
        arriving = arriving + make3(seen, seen, seen);
    }
    real3 light = albedo * arriving;
    // The rim of bodies catches the sky.
    if (some(is_body)) {
        real rim = select(is_body, real(0.06f) * grazing * grazing * grazing, real(0.0f));
        light = light + (sky + sunlight * real(0.5f)) * rim;
    }
    if (some(kept.mirror > real(0.0f))) {
        real mirror = kept.mirror * real(1.0f / 255.0f), steep = square(square(grazing));
        real3 way = reflected(ray, normal);
        real3 glassy = light + street_towards(make3(way.x, max(way.y, real(0.0f)), way.z)) *
                                   (mirror * (real(0.09f) + real(0.91f) * steep * grazing));
        real3 wet = lerp(light, sky_towards(way), mirror * (real(0.1f) + real(0.9f) * steep));
        light = select(is_wall, glassy, wet);
    }
    // Of the colour that is shown, whose square is about its light; the air before it stays as bright.
    return through_air(light * square(kept.open * real(1.0f / 255.0f)), ray, distance);
}

// The display-ready colour of a sample at a place on the picture, 0..1.
SHARED real3 colour_seen(Kept kept, real u, real v) {
    if (frame.way.z > 0.0f) return make3(kept.red, kept.green, kept.blue) * real(1.0f / 255.0f);
    real3 way = ray_through(u, v);
    truth is_sky = is_nothing(kept);
    real3 colour = make3(real(0.0f), real(0.0f), real(0.0f));
    if (some(kept.depth > real(0.0f))) {
        real ahead = real(frame.clip_from_world[3].z) * inverse(max(kept.depth, real(1e-7f)));
        real distance = ahead * sqrt(inner(way, way));
        real3 place = way * ahead + scaled(frame.eye, real(1.0f));
        colour = tone_curve(surface_lit(kept, way * inverse_length(way), distance, place));
    }
    if (some(is_sky)) {
        real3 sky = frame.backdrop.w > 0.0f ? scaled(frame.backdrop, real(1.0f)) : sky_seen(kept, u, v, way);
        colour = select(is_sky, sky, colour);
    }
    return colour;
}

// Pixels of four samples, in two rows

SHARED real least(real a, real b, real c, real d) { return min(min(a, b), min(c, d)); }
SHARED real most(real a, real b, real c, real d) { return max(max(a, b), max(c, d)); }
SHARED real spread(real a, real b, real c, real d) { return most(a, b, c, d) - least(a, b, c, d); }

// Whether samples lie on one surface, so that the pixel may be lit once.
SHARED truth is_one_surface(Kept a, Kept b, Kept c, Kept d) {
    truth is_level = both(spread(a.normal_u, b.normal_u, c.normal_u, d.normal_u) < real(200.0f),
                          spread(a.normal_v, b.normal_v, c.normal_v, d.normal_v) < real(200.0f));
    truth is_close =
        spread(a.depth, b.depth, c.depth, d.depth) <= real(0.03f) * most(a.depth, b.depth, c.depth, d.depth);
    truth is_one = both(both(is_level, is_close), spread(a.kind, b.kind, c.kind, d.kind) < real(0.5f));
    return either(is_one, most(a.depth, b.depth, c.depth, d.depth) <= real(0.0f));
}

SHARED real mean(real a, real b, real c, real d) { return ((a + b) + (c + d)) * real(0.25f); }
SHARED real3 mean(real3 a, real3 b, real3 c, real3 d) { return ((a + b) + (c + d)) * real(0.25f); }
SHARED Kept mean(Kept a, Kept b, Kept c, Kept d) {
    Kept m;
    m.red = mean(a.red, b.red, c.red, d.red);
    m.green = mean(a.green, b.green, c.green, d.green);
    m.blue = mean(a.blue, b.blue, c.blue, d.blue);
    m.open = mean(a.open, b.open, c.open, d.open);
    m.normal_u = mean(a.normal_u, b.normal_u, c.normal_u, d.normal_u);
    m.normal_v = mean(a.normal_v, b.normal_v, c.normal_v, d.normal_v);
    m.kind = mean(a.kind, b.kind, c.kind, d.kind);
    m.sky = mean(a.sky, b.sky, c.sky, d.sky);
    m.sun = mean(a.sun, b.sun, c.sun, d.sun);
    m.mirror = mean(a.mirror, b.mirror, c.mirror, d.mirror);
    m.glow = mean(a.glow, b.glow, c.glow, d.glow);
    m.depth = mean(a.depth, b.depth, c.depth, d.depth);
    return m;
}
