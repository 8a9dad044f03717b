// What inverse kinematics and its kin add to bodies, switched on and off, and both side by side.
#pragma once

#include <span>
#include <string>

#include "sim/pose/techniques.h"

namespace flaneur {

struct Action;
struct Show;
struct Size;
struct Viewer;

struct TechniqueSwitches {
    Techniques on;
    bool is_split = false;  // the left half shows all of them on, the right one those that are
};

// To be called once a picture: what is drawn follows the switches.
void follow_switches(const TechniqueSwitches& switches, Show& show);

// Begins and ends showing both side by side, in place of another run beside this one.
void split_techniques(Show& show, Viewer& viewer);

// In the room Gait.
void lay_out_techniques(Show& show, Viewer& viewer, float width, float scale);
// "without feet, look"; "" where nothing is off.
std::string told_off(const Techniques& on);
// What either half shows.
void lay_out_halves(const Viewer& viewer, Size size);

std::span<const Action> technique_actions();

}  // namespace flaneur
