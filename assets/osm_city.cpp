#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assets/city.h"
#include "assets/masses.h"
#include "assets/osm_decks.h"
#include "assets/osm_map.h"

namespace flaneur {

namespace {

constexpr double k_widest_degrees = 0.25;  // of latitude; about 28 km
// Sides of the squares that the ground is cut along, metres: on level ground, on terrain. Wide maps take
// wider ones, to be no more than so many.
constexpr float k_level_square = 32, k_terrain_square = 16, k_most_squares = 100'000;

// The box that the file states, or else that of its buildings and streets: west, south, east, north. None
// where there are neither.
std::optional<std::array<double, 4>> extent_of(const OsmMap& map) {
    std::array<double, 4> box{1e9, 1e9, -1e9, -1e9};
    for (const OsmWay& way : map.ways) {
        if (!way.tags.has("building") && !highway_of(way.tags)) continue;
        for (int64_t id : way.nodes) {
            const OsmNode* node = map.node(id);
            if (!node) continue;
            box = {std::min(box[0], node->longitude), std::min(box[1], node->latitude),
                   std::max(box[2], node->longitude), std::max(box[3], node->latitude)};
        }
    }
    if (box[0] > box[2]) return std::nullopt;
    if (map.box) {
        std::array<double, 4> stated{std::max(box[0], (*map.box)[0]), std::max(box[1], (*map.box)[1]),
                                     std::min(box[2], (*map.box)[2]), std::min(box[3], (*map.box)[3])};
        if (stated[0] < stated[2] && stated[1] < stated[3]) return stated;
    }
    return box;
}

std::string counted(int count, const char* one, const char* many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

void write_notes(OsmImport& in) {
    const OsmCounts& c = in.counts;
    std::vector<std::string>& notes = in.city.notes;
    auto note = [&](int count, const char* one, const char* many) {
        if (count > 0) notes.push_back(counted(count, one, many));
    };
    note(std::max(0, c.built[static_cast<size_t>(OsmSort::without_height)]),
         "building says neither its height nor its storeys; a usual height was taken.",
         "buildings say neither their height nor their storeys; usual heights were taken.");
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
    note(c.missing_nodes, "reference to a node that the file lacks was skipped.",
         "references to nodes that the file lacks were skipped.");
    note(c.hidden, "way or building under ground or indoors was left out.",
         "ways and buildings under ground or indoors were left out.");
    note(c.outside, "building outside the map's bounds was left out.",
         "buildings outside the map's bounds were left out.");
    note(c.props_off_ground, "tree or lamp was left out because it would stand in a building or on a road.",
         "trees, lamps and benches were left out because they would stand in buildings or on roads.");
}

}  // namespace

void add_osm_outdoors(OsmImport& in) {
    add_osm_streets(in);
    add_osm_barriers(in);
    add_osm_areas(in);
    std::vector<DeckPiece> decks = solve_decks(in);
    clear_ground_below(in, decks);
    Area rest;
    rest.rank = k_rank_rest;
    rest.kind = Surface::grass;
    rest.lift = flat(k_kerb);
    rest.rings = {rectangle(to_point(in.plan.low), to_point(in.plan.high))};
    in.plan.areas.push_back(std::move(rest));
    lay_ground(in.plan, in.city);
    lay_decks(in, decks);
    add_osm_props(in);
    add_osm_destinations(in);
}

Result<City> load_osm(const std::string& path, const CityOptions& options) {
    Result<OsmMap> map = read_osm(path);
    if (!map) return map.error();
    return city_of(*map, path, options);
}

Result<City> city_of(const OsmMap& map, const std::string& path, const CityOptions& options) {
    std::optional<std::array<double, 4>> extent = extent_of(map);
    if (!extent) {
        return Error{
            "The map " + path +
            " has neither buildings nor streets, so there is no city in it; take an extract of a town."};
    }
    auto [west, south, east, north] = *extent;
    if (north - south > k_widest_degrees || (east - west) > 2 * k_widest_degrees || north > 84 ||
        south < -84) {
        return Error{"The map " + path +
                     " is more than 28 km wide or reaches a pole; cut out a part of a few kilometres (osmium "
                     "extract does)."};
    }
    OsmImport in{map, projection_about((west + east) * 0.5, (south + north) * 0.5), {}, {}, {}};
    in.city.name = std::filesystem::path(path).stem().string();
    in.city.latitude = static_cast<float>((south + north) * 0.5);
    OsmNode corner{0, east, south, {}};
    in.plan.high = in.project(corner) + Vec2{6, 6};
    in.plan.low = -in.plan.high;
    Vec2 size = in.plan.high - in.plan.low;
    in.plan.cell = std::max(options.terrain.empty() ? k_level_square : k_terrain_square,
                            std::ceil(std::sqrt(size.x * size.z / k_most_squares)));
    add_osm_sea(in);
    if (!options.terrain.empty()) {
        Result<void> raised = raise_ground(in, options.terrain);
        if (!raised) return raised.error();
    }

    add_osm_buildings(in);
    add_osm_outdoors(in);
    tell_counts(in);
    write_notes(in);
    return std::move(in.city);
}

}  // namespace flaneur
