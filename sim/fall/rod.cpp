#include "sim/fall/rod.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.3f, k_down = 2;  // metres in which ground is looked for

float ground_below(const Surroundings& around, Vec3 at) {
    const auto hit = ground_at(around, at, k_up, k_down);
    return hit ? hit->height + k_rod_thick : at.y - k_down;
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

// The tip there or where the ground pushes it up to, a length from the grip.
void lay_tip(LooseRod& rod, const Surroundings& around, Vec3 tip) {
    tip.y = std::max(tip.y, ground_below(around, tip));
    const Vec3 grip = rod.grip;
    const float down = clamp(grip.y - tip.y, -rod.length, rod.length);
    const Vec2 way = normalize_or(on_ground(tip - grip), {0, 1});
    rod.tip = grip + at_height(way * std::sqrt(std::max(rod.length * rod.length - down * down, 0.0f)), -down);
}

void hold(LooseRod& rod, const Surroundings& around, Vec3 grip) {
    rod.grip_before = rod.grip;
    rod.grip = {grip.x, std::max(grip.y, ground_below(around, grip)), grip.z};
}

void swing_rod(LooseRod& rod, const Surroundings& around, Vec3 grip) {
    constexpr float k_air = 0.985f;     // of how it moves, a tick: fingers are about it
    constexpr float k_thin_rod = 1.5f;  // of the gravity of a weight at its tip
    hold(rod, around, grip);
    const Vec3 was = rod.tip;
    Vec3 tip = was + (was - rod.tip_before) * k_air - Vec3{0, k_thin_rod * k_gravity * k_tick * k_tick, 0};
    for (int k = 0; k < 3; ++k) {
        tip = rod.grip + normalize_or(tip - rod.grip, {0, -1, 0}) * rod.length;
        keep_above(around, tip, was);
    }
    lay_tip(rod, around, tip);
    rod.tip_before = was;
}

// By so much of the way to a direction.
void point_rod(LooseRod& rod, const Surroundings& around, Vec3 grip, Vec3 way, float by) {
    const Vec3 now = normalize_or(rod.tip - rod.grip, way);
    hold(rod, around, grip);
    rod.tip_before = rod.tip;
    const Quat turn = nlerp({}, rotation_between(now, way), by);
    lay_tip(rod, around, rod.grip + rotate(turn, now) * rod.length);
}

// Turns what hangs on it, so that `hangs`, unit, from grip to tip as the hand sees it, is where the tip is.
void turn_rod(LooseRod& rod, Vec3 hangs) {
    const Vec3 from = rotate(rod.turn, hangs), to = normalize_or(rod.tip - rod.grip, from);
    rod.turn = normalize(rotation_between(from, to) * rod.turn);
}

}  // namespace

void carry_rod(LooseRod& rod, const Surroundings& around, Vec3 grip, Vec3 way, Quat hand, float share) {
    const float by = share < 1 ? (share - rod.share) / (1 - rod.share) : 1;
    rod.share = share;
    if (share > 0)
        point_rod(rod, around, grip, way, by);
    else
        swing_rod(rod, around, grip);
    turn_rod(rod, rotate(conjugate(hand), way));
    if (share > 0) rod.turn = nlerp(rod.turn, hand, by);
}

}  // namespace flaneur
