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
inline constexpr float k_way_late = 11.99f, k_way = 0.02952f;
inline constexpr float k_clear_early = 1.032f, k_clear = -0.001117f;
inline constexpr float k_droop = -0.01412f, k_soft = 0.02156f;
inline constexpr float k_land_0 = 1.187f, k_land_1 = 1.494f, k_knee_more = -0.0008148f;
inline constexpr float k_straight = 0.004054f;
inline constexpr float k_sway = 0.020f;
inline constexpr float k_shift_width = 1.138f;

// Timing of a walk at a given speed. Step length over leg length L:
// 1.16 L (v / sqrt(g L))^0.5; stance as a share of the cycle: 62.5, 60.3, 59.1 % at 0.94, 1.24, 1.50 m/s.
inline constexpr float k_gravity = 9.81f;
inline constexpr float k_step_factor = 1.141f;

}  // namespace flaneur
