// From one camera to another, in a short while, and over what is in between.
#pragma once

#include "renderer/scene.h"
#include "sim/world.h"

namespace flaneur {

struct Glide {
    Camera from, to;
    float passed = 1e9f;  // seconds since it began
    float rise = 0;       // metres over the straight way, in its middle
};
inline constexpr float k_glide_seconds = 0.6f;

inline bool is_gliding(const Glide& glide) { return glide.passed < k_glide_seconds; }
inline void end(Glide& glide) { glide.passed = 1e9f; }

// Over houses, if the straight way goes through some.
void begin(Glide& glide, const World& world, const Camera& from, const Camera& to);

// Where it is: leaves and arrives slowly, turns the shorter way round, and never rolls but between cameras
// of which one does not have +y up.
Camera camera_of(const Glide& glide);

}  // namespace flaneur
