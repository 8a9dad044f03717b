#include "sim/roam.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

Roam::Frame frame_on(const SurfaceWalkers& w, size_t i) {
    return {w.position[i], frame_of(w.up[i], w.ahead[i])};
}

float size_of_creature(uint64_t seed, uint32_t number) {
    return random_between({seed, number, 2, Purpose::spawn}, 1.1f, 1.9f);
}
// A third of its length a second at least, as it likes.
float speed_of_creature(uint64_t seed, uint32_t number, float size) {
    return size * random_between({seed, number, 3, Purpose::spawn}, 0.45f, 0.7f);
}

}  // namespace

Result<Roam> make_roam(Compound compound, const Crowd& crowd, uint32_t creatures, uint64_t seed,
                       Gravity gravity) {
    Roam roam;
    roam.compound = std::move(compound);
    roam.gravity = gravity.points.empty() ? gravity_of(roam.compound, k_usual_pull) : std::move(gravity);
    std::vector<float> speed = crowd.identity.preferred_speed, radius = crowd.identity.radius;
    speed.resize(crowd.count), radius.resize(crowd.count);
    for (uint32_t n = 0; n < creatures; ++n) {
        const float size = size_of_creature(seed, n);
        speed.push_back(speed_of_creature(seed, n, size));
        radius.push_back(creature_radius(size));
    }
    roam.walkers = place_on_surface(roam.compound, speed, radius, seed);
    const size_t placed = roam.walkers.position.size();
    if (placed == 0 && !speed.empty())
        return Error{"There is nothing to walk on where walkers are set down; give it closed shapes."};
    if (placed != speed.size())
        return Error{"Only " + std::to_string(placed) + " of " + std::to_string(crowd.count) +
                     " walkers and " + std::to_string(creatures) +
                     " creatures find room all round it; ask for fewer."};
    for (uint32_t n = 0; n < creatures; ++n) {
        const uint32_t walker = crowd.count + n;
        const float size = size_of_creature(seed, n);
        roam.creatures.push_back(make_creature(rays_of(roam.compound), roam.walkers, walker, size));
        roam.walkers.middle[walker] = creature_height(size);
        roam.walkers.leaps_at_will[walker] = 1;
    }
    for (size_t i = 0; i < crowd.count; ++i) roam.frames.push_back(frame_on(roam.walkers, i));
    roam.previous_frames = roam.frames;
    return roam;
}

void step_roam(Roam& roam, Crowd& crowd, Gait& gait, Workers& workers, uint64_t seed, uint32_t tick) {
    roam.previous_frames.swap(roam.frames);
    roam.walkers.led = crowd.driven.walker;
    look_round(roam.walkers);
    for (size_t i = 0; i < crowd.count; ++i)
        roam.walkers.stands[i] = gait.blocks[i / k_block].standing[i % k_block] != 0;
    for (const Creature& c : roam.creatures) roam.walkers.stands[c.walker] = is_standing(c);
    begin_leaps(roam.compound, roam.gravity, roam.walkers, seed, tick, k_tick);
    auto go = [&](size_t begin, size_t end) {
        walk_on_surface(roam.compound, roam.walkers, begin, end, seed, tick, k_tick);
        go_on_leaping(roam.compound, roam.gravity, roam.walkers, begin, end, k_tick);
    };
    for (const Creature& c : roam.creatures) go(c.walker, c.walker + 1);
    // A block of the gait's walkers at least, which lie side by side.
    parallel_for(workers, crowd.count, 4 * k_block, [&](size_t begin, size_t end, int) {
        SurfaceWalkers& w = roam.walkers;
        go(begin, end);
        for (size_t i = begin; i < end; ++i) {
            roam.frames[i] = frame_on(w, i);
            Vec2 way = heading_direction(crowd.motion.heading[i]) * w.moved[i];
            crowd.motion.velocity[i] = crowd.motion.wish[i] = way / k_tick;
            crowd.motion.turn_rate[i] = w.turn_rate[i];
            carry_feet(gait, i, crowd.motion.position[i], -w.turn_rate[i] * k_tick, at_height(-way, 0));
            const float leg = gait.people[i / k_block].joints[left_upper_leg][1][i % k_block];
            gait.blocks[i / k_block].crouch[i % k_block] = leap_crouch(w.leaps[i], leg);
        }
    });
}

Linkages make_bones(const std::vector<Creature>& creatures) {
    std::vector<Linkage> all;
    all.reserve(creatures.size());
    for (const Creature& creature : creatures) all.push_back(creature_linkage(creature.size));
    Linkages bones = make_linkages(std::move(all));
    for (size_t n = 0; n < creatures.size(); ++n)
        place_creature(bones.all[n], creatures[n], places_of(bones, n));
    bones.previous_places = bones.places;
    return bones;
}

void step_creatures(Roam& roam, Linkages& linkages, Workers& workers) {
    parallel_for(workers, roam.creatures.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t n = begin; n < end; ++n) {
            Creature& creature = roam.creatures[n];
            step_creature(rays_of(roam.compound), roam.walkers, creature, k_tick);
            place_creature(linkages.all[n], creature, places_of(linkages, n));
        }
    });
}

namespace {

// How far somebody's joints are from those of one who stands, 0 to 1.
struct LeapPose {
    float winds = 0;    // the trunk leans ahead and the arms are back, before
    float springs = 0;  // toes push, arms swing up
    float hangs = 0;    // legs are drawn up
    float gives = 0;    // the trunk leans ahead and arms are out, after
};

LeapPose pose_of(const Leap& leap, float seconds) {
    constexpr float k_spring = 0.16f, k_draw = 0.45f, k_reach = 0.35f;
    LeapPose p;
    switch (leap.stage) {
        case LeapStage::crouches:
            p.springs = smoothstep(k_crouch_seconds - 0.2f, k_crouch_seconds, seconds);
            p.winds = smoothstep(0, 0.2f, seconds) * (1 - p.springs);
            break;
        case LeapStage::flies:
            p.hangs = smoothstep(0.02f, k_draw, seconds) *
                      (1 - smoothstep(leap.lasts - k_reach, leap.lasts, seconds));
            p.springs = 1 - smoothstep(k_spring, k_draw, seconds);
            p.gives = smoothstep(leap.lasts - k_reach, leap.lasts, seconds);
            break;
        case LeapStage::absorbs:
            p.gives = 1 - smoothstep(0.3f * k_absorb_seconds, k_absorb_seconds, seconds);
            break;
        default:
            break;
    }
    return p;
}

bool is_below(int joint, Joint top) {
    for (; joint >= 0; joint = k_joint_parents[static_cast<size_t>(joint)])
        if (joint == top) return true;
    return false;
}

// Turns a joint and all that hangs on it by `angle` about a unit axis through it.
void bend(std::span<JointPose> joints, Joint top, Vec3 axis, float angle) {
    if (angle == 0) return;
    const Quat turn = rotation_about(axis, angle);
    const Vec3 middle = joints[top].position;
    for (int j = top; j < k_joint_count; ++j) {
        if (!is_below(j, top)) continue;
        JointPose& joint = joints[static_cast<size_t>(j)];
        joint = {middle + rotate(turn, joint.position - middle), turn * joint.rotation};
    }
}

}  // namespace

void bend_in_leap(const Roam& roam, size_t walker, float between, std::span<JointPose> joints) {
    const Leap& leap = roam.walkers.leaps[walker];
    if (leap.stage == LeapStage::none || leap.stage == LeapStage::gathers) return;
    const LeapPose p = pose_of(leap, std::max(leap.seconds - (1 - between) * k_tick, 0.0f));
    const Vec3 left = rotate(joints[hips].rotation, {1, 0, 0}),
               ahead = rotate(joints[hips].rotation, {0, 0, 1});
    constexpr Joint k_legs[2][3] = {{left_upper_leg, left_lower_leg, left_foot},
                                    {right_upper_leg, right_lower_leg, right_foot}};
    constexpr Joint k_arms[2][2] = {{left_upper_arm, left_lower_arm}, {right_upper_arm, right_lower_arm}};
    bend(joints, spine, left, 0.35f * p.winds + 0.3f * p.gives + 0.12f * p.hangs);
    for (const Side side : {k_left, k_right}) {
        const float out = side == k_left ? 1.0f : -1.0f, more = side == k_left ? 1.0f : 0.7f;
        const auto& [thigh, shank, foot] = k_legs[side];
        bend(joints, thigh, left, -0.75f * more * p.hangs);
        bend(joints, shank, left, 1.15f * more * p.hangs);
        bend(joints, foot, left, 0.45f * p.hangs);
        const auto& [arm, forearm] = k_arms[side];
        bend(joints, arm, left, 0.75f * p.winds - 1.9f * p.springs - 0.5f * p.gives - 0.35f * p.hangs);
        bend(joints, arm, ahead, out * (0.75f * p.hangs + 0.45f * p.gives + 0.15f * p.springs));
        bend(joints, forearm, left, -0.5f * p.hangs - 0.3f * p.gives - 0.2f * p.winds);
    }
}

JointPose set_onto(const Roam::Frame& frame, Vec3 root, float heading, const JointPose& joint) {
    Quat turn = frame.rotation * rotation_y(-heading);
    return {frame.position + rotate(turn, joint.position - root), turn * joint.rotation};
}

}  // namespace flaneur
