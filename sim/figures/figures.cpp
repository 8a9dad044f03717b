#include "sim/figures/figures.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/gait/hands.h"
#include "sim/pose/bare.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

namespace {

constexpr float k_ahead = 0.7f;  // metres of its way ahead that a figure goes for

Vec2 on_way(const std::vector<Vec2>& way, float along) {
    float whole = 0;
    for (size_t i = 0; i < way.size(); ++i) whole += length(way[(i + 1) % way.size()] - way[i]);
    if (whole <= 0) return way[0];
    float left = along - whole * std::floor(along / whole);
    for (size_t i = 0; i < way.size(); ++i) {
        const Vec2 a = way[i], b = way[(i + 1) % way.size()];
        const float piece = length(b - a);
        if (left <= piece && piece > 0) return lerp(a, b, left / piece);
        left -= piece;
    }
    return way[0];
}

Manner manner_of(const FigurePlan& plan) {
    Manner manner;
    manner.touches = plan.by == FigurePlan::By::techniques ? 1.5f : 0.0f;
    manner.curiosity = 0.5f;
    return manner;
}

// Of a wish only what leads neither off the ground, nor into a wall or another figure.
Vec2 kept_off(const Troupe& f, size_t figure, Vec2 wish) {
    constexpr float k_radius = 0.3f, k_apart = 0.75f, k_chest = 1, k_ahead_of_edge = 0.35f,
                    k_step = 0.25f;   // metres
    constexpr float k_parts = 6;      // 1/s
    constexpr float k_stops = 0.35f;  // s2/m, half the inverse of how it brakes
    const Vec3 here = f.moves[figure].position;
    auto keep = [&](Vec2 out) { wish -= out * std::min(dot(wish, out), 0.0f); };
    if (const auto wall = closest_wall(*f.ground, here + Vec3{0, k_chest, 0}, k_radius))
        keep(on_ground(wall->normal));
    const Vec2 goes = f.moves[figure].motion.velocity;
    for (size_t i = 0; i < f.moves.size(); ++i) {
        const Vec2 away = on_ground(here - f.moves[i].position), out = normalize_or(away, {0, 1});
        const float nears = std::max(-dot(goes, out), 0.0f);
        const float too_near = k_apart + k_stops * nears * nears - length(away);
        if (i == figure || too_near < 0) continue;
        keep(out);
        // It turns slowly: whoever sets off beside somebody first makes room.
        if (wish != Vec2{}) wish += out * (k_parts * too_near);
    }
    // As far as it comes before it stands.
    auto is_ground = [&](Vec2 way) {
        const float speed = length(way), far = k_ahead_of_edge + k_stops * speed * speed;
        if (speed < 1e-3f) return true;
        for (float on = far; on > 0; on -= k_step)
            if (!ground_at(*f.ground, here + at_height(way * (on / speed), 0), far, far)) return false;
        return true;
    };
    return is_ground(wish) && is_ground(goes + wish * k_tick) ? wish : Vec2{};
}

// One tick of where it goes.
void move(const Troupe& f, size_t figure, const FigureWish& want, FigureMove& m) {
    const FigurePlan& plan = f.plans[figure];
    const Ground& ground = *f.ground;
    const float stairs = stair_pace(leg_length(f.bodies[figure]));
    const Surroundings around = surroundings_of(ground);
    const Vec2 here = on_ground(m.position);
    Vec2 wish = f.lead.wish;
    if (f.lead.figure == figure) {
        wish = kept_off(f, figure, wish);
    } else {
        Vec2 aim = on_way(plan.way, m.along);
        constexpr float k_on = 0.05f;  // metres
        for (int n = 0; n < 8 && length(aim - here) < k_ahead; ++n) aim = on_way(plan.way, m.along += k_on);
        wish = normalize_or(aim - here, {0, 1}) * want.speed;
    }
    GroundHit under = ground_at(ground, m.position).value_or(GroundHit{});
    under = slowing_ground(around, under, m.position, m.motion.velocity, want.speed, stairs);
    wish = wish_on(under, wish, stairs);
    m.motion = next_motion(m.motion, wish, k_tick);
    m.position = set_down(ground, here + m.motion.velocity * k_tick, m.position.y);
    constexpr float k_crouch_rate = 1.2f;  // a second
    m.crouch += clamp(want.crouch - m.crouch, -k_crouch_rate * k_tick, k_crouch_rate * k_tick);
}

// Joints and where they are told from.
void copy_walker(const std::vector<PoseBlock>& poses, size_t walker, size_t figure, Vec3 aside,
                 std::vector<PoseBlock>& to_poses) {
    const PoseBlock& from = poses[walker / k_block];
    PoseBlock& to = to_poses[figure / k_block];
    const size_t a = walker % k_block, b = figure % k_block;
    const float by[] = {aside.x, aside.y, aside.z};
    for (size_t i = 0; i < 3; ++i) to.origin[i][b] = from.origin[i][a] + by[i];
    for (size_t j = 0; j < k_joint_count; ++j) {
        for (size_t i = 0; i < 3; ++i) to.position[j][i][b] = from.position[j][i][a];
        for (size_t i = 0; i < 4; ++i) to.rotation[j][i][b] = from.rotation[j][i][a];
    }
}

// Whose gait a figure has.
size_t walker_of(const Troupe& f, size_t figure) {
    const uint32_t twin = f.plans[figure].twin_of;
    return twin == k_no_twin ? figure : twin;
}

// Who lacks a technique is posed once more.
void pose_by_techniques(Troupe& f) {
    f.poses = f.whole;
    for (const Techniques& on : f.sets) {
        const bool is_whole = on == Techniques{};
        if (!is_whole) pose_bare(f.gait, 0, f.bare.size(), on, f.whole, f.bare);
        for (size_t i = 0; i < f.plans.size(); ++i)
            if (f.plans[i].on == on)
                copy_walker(is_whole ? f.whole : f.bare, walker_of(f, i), i, f.plans[i].aside, f.poses);
    }
}

void pose_all(Troupe& f) {
    pose_by_techniques(f);
    for (size_t i = 0; i < f.plans.size(); ++i) {
        const FigurePlan& plan = f.plans[i];
        PoseBlock& posed = f.poses[i / k_block];
        if (plan.by == FigurePlan::By::keys)
            pose_by_keys(f.trees[i], key_inputs(f.gait.blocks[i / k_block], i % k_block, f.moves[i].crouch),
                         f.gait, i, posed);
        if (plan.by == FigurePlan::By::statue) pose_as(f.keys[i], f.bodies[i], f.gait, i, posed);
    }
}

}  // namespace

FigureWish figure_wish(const FigurePlan& plan, uint32_t tick) {
    if (plan.by == FigurePlan::By::statue) return {};
    if (plan.way.size() == 1) return {};
    if (!plan.varies) return {plan.speed, 0, false};
    // In seconds of the round.
    constexpr float k_run = 2.6f, k_creep = 0.6f;  // of a walk's speed
    struct Part {
        float until, speed, crouch;
    };
    constexpr Part k_parts[] = {{3, 0, 0},  {11, 1, 0},    {20, k_run, 0},   {24, 1, 0},
                                {26, 0, 0}, {28.5f, 0, 1}, {35, k_creep, 1}, {40, 1, 0}};
    const uint32_t at = tick % k_figure_round;
    const float seconds = static_cast<float>(at) * k_tick;
    const bool leaps = at == 8 * k_ticks_a_second || at == 15 * k_ticks_a_second;
    for (const Part& part : k_parts)
        if (seconds < part.until) return {plan.speed * part.speed, part.crouch, leaps};
    return {plan.speed, 0, false};
}

Troupe make_figures(std::vector<FigurePlan> plans, std::shared_ptr<const Ground> ground,
                    const std::vector<Body>& bodies, uint64_t seed) {
    Troupe f;
    f.plans = std::move(plans);
    f.ground = std::move(ground);
    if (f.plans.empty()) return f;
    std::vector<Manner> manners;
    std::vector<uint32_t> numbers;
    const std::vector<float> scales(f.plans.size(), 1);
    for (const FigurePlan& plan : f.plans) {
        FigureMove m;
        m.along = plan.start;
        const Vec2 place = on_way(plan.way, m.along), next = on_way(plan.way, m.along + k_ahead);
        m.position = set_down(*f.ground, place, 1);
        const Vec2 ahead = next - place;
        m.motion.heading = plan.way.size() == 1 ? plan.heading : heading_of(ahead);
        f.moves.push_back(m);
        f.bodies.push_back(bodies[plan.kind]);
        f.trees.push_back(plan.by == FigurePlan::By::keys ? key_tree(bodies[plan.kind], plan.curves)
                                                          : BlendTree{});
        f.keys.push_back(key_pose(bodies[plan.kind], plan.key));
        manners.push_back(manner_of(plan));
        if (std::ranges::find(f.sets, plan.on) == f.sets.end()) f.sets.push_back(plan.on);
        numbers.push_back(static_cast<uint32_t>(numbers.size()));
    }
    start_gait(f.gait, f.plans.size(), f.bodies, numbers.data(), scales.data(), told(f.moves, f.rows),
               surroundings_of(*f.ground), seed, manners.data());
    f.whole.resize(f.gait.blocks.size());
    f.bare.resize(f.whole.size());
    pose_blocks(f.gait, 0, f.whole.size(), f.whole);
    f.before = f.whole;
    pose_all(f);
    f.previous_poses = f.poses;
    return f;
}

void pose_figures_anew(Troupe& f) {
    if (f.plans.empty()) return;
    pose_all(f);
    f.previous_poses = f.poses;
}

void lead_figure(Troupe& f, uint32_t figure) { f.lead = {.figure = figure}; }

void leap(Troupe& f) {
    if (f.lead.figure != k_no_twin) jump(f.gait, f.lead.figure);
}

void step_figures(Troupe& f, uint64_t seed, uint32_t tick) {
    const size_t count = f.plans.size();
    if (count == 0) return;
    const Surroundings around = surroundings_of(*f.ground);
    for (size_t i = 0; i < count; ++i) {
        if (f.plans[i].by == FigurePlan::By::statue) continue;
        if (f.plans[i].twin_of != k_no_twin) {
            f.moves[i] = f.moves[f.plans[i].twin_of];
            f.moves[i].position += f.plans[i].aside;
            continue;
        }
        FigureWish want = figure_wish(f.plans[i], tick);
        if (f.lead.figure == i) want = {length(f.lead.wish), f.lead.creeps != 0 ? 1.0f : 0.0f, false};
        move(f, i, want, f.moves[i]);
        if (want.leaps) jump(f.gait, i);
    }
    const RootMotion root = told(f.moves, f.rows);
    advance_gait(f.gait, 0, count, root, around, seed, tick, k_tick);
    reach_for_walls(f.gait, 0, count, root, around, seed, tick, k_tick);
    for (size_t i = 0; i < count; ++i) f.moves[i].motion.feet = footwork(f.gait, i, f.moves[i].position);
    f.before.swap(f.whole);
    pose_blocks(f.gait, 0, f.whole.size(), k_tick, f.before, f.whole);
    restrain_legs(f.gait, 0, f.whole.size(), k_tick, f.before, f.whole);
    f.previous_poses.swap(f.poses);
    pose_all(f);
}

JointPose joint_between(const Troupe& f, size_t figure, Joint joint, float between) {
    return joint_between(f.previous_poses, f.poses, figure, joint, between);
}

}  // namespace flaneur
