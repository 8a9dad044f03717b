// Sums of clips' rows.
//
// Characters stand at different times, so their rows lie apart, and lanes here run along the row: a gather
// across characters would cost more than the arithmetic. Each sum is then turned over into rows of lanes.
#if defined(FLANEUR_SIM_ANIMATION_CLIP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_ANIMATION_CLIP_INL_H
#undef FLANEUR_SIM_ANIMATION_CLIP_INL_H
#else
#define FLANEUR_SIM_ANIMATION_CLIP_INL_H
#endif

#include <algorithm>

#include "sim/animation/clip.h"
#include "sim/base/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Where a phase lies in a clip.
template <class T>
struct KeyTime {
    T key;       // whole
    T fraction;  // of the way to the next, [0, 1]
};

// A phase that is no number counts as 0.
template <class T>
HWY_INLINE KeyTime<T> key_time(const Clip& clip, T phase) {
    auto steps = static_cast<float>(clip.loops ? clip.keys : clip.keys - 1);
    if (clip.loops) phase = phase - floor(phase);
    T time = clamp(phase, T(0.0f), T(1.0f)) * T(steps);
    T key = min(floor(time), T(steps > 0 ? steps - 1 : 0.0f));
    return {key, time - key};
}

struct Tap {
    const KeyPiece* row;
    float weight;
};

// What one character's sum is made of.
template <size_t Capacity>
struct TapList {
    Tap taps[Capacity];
    size_t count = 0;
};

template <size_t Capacity>
HWY_INLINE void add_taps(TapList<Capacity>& list, const Clip& clip, float key, float fraction, float weight) {
    size_t pieces = local_rows(clip.joints) / 16;
    const KeyPiece* row = clip.rows.data() + (size_t(key) + 1) * pieces;
    Tap* tap = list.taps + list.count;
    float f = fraction, g = 1 - fraction;
    if (clip.curve == Curve::linear) {
        tap[0] = {row, weight * g};
        tap[1] = {row + pieces, weight * f};
        list.count += 2;
    } else {
        tap[0] = {row - pieces, weight * (-0.5f * f * g * g)};
        tap[1] = {row, weight * (1 + f * f * (1.5f * f - 2.5f))};
        tap[2] = {row + pieces, weight * (1 + g * g * (1.5f * g - 2.5f))};
        tap[3] = {row + 2 * pieces, weight * (-0.5f * g * f * f)};
        list.count += 4;
    }
}

HWY_INLINE void sum_values(const Tap* taps, size_t count, size_t piece, float* out) {
    using Narrow = hn::Rebind<int16_t, LaneTag>;
    using Wide = hn::Rebind<int32_t, LaneTag>;
    size_t step = lane_count();
    if (count == 0) {
        std::fill_n(out, 16, 0.0f);
        return;
    }
    auto value = [&](size_t tap, size_t at) -> Lanes {
        auto narrow = hn::LoadU(Narrow(), taps[tap].row[piece].values + at);
        return Lanes(hn::ConvertTo(LaneTag(), hn::PromoteTo(Wide(), narrow))) * Lanes(taps[tap].weight);
    };
    for (size_t at = 0; at < 16; at += step) {
        Lanes sum = value(0, at);
        for (size_t tap = 1; tap < count; ++tap) sum = sum + value(tap, at);
        store(sum, out + at);
    }
}

// Four characters' sixteen values into four lanes of sixteen rows.
HWY_INLINE void transpose(const float (*values)[16], float (*rows)[k_block], size_t lane) {
#if HWY_TARGET == HWY_SCALAR
    for (size_t at = 0; at < 16; ++at)
        for (size_t i = 0; i < 4; ++i) rows[at][lane + i] = values[i][at];
#else
    const hn::FixedTag<float, 4> d;
    for (size_t at = 0; at < 16; at += 4) {
        auto a = hn::Load(d, values[0] + at), b = hn::Load(d, values[1] + at);
        auto c = hn::Load(d, values[2] + at), e = hn::Load(d, values[3] + at);
        auto ac_low = hn::InterleaveLower(d, a, c), ac_high = hn::InterleaveUpper(d, a, c);
        auto be_low = hn::InterleaveLower(d, b, e), be_high = hn::InterleaveUpper(d, b, e);
        hn::Store(hn::InterleaveLower(d, ac_low, be_low), d, rows[at] + lane);
        hn::Store(hn::InterleaveUpper(d, ac_low, be_low), d, rows[at + 1] + lane);
        hn::Store(hn::InterleaveLower(d, ac_high, be_high), d, rows[at + 2] + lane);
        hn::Store(hn::InterleaveUpper(d, ac_high, be_high), d, rows[at + 3] + lane);
    }
#endif
}

// Sums piece `piece` of a block's characters, as rows of lanes.
template <size_t Capacity>
HWY_INLINE void sum_piece(const TapList<Capacity>* lists, size_t piece, float (*rows)[k_block]) {
    alignas(64) float values[4][16];
    for (size_t lane = 0; lane < k_block; lane += 4) {
        for (size_t i = 0; i < 4; ++i)
            sum_values(lists[lane + i].taps, lists[lane + i].count, piece, values[i]);
        transpose(values, rows, lane);
    }
}

// A sum of rotations that cancel out is the identity.
template <class T>
HWY_INLINE Q4<T> normalize_or_identity(Q4<T> q) {
    T norm = dot(q, q);
    auto some = norm > T(1e-6f);
    T s = T(1.0f) / sqrt(select(some, norm, T(1.0f)));
    return {select(some, q.x * s, T(0.0f)), select(some, q.y * s, T(0.0f)), select(some, q.z * s, T(0.0f)),
            select(some, q.w * s, T(1.0f))};
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
