// Prams (pushchairs), that a few walkers push ahead of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/base/spans.h"
#include "sim/base/vec.h"
#include "sim/body/pram.h"

namespace flaneur {

struct Gait;
struct Stepper;

// Where a pram stands, in the world.
struct PramPlace {
    Vec3 place;                          // of the ground between the rear wheels
    float yaw = 0, pitch = 0, roll = 0;  // radians, of its way ahead, as headings; front up; left side up
    float wheel = 0;                     // radians that the rear wheels have turned, in [0, 2 pi)
};

// The pram of one walker.
struct Pram {
    uint32_t walker = 0;
    float scale = 1;
    Vec3 handle{};          // see Body::pram, in metres
    float aside = 0;        // radians that it faces aside from the body's heading,
    float aside_rate = 0;   // and a second
    float off = 0;          // metres that it would have to go to its left for the handle to be right ahead
    float slope = 0;        // its pitch, smoothed
    PramPlace now, before;  // after the last tick and the one before
};

// The axes of a pram.
Quat pram_rotation(const PramPlace& place);
// The middle of the handle, and of the hand on that side, 1 left, -1 right.
Vec3 pram_handle(const Pram& pram, const PramPlace& place, float side = 0);
// Between two ticks.
PramPlace mixed_place(const PramPlace& a, const PramPlace& b, float between);

// A tick for a walker's pram. Its handle keeps ahead of the body, and is never more than 0.04 m off that to a
// side. Within that the rear wheels only roll: it faces where the axle is to go, into a bend more than the
// body does, with a lag of some 0.2 s, and as the body does where that hardly moves. All wheels are on the
// ground that is there; over an edge, as high as a kerb, they rise before it and come down behind it within
// 0.35 m.
void advance_pram(Pram& pram, const Stepper& stepper);
// Gives one who stands a pram (see Body::pram), or takes away what it had where that is zero.
void give_pram(Gait& gait, size_t walker, Vec3 handle, float scale, const Stepper& stepper);
// The prams of walkers [begin, end), as indices of Gait::prams.
Span prams_of(const Gait& gait, size_t begin, size_t end);

}  // namespace flaneur
