// What those go by who have no goal: the circles of one who staggers, the rays of one who rambles, or of one
// who walks on a compound; and the ways of the gallery's figures and targets.
#include <algorithm>
#include <cmath>

#include "sim/ways/rays.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_reach = 60;                  // metres from the eye
constexpr size_t k_most = 32, k_with_fan = 3;  // who are nearest
constexpr float k_widest = 40;                 // metres, of a circle that is drawn
constexpr float k_over = 0.03f;                // metres over the ground
constexpr float k_eyes = 1;                    // metres over it, of rays
constexpr float k_hit = 0.06f;                 // metres, of the mark where one ends

const Pen k_thin{.pixels = 1.6f, .place = GizmoPlace::in_world_hidden};

void add_stride(const Crowd& c, const Wayfarer& way, Overlay& overlay) {
    const uint32_t i = way.walker;
    const Vec3 place = c.motion.position[i];
    const Vec2 going = c.motion.velocity[i];
    const float heading = length(going) > 0.3f ? heading_of(going) : c.motion.heading[i];
    const float clear = kept_clear(strider_of(c, i));
    Pen pen = k_thin;
    auto circle = [&](uint32_t colour, Vec2 middle, float radius) {
        if (radius <= 0 || radius > k_widest) return;
        pen.colour = colour;
        add_circle(overlay.lines, pen, to_glm(at_height(middle, place.y + k_over)), {0, 1, 0}, radius);
    };
    for (const float side : {1.0f, -1.0f}) {
        const float radius = largest_circle(way.platform, on_ground(place), heading, side, clear);
        circle(k_barred_colour, on_ground(place) + right_of(heading) * (side * radius), radius);
    }
    pen.pixels = 2.6f;
    circle(k_chosen_colour, way.stride.centre, way.stride.radius);
}

void add_rays(const OverlayInput& input, const Wayfarer& way, bool with_fan, Overlay& overlay) {
    const Crowd& c = input.world.crowd;
    const Vec3 from = c.motion.position[way.walker] + Vec3{0, k_eyes, 0};
    auto ray = [&](float degrees, float reach) {
        const float yaw = way.bearing + degrees * k_radians;
        const float comes = clear_way(c, *input.world.navmesh, 0, way.walker, yaw, reach);
        const Vec3 end = from + at_height(heading_direction(yaw) * comes, 0);
        Pen pen = k_thin;
        pen.colour = comes < reach ? k_barred_colour : k_free_colour;
        add_line(overlay.lines, pen, to_glm(from), to_glm(end));
        if (comes < reach) add_cross(overlay.lines, pen, to_glm(end), k_hit);
        return comes;
    };
    const LimbCurves& how = c.march.how;
    // The fan decides where the ray ahead has met something.
    const bool is_blocked = ray(0, how.ray_ahead) < how.ray_ahead;
    if (!is_blocked && !with_fan) return;
    float longest = 0;
    for (const float degrees : k_fan) longest = std::max(longest, ray(degrees, how.ray_aside));
    if (longest < how.ray_aside)
        for (const float degrees : k_fan_behind) ray(degrees, how.ray_aside);
}

// In the document's colours: rays yellow and red, normals green and magenta, their mean cyan.
void add_probes(const SurfaceWalkers& walkers, glm::vec3 eye, Overlay& overlay) {
    constexpr float k_normal = 0.5f, k_mean = 0.9f;  // metres
    auto line = [&](uint32_t colour, Vec3 a, Vec3 b) {
        add_line(overlay.lines, {.pixels = 2, .colour = colour}, to_glm(a), to_glm(b));
    };
    for (size_t i = 0; i < walkers.position.size(); ++i) {
        const glm::vec3 to_eye = eye - to_glm(walkers.position[i]);
        const bool is_behind_rock = glm::dot(to_eye, to_glm(walkers.up[i])) < 0;
        if (is_behind_rock || glm::length(to_eye) > k_reach) continue;
        const SurfaceProbe& probe = walkers.probes[i];
        for (size_t k = 0; k < std::size(probe.sides); ++k) {
            const SurfaceProbe::Side& side = probe.sides[k];
            line(k_ray_colours[k], side.from, side.is_hit ? side.point : side.to);
            if (side.is_hit) line(k_normal_colours[k], side.point, side.point + side.normal * k_normal);
        }
        line(k_mean_colour, probe.point, probe.point + probe.normal * k_mean);
    }
}

// Where figures of the gallery go, and where targets will be.
void add_exhibit_ways(const World& world, Overlay& overlay) {
    Pen pen = k_thin;
    pen.colour = k_free_colour;
    const Troupe& figures = world.figures;
    for (size_t i = 0; i < figures.plans.size(); ++i) {
        const FigurePlan& plan = figures.plans[i];
        const float height = figures.moves[i].position.y + k_over;
        auto corner = [&](size_t k) {
            return to_glm(at_height(plan.way[k % plan.way.size()], height) + plan.aside);
        };
        for (size_t k = 0; k < plan.way.size(); ++k) add_line(overlay.lines, pen, corner(k), corner(k + 1));
    }
    constexpr uint32_t k_ticks = 240, k_apart = 6;
    pen.colour = k_chosen_colour;
    const Linkages& linkages = world.linkages;
    for (size_t i = 0; i < linkages.all.size(); ++i)
        for (size_t e = 0; e < linkages.all[i].leads.size(); ++e) {
            if (linkages.held[linkages.ranges[i].targets + e].is_held) continue;
            const Sway& sway = linkages.all[i].leads[e];
            for (uint32_t t = 0; t < k_ticks; t += k_apart)
                add_line(overlay.lines, pen, to_glm(sway_at(sway, world.tick + t)),
                         to_glm(sway_at(sway, world.tick + t + k_apart)));
        }
}

}  // namespace

void add_ways(const OverlayInput& input, Overlay& overlay) {
    if (!input.world.figures.plans.empty()) add_exhibit_ways(input.world, overlay);
    if (input.world.roam) return add_probes(input.world.roam->walkers, input.camera.eye, overlay);
    if (input.world.stepping) add_stepper_ways(input, overlay);
    add_kerbs(input, overlay);
    add_lanes(input, overlay);
    const Crowd& c = input.world.crowd;
    std::vector<std::pair<float, const Wayfarer*>> near;
    for (const Wayfarer& way : c.wayfarers) {
        const bool is_shown = way.kind == Wayfarer::Kind::stagger || way.kind == Wayfarer::Kind::ramble;
        const float far = glm::length(to_glm(c.motion.position[way.walker]) - input.camera.eye);
        if (is_shown && far < k_reach) near.emplace_back(far, &way);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), k_most));
    for (size_t k = 0; k < near.size(); ++k) {
        const Wayfarer& way = *near[k].second;
        if (way.kind == Wayfarer::Kind::stagger)
            add_stride(c, way, overlay);
        else
            add_rays(input, way, k < k_with_fan, overlay);
    }
}

}  // namespace flaneur
