// The library: people who walk in somebody else's program, on somebody else's ground. This header is all of
// it, and its manual.
//
//     const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
//     const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
//     auto world = flaneur::make_world({corners, triangles}, {.capacity = 100});
//     if (!world) return std::puts(world.error().message.c_str()), 1;
//     for (int i = 0; i < 100; ++i) (void)add_walker(**world, {.wanders = true});
//     for (int tick = 0; tick < 600; ++tick) step(**world);
//     for (WalkerId id : walkers(**world)) {
//         Vec3 p = motion_of(**world, id)->position;
//         std::printf("%.2f %.2f %.2f\n", p.x, p.y, p.z);
//     }
//
// Units and axes: metres, seconds, radians. Right-handed, +y up; one who stands with heading 0 faces +z, and
// headings grow towards +x. Time goes on in ticks of 1/60 s; whoever draws at another rate asks for poses
// between the last two ticks.
//
// Errors: what a program cannot know beforehand (is there ground, is there room, is that one still there)
// comes back as a Result or an empty optional. Breaking what is written here as a must is a bug of the
// caller; debug builds assert it.
//
// Threads: worlds share nothing. Functions that take a `const World&` may run on any number of threads at
// once, but not beside one that changes the same world. make_world, add_walker and send_to may take long;
// step, remove_walker, let_wander and all that takes a `const World&` allocate nothing.
//
// Determinism: the same ground, options and calls in the same order give the same world to the last bit, on
// any number of threads, with any instruction set and compiler (hash_world says so). Between kinds of
// machines (x86-64, arm64) so too where Recast is built with -ffp-contract=off; see docs/determinism.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/alongside/shares.h"
#include "sim/animation/clip.h"
#include "sim/ball/ball.h"
#include "sim/base/result.h"
#include "sim/base/tasks.h"
#include "sim/base/vec.h"
#include "sim/body/body.h"
#include "sim/coming/sending.h"
#include "sim/crowd/demand.h"
#include "sim/crowd/habit.h"
#include "sim/crowd/pass_on.h"
#include "sim/crowd/walker_id.h"
#include "sim/fall/planned_push.h"
#include "sim/ground/ground.h"
#include "sim/ground/surroundings.h"
#include "sim/lamps/kerbs.h"
#include "sim/lanes/lanes.h"
#include "sim/limbs/limbs.h"
#include "sim/navigation/navmesh.h"
#include "sim/pastimes/places.h"
#include "sim/pose/pose.h"

namespace flaneur {

struct World;
struct WorldDelete {
    void operator()(World*) const;
};
using WorldPtr = std::unique_ptr<World, WorldDelete>;

// What people stand on and bump into.
struct Triangles {
    std::span<const Vec3> positions{};
    // Three a triangle, counter-clockwise seen from above or from outside. What is less steep than
    // NavmeshSettings::max_slope_degrees is ground; all else is wall, which stops people and paths where it
    // is higher than NavmeshSettings::max_climb, and is stepped over where it is not: kerbs and steps.
    std::span<const uint32_t> indices{};
    // One a triangle, what kind of ground it is; none: all is plaza. Nobody walks on water or
    // railway tracks, and paths prefer sidewalks, paths and plazas to grass and roads.
    std::span<const Surface> kinds{};
};

// A body that walkers may have, and who has such a body.
struct Kind {
    // standard_body(height), or the joints of one's own character in the canonical pose (see Body). All must
    // be finite, legs longer than 0.1 m, their thighs and shanks than 0.05 m.
    Body body;
    float share = 1;  // how many have it, against the other kinds' shares; above 0
    float age = 30;  // years, 5..100: with sex and legs it sets how fast they walk, and with it how they move
    bool woman = false;
};

struct WorldOptions {
    uint32_t capacity = 0;  // walkers there can be at one time, up to 1,000,000; raised to `walkers`
    uint32_t walkers = 0;   // of them set down by chance at the start, 0.95..1.05 times their body, to wander
    Habit habit = Habit::wander;   // theirs,
    std::vector<Vec2> platform{};  // and where they stagger
    // Whether those who ramble do so at the pace of limbs on curves, and turn as slowly; and how. Of poses
    // see pose_without() in sim/without.h.
    LimbLead limbs = LimbLead::gait;
    LimbCurves curves{};
    // How much everybody has had, 0..1: 1 hardly walks; see add_drink() in sim/body/manner.h. With `drunks`,
    // the first so many alone have, and stagger on the platform, and the others are sober and do as is their
    // habit.
    float drunk = 0;
    uint32_t drunks = 0;
    uint64_t seed = 1;   // of all that is left to chance
    int threads = 0;     // that make_world and step use, the calling one included, to 1024; 0: one a core
    TaskSystem tasks{};  // one's own threads instead, if `run` is set; paths are prepared on the caller's
    std::vector<Kind> kinds{{standard_body(1.72f)}};  // at least one
    // One's own answers to where exactly the ground is, for feet, and where walls are, for hands: a height
    // field, a physics engine. The triangles say where people can go, and may be coarser (by 0.3 m in
    // height). Asked from all threads at once. Where `ground` is null the triangles answer both; with it, a
    // null `wall` means that hands find no walls.
    Surroundings around{};
    NavmeshSettings navmesh{};
    std::vector<Destination> destinations{};  // where those go who wander; none: they stroll
    // How many of those who wander leave at the destinations they get to, by their kind; as many come in at
    // such places. Else nobody comes or goes but by add_walker and remove_walker. k_usual_leaving is usual.
    // They do so by doors, a metre behind whose wall they begin and end, or, where no wall would hide them,
    // within half a second where they are: WalkerMotion::presence says how much of them to draw.
    Leaving leaving = k_nobody_leaves;
    // People who are sent at their time, and leave where they are sent; beside `walkers`, and as far as
    // `capacity` lets them in.
    std::vector<Sending> sendings{};
    float hour = 17.5f;                  // of the day, 0..24, at the first tick: who goes where
    PassOn pass_on = PassOn::right;      // the side on which people pass who come from the other way
    std::vector<PlannedPush> pushes{};   // that people get by and by
    std::vector<PlannedThrow> throws{};  // of balls at them, the same; at most k_most_balls are there at once
    // How many of those near who could help up somebody who has fallen do, 0..1; the agreeable rather than
    // others. Where it is 0 nobody minds who falls but to go round them.
    float helpers = k_usual_helpers;
    // Where people wait for lamps; of those crossings that have one. How many go on red, 0..1: fewer of
    // children, the old and the dutiful, more of those who have drunk.
    Crossings crossings{};
    float jaywalkers = k_usual_jaywalkers;
    // How many of those who wander are alone, in pairs, in threes and in fours, against the others: they
    // walk, stand and talk together, and children below ten are never alone. As it is, everybody is by
    // itself.
    std::array<float, 4> groups{1, 0, 0, 0};
    // How likely two who come towards each other and walk alone know each other, 0..1: they greet, stop and
    // talk.
    float acquaintances = 0;
    // Dogs, wheelchairs, white canes, umbrellas and musicians among those who are set down or come in.
    AlongShares along{};
    // What people do who stay, and where: sit, lean, look at windows, line up, use a phone
    // (docs/life/pastimes.md).
    PastimeShares pastimes{};
    PastimePlaces pastime_places{};
    // Where one drives, and how many do, 0..1: 0 nobody, 0.5 as usual, 1 as in a rush hour.
    Lanes lanes{};
    float traffic = 0;
    std::vector<Clip> idles{};  // by make_additive_clip(humanoid(body), ...); who stands a while plays one
};

// Takes seconds for a city, as paths are prepared. Triangles and options are copied; what `around.asked` and
// `tasks.user` point to must outlive the world. Refuses, with a sentence: indices beyond the positions,
// numbers that are not finite, ground too small to stand on or without room for `walkers`, options out of
// range.
Result<WorldPtr> make_world(const Triangles& triangles, const WorldOptions& options = {});

// The same on ground that knows kerbs, walls and obstacles by themselves, such as City::ground of
// flaneur::assets; it is copied, and must be indexed, as that is. Give City::destinations as
// WorldOptions::destinations.
Result<WorldPtr> make_world_on(const Ground& ground, const WorldOptions& options = {});

struct WalkerOptions {
    std::optional<Vec3> place{};  // on the ground or within 2 m of it; none: by chance where there is room
    float heading = 0;
    std::optional<uint32_t> kind{};  // index into WorldOptions::kinds; none: by chance and share
    float scale = 1;                 // of the kind's body, 0.5..2
    std::optional<float> speed{};    // m/s that it likes to walk, 0.3..2; none: as people of its kind do
    float radius = 0.2f;             // of the room that nobody else enters, 0.1..0.5
    bool wanders = false;            // strolls from place to place; else it stands until it is sent
};

// Refuses, with a sentence: a full world, a place without ground or where somebody stands, options out of
// range.
Result<WalkerId> add_walker(World& world, const WalkerOptions& options = {});

// Whoever walks on: the walker is gone at once, and nobody avoids it. False if it was gone before.
bool remove_walker(World& world, WalkerId id);
bool is_alive(const World& world, WalkerId id);

// All who are there, in no particular order but the same in equal runs; until somebody is added or removed.
std::span<const WalkerId> walkers(const World& world);

// Sends a walker to the walkable place nearest to `goal`, within 2 m. It goes by the best way, stands there
// and waits. Refuses a walker that is gone, a goal without ground, and one to which there is no way. The way
// itself is found in the next ticks, 32 walkers' in each.
Result<void> send_to(World& world, WalkerId id, Vec3 goal);
// Lets it stroll from place to place. False if it is gone.
bool let_wander(World& world, WalkerId id);
// Lets it jump: one who walks leaps with the next step, 0.3-0.36 s through the air, one who stands hops;
// where the ground ahead has a gap or a ledge, as far as that asks for. Nothing changes where it goes, and
// nothing happens while it jumps already. False if it is gone.
bool let_jump(World& world, WalkerId id);
// Pushes a walker at the height of its chest by so many newton seconds, along the ground plane (a push of 50
// changes the speed of one of 70 kg by 0.7 m/s). It sways, or steps, or falls, lies for a moment and gets up:
// nobody falls whose speed changes by less than k_harmless_push, all do by more than k_felling_push, and
// between by how it stands to the push, how old, tall and sober it is (sim/fall/balance.h). False if it is
// gone, comes in or leaves just now, pushes a pram, sits or leans at a wall, roams a compound or steps on a
// course that is flat; on one that is not it holds its own where it would fall off.
bool push(World& world, WalkerId id, Vec2 impulse);
// Throws a ball, which pushes whom it hits. Not on a compound, where it would fall for ever.
void throw_ball(World& world, const Ball& ball);
// Whether it falls, lies or gets up.
bool has_fallen(const World& world, WalkerId id);
// Ways to go without a goal of one's own, until it is sent or let do something else. All keep off walls and
// out of others' way as anybody does. One who goes by somebody who is gone stands. Each refuses a walker that
// is gone, and what its last argument cannot be.
//
// After `whom`, some `distance` metres behind, 0.5..20: straight where nothing is between, else by the best
// way; it hurries a little where it falls behind, and stands where the other does.
Result<void> let_follow(World& world, WalkerId id, WalkerId whom, float distance = 1.2f);
// To a goal as by send_to, waiting where `whom`, who may follow it, falls more than `most` metres
// behind, 1..50.
Result<void> let_lead(World& world, WalkerId id, WalkerId whom, Vec3 goal, float most = 5);
// Away from `whom` while that one is nearer than `range` metres, 1..100; then it stands.
Result<void> let_flee(World& world, WalkerId id, WalkerId whom, float range = 10);
// Straight on until a ray 4 m ahead meets a wall, then where one of a fan of rays is free for 5 m; where none
// is, on to a metre from the wall, and then where the longest leads: see sim/ways/rays.h.
bool let_ramble(World& world, WalkerId id);
// Along circles on a convex platform, never straight: see sim/ways/stride.h. `corners` are 3 to 16, in metres
// on the ground plane, walkable and joined to where the walker is; one who is beside it walks there. With
// another platform, one who staggers goes on on that one.
Result<void> let_stagger(World& world, WalkerId id, std::span<const Vec2> corners);
// Whether it stands where it was last sent, or was set down. Where others stand on the goal, next to them
// is there.
bool has_arrived(const World& world, WalkerId id);

// One tick, 1/60 s.
void step(World& world);

// Simulation level of detail. From now on those who are farther than `reach` metres from every eye decide at
// 7.5 Hz instead of 15, and walk and step an eighth of the time, eight ticks at once: blocks of sixteen
// walkers all of whom are. Twice as far they do half of that, sixteen ticks at once. They still meet nobody
// and no wall. In equal runs, whose programs tell the same eyes before the same ticks, the world is the same
// to the last bit. Without eyes, as at the start, everybody is in full.
void look_from(World& world, std::span<const Vec3> eyes, float reach = 120);

struct WalkerMotion {
    Vec3 position{};    // on the ground, between the feet
    Vec2 velocity{};    // m/s over the ground plane
    float heading = 0;  // where the body faces: yaw about +y, in [-pi, pi]
    uint32_t kind = 0;
    float scale = 1;     // of the kind's body
    float presence = 1;  // how much of it is to be seen, 0..1: see WorldOptions::leaving
};
// After the last tick. None if the walker is gone.
std::optional<WalkerMotion> motion_of(const World& world, WalkerId id);

// Writes where each joint is in the world and how it is turned, by Joint (k_joint_names, k_joint_parents).
// Rotations take the axes of the canonical pose, in which all are the identity, to the joint's. `between` is
// 0 for the tick before the last .. 1 for the last. False, and nothing written, if the walker is gone.
bool pose_of(const World& world, WalkerId id, std::span<JointPose, k_joint_count> joints, float between = 1);

// Who came in and left by themselves so far (WorldOptions::leaving and sendings), how many are due to come in
// and have found no room yet, and how many of those sent had no way from where they were to come in to where
// they went.
struct ComingCount {
    uint32_t came = 0, left = 0, waiting = 0, lost = 0;
};
ComingCount coming_count(const World& world);

// The same of those whom one sending sends. Of those who came, who is neither under way nor has arrived was
// taken out or sent elsewhere by others.
struct SentCount {
    uint32_t came = 0, under_way = 0, arrived = 0, waiting = 0, lost = 0;
    uint32_t later = 0;  // are not due yet
};
// By sending, in the order of WorldOptions::sendings.
std::vector<SentCount> sent_counts(const World& world);

// The hash of the whole state, poses included.
uint64_t hash_world(const World& world);

}  // namespace flaneur
