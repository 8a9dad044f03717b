#include "sim/balls.h"

#include <algorithm>
#include <array>
#include <span>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/falls.h"
#include "sim/sim.h"
#include "sim/world.h"

namespace flaneur {

namespace {

// Where somebody is hit, from there to the ball, and how deep it is in.
struct Touch {
    Vec3 at{}, normal{};
    float deep = 0;
};
Touch touch_of(const World& w, const Ball& ball, uint32_t walker) {
    const PersonBlock& person = w.gait.people[walker / k_block];
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
        const PersonBlock& person = w.gait.people[i / k_block];
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
