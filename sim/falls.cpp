#include "sim/falls.h"

#include <algorithm>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/fall.h"
#include "sim/fall/lane.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr uint32_t k_no_tick = ~0u, k_no_fall = ~0u;
constexpr float k_quiet = 0.12f, k_quiet_for = 0.25f, k_longest_fall = 2.5f;  // m/s, seconds
constexpr float k_calms_after = 0.8f, k_calms = 0.93f;  // seconds; of how it moves, a tick

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

const PersonBlock& person_of(const World& w, const Fall& f) { return w.gait.people[f.walker / k_block]; }
int lane_in_gait(const Fall& f) { return static_cast<int>(f.walker % k_block); }

float leg_of(const World& w, uint32_t walker) {
    return w.gait.people[walker / k_block].joints[left_upper_leg][1][walker % k_block];
}

// Of the old, less (Maki & McIlroy, "Control of rapid limb movements for balance recovery", Age and Ageing
// 35, 2006: from 60 on), and of those who reel; and everybody is a little other.
Sturdiness sturdiness_of(const World& w, uint32_t walker) {
    const CrowdIdentity& who = w.crowd.identity;
    const float age = w.kinds[who.body[walker]].age;
    const RandomKey key{w.seed, walker, w.crowd.slots.generation[walker], Purpose::fall};
    const float own = random_between(key, 0.9f, 1.1f);
    return {leg_of(w, walker), w.crowd.motion.heading[walker],
            own * (1 - 0.4f * smoothstep(60, 85, age)) * (1 - 0.4f * drunk_of(w, walker))};
}

// Its trunk, head and arms turned after the sway; the head half of it, since eyes stay level.
void sway_pose(BodyPose& pose, Vec2 lean) {
    const float angle = length(lean);
    if (angle < 1e-5f) return;
    const Vec2 way = lean / angle;
    const Vec3 axis{way.z, 0, -way.x};  // up turns towards the lean about it
    auto turn = [&](float share) {
        const SinCos h = sin_cos(0.5f * share * angle);
        return Quat{axis.x * h.sine, axis.y * h.sine, axis.z * h.sine, h.cosine};
    };
    for (int j = spine; j <= right_hand; ++j) {
        const float share = j == spine ? 0.4f : j == chest ? 0.7f : j == head ? 0.4f : 1.0f;
        pose.rotation[j] = normalize(turn(share) * pose.rotation[j]);
    }
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
    f.began = w.tick;
    f.lain = f.still = 0;
    f.segments = segments_of(person, lane);
    f.floor = w.crowd.motion.under[f.walker].height;
    f.origin = w.crowd.motion.position[f.walker];
    BodyPose now = body_pose_of(w.poses, f.walker);
    sway_pose(now, f.sway.lean);
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
    go_down(w.crowd, f.walker);
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
}

void fall_on(World& w, Fall& f) {
    const size_t b = f.lane / k_block;
    const int own = static_cast<int>(f.lane % k_block);
    TumbleBlock& block = w.falls.blocks[b];
    const TumbleShapes& shapes = w.falls.shapes[b];
    if (f.lain > 0 || is_down(block, shapes, w.falls.planes[b], own)) f.lain += k_tick;
    f.still = f.lain > 0.5f && liveliness(block, shapes, own) < k_quiet ? f.still + k_tick : 0;
    if (f.lain > k_calms_after) calm(block, own, k_calms);
    constexpr float k_any = 1e9f;  // muscles give some until then
    f.energy = keep_energy(block, f.segments, own, f.lain > 0 ? f.energy : k_any);
    constexpr float k_settles = 0.94f;  // of what is left of it, a tick
    for (Quat& turn : f.residue) turn = nlerp({}, turn, k_settles);
    set_body_pose(w.poses, person_of(w, f), f.walker,
                  body_pose_of(block, own, f.segments, f.residue, f.origin));
}

// How long one lies before getting up, seconds, and how slowly it does that.
void lie_down(World& w, Fall& f) {
    const float age = w.kinds[w.crowd.identity.body[f.walker]].age;
    const RandomKey key{w.seed, f.walker, w.tick, Purpose::fall};
    const float old = smoothstep(50, 80, age);
    f.phase = FallPhase::lies;
    f.began = w.tick;
    f.rises_at = w.tick + ticks_of(random_between(key, 0.4f, 1.4f, 1) * (1 + 0.3f * old));
    f.slowness = random_between(key, 0.9f, 1.1f, 2) * (1 + 0.35f * old);
    f.from = body_pose_of(w.previous_poses, f.walker);
}

// Where the crowd has it goes along the mesh towards `to`, onto ground up to `up` metres higher.
void move_root(World& w, uint32_t walker, Vec2 to, float up) {
    CrowdMotion& m = w.crowd.motion;
    const NavPoint from{m.position[walker], m.polygon[walker]};
    const NavPoint end =
        move_along(*w.navmesh, 0, from, at_height(to, from.position.y), by_of(w.crowd, walker));
    m.position[walker] = end.position;
    m.polygon[walker] = end.polygon;
    if (const auto hit = ground_at(w.around, end.position, up, 1.5f)) {
        m.position[walker].y = hit->height;
        m.under[walker] = *hit;
    }
}

// Where it lies is where others find it, and from where it will walk on.
void follow_hips(World& w, const Fall& f) {
    const auto places = places_of(body_pose_of(w.previous_poses, f.walker), person_of(w, f), lane_in_gait(f));
    const Vec2 hips_at = on_ground(places[hips]);
    move_root(w, f.walker, hips_at, 0.5f);
    w.crowd.motion.velocity[f.walker] = {};
    lie_across(w.crowd, f.walker, on_ground(places[upper_chest]) - hips_at);
}

void begin_to_rise(World& w, Fall& f) {
    const int lane = lane_in_gait(f);
    f.phase = FallPhase::rises;
    f.began = w.tick;
    f.share = 0;
    f.lifts = {};
    f.lie = lie_of(f.from, person_of(w, f), lane);
    f.stage = first_stage(f.lie);
    f.hips_at = on_ground(f.from.hips);
    // It will stand ahead of there.
    const Vec2 facing = heading_direction(f.lie.heading);
    move_root(w, f.walker, f.hips_at + facing * rise_ahead(leg_of(w, f.walker)), 0.8f);
    w.crowd.motion.heading[f.walker] = f.lie.heading;
    w.crowd.motion.turn_rate[f.walker] = 0;
    const BodyPose drawn = body_pose_of(w.previous_poses, f.walker);
    start_body(w, f.walker);
    set_body_pose(w.previous_poses, person_of(w, f), f.walker, drawn);
}

// `stance` is how the gait has it stand where it will.
void rise_on(World& w, Fall& f, const BodyPose& stance) {
    const PersonBlock& person = person_of(w, f);
    const int lane = lane_in_gait(f);
    f.share = std::min(f.share + k_tick / (seconds_of(f.stage) * f.slowness), 1.0f);
    const float t = smoothstep(0, 1, f.share);
    BodyPose pose;
    if (f.stage == RiseStage::stand) {
        pose = mixed(f.from, stance, t);
        // The foot that was set down stays; the other one is lifted, and set down beside it.
        constexpr float k_lifts = 0.13f;  // of the leg
        const auto began = places_of(f.from, person, lane), ends = places_of(stance, person, lane);
        auto ankle = [&](Joint foot, float lift) {
            return lerp(began[foot], ends[foot], t) + Vec3{0, 4 * t * (1 - t) * lift, 0};
        };
        reach_with_leg(pose, person, lane, k_left, ankle(left_foot, 0));
        reach_with_leg(pose, person, lane, k_right, ankle(right_foot, k_lifts * leg_of(w, f.walker)));
        rest_on_ground(pose, f.segments, person, lane, w.around, f.floor, false, f.lifts, k_tick);
    } else {
        BodyPose end = end_of(f.stage, f.lie, person, lane, f.hips_at);
        end.hips.y += w.crowd.motion.position[f.walker].y;
        pose = mixed(f.from, end, t);
        rest_on_ground(pose, f.segments, person, lane, w.around, f.floor, true, f.lifts, k_tick);
        keep_off_walls(pose, f.segments, person, lane, w.around);
    }
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
        if (w.tick >= f.rises_at) begin_to_rise(w, f);
    }
}

bool is_done(const Fall& f) {
    if (f.phase == FallPhase::sways) return f.falls_at == k_no_tick && is_over(f.sway);
    return f.phase == FallPhase::rises && f.stage == RiseStage::done;
}

void step_fall(World& w, Fall& f) {
    switch (f.phase) {
        case FallPhase::sways: {
            advance(f.sway, k_tick);
            BodyPose pose = body_pose_of(w.poses, f.walker);
            sway_pose(pose, f.sway.lean);
            set_body_pose(w.poses, person_of(w, f), f.walker, pose);
            break;
        }
        case FallPhase::falls:
            fall_on(w, f);
            break;
        case FallPhase::lies:
            set_body_pose(w.poses, person_of(w, f), f.walker, f.from);
            break;
        case FallPhase::rises:
            rise_on(w, f, body_pose_of(w.poses, f.walker));
            break;
    }
}

}  // namespace

void make_room_to_fall(World& w, size_t count) {
    Falls& falls = w.falls;
    if (falls.all.capacity() >= count) return;
    count = std::max(count, 2 * falls.all.capacity());
    falls.all.reserve(count);
    w.crowd.downed.reserve(count);
    const size_t blocks = block_count(count);
    falls.blocks.reserve(blocks);
    falls.shapes.reserve(blocks);
    falls.aims.reserve(blocks);
    falls.planes.reserve(blocks);
    falls.lane_of.reserve(blocks * k_block);
}

void push_walker(World& w, uint32_t walker, Vec2 change) {
    constexpr float k_most = 8;  // m/s: harder than any fall from where one stands
    if (const float wanted = length(change); wanted > k_most) change = change * (k_most / wanted);
    const float speed = length(change);
    if (speed < 1e-4f) return;
    std::vector<Fall>& all = w.falls.all;
    make_room_to_fall(w, all.size() + 1);
    Fall* f = own_of(all, walker);
    if (f && f->phase != FallPhase::sways) {
        // Whoever is down already is pushed about as it lies; who gets up is steadied by both hands.
        if (f->phase != FallPhase::falls) return;
        TumbleBlock& block = w.falls.blocks[f->lane / k_block];
        for (int s = 0; s < k_segment_count; ++s) {
            block.velocity[s][0][f->lane % k_block] += change.x;
            block.velocity[s][2][f->lane % k_block] += change.z;
        }
        f->energy = energy_of(block, f->segments, static_cast<int>(f->lane % k_block));
        return;
    }
    if (!f) {
        Fall fall;
        fall.walker = walker;
        fall.falls_at = k_no_tick;
        fall.began = w.tick;
        f = &*all.insert(take_away(all, walker), fall);
    }
    f->to = change / speed;
    const float times = speed / bearable_push(sturdiness_of(w, walker), change);
    const bool falls = times >= 1;
    if (falls) f->falls_at = std::min(f->falls_at, w.tick + ticks_of(staggers_for(times)));
    if (falls && f->falls_at <= w.tick) {
        f->gives += change;
        if (const float gives = length(f->gives); gives > k_most) f->gives = f->gives * (k_most / gives);
        return;
    }
    // Feet follow no more than that.
    constexpr float k_fastest_stagger = 1.6f;
    shove(f->sway, change);
    Vec2& velocity = w.crowd.motion.velocity[walker];
    velocity += change;
    const float goes = length(velocity), most = std::max(k_fastest_stagger, goes - speed);
    if (goes > most) velocity = velocity * (most / goes);
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
    for (size_t i = 0; i < falls.all.size(); ++i)
        if (is_done(falls.all[i]) && falls.all[i].phase == FallPhase::rises)
            get_up(w.crowd, falls.all[i].walker);
    std::erase_if(falls.all, is_done);
}

uint64_t hash_falls(const World& w) {
    uint64_t hash = w.falls.all.size();
    auto add = [&](const auto& value) { hash = hash_bytes(hash, &value, sizeof value); };
    for (const Fall& f : w.falls.all) {
        add(f.walker), add(f.phase), add(f.began), add(f.falls_at), add(f.to), add(f.gives), add(f.sway);
        add(f.lane), add(f.energy), add(f.lain), add(f.still), add(f.residue), add(f.stage), add(f.share),
            add(f.lifts), add(f.from);
    }
    for (const Fall& f : w.falls.all) {
        if (f.phase != FallPhase::falls) continue;
        const auto* rows = reinterpret_cast<const LaneRow*>(&w.falls.blocks[f.lane / k_block]);
        for (size_t row = 0; row < sizeof(TumbleBlock) / sizeof(LaneRow); ++row)
            add(rows[row].lanes[f.lane % k_block]);
    }
    return hash;
}

void forget_fall(World& w, uint32_t walker) { (void)take_away(w.falls.all, walker); }

}  // namespace flaneur
