// Numbers of the walk, the run, steps and hands that no table gives: fitted so that the joints of the result
// move as in the norms (see norms.h) and no joint jumps, at 0.6 to 1.5 m/s. `flaneur gait` measures what
// becomes of them.
#pragma once

namespace flaneur {

// The swing of a foot from one place to the next, u = 0 at toe-off .. 1 at contact, r = 1 - u, h = 16 u^2
// r^2. Its progress is 3u^2 - 2u^3 - progress_late u^6 r^2 - progress_hop h; its lowest point, found among
// heel, ball and tip with corners rounded over soft h metres, stays clear_early u^2 r^5 + clear h metres
// above the ground; its toes hang droop h radians lower than in the norm and have a share of its pitch, so
// that they stay bent up.
inline constexpr float k_progress_late = 4.437f, k_progress_hop = -0.03416f;
inline constexpr float k_clear_early = 1.001f, k_clear = 0.004182f;
inline constexpr float k_soft = 0.02199f, k_droop = -0.09998f, k_toes = 0.4717f;

// The foot in stance: share of the norm's pitch at heel strike, phases in which the heel comes off, radians
// by which it rises further before toe-off; pitch of a foot that lands on its ball.
inline constexpr float k_heel_strike = 0.7497f, k_heel_off_0 = 0.3019f, k_heel_off_1 = 0.339f;
inline constexpr float k_heel_rise = 0.04983f, k_forefoot_pitch = -0.25f;

// Radians by which the heel rises while the body comes down to the other foot, whole from the second drop on,
// metres.
inline constexpr float k_tiptoe = 0.35f, k_drop_0 = 0.08f, k_drop_1 = 0.15f;

// Height of the pelvis: radians that the standing knee bends more than in the norm; the straightest leg, as a
// share of its length, rounded over so many metres; metres that a leg may fall short as it leaves, and before
// `landing`, a share of the swing, and by which a foot in mid-swing gives way.
inline constexpr float k_knee_more = -0.005341f, k_straightest = 0.9978f, k_straight = 0.001f;
inline constexpr float k_leaving_slack = 0.03f, k_landing = 0.5942f, k_landing_slack = 0.1f, k_give = 0.03f;

// Share of a foot's time on the ground before the hip passes it.
inline constexpr float k_lead = 0.3987f;

// Share of double support in which the body goes over to the foot that has landed.
inline constexpr float k_shift_width = 0.9136f;

// Pelvis: sway to each side and rise over the standing leg, metres, at a natural speed, and what a longer
// share of stance (a slower walk) adds to them: 70 mm from side to side at 0.7 m/s .. 39 at 1.6, 27 mm up and
// down .. 48 (Orendurff et al. 2004). The rise goes with high_cosine cos 2a + high_sine sin 2a, a = 2 pi
// phase; likewise its way ahead of an even speed, metres.
inline constexpr float k_sway = 0.0257f, k_sway_slow = 0.287f;
inline constexpr float k_bob = 0.00151f, k_bob_slow = 0.2039f;
inline constexpr float k_high_cosine = -0.9725f, k_high_sine = -1.478f;
inline constexpr float k_surge_cosine = 0.01078f, k_surge_sine = -0.002614f;

// Arms swing twice a stride where feet stand longer than at a natural speed by these shares of the cycle
// (0.75 m/s).
inline constexpr float k_arms_twice_0 = 0.028f, k_arms_twice_1 = 0.036f;

// A swing to another level has climbed by a share of its time that grows by the metres climbed, and waits
// before it goes on; the other way round down, where it waits only where the way is steep (times its slope
// squared) and otherwise comes down in a last share, falls. From these heights on (metres) it is one.
inline constexpr float k_step_climbs = 0.32f, k_step_wait = 0.22f, k_step_waits = 20, k_step_falls = 0.25f;
inline constexpr float k_step_0 = 0.03f, k_step_1 = 0.09f;

// A run at 3.1 m/s: knee 94 degrees in the swing, elbow 106. Radians by which its heel rises further before
// toe-off. Its swing: metres by which the heel rises, metres and shares of the way that the foot takes along
// from its push and brings down into the landing. Cosine of the knee at the mean height of the hips; half the
// way that they bounce.
inline constexpr float k_heel_kick = 3.5f, k_run_heel = 0.32f;
inline constexpr float k_run_rise = 0.44f, k_run_fall = 0.3f, k_run_progress = 0.25f;
inline constexpr float k_run_knee_cosine = 0.64f, k_bounce = 0.027f;
inline constexpr float k_run_elbow = 1.85f, k_run_lean = 0.12f;

// A hand on a wall: how far its fingers lean ahead (half of 1.1 rad), and from the wrist's axis to the palm,
// metres.
inline constexpr float k_finger_tilt_sine = 0.5227f, k_finger_tilt_cosine = 0.8525f;
inline constexpr float k_palm_thickness = 0.02f;

}  // namespace flaneur
