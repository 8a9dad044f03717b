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

// How much of a pixel lies within a stretch about 0 that comes again with every bay, `far`: 1 where a pixel is wider
// than those between them, and sees their mean.
float across(float x, float half_width, float width, float far) {
    return mix(between(x, -half_width, half_width, width), 2.0 * half_width / k_bay, far);
}

// Of several things in a pixel, each with its share of it: what their albedo is, and what they see of sky and sun and
// send out, as their light together has it.
struct Mixture {
    vec3 albedo, seen;  // sum of share * albedo; and, by its lightness, of sky, sun, glow
};
void add(inout Mixture m, float share, vec3 albedo, float sky, float sun, float glow) {
    m.albedo += share * albedo;
    m.seen += share * dot(albedo, vec3(1)) * vec3(sky, sun, glow);
}

void main() {
    vec3 normal = normalize(in_normal);
    float height = max(in_wall.x, 2.0), shop = in_wall.y, storeys = in_wall.z;
    float door_bay = float(in_kind.x) - 1.0, manner = float(in_kind.y);
    uint house = in_kind.z;
    float has_windows = float(storeys > 0.5);
    float above = in_uv.y * height;  // metres above the foot
    vec2 pixel = pixel_widths(vec2(in_uv.x, above));
    float far = saturate(pixel.x * (1.0 / 1.2) - 1.0);

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
    float side = mix(mix(0.5, 0.64, taste), 1.0, is_wide);  // half its width
    float low = mix(mix(0.85, 0.12, is_french), 0.4, is_attic);
    float high = height - mix(0.62, 0.3, is_attic);
    side = mix(mix(side, 1.12, is_shop), 0.62, is_door);
    low = mix(mix(low, 0.45, is_shop), 0.02, is_door);
    high = mix(mix(high, height - 0.75, is_shop), min(2.75, height - 0.3), is_door);
    float is_wall_of_glass = is_glass * (1.0 - is_door);
    side = mix(side, 0.5 * k_bay, is_wall_of_glass);
    low *= 1.0 - is_wall_of_glass;
    high = mix(high, height, is_wall_of_glass);
    float is_open = has_windows * float(storey < storeys - 0.5 && above > -0.01);
    float open = across(at.x, side, pixel.x, far) * between(at.y, low, high, pixel.y);
    // Its panes, but for a mullion and a transom; of a door, the fanlight.
    float glass = across(at.x, side - 0.075, pixel.x, far) * between(at.y, low + 0.075, high - 0.075, pixel.y);
    if (is_arched > 0.0) {
        vec2 from_middle = vec2(at.x, max(at.y - high + side, 0.0));
        float reach = max(length(from_middle), 1e-4), inverse = reach / length(from_middle * pixel + 1e-6);
        open = mix(saturate((side - reach) * inverse + 0.5) * saturate((at.y - low) / pixel.y + 0.5), open, far);
        glass = mix(saturate((side - 0.075 - reach) * inverse + 0.5) * saturate((at.y - low - 0.075) / pixel.y + 0.5), glass, far);
    }
    open *= is_open;
    float bar = across(at.x, 0.025, pixel.x, far) + between(at.y, high - 0.55, high - 0.50, pixel.y);
    glass *= 1.0 - saturate(bar) * (1.0 - is_shop);
    glass *= 1.0 - is_door * (1.0 - between(at.y, high - 0.45, high - 0.12, pixel.y));
    float pane = min(glass * is_open, open);
    // A railing before windows that reach the floor.
    float rail = 0.0;
    if (is_french > 0.0) {
        float bars = between(abs(fract(at.x * 8.0) - 0.5), 0.35, 0.5, 8.0 * pixel.x) +
                     between(at.y, 0.93, 1.0, pixel.y) + between(at.y, 0.1, 0.15, pixel.y);
        bars = mix(saturate(bars), 0.36, saturate(16.0 * pixel.x - 1.0));
        rail = across(at.x, side, pixel.x, far) * between(at.y, 0.1, 1.0, pixel.y) * is_open * mix(0.45, 1.0, bars);
    }

    // The wall: a base course, a string course at each floor, sills, a surround, and a cornice on top.
    float has_sill = is_open * (1.0 - is_door) * (1.0 - is_shop) * (1.0 - is_french);
    float surround =
        across(at.x, side + 0.12, pixel.x, far) * between(at.y, low - 0.12, high + 0.12, pixel.y) * is_open;
    float sill_across = across(at.x, side + 0.16, pixel.x, far) * has_sill;
    float sill = between(at.y, low - 0.09, low, pixel.y) * sill_across;
    float under_sill = between(at.y, low - 0.19, low - 0.09, pixel.y) * sill_across;
    float from_floor = at.y - height * float(at.y > 0.5 * height);
    float course = between(from_floor, -0.16, 0.01, pixel.y) * has_windows;
    float under_course = between(from_floor, -0.24, -0.16, pixel.y) * has_windows;
    float from_top = storeys * height - above;
    float cornice = between(from_top, -1.0, 0.34, pixel.y) * has_windows;
    float under_cornice = between(from_top, 0.34, 0.56, pixel.y) * has_windows;
    float base = between(above, -9.0, 0.5, pixel.y);
    float sign_band = is_shop * across(at.x, 1.25, pixel.x, far) * between(at.y, height - 0.68, height - 0.24, pixel.y);
    // Courses of large stones at the foot of the house.
    float groove = between(abs(fract(above * 2.3) - 0.5), 0.46, 0.5, 2.3 * pixel.y);
    groove = mix(groove, 0.08, saturate(4.6 * pixel.y - 1.0)) * ground * (1.0 - is_wide);
    float shade = 1.0 + 0.07 * surround + 0.12 * sill + 0.05 * course + 0.08 * cornice - 0.22 * base -
                  0.10 * is_shop - 0.2 * groove;
    float occluded = 1.0 - 0.30 * under_sill - 0.20 * under_course - 0.32 * under_cornice;
    vec3 wall = in_colour * shade;
    if (has_shutters > 0.0) {
        float shutter = is_open * (1.0 - open) * between(abs(at.x), side + 0.05, side + 0.58, pixel.x) *
                        between(at.y, low, high, pixel.y);
        vec3 shutter_colour = taste < 0.4    ? vec3(0.09, 0.13, 0.11)
                              : taste < 0.75 ? vec3(0.21, 0.23, 0.24)
                                             : vec3(0.16, 0.10, 0.07);
        float slat = rising(at.y * 7.0, 7.0 * pixel.y);
        wall = mix(wall, shutter_colour * (0.8 + 0.4 * slat), shutter);
    }

    // Awnings and signs: few quiet colours by bay.
    float pick = hash(vec2(floor(bay * 0.5), storeys + 7.0));
    vec3 sign_colour = pick < 0.25 ? vec3(0.14, 0.02, 0.03) : pick < 0.5 ? vec3(0.02, 0.05, 0.05)
                       : pick < 0.75 ? vec3(0.03, 0.035, 0.04) : vec3(0.35, 0.19, 0.04);
    vec3 frame_colour = is_shop > 0.5 ? vec3(0.045) : vec3(0.55, 0.53, 0.48);
    if (is_door > 0.0) {
        // Panels of a door's two leaves.
        float panel = inside(vec2(abs(at.x), fract(at.y * 0.9)), vec2(0.1, 0.1), vec2(0.48, 0.9), pixel);
        frame_colour = taste < 0.3   ? vec3(0.03, 0.055, 0.05)
                       : taste < 0.6 ? vec3(0.10, 0.055, 0.03)
                                     : vec3(0.10, 0.022, 0.028);
        frame_colour *= 1.0 + 0.35 * panel - 0.5 * between(at.x, -0.012, 0.012, pixel.x);
    }

    // The street's walls see less sky near the ground, least at the foot.
    float contact = max(above, 0.0) / (max(above, 0.0) + 0.35);
    float canyon = 0.72 + 0.28 * saturate(above * 0.07);
    float sky = (0.55 + 0.45 * saturate(contact)) * canyon * occluded;

    // The reveal's shadow on the window: its rectangle, moved by the sun.
    vec3 along = vec3(-normal.z, 0, normal.x);
    float towards = max(dot(normal, frame.sun_direction.xyz), 0.15);
    vec2 slide = -k_reveal * vec2(-dot(along, frame.sun_direction.xyz), frame.sun_direction.y) / towards;
    float in_reveal =
        occluded * inside(at - slide, vec2(-side, low), vec2(side, high), pixel) * mix(1.0, 1.0 - abs(slide.x) / k_bay, far);

    float visible = 1.0 - rail;
    Mixture all = Mixture(vec3(0), vec3(0));
    float signs = sign_band * (1.0 - open);
    add(all, (1.0 - open - signs) * visible, wall, sky, occluded, 0.0);
    add(all, signs * visible, sign_colour, sky, occluded, 1.2);
    add(all, (open - pane) * visible, frame_colour, 0.65 * sky, in_reveal, 0.0);
    add(all, rail, vec3(0.03, 0.032, 0.035), 1.0, occluded, 0.0);
    pane *= visible;

    // Glass: dark rooms, some with curtains, behind a mirror of the sky.
    ONLY_IF(pane > 0.0) {
        float lean = hash(vec2(bay * 3.0 + 1.0, storey + storeys * 17.0)) - 0.5;
        float curtain = float(lean > 0.15) * between(abs(at.x), 0.24, 0.6, pixel.x) * (1.0 - is_shop) * (1.0 - is_glass);
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
            float inverse_height = 1.0 / (0.3 + 1.1 * goods * goods), up = (at.y - 0.5) * inverse_height;
            float wide = (0.2 + 0.26 * fract(goods * 7.3)) * (1.0 - 0.55 * up * up * fract(goods * 17.0));
            float thing = saturate((wide - abs(fract(place) - 0.5)) / (2.5 * pixel.x) + 0.5) *
                          between(up, 0.0, 1.0, inverse_height * pixel.y);
            float shown = saturate(2.0 - 6.0 * max(pixel.x, pixel.y));
            float lit = mix(0.3 * between(at.y, 0.5, 1.2, pixel.y), thing * (0.35 + 0.65 * fract(goods * 3.1)), shown);
            room += (1.0 + 1.5 * frame.way.x) * lit * mix(vec3(0.16, 0.10, 0.06), vec3(0.09, 0.11, 0.13), fract(goods * 7.0));
        }
        // What lights a room outshines what comes in.
        add(all, pane, room * lamp, 1.0 - is_lit, 0.0, brightness);
        normal = normalize(normal + along * (0.05 * lean * pane));
    }
    vec3 seen = all.seen / max(dot(all.albedo, vec3(1)), 1e-4);
    keep(sqrt(all.albedo), normal, k_kind_wall, packed(seen.x, seen.y, pane * (0.6 + 0.4 * canyon), seen.z));
}
