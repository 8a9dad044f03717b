// One who falls: what its muscles try meanwhile, what its body meets, and when it has come to rest.
#pragma once

#include "sim/fall/body_pose.h"
#include "sim/fall/tumble.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// Begins a fall in the direction `to`, unit: feet are caught, and the body goes on over them, turning as a
// whole, fast enough for the extrapolated centre of mass (Hof, Gazendam & Sinke 2005) to come to rest beyond
// them.
void topple(TumbleBlock& block, int lane, const Segments& segments, Vec2 to);

// What muscles do `seconds` after a fall in the direction `to` (unit, on the ground plane) began. At first
// the body stays as stiff as it stood, `stood` by segment against what carries it, and topples over its feet;
// then arms go where the ground comes from, and, once it leans, knees give way and the head draws back from
// it (Hsiao & Robinovitch, "Common protective movements govern unexpected falls from standing height",
// Journal of Biomechanics 31, 1998); and `lain` seconds after the trunk has come down all goes slack.
void aim_fall(TumbleAims& aims, int lane, const TumbleBlock& block,
              const std::array<Quat, k_segment_count>& stood, Vec2 to, float seconds, float lain);
// Each segment of the lane against what carries it, as it is.
std::array<Quat, k_segment_count> turns_of(const TumbleBlock& block, int lane);

// What balls of the lane are near: the ground below and about them, and walls. `floor` is the height of the
// ground where there is none.
void find_planes(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
                 Vec3 origin, const Surroundings& around, float floor);

// Where it cannot be followed: its trunk comes no more than an arm's width farther `out`, unit, than the
// place, and its limbs little more, as if a low wall stood there; of two walls a ball meets the nearer one.
void hold_back(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
               Vec3 origin, Vec2 place, Vec2 out);

// The fastest that anything of the lane moves, m/s.
float liveliness(const TumbleBlock& block, const TumbleShapes& shapes, int lane);

// Whether the trunk or the skull touches the ground of the planes.
bool is_down(const TumbleBlock& block, const TumbleShapes& shapes, const TumblePlanes& planes, int lane);

}  // namespace flaneur
