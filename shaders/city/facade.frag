#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/common.glsl"
#include "shaders/base/pattern.glsl"
#include "shaders/base/surface.glsl"

layout(location = 1) in vec2 in_uv;  // x: metres, a window every k_bay; y: storeys
layout(location = 2) in vec3 in_normal;
layout(location = 3) flat in vec3 in_colour;
layout(location = 4) flat in vec3 in_wall;   // height of a storey; whether it has shops; storeys
layout(location = 5) flat in uvec3 in_kind;  // 1 + the bay of the door, or 0; WindowKind; whose house it is

const float k_reveal = 0.16;  // how deep windows sit, metres

void main() {
    vec3 normal = normalize(in_normal);
    float height = max(in_wall.x, 2.0), shop = in_wall.y, storeys = in_wall.z;
    float door_bay = float(in_kind.x) - 1.0, manner = float(in_kind.y);
    uint house = in_kind.z;
    float has_windows = float(storeys > 0.5);
    float above = in_uv.y * height;  // metres above the foot
    vec2 pixel = max(fwidth(vec2(in_uv.x, above)), vec2(1e-4));

    float bay = floor(in_uv.x / k_bay), storey = floor(in_uv.y);
    vec2 at = vec2(in_uv.x - (bay + 0.5) * k_bay, above - storey * height);  // from the bay's foot
    float ground = float(storey < 0.5 && above > -0.01) * has_windows;
    float is_door = ground * float(abs(bay - door_bay) < 0.5);
    float is_shop = ground * shop * (1.0 - is_door);
    // Each house has windows of its own: 0 sashes, 1 with shutters, 2 round heads, 3 wide ones.
    float taste = hash(uvec2(house, 0u));
    float has_shutters = float(abs(manner - 1.0) < 0.5) * (1.0 - ground);
    float is_glass = float(in_wall.x > 0.01 && in_wall.x < 1.0);
    float is_arched = float(abs(manner - 2.0) < 0.5) * (1.0 - is_shop) * (1.0 - is_glass);
    float is_wide = float(manner > 2.5);
    float is_attic = float(height < 2.3) * (1.0 - is_glass);
    float is_french = float(taste > 0.55 && manner < 0.5) * (1.0 - ground) * (1.0 - is_attic) * (1.0 - is_glass);

    // The opening: a window, a door, or a shop's wide pane.
    float half_width = mix(mix(0.5, 0.64, taste), 1.0, is_wide);
    vec2 low = vec2(-half_width, mix(mix(0.85, 0.12, is_french), 0.4, is_attic));
    vec2 high = vec2(half_width, height - mix(0.62, 0.3, is_attic));
    low = mix(mix(low, vec2(-1.12, 0.45), is_shop), vec2(-0.62, 0.02), is_door);
    high = mix(mix(high, vec2(1.12, height - 0.75), is_shop), vec2(0.62, min(2.75, height - 0.3)), is_door);
    low = mix(low, vec2(-0.5 * k_bay, 0.0), is_glass * (1.0 - is_door));
    high = mix(high, vec2(0.5 * k_bay, height), is_glass * (1.0 - is_door));
    float spring = high.y - high.x;
    vec2 from_head = vec2(at.x, max(at.y - spring, 0.0));
    float head = mix(1.0, saturate((high.x - length(from_head)) / max(pixel.x, pixel.y) + 0.5), is_arched);
    float is_open = has_windows * float(storey < storeys - 0.5 && above > -0.01);
    float open = inside(at, low, high, pixel) * head * is_open;
    float glass = inside(at, low + 0.075, high - 0.075, pixel);
    // A window has a mullion and a transom; a door has leaves and a fanlight.
    float bar = between(at.x, -0.025, 0.025, pixel.x) + between(at.y, high.y - 0.55, high.y - 0.50, pixel.y);
    glass *= 1.0 - saturate(bar) * (1.0 - is_shop);
    glass *= 1.0 - is_door * (1.0 - between(at.y, high.y - 0.45, high.y - 0.12, pixel.y));
    // A railing before windows that reach the floor.
    float rail = 0.0;
    if (is_french > 0.0) {
        float bars = between(abs(fract(at.x * 8.0) - 0.5), 0.35, 0.5, 8.0 * pixel.x) +
                     between(at.y, 0.93, 1.0, pixel.y) + between(at.y, 0.1, 0.15, pixel.y);
        rail = inside(at, vec2(low.x, 0.1), vec2(high.x, 1.0), pixel) * is_open * mix(0.45, 1.0, saturate(bars));
    }

    // The wall: a base course, a string course at each floor, sills, a surround, and a cornice on top.
    float has_sill = is_open * (1.0 - is_door) * (1.0 - is_shop) * (1.0 - is_french);
    float surround = inside(at, low - 0.12, high + 0.12, pixel) * is_open;
    float sill = inside(at, vec2(low.x - 0.16, low.y - 0.09), vec2(high.x + 0.16, low.y), pixel) * has_sill;
    float under_sill =
        inside(at, vec2(low.x - 0.16, low.y - 0.19), vec2(high.x + 0.16, low.y - 0.09), pixel) * has_sill;
    float course = between(at.y, height - 0.16, height + 0.01, pixel.y) * has_windows;
    float under_course = between(at.y, height - 0.24, height - 0.16, pixel.y) * has_windows;
    float from_top = storeys * height - above;
    float cornice = between(from_top, -1.0, 0.34, pixel.y) * has_windows;
    float under_cornice = between(from_top, 0.34, 0.56, pixel.y) * has_windows;
    float base = between(above, -9.0, 0.5, pixel.y);
    float sign_band = is_shop * inside(at, vec2(-1.25, height - 0.68), vec2(1.25, height - 0.24), pixel);
    // Courses of large stones at the foot of the house.
    float groove = ground * (1.0 - is_wide) * between(abs(fract(above * 2.3) - 0.5), 0.46, 0.5, 2.3 * pixel.y);
    float shade = 1.0 + 0.07 * surround + 0.12 * sill + 0.05 * course + 0.08 * cornice - 0.22 * base -
                  0.10 * is_shop - 0.2 * groove;
    float occluded = 1.0 - 0.30 * under_sill - 0.20 * under_course - 0.32 * under_cornice;
    vec3 albedo = in_colour * shade;
    if (has_shutters > 0.0) {
        float shutter = is_open * (1.0 - open) *
                        inside(vec2(abs(at.x), at.y), vec2(high.x + 0.05, low.y), vec2(high.x + 0.58, high.y), pixel);
        vec3 shutter_colour = taste < 0.4    ? vec3(0.09, 0.13, 0.11)
                              : taste < 0.75 ? vec3(0.21, 0.23, 0.24)
                                             : vec3(0.16, 0.10, 0.07);
        albedo = mix(albedo, shutter_colour * (0.8 + 0.4 * fract(at.y * 7.0)), shutter);
    }

    // Awnings and signs: few quiet colours by bay.
    float pick = hash(vec2(floor(bay * 0.5), storeys + 7.0));
    vec3 sign_colour = pick < 0.25 ? vec3(0.14, 0.02, 0.03) : pick < 0.5 ? vec3(0.02, 0.05, 0.05)
                       : pick < 0.75 ? vec3(0.03, 0.035, 0.04) : vec3(0.35, 0.19, 0.04);
    albedo = mix(albedo, sign_colour, sign_band);
    vec3 frame_colour = is_shop > 0.5 ? vec3(0.045) : vec3(0.55, 0.53, 0.48);
    if (is_door > 0.0) {
        // Panels of a door's two leaves.
        float panel = inside(vec2(abs(at.x), fract(at.y * 0.9)), vec2(0.1, 0.1), vec2(0.48, 0.9), pixel);
        frame_colour = taste < 0.3   ? vec3(0.03, 0.055, 0.05)
                       : taste < 0.6 ? vec3(0.10, 0.055, 0.03)
                                     : vec3(0.10, 0.022, 0.028);
        frame_colour *= 1.0 + 0.35 * panel - 0.5 * between(at.x, -0.012, 0.012, pixel.x);
    }
    albedo = mix(albedo, frame_colour, open);

    // The street's walls see less sky near the ground, least at the foot.
    float contact = max(above, 0.0) / (max(above, 0.0) + 0.35);
    float canyon = 0.72 + 0.28 * saturate(above * 0.07);
    float ao = (0.55 + 0.45 * saturate(contact)) * canyon * (1.0 - 0.35 * open) * occluded;

    // The reveal's shadow on the window: its rectangle, moved by the sun.
    vec3 along = vec3(-normal.z, 0, normal.x);
    float towards = max(dot(normal, frame.sun_direction.xyz), 0.15);
    vec2 slide = -k_reveal * vec2(-dot(along, frame.sun_direction.xyz), frame.sun_direction.y) / towards;
    float sun = occluded * mix(1.0, inside(at - slide, low, high, pixel), open);
    float glow = 1.2 * sign_band, sun_on_rail = sun;

    // Glass: dark rooms, some with curtains, behind a mirror of the sky.
    float pane = open * glass;
    ONLY_IF(pane > 0.0) {
        float lean = hash(vec2(bay * 3.0 + 1.0, storey + storeys * 17.0)) - 0.5;
        float curtain = float(lean > 0.15) * between(abs(at.x), 0.24, 0.6, pixel.x) * (1.0 - is_shop) * (1.0 - is_glass) * glass;
        vec3 tone = vec3(0.018, 0.017, 0.016) * (1.0 + 2.0 * is_shop), lamp = vec3(1);
        float is_lit = 0.0, brightness = 0.0;
        ONLY_IF(frame.way.x > 0.0) {
            // Lamps of many colours behind some windows and in every shop; ceilings are brighter than floors.
            uint window = uint(int(bay) + 61 * int(storey));
            float drawn = hash(uvec2(window, house + 7u * uint(storeys)));
            is_lit = max(float(drawn < frame.lamp_light.w), is_shop);
            float warmth = hash(uvec2(house, window));
            lamp = mix(vec3(1), mix(vec3(1.0, 0.82, 0.62), vec3(0.9, 1.15, 1.45), warmth * warmth), is_lit);
            brightness = (0.35 + 0.65 * fract(warmth * 5.3)) * (0.55 + 0.45 * saturate(at.y / height)) *
                         (2.2 - 0.9 * is_shop) * is_lit;
            tone = mix(tone, vec3(0.34, 0.30, 0.25) * (1.0 - 0.45 * is_shop), is_lit);
        }
        vec3 room = mix(tone, vec3(0.20, 0.19, 0.17), curtain);
        // Goods in a shop's window, in the light of its lamps.
        ONLY_IF(is_shop > 0.0) {
            // Each stands in a place of its own, narrower above.
            float place = at.x * 2.5 + bay * 11.0, goods = hash(vec2(floor(place), storeys));
            float up = (at.y - 0.5) / (0.3 + 1.1 * goods * goods);
            float wide = (0.2 + 0.26 * fract(goods * 7.3)) * (1.0 - 0.55 * up * up * fract(goods * 17.0));
            float thing = saturate((wide - abs(fract(place) - 0.5)) / (2.5 * pixel.x) + 0.5) *
                          between(up, 0.0, 1.0, pixel.y);
            float shown = saturate(2.0 - 6.0 * max(pixel.x, pixel.y));
            float lit = mix(0.3 * between(at.y, 0.5, 1.2, pixel.y), thing * (0.35 + 0.65 * fract(goods * 3.1)), shown);
            room += (1.0 + 1.5 * frame.way.x) * lit * mix(vec3(0.16, 0.10, 0.06), vec3(0.09, 0.11, 0.13), fract(goods * 7.0));
        }
        albedo = mix(albedo, room * lamp, pane);
        ao = mix(ao, 1.0 - is_lit, pane);  // what lights a room outshines what comes in
        sun *= 1.0 - pane;
        glow = mix(glow, brightness, pane);
        normal = normalize(normal + along * (0.05 * lean * pane));
    }
    albedo = mix(albedo, vec3(0.03, 0.032, 0.035), rail);
    ao = mix(ao, 1.0, rail);
    sun = mix(sun, sun_on_rail, rail);
    pane *= 1.0 - rail;
    glow *= 1.0 - rail;
    keep(sqrt(albedo), normal, k_kind_wall, packed(ao, sun, pane * (0.6 + 0.4 * canyon), glow));
}
