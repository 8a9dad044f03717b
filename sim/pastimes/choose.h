// What somebody takes up who could do something. Private to sim/pastimes.
#pragma once

#include "sim/base/rng.h"
#include "sim/ground/grid.h"
#include "sim/pastimes/pastimes.h"

namespace flaneur {

// What is known of one who may do something.
struct Candidate {
    uint32_t walker;
    Vec3 at;
    Vec2 velocity;
    float speed;
    bool has_stopped;  // at its goal, for a while
    float stays;       // seconds that it will
    RandomKey key;     // of its trip
    const PersonBlock& person;
    size_t lane;
};
Candidate candidate(const PastimeTick& tick, uint32_t walker);
bool has_free_hands(const Candidate& candidate);
// Has a bag, a cane or a pram.
bool is_laden(const PastimeTick& tick, const Candidate& candidate);
// It goes to a place from now on, and stays there for so many seconds.
Pastime& send(const PastimeTick& tick, const Candidate& candidate, Staying what, Vec2 to, Vec2 facing,
              float seconds);

// Calls visit(index, metres) for each place within `reach`.
template <class Visit>
void for_near(const PlaceIndex& index, Vec2 at, float reach, Visit visit) {
    if (index.places.empty()) return;
    const Vec2 box{reach, reach};
    for_items_of_box(index.grid, at - box, at + box, [&](uint32_t item) {
        const float far = length(index.places[item] - at);
        if (far < reach) visit(item, far);
    });
}

// One sits down on a seat near it, or puts the hands on a railing, by chance: whether it does.
bool sits_down(const PastimeTick& tick, const Candidate& candidate);
bool leans_out(const PastimeTick& tick, const Candidate& candidate);
// Where one looks who does, anew every few seconds.
void look_out(const PastimeTick& tick, Pastime& pastime);
// A group whose leader has stopped sits down side by side, if all of it can.
void sit_together(const PastimeTick& tick, uint32_t leader);

// One who may take up something: sits down, leans, looks, queues or takes out a phone, by chance.
void consider(const PastimeTick& tick, uint32_t walker);

// How many can stand in line there, on the mesh.
uint32_t room_in_line(const Service& service, const Navmesh& mesh);
// Sends one to the end of a line.
void join_line(const PastimeTick& tick, Pastime& pastime, uint32_t service);
// One in a line goes to its place in it, and leaves when it has been served.
void move_up(const PastimeTick& tick, Pastime& pastime);

// Whether it wears a skirt, a dress or a coat.
bool has_robe(const PersonBlock& person, size_t lane);

inline constexpr float k_leans_back = 1.8f;  // seconds until the back is at the wall
inline constexpr float k_leans_out = 1.8f;   // until the hands are on the railing

}  // namespace flaneur
