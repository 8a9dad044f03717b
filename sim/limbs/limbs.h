// Limbs that follow four targets on curves, and a body that goes as far as the foot on the ground goes back:
// the walk of "The Walker Report" (A. Farmaki, KTH 2024), whose figures these are.
//
// Time is counted in units of the curves, which run forth in one and back in the next, and so for ever. It is
// the left leg's; the right one is a unit later.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "sim/base/math.h"

namespace flaneur {

// What leads limbs: steps that are planned on the ground (sim/gait), or these curves.
enum class LimbLead : uint8_t { gait, curves };
inline constexpr std::string_view k_limb_lead_names[] = {"gait", "curves"};

// Metres of these are of legs of k_curves_leg, and others' in proportion.
struct LimbCurves {
    float period = 1.5f;                       // seconds, forth and back
    float leg_forward = 0.3f, leg_up = 0.2f;   // metres, times what the curves say
    float arm_forward = 0.4f, arm_up = 0.01f;  // the same
    float turn_rate = 20, shortest_turn = 3;   // degrees a second that one turns, and seconds at least
    float ray_ahead = 4, ray_aside = 5;        // metres, of those who go by rays: see sim/ways/rays.h
    bool operator==(const LimbCurves&) const = default;
};
inline constexpr float k_curves_leg = 0.9f;                  // from the hip to the ground, metres
inline constexpr float k_leg_back = -1, k_leg_front = 0.5f;  // the ends of the legs' curve

// A curve's time in units, there and back again: 0..1.
inline float ping_pong(float time) {
    const float turn = time - 2 * std::floor(time * 0.5f);
    return turn < 1 ? turn : 2 - turn;
}
inline float eased(float share) { return share * share * (3 - 2 * share); }

// Evenly, so that a body goes evenly whose legs do.
inline float leg_ahead(float time) { return k_leg_back + (k_leg_front - k_leg_back) * ping_pong(time); }
// 0 but in the second half of the curve: a foot that comes down is on the ground when it begins to go back.
inline float leg_raised(float time) { return eased(std::max(2 * ping_pong(time) - 1, 0.0f)); }
inline float arm_ahead(float time) { return eased(ping_pong(time)); }
inline float arm_raised(float time) { return eased(ping_pong(time)); }

// Metres of one target ahead of where its limb rests, and above it.
struct LimbTarget {
    float ahead = 0, up = 0;
};
// Left, right. A foot is lifted half a unit from where it goes to and fro; arms go against legs.
struct LimbTargets {
    LimbTarget feet[2], hands[2];
};
inline LimbTargets targets_at(const LimbCurves& how, float time) {
    auto foot = [&](float ahead, float up) {
        return LimbTarget{leg_ahead(ahead) * how.leg_forward, leg_raised(up) * how.leg_up};
    };
    auto hand = [&](float ahead) {
        return LimbTarget{arm_ahead(ahead) * how.arm_forward, arm_raised(time) * how.arm_up};
    };
    return {{foot(time, time + 0.5f), foot(time - 1, time - 0.5f)}, {hand(time - 1), hand(time)}};
}

// Metres that a body with legs of `leg` goes in a unit, and metres a second at which it goes.
inline float metres_a_unit(const LimbCurves& how, float leg) {
    return (k_leg_front - k_leg_back) * how.leg_forward * leg / k_curves_leg;
}
inline float pace_of(const LimbCurves& how, float leg) { return metres_a_unit(how, leg) * 2 / how.period; }

// A turn that takes its time. About one upright axis a slerp is an angle that grows evenly.
struct SlowTurn {
    float from = 0, by = 0;         // radians
    float seconds = 0, passed = 0;  // it is over when these are equal
};
inline bool is_turning(const SlowTurn& turn) { return turn.passed < turn.seconds; }
inline SlowTurn begin_turn(const LimbCurves& how, float from, float degrees) {
    return {from, degrees * k_radians, std::max(std::fabs(degrees) / how.turn_rate, how.shortest_turn), 0};
}
// The heading so many seconds later, radians.
inline float turn_on(SlowTurn& turn, float seconds) {
    turn.passed = std::min(turn.passed + seconds, turn.seconds);
    return wrap_angle(turn.from + turn.by * (turn.seconds > 0 ? turn.passed / turn.seconds : 1));
}

}  // namespace flaneur
