// Leaps from body to body: one stops, crouches, pushes off along a way that has been found beforehand to end
// on its feet, is then moved by the bodies' pull alone, turns as it goes until its feet are towards the body
// where it will land, and takes up the landing in its knees. As bodies stand still, where and when it lands
// is known as it leaves.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/surface/gravity.h"

namespace flaneur {

enum class LeapStage : uint32_t { none, gathers, crouches, flies, absorbs };

inline constexpr float k_crouch_seconds = 0.42f, k_absorb_seconds = 0.6f;
inline constexpr float k_gather_seconds = 3;     // until it is given up
inline constexpr float k_longest_flight = 4;     // seconds
inline constexpr float k_fastest_landing = 5;    // m/s
inline constexpr float k_flight_turn = 3.5f;     // radians a second, that up turns in flight at most, and
inline constexpr float k_flight_turn_gain = 14;  // how that changes, radians a second each second

struct Leap {
    LeapStage stage = LeapStage::none;
    uint32_t is_asked = 0;  // 1: by hand, and be it back onto the same body
    float seconds = 0;      // since its stage began
    float lasts = 0;        // seconds of flight
    Vec3 velocity;          // of the body's middle, m/s, as it leaves and then as it flies
    float turn = 0;         // radians a second that up turns
    float landing = 0;      // m/s, towards the ground, with which it lands
    Vec3 place, normal;     // where that is, and out of the ground there
    uint32_t to = 0;        // the body towards which its feet turn
};

// One in the air. Its middle is `middle` metres above its feet.
struct Flyer {
    Vec3 position, up, ahead;  // feet; unit vectors square to each other
    float middle = 1;
};

// One tick of `dt` seconds in the air, and whether its feet have met ground in it: then it stands there, and
// leap.place, normal and landing say where and how.
bool fly_on(const Compound& compound, const Gravity& gravity, Flyer& flyer, Leap& leap, float dt);

// How far above its feet a body is looked for, metres.
inline constexpr float k_leap_reach = 9;

// The leap of one who stands there that lands it on its feet, as soon and with as little speed as may be: on
// another body, or `to_own` on its own. Its middle and head meet nothing on the way. is_free(flyer, tick) is
// asked tick after tick in flight, and once more as it has landed, and gives up that leap by false.
template <class IsFree>
std::optional<Leap> plan_leap(const Compound& compound, const Gravity& gravity, const Flyer& stands,
                              bool to_own, float dt, const IsFree& is_free);

// What stands `reach` metres or less above somebody's head and is another body.
std::optional<SurfaceHit> body_overhead(const Compound& compound, const Gravity& gravity,
                                        const Flyer& stands);

// Metres that the pelvis sinks in this stage, of one whose legs are so long: at the end of the crouch it
// rises, and at the beginning of the landing it sinks, as fast as the body flies.
float leap_crouch(const Leap& leap, float leg);

// The speeds, m/s, and the ways that are tried.
inline constexpr float k_leap_speeds[] = {1.4f, 1.8f, 2.2f, 2.6f, 3, 3.4f, 3.8f, 4.2f, 4.6f};
inline constexpr float k_speed_cost = 1;  // seconds in the air that are worth a metre a second
inline constexpr float k_hop_speed = 2.4f;
// Whether one has landed on its feet, softly enough, and on the body where it was to.
bool is_good_landing(const Gravity& gravity, const Flyer& flyer, const Leap& leap);
// Whether nothing is in the way of somebody's middle and head from one tick to the next.
bool is_clear_between(const Compound& compound, const Flyer& before, const Flyer& after);

template <class IsFree>
std::optional<Leap> plan_leap(const Compound& c, const Gravity& g, const Flyer& stands, bool to_own, float dt,
                              const IsFree& is_free) {
    const uint32_t own = pull_at(g, stands.position).body;
    const auto over = to_own ? std::nullopt : body_overhead(c, g, stands);
    if (!over && !to_own) return std::nullopt;
    const auto ticks = static_cast<int>(k_longest_flight / dt);
    auto attempt = [&](Vec3 way, float speed) -> std::optional<Leap> {
        Flyer f = stands;
        Leap leap;
        leap.velocity = way * speed;
        leap.to = to_own ? own : pull_at(g, over->point).body;
        for (int t = 1; t <= ticks; ++t) {
            const Flyer before = f;
            const bool has_landed = fly_on(c, g, f, leap, dt);
            if (!is_free(f, t)) return std::nullopt;
            if (has_landed) {
                if (!is_good_landing(g, f, leap)) return std::nullopt;
                leap.lasts = static_cast<float>(t) * dt;
                leap.velocity = way * speed;
                leap.turn = 0;
                return leap;
            }
            if (!is_clear_between(c, before, f)) return std::nullopt;
        }
        return std::nullopt;
    };
    if (to_own) return attempt(stands.up, k_hop_speed);
    std::optional<Leap> best;
    float least = 1e9f;
    for (const float speed : k_leap_speeds) {
        if (k_speed_cost * speed > least) break;
        for (const Vec3 way : {normalize_or(stands.up - over->normal, stands.up), stands.up}) {
            auto leap = attempt(way, speed);
            if (!leap || leap->lasts + k_speed_cost * speed > least) continue;
            least = leap->lasts + k_speed_cost * speed;
            best = leap;
        }
    }
    return best;
}

}  // namespace flaneur
