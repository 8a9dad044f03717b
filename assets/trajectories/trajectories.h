// Where people were, frame by frame: measured, or simulated by any program.
//
// Files have x and y on the plane and z upwards; we have x and z on the plane and y upwards, right-handed
// both. So x is x, y is -z and z is y: as on a map, with north up and +z to the south. Metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

// Somebody in a frame.
struct Sighting {
    uint32_t frame = 0, id = 0;
    Vec2 at;
    float height = 0;  // of the ground; of the head in files of PeTrack
    Vec2 facing;       // unit; (0, 0): not known
};

// An outline, and those of what nobody can stand on in it. Either way round; the last corner is not the first
// one again.
struct WalkablePolygon {
    std::vector<Vec2> outer;
    std::vector<std::vector<Vec2>> holes;
};

struct Trajectories {
    float fps = 25;                     // frames a second; frame f is f / fps seconds after frame 0
    std::vector<Sighting> sightings;    // by frame, then by id; nobody is twice in a frame
    std::vector<WalkablePolygon> area;  // where people can be; empty: the file does not say
};

inline constexpr size_t k_most_sightings = 20'000'000;

// By how its name ends:
//   .txt            PeTrack and jpscore: "id frame x y [z ..]" a row, and comments that begin with #, of
//                   which one has "framerate". Metres or centimetres, as a comment says ("x/m", "in m",
//                   "x/cm", "in cm"); where none does, centimetres if people would go faster than 20 m/s
//                   else.
//   .csv            as TrajectoryWriter writes it
//   .sqlite         JuPedSim, version 1 or 2
//   .h5, .hdf5      of the Juelich data archive: the data set "trajectory" and the attribute "wkt_geometry"
// Refuses, in a sentence, what cannot be read, is cut short, has numbers that are not finite or lie beyond
// 100 km, somebody twice in a frame, nobody at all, and more than k_most_sightings.
Result<Trajectories> read_trajectories(const std::string& path);

}  // namespace flaneur
