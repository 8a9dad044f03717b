#include "sim/deeds/deeds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/deeds/carry.h"
#include "sim/deeds/climb.h"
#include "sim/deeds/doorway.h"
#include "sim/pose/arm.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

namespace {

using What = Deed::What;

Manner manner_of(const DoerPlan&) {
    Manner manner;
    manner.touches = 0;
    manner.curiosity = 0.15f;
    return manner;
}

// Those that nobody holds.
void close_doors(Deeds& d) {
    for (uint32_t n = 0; n < d.leaves.size(); ++n) {
        bool is_held = false;
        for (size_t i = 0; i < d.doers.size(); ++i) {
            const Deed& deed = deed_of(d, i);
            is_held = is_held || (d.doers[i].has != 0 && deed.thing == n &&
                                  (deed.what == What::push || deed.what == What::pull));
        }
        if (is_held) continue;
        step_closer(d.leaves[n], k_tick);
        let_by(d, n);
    }
}

DoerWish wish_of(Deeds& d, size_t i) {
    Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    switch (deed.what) {
        case What::take:
        case What::put:
            return carry(d, i);
        case What::push:
        case What::pull:
            return pass_door(d, i);
        case What::climb:
            return climb(d, i);
        default:
            break;
    }
    // Walks there, and on.
    constexpr float k_there = 0.5f;
    const Vec2 off = deed.at - on_ground(doer.position);
    if (length(off) < k_there) next_deed(d, doer, i);
    return {normalize_or(off, {0, 1}) * d.plans[i].speed, {}};
}

void pose_doer(const Deeds& d, size_t i, std::vector<PoseBlock>& poses) {
    BodyPose pose = body_pose_of(d.whole, i);
    pose_carrying(d, i, pose);
    pose_at_door(d, i, pose);
    pose_climbing(d, i, pose);
    set_body_pose(poses, d.gait.people[i / k_block], i, pose);
}

void pose_all(Deeds& d) {
    d.poses = d.whole;
    for (size_t i = 0; i < d.doers.size(); ++i) pose_doer(d, i, d.poses);
}

// No joint of a limb turns faster than people's; what that leaves behind comes after.
void restrain(Deeds& d) {
    constexpr float k_fastest_arm = 20;  // rad/s
    restrain_legs(d.gait, 0, d.poses.size(), k_tick, d.previous_poses, d.poses);
    for (size_t i = 0; i < d.doers.size(); ++i)
        for (const Side side : {k_left, k_right})
            slow_arm({d.previous_poses[i / k_block], i % k_block}, {d.poses[i / k_block], i % k_block}, side,
                     k_fastest_arm * k_tick);
}

}  // namespace

Deeds make_deeds(std::vector<DoerPlan> plans, Things things, std::shared_ptr<const Ground> ground,
                 const std::vector<Body>& bodies, uint64_t seed) {
    Deeds d;
    d.plans = std::move(plans);
    d.things = std::move(things);
    d.ground = std::move(ground);
    for (const Parcel& parcel : d.things.parcels)
        d.parcels.push_back(at_rest(parcel, d.things.shelves[parcel.shelf], parcel.shelf));
    d.leaves.resize(d.things.doors.size());
    d.previous_parcels = d.parcels, d.previous_leaves = d.leaves;
    if (d.plans.empty()) return d;
    std::vector<Manner> manners;
    std::vector<uint32_t> numbers;
    const std::vector<float> scales(d.plans.size(), 1);
    for (const DoerPlan& plan : d.plans) {
        Doer doer;
        doer.position = set_down(*d.ground, plan.at, 1);
        doer.motion.heading = plan.heading;
        d.doers.push_back(doer);
        d.bodies.push_back(bodies[plan.kind]);
        manners.push_back(manner_of(plan));
        numbers.push_back(static_cast<uint32_t>(numbers.size()));
    }
    start_gait(d.gait, d.plans.size(), d.bodies, numbers.data(), scales.data(), told(d.doers, d.rows),
               surroundings_of(*d.ground), seed, manners.data());
    for (size_t i = 0; i < d.plans.size(); ++i)
        d.masses.push_back(mass_of(d.gait.people[i / k_block], i % k_block));
    d.whole.resize(d.gait.blocks.size());
    pose_blocks(d.gait, 0, d.whole.size(), d.whole);
    d.before = d.whole;
    pose_all(d);
    d.previous_poses = d.poses;
    return d;
}

void forget_previous(Deeds& d) {
    d.previous_poses = d.poses, d.previous_parcels = d.parcels, d.previous_leaves = d.leaves;
}

void step_deeds(Deeds& d, uint64_t seed, uint32_t tick) {
    const size_t count = d.plans.size();
    if (count == 0) return;
    const Surroundings around = surroundings_of(*d.ground);
    d.previous_parcels = d.parcels, d.previous_leaves = d.leaves;
    for (size_t i = 0; i < count; ++i) {
        Doer& doer = d.doers[i];
        ++doer.since;
        const DoerWish want = wish_of(d, i);
        doer.motion = next_motion(doer.motion, want.wish, k_tick, want.look);
        doer.position =
            set_down(*d.ground, on_ground(doer.position) + doer.motion.velocity * k_tick, doer.position.y);
    }
    const RootMotion root = told(d.doers, d.rows);
    advance_gait(d.gait, 0, count, root, around, seed, tick, k_tick);
    for (size_t i = 0; i < count; ++i) d.doers[i].motion.feet = footwork(d.gait, i, d.doers[i].position);
    d.before.swap(d.whole);
    pose_blocks(d.gait, 0, d.whole.size(), k_tick, d.before, d.whole);
    restrain_legs(d.gait, 0, d.whole.size(), k_tick, d.before, d.whole);
    for (size_t i = 0; i < count; ++i) move_parcel(d, i), move_leaf(d, i);
    close_doors(d);
    d.previous_poses.swap(d.poses);
    pose_all(d);
    restrain(d);
}

void lead_movers(const Deeds& d, Movers& movers) {
    size_t next = d.first_mover;
    for (const ParcelNow& parcel : d.parcels) movers.places[next++] = {parcel.place, parcel.turn};
    for (size_t i = 0; i < d.leaves.size(); ++i) {
        const SwingDoor& door = d.things.doors[i];
        const LeafNow& now = d.leaves[i];
        const Quat turn = rotation_y(leaf_yaw(door, now.angle));
        movers.places[next++] = {on_leaf(door, now.angle, {}), turn};
        const float down = door.hinge_left ? -now.lever : now.lever;
        movers.places[next++] = {
            on_leaf(door, now.angle, {door.width - k_handle_from_edge, k_handle_high, 0}),
            normalize(turn * rotation_z(down))};
    }
}

JointPose joint_between(const Deeds& d, size_t doer, Joint joint, float between) {
    return joint_between(d.previous_poses, d.poses, doer, joint, between);
}

DeedContacts contacts_of(const Deeds& d, size_t i) {
    const Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    DeedContacts c;
    for (size_t side = 0; side < 2; ++side)
        c.stands[side] = d.gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
    if (deed.what == What::climb && doer.stage == DoerStage::act) {
        const ClimbHolds holds = climb_holds(d, i);
        for (size_t side = 0; side < 2; ++side)
            c.palms[side] = holds.palms[side], c.holds[side] = holds.hands[side],
            c.stands[side] = holds.feet[side];
        return c;
    }
    if (doer.has == 0) return c;
    if (doer.parcel != k_no_parcel) {
        for (const Side side : {k_left, k_right}) {
            c.palms[side] = grip_of(d.things.parcels[doer.parcel], d.parcels[doer.parcel], side, 0).place;
            c.holds[side] = true;
        }
    } else if (deed.what == What::push || deed.what == What::pull) {
        const bool pushes = deed.what == What::push;
        const Side side = hand_at(d.things.doors[deed.thing], pushes);
        c.palms[side] = handle_of(d.things.doors[deed.thing], d.leaves[deed.thing], pushes);
        c.holds[side] = true;
    }
    return c;
}

std::string what_it_does(const Deeds& d, size_t i) {
    const Doer& doer = d.doers[i];
    auto kilograms = [&] {
        char words[16];
        std::snprintf(words, sizeof words, "%.0f kg", wide(d.things.parcels[doer.parcel].mass));
        return std::string(words);
    };
    const bool goes = doer.stage == DoerStage::go, has = doer.has != 0;
    switch (deed_of(d, i).what) {
        case What::take:
            if (doer.stage == DoerStage::reach) return "reaches for a box";
            if (doer.stage == DoerStage::act) return "lifts " + kilograms();
            return has ? "steps back with " + kilograms() : "goes for a box";
        case What::put:
            if (goes) return "carries " + kilograms();
            return has ? "puts " + kilograms() + " down" : "lets go of it";
        case What::push:
        case What::pull: {
            const bool pushes = deed_of(d, i).what == What::push;
            if (goes) return doer.arms > 0 ? "reaches for the handle" : "goes to a door";
            if (has) return pushes ? "pushes the door open" : "pulls the door open";
            return "goes through, the door falls shut";
        }
        case What::climb:
            return goes ? "goes to a wall" : "climbs over a wall";
        case What::walk:
            return "walks";
    }
    return {};
}

float laden_speed(float speed, float mass, float load) {
    constexpr float k_in_hands = 1.9f, k_slowest = 0.45f;
    const float felt = k_in_hands * load, all = mass + felt;
    const float stands = 2 * all * (felt / mass) * (felt / mass);
    const float left = 1.5f * mass * speed * speed - stands;
    return std::max(std::sqrt(std::max(left, 0.0f) / (1.5f * all)), k_slowest);
}

float laden_lean(float mass, float height, float load, float ahead) {
    constexpr float k_share = 0.5f, k_upper = 0.678f, k_high = 0.2f, k_most = 0.42f;
    const float sine = load * ahead / (k_upper * mass * k_high * height);
    return k_share * std::min(sine, k_most);
}

}  // namespace flaneur
