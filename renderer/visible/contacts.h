// Where people darken the ground that they stand on.
#pragma once

#include "renderer/visible/cull.h"

namespace flaneur {

// Bodies whose spheres are so many pixels or less leave no spots on the ground.
inline constexpr float k_least_contact = 32;

// A soft dark disc on the ground, as contact.vert takes it.
struct Contact {
    glm::vec3 place;  // metres
    float radius;
    glm::vec3 normal;  // of the ground, unit
    float strength;
};
static_assert(sizeof(Contact) == 32);  // as pipelines.cpp has it

// Spots under the feet of those walkers that the view sees finely enough, the fainter the higher a foot is
// above its ground, and wider ones under each body and pram; not where walls hide them. `grounds` as
// FrameInput's.
void find_contacts(const CrowdInput& input, std::span<const JointTransform> palette,
                   std::span<const GroundBelow> grounds, const View& view, std::vector<Contact>& contacts);

}  // namespace flaneur
