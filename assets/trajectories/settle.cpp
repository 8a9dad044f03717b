// Unit, rate, axes, heights and origin of what a reader found, by evidence where the file does not tell them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr double k_farthest_track = 1e5;      // metres
constexpr double k_far_off = 2e4;             // metres from (0, 0), where places lose millimetres
constexpr double k_faster_than_anybody = 20;  // m/s
constexpr double k_usual_speed = 1.34;        // m/s; Weidmann 1993
constexpr size_t k_enough_steps = 1'000'000;
constexpr double k_units[] = {1, 0.01, 0.001};
constexpr const char* k_unit_names[] = {"Metres", "Centimetres", "Millimetres"};

bool by_who_then_time(const FoundRow& a, const FoundRow& b) {
    return std::tuple(a.who, a.time, a.x, a.y) < std::tuple(b.who, b.time, b.x, b.y);
}

// One row of each at a time.
Result<void> drop_doubles(FoundTracks& found) {
    size_t kept = 0, elsewhere = 0;
    const FoundRow* last = nullptr;
    std::string whom;
    std::vector<FoundRow>& rows = found.rows;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (last && last->who == rows[i].who && last->time == rows[i].time) {
            if (last->x == rows[i].x && last->y == rows[i].y) continue;
            if (elsewhere++ == 0)
                whom = found.names[rows[i].who] + " twice " +
                       (found.is_in_frames ? "in frame " : "at second ") + short_number(rows[i].time, 3);
            continue;
        }
        rows[kept] = rows[i];
        last = &rows[kept++];
    }
    if (elsewhere * 100 > rows.size()) return Error{"has number " + whom + ", in different places"};
    if (kept < rows.size() && (!found.is_in_steps || elsewhere > 0))
        found.assumed.push_back(std::to_string(rows.size() - kept) +
                                (whom.empty() ? " rows that are there twice are left out."
                                              : " rows have somebody once more at a time, as number " + whom +
                                                    ", elsewhere: they are left out."));
    rows.resize(kept);
    return {};
}

// Calls tell(a, b) with two rows of one person after the other.
template <class Tell>
void each_step(const FoundTracks& found, Tell&& tell) {
    for (size_t i = 1; i < found.rows.size(); ++i)
        if (found.rows[i].who == found.rows[i - 1].who) tell(found.rows[i - 1], found.rows[i]);
}

// The middle one of the speeds of people who move, as the file counts lengths and times; 0: nobody does.
double usual_speed(const FoundTracks& found) {
    std::vector<bool> drives(found.names.size());
    size_t drivers = 0;
    for (const Tracked& tracked : found.tracked)
        if (tracked.kind != TrackedKind::person) drives[tracked.id] = true, ++drivers;
    if (drivers >= found.names.size()) drives.assign(found.names.size(), false);
    const size_t every = found.rows.size() / k_enough_steps + 1;
    size_t number = 0;
    std::vector<double> speeds;
    each_step(found, [&](const FoundRow& a, const FoundRow& b) {
        if (number++ % every != 0 || drives[a.who]) return;
        const double way = std::hypot(b.x - a.x, b.y - a.y);
        if (way > 0) speeds.push_back(way / (b.time - a.time));
    });
    if (speeds.empty()) return 0;
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    std::nth_element(speeds.begin(), middle, speeds.end());
    return std::isfinite(*middle) ? *middle : 0;
}

struct TracksBox {
    double low_x = std::numeric_limits<double>::max(), low_y = low_x, high_x = -low_x, high_y = -low_x;
};

TracksBox box_of_tracks(const FoundTracks& found) {
    TracksBox box;
    for (const FoundRow& row : found.rows) {
        box.low_x = std::min(box.low_x, row.x), box.high_x = std::max(box.high_x, row.x);
        box.low_y = std::min(box.low_y, row.y), box.high_y = std::max(box.high_y, row.y);
    }
    return box;
}

// Degrees of WGS84 as metres about the middle.
Result<void> settle_degrees(FoundTracks& found) {
    const TracksBox box = box_of_tracks(found);
    if (box.low_x < -180.001 || box.high_x > 180.001 || box.low_y < -90 || box.high_y > 90)
        return Error{"has degrees that are none on Earth"};
    const double east = (box.low_x + box.high_x) / 2, north = (box.low_y + box.high_y) / 2;
    const double cosine = static_cast<double>(sin_cos(static_cast<float>(north) * k_pi / 180).cosine);
    const double twice = 2 * cosine * cosine - 1;  // the cosine of twice the latitude
    const double metres_north = 111'132.92 - 559.82 * twice + 1.175 * (2 * twice * twice - 1);
    const double metres_east = 111'412.84 * cosine - 93.5 * (cosine * (2 * twice - 1));
    for (FoundRow& row : found.rows) {
        row.x = (row.x - east) * metres_east;
        row.y = (row.y - north) * metres_north;
    }
    found.assumed.push_back("Degrees: metres are about the middle, " + short_number(north, 6) + " north, " +
                            short_number(east, 6) + " east.");
    found.unit = 1;
    return {};
}

// Which axis points upwards: people climb less than they walk.
void settle_up(FoundTracks& found, char asked) {
    if (!found.has_heights) return;
    bool is_y = asked == 'y';
    if (asked == 0 && !found.is_in_degrees) {
        double x = 0, y = 0, z = 0;
        each_step(found, [&](const FoundRow& a, const FoundRow& b) {
            x += std::fabs(b.x - a.x), y += std::fabs(b.y - a.y), z += std::fabs(wide(b.z) - wide(a.z));
        });
        is_y = z > 3 * y && z > 0.8 * x;
        if (is_y)
            found.assumed.push_back(
                "The second axis points upwards, as people would climb more than they walk else.");
    }
    if (!is_y) return;
    for (FoundRow& row : found.rows) {
        const double up = row.y;
        row.y = -wide(row.z);  // right-handed
        row.z = static_cast<float>(up);
    }
}

// Times of a column that says no unit: seconds, parts of them, or frames.
void settle_counting(FoundTracks& found) {
    if (found.is_in_frames || !found.may_be_frames) return;
    double last = 0;
    bool is_whole = true;
    for (const FoundRow& row : found.rows) {
        last = std::max(last, std::fabs(row.time));
        is_whole = is_whole && row.time == std::floor(row.time);
    }
    double part = 1;
    const char* name = "";
    // Since 1970.
    if (last > 1e17)
        part = 1e-9, name = "nanoseconds";
    else if (last > 1e14)
        part = 1e-6, name = "microseconds";
    else if (last > 1e11)
        part = 1e-3, name = "milliseconds";
    const double speed = usual_speed(found) * (found.unit > 0 ? found.unit : 1);
    if (part == 1 && is_whole && speed > 0 && speed < 0.2) {
        if (speed * 1000 < 0.3 || speed * 1000 > 5) {
            found.is_in_frames = true;
            found.assumed.push_back("Times count frames, as people would walk " + short_number(speed, 3) +
                                    " m/s else.");
            return;
        }
        part = 1e-3, name = "milliseconds";
    }
    if (part == 1) return;
    for (FoundRow& row : found.rows) row.time *= part;
    found.assumed.push_back(std::string("Times are in ") + name + ", as their size tells.");
}

double how_odd(double speed) { return std::fabs(std::log(speed / k_usual_speed)); }

// Frames a second where nothing says how many.
void settle_rate(FoundTracks& found, float asked) {
    if (!found.is_in_frames) return;
    if (asked > 0) found.fps = static_cast<double>(asked);
    if (found.fps > 0) return;
    found.fps = 25;
    const double way = usual_speed(found);  // a frame
    if (way <= 0) return found.assumed.push_back("25 frames a second, as most cameras have.");
    // 25 first, then what is likeliest, in metres or what is known, then in smaller units.
    double unit = found.unit > 0 ? found.unit : 1;
    for (const double other : k_units)
        if (found.unit <= 0 && way * 25 * other > 0.5 && way * 25 * other < 2.5) unit = other;
    double speed = way * unit * 25;
    if (speed < 0.5 || speed > 2.5)
        for (const double fps : {30.0, 10.0, 50.0, 16.0, 8.0, 15.0, 60.0, 100.0, 5.0, 4.0, 2.5, 2.0, 1.0})
            for (const double other : k_units) {
                if (found.unit > 0 && other != 1) continue;
                const double by = found.unit > 0 ? found.unit : other;
                if (how_odd(way * by * fps) < how_odd(speed) - 0.05) found.fps = fps, speed = way * by * fps;
            }
    found.assumed.push_back(short_number(found.fps) + " frames a second, as people walk " +
                            short_number(speed) + " m/s then.");
}

void settle_unit(FoundTracks& found, float asked) {
    if (asked > 0) found.unit = static_cast<double>(asked);
    if (found.unit <= 0) {
        const double speed = usual_speed(found) * (found.is_in_frames ? found.fps : 1);  // a second
        size_t k = 0;
        while (k + 1 < std::size(k_units) && speed * k_units[k] > k_faster_than_anybody) ++k;
        found.unit = k_units[k];
        if (found.is_in_pixels && speed > 0) {
            found.unit = k_usual_speed / speed;
            found.assumed.push_back("Pixels: one is " + short_number(found.unit, 5) +
                                    " m, so that people walk " + short_number(k_usual_speed) + " m/s.");
        } else if (k > 0) {
            found.assumed.push_back(std::string(k_unit_names[k]) + ", as people would walk " +
                                    short_number(speed * k_units[k - 1], 0) + " m/s else.");
        } else {
            found.assumed.push_back(speed > 0 ? "Metres, as people walk " + short_number(speed) + " m/s then."
                                              : "Metres, as nobody moves who would tell.");
        }
    }
    if (found.unit == 1) return;
    for (FoundRow& row : found.rows) {
        row.x *= found.unit, row.y *= found.unit;
        row.z = static_cast<float>(wide(row.z) * found.unit);
    }
}

Result<void> settle_origin(FoundTracks& found, const std::optional<Vec2>& asked) {
    double x = 0, y = 0;
    const TracksBox box = box_of_tracks(found);
    if (!(box.high_x - box.low_x <= 2 * k_farthest_track) ||
        !(box.high_y - box.low_y <= 2 * k_farthest_track) ||
        !(std::max(std::fabs(box.low_x), std::fabs(box.low_y)) <= 1e8))
        return Error{"has places that lie beyond 100 km from their middle"};
    if (asked) {
        x = wide(asked->x) * found.unit, y = wide(asked->z) * found.unit;
    } else if (std::max({-box.low_x, box.high_x, -box.low_y, box.high_y}) > k_far_off) {
        x = std::round((box.low_x + box.high_x) / 2), y = std::round((box.low_y + box.high_y) / 2);
        found.assumed.push_back("(0, 0) is at " + short_number(x) + " east, " + short_number(y) +
                                " north of the file's, so that millimetres are kept.");
    }
    if (x == 0 && y == 0) return {};
    for (FoundRow& row : found.rows) row.x -= x, row.y -= y;
    const Vec2 by{static_cast<float>(x), -static_cast<float>(y)};
    for (WalkablePolygon& polygon : found.area) {
        polygon.level += dot(polygon.rise, by);
        for (Vec2& corner : polygon.outer) corner = corner - by;
        for (std::vector<Vec2>& hole : polygon.holes)
            for (Vec2& corner : hole) corner = corner - by;
    }
    for (std::vector<Vec2>& wall : found.walls)
        for (Vec2& corner : wall) corner = corner - by;
    return {};
}

void settle_heights(FoundTracks& found) {
    if (!found.has_heights) return void(found.heights = HeightsOf::nothing);
    if (found.heights != HeightsOf::nothing) return;
    size_t of_heads = 0;
    for (const FoundRow& row : found.rows) of_heads += row.z >= 1.0f && row.z <= 2.2f;
    std::vector<float> heights;
    for (size_t i = 0; i < found.rows.size(); i += found.rows.size() / k_enough_steps + 1)
        heights.push_back(found.rows[i].z);
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    const bool is_heads = of_heads * 100 >= found.rows.size() * 95 && *middle >= 1.4f && *middle <= 2.1f;
    found.heights = is_heads ? HeightsOf::heads : HeightsOf::ground;
    found.assumed.push_back(is_heads ? "Heights are those of heads, as " + short_number(wide(*middle)) +
                                           " m is as tall as people are."
                                     : "Heights are those of the ground, as heads are not that high.");
}

struct TrackIds {
    std::vector<uint32_t> of;  // by place in FoundTracks::names
    bool are_words = false;
};

// Numbers that are in the file where all are numbers; else places in it.
TrackIds track_ids_of(const FoundTracks& found) {
    TrackIds ids{std::vector<uint32_t>(found.names.size()), false};
    for (uint32_t i = 0; i < ids.of.size() && !ids.are_words; ++i) {
        const std::string_view name = found.names[i];
        ids.are_words = !parse_number(name, ids.of[i]) || (name[0] == '0' && name.size() > 1);
    }
    for (uint32_t i = 0; i < ids.of.size() && ids.are_words; ++i) ids.of[i] = i;
    return ids;
}

// Everybody's names, where they are words, among what else is known of them.
void tell_names(Trajectories& t, const FoundTracks& found, const TrackIds& ids) {
    std::vector<bool> is_told(ids.of.size());
    for (const Tracked& tracked : t.tracked) is_told[tracked.id] = true;
    for (uint32_t i = 0; i < ids.of.size() && ids.are_words; ++i)
        if (!is_told[i]) t.tracked.push_back({.id = i, .name = {}});
    for (Tracked& tracked : t.tracked) {
        if (ids.are_words && tracked.name.empty()) tracked.name = found.names[tracked.id];
        tracked.id = ids.of[tracked.id];
    }
    std::sort(t.tracked.begin(), t.tracked.end(),
              [](const Tracked& a, const Tracked& b) { return a.id < b.id; });
}

void tell_jumps(FoundTracks& found) {
    size_t jumps = 0;
    each_step(found, [&](const FoundRow& a, const FoundRow& b) {
        jumps += std::hypot(b.x - a.x, b.y - a.y) * found.fps > (b.time - a.time) * 60;
    });
    if (jumps > 0)
        found.assumed.push_back(std::to_string(jumps) +
                                " times somebody is elsewhere at once, faster than 60 m/s; that is kept.");
}

}  // namespace

Result<Trajectories> settle_trajectories(FoundTracks found, const TrajectoryReading& reading) {
    if (found.left_out > 0)
        found.assumed.push_back(std::to_string(found.left_out) +
                                " rows without a place or a time are left out.");
    if (found.rows.empty()) return Error{"has nobody in it"};
    std::sort(found.rows.begin(), found.rows.end(), by_who_then_time);
    if (Result<void> single = drop_doubles(found); !single) return single.error();
    settle_up(found, reading.up);
    if (found.is_in_degrees)
        if (Result<void> flat = settle_degrees(found); !flat) return flat.error();
    settle_counting(found);
    settle_rate(found, reading.fps);
    if (found.is_in_frames && !(found.fps > 0 && found.fps <= 1000))
        return Error{"has a rate of frames that is not from 0 to 1000 a second"};
    settle_unit(found, reading.unit);
    if (Result<void> near = settle_origin(found, reading.origin); !near) return near.error();
    if (Result<void> even = settle_times(found, reading); !even) return even.error();
    settle_heights(found);
    tell_jumps(found);

    Trajectories t;
    t.format = std::move(found.format);
    t.fps = static_cast<float>(found.fps);
    t.heights = found.heights;
    t.area = std::move(found.area);
    t.walls = std::move(found.walls);
    const TrackIds ids = track_ids_of(found);
    t.tracked = std::move(found.tracked);
    tell_names(t, found, ids);
    t.sightings.reserve(found.rows.size());
    for (const FoundRow& row : found.rows) {
        if (!(std::fabs(row.x) <= k_farthest_track) || !(std::fabs(row.y) <= k_farthest_track) ||
            !(std::fabs(row.z) <= k_farthest_track))
            return Error{"has a place that lies beyond 100 km"};
        t.sightings.push_back({static_cast<uint32_t>(row.time),
                               ids.of[row.who],
                               {static_cast<float>(row.x), 0 - static_cast<float>(row.y)},
                               found.has_heights ? row.z : 0,
                               row.facing});
    }
    std::sort(t.sightings.begin(), t.sightings.end(), [](const Sighting& a, const Sighting& b) {
        return std::tuple(a.frame, a.id) < std::tuple(b.frame, b.id);
    });
    t.assumed = std::move(found.assumed);
    return t;
}

}  // namespace flaneur
