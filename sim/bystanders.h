// Those who mind that somebody near has fallen: heads turn, some stop and look, and who can and would help
// goes there, offers a hand, pulls while the other gets up, and says a word before both go on.
//
// Who helps is the nearest who is free, by personality and chance (WorldOptions::helpers): the more agreeable
// and the bolder (Penner et al., "Prosocial behavior: multilevel perspectives", Annual Review of Psychology
// 56, 2005); of those who are many near each is less likely to (Latane & Nida, Psychological Bulletin 89,
// 1981), which a nearest one or two who go leave over.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "sim/body/body.h"
#include "sim/fall/limbs.h"
#include "sim/fall/planned_push.h"

namespace flaneur {

struct World;

enum class Concern : uint32_t {
    glances,  // turns the head and goes on
    watches,  // has stopped, or stops a few metres off
    comes,    // to help
    offers,   // stands beside, with a hand out
    pulls,    // has the other's hand
    parts,    // lets go, and stands a moment
    thanks,   // has been helped up: stands a moment
};
inline constexpr std::array<std::string_view, 7> k_concern_words = {
    "looks at somebody who has fallen",
    "stands and looks at somebody who has fallen",
    "goes to help somebody up",
    "offers a hand to somebody who has fallen",
    "helps somebody up",
    "has helped somebody up",
    "has been helped up"};

struct Bystander {
    uint32_t walker = 0;
    uint32_t whom = 0;
    uint32_t whom_generation = 0;
    Concern does = Concern::glances;
    uint32_t began = 0, until = 0;  // ticks; of what it does now
    uint32_t side = 0;              // Side of the other's hand that it takes,
    uint32_t hand = 0;              // and of its own
    HeadTurn gaze{};                // where the head is turned,
    float heed = 0;                 // 0: as the walk has it .. 1: there
    float bent = 0;                 // of trunk and knees towards the other, 0..1
    float leans_back = 0;           // radians
    float reach = 0;                // of the arm, 0: as the walk has it .. 1: to the other's hand,
    float holds = 0;                // and of the other's arm to it
    uint32_t has_hold = 0;          // 1: hands are in each other
};

struct Bystanders {
    std::vector<Bystander> all;  // by walker
    float helpers = k_usual_helpers;
};

// So that ticks allocate nothing while no more than `count` lie.
void make_room_to_mind(World& world, size_t count);

// Before the falls' phases change: who minds whom, and what each does.
void mind_falls(World& world);
// Whether one goes about by itself, in full view.
bool is_by_itself(const World& world, uint32_t walker);
// After the poses of those who fell are set: poses of bystanders, and of the hands that they hold.
void pose_bystanders(World& world);

struct Fall;
// Whether somebody is on the way to help it who will be there in time.
bool is_awaited(const World& world, const Fall& fall);

uint64_t hash_bystanders(const World& world);
// It is gone; or has fallen itself.
void forget_bystander(World& world, uint32_t walker);

}  // namespace flaneur
