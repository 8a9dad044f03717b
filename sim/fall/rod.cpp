#include "sim/fall/rod.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.3f, k_down = 2;  // metres in which ground is looked for

float ground_below(const Surroundings& around, Vec3 at) {
    const auto hit = ground_at(around, at, k_up, k_down);
    return hit ? hit->height + k_rod_thick : at.y - k_down;
}

// Both ends by half of what their way apart is off.
void keep_length(LooseRod& rod) {
    const Vec3 along = rod.tip - rod.grip;
    const float far = length(along);
    if (far < 1e-4f) return;
    const Vec3 by = along * (0.5f * (1 - rod.length / far));
    rod.grip += by;
    rod.tip -= by;
}

void keep_above(const Surroundings& around, Vec3& end, Vec3 before) {
    const float floor = ground_below(around, end);
    if (end.y >= floor) return;
    constexpr float k_rubs = 0.82f;  // of its way along the ground, a tick
    const Vec3 way = end - before;
    end.x = before.x + k_rubs * way.x;
    end.z = before.z + k_rubs * way.z;
    end.y = floor;
}

void lay_tip(LooseRod& rod, Vec3 tip) {
    // Where the ground pushes it up it is as long as ever.
    const Vec3 grip = rod.grip;
    const float down = clamp(grip.y - tip.y, -rod.length, rod.length);
    const Vec2 way = normalize_or(on_ground(tip - grip), {0, 1});
    rod.tip = grip + at_height(way * std::sqrt(std::max(rod.length * rod.length - down * down, 0.0f)), -down);
}

}  // namespace

void point_rod(LooseRod& rod, const Surroundings& around, Vec3 way) {
    Vec3 tip = rod.grip + way * rod.length;
    tip.y = std::max(tip.y, ground_below(around, tip));
    lay_tip(rod, tip);
}

void turn_rod(LooseRod& rod, Vec3 was) {
    const Vec3 from = normalize_or(was, {0, -1, 0}), to = normalize_or(rod.tip - rod.grip, from);
    rod.turn = normalize(rotation_between(from, to) * rod.turn);
}

void step_rod(LooseRod& rod, const Surroundings& around, float dt) {
    const Vec3 falls{0, -k_gravity * dt * dt, 0};
    constexpr float k_air = 0.995f, k_rests = 0.0006f;  // metres a tick
    const Vec3 grip = rod.grip, tip = rod.tip;
    rod.grip += (grip - rod.grip_before) * k_air + falls;
    rod.tip += (tip - rod.tip_before) * k_air + falls;
    for (int k = 0; k < 4; ++k) {
        keep_above(around, rod.grip, grip);
        keep_above(around, rod.tip, tip);
        keep_length(rod);
    }
    // Nothing is below ground, and what all but rests does.
    for (Vec3* end : {&rod.grip, &rod.tip}) end->y = std::max(end->y, ground_below(around, *end));
    // One that still stands on an end tips over, however slowly it begins to.
    auto lies = [&](Vec3 end) { return end.y < ground_below(around, end) + k_rod_thick; };
    const bool rests = length(rod.grip - grip) < k_rests && length(rod.tip - tip) < k_rests &&
                       lies(rod.grip) && lies(rod.tip);
    rod.grip_before = rests ? rod.grip : grip;
    rod.tip_before = rests ? rod.tip : tip;
}

void drag_rod(LooseRod& rod, const Surroundings& around, Vec3 grip) {
    rod.grip_before = rod.grip;
    rod.tip_before = rod.tip;
    rod.grip = grip;
    Vec3 tip = rod.tip - Vec3{0, 0.6f * k_gravity / 60, 0} * 0.2f;
    for (int k = 0; k < 3; ++k) {
        tip = grip + normalize_or(tip - grip, {0, -1, 0}) * rod.length;
        tip.y = std::max(tip.y, ground_below(around, tip));
    }
    lay_tip(rod, tip);
}

}  // namespace flaneur
