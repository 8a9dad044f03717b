// Two shoes: where one stands or goes, the other does not.
#pragma once

#include "sim/gait/footing.h"

namespace flaneur {

// Metres between the middle lines of two.
float room_between(const FootPlace& a, const FootPlace& b, const FootSize& size);

// Moves a landing until the shoe there does not stand on that which is `there`: by as little as that takes,
// 0.3 m at most, and never away from its own side, `outward` (unit).
void keep_shoes_apart(FootPlace& landing, const FootPlace& there, const FootSize& size, Vec2 outward);

// Whether a foot that turns on the ground from one place to another comes onto the shoe `there`.
bool turns_onto(const FootPlace& from, const FootPlace& to, const FootPlace& there, const FootSize& size);

// Metres to its own side (`outward`, +1: left, -1: right), 0.26 at most, by which a foot that swings from one
// place to another has to go round the shoe `there` and its leg: FootBlock::round.
float way_round(const FootPlace& from, const FootPlace& to, const FootPlace& there, const FootSize& size,
                float outward);

}  // namespace flaneur
