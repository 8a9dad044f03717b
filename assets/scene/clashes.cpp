// What cannot be in a scene at once.
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "assets/files/file.h"
#include "assets/scene/reading.h"

namespace flaneur {

namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

bool is_round(const Scene& s) { return s.built == BuiltIn::asteroid || s.built == BuiltIn::planets; }
bool is_map(const Scene& scene) { return kind_of(scene.city) == FileKind::map; }

// A city that is a map, as a schema says it of one that must be there.
OrderedJson map_schema() {
    return {{"pattern", R"(\.([oO][sS][mM](\.([gG][zZ]|[bB][zZ]2))?|[pP][bB][fF])$)"}};
}
OrderedJson needs_city(const char* key, OrderedJson city) {
    OrderedJson given = {{"required", OrderedJson::array({"city"})},
                         {"properties", {{"city", std::move(city)}}}};
    return {{"required", OrderedJson::array({key})}, {"not", std::move(given)}};
}
OrderedJson needs_map(const char* key) { return needs_city(key, map_schema()); }

// These keys are there, and these rules hold of values.
OrderedJson both(std::initializer_list<const char*> keys, const OrderedJson& properties) {
    OrderedJson schema = {{"required", keys}};
    if (!properties.empty()) schema["properties"] = properties;
    return schema;
}
// The key is there, with these rules, and the built-in place of this name is not.
OrderedJson needs_built(const char* name, const char* key, const OrderedJson& properties) {
    OrderedJson schema = both({key}, properties);
    schema["not"] = both({"built"}, {{"built", {{"const", name}}}});
    return schema;
}

// The key is there, with these rules, and so is a small world.
OrderedJson on_small_world(const char* key, const OrderedJson& rules) {
    OrderedJson properties = {{"built", {{"enum", {"asteroid", "planets"}}}}};
    if (!rules.empty()) properties[key] = rules;
    return both({"built", key}, properties);
}

// The same of a course.
OrderedJson on_course(const char* key, const OrderedJson& rules) {
    OrderedJson properties = {{"built", {{"const", "course"}}}};
    if (!rules.empty()) properties[key] = rules;
    return both({"built", key}, properties);
}

// What is of people who go by themselves, or of another place.
constexpr const char* k_not_recorded[] = {"city",   "built",  "creatures", "habit", "drunks",  "steppers",
                                          "pushes", "groups", "demand",    "lamps", "traffic", "dogs"};
template <size_t K>
constexpr SceneClash beside_recorded() {
    return {
        k_not_recorded[K], R"("trajectories" say where people go and what the place is like; leave this out)",
        [](const Scene& s, const Json& json) { return is_recorded(s) && json.contains(k_not_recorded[K]); },
        [](const char* key) {
            return both({key, "trajectories"}, OrderedJson::object());
        }};
}

constexpr SceneClash k_clashes[] = {
    beside_recorded<0>(),
    beside_recorded<1>(),
    beside_recorded<2>(),
    beside_recorded<3>(),
    beside_recorded<4>(),
    beside_recorded<5>(),
    beside_recorded<6>(),
    beside_recorded<7>(),
    beside_recorded<8>(),
    beside_recorded<9>(),
    beside_recorded<10>(),
    beside_recorded<11>(),
    {"walkers", R"("trajectories" say who walks, and "walkers" how many others: nobody)",
     [](const Scene& s, const Json&) { return is_recorded(s) && s.walkers > 0; },
     [](const char* key) {
         return both({key, "trajectories"}, {{key, {{"minimum", 1}}}});
     }},
    {"built", R"("built" is a place of its own, and "city" another; people walk in one)",
     [](const Scene& s, const Json&) { return s.built != BuiltIn::district && !s.city.empty(); },
     [](const char* key) {
         return both({key, "city"}, {{key, {{"not", {{"const", "district"}}}}}});
     }},
    {"camera",
     R"("camera": where up is not one way it is overview, follow:ID, or EX,EY,EZ/TX,TY,TZ, such as 22,13,34/1,0,0)",
     [](const Scene& s, const Json&) {
         using enum CameraChoice::Kind;
         const bool on_ground =
             s.camera.kind != overview && s.camera.kind != fixed && s.camera.kind != follow;
         return is_round(s) && on_ground;
     },
     [](const char* key) {
         return on_small_world(key, {{"pattern", "^(street|crowd|map|(eyes|map):.*)$"}});
     }},
    {"trams", R"("trams" is of the built-in district, and "built" says another place)",
     [](const Scene& s, const Json&) { return s.trams && s.built != BuiltIn::district; },
     [](const char* key) {
         return both({"built", key},
                     {{key, {{"const", true}}}, {"built", {{"not", {{"const", "district"}}}}}});
     }},
    {"trams", R"("trams" is of the built-in district, and "city" another place; maps have their own)",
     [](const Scene& s, const Json&) { return s.trams && !s.city.empty(); },
     [](const char* key) {
         return both({key, "city"}, {{key, {{"const", true}}}});
     }},
    {"blocks", R"("blocks" is of the built-in district, and "built" says another place)",
     [](const Scene& s, const Json& json) { return json.contains("blocks") && s.built != BuiltIn::district; },
     [](const char* key) {
         return both({"built", key}, {{"built", {{"not", {{"const", "district"}}}}}});
     }},
    {"added", R"("added" is what is put into a city, and nobody walks in one on the asteroid or the planets)",
     [](const Scene& s, const Json& json) { return json.contains("added") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"pushes", R"("pushes": nobody is pushed on the asteroid or the planets; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("pushes") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"balls", R"("balls": nobody throws any on the asteroid or the planets; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("balls") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"helpers", R"("helpers": nobody falls on the asteroid or the planets; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("helpers") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"dogs", R"("dogs" go with people in cities and fields; on the asteroid and the planets nobody has any)",
     [](const Scene& s, const Json& json) { return json.contains("dogs") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"wheelchairs",
     R"("wheelchairs" go with people in cities and fields; on the asteroid and the planets nobody has any)",
     [](const Scene& s, const Json& json) { return json.contains("wheelchairs") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"white_canes",
     R"("white_canes" go with people in cities and fields; on the asteroid and the planets nobody has any)",
     [](const Scene& s, const Json& json) { return json.contains("white_canes") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"umbrellas",
     R"("umbrellas" go with people in cities and fields; on the asteroid and the planets nobody has any)",
     [](const Scene& s, const Json& json) { return json.contains("umbrellas") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"musicians",
     R"("musicians" go with people in cities and fields; on the asteroid and the planets nobody has any)",
     [](const Scene& s, const Json& json) { return json.contains("musicians") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"lamps",
     R"("lamps" are traffic lights; of the places that are built in they are in the district and on the quayside)",
     [](const Scene& s, const Json&) {
         return s.lamps && s.built != BuiltIn::district && s.built != BuiltIn::quayside;
     },
     [](const char* key) {
         const OrderedJson others = {{"not", {{"enum", {"district", "quayside"}}}}};
         return both({key, "built"}, {{key, {{"const", true}}}, {"built", others}});
     }},
    {"lamps", R"("lamps" are traffic lights, which a glTF city says nothing of)",
     [](const Scene& s, const Json&) { return s.lamps && !s.city.empty() && !is_map(s); },
     [](const char* key) {
         const OrderedJson built_in = {{"not", {{"const", "district"}}}}, map = {{"not", map_schema()}};
         return both({key, "city"},
                     {{key, {{"const", true}}}, {"city", {{"allOf", OrderedJson::array({built_in, map})}}}});
     }},
    {"traffic",
     R"("traffic" is of those who drive; of the places that are built in they do in the district and on the quayside)",
     [](const Scene& s, const Json&) {
         return s.traffic > 0 && s.built != BuiltIn::district && s.built != BuiltIn::quayside;
     },
     [](const char* key) {
         const OrderedJson others = {{"not", {{"enum", {"district", "quayside"}}}}};
         return both({key, "built"}, {{key, {{"exclusiveMinimum", 0}}}, {"built", others}});
     }},
    {"traffic", R"("traffic" is of those who drive, and a glTF city says nothing of where)",
     [](const Scene& s, const Json&) { return s.traffic > 0 && !s.city.empty() && !is_map(s); },
     [](const char* key) {
         const OrderedJson built_in = {{"not", {{"const", "district"}}}}, map = {{"not", map_schema()}};
         return both({key, "city"}, {{key, {{"exclusiveMinimum", 0}}},
                                     {"city", {{"allOf", OrderedJson::array({built_in, map})}}}});
     }},
    {"jaywalkers", R"("jaywalkers" are those who go on red, and nobody does but where "lamps" is true)",
     [](const Scene& s, const Json& json) {
         return !s.lamps && json.contains("jaywalkers") && json.at("jaywalkers") != 0.1;
     },
     [](const char* key) {
         OrderedJson schema = both({key}, {{key, {{"not", {{"const", 0.1}}}}}});
         schema["not"] = both({"lamps"}, {{"lamps", {{"const", true}}}});
         return schema;
     }},
    {"demand",
     R"("demand" sends people through a city, and nobody can be sent on the asteroid or the planets)",
     [](const Scene& s, const Json&) { return !s.demand.empty() && is_round(s); },
     [](const char* key) {
         return on_small_world(key, {{"minLength", 1}});
     }},
    {"side", R"("side": on the asteroid and the planets people pass where there is room; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("side") && is_round(s); },
     [](const char* key) { return on_small_world(key, OrderedJson::object()); }},
    {"creatures", R"("creatures" walk among people; in the "gallery" there is no room for them)",
     [](const Scene& s, const Json&) { return s.creatures > 0 && s.built == BuiltIn::gallery; },
     [](const char* key) {
         return both({key, "built"}, {{key, {{"minimum", 1}}}, {"built", {{"const", "gallery"}}}});
     }},
    {"rock", R"("rock" is what the asteroid is; "built" must be "asteroid")",
     [](const Scene& s, const Json&) { return !s.rock.empty() && s.built != BuiltIn::asteroid; },
     [](const char* key) {
         return needs_built("asteroid", key, {{key, {{"minLength", 1}}}});
     }},
    {"platform",
     R"("platform" is the outline of one; "built" must be "platform", or "drunks" say how many stagger there)",
     [](const Scene& s, const Json&) {
         return !s.platform.empty() && s.built != BuiltIn::platform && s.drunks == 0;
     },
     [](const char* key) {
         return needs_built("platform", key, {{"drunks", {{"maximum", 0}}}});
     }},
    {"drunks", R"("drunks": nobody staggers on the asteroid or the planets; leave it out)",
     [](const Scene& s, const Json&) { return s.drunks > 0 && is_round(s); },
     [](const char* key) {
         return on_small_world(key, {{"minimum", 1}});
     }},
    {"drunks",
     R"("drunks" stagger on a platform; "platform" must be its outline, somewhere where people walk)",
     [](const Scene& s, const Json&) {
         return s.drunks > 0 && s.platform.empty() && s.built != BuiltIn::platform;
     },
     [](const char* key) {
         return needs_built("platform", key,
                            {{key, {{"minimum", 1}}}, {"platform", {{"not", OrderedJson::object()}}}});
     }},
    {"steppers", R"("steppers" go along a "steppers_way", which must be there)",
     [](const Scene& s, const Json&) { return s.steppers > 0 && s.steppers_way.empty(); },
     [](const char* key) {
         return both({key}, {{key, {{"minimum", 1}}}, {"steppers_way", {{"not", OrderedJson::object()}}}});
     }},
    {"steppers_way", R"("steppers_way" is where "steppers" go, and that says how many)",
     [](const Scene& s, const Json&) { return s.steppers == 0 && !s.steppers_way.empty(); },
     [](const char* key) {
         return both({key}, {{"steppers", {{"maximum", 0}}}});
     }},
    {"steppers",
     R"("steppers" are some of a city's people, and "built" says a place that is none or has ways of its own)",
     [](const Scene& s, const Json&) {
         return s.steppers > 0 && (is_round(s) || s.built >= BuiltIn::yard || s.built == BuiltIn::gallery);
     },
     [](const char* key) {
         return both({"built", key},
                     {{"built", {{"enum", {"asteroid", "planets", "gallery", "yard", "course"}}}},
                      {key, {{"minimum", 1}}}});
     }},
    {"drunks", R"("drunks" are as drunk as "drunk" says; without it nobody staggers)",
     [](const Scene& s, const Json&) { return s.drunks > 0 && s.drunk == 0; },
     [](const char* key) {
         return both({key}, {{key, {{"minimum", 1}}}, {"drunk", {{"maximum", 0}}}});
     }},
    {"habit", R"("habit": who staggers does so on a platform; "built" must be "platform")",
     [](const Scene& s, const Json&) { return s.habit == Habit::stagger && s.built != BuiltIn::platform; },
     [](const char* key) {
         return needs_built("platform", key, {{key, {{"const", "stagger"}}}});
     }},
    {"habit", R"("habit": on the asteroid and the planets everybody goes straight on; leave it out)",
     [](const Scene& s, const Json&) { return s.habit == Habit::ramble && is_round(s); },
     [](const char* key) {
         return on_small_world(key, {{"const", "ramble"}});
     }},
    {"limbs", R"("limbs" go by curves of those who ramble; "habit" must be "ramble")",
     [](const Scene& s, const Json&) { return s.limbs == LimbLead::curves && s.habit != Habit::ramble; },
     [](const char* key) {
         OrderedJson schema = both({key}, {{key, {{"const", "curves"}}}});
         schema["not"] = both({"habit"}, {{"habit", {{"const", "ramble"}}}});
         return schema;
     }},
    {"flat", R"("flat" is how a course is laid out; "built" must be "course")",
     [](const Scene& s, const Json&) { return s.flat && s.built != BuiltIn::course; },
     [](const char* key) {
         return needs_built("course", key, {{key, {{"const", true}}}});
     }},
    {"look", R"("look" is for those on a course; "built" must be "course")",
     [](const Scene& s, const Json&) { return s.look && s.built != BuiltIn::course; },
     [](const char* key) { return needs_built("course", key, OrderedJson::object()); }},
    {"habit", R"("habit": on a course everybody goes along it; leave it out)",
     [](const Scene& s, const Json&) { return s.habit == Habit::ramble && s.built == BuiltIn::course; },
     [](const char* key) {
         return on_course(key, {{"const", "ramble"}});
     }},
    {"pushes", R"("pushes": nobody is pushed in one plane; leave it or "flat" out)",
     [](const Scene& s, const Json& json) { return json.contains("pushes") && s.flat; },
     [](const char* key) {
         return both({"flat", key}, {{"flat", {{"const", true}}}});
     }},
    {"added", R"("added" is what is put into a city, and a course is as it is)",
     [](const Scene& s, const Json& json) { return json.contains("added") && s.built == BuiltIn::course; },
     [](const char* key) { return on_course(key, OrderedJson::object()); }},
    {"demand", R"("demand" sends people through a city, and a course leads round)",
     [](const Scene& s, const Json&) { return !s.demand.empty() && s.built == BuiltIn::course; },
     [](const char* key) {
         return on_course(key, {{"minLength", 1}});
     }},
    {"side", R"("side": on a course all go the same way; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("side") && s.built == BuiltIn::course; },
     [](const char* key) { return on_course(key, OrderedJson::object()); }},
    {"canes", R"("canes": nobody walks with one on a course; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("canes") && s.built == BuiltIn::course; },
     [](const char* key) { return on_course(key, OrderedJson::object()); }},
    {"prams", R"("prams": nobody pushes one on a course; leave it out)",
     [](const Scene& s, const Json& json) { return json.contains("prams") && s.built == BuiltIn::course; },
     [](const char* key) { return on_course(key, OrderedJson::object()); }},
    {"blocks", R"("blocks" is of the built-in district, and "city" another place)",
     [](const Scene& s, const Json& json) { return json.contains("blocks") && !s.city.empty(); },
     [](const char* key) {
         return both({key, "city"}, OrderedJson::object());
     }},
    {"terrain", R"("terrain" lies under an OpenStreetMap city, which "city" must name)",
     [](const Scene& s, const Json&) { return !s.terrain.empty() && !is_map(s); }, needs_map},
    {"center", R"("center" is of an OpenStreetMap city, which "city" must name)",
     [](const Scene& s, const Json&) { return s.center && !is_map(s); }, needs_map},
    {"radius", R"("radius" is of an OpenStreetMap city, which "city" must name)",
     [](const Scene& s, const Json&) { return s.radius > 0 && !is_map(s); }, needs_map},
    {"scale", R"("scale" is of a glTF city, which "city" must name; the others are in metres)",
     [](const Scene& s, const Json& json) { return json.contains("scale") && (s.city.empty() || is_map(s)); },
     [](const char* key) {
         return needs_city(key, {{"not", map_schema()}});
     }},
};

}  // namespace

std::span<const SceneClash> scene_clashes() { return k_clashes; }

static bool is_of_nobody(const Scene& scene, const PlannedPush& push) {
    if (!scene.demand.empty()) return false;  // more may come
    return push.walker != k_everybody && push.walker >= static_cast<uint32_t>(scene.walkers);
}

std::optional<uint32_t> pushed_nobody(const Scene& scene) {
    for (const PlannedPush& push : scene.pushes)
        if (is_of_nobody(scene, push)) return push.walker;
    return std::nullopt;
}

void leave_out_nobody(Scene& scene) {
    std::erase_if(scene.pushes, [&](const PlannedPush& push) { return is_of_nobody(scene, push); });
}

}  // namespace flaneur
