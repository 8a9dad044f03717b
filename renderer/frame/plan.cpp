#include "renderer/frame/plan.h"

#include <algorithm>
#include <cmath>

#include "renderer/light/look.h"

namespace flaneur {
namespace {

constexpr float k_plain_shadows = 0.8f;  // from which share of their reach on people's shadows fade

DrawRange append(std::vector<DrawCommand>& draws, std::span<const DrawCommand> more,
                 uint32_t first_instance) {
    const DrawRange range{static_cast<uint32_t>(draws.size()), static_cast<uint32_t>(more.size())};
    for (DrawCommand draw : more) {
        draw.first_instance += first_instance;
        draws.push_back(draw);
    }
    return range;
}

// Every place lies beyond both maps of shadows then, where it is light.
void look_beyond_shadows(FrameConstants& out) {
    constexpr float k_beyond = 2;  // maps reach from 0 to 1
    out.shadow_from_world = mat4(0);
    out.shadow_from_world[3] = vec4(k_beyond, k_beyond, k_beyond, 1);
    out.far_scale = vec4(0);
    out.far_offset = vec4(k_beyond, k_beyond, k_beyond, 0);
}

// What light does not know of: the view, its shadows, and how the picture is made.
void set_view(const Renderer& renderer, const FramePlan& plan, VkExtent2D extent, FrameConstants& out) {
    auto v4 = [](vec3 v, float w = 0) { return vec4(v, w); };
    out.clip_from_world = plan.view.clip_from_world;
    out.shadow_from_world = plan.near.map_from_world;
    const float ratio = plan.near.size / plan.far.size;
    out.far_scale = v4(vec3(ratio));
    out.far_offset = plan.far.map_from_world[3] - plan.near.map_from_world[3] * ratio;
    const float resolution = static_cast<float>(renderer.quality.shadow_resolution);
    auto layer = [&](int first, Reach reach) {
        return static_cast<float>(first + plan.shadows.seen[static_cast<size_t>(reach)]);
    };
    out.shadow_layers = {layer(k_near_layers, Reach::near), layer(k_still_layers, Reach::near),
                         layer(k_far_layers, Reach::far), 0};
    out.shadow_texels = {plan.near.texel, plan.far.texel, resolution, 1 / resolution};
    const float reach = plan.slice.far, faded = reach * reach * (1 - k_plain_shadows * k_plain_shadows);
    out.people_shadows = {reach * reach / faded, 1 / faded, 0, 0};
    out.eye = v4(plan.view.eye);
    out.haze_away.w += plan.clear_air;
    out.ray_forward = v4(plan.view.forward, 1 / plan.view.pixels_at_one_metre);
    out.ray_right = v4(plan.view.right);
    out.ray_down = v4(plan.view.down);
    const bool has_sun = plan.has_shadows || plan.backdrop || plan.without.shadows;
    out.sun_direction = has_sun ? v4(plan.light.to_light) : vec4(0, -1, 0, 0);
    if (plan.without.shadows) look_beyond_shadows(out);
    out.lamp_map = renderer.scene.lamp_map;
    const vec2 size(extent.width, extent.height);
    out.screen = {size.x, size.y, 1 / size.x, 1 / size.y};
    const auto samples = static_cast<float>(renderer.quality.samples);
    out.samples = {samples, 1 / samples, 1 / (size.x * samples), 1 / (size.y * samples)};
    out.way = {plan.light.lamps > 0 && !plan.backdrop && !plan.without.lamps, plan.backdrop.has_value(),
               plan.surfaces_view != Surfaces::lit, has_overlay(plan)};
    if (plan.without.smoothing) out.backdrop = {0, 0, 0, -1};
    if (plan.backdrop) out.backdrop = v4(*plan.backdrop, 1);
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

// What lights the frame, and which maps of shadows are looked at and drawn.
void plan_light(const Renderer& renderer, const FrameInput& input, FramePlan& plan) {
    plan.light = make_daylight(input.sun, input.is_overcast);
    plan.without.shadows = input.without.shadows && luminance(plan.light.sky.sun) > 0 && !plan.backdrop;
    plan.without.smoothing = input.without.smoothing;
    plan.without.lamps = input.without.lamps;
    plan.has_shadows = luminance(plan.light.sky.sun) > 0 && !plan.backdrop && !plan.without.shadows;
    plan.lit_windows = input.lit_windows;
    plan.lens_time = input.lens_time;
    plan.slice = fine_shadow_slice(plan.view, plan.view.eye.y - renderer.scene.ground_low);
    auto wanted_of = [&](Slice slice) {
        return wanted_box(renderer.last_view, plan.view, plan.light.to_light, slice,
                          renderer.quality.shadow_resolution);
    };
    const std::array wanted = {wanted_of(plan.slice), wanted_of(far_shadow_slice(plan.slice))};
    plan.near = wanted[0].now, plan.far = wanted[1].now;
    if (plan.has_shadows) plan.shadows = next_shadows(renderer.shadows.state, wanted, plan.slices);
}

// Who is seen, whose shadows are, and what of their map changes.
void plan_people(Renderer& renderer, const FrameInput& input, FramePlan& plan) {
    const GpuScene& scene = renderer.scene;
    const CrowdInput crowd{input.walkers,        scene.people,
                           input.palette.size(), input.without.impostors ? 0 : scene.impostors.pixels,
                           input.is_finest,      input.companion,
                           &renderer.hidden,     renderer.workers.get()};
    View finer = plan.view;
    finer.pixels_at_one_metre *= renderer.quality.detail;
    cull_crowd(crowd, finer, renderer.crowd);
    cull_shadow_casters(crowd, finer, plan.near, plan.light.to_light, plan.has_shadows ? plan.slice.far : -1,
                        renderer.casters);
    HeldMap& near = plan.shadows.maps[0][plan.shadows.seen[0]];
    const uint32_t resolution = renderer.quality.shadow_resolution;
    ShadowTiles tiles = tiles_below(plan.near, resolution, renderer.casters.spheres);
    if (plan.has_shadows) plan.near_changed = changed_texels(near.people, tiles, resolution);
    near.people = std::move(tiles);
    if (input.people_colours == PeopleColours::levels) colour_by_level(scene.people, renderer.crowd);
    if (!plan.backdrop && !input.without.contacts)
        find_contacts(crowd, input.palette, input.grounds, finer, plan.contacts);
}

// Those whom the host skins come first.
void plan_people_draws(const Renderer& renderer, const FrameInput& input, FramePlan& plan) {
    const std::span<const DrawCommand> people(renderer.crowd.draws), casters(renderer.casters.draws);
    if (renderer.are_people_skinned_on_host) {
        if (input.surfaces == Surfaces::lit && !input.are_ghosts)
            plan.crowd_skin = plan_skin(people, renderer.scene.skin_meshes);
        plan.casters_skin = plan_skin(casters, renderer.scene.skin_meshes);
    }
    auto skinned = [&](const SkinPlan& skin) {  // to be completed by skin_people()
        return append(plan.draws, std::vector<DrawCommand>(skin.batches.size()), 0);
    };
    plan.crowd_skinned = skinned(plan.crowd_skin);
    plan.casters_skinned = skinned(plan.casters_skin);
    plan.crowd = append(plan.draws, people.subspan(plan.crowd_skin.draws), 0);
    plan.casters = append(plan.draws, casters.subspan(plan.casters_skin.draws),
                          static_cast<uint32_t>(renderer.crowd.instances.size()));
}

// What of the city is seen, and what throws shadows into the slices that are drawn.
void plan_city(const Renderer& renderer, FramePlan& plan) {
    auto chunks = [&](CityClass kind) {
        return std::span<const CityChunk>(renderer.scene.chunks[static_cast<size_t>(kind)]);
    };
    auto begin = [&] { return static_cast<uint32_t>(plan.draws.size()); };
    for (size_t kind = 0; kind < k_city_classes; ++kind) {
        const uint32_t first = begin();
        plan.surfaces[kind] = {
            first, cull_chunks(chunks(static_cast<CityClass>(kind)), plan.view, renderer.hidden, plan.draws)};
    }
    const uint32_t resolution = renderer.quality.shadow_resolution;
    for (const ShadowSlices& slices : plan.slices) {
        const ShadowBox part = part_of(slices.box, rows_of(slices, resolution), resolution);
        auto casting = [&](std::initializer_list<CityClass> kinds) {
            DrawRange range{begin(), 0};
            for (CityClass kind : kinds)
                range.count +=
                    cull_chunk_casters(chunks(kind), part, slices.reach == Reach::near, plan.draws);
            return range;
        };
        CityCasters& casters = plan.slice_casters.emplace_back();
        casters.opaque = casting({CityClass::facade, CityClass::roof, CityClass::detail, CityClass::prop});
        casters.scenery = casting({CityClass::scenery});
    }
}

}  // namespace

void plan_frame(Renderer& renderer, const FrameInput& input, VkExtent2D extent, FramePlan& plan) {
    plan.view = make_view(input.camera, extent.width, extent.height);
    plan.backdrop = input.backdrop;
    plan.clear_air = std::isfinite(input.camera.clear_air) ? std::max(input.camera.clear_air, 0.0f) : 0;
    plan.times_passes = input.times_passes;
    plan.surfaces_view = input.surfaces;
    plan.are_tinted = input.people_colours != PeopleColours::own;
    plan.are_ghosts = input.are_ghosts;
    plan.lines = static_cast<uint32_t>(input.lines.size());
    plan.fills = static_cast<uint32_t>(input.fills.size());
    plan.panels = input.panels.draws;
    plan_light(renderer, input, plan);
    if (input.skips_hidden)
        draw_walls(renderer.scene.wall_groups, renderer.scene.walls, plan.view, renderer.hidden);
    else
        renderer.hidden.nearness.clear();
    plan_people(renderer, input, plan);
    plan_people_draws(renderer, input, plan);
    plan_city(renderer, plan);
    const Look look = look_of(plan.light, plan.lit_windows);
    plan.constants = look.constants;
    plan.constants.zenith.w = plan.lens_time;
    set_view(renderer, plan, extent, plan.constants);
    plan.sky = sky_corners(plan.light, look, plan.constants);
    renderer.last_view = plan.view;
}

}  // namespace flaneur
