#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "assets/character.h"
#include "assets/city.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/load.h"
#include "tools/flaneur/output.h"

namespace flaneur {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, k_surface_count> k_surface_names = {
    "road", "sidewalk", "crossing", "plaza", "path", "steps", "grass", "water"};
constexpr std::array<const char*, size_t{k_prop_count}> k_prop_names = {
    "trees",     "lamps",   "benches",  "bollards",       "bins",    "cars",
    "fountains", "statues", "planters", "traffic_lights", "shelters"};
constexpr std::array<const char*, size_t{k_destination_count}> k_destination_names = {
    "doors", "shops", "benches", "stops", "edges", "squares"};

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

Json facts_of(const City& city) {
    std::array<float, k_surface_count> areas{};
    for (size_t t = 0; t < city.ground_kinds.size(); ++t) {
        Vec3 a = city.ground_vertices[city.ground_indices[3 * t]];
        Vec3 b = city.ground_vertices[city.ground_indices[3 * t + 1]];
        Vec3 c = city.ground_vertices[city.ground_indices[3 * t + 2]];
        areas[static_cast<size_t>(city.ground_kinds[t])] += 0.5f * length(cross(b - a, c - a));
    }
    std::array<size_t, k_prop_names.size()> props{};
    for (const Prop& prop : city.props) ++props[static_cast<size_t>(prop.kind)];
    std::array<size_t, k_destination_names.size()> destinations{};
    for (const Destination& place : city.destinations) ++destinations[static_cast<size_t>(place.kind)];
    float highest = 0;
    for (const Building& building : city.buildings) highest = std::max(highest, building.top - building.base);

    Json facts;
    facts["kind"] = "map";
    facts["width_m"] = std::lround(city.high.x - city.low.x);
    facts["depth_m"] = std::lround(city.high.z - city.low.z);
    facts["buildings"] = city.buildings.size();
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

void print_facts(const Json& facts) {
    for (const auto& [key, value] : facts.items()) {
        if (value.is_object()) {
            std::printf("%s\n", heading(key).c_str());
            for (const auto& [inner, of] : value.items())
                std::printf("  %-24s %s\n", heading(inner).c_str(), plain(of).c_str());
        } else if (key == "notes") {
            for (const Json& note : value) std::printf("%s\n", plain(note).c_str());
        } else if (value.is_array()) {
            std::string line;
            for (const Json& item : value) line += (line.empty() ? "" : ", ") + plain(item);
            std::printf("%-18s %s\n", heading(key).c_str(), line.empty() ? "none" : line.c_str());
        } else {
            std::printf("%-18s %s\n", heading(key).c_str(), plain(value).c_str());
        }
    }
}

Result<Json> inspect(const std::string& path, const std::string& terrain) {
    show_progress("reading " + path);
    bool is_map = path.find(".osm") != std::string::npos || path.ends_with(".pbf");
    Result<Character> character = is_map ? Result<Character>{Error{}} : load_character(path);
    if (character) return facts_of(*character);
    // A glTF scene with nobody in it is a city.
    Result<City> city = load_city(path, {terrain, 1});
    if (city) return facts_of(*city);
    return is_map ? city.error() : character.error();
}

}  // namespace

Result<void> run_inspect(const Options& options) {
    PartFilePtr file;
    if (!options.json.empty()) {
        Result<PartFilePtr> opened = open_file(options.json);
        if (!opened) return opened.error();
        file = std::move(*opened);
    }
    Result<Json> facts = inspect(options.file, options.scene.terrain);
    clear_progress();
    if (!facts) return facts.error();
    print_facts(*facts);
    if (!file) return {};
    // A name in the file may be anything but UTF-8.
    std::string text = facts->dump(4, ' ', false, Json::error_handler_t::replace) + "\n";
    std::fwrite(text.data(), 1, text.size(), file->file);
    return keep_file(std::move(file));
}

}  // namespace flaneur
