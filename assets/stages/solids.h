// Upright solids as scenery. Private to assets/stages.
#pragma once

#include <span>
#include <vector>

#include "assets/city.h"

namespace flaneur {

// Four corners counter-clockwise from outside.
void add_quad(Scenery& scenery, std::span<const Vec3, 4> corners, uint32_t colour, SceneryUse use);

// The sides of an upright prism, whose outline goes round so that its inside is where +z is of one who goes
// along +x, in courses of stone from `top` down to `bottom`; where it is `round`, their normals go over into
// each other.
void add_courses(Scenery& scenery, std::span<const Vec2> outline, float bottom, float top, uint32_t colour,
                 SceneryUse use, bool round = false);
// A box, with its top.
std::vector<Vec2> box_outline(Vec2 low, Vec2 high);
void add_block(Scenery& scenery, Vec2 low, Vec2 high, float bottom, float top, uint32_t colour,
               SceneryUse use);
// A prism's top.
void add_lid(Scenery& scenery, std::span<const Vec2> outline, float height, uint32_t colour, SceneryUse use);

}  // namespace flaneur
