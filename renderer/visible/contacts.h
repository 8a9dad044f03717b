// Where people darken the ground that they stand on.
#pragma once

#include "renderer/visible/cull.h"

namespace flaneur {

// Bodies whose spheres are so many pixels or less leave no spots on the ground.
inline constexpr float k_least_contact = 32;

// A soft dark spot on the ground, as contact.vert takes it.
struct Contact {
    glm::vec3 place;
    float radius, strength;
};

// Spots under the feet of those walkers that the view sees finely enough, and a wider one under each body;
// not where walls hide them.
void find_contacts(const CrowdInput& input, std::span<const JointTransform> palette, const View& view,
                   std::vector<Contact>& contacts);

}  // namespace flaneur
