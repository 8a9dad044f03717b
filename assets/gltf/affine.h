// 3x4 transforms for reading files: p -> x * p.x + y * p.y + z * p.z + t.
#pragma once

#include "sim/base/vec.h"

namespace flaneur {

struct Affine {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{};
};

constexpr Vec3 rotate_scale(const Affine& a, Vec3 v) { return a.x * v.x + a.y * v.y + a.z * v.z; }
constexpr Vec3 transform(const Affine& a, Vec3 p) { return rotate_scale(a, p) + a.t; }
// First b, then a.
constexpr Affine operator*(const Affine& a, const Affine& b) {
    return {rotate_scale(a, b.x), rotate_scale(a, b.y), rotate_scale(a, b.z), transform(a, b.t)};
}
constexpr float determinant(const Affine& a) { return dot(a.x, cross(a.y, a.z)); }
// Whether space keeps its three dimensions, at whatever scale.
inline bool invertible(const Affine& a) {
    float volume = determinant(a), most = length(a.x) * length(a.y) * length(a.z);
    return most > 1e-33f && (volume > 1e-5f * most || volume < -1e-5f * most);
}
// Of what is invertible.
constexpr Affine inverse(const Affine& a) {
    float s = 1 / determinant(a);
    Vec3 u = cross(a.y, a.z) * s, v = cross(a.z, a.x) * s, w = cross(a.x, a.y) * s;  // rows of the inverse
    Affine r{{u.x, v.x, w.x}, {u.y, v.y, w.y}, {u.z, v.z, w.z}, {}};
    r.t = -rotate_scale(r, a.t);
    return r;
}

}  // namespace flaneur
