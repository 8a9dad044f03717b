// Recorded clips that some walkers play on top of their procedural pose, idles and gestures, switched on and
// off without a jump.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/animation/clip.h"

namespace flaneur {

inline constexpr uint16_t k_no_clip = 0xffff;

// One walker at it.
struct ClipPlay {
    uint32_t walker;
    uint16_t clip;
    float phase;  // in durations, see sample()
    float fade;   // 0 silent .. 1 fully there; the weight is eased over it
};

struct ClipLayer {
    std::vector<Clip> clips;  // of the humanoid, by make_additive_clip
    // By joint, a factor on the weight. Only spine to hands are turned: the pelvis stays where the feet want
    // it, so nothing that stands on the ground moves.
    std::array<float, k_joint_count> mask{};
    float fade_time = 0.5f;  // seconds from nothing to all

    std::vector<uint16_t> wanted;  // by walker, an index into `clips` or k_no_clip
    std::vector<uint8_t> playing;  // by walker, 1: has an entry in `plays`
    std::vector<ClipPlay> plays;   // those who play or fade out, each walker once
    std::vector<uint16_t> stood;   // by walker, ticks it has stood still, up to a second
};

// A layer of full masks for `walkers` who want nothing yet. Nothing is allocated after.
ClipLayer make_layer(std::vector<Clip> clips, size_t walkers);

// Somebody else has that number from now on, and plays nothing yet.
void forget_plays(ClipLayer& layer, uint32_t walker);

// Who has stood for a second with its hands free wants a clip, chosen by its index; who walks wants none.
void want_idles(ClipLayer& layer, const Gait& gait);

// One tick of `dt` seconds: plays move on in time, fade in while their clip is wanted and out when it is not,
// and end when they are silent; another clip waits for that. Loops start anywhere, by the walker's index,
// other clips at their first key.
void advance_plays(ClipLayer& layer, float dt);

// Turns the joints of the walkers of plays [begin, end) further. The same bits on every instruction set.
void apply_plays(const ClipLayer& layer, size_t begin, size_t end, std::vector<PoseBlock>& poses);

}  // namespace flaneur
