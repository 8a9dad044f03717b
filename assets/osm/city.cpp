#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assets/cities.h"
#include "assets/osm/decks.h"
#include "assets/osm/map.h"
#include "assets/osm/window.h"
#include "assets/plan/masses.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr double k_widest = 28'000;  // metres
// Sides of the squares that the ground is cut along, metres: on level ground, on terrain. Wide maps take
// wider ones, to be no more than so many.
constexpr float k_level_square = 32, k_terrain_square = 16, k_most_squares = 100'000;

// How the map lies on the plane, and what of the plane it takes.
struct Frame {
    Projection project;
    Vec2 low, high;
};

// About the box that the map states, or that of its buildings and streets. None where it is too wide.
std::optional<Frame> frame_of(const OsmBox& extent) {
    if (is_too_wide(extent)) return std::nullopt;
    auto [west, south, east, north] = extent;
    Frame frame{projection_about((west + east) * 0.5, (south + north) * 0.5), {}, {}};
    frame.high = frame.project.at(east, south);
    frame.low = -frame.high;
    return frame;
}

// Near a pole, where all meridians meet: about the window's middle, or else the mean of the places of
// buildings and streets.
std::optional<Frame> polar_frame(const OsmMap& map) {
    std::vector<const OsmNode*> nodes;
    double north = 0, east = 0;  // on the plane about the pole, degrees
    for (const OsmWay& way : map.ways) {
        if (!way.tags.has("building") && !highway_of(way.tags)) continue;
        for (int64_t id : way.nodes) {
            const OsmNode* node = map.node(id);
            if (!node) continue;
            nodes.push_back(node);
            SinCos turn = sin_cos(static_cast<float>(node->longitude) * k_radians);
            double away = 90 - std::fabs(node->latitude);
            north += away * turn.cosine, east += away * turn.sine;
        }
    }
    auto count = static_cast<double>(nodes.size());
    north /= count, east /= count;
    double away = std::sqrt(north * north + east * east), side = map.nodes[0].latitude > 0 ? 1 : -1;
    Frame frame{projection_about(arctan2(static_cast<float>(east), static_cast<float>(north)) / k_radians,
                                 side * (90 - away)),
                {1e9f, 1e9f},
                {-1e9f, -1e9f}};
    if (map.window) frame.project = map.window->project;
    for (const OsmNode* node : nodes) {
        Vec2 p = frame.project.at(near_longitude(node->longitude, frame.project.longitude), node->latitude);
        frame.low = {std::min(frame.low.x, p.x), std::min(frame.low.z, p.z)};
        frame.high = {std::max(frame.high.x, p.x), std::max(frame.high.z, p.z)};
    }
    if (map.window) {
        float half = map.window->half;
        frame.low = {std::max(frame.low.x, -half), std::max(frame.low.z, -half)};
        frame.high = {std::min(frame.high.x, half), std::min(frame.high.z, half)};
    }
    Vec2 size = frame.high - frame.low;
    return std::max(size.x, size.z) > static_cast<float>(k_widest) ? std::nullopt : std::optional(frame);
}

std::string counted(int count, const char* one, const char* many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

int missing_nodes(const OsmMap& map) {
    int missing = 0;
    for (const OsmWay& way : map.ways)
        missing += static_cast<int>(
            std::count_if(way.nodes.begin(), way.nodes.end(), [&](int64_t id) { return !map.node(id); }));
    return missing;
}

void write_notes(OsmImport& in) {
    const OsmCounts& c = in.counts;
    std::vector<std::string>& notes = in.city.notes;
    auto note = [&](int count, const char* one, const char* many) {
        if (count > 0) notes.push_back(counted(count, one, many));
    };
    note(std::max(0, c.built[static_cast<size_t>(OsmSort::without_height)]),
         "building says neither a height nor storeys that can be; a usual height was taken.",
         "buildings say neither heights nor storeys that can be; usual heights were taken.");
    note(c.flat_instead, "roof became flat because its outline does not allow for its shape.",
         "roofs became flat because their outlines do not allow for their shapes.");
    note(c.open_buildings, "building was left out because its outline is not closed.",
         "buildings were left out because their outlines are not closed.");
    note(c.broken_relations, "multipolygon was left out because its rings are incomplete.",
         "multipolygons were left out because their rings are incomplete.");
    note(in.map.too_long,
         "way was left out because it has more nodes than the 2000 that OpenStreetMap takes.",
         "ways were left out because they have more nodes than the 2000 that OpenStreetMap takes.");
    note(c.tangled, "outline was left out because it crosses itself more than a hundred times.",
         "outlines were left out because they cross themselves more than a hundred times.");
    note(missing_nodes(in.map),
         "reference to a node that the file lacks, or has nowhere on Earth, was skipped.",
         "references to nodes that the file lacks, or has nowhere on Earth, were skipped.");
    note(c.hidden, "way or building under ground or indoors was left out.",
         "ways and buildings under ground or indoors were left out.");
    if (!in.map.window) {  // which has others beside it
        note(c.outside, "building outside the map's bounds was left out.",
             "buildings outside the map's bounds were left out.");
    }
    note(c.props_off_ground, "tree or lamp was left out because it would stand in a building or on a road.",
         "trees, lamps and benches were left out because they would stand in buildings or on roads.");
}

}  // namespace

void add_osm_outdoors(OsmImport& in) {
    add_osm_streets(in);
    add_osm_railways(in);
    add_osm_barriers(in);
    add_osm_areas(in);
    pave_to_walls(in);
    std::vector<DeckPiece> decks = solve_decks(in);
    clear_ground_below(in, decks);
    add_piers(in, decks);
    Area rest;
    rest.rank = k_rank_rest;
    rest.kind = Surface::grass;
    rest.lift = flat(k_kerb);
    rest.rings = {rectangle(to_point(in.plan.low), to_point(in.plan.high))};
    in.plan.areas.push_back(std::move(rest));
    lay_ground(in.plan, in.city);
    lay_decks(in, decks);
    lay_osm_rails(in, decks);
    add_osm_props(in);
    settle_crossings(in.city);
    list_obstacles(in.city);
    add_osm_destinations(in);
    add_osm_lanes(in);
}

bool is_too_wide(const std::array<double, 4>& box) {
    auto [west, south, east, north] = box;
    Projection project = projection_about((west + east) * 0.5, (south + north) * 0.5);
    return (east - west) * project.metres_per_longitude > k_widest ||
           (north - south) * project.metres_per_latitude > k_widest;
}

Error too_wide(const std::string& name) {
    return Error{"The map " + name +
                 " is more than 28 km wide; --center LAT,LON and --radius M choose what to draw of it."};
}

std::optional<OsmBox> extent_of(const OsmMap& map) {
    std::array<double, 4> box{1e9, 1e9, -1e9, -1e9};
    bool has_line = false;  // of more than one place
    for (const OsmWay& way : map.ways) {
        if (!way.tags.has("building") && !highway_of(way.tags)) continue;
        const OsmNode* other = nullptr;
        for (int64_t id : way.nodes) {
            const OsmNode* node = map.node(id);
            if (!node) continue;
            if (!other) other = node;
            has_line |= node->longitude != other->longitude || node->latitude != other->latitude;
            box = {std::min(box[0], node->longitude), std::min(box[1], node->latitude),
                   std::max(box[2], node->longitude), std::max(box[3], node->latitude)};
        }
    }
    if (!has_line) return std::nullopt;
    if (map.box) {
        std::array<double, 4> stated{std::max(box[0], (*map.box)[0]), std::max(box[1], (*map.box)[1]),
                                     std::min(box[2], (*map.box)[2]), std::min(box[3], (*map.box)[3])};
        if (stated[0] < stated[2] && stated[1] < stated[3]) return stated;
        bool is_line = stated[0] <= stated[2] && stated[1] <= stated[3];
        if (map.window) return is_line ? std::optional(stated) : std::nullopt;
    }
    return box;
}

Result<City> load_osm(const std::string& path, const CityOptions& options) {
    Result<OsmMap> map = read_drawn(path, options);
    if (!map) return map.error();
    return city_of(*map, path, options);
}

// That there is nothing to build.
static Error no_city(const OsmMap& map, const std::string& path) {
    if (!map.window) {
        return Error{
            "The map " + path +
            " has neither buildings nor streets, so there is no city in it; take an extract of a town."};
    }
    const Projection& p = map.window->project;
    return Error{"The map " + path + " has neither buildings nor streets within " +
                 std::to_string(std::lround(map.window->half)) + " m of " +
                 shown_place({p.latitude, p.longitude}) + "; take another --center or a larger --radius."};
}

Result<City> city_of(const OsmMap& map, const std::string& path, const CityOptions& options) {
    std::optional<OsmBox> extent = extent_of(map);
    if (!extent) return no_city(map, path);
    bool is_polar =
        map.window ? map.window->project.pole != 0 : std::max((*extent)[3], -(*extent)[1]) > k_polar;
    std::optional<Frame> frame = is_polar ? polar_frame(map) : frame_of(*extent);
    if (!frame) return too_wide(path);
    if (is_polar && !options.terrain.empty())
        return Error{"The map " + path + " lies beyond 84 degrees, where terrain (" + options.terrain +
                     ") is not laid under maps."};
    auto tell = [&](std::string_view what, float done) {
        if (options.tell) options.tell(what, done);
    };
    OsmImport in{map, frame->project, {}, {}, {}};
    in.city.ground.name = std::filesystem::path(path).stem().string();
    in.city.latitude = static_cast<float>(in.project.latitude);
    in.city.on_earth = OnEarth{{in.project.latitude, near_longitude(in.project.longitude, 0)},
                               map.window ? map.window->half : 0,
                               map.whole_width,
                               map.whole_depth};
    if (!map.cut_note.empty()) in.city.notes.push_back(map.cut_note);
    in.plan.low = frame->low - Vec2{6, 6};
    in.plan.high = frame->high + Vec2{6, 6};
    Vec2 size = in.plan.high - in.plan.low;
    if (!map.window) {
        in.city.on_earth->map_width = frame->high.x - frame->low.x;
        in.city.on_earth->map_depth = frame->high.z - frame->low.z;
    }
    in.plan.cell = std::max(options.terrain.empty() ? k_level_square : k_terrain_square,
                            std::ceil(std::sqrt(size.x * size.z / k_most_squares)));
    if (Result<void> sound = refuse_tangle(in, path); !sound) return sound.error();
    add_osm_sea(in);
    if (!options.terrain.empty()) {
        Result<void> raised = raise_ground(in, options.terrain);
        if (!raised) return raised.error();
    }

    tell("building the houses", 0);
    add_osm_buildings(in);
    tell("laying the streets", 0.3f);
    add_osm_outdoors(in);
    tell_counts(in);
    write_notes(in);
    return std::move(in.city);
}

}  // namespace flaneur
