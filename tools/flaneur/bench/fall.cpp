#include "sim/fall/fall.h"

#include "sim/gait/gait.h"
#include "tools/flaneur/bench/bench.h"

namespace flaneur {

namespace {

// Sixteen people in a fall, as far into it as half of them touch the ground.
struct Fallen {
    TumbleShapes shapes{};
    TumbleBlock block{};
    TumbleAims aims{};
    TumblePlanes planes{};
};

Fallen falling(const Gait& gait, const std::vector<PoseBlock>& poses, size_t block,
               const Surroundings& around) {
    constexpr int k_ticks = 36;
    Fallen f;
    const PersonBlock& people = gait.people[block];
    std::array<std::array<Quat, k_segment_count>, k_block> stood;
    std::array<Vec3, k_block> origin;
    std::array<Vec2, k_block> way;
    for (int lane = 0; lane < k_block; ++lane) {
        const size_t walker = block * k_block + static_cast<size_t>(lane);
        const Segments segments = segments_of(people, lane);
        set_shape(f.shapes, lane, segments);
        const BodyPose pose = body_pose_of(poses, walker);
        origin[lane] = pose.hips;
        (void)take_over(f.block, lane, segments, people, lane, pose, pose, k_tick, origin[lane]);
        stood[lane] = turns_of(f.block, lane);
        way[lane] = heading_direction(static_cast<float>(walker));
        for (int s = 0; s < k_segment_count; ++s) {
            f.block.velocity[s][0][lane] += 2 * way[lane].x;
            f.block.velocity[s][2][lane] += 2 * way[lane].z;
        }
    }
    for (int tick = 0; tick <= k_ticks; ++tick) {
        f.planes.has_walls = 0;
        for (int lane = 0; lane < k_block; ++lane) {
            aim_fall(f.aims, lane, f.block, stood[lane], way[lane], static_cast<float>(tick) * k_tick, 0);
            find_planes(f.planes, lane, f.block, f.shapes, origin[lane], around, origin[lane].y - 0.9f);
        }
        if (tick < k_ticks) tumble(f.shapes, f.aims, f.planes, k_tick, f.block);
    }
    return f;
}

}  // namespace

Kernel fall_kernel(const Gait& gait, const std::vector<PoseBlock>& poses, const Surroundings& around) {
    std::vector<Fallen> fallen;
    for (size_t block = 0; (block + 1) * k_block <= gait.count; ++block)
        fallen.push_back(falling(gait, poses, block, around));
    TumbleBlock scratch{};
    auto ns = [fallen = std::move(fallen), scratch]() mutable {
        return ns_each(fallen.size() * k_block, [&] {
            for (const Fallen& f : fallen) {
                scratch = f.block;
                tumble(f.shapes, f.aims, f.planes, k_tick, scratch);
            }
        });
    };
    return {"fall", ns, {0, 2000, 0}};
}

}  // namespace flaneur
