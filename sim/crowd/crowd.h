// The walkers: who they are, where they are, and the stages that move them; arrays parted by who reads what.
//
// One tick (1/60 s) is think, find_neighbours, steer, move, in this order. Of others, think reads
// what the last tick left, steer and move what find_neighbours copied; all write what is their walker's own.
// So the result depends neither on the number of threads nor on the order of walkers within a stage.
// Decisions (think, find_neighbours, steer) are taken at 15 Hz, by blocks of k_block slots: block b decides
// on ticks with tick % 4 == b % 4. Nothing is allocated once a crowd is made.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/block.h"
#include "sim/base/footwork.h"
#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/base/tick.h"
#include "sim/base/vec.h"
#include "sim/crowd/demand.h"
#include "sim/crowd/pass_on.h"
#include "sim/crowd/walker_id.h"
#include "sim/fellows/fellows.h"
#include "sim/ground/door.h"
#include "sim/ground/surroundings.h"
#include "sim/lamps/kerbs.h"
#include "sim/lanes/roadway.h"
#include "sim/limbs/limbs.h"
#include "sim/navigation/navmesh.h"
#include "sim/navigation/traffic.h"
#include "sim/ways/stride.h"

namespace flaneur {

inline constexpr uint32_t k_decision_ticks = 4;  // a walker decides every so many ticks
inline constexpr uint32_t k_afar_ticks = 8;      // and one afar every so many,
inline constexpr uint32_t k_farther_ticks = 16;  // or so many
inline constexpr int k_corners = 32;             // of a path, at most
inline constexpr int k_neighbours = 12;          // that a walker minds, at most
inline constexpr float k_neighbour_reach = 4;    // metres

// What a walker does at its goal.
enum class Errand : uint8_t {
    wander,
    arrive,
    by_way
};  // pause and go somewhere else; stand there; see Wayfarer

// How one goes who goes about no errand of its own.
struct Wayfarer {
    // After somebody; to its goal, waiting for somebody who comes along; away from somebody; by rays among
    // walls; along circles on a platform; as somebody else moves it (sim/stepping.h); or along with those it
    // goes with (Fellow).
    enum class Kind : uint32_t { follow, lead, flee, ramble, stagger, is_led, along };
    uint32_t walker = 0;
    Kind kind = Kind::follow;
    uint32_t waits = 0;  // 1: for the one it leads
    uint32_t turns = 0;  // so far, of one who rambles
    WalkerId whom{};     // followed, led, fled from
    float range = 0;     // metres: kept behind, most ahead, fled
    float bearing = 0;   // yaw, of one who rambles
    Stride stride{};
    Platform platform{};
};

// How one comes in or leaves: through a door, or, where nothing would hide it, by coming into sight and going
// out of it where it is (sim/coming/passages.h).
struct Passage {
    enum class Kind : uint32_t { in, out, appear, vanish };
    uint32_t walker = 0;
    Kind kind = Kind::appear;
    uint32_t shown = 0;  // how much of it is seen, of k_shown
    Door door{};         // of who goes through one
};
inline constexpr uint32_t k_shown = 32;  // ticks until one who appears or vanishes has

// A part of a body on the ground that nobody is to step on: a disk, from which bodies keep as far as feet
// swing ahead of them, and those who have come for who lies there as far as a foot is broad.
struct LyingPart {
    Vec2 from{};       // metres from where the hips are
    float radius = 0;  // metres; 0: nothing
};
inline constexpr float k_off_who_lies = 0.14f, k_beside_who_lies = 0.04f;  // metres
inline constexpr int k_lying_parts = 13;
inline constexpr float k_lying_reach = 1.6f;  // metres from the hips within which all of them are

// Who has fallen, lies or gets up: stays where it is, whatever it wants, and others go round all of it.
struct Downed {
    uint32_t walker = 0;
    Vec2 across{};  // metres from its place, where the hips are, to the head,
    Vec2 along{};   // and to between the feet
    std::array<LyingPart, k_lying_parts> parts{};
};

// Who goes straight to a place and stands there, whatever its errand is, until it is called off. At speed 0
// it stays where it is, and nobody moves it.
struct Called {
    uint32_t walker = 0;
    Vec2 to{};        // on the ground plane
    Vec2 facing{};    // unit: where it looks as it stands
    float speed = 0;  // m/s, at most
};

// What goes beside a walker, such as a dog on a lead: others keep clear of it as of a pram.
struct GoesBeside {
    uint32_t walker = 0;
    Vec2 to{};  // metres from the walker to its middle
};

// Who they are; constant, but for the speed of who does something on the way (sim/pastimes).
struct CrowdIdentity {
    std::vector<float> preferred_speed;  // metres a second, 0.3 .. 2
    std::vector<float> radius;           // of the body, metres
    std::vector<float> lateral;          // how far out corners are taken, metres
    std::vector<uint32_t> body;          // index into the bodies that the program has
    std::vector<float> scale;            // of that body
    std::vector<float> stair_pace;       // share of others' pace on stairs
    std::vector<float> ahead;  // metres from there to the middle of the pram that one pushes, 0: none
    // Shares of what others have (see sim/body/personality.h): the room that one keeps to those ahead, the
    // time that one bears to be held up, and stays where one stops.
    std::vector<float> room, patience, linger;
};

// The square of the ground plane in which one is looked for: where one was when all were filed last.
struct Filed {
    int16_t column = 0, row = 0;
};

// Where they are and how they move, at the end of the last tick. Gait and pictures read it.
struct CrowdMotion {
    std::vector<Vec3> position;     // on the ground, between the feet
    std::vector<Vec2> velocity;     // metres a second
    std::vector<Vec2> wish;         // what it is led to: as decided, as fast as ground and turns let one go
    std::vector<float> heading;     // where the body faces: yaw about +y, 0 = +z, growing towards +x
    std::vector<float> turn_rate;   // of the heading, radians a second
    std::vector<Footwork> feet;     // as the gait says
    std::vector<float> brakes;      // m/s2, with which it slows down; 0: it does not
    std::vector<uint32_t> polygon;  // of the mesh, under the position
    std::vector<GroundHit> under;   // the ground there, or steps just ahead: see slowing_ground
    std::vector<Filed> filed;       // where others look for it
};

// Whether a walker waits for a path to be found: to its goal, or to one that is chosen first.
enum class PathDue : uint8_t { no, to_goal, to_new_goal };

inline constexpr uint32_t k_never = ~0u;  // a tick

// Where one walker goes and how it gets on. `think` alone writes it.
struct Journey {
    NavPoint goal;
    Vec2 facing;               // the direction to look in there; (0, 0): no matter
    Stay stay{};               // how long to stand there
    uint32_t trip = 0;         // how many goals it has had
    uint32_t pause_until = 0;  // tick; stands before it
    Vec2 path_start;           // where the walker was when its path was found
    Vec2 stretch_start;        // where the stretch of path to the current corner began
    Vec2 turned_at;            // the last corner that was widened, as it was before
    float closest = 0;         // to the current corner so far, metres, for noticing that one is stuck
    uint32_t closest_tick = 0;
    uint32_t insists_since = k_never;  // has a claim of its own since that tick,
    Vec2 insists_from;                 // and was here then
    uint32_t hurries_until = 0;        // tick; has been held up, and keeps less room to those ahead
    Errand errand = Errand::wander;
    PathDue path_due = PathDue::no;
    uint8_t corner = 0, corner_count = 0;  // the path's; `corner` is walked to; equal: no path
    uint8_t stuck = 0;                     // replans in a row that did not help
    bool arrived = false;                  // is at its goal, or as near as those who stand there let it
    bool leaves = false;                   // the crowd, when it has arrived and stood there,
    uint8_t door_tries = 0;                // by the door that it faces, if it gets before it in so many tries
};

// The right of way of one who does not get on: whose own it is, and since when. Who stands in such a one's
// way inherits it to get out of there, and so do those in whose way that one comes, as in "Priority
// inheritance with backtracking" (Okumura et al., IJCAI 2019): so the oldest claim always gets on.
struct Claim {
    uint32_t since = k_never, owner = 0, heirs = 0;                 // heirs: how many took it over before
    friend auto operator<=>(const Claim&, const Claim&) = default;  // smaller goes before larger
};

// What they have decided, the last time each did.
struct CrowdDecision {
    std::vector<Vec2> wanted;    // velocity that the errand asks for
    std::vector<Vec2> course;    // unit: to where the path is some metres on; zero of who goes nowhere
    std::vector<Vec2> aim;       // the corner that the path comes to, or nearer: a point of it
    std::vector<uint8_t> looks;  // 1: stands at its goal, and looks where one looks there
    std::vector<Vec2> chosen;    // velocity that steering allows
    std::vector<Claim> claim;
};

// What others go by of one walker: a line of the cache.
struct Seen {
    Vec3 position;
    Vec2 velocity;  // m/s; of one with a claim what it asks for, else what it has
    Vec2 ahead;     // metres to the middle of the pram that it pushes, or of what is beside it; zero: of none
    Vec2 course, aim;
    float radius = 0;
    uint32_t id = 0;
    Claim claim;
};
static_assert(sizeof(Seen) == 64);

// What others need to know of everybody to keep clear of them, as it is when a tick begins, in the order of
// places, so that those who are near lie near. Places are in rows as well, k_block more than there are
// walkers, so that lanes take many side by side.
struct SeenRows {
    std::vector<float> x, y, z;  // metres
    std::vector<Seen> all;
};

// What one who decides goes by.
struct Intent {
    Vec2 wanted;             // m/s
    float most = 0;          // m/s that it may go to get out of others' way
    float waited = 0;        // seconds without getting nearer
    uint32_t insists = 0;    // has a claim of its own since that tick, or k_never
    bool hurries = false;    // has been held up: see Journey
    float room = 1;          // see CrowdIdentity
    bool is_beside = false;  // the mesh: walks back onto it, or
    bool by_door = false;    // goes through a door
    bool lifts = false;      // its pram, if it has one, past what holds it up
    bool staggers = false;
};

// Written and read within one tick, but for the order of places, which holds for k_decision_ticks.
struct CrowdScratch {
    SeenRows seen;
    std::vector<uint32_t> order;        // walkers by square
    std::vector<uint32_t> cell_first;   // square c holds order[cell_first[c] .. cell_first[c + 1])
    uint32_t cells_x = 0, cells_z = 0;  // powers of two; the plane is wrapped onto them
    std::vector<uint32_t> tallies;      // of each square, by each of those who sort
    bool is_ordered = false;            // nobody came or went since
    std::vector<Intent> intents;        // by walker
    std::vector<uint8_t> woken;         // by block: 1: it was afar until this tick
    std::vector<uint8_t> lets_pass;  // by walker: 1: it waits before a carriageway until who comes has passed
    float strays = 0;                // metres from where one was filed, at most
    std::vector<uint32_t> requests;  // walkers whose path is sought
};

// Which slots are taken by whom.
struct CrowdSlots {
    std::vector<WalkerId> living;      // in no particular order
    std::vector<uint32_t> place;       // by slot: where in `living` its walker is, or k_nobody
    std::vector<uint32_t> generation;  // by slot: how often it was left
    std::vector<uint32_t> left;        // slots to be taken again, the last first
};
inline constexpr uint32_t k_nobody = ~0u;

// Who is moved by a hand rather than by an errand; k_nobody: nobody is.
struct Driven {
    uint32_t walker = k_nobody;
    Vec2 wish;  // m/s, at most k_fastest_driven
};
inline constexpr float k_fastest_driven = 4;

// Those who ramble as limbs on curves take them: at the pace of their legs, and turning one turn at a time,
// each of which takes its time. Of all, how.
struct March {
    LimbCurves how;
    std::vector<float> pace;      // m/s, by slot; empty: nobody marches
    std::vector<SlowTurn> turns;  // by slot, the last one
};
inline bool is_on(const March& march) { return !march.pace.empty(); }

// Who looks on. A block of walkers who are all farther than `reach` from every eye is afar: they decide at
// 7.5 Hz, and then go k_afar_ticks at once; twice as far they do at 3.75 Hz, and go k_farther_ticks. Without
// eyes nobody is.
struct Onlookers {
    std::vector<Vec3> eyes;
    float reach = 120;  // metres
};

// Index = slot. Those at `count` and above were never taken; of those below, some may be empty (is_there).
struct Crowd {
    uint32_t count = 0, capacity = 0;
    CrowdSlots slots;
    float widest = 0;  // radius of any of them, metres
    CrowdIdentity identity;
    CrowdMotion motion;
    std::vector<Journey> journeys;
    std::vector<Vec3> corners;  // k_corners a walker: the path ahead
    CrowdDecision decision;
    // Of those from under whose feet the mesh has gone, and who go through a door, the place on it that they
    // walk back to, or came from; polygon 0: of all others.
    std::vector<NavPoint> way_back;
    std::vector<Passage> passages;    // of those who come in or leave just now, by walker
    std::vector<Wayfarer> wayfarers;  // of those who have one, by walker
    bool leads = false;               // whether any was ever moved by somebody else: else none is asked
    std::vector<Downed> downed;       // by walker
    std::vector<Called> called;       // by walker
    Fellows fellows;                  // by walker; empty: nobody goes with others
    std::vector<GoesBeside> beside;   // by walker
    Driven driven;
    March march;
    PassOn pass_on = PassOn::right;
    Onlookers onlookers;
    std::vector<uint8_t>
        at_once;             // by block: ticks that its walkers go in one step: 1, or of those afar more
    uint32_t next_path = 0;  // the walker from which path requests are served next
    Demand demand;           // what draws them
    Traffic traffic;         // where they crowd
    Kerbs kerbs;             // who waits for lamps
    Roadway roadway;         // who drives
    CrowdScratch scratch;
};

// Bodies may press into each other by this much and never more, metres.
inline constexpr float k_most_overlap = 0.04f;

inline constexpr float k_pram_radius = 0.4f;  // metres, that others keep clear of round its middle
inline constexpr float k_pram_reach =
    0.2f;  // metres that it reaches ahead of that beyond the mesh's own margin

inline constexpr float k_least_radius = 0.1f, k_widest_radius = 0.5f;  // of bodies, metres

struct Walker {
    NavPoint place;
    float heading = 0;
    float preferred_speed = 1.34f;
    float radius = 0.25f;
    float lateral = 0.3f;
    uint32_t body = 0;
    float scale = 1;
    float stair_pace = 1, ahead = 0, room = 1, patience = 1, linger = 1;  // see CrowdIdentity
    Errand errand = Errand::wander;
};

// An empty crowd with room for `capacity` walkers; its demand and traffic are its maker's.
Crowd make_crowd(uint32_t capacity);

inline bool is_there(const Crowd& crowd, uint32_t slot) { return crowd.slots.place[slot] != k_nobody; }
// Whether that one is, and not another who took the slot.
inline bool is_there(const Crowd& crowd, WalkerId id) {
    return id.index < crowd.count && is_there(crowd, id.index) &&
           crowd.slots.generation[id.index] == id.generation;
}

// Whether a body of `radius` fits in at `place` without touching anybody.
bool has_room(const Crowd& crowd, Vec3 place, float radius);

// Adds a walker that stands still; returns its slot. `place` must be on the mesh, and there must be room for
// it there and in the crowd.
uint32_t add_walker(Crowd& crowd, const Surroundings& around, const Walker& walker);

void remove_walker(Crowd& crowd, uint32_t walker);

// Gives a walker a goal; its path is found in the next ticks.
void send_to(Crowd& crowd, uint32_t walker, NavPoint goal);

// The mesh `from` is exchanged for `to`, which differs from it about `changed` alone, between two ticks. Who
// stands where the new one is not walks back onto it; whose way leads past a change, or to where none leads
// any more, is due another. `from` is needed no more afterwards.
void change_mesh(Crowd& crowd, const Navmesh& from, const Navmesh& to, std::span<const Rectangle> changed,
                 uint32_t tick);

// A number that nobody else has had: of its slot, and `capacity` more for each who was there before.
inline uint32_t person_number(const Crowd& crowd, WalkerId id) {
    return id.index + id.generation * crowd.capacity;
}
// How a walker gets about.
inline By by_of(const Crowd& crowd, uint32_t walker) {
    return crowd.identity.ahead[walker] > 0 ? By::wheels : By::feet;
}
// Room for `capacity` walkers from now on, if there is less. Allocates; between two ticks.
void make_room(Crowd& crowd, uint32_t capacity);

inline bool is_by_door(const Passage& passage) {
    return passage.kind == Passage::Kind::in || passage.kind == Passage::Kind::out;
}
// Of one who comes in or leaves just now, and of one who does so by a door; null: of all others.
const Passage* passage_of(const Crowd& crowd, uint32_t walker);
const Passage* passage_by_door(const Crowd& crowd, uint32_t walker);
// Whether it is in a doorway, where it passes what is wall and no ground to all others.
bool is_in_doorway(const Crowd& crowd, uint32_t walker);
// Who is about to leave stays, and comes back.
void turn_back(Crowd& crowd, uint32_t walker);

// From now on the walker goes as `driven.wish` says, and others make way as for anybody; and it goes on about
// its errand. One of those afar does when the step is over that its block has taken: k_farther_ticks, at
// most.
void drive(Crowd& crowd, uint32_t walker);
void let_go(Crowd& crowd);

// From now on a walker is down, lying as `how` says, whose own walker it is; and up again, to go on from
// where it is.
void go_down(Crowd& crowd, uint32_t walker);
void lie_across(Crowd& crowd, const Downed& how);
void get_up(Crowd& crowd, uint32_t walker);
bool is_down(const Crowd& crowd, uint32_t walker);
// Whether others than the crowd move it.
bool is_led(const Crowd& crowd, uint32_t walker);

// From now on a walker goes where it is called to, and stands there; and on about its errand. Nobody is
// called who is driven, down, or comes in or leaves just now.
void call(Crowd& crowd, const Called& how);
void call_off(Crowd& crowd, uint32_t walker);
// Whether it is called to stay where it is, so that nobody moves it.
bool stays_put(const Crowd& crowd, uint32_t walker);
// The velocity, m/s, of one who would go with `wanted` and finds somebody lying in its way, a few metres
// ahead: round the nearer end of who lies there, where the mesh lets it.
Vec2 round_who_lies(const Crowd& crowd, const Navmesh& mesh, uint32_t walker, Vec2 wanted);

// From now on it goes this way.
void go_by_way(Crowd& crowd, const Wayfarer& way);
// How far a walker comes, straight on with that yaw, before it would leave the mesh: `reach` metres at most.
// A pram is there before who pushes it, and must have room where it turns to.
float clear_way(const Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, float yaw, float reach);
// What bounds the circles of one who staggers.
Strider strider_of(const Crowd& crowd, uint32_t walker);

// Whether a walker stands at its goal, or next to others who stand there. Who is led by no goal never does.
bool has_arrived(const Crowd& crowd, uint32_t walker);

// The walkers who share a body.
struct Folk {
    float share = 1;                  // of all walkers, against the others' shares
    float speed = 1.34f;              // the mean that they prefer, metres a second
    float most = 1.9f;                // nobody prefers to go faster
    float stair_pace = 1, ahead = 0;  // see CrowdIdentity
    float age = 30;                   // years: with sex it shifts what they are like
    bool woman = false;
};

// One of them by chance: all but its place. And one with that body.
Walker draw_walker(std::span<const Folk> folk, RandomKey key);
Walker draw_walker_as(std::span<const Folk> folk, uint32_t body, RandomKey key);
// A walker is such a one from now on, where it is. Before its gait has begun.
void become(Crowd& crowd, uint32_t walker, const Walker& how);

// The streets where a city is densest, about the median of its facades, as far as so many walkers need to
// have some 60 square metres each.
struct Neighbourhood {
    Vec2 centre;
    float radius = 0;  // metres, of a square
};
Neighbourhood find_neighbourhood(const Ground& ground, const Navmesh& mesh, uint32_t walkers);

// A crowd of `walkers` spread over the ground's sidewalks, plazas and paths without touching (on large ground
// over those about the middle of its houses, one walker to some 60 square metres), under way to where people
// go at that `hour` of the day (0..24), or to random goals where there are no destinations.
// Each belongs by chance to one of the folk, whose place in the list is its body. There is room for
// `capacity` walkers in all. Refuses more walkers than fit.
Result<Crowd> populate(const Ground& ground, const Surroundings& around,
                       std::span<const Destination> destinations, const Navmesh& mesh, Workers& workers,
                       uint32_t walkers, std::span<const Folk> folk, uint64_t seed, float hour = 17.5f,
                       uint32_t capacity = 0, const Leaving& leaving = k_nobody_leaves);

// Those afar take turns by stretches of so many blocks, which lie near each other when a crowd is set down:
// so those of one turn find each other's ground in the cache.
inline constexpr size_t k_stretch = 32;

// How long ago it was a block's turn to go so many ticks at once.
inline uint32_t ticks_since_turn(size_t block, uint32_t tick, uint32_t at_once) {
    return (tick - static_cast<uint32_t>(block / k_stretch)) % at_once;
}
// How many ticks the walkers of a block go in this one; 0: it is not their turn.
inline uint32_t ticks_due(const Crowd& crowd, size_t block, uint32_t tick) {
    const uint32_t at_once = crowd.at_once[block];
    return ticks_since_turn(block, tick, at_once) == 0 ? at_once : 0;
}
// Whether they decide.
inline bool decides(const Crowd& crowd, size_t block, uint32_t tick) {
    if (crowd.scratch.woken[block]) return true;
    if (crowd.at_once[block] > 1) return ticks_due(crowd, block, tick) > 0;
    return (tick - static_cast<uint32_t>(block)) % k_decision_ticks == 0;
}

// Who is afar; before all that follows.
void look_on(Crowd& crowd, Workers& workers, uint32_t tick);

// Goals, paths and what each walker would like. Serves a bounded number of path requests a tick.
void think(Crowd& crowd, const Navmesh& mesh, Workers& workers, uint32_t tick, uint64_t seed);

// Puts everyone in the order of places, anew every k_decision_ticks.
void find_neighbours(Crowd& crowd, Workers& workers, uint32_t tick);

// How deep any two bodies press into each other where they were when the last tick began, metres; negative
// where nobody touches. Of no more than the widest body's reach.
float deepest_overlap(const Crowd& crowd);

// A velocity near the wanted one that avoids the k_neighbours nearest within k_neighbour_reach and the mesh's
// border: optimal reciprocal collision avoidance (van den Berg et al. 2011), then a speed that keeps headway
// (Tordeux et al. 2016).
void steer(Crowd& crowd, const Navmesh& mesh, Workers& workers, uint32_t tick);

// Turns and moves everyone by one tick, on the mesh, within what legs can do. Comes after find_neighbours.
void move(Crowd& crowd, const Surroundings& around, const Navmesh& mesh, Workers& workers, uint32_t tick);

// All five.
void step_crowd(Crowd& crowd, const Surroundings& around, const Navmesh& mesh, Workers& workers,
                uint32_t tick, uint64_t seed);

// Of everything that the next tick depends on.
uint64_t hash_crowd(const Crowd& crowd);

}  // namespace flaneur
