// What lies behind a World of sim.h, for this project's own tools: ground with people on it, and the tick
// that moves them on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/animation/layer.h"
#include "sim/balls.h"
#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/body/body.h"
#include "sim/body/personality.h"
#include "sim/bystanders.h"
#include "sim/coming/coming.h"
#include "sim/company/company.h"
#include "sim/crowd/crowd.h"
#include "sim/deeds/deeds.h"
#include "sim/falls.h"
#include "sim/figures/figures.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"
#include "sim/ground/surroundings.h"
#include "sim/herd.h"
#include "sim/linkages/linkages.h"
#include "sim/movers/movers.h"
#include "sim/navigation/navmesh.h"
#include "sim/pose/pose.h"
#include "sim/pose/trail.h"
#include "sim/roam.h"
#include "sim/sim.h"
#include "sim/traced/traced.h"
#include "sim/vehicles/vehicles.h"

namespace flaneur {

// The stages of a tick, in order.
enum class Stage : int { come, think, neighbours, steer, move, gait, pose };
inline constexpr int k_stage_count = 7;
inline constexpr std::string_view k_stage_names[k_stage_count] = {"come", "think", "neighbours", "steer",
                                                                  "move", "gait",  "pose"};

struct Stepping;   // of stepping.h
struct Alongside;  // of alongside/alongside.h
struct Pastimes;   // of pastimes/pastimes.h

struct World {
    std::shared_ptr<const Ground> ground;
    Surroundings around;  // what feet and hands ask
    NavmeshPtr navmesh;
    WorkersPtr workers;
    std::vector<Kind> kinds;
    std::vector<Folk> folk;  // who has such a body, one of each kind
    // See WorldOptions.
    Habit habit = Habit::wander;
    std::vector<Vec2> platform;
    float drunk = 0;
    uint32_t drunks = 0;
    std::vector<PlannedPush> pushes;
    float jaywalkers = k_usual_jaywalkers;
    uint64_t seed = 1;
    uint32_t tick = 0;  // ticks done

    void (*drive)(World& world) = nullptr;  // moves everybody by a tick; see step.cpp
    Coming coming;
    Traced traced;  // people who go where others were, and nobody else; mostly none
    Crowd crowd;
    Company company;             // who goes with whom; mostly of nobody
    std::unique_ptr<Roam> roam;  // of those who walk on a compound, with the ground as their stage; else null
    Herd herd;                   // creatures among people in a city; mostly none
    Linkages linkages;           // that are no people; mostly none
    std::shared_ptr<Stepping> stepping;    // of those who step by the showcase's rule; else null
    std::shared_ptr<Alongside> alongside;  // what goes along with people; null: nothing does
    Movers movers;                         // rigid things that move; mostly none
    std::shared_ptr<const RoadMap> roads;  // where one drives; null: nowhere
    Vehicles vehicles;                     // who drives; mostly nobody
    Deeds deeds;                           // people who do things with their hands, the same
    Troupe figures;                        // that are people, but not of the crowd; mostly none
    Gait gait;
    ClipLayer idles;
    Balls balls;                                      // that are thrown
    Falls falls;                                      // who has been pushed
    Bystanders bystanders;                            // and who minds
    std::shared_ptr<Pastimes> pastimes;               // what they do who stay; never null
    std::vector<PoseBlock> poses, previous_poses;     // after the last tick and the one before
    std::vector<TrailBlock> trails, previous_trails;  // the same

    // One block, in which who comes or goes is posed.
    Gait newcomer;
    std::vector<PoseBlock> newcomer_pose;

    double stage_ms[k_stage_count] =
        {};  // wall time of the last tick; measured, never read by the simulation
};

// Sets the walkers down on the ground's navigation mesh; without one, builds it. `progress`, if given, is
// called with what is being done and how much of it, 0..1; where it answers false, the world is given up with
// an error. Refuses ground that has no room for so many.
Result<std::unique_ptr<World>> make_world(std::shared_ptr<const Ground> ground, NavmeshPtr mesh,
                                          const WorldOptions& options,
                                          const std::function<bool(std::string_view, float)>& progress = {});
Result<std::unique_ptr<World>> make_world(std::shared_ptr<const Ground> ground, const WorldOptions& options,
                                          const std::function<bool(std::string_view, float)>& progress = {});

// Sets everybody down on a compound, and so many creatures of six legs, which are its linkages. The ground is
// level and becomes their stage. `gravity` as make_roam() takes it. Where it is of several bodies all leap
// now and then but the old, small children, and who has a cane or pushes a pram.
Result<void> set_down(World& world, Compound compound, uint32_t creatures = 0, Gravity gravity = {});

// Exchanges the ground that people stand on, the mesh that they find their ways by and what draws them,
// between two ticks. `ground` is as it was but within `changed`, and `mesh` is its own, as rebuild_navmesh()
// makes it. Nobody is set down elsewhere: see change_mesh() in sim/crowd/crowd.h. Not while people roam a
// compound.
void change_ground(World& world, std::shared_ptr<const Ground> ground, NavmeshPtr mesh,
                   std::span<const Destination> destinations, std::span<const Rectangle> changed);

// From now on those who stagger do so on this outline, under all of which there is ground: circles that it
// does not hold any more are replaced within a decision, and who is off it comes onto it. Refuses what
// let_stagger() refuses of anybody; nothing has changed then. Between two ticks.
Result<void> change_platform(World& world, const std::vector<Vec2>& corners);

// From now on people mind the lamps of these crossings; of none, where none is ruled. Allocates; between two
// ticks.
void mind_lamps(World& world, const Crossings& crossings);
// As much traffic from now on, 0..1: everybody who drives is set down anew. Allocates; between two ticks.
void set_traffic(World& world, float traffic);
// So many go on red from now on, 0..1; between two ticks.
void set_jaywalkers(World& world, float share);
// What one is like who minds them; creatures never go on red.
void set_lamp_manner(World& world, uint32_t walker);

// Room for so many walkers from now on, if there is less. Allocates; between two ticks.
void make_room(World& world, uint32_t capacity);

// What coming and going takes, so that ticks allocate nothing. Allocates; after either changed.
void make_room_to_come(World& world);

// From now on those who ramble go by the curves, or as they like, and rays are so long. Allocates; between
// two ticks. See sim/limbs/limbs.h.
void go_by_curves(World& world, LimbLead limbs, const LimbCurves& how);
// At which pace a new one does.
void set_pace(World& world, uint32_t walker);

// The hour of the day after the last tick, 0..24, and another one that it shall be.
float hour_now(const World& world);
void set_hour(World& world, float hour);

// The drives. People who go where they want to: come and go, think, find neighbours, steer, move.
void drive_crowd(World& world);
// People who roam all round a compound.
void drive_roam(World& world);

// Gait, pose and idles of a walker that came, or is gone, in slot `walker`.
void start_body(World& world, uint32_t walker);
void end_body(World& world, uint32_t walker);

// How many of them play on squares.
uint32_t player_count(const World& world);
// How many people there are, without creatures.
inline uint32_t people_count(const World& world) {
    return static_cast<uint32_t>(world.crowd.slots.living.size() - world.herd.goes_as.size());
}

// The same with those who are about to come in, and without those who leave (see kept_people() of Coming) and
// those who play.
inline uint32_t kept_people(const World& world) {
    return kept_people(world.coming, world.crowd) - static_cast<uint32_t>(world.herd.goes_as.size()) -
           player_count(world);
}
// The creatures, and what they stand on, by Creature::walker.
inline const std::vector<Creature>& creatures_of(const World& world) {
    return world.roam ? world.roam->creatures : world.herd.creatures;
}
inline const SurfaceWalkers& creature_walkers(const World& world) {
    return world.roam ? world.roam->walkers : world.herd.walkers;
}

// How much a walker has had: see WorldOptions. Another drink for all who have had one, from now on; between
// two ticks.
float drunk_of(const World& world, uint32_t walker);
void set_drunk(World& world, float drunk);
// Its body, with others in a block; see lane_of().
inline const PersonBlock& person_of(const World& world, uint32_t walker) {
    return world.gait.people[walker / k_block];
}
// How a walker moves, as it was drawn for it.
Manner manner_of(const World& world, uint32_t walker);

// What kind of person a walker is.
Personality personality_of(const World& world, uint32_t walker);

// A joint `between` 0, the tick before the last, and 1, the last.
JointPose joint_between(const World& world, size_t walker, Joint joint, float between);
// Where the pram is that a walker pushes, if it pushes one, the same way between ticks.
std::optional<PramPlace> pram_between(const World& world, size_t walker, float between);
// How a walker has moved of late, the same way between ticks.
Trail trail_between(const World& world, size_t walker, float between);

}  // namespace flaneur
