// Vectors and quaternions over float or Lanes, for kernels, under the names of vec.h; see there for spaces
// and conventions.
#if defined(FLANEUR_SIM_BASE_VEC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_BASE_VEC_INL_H
#undef FLANEUR_SIM_BASE_VEC_INL_H
#else
#define FLANEUR_SIM_BASE_VEC_INL_H
#endif

#include "sim/base/lanes-inl.h"
#include "sim/base/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// On the ground plane.
template <class T>
struct V2 {
    T x, z;
};
template <class T>
HWY_INLINE V2<T> operator+(V2<T> a, V2<T> b) {
    return {a.x + b.x, a.z + b.z};
}
template <class T>
HWY_INLINE V2<T> operator-(V2<T> a, V2<T> b) {
    return {a.x - b.x, a.z - b.z};
}
template <class T>
HWY_INLINE V2<T> operator*(V2<T> a, T s) {
    return {a.x * s, a.z * s};
}
template <class T>
HWY_INLINE T dot(V2<T> a, V2<T> b) {
    return a.x * b.x + a.z * b.z;
}
template <class T>
HWY_INLINE T cross(V2<T> a, V2<T> b) {
    return a.x * b.z - a.z * b.x;
}
template <class M, class T>
HWY_INLINE V2<T> select(M m, V2<T> a, V2<T> b) {
    return {select(m, a.x, b.x), select(m, a.z, b.z)};
}

template <class T>
struct V3 {
    T x, y, z;
};
template <class T>
struct Q4 {
    T x, y, z, w;
};

template <class T>
HWY_INLINE V3<T> operator+(V3<T> a, V3<T> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
HWY_INLINE V3<T> operator-(V3<T> a, V3<T> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
HWY_INLINE V3<T> operator*(V3<T> a, T s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class T>
HWY_INLINE T dot(V3<T> a, V3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
HWY_INLINE V3<T> cross(V3<T> a, V3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class M, class T>
HWY_INLINE V3<T> select(M m, V3<T> a, V3<T> b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class T>
HWY_INLINE V3<T> lerp(V3<T> a, V3<T> b, T t) {
    return a + (b - a) * t;
}
// Unit length; a vector shorter than a micrometre keeps its direction but not its length.
template <class T>
HWY_INLINE V3<T> normalize(V3<T> a) {
    return a * (T(1.0f) / sqrt(max(dot(a, a), T(1e-12f))));
}

template <class T>
HWY_INLINE Q4<T> operator*(Q4<T> a, Q4<T> b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
template <class T>
HWY_INLINE Q4<T> conjugate(Q4<T> q) {
    return {T(0.0f) - q.x, T(0.0f) - q.y, T(0.0f) - q.z, q.w};
}
template <class T>
HWY_INLINE T dot(Q4<T> a, Q4<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <class T>
HWY_INLINE V3<T> rotate(Q4<T> q, V3<T> v) {
    V3<T> u{q.x, q.y, q.z};
    V3<T> t = cross(u, v) * T(2.0f);
    return v + t * q.w + cross(u, t);
}
// q times a turn about the axis x, y or z, given by the sine and cosine of half of it.
template <class T>
HWY_INLINE Q4<T> turned_x(Q4<T> q, SinCosOf<T> h) {
    return {q.x * h.cosine + q.w * h.sine, q.y * h.cosine + q.z * h.sine, q.z * h.cosine - q.y * h.sine,
            q.w * h.cosine - q.x * h.sine};
}
template <class T>
HWY_INLINE Q4<T> turned_y(Q4<T> q, SinCosOf<T> h) {
    return {q.x * h.cosine - q.z * h.sine, q.y * h.cosine + q.w * h.sine, q.z * h.cosine + q.x * h.sine,
            q.w * h.cosine - q.y * h.sine};
}
// A turn about y after q.
template <class T>
HWY_INLINE Q4<T> after_y(SinCosOf<T> h, Q4<T> q) {
    return {h.cosine * q.x + h.sine * q.z, h.cosine * q.y + h.sine * q.w, h.cosine * q.z - h.sine * q.x,
            h.cosine * q.w - h.sine * q.y};
}
// Turns about y, then z, then x, each within the one before.
template <class T>
HWY_INLINE Q4<T> turned_yzx(SinCosOf<T> y, SinCosOf<T> z, SinCosOf<T> x) {
    Q4<T> q{y.sine * z.sine, y.sine * z.cosine, y.cosine * z.sine, y.cosine * z.cosine};
    return turned_x(q, x);
}

// The axes that a rotation takes x, y and z to.
template <class T>
struct Axes {
    V3<T> x, y, z;
};
template <class T>
HWY_INLINE Axes<T> axes_of(Q4<T> q) {
    T x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
    T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2, xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
    T wx = q.w * x2, wy = q.w * y2, wz = q.w * z2, one = T(1.0f);
    return {{one - yy - zz, xy + wz, xz - wy},
            {xy - wz, one - xx - zz, yz + wx},
            {xz + wy, yz - wx, one - xx - yy}};
}
// The rotation with these orthonormal axes, if it is nearer to the identity than half a turn.
template <class T>
HWY_INLINE Q4<T> rotation_of(Axes<T> a) {
    T w = sqrt(max(T(1.0f) + a.x.x + a.y.y + a.z.z, T(1e-6f)));
    T s = T(0.5f) / w;
    return {(a.y.z - a.z.y) * s, (a.z.x - a.x.z) * s, (a.x.y - a.y.x) * s, w * T(0.5f)};
}

template <class M, class T>
HWY_INLINE Q4<T> select(M m, Q4<T> a, Q4<T> b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
// The part of a turn about y, as sine and cosine of half of it; less than half a turn either way.
template <class T>
HWY_INLINE SinCosOf<T> twist_about_y(Q4<T> turn) {
    T over = T(1.0f) / sqrt(max(turn.y * turn.y + turn.w * turn.w, T(1e-12f)));
    over = select(turn.w < T(0.0f), T(0.0f) - over, over);
    return {turn.y * over, turn.w * over};
}

template <class T>
HWY_INLINE Q4<T> normalize(Q4<T> q) {
    T s = T(1.0f) / sqrt(max(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, T(1e-12f)));
    return {q.x * s, q.y * s, q.z * s, q.w * s};
}
// The shortest rotation from unit vector `from` to unit vector `to`, without a trigonometric function: the
// half-angle quaternion (from x to, 1 + from . to). Not defined for opposite vectors.
template <class T>
HWY_INLINE Q4<T> rotation_between(V3<T> from, V3<T> to) {
    V3<T> axis = cross(from, to);
    return normalize(Q4<T>{axis.x, axis.y, axis.z, max(T(1.0f) + dot(from, to), T(1e-6f))});
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
