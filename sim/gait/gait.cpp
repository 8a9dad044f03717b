#include "sim/gait/gait.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/gait/jump.h"
#include "sim/gait/norms.h"
#include "sim/gait/states.h"
#include "sim/gait/steps.h"

namespace flaneur {

float stride_length(float v, float leg) {
    return 2 * k_step_factor * leg * std::sqrt(v / std::sqrt(k_gravity * leg));
}

float duty_factor(float v) { return clamp(0.603f - 0.06f * (v - 1.24f), 0.57f, 0.66f); }

float run_frequency(float v, float leg) { return (1.29f + 0.023f * v) * std::sqrt(0.9f / leg); }

float run_duty(float v) { return clamp(0.41f - 0.03f * (v - 3.1f), 0.33f, 0.43f); }

static Stepper stepper_at(Gait& gait, size_t i, const City& city, Vec3 root, float heading) {
    int lane = static_cast<int>(i % k_block);
    const PersonBlock& person = gait.people[i / k_block];
    return {gait.blocks[i / k_block],
            person,
            lane,
            city,
            root,
            {},
            {},
            heading,
            0,
            heading_direction(heading),
            person.joints[left_upper_leg][1][lane],
            0,
            false};
}

void start_gait(Gait& gait, size_t count, const std::vector<Body>& bodies, const uint32_t* body,
                const float* scale, const RootMotion& root, const City& city, uint64_t seed,
                const Manner* manner) {
    gait.count = count;
    gait.blocks.assign(block_count(count), {});
    gait.people.assign(block_count(count), {});
    // Lanes past the last walker hold a body too, so that kernels meet only sound numbers.
    for (size_t i = 0; i < gait.blocks.size() * k_block; ++i) {
        PersonBlock& person = gait.people[i / k_block];
        GaitBlock& g = gait.blocks[i / k_block];
        int lane = static_cast<int>(i % k_block);
        bool real = i < count;
        const Body& b = bodies[real ? body[i] : 0];
        float s = real ? scale[i] : 1;
        for (int j = 0; j < k_joint_count; ++j) {
            person.joints[j][0][lane] = b.joints[j].x * s;
            person.joints[j][1][lane] = b.joints[j].y * s;
            person.joints[j][2][lane] = b.joints[j].z * s;
        }
        RandomKey key{seed, static_cast<uint32_t>(i), 0, Purpose::style};
        Manner m = manner && real ? manner[i] : draw_manner({}, key);
        person.heel[lane] = b.heel * s;
        person.toe[lane] = b.toe * s;
        person.stride[lane] = m.stride;
        person.lead[lane] = m.lead;
        person.arm_swing[lane] = m.arm_swing;
        person.sway[lane] = m.sway;
        person.toe_out[lane] = m.toe_out;
        // Never so near that the thighs would meet.
        person.step_width[lane] = std::max(m.step_width * b.height, 0.5f * b.joints[left_upper_leg].x) * s;
        person.lean[lane] = m.lean;
        person.carriage[lane] = std::max(m.carriage, b.carriage);
        person.crouch[lane] = m.crouch * leg_length(b) * s;

        g.duty[lane] = duty_factor(0);
        g.phase[lane] = random_unit(key, 200) < 0.5f ? 0.05f : 0.55f;
        g.load[lane] = 0.5f;
        g.course[lane] = 1;
        g.standing[lane] = 1;
        Vec3 at = real ? root.position[i] : Vec3{};
        float heading = real ? root.heading[i] : 0;
        g.x[lane] = at.x;
        g.z[lane] = at.z;
        g.base[lane] = at.y;
        g.heading[lane] = heading;
        g.first[lane] = -1;
        g.frequency[lane] = 1;
        Stepper stepper = stepper_at(gait, i, city, at, heading);
        for (Side side : {k_left, k_right}) {
            g.feet[side].phase[lane] = k_rest;
            if (real) {
                replant(stepper, side);
            } else {
                set_place(g.feet[side].goal, lane, home(person, lane, side, at, heading));
                touch_down(stepper, side);
            }
        }
    }
}

void advance_gait(Gait& gait, size_t begin, size_t end, const RootMotion& root, const City& city,
                  uint64_t seed, uint32_t tick, float dt) {
    for (size_t i = begin; i < end; ++i) {
        // What a walker looks at changes every two seconds, not for all at once.
        uint32_t glance = (tick + static_cast<uint32_t>(i) * 37) / 120;
        RandomKey key{seed, static_cast<uint32_t>(i), glance, Purpose::look};
        Stepper stepper = stepper_at(gait, i, city, root.position[i], root.heading[i]);
        stepper.velocity = root.velocity[i];
        stepper.wish = root.wish ? root.wish[i] : root.velocity[i];
        stepper.turn_rate = root.turn_rate[i];
        stepper.dt = dt;
        stepper.replans = (tick + i) % 3 == 0;
        advance_walker(stepper, key);
    }
}

void jump(Gait& gait, size_t walker) {
    begin_jump(gait.blocks[walker / k_block], static_cast<int>(walker % k_block));
}

void carry_feet(Gait& gait, size_t walker, Vec3 pivot, float yaw, Vec3 by) {
    GaitBlock& g = gait.blocks[walker / k_block];
    int lane = static_cast<int>(walker % k_block);
    SinCos turn = sin_cos(yaw);
    auto carried = [&](float x, float z) {
        float dx = x - pivot.x, dz = z - pivot.z;
        return Vec2{dx * turn.cosine + dz * turn.sine, dz * turn.cosine - dx * turn.sine};
    };
    for (FootBlock& foot : g.feet) {
        for (FootBlock::Place* p : {&foot.from, &foot.to, &foot.goal}) {
            Vec2 place = carried(p->x[lane], p->z[lane]) + on_ground(pivot + by);
            p->x[lane] = place.x;
            p->y[lane] += by.y;
            p->z[lane] = place.z;
            p->yaw[lane] += yaw;
            Vec2 normal = carried(p->normal_x[lane] + pivot.x, p->normal_z[lane] + pivot.z);
            p->normal_x[lane] = normal.x;
            p->normal_z[lane] = normal.z;
        }
        Vec2 wished = carried(foot.wished_x[lane], foot.wished_z[lane]) + on_ground(pivot + by);
        foot.wished_x[lane] = wished.x;
        foot.wished_z[lane] = wished.z;
        foot.wished_yaw[lane] += yaw;
    }
    g.base[lane] += by.y;
}

}  // namespace flaneur
