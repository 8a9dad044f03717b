// Pushes: who bears them, and whom they are passed on to; and the balls that give them.
#include <algorithm>
#include <array>
#include <span>

#include "sim/balls.h"
#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/crowd/places.h"
#include "sim/falls.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

namespace {

// Of the old, less (Maki & McIlroy, "Control of rapid limb movements for balance recovery", Age and Ageing
// 35, 2006: from 60 on), and of those who reel; and everybody is a little other.
Sturdiness sturdiness_of(const World& w, uint32_t walker) {
    const CrowdIdentity& who = w.crowd.identity;
    const float age = w.kinds[who.body[walker]].age;
    const RandomKey key{w.seed, walker, w.crowd.slots.generation[walker], Purpose::fall};
    const float own = random_between(key, 0.9f, 1.1f);
    return {person_of(w, walker).joints[left_upper_leg][1][walker % k_block], w.crowd.motion.heading[walker],
            own * (1 - 0.4f * smoothstep(60, 85, age)) * (1 - 0.4f * drunk_of(w, walker))};
}

// Those whom one touches who is pushed `way`, and how squarely, 0..1.
constexpr size_t k_most_touched = 4;
struct Touched {
    uint32_t who[k_most_touched];
    float squarely[k_most_touched];
    size_t count = 0;
};
Touched touched_by(const World& w, uint32_t walker, Vec2 way) {
    constexpr float k_touches = 0.12f, k_ahead = 0.5f, k_level = 1;  // metres; a cosine
    const CrowdMotion& m = w.crowd.motion;
    Touched touched;
    std::array<uint32_t, 32> near;
    const float reach = w.crowd.identity.radius[walker] + w.crowd.widest + k_touches;
    const size_t count = those_near(w, m.position[walker], reach, near);
    for (const uint32_t i : std::span(near).first(count)) {
        const Vec3 off = m.position[i] - m.position[walker];
        const float far = length(on_ground(off));
        const float radii = w.crowd.identity.radius[i] + w.crowd.identity.radius[walker];
        if (i == walker || far > radii + k_touches || far < 1e-3f || std::fabs(off.y) > k_level) continue;
        const float squarely = dot(on_ground(off), way) / far;
        if (squarely < k_ahead || touched.count == k_most_touched) continue;
        if (own_of(w.crowd.passages, i) || w.crowd.identity.ahead[i] > 0 || is_down(w.crowd, i) ||
            is_creature(w.herd, i) || stays_put(w.crowd, i))
            continue;
        touched.who[touched.count] = i;
        touched.squarely[touched.count++] = squarely;
    }
    return touched;
}

void be_pushed(World& w, uint32_t walker, Vec2 change) {
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
        fall.falls_at = k_never;
        fall.began = w.tick;
        f = &*all.insert(take_away(all, walker), fall);
    }
    f->carried += change;
    const float carries = length(f->carried);
    f->to = normalize_or(f->carried, change / speed);
    const float times = carries / bearable_push(sturdiness_of(w, walker), f->to);
    const bool falls = times >= 1 && (!is_stepping(w, walker) || can_fall(w, walker));
    if (falls)
        f->falls_at = std::min(f->falls_at, w.tick + static_cast<uint32_t>(staggers_for(times) / k_tick));
    if (falls && f->falls_at <= w.tick) {
        f->gives += change;
        if (const float gives = length(f->gives); gives > k_most) f->gives = f->gives * (k_most / gives);
        return;
    }
    // Feet follow no more than that, or half of it faster than they go.
    constexpr float k_fastest_stagger = 1.6f, k_hastens = 0.5f;
    shove(f->sway, change);
    Vec2& velocity = w.crowd.motion.velocity[walker];
    const Vec2 before = velocity;
    velocity += change;
    const float goes = length(velocity),
                most = std::max(k_fastest_stagger, length(before) + k_hastens * speed);
    if (goes > most) velocity = velocity * (most / goes);
    if (is_stepping(w, walker)) shove(w, walker, velocity - before);
}

// Who is pushed against others keeps a part of it and gives them the rest, who do the same.
void push_on(World& w, uint32_t walker, Vec2 change, int others) {
    constexpr float k_gives = 0.5f, k_least = 0.05f;  // of what it has; m/s
    const float speed = length(change);
    if (others == 0 || speed < k_least) return be_pushed(w, walker, change);
    const Vec2 way = change / speed;
    const Touched touched = touched_by(w, walker, way);
    float whole = 0;
    for (size_t k = 0; k < touched.count; ++k) whole += touched.squarely[k];
    const float own = mass_of(person_of(w, walker), walker % k_block);
    be_pushed(w, walker, touched.count ? change * (1 - k_gives) : change);
    for (size_t k = 0; k < touched.count; ++k) {
        const uint32_t other = touched.who[k];
        const float mass = mass_of(person_of(w, other), other % k_block);
        push_on(w, other, change * (k_gives * touched.squarely[k] / whole * own / mass), others - 1);
    }
}

}  // namespace

size_t those_near(const World& w, Vec3 place, float reach, std::span<uint32_t> found) {
    size_t count = 0;
    auto take = [&](uint32_t i) {
        const Vec2 off = on_ground(w.crowd.motion.position[i] - place);
        if (length_squared(off) <= reach * reach && is_there(w.crowd, i) && count < found.size())
            found[count++] = i;
    };
    const CrowdScratch& s = w.crowd.scratch;
    if (s.is_ordered) {
        for_seen_near(s, place, reach, [&](uint32_t begin, uint32_t end) {
            for (uint32_t at = begin; at < end; ++at) take(s.order[at]);
        });
    } else {
        for (const WalkerId id : w.crowd.slots.living) take(id.index);
    }
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    // A small plane is wrapped so often that some are found twice.
    const auto end = std::unique(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<size_t>(end - found.begin());
}

void push_walker(World& w, uint32_t walker, Vec2 change) {
    constexpr int k_in_a_row = 4;
    if (stays_put(w.crowd, walker)) return;
    push_on(w, walker, change, k_in_a_row);
}

namespace {

// Where somebody is hit, from there to the ball, and how deep it is in.
struct Touch {
    Vec3 at{}, normal{};
    float deep = 0;
};
Touch touch_of(const World& w, const Ball& ball, uint32_t walker) {
    const PersonBlock& person = person_of(w, walker);
    const int lane = static_cast<int>(walker % k_block);
    const Segments segments = segments_of(person, lane);
    const auto parts = balls_of(body_pose_of(w.poses, walker), segments, person, lane);
    Touch deepest;
    for (size_t k = 0; k < parts.size(); ++k) {
        const Vec3 off = ball.place - parts[k];
        const float far = length(off), deep = segments.radius[k] + ball.radius - far;
        if (deep <= deepest.deep) continue;
        const Vec3 normal = normalize_or(off, {0, 1, 0});
        deepest = {parts[k] + normal * segments.radius[k], normal, deep};
    }
    return deepest;
}

void hit_people(World& w, Ball& ball) {
    constexpr float k_reach = 1.3f;                // metres, of a body about its root
    constexpr float k_moves = 0.6f;                // of a body, what a hit moves at once
    constexpr float k_high = 0.62f, k_low = 0.2f;  // of the height: hit there all of it counts; of that
    constexpr float k_least = 0.5f;                // newton seconds
    std::array<uint32_t, 64> near;
    const size_t count = those_near(w, ball.place, k_reach + ball.radius, near);
    for (const uint32_t i : std::span(near).first(count)) {
        if (is_creature(w.herd, i)) continue;
        const Touch touch = touch_of(w, ball, i);
        if (touch.deep <= 0) continue;
        const PersonBlock& person = person_of(w, i);
        const size_t lane = i % k_block;
        const CrowdMotion& m = w.crowd.motion;
        ball.place += touch.normal * touch.deep;
        const float gives =
            hit(ball, touch.normal, at_height(m.velocity[i], 0), k_moves * mass_of(person, lane));
        if (gives < k_least) continue;
        const float high = (touch.at.y - m.position[i].y) / (k_high * person.height[lane]);
        const Vec2 impulse = on_ground(touch.normal) * (-gives * clamp(high, k_low, 1));
        (void)push(w, {i, w.crowd.slots.generation[i]}, impulse);
    }
}

}  // namespace

void make_room_for_balls(World& w) {
    w.balls.all.reserve(k_most_balls);
    w.balls.previous_places.reserve(k_most_balls);
    make_room_to_fall(w, w.crowd.capacity);
}

void throw_ball(World& w, const Ball& ball) {
    make_room_for_balls(w);
    Balls& b = w.balls;
    if (b.all.size() == k_most_balls) {
        b.all.erase(b.all.begin());
        b.previous_places.erase(b.previous_places.begin());
    }
    b.all.push_back(ball);
    b.previous_places.push_back(ball.place);
}

void step_balls(World& w) {
    for (const PlannedThrow& planned : w.balls.planned)
        if (planned.tick == w.tick) throw_ball(w, thrown(planned));
    std::vector<Ball>& all = w.balls.all;
    for (size_t i = 0; i < all.size(); ++i) w.balls.previous_places[i] = all[i].place;
    step_balls(all, *w.ground, w.around, k_tick);
    for (Ball& ball : all) hit_people(w, ball);
    constexpr float k_gone = 100;  // metres below all ground
    for (size_t i = all.size(); i-- > 0;) {
        if (all[i].place.y > -k_gone) continue;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        w.balls.previous_places.erase(w.balls.previous_places.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

uint64_t hash_balls(const Balls& balls) {
    static_assert(sizeof(Ball) == 12 * sizeof(float));
    return hash_bytes(balls.all.size(), balls.all.data(), balls.all.size() * sizeof(Ball));
}

}  // namespace flaneur
