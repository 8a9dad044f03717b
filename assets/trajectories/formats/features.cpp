// GeoJSON: points with an id and a time, lines with a time for each corner, moving points after OGC's Moving
// Features (19-045r3), and polygons as ground. Degrees, unless it says another system of coordinates or
// nobody could go as fast.
#include <algorithm>
#include <cmath>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/formats/columns.h"
#include "assets/trajectories/formats/json.h"

namespace flaneur {
namespace {

constexpr size_t k_most_feature_values = 20'000'000;

// The first of some members that is there.
const TracksJson& first_in_json(const TracksJson& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (const TracksJson& value = in_json(object, key); !value.is_null()) return value;
    return in_json(TracksJson(), "");
}

// Numbers are milliseconds in moving features, seconds elsewhere.
std::optional<double> feature_time(const TracksJson& value, double second) {
    if (value.is_number()) return value.get<double>() * second;
    if (value.is_string()) return seconds_of_moment(value.get_ref<const std::string&>());
    return std::nullopt;
}

bool read_place(const TracksJson& coordinates, FoundRow& row, bool& has_height) {
    if (!coordinates.is_array() || coordinates.size() < 2 || !coordinates[0].is_number() ||
        !coordinates[1].is_number())
        return false;
    row.x = coordinates[0].get<double>(), row.y = coordinates[1].get<double>();
    row.z = 0;
    if (coordinates.size() > 2 && coordinates[2].is_number()) {
        row.z = static_cast<float>(coordinates[2].get<double>());
        has_height = true;
    }
    return true;
}

struct Features {
    FoundTracks found;
    size_t number = 0;  // of the one that is read
    bool counts_frames = false, counts_seconds = false;
    std::vector<const TracksJson*> polygons{};
};

Error at_feature(const Features& f, const std::string& what) {
    return Error{"has in feature " + std::to_string(f.number) + " " + what};
}

uint32_t owner_of(Features& f, const TracksJson& feature) {
    const TracksJson& properties = in_json(feature, "properties");
    const TracksJson* id = &in_json(feature, "id");
    if (id->is_null())
        id = &first_in_json(properties, {"id", "agent_id", "ped_id", "person", "track_id", "name"});
    if (id->is_number_integer()) return who_is(f.found, id->get<int64_t>());
    if (id->is_string() && !id->get_ref<const std::string&>().empty())
        return who_is(f.found, std::string_view(id->get_ref<const std::string&>()).substr(0, 200));
    return who_is(f.found, "feature " + std::to_string(f.number));
}

Result<void> add_line(Features& f, const TracksJson& coordinates, const TracksJson& times, double second,
                      uint32_t who) {
    if (!coordinates.is_array() || !times.is_array() || coordinates.size() != times.size())
        return at_feature(f, "not as many times as places");
    for (size_t i = 0; i < times.size(); ++i) {
        FoundRow row{.who = who, .facing = {}};
        const std::optional<double> time = feature_time(times[i], second);
        if (!time || !read_place(coordinates[i], row, f.found.has_heights))
            return at_feature(f, "a place or a time that is none");
        row.time = *time;
        if (Result<void> added = add_row(f.found, row); !added) return at_feature(f, added.error().message);
    }
    f.counts_seconds = true;
    return {};
}

Result<void> add_moving(Features& f, const TracksJson& temporal, uint32_t who) {
    if (temporal.is_array() || in_json(temporal, "prisms").is_array()) {
        for (const TracksJson& part : temporal.is_array() ? temporal : in_json(temporal, "prisms"))
            if (Result<void> added = part.is_object() ? add_moving(f, part, who) : Result<void>(); !added)
                return added;
        return {};
    }
    const TracksJson& times = first_in_json(temporal, {"datetimes", "dateTimes"});
    return add_line(f, in_json(temporal, "coordinates"), times, 1e-3, who);
}

Result<void> add_point(Features& f, const TracksJson& feature, const TracksJson& coordinates) {
    const TracksJson& properties = in_json(feature, "properties");
    FoundRow row{.facing = {}};
    if (!read_place(coordinates, row, f.found.has_heights)) return at_feature(f, "a place that is none");
    const TracksJson& frame = in_json(properties, "frame");
    const TracksJson& time = first_in_json(properties, {"time", "t", "timestamp", "datetime", "when"});
    if (const std::optional<double> seconds = feature_time(time, 1)) {
        row.time = *seconds, f.counts_seconds = true;
    } else if (frame.is_number()) {
        row.time = frame.get<double>(), f.counts_frames = true;
    } else {
        return {};  // a thing that stands there
    }
    row.who = owner_of(f, feature);
    if (Result<void> added = add_row(f.found, row); !added) return at_feature(f, added.error().message);
    return {};
}

Result<void> add_feature(Features& f, const TracksJson& feature) {
    ++f.number;
    const TracksJson& geometry = in_json(feature, "geometry");
    const TracksJson& properties = in_json(feature, "properties");
    const TracksJson& type = in_json(geometry, "type");
    if (const TracksJson& moving = in_json(feature, "temporalGeometry"); !moving.is_null())
        return add_moving(f, moving, owner_of(f, feature));
    const TracksJson& times = first_in_json(properties, {"datetimes", "dateTimes", "times", "coordTimes"});
    if (type == "LineString" && times.is_array())
        return add_line(f, in_json(geometry, "coordinates"), times,
                        in_json(properties, "datetimes").is_array() ? 1e-3 : 1, owner_of(f, feature));
    if (type == "Point") return add_point(f, feature, in_json(geometry, "coordinates"));
    if (type == "Polygon") f.polygons.push_back(&in_json(geometry, "coordinates"));
    if (type == "MultiPolygon")
        for (const TracksJson& polygon : in_json(geometry, "coordinates")) f.polygons.push_back(&polygon);
    return {};
}

// Whether x and y are degrees: where no system is named, GeoJSON has them; and ours names none on Earth.
bool are_degrees(const TracksJson& root, const FoundTracks& found) {
    const TracksJson& crs = first_in_json(root, {"crs", "coordRefSys"});
    const std::string named =
        crs.is_null() ? "" : crs.dump(-1, ' ', false, TracksJson::error_handler_t::replace);
    if (named.find("CRS84") != std::string::npos || named.find("4326") != std::string::npos) return true;
    if (!named.empty()) return false;
    return std::all_of(found.rows.begin(), found.rows.end(),
                       [](const FoundRow& row) { return std::fabs(row.x) <= 180 && std::fabs(row.y) <= 90; });
}

// Metres alone: what is in degrees is told by places, and no ground is cut out of a map here.
void add_polygons(Features& f) {
    if (f.found.is_in_degrees) {
        if (!f.polygons.empty())
            f.found.assumed.push_back(std::to_string(f.polygons.size()) +
                                      " polygons in degrees are left out.");
        return;
    }
    for (const TracksJson* rings : f.polygons) {
        WalkablePolygon polygon;
        bool is_sound = rings->is_array() && !rings->empty();
        for (size_t k = 0; is_sound && k < rings->size(); ++k) {
            std::vector<Vec2> ring;
            FoundRow row;
            bool ignored = false;
            if (!(*rings)[k].is_array()) break;
            for (const TracksJson& corner : (*rings)[k])
                if (read_place(corner, row, ignored) && std::fabs(row.x) <= 1e5 && std::fabs(row.y) <= 1e5)
                    ring.push_back({static_cast<float>(row.x), 0 - static_cast<float>(row.y)});
            if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
            is_sound = ring.size() > 2;
            if (is_sound && k == 0)
                polygon.outer = std::move(ring);
            else if (is_sound)
                polygon.holes.push_back(std::move(ring));
        }
        if (polygon.outer.size() > 2) f.found.area.push_back(std::move(polygon));
    }
}

}  // namespace

Result<FoundTracks> parse_features(const TrajectorySource& source) {
    Result<TracksJson> parsed = parse_tracks_json(source.text, k_most_feature_values);
    if (!parsed) return parsed.error();
    const TracksJson& root = *parsed;
    Features f;
    f.found.format = "GeoJSON";
    const TracksJson& features = in_json(root, "features");
    if (features.is_array()) {
        for (const TracksJson& feature : features)
            if (Result<void> added = add_feature(f, feature); !added) return added.error();
    } else if (Result<void> added = add_feature(f, root); !added) {
        return added.error();
    }
    if (source.text.find("temporalGeometry") != std::string_view::npos)
        f.found.format = "moving features (MF-JSON)";
    if (f.counts_frames && f.counts_seconds) return Error{"has times of some people and frames of others"};
    f.found.is_in_frames = f.counts_frames;
    f.found.is_in_degrees = are_degrees(root, f.found);
    if (!f.found.is_in_degrees && !first_in_json(root, {"crs", "coordRefSys"}).is_null()) f.found.unit = 1;
    if (f.found.rows.empty())
        return Error{
            "is JSON without anybody: of JSON, points with an id and a time or frame, lines with "
            "datetimes, and temporalGeometry are read"};
    add_polygons(f);
    return std::move(f.found);
}

}  // namespace flaneur
