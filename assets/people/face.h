// What is painted on a face: exactly on the finest level of detail, and as patches of a few corners on
// coarser ones, whose triangles are too large to keep the borders of an eye.
#pragma once

#include <span>
#include <vector>

#include "assets/people/shape.h"

namespace flaneur {

// Of the materials that are painted on skin, at `face` (see to_face): how far outside of each it is, below
// the others' where it is seen.
void paint_face(const Figure& figure, Vec3 face, std::span<float> out);
bool is_painted(uint8_t material);

// One convex spot of colour as seen from ahead, in metres on the person at rest.
struct FacePatch {
    Tint tint = Tint::none;
    uint32_t colour = 0;
    int coat = 0;               // above how many others it lies
    std::vector<Vec3> outline;  // counter-clockwise from ahead
};
// With the rims of glasses, if they are painted too.
std::vector<FacePatch> face_patches(const Figure& figure, bool with_glasses);

// Lays the patches on the skin that a level shows ahead, piece by piece, in vertices of their own.
void lay_on(std::span<const FacePatch> patches, std::vector<uint32_t>& level, Character& person);

}  // namespace flaneur
