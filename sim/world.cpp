#include "sim/world.h"

#include <type_traits>
#include <utility>

#include "sim/base/hash.h"
#include "sim/crowd/pace.h"

namespace flaneur {

Result<std::unique_ptr<World>> make_world(City city, const WorldOptions& options,
                                          const std::function<void(std::string_view, float)>& progress) {
    auto mesh = build_navmesh(city, options.navmesh, options.threads, [&](float share) {
        if (progress) progress("building the navigation mesh", share);
    });
    if (!mesh) return mesh.error();
    return make_world(std::move(city), std::move(mesh).value(), options, progress);
}

Result<std::unique_ptr<World>> make_world(City city, NavmeshPtr mesh, const WorldOptions& options,
                                          const std::function<void(std::string_view, float)>& progress) {
    auto world = std::make_unique<World>();
    world->city = std::move(city);
    world->navmesh = std::move(mesh);
    world->seed = options.seed;
    world->workers = make_workers(options.threads);
    prepare_queries(*world->navmesh, thread_count(*world->workers));

    if (progress) progress("setting down the walkers", 0);
    std::vector<Folk> folk;
    for (const Kind& kind : options.kinds) {
        world->bodies.push_back(kind.body);
        float leg = leg_length(kind.body);
        folk.push_back({kind.share, usual_speed(kind.age, kind.woman, leg), fastest_walk(leg)});
    }
    auto crowd = populate(world->city, *world->navmesh, *world->workers, options.walkers, folk, options.seed,
                          options.hour);
    if (!crowd) return crowd.error();
    world->crowd = std::move(crowd).value();

    RootMotion root{world->crowd.position.data(), world->crowd.velocity.data(), world->crowd.heading.data(),
                    world->crowd.turn_rate.data(), world->crowd.chosen.data()};
    std::vector<Manner> manners;
    for (uint32_t i = 0; i < world->crowd.count; ++i) {
        Manner middle = manner_at_age(options.kinds[world->crowd.body[i]].age);
        manners.push_back(draw_manner(middle, {world->seed, i, 0, Purpose::style}));
    }
    start_gait(world->gait, world->crowd.count, world->bodies, world->crowd.body.data(),
               world->crowd.scale.data(), root, world->city, world->seed, manners.data());
    world->idles = make_layer(options.idles, world->crowd.count);
    world->poses.resize(world->gait.blocks.size());
    pose_blocks(world->gait, 0, world->gait.blocks.size(), world->poses);
    world->previous_poses = world->poses;
    if (progress) progress("setting down the walkers", 1);
    return world;
}

Result<void> set_down(World& world, Compound compound) {
    auto roam = make_roam(std::move(compound), world.crowd, world.seed);
    if (!roam) return roam.error();
    world.roam = std::make_unique<Roam>(std::move(roam).value());
    return {};
}

uint64_t hash_world(const World& world) {
    uint64_t hash = mix(world.seed) ^ world.tick;
    hash = mix(hash ^ hash_crowd(world.crowd));
    if (world.roam) {
        const auto& frames = world.roam->frames;
        hash = hash_bytes(hash, frames.data(), frames.size() * sizeof(frames[0]));
    }
    static_assert(std::is_trivially_copyable_v<GaitBlock> && std::is_trivially_copyable_v<PoseBlock>);
    hash = hash_bytes(hash, world.gait.blocks.data(), world.gait.blocks.size() * sizeof(GaitBlock));
    return hash_bytes(hash, world.poses.data(), world.poses.size() * sizeof(PoseBlock));
}

}  // namespace flaneur
