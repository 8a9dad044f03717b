// Small pictures of a posed character, drawn on the CPU, to measure one mesh by another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// Where vertices are and which way they face, one for each of Character::vertices.
struct PosedMesh {
    std::vector<Vec3> places, normals;
};

// What is seen from one side, level and without perspective.
struct SideView {
    float sine = 0, cosine = 1;   // of the turn of the eye from +z towards +x
    float left = -1, bottom = 0;  // of the picture, metres to the right of the middle and above the ground
    float pixels_per_metre = 100;
    int width = 0, height = 0;
};

// RGBA, rows from the bottom; alpha is 255 where the character is and 0 where it is not.
struct SidePicture {
    std::vector<uint32_t> rgba;
    std::vector<float> nearness;  // scratch
};

// Only fronts are seen, counter-clockwise, and nothing of textures where alpha is below a half. The light
// comes from the eye, so that what faces elsewhere is darker.
void draw_side(const Character& c, const PosedMesh& mesh, std::span<const uint32_t> triangles,
               const SideView& view, SidePicture& picture);

}  // namespace flaneur
