// Numbers of the walk, the run, steps and hands that no table gives: fitted so that the joints of the result
// move as in the norms (see norms.h) and no joint jumps, at 0.6 to 1.5 m/s. `flaneur gait` measures what
// becomes of them.
#pragma once

namespace flaneur {

// The swing of a foot from one place to the next, u = 0 at toe-off .. 1 at contact, r = 1 - u, h = 16 u^2
// r^2. Its progress is 3u^2 - 2u^3 - progress_late u^6 r^2 - progress_hop h; its lowest point, found among
// heel, ball and tip with corners rounded over soft h metres, stays clear_early u^2 r^5 + clear h +
// clear_late u^3 r metres above the ground; its toes hang droop h radians lower than in the norm and have a
// share of its pitch, so that they stay bent up.
inline constexpr float k_progress_late = 3.22f, k_progress_hop = -0.0318f;
inline constexpr float k_clear_early = 1.46f, k_clear = 0.001033f, k_clear_late = 0.03f;
inline constexpr float k_pitch_pace = 0.04627f, k_clear_pace = 1.219f;
inline constexpr float k_soft = 0.01195f, k_droop = -0.101f, k_toes = 0.4717f;

// The foot in stance: share of the norm's pitch at heel strike, phases in which the heel comes off, radians
// by which it rises further before toe-off, and by which it pushes off more for each pace over the natural
// one; pitch of a foot that lands on its ball.
inline constexpr float k_heel_strike = 0.8393f, k_heel_off_0 = 0.05908f, k_heel_off_1 = 0.5633f;
inline constexpr float k_heel_rise = 0.1200f, k_push_pace = 0.3158f, k_forefoot_pitch = -0.25f;

// Radians by which the heel rises while the body comes down to the other foot, whole from the second drop on,
// metres.
inline constexpr float k_tiptoe = 0.66f, k_tiptoe_soft = 0.15f, k_drop_0 = 0.08f, k_drop_1 = 0.15f;

// Height of the pelvis, see rise-inl.h: speed over sqrt(g leg) at a natural speed, harmonics there and by how
// much they grow with the pace, the mean below upright; of one who stands.
inline constexpr float k_natural_pace = 0.43f, k_fastest_over = 0.27f, k_slowest_over = -0.07f;
inline constexpr float k_rise_c2 = -0.01225f, k_rise_c2_pace = -0.03913f, k_rise_s2 = -0.008584f,
                       k_rise_s2_pace = 0.01997f;
inline constexpr float k_rise_c4 = 0.0006924f, k_rise_s4 = -0.0004007f, k_rise_c6 = -0.001759f,
                       k_rise_s6 = -0.000178f;
inline constexpr float k_sink = -0.0008523f, k_sink_step = 0.04754f, k_stand = 0.001f, k_steepest = 0.12f;
inline constexpr float k_uphill = 12.28f, k_downstep = 0.1f, k_spare_slow = 0.07006f;
// The pelvis comes down for a landing once that asks for some such acceleration, m/s2, and goes up again at
// this rate, 1/s, critically damped.
inline constexpr float k_sink_effort = 5.2f, k_sink_release = 9.636f;

// The straightest leg, as a share of its length, rounded over so many metres; metres that a leg may fall
// short as it leaves, and before `landing`, a share of the swing, and by which a foot in mid-swing gives way.
inline constexpr float k_straightest = 0.9994f, k_straight = 0.002287f;
inline constexpr float k_leaving_slack = 0.03624f, k_landing = 0.9291f, k_landing_slack = 0.1563f,
                       k_give = 0.01714f;
// Legs behind the body in which it may fall short by so much more; and metres for each metre climbed.
inline constexpr float k_behind_0 = 0.45f, k_behind_1 = 0.6f, k_behind_slack = 0.15f, k_climb_slack = 0.4f;
// Share of the swing in which a foot that had rolled over its ball comes off it.
inline constexpr float k_let_go = 0.6f;

// Share of a foot's time on the ground before the hip passes it.
inline constexpr float k_lead = 0.3959f;

// Share of double support in which the body goes over to the foot that has landed.
inline constexpr float k_shift_width = 0.9136f;

// Pelvis: sway to each side, metres, at a natural speed, and what a longer share of stance (a slower walk)
// adds to it: 70 mm from side to side at 0.7 m/s .. 39 at 1.6 (Orendurff et al. 2004). Its way ahead of an
// even speed, legs, goes with surge_cosine cos 2a + surge_sine sin 2a, a = 2 pi phase.
inline constexpr float k_sway = 0.0257f, k_sway_slow = 0.287f;
inline constexpr float k_surge_cosine = 0.006715f, k_surge_sine = -0.01728f;

// Trunk: radians by which it nods for each leg that the pelvis goes ahead, its turn over the pelvis's; head:
// radians that it nods, rolls over the pelvis's list, its turn over the chest's.
inline constexpr float k_nod = 1.84f, k_chest_turn = 0.64f;
// The share of its surge that the pelvis loses for each gravity that drives it.
inline constexpr float k_drive_evens = 8;
inline constexpr float k_drive_lean = 0.5f, k_bank_lean = 0.35f;  // radians over gravity
inline constexpr float k_head_nod = 0.039f, k_head_roll = 0.3f, k_head_turn = 0.5f;

// One who stands: pelvis to the side, for all of the body on one leg, in what the feet are apart, at most so
// many metres; its list then, radians (twice that once at rest); how far the chest goes back at the height of
// a breath.
inline constexpr float k_idle_sway = 0.5f, k_widest_sway = 0.3f;
inline constexpr float k_idle_list = 0.12f, k_breath_lean = 0.014f;

// Knees that a manner keeps bent are straight in standing, and bent again from 1 / crouches of a walk on.
inline constexpr float k_crouches = 1.6f;

// Arms swing twice a stride where feet stand longer than at a natural speed by these shares of the cycle
// (0.75 m/s).
inline constexpr float k_arms_twice_0 = 0.028f, k_arms_twice_1 = 0.036f;

// A swing to another level has climbed by a share of its time that grows by the metres climbed, and waits
// before it goes on; the other way round down, where it waits only where the way is steep (times its slope
// squared) and otherwise comes down in a last share, falls. From these heights on (metres) it is one.
inline constexpr float k_step_climbs = 0.32f, k_step_wait = 0.22f, k_step_waits = 20, k_step_falls = 0.25f;
inline constexpr float k_slow_climbs = 0.8f, k_slow_wait = 0.5f;  // of a small child's climb
inline constexpr float k_step_0 = 0.03f, k_step_1 = 0.09f;

// A run, see swing-inl.h and rise-inl.h, fitted to legs that move as runners' do (Novacheck 1998; Fukuchi,
// Fukuchi & Duarte 2017): the knee 14 degrees at contact, 50 in mid-stance, 20 at toe-off and 78, 94, 113 in
// the swing at 2.2, 3.1, 5 m/s; the thigh from 22 degrees behind to 27, 37, 46 ahead.
struct RunFit {
    float value, faster;  // at a pace of 1; what a pace faster by 1 adds
};
inline constexpr RunFit k_run_progress[] = {
    {-1.21f, 3.004f}, {-0.156f, -1.169f}, {-1.348f, 1.688f}, {-0.511f, -0.019f}};
inline constexpr RunFit k_run_clear[] = {
    {0.759f, 1.306f}, {5.774f, 6.914f}, {-11.319f, -12.701f}, {0.341f, 0.677f}, {0.061f, 0.555f}};
inline constexpr RunFit k_run_swing_pitch[] = {
    {-3.94f, -1.71f}, {0.755f, -7.722f}, {-24.126f, 3.176f}, {31.686f, 3.416f}};
// Its foot on the ground: toes up at contact, radians; shares of stance until it is flat and from which on
// the heel rises; radians by which it has risen at toe-off, for each leg of reach more, and how late.
inline constexpr float k_run_contact = 0.157f, k_run_contact_sine = 0.1564f, k_run_contact_cosine = 0.9877f;
inline constexpr float k_run_flat = 0.2f, k_run_heel_off = 0.46f;
inline constexpr float k_run_push = -0.8f, k_run_push_reach = 2.0f, k_run_push_late = 0.7f;
// The hips: how much they give way in mid-stance, of gravity times the square of the time that a foot
// stands; cosine of the knee at contact, at a pace of 1.15, and by how much it falls to either side; share of
// that time before the hip passes the foot; how far the body goes meanwhile at most, legs, and how much less
// for each m/s beyond 3.1 (about as far at every speed: Weyand et al. 2000).
inline constexpr float k_run_give = 0.028f, k_run_knee_cosine = 0.985f, k_run_knee_pace = 0.055f;
inline constexpr float k_run_lead = 0.347f;
inline constexpr float k_run_reach = 1.0f, k_run_reach_slope = 0.045f;
// Elbow, radians; how much wider the arms swing than in a walk, and radians farther out; of the trunk's lean.
inline constexpr float k_run_elbow = 1.8f, k_run_arms = 0.5f, k_run_carriage = 0.1f, k_run_lean = 0.06f;

// A hand on a wall: how far its fingers lean ahead (half of 1.1 rad), and from the wrist's axis to the palm,
// metres.
inline constexpr float k_finger_tilt_sine = 0.5227f, k_finger_tilt_cosine = 0.8525f;
inline constexpr float k_palm_thickness = 0.02f;

}  // namespace flaneur
