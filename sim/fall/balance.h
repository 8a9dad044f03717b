// Being pushed, and staying on one's feet.
//
// Small shoves are answered at the ankle, middling ones by the trunk, larger ones by steps to where the body
// would come to rest over a foot, the extrapolated centre of mass x + v / sqrt(g / l) (Hof, Gazendam & Sinke,
// "The condition for dynamic stability", Journal of Biomechanics 38, 2005). Who would have to step farther or
// more quickly than legs can falls (Horak & Nashner, Journal of Neurophysiology 55, 1986; Pai & Patton,
// Journal of Biomechanics 30, 1997).
#pragma once

#include "sim/base/vec.h"

namespace flaneur {

// Who is pushed.
struct Sturdiness {
    float leg = 0.9f;      // metres
    float heading = 0;     // where the body faces
    float steadiness = 1;  // 1: a healthy adult; less of the old, the drunk, those taken by surprise
};

// Metres a second that a push may change somebody's speed by without felling him: 1.5 from behind, 1.05 from
// the front and 1.1 from a side, for legs of 0.9 m, as the root of their length. `along` is the way of the
// push, any length but 0.
float bearable_push(const Sturdiness& who, Vec2 along);

// No push of less changes anybody's speed enough to fell him, and any of more fells everybody, m/s.
inline constexpr float k_harmless_push = 0.3f, k_felling_push = 2.2f;

// How long one who will fall staggers before, seconds, when pushed by `times` what is bearable, 1 or more.
float staggers_for(float times);

// The sway of a trunk, along the world's axes, radians, as it answers a push, and how far arms go out with
// it.
struct TrunkSway {
    Vec2 lean{}, rate{};
    float arms = 0;
};
void shove(TrunkSway& sway, Vec2 change);  // of the body's speed, m/s
void advance(TrunkSway& sway, float dt);
// Whether nobody would see it any more.
bool is_over(const TrunkSway& sway);

}  // namespace flaneur
