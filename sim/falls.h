// Those of a world who have been pushed: who sway and step, who fall, lie and get up again. What becomes of
// their bodies is in sim/fall; here is what it has to do with crowd, gait and poses.
#pragma once

#include <span>
#include <vector>

#include "sim/crowd/crowd.h"
#include "sim/fall/balance.h"
#include "sim/fall/body_pose.h"
#include "sim/fall/rising.h"
#include "sim/fall/rod.h"
#include "sim/fall/tumble.h"

namespace flaneur {

struct World;

enum class FallPhase : uint32_t {
    sways,  // is on its feet, and may be about to fall
    falls,
    lies,
    rises,
};

struct Fall {
    uint32_t walker = 0;
    FallPhase phase = FallPhase::sways;
    uint32_t began = 0;     // tick at which this phase did
    uint32_t falls_at = 0;  // tick, of one who sways; ~0u: it stays on its feet
    uint32_t fell = 0;      // tick at which it began to fall
    Vec2 to{};              // the way it is pushed, unit
    Vec2 gives{};           // m/s that a push leaves to the body that falls, beside what it has
    Vec2 carried{};         // m/s of pushes that it has not yet come to rest over: they add up
    TrunkSway sway{};       // along the world's axes
    // Of one who falls.
    uint32_t lane = 0;          // in Falls::blocks
    Vec3 origin{};              // of the places in that block
    float floor = 0;            // height of the ground where it stood
    float energy = 0;           // joules, that it may have when the trunk is down
    float lain = 0, still = 0;  // seconds since the trunk came down, and that nothing moves
    Segments segments{};
    std::array<Quat, k_segment_count> stood{};
    Residue residue{};
    // Of one who lies or rises.
    RiseStage stage = RiseStage::side;
    float share = 0;     // of this stage
    float slowness = 1;  // of the old and the heavy
    float raised = 0;    // metres, see settle() in sim/fall/settle.h
    uint32_t rises_at = 0;
    uint32_t awaits = 0;  // 1: who helps is on the way
    uint32_t held = 0;    // 1: the left hand is held by who helps, 2: the right one, 3: both
    Lie lie{};
    Vec2 hips_at{};     // as it begins to rise
    Vec2 stands_at{};   // where it comes to stand
    BodyPose from{};    // at the end of the last stage
    BodyPose stance{};  // in which it will stand
};

struct Falls {
    std::vector<Fall> all;       // by walker
    std::vector<LooseRod> rods;  // their canes, from when they fall until they stand again; by walker
    // Sixteen who fall, by lane; scratch but for `blocks`.
    std::vector<TumbleBlock> blocks;
    std::vector<TumbleShapes> shapes;
    std::vector<TumbleAims> aims;
    std::vector<TumblePlanes> planes;
    std::vector<uint32_t> lane_of;  // who has a lane: index into `all`, or ~0u; anew each tick
};

// So that ticks allocate nothing while no more than `count` have been pushed and are not done with it.
void make_room_to_fall(World& world, size_t count);

// See push() in sim/sim.h; `change` is of the speed, m/s, on the ground plane. Whom it is pushed against gets
// a part of it.
void push_walker(World& world, uint32_t walker, Vec2 change);

// After poses are found, before what trails them: poses of those in `falls` are set anew.
void step_falls(World& world);

// Of all that the next tick depends on.
uint64_t hash_falls(const World& world);

// Walkers within `reach` metres of a place on the ground plane, by their numbers, as many as there is room
// for; returns how many.
size_t those_near(const World& world, Vec3 place, float reach, std::span<uint32_t> found);

// From lying to standing (sim/fall/get_up.cpp). How long it lies before getting up, how slowly it does that,
// and which way;
void lie_down(World& world, Fall& fall);
// where it lies is where others find it;
void follow_hips(World& world, const Fall& fall);
// it breathes, and shins that came to rest in the air are let down;
void lie_on(World& world, Fall& fall);
void begin_to_rise(World& world, Fall& fall);
// its place comes to where it will stand, before poses are found,
void choose_stand(World& world, Fall& fall);
// and a tick of its body.
void rise_on(World& world, Fall& fall);

// Where it lies, by rows of its body that others go round.
Downed lying(const World& world, const Fall& fall);
// Seconds that it will take to get up, from where it lies.
float seconds_to_rise(const Fall& fall);

// It is gone, whatever became of it.
void forget_fall(World& world, uint32_t walker);

}  // namespace flaneur
