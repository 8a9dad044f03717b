// Crossings with lamps: their kerbs in the colour that people see, stop lines in that of those who drive, and
// the places of those who wait.
#include <cmath>

#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_reach = 120;   // metres from the eye
constexpr float k_over = 0.16f;  // metres over the carriageway
constexpr float k_before = 1;    // metres from a stop line to the crossing
constexpr uint32_t k_amber_colour = ink(0xe8a317);

uint32_t colour_of(Light light) {
    return light == Light::green ? k_free_colour : light == Light::amber ? k_amber_colour : k_barred_colour;
}

}  // namespace

void add_kerbs(const OverlayInput& input, Overlay& overlay) {
    const Kerbs& kerbs = input.world.crowd.kerbs;
    if (!minds_lamps(kerbs)) return;
    const Crossings& crossings = kerbs.map->crossings;
    Pen pen{.pixels = 3, .place = GizmoPlace::in_world_hidden};
    for (const Crossing& c : crossings.all) {
        if (!is_ruled(c) || glm::length(to_glm(c.centre) - input.camera.eye) > k_reach) continue;
        const LampPlan& plan = crossings.plans[c.plan];
        const Vec3 across = at_height(c.across * c.half_length, 0), middle = c.centre + Vec3{0, k_over, 0};
        auto line = [&](Vec3 from, Vec3 to, Light light) {
            pen.colour = colour_of(light);
            add_line(overlay.lines, pen, to_glm(from), to_glm(to));
        };
        for (const float way : {-1.0f, 1.0f}) {
            const Vec3 kerb = middle + across * way, side = at_height(c.along * c.half_width, 0);
            line(kerb - side, kerb + side, lamp_at(plan, input.world.tick).light);
            // On the right of those who come to it.
            const Vec3 stop = middle + at_height(c.along * ((c.half_width + k_before) * way), 0);
            const Vec2 right{c.along.z * way, -c.along.x * way};
            const float half = std::fabs(cross(c.across, c.along)) * c.half_length;
            line(stop, stop + at_height(right * half, 0), lamp_of_drivers(plan, input.world.tick).light);
        }
    }
    pen = {.pixels = 1.6f, .colour = k_chosen_colour, .place = GizmoPlace::in_world_hidden};
    for (const WalkerId id : input.world.crowd.slots.living) {
        const KerbWait& wait = kerbs.waits[id.index];
        const Vec3 at = input.world.crowd.motion.position[id.index];
        if (wait.kerb == k_no_kerb || glm::length(to_glm(at) - input.camera.eye) > k_reach) continue;
        add_cross(overlay.lines, pen, to_glm(at_height(wait.to, at.y + 0.03f)), 0.12f);
    }
}

}  // namespace flaneur
