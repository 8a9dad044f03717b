#include "tools/flaneur/gait/walk.h"

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"

namespace flaneur {

namespace {

constexpr float k_faster = 1.6f, k_slower = 2.2f;  // m/s2
constexpr float k_turn_faster = 8;                 // rad/s2

FootInstant foot_instant(const City& city, const Gait& gait, const std::vector<PoseBlock>& poses, Side side) {
    FootInstant foot;
    foot.sole = sole(poses, gait, 0, side);
    foot.swinging = gait.blocks[0].feet[side].swinging[0] != 0;
    const Vec3 points[3] = {foot.sole.heel, foot.sole.ball, foot.sole.tip};
    for (int i = 0; i < 3; ++i) {
        auto hit = ground(city, points[i], 0.5f, 1);
        foot.ground[i] = hit ? hit->height : points[i].y;
    }
    return foot;
}

}  // namespace

City strip(const std::function<float(float z)>& height, const std::vector<float>& edges, bool stepped) {
    City city;
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        float a = edges[i], b = edges[i + 1];
        float ya = stepped ? height((a + b) / 2) : height(a), yb = stepped ? ya : height(b);
        auto n = static_cast<uint32_t>(city.ground_vertices.size());
        for (Vec3 v : {Vec3{-10, ya, a}, Vec3{-10, yb, b}, Vec3{10, yb, b}, Vec3{10, ya, a}})
            city.ground_vertices.push_back(v);
        for (uint32_t k : {0, 1, 2, 0, 2, 3}) city.ground_indices.push_back(n + k);
        city.ground_kinds.insert(city.ground_kinds.end(), 2, Surface::sidewalk);
    }
    index_city(city);
    return city;
}

Walk walk(const City& city, const Body& body, uint64_t style, double seconds,
          const std::function<Wish(double time)>& wish) {
    Walk result{body, 1 / static_cast<double>(k_tick), {}};
    std::vector<Body> bodies{body};
    uint32_t index = 0;
    float scale = 1, heading = 0, turn_rate = 0, speed = 0;
    Vec3 position;
    if (auto hit = ground(city, {0, 1, 0}, 100, 100)) position.y = hit->height;
    Vec2 velocity;
    RootMotion root{&position, &velocity, &heading, &turn_rate};
    Gait gait;
    start_gait(gait, 1, bodies, &index, &scale, root, city, style);
    std::vector<PoseBlock> poses(1);

    auto ticks = static_cast<uint32_t>(seconds * result.rate);
    for (uint32_t t = 0; t < ticks; ++t) {
        Wish w = wish(t / result.rate);
        speed += clamp(w.speed - speed, -k_slower * k_tick, k_faster * k_tick);
        turn_rate += clamp(w.turn_rate - turn_rate, -k_turn_faster * k_tick, k_turn_faster * k_tick);
        heading += turn_rate * k_tick;
        velocity = heading_direction(heading) * speed;
        position += at_height(velocity * k_tick, 0);
        if (auto hit = ground(city, position)) position.y = hit->height;
        advance_gait(gait, 0, 1, root, city, style, t, k_tick);
        pose_blocks(gait, 0, 1, poses);

        Instant now;
        now.root = position;
        now.velocity = velocity;
        now.heading = heading;
        for (size_t j = 0; j < k_joint_count; ++j)
            now.joints[j] = joint_pose(poses, 0, static_cast<Joint>(j));
        for (Side side : {k_left, k_right}) now.feet[side] = foot_instant(city, gait, poses, side);
        result.ticks.push_back(now);
    }
    return result;
}

}  // namespace flaneur
