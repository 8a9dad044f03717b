// What `flaneur measure` measures of a file of trajectories: taken, told, written and drawn.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/measures/lines.h"
#include "assets/measures/moments.h"
#include "assets/measures/profile.h"
#include "assets/measures/ttc.h"
#include "assets/trajectories/trajectories.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

inline constexpr double k_fundamental_bin = 0.25;  // people to a square metre

struct MeasuredLineFlow {
    CountLine line;
    std::vector<LineCrossed> crossings = {}, first = {};  // all, and each person's first one
    std::vector<FlowInterval> flows = {};
    std::vector<PassedThrough> passages = {};
};

// `table` points into `tracks`: to be neither copied nor moved.
struct MeasuredFile {
    MeasureOptions options;
    Trajectories tracks;             // of people, without what is no person
    std::vector<std::string> notes;  // sentences: what was assumed, what was left out
    TrackTable table;
    std::vector<WalkablePolygon> walkable;
    MeasuredArea area;
    CellGround ground;
    FrameRange range;
    std::vector<Vec2> velocities;
    std::vector<float> speeds;
    // What was not asked for is empty.
    std::vector<AreaMoment> moments;
    std::optional<Profiles> profiles;
    std::vector<NextCollision> next_collisions;
    std::vector<Sojourn> sojourns;
    std::vector<PersonalSpace> spaces;
    std::vector<Vec2> accelerations;
    std::vector<MeasuredLineFlow> lines;
    MeasuredFile() = default;
    MeasuredFile(const MeasuredFile&) = delete;
    MeasuredFile& operator=(const MeasuredFile&) = delete;
};

// Refuses, in a sentence, an area that nobody can walk on, a part of the time when nobody is there, and maps
// of more squares than k_most_field_squares.
Result<void> measure_file(Trajectories tracks, const MeasureOptions& options, Workers& workers,
                          MeasuredFile& measured);

// Columns of the same length.
struct MeasuredColumn {
    std::string name;                 // with its unit, as in speed_m_per_s
    int digits = 4;                   // behind the point
    std::vector<double> values = {};  // NaN: empty
};
struct MeasuredTable {
    std::string name;                      // of its file and its key in JSON
    std::vector<std::string> labels = {};  // a first column of words, called "level"; empty: none
    std::vector<MeasuredColumn> columns = {};
};
// All but each person in each frame.
std::vector<MeasuredTable> tables_of(const MeasuredFile& measured);
std::string table_csv(const MeasuredTable& table);
// Each person in each frame.
std::string individual_csv(const MeasuredFile& measured);

// What it comes to, for a terminal; `name` is that of the file. And all of it but individuals, as JSON.
std::string told_measures(const MeasuredFile& measured, const std::string& name);
std::string measures_json(const MeasuredFile& measured, const std::string& name);

struct MeasuredChart {
    std::string name, svg;
};
std::vector<MeasuredChart> charts_of(const MeasuredFile& measured);
// One below the other.
std::string stacked_charts(const MeasuredFile& measured);

}  // namespace flaneur
