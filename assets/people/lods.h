// Levels of detail of the built-in people, and what those of others take from them.
#pragma once

#include <vector>

#include "assets/character.h"
#include "assets/people/face.h"
#include "assets/people/pram.h"

namespace flaneur {

// What coarse levels are made of.
struct Unpainted {
    std::vector<uint32_t> triangles;  // the finest without glasses and what is painted on the face
    std::vector<uint32_t> glasses;    // whole on the first of them
    std::vector<FacePatch> face, face_with_glasses;
    PramLevels pram;  // laid on each level
};

// Appends the levels after the first to a built-in person: about 3000, 1500, 500 and 180 triangles, skipping
// those that would not be coarser than the one before; then orders them. What is painted on the face is laid
// on all but the last.
void build_person_lods(Character& person, const Unpainted& unpainted);

// Places of the vertices as a simplifier should measure errors: the head twice as large, for the eye goes
// there, and elbows and knees bent, so that no straight limb loses the vertices that bend it.
std::vector<Vec3> weighed_places(const Character& character);

// Orders indices and vertices for the vertex cache; vertices that no level uses go.
void order_levels(Character& character);

}  // namespace flaneur
