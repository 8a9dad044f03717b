// The platform that people stagger on is changed while they walk: its outline, by a panel or corner by
// corner.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/window/change/design.h"

namespace flaneur {

struct Mouse;
struct Show;
struct Viewer;

// What can be done now for an outline that is wanted. Ground grows before anybody goes onto what is new of
// it, circles keep to the outline as soon as there is ground under all of it, and ground goes once nobody
// stands on it any more.
struct PlatformStep {
    bool is_for_circles = false;  // see change_platform() in sim/world.h
    std::vector<Vec2> ground;     // the outline that the ground is to have; none: as it is
    uint32_t off = 0;             // how many are not on the wanted outline yet
};
PlatformStep next_step(const World& world, const std::vector<Vec2>& ground, const std::vector<Vec2>& wanted);

// Whether all of them are on that mesh, to a few millimetres: where it ends nobody then goes beyond it.
bool holds_everybody(const World& world, Navmesh& mesh);

// A convex outline about two others, of k_platform_edges corners at most.
std::vector<Vec2> outline_about(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

// Around its middle: `size` times as large, and turned by `turn` radians, clockwise seen from above.
std::vector<Vec2> turned_outline(const std::vector<Vec2>& outline, float size, float turn);
// With so many corners, all alike, and as much area.
std::vector<Vec2> even_outline(const std::vector<Vec2>& outline, int corners);
// Why people like these cannot stagger on it; "": they can.
std::string why_not(const World& world, const std::vector<Vec2>& outline);

// In the room Change; nothing where people are on no platform.
void lay_out_platform(const Show& show, Viewer& viewer, float scale);
// How drunk those are who stagger; nothing where nobody does.
void lay_out_drink(Show& show, Viewer& viewer, float scale);
// The left button drags a corner, if it is on one. Whether it does; `place` is the ground below the pointer.
bool take_corner(const Show& show, const Mouse& before, const Mouse& now, std::optional<Vec3> place,
                 Viewer& viewer);
void mark_platform(const Viewer& viewer, std::vector<GizmoLine>& lines);

}  // namespace flaneur
