// Small vectors and quaternions for single values: + - * / and sqrt only, so that results are the same bits
// everywhere. Kernels that run over lanes use the templates of vec-inl.h.
#pragma once

#include <cmath>
#include <cstdint>

namespace flaneur {

// A point or direction of the ground plane, metres. Seen from above, +x is left of a walker that faces +z.
struct Vec2 {
    float x = 0, z = 0;
};

// A point or direction, metres. Right-handed, +y up, a character at rest faces +z.
struct Vec3 {
    float x = 0, y = 0, z = 0;
};

// A unit quaternion, vector part first. Identity by default.
struct Quat {
    float x = 0, y = 0, z = 0, w = 1;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.z + b.z}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.z - b.z}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.z}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.z * s}; }
constexpr Vec2 operator/(Vec2 a, float s) { return {a.x / s, a.z / s}; }
constexpr Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
constexpr Vec2& operator-=(Vec2& a, Vec2 b) { return a = a - b; }
constexpr bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.z == b.z; }
constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.z * b.z; }
// Twice the signed area of the triangle (0, a, b). On a map with x to the right and z down the page it is
// positive when b lies clockwise of a.
constexpr float cross(Vec2 a, Vec2 b) { return a.x * b.z - a.z * b.x; }
constexpr float length_squared(Vec2 a) { return dot(a, a); }
inline float length(Vec2 a) { return std::sqrt(dot(a, a)); }

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator/(Vec3 a, float s) { return {a.x / s, a.y / s, a.z / s}; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
constexpr bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr float length_squared(Vec3 a) { return dot(a, a); }
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
constexpr Vec2 on_ground(Vec3 a) { return {a.x, a.z}; }
constexpr Vec3 at_height(Vec2 a, float y) { return {a.x, y, a.z}; }

// `a` scaled to length 1, or `otherwise` when `a` is shorter than a micrometre.
inline Vec2 normalize_or(Vec2 a, Vec2 otherwise) {
    float l = length(a);
    return l > 1e-6f ? a / l : otherwise;
}
inline Vec3 normalize_or(Vec3 a, Vec3 otherwise) {
    float l = length(a);
    return l > 1e-6f ? a / l : otherwise;
}

constexpr float clamp(float v, float low, float high) { return v < low ? low : (v > high ? high : v); }
constexpr float lerp(float a, float b, float t) { return a + (b - a) * t; }
constexpr Vec2 lerp(Vec2 a, Vec2 b, float t) { return a + (b - a) * t; }
constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
// 0 below `low`, 1 above `high`, 3t^2 - 2t^3 between.
constexpr float smoothstep(float low, float high, float v) {
    float t = clamp((v - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

// Hamilton product: rotating by `a * b` is rotating by b, then by a.
constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
constexpr Quat conjugate(Quat q) { return {-q.x, -q.y, -q.z, q.w}; }
constexpr float dot(Quat a, Quat b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
constexpr Vec3 rotate(Quat q, Vec3 v) {
    Vec3 u{q.x, q.y, q.z};
    Vec3 t = cross(u, v) * 2;
    return v + t * q.w + cross(u, t);
}
inline Quat normalize(Quat q) {
    float s = 1 / std::sqrt(dot(q, q));
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}
// The share `t` of the shorter way from one to the other, about evenly where they lie near each other.
inline Quat nlerp(Quat from, Quat to, float t) {
    float there = dot(from, to) < 0 ? -t : t, here = 1 - t;
    return normalize({from.x * here + to.x * there, from.y * here + to.y * there,
                      from.z * here + to.z * there, from.w * here + to.w * there});
}
// The shortest rotation that takes unit vector `from` to unit vector `to`; for opposite vectors, half a turn
// about some axis square to `from`.
Quat rotation_between(Vec3 from, Vec3 to);

}  // namespace flaneur
