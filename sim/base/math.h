// Elementary functions that give the same bits on every compiler, instruction set and optimisation level:
// only + - * / sqrt and comparisons inside. libm's differ between machines, so nothing that reaches
// simulation state may use them, and none of these has the name of one of libm's. The formulas stand once, in
// math-inl.h, for single values and for lanes.
#pragma once

#include <cmath>

#include "sim/base/vec.h"

namespace flaneur {

inline constexpr float k_pi = 3.14159265358979f;
inline constexpr float k_radians = k_pi / 180;  // one degree
inline constexpr float k_gravity = 9.81f;       // m/s2

// The sine and cosine of one angle, of a float here, of float or Lanes in kernels.
template <class T>
struct SinCosOf {
    T sine, cosine;
};
using SinCos = SinCosOf<float>;

// For |x| <= 10,000; within 2e-7 for |x| <= 10.
SinCos sin_cos(float x);

// In (-pi, pi]; within 4e-7. 0 for (0, 0).
float arctan2(float y, float x);

// For x in [-1, 1], clamped; in [0, pi].
float arccos(float x);

// e^x for |x| <= 87; relative error under 2e-7.
float exponential(float x);

// A float as a double, where one is reckoned with or written.
inline double wide(float value) { return static_cast<double>(value); }

// Angles of heading: 0 faces +z, growing towards +x (to the walker's left).
Vec2 heading_direction(float yaw);
float heading_of(Vec2 direction);
// `angle` brought into [-pi, pi], where most are.
inline float wrap_angle(float angle) {
    if (angle >= -k_pi && angle < k_pi) return angle;
    return angle - 2 * k_pi * std::floor(angle / (2 * k_pi) + 0.5f);
}

Quat rotation_x(float angle);
Quat rotation_y(float angle);
Quat rotation_z(float angle);
Quat rotation_about(Vec3 axis, float angle);  // unit

}  // namespace flaneur
