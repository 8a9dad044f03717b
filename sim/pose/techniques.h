// What inverse kinematics and its kin add to bodies, each technique by itself.
#pragma once

#include <array>
#include <string_view>

namespace flaneur {

// Those that are on. They change how bodies look and nothing of how people walk.
struct Techniques {
    bool gait = true, feet = true, soles = true, heels = true, pelvis = true, limits = true, trunk = true,
         look = true, walls = true, holds = true, canes = true, prams = true, idles = true;
    bool operator==(const Techniques&) const = default;
};

struct TechniqueInfo {
    std::string_view name;
    bool Techniques::*is_on;
    std::string_view what;     // it does
    std::string_view without;  // it, what bodies do
};
inline constexpr std::array<TechniqueInfo, 13> k_techniques = {{
    {"gait", &Techniques::gait, "feet step to places on the ground that are planned, and bodies follow",
     "hands and feet follow four targets on curves, as in The Walker Report. Where it is off, all others but "
     "canes, prams and idles are too"},
    {"feet", &Techniques::feet, "legs are solved, by two bones, from the hips to where feet stand and swing",
     "legs follow the mean curves of people on level ground: feet slide, hang over lower ground and sink "
     "into "
     "higher ground"},
    {"soles", &Techniques::soles, "feet tilt with the ground that they stand on",
     "feet are as on level ground: on slopes heels or toes go into it"},
    {"heels", &Techniques::heels, "heels rise where legs are too short and where shins tilt far",
     "feet follow their curve of heel, sole and ball alone: ankles bend too far, and feet are torn off the "
     "ground"},
    {"pelvis", &Techniques::pelvis,
     "the pelvis comes down as far as legs ask, falls and is caught as bodies are",
     "it rides on its curve above the smoothed ground: on kerbs and stairs legs are too short for their "
     "feet"},
    {"limits", &Techniques::limits, "hips and ankles keep within people's range, and legs within their speed",
     "legs do what their feet ask for: in starts and turns they bend too far and jerk. Where feet, soles, "
     "heels or the pelvis are off, this is too"},
    {"trunk", &Techniques::trunk, "chest and head turn and tip against the pelvis, and keep level",
     "they turn and tip with it, stiffly"},
    {"look", &Techniques::look, "chest, neck and head turn to what is looked at",
     "heads look where bodies face"},
    {"walls", &Techniques::walls, "hands rest on walls and rails that people pass",
     "they swing, through the wall if it is near"},
    {"holds", &Techniques::holds, "hands are in pockets, on hips, straps and each other",
     "they hang and swing"},
    {"canes", &Techniques::canes, "the hand follows a cane whose tip stands where it came down",
     "the cane swings with the hand"},
    {"prams", &Techniques::prams, "both hands are solved to the handle of a pram", "they swing beside it"},
    {"idles", &Techniques::idles, "recorded motion lies over who stands", "they stand as the gait has them"},
}};

}  // namespace flaneur
