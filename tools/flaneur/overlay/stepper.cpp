// What those go by who step when they must, as the showcase draws it: the ray, diamonds where feet are
// wanted, the reach, and the step that is under way.
#include "sim/stepper/foothold.h"
#include "sim/stepping.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

void add_stepper_ways(const OverlayInput& input, Overlay& overlay) {
    constexpr float k_sight = 140;                      // metres from the eye
    constexpr float k_over = 0.02f, k_diamond = 0.07f;  // metres
    constexpr float k_ray = 2.2f;                       // metres of the ray that are drawn
    const World& world = input.world;
    const Bipeds& bipeds = world.stepping->bipeds;
    const glm::vec3 ahead = glm::normalize(input.camera.target - input.camera.eye),
                    right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0)));
    Pen pen{.pixels = 1.8f, .place = GizmoPlace::in_world_hidden};
    auto line = [&](uint32_t colour, Vec3 a, Vec3 b) {
        pen.colour = colour;
        add_line(overlay.lines, pen, to_glm(a), to_glm(b));
    };
    for (const BipedWay& way : bipeds.ways)
        for (size_t k = 0; k < way.line.size(); ++k)
            line(ink(0xd9d4c8, 0.5f), at_height(way.line[k], k_over),
                 at_height(way.line[(k + 1) % way.line.size()], k_over));
    for (size_t i = 0; i < bipeds.all.size(); ++i) {
        const Biped& b = bipeds.all[i];
        if (b.is_down != 0) continue;
        if (glm::length(to_glm(at_height(b.body, 1)) - input.camera.eye) > k_sight) continue;
        const float far[] = {off_wanted(bipeds, world.gait, i, k_left),
                             off_wanted(bipeds, world.gait, i, k_right)};
        const int next = far[k_left] >= far[k_right] ? k_left : k_right;
        for (const int side : {k_left, k_right}) {
            const Vec3 wanted = b.wanted[side] + Vec3{0, k_over, 0};
            const bool is_next = b.swings == 2 ? side == next : b.swings == static_cast<uint32_t>(side);
            const uint32_t colour = b.meets[side] == 0 ? k_barred_colour
                                    : side == k_left   ? k_left_colour
                                                       : k_right_colour;
            line(b.meets[side] == 0 ? k_barred_colour : k_ray_colours[0], wanted + Vec3{0, k_ray, 0}, wanted);
            pen.pixels = is_next ? 3.4f : 1.8f;
            pen.colour = colour;
            const glm::vec3 at = to_glm(wanted), up(0, k_diamond, 0), aside = right * k_diamond;
            for (const auto& [from, to] : {std::pair{up, aside}, {aside, -up}, {-up, -aside}, {-aside, up}})
                add_line(overlay.lines, pen, at + from, at + to);
            pen.pixels = 1.8f;
        }
        // Beyond it a foot steps.
        const Vec3 point = at_height(b.point, 0.5f * (b.wanted[0].y + b.wanted[1].y) + k_over);
        pen.colour = ink(0xf6f3ec, 0.75f);
        add_circle(overlay.lines, pen, to_glm(point), bipeds.is_flat ? -ahead : glm::vec3(0, 1, 0), b.reach);
        if (b.swings == 2) continue;
        const Vec3 from = in_world(world.movers, b.feet[b.swings]).place,
                   to = in_world(world.movers, b.target).place;
        pen.colour = k_chosen_colour;
        add_arc(overlay.lines, pen, to_glm(from), to_glm(to), 0.15f);
    }
}

}  // namespace flaneur
