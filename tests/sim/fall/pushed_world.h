// Worlds for tests in which people are pushed.
#pragma once

#include <memory>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/sim.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {

// From a child to old age.
inline std::unique_ptr<World> world_on(Ground ground, uint32_t walkers, uint64_t seed = 1, int threads = 2,
                                       float helpers = k_usual_helpers) {
    WorldOptions options;
    options.walkers = walkers;
    options.capacity = walkers + 8;
    options.threads = threads;
    options.seed = seed;
    options.helpers = helpers;
    options.kinds = {{standard_body(1.78f), 1, 30, false},
                     {standard_body(1.64f), 1, 45, true},
                     {standard_body(1.15f), 1, 7, false},
                     {standard_body(1.58f), 1, 78, true},
                     {standard_body(1.9f), 1, 22, false}};
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    if (!world) return nullptr;
    return std::move(*world);
}

inline float mass(const World& w, WalkerId id) {
    return mass_of(w.gait.people[id.index / k_block], id.index % k_block);
}

inline const Fall* fall_of(const World& w, uint32_t walker) {
    for (const Fall& f : w.falls.all)
        if (f.walker == walker) return &f;
    return nullptr;
}

// Pushes a walker, or everybody, by so many m/s, each another way, by tick and number alone.
inline void push_one(World& w, WalkerId id, float speed, uint32_t salt) {
    const RandomKey key{5, id.index, salt, Purpose::fall};
    (void)push(w, id, heading_direction(random_between(key, -k_pi, k_pi)) * (speed * mass(w, id)));
}
inline void push_all(World& w, float speed, uint32_t salt) {
    const std::vector<WalkerId> all(walkers(w).begin(), walkers(w).end());
    for (const WalkerId id : all) push_one(w, id, speed, salt);
}

inline std::array<Vec3, k_ball_count> balls_of(const World& w, uint32_t walker, const Segments& segments) {
    return balls_of(body_pose_of(w.poses, walker), segments, w.gait.people[walker / k_block],
                    static_cast<int>(walker % k_block));
}

}  // namespace flaneur
