#include "sim/company/talk.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_walks = 0.4f;  // m/s

RandomKey key_of(const Group& g, uint64_t seed) {
    return {seed, g.members[0].index, g.turn, Purpose::company};
}
uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }
float seconds_since(uint32_t then, uint32_t tick) { return static_cast<float>(tick - then) * k_tick; }

// To whom one who speaks, or says nothing, would look.
uint32_t addressee(const Group& g, uint32_t member) {
    return (member + 1 + g.turn % (g.count - 1)) % g.count;
}

// 0 at both ends of its time, 1 between.
float envelope(const Group& g, uint32_t tick, float eases) {
    const float passed = seconds_since(g.turn_began, tick), left = seconds_since(tick, g.turn_ends);
    return smoothstep(0, eases, passed) * smoothstep(0, eases, left);
}

// Eyes are averted while one comes up (Kendon & Ferber 1973); and one looks back once.
bool looks_at_who_is_met(const Group& g, float far, uint32_t tick) {
    const float since = seconds_since(g.stage_began, tick);
    if (g.stage == Encounter::comes) return far < 1.7f;
    if (g.stage == Encounter::parts) return since > 0.5f && since < 1.4f;
    return g.stage == Encounter::greets || since < 1.6f;
}

float bump(float since, float lasts) {
    return since < 0 || since > lasts ? 0 : 0.5f - 0.5f * sin_cos(2 * k_pi * since / lasts).cosine;
}

}  // namespace

void take_turns(Group& g, uint32_t tick, uint64_t seed) {
    constexpr float k_laughs = 0.1f, k_falls_silent = 0.15f, k_goes_on = 0.75f;  // of the turns
    if (tick < g.turn_ends || g.count < 2) return;
    if (g.does == Together::meets && g.stage != Encounter::talks) {
        g.speech = Speech::silence;
        g.turn_ends = tick + 1;
        return;
    }
    ++g.turn;
    g.turn_began = tick;
    const RandomKey key = key_of(g, seed);
    auto lasts = [&](float least, float most) {
        g.turn_ends = tick + ticks_of(random_between(key, least, most, 11));
    };
    const float drawn = random_unit(key, 10);
    const bool can = g.does != Together::parts && g.parted_since == k_never && g.expects == 0;
    const bool spoke = g.speech == Speech::speech;
    if (can && spoke && drawn < k_laughs) {
        g.speech = Speech::laughter;
        lasts(1.2f, 2.2f);
    } else if (can && (spoke ? drawn >= k_laughs + k_falls_silent : drawn < k_goes_on)) {
        const auto others = static_cast<float>(g.count - 1);
        g.speaker = (g.speaker + 1 + static_cast<uint32_t>(random_unit(key, 12) * others)) % g.count;
        g.speech = Speech::speech;
        lasts(2, 6);
    } else {
        g.speech = Speech::silence;
        lasts(2, 8);
    }
}

void look_at_each_other(Company& company, const Crowd& c, const Group& g, uint32_t tick, uint64_t seed) {
    constexpr float k_most_walking = 43 * k_radians, k_most_standing = 62 * k_radians, k_behind = 2.2f;
    if (g.count < 2) return;
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        Bearing& b = company.bearings[i];
        const bool walks = length(c.motion.velocity[i]) > k_walks;
        const bool listens = g.speech == Speech::speech && k != g.speaker;
        const uint32_t whom = g.members[listens ? g.speaker : addressee(g, k)].index;
        const Vec2 to = on_ground(c.motion.position[whom] - c.motion.position[i]);
        const float far = length(to), yaw = wrap_angle(heading_of(to) - c.motion.heading[i]);
        const bool sees = far < 4 && g.does != Together::parts && b.runs_until <= tick &&
                          !(walks && std::fabs(yaw) > k_behind);
        if (tick >= b.gaze_ends || (b.gazes != 0 && !sees)) {
            const RandomKey key{seed, i, tick, Purpose::company};
            b.gazes = b.gazes == 0 && sees ? 1 : 0;
            b.gaze_began = tick;
            const float away = g.speech == Speech::silence ? (walks ? 9.0f : 3.0f) : walks ? 2.8f : 0.9f;
            const float lasts = b.gazes == 0 ? random_between(key, 0.45f * away, 1.2f * away, 20)
                                : walks      ? random_between(key, 0.7f, 1.5f, 20)
                                             : random_between(key, 2.0f, 5.0f, 20);
            b.gaze_ends = tick + ticks_of(lasts);
        }
        const float most = walks ? k_most_walking : k_most_standing;
        b.gaze = b.gazes != 0 ? clamp(yaw, -most, most) : 0;
        b.whom = whom;
        if (g.does == Together::meets && g.stage != Encounter::talks) {
            b.gaze_began = b.gazes != 0 ? b.gaze_began : tick;
            b.gaze_ends = tick + k_decision_ticks;
            b.gazes = looks_at_who_is_met(g, far, tick) ? 1 : 0;
            b.gaze = clamp(yaw, -k_most_standing, k_most_standing);
            continue;
        }
    }
}

float nod_of(const Group& g, uint32_t member, uint32_t tick, uint64_t seed) {
    constexpr float k_lasts = 0.95f, k_deep = 0.13f, k_often = 0.75f;  // seconds; radians; of the turns
    constexpr float k_stress = 0.035f, k_back = 0.14f, k_shakes = 0.03f;
    const RandomKey key = key_of(g, seed);
    const float passed = seconds_since(g.turn_began, tick);
    if (g.does == Together::meets && g.stage != Encounter::talks) {
        constexpr float k_chin = 0.2f, k_bow = 0.24f;  // radians
        const float since = seconds_since(g.stage_began, tick);
        if (g.stage == Encounter::sees && !waves(g, member, seed)) return -k_chin * bump(since - 0.3f, 0.7f);
        return g.stage == Encounter::greets ? k_bow * bump(since - 0.1f, 0.8f) : 0;
    }
    if (g.speech == Speech::laughter) {
        const float shakes = sin_cos(2 * k_pi * 4.3f * passed + static_cast<float>(member)).sine;
        return (k_shakes * shakes - k_back) * envelope(g, tick, 0.35f);
    }
    if (g.speech != Speech::speech) return 0;
    if (member == g.speaker)
        return k_stress * envelope(g, tick, 0.3f) * sin_cos(2 * k_pi * 1.15f * passed).sine *
               sin_cos(2 * k_pi * 0.31f * passed).sine;
    if (random_unit(key, 30 + member) >= k_often) return 0;
    const float began = random_between(key, 0.7f, 2.4f, 40 + member), since = passed - began;
    const float left = seconds_since(tick, g.turn_ends);
    if (since < 0 || since > k_lasts || left < 0.05f) return 0;
    const float bobs = 0.5f - 0.5f * sin_cos(2 * k_pi * 2 * since / k_lasts).cosine;
    return k_deep * bobs * (1 - 0.4f * since / k_lasts) * smoothstep(0, 0.3f, left);
}

bool waves(const Group& g, uint32_t member, uint64_t seed) {
    // One of the two, nearly always; the other answers with the chin.
    const float drawn = random_unit({seed, g.members[0].index, g.stage_began, Purpose::company}, 90);
    return drawn < 0.25f ? false : drawn < 0.4f || (drawn < 0.7f) == (member == 0);
}

bool gestures(const Group& g, const Crowd& c, uint32_t member, Side side, uint32_t tick, uint64_t seed) {
    constexpr float k_after = 0.3f, k_before = 0.7f, k_waves = 1.9f;  // seconds
    constexpr float k_standing = 0.8f, k_walking = 0.35f, k_other = 0.4f, k_right_handed = 0.7f;
    if (g.does == Together::meets && g.stage == Encounter::sees)
        return side == k_right && waves(g, member, seed) && seconds_since(g.stage_began, tick) < k_waves;
    if (g.speech != Speech::speech || member != g.speaker) return false;
    if (seconds_since(g.turn_began, tick) < k_after || tick + ticks_of(k_before) > g.turn_ends) return false;
    const uint32_t i = g.members[member].index;
    const bool walks = length(c.motion.velocity[i]) > k_walks;
    const RandomKey key = key_of(g, seed);
    if (random_unit(key, 50) >= (walks ? k_walking : k_standing)) return false;
    const Side first = random_unit(key, 51) < k_right_handed ? k_right : k_left;
    return side == first || (!walks && random_unit(key, 52) < k_other);
}

Vec3 beat_of(const Group& g, Side side, float height, uint32_t tick, uint64_t seed) {
    const RandomKey key = key_of(g, seed);
    const uint32_t of = side == k_left ? 60 : 70;
    if (g.does == Together::meets && g.stage == Encounter::sees) {
        const float since = seconds_since(g.stage_began, tick);
        return Vec3{0.035f * sin_cos(2 * k_pi * 2 * since).sine, 0, 0} * height;
    }
    const float t = seconds_since(g.turn_began, tick);
    auto wave = [&](float hertz, uint32_t index) {
        return sin_cos(2 * k_pi * (hertz * t + random_unit(key, of + index))).sine;
    };
    const float quick = random_between(key, 0.8f, 1.3f, of + 5),
                large = random_between(key, 0.6f, 1.2f, of + 6);
    const float out = side == k_left ? 1.0f : -1.0f;
    // Beats: down with what is stressed, and slower to the sides (McNeill, "Hand and Mind", 1992).
    const Vec3 moved{out * (0.016f + 0.026f * wave(0.37f * quick, 0)),
                     0.02f * wave(quick, 1) + 0.016f * wave(2.1f * quick, 2), 0.02f * wave(0.6f * quick, 3)};
    return moved * (large * height);
}

}  // namespace flaneur
