#include "sim/gait/hands.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_mood = 0.7f;                         // share of the time that who touches walls does
constexpr uint32_t k_mood_ticks = 480;                 // how long a mood lasts
constexpr uint32_t k_ask_ticks = 8;                    // an idle hand looks for a wall every so many ticks
constexpr float k_start_speed = 1.4f;                  // m/s; a faster walker does not begin to touch,
constexpr float k_hold_speed = 1.6f;                   // nor goes on
constexpr float k_catch_up = 0.6f;                     // m/s that the palm moves over its walker
constexpr float k_lift_off = 0.1f;                     // m/s away from the wall after letting go
constexpr float k_straight = 0.92f, k_onward = 0.38f;  // of an arm's length; of its reach, ahead
constexpr float k_below_coping = 0.06f;  // of the palm on a wall lower than where it would rest, metres

// What an arm needs to know of its walker.
struct ReachingArm {
    Vec3 shoulder;
    Vec2 ahead, outward;  // of the body, unit; outward is to this arm's side
    float length;         // from shoulder to wrist
    float beside;         // of the shoulder, from the body's middle
    float low, wanted;    // heights that the palm may have, and that it would like
    float speed;
};

ReachingArm arm_of(const GaitBlock& g, const PersonBlock& person, int lane, Side side, Vec3 root,
                   float heading, float speed, float style) {
    int joint = side == k_left ? left_upper_arm : right_upper_arm;
    auto place = [&](int j) {
        return Vec3{person.joints[j][0][lane], person.joints[j][1][lane], person.joints[j][2][lane]};
    };
    Vec3 shoulder = place(joint), elbow = place(joint + 1), wrist = place(joint + 2);
    Vec2 ahead = heading_direction(heading), left{ahead.z, -ahead.x};
    float base = g.base[lane];
    // Of the shoulder's height: trails low, rests high.
    float height = lerp(0.86f, 0.78f, g.amplitude[lane]) + 0.06f * (style - 0.5f);
    return {at_height(on_ground(root) + left * shoulder.x + ahead * shoulder.z, base + shoulder.y),
            ahead,
            side == k_left ? left : -left,
            length(elbow - shoulder) + length(wrist - elbow),
            std::fabs(shoulder.x),
            base + 0.5f * shoulder.y,
            base + height * shoulder.y,
            speed};
}

// The side on which a wall is so near that the arm might touch it.
std::optional<Side> side_of_wall(const Surroundings& around, const ReachingArm& left) {
    Vec2 inward = left.outward * -left.beside;
    auto wall = closest_wall(around, at_height(on_ground(left.shoulder) + inward, left.wanted),
                             left.length + left.beside);
    if (!wall) return std::nullopt;
    return dot(on_ground(wall->normal), left.outward) < 0 ? k_left : k_right;
}

struct Touch {
    Vec3 palm;
    Vec2 normal;
};

// Where this arm would touch a wall now. One that is `held` already may be a little farther and more oblique.
std::optional<Touch> find_touch(const Surroundings& around, const ReachingArm& arm, bool held) {
    Vec3 wanted = at_height(on_ground(arm.shoulder) + arm.ahead * (0.12f + 0.06f * arm.speed), arm.wanted);
    auto wall = closest_wall(around, wanted, arm.length);
    if (!wall) return std::nullopt;
    Touch touch{wall->point, on_ground(wall->normal)};
    if (touch.palm.y < arm.wanted - 1e-3f) touch.palm.y -= k_below_coping;
    if (touch.palm.y > arm.wanted + 0.05f || touch.palm.y < arm.low) return std::nullopt;
    float gap = dot(on_ground(arm.shoulder - touch.palm), touch.normal);
    float distance = length(touch.palm - arm.shoulder);
    if (gap < 0.04f || distance > (held ? 1.0f : 0.93f) * arm.length) return std::nullopt;
    // An arm straight at the wall would bend the wrist farther than it goes.
    if (gap > (held ? 0.85f : 0.8f) * distance) return std::nullopt;
    // Beside the body, and neither behind it nor where the wall has already ended.
    float along = dot(on_ground(touch.palm - arm.shoulder), arm.ahead);
    bool beside = -dot(touch.normal, arm.outward) > (held ? 0.5f : 0.7f);
    // Nor does the wrist of an arm that is nearly straight bend from there to fingers that point ahead.
    const bool bends = distance > k_straight * arm.length && along < k_onward * distance;
    return beside && !bends && along > 0 && along < 0.5f ? std::optional(touch) : std::nullopt;
}

Vec3 get_palm(const HandBlock& h, int lane) { return {h.x[lane], h.y[lane], h.z[lane]}; }
void set_palm(HandBlock& h, int lane, Vec3 p) {
    h.x[lane] = p.x;
    h.y[lane] = p.y;
    h.z[lane] = p.z;
}

void touch_wall(HandBlock& hand, int lane, const Touch& touch, float speed, float dt) {
    if (hand.reach[lane] == 0) {
        set_palm(hand, lane, touch.palm);
        hand.normal_x[lane] = touch.normal.x;
        hand.normal_z[lane] = touch.normal.z;
        return;
    }
    Vec3 palm = get_palm(hand, lane), missing = touch.palm - palm;
    float distance = length(missing), most = (speed + k_catch_up) * dt;
    set_palm(hand, lane, distance > most ? palm + missing * (most / distance) : touch.palm);
    Vec2 normal{hand.normal_x[lane], hand.normal_z[lane]};
    normal = normalize_or(lerp(normal, touch.normal, std::min(1.0f, 10 * dt)), touch.normal);
    hand.normal_x[lane] = normal.x;
    hand.normal_z[lane] = normal.z;
}

void let_go(HandBlock& hand, int lane, Vec2 velocity, float dt) {
    Vec2 normal{hand.normal_x[lane], hand.normal_z[lane]};
    Vec2 course = velocity + normal * (k_lift_off - std::min(0.0f, dot(velocity, normal)));
    set_palm(hand, lane, get_palm(hand, lane) + at_height(course * dt, 0));
}

// Slowly at both ends, fastest half way.
void move_reach(float& reach, bool touches, float dt) {
    float step = 2.2f * (0.25f + 3 * reach * (1 - reach)) * dt;
    reach = clamp(touches ? reach + step : reach - step, 0, 1);
}

}  // namespace

void reach_for_walls(Gait& gait, size_t begin, size_t end, const RootMotion& root, const Surroundings& around,
                     uint64_t seed, uint32_t tick, float dt) {
    for (size_t i = begin; i < end; ++i) {
        auto walker = static_cast<uint32_t>(i);
        const float style = random_unit({seed, walker, 0, Purpose::touch}),
                    touches = gait.people[i / k_block].touches[i % k_block];
        if (style >= touches) continue;
        GaitBlock& g = gait.blocks[i / k_block];
        int lane = static_cast<int>(i % k_block);
        bool busy = g.hands[k_left].reach[lane] > 0 || g.hands[k_right].reach[lane] > 0;
        if (!busy && tick % k_ask_ticks != walker % k_ask_ticks) continue;
        uint32_t mood = 1 + (tick + walker * 97) / k_mood_ticks;
        float speed = length(root.velocity[i]);
        bool willing = random_unit({seed, walker, mood, Purpose::touch}) < k_mood * std::max(touches, 1.0f) &&
                       speed < (busy ? k_hold_speed : k_start_speed) && g.running[lane] == 0;
        if (!busy && !willing) continue;

        auto arm = [&](Side side) {
            return arm_of(g, gait.people[i / k_block], lane, side, root.position[i], root.heading[i], speed,
                          style / touches);
        };
        Side side = g.hands[k_right].reach[lane] > 0 ? k_right : k_left;
        if (!busy) {
            auto nearer = side_of_wall(around, arm(k_left));
            if (!nearer) continue;
            side = *nearer;
            Span canes = canes_of(gait, i, i + 1);
            Span prams = prams_of(gait, i, i + 1);
            if ((side == k_right && canes.begin < canes.end) || prams.begin < prams.end) continue;
            if (g.holds[side].share[lane] > 0) continue;
        }
        HandBlock& hand = g.hands[side];
        std::optional<Touch> touch;
        if (willing) touch = find_touch(around, arm(side), busy);
        // Another wall, round a corner say: the hand leaves this one first.
        Vec2 normal{hand.normal_x[lane], hand.normal_z[lane]};
        if (busy && touch && dot(touch->normal, normal) < 0.9f) touch.reset();
        if (touch) {
            touch_wall(hand, lane, *touch, speed, dt);
        } else if (busy) {
            let_go(hand, lane, root.velocity[i], dt);
        }
        move_reach(hand.reach[lane], touch.has_value(), dt);
    }
}

}  // namespace flaneur
