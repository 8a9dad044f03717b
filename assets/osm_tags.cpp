#include <algorithm>
#include <cmath>

#include "assets/osm_map.h"
#include "sim/base/math.h"

namespace flaneur {

// Reads digits with at most one point or comma from the front of `text`, and drops them from it.
static std::optional<double> take_number(std::string_view& text) {
    double value = 0, scale = 1;
    bool digits = false, fraction = false;
    size_t i = 0;
    for (; i < text.size(); ++i) {
        char c = text[i];
        if (c >= '0' && c <= '9' && value < 1e9) {
            digits = true;
            if (fraction) scale /= 10;
            value = fraction ? value + scale * (c - '0') : value * 10 + (c - '0');
        } else if ((c == '.' || c == ',') && digits && !fraction) {
            fraction = true;
        } else {
            break;
        }
    }
    if (!digits) return std::nullopt;
    text.remove_prefix(i);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return value;
}

std::optional<float> parse_number(std::string_view text) {
    bool negative = !text.empty() && text.front() == '-';
    if (negative) text.remove_prefix(1);
    std::optional<double> value = take_number(text);
    if (!value || !text.empty()) return std::nullopt;
    return static_cast<float>(negative ? -*value : *value);
}

std::optional<float> parse_metres(std::string_view text) {
    std::optional<double> value = take_number(text);
    if (!value) return std::nullopt;
    if (text.empty() || text == "m" || text == "meter" || text == "metres" || text == "meters") {
        return static_cast<float>(*value);
    }
    if (text == "ft" || text == "feet") return static_cast<float>(*value * 0.3048);
    if (text.front() != '\'') return std::nullopt;
    text.remove_prefix(1);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    double feet = *value;
    if (!text.empty()) {
        std::optional<double> inches = take_number(text);
        if (!inches || (text != "\"" && !text.empty())) return std::nullopt;
        feet += *inches / 12;
    }
    return static_cast<float>(feet * 0.3048);
}

bool is_hidden(const OsmTags& tags) {
    if (tags.is("location", "underground") || tags.is("indoor", "yes") || tags.is("tunnel", "yes") ||
        tags.is("tunnel", "culvert")) {
        return true;
    }
    std::optional<float> layer = parse_number(tags["layer"]);
    return layer && *layer < 0 && !tags.is("tunnel", "building_passage");
}

Vec2 Projection::operator()(const OsmNode& node) const {
    double east = (node.longitude - longitude) * metres_per_longitude;
    double north = (node.latitude - latitude) * metres_per_latitude;
    // Whole millimetres, so that nothing below them can differ between machines.
    return {static_cast<float>(std::floor(east * 1000 + 0.5) / 1000),
            static_cast<float>(std::floor(-north * 1000 + 0.5) / 1000)};
}

Projection projection_about(double longitude, double latitude) {
    // Lengths of a degree on WGS84 as series in the latitude, within a centimetre.
    double c = sin_cos(static_cast<float>(latitude) * k_radians).cosine, c2 = 2 * c * c - 1,
           c4 = 2 * c2 * c2 - 1;
    double c3 = c * (4 * c * c - 3);
    return {longitude, latitude, 111412.84 * c - 93.5 * c3, 111132.954 - 559.822 * c2 + 1.175 * c4};
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
        {"living_street", {5.5f, 2.4f, true, road}},
        {"road", {6, 2.4f, true, road}},
        {"service", {4, 0, false, road}},
        {"busway", {6.5f, 0, true, road}},
        {"pedestrian", {6, 0, false, plaza}},
        {"footway", {2.4f, 0, false, path}},
        {"path", {2, 0, false, path}},
        {"cycleway", {2, 0, false, path}},
        {"track", {2.8f, 0, false, path}},
        {"bridleway", {2, 0, false, path}},
        {"steps", {2.6f, 0, false, Surface::steps}},
        {"corridor", {2.4f, 0, false, path}},
    };
    std::string_view name = tags["highway"];
    const Class* found = std::find_if(std::begin(k_classes), std::end(k_classes),
                                      [&](const Class& c) { return c.name == name; });
    if (found == std::end(k_classes) || is_hidden(tags)) return std::nullopt;
    OsmHighway way = found->road;
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
