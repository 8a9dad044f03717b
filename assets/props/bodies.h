// The shapes that bodies of vehicles are made of. Private to assets/props.
#pragma once

#include <span>

#include "assets/props/vehicles.h"

namespace flaneur {

// Of a skin round a body, from the end to the front: half widths and heights of the sills, the shoulders and
// the roof, metres.
struct BodySection {
    float z, foot, half_foot, shoulder, half, top, half_top;
};
void add_skin(PropMesh& mesh, std::span<const BodySection> sections, PropPart part);
// A pane or lamp on both sides at half width `x`, `top_x` above, from z0 to z1 and y0 to y1.
void add_on_side(PropMesh& mesh, float x, float top_x, float z0, float z1, float y0, float y1, PropPart part);
// The same across the front or the end, from half width `x`.
void add_across(PropMesh& mesh, float x, float y0, float z0, float y1, float z1, bool front, PropPart part);

// A section of a tram, without its wheels.
void add_tram(PropMesh& mesh, VehicleModel model);

}  // namespace flaneur
