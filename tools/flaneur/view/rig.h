// Cameras that go along with a walker: behind it, or where its eyes are. They are moved from tick to tick, so
// that neither steps nor turns jerk them; the same run of the same world moves them the same way.
#pragma once

#include <optional>

#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/view/round.h"

namespace flaneur {

// Where one looks from and whereto: headings as walkers have them, pitches up, radians.
struct Gaze {
    Vec3 eye;
    float yaw = 0, pitch = 0;
    float fov = 0;
};
// To a target one metre ahead.
Camera camera_of(const Gaze& gaze);
Gaze gaze_of(const Camera& camera);
// On the shorter way round; the lens by its size.
Gaze between(const Gaze& from, const Gaze& to, float share);

// A value that is drawn towards another without swinging, and how fast it changes.
struct Spring {
    float value = 0, speed = 0;
};
// So many seconds later; `stiffness` is the rate of a critically damped spring, 1/s: two thirds of the way
// take 2.3 / stiffness.
void draw_towards(Spring& spring, float wanted, float stiffness, float seconds);

struct CameraRig {
    CameraChoice choice;      // whom, and how: follow or eyes; else it does nothing
    uint32_t ticks = 0;       // since then
    uint32_t generation = 0;  // of the walker's slot
    bool is_left = false;     // by the walker, who is gone
    Gaze before, now;         // at the last two ticks
    bool is_round = false;    // on small worlds, of which it only follows:
    RoundRig round_rig;

    // follow
    Spring feet[3], heading;
    Spring round, lift;  // radians about the walker, and metres higher, than straight behind it
    float wanted_round = 0, wanted_lift = 0;  // so that it is in sight
    Spring reach;                             // share of the distance that walls leave

    // eyes
    Vec3 eyes_from_root;  // turned as the walker is, its steps taken out
    Spring eyes_height, yaw, pitch;
};

inline bool goes_along(CameraChoice::Kind kind) {
    return kind == CameraChoice::Kind::follow || kind == CameraChoice::Kind::eyes;
}

// After every tick, and before the first picture. Who is chosen anew is gone along with at once; where nobody
// is any more, it stays where it was.
void advance(CameraRig& rig, const World& world, const CameraChoice& choice);

// Between the last two ticks; `fov`, radians, in place of the lens that it chooses, unless it is 0.
Camera camera_of(const CameraRig& rig, float fov, float between);

}  // namespace flaneur
