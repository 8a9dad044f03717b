// A city with people in it, and the tick that moves them on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/city/city.h"
#include "sim/city/navmesh.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/gait.h"
#include "sim/pose/body.h"
#include "sim/pose/layer.h"
#include "sim/pose/pose.h"
#include "sim/roam.h"

namespace flaneur {

// A body that walkers have, and who has such a body.
struct Kind {
    Body body;
    float share = 1;  // of all walkers, against the other kinds' shares; above 0
    float age = 30;   // years: with sex and legs it sets how fast they walk, and with it how they move
    bool woman = false;
};

struct WorldOptions {
    uint32_t walkers = 500;
    uint64_t seed = 1;
    int threads = 0;                                  // 0: one a core
    std::vector<Kind> kinds{{standard_body(1.72f)}};  // at least one
    std::vector<Clip> idles;  // of the humanoid, additive; each who stands a while plays one of them
    NavmeshSettings navmesh;
    float hour = 17.5f;  // of the day, 0..24, at the first tick
};

// The stages of a tick, in order.
enum class Stage : int { think, neighbours, steer, move, gait, pose };
inline constexpr int k_stage_count = 6;
inline constexpr std::string_view k_stage_names[k_stage_count] = {"think", "neighbours", "steer",
                                                                  "move",  "gait",       "pose"};

struct World {
    City city;
    NavmeshPtr navmesh;
    WorkersPtr workers;
    std::vector<Body> bodies;  // one of each kind
    uint64_t seed = 1;
    uint32_t tick = 0;  // ticks done

    Crowd crowd;
    Gait gait;
    std::unique_ptr<Roam> roam;  // of those who walk on a compound, with `city` as their stage; else null
    ClipLayer idles;
    std::vector<PoseBlock> poses, previous_poses;  // after the last tick and the one before

    double stage_ms[k_stage_count] =
        {};  // wall time of the last tick; measured, never read by the simulation
};

// Sets the walkers down on a city's navigation mesh; without one, builds it. `progress`, if given, is called
// with what is being done and how much of it, 0..1. Refuses a city that has no room for so many.
Result<std::unique_ptr<World>> make_world(City city, NavmeshPtr mesh, const WorldOptions& options,
                                          const std::function<void(std::string_view, float)>& progress = {});
Result<std::unique_ptr<World>> make_world(City city, const WorldOptions& options,
                                          const std::function<void(std::string_view, float)>& progress = {});

// Sets everybody down on a compound. The city is level ground and becomes their stage.
Result<void> set_down(World& world, Compound compound);

// One tick of k_tick seconds.
void step(World& world);

// The hash of the whole state, poses included: equal for equal runs on any machine.
uint64_t hash_world(const World& world);

}  // namespace flaneur
