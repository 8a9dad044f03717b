#include "renderer/frame.h"
#include "renderer/sky.h"

namespace flaneur {
namespace {

constexpr Slice k_far_slice = {0, 250};  // where the city throws shadows, metres
constexpr float k_turbidity = 2.8f;
constexpr float k_ground_albedo = 0.22f;
constexpr float k_haze = 1.0f / 2200;  // a metre
constexpr float k_haze_begins = 60;    // metres
// What a white level surface in sun and sky shows before the tone curve: puts pavement at mid-grey.
constexpr float k_white_level = 0.72f;
// How far the light's colour is taken out of the picture: not all the way, so that afternoons stay warm.
constexpr float k_white_balance = 0.8f;

// How much of the sky's colour shadows keep: walls and haze between them and the sky take the rest.
constexpr float k_blue_of_shadow = 0.45f;
// How much brighter walls and ground make the shadows of a street than open sky would.
constexpr float k_bounce = 1.5f;

// Seen under a low sun the model's sky comes out dim and mauve: a little brighter and bluer.
const vec3 k_sky_tint(1.29f, 1.45f, 1.63f);

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

}  // namespace

void plan_frame(Renderer& renderer, const FrameInput& input, VkExtent2D extent, FramePlan& plan) {
    const GpuScene& scene = renderer.scene;
    plan.view = make_view(input.camera, extent.width, extent.height);
    plan.to_sun = sun_direction(input.sun);
    plan.slice = fine_shadow_slice(plan.view, plan.view.eye.y - scene.ground_low);
    plan.near_box = fit_shadow(plan.view, plan.to_sun, plan.slice, k_shadow_resolution);
    plan.far_box = fit_shadow(plan.view, plan.to_sun, k_far_slice, k_shadow_resolution);
    plan.refresh_near = plan.near_box != renderer.shadows.near_box;
    plan.refresh_far = plan.far_box != renderer.shadows.far_box;

    const CrowdInput crowd{input.walkers, scene.people, input.palette.size(), scene.impostors.pixels};
    if (is_cut(renderer.last_view, plan.view) || renderer.crowd.levels.size() != input.walkers.size())
        renderer.crowd.levels.clear();
    renderer.last_view = plan.view;
    cull_crowd(crowd, plan.view, renderer.crowd);
    cull_shadow_casters(crowd, plan.view, plan.near_box, plan.to_sun, plan.slice.far, renderer.casters);
    find_contacts(crowd, input.palette, plan.view, plan.contacts);

    const std::span<const DrawCommand> people(renderer.crowd.draws);
    plan.crowd_smooth = append(plan.draws, people.first(renderer.crowd.smooth_draws), 0);
    plan.crowd_rigid = append(plan.draws, people.subspan(renderer.crowd.smooth_draws), 0);
    plan.casters =
        append(plan.draws, renderer.casters.draws, static_cast<uint32_t>(renderer.crowd.instances.size()));

    auto chunks = [&](CityClass kind) {
        return std::span<const CityChunk>(scene.chunks[static_cast<size_t>(kind)]);
    };
    auto begin = [&] { return static_cast<uint32_t>(plan.draws.size()); };
    auto visible = [&](CityClass kind) {
        const uint32_t first = begin();
        return DrawRange{first, cull_chunks(chunks(kind), plan.view, plan.draws)};
    };
    auto casting = [&](const ShadowBox& box) {
        const uint32_t first = begin();
        uint32_t count = cull_chunk_casters(chunks(CityClass::facade), box, plan.draws);
        count += cull_chunk_casters(chunks(CityClass::detail), box, plan.draws);
        return DrawRange{first, count};
    };
    auto scenery_casting = [&](const ShadowBox& box) {
        const uint32_t first = begin();
        return DrawRange{first, cull_chunk_casters(chunks(CityClass::scenery), box, plan.draws)};
    };
    plan.facades = visible(CityClass::facade);
    plan.surfaces[0] = visible(CityClass::detail);
    plan.surfaces[1] = visible(CityClass::ground);
    plan.scenery = visible(CityClass::scenery);
    if (plan.refresh_near) {
        plan.near_city = casting(plan.near_box);
        plan.near_scenery = scenery_casting(plan.near_box);
    }
    if (plan.refresh_far) {
        plan.far_city = casting(plan.far_box);
        plan.far_scenery = scenery_casting(plan.far_box);
    }
}

FrameConstants frame_constants(const FramePlan& plan, VkExtent2D extent) {
    const SkyModel sky = make_sky(plan.to_sun, k_turbidity);
    const AmbientLight ambient = ambient_light(sky, vec3(k_ground_albedo));
    auto ambient_on = [&](vec3 normal) {
        vec3 light = ambient.level;
        for (int c = 0; c < 3; ++c) light[c] += glm::dot(ambient.slope[c], normal);
        return light * k_bounce;
    };
    const vec3 sun = sky.sun / 3.14159265f;
    const vec3 level_white = ambient_on({0, 1, 0}) + sun * plan.to_sun.y;
    const vec3 balance = glm::pow(vec3(luminance(level_white)) / level_white, vec3(k_white_balance));
    const vec3 white = balance * (k_white_level / luminance(level_white * balance));
    const vec3 sky_white = white * k_sky_tint;
    auto sky_at = [&](vec3 direction) { return sky_luminance(sky, glm::normalize(direction)) * sky_white; };
    const vec3 level_sun(plan.to_sun.x, 0, plan.to_sun.z);
    const vec3 ahead = glm::length(level_sun) > 1e-3f ? glm::normalize(level_sun) : vec3(0, 0, 1);

    FrameConstants out;
    out.clip_from_world = plan.view.clip_from_world;
    out.shadow_from_world = plan.near_box.map_from_world;
    const float ratio = plan.near_box.size / plan.far_box.size;
    out.far_scale = v4(vec3(ratio));
    out.far_offset = plan.far_box.map_from_world[3] - plan.near_box.map_from_world[3] * ratio;
    out.shadow_texels = {plan.near_box.texel, plan.far_box.texel, static_cast<float>(k_shadow_resolution),
                         1.0f / static_cast<float>(k_shadow_resolution)};
    out.eye = v4(plan.view.eye);
    out.ray_forward = v4(plan.view.forward, 1 / plan.view.pixels_at_one_metre);
    out.ray_right = v4(plan.view.right);
    out.ray_down = v4(plan.view.down);
    out.sun_direction = v4(plan.to_sun);
    out.sun_light = v4(sun * white);
    const vec3 grey(0.2126f, 0.7152f, 0.0722f);
    vec4 ambient_grey(0);
    for (int c = 0; c < 3; ++c) {
        out.ambient[c] = v4(ambient.slope[c], ambient.level[c]) * (white[c] * k_bounce);
        ambient_grey += grey[c] * out.ambient[c];
    }
    for (vec4& colour : out.ambient) colour = glm::mix(ambient_grey, colour, k_blue_of_shadow);
    out.haze_towards = v4(sky_at(ahead + vec3(0, 0.12f, 0)), k_haze);
    out.haze_away = v4(sky_at(-ahead + vec3(0, 0.12f, 0)), k_haze_begins);
    out.zenith = v4(sky_at({0, 1, 0}));
    for (int i = 0; i < 5; ++i) out.perez[i] = v4(sky.perez[i]);
    out.sky_scale = v4(sky.scale);
    out.sky_white = v4(sky_white);
    const vec2 size(extent.width, extent.height);
    out.screen = {size.x, size.y, 1 / size.x, 1 / size.y};
    return out;
}

}  // namespace flaneur
