// The city is changed while it runs: time of day, weather, how many people there are, what stands in the
// streets; and somebody is driven by hand.
#pragma once

#include <optional>

#include "assets/scene.h"
#include "sim/crowd/crowd.h"
#include "tools/flaneur/window/change/design.h"
#include "tools/flaneur/window/change/making.h"

namespace flaneur {

struct Options;
struct Viewer;

// What the left button holds: an addition that is moved, or the end of one that is drawn.
struct ChangeGrip {
    bool is_held = false;
    bool is_clicked = false;      // its first end was clicked: the next click is the other one
    std::optional<size_t> moved;  // number of an addition; none: a new one is drawn
    Addition was;                 // before
    Vec3 from;                    // where it was taken hold of
};

// How who is driven goes.
struct Driving {
    bool is_by_turns =
        false;  // as pressed once: on and on, or not; and about by 45 degrees, slowly. Else as held
    bool goes_on = false;
    float heading = 0;
    SlowTurn turn;
    uint32_t tick = 0;  // as of which these are
};

struct Change {
    Scene scene;        // as the window was opened
    Designs designs;    // what is wanted
    Design carried;     // what holds, already or so far
    uint32_t late = 0;  // the tick of the last change after which a scene's first tick is another; 0: none
    std::optional<AddedKind> tool;   // what a click puts down
    std::optional<size_t> selected;  // number of an addition of the current design
    std::optional<Addition> ghost;   // what would be put down, or is being moved
    ChangeGrip grip;
    Making making;
    // Of a platform: the outline of its ground, carried.platform being that of circles; the one that a slider
    // changes, and what by; the corner that is dragged, and whereto.
    std::vector<Vec2> ground, outline_was;
    float platform_size = 100, platform_turn = 0;  // percent, degrees
    std::optional<size_t> corner;
    Vec2 corner_at;
    std::optional<Neighbourhood> home;  // where people come, for so many
    uint32_t home_people = 0;
    uint64_t next_gesture = 1, gesture = 0;  // of sliders
    int typed_people = 0;
    char typed_hour[16] = {};
    char path[256] = "out/scene.json";
    bool is_naming = false, starts_naming = false;
    Driving driving;
};

// The window shows the scene of these options now.
void start_changes(const Options& options, const Show& show, Viewer& viewer);

// Whether nothing but the weather is otherwise than in the scene that was opened, and never was.
bool is_as_opened(const Change& change);

// What makes the city with these additions in place of those that are carried.
Order order_of(const Show& show, const Change& change, std::vector<Addition> added);

// Once a frame, between two ticks: carries on what is wanted, as far as it is ready.
Result<void> carry_on(Show& show, Viewer& viewer);

// Says that it is so from now on; what is wanted may be undone.
void want(Viewer& viewer, Design next, uint64_t gesture = 0);

}  // namespace flaneur
