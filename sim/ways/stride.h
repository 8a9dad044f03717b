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
};
inline float least_circle(const Strider& who) { return who.speed / who.turns; }

// Where one is: on a circle, seen from its middle.
struct Stride {
    Vec2 centre;
    float radius = 0;      // metres
    float heading = 0;     // yaw as in WalkerMotion: the way that it goes
    float side = 1;        // +1: the middle is to the right, -1: to the left
    float left = 0;        // seconds until the next circle
    uint32_t circles = 0;  // so far
};
Vec2 place_of(const Stride& stride);

// The largest radius of a circle through `place` that has its middle `side` of the way with that heading, and
// lies on the platform with a body of `radius` all along: the least, over edges, of (d - radius) / (1 + side
// n.r), with d metres to the edge, n its outward normal and r the way's right; infinite where only edges
// bound it that it leaves. Less than 0 where the body is not on the platform.
float largest_circle(const Platform& platform, Vec2 place, float heading, float side, float radius);

// Whether all of its circle lies on the platform.
bool is_on(const Platform& platform, const Strider& who, const Stride& stride);

// On the platform at `place` or as near as there is room to turn, on its first circle. None where the
// platform is too small to turn on.
std::optional<Stride> begin_stride(const Platform& platform, const Strider& who, Vec2 place, float heading,
                                   RandomKey key);

// `seconds` later: on along the circle, onto the next one when its time has come: with a radius in (0,
// largest], for a time in (0, 10] s, whatever the other is. Where there is no room for the narrowest on the
// other side it stays on its own. A circle that the platform, which may have changed, does not hold any more
// ends at once; who has no room there to turn to either side is carried by it to where there is. False, and
// nothing happens, where there is none.
bool advance_stride(const Platform& platform, const Strider& who, Stride& stride, float seconds,
                    RandomKey key);

// The next circle from where one is now: `advance_stride` calls it. False where there is room for none on
// that side.
bool turn_to(const Platform& platform, const Strider& who, Stride& stride, float side, RandomKey key);

}  // namespace flaneur
