// People who are with each other: couples, friends, families, who walk together, stop together and talk.
//
// Of people in streets 55 to 70 % walk in groups, of which some 70 % are pairs, 20 % threes and 7 % fours;
// they walk abreast, threes as a V and fours as a U whose middle is behind, and the slower the more they are
// (Moussaid et al., PLoS ONE 5:e10047, 2010); in narrow places and throngs they go one behind the other. Who
// leads a group has its errand and its way, and waits for who falls behind. Groups that stop stand round a
// common middle (Kendon, "Conducting Interaction", 1990) and talk by turns.
//
// What is decided of a group is written by that group alone, after everybody has moved; the crowd goes by it
// in the next tick (Fellow). docs/life/company.md has the measured figures.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/coming/coming.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/gait.h"
#include "sim/pose/pose.h"

namespace flaneur {

inline constexpr uint32_t k_most_company = 4;  // in a group
// How many of all people are alone, in pairs, in threes and in fours, against the others.
using GroupShares = std::array<float, k_most_company>;
inline constexpr GroupShares k_no_groups{1, 0, 0, 0};
// Of people of a weekday, 55 % in groups (Moussaid 2010).
inline constexpr GroupShares k_usual_groups{0.45f, 0.38f, 0.11f, 0.06f};
inline bool has_groups(const GroupShares& shares) { return shares[1] + shares[2] + shares[3] > 0; }

inline constexpr float k_never_alone = 10;    // years: children below go with others, where there are groups,
inline constexpr float k_holds_hands = 7.5f;  // and below that hold somebody's hand, nearly always below six

// What a group does.
enum class Together : uint32_t {
    walks,
    row,    // stands, side by side, to look at something
    ring,   // stands round a common middle
    parts,  // leaves the crowd one by one
    meets,  // are acquaintances who have come upon each other
    sits,   // side by side, or goes to seats (sim/pastimes)
};

// How far those who meet are (Kendon & Ferber, "A description of some human greetings", 1973): they greet
// from afar, come up, greet again and talk.
enum class Encounter : uint32_t { sees, comes, greets, talks, parts };

enum class Speech : uint32_t { silence, speech, laughter };

struct Group {
    std::array<WalkerId, k_most_company> members{};  // in the order in which they go abreast
    uint32_t count = 0;                              // 0: there is no such group
    uint32_t leader = 0;                             // which of them
    uint32_t mirrored = 0;                           // 0: the first goes at the left, 1: at the right
    Together does = Together::walks;
    Vec2 ahead{0, 1};     // unit: which way they go
    float narrow = 0;     // 0: abreast .. 1: one behind the other
    float crowded = 0;    // strangers for each square metre about them
    float speed = 1.34f;  // m/s, at which they like to go
    uint32_t waits = 0;   // tick since which who leads stands, for one who has fallen behind; 0: goes
    uint32_t parted_since = k_never;  // tick: one of them has been away from the others
    Vec2 middle{};                    // of a ring, on the ground plane; of a row, its way
    // So many are still to come in, by the way by which who leads has: until then it waits for them.
    uint32_t expects = 0, expects_until = 0;  // the latter a tick
    NavPoint entry{};
    float entry_heading = 0;
    uint32_t by_door = 0, brings_child = 0;
    Encounter stage = Encounter::sees;         // of those who meet,
    uint32_t stage_began = 0, stage_ends = 0;  // ticks
    uint32_t shakes_hands = 0;                 // 1: rather than nod
    // Who speaks, of the members, since when and until when; chance goes by how many turns there were.
    Speech speech = Speech::silence;
    uint32_t speaker = 0, turn = 0, turn_began = 0, turn_ends = 0;
};

// How one of them bears itself.
struct Bearing {
    float gaze = 0;                          // radians: yaw that the head is to have against the body
    float bows = 0;                          // radians: how far it is bowed to look at who is smaller
    uint32_t whom = k_nobody;                // one of the others,
    uint32_t gazes = 0;                      // 1: looks at that one, 0: ahead, or about,
    uint32_t gaze_began = 0, gaze_ends = 0;  // from this tick to that
    uint32_t holds = k_nobody;               // whose hand it has, mostly of a child,
    uint32_t holds_side = 0;                 // with which of its own and in which of its: see own_side()
    float grip = 0;                          // 0: hangs .. 1: hands are in each other
    uint32_t runs_until = 0;                 // tick: a child runs ahead,
    uint32_t runs_next = 0;                  // and may do so again from then on
    uint32_t meets_next = 0;                 // tick from which on it may stop for an acquaintance
};

// Of Bearing::holds_side: a bit for its own Side, one for the other's, and one of who lets go until it has.
inline constexpr uint32_t k_lets_go = 4;
inline Side own_side(const Bearing& b) { return static_cast<Side>(b.holds_side & 1); }
inline Side others_side(const Bearing& b) { return static_cast<Side>(b.holds_side >> 1 & 1); }
inline bool lets_go(const Bearing& b) { return (b.holds_side & k_lets_go) != 0; }

struct Company {
    GroupShares shares = k_no_groups;
    float acquaintances = 0;  // see WorldOptions
    std::vector<Group> groups;
    std::vector<Bearing> bearings;  // by walker; empty: nobody goes with others
    uint32_t vacant = 0;            // of the groups
};
inline bool is_on(const Company& company) { return !company.bearings.empty(); }

inline const Group* group_of(const Company& company, const Crowd& crowd, uint32_t walker) {
    if (crowd.fellows.empty() || crowd.fellows[walker].group == k_no_group) return nullptr;
    return &company.groups[crowd.fellows[walker].group];
}

// Makes groups of those who have been set down and wander: their ages fit, and they stand together. Bodies
// are dealt anew among them. Allocates; before their gait begins.
void form_groups(Company& company, Crowd& crowd, const Surroundings& around, const Navmesh& mesh,
                 std::span<const Folk> folk, uint64_t seed);
// Room for `capacity` walkers. Allocates.
void make_room(Company& company, Crowd& crowd, uint32_t capacity);
// Nobody goes with anybody from now on.
void end_company(Company& company, Crowd& crowd);

// Before people come in: tells where those wait who have come in before the others of their group.
void await_others(const Company& company, Coming& coming);
// Of who has just come in, before its gait begins: goes with who expects others, or may expect some itself,
// who come in after it.
void join_arrivals(Company& company, Crowd& crowd, const Coming& coming, std::span<const Folk> folk,
                   uint32_t tick, uint64_t seed);

// Who leads a group has been called to a seat, and the others to those beside it: they sit until it is called
// off.
inline void let_sit(Company& company, const Crowd& crowd, uint32_t leader) {
    if (group_of(company, crowd, leader)) company.groups[crowd.fellows[leader].group].does = Together::sits;
}

// After everybody has moved: where all should be in the next tick, what groups do and who speaks.
void guide(Company& company, Crowd& crowd, const Navmesh& mesh, Workers& workers, std::span<const Folk> folk,
           uint32_t tick, uint64_t seed);
// Between gait and pose: where heads turn, and hands of who speaks.
void bear_themselves(const Company& company, const Crowd& crowd, Gait& gait, Workers& workers, uint32_t tick,
                     uint64_t seed);
// After the pose: nods, and hands in hands, from where arms were a tick before.
void pose_company(Company& company, const Crowd& crowd, const Gait& gait, Workers& workers, uint32_t tick,
                  uint64_t seed, const std::vector<PoseBlock>& previous, std::vector<PoseBlock>& poses);

// The groups' part of the state of the world. Nothing of a world without groups.
uint64_t hash_company(const Company& company);

// "walks with two others, speaks"; empty of who goes alone.
std::string company_words(const Company& company, const Crowd& crowd, std::span<const Folk> folk,
                          uint32_t walker);

}  // namespace flaneur
