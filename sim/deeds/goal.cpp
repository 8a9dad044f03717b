#include "sim/deeds/goal.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

DoerWish wish_to(const Doer& doer, const Spot& goal, float speed) {
    constexpr float k_line = 0.9f, k_carrot = 0.5f, k_brakes = 1, k_slow = 0.24f, k_least = 0.09f,
                    k_near = 0.17f, k_there = 0.02f;
    const Vec2 ahead = heading_direction(goal.heading);
    const Vec2 off = goal.at - on_ground(doer.position);
    const float left = length(off), before = dot(off, ahead);
    DoerWish w;
    if (left < k_near) {
        w.look = ahead;
        if (left > k_there) w.wish = off * (clamp(2 * left, k_least, k_slow) / left);
        return w;
    }
    const Vec2 aim = goal.at - ahead * clamp(before - k_carrot, 0, k_line);
    const float pace =
        std::max(std::min(speed, std::sqrt(2 * k_brakes * std::max(left - 0.12f, 0.0f))), 0.3f);
    w.wish = normalize_or(aim - on_ground(doer.position), ahead) * pace;
    w.look = ahead;
    return w;
}

bool is_at(const Deeds& d, size_t i, const Spot& goal) {
    constexpr float k_off = 0.035f, k_turned = 4 * k_radians, k_still = 0.02f;
    const Doer& doer = d.doers[i];
    const GaitBlock& g = d.gait.blocks[i / k_block];
    const size_t lane = i % k_block;
    return length(goal.at - on_ground(doer.position)) < k_off && length(doer.motion.velocity) < k_still &&
           std::fabs(wrap_angle(goal.heading - doer.motion.heading)) < k_turned &&
           std::fabs(doer.motion.turn_rate) < 0.05f && g.standing[lane] != 0 &&
           g.feet[0].swinging[lane] == 0 && g.feet[1].swinging[lane] == 0;
}

DoerWish wish_back(const Spot& goal) {
    constexpr float k_back = 0.245f;  // m/s: any faster, and one would turn round
    const Vec2 ahead = heading_direction(goal.heading);
    return {ahead * -k_back, ahead};
}

Someone someone(const Deeds& d, size_t i) {
    return {d.gait.people[i / k_block], static_cast<int>(i % k_block)};
}

float toes_ahead(const Deeds& d, size_t i) {
    const Body& body = d.bodies[i];
    return body.joints[left_toes].z + body.toe;
}

void next_stage_of(Doer& doer, DoerStage stage) { doer.stage = stage, doer.since = 0; }

void next_deed(Deeds& d, Doer& doer, size_t number) {
    doer.deed = (doer.deed + 1) % static_cast<uint32_t>(d.plans[number].round.size());
    ++doer.done;
    next_stage_of(doer, DoerStage::go);
}

const Deed& deed_of(const Deeds& d, size_t i) { return d.plans[i].round[d.doers[i].deed]; }

}  // namespace flaneur
