// Where people were, frame by frame: measured, or simulated by any program.
//
// Files have x and y on the plane and z upwards; we have x and z on the plane and y upwards, right-handed
// both. So x is x, y is -z and z is y: as on a map, with north up and +z to the south. Metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/trajectory_reading.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

// Somebody in a frame.
struct Sighting {
    uint32_t frame = 0, id = 0;
    Vec2 at;
    float height = 0;  // as Trajectories::heights says
    Vec2 facing;       // unit; (0, 0): not known
};

// What the heights of a file are: of nothing (places on a plane), of the ground, or of heads, as overhead
// cameras have them.
enum class HeightsOf : uint8_t { nothing, ground, heads };

enum class TrackedKind : uint8_t { person, bicycle, car, van, bus, tram };
// What a file tells of one of its ids, other than where it is.
struct Tracked {
    uint32_t id = 0;
    std::string name;  // where ids are words
    TrackedKind kind = TrackedKind::person;
    float length = 0, width = 0, height = 0;  // metres; 0: not known
};

// An outline, and those of what nobody can stand on in it. Either way round; the last corner is not the first
// one again. At a place it is `level + rise.x * at.x + rise.y * at.y` high.
struct WalkablePolygon {
    std::vector<Vec2> outer;
    std::vector<std::vector<Vec2>> holes;
    float level = 0;
    Vec2 rise{};
};

struct Trajectories {
    std::string format;               // what the file is: "FCD of SUMO"
    float fps = 25;                   // frames a second; frame f is f / fps seconds after frame 0
    std::vector<Sighting> sightings;  // by frame, then by id; nobody is twice in a frame
    HeightsOf heights = HeightsOf::nothing;
    std::vector<Tracked> tracked;          // by id; who is not in it is a person of unknown size
    std::vector<WalkablePolygon> area;     // where people can be; empty: no file says
    std::vector<std::vector<Vec2>> walls;  // lines that nobody crosses, and that no outline has
    std::vector<std::string> assumed;      // sentences: what was not in the file, and why it was taken so
};

// What a file tells of somebody; null: nothing, so that it is a person.
const Tracked* tracked_of(const Trajectories& tracks, uint32_t id);
// The ids of what is no person, rising.
std::vector<uint32_t> ids_of_vehicles(const Trajectories& tracks);

inline constexpr size_t k_most_sightings = 20'000'000;

// By what is in a file, whatever it is called, packed by gzip or not; docs/trajectories.md has the table of
// formats, and how unit, rate, axes and the kind of heights are found where none is told: a sentence each in
// Trajectories::assumed. Times that are not even are put on even ones along straight lines.
// Refuses, in a sentence, what cannot be read or is cut short, places farther than 100 km from each other,
// somebody in two places at once in more than one of a hundred rows, nobody at all, and more than
// k_most_sightings. Rows whose places are no numbers are left out, and counted in `assumed`.
Result<Trajectories> read_trajectories(const std::string& path, const TrajectoryReading& reading = {});

}  // namespace flaneur
