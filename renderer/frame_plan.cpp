#include <algorithm>

#include "renderer/frame.h"

namespace flaneur {
namespace {

constexpr Slice k_far_slice = {0, 250};  // where the city throws shadows, metres
constexpr float k_ground_albedo = 0.22f;
constexpr float k_haze = 1.0f / 2200;  // a metre
constexpr float k_haze_begins = 60;    // metres
// What a white level surface in sun and sky shows before the tone curve: puts pavement at mid-grey.
constexpr float k_white_level = 0.72f;
// How far the light's colour is taken out of the picture: not all the way, so that afternoons stay warm.
constexpr float k_white_balance = 0.8f;

// How much of the sky's colour shadows keep: walls and haze between them and the sky take the rest.
constexpr float k_blue_of_shadow = 0.45f;
// How much brighter walls and ground make the shadows of a street than open sky would, while the sun is low
// and when it is high.
constexpr float k_bounce = 1.5f, k_noon_bounce = 2;

// Against pavement at mid-grey the model's sky comes out dim and mauve, at noon most, and too bright about a
// sun that sets.
const vec3 k_sky_tint(1.3f, 1.95f, 2.8f), k_noon_sky_tint(1.75f, 2.45f, 3.1f),
    k_dusk_sky_tint(0.8f, 0.72f, 0.84f);

// What a white pavement below a street lamp reflects, kcd/m2: 32 lux over pi. Against it: how much of it eyes
// grow used to, and how bright lit rooms are.
constexpr float k_lamp_level = 0.032f / 3.14159265f, k_lamps_seen = 0.35f, k_window_level = 2.2f,
                k_dusk_windows = 4;
const vec3 k_lamp_colour(1.18f, 0.98f, 0.70f), k_window_colour(1.38f, 0.93f, 0.46f);
constexpr float k_pavement = 0.3f;  // albedo of what eyes grow used to
constexpr float k_bright = 1000;    // cd/m2 from where on nothing looks dim
constexpr float k_readable = 0.9f;  // below 1 nights are drawn brighter than eyes see them

vec4 v4(vec3 v, float w = 0) { return {v, w}; }

DrawRange append(std::vector<DrawCommand>& draws, std::span<const DrawCommand> more,
                 uint32_t first_instance) {
    const DrawRange range{static_cast<uint32_t>(draws.size()), static_cast<uint32_t>(more.size())};
    for (DrawCommand draw : more) {
        draw.first_instance += first_instance;
        draws.push_back(draw);
    }
    return range;
}

// Whether a view does not go on from the one before, but shows something else.
bool is_cut(const View& before, const View& now) {
    constexpr float farthest = 3, widest = 1.05f;  // metres; factor on the size of what is seen
    const float zoom = now.pixels_at_one_metre / before.pixels_at_one_metre;
    return !(glm::length(now.eye - before.eye) <= farthest && zoom <= widest && zoom >= 1 / widest);
}

void colour_by_level(std::span<const PersonRanges> people, CrowdDraws& crowd) {
    auto level_of = [&](uint32_t first_index) {
        for (const PersonRanges& person : people)
            for (size_t level = 0; level < person.lods.size(); ++level)
                if (person.lods[level].first_index == first_index) return level;
        return size_t{0};
    };
    for (const DrawCommand& draw : crowd.draws) {
        const uint32_t colour = k_level_colours[level_of(draw.first_index)];
        for (uint32_t i = 0; i < draw.instance_count; ++i)
            std::fill_n(crowd.instances[draw.first_instance + i].tints, k_tints, colour);
    }
    for (ImpostorInstance& impostor : crowd.impostors)
        std::fill_n(impostor.tints, k_tints, k_level_colours[k_impostor_level]);
}

}  // namespace

void plan_frame(Renderer& renderer, const FrameInput& input, VkExtent2D extent, FramePlan& plan) {
    const GpuScene& scene = renderer.scene;
    plan.view = make_view(input.camera, extent.width, extent.height);
    plan.light = make_daylight(input.sun, input.is_overcast);
    plan.backdrop = input.backdrop;
    plan.times_passes = input.times_passes;
    plan.has_shadows = luminance(plan.light.sky.sun) > 0 && !plan.backdrop;
    plan.light_kind = plan.backdrop ? k_light_plain : plan.light.lamps > 0 ? k_light_night : k_light_day;
    plan.lit_windows = input.lit_windows;
    const vec3 to_light = plan.light.to_light;
    const uint32_t resolution = renderer.quality.shadow_resolution;
    plan.slice = fine_shadow_slice(plan.view, plan.view.eye.y - scene.ground_low);
    plan.near_box = fit_shadow(plan.view, to_light, plan.slice, resolution);
    plan.far_box = fit_shadow(plan.view, to_light, k_far_slice, resolution);
    plan.refresh_near = plan.has_shadows && plan.near_box != renderer.shadows.near_box;
    plan.refresh_far = plan.has_shadows && plan.far_box != renderer.shadows.far_box;

    OcclusionMap& hidden = renderer.hidden;
    if (input.skips_hidden)
        draw_walls(scene.wall_groups, scene.walls, plan.view, hidden);
    else
        hidden.nearness.clear();
    const CrowdInput crowd{input.walkers,          scene.people,    input.palette.size(),
                           scene.impostors.pixels, input.is_finest, &hidden};
    if (is_cut(renderer.last_view, plan.view) || renderer.crowd.levels.size() != input.walkers.size())
        renderer.crowd.levels.clear();
    renderer.last_view = plan.view;
    View finer = plan.view;
    finer.pixels_at_one_metre *= renderer.quality.detail;
    cull_crowd(crowd, finer, renderer.crowd);
    cull_shadow_casters(crowd, finer, plan.near_box, to_light, plan.has_shadows ? plan.slice.far : -1,
                        renderer.casters);
    if (input.people_colours == PeopleColours::levels) colour_by_level(scene.people, renderer.crowd);
    plan.surfaces_view = input.surfaces;
    plan.are_tinted = input.people_colours != PeopleColours::own;
    plan.are_ghosts = input.are_ghosts;
    plan.lines = static_cast<uint32_t>(input.lines.size());
    plan.fills = static_cast<uint32_t>(input.fills.size());
    if (!plan.backdrop) find_contacts(crowd, input.palette, finer, plan.contacts);

    const std::span<const DrawCommand> people(renderer.crowd.draws);
    const std::span<const DrawCommand> casters(renderer.casters.draws);
    if (renderer.workers) {
        if (input.surfaces == Surfaces::lit && !input.are_ghosts)
            plan.crowd_skin = plan_skin(people, scene.skin_meshes);
        plan.casters_skin = plan_skin(casters, scene.skin_meshes);
    }
    auto skinned = [&](const SkinPlan& skin) {  // to be completed by skin_people()
        return append(plan.draws, std::vector<DrawCommand>(skin.batches.size()), 0);
    };
    plan.crowd_skinned = skinned(plan.crowd_skin);
    plan.casters_skinned = skinned(plan.casters_skin);
    plan.crowd = append(plan.draws, people.subspan(plan.crowd_skin.draws), 0);
    plan.casters = append(plan.draws, casters.subspan(plan.casters_skin.draws),
                          static_cast<uint32_t>(renderer.crowd.instances.size()));

    auto chunks = [&](CityClass kind) {
        return std::span<const CityChunk>(scene.chunks[static_cast<size_t>(kind)]);
    };
    auto begin = [&] { return static_cast<uint32_t>(plan.draws.size()); };
    auto visible = [&](CityClass kind) {
        const uint32_t first = begin();
        return DrawRange{first, cull_chunks(chunks(kind), plan.view, hidden, plan.draws)};
    };
    auto casting = [&](std::initializer_list<CityClass> kinds, const ShadowBox& box, bool is_near) {
        DrawRange range{begin(), 0};
        for (CityClass kind : kinds)
            range.count += cull_chunk_casters(chunks(kind), box, is_near, plan.draws);
        return range;
    };
    const auto opaque = {CityClass::facade, CityClass::roof, CityClass::detail, CityClass::prop};
    plan.facades = visible(CityClass::facade);
    plan.props = visible(CityClass::prop);
    plan.surfaces[0] = visible(CityClass::detail);
    plan.surfaces[1] = visible(CityClass::roof);
    plan.surfaces[2] = visible(CityClass::ground);
    plan.scenery = visible(CityClass::scenery);
    plan.shades = visible(CityClass::shade);
    if (plan.refresh_near) {
        plan.near_city = casting(opaque, plan.near_box, true);
        plan.near_scenery = casting({CityClass::scenery}, plan.near_box, true);
    }
    if (plan.refresh_far) {
        plan.far_city = casting(opaque, plan.far_box, false);
        plan.far_scenery = casting({CityClass::scenery}, plan.far_box, false);
    }
}

FrameConstants frame_constants(const Renderer& renderer, const FramePlan& plan, VkExtent2D extent) {
    const Daylight& light = plan.light;
    const SkyModel& sky = light.sky;
    const vec3 to_light = light.to_light;
    const AmbientLight ambient = ambient_light(sky, vec3(k_ground_albedo));
    const float high = glm::smoothstep(0.45f, 0.9f, sky.to_sun.y);
    const float bounce = glm::mix(k_bounce, k_noon_bounce, high);
    auto ambient_on = [&](vec3 normal) {
        vec3 on = ambient.level;
        for (int c = 0; c < 3; ++c) on[c] += glm::dot(ambient.slope[c], normal);
        return on * bounce;
    };
    const vec3 sun = sky.sun / 3.14159265f;
    const vec3 level_white = ambient_on({0, 1, 0}) + sun * to_light.y;
    // Lamps are as bright as they are: eyes grow used to them, and see their colour.
    const float lamps = light.lamps * k_lamp_level;
    const float colourless = k_white_balance * (1 - light.lamps);
    const vec3 balance = glm::pow(vec3(luminance(level_white)) / level_white, vec3(colourless));
    const float seen = luminance(level_white * balance) + k_lamps_seen * lamps;
    const float key = exposure_key(k_pavement * 1000 * seen) / exposure_key(k_bright);
    const float dim = std::min(std::pow(key, k_readable), 1.0f);
    const float exposure = k_white_level * dim / seen;
    const vec3 white = balance * exposure;
    const vec3 low_tint = glm::mix(k_dusk_sky_tint, k_sky_tint, glm::smoothstep(0.06f, 0.38f, sky.to_sun.y));
    const vec3 sky_white = white * glm::mix(low_tint, k_noon_sky_tint, high);
    auto sky_at = [&](vec3 direction) {
        direction = glm::normalize(direction);
        return daylit_sky(sky, direction) * sky_white + added_sky(sky, direction) * white;
    };
    const vec3 level_sun(sky.to_sun.x, 0, sky.to_sun.z);
    const vec3 ahead = glm::length(level_sun) > 1e-3f ? glm::normalize(level_sun) : vec3(0, 0, 1);

    FrameConstants out;
    out.clip_from_world = plan.view.clip_from_world;
    out.shadow_from_world = plan.near_box.map_from_world;
    const float ratio = plan.near_box.size / plan.far_box.size;
    out.far_scale = v4(vec3(ratio));
    out.far_offset = plan.far_box.map_from_world[3] - plan.near_box.map_from_world[3] * ratio;
    const float resolution = static_cast<float>(renderer.quality.shadow_resolution);
    out.shadow_texels = {plan.near_box.texel, plan.far_box.texel, resolution, 1 / resolution};
    out.eye = v4(plan.view.eye);
    out.ray_forward = v4(plan.view.forward, 1 / plan.view.pixels_at_one_metre);
    out.ray_right = v4(plan.view.right);
    out.ray_down = v4(plan.view.down);
    out.sun_direction = plan.has_shadows || plan.backdrop ? v4(to_light) : vec4(0, -1, 0, 0);
    out.sun_light = v4(sun * white, light.disc);
    const vec3 grey(0.2126f, 0.7152f, 0.0722f);
    vec4 ambient_grey(0);
    for (int c = 0; c < 3; ++c) {
        out.ambient[c] = v4(ambient.slope[c], ambient.level[c]) * (white[c] * bounce);
        ambient_grey += grey[c] * out.ambient[c];
    }
    for (vec4& colour : out.ambient) colour = glm::mix(ambient_grey, colour, k_blue_of_shadow);
    out.haze_towards = v4(sky_at(ahead + vec3(0, 0.12f, 0)), k_haze);
    out.haze_away = v4(sky_at(-ahead + vec3(0, 0.12f, 0)), k_haze_begins);
    out.zenith = v4(sky_at({0, 1, 0}));
    for (int i = 0; i < 5; ++i) out.perez[i] = v4(sky.perez[i]);
    out.sky_scale = v4(sky.scale);
    out.sky_white = v4(sky_white);
    out.sky_low = v4(sky.low * white);
    out.sky_high = v4(sky.high * white);
    out.sky_dusk = v4(sky.dusk * white, luminance(sky.sun) > 0 ? light.lamps * light.lamps : 0);
    out.sky_sun = v4(sky.to_sun);
    out.lamp_light = v4(k_lamp_colour * (lamps * exposure), plan.lit_windows);
    out.lamp_map = renderer.scene.lamp_map;
    // Against a sky that is still light, rooms are those whose lamps are brightest.
    const float windows = lamps * (k_window_level + k_dusk_windows * (1 - k_lamps_seen * lamps / seen));
    out.window_light = v4(k_window_colour * (windows * exposure));
    const vec2 size(extent.width, extent.height);
    out.screen = {size.x, size.y, 1 / size.x, 1 / size.y};
    return out;
}

}  // namespace flaneur
