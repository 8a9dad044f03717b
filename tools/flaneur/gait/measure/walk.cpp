#include "tools/flaneur/gait/measure/walk.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/locomotion.h"
#include "sim/gait/hands.h"
#include "sim/hands/holds.h"
#include "sim/pose/cane.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pram.h"

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

static CaneInstant cane_instant(const Ground& ground, const Gait& gait, const std::vector<PoseBlock>& poses) {
    if (gait.canes.empty()) return {};
    const Cane& cane = gait.canes.front();
    Vec3 tip = posed_tip(poses, cane);
    auto hit = ground_at(ground, tip, 0.25f, 0.5f);
    return {is_planted(cane), tip, hit ? hit->height : tip.y};
}

static constexpr float k_near = -60, k_far = 600;  // metres, where courses end

Course level_course(float way) {
    Course course{{std::min(k_near, -way), std::max(k_far, way)}};
    course.half_width = std::max(course.half_width, way);
    return course;
}

Course stairs_course(float begin, float rise, float tread) {
    Course course{{k_near}};
    for (int i = 0; i < k_flight_steps; ++i) course.edges.push_back(begin + static_cast<float>(i) * tread);
    course.edges.push_back(k_far);
    course.height = [=](float z) {
        return clamp(std::floor((z - begin) / tread) + 1, 0, k_flight_steps) * rise;
    };
    course.is_stepped = true;
    course.kind = Surface::steps;
    course.ends = Surface::sidewalk;
    return course;
}

Course slope_course(float begin, float grade) {
    constexpr float k_length = 60;
    return {{k_near, begin, begin + k_length, k_far},
            [=](float z) { return clamp(z - begin, 0, k_length) * grade; }};
}

Course kerb_course(float begin, float height) {
    constexpr float k_length = 4;
    Course course{{k_near, begin, begin + k_length, k_far},
                  [=](float z) { return z > begin && z < begin + k_length ? height : 0; }};
    course.is_stepped = true;
    return course;
}

Ground ground_of(const Course& course) {
    Ground ground;
    float x = course.half_width;
    for (size_t i = 0; i + 1 < course.edges.size(); ++i) {
        float a = course.edges[i], b = course.edges[i + 1];
        float ya = course.height(course.is_stepped ? (a + b) / 2 : a);
        float yb = course.is_stepped ? ya : course.height(b);
        auto n = static_cast<uint32_t>(ground.vertices.size());
        for (Vec3 v : {Vec3{-x, ya, a}, Vec3{-x, yb, b}, Vec3{x, yb, b}, Vec3{x, ya, a}})
            ground.vertices.push_back(v);
        for (uint32_t k : {0, 1, 2, 0, 2, 3}) ground.indices.push_back(n + k);
        bool is_end = i == 0 || i + 2 == course.edges.size();
        ground.kinds.insert(ground.kinds.end(), 2, is_end ? course.ends.value_or(course.kind) : course.kind);
    }
    index_ground(ground);
    return ground;
}

void add_risers(Ground& ground, const Course& course) {
    for (size_t i = 1; i + 1 < course.edges.size(); ++i) {
        float z = course.edges[i];
        float before = course.height((course.edges[i - 1] + z) / 2),
              after = course.height((z + course.edges[i + 1]) / 2);
        Vec3 left{course.half_width, std::min(before, after), z},
            right{-course.half_width, std::min(before, after), z};
        if (after < before) std::swap(left, right);
        float top = std::max(before, after);
        ground.faces.push_back({left, right, top, top, FaceKind::riser});
    }
}

bool runs_on_stairs(const Person& person, double speed) {
    constexpr float k_fastest_walk = 0.61f;  // m/s
    return stair_speed(static_cast<float>(speed), stair_pace(leg_length(person.body))) > k_fastest_walk;
}

Vec2 turned_by(double degrees, double speed) {
    float angle = clamp(static_cast<float>(degrees), -179.5f, 179.5f);
    return heading_direction(angle * k_radians) * static_cast<float>(speed);
}

Walk walk(const Ground& ground, const Person& person, double seconds, const Wish& wish, double leaps,
          const Wish& look) {
    const uint64_t seed = k_seed + person.draws;
    Walk result{person.body, 1 / static_cast<double>(k_tick), {}, 0};
    std::vector<Body> bodies{person.body};
    uint32_t index = 0;
    float scale = 1;
    Vec3 position;
    if (auto hit = ground_at(ground, {0, 0, 0}, 100, 100)) position.y = hit->height;
    Motion motion;
    RootMotion root{&position,         &motion.velocity, &motion.heading,
                    &motion.turn_rate, &motion.aim,      &motion.brakes};
    Gait gait;
    start_gait(gait, 1, bodies, &index, &scale, root, surroundings_of(ground), seed, &person.manner);
    std::vector<PoseBlock> poses(1), before(1);
    std::vector<TrailBlock> trails(1);
    pose_blocks(gait, 0, 1, poses);
    hold_canes(gait, 0, gait.canes.size(), poses);
    hold_prams(gait, 0, gait.prams.size(), poses);

    auto ticks = static_cast<uint32_t>(std::lround(seconds * result.rate));
    for (uint32_t t = 0; t < ticks; ++t) {
        GroundHit under = ground_at(ground, position).value_or(GroundHit{});
        Vec2 wished = wish(t / result.rate);
        const float pace = stair_pace(leg_length(person.body));
        under =
            slowing_ground(surroundings_of(ground), under, position, motion.velocity, length(wished), pace);
        wished = wish_on(under, wished, pace);
        motion = next_motion(motion, wished, k_tick, look ? look(t / result.rate) : Vec2{},
                             person.body.pram != Vec3{} ? person.body.pram.z + k_pram_behind : 0);
        position += at_height(motion.velocity * k_tick, 0);
        if (auto hit = ground_at(ground, position)) position.y = hit->height;
        if (leaps > 0 && t == static_cast<uint32_t>(std::lround(leaps * result.rate))) jump(gait, 0);
        advance_gait(gait, 0, 1, root, surroundings_of(ground), seed, t, k_tick);
        motion.feet = footwork(gait, 0, position);
        reach_for_walls(gait, 0, 1, root, surroundings_of(ground), seed, t, k_tick);
        advance_holds(gait, 0, 1, root, seed, t, k_tick);
        poses.swap(before);
        pose_blocks(gait, 0, 1, k_tick, before, poses);
        restrain_legs(gait, 0, 1, k_tick, before, poses);
        hold_canes(gait, 0, gait.canes.size(), k_tick, before, poses);
        hold_prams(gait, 0, gait.prams.size(), k_tick, before, poses);
        advance_trails(before, poses, 0, 1, k_tick, trails, trails);
        result.hash = hash_bytes(result.hash, poses.data(), sizeof(PoseBlock));

        Instant now;
        now.root = position;
        now.velocity = motion.velocity;
        now.heading = motion.heading;
        for (size_t j = 0; j < k_joint_count; ++j)
            now.joints[j] = joint_pose(poses, 0, static_cast<Joint>(j));
        for (Side side : {k_left, k_right}) {
            now.feet[side] = foot_instant(ground, gait, poses, 0, side);
            now.holds[side] = gait.blocks[0].holds[side].weight[0] > 0 || !gait.prams.empty();
        }
        now.load = gait.blocks[0].load[0];
        now.cane = cane_instant(ground, gait, poses);
        if (!gait.prams.empty()) now.pram = gait.prams.front().now;
        now.trail = trail_of(trails, 0);
        result.ticks.push_back(now);
    }
    return result;
}

}  // namespace flaneur
