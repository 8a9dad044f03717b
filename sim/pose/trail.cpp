#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/trail.cpp"
#include "sim/pose/trail.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Whoever is set down elsewhere does not drag what hangs on him along.
constexpr float k_fastest = 12, k_fastest_turn = 12;

HWY_INLINE Lanes row(const float* from) {
    Lanes lanes(0.0f);
    load(lanes, from);
    return lanes;
}

// A lag behind `v`, within `most`.
HWY_INLINE void follow(Lanes v, float most, Lanes share, const float* from, float* to) {
    const Lanes was = row(from);
    store(was + (max(min(v, Lanes(most)), Lanes(-most)) - was) * share, to);
}

void advance_trail(const PoseBlock& before, const PoseBlock& last, float tick, const TrailBlock& from,
                   TrailBlock& to) {
    const Lanes share(tick / (tick + k_trail)), rate(1 / tick), twice(2 / tick), zero(0.0f);
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const Lanes carried = row(last.origin[axis] + lane) - row(before.origin[axis] + lane);
            for (size_t n = 0; n < k_trailed.size(); ++n) {
                const size_t joint = k_trailed[n];
                const Lanes way = row(last.position[joint][axis] + lane) -
                                  row(before.position[joint][axis] + lane) + carried;
                follow(way * rate, k_fastest, share, from.moving[n][axis] + lane, to.moving[n][axis] + lane);
            }
        }
        for (size_t n = 0; n < k_turning; ++n) {
            Lanes a[4] = {zero, zero, zero, zero}, b[4] = {zero, zero, zero, zero};
            for (size_t i = 0; i < 4; ++i) {
                a[i] = row(before.rotation[k_trailed[n]][i] + lane);
                b[i] = row(last.rotation[k_trailed[n]][i] + lane);
            }
            // Of b times the conjugate of a. Twice the vector part of a small turn is its angle.
            const Lanes up = b[1] * a[3] - b[3] * a[1] + b[0] * a[2] - b[2] * a[0];
            const Lanes w = b[0] * a[0] + b[1] * a[1] + b[2] * a[2] + b[3] * a[3];
            follow(select(w < zero, zero - up, up) * twice, k_fastest_turn, share, from.turning[n] + lane,
                   to.turning[n] + lane);
        }
    }
}

void advance_trails_here(const PoseBlock* before, const PoseBlock* last, size_t begin, size_t end, float tick,
                         const TrailBlock* from, TrailBlock* to) {
    for (size_t b = begin; b < end; ++b) advance_trail(before[b], last[b], tick, from[b], to[b]);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(advance_trails_here);

void advance_trails(const std::vector<PoseBlock>& before, const std::vector<PoseBlock>& last, size_t begin,
                    size_t end, float tick, const std::vector<TrailBlock>& from,
                    std::vector<TrailBlock>& to) {
    HWY_DYNAMIC_DISPATCH(advance_trails_here)
    (before.data(), last.data(), begin, end, tick, from.data(), to.data());
}

void forget_trail(std::vector<TrailBlock>& trails, size_t walker) {
    TrailBlock& block = trails[walker / k_block];
    const size_t lane = walker % k_block;
    for (auto& joint : block.moving)
        for (auto& axis : joint) axis[lane] = 0;
    for (auto& joint : block.turning) joint[lane] = 0;
}

Trail trail_of(const std::vector<TrailBlock>& trails, size_t walker) {
    const TrailBlock& block = trails[walker / k_block];
    const size_t lane = walker % k_block;
    Trail trail;
    for (size_t n = 0; n < k_trailed.size(); ++n) {
        const auto& v = block.moving[n];
        trail.moving[n] = {v[0][lane], v[1][lane], v[2][lane]};
    }
    for (size_t n = 0; n < k_turning; ++n) trail.turning[n] = block.turning[n][lane];
    return trail;
}

Trail mixed_trail(const Trail& a, const Trail& b, float between) {
    Trail mixed;
    for (size_t n = 0; n < k_trailed.size(); ++n) mixed.moving[n] = lerp(a.moving[n], b.moving[n], between);
    for (size_t n = 0; n < k_turning; ++n) mixed.turning[n] = lerp(a.turning[n], b.turning[n], between);
    return mixed;
}

}  // namespace flaneur
#endif
