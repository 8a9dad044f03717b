// What people do who stay somewhere, and what they do on the way: they sit on benches, lean at walls, look at
// shop windows, stand in line, look up at houses, have a phone in the hand, hurry, stroll and run for a bus.
//
// Of those who may, who does is drawn by key: (seed, walker, trip). Decisions are taken in the order of
// walkers, before the crowd thinks; the crowd then leads them as it leads all who are called somewhere (see
// Called in sim/crowd/crowd.h). What their bodies do is laid over the poses that the gait made, each on its
// own.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/crowd/crowd.h"
#include "sim/fall/body_pose.h"
#include "sim/fall/limbs.h"
#include "sim/pastimes/places.h"

namespace flaneur {

struct World;

// Where one stays for it.
enum class Staying : uint32_t {
    nowhere,  // does something on the way
    sits,
    leans,        // with the back at a wall
    looks,        // stands before a shop window
    glances,      // at one, as it passes
    queues,       // stands in line
    photographs,  // stands and takes a picture
    marvels,      // stands and looks up at a house
    leans_out,    // with both hands on a railing
};
enum class StayPhase : uint32_t { comes, begins, stays, ends, over };  // over: remembers it for a while
// How it goes, on this trip; runs: for a bus.
enum class Haste : uint32_t { usual, strolls, hurries, runs };
enum class PhoneUse : uint32_t { none, texts, calls, photographs };

struct Pastime {
    uint32_t walker = 0;
    Staying what = Staying::nowhere;
    StayPhase phase = StayPhase::comes;
    uint32_t began = 0, until = 0;                  // ticks: of this phase; until one ends staying
    uint32_t place = 0;                             // index of its seat, window, service or railing
    uint32_t rank = 0;                              // in its line, 0: is served
    uint32_t joined = 0, moves_up = 0, served = 0;  // ticks, of one in a line; served 0: not yet begun
    PhoneUse phone = PhoneUse::none;
    uint32_t phone_began = 0, phone_until = 0;  // ticks
    Haste haste = Haste::usual;
    float usual_speed = 0;     // m/s that it likes without all that; 0: as it does now
    uint32_t whom = k_nobody;  // looks at that walker,
    uint32_t looks_until = 0;  // until that tick
    Vec2 to{}, facing{};       // where it stands, and where it looks there, unit
    Vec3 at{};                 // what it leans on, looks at, takes a picture of
    HeadTurn gaze{};           // where the head is turned,
    float heed = 0;            // 0: as the walk has it .. 1: there
    // Of one who sits: how, see sim/pastimes/seated.h, since which tick, and the bodies of that and before.
    // Of one who leans out: the body as it stood before.
    uint32_t posture = 0, posture_began = 0;
    BodyPose before{}, now{};
    // Of one who sits beside those it goes with: who leads them, which may be itself; and radians to the left
    // that its chest is turned to them.
    uint32_t with = k_nobody;
    float turned = 0;
};

// Those who go together and could sit down now, who leads first; count 0: nobody.
struct Party {
    std::array<uint32_t, 4> who{};
    uint32_t count = 0;
};

// A list of places, by squares of the ground.
struct PlaceIndex {
    Grid grid;
    std::vector<Vec2> places;
};

struct Pastimes {
    PastimeShares shares;
    PastimePlaces places;
    std::vector<Pastime> all;  // by walker
    // What is known of the places. Seats are sat on from there; polygon 0: from nowhere.
    std::vector<NavPoint> before_seat;
    std::vector<uint32_t> room;  // by service: how many can stand in line
    PlaceIndex seats, windows, services, railings, sights, doors;
    // By seat, window, service and railing: how many are at it. Anew in each tick.
    std::vector<uint32_t> at_seat, at_window, at_service, at_railing;
};

// What the stage of a tick that concerns them goes by.
struct PastimeTick {
    Pastimes& pastimes;
    Crowd& crowd;
    const Gait& gait;
    const Navmesh& mesh;
    const Surroundings& around;
    std::vector<PoseBlock>& poses;
    uint64_t seed;
    uint32_t tick;
    const World& world;
    bool (*is_free)(const World& world, uint32_t walker);  // to do as it likes, in full view
    bool (*is_bus_near)(const World& world, Vec3 stop);    // that people get on there, or will at once
    float (*age_of)(const World& world, uint32_t walker);  // years
    Party (*led_by)(const World& world, uint32_t walker);
    // Whom of those it goes with one looks at just now, or k_nobody.
    uint32_t (*heeds)(const World& world, uint32_t walker);
};

// Between two ticks: the places of a city, and how many use them. Both allocate.
// Who is at a place that is there no more leaves it.
void set_places(Pastimes& pastimes, const PastimePlaces& places, const Navmesh& mesh, Crowd& crowd);
void set_shares(Pastimes& pastimes, const PastimeShares& shares, Crowd& crowd);

// Who does what from now on; before the crowd thinks.
void decide_pastimes(const PastimeTick& tick);

// The bodies of walkers [begin, end), on top of their poses.
void pose_pastimes(const PastimeTick& tick, size_t begin, size_t end);

// It is gone, or has fallen: whatever it did is over.
void forget_pastime(Pastimes& pastimes, Crowd& crowd, uint32_t walker);

// Whether it stays at something, so that nobody else calls or pushes it.
bool is_staying(const Pastimes& pastimes, uint32_t walker);

// Where the phone is that a walker has in the hand and is no part of its body: its middle, y along it and x
// out of its back. None of who has none.
std::optional<JointPose> phone_of(const Pastimes& pastimes, const Gait& gait, uint32_t walker, uint32_t tick,
                                  const JointPose& right_hand);

// "sits on a bench, texting"; empty: does nothing of it.
std::string told_pastime(const Pastimes& pastimes, uint32_t walker, uint32_t tick);

uint64_t hash_pastimes(const Pastimes& pastimes);

}  // namespace flaneur
