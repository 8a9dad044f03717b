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
constexpr float k_quiet = 0.12f, k_quiet_for = 0.25f, k_longest_fall = 2.8f;  // m/s, seconds
// Of what it carries, a tick: the extrapolated centre of mass comes back over the feet within some 0.3 s, the
// inverse of sqrt(g / l) (Hof, Gazendam & Sinke 2005).
constexpr float k_comes_to_rest = 0.95f;
constexpr float k_meets_standing = 1.2f;                // seconds
constexpr float k_calms_after = 0.8f, k_calms = 0.93f;  // seconds; of how it moves, a tick

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

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
    const PersonBlock& person = person_of(w, f.walker);
    const int lane = lane_of(f.walker);
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
    sway_pose(now, f.sway, own_of(w.gait.canes, f.walker));
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

BodyInTheWay in_the_way(const World& w, uint32_t walker, const Segments& segments) {
    const BodyPose pose = body_pose_of(w.previous_poses, walker);
    return {balls_of(pose, segments, person_of(w, walker), lane_of(walker)), segments.radius};
}
BodyInTheWay in_the_way(const World& w, const Fall& f) { return in_the_way(w, f.walker, f.segments); }

// Calls act(walker, its fall or null) for everybody else who is so near that bodies may touch; who sways
// still stands.
template <class Do>
void for_those_near(const World& w, const Fall& f, const Do& act) {
    constexpr float k_reach = 2.2f;  // metres, of hips
    std::array<uint32_t, 64> near;
    const size_t count = those_near(w, w.crowd.motion.position[f.walker], k_reach, near);
    for (const uint32_t i : std::span(near).first(count)) {
        if (i == f.walker) continue;
        const Fall* other = own_of(w.falls.all, i);
        act(i, other && other->phase != FallPhase::sways ? other : nullptr);
    }
}
template <class Do>
void for_fallen_near(const World& w, const Fall& f, const Do& act) {
    for_those_near(w, f, [&](uint32_t, const Fall* other) {
        if (other) act(*other);
    });
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
    // Whoever stands there is slid down along, and has gone aside by the time that one lies.
    const bool meets_standing = w.tick - f.began < ticks_of(k_meets_standing);
    for_those_near(w, f, [&](uint32_t i, const Fall* other) {
        if (other || meets_standing)
            meet_body(
                falls.planes[b], own, falls.blocks[b], falls.shapes[b], f.origin,
                other ? in_the_way(w, *other) : in_the_way(w, i, segments_of(person_of(w, i), lane_of(i))));
    });
}

void fall_on(World& w, Fall& f) {
    const size_t b = f.lane / k_block;
    const int own = static_cast<int>(f.lane % k_block);
    TumbleBlock& block = w.falls.blocks[b];
    const TumbleShapes& shapes = w.falls.shapes[b];
    // Nobody holds itself up on an arm for long.
    constexpr float k_gives_out = 1.2f;  // seconds
    const bool gives_out = w.tick - f.began > ticks_of(k_gives_out);
    if (f.lain > 0 || gives_out || is_down(block, shapes, w.falls.planes[b], own)) f.lain += k_tick;
    f.still = f.lain > 0.5f && liveliness(block, shapes, own) < k_quiet ? f.still + k_tick : 0;
    if (f.lain > k_calms_after) calm(block, own, k_calms);
    constexpr float k_any = 1e9f;  // muscles give some until then
    f.energy = keep_energy(block, f.segments, own, f.lain > 0 ? f.energy : k_any);
    constexpr float k_settles = 0.94f;  // of what is left of it, a tick
    for (Quat& turn : f.residue) turn = nlerp({}, turn, k_settles);
    set_body_pose(w.poses, person_of(w, f.walker), f.walker,
                  body_pose_of(block, own, f.segments, f.residue, f.origin));
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
    } else {
        choose_stand(w, f);
    }
    if (f.phase != FallPhase::sways) lie_across(w.crowd, lying(w, f));
}

// Where a hand holds a cane.
Vec3 palm_at(const World& w, uint32_t walker, const JointPose& hand) {
    constexpr Vec3 k_palm{-0.006f, -0.049f, 0.014f};  // of the height, from the wrist
    const float height = person_of(w, walker).height[walker % k_block];
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
    const Vec3 hangs = normalize_or(tip - palm, {0, -1, 0});
    const bool is_standing_up = f.phase == FallPhase::rises && f.stage >= RiseStage::stand;
    const float stands = f.stage == RiseStage::done ? 1 : smoothstep(0, 1, f.share);
    carry_rod(*rod, w.around, palm, hangs, hand.rotation, is_standing_up ? stands : 0);
}

// Who comes down on others who stand makes them step aside.
void jostle(World& w) {
    constexpr float k_hits_after = 0.25f, k_reach = 0.75f, k_gives = 0.45f;  // seconds, metres, m/s
    constexpr size_t k_most = 8;
    struct Jostled {
        uint32_t walker;
        Vec2 by;
    };
    std::array<Jostled, k_most> jostled;
    size_t count = 0;
    for (const Fall& f : w.falls.all) {
        if (f.phase != FallPhase::falls || w.tick - f.began != ticks_of(k_hits_after)) continue;
        const Vec2 chest = on_ground(joint_pose(w.previous_poses, f.walker, upper_chest).position);
        for_those_near(w, f, [&](uint32_t i, const Fall* other) {
            const Vec2 off = on_ground(w.crowd.motion.position[i]) - chest;
            if (other || count == k_most || length(off) > k_reach || dot(off, f.to) < 0) return;
            jostled[count++] = {i, normalize_or(off, f.to) * k_gives};
        });
    }
    for (const Jostled& j : std::span(jostled).first(count)) push_walker(w, j.walker, j.by);
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
            sway_pose(pose, f.sway, own_of(w.gait.canes, f.walker));
            set_body_pose(w.poses, person_of(w, f.walker), f.walker, pose);
            break;
        }
        case FallPhase::falls:
            fall_on(w, f);
            break;
        case FallPhase::lies:
            lie_on(w, f);
            break;
        case FallPhase::rises:
            rise_on(w, f);
            break;
    }
}

}  // namespace

Downed lying(const World& w, const Fall& f) {
    constexpr std::array<int, k_lying_parts> k_balls = {6, 3, 4, 7, 15, 9, 17, 11, 19, 12, 20, 14, 22};
    const auto balls = in_the_way(w, f).balls;
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
    if (!is_on_course(w)) jostle(w);
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
