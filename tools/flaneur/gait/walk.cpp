#include "tools/flaneur/gait/walk.h"

#include "sim/base/hash.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/locomotion.h"
#include "sim/gait/hands.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

// Of what the person does besides walking: one who likes to touch walls.
static constexpr uint64_t k_seed = 30;

FootInstant foot_instant(const Ground& ground, const Gait& gait, const std::vector<PoseBlock>& poses,
                         size_t walker, Side side) {
    FootInstant foot;
    foot.sole = sole(poses, gait, walker, side);
    foot.swinging = gait.blocks[walker / k_block].feet[side].swinging[walker % k_block] != 0;
    const Vec3 points[3] = {foot.sole.heel, foot.sole.ball, foot.sole.tip};
    for (int i = 0; i < 3; ++i) {
        auto hit = ground_at(ground, points[i], 0.25f, 0.5f);
        foot.ground[i] = hit ? hit->height : points[i].y;
    }
    return foot;
}

Ground strip(const std::function<float(float z)>& height, const std::vector<float>& edges, bool stepped,
             Surface kind) {
    Ground ground;
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        float a = edges[i], b = edges[i + 1];
        float ya = stepped ? height((a + b) / 2) : height(a), yb = stepped ? ya : height(b);
        auto n = static_cast<uint32_t>(ground.vertices.size());
        for (Vec3 v : {Vec3{-10, ya, a}, Vec3{-10, yb, b}, Vec3{10, yb, b}, Vec3{10, ya, a}})
            ground.vertices.push_back(v);
        for (uint32_t k : {0, 1, 2, 0, 2, 3}) ground.indices.push_back(n + k);
        ground.kinds.insert(ground.kinds.end(), 2, kind);
    }
    index_ground(ground);
    return ground;
}

Walk walk(const Ground& ground, const Person& person, double seconds, const Wish& wish) {
    Walk result{person.body, 1 / static_cast<double>(k_tick), {}, 0};
    std::vector<Body> bodies{person.body};
    uint32_t index = 0;
    float scale = 1;
    Vec3 position;
    if (auto hit = ground_at(ground, {0, 0, 0}, 100, 100)) position.y = hit->height;
    Motion motion;
    Vec2 wished;
    RootMotion root{&position, &motion.velocity, &motion.heading, &motion.turn_rate, &wished};
    Gait gait;
    start_gait(gait, 1, bodies, &index, &scale, root, surroundings_of(ground), k_seed, &person.manner);
    std::vector<PoseBlock> poses(1), before(1);
    pose_blocks(gait, 0, 1, poses);

    auto ticks = static_cast<uint32_t>(seconds * result.rate);
    for (uint32_t t = 0; t < ticks; ++t) {
        GroundHit under = ground_at(ground, position).value_or(GroundHit{});
        wished = wish_on(under, wish(t / result.rate));
        motion = next_motion(motion, wished, k_tick);
        position += at_height(motion.velocity * k_tick, 0);
        if (auto hit = ground_at(ground, position)) position.y = hit->height;
        advance_gait(gait, 0, 1, root, surroundings_of(ground), k_seed, t, k_tick);
        reach_for_walls(gait, 0, 1, root, surroundings_of(ground), k_seed, t, k_tick);
        poses.swap(before);
        pose_blocks(gait, 0, 1, poses);
        restrain_legs(gait, 0, 1, k_tick, before, poses);
        result.hash = hash_bytes(result.hash, poses.data(), sizeof(PoseBlock));

        Instant now;
        now.root = position;
        now.velocity = motion.velocity;
        now.heading = motion.heading;
        for (size_t j = 0; j < k_joint_count; ++j)
            now.joints[j] = joint_pose(poses, 0, static_cast<Joint>(j));
        for (Side side : {k_left, k_right}) now.feet[side] = foot_instant(ground, gait, poses, 0, side);
        result.ticks.push_back(now);
    }
    return result;
}

}  // namespace flaneur
