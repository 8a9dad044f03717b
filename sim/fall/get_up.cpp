// How those of a world who have fallen lie, get to hands and knees, and stand up again; see sim/falls.h.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/limbs.h"
#include "sim/fall/settle.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

namespace {

float leg_of(const World& w, uint32_t walker) {
    return person_of(w, walker).joints[left_upper_leg][1][walker % k_block];
}

// Where one comes to from a place towards another: along the mesh, or on a course, of which there is none, as
// far as there is ground about as high, beside its way.
NavPoint follow_to(const World& w, uint32_t walker, Vec2 to) {
    const CrowdMotion& m = w.crowd.motion;
    const NavPoint from{m.position[walker], m.polygon[walker]};
    const Vec3 there = at_height(to, from.position.y);
    if (!is_on_course(w)) return move_along(*w.navmesh, 0, from, there, by_of(w.crowd, walker));
    constexpr float k_above = 1, k_level = 0.25f;                              // metres
    const auto hit = ground_at(*w.stepping->ground, there, k_above, k_level);  // what moves would leave it
    const bool is_level = hit && is_walked(hit->kind) && hit->height < from.position.y + k_level;
    return is_level && is_by_way(w, walker, there) ? NavPoint{there, from.polygon} : from;
}

// Where the crowd has it goes there, onto ground up to `up` metres higher.
void move_root(World& w, uint32_t walker, Vec2 to, float up) {
    CrowdMotion& m = w.crowd.motion;
    const NavPoint end = follow_to(w, walker, to);
    m.position[walker] = end.position;
    m.polygon[walker] = end.polygon;
    if (const auto hit = ground_at(w.around, end.position, up, 1.5f)) {
        m.position[walker].y = hit->height;
        m.under[walker] = *hit;
    }
}

// Its place and heading come to where it will stand while it gets to its knees.
void turn_root(World& w, const Fall& f) {
    constexpr float k_speed = 0.7f, k_rate = 2.6f;  // m/s, rad/s
    CrowdMotion& m = w.crowd.motion;
    const Vec2 at = on_ground(m.position[f.walker]), way = f.stands_at - at;
    const float far = length(way), most = k_speed * k_tick;
    if (far > 1e-3f) move_root(w, f.walker, far > most ? at + way * (most / far) : f.stands_at, 0.8f);
    float& heading = m.heading[f.walker];
    heading =
        wrap_angle(heading + clamp(wrap_angle(f.lie.heading - heading), -k_rate * k_tick, k_rate * k_tick));
}

// From now on the gait has it stand there.
void find_stance(World& w, Fall& f) {
    const BodyPose now = body_pose_of(w.poses, f.walker), drawn = body_pose_of(w.previous_poses, f.walker);
    w.crowd.motion.heading[f.walker] = f.lie.heading;
    start_body(w, f.walker);
    f.stance = body_pose_of(w.poses, f.walker);
    set_body_pose(w.poses, person_of(w, f.walker), f.walker, now);
    set_body_pose(w.previous_poses, person_of(w, f.walker), f.walker, drawn);
}

// From hands and knees, where it will stand is where the foot that it sets down next can stay.
void find_stand(World& w, Fall& f) {
    const PersonBlock& person = person_of(w, f.walker);
    const int lane = lane_of(f.walker);
    float& heading = w.crowd.motion.heading[f.walker];
    const float turned = heading;
    find_stance(w, f);
    heading = turned;
    const BodyPose kneels = end_of(RiseStage::kneel, f.lie, person, lane, f.hips_at);
    const Vec3 sets = places_of(kneels, person, lane)[left_foot],
               stands = places_of(f.stance, person, lane)[left_foot];
    f.stands_at = on_ground(w.crowd.motion.position[f.walker]) + on_ground(sets - stands);
}

// What of a body rests on the ground in a stage, `t` of the way through it to `end`.
Rests rests_of(const Fall& f, const BodyPose& end, const PersonBlock& person, int lane, float t,
               float risen_for) {
    constexpr float k_hand_lift = 0.05f, k_sees_after = 0.3f;  // metres, seconds
    Rests rests;
    rests.sees_steps = smoothstep(0, k_sees_after, risen_for);
    for (const Side side : {k_left, k_right}) {
        const auto k = static_cast<size_t>(side);
        rests.arms_from[k] = arm_way(f.from, person, lane, side);
        rests.arms_to[k] =
            f.stage <= RiseStage::fours ? arm_way(end, person, lane, side) : rests.arms_from[k];
    }
    if (f.stage == RiseStage::side) {
        rests.hands = 1;
        rests.hands_on = t;
        rests.hands_above = palms_above(end, f.segments, person, lane);
    } else if (f.stage == RiseStage::fours) {
        rests.hands = 1;
        rests.hands_on = t;
        rests.hands_lift = k_hand_lift;
    } else if (f.stage == RiseStage::kneel) {
        rests.hands = 1 - smoothstep(0, 0.35f, t);
        rests.left_foot = smoothstep(0.5f, 1, t);
    } else if (f.stage == RiseStage::stand) {
        rests.left_foot = 1 - smoothstep(0.4f, 1, t);
        rests.may_sink = false;
        rests.keeps_feet = true;
    }
    return rests;
}

// How it will stand: on its feet as they were found, and with its trunk and arms as they are by now.
BodyPose stance_of(const World& w, const Fall& f) {
    BodyPose stance = f.stance;
    const BodyPose now = body_pose_of(w.poses, f.walker);
    for (int j = spine; j <= right_hand; ++j) stance.rotation[j] = now.rotation[j];
    return stance;
}

}  // namespace

void lie_down(World& w, Fall& f) {
    const float age = w.kinds[w.crowd.identity.body[f.walker]].age;
    const RandomKey key{w.seed, f.walker, w.tick, Purpose::fall};
    const float old = smoothstep(50, 80, age);
    f.phase = FallPhase::lies;
    f.began = w.tick;
    f.rises_at =
        w.tick + static_cast<uint32_t>(random_between(key, 0.3f, 1.25f, 1) * (1 + 0.3f * old) / k_tick);
    f.slowness = random_between(key, 0.9f, 1.1f, 2) * (1 + 0.35f * old);
    f.from = body_pose_of(w.previous_poses, f.walker);
    constexpr float k_about = 0.6f;  // metres
    f.lie =
        lie_of(f.from, person_of(w, f.walker), lane_of(f.walker), slope_at(w.around, f.from.hips, k_about));
    f.hips_at = on_ground(f.from.hips);
    f.stands_at = f.hips_at + heading_direction(f.lie.heading) * rise_ahead(leg_of(w, f.walker));
}

void follow_hips(World& w, const Fall& f) {
    move_root(w, f.walker, on_ground(body_pose_of(w.previous_poses, f.walker).hips), 0.5f);
    w.crowd.motion.velocity[f.walker] = {};
}

void lie_on(World& w, Fall& f) {
    constexpr float k_unfolds = 2.2f, k_after = 0.3f, k_above = 0.03f;  // rad/s, seconds, metres
    constexpr float k_comes_to = 0.15f;                                 // metres
    constexpr size_t k_heels[] = {13, 21}, k_knees[] = {11, 19};        // balls
    const PersonBlock& person = person_of(w, f.walker);
    const int lane = lane_of(f.walker);
    const float lain = static_cast<float>(w.tick - f.began) * k_tick;
    const auto balls = balls_of(f.from, f.segments, person, lane);
    for (const Side side : {k_left, k_right}) {
        const size_t heel = k_heels[side], knee = k_knees[side];
        // Over what is below it, and over a step that it would come to.
        auto is_in_the_air = [&](size_t ball) {
            const float low = balls[ball].y - f.segments.radius[ball] - k_above;
            auto is_below = [&](Vec3 at) {
                const auto hit = ground_at(w.around, at, 0.6f, 2);
                return (hit ? hit->height : f.floor) < low;
            };
            const Vec2 out = normalize_or(on_ground(balls[ball] - balls[knee]), {0, 1});
            return is_below(balls[ball]) && is_below(balls[ball] + at_height(out * k_comes_to, 0)) &&
                   is_below(balls[ball] - at_height(out * k_comes_to, 0));
        };
        const bool hangs = balls[heel].y > balls[knee].y + k_above;
        if (hangs && is_in_the_air(heel) && is_in_the_air(heel + 1))
            fold_knee(f.from, side, -k_unfolds * smoothstep(0, k_after, lain) * k_tick);
    }
    BodyPose pose = f.from;
    breathe(pose, lain, smoothstep(0, 0.5f, lain));
    set_body_pose(w.poses, person, f.walker, pose);
}

void begin_to_rise(World& w, Fall& f) {
    f.phase = FallPhase::rises;
    f.began = w.tick;
    f.share = 0;
    f.raised = air_below(f.from, f.segments, person_of(w, f.walker), lane_of(f.walker), w.around, f.floor);
    f.stage = first_stage(f.lie);
    w.crowd.motion.turn_rate[f.walker] = 0;
}

void choose_stand(World& w, Fall& f) {
    if (f.stage < RiseStage::stand) {
        if (f.share == 0 && f.stage == RiseStage::kneel) find_stand(w, f);
        turn_root(w, f);
    } else if (f.share == 0 && f.stage == RiseStage::stand) {
        find_stance(w, f);
    }
}

void rise_on(World& w, Fall& f) {
    const PersonBlock& person = person_of(w, f.walker);
    const int lane = lane_of(f.walker);
    const bool is_pulled = f.held != 0 && f.stage >= RiseStage::kneel;
    constexpr float k_pulled = 0.75f;  // of the time that a stage takes
    const float seconds = seconds_of(f.stage) * f.slowness * (is_pulled ? k_pulled : 1);
    f.share = std::min(f.share + k_tick / seconds, 1.0f);
    const float t = smoothstep(0, 1, f.share);
    BodyPose pose, end;
    if (f.stage == RiseStage::stand) {
        end = stance_of(w, f);
        pose = mixed(f.from, end, t);
        // First the weight comes over the foot that was set down, with the trunk bowed, and then up.
        constexpr float k_comes_over = 0.65f, k_rises_after = 0.15f, k_bows = 0.3f;  // of the time; radians
        const Vec2 over = on_ground(lerp(f.from.hips, end.hips, smoothstep(0, k_comes_over, f.share)));
        pose.hips = at_height(over, lerp(f.from.hips.y, end.hips.y, smoothstep(k_rises_after, 1, f.share)));
        lean_trunk(pose, k_bows * bell(1 - std::fabs(2 * f.share - 1)));
        // The foot that was set down stays; once the body is over it the other one is lifted, and set down
        // beside it.
        constexpr float k_lifts = 0.13f, k_leaves = 0.24f;  // of the leg; of the time
        const auto began = places_of(f.from, person, lane), ends = places_of(end, person, lane);
        const float goes = smoothstep(k_leaves, 1, f.share),
                    lift = 4 * goes * (1 - goes) * k_lifts * leg_of(w, f.walker);
        reach_with_leg(pose, person, lane, k_left, lerp(began[left_foot], ends[left_foot], t));
        reach_with_leg(pose, person, lane, k_right,
                       lerp(began[right_foot], ends[right_foot], goes) + Vec3{0, lift, 0});
    } else {
        end = end_of(f.stage, f.lie, person, lane, f.hips_at);
        end.hips.y += w.crowd.motion.position[f.walker].y;
        pose = mixed(f.from, end, t);
    }
    // Limbs that were set on the ground may have come to a wall; on steps they stay where they stand. Who has
    // been moved aside goes on from there: limbs are bound to where they were, and must not fall behind.
    // Nobody is moved beyond where one can walk, and who lies at its edge gets up from there.
    auto keep_off = [&] {
        constexpr float k_edge = 0.35f, k_crawls = 0.008f;  // metres from the place; a tick
        Vec3 aside = keep_off_walls(pose, f.segments, person, lane, w.around);
        const Vec2 off = on_ground(pose.hips - w.crowd.motion.position[f.walker]);
        const float far = length(off);
        if (far > k_edge) {
            const float out = std::max(dot(on_ground(aside), off) / far, 0.0f);
            const Vec3 back = at_height(off * (-std::min(far - k_edge, out + k_crawls) / far), 0);
            pose.hips += back;
            aside += back;
        }
        f.hips_at += on_ground(aside);
        f.from.hips += aside;
    };
    keep_off();
    const bool is_smooth = settle(
        pose, body_pose_of(w.previous_poses, f.walker), f.segments, person, lane, w.around, f.floor,
        rests_of(f, end, person, lane, t, static_cast<float>(w.tick - f.began) * k_tick), f.raised, k_tick);
    if (is_smooth) keep_off();
    set_body_pose(w.poses, person, f.walker, pose);
    if (f.share < 1) return;
    f.from = pose;
    f.share = 0;
    f.stage = next_stage(f.stage);
}

}  // namespace flaneur
