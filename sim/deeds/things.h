// What hands find in a yard: parcels and where they lie, doors, low walls. Places are in the world, metres;
// headings are yaws about +y, 0 faces +z.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// A box that two hands lift by its sides.
struct Parcel {
    Vec3 half{0.18f, 0.14f, 0.14f};  // half its width, height and depth, as who holds it has them
    float mass = 2;                  // kilograms
    uint32_t shelf = 0;              // where it lies at first
};

// A place where one parcel lies, or none: on a table, on the ground.
struct Shelf {
    Vec2 at;            // of its edge, in the middle
    float top = 0;      // of what the parcel lies on
    float heading = 0;  // of one who stands before it
    float inset = 0;    // from the edge to the near side of the parcel
};

// A door, closed, whose leaf turns about its hinge away from one who goes along its heading.
struct SwingDoor {
    Vec2 hinge;
    float floor = 0;
    float heading = 0;
    bool hinge_left = false;              // of one who goes along the heading
    float width = 0.95f, height = 2.05f;  // of the leaf
    float thick = 0.05f;
};
// Of handles, which are levers that point to the hinge: from the hinge, over the floor, along the leaf from
// where they turn to the middle of the hand, and out of the leaf's face.
inline constexpr float k_handle_from_edge = 0.07f, k_handle_high = 1.03f, k_lever = 0.085f,
                       k_lever_out = 0.055f;
inline constexpr float k_lever_thick = 0.011f;  // half of it
inline constexpr float k_lever_down = 0.6f;     // radians that it turns

// A wall over which one climbs, along its heading and back.
struct LowWall {
    Vec2 at;  // the middle of its length and thickness
    float floor = 0;
    float heading = 0;  // square to it
    float height = 0.8f, thick = 0.26f, half_long = 1;
};

struct Things {
    std::vector<Parcel> parcels;
    std::vector<Shelf> shelves;
    std::vector<SwingDoor> doors;
    std::vector<LowWall> walls;
};

// Where they are.
struct ParcelNow {
    Vec3 place;  // of its middle
    Quat turn;
    uint32_t shelf = 0;  // where it lies or last lay
};
struct LeafNow {
    float angle = 0, speed = 0;  // of the leaf, 0 closed, radians, and a second
    float lever = 0;             // of both its handles, 0 level, radians
    float waits = 0;             // seconds until the closer begins
};

// The leaf's yaw: what takes +x, from the hinge to the edge, and +z, along its heading of one who opens it,
// with +x to the left of that where the hinge is on the right.
float leaf_yaw(const SwingDoor& door, float angle);
// A place of the leaf: metres from the hinge, over the floor, and out of its middle towards where it opens
// to.
Vec3 on_leaf(const SwingDoor& door, float angle, Vec3 own);
// The middle of the lever that a hand lies on, on the side of one who pushes, or on the other one.
Vec3 handle_of(const SwingDoor& door, const LeafNow& now, bool pushes);
// A tick of a leaf that nobody holds: it goes on as it was let go, then a closer takes it back.
void step_closer(LeafNow& now, float dt);

}  // namespace flaneur
