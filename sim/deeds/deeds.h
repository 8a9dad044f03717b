// People who do things with their hands, for ever: carry parcels from shelf to shelf, go through doors, climb
// over low walls. Each goes round by itself through deeds of its own, on legs that follow a wish as the
// crowd's do; a crowd knows nothing of them. Where one stands or walks the gait poses it, and what hands do
// is laid over that (bend.h); over a wall key poses take its place.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/alone/alone.h"
#include "sim/crowd/locomotion.h"
#include "sim/deeds/bend.h"
#include "sim/deeds/things.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"
#include "sim/movers/movers.h"

namespace flaneur {

inline constexpr uint32_t k_no_parcel = ~0u;

struct Deed {
    enum class What : uint8_t {
        take,   // the parcel of a shelf
        put,    // the parcel that it has onto a shelf
        push,   // a door, along its heading
        pull,   // a door, against it
        climb,  // a wall, along its heading, or against it where it stands on that side
        walk,   // to a place
    };
    What what = What::walk;
    uint32_t thing = 0;  // number of the shelf, the door or the wall
    Vec2 at{};           // where one walks; along a wall, where one climbs
};

// One who does things, and again from the first one on.
struct DoerPlan {
    std::string name;
    uint32_t kind = 0;  // of the world's: whose body it has
    Vec2 at;
    float heading = 0;
    float speed = 1.25f;  // m/s
    std::vector<Deed> round;
};

// What one is about, within a deed.
enum class DoerStage : uint32_t { go, stand, reach, act, leave };

struct Doer {
    Vec3 position{};
    Motion motion;
    uint32_t deed = 0;  // of its round
    DoerStage stage = DoerStage::go;
    uint32_t since = 0;  // ticks in the stage
    uint32_t parcel = k_no_parcel;
    uint32_t has = 0;   // 1: hands hold what they act on
    uint32_t done = 0;  // deeds
    float laden = 0;    // 0..1: how much of the parcel's weight it has
    float arms = 0;     // 0..1: how much its hands are where the deed has them
    Vec3 from{};        // where what it moves was
    Vec2 side{};        // of one who climbs: the way
};

struct Deeds {
    std::vector<DoerPlan> plans;
    Things things;
    std::shared_ptr<const Ground> ground;
    std::vector<Body> bodies;  // of each
    std::vector<float> masses;
    std::vector<Doer> doers;
    std::vector<ParcelNow> parcels, previous_parcels;
    std::vector<LeafNow> leaves, previous_leaves;
    size_t first_mover = 0;  // of the world's, that show its things
    Gait gait;
    std::vector<PoseBlock> whole, before;          // as the gait has them, after the last tick and before
    std::vector<PoseBlock> poses, previous_poses;  // as they are seen, the same
    // Of one tick alone.
    RootRows rows;
};

// Standing where they begin. `bodies` are of the plans' kinds.
Deeds make_deeds(std::vector<DoerPlan> plans, Things things, std::shared_ptr<const Ground> ground,
                 const std::vector<Body>& bodies, uint64_t seed);
// A tick, which allocates nothing.
void step_deeds(Deeds& deeds, uint64_t seed, uint32_t tick);
// After `doers`, `parcels`, `leaves`, `gait.blocks`, `whole` and `poses` were written over.
void forget_previous(Deeds& deeds);

// Writes where its things are: parcels, then of each door its leaf and its levers.
void lead_movers(const Deeds& deeds, Movers& movers);

// A joint `between` 0, the tick before the last, and 1, the last.
JointPose joint_between(const Deeds& deeds, size_t doer, Joint joint, float between);

// Where hands hold something that is not theirs, and which feet stand.
struct DeedContacts {
    Vec3 palms[2];
    bool holds[2] = {}, stands[2] = {};
};
DeedContacts contacts_of(const Deeds& deeds, size_t doer);

// "carries 10 kg", "opens the door".
std::string what_it_does(const Deeds& deeds, size_t doer);

// The speed of one who weighs `mass` kilograms and would walk at `speed`, with `load` in both arms: that at
// which it costs as much power as without, by the equation of Pandolf, Givoni & Goldman ("Predicting energy
// expenditure with loads while standing or walking very slowly", Journal of Applied Physiology 43, 1977),
// 1.5 M + 2 (M + L) (L / M)^2 + (M + L) (1.5 v^2), a kilogram in the hands counting as 1.9 (Soule & Goldman,
// "Energy cost of loads carried on the head, hands, or feet", the same 27, 1969).
float laden_speed(float speed, float mass, float load);
// Radians that the trunk leans back: half of what brings the common centre of mass over the feet again, the
// other half being the hips'. `ahead`: metres from hips to the load. Head, arms and trunk are 0.678 of the
// body and their centre a fifth of the height above the hips (Winter 2009, table 4.1).
float laden_lean(float mass, float height, float load, float ahead);

}  // namespace flaneur
