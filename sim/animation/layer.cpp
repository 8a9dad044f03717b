#include "sim/animation/layer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/animation/layer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/animation/clip-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Sixteen plays' joints from hips to hands, side by side.
struct alignas(64) UpperBodies {
    float position[right_hand + 1][3][k_block];
    float rotation[right_hand + 1][4][k_block];
};

HWY_INLINE void gather(const ClipPlay* plays, size_t count, const PoseBlock* poses, UpperBodies& to) {
    for (size_t i = 0; i < k_block; ++i) {
        size_t walker = plays[i < count ? i : 0].walker;  // spare lanes repeat the first
        const PoseBlock& from = poses[walker / k_block];
        size_t lane = walker % k_block;
        for (size_t j = hips; j <= right_hand; ++j) {
            for (size_t c = 0; c < 3; ++c) to.position[j][c][i] = from.position[j][c][lane];
            for (size_t c = 0; c < 4; ++c) to.rotation[j][c][i] = from.rotation[j][c][lane];
        }
    }
}

HWY_INLINE void scatter(const UpperBodies& from, const ClipPlay* plays, size_t count, PoseBlock* poses) {
    for (size_t i = 0; i < count; ++i) {
        PoseBlock& to = poses[plays[i].walker / k_block];
        size_t lane = plays[i].walker % k_block;
        for (size_t j = spine; j <= right_hand; ++j) {
            for (size_t c = 0; c < 3; ++c) to.position[j][c][lane] = from.position[j][c][i];
            for (size_t c = 0; c < 4; ++c) to.rotation[j][c][lane] = from.rotation[j][c][i];
        }
    }
}

// Joint `j`, carried by its parent's new place and turned by its share of the difference in `rows`, which is
// in the joint's own axes. With _ws in the world's axes and _os from the pose's origin: the parent has turned
// by `carried_ws`, which takes the bone along; the joint is turned by that, and by its share before.
//
// A share w of a turn (x, y, z, c), c >= 0, is the normalised (w x, w y, w z, 1 - w + w c): lerp from the
// identity.
HWY_INLINE void turn_joint(const UpperBodies& old, UpperBodies& now, size_t j, const float* weights,
                           float mask, const float (*rows)[k_block]) {
    auto parent = size_t(k_joint_parents[j]);
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        Q4<Lanes> old_above_ws = load_rotation<Lanes>(old.rotation[parent], lane);
        Q4<Lanes> carried_ws = load_rotation<Lanes>(now.rotation[parent], lane) * conjugate(old_above_ws);
        V3<Lanes> bone_os =
            load_place<Lanes>(old.position[j], lane) - load_place<Lanes>(old.position[parent], lane);
        store_place(load_place<Lanes>(now.position[parent], lane) + rotate(carried_ws, bone_os),
                    now.position[j], lane);
        Lanes w;
        load(w, weights + lane);
        w = w * Lanes(mask);
        Q4<Lanes> turn = normalize_or_identity(load_rotation<Lanes>(rows, lane));
        w = select(turn.w < Lanes(0.0f), -w, w);
        Lanes rest = Lanes(1.0f) - abs(w);
        Q4<Lanes> share{turn.x * w, turn.y * w, turn.z * w, turn.w * w + rest};
        Q4<Lanes> turned_ws = carried_ws * load_rotation<Lanes>(old.rotation[j], lane) * share;
        store_rotation(normalize(turned_ws), now.rotation[j], lane);
    }
}

void apply_plays_here(const ClipLayer& layer, size_t begin, size_t end, PoseBlock* poses) {
    UpperBodies old, now;
    TapList<4> lists[k_block];
    alignas(64) float weights[k_block], rows[16][k_block];
    for (; begin < end; begin += k_block) {
        const ClipPlay* plays = layer.plays.data() + begin;
        size_t count = std::min<size_t>(k_block, end - begin);
        for (size_t i = 0; i < k_block; ++i) {
            lists[i].count = 0;
            weights[i] = 0;
            if (i >= count) continue;
            const Clip& clip = layer.clips[plays[i].clip];
            KeyTime<float> time = key_time(clip, plays[i].phase);
            add_taps(lists[i], clip, time.key, time.fraction, 1);
            weights[i] = smoothstep(plays[i].fade);
        }
        gather(plays, count, poses, old);
        std::copy_n(&old.position[hips][0][0], 3 * k_block, &now.position[hips][0][0]);
        std::copy_n(&old.rotation[hips][0][0], 4 * k_block, &now.rotation[hips][0][0]);
        sum_piece(lists, 0, rows);
        for (size_t j = spine; j <= right_hand; ++j) {
            if (j % 4 == 0) sum_piece(lists, j / 4, rows);
            turn_joint(old, now, j, weights, layer.mask[j], rows + 4 * (j % 4));
        }
        scatter(now, plays, count, poses);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

namespace {

constexpr uint16_t k_patience = 60;  // ticks of standing before an idle

}  // namespace

ClipLayer make_layer(std::vector<Clip> clips, size_t walkers) {
    ClipLayer layer;
    layer.clips = std::move(clips);
    layer.mask.fill(1);
    layer.wanted.assign(walkers, k_no_clip);
    layer.playing.assign(walkers, 0);
    layer.stood.assign(walkers, 0);
    layer.plays.reserve(walkers);
    return layer;
}

void forget_plays(ClipLayer& layer, uint32_t walker) {
    layer.wanted[walker] = k_no_clip;
    layer.playing[walker] = 0;
    layer.stood[walker] = 0;
    std::erase_if(layer.plays, [&](const ClipPlay& play) { return play.walker == walker; });
}

constexpr int32_t k_both_free = 1 << k_left | 1 << k_right;

void want_idles(ClipLayer& layer, const Gait& gait) {
    if (layer.clips.empty()) return;
    for (size_t i = 0; i < layer.wanted.size(); ++i) {
        const GaitBlock& g = gait.blocks[i / k_block];
        size_t lane = i % k_block;
        bool free = g.standing[lane] != 0 && gait.people[i / k_block].free_hands[lane] == k_both_free;
        for (Side side : {k_left, k_right})
            free = free && g.hands[side].reach[lane] <= 0 && g.holds[side].share[lane] <= 0;
        layer.stood[i] = free ? std::min<uint16_t>(uint16_t(layer.stood[i] + 1), k_patience) : uint16_t{0};
        bool idle = layer.stood[i] == k_patience;
        layer.wanted[i] = idle ? uint16_t(i % layer.clips.size()) : k_no_clip;
    }
}

void advance_plays(ClipLayer& layer, float dt) {
    float step = dt / layer.fade_time;
    size_t kept = 0;
    for (ClipPlay play : layer.plays) {
        const Clip& clip = layer.clips[play.clip];
        play.phase += clip.duration > 0 ? dt / clip.duration : 0;
        play.phase = clip.loops ? play.phase - std::floor(play.phase) : std::min(play.phase, 1.0f);
        bool on = layer.wanted[play.walker] == play.clip;
        play.fade = on ? std::min(play.fade + step, 1.0f) : play.fade - step;
        layer.playing[play.walker] = play.fade > 0;
        if (play.fade > 0) layer.plays[kept++] = play;
    }
    layer.plays.resize(kept);
    if (layer.clips.empty()) return;
    for (uint32_t i = 0; i < layer.wanted.size(); ++i) {
        if (layer.playing[i] || layer.wanted[i] == k_no_clip) continue;
        // The golden ratio spreads neighbours over the loop.
        float somewhere = float(i % 10000) * 0.618034f;
        bool loops = layer.clips[layer.wanted[i]].loops;
        layer.playing[i] = 1;
        layer.plays.push_back(
            {i, layer.wanted[i], loops ? somewhere - std::floor(somewhere) : 0, std::min(step, 1.0f)});
    }
}

HWY_EXPORT(apply_plays_here);

void apply_plays(const ClipLayer& layer, size_t begin, size_t end, std::vector<PoseBlock>& poses) {
    HWY_DYNAMIC_DISPATCH(apply_plays_here)(layer, begin, end, poses.data());
}

}  // namespace flaneur
#endif
