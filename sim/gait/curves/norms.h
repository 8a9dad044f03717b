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

// Timing of a walk at a given speed. Step length over leg length L: 1.16 (v / sqrt(g L))^0.5, of which the
// neutral person's are a little short; stance as a share of the cycle: 62.5, 60.3, 59.1 % at 0.94, 1.24, 1.50
// m/s.
inline constexpr float k_step_factor = 1.148f;

}  // namespace flaneur
