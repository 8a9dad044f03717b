// What a map has, beside what was built of it.
#include <algorithm>

#include "assets/osm/house.h"
#include "assets/osm/map.h"

namespace flaneur {

namespace {

bool is_building(const OsmTags& t) {
    if (t.has("building")) return !t.is("building", "no");
    return !t.has("building:part") && is_structure(t) && !t.is("type", "building");
}
bool is_building_of_one_point(const OsmTags& t) { return round_structure(t, {}) && is_building(t); }
bool says_no_height(const OsmTags& t) {
    return !t.has("height") && !t.has("building:height") && !t.has("building:levels");
}
bool is_part(const OsmTags& t) {
    return !is_building(t) && t.has("building:part") && !t.is("building:part", "no");
}
template <const char* shape>
bool has_roof(const OsmTags& t) {
    return t.is("roof:shape", shape) && (is_building(t) || is_part(t));
}

constexpr char k_flat[] = "flat", k_gabled[] = "gabled", k_half_hipped[] = "half-hipped",
               k_hipped[] = "hipped", k_pyramidal[] = "pyramidal", k_skillion[] = "skillion",
               k_gambrel[] = "gambrel", k_round[] = "round", k_mansard[] = "mansard", k_dome[] = "dome",
               k_onion[] = "onion";

struct Sort {
    const char* name;
    enum { nodes, lines } where;  // lines: ways and relations
    bool (*is)(const OsmTags& tags);
    bool (*is_point)(const OsmTags& tags) = nullptr;  // beside lines: a node that is built as one of them
};
constexpr Sort k_sorts[k_osm_sort_count] = {
    {"buildings", Sort::lines, is_building, is_building_of_one_point},
    {"without height or levels", Sort::lines,
     [](const OsmTags& t) { return is_building(t) && says_no_height(t); },
     [](const OsmTags& t) { return is_building_of_one_point(t) && says_no_height(t); }},
    {"building parts", Sort::lines, is_part},
    {"roofs flat", Sort::lines, has_roof<k_flat>},
    {"roofs gabled", Sort::lines, has_roof<k_gabled>},
    {"roofs half-hipped", Sort::lines, has_roof<k_half_hipped>},
    {"roofs hipped", Sort::lines, has_roof<k_hipped>},
    {"roofs pyramidal", Sort::lines, has_roof<k_pyramidal>},
    {"roofs skillion", Sort::lines, has_roof<k_skillion>},
    {"roofs gambrel", Sort::lines, has_roof<k_gambrel>},
    {"roofs round", Sort::lines, has_roof<k_round>},
    {"roofs mansard", Sort::lines, has_roof<k_mansard>},
    {"roofs dome", Sort::lines, has_roof<k_dome>},
    {"roofs onion", Sort::lines, has_roof<k_onion>},
    {"building passages", Sort::lines,
     [](const OsmTags& t) { return t.has("highway") && t.is("tunnel", "building_passage"); }},
    {"roads", Sort::lines,
     [](const OsmTags& t) {
         std::optional<OsmHighway> highway = highway_of(t);
         return highway && highway->drives;
     }},
    {"roads with sidewalk=*", Sort::lines,
     [](const OsmTags& t) {
         return t.has("highway") && (t.has("sidewalk") || t.has("sidewalk:left") || t.has("sidewalk:right") ||
                                     t.has("sidewalk:both"));
     }},
    {"footway=sidewalk", Sort::lines, [](const OsmTags& t) { return t.is("footway", "sidewalk"); }},
    {"other ways on foot", Sort::lines,
     [](const OsmTags& t) {
         return is_one_of(t["highway"],
                          {"footway", "path", "pedestrian", "living_street", "track", "cycleway"}) &&
                !is_one_of(t["footway"], {"sidewalk", "crossing"}) && !t.is("area", "yes");
     }},
    {"crossing nodes", Sort::nodes, [](const OsmTags& t) { return t.is("highway", "crossing"); }},
    {"crossing ways", Sort::lines, [](const OsmTags& t) { return t.is("footway", "crossing"); }},
    {"kerb=*", Sort::nodes, [](const OsmTags& t) { return t.has("kerb"); }},
    {"steps", Sort::lines, [](const OsmTags& t) { return t.is("highway", "steps"); }},
    {"steps with step_count", Sort::lines,
     [](const OsmTags& t) { return t.is("highway", "steps") && t.has("step_count"); }},
    {"pedestrian areas", Sort::lines,
     [](const OsmTags& t) {
         return (is_one_of(t["highway"], {"pedestrian", "footway"}) && t.is("area", "yes")) ||
                (t.is("highway", "pedestrian") && t.is("type", "multipolygon")) || t.is("place", "square");
     }},
    {"bridges", Sort::lines,
     [](const OsmTags& t) { return t.has("highway") && t.has("bridge") && !t.is("bridge", "no"); }},
    {"ways with layer=*", Sort::lines, [](const OsmTags& t) { return t.has("layer"); }},
    {"parks and grass", Sort::lines,
     [](const OsmTags& t) {
         return is_one_of(t["leisure"], {"park", "garden", "pitch", "playground"}) ||
                is_one_of(t["landuse"], {"grass", "forest", "meadow", "village_green"}) ||
                t.is("natural", "wood");
     }},
    {"water", Sort::lines,
     [](const OsmTags& t) {
         return t.is("natural", "water") || is_one_of(t["waterway"], {"riverbank", "dock"});
     }},
    {"trees", Sort::nodes, [](const OsmTags& t) { return t.is("natural", "tree"); }},
    {"street lamps", Sort::nodes, [](const OsmTags& t) { return t.is("highway", "street_lamp"); }},
    {"benches", Sort::nodes, [](const OsmTags& t) { return t.is("amenity", "bench"); }},
    {"bollards", Sort::nodes, [](const OsmTags& t) { return t.is("barrier", "bollard"); }},
    {"bins", Sort::nodes, [](const OsmTags& t) { return t.is("amenity", "waste_basket"); }},
    {"traffic lights", Sort::nodes, [](const OsmTags& t) { return t.is("highway", "traffic_signals"); }},
    {"bus stops", Sort::nodes, [](const OsmTags& t) { return t.is("highway", "bus_stop"); }},
    {"walls and fences", Sort::lines,
     [](const OsmTags& t) {
         return is_one_of(t["barrier"],
                          {"wall", "retaining_wall", "city_wall", "fence", "hedge", "guard_rail"});
     }},
    {"railway tracks", Sort::lines, [](const OsmTags& t) { return track_of(t).has_value(); }},
    {"platforms of trains and trams", Sort::lines,
     [](const OsmTags& t) { return platform_of(t).has_value(); }},
};

}  // namespace

void count_built(OsmCounts& counts, OsmSort sort, int more) {
    int& built = counts.built[static_cast<size_t>(sort)];
    built = std::max(built, 0) + more;
}

void count_built(OsmCounts& counts, const OsmTags& tags, OsmSort first, OsmSort last) {
    for (auto s = static_cast<size_t>(first); s <= static_cast<size_t>(last); ++s) {
        if (k_sorts[s].where != Sort::nodes && k_sorts[s].is(tags))
            count_built(counts, static_cast<OsmSort>(s));
    }
}

void tell_counts(OsmImport& in) {
    for (const Prop& prop : in.city.props) {
        switch (prop.kind) {
            case PropKind::tree:
                count_built(in.counts, OsmSort::tree);
                break;
            case PropKind::lamp:
                count_built(in.counts, OsmSort::lamp);
                break;
            case PropKind::bench:
                count_built(in.counts, OsmSort::bench);
                break;
            case PropKind::bollard:
                count_built(in.counts, OsmSort::bollard);
                break;
            case PropKind::bin:
                count_built(in.counts, OsmSort::bin);
                break;
            case PropKind::signal:
                count_built(in.counts, OsmSort::traffic_light);
                break;
            case PropKind::shelter:
                count_built(in.counts, OsmSort::bus_stop);
                break;
            default:
                break;
        }
    }
    for (size_t s = 0; s < k_osm_sort_count; ++s) {
        const Sort& sort = k_sorts[s];
        int found = 0;
        auto count = [&](const auto& objects, bool (*is)(const OsmTags& tags)) {
            for (const auto& object : objects) found += !object.tags.items.empty() && is(object.tags);
        };
        if (sort.where == Sort::nodes) count(in.map.nodes, sort.is);
        if (sort.where == Sort::lines) count(in.map.ways, sort.is), count(in.map.relations, sort.is);
        if (sort.is_point) count(in.map.nodes, sort.is_point);
        int built = in.counts.built[s];
        if (found > 0 || built > 0) in.city.tallies.push_back({sort.name, found, built});
    }
}

}  // namespace flaneur
