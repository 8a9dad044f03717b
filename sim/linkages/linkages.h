// Things of bones that are no people, each led by targets that move: what inverse kinematics does by itself,
// to be looked at.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/base/parallel_for.h"
#include "sim/ik/solve.h"
#include "sim/ik/solvers.h"
#include "sim/movers/sway.h"

namespace flaneur {

// By what a linkage is solved. Only chains take another solver than FABRIK, and two bones only those of
// three joints: see takes().
struct Method {
    Solver solver = Solver::fabrik;
    Patience patience{0.001f, 200};
    bool operator==(const Method&) const = default;
};

// Where a hand holds a target, in the world, instead of where it would sway.
struct HeldTarget {
    Vec3 place{};
    uint32_t is_held = 0;
    bool operator==(const HeldTarget&) const = default;
};

struct Linkage {
    // How its joints may turn: any way, in a chain or a tree; within cones; about one axis, as a finger. One
    // that is led has no targets: whoever leads it writes its places.
    enum class Kind : uint8_t { chain, tree, cones, hinges, led };
    std::string name;
    Kind kind = Kind::chain;
    float recoil = 0;           // where each tick begins, from where the last one left it, 0, to its rest, 1
    TreeShape shape;            // of a chain too: each joint after the one before, the last led
    std::vector<float> bones;   // of each joint: metres to its parent
    std::vector<float> girth;   // of each joint: radius of that bone, metres, for who draws it
    std::vector<Vec3> rest;     // of each joint, metres from joint 0
    std::vector<float> limits;  // of cones: as Chains::limits. Of hinges: low and high of each bone, radians
    Vec3 axis{0, 1, 0};         // of cones: the middle of the first bone's; of hinges: where a bone points
                                // that is not bent,
    Vec3 hinge{1, 0, 0};        // and what all bend about
    Sway root{};                // where joint 0 is
    std::vector<Sway> leads;    // where the targets are
    Method method;              // at first
};

// A linkage's joints are [joints, joints + shape.parents.size()) of Linkages::places, its targets the same.
struct LinkageRange {
    uint32_t joints = 0, targets = 0;
};

struct Linkages {
    std::vector<Linkage> all;
    std::vector<LinkageRange> ranges;
    std::vector<Vec3> places, previous_places;    // after the last tick and the one before, metres
    std::vector<Vec3> targets, previous_targets;  // the same
    std::vector<Solved> solved;                   // of each linkage in the last tick
    std::vector<Method> methods;                  // of each linkage, by which the next tick solves it
    std::vector<HeldTarget> held;                 // of each target; moved by a hand between two ticks
    std::vector<double> solve_ms;                 // of each linkage, wall time of the last tick; measured,
                                                  // never read by the simulation
};

// The joints of one of them.
std::span<Vec3> places_of(Linkages& linkages, size_t number);

// At rest, with their targets where they begin.
Linkages make_linkages(std::vector<Linkage> all);
// Whether a linkage can be solved so: with a tolerance of more than 0 and at least one iteration, too.
bool takes(const Linkage& linkage, const Method& method);
// Moves `places`, which keep the first of them, so that the ends come to `targets`, by a method that it
// takes.
Solved solve_linkage(const Linkage& linkage, const Method& method, std::span<Vec3> places,
                     std::span<const Vec3> targets);
// Targets are where hands hold them, else where they sway; one that was let go of is back there by
// k_return_speed.
inline constexpr float k_return_speed = 3;  // m/s: faster than any exhibit's sway
void step_linkages(Linkages& linkages, Workers& workers, uint32_t tick);

// `joints` in a row upwards, slightly bowed towards +z, `bone` metres apart.
Linkage chain_linkage(int joints, float bone, Solver solver);
// The same whose bones make angles of at most `most` radians with the bone before, the first with +y.
Linkage cone_linkage(int joints, float bone, float most);
// A finger that points up and bends towards +z, with joints as people's fingers have them.
Linkage finger_linkage(float length);
// A hand that points up, its palm to +z: a palm of five bones, four fingers and a thumb.
Linkage hand_linkage(float length);
// A person of so many metres who faces +z: pelvis, spine and head, two arms, two legs; six targets with the
// pelvis, which is its root.
Linkage body_linkage(float height);
// A body with eight arms of so many bones all round.
Linkage octopus_linkage(int arm_bones, float arm_length);
// A tree of so many joints by chance, k_most_chain_joints at most, all of whose tips are led.
Linkage random_tree_linkage(int joints, float bone, uint64_t seed);

}  // namespace flaneur
