// What of the map is no house, though it stands like one: towers and columns, halls of prayer, sheds, glass.
#include <algorithm>
#include <cmath>

#include "assets/osm/house.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

struct Sort {
    std::string_view name;
    Finish finish;
};
// Values of building, building:part, man_made, historic and memorial.
constexpr Sort k_sorts[] = {
    {"greenhouse", Finish::glass},
    {"glasshouse", Finish::glass},
    {"conservatory", Finish::glass},
    {"garage", Finish::plain},
    {"garages", Finish::plain},
    {"carport", Finish::plain},
    {"shed", Finish::plain},
    {"hut", Finish::plain},
    {"container", Finish::plain},
    {"barn", Finish::plain},
    {"stable", Finish::plain},
    {"cowshed", Finish::plain},
    {"sty", Finish::plain},
    {"farm_auxiliary", Finish::plain},
    {"hangar", Finish::plain},
    {"warehouse", Finish::plain},
    {"silo", Finish::plain},
    {"storage_tank", Finish::plain},
    {"gasometer", Finish::plain},
    {"digester", Finish::plain},
    {"reservoir_covered", Finish::plain},
    {"water_tower", Finish::plain},
    {"cooling_tower", Finish::plain},
    {"transformer_tower", Finish::plain},
    {"service", Finish::plain},
    {"bunker", Finish::plain},
    {"stadium", Finish::plain},
    {"grandstand", Finish::plain},
    {"bleachers", Finish::plain},
    {"lighthouse", Finish::plain},
    {"chimney", Finish::stone},
    {"obelisk", Finish::stone},
    {"column", Finish::stone},
    {"pillar", Finish::stone},
    {"monument", Finish::stone},
    {"memorial", Finish::stone},
    {"tomb", Finish::stone},
    {"mausoleum", Finish::stone},
    {"triumphal_arch", Finish::stone},
    {"city_gate", Finish::stone},
    {"gatehouse", Finish::stone},
    {"citywalls", Finish::stone},
    {"city_wall", Finish::stone},
    {"ruins", Finish::stone},
    {"campanile", Finish::stone},
    {"bell_tower", Finish::stone},
    {"clock_tower", Finish::stone},
    {"minaret", Finish::stone},
    {"tower", Finish::stone},
    {"mast", Finish::plain},
    {"communications_tower", Finish::plain},
    {"bridge_tower", Finish::stone},
};

}  // namespace

std::optional<Finish> named_finish(std::string_view name) {
    auto found = std::find_if(std::begin(k_sorts), std::end(k_sorts),
                              [&](const Sort& sort) { return sort.name == name; });
    return found == std::end(k_sorts) ? std::nullopt : std::optional(found->finish);
}

namespace {

// Those of man_made that stand without being called a building.
constexpr std::string_view k_structures[] = {"tower",     "chimney",     "silo",          "storage_tank",
                                             "gasometer", "water_tower", "cooling_tower", "lighthouse",
                                             "obelisk",   "column",      "campanile"};

}  // namespace

bool is_structure(const OsmTags& tags) {
    // Masts and lattices are seen through.
    bool is_open = tags.is("tower:construction", "lattice") ||
                   tags.is("tower:construction", "guyed_lattice") ||
                   tags.is("tower:construction", "guyed_tube") || tags.is("tower:construction", "dish");
    return !is_open && std::find(std::begin(k_structures), std::end(k_structures), tags["man_made"]) !=
                           std::end(k_structures);
}

// Of what is drawn as a building: lattices and masts too. Empty for what is none.
static std::string_view named_tower(const OsmTags& tags) {
    std::string_view made = tags["man_made"];
    if (made == "mast" || made == "communications_tower" || made == "tower") return made;
    return tags.has("tower:type") ? "tower" : "";
}

std::string_view structure_of(const OsmTags& tags) {
    if (is_structure(tags)) return tags["man_made"];
    std::string_view historic = tags["historic"];
    return historic == "monument" || historic == "city_gate" || historic == "tomb" ? historic
                                                                                   : std::string_view{};
}

std::optional<Ring> round_structure(const OsmTags& tags, Vec2 at) {
    struct Usual {
        std::string_view name;
        float diameter;
    };
    constexpr Usual k_usual[] = {
        {"chimney", 4},        {"silo", 6},       {"storage_tank", 10}, {"gasometer", 30}, {"water_tower", 8},
        {"cooling_tower", 40}, {"lighthouse", 6}, {"obelisk", 2.4f},    {"column", 2},     {"campanile", 6}};
    // A tower that is a point of the map and says no height is most often an aerial on a roof.
    bool says_height = parse_metres(tags["height"]).has_value();
    const Usual* usual = std::find_if(std::begin(k_usual), std::end(k_usual),
                                      [&](const Usual& u) { return u.name == tags["man_made"]; });
    bool is_tower = tags.is("man_made", "tower") && says_height && !tags.is("tower:type", "communication");
    if (!is_structure(tags) || (usual == std::end(k_usual) && !is_tower)) return std::nullopt;
    float diameter = parse_metres(tags["diameter"]).value_or(is_tower ? 6 : usual->diameter);
    int corners = tags.is("man_made", "obelisk") ? 4 : 12;
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        float turn = (static_cast<float>(i) + 0.5f) * 2 * k_pi / static_cast<float>(corners);
        ring.push_back(to_point(at + heading_direction(turn) * (clamp(diameter, 1, 80) * 0.5f)));
    }
    return positive(std::move(ring));
}

bool is_hall_of_prayer(std::string_view type) {
    constexpr std::string_view k_halls[] = {"church", "cathedral", "basilica",  "chapel",    "mosque",
                                            "temple", "synagogue", "monastery", "religious", "shrine"};
    return std::find(std::begin(k_halls), std::end(k_halls), type) != std::end(k_halls);
}

Finish finish_of(const OsmTags& tags, const OsmTags& whole, std::string_view type, float breadth,
                 float height) {
    // Whoever lives or works up there looks out.
    auto has_storeys = [](const OsmTags& t) { return t.has("building:levels") || t.has("building:flats"); };
    constexpr float k_widest_tower = 16;  // metres
    for (const OsmTags* t : {&tags, &whole}) {
        // Houses of flats are called towers too, if they are as broad; what man_made calls one is none.
        bool is_made = !named_tower(*t).empty();
        for (std::string_view name :
             {(*t)["building"], (*t)["building:part"], named_tower(*t), structure_of(*t)}) {
            std::optional<Finish> finish = named_finish(name);
            if (!finish) continue;
            bool is_block = finish == Finish::stone &&
                            (has_storeys(*t) || (name == "tower" && breadth > k_widest_tower && !is_made));
            if (!is_block) return *finish;
        }
    }
    // The towers of churches are of stone.
    bool is_slender = height > 3 * breadth && breadth < 9;
    return is_hall_of_prayer(type) && is_slender ? Finish::stone : Finish::windows;
}

}  // namespace flaneur
