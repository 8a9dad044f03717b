#include "sim/base/math.h"

#include <bit>

#include "sim/base/math-inl.h"

namespace flaneur {

SinCos sin_cos(float x) { return HWY_NAMESPACE::sin_cos(x); }

float arctan2(float y, float x) { return HWY_NAMESPACE::arctan2(y, x); }

float arccos(float x) {
    x = clamp(x, -1, 1);
    return arctan2(std::sqrt((1 - x) * (1 + x)), x);
}

float exponential(float x) {
    x = clamp(x, -87, 87);
    float n = std::floor(x * 1.44269504f + 0.5f);
    float r = (x - n * 0.693359375f) - n * -2.12194440e-4f;
    float p = 1.9875691500e-4f;
    p = p * r + 1.3981999507e-3f;
    p = p * r + 8.3334519073e-3f;
    p = p * r + 4.1665795894e-2f;
    p = p * r + 1.6666665459e-1f;
    p = p * r + 5.0000001201e-1f;
    float y = p * r * r + r + 1;
    return y * std::bit_cast<float>(static_cast<uint32_t>(static_cast<int>(n) + 127) << 23);
}

Vec2 heading_direction(float yaw) {
    SinCos sc = sin_cos(yaw);
    return {sc.sine, sc.cosine};
}

float heading_of(Vec2 d) { return arctan2(d.x, d.z); }

Quat rotation_x(float angle) {
    SinCos h = sin_cos(angle * 0.5f);
    return {h.sine, 0, 0, h.cosine};
}

Quat rotation_y(float angle) {
    SinCos h = sin_cos(angle * 0.5f);
    return {0, h.sine, 0, h.cosine};
}

Quat rotation_z(float angle) {
    SinCos h = sin_cos(angle * 0.5f);
    return {0, 0, h.sine, h.cosine};
}

Quat rotation_about(Vec3 axis, float angle) {
    SinCos h = sin_cos(angle * 0.5f);
    return {axis.x * h.sine, axis.y * h.sine, axis.z * h.sine, h.cosine};
}

}  // namespace flaneur
