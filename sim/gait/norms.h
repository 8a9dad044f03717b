// The normal walk as harmonic series over one gait cycle, fitted by least squares to the mean curves of
// Winter (The Biomechanics and Motor Control of Human Gait, 1991) and Fukuchi, Fukuchi & Duarte (PeerJ
// 6:e4640, 2018, CC BY 4.0), pooled. Degrees; the cycle starts at initial contact of the same side.
#pragma once

namespace flaneur {

struct Harmonic {
    float cosine, sine;
};

// value(phase) = mean + sum over k of cosine[k] cos(2 pi k phase) + sine[k] sin(2 pi k phase)
template <int N>
struct HarmonicCurve {
    float mean;
    Harmonic terms[N];
};

// The phase of toe-off in the curves below.
inline constexpr float k_norm_toe_off = 0.61f;
// The share of the cycle that a foot stands at a natural speed.
inline constexpr float k_norm_duty = 0.603f;

// Flexion +.
inline constexpr HarmonicCurve<5> k_norm_knee = {22.9480f,
                                                 {{-2.9209f, -20.7971f},
                                                  {-15.6105f, 7.1439f},
                                                  {-1.3223f, 5.0758f},
                                                  {-1.0727f, 0.7181f},
                                                  {-0.6257f, 1.0024f}}};

// Toe up +, against the flat foot.
inline constexpr HarmonicCurve<6> k_norm_foot_pitch = {-12.1792f,
                                                       {{17.8504f, 21.5883f},
                                                        {14.2936f, -13.2476f},
                                                        {-3.2648f, -3.4664f},
                                                        {3.0136f, 0.6340f},
                                                        {0.8366f, -1.9749f},
                                                        {0.2381f, 0.5680f}}};

// Same side up +.
inline constexpr HarmonicCurve<3> k_norm_pelvic_list = {0.0f,
                                                        {{2.7561f, 3.1983f}, {0, 0}, {-1.4058f, -0.0850f}}};

// Same side forward +.
inline constexpr HarmonicCurve<3> k_norm_pelvic_rotation = {
    0.0f, {{5.4471f, 2.6602f}, {0, 0}, {0.8309f, -0.3824f}}};

// The swing of a foot from one place to the next, u = 0 at toe-off .. 1 at contact, r = 1 - u, h = 16 u^2
// r^2: its way is 3u^2 - 2u^3 - way_late u^5 r^3 - way h, its lowest point stays clear_early u^2 r^5 + clear
// h metres above the ground, and its toes hang droop h radians lower than in the norm. Fitted so that thigh,
// knee and ankle move as in the norms.
inline constexpr float k_way_late = 5.034f, k_way = -0.0301f;
inline constexpr float k_clear_early = 0.9395f, k_clear = 0.005979f;
inline constexpr float k_droop = -0.1084f, k_soft = 0.0239f;
inline constexpr float k_landing = 0.6f, k_landing_slack = 0.1454f, k_knee_more = -0.005787f;
inline constexpr float k_straight = 0.001057f;
// Share of the norm's pitch at heel strike, and radians by which the heel rises further before toe-off.
inline constexpr float k_heel_strike = 0.7013f, k_heel_rise = 0.04128f;
// Phases in which the heel comes off.
inline constexpr float k_heel_off_0 = 0.2982f, k_heel_off_1 = 0.3509f;
inline constexpr float k_straightest = 0.9981f;
// Pelvis: sway to each side and extra rise over the standing leg, metres, at a natural speed, and what a
// longer share of stance (a slower walk) adds: 70 mm from side to side at 0.7 m/s .. 39 at 1.6, 27 mm up and
// down .. 48.
inline constexpr float k_sway = 0.0257f, k_sway_slow = 0.287f;
inline constexpr float k_bob = 0.0005075f, k_bob_slow = 0.2355f;
inline constexpr float k_high_cosine = -0.9661f, k_high_sine = -1.284f;  // of 4 pi times the phase 0.28
// Metres ahead of an even speed: fastest when lowest.
// Share of the pitch of a swinging foot that its toes have: they stay bent up.
inline constexpr float k_toes = 0.4423f;
inline constexpr float k_surge_cosine = 0.0117f, k_surge_sine = -0.003194f;
// Arms swing twice a stride where feet stand longer than at a natural speed by these shares of the cycle
// (0.75 m/s).
inline constexpr float k_arms_twice_0 = 0.028f, k_arms_twice_1 = 0.036f;
inline constexpr float k_forefoot_pitch = -0.25f;  // of a foot that lands on its ball, radians

// A swing to another level has climbed by a share of its time that grows by the metres climbed, and waits
// before it goes on; the other way round down, where it waits only where the way is steep (times its slope
// squared). From these heights on (metres) it is one.
inline constexpr float k_step_climbs = 0.32f, k_step_wait = 0.22f, k_step_waits = 20;
inline constexpr float k_give = 0.03f;  // metres; see Foot
inline constexpr float k_step_0 = 0.03f, k_step_1 = 0.09f;

// A run at 3.1 m/s: knee 94 degrees in the swing, elbow 106.
// Radians by which its heel rises further before toe-off. Its swing: metres by which the heel rises, metres
// and shares of the way that the foot takes along from its push and brings down into the landing.
inline constexpr float k_heel_kick = 3.5f, k_run_heel = 0.32f, k_run_rise = 0.44f, k_run_fall = 0.3f,
                       k_run_way = 0.25f;
inline constexpr float k_run_knee_cosine = 0.64f, k_bounce = 0.027f;  // of the mean height; metres
inline constexpr float k_run_elbow = 1.85f, k_run_lean = 0.12f;       // radians

// A hand on a wall: how far its fingers lean ahead (half of 1.1 rad), and from the wrist's axis to the palm,
// metres.
inline constexpr float k_finger_tilt_sine = 0.5227f, k_finger_tilt_cosine = 0.8525f;
inline constexpr float k_palm_thickness = 0.02f;
inline constexpr float k_shift_width = 0.8946f;

// Timing of a walk at a given speed. Step length over leg length L:
// 1.16 L (v / sqrt(g L))^0.5; stance as a share of the cycle: 62.5, 60.3, 59.1 % at 0.94, 1.24, 1.50 m/s.
inline constexpr float k_gravity = 9.81f;
inline constexpr float k_step_factor = 1.115f;

}  // namespace flaneur
