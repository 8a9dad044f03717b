// Lanes, their curves through junctions fainter; and from each who brakes a line as far as where it will
// stand, in the colour of what for.
#include <algorithm>
#include <cmath>

#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_reach = 150;   // metres from the eye
constexpr float k_over = 0.12f;  // metres over the carriageway
constexpr uint32_t k_lane_colour = ink(0x6aa9ff, 0.8f), k_curve_colour = ink(0x6aa9ff, 0.35f);
// By Brakes.
constexpr uint32_t k_brake_colours[] = {k_free_colour, ink(0xe8a317), k_barred_colour, ink(0xd05be0),
                                        ink(0xd05be0), ink(0x39b6c8), ink(0xffffff)};

}  // namespace

void add_lanes(const OverlayInput& input, Overlay& overlay) {
    if (!has_traffic(input.world.vehicles)) return;
    const Vehicles& vehicles = input.world.vehicles;
    const Lanes& lanes = vehicles.map->lanes;
    auto is_near = [&](Vec3 at) { return glm::length(to_glm(at) - input.camera.eye) < k_reach; };
    Pen pen{.pixels = 1.5f, .place = GizmoPlace::in_world_hidden};
    const Vec3 over{0, k_over, 0};
    for (const Lane& lane : lanes.all) {
        pen.colour = is_curve(lane) ? k_curve_colour : k_lane_colour;
        for (uint32_t k = 0; k + 1 < lane.count; ++k) {
            const Vec3 a = lanes.places[lane.first + k], b = lanes.places[lane.first + k + 1];
            if (is_near(a)) add_line(overlay.lines, pen, to_glm(a + over), to_glm(b + over));
        }
    }
    pen.pixels = 4;
    for (uint32_t n = 0; n < vehicles.all.size(); ++n) {
        const Vehicle& v = vehicles.all[n];
        if (!is_there(v) || !is_near(vehicles.places[first_section(vehicles, n)].middle)) continue;
        pen.colour = k_brake_colours[static_cast<size_t>(v.brakes)];
        const float far = v.brakes == Brakes::no ? 2 : 2 + v.speed * v.speed / 3;
        for (float at = 0; at < far; at += 1) {
            const Vec3 a = ahead_of(lanes, v, at).at, b = ahead_of(lanes, v, std::min(at + 1, far)).at;
            add_line(overlay.lines, pen, to_glm(a + over), to_glm(b + over));
        }
    }
}

}  // namespace flaneur
