// Vectors and quaternions in rows of sixteen lanes.
#if defined(FLANEUR_SIM_BASE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_BASE_ROWS_INL_H
#undef FLANEUR_SIM_BASE_ROWS_INL_H
#else
#define FLANEUR_SIM_BASE_ROWS_INL_H
#endif

#include "sim/base/block.h"
#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE T row(const float* values, size_t lane) {
    T value;
    load(value, values + lane);
    return value;
}

template <class T>
HWY_INLINE V3<T> load_place(const float (*rows)[k_block], size_t lane) {
    V3<T> v;
    load(v.x, rows[0] + lane), load(v.y, rows[1] + lane), load(v.z, rows[2] + lane);
    return v;
}
template <class T>
HWY_INLINE Q4<T> load_rotation(const float (*rows)[k_block], size_t lane) {
    Q4<T> q;
    load(q.x, rows[0] + lane), load(q.y, rows[1] + lane), load(q.z, rows[2] + lane);
    load(q.w, rows[3] + lane);
    return q;
}
template <class T>
HWY_INLINE void store_place(V3<T> v, float (*rows)[k_block], size_t lane) {
    store(v.x, rows[0] + lane), store(v.y, rows[1] + lane), store(v.z, rows[2] + lane);
}
template <class T>
HWY_INLINE void store_rotation(Q4<T> q, float (*rows)[k_block], size_t lane) {
    store(q.x, rows[0] + lane), store(q.y, rows[1] + lane), store(q.z, rows[2] + lane);
    store(q.w, rows[3] + lane);
}

// Rows of a LaneRow array, as the functions above take them.
HWY_INLINE const float (*rows_of(const LaneRow* rows))[k_block] { return &rows->lanes; }
HWY_INLINE float (*rows_of(LaneRow* rows))[k_block] { return &rows->lanes; }

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
