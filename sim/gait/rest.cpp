#include "sim/gait/rest.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_breaths = 0.25f;       // a second, of grown people; the small are quicker
static constexpr float k_grown_leg = 0.94f;     // metres
static constexpr float k_breaths_to_shift = 7;  // from leg to leg
static constexpr float k_least_shift = 0.12f, k_most_shift = 0.33f;  // of the body

// Quiet standing goes to and fro by some ten millimetres, mostly slower than one breathes (Winter 1995): sums
// of two slow waves, whole ones in a round. Radians of the body over its ankles.
static constexpr float k_ahead = 0.0065f, k_aside = 0.004f;

// Who is slower, and wishes to stand, chooses where the feet will. Shares of the body's height.
static constexpr float k_comes_to_stand = 0.7f;  // m/s
static constexpr float k_turns = 0.8f;           // rad/s; who turns on the spot gathers the feet
static constexpr float k_narrowest = 0.08f, k_widest = 0.16f, k_farthest_apart = 0.064f;
static constexpr float k_leads = 0.02f;                 // metres ahead, of the last step, that are kept
static constexpr float k_most_lead = 0.026f;            // and at most, of the height
static constexpr float k_most_turned = 20 * k_radians;  // outward
static constexpr float k_rests = 0.35f;                 // of the body, at most, on a leg that rests

// A wave that goes `times` through a round.
static float wave(float breath, float times, float from) {
    float cycles = breath * (times / k_breath_round) + from;
    return sin_cos(2 * k_pi * (cycles - std::floor(cycles))).sine;
}

void advance_rest(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    float& breath = g.breath[lane];
    breath += k_breaths * std::sqrt(k_grown_leg / s.leg_length) * s.dt;
    if (breath >= k_breath_round) breath -= k_breath_round;
    const float reel = s.person.reel[lane];
    if (g.amplitude[lane] >= 1 && reel == 0) return;  // nobody sees it in a walk
    g.inhaled[lane] = wave(breath, k_breath_round, 0);
    g.tilt_ahead[lane] = k_ahead * (0.6f * wave(breath, 37, 0) + 0.4f * wave(breath, 83, 0.2f));
    g.tilt_aside[lane] = k_aside * (0.6f * wave(breath, 29, 0.4f) + 0.4f * wave(breath, 61, 0.1f));
    if (reel == 0) return;
    g.tilt_ahead[lane] += reel * (0.6f * wave(breath, 71, 0.3f) + 0.4f * wave(breath, 139, 0.7f));
    g.tilt_aside[lane] += reel * (0.6f * wave(breath, 83, 0) + 0.4f * wave(breath, 151, 0.5f));
}

float resting_load(const GaitBlock& g, int lane, RandomKey chance) {
    const auto turn = static_cast<uint32_t>(g.breath[lane] / k_breaths_to_shift);
    chance.when = 0;
    const bool left = random_unit(chance, 3) < 0.5f;
    chance.when = turn;
    const float shift = random_between(chance, k_least_shift, k_most_shift, 2);
    return left == (turn % 2 == 0) ? 0.5f - shift : 0.5f + shift;
}

namespace {

// Metres from one foot to the other, along the heading.
float draw_ahead(const Stepper& s) {
    float ahead = s.person.stance_ahead[s.lane] * random_between(s.chance, 0.4f, 1.6f, 100);
    return std::min(ahead, k_farthest_apart * s.person.height[s.lane]);
}

// Metres along the heading, by which a foot that stands is ahead of where one who slows down will stand.
float stands_ahead(const GaitBlock& g, const Stepper& s, Side side) {
    const FootBlock& foot = g.feet[side];
    if (foot.swinging[s.lane]) return 0;
    return dot(Vec2{foot.to.x[s.lane], foot.to.z[s.lane]} - on_ground(s.root) - stopping_way(s), s.facing);
}

void place_foot(GaitBlock& g, const Stepper& s, Side side, bool rests, float ahead) {
    const uint32_t draw = 110 + 10 * static_cast<uint32_t>(side);
    const PersonBlock& p = s.person;
    float height = p.height[s.lane],
          width = p.stance_width[s.lane] * random_between(s.chance, 0.85f, 1.2f, draw);
    float turn =
        rests ? random_between(s.chance, 0.5f, 1.5f, draw + 1) : random_between(s.chance, 0, 0.3f, draw + 1);
    FootBlock& foot = g.feet[side];
    foot.stance_ahead[s.lane] = ahead;
    width = std::max(clamp(width, k_narrowest * height, k_widest * height), p.step_width[s.lane]);
    foot.stance_out[s.lane] = 0.5f * (width - p.step_width[s.lane]);
    foot.stance_turn[s.lane] =
        clamp(turn * p.stance_turn[s.lane], 0, std::max(k_most_turned - p.toe_out[s.lane], 0.0f));
}

}  // namespace

void advance_stance(GaitBlock& g, const Stepper& s, RandomKey chance) {
    int lane = s.lane;
    int32_t& relaxed = g.relaxed[lane];
    bool goes = wishes_to_go(s) || length_squared(s.velocity) > k_comes_to_stand * k_comes_to_stand ||
                std::fabs(s.turn_rate) > k_turns || g.jump[lane] > 0;
    if (goes) {
        if (relaxed < 0) return;
        relaxed = g.restless[lane] = -1;
        for (FootBlock& foot : g.feet)
            foot.stance_ahead[lane] = foot.stance_out[lane] = foot.stance_turn[lane] = 0;
        return;
    }
    // Until the other leg is free, nothing is to be decided.
    const int32_t lighter = g.load[lane] > 0.5f ? k_right : k_left;
    const float carried = std::min(g.load[lane], 1 - g.load[lane]);
    if (relaxed >= 0 && (relaxed == lighter || !g.standing[lane] || carried > k_rests)) return;
    const Side rests = resting_load(g, lane, chance) > 0.5f ? k_right : k_left,
               stands = rests == k_left ? k_right : k_left;
    if (relaxed == rests) return;
    if (relaxed < 0) {
        float ahead = draw_ahead(s) * (random_unit(s.chance, 101) < 0.75f ? 0.5f : -0.5f);
        // A foot in the air that comes from a walk is set down ahead of the other one.
        if (length_squared(s.velocity) > k_goes * k_goes &&
            g.feet[rests].swinging[lane] != g.feet[stands].swinging[lane])
            ahead = g.feet[rests].swinging[lane] ? std::fabs(ahead) : -std::fabs(ahead);
        // The foot of the last step stays where it is, if it may.
        for (Side side : {stands, rests})
            if (float lead = stands_ahead(g, s, side); lead > k_leads && !g.standing[lane])
                ahead = std::min(lead, k_most_lead * s.person.height[lane]) * (side == rests ? 1.0f : -1.0f);
        place_foot(g, s, stands, false, -ahead);
        place_foot(g, s, rests, true, ahead);
    } else {
        // The leg that rested carries from now on, where it is; the other one moves.
        float other = g.feet[stands].stance_ahead[lane], ahead = draw_ahead(s);
        place_foot(g, s, rests, true, other > 0 ? other - ahead : other + ahead);
        g.restless[lane] = rests;
    }
    relaxed = rests;
}

}  // namespace flaneur
