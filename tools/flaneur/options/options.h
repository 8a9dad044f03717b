// The command line.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "assets/measures/profile.h"
#include "assets/measures/service.h"
#include "assets/measures/ttc.h"
#include "assets/person.h"
#include "assets/recording/head.h"
#include "assets/scene.h"
#include "assets/trajectories/trajectories.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/pose/techniques.h"
#include "tools/flaneur/measure/plan.h"

namespace flaneur {

enum class Command {
    view,
    render,
    sim,
    bench,
    gait,
    people,
    inspect,
    city,
    scenes,
    cache,
    check,
    validate,
    measure,
    replay,
    exports,
    diff,
    join
};
enum class BenchLoad {
    frame,
    window,
    crowd,
    tick,
    pose,
    city,
    peers,
    sweep,
    scale,
    ablate,
    gauntlet,
    ik,
    compare
};

// Ticks first, first + step, ... not beyond last.
struct TickRange {
    uint32_t first = 600, last = 600, step = 1;
};
inline constexpr uint32_t k_last_tick = 10'000'000;
constexpr uint32_t count(const TickRange& t) { return (t.last - t.first) / t.step + 1; }

// Which of how many parts of a film's pictures, from 1 on.
struct Shard {
    uint32_t number = 1, of = 1;
};
inline constexpr uint32_t k_most_shards = 100'000;
constexpr bool is_whole(Shard shard) { return shard.of == 1; }

enum class Sex { woman, man };
enum class StripView { side, front };

// Seconds of a walk that are looked at.
struct Moments {
    double first = 0, last = 0;  // equal: what tells most of it
};
inline constexpr double k_longest_walk = 600;

// Who walks where; zeros and empty words ask for nothing.
struct GaitOptions {
    double speed = 0;   // m/s; 0: what people of that age and sex prefer
    double height = 0;  // metres; 0: what people of that age and sex have
    Sex sex = Sex::man;
    double age = 30;
    bool cane = false, pram = false;
    Bag bag = Bag::none;
    std::string posture;  // of the hands, that one alone: one of k_posture_names
    double stand = 0;     // seconds that the person stands instead of walking
    uint64_t style = 0;   // draws what differs between people of one body; 0: the middle manner
    double seconds = 25;
    double turn = 0;                    // degrees to the left
    double aside = 0;                   // metres to the left that one who stands steps
    double change = 0;                  // m/s on the way; 0: as before. Not where bars are held
    std::string stairs;                 // up, down
    double riser = 0.17, tread = 0.29;  // metres
    double slope = 0;                   // metres up in a hundred
    double kerb = 0;                    // metres
    double leap = 0;                    // metres of a puddle
    double wall = 0;                    // metres to the left of the way; only where a strip is drawn
    int crowd = 0;                      // walkers to watch, instead of one
    bool everyone = false;              // women and men of all ages, each in every way
    bool check = false;
    std::string csv, svg, strip;
    std::string motion;  // a .bvh or a .glb
    int walker = 0;      // of a crowd, whose motion it is
    StripView view = StripView::side;
    Moments moments;       // that a strip shows,
    bool abreast = false;  // or twelve people at one moment
};

// Empty words ask for nothing.
struct PeopleOptions {
    uint32_t count = 24;     // of the built-in people, where no characters are given
    std::string folder;      // for .glb files
    std::string sheet;       // a picture of them
    bool close = false;      // of their faces
    double turn = 0;         // degrees to their left that they are turned from how a sheet shows them
    Size cell = {480, 400};  // pixels of one of them on the sheet
};

enum class BenchMove { none, follow, walk, orbit };

// Both ends belong to it.
struct WalkerRange {
    uint32_t first = 0, last = 0;
};
inline constexpr uint32_t k_most_swept = 1'000'000;
inline bool is_single(const WalkerRange& range) { return range.first == range.last; }

// Of bench loads that change one thing and look how all else follows. Empty words ask for nothing.
struct StudyOptions {
    WalkerRange walkers{100, 100'000};  // of a sweep,
    int steps = 0;                      // at so many points; 0: 1, 2, 5, 10 ..
    std::string svg;                    // a chart
    // Of the gauntlet:
    bool quick = false;
    std::string html;      // a page with charts
    std::string others;    // a folder with what other machines measured
    std::string markdown;  // goals beside what was measured
};

// What a run is held against: one of them. Empty words ask for nothing.
struct SimCheckOptions {
    std::string with;                       // another flaneur, by its path; empty: this one,
    std::vector<std::string> with_options;  // with these options
    std::string against;                    // a file that --state-log wrote
};

// Empty words ask for nothing.
struct ValidateOptions {
    std::vector<std::string> tests;     // ids; none: all
    std::vector<std::string> measured;  // files of trajectories
    std::string svg, markdown;
    bool list = false;  // tells which tests there are
};

// What is measured of a file of trajectories. Nothing asked for: all of it.
struct MeasureOptions {
    std::vector<CountLine> lines;
    std::vector<WalkablePolygon> area, walkable;  // empty: as the file says
    Moments seconds{0, 1e9}, frames{0, 1e9};      // what lies in both
    bool voronoi = false, fundamental = false, service = false, ttc = false, dwell = false;
    bool individual = false;
    double profile = 0;  // side of a square, metres; 0: not asked for
    FieldMethod profile_method = FieldMethod::voronoi;
    double cut_off = 1;       // metres; 0: none
    uint32_t frame_step = 0;  // 0: of a fifth of a second
    AtEnds at_ends = AtEnds::single_sided;
    Vec2 direction;      // (0, 0): speeds are told whichever way one goes
    double passing = 0;  // metres beside each line; 0: not asked for
    double flow_seconds = 10;
    double radius = k_disc_radius;  // metres
    ServiceOf service_of = ServiceOf::walkway;
};
inline bool asks_for_all(const MeasureOptions& o) {
    return !o.voronoi && !o.fundamental && !o.service && !o.ttc && !o.dwell && !o.individual &&
           o.profile == 0;
}

// What is recorded, of view, render, sim and bench tick.
struct RecordOptions {
    std::string path;  // empty: nothing is
    RecordedAs as = RecordedAs::motion;
    float error = 0.001f;  // of motion: metres at most; 0: to the last bit
};

// What is written for other programs.
struct ExportOptions {
    std::vector<std::string> files;    // what of, unless a scene is named; where to
    std::vector<WalkerRange> walkers;  // by number; empty: all
    Moments seconds{0, 1e9};           // from the source's beginning; all that there is
    uint32_t fps = 0;                  // 0: as is usual
};

struct Options {
    Command command = Command::view;
    Scene scene;      // with what the command line says instead
    int threads = 0;  // 0: one a core

    bool force = false;  // characters need no more than two legs

    // view, render, bench frame and tick: metres from the camera beyond which people step several ticks at
    // once (look_from in sim/sim.h); 0: nobody does.
    float lod = 0;

    // view, render, bench frame
    std::string device;
    bool validate = false;
    Techniques techniques;               // of those who are drawn; not of bench
    std::optional<bool> lights_on_host;  // rather than on the device; default: where that is a CPU

    RecordOptions record;
    std::string replay;  // view, render, check, replay: the recording that is shown; empty: a scene is
    // Of a scene that is_recorded(), where somebody has read them already: see read_recorded().
    std::shared_ptr<const Trajectories> recorded;
    bool checks_replay = false;
    ExportOptions exported;
    float within = 0;           // diff: metres that do not count
    TrajectoryReading reading;  // inspect, measure

    bool captures = false;  // view, render: RenderDoc is loaded

    // view
    uint32_t close_after = 0;        // frames; 0: stays open
    std::vector<std::string> words;  // that followed the command's name
    bool starts = false;             // with scenes to choose from

    // render
    TickRange ticks;
    std::string camera_path;  // a file (view/path.h); empty: the scene's camera
    bool has_ticks = false;   // they were asked for
    bool resume = false;
    Shard shard;
    std::string like;             // a picture whose options these are, where no others are given
    bool is_transparent = false;  // where there is sky
    uint32_t captured = 0;        // the tick whose picture RenderDoc captures, if it is loaded
    std::string depth;            // a file for depths, or a pattern as `out`; empty: none
    std::string ids;              // the same, for ids

    std::string out;  // where render, city, measure, join and bench peers write

    // sim
    double seconds = 10;
    bool hash = false;
    std::string hash_log, state_log;
    std::string isa = "best";
    MeasurePlan plan;          // what is counted
    std::string measures;      // where to: see csv_path()
    std::string trajectories;  // a file of everybody's ways,
    uint32_t fps = 25;         // with so many frames a second

    SimCheckOptions sim_check;  // check

    // bench
    BenchLoad load = BenchLoad::frame;
    uint32_t bench_frames = 120;       // or ticks, or repetitions
    uint32_t warm_up = 60;             // ticks before measuring; people get under way
    uint32_t bench_count = 100;        // characters of peers
    BenchMove move = BenchMove::none;  // how the camera of frame moves
    StudyOptions study;
    std::vector<std::string> compared;  // two files of figures, the earlier one first
    double tolerance = 5;               // percent that a stage may take longer in the later one

    // city
    bool check = false;

    bool clear_cache = false;  // cache

    std::string json;  // where bench, city, gait and inspect write their figures too

    ValidateOptions validation;
    MeasureOptions measure;
    GaitOptions gait;
    PeopleOptions people;

    // inspect, measure, export
    std::string file;

    // scenes
    std::vector<std::string> scene_files;  // to check; empty: none
    bool schema = false;

    std::string trace;  // where view, render, sim and bench write what their time went into; empty: nowhere

    std::vector<std::string> inputs;  // files that the command reads, if they are there, besides its scene's
};

// "me.glb", "me.glb:2.5" or "builtin:9": a file or the built-in people, and their share of the walkers.
Result<PeopleShare> parse_people(const std::string& text);
// Without what bodies are drawn usually where limbs are led so.
Techniques usual_techniques(LimbLead limbs);
// What --unit and the others of trajectories say, as words.
std::vector<std::string> told_reading(const TrajectoryReading& reading);
// "feet,walls": all techniques but these; "none": all. And back, of those that are off; "": as is usual.
Result<Techniques> parse_without(const std::string& text);
std::string told_without(Techniques techniques, LimbLead limbs);
// 'x,y x,y', two opposite corners, or more of them, or POLYGON ((x y, ..), ..), y to the north.
Result<std::vector<WalkablePolygon>> parse_area(const std::string& text);
// 'x,y x,y' or LINESTRING (x y, x y), with "NAME:" before it if it has one.
Result<CountLine> parse_line(const std::string& text);
// 0 .. 2^64 - 1.
Result<uint64_t> parse_seed(const std::string& text);
// "21.5:24"
Result<Moments> parse_moments(const std::string& text);
// "10:40", of any time.
Result<Moments> parse_part(const std::string& text);
// "12", "10:20" or "3,7,10:20": who by number.
Result<std::vector<WalkerRange>> parse_who(const std::string& text);
// "500", of which there may be as many as a scene has; or "100:1e6", up to k_most_swept.
Result<WalkerRange> parse_walkers(const std::string& text);
// "3/8"
Result<Shard> parse_shard(const std::string& text);
// "600", "0:600" or "0:600:2".
Result<TickRange> parse_ticks(const std::string& text);

// What to do; or, when help was asked for and printed, nothing (monostate).
Result<std::variant<std::monostate, Options>> parse_options(int argc, char** argv);

}  // namespace flaneur
