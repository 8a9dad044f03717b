// How the selected walker walks: the angles of its legs beside those of people, its speed, its steps.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "sim/pose/techniques.h"
#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

struct Action;
struct Show;
struct Viewer;
struct World;

inline constexpr size_t k_watched_ticks = 900;  // that are kept at least, once they have gone by

struct WatchedLeg {
    Curves curves;
    int strides = 0;
    double stance = 0;  // share of the cycle
};

struct GaitWatch {
    bool shows_steps = false;  // footprints, contacts and what limbs reach for, in the city
    uint32_t walker = 0, generation = 0;
    uint32_t tick = 0;  // the last one
    Walk walk;          // the last ticks
    struct Print {
        glm::vec3 heel, tip, normal;
        Side side = k_left;
    };
    std::vector<Print> prints;  // where its feet stood, the last ones
    // Of the last strides of each leg; none where it has not made one.
    std::array<std::optional<WatchedLeg>, 2> legs;
    double seconds = 0, metres = 0;  // of a stride
    size_t contacts = 0;             // seen so far,
    size_t known_contacts = 0;       // and when `legs` were made
};

// Whose gait is told of: who is selected, or else gone along with.
std::optional<uint32_t> watched(const Viewer& viewer);

// After each tick. Another walker, or a tick that does not follow, begins anew.
void watch_gait(const World& world, std::optional<uint32_t> walker, GaitWatch& watch);

// From the last strides of each leg, if there are new ones: `legs`, `seconds` and `metres`.
void measure_legs(GaitWatch& watch);

void mark_gait(Show& show, Viewer& viewer, FrameInput& frame);
// Its speed over the last ten seconds.
void lay_out_speed(const GaitWatch& watch, float width, float scale);
// Whether what is drawn is what the curves are of.
std::string told_of_curves(const Techniques& on);
void lay_out_gait(Show& show, Viewer& viewer, float scale);

std::span<const Action> gait_actions();

}  // namespace flaneur
