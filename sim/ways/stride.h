// Never in a straight line: "Drunk Stride". One goes along circles, alternately to the right and to the left,
// for a random while along each, and each lies on the platform as a whole with all of who goes along it.
#pragma once

#include "sim/base/rng.h"
#include "sim/base/vec.h"
#include "sim/ways/platform.h"

namespace flaneur {

inline constexpr float k_longest_on_circle = 10;  // seconds

// What bounds one's circles.
struct Strider {
    float speed = 1;           // m/s, for ever
    float radius = 0.2f;       // of the body, metres
    float turns = 6.2831853f;  // radians a second, at most: no circle is narrower than speed / turns
    float goes_off = 0;        // metres that others and its legs may take it off a circle
};
inline float least_circle(const Strider& who) { return who.speed / who.turns; }
// Metres from the edge of a platform that all of its circles keep.
inline float kept_clear(const Strider& who) { return who.radius + who.goes_off; }
// And from there to the middle of the narrowest.
inline float room_to_turn(const Strider& who) { return least_circle(who) + kept_clear(who); }

// The circle that one goes along.
struct Stride {
    Vec2 centre;
    float radius = 0;      // metres
    float side = 1;        // +1: the middle is to the right, -1: to the left
    float left = 0;        // seconds until the next circle
    uint32_t circles = 0;  // so far
};

// Which way is to the right of one with that heading.
Vec2 right_of(float heading);

// The largest radius of a circle through `place` that has its middle `side` of the way with that heading, and
// lies on the platform with a body of `radius` all along: the least, over edges, of (d - radius) / (1 + side
// n.r), with d metres to the edge, n its outward normal and r the way's right; infinite where only edges
// bound it that it leaves. Less than 0 where the body is not on the platform.
float largest_circle(const Platform& platform, Vec2 place, float heading, float side, float radius);

// Whether all of its circle lies on the platform.
bool is_on(const Platform& platform, const Strider& who, const Stride& stride);
// Whether one at `place` goes along its circle, and has not been taken off it.
bool is_along(const Stride& stride, Vec2 place);

// Which way one goes on, a unit vector, who is at `place`, goes with that heading and has gone on for
// `seconds`: along its circle; where its time has come along the next one, with a radius in (0, largest], for
// a time in (0, 10] s, whatever the other is. Where there is no room for the narrowest on the other side it
// stays on its own. A circle that the platform, which may have changed, does not hold any more, or off which
// one has been taken, ends at once; who has no room there to turn to either side goes onto the narrowest
// where there is. (0, 0) where there is none.
Vec2 stride_on(const Platform& platform, const Strider& who, Stride& stride, Vec2 place, float heading,
               float seconds, RandomKey key);

}  // namespace flaneur
