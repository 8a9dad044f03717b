// Whether a level of detail may stand for the finest: both are drawn as large as the level ever is, from
// eight sides, at rest, in mid-stride and with arms raised, and compared.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/levels/raster.h"
#include "sim/base/levels.h"

namespace flaneur {

// Of the worst picture, or the first that is bad enough.
struct LevelDifference {
    float silhouette = 0;  // what one covers and the other does not, of what the finest covers
    // The mean distance of colours where both are, 0 equal .. 1 black against white, over squares of three
    // pixels: finer detail than that goes when colours are seen from afar.
    float colour = 0;
};

// What each level may differ by. Its own outline and patches are fewer pixels wide than those of the level
// before, so that the same part of a pixel is more of them: some 0.4 pixels along the outline.
inline constexpr std::array<LevelDifference, k_person_levels> k_most_difference = {
    {{0, 0}, {0.03f, 0.03f}, {0.05f, 0.04f}, {0.08f, 0.05f}, {0.12f, 0.06f}}};

bool is_within(const LevelDifference& d, int level);

// The finest level of one character in all pictures.
struct LevelGate {
    static constexpr int k_sides = 8, k_poses = 3;
    std::array<PosedMesh, k_poses> poses;
    std::array<SideView, k_poses> views;
    std::vector<SidePicture> pictures;  // k_sides for each pose
};

LevelGate make_gate(const Character& c);

// How large the body is, in pixels, where level 1, 2 .. k_person_levels - 1 is seen from nearest.
float pixels_of_level(int level);

// Of these triangles over c.vertices, which may have grown since the gate was made, as level 1, 2 ... Looks
// no further than the first picture in which they differ by too much.
LevelDifference difference_of(LevelGate& gate, const Character& c, std::span<const uint32_t> triangles,
                              int level);

}  // namespace flaneur
