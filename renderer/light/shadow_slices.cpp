#include "renderer/light/shadow_slices.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace flaneur {
namespace {

constexpr uint32_t k_frames_ahead = 30;  // more than both maps take to be drawn by slices
constexpr uint32_t k_most_slices = 4;    // of a map in a frame, if time is short

// What is left of a map that is seen.
void complete(Reach reach, const ShadowBox& box, ShadowState& state, std::vector<ShadowSlices>& drawn) {
    auto& maps = state.maps[static_cast<size_t>(reach)];
    uint8_t& seen = state.seen[static_cast<size_t>(reach)];
    if (maps[seen].box != box) seen ^= 1;
    HeldMap& map = maps[seen];
    if (map.box != box) map = {box, 0, {}};
    if (map.slices == k_shadow_slices) return;
    drawn.push_back({reach, seen, box, map.slices, k_shadow_slices - map.slices});
    map.slices = k_shadow_slices;
}

// Some of the map that will be seen, unless there is time and something else to do.
void go_ahead(Reach reach, const Wanted& wanted, bool is_busy, ShadowState& state,
              std::vector<ShadowSlices>& drawn) {
    const auto ahead = static_cast<uint8_t>(state.seen[static_cast<size_t>(reach)] ^ 1);
    HeldMap& map = state.maps[static_cast<size_t>(reach)][ahead];
    const bool is_next = wanted.frames > 0 && map.box == wanted.next;
    const bool is_begun = map.slices > 0 && map.slices < k_shadow_slices;
    const bool is_done = is_next && map.slices == k_shadow_slices;
    if (is_done || (!is_begun && wanted.frames == 0)) return;
    if (!is_next && wanted.frames > 0 && (!is_begun || wanted.frames <= k_shadow_slices))
        map = {wanted.next, 0, {}};
    const uint32_t left = k_shadow_slices - map.slices;
    const uint32_t frames = map.box == wanted.next && wanted.frames > 0 ? wanted.frames : k_frames_ahead;
    const uint32_t count = std::min((left + frames - 1) / frames, k_most_slices);
    if (count == 1 && is_busy && left < frames) return;
    drawn.push_back({reach, ahead, map.box, map.slices, count});
    map.slices += count;
}

}  // namespace

Wanted wanted_box(const View& before, const View& now, glm::vec3 to_sun, Slice slice, uint32_t resolution) {
    Wanted wanted{fit_shadow(now, to_sun, slice, resolution), {}, 0};
    if (is_cut(before, now)) return wanted;
    const glm::vec3 step = now.eye - before.eye, turn = now.forward - before.forward;
    for (uint32_t frames = 1; frames <= k_frames_ahead; ++frames) {
        View ahead = now;
        ahead.eye += step * static_cast<float>(frames);
        ahead.forward = glm::normalize(now.forward + turn * static_cast<float>(frames) + now.forward * 1e-3f);
        wanted.next = fit_shadow(ahead, to_sun, slice, resolution);
        if (wanted.next == wanted.now) continue;
        wanted.frames = frames;
        break;
    }
    return wanted;
}

ShadowState next_shadows(const ShadowState& before, const std::array<Wanted, k_reaches>& wanted,
                         std::vector<ShadowSlices>& drawn) {
    ShadowState now = before;
    drawn.clear();
    for (const Reach reach : {Reach::near, Reach::far})
        complete(reach, wanted[static_cast<size_t>(reach)].now, now, drawn);
    for (const Reach reach : {Reach::near, Reach::far})
        go_ahead(reach, wanted[static_cast<size_t>(reach)], !drawn.empty(), now, drawn);
    return now;
}

TexelRect rows_of(const ShadowSlices& slices, uint32_t resolution) {
    const uint32_t top = resolution * slices.first / k_shadow_slices,
                   bottom = resolution * (slices.first + slices.count) / k_shadow_slices;
    return {0, top, resolution, bottom - top};
}

ShadowBox part_of(const ShadowBox& box, const TexelRect& rows, uint32_t resolution) {
    const float edge = static_cast<float>(resolution), scale = edge / static_cast<float>(rows.height);
    ShadowBox part = box;
    for (int column = 0; column < 4; ++column) part.map_from_world[column].y *= scale;
    part.map_from_world[3].y -= static_cast<float>(rows.y) / edge * scale;
    return part;
}

}  // namespace flaneur
