// What files of trajectories hold, format by format. Errors' sentences have no subject: "is cut short".
// Private to assets/trajectories, and its tests.
#pragma once

#include <string_view>
#include <unordered_map>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

// Somebody at a time, as a file counts.
struct FoundRow {
    double time = 0;      // seconds, or frames
    double x = 0, y = 0;  // to the east and the north; in degrees: longitude and latitude
    float z = 0;
    uint32_t who = 0;  // place in FoundTracks::names
    Vec2 facing;       // unit, z to the south; (0, 0): not known
};

struct NameHash : std::hash<std::string_view> {
    using is_transparent = void;
};

// What a reader found, before unit, rate and the like are settled.
struct FoundTracks {
    std::string format;
    std::vector<FoundRow> rows;
    std::vector<std::string> names;  // numbers or words, in order of appearance
    std::unordered_map<std::string, uint32_t, NameHash, std::equal_to<>> number_of_name;
    bool is_in_frames = false;   // `time` counts them
    bool may_be_frames = false;  // it says "time", and may count milliseconds or frames
    double fps = 0;              // frames a second, 0: not told
    double unit = 0;             // metres, 0: not told
    bool is_in_steps = false;    // each begins where and when the one before it ends
    bool is_in_degrees = false;
    bool is_in_pixels = false;  // a unit that no evidence but speed tells
    bool has_heights = false;
    HeightsOf heights = HeightsOf::nothing;  // what they are of, if the file says
    std::vector<Tracked> tracked;            // id: a place in `names`
    std::vector<WalkablePolygon> area;
    std::vector<std::vector<Vec2>> walls;
    std::vector<std::string> assumed;
    size_t left_out = 0;                        // rows without a place
    std::string geometry;                       // the name of a file of geometry that is mentioned
    std::string_view geometry_ending = ".wkt";  // how such a file's name ends
};

// A file's bytes, unpacked, and where it lies.
struct TrajectorySource {
    std::string path;
    std::string_view text;
};

Result<FoundTracks> parse_table(const TrajectorySource& source);     // text in rows and columns
Result<FoundTracks> parse_juelich(const TrajectorySource& source);   // HDF5
Result<FoundTracks> read_jupedsim(const TrajectorySource& source);   // SQLite, by its path
Result<FoundTracks> parse_sumo_fcd(const TrajectorySource& source);  // XML
Result<FoundTracks> parse_gpx(const TrajectorySource& source);       // XML
Result<FoundTracks> parse_features(const TrajectorySource& source);  // GeoJSON and moving features
Result<FoundTracks> parse_splines(const TrajectorySource& source);   // .vsp of UCY
// What lies beside tables of inD and its kin: rate and classes.
Result<void> add_recording_meta(FoundTracks& found, const std::string& path);

// The place in `names` of somebody who is called so; numbers are told apart as numbers.
uint32_t who_is(FoundTracks& found, std::string_view name);
uint32_t who_is(FoundTracks& found, int64_t number);
// Counts what is not finite instead, and refuses more than k_most_sightings.
Result<void> add_row(FoundTracks& found, const FoundRow& row);

// Seconds of ISO 8601 ("2024-05-01T12:30:15.2Z") after 1970, or of "12:30:15.2"; none where it is no time.
std::optional<double> seconds_of_moment(std::string_view text);
// By the words of SUMO, inD and others; people where none is known.
TrackedKind kind_of_word(std::string_view word);
// 1.34, without what nobody needs: at most so many digits after the point.
std::string short_number(double value, int digits = 2);

// What `unit` metres would make of them; the sentence of what was taken is added to `assumed`.
Result<Trajectories> settle_trajectories(FoundTracks found, const TrajectoryReading& reading);
// Rows, by who and then by time, on even times: afterwards `time` counts frames. Part of settling.
Result<void> settle_times(FoundTracks& found, const TrajectoryReading& reading);

}  // namespace flaneur
