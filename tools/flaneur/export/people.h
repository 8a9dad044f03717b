// People of a world, frame by frame as they are drawn, for a file.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "assets/gltf/group/group.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/motion/motion.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct PeopleTaking {
    std::vector<WalkerRange> wanted;      // by number; empty: all
    bool has_their_numbers = false;       // see number_of()
    GlbGroup group;                       // its fps is told beforehand
    std::set<uint32_t> seen;              // numbers of all who were there, wanted or not
    size_t poses = 0;                     // in the group
    std::map<uint32_t, size_t> place_of;  // in the group, by number
    PeopleFrame drawn;
};

// To be called after each tick, the `tick`th of what is taken, from 0 on. What is drawn at the frames that
// lie after the tick before, and not after this one; frame 0 is tick 0. `characters` are kept alive.
void take_people(PeopleTaking& taking, const World& world, const std::vector<Character>& characters,
                 uint32_t tick);

// Joints as the simulation has them, in a frame by its place in GlbPerson::frames.
JointPoses joints_of(const GlbPerson& person, size_t i);

}  // namespace flaneur
