// Where those of a group are to each other. Private to sim/company.
#pragma once

#include <array>

#include "sim/company/company.h"

namespace flaneur {

// Of each member, metres to the left of and ahead of who leads.
struct Shape {
    std::array<Vec2, k_most_company> at{};  // x: left, z: ahead
    float left = 0, right = 0;              // of the outermost of them
};
// Who walks. Abreast 0.75 m apart (0.7-0.8: Moussaid 2010), less beside a child whose hand is held; the
// middle of three 0.3 m behind, the inner two of four 0.35 m; one behind the other 0.95 m apart.
Shape walking_shape(const Group& group, std::span<const Bearing> bearings, float narrow, bool mirrored);

// Who stands round a middle: places on the ground plane, the leader's first.
struct Circle {
    Vec2 middle{};
    std::array<Vec2, k_most_company> at{};  // by member
};
// `way`: unit, from who leads to the middle. 0.85 to 0.95 m apart (0.6-1.2: Kendon 1990, Hall 1966). Of two,
// one in three stands at a right angle to the other.
Circle ring_of(const Group& group, const Crowd& crowd, Vec2 way, bool at_right_angle);

}  // namespace flaneur
