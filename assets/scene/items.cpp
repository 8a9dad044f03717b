// The keys of what a scene lists: people, and what is added to the city.
#include <algorithm>
#include <iterator>

#include "assets/files/file.h"
#include "assets/files/json_place.h"
#include "assets/files/words.h"
#include "assets/scene/reading.h"

namespace flaneur {

namespace {
using Json = nlohmann::json;
}  // namespace

static constexpr size_t k_most_faults = 50;

std::string in_quotes(std::string text) {
    text.insert(text.begin(), '"');
    text += '"';
    return text;
}

void add_fault(SceneReading& r, const std::string& what, bool of_key) {
    if (r.faults.size() == k_most_faults) return;
    JsonPlace place = place_in_json(r.text, r.path, of_key);
    std::string whose;
    size_t number = 0;
    if (r.path.size() > 1) {
        const bool is_listed = parse_number(r.path[1], number);  // else a key of an object
        whose =
            "in " + in_quotes(r.path[0]) + (is_listed ? ", number " + std::to_string(number + 1) : "") + ": ";
    }
    r.faults.push_back({place.line, place.column, whose + what});
}

const std::string& coordinate_pattern() {
    static const std::string text = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)";
    return text;
}
std::string point_pattern() {
    return coordinate_pattern() + "," + coordinate_pattern() + "," + coordinate_pattern();
}

const std::vector<SceneKey<PeopleItem>>& people_keys() {
    using enum KeyKind;
    using Reading = SceneReading;
    using Item = PeopleItem;
    static const std::vector<SceneKey<PeopleItem>> keys = {
        {"character",
         {text},
         nullptr,
         R"("robot.glb")",
         "A glTF or VRM file, .glb, .gltf or .vrm, of a skinned humanoid. A relative path starts at the "
         "scene's folder.",
         [](Reading&, Item& to, const Json& v) { to.people.character = v; }},
        {"builtin",
         {flag},
         "false",
         "true",
         "The built-in people, in place of a file.",
         [](Reading&, Item& to, const Json& v) { to.is_builtin = v; }},
        {"share",
         {number, k_least_share, k_most_share},
         "1",
         "9",
         "Their part of all walkers, against the parts of the others.",
         [](Reading&, Item& to, const Json& v) { to.people.share = v; }},
    };
    return keys;
}

static void take_kind(SceneReading& r, AddedItem& to, const std::string& name) {
    const auto* at = std::find(std::begin(k_added_names), std::end(k_added_names), name);
    if (at == std::end(k_added_names))
        return add_fault(r, "\"what\" is " + excerpt(name) + "; it may be " + joined(k_added_names));
    to.added.kind = static_cast<AddedKind>(at - std::begin(k_added_names));
    to.has_kind = true;
}

template <size_t Size>
static SceneKey<SizeShares> group_key(const char* name, const char* example, const char* meaning) {
    return {name,    {KeyKind::number, 0, 1},
            "0",     example,
            meaning, [](SceneReading&, SizeShares& to, const nlohmann::json& v) { to[Size - 1] = v; }};
}

const std::vector<SceneKey<SizeShares>>& group_keys() {
    static const std::vector<SceneKey<SizeShares>> keys = {
        group_key<1>("1", "0.45", "How many are alone."), group_key<2>("2", "0.38", "How many are in pairs."),
        group_key<3>("3", "0.11", "How many are in threes."),
        group_key<4>("4", "0.06", "How many are in fours.")};
    return keys;
}

const std::vector<SceneKey<Scene>>& recorded_keys() {
    using enum KeyKind;
    using Reading = SceneReading;
    static const std::vector<SceneKey<Scene>> keys = {
        {"file",
         {text},
         nullptr,
         R"("corridor.txt")",
         "Where people were, frame by frame: see docs/trajectories.md. A relative path starts at the scene's "
         "folder.",
         [](Reading&, Scene& to, const Json& v) { to.trajectories = v; }},
        {"fps",
         {number, k_least_frame_rate, k_most_frame_rate},
         nullptr,
         "25",
         "Frames a second; without it, as the file says.",
         [](Reading&, Scene& to, const Json& v) { to.reading.fps = v; }},
        {"unit",
         {number, k_least_unit, k_most_unit},
         nullptr,
         "0.01",
         "Metres that 1 is in the file: 0.01 where it has centimetres; without it, as the file says.",
         [](Reading&, Scene& to, const Json& v) { to.reading.unit = v; }},
        {"up",
         {text, 0, 0, {}, {"y", "z"}},
         nullptr,
         R"("y")",
         "The axis of the file that points upwards; without it, by evidence.",
         [](Reading&, Scene& to, const Json& v) { to.reading.up = v.get<std::string>()[0]; }},
        {"origin",
         {text, 0, 0, coordinate_pattern() + "," + coordinate_pattern()},
         nullptr,
         R"("120,-40")",
         "The place of the file, EAST,NORTH in its own unit, that is to be the middle.",
         [](Reading& r, Scene& to, const Json& v) {
             if (const Result<Vec2> origin = parse_origin(v))
                 to.reading.origin = *origin;
             else
                 add_fault(r, origin.error().message);
         }},
        {"geometry",
         {text},
         nullptr,
         R"("corridor.wkt")",
         "A file of where people can be; without it, one that lies beside the file and fits. A relative path "
         "starts at the scene's folder.",
         [](Reading&, Scene& to, const Json& v) { to.reading.geometry = v; }},
        {"enter",
         {text, 0, 0, {}, names(k_entering_names)},
         R"("fade")",
         R"("step")",
         "How one comes and leaves who is seen in the middle of the recording: fade, into sight where it is "
         "first; or step, before that and after, straight on, so that it is there in full as long as it is "
         "recorded.",
         [](Reading& r, Scene& to, const Json& v) {
             take_parsed(r, word_of<Entering>(k_entering_names, v), to.entering);
         }},
    };
    return keys;
}

const std::vector<SceneKey<AddedItem>>& added_keys() {
    using enum KeyKind;
    using Reading = SceneReading;
    using Item = AddedItem;
    static const std::vector<SceneKey<AddedItem>> keys = {
        {"what",
         {text, 0, 0, {}, {std::begin(k_added_names), std::end(k_added_names)}},
         nullptr,
         R"("bench")",
         "What it is. A wall is of stone and 2 m high, and stops people as a barrier does, a row of planks "
         "that "
         "closes a street; an entrance leads into the nearest house, within 3 m, and draws people.",
         [](Reading& r, Item& to, const Json& v) { take_kind(r, to, v); }},
        {"at",
         {text, 0, 0, point_pattern()},
         nullptr,
         R"("12.5,0.1,-3")",
         "Where it is, X,Y,Z in metres, on the ground or up to 3 m above or below it; of a wall or a "
         "barrier, one "
         "end.",
         [](Reading& r, Item& to, const Json& v) {
             take_parsed(r, parse_spot(v), to.added.at);
             to.has_at = true;
         }},
        {"to",
         {text, 0, 0, point_pattern()},
         nullptr,
         R"("20,0.1,-3")",
         "The other end of a wall or a barrier, 0.5 to 200 m away.",
         [](Reading& r, Item& to, const Json& v) {
             take_parsed(r, parse_spot(v), to.added.to);
             to.has_to = true;
         }},
        {"turn",
         {number, -360, 360},
         "0",
         "90",
         "Degrees that it is turned, counter-clockwise seen from above; at 0 it faces +z. Not of walls, "
         "barriers "
         "and entrances.",
         [](Reading&, Item& to, const Json& v) {
             to.added.turn = v;
             to.has_turn = true;
         }},
    };
    return keys;
}

std::string fault_of(const AddedItem& item) {
    const Addition& a = item.added;
    if (!item.has_kind || !item.has_at)
        return R"(it must have "what" and "at", such as {"what": "bench", "at": "12.5,0,-3"})";
    if (is_drawn_out(a.kind) != item.has_to)
        return item.has_to ? R"("to" is of walls and barriers alone)"
                           : R"(a wall or a barrier must have "to", its other end)";
    if (item.has_turn && !is_turned(a.kind)) return R"("turn" is not of walls, barriers and entrances)";
    const float whole = length(on_ground(a.to - a.at));
    if (item.has_to && !(whole >= k_shortest_added && whole <= k_longest_added))
        return R"("to" must be 0.5 to 200 m away from "at" on the ground plane)";
    return "";
}

}  // namespace flaneur
