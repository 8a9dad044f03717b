// A camera that goes along with somebody, or a creature, on small worlds, where up is not one way.
#pragma once

#include "renderer/scene.h"
#include "sim/world.h"

namespace flaneur {

// People by their numbers, then creatures.
inline uint32_t followed_count(const World& world) {
    return world.crowd.count + (world.roam ? static_cast<uint32_t>(world.roam->creatures.size()) : 0);
}

// How it is turned, which comes after whoever is followed slowly: who leaps from body to body does not whirl
// it about.
struct RoundRig {
    Vec3 place, up, ahead;  // of the one who is followed, smoothed
    float reach = 1;        // share of the distance that the rock leaves
    Camera before, now;     // at the last two ticks
};

// After a tick; `is_new`: at once where it belongs.
void follow_round(RoundRig& rig, const World& world, uint32_t who, bool is_new, float seconds);

// `share` 0 is before, and 1 now.
Camera camera_of(const RoundRig& rig, float share);

// Between two cameras of any up.
Camera mixed_camera(const Camera& from, const Camera& to, float share);

}  // namespace flaneur
