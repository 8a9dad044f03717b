// An OpenStreetMap extract in memory, and the steps that make a city of it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/cities.h"
#include "assets/city.h"
#include "assets/osm/lines.h"
#include "assets/plan/ground_plan.h"
#include "assets/plan/masses.h"
#include "sim/base/result.h"

namespace flaneur {

struct OsmTags {
    std::vector<std::pair<std::string, std::string>> items;

    // The value, or an empty one where the key is missing.
    std::string_view operator[](std::string_view key) const;
    bool is(std::string_view key, std::string_view value) const { return (*this)[key] == value; }
    bool has(std::string_view key) const { return !(*this)[key].empty(); }
};

struct OsmNode {
    int64_t id = 0;
    double longitude = 0, latitude = 0;
    OsmTags tags;
};

struct OsmWay {
    int64_t id = 0;
    std::vector<int64_t> nodes;
    OsmTags tags;

    bool closed() const { return nodes.size() > 3 && nodes.front() == nodes.back(); }
};

struct OsmRelation {
    int64_t id = 0;
    struct Member {
        int64_t way = 0;
        bool inner = false;
        bool part = false;  // of a building: no piece of its outline
    };
    std::vector<Member> ways;
    OsmTags tags;
};

inline constexpr float k_track = 0;  // height of ballast above the terrain: level with roads, metres

// OpenStreetMap takes no longer ways.
inline constexpr size_t k_osm_most_nodes = 2000;

// Longitude and latitude to metres about a point, on the WGS84 ellipsoid. What lies farther than 40 km to a
// side is brought that near.
struct Projection {
    double longitude = 0, latitude = 0;  // of the origin
    double metres_per_longitude = 0, metres_per_latitude = 0;
    // Equirectangular; or, 1 near the north pole and -1 near the south pole, polar, true along meridians and
    // within half a percent across them.
    int pole = 0;

    Vec2 operator()(const OsmNode& node) const { return at(node.longitude, node.latitude); }
    Vec2 at(double longitude, double latitude) const;
};
Projection projection_about(double longitude, double latitude);

// A square of a map, its sides running north and east through its middle.
struct OsmWindow {
    Projection project;  // about its middle
    float half = 0;      // metres to each side
};

// Sorted by id, each id once. Objects marked as deleted are left out.
struct OsmMap {
    std::vector<OsmNode> nodes;
    std::vector<OsmWay> ways;
    std::vector<OsmRelation> relations;        // multipolygons and buildings only
    std::optional<std::array<double, 4>> box;  // west, south, east, north, where the file states it
    int too_long = 0;                          // ways left out for having more nodes than k_osm_most_nodes
    // Where it was cut out of a larger map: by which window, how large that is, metres, 0 where nobody
    // knows, and why.
    std::optional<OsmWindow> window{};
    float whole_width = 0, whole_depth = 0;
    std::string cut_note{};

    const OsmNode* node(int64_t id) const;
    const OsmWay* way(int64_t id) const;
};

// How many bytes of nodes, ways and tags are taken in: some hundred square kilometres of a dense city.
inline constexpr size_t k_osm_most_bytes = size_t{256} << 20;

// How a file is read.
struct OsmReading {
    size_t most = k_osm_most_bytes;  // bytes of what is taken in
    TellProgress tell{};
};
// Reads .osm and .osm.pbf (also .osm.gz, .osm.bz2), in any order. Refuses what libosmium cannot read to the
// end, and, before it is read whole, what unpacks to a hundred times its size or holds more than is to be
// taken in; of that `too_large`, if given, tells.
Result<OsmMap> read_osm(const std::string& path, const OsmReading& how = {}, bool* too_large = nullptr);
// The same of bytes in memory; `format` is "osm", "osm.gz", "osm.bz2" or "pbf".
Result<OsmMap> parse_osm(std::string_view bytes, const std::string& format, size_t most = k_osm_most_bytes);
// The same of what a window touches; see cut_to. What it does not touch is not taken in.
Result<OsmMap> read_osm_window(const std::string& path, const OsmWindow& window, const OsmReading& how = {});
// West, south, east and north as the header of a file states them, if it does: nothing else is read.
Result<std::optional<std::array<double, 4>>> read_osm_bounds(const std::string& path);

// Whether west, south, east, north are too far apart for a city, more than 28 km; and what to say then of the
// map `name`.
bool is_too_wide(const std::array<double, 4>& box);
Error too_wide(const std::string& name);
// A city of a map that was read; see load_osm. `path` names it.
Result<City> city_of(const OsmMap& map, const std::string& path, const CityOptions& options);

// A length in metres: "12", "12.5 m", "1,5", "40 ft", "12'6\"". None for anything else.
std::optional<float> parse_metres(std::string_view text);
std::optional<float> parse_number(std::string_view text);
bool is_one_of(std::string_view value, std::initializer_list<std::string_view> values);
// The steps that a stair says it has, 1000 at most; 0 where it says nothing.
int stated_risers(const OsmTags& tags);
// Below ground, in a tunnel or indoors.
bool is_hidden(const OsmTags& tags);

// What City::tallies tells of. Roofs stand as in RoofKind.
enum class OsmSort : uint8_t {
    building,
    without_height,
    part,
    roof_flat,
    roof_last = static_cast<uint8_t>(roof_flat) + k_roof_count - 1,
    passage,
    road,
    sidewalk_tag,
    sidewalk_way,
    footway,
    crossing_node,
    crossing_way,
    kerb,
    steps,
    step_count,
    pedestrian_area,
    bridge,
    layer,
    green,
    water,
    tree,
    lamp,
    bench,
    bollard,
    bin,
    traffic_light,
    bus_stop,
    barrier,
    track,
    platform
};
inline constexpr size_t k_osm_sort_count = static_cast<size_t>(OsmSort::platform) + 1;

// How often something was met, for City::notes and City::tallies.
struct OsmCounts {
    int open_buildings = 0, broken_relations = 0, hidden = 0;
    int outside = 0, props_off_ground = 0;
    int tangled = 0;       // outlines that cross themselves again and again
    int flat_instead = 0;  // roofs whose outlines do not allow for their shape
    std::array<int, k_osm_sort_count> built;
    OsmCounts() { built.fill(-1); }
};
// Once more, or so often more, that something of a sort was built.
void count_built(OsmCounts& counts, OsmSort sort, int more = 1);
// Once more for each sort from first to last that the tags are of.
void count_built(OsmCounts& counts, const OsmTags& tags, OsmSort first, OsmSort last);

struct OsmHighway {
    float width = 0;     // metres
    float sidewalk = 0;  // width of a sidewalk where tags do not say; 0: none without a tag
    bool drives =
        false;  // a carriageway with kerbs; service roads are level with the sidewalks that they cross
    Surface kind = Surface::path;
    int level = 0;  // 0 on the ground, more above it: `layer`, and 1 for bridges that say no layer
};
// None for what is not built, below ground, indoors or not for streets and ways.
std::optional<OsmHighway> highway_of(const OsmTags& tags);
// The same of tracks.
std::optional<OsmHighway> track_of(const OsmTags& tags);
// OsmHighway::level.
int level_of(const OsmTags& tags);
// How high a platform of trams or trains is, metres; none for what is none or below ground.
std::optional<float> platform_of(const OsmTags& tags);

// A street or way of the map. Lines of its known points, as `lines_of` gives them.
struct OsmStreet {
    const OsmWay* way = nullptr;
    OsmHighway highway;
    std::vector<std::vector<Vec2>> lines;
};

// What a building or a part of one takes of the air.
struct OsmMass {
    Rings rings;
    float bottom = 0, eaves = 0;  // heights, metres
};

// Ground that goes on from a line to the walls beside it: where there are none within reach it ends, but for
// gaps between houses.
struct OsmPaving {
    std::vector<Vec2> line;
    float left = 0, right = 0;  // how far walls may be, metres; 0: nothing is paved on that side
    bool to_streets = false;    // the middle of a carriageway will do for a wall
    bool needs_both = false;    // walls on both sides, or none
    Area area;                  // what is laid
};

// What the steps read and add to.
struct OsmImport {
    const OsmMap& map;
    Projection project;
    GroundPlan plan;
    City city;
    OsmCounts counts;
    // Filled by add_osm_streets: centre lines on the ground, by index of their way, with half the breadth of
    // carriageway and sidewalks (0: none), and what lies above the ground or leads up there by steps.
    SegmentIndex streets{};
    std::vector<OsmStreet> raised{};
    std::vector<OsmPaving> pavings{};
    SegmentIndex tracks{};  // railways on the ground, as streets
    uint32_t walls = ~0u;   // see wall_building
    std::vector<OsmMass> masses{};
    std::map<int64_t, OsmTags> joined{};  // of outlines and parts, with what relations say of their building
};

// The known points of a way; missing ones split it. Lines of fewer than two points are left out.
std::vector<std::vector<Vec2>> lines_of(const OsmImport& in, const OsmWay& way);
// The regions that a closed way or a relation encloses; empty, and counted, where nodes are missing or rings
// stay open.
std::vector<Region> regions_of_way(OsmImport& in, const OsmWay& way);
std::vector<Region> regions_of_relation(OsmImport& in, const OsmRelation& relation);

// The building that all walls and railings of the map belong to, which has no facade.
uint32_t wall_building(OsmImport& in);
// What tags alone say of the width of a street's own sidewalk on one side, or what is usual; 0: none.
float tagged_sidewalk(const OsmStreet& street, bool left);

void add_osm_streets(OsmImport& in);
// Junctions with rounded corners, crossings and lowered kerbs of the streets that have carriageways.
void add_osm_crossings(OsmImport& in, const std::vector<OsmStreet>& roads);
// Walls, fences and hedges, with gaps where streets and ways pass. After the streets.
void add_osm_barriers(OsmImport& in);
// Tracks, on the ground or raised, and platforms. After the streets.
void add_osm_railways(OsmImport& in);
void add_osm_areas(OsmImport& in);  // parks, water, squares
// Lays OsmImport::pavings, below what the map draws itself. After streets, areas and buildings.
void pave_to_walls(OsmImport& in);
// Refuses maps whose lines are far longer, or cross without a common node far more often, than those of any
// place, before any ground is laid, which would take minutes.
Result<void> refuse_tangle(const OsmImport& in, const std::string& path);
// Coastlines have the sea on their right hand. Those that the extract cuts short in its middle make no sea.
void add_osm_sea(OsmImport& in);
// Lays the terrain of an elevation file under the plan, level with the sea where there is sea: after
// add_osm_sea, before all else.
Result<void> raise_ground(OsmImport& in, const std::string& path);
// At the corners of the region's outline, metres.
float lowest_ground(const GroundPlan& plan, const Region& region);
void add_osm_buildings(OsmImport& in);
// Trees and street furniture, where there is room for them. After the ground is laid.
void add_osm_props(OsmImport& in);
// Doors, shops, benches, stops, squares and where streets leave the map. After the props.
void add_osm_destinations(OsmImport& in);

// Where one drives; after the destinations.
void add_osm_lanes(OsmImport& in);

// All that stands and lies outdoors of these, and the ground: after the buildings, if there are any.
void add_osm_outdoors(OsmImport& in);

// Fills City::tallies.
void tell_counts(OsmImport& in);

}  // namespace flaneur
