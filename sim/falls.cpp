#include "sim/falls.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/bodies.h"
#include "sim/fall/fall.h"
#include "sim/fall/lane.h"
#include "sim/fall/limbs.h"
#include "sim/fall/settle.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr uint32_t k_no_fall = ~0u;
constexpr float k_quiet = 0.12f, k_quiet_for = 0.25f, k_longest_fall = 3;  // m/s, seconds
// Of what it carries, a tick: the extrapolated centre of mass comes back over the feet within some 0.3 s, the
// inverse of sqrt(g / l) (Hof, Gazendam & Sinke 2005).
constexpr float k_comes_to_rest = 0.95f;
constexpr float k_pulled = 0.75f;                       // of the time that a stage takes
constexpr float k_calms_after = 0.8f, k_calms = 0.93f;  // seconds; of how it moves, a tick

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

const PersonBlock& person_of(const World& w, const Fall& f) { return w.gait.people[f.walker / k_block]; }
int lane_in_gait(const Fall& f) { return static_cast<int>(f.walker % k_block); }

float leg_of(const World& w, uint32_t walker) {
    return w.gait.people[walker / k_block].joints[left_upper_leg][1][walker % k_block];
}

// The first that nobody has.
void take_lane(Falls& falls, Fall& f) {
    auto has = [&](uint32_t lane) {
        return std::any_of(falls.all.begin(), falls.all.end(), [&](const Fall& other) {
            return other.phase == FallPhase::falls && other.lane == lane;
        });
    };
    f.lane = 0;
    while (has(f.lane)) ++f.lane;
    if (f.lane / k_block >= falls.blocks.size()) falls.blocks.push_back({});
}

void begin_fall(World& w, Fall& f) {
    const PersonBlock& person = person_of(w, f);
    const int lane = lane_in_gait(f);
    take_lane(w.falls, f);
    TumbleBlock& block = w.falls.blocks[f.lane / k_block];
    const int own = static_cast<int>(f.lane % k_block);
    f.phase = FallPhase::falls;
    f.began = f.fell = w.tick;
    f.held = 0;
    f.lain = f.still = 0;
    f.segments = segments_of(person, lane);
    f.floor = w.crowd.motion.under[f.walker].height;
    f.origin = w.crowd.motion.position[f.walker];
    BodyPose now = body_pose_of(w.poses, f.walker);
    sway_pose(now, f.sway);
    const BodyPose before = body_pose_of(w.previous_poses, f.walker);
    f.residue = take_over(block, own, f.segments, person, lane, before, now, k_tick, f.origin);
    f.stood = turns_of(block, own);
    // A push at the chest turns the body as well: what is higher has more of it.
    float moved = 0;
    auto share_of = [&](int s) { return 0.2f + block.place[s][1][own] / person.height[lane]; };
    for (int s = 0; s < k_segment_count; ++s) moved += f.segments.mass[s] * share_of(s) / f.segments.whole;
    for (int s = 0; s < k_segment_count; ++s) {
        const Vec2 gains = f.gives * (share_of(s) / moved);
        block.velocity[s][0][own] += gains.x;
        block.velocity[s][2][own] += gains.z;
    }
    f.gives = {};
    topple(block, own, f.segments, f.to);
    go_down(w.crowd, f.walker);
}

BodyInTheWay in_the_way(const World& w, const Fall& f) {
    return {balls_of(body_pose_of(w.previous_poses, f.walker), f.segments, person_of(w, f), lane_in_gait(f)),
            f.segments.radius};
}

// Everybody else on the ground who is so near that bodies may touch.
template <class Do>
void for_fallen_near(const World& w, const Fall& f, const Do& act) {
    constexpr float k_reach = 2.2f;  // metres, of hips
    std::array<uint32_t, 64> near;
    const size_t count = those_near(w, w.crowd.motion.position[f.walker], k_reach, near);
    for (const uint32_t i : std::span(near).first(count)) {
        const Fall* other = i == f.walker ? nullptr : own_of(w.falls.all, i);
        if (other && other->phase != FallPhase::sways) act(*other);
    }
}

// Who lies under another waits until that one is up, for a while.
bool is_lain_on(const World& w, const Fall& f) {
    constexpr float k_longest = 1;  // seconds
    if (w.tick > f.rises_at + ticks_of(k_longest)) return false;
    const BodyInTheWay own = in_the_way(w, f);
    bool is = false;
    for_fallen_near(w, f, [&](const Fall& other) {
        if (other.phase != FallPhase::rises) is = is || lies_on(in_the_way(w, other), own);
    });
    return is;
}

// Aims, planes and shapes of one who falls, for the tick.
void prepare_fall(World& w, const Fall& f) {
    Falls& falls = w.falls;
    const size_t b = f.lane / k_block;
    const int own = static_cast<int>(f.lane % k_block);
    set_shape(falls.shapes[b], own, f.segments);
    aim_fall(falls.aims[b], own, falls.blocks[b], f.stood, f.to,
             static_cast<float>(w.tick - f.began) * k_tick, f.lain);
    find_planes(falls.planes[b], own, falls.blocks[b], falls.shapes[b], f.origin, w.around, f.floor);
    constexpr float k_followed = 0.12f;  // metres
    const Vec2 place = on_ground(w.crowd.motion.position[f.walker]),
               off = on_ground(body_pose_of(w.previous_poses, f.walker).hips) - place;
    if (length(off) > k_followed)
        hold_back(falls.planes[b], own, falls.blocks[b], falls.shapes[b], f.origin, place, off / length(off));
    for_fallen_near(w, f, [&](const Fall& other) {
        meet_body(falls.planes[b], own, falls.blocks[b], falls.shapes[b], f.origin, in_the_way(w, other));
    });
}

void fall_on(World& w, Fall& f) {
    const size_t b = f.lane / k_block;
    const int own = static_cast<int>(f.lane % k_block);
    TumbleBlock& block = w.falls.blocks[b];
    const TumbleShapes& shapes = w.falls.shapes[b];
    // Nobody holds itself up on an arm for long.
    constexpr float k_gives_out = 1.3f;  // seconds
    const bool gives_out = w.tick - f.began > ticks_of(k_gives_out);
    if (f.lain > 0 || gives_out || is_down(block, shapes, w.falls.planes[b], own)) f.lain += k_tick;
    f.still = f.lain > 0.5f && liveliness(block, shapes, own) < k_quiet ? f.still + k_tick : 0;
    if (f.lain > k_calms_after) calm(block, own, k_calms);
    constexpr float k_any = 1e9f;  // muscles give some until then
    f.energy = keep_energy(block, f.segments, own, f.lain > 0 ? f.energy : k_any);
    constexpr float k_settles = 0.94f;  // of what is left of it, a tick
    for (Quat& turn : f.residue) turn = nlerp({}, turn, k_settles);
    set_body_pose(w.poses, person_of(w, f), f.walker,
                  body_pose_of(block, own, f.segments, f.residue, f.origin));
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

// How long one lies before getting up, seconds, how slowly it does that, and which way.
void lie_down(World& w, Fall& f) {
    const float age = w.kinds[w.crowd.identity.body[f.walker]].age;
    const RandomKey key{w.seed, f.walker, w.tick, Purpose::fall};
    const float old = smoothstep(50, 80, age);
    f.phase = FallPhase::lies;
    f.began = w.tick;
    f.rises_at = w.tick + ticks_of(random_between(key, 0.3f, 1.5f, 1) * (1 + 0.3f * old));
    f.slowness = random_between(key, 0.9f, 1.1f, 2) * (1 + 0.35f * old);
    f.from = body_pose_of(w.previous_poses, f.walker);
    constexpr float k_about = 0.6f;  // metres
    f.lie = lie_of(f.from, person_of(w, f), lane_in_gait(f), slope_at(w.around, f.from.hips, k_about));
    f.hips_at = on_ground(f.from.hips);
    f.stands_at = f.hips_at + heading_direction(f.lie.heading) * rise_ahead(leg_of(w, f.walker));
}

// Where it lies is where others find it.
void follow_hips(World& w, const Fall& f) {
    move_root(w, f.walker, on_ground(body_pose_of(w.previous_poses, f.walker).hips), 0.5f);
    w.crowd.motion.velocity[f.walker] = {};
}

void begin_to_rise(World& w, Fall& f) {
    f.phase = FallPhase::rises;
    f.began = w.tick;
    f.share = 0;
    f.raised = air_below(f.from, f.segments, person_of(w, f), lane_in_gait(f), w.around, f.floor);
    f.stage = first_stage(f.lie);
    w.crowd.motion.turn_rate[f.walker] = 0;
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
    set_body_pose(w.poses, person_of(w, f), f.walker, now);
    set_body_pose(w.previous_poses, person_of(w, f), f.walker, drawn);
}

// From hands and knees, where it will stand is where the foot that it sets down next can stay.
void find_stand(World& w, Fall& f) {
    const PersonBlock& person = person_of(w, f);
    const int lane = lane_in_gait(f);
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

void rise_on(World& w, Fall& f) {
    const PersonBlock& person = person_of(w, f);
    const int lane = lane_in_gait(f);
    const bool is_pulled = f.held != 0 && f.stage >= RiseStage::kneel;
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

// Poses of this tick are as yet the gait's; how it fell and lies is in those of the one before.
void change_phase(World& w, Fall& f) {
    if (f.phase == FallPhase::sways) {
        if (f.falls_at <= w.tick) begin_fall(w, f);
    } else if (f.phase == FallPhase::falls) {
        follow_hips(w, f);
        const bool has_long = w.tick - f.began > ticks_of(k_longest_fall);
        if (f.still > k_quiet_for || has_long) lie_down(w, f);
    } else if (f.phase == FallPhase::lies) {
        if (w.tick >= f.rises_at && !is_awaited(w, f) && !is_lain_on(w, f)) begin_to_rise(w, f);
    } else if (f.stage < RiseStage::stand) {
        if (f.share == 0 && f.stage == RiseStage::kneel) find_stand(w, f);
        turn_root(w, f);
    } else if (f.share == 0 && f.stage == RiseStage::stand) {
        find_stance(w, f);
    }
    if (f.phase != FallPhase::sways) lie_across(w.crowd, lying(w, f));
}

// Where a hand holds a cane.
Vec3 palm_at(const World& w, uint32_t walker, const JointPose& hand) {
    constexpr Vec3 k_palm{-0.006f, -0.049f, 0.014f};  // of the height, from the wrist
    const float height = w.gait.people[walker / k_block].height[walker % k_block];
    return hand.position + rotate(hand.rotation, k_palm * height);
}

// The cane of one who falls stays in a hand that holds it no longer: it hangs, drags and lies, and is set up
// again as its owner stands up.
void step_cane(World& w, const Fall& f) {
    const Cane* cane = own_of(w.gait.canes, f.walker);
    if (!cane || f.phase == FallPhase::sways) return;
    LooseRod* rod = own_of(w.falls.rods, f.walker);
    const JointPose hand = joint_pose(w.poses, f.walker, right_hand);
    const Vec3 palm = palm_at(w, f.walker, hand), tip = hand.position + rotate(hand.rotation, cane->tip_hs);
    if (!rod) {
        const JointPose was = joint_pose(w.previous_poses, f.walker, right_hand);
        LooseRod loose{.walker = f.walker, .length = length(tip - palm)};
        loose.grip = palm_at(w, f.walker, was);
        loose.tip = loose.tip_before = was.position + rotate(was.rotation, cane->tip_hs);
        loose.turn = was.rotation;
        rod = &*w.falls.rods.insert(take_away(w.falls.rods, f.walker), loose);
    }
    const Vec3 hangs = normalize_or(tip - palm, {0, -1, 0}),
               in_hand = rotate(conjugate(hand.rotation), hangs);
    const bool is_standing_up = f.phase == FallPhase::rises && f.stage >= RiseStage::stand;
    if (is_standing_up) {
        const float t = f.stage == RiseStage::done ? 1 : smoothstep(0, 1, f.share);
        const float by = t < 1 ? (t - rod->share) / (1 - rod->share) : 1;
        rod->share = t;
        point_rod(*rod, w.around, palm, hangs, by);
        turn_rod(*rod, in_hand);
        rod->turn = nlerp(rod->turn, hand.rotation, by);
        return;
    }
    rod->share = 0;
    swing_rod(*rod, w.around, palm, k_tick);
    turn_rod(*rod, in_hand);
}

bool is_done(const Fall& f) {
    if (f.phase == FallPhase::sways) return f.falls_at == k_never && is_over(f.sway);
    return f.phase == FallPhase::rises && f.stage == RiseStage::done;
}

void step_fall(World& w, Fall& f) {
    switch (f.phase) {
        case FallPhase::sways: {
            advance(f.sway, k_tick);
            f.carried = f.carried * k_comes_to_rest;
            BodyPose pose = body_pose_of(w.poses, f.walker);
            sway_pose(pose, f.sway);
            set_body_pose(w.poses, person_of(w, f), f.walker, pose);
            break;
        }
        case FallPhase::falls:
            fall_on(w, f);
            break;
        case FallPhase::lies: {
            BodyPose pose = f.from;
            const float lain = static_cast<float>(w.tick - f.began) * k_tick;
            breathe(pose, lain, smoothstep(0, 0.5f, lain));
            set_body_pose(w.poses, person_of(w, f), f.walker, pose);
            break;
        }
        case FallPhase::rises:
            rise_on(w, f);
            break;
    }
}

}  // namespace

Downed lying(const World& w, const Fall& f) {
    constexpr std::array<int, k_lying_parts> k_balls = {6, 3, 4, 7, 15, 9, 17, 11, 19, 12, 20, 14, 22};
    const auto balls =
        balls_of(body_pose_of(w.previous_poses, f.walker), f.segments, person_of(w, f), lane_in_gait(f));
    const Vec2 at = on_ground(w.crowd.motion.position[f.walker]);
    Downed down{.walker = f.walker};
    for (size_t k = 0; k < k_lying_parts; ++k) {
        const auto ball = static_cast<size_t>(k_balls[k]);
        down.parts[k] = {on_ground(balls[ball]) - at, f.segments.radius[ball]};
    }
    down.across = on_ground(balls[6]) - at;
    down.along = on_ground(balls[14] + balls[22]) * 0.5f - at;
    return down;
}

float seconds_to_rise(const Fall& f) {
    float seconds = 0;
    for (RiseStage s = first_stage(f.lie); s != RiseStage::done; s = next_stage(s)) seconds += seconds_of(s);
    return seconds * f.slowness;
}

void make_room_to_fall(World& w, size_t count) {
    Falls& falls = w.falls;
    if (falls.all.capacity() >= count) return;
    count = std::max(count, 2 * falls.all.capacity());
    falls.all.reserve(count);
    falls.rods.reserve(count);
    w.crowd.downed.reserve(count);
    make_room_to_mind(w, count);
    const size_t blocks = block_count(count);
    falls.blocks.reserve(blocks);
    falls.shapes.reserve(blocks);
    falls.aims.reserve(blocks);
    falls.planes.reserve(blocks);
    falls.lane_of.reserve(blocks * k_block);
}

void step_falls(World& w) {
    Falls& falls = w.falls;
    if (falls.all.empty()) return;
    for (Fall& f : falls.all) change_phase(w, f);
    falls.shapes.resize(falls.blocks.size());
    falls.aims.resize(falls.blocks.size());
    falls.planes.resize(falls.blocks.size());
    falls.lane_of.assign(falls.blocks.size() * k_block, k_no_fall);
    for (size_t i = 0; i < falls.all.size(); ++i)
        if (falls.all[i].phase == FallPhase::falls)
            falls.lane_of[falls.all[i].lane] = static_cast<uint32_t>(i);
    parallel_for(*w.workers, falls.blocks.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t b = begin; b < end; ++b) {
            falls.planes[b].has_walls = 0;
            bool is_any = false;
            for (size_t lane = b * k_block; lane < (b + 1) * k_block; ++lane) {
                if (falls.lane_of[lane] == k_no_fall) continue;
                prepare_fall(w, falls.all[falls.lane_of[lane]]);
                is_any = true;
            }
            if (is_any) tumble(falls.shapes[b], falls.aims[b], falls.planes[b], k_tick, falls.blocks[b]);
        }
    });
    parallel_for(*w.workers, falls.all.size(), 4, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) step_fall(w, falls.all[i]);
    });
    for (const Fall& f : falls.all) step_cane(w, f);
    for (size_t i = 0; i < falls.all.size(); ++i)
        if (is_done(falls.all[i]) && falls.all[i].phase == FallPhase::rises)
            get_up(w.crowd, falls.all[i].walker);
    std::erase_if(falls.all, is_done);
    std::erase_if(falls.rods, [&](const LooseRod& rod) { return !own_of(falls.all, rod.walker); });
}

uint64_t hash_falls(const World& w) {
    uint64_t hash = w.falls.all.size();
    auto add = [&](const auto& value) { hash = hash_bytes(hash, &value, sizeof value); };
    for (const Fall& f : w.falls.all) {
        add(f.walker), add(f.phase), add(f.began), add(f.falls_at), add(f.to), add(f.gives), add(f.carried),
            add(f.sway);
        add(f.lane), add(f.energy), add(f.lain), add(f.still), add(f.residue), add(f.stage), add(f.share),
            add(f.raised), add(f.fell), add(f.held), add(f.lie.heading), add(f.stands_at), add(f.from),
            add(f.stance);
    }
    for (const Fall& f : w.falls.all) {
        if (f.phase != FallPhase::falls) continue;
        const auto* rows = reinterpret_cast<const LaneRow*>(&w.falls.blocks[f.lane / k_block]);
        for (size_t row = 0; row < sizeof(TumbleBlock) / sizeof(LaneRow); ++row)
            add(rows[row].lanes[f.lane % k_block]);
    }
    for (const LooseRod& rod : w.falls.rods) add(rod);
    return hash;
}

void forget_fall(World& w, uint32_t walker) {
    (void)take_away(w.falls.all, walker);
    (void)take_away(w.falls.rods, walker);
}

}  // namespace flaneur
