#include "assets/osm/house.h"

#include <algorithm>
#include <cmath>

#include "assets/colour.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_storey = 3.2f, k_attic = 0.8f;  // of a flat roof, above the last ceiling
constexpr float k_highest = 900, k_most_storeys = 200;

// What kind of building it is; other keys help where the map says "yes" only.
std::string_view type_of(const OsmTags& tags) {
    std::string_view type = tags["building"];
    if (type.empty() || type == "yes") type = tags["building:part"];
    if (!type.empty() && type != "yes") return type;
    if (tags.is("amenity", "place_of_worship")) return "church";
    if (tags.is("amenity", "parking")) return "parking";
    if (is_one_of(tags["amenity"], {"school", "university", "hospital", "kindergarten"}))
        return tags["amenity"];
    if (tags.is("tourism", "hotel")) return "hotel";
    if (is_one_of(tags["shop"], {"mall", "supermarket", "department_store"})) return "retail";
    if (tags.has("office")) return "office";
    if (std::string_view structure = structure_of(tags); !structure.empty()) return structure;
    return "yes";
}

bool is_house(std::string_view type) {
    return is_one_of(type, {"house", "detached", "semidetached_house", "semi", "terrace", "bungalow", "farm",
                            "cabin", "villa", "chalet", "static_caravan", "presbytery"});
}

bool is_shed(std::string_view type) {
    return is_one_of(type,
                     {"garage", "garages", "shed", "hut", "kiosk", "carport", "roof", "service", "toilets",
                      "greenhouse", "transformer_tower", "container", "guardhouse", "booth"});
}

// Height to the eaves where the map says neither height nor storeys, metres.
float usual_height(std::string_view type, double square_metres, const OsmSurroundings& around, uint64_t id) {
    struct Type {
        std::string_view name;
        float height;
    };
    static constexpr Type k_types[] = {
        {"garage", 2.6f},   {"garages", 2.6f},      {"carport", 2.8f},     {"shed", 2.5f},
        {"hut", 2.6f},      {"kiosk", 2.9f},        {"booth", 2.6f},       {"toilets", 2.9f},
        {"service", 3},     {"container", 2.6f},    {"greenhouse", 3.5f},  {"guardhouse", 3},
        {"roof", 4.5f},     {"bungalow", 3.2f},     {"farm_auxiliary", 5}, {"barn", 5.5f},
        {"stable", 4.5f},   {"church", 12},         {"cathedral", 22},     {"basilica", 18},
        {"chapel", 7},      {"mosque", 11},         {"synagogue", 11},     {"temple", 9},
        {"shrine", 6},      {"warehouse", 8},       {"industrial", 8},     {"manufacture", 8},
        {"hangar", 10},     {"supermarket", 6},     {"stadium", 18},       {"grandstand", 10},
        {"sports_hall", 9}, {"sports_centre", 9},   {"train_station", 11}, {"transportation", 8},
        {"parking", 12},    {"kindergarten", 6.4f}, {"school", 10.4f},     {"university", 14},
        {"college", 14},    {"public", 12},         {"civic", 12},         {"government", 16},
        {"hospital", 17},   {"fire_station", 9},    {"castle", 14},        {"palace", 16},
        {"tower", 24},      {"water_tower", 24},    {"bell_tower", 24},    {"bunker", 4},
        {"pavilion", 5},    {"construction", 13},   {"ruins", 4},          {"chimney", 40},
        {"silo", 14},       {"storage_tank", 9},    {"gasometer", 28},     {"cooling_tower", 70},
        {"lighthouse", 24}, {"obelisk", 16},        {"column", 16},        {"campanile", 30},
        {"monument", 9},    {"city_gate", 9},       {"tomb", 4},
    };
    for (const Type& t : k_types) {
        if (t.name == type) return t.height;
    }
    float vary = std::floor(random_unit({id, 0, 0, Purpose::city}, 7) * 3) - 1,
          storeys = around.storeys + vary;
    if (is_house(type)) {
        storeys = type == "terrace" ? 3.0f : 2.0f;
    } else if (is_one_of(type, {"office", "hotel", "skyscraper"})) {
        storeys = std::max(around.storeys + 2, 5.0f);
    } else if (is_one_of(type, {"retail", "commercial"})) {
        storeys = square_metres < 400 ? std::min(around.storeys, 3.0f) : std::max(2.0f, storeys - 1);
    } else if (square_metres < 25) {
        return 2.8f;
    } else if (square_metres < 60) {
        storeys = std::min(storeys, 2.0f);
    } else if (square_metres < 110) {
        storeys = std::min(storeys, 4.0f);
    } else if (square_metres > 8000) {
        storeys = std::min(storeys, 4.0f);
    }
    if (around.old) storeys = clamp(storeys, 2, 4);
    return std::max(storeys, 1.0f) * k_storey + k_attic;
}

std::optional<float> storeys_of(const OsmTags& tags) {
    std::optional<float> levels = parse_number(tags["building:levels"]);
    return levels && *levels >= 0.5f && *levels < k_most_storeys ? levels : std::nullopt;
}

std::optional<float> height_of(const OsmTags& tags) {
    std::optional<float> height = parse_metres(tags["height"]);
    if (!height) height = parse_metres(tags["building:height"]);
    return height && *height >= 1 && *height < k_highest ? height : std::nullopt;
}

uint8_t style_of(const OsmTags& tags, const OsmTags& whole, std::string_view type, uint64_t id) {
    std::string_view material = tags["building:material"];
    if (material.empty()) material = whole["building:material"];
    if (material == "brick") return 3;
    if (is_one_of(material, {"concrete", "glass", "metal", "steel", "cement_block"})) return 4;
    if (is_one_of(material, {"limestone", "stone", "sandstone", "marble", "granite"})) return 0;
    if (is_one_of(material, {"plaster", "stucco", "render"})) return 1;
    if (is_hall_of_prayer(type)) return 0;
    std::optional<Finish> finish = named_finish(type);
    if (finish == Finish::stone) return 0;
    if (finish == Finish::plain && !is_shed(type)) return 4;
    constexpr uint8_t styles[] = {0, 1, 1, 1, 2, 3, 4, 5, 5, 6, 6, 7, 8, 9};
    return styles[static_cast<size_t>(random_unit({id, 0, 0, Purpose::city}, 3) * 14)];
}

// The breadth of the outline across its longer side, metres.
float breadth_of(const Region& outline) {
    float around = 0;
    for (size_t i = 0; i < outline.outer.size(); ++i) {
        around +=
            length(to_metres(outline.outer[(i + 1) % outline.outer.size()]) - to_metres(outline.outer[i]));
    }
    // Of a rectangle of that area and circumference.
    auto surface = static_cast<float>(area(rings_of(outline)));
    float half = around * 0.5f, root = std::sqrt(std::max(0.0f, half * half - 4 * surface));
    return std::max(0.5f, (half - root) * 0.5f);
}

std::optional<RoofKind> roof_named(std::string_view shape) {
    struct Named {
        std::string_view name;
        RoofKind roof;
    };
    static constexpr Named k_named[] = {
        {"flat", RoofKind::flat},
        {"gabled", RoofKind::gable},
        {"saltbox", RoofKind::gable},
        {"cross_gabled", RoofKind::gable},
        {"hipped", RoofKind::hip},
        {"side_hipped", RoofKind::half_hip},
        {"half-hipped", RoofKind::half_hip},
        {"hipped-and-gabled", RoofKind::half_hip},
        {"pyramidal", RoofKind::pyramid},
        {"cone", RoofKind::pyramid},
        {"skillion", RoofKind::skillion},
        {"lean_to", RoofKind::skillion},
        {"gambrel", RoofKind::gambrel},
        {"mansard", RoofKind::mansard},
        {"round", RoofKind::round},
        {"dome", RoofKind::dome},
        {"onion", RoofKind::onion},
    };
    for (const Named& n : k_named) {
        if (n.name == shape) return n.roof;
    }
    return std::nullopt;
}

RoofKind usual_roof(std::string_view type, const Region& outline, float eaves, const OsmSurroundings& around,
                    uint64_t id) {
    float u = random_unit({id, 0, 0, Purpose::city}, 5), breadth = breadth_of(outline);
    double square_metres = area(rings_of(outline));
    bool quad = outline.holes.empty() && without_collinear(outline.outer, 250).size() == 4;
    RoofKind pitched = quad && u < 0.6f ? RoofKind::gable : RoofKind::hip;
    // A "house" of many storeys, as in Taipei, is a block of flats by another name.
    bool low = breadth < 17 && eaves < (around.pitched ? 13.0f : 8.0f);
    if (is_house(type)) return low ? pitched : RoofKind::flat;
    if (is_one_of(type, {"barn", "stable", "farm_auxiliary", "chapel"})) return pitched;
    if (is_one_of(type, {"church", "cathedral", "basilica"})) return RoofKind::gable;
    if (!around.pitched || breadth > 17 || eaves > 20 || square_metres < 25) return RoofKind::flat;
    if (around.old && square_metres < 600) return u < 0.85f ? pitched : RoofKind::flat;
    if (is_one_of(type, {"apartments", "residential", "terrace"}))
        return u < 0.45f ? RoofKind::mansard : u < 0.8f ? pitched : RoofKind::flat;
    if (type == "yes" && square_metres < 300 && eaves < 14) return u < 0.7f ? pitched : RoofKind::flat;
    return RoofKind::flat;
}

float usual_roof_height(RoofKind roof, float breadth) {
    switch (roof) {
        case RoofKind::flat:
            return 0;
        case RoofKind::mansard:
            return 2.6f;
        case RoofKind::skillion:
            return clamp(breadth * 0.15f, 0.4f, 3);
        case RoofKind::pyramid:
            return clamp(breadth * 0.6f, 1, 12);
        case RoofKind::dome:
            return breadth * 0.5f;
        case RoofKind::onion:
            return breadth;
        case RoofKind::round:
            return clamp(breadth * 0.3f, 1, 8);
        default:
            return clamp(breadth * 0.33f, 1.2f, 5);
    }
}

// Along the ridge, with its high side to the left.
Vec2 ridge_of(const OsmTags& tags, RoofKind roof, const Region& outline) {
    std::optional<float> heading = parse_number(tags["roof:direction"]);
    if (!heading) {
        static constexpr std::string_view k_winds[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                       "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
        auto wind = std::find(std::begin(k_winds), std::end(k_winds), tags["roof:direction"]);
        if (wind != std::end(k_winds)) heading = 22.5f * static_cast<float>(wind - k_winds);
    }
    if (heading && std::fabs(*heading) <= 360) {
        // The way down, clockwise from north; the ridge is square to it.
        SinCos turn = sin_cos(*heading * k_radians);
        Vec2 down{turn.sine, -turn.cosine};
        return {down.z, -down.x};
    }
    bool across = tags.is("roof:orientation", "across");
    if (!across || outline.outer.size() < 3) return {};
    Vec2 longest{};
    for (size_t i = 0; i < outline.outer.size(); ++i) {
        Vec2 d = to_metres(outline.outer[(i + 1) % outline.outer.size()]) - to_metres(outline.outer[i]);
        if (dot(d, d) > dot(longest, longest)) longest = d;
    }
    longest = normalize_or(longest, {1, 0});
    return roof == RoofKind::skillion ? longest : Vec2{-longest.z, longest.x};
}

uint32_t roof_material(std::string_view material) {
    if (is_one_of(material, {"roof_tiles", "tile", "tiles", "clay"})) return rgb(0xb5694a);
    if (material == "slate") return rgb(0x5b626b);
    if (is_one_of(material, {"metal", "zinc", "steel", "tin", "metal_sheet"})) return rgb(0x8f979c);
    if (material == "copper") return rgb(0x7f9a8a);
    if (is_one_of(material, {"grass", "plants"})) return rgb(0x6f8a4c);
    if (material == "thatch") return rgb(0x9a8560);
    if (material == "glass") return rgb(0x77858c);
    return 0;
}

}  // namespace

uint32_t parse_colour(std::string_view text, bool roof) {
    struct Named {
        std::string_view name;
        uint32_t hex;
    };
    static constexpr Named k_named[] = {
        {"white", 0xf2f0ec},    {"black", 0x303236},     {"grey", 0x909090},      {"gray", 0x909090},
        {"silver", 0xc0c0c0},   {"lightgrey", 0xc8c8c8}, {"lightgray", 0xc8c8c8}, {"darkgrey", 0x6a6a6a},
        {"darkgray", 0x6a6a6a}, {"red", 0xb05040},       {"darkred", 0x8b3a2f},   {"maroon", 0x7d3a32},
        {"brown", 0x8a5a3c},    {"tan", 0xd2b48c},       {"beige", 0xe8dfc4},     {"cream", 0xf0e6cc},
        {"yellow", 0xe0c46a},   {"gold", 0xc9a84a},      {"orange", 0xd08a4a},    {"pink", 0xe0b0a8},
        {"salmon", 0xe0987f},   {"green", 0x6f8a5c},     {"olive", 0x808050},     {"blue", 0x6080a8},
        {"navy", 0x3a4a6a},     {"purple", 0x7d6080},    {"lightblue", 0xb0c8d8}, {"lightyellow", 0xf0e8c0},
    };
    uint32_t hex = 0;
    if (!text.empty() && text[0] == '#' && (text.size() == 4 || text.size() == 7)) {
        for (char c : text.substr(1)) {
            int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
            if (digit < 0) return 0;
            auto d = static_cast<uint32_t>(digit);
            hex = text.size() == 7 ? hex << 4 | d : hex << 8 | d << 4 | d;
        }
    } else {
        auto named = std::find_if(std::begin(k_named), std::end(k_named),
                                  [&](const Named& n) { return n.name == text; });
        if (named == std::end(k_named)) return 0;
        hex = named->hex;
    }
    // Less of its colour, nothing glaring nor pitch-dark, and a share of the house's limestone or slate.
    float channels[3], grey = 0;
    for (size_t i = 0; i < 3; ++i) channels[i] = static_cast<float>(hex >> (16 - 8 * i) & 0xffu);
    grey = 0.3f * channels[0] + 0.59f * channels[1] + 0.11f * channels[2];
    float tamed = roof ? clamp(grey, 60, 185) : clamp(grey, 95, 220);
    const float k_house[2][3] = {{0xd8, 0xc9, 0xae}, {0x8b, 0x89, 0x83}};
    uint32_t out = 0;
    for (size_t i = 0; i < 3; ++i) {
        float c = clamp(tamed + 0.6f * (channels[i] - grey), 0, 255);
        c = lerp(c, k_house[roof][i], 0.2f);
        out = out << 8 | static_cast<uint32_t>(c);
    }
    return rgb(out);
}

std::optional<float> known_storeys(const OsmTags& tags) {
    if (std::optional<float> levels = storeys_of(tags)) return levels;
    if (std::optional<float> height = height_of(tags)) return *height / k_storey;
    return std::nullopt;
}

bool is_outbuilding(const OsmTags& tags) { return is_shed(type_of(tags)); }

OsmHouse house_of(const OsmTags& tags, const OsmTags& whole, const Region& outline,
                  const OsmSurroundings& around, uint64_t id) {
    OsmHouse house;
    std::string_view type = type_of(tags);
    if (type == "yes") type = type_of(whole);
    std::optional<float> height = height_of(tags), levels = storeys_of(tags);
    // A part that says nothing of its own is as high as the whole.
    if (!height && !levels && &tags != &whole) height = height_of(whole), levels = storeys_of(whole);
    house.default_height = !height && !levels;
    float low = parse_metres(tags["min_height"])
                    .value_or(parse_number(tags["building:min_level"]).value_or(0) * k_storey);
    house.canopy = type == "roof" || type == "carport";
    house.style = style_of(tags, whole, type, id);

    float breadth = breadth_of(outline);
    float eaves = levels ? *levels * k_storey + k_attic : 0;
    if (house.default_height) eaves = usual_height(type, area(rings_of(outline)), around, id);
    float guess = height ? *height : eaves;
    std::string_view shape = tags["roof:shape"];
    if (shape.empty() && !tags.has("building:part")) shape = tags["building:roof:shape"];
    bool is_part = &tags != &whole;
    house.roof = roof_named(shape).value_or(is_part || house.canopy || shape == "many"
                                                ? RoofKind::flat
                                                : usual_roof(type, outline, guess, around, id));
    house.ridge = ridge_of(tags, house.roof, outline);
    if (house.roof != RoofKind::flat) {
        std::optional<float> said = parse_metres(tags["roof:height"]),
                             floors = parse_number(tags["roof:levels"]);
        float rise = usual_roof_height(house.roof, breadth);
        if (floors && *floors > 0 && *floors < 20) rise = *floors * 2.8f;
        if (type == "church" || type == "cathedral" || type == "basilica")
            rise = std::max(rise, breadth * 0.45f);
        if (said && *said >= 0) rise = *said;
        // A height says how much of it can be roof.
        if (height) rise = std::min(rise, (*height - std::max(low, 0.0f)) * (said ? 1.0f : 0.5f));
        house.roof_height = clamp(rise, 0.1f, 200);
    }
    house.top = height ? *height : eaves + house.roof_height;
    house.bottom = clamp(low, 0, std::max(0.0f, house.top - 0.5f));
    if (house.canopy) {
        house.top = std::max(house.top, 3.2f);
        if (house.bottom < 2.5f) house.bottom = house.top - house.roof_height - 0.4f;
    }
    float inside = house.top - house.roof_height - house.bottom;
    house.storey = clamp(levels && *levels >= 1 ? inside / *levels : k_storey, 2.6f, 4.5f);
    house.finish = finish_of(tags, whole, type, breadth, house.top - house.bottom);
    if (is_hall_of_prayer(type) && house.finish == Finish::windows) {
        // One row of tall windows, more only up the highest walls.
        constexpr float k_row = 9, k_least = 4.6f, k_most = 14;
        house.storey = clamp(inside / std::max(1.0f, std::floor(inside / k_row + 0.5f)), k_least, k_most);
    }
    if (house.roof == RoofKind::flat) house.roof_height = house.canopy ? 0 : inside > 6 ? 0.7f : 0.2f;

    auto colour = [&](std::string_view key, bool roof) {
        uint32_t own = parse_colour(tags[key], roof);
        return own ? own : parse_colour(whole[key], roof);
    };
    house.wall_colour = colour("building:colour", false);
    house.roof_colour = colour("roof:colour", true);
    if (!house.roof_colour) house.roof_colour = roof_material(tags["roof:material"]);
    if (!house.roof_colour && around.tiles && house.roof != RoofKind::flat &&
        random_unit({id, 0, 0, Purpose::city}, 9) < 0.9f)
        house.roof_colour = rgb(0xb5694a);
    return house;
}

}  // namespace flaneur
