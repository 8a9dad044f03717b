// Walking about on foot, among the people.
#pragma once

#include <optional>

#include "sim/world.h"
#include "tools/flaneur/view/rig.h"
#include "tools/flaneur/window/cameras/steering.h"

namespace flaneur {

struct Stroll {
    NavPoint at;    // on the ground
    Vec2 velocity;  // metres a second
    Spring height;  // of the eye, metres
    float yaw = 0, pitch = 0;
};
inline constexpr float k_walking_eye = 1.6f;  // metres above the ground

// Below the eye, where that is near the ground, or else at what it looks at. None where there is no ground to
// walk on.
std::optional<Stroll> set_foot(const World& world, const Camera& camera);

// Where the hands want, as far as walls and props let one; kerbs, steps and slopes are walked. Tells whether
// anything moved.
bool walk(const World& world, const Steering& hands, float seconds, Stroll& walk);

Gaze gaze_of(const Stroll& walk, float fov);

}  // namespace flaneur
