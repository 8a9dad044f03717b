// Where two surfaces of a drawn city lie in one plane, face the same way, look unlike and are seen from
// outside: as the camera moves, now the one is drawn there and now the other.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene.h"
#include "sim/base/vec.h"

namespace flaneur {

enum class Drawn : uint8_t { facade, wall, roof, ground };

// A pair of triangles that fight.
struct Fight {
    Drawn a, b;
    uint32_t a_house, b_house;  // of facades: CityVertex::house
    Vec3 at;                    // in the middle of what they share
    Vec3 out;                   // the way that both face
    float area = 0;             // of it, m^2
    float apart = 0;            // how far from plane to plane there, metres
};

// Depth is near / distance in floats, which tells apart a millionth of the distance; corners are rounded to a
// tenth of a millimetre a kilometre from the map's middle, and to a 256th of a pixel on the picture, 2 mm at
// 300 m. What lies k_apart or more behind another surface is never drawn before it at 300 m.
inline constexpr float k_apart = 0.004f;
// What is smaller is under a pixel from 5 m on.
inline constexpr float k_least_area = 0.001f, k_least_width = 0.005f;

// Props and scenery are left out, and the shades on the ground, which lie on it by intention.
std::vector<Fight> find_fights(const CityMesh& mesh);

// "3 pairs, 1.25 m2; facade-facade 2, 1.00 m2; ...", and the largest of them with their places.
std::string told(std::vector<Fight> fights, size_t most = 5);

}  // namespace flaneur
