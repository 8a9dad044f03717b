// Those whose way leads over a crossing with a lamp: who waits at its kerb, where, and when each goes.
//
// While it is red, or too late to get over, people stand by the kerb in rows, 0.45 m from it, then 0.55 m
// farther, each 0.8 m from those beside (0.6 to 0.9: Fruin 1971), and face the other side. After the lamp
// has turned green they start in 0.3 to 2.6 s, old people in 1.9 to 2.5 (Knoblauch, Pietrucha & Nitzburg
// 1996), and cross a little faster than they walk elsewhere; who has not got over as time runs out hurries.
// Some go on red. A walker's decisions write what is its own; who gets which place is settled one after the
// other. Nothing of it is there in a crowd without such crossings.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/base/vec.h"
#include "sim/lamps/crossings.h"
#include "sim/navigation/navmesh.h"

namespace flaneur {

inline constexpr uint32_t k_no_kerb = ~0u, k_no_spot = ~0u;
inline constexpr float k_usual_jaywalkers = 0.1f;
inline constexpr float k_kerb_margin = 1.5f;  // metres beside a crossing where its lamp is still minded

// The crossings of a city, and where people wait for them.
struct KerbMap {
    struct Spot {
        Vec2 at;
        float back = 0, aside = 0;  // metres behind the kerb and along it
    };
    Crossings crossings;
    CrossingGrid grid;
    std::vector<uint32_t> first;  // by kerb, and one more: its spots are [first[k], first[k + 1]), at most 64
    std::vector<Spot> spots;
};
// Spots are where people can stand on the mesh, on pavements.
KerbMap make_kerb_map(Crossings crossings, const Navmesh& mesh);

// One who waits, or is about to.
struct KerbWait {
    uint32_t kerb = k_no_kerb;
    uint32_t spot = k_no_spot;  // of that kerb; none where all are taken
    uint32_t since = 0;         // tick
    Vec2 to{};                  // where it stands
};

// How one minds lamps.
struct LampManner {
    float jaywalks = 0;                             // how likely it goes on red, each time
    float starts_least = 0.3f, starts_most = 2.6f;  // seconds after green
};
// Of a middle one of those years and that much drink, 0..1, among whom the `share` of all goes on red.
LampManner lamp_manner(float age, float drunk, float conscientiousness, float share);

// Who asks for a place there.
struct KerbAsk {
    uint32_t kerb = k_no_kerb;
    float aside = 0;  // metres along it, where its way leads
    Vec2 at{};        // where it is
    float ahead = 0;  // see PathGoer
};

struct Kerbs {
    std::shared_ptr<const KerbMap> map;  // null: nobody minds lamps
    std::vector<KerbWait> waits;         // by walker, as all that follows; empty without a map
    std::vector<LampManner> manners;
    std::vector<KerbAsk> asks;     // of this tick
    std::vector<uint32_t> asking;  // who they are
    std::vector<uint64_t> taken;   // by kerb, of spots
};
inline bool minds_lamps(const Kerbs& kerbs) { return kerbs.map != nullptr; }
inline bool waits_at_kerb(const Kerbs& kerbs, uint32_t walker) {
    return minds_lamps(kerbs) && kerbs.waits[walker].kerb != k_no_kerb;
}

// From now on so many walkers may mind lamps; with no map, none. Allocates.
void mind_lamps(Kerbs& kerbs, std::shared_ptr<const KerbMap> map, uint32_t capacity);

// One who goes along a path.
struct PathGoer {
    Vec3 at;                     // on the ground
    Vec2 velocity;               // m/s
    std::span<const Vec3> path;  // its corners ahead
    float usual = 1.34f;         // m/s that it likes to go
    float ahead = 0;             // metres that what it pushes is before it
    uint32_t trip = 0;           // how many goals it has had
};

// What one who goes along its path does about lamps.
struct Heed {
    bool waits = false;   // and goes with `wanted` instead of along the path,
    bool stands = false;  // or has come to where it stands
    Vec2 wanted{};        // m/s
    float pace = 1;       // times the speed at which it goes along the path
};
Heed heed_lamp(Kerbs& kerbs, uint32_t walker, const PathGoer& goer, uint32_t tick, uint64_t seed);
// It waits no longer.
inline void leave_kerb(Kerbs& kerbs, uint32_t walker) {
    kerbs.waits[walker] = {};
    kerbs.asks[walker] = {};
}
// After all of the first `count` have decided: places for those who have come to a kerb.
void give_spots(Kerbs& kerbs, uint32_t count, uint32_t tick);

// Where one who waits looks: over the carriageway.
inline Vec2 faces_over(const Kerbs& kerbs, uint32_t walker) {
    const uint32_t kerb = kerbs.waits[walker].kerb;
    return way_over(kerbs.map->crossings.all[kerb / 2], kerb);
}
inline const LampPlan& plan_of(const KerbMap& map, uint32_t kerb) {
    return map.crossings.plans[map.crossings.all[kerb / 2].plan];
}

}  // namespace flaneur
