// The shadow maps of the city, near and far, from frame to frame. Which box a map is of depends on the view
// alone, so that pictures do not depend on the frames before; but a map that will soon be wanted is drawn
// ahead, a slice a frame, so that no frame takes much longer than others.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/light/shadow_tiles.h"

namespace flaneur {

enum class Reach : uint8_t { near, far };
inline constexpr size_t k_reaches = 2;
inline constexpr uint32_t k_shadow_slices = 8;  // bands of rows that a map is drawn in

// What one map holds.
struct HeldMap {
    ShadowBox box;        // of nothing at first
    uint32_t slices = 0;  // drawn, from the first row on
    ShadowTiles people;   // of a near one: where people's shadows lie on it
};
// Of each reach two: the one that is seen, and one to be drawn ahead.
struct ShadowState {
    std::array<std::array<HeldMap, 2>, k_reaches> maps;
    std::array<uint8_t, k_reaches> seen = {};  // which of the two
};

// Slices of a map, to be drawn.
struct ShadowSlices {
    Reach reach = Reach::near;
    uint8_t map = 0;  // of the two
    ShadowBox box;
    uint32_t first = 0, count = 0;
};

// The box that a slice of the view has, the next one that it will have if the view goes on moving as it did
// from the one before, and in how many frames: none, where it jumped, or stays in its box.
struct Wanted {
    ShadowBox now, next;
    uint32_t frames = 0;
};
Wanted wanted_box(const View& before, const View& now, glm::vec3 to_sun, Slice slice, uint32_t resolution);

// The state after a frame, and what is to be drawn for it: what is left of the maps that are wanted now and,
// in a frame that lacks nothing, a slice of one that will be, or several if time is short.
ShadowState next_shadows(const ShadowState& before, const std::array<Wanted, k_reaches>& wanted,
                         std::vector<ShadowSlices>& drawn);

// The rows of slices, of a map of so many texels along each edge.
TexelRect rows_of(const ShadowSlices& slices, uint32_t resolution);
// The part of a box that lies on them.
ShadowBox part_of(const ShadowBox& box, const TexelRect& rows, uint32_t resolution);

}  // namespace flaneur
