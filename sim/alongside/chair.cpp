// Wheelchairs: what wheels do, and who sits in them.
//
// One pushes about once a second at 1 m/s, over some 85 degrees of the rim, and brings the hands back
// meanwhile for somewhat longer than that takes (Boninger et al., "Propulsion patterns and pushrim
// biomechanics in manual wheelchair propulsion", Archives of Physical Medicine and Rehabilitation 83, 2002).
#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/alongside/parts.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/fall/limbs.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_usual_height = 1.72f;  // metres
constexpr float k_stroke = 1.02f;        // metres that one push takes it, of a chair of size 1
constexpr float k_from = -0.22f;         // radians ahead of the top of the rim, where hands take it
constexpr float k_casters = 0.42f;       // metres ahead of the axle
constexpr float k_rides = 10;            // 1/s, critically damped

float wrapped(float turn) {
    constexpr float k_round = 2 * k_pi;
    turn -= k_round * std::floor(turn / k_round);
    return turn < k_round ? turn : 0;
}

struct Under {
    float axle, pitch, roll;
};
Under ground_under(const World& w, uint32_t i, float size) {
    const CrowdMotion& m = w.crowd.motion;
    const Vec3 at = m.position[i];
    const Vec2 way = heading_direction(m.heading[i]), left = left_of(way) * (0.5f * k_chair_track * size);
    const Vec2 ahead = way * (k_casters * size);
    const Vec2 p = on_ground(at);
    const Vec3 points[] = {at_height(p + left, at.y),
                           at_height(p - left, at.y),
                           at_height(p + ahead + left * 0.7f, at.y),
                           at_height(p + ahead - left * 0.7f, at.y),
                           at_height(p + way * (0.28f * size), at.y),
                           at_height(p - way * (0.14f * size), at.y)};
    std::optional<GroundHit> hits[6];
    ground_at(w.around, points, 0.5f, 1, hits);
    float high[6];
    for (int k = 0; k < 6; ++k) high[k] = hits[k] ? hits[k]->height : at.y;
    const float rear = 0.5f * (high[0] + high[1]), front = 0.5f * (high[2] + high[3]);
    // Over an edge it rises before it, and comes down behind it.
    return {std::max({rear, high[4], high[5]}), clamp(arctan2(front - rear, k_casters * size), -0.3f, 0.3f),
            clamp(arctan2(high[0] - high[1], k_chair_track * size), -0.3f, 0.3f)};
}

void roll(const World& w, Chair& c) {
    const CrowdMotion& m = w.crowd.motion;
    const uint32_t i = c.walker;
    const float size = chair_size(w, i);
    const float on = dot(m.velocity[i], heading_direction(m.heading[i])) * k_tick;
    const float turns = m.turn_rate[i] * k_tick * 0.5f * k_chair_track * size;
    for (const Side side : {k_left, k_right}) {
        // Headings grow to the left, where the right wheel goes farther.
        const float way = on + (side == k_left ? -turns : turns);
        c.wheels[side] = wrapped(c.wheels[side] + way / (k_chair_wheel * size));
    }
    const bool has_rims = c.push < k_pushes;
    float by = std::max(on, 0.0f) / (k_stroke * size);
    // Who comes to rest takes the rims again.
    if (!has_rims) by = std::max(by, 0.9f * k_tick);
    c.push += by;
    c.push -= std::floor(c.push);
    const Under under = ground_under(w, i, size);
    c.height_rate += ((under.axle - c.height) * k_rides - 2 * c.height_rate) * (k_rides * k_tick);
    c.height += c.height_rate * k_tick;
    c.pitch += (under.pitch - c.pitch) * std::min(6 * k_tick, 1.0f);
    c.roll += (under.roll - c.roll) * std::min(6 * k_tick, 1.0f);
}

Placement chair_at(Vec3 at, float height, float heading, const Chair& c) {
    return {at_height(on_ground(at), height),
            rotation_y(heading) * rotation_x(-c.pitch) * rotation_z(c.roll)};
}

// How far along the rim a hand is, radians ahead of its top, and how far out of it and up from it.
struct HandOnRim {
    float angle, out, up;
};
HandOnRim hand_on_rim(const Chair& c) {
    const float turned = k_stroke / k_chair_wheel;  // radians of the wheel in a whole stroke
    const float end = k_from + k_pushes * turned;
    if (c.push < k_pushes) return {k_from + c.push * turned, 0, 0};
    const float t = (c.push - k_pushes) / (1 - k_pushes), s = smoothstep(0, 1, t);
    const float arc = sin_cos(k_pi * t).sine;
    return {lerp(end, k_from, s), 0.035f * arc, 0.055f * arc};
}

}  // namespace

float chair_size(const World& w, uint32_t i) { return person_of(w, i).height[i % k_block] / k_usual_height; }

Chair make_chair(const World& w, uint32_t i) {
    Chair c;
    c.walker = i;
    const RandomKey key{w.seed, i, w.crowd.slots.generation[i], Purpose::along};
    c.push = random_between(key, 0, k_pushes, 2);
    const Under under = ground_under(w, i, chair_size(w, i));
    c.height = under.axle, c.pitch = under.pitch, c.roll = under.roll;
    return c;
}

void roll_chairs(World& w) {
    for (Chair& c : w.alongside->chairs) roll(w, c);
}

void sit_in_chair(const World& w, const Chair& c, BodyPose& pose) {
    const uint32_t i = c.walker;
    const CrowdMotion& m = w.crowd.motion;
    const float size = chair_size(w, i);
    const Holder h = holder_of(w, i);
    const Placement chair = chair_at(m.position[i], c.height, m.heading[i], c);
    const Quat looks = conjugate(pose.rotation[upper_chest]) * pose.rotation[head];
    const Quat neck_turn = conjugate(pose.rotation[upper_chest]) * pose.rotation[neck];
    // It leans into the push and comes up again.
    const float effort = smoothstep(0.15f, 0.7f, length(m.velocity[i]));
    const float stroke = c.push < k_pushes ? smoothstep(0, 1, c.push / k_pushes)
                                           : 1 - smoothstep(0, 1, (c.push - k_pushes) / (1 - k_pushes));
    const float leans = 0.05f + effort * lerp(0.08f, 0.20f, stroke);
    for (int j = 0; j < k_joint_count; ++j) pose.rotation[j] = chair.turn;
    pose.hips = to_world(chair, Vec3{0, k_chair_seat + 0.085f, 0.02f} * size);
    pose.rotation[hips] = chair.turn * rotation_x(-0.08f);
    pose.rotation[spine] = chair.turn * rotation_x(0.35f * leans);
    pose.rotation[chest] = chair.turn * rotation_x(0.75f * leans);
    for (int j : {int(upper_chest), int(left_shoulder), int(right_shoulder)})
        pose.rotation[j] = chair.turn * rotation_x(leans);
    pose.rotation[neck] = pose.rotation[upper_chest] * nlerp({}, neck_turn, 0.7f) * rotation_x(-0.4f * leans);
    pose.rotation[head] = pose.rotation[upper_chest] * looks * rotation_x(-0.8f * leans);
    // Bent at first, so that it is known to which side elbows bend.
    for (const int arm : {int(left_upper_arm), int(right_upper_arm)}) {
        pose.rotation[arm] = chair.turn * rotation_x(0.5f);
        pose.rotation[arm + 1] = pose.rotation[arm + 2] = chair.turn * rotation_x(-0.7f);
    }
    for (const Side side : {k_left, k_right}) {
        const float out = side == k_left ? 1.0f : -1.0f;
        const int thigh = side == k_left ? left_upper_leg : right_upper_leg;
        const Quat turned = chair.turn * rotation_y(0.07f * out);
        pose.rotation[thigh] = turned * rotation_x(-1.50f);
        pose.rotation[thigh + 1] = turned * rotation_x(-0.30f);
        pose.rotation[thigh + 2] = pose.rotation[thigh + 3] = turned * rotation_x(-0.06f);
        const HandOnRim hand = hand_on_rim(c);
        const SinCos at = sin_cos(hand.angle);
        const Vec3 palm{out * (0.5f * k_chair_track + 0.018f + hand.out),
                        k_chair_wheel + k_chair_rim * at.cosine + hand.up, k_chair_rim * at.sine};
        bring_palm(pose, h, side, to_world(chair, palm * size),
                   rotate(chair.turn, Vec3{1.4f * out, 0.1f, -1}), 1);
    }
}

// From the hips, which sit in it, so that both go alike between ticks.
Placement chair_between(const World& w, size_t number, float between) {
    const uint32_t i = w.alongside->chairs[number].walker;
    const JointPose hip = joint_between(w, i, hips, between);
    const Quat turn = hip.rotation * rotation_x(0.08f);
    return {hip.position - rotate(turn, Vec3{0, k_chair_seat + 0.085f, 0.02f} * chair_size(w, i)), turn};
}

}  // namespace flaneur
