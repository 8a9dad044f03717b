#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "assets/cache/cache_file.h"
#include "assets/character.h"
#include "assets/cities.h"
#include "assets/files/file.h"
#include "assets/gltf/group/group.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/tracks/facts.h"

namespace flaneur {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, k_surface_count> k_surface_names = {
    "road", "sidewalk", "crossing", "plaza", "path", "steps", "grass", "water", "track"};
constexpr std::array<const char*, size_t{k_prop_count}> k_prop_names = {
    "trees",     "lamps",   "benches",  "bollards",       "bins",     "cars",
    "fountains", "statues", "planters", "traffic_lights", "shelters", "barriers"};
constexpr std::array<const char*, size_t{k_destination_count}> k_destination_names = {
    "doors", "shops", "benches", "stops", "edges", "squares"};

// To a metre.
double degrees(double value) { return std::round(value * 1e5) / 1e5; }

// Four digits of it.
double rounded(float value) {
    char text[24];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(value));
    return std::strtod(text, nullptr);
}

// "+z", or the direction's components.
std::string direction(Vec3 v) {
    const float parts[] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; ++i) {
        if (std::fabs(parts[i]) > 0.999f) return {parts[i] > 0 ? '+' : '-', static_cast<char>('x' + i)};
    }
    char text[48];
    std::snprintf(text, sizeof text, "%.2f, %.2f, %.2f", static_cast<double>(v.x), static_cast<double>(v.y),
                  static_cast<double>(v.z));
    return text;
}

Json facts_of(const Character& c) {
    Json facts;
    facts["kind"] = "character";
    facts["height_m"] = rounded(c.body.height);
    facts["leg_m"] = rounded(leg_length(c.body));
    facts["unit_m"] = rounded(c.found.scale);
    facts["up"] = direction(c.found.up);
    facts["ahead"] = direction(c.found.ahead);
    facts["skins"] = c.found.skins;
    facts["materials"] = c.found.materials;
    facts["vertices"] = c.vertices.size();
    for (const auto& level : c.lods) facts["triangles"].push_back(level.size() / 3);
    facts["levels"] = Json::array();
    for (const MeasuredLevel& level : c.found.levels)
        facts["levels"].push_back({{"pixels", std::lround(level.pixels)},
                                   {"triangles", level.triangles},
                                   {"silhouette", rounded(level.silhouette)},
                                   {"colour", rounded(level.colour)},
                                   {"refused", level.refused}});
    facts["textures"] = Json::array();
    for (const Texture& texture : c.textures)
        facts["textures"].push_back(std::to_string(texture.width) + "x" + std::to_string(texture.height));
    facts["animations"] = c.found.clips;
    for (size_t j = 0; j < k_joint_count; ++j) {
        const std::string& node = c.found.nodes[j];
        facts["joints"][std::string(k_joint_names[j])] = node.empty() ? Json() : Json(node);
    }
    facts["notes"] = c.notes;
    return facts;
}

// Walls without houses and rails are buildings to those who draw them, and have no facades.
size_t count_houses(const City& city) {
    std::vector<uint8_t> is_house(city.buildings.size());
    for (const Face& face : city.ground.faces)
        if (face.kind == FaceKind::facade && face.building < is_house.size()) is_house[face.building] = 1;
    return static_cast<size_t>(std::count(is_house.begin(), is_house.end(), 1));
}

Json facts_of(const City& city, const char* called) {
    std::array<float, k_surface_count> areas{};
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        Vec3 a = city.ground.vertices[city.ground.indices[3 * t]];
        Vec3 b = city.ground.vertices[city.ground.indices[3 * t + 1]];
        Vec3 c = city.ground.vertices[city.ground.indices[3 * t + 2]];
        areas[static_cast<size_t>(city.ground.kinds[t])] += 0.5f * length(cross(b - a, c - a));
    }
    std::array<size_t, k_prop_names.size()> props{};
    for (const Prop& prop : city.props) ++props[static_cast<size_t>(prop.kind)];
    std::array<size_t, k_destination_names.size()> destinations{};
    for (const Destination& place : city.destinations) ++destinations[static_cast<size_t>(place.kind)];
    float highest = 0;
    for (const Building& building : city.buildings) highest = std::max(highest, building.top - building.base);

    Json facts;
    facts["kind"] = called;
    if (city.on_earth) {
        const OnEarth& place = *city.on_earth;
        facts["center"] = {{"latitude", degrees(place.middle.latitude)},
                           {"longitude", degrees(place.middle.longitude)}};
        auto known = [](float metres) { return metres > 0 ? Json(std::lround(metres)) : Json(); };
        facts["map_width_m"] = known(place.map_width);
        facts["map_depth_m"] = known(place.map_depth);
        facts["radius_m"] = known(place.radius);
        facts["drawn"] = place.radius > 0 ? "a square about the center" : "the whole map";
    }
    facts["width_m"] = std::lround(city.ground.high.x - city.ground.low.x);
    facts["depth_m"] = std::lround(city.ground.high.z - city.ground.low.z);
    facts["buildings"] = count_houses(city);
    facts["highest_m"] = rounded(highest);
    for (size_t kind = 0; kind < areas.size(); ++kind)
        facts["ground_m2"][k_surface_names[kind]] = std::lround(areas[kind]);
    for (size_t kind = 0; kind < props.size(); ++kind) facts["props"][k_prop_names[kind]] = props[kind];
    for (size_t kind = 0; kind < destinations.size(); ++kind)
        facts["destinations"][k_destination_names[kind]] = destinations[kind];
    for (const City::Tally& tally : city.tallies) {
        facts["found_and_built"][tally.what] = {tally.found, tally.built < 0 ? Json() : Json(tally.built)};
    }
    facts["notes"] = city.notes;
    return facts;
}

// "ground_m2" as "ground, m2"; other underscores are blanks.
std::string heading(std::string key) {
    size_t unit = key.rfind("_m");
    bool has_unit = unit != std::string::npos && key.size() - unit <= 3;
    if (has_unit) key.replace(unit, 1, ", ");
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

std::string plain(const Json& value) {
    if (value.is_array() && value.size() == 2) {  // found and built
        char pair[40];
        std::snprintf(pair, sizeof pair, "%7d %7s", value[0].get<int>(),
                      value[1].is_null() ? "-" : value[1].dump().c_str());
        return pair;
    }
    if (value.is_null()) return "-, made up by proportion";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

// A line for each level of detail, and for each that was refused.
void print_levels(const Json& levels) {
    for (const Json& level : levels) {
        std::printf("below %4d pixels  %6d triangles, silhouette %.1f %%, colour %.1f %% off\n",
                    level["pixels"].get<int>(), level["triangles"].get<int>(),
                    100 * level["silhouette"].get<double>(), 100 * level["colour"].get<double>());
        for (const Json& refused : level["refused"]) std::printf("  refused: %s\n", plain(refused).c_str());
    }
}

void print_facts(const Json& facts) {
    for (const auto& [key, value] : facts.items()) {
        if (value.is_null()) continue;
        if (key == "levels") {
            print_levels(value);
        } else if (value.is_object()) {
            std::printf("%s\n", heading(key).c_str());
            for (const auto& [inner, of] : value.items())
                std::printf("  %-24s %s\n", printable(heading(inner)).c_str(), printable(plain(of)).c_str());
        } else if (key == "notes") {
            for (const Json& note : value) std::printf("%s\n", printable(plain(note)).c_str());
        } else if (value.is_array()) {
            std::string line;
            for (const Json& item : value) line += (line.empty() ? "" : ", ") + plain(item);
            std::printf("%-18s %s\n", heading(key).c_str(), line.empty() ? "none" : printable(line).c_str());
        } else {
            std::printf("%-18s %s\n", heading(key).c_str(), printable(plain(value)).c_str());
        }
    }
}

Result<Json> inspect(const Options& options) {
    const std::string& path = options.file;
    CityOptions how = city_options(options.scene);
    if (Result<void> found = find_file(path); !found) return found.error();
    show_progress("reading " + path);
    if (kind_of(path) == FileKind::map) {
        Result<City> city = load_city(path, how);
        if (!city) return city.error();
        return facts_of(*city, "map");
    }
    if (kind_of(path) == FileKind::other) {
        Result<Trajectories> tracks = read_trajectories(path, options.reading);
        if (tracks) return facts_of(*tracks);
        // What looks like rows is none of the things below.
        if (!has_ending(path, ".json")) return tracks.error();
    }
    Result<Character> character = load_character(path, {options.force, cache_folder()});
    if (character) return facts_of(*character);
    if (const Result<GroupFound> group = find_group(path)) {
        return Json{{"kind", "people"},
                    {"people", group->names},
                    {"triangles", group->triangles},
                    {"animations", group->clips}};
    }
    if (has_skin(path)) return character.error();
    // A glTF scene with nobody in it may be a city.
    Result<City> city = load_city(path, how);
    if (!city && has_ending(path, ".json"))
        return Error{character.error().message + "; if it is a scene, flaneur scenes --check looks into it"};
    if (!city) return character.error();
    return facts_of(*city, "thing without a skeleton");
}

}  // namespace

Result<void> run_inspect(const Options& options) {
    Result<PartFilePtr> file = open_if_asked(options.json);
    if (!file) return file.error();
    Result<Json> facts = inspect(options);
    clear_progress();
    if (!facts) return facts.error();
    print_facts(*facts);
    if (!*file) return {};
    // A name in the file may be anything but UTF-8.
    return write_file(std::move(*file), facts->dump(4, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace flaneur
