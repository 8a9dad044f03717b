// What the map's streets and ways are like.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"

namespace flaneur {

static bool is_paved(std::string_view surface) {
    constexpr std::string_view k_paved[] = {
        "paved",  "asphalt",     "concrete",           "concrete:plates", "paving_stones", "sett",
        "bricks", "cobblestone", "unhewn_cobblestone", "tiles",           "stone"};
    return std::find(std::begin(k_paved), std::end(k_paved), surface) != std::end(k_paved);
}

int level_of(const OsmTags& tags) {
    bool bridge = tags.has("bridge") && !tags.is("bridge", "no");
    return static_cast<int>(clamp(parse_number(tags["layer"]).value_or(0), bridge ? 1.0f : 0.0f, 5));
}

std::optional<OsmHighway> highway_of(const OsmTags& tags) {
    struct Class {
        std::string_view name;
        OsmHighway road;
    };
    constexpr Surface road = Surface::road, plaza = Surface::plaza, path = Surface::path;
    static constexpr Class k_classes[] = {
        {"motorway", {11, 0, true, road}},
        {"motorway_link", {5.5f, 0, true, road}},
        {"trunk", {11, 0, true, road}},
        {"trunk_link", {5.5f, 0, true, road}},
        {"primary", {10.5f, 3.5f, true, road}},
        {"primary_link", {5.5f, 0, true, road}},
        {"secondary", {9.5f, 3.5f, true, road}},
        {"secondary_link", {5.5f, 0, true, road}},
        {"tertiary", {8, 3, true, road}},
        {"tertiary_link", {5, 0, true, road}},
        {"residential", {7, 3, true, road}},
        {"unclassified", {7, 2.6f, true, road}},
        {"living_street", {5.5f, 0, false, plaza}},
        {"road", {6, 2.4f, true, road}},
        {"service", {4, 0, false, plaza}},  // shared with what few cars there are
        {"busway", {6.5f, 0, true, road}},
        {"pedestrian", {6, 0, false, plaza}},
        {"footway", {2.4f, 0, false, path}},
        {"path", {2, 0, false, path}},
        {"cycleway", {2, 0, false, path}},
        {"track", {2.8f, 0, false, path}},
        {"bridleway", {2, 0, false, path}},
        {"steps", {2.6f, 0, false, Surface::steps}},
    };
    std::string_view name = tags["highway"];
    const Class* found = std::find_if(std::begin(k_classes), std::end(k_classes),
                                      [&](const Class& c) { return c.name == name; });
    if (found == std::end(k_classes) || is_hidden(tags)) return std::nullopt;
    std::optional<float> storey = parse_number(tags["level"]);
    if (storey && *storey < 0) return std::nullopt;
    OsmHighway way = found->road;
    way.level = level_of(tags);
    if (way.kind == Surface::path && is_paved(tags["surface"])) way.kind = Surface::sidewalk;
    if (name == "service" && tags.is("service", "alley")) way.width = 3.5f;
    if (name == "service" && tags.is("service", "driveway")) way.width = 3;
    if (name == "footway" && (tags.is("footway", "sidewalk") || tags.is("footway", "crossing")))
        way.kind = Surface::sidewalk;
    if (way.drives && tags.is("oneway", "yes") && way.width > 5.5f) way.width *= 0.8f;
    std::optional<float> width = parse_metres(tags["width"]), lanes = parse_number(tags["lanes"]);
    if (width && *width >= 0.8f && *width <= 60) {
        way.width = *width;
    } else if (way.drives && lanes && *lanes >= 1 && *lanes <= 14) {
        way.width = *lanes * 3.1f + (*lanes < 2 ? 1.2f : 0.4f);
    }
    return way;
}

}  // namespace flaneur
