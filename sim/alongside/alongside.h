// What goes along with the people of a world: dogs on leads, wheelchairs, white canes, umbrellas; and those
// who play on squares, with those who listen. Who has what is drawn for each by chance as it comes
// (shares.h); all else of them, crowd and gait, is as of anybody.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sim/alongside/dog.h"
#include "sim/alongside/shares.h"
#include "sim/movers/movers.h"

namespace flaneur {

struct World;

enum class Along : uint32_t { dog, wheelchair, white_cane, umbrella, guitar, violin, accordion };
inline constexpr int k_along_count = 7;

// Who has something with it.
struct Companion {
    uint32_t walker = 0, generation = 0;
    Along what = Along::dog;
    float holds = 0;  // 0: hands hang .. 1: they have it
};

// The wheelchair of one, which stands where its walker does.
struct Chair {
    uint32_t walker = 0;
    float wheels[2] = {0, 0};  // radians that left and right have turned, in [0, 2 pi)
    float push = 0;            // phase of the push, [0, 1): hands are on the rims while below k_pushes
    float height = 0, pitch = 0,
          roll = 0;  // of the ground below the axle, smoothed; radians, front up, left up
    float height_rate = 0;
};
inline constexpr float k_pushes = 0.45f;  // of a stroke

// Somebody who plays, and where.
struct Player {
    uint32_t walker = 0, generation = 0;
    Vec2 at{}, facing{};
    float beat = 0;       // of the music, counted round
    uint32_t stands = 0;  // 1: is there, and plays
    Vec3 hat{};           // on the ground before it
};

// Who listens to one who plays.
struct Listener {
    uint32_t walker = 0, generation = 0;
    uint32_t player = 0;  // index into Alongside::players
    uint32_t until = 0;   // tick
    float heeds = 0;      // 0..1, of how it moves to the music
    uint32_t claps = 0;   // 1: it does, else it sways
};

struct Alongside {
    AlongShares shares;
    // Each by walker, but for players, who keep their order.
    std::vector<Companion> companions;
    std::vector<Dog> dogs;
    std::vector<Chair> chairs;
    std::vector<Player> players;
    std::vector<Listener> listeners;
    // For who draws between ticks.
    std::vector<Dog> previous_dogs;
    std::vector<Chair> previous_chairs;
};

// The lists that the next tick depends on.
template <class A, class Each>
void for_each_list(A& along, const Each& each) {
    each(along.companions);
    each(along.dogs);
    each(along.chairs);
    each(along.players);
    each(along.listeners);
}
uint64_t hash_alongside(const Alongside& along);
// After those were written over.
void forget_previous(Alongside& along);

// From now on such things go along with people, whoever is there already too. Allocates; between two ticks.
void let_go_along(World& world, const AlongShares& shares);

// The same of a world in which they do: shares of those who are there are drawn anew; who plays stays.
// Allocates; between two ticks.
void change_along(World& world, const AlongShares& shares);

// A walker came, or is gone.
void join_along(World& world, uint32_t walker);
void leave_along(World& world, uint32_t walker);

// The mesh has been exchanged.
void find_dogs_anew(World& world);

// Before the crowd's tick: who waits for a dog, and who stops to listen.
void think_alongside(World& world);
// After it: where dogs and wheels are.
void move_alongside(World& world);
// After all else that poses people: hands on leads, rims, handles and strings.
void pose_alongside(World& world);

// What one has with it; null: nothing.
const Companion* companion_of(const World& world, uint32_t walker);
// What one does with it, in words: "walks a dog"; empty: nothing.
std::string_view told_along(const World& world, uint32_t walker);

// Where the middle of a palm is, by a walker's joints between two ticks.
Vec3 palm_between(const World& world, uint32_t walker, Side side, float between);

// Where what is held is, for who draws it: the frame of a white cane has its grip at the origin and -y to its
// tip; of an umbrella its grip, and +y to its top; of an instrument its middle, +x to its neck, +z out of it.
Placement held_between(const World& world, const Companion& companion, float between);
inline constexpr float k_white_cane = 1.25f;                  // metres, from grip to tip
inline constexpr float k_umbrella = 0.80f, k_canopy = 0.52f;  // from grip to top; radius
// The bow of a violin: where it is held, -x to its tip.
Placement bow_between(const World& world, const Companion& companion, float between);
// How far an accordion is open, metres between both hands.
float bellows_between(const World& world, const Companion& companion, float between);

// Of a wheelchair for a body of so many metres: its middle above the axle.
inline constexpr float k_chair_wheel = 0.305f, k_chair_rim = 0.26f;  // radii, metres
inline constexpr float k_chair_track = 0.56f, k_chair_seat = 0.47f;  // between rims; of the seat's top
Placement chair_between(const World& world, size_t number, float between);

}  // namespace flaneur
