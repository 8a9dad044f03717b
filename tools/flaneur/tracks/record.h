// Everyone's ways as a file for other programs (assets/trajectories/write.h), while the simulation goes on.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "assets/trajectories/write.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

struct World;

// Frame f is f / fps seconds after the first tick, or after the one that it begins with. Where that lies
// between two ticks, places and the way that people face are so too, on straight lines, and who is not there
// after both of them is left out. Walkers have their number, and those who come into the place of one that
// has left that number and WorldOptions::capacity for each who was there before.
struct TrackRecord {
    PartFilePtr file;  // null: nothing is recorded
    TrajectoryWriterPtr writer;
    uint32_t fps = 25;
    uint32_t frame = 0;  // the next one
    struct Before {
        bool is_there = false;
        uint32_t generation = 0;
        Vec3 at;
        float heading = 0;
    };
    std::vector<Before> before;  // by slot, after the last tick
    std::vector<Sighting> people;
    uint32_t begin = 0;  // the tick of frame 0
    // Of those who follow traces, numbers are those that they had there.
    bool has_their_numbers = false;
    std::vector<WalkerRange> wanted;     // by number; empty: all
    std::set<uint32_t>* seen = nullptr;  // gets the numbers of all who were there, wanted or not
};

// What somebody is called. `as_traced`: as in the traces that the world follows, if it follows some.
uint32_t number_of(const World& world, uint32_t walker, bool as_traced);
bool is_wanted(const std::vector<WalkerRange>& wanted, uint32_t number);

// Refuses names that end in no format, and databases that would go to a pipe.
Result<PartFilePtr> open_tracks(const std::string& path);
// From the first tick on.
Result<void> begin_tracks(TrackRecord& record, const World& world, uint32_t fps);
// After each tick. False where it could not be written, as finish_tracks() then tells.
bool add_tick(TrackRecord& record, const World& world);
Result<void> finish_tracks(TrackRecord record);

}  // namespace flaneur
