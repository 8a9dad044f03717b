// Where a foot that is wanted somewhere finds ground: the ray, a whole sole, and the nearest place that legs
// reach.
#pragma once

#include <optional>
#include <span>

#include "sim/gait/footing.h"
#include "sim/stepper/stepper.h"

namespace flaneur {

struct StandingOn {
    const MovingGround& ground;
    const Surroundings& around;  // of it
    uint32_t tick;               // that the movers' places are after
};

// A foot that looks for a place.
struct Seeker {
    Side side = k_left;
    float leg = 0.9f;  // metres
    FootSize size{};
    Vec2 ahead{}, facing{};  // where it is led, and where the body faces; unit
    Foothold at{};           // where it stands, in the world
    // The other foot: own is in its mover's frame, now is in the world.
    Foothold other{}, other_now{};
    bool has_other = true;  // else nobody stands yet
    // Where feet of others stand or are about to, three each, those of `own` among them.
    std::span<const Vec2> others;
    size_t own = 0;
    bool is_flat = false;  // feet may stand side by side in one place
    float apart = 0.36f;   // metres that it keeps from feet of others
    bool gathers = false;  // it may come down wherever it is, if only beside the other
};

// What stands at a place, in the frame of what bears it there.
Foothold bound(const StandingOn& on, const FootPlace& place);

// Where a ray down meets what one walks on, no farther up or down from `height` than legs step; the highest
// that it meets, or else the highest within a step.
std::optional<Vec3> ray_down(const StandingOn& on, Vec2 at, float height, float leg);

// Whether what bears two feet, in their movers' frames, parts within a second, or has parted too far.
bool are_parting(const StandingOn& on, const Foothold& a, const Foothold& b, float leg);

// A place at `wanted`, or the nearest to it that a whole sole finds; within reach of the other foot, apart
// from it, farther ahead than the foot stands, and on nothing that leaves within 1.5 seconds.
std::optional<Foothold> foothold_at(const StandingOn& on, const Seeker& who, Vec3 wanted, float yaw);
std::optional<Foothold> foothold_near(const StandingOn& on, const Seeker& who, Vec2 wanted, float yaw);

}  // namespace flaneur
