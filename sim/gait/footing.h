// Where a foot can stand on the real ground.
#pragma once

#include "sim/base/vec.h"
#include "sim/gait/gait.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// Where one foot stands; see FootPlaces.
struct FootPlace {
    Vec3 position;
    float yaw = 0;
    Vec3 normal{0, 1, 0};
};

FootPlace get_place(const FootPlaces& from, int lane);
void set_place(FootPlaces& to, int lane, const FootPlace& p);

// The height at `at` of the plane on which a foot stands there.
float height_on(const FootPlaces& foot, int lane, Vec2 at);

// Along the foot from the ground point below the ankle: heel behind it, ball and tip of the toes ahead.
struct FootSize {
    float heel, ball, tip;
};
FootSize foot_size(const PersonBlock& person, int lane);

// What a step can reach without a jump, metres above and below the foot that carries.
inline constexpr float k_step_up = 0.45f, k_step_down = 0.8f;

struct Footing {
    FootPlace place;
    bool found = false;    // else no ground within k_step_up and k_step_down is below its ball
    bool whole = false;    // one surface carries the whole sole
    bool stepped = false;  // an edge of a kerb or step lies near
};
// A place near `wanted` where a whole foot finds one surface: off an edge that runs along it, by 0.12 m
// outward
// (+1: to the left of where it points, -1: to its right) or 0.06 inward, or else shifted along the foot by
// 0.22 m at most to keep off an edge; and by 0.03 more from what rises just behind it or before it, and by
// half a sole's width, 0.045 m, from an edge beside it. On a tread too short for the foot, the one that ends
// highest: the heel or the toes hang over.
Footing find_footing(const Surroundings& around, const FootPlace& wanted, const FootSize& size,
                     float outward);

// Whether a step or kerb rises where the heel or the toes of a foot at `place` are.
bool meets_edge(const Surroundings& around, const FootPlace& place, const FootSize& size);

// Whether the tip of a foot at `place` has ground below it at such a height.
bool bears_tip(const Surroundings& around, const FootPlace& place, const FootSize& size, float height);

// Metres by which a foot at `to` stands above the slope of the ground at `from`.
float step_between(const FootPlace& from, const FootPlace& to);

// `down`, a footing below the one before, moved along `direction` until its heel stands well clear of the
// edge that it passes, if the ground there lets it.
Footing clear_of_edge(const Surroundings& around, const Footing& down, Vec2 direction, const FootSize& size,
                      float outward);

// How a swing keeps clear of the ground.
struct Clearing {
    float obstacle = 0;  // metres that it has to rise above the way that the pose gives it, at most 0.35
    float edge = 0;      // see FootBlock
};
// So that neither toes nor heel meet the ground between two places. `running` and `pace` as in GaitBlock;
// small children climb `slowly`.
Clearing clear_ground(const Surroundings& around, const FootPlace& from, const FootPlace& to,
                      const FootSize& size, float running, float pace, bool slowly = false);

// The first level after the one at `from`, along `direction`, unit, and `aside` metres to the left of there,
// which begins and ends within `reach` metres: distances of its edges from `from` along `direction`. Empty
// (begin == end) where the ground ahead has fewer than two edges, and all 0 where it has none.
struct Tread {
    float level = 0;  // where the ground as high as `from` begins, a quarter of a metre behind it at most
    float begin = 0, end = 0;
    float height = 0;   // metres, in the world, just beyond its first edge
    bool down = false;  // it lies lower than `from`
};
Tread next_tread(const Surroundings& around, Vec3 from, Vec2 direction, float aside, float reach);

// The first ground ahead after a gap, or on a ledge too high to step on: metres along
// `direction`, unit, and its height. Distance 0: there is nothing to jump to, or nothing to jump over.
struct FarSide {
    float distance = 0, height = 0;
};
FarSide far_side(const Surroundings& around, Vec3 from, Vec2 direction, float reach);

}  // namespace flaneur
