// Walking on a compound with any up, after "Lovers in a Dangerous Spacetime DevLog #7: Learning How to Walk"
// (A. Winkels, 2014): two rays down along the walker's own up, one ahead of it and one behind; the mean of
// the points and of the normals that they meet places and turns it, by so much a tick at most; a short ray
// ahead that meets something takes the place of the front one, so that concave corners are climbed.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/surface/leap.h"

namespace flaneur {

// What one walker's rays met in the last tick: 0 ahead of it, 1 behind.
struct SurfaceProbe {
    struct Side {
        Vec3 from, to;       // the ray
        Vec3 point, normal;  // what it met, if it did
        bool is_hit = false;
        bool is_level = false;  // the ray ahead took the place of the one down
    } sides[2];
    Vec3 point, normal;  // means of what was met
};

// What others go by of one, as it was when the tick began.
struct SurfaceSeen {
    Vec3 position, up, velocity;
    float radius = 0;
    uint32_t walker = 0;
};

// Structure of arrays, index = walker.
struct SurfaceWalkers {
    std::vector<Vec3> position;    // on the surface, between the feet
    std::vector<Vec3> up, ahead;   // unit, square to each other
    std::vector<float> speed;      // what it likes, metres a second
    std::vector<float> pace;       // what it has come to, from standing
    std::vector<float> turn_rate;  // about its up, radians a second, in the last tick
    std::vector<float> moved;      // metres along the surface in the last tick
    std::vector<float> radius;     // of the body, metres
    std::vector<SurfaceProbe> probes;
    std::vector<Leap> leaps;
    std::vector<float> middle;           // of the body over its feet, metres
    std::vector<uint8_t> leaps_at_will;  // 1: by itself, where another body is overhead
    std::vector<uint8_t> stands;         // 1: all of its feet are down and at rest, as its body has it
    std::vector<Vec3> wish;              // m/s, of the one that is led by hand
    uint32_t led = k_nobody_led;         // which that is
    std::vector<SurfaceSeen> seen;       // by x; see look_round()
    float widest = 0;                    // radius of any, metres

    static constexpr uint32_t k_nobody_led = 0xffffffffu;
};

// Sets `count` walkers down where rays towards the compound's parts from random directions first meet it.
// Fewer where rays meet nothing, or where there is no room beside those before. `speed` is what each likes,
// and `radius` how wide it is; as many.
SurfaceWalkers place_on_surface(const Compound& compound, const std::vector<float>& speed,
                                const std::vector<float>& radius, uint64_t seed);

// Before a tick: what all will see of each other in it. Who leaps is seen where it will land, and until it
// has left where it stands too.
void look_round(SurfaceWalkers& walkers);

// One tick of `dt` seconds for walkers [begin, end): each strolls ahead, bending its way a little now to one
// side, now to the other; whom it would come too near to within some seconds it turns away from, to its right
// where that is all one, and it brakes behind whom it cannot get round. Of others it reads `seen` alone. Who
// is led goes where its wish leads. Who gathers for a leap stops, and who is in one stays where it is: see
// leaps.h.
void walk_on_surface(const Compound& compound, SurfaceWalkers& walkers, size_t begin, size_t end,
                     uint64_t seed, uint32_t tick, float dt);

// The rotation that takes +y to `up` and +z to `ahead`, unit and square to each other.
Quat frame_of(Vec3 up, Vec3 ahead);

// From one unit vector towards another, by `most` radians at most.
Vec3 turned_towards(Vec3 from, Vec3 to, float most);

}  // namespace flaneur
