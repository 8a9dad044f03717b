#include "tests/sim/gait/tried.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {

Tried make_tried(Ground ground, float height) {
    Tried t;
    t.ground = std::move(ground);
    t.height = height;
    uint32_t body = 0;
    float scale = 1;
    if (auto hit = ground_at(t.ground, {0, 1, 0}, 3, 4)) t.position.y = hit->height;
    RootMotion root{&t.position,         &t.motion.velocity, &t.motion.heading,
                    &t.motion.turn_rate, &t.motion.aim,      &t.motion.brakes};
    Manner short_steps;
    short_steps.stride = 0.9f;
    start_gait(t.gait, 1, {standard_body(height)}, &body, &scale, root, surroundings_of(t.ground), 5,
               &short_steps);
    t.poses.resize(1);
    pose_blocks(t.gait, 0, 1, t.poses);
    return t;
}

static void observe(Tried& t) {
    pose_blocks(t.gait, 0, 1, k_tick, t.poses, t.poses);
    t.fastest = t.drift = t.slide = 0;
    for (int j = 0; j < k_joint_count; ++j) {
        JointPose p = joint_pose(t.poses, 0, static_cast<Joint>(j));
        ASSERT_TRUE(std::isfinite(dot(p.position, p.position)));
        float d = std::min(1.0f, std::fabs(dot(p.rotation, t.rotations[j])));
        if (t.tick > 0) t.fastest = std::max(t.fastest, 2 * std::acos(d) / k_tick / k_radians);
        t.rotations[j] = p.rotation;
    }
    Vec3 pelvis = joint_pose(t.poses, 0, hips).position;
    Vec3 second = pelvis - t.pelvis * 2 + t.pelvis_before;
    t.acceleration = t.tick > 1 ? length(second) / (k_tick * k_tick) : 0;
    t.pelvis_before = t.pelvis;
    t.pelvis = pelvis;
    for (Side side : {k_left, k_right}) {
        Sole now = sole(t.poses, t.gait, 0, side);
        bool air = t.in_air(side);
        if (t.tick > 0 && !air && !t.swinging[side]) {
            const Sole& last = t.soles[side];
            t.drift = std::max(t.drift, std::min(length(now.heel - last.heel), length(now.ball - last.ball)));
            t.slide = std::max(t.slide, std::min(length(on_ground(now.heel - last.heel)),
                                                 length(on_ground(now.ball - last.ball))));
        }
        t.landed[side] = !air && t.swinging[side];
        t.swinging[side] = air;
        t.soles[side] = now;
    }
}

void advance(Tried& t, Vec2 wish) {
    GroundHit under;
    if (auto hit = ground_at(t.ground, t.position)) under = *hit;
    t.wish = wish_on(under, wish, stair_pace(k_leg_share * t.height));
    t.motion = next_motion(t.motion, t.wish, k_tick, t.look);
    t.position += at_height(t.motion.velocity * k_tick, 0);
    if (auto hit = ground_at(t.ground, t.position, 1)) t.position.y = hit->height;
    RootMotion root{&t.position,         &t.motion.velocity, &t.motion.heading,
                    &t.motion.turn_rate, &t.motion.aim,      &t.motion.brakes};
    advance_gait(t.gait, 0, 1, root, surroundings_of(t.ground), 5, t.tick, k_tick);
    t.motion.feet = footwork(t.gait, 0, t.position);
    observe(t);
    ++t.tick;
}

void for_seconds(Tried& t, float seconds, Vec2 wish, const std::function<void()>& check) {
    for (int k = 0; k < static_cast<int>(seconds / k_tick); ++k) {
        advance(t, wish);
        if (check) check();
    }
}

Ground wide_floor() {
    Ground ground;
    add_floor(ground, {-150, -150}, {150, 150}, 0, Surface::plaza);
    index_ground(ground);
    return ground;
}

float leftward(const Tried& t) {
    Vec2 facing = heading_direction(t.motion.heading);
    return dot(t.foot_place(k_left) - t.foot_place(k_right), {facing.z, -facing.x});
}

}  // namespace flaneur
