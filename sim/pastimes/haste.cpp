// Who hurries goes at some 1.6 to 1.7 m/s, as people do to work, who strolls at 1.0 (Fruin, "Pedestrian
// Planning and Design", 1971; Weidmann, "Transporttechnik der Fussgaenger", 1993: 1.49 to work, 1.16 to
// shops, 1.10 at leisure).
#include "sim/pastimes/haste.h"

#include <algorithm>

#include "sim/base/rng.h"
#include "sim/base/spans.h"

namespace flaneur {

namespace {

constexpr float k_hurries = 1.25f, k_strolls = 0.76f, k_runs = 2.7f;  // of the usual speed; m/s

// It is on its way to a stop, near enough to get the bus that is there, or comes.
bool runs_for_bus(const PastimeTick& t, uint32_t i, RandomKey key) {
    constexpr float k_nearest = 3, k_farthest = 45, k_would = 0.8f;  // metres; of those who can
    constexpr float k_youngest = 11, k_oldest = 62;                  // years
    const Journey& j = t.crowd.journeys[i];
    if (!j.leaves || j.arrived) return false;
    const Vec3 stop = j.goal.position, at = t.crowd.motion.position[i];
    const float far = length(on_ground(stop - at));
    if (far < k_nearest || far > k_farthest || random_unit(key, 72) > k_would) return false;
    const float age = t.age_of(t.world, i);
    return age >= k_youngest && age <= k_oldest && t.is_bus_near(t.world, stop);
}

}  // namespace

Haste haste_of(const PastimeTick& t, uint32_t i) {
    const PastimeShares& shares = t.pastimes.shares;
    if (shares.hurrying <= 0 && shares.strolling <= 0) return Haste::usual;
    const RandomKey key{t.seed, i, t.crowd.journeys[i].trip, Purpose::pastime};
    const bool is_slow = own_of(t.gait.canes, i) || t.crowd.identity.ahead[i] > 0;
    if (!is_slow && shares.hurrying > 0 && runs_for_bus(t, i, key)) return Haste::runs;
    const float u = random_unit(key, 70);
    if (u < shares.hurrying) return is_slow ? Haste::usual : Haste::hurries;
    return u > 1 - shares.strolling ? Haste::strolls : Haste::usual;
}

float pace_of(Haste haste, float usual) {
    switch (haste) {
        case Haste::strolls:
            return k_strolls;
        case Haste::hurries:
            return k_hurries;
        case Haste::runs:
            return std::max(k_runs / usual, 1.0f);
        default:
            return 1;
    }
}

}  // namespace flaneur
