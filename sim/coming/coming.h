// Coming and going: who leaves the crowd where places let people leave, who comes in there instead, and those
// whom somebody sends. How that looks is in passages.h.
//
// Who wanders and gets to a destination may leave there, by Demand::leaving; then another is due to come in
// at such a place near the crowd's home, so that as many stay. One who is sent comes in at its time, goes
// where it is sent and leaves there. Whoever finds no room where it is to come in waits for it; who wanders
// tries another place after a second. The two wait apart, so that however many are sent, they keep none out
// who come in instead of others.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/coming/sending.h"
#include "sim/crowd/crowd.h"

namespace flaneur {

inline constexpr uint32_t k_no_sending = ~0u;

// One who is to come in.
struct Entrant {
    NavPoint place{};                 // where; polygon 0: is not chosen yet, or is no more
    NavPoint goal{};                  // where one who is sent goes
    float heading = 0;                // yaw
    float speed = 0;                  // see Sending
    uint32_t number = 0;              // of all who were ever to come in: chance goes by it
    uint32_t tries = 0;               // how often there was no room
    uint32_t sending = k_no_sending;  // by which it is sent; none: comes instead of one who left
    uint32_t by_door = 0;             // 1: comes out of a house or a shop
};

// Who is to come in, in the order in which they are due. So many of them try at a time, in turn.
struct WaitingLine {
    std::vector<Entrant> entrants;
    uint32_t next = 0;  // who is the next to try
};

// A place where somebody who has come in waits for others.
struct Awaited {
    NavPoint place{};
    float heading = 0;
    uint32_t by_door = 0;  // as of Entrant
    uint32_t count = 0;    // how many are still to be called there
};

// How far the people of a sending are.
struct SentSoFar {
    uint32_t came = 0, arrived = 0;
    uint32_t lost = 0;  // had no way from there to there
};

struct Coming {
    std::vector<Sending> sendings;
    Neighbourhood home;  // where who comes in instead of another does so, if there are such places

    WaitingLine successors;  // who come in instead of others
    WaitingLine sent;        // and who are sent
    uint32_t numbered = 0;   // how many were ever to come in
    uint32_t left = 0, came = 0;
    std::vector<SentSoFar> so_far;     // by sending
    std::vector<uint32_t> sending_of;  // by slot: of the last who came in there, if there are sendings

    std::vector<Awaited>
        awaited;  // who comes in instead of others does so there first; set anew before each use
    std::vector<uint32_t> gone, arrivals;  // slots left and taken in this tick; an arrival may take one gone
};

// Whether anybody comes or goes by itself.
bool comes_and_goes(const Coming& coming, const Crowd& crowd);
// Room for all who may wait to come in, so that nothing is allocated later. Allocates.
void make_room(Coming& coming, const Crowd& crowd);

// Those who leave begin to, or are gone if they are out of sight, and others come in, who are drawn from the
// folk; before all else in a tick. Says who is gone and who has come in `gone` and `arrivals`. It is done at
// 15 Hz, when all are put in the order of places anyway.
void come_and_go(Coming& coming, Crowd& crowd, const Surroundings& around, const Navmesh& mesh,
                 Workers& workers, std::span<const Folk> folk, uint32_t tick, uint64_t seed);

// The mesh is exchanged for `mesh`, between two ticks: see change_mesh() in sim/crowd/crowd.h.
void change_mesh(Coming& coming, const Navmesh& mesh);

// The height at which people walk in a place that says another one, near which nobody does. None: they do, it
// says none, or nobody walks there at any height.
std::optional<float> other_height(const SentPlace& place, const Navmesh& mesh);

// Why nobody of a sending can be sent: nobody walks within 2 m of the place where it begins or ends, nor of
// 256 places by chance of an area, or no way leads from the one place to the other. Of ways between areas it
// is not known before.
enum class Unwalkable : uint8_t { no, from, to, way };
Unwalkable why_unwalkable(const Sending& sending, const Navmesh& mesh);

// How many wander or stand here, and are to come in instead of those who left: all but those who are sent.
uint32_t kept_people(const Coming& coming, const Crowd& crowd);

// How many are due to come in and have found no room yet.
uint32_t waiting(const Coming& coming);
// Whether a walker who is there came by a sending, and goes where that sends it.
bool is_under_way(const Coming& coming, const Crowd& crowd, uint32_t walker);

// Of everything that the next tick depends on.
uint64_t hash_coming(const Coming& coming);

}  // namespace flaneur
