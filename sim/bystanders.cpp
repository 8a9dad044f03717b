#include "sim/bystanders.h"

#include <algorithm>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/help.h"
#include "sim/pastimes/pastimes.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_notices = 0.5f;                       // seconds
constexpr float k_near = 8, k_helps_within = 6;         // metres
constexpr float k_other_storey = 1.5f;                  // metres
constexpr float k_hastens = 1.5f;                       // m/s, of who comes to help
constexpr float k_up_within = 9.5f;                     // seconds after the fall, with help
constexpr int k_most_helpers = 2, k_most_watchers = 5;  // of one who lies
constexpr float k_usual_tries = 1.8f;  // of each who could help, over the share of those who do

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }
float seconds_of(uint32_t ticks) { return static_cast<float>(ticks) * k_tick; }

float age_of(const World& w, uint32_t walker) { return w.kinds[w.crowd.identity.body[walker]].age; }

// And does nothing else.
bool is_free(const World& w, uint32_t i) { return is_by_itself(w, i) && !is_staying(*w.pastimes, i); }
bool can_stop(const World& w, uint32_t i) {
    return is_free(w, i) && w.gait.blocks[i / k_block].jump[i % k_block] == 0;
}
bool can_help(const World& w, uint32_t i) {
    const float age = age_of(w, i);
    const bool has_things = own_of(w.gait.canes, i) || own_of(w.gait.prams, i);
    return can_stop(w, i) && !has_things && age >= 13 && age < 72 &&
           person_of(w, i).free_hands[i % k_block] != 0;
}

// Canes are in right hands.
bool is_hand_free(const World& w, uint32_t i, Side side) {
    if (side == k_right && own_of(w.gait.canes, i)) return false;
    return (person_of(w, i).free_hands[i % k_block] & 1 << side) != 0;
}

// 1 of a middle one.
float helpfulness(const Personality& p) {
    return clamp(1 + 0.35f * p.agreeableness + 0.15f * p.extraversion - 0.15f * p.neuroticism, 0.2f, 1.9f);
}

Bystander& bystander(World& w, uint32_t walker) {
    auto& all = w.bystanders.all;
    if (Bystander* own = own_of(all, walker)) return *own;
    Bystander b;
    b.walker = walker;
    return *all.insert(take_away(all, walker), b);
}

void set_concern(World& w, Bystander& b, Concern does, float seconds) {
    b.does = does;
    b.began = w.tick;
    b.until = w.tick + ticks_of(seconds);
}

// A place beside one who will stand up, on a side of it, that is walkable and where no part of it lies.
struct Place {
    Vec2 at{};
    bool is_one = false;
};
Place place_to_help(const World& w, const Fall& f, Side side, float radius) {
    constexpr float k_off = 0.74f, k_clear = k_beside_who_lies + 0.02f;  // metres
    const Downed* down = own_of(w.crowd.downed, f.walker);
    const Vec2 hips_at = on_ground(w.crowd.motion.position[f.walker]);
    const NavPoint from{w.crowd.motion.position[f.walker], w.crowd.motion.polygon[f.walker]};
    for (const float degrees : {50.0f, 65.0f, 35.0f, 85.0f, 105.0f}) {
        const float yaw = f.lie.heading + (side == k_left ? degrees : -degrees) * k_radians;
        const Vec2 at = f.stands_at + heading_direction(yaw) * k_off;
        bool is_clear_there = true;
        for (const LyingPart& part : down->parts)
            is_clear_there &= length(hips_at + part.from - at) > part.radius + radius + k_clear;
        if (!is_clear_there) continue;
        const NavPoint end = move_along(*w.navmesh, 0, from, at_height(at, from.position.y), By::feet);
        if (length(on_ground(end.position) - at) < 0.03f) return {at, true};
    }
    return {};
}

// How far it is to walk there, past the body.
float way_to(const World& w, uint32_t i, Vec2 at) {
    return 1.15f * length(at - on_ground(w.crowd.motion.position[i]));
}

// Sends the nearest who can and would, by `tries`, if one is in time; returns whether it did.
bool send_helper(World& w, const Fall& f, Side side, std::span<const uint32_t> near) {
    constexpr float k_turns_and_stops = 0.7f;  // seconds
    const float in_time = k_up_within - seconds_of(w.tick - f.fell) - 0.85f * seconds_to_rise(f);
    uint32_t best = k_nobody;
    float least = k_helps_within;
    Place there;
    for (const uint32_t i : near) {
        const Bystander* is = own_of(w.bystanders.all, i);
        if (!can_help(w, i) || (is && is->does != Concern::glances && is->does != Concern::watches)) continue;
        const RandomKey key{w.seed, i, f.fell, Purpose::fall};
        const float would = w.bystanders.helpers * k_usual_tries * helpfulness(personality_of(w, i)) * 0.8f;
        if (w.bystanders.helpers < 1 && random_unit(key, 5) >= would) continue;
        const Place place = place_to_help(w, f, side, w.crowd.identity.radius[i]);
        if (!place.is_one) return false;
        const float far = way_to(w, i, place.at);
        if (far >= least || far / k_hastens + k_turns_and_stops > in_time) continue;
        const Vec3 from = w.crowd.motion.position[i];
        if (!is_clear(*w.navmesh, from, at_height(place.at, w.crowd.motion.position[f.walker].y))) continue;
        least = far, best = i, there = place;
    }
    if (best == k_nobody) return false;
    Bystander& b = bystander(w, best);
    set_concern(w, b, Concern::comes, least / k_hastens + 2 * k_turns_and_stops);
    b.whom = f.walker, b.whom_generation = w.crowd.slots.generation[f.walker];
    b.side = side;
    const int32_t free = person_of(w, best).free_hands[best % k_block];
    const Side own = side == k_left ? k_right : k_left;
    b.hand = (free & (1 << own)) != 0 ? own : side;
    const Vec2 facing = normalize_or(f.stands_at - there.at, {0, 1});
    call(w.crowd,
         {best, there.at, facing, std::min(k_hastens, 1.4f * w.crowd.identity.preferred_speed[best])});
    return true;
}

// Some of those who come by stop at a few metres, the others turn their heads.
void let_others_look(World& w, const Fall& f, std::span<const uint32_t> near) {
    constexpr float k_nearest = 1.5f, k_farthest = 3, k_sees = 6, k_share = 0.35f;
    const Vec2 at = on_ground(w.crowd.motion.position[f.walker]);
    int watchers = 0;
    for (const uint32_t i : near) {
        if (!is_free(w, i) || own_of(w.bystanders.all, i)) continue;
        const RandomKey key{w.seed, i, f.fell, Purpose::fall};
        const Vec2 to = at - on_ground(w.crowd.motion.position[i]);
        const float far = length(to);
        const float curious = 1 + 0.3f * personality_of(w, i).openness;
        const bool stops = can_stop(w, i) && watchers < k_most_watchers && far < k_sees && far > k_nearest &&
                           !own_of(w.gait.prams, i) &&
                           random_unit(key, 6) < std::min(w.bystanders.helpers * 2, 1.0f) * k_share * curious;
        if (w.bystanders.helpers <= 0) continue;
        Bystander& b = bystander(w, i);
        b.whom = f.walker, b.whom_generation = w.crowd.slots.generation[f.walker];
        if (!stops) {
            set_concern(w, b, Concern::glances, random_between(key, 0.8f, 2.6f, 7));
            continue;
        }
        ++watchers;
        set_concern(w, b, Concern::watches, random_between(key, 2.5f, 5.5f, 7));
        const Vec2 way = normalize_or(to, {0, 1});
        const float stands = std::min(far, random_between(key, k_nearest + 0.3f, k_farthest, 8));
        const Vec2 place = at - way * stands;
        const Vec3 from = w.crowd.motion.position[i];
        const bool comes = is_clear(*w.navmesh, from, at_height(place, from.y));
        call(w.crowd, {i, comes ? place : on_ground(from), way, w.crowd.identity.preferred_speed[i]});
    }
}

void notice(World& w, const Fall& f) {
    constexpr size_t k_most_near = 64;
    std::array<uint32_t, k_most_near> all, near;
    const Vec3 at = w.crowd.motion.position[f.walker];
    size_t count = 0;
    for (const uint32_t i : std::span(all).first(those_near(w, at, k_near, all)))
        if (i != f.walker && std::fabs(w.crowd.motion.position[i].y - at.y) < k_other_storey)
            near[count++] = i;
    const std::span<const uint32_t> those{near.data(), count};
    if (f.phase == FallPhase::lies) {
        int sent = 0;
        for (const Side side : {k_right, k_left})
            if (is_hand_free(w, f.walker, side) && sent < k_most_helpers && (sent == 0 || f.walker % 3 == 0))
                sent += send_helper(w, f, side, those);
        return;
    }
    let_others_look(w, f, those);
}

// Those to whom a creature comes into view look at it for a while, by turns.
void notice_creatures(World& w) {
    constexpr uint32_t k_every = 30;                               // ticks
    constexpr float k_sees = 7, k_beside = -0.2f, k_share = 0.3f;  // metres; a cosine
    constexpr size_t k_most = 16;                                  // who do at a time, for each of them
    std::array<uint32_t, 32> near;
    for (const uint32_t creature : w.herd.goes_as) {
        if ((w.tick + creature) % k_every != 0) continue;
        const Vec3 at = w.crowd.motion.position[creature];
        const size_t count = those_near(w, at, k_sees, near);
        for (const uint32_t i : std::span(near).first(count)) {
            const RandomKey key{w.seed, i, w.tick, Purpose::fall};
            const Vec2 to = on_ground(at - w.crowd.motion.position[i]);
            const bool sees = dot(to, heading_direction(w.crowd.motion.heading[i])) > k_beside * length(to);
            if (!sees || !is_free(w, i) || own_of(w.bystanders.all, i) || random_unit(key, 6) >= k_share)
                continue;
            if (w.bystanders.all.size() >= k_most * w.herd.goes_as.size()) return;
            Bystander& b = bystander(w, i);
            b.whom = creature, b.whom_generation = w.crowd.slots.generation[creature];
            set_concern(w, b, Concern::glances, random_between(key, 0.8f, 2.6f, 7));
        }
    }
}

// Where one looks at another.
Vec3 place_to_look_at(const World& w, uint32_t whom) {
    if (is_creature(w.herd, whom)) return w.herd.creatures[whom - w.herd.goes_as.front()].middle;
    return place_of(body_pose_of(w.poses, whom), person_of(w, whom), lane_of(whom), head);
}

// It lets go, and stands a moment; so does who was helped.
void part(World& w, Bystander& b, float seconds) { set_concern(w, b, Concern::parts, seconds); }

void thank(World& w, uint32_t who, uint32_t helper) {
    if (!is_there(w.crowd, who) || own_of(w.crowd.passages, who)) return;
    const RandomKey key{w.seed, who, w.tick, Purpose::fall};
    const Vec2 at = on_ground(w.crowd.motion.position[who]);
    const Vec2 way = normalize_or(on_ground(w.crowd.motion.position[helper]) - at, {0, 1});
    call(w.crowd, {who, at, way, 0.5f});
    Bystander b;
    b.walker = who, b.whom = helper;
    b.whom_generation = w.crowd.slots.generation[helper];
    set_concern(w, b, Concern::thanks, random_between(key, 0.7f, 1.5f, 9));
    auto& all = w.bystanders.all;
    all.insert(take_away(all, who), b);
}

// What one does next; returns whether it does anything.
void decide(World& w, Bystander& b) {
    constexpr float k_there = 0.22f, k_nearly = 0.5f;  // metres
    const Fall* f = own_of(w.falls.all, b.whom);
    const bool is_whom = is_there(w.crowd, {b.whom, b.whom_generation});
    const bool lies = is_whom && f && f->phase != FallPhase::sways;
    const Called* called = own_of(w.crowd.called, b.walker);
    switch (b.does) {
        case Concern::comes: {
            if (!lies || !called) return part(w, b, 0.6f);
            const Vec2 here = on_ground(w.crowd.motion.position[b.walker]);
            const float off = length(called->to - here);
            const float speed = length(w.crowd.motion.velocity[b.walker]);
            // There, or as near as others let it.
            if ((off < k_there && speed < 0.3f) || (off < k_nearly && speed < 0.08f))
                return set_concern(w, b, Concern::offers, 6);
            if (w.tick >= b.until || (f->phase == FallPhase::rises && f->stage >= RiseStage::stand))
                part(w, b, 1);
            return;
        }
        case Concern::offers:
            if (!lies || !called || w.tick >= b.until) return part(w, b, 0.8f);
            if (f->phase == FallPhase::rises && f->stage == RiseStage::kneel) {
                set_concern(w, b, Concern::pulls, 6);
            } else if (f->phase == FallPhase::rises && f->stage > RiseStage::kneel) {
                part(w, b, 1);
            }
            return;
        case Concern::pulls:
            if (lies && called && w.tick < b.until) return;
            part(w, b, random_between({w.seed, b.walker, w.tick, Purpose::fall}, 0.8f, 1.6f, 9));
            return;
        default:
            return;
    }
}

bool stands_by(Concern does) { return does != Concern::glances; }

void come_nearer(float& value, float to, float most) { value += clamp(to - value, -most, most); }

// Whether all that it did is over.
bool is_over(const World& w, const Bystander& b) {
    return w.tick >= b.until && b.heed == 0 && b.reach == 0 && b.holds == 0 && b.bent == 0 &&
           b.leans_back == 0;
}

}  // namespace

bool is_by_itself(const World& w, uint32_t i) {
    return !is_down(w.crowd, i) && !is_led(w.crowd, i) && !is_creature(w.herd, i) &&
           !own_of(w.crowd.passages, i) && w.crowd.driven.walker != i && w.crowd.at_once[i / k_block] == 1 &&
           w.crowd.way_back[i].polygon == 0 && !own_of(w.falls.all, i);
}

void make_room_to_mind(World& w, size_t count) {
    w.bystanders.all.reserve(std::min<size_t>(w.crowd.capacity, count * 64));
    w.crowd.called.reserve(std::min<size_t>(w.crowd.capacity, count * 16));
}

bool is_awaited(const World& w, const Fall& f) {
    return f.awaits && k_up_within - seconds_of(w.tick - f.fell) > seconds_to_rise(f);
}

void mind_falls(World& w) {
    auto& all = w.bystanders.all;
    if (w.bystanders.helpers > 0) notice_creatures(w);
    if (w.falls.all.empty() && all.empty()) return;
    if (w.bystanders.helpers > 0) {
        for (const Fall& f : w.falls.all) {
            const bool notices = f.phase == FallPhase::falls && w.tick == f.began + ticks_of(k_notices);
            const bool lies_now = f.phase == FallPhase::lies && w.tick == f.began + 1;
            if (notices || lies_now) notice(w, f);
        }
    }
    for (size_t k = 0; k < all.size(); ++k) {
        Bystander& b = all[k];
        if (is_down(w.crowd, b.walker) || w.crowd.driven.walker == b.walker) {
            b.until = w.tick;
            if (b.does != Concern::glances) call_off(w.crowd, b.walker);
            b.does = Concern::glances;
            continue;
        }
        const Concern did = b.does;
        decide(w, b);
        if (w.tick >= b.until && stands_by(b.does)) {
            call_off(w.crowd, b.walker);
            b.does = Concern::glances;
        }
        if (did == Concern::pulls && b.does == Concern::parts && is_there(w.crowd, b.whom) &&
            !own_of(w.bystanders.all, b.whom) && !is_down(w.crowd, b.whom))
            thank(w, b.whom, all[k].walker);  // may move those behind it on, which are looked at twice then
    }
    constexpr float k_hand_out = 0.5f;  // seconds
    for (Fall& f : w.falls.all) f.awaits = 0;
    for (const Bystander& b : all) {
        const bool is_near = b.does == Concern::comes ||
                             (b.does == Concern::offers && w.tick < b.began + ticks_of(k_hand_out));
        if (Fall* f = is_near ? own_of(w.falls.all, b.whom) : nullptr) f->awaits = 1;
    }
    std::erase_if(all, [&](const Bystander& b) { return is_over(w, b) || !is_there(w.crowd, b.walker); });
}

void pose_bystanders(World& w) {
    constexpr float k_turns = 3.2f * k_tick, k_heeds = k_tick / 0.35f, k_bends = k_tick / 0.7f,
                    k_reaches = k_tick / 0.45f, k_draws_back = k_tick / 0.5f;
    constexpr float k_elbows = 0.16f;  // radians a tick
    for (Bystander& b : w.bystanders.all) {
        if (is_down(w.crowd, b.walker)) {
            b.heed = b.reach = b.holds = b.bent = b.leans_back = 0;
            b.has_hold = 0;
            continue;
        }
        const bool minds = w.tick < b.until && is_there(w.crowd, b.whom);
        const bool helps = minds && (b.does == Concern::offers || b.does == Concern::pulls);
        const Fall* f = own_of(w.falls.all, b.whom);
        const bool stands_up = f && f->phase == FallPhase::rises && f->stage == RiseStage::stand;
        const PersonBlock& person = person_of(w, b.walker);
        const int lane = lane_of(b.walker);
        const BodyPose other = body_pose_of(w.poses, b.whom);
        BodyPose pose = body_pose_of(w.poses, b.walker);

        // Down to one who lies, up with one who rises.
        const float rises = stands_up ? smoothstep(0, 0.8f, f->share) : 0;
        come_nearer(b.bent, helps ? 1 - rises : 0, k_bends);
        come_nearer(b.leans_back, helps && stands_up ? 0.12f * (1 - f->share) : 0, k_bends * 0.25f);
        const float low = w.crowd.motion.position[b.whom].y - w.crowd.motion.position[b.walker].y;
        const Stoop stoop = stoop_for(person, lane, person_of(w, b.whom), lane_of(b.whom), low);
        const float bent = smoothstep(0, 1, b.bent);
        w.gait.blocks[b.walker / k_block].crouch[lane] = bent * stoop.crouch;
        lean_trunk(pose, bent * stoop.lean - b.leans_back);

        const HeadTurn wanted =
            minds ? turn_to_look(pose, person, lane, place_to_look_at(w, b.whom)) : HeadTurn{};
        const bool looks = minds && (wanted.yaw != 0 || wanted.pitch != 0);
        come_nearer(b.gaze.yaw, wanted.yaw, k_turns), come_nearer(b.gaze.pitch, wanted.pitch, k_turns);
        come_nearer(b.heed, looks ? 1 : 0, k_heeds);
        turn_head(pose, b.gaze, smoothstep(0, 1, b.heed));

        const bool pulls = minds && b.does == Concern::pulls;
        come_nearer(b.reach, helps ? 1 : 0, helps ? k_reaches : k_draws_back);
        come_nearer(b.holds, pulls ? 1 : 0, pulls ? k_reaches : k_draws_back);
        b.has_hold = 0;
        if (b.reach > 0) {
            BodyPose held = other;
            const Hands hands{static_cast<Side>(b.hand), static_cast<Side>(b.side), smoothstep(0, 1, b.reach),
                              smoothstep(0, 1, b.holds)};
            const bool meet =
                take_hand(pose, person, lane, held, person_of(w, b.whom), lane_of(b.whom), hands);
            b.has_hold = meet && b.holds >= 1 && b.reach >= 1;
            // Whoever is set on its feet, or let go of, has had the elbow somewhere.
            keep_elbow(pose, body_pose_of(w.previous_poses, b.walker), person, lane, hands.own, k_elbows);
            if (b.holds > 0) {
                keep_elbow(held, body_pose_of(w.previous_poses, b.whom), person_of(w, b.whom),
                           lane_of(b.whom), hands.other, k_elbows);
                set_body_pose(w.poses, person_of(w, b.whom), b.whom, held);
            }
        }
        set_body_pose(w.poses, person, b.walker, pose);
    }
    for (Fall& f : w.falls.all) f.held = 0;
    for (const Bystander& b : w.bystanders.all)
        if (Fall* f = b.has_hold ? own_of(w.falls.all, b.whom) : nullptr) f->held |= 1u << b.side;
}

uint64_t hash_bystanders(const World& w) {
    uint64_t hash = w.bystanders.all.size();
    auto add = [&](const auto& value) { hash = hash_bytes(hash, &value, sizeof value); };
    for (const Bystander& b : w.bystanders.all) add(b);
    for (const Called& called : w.crowd.called) add(called);
    return hash;
}

void forget_bystander(World& w, uint32_t walker) { (void)take_away(w.bystanders.all, walker); }

}  // namespace flaneur
