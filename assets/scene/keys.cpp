#include "assets/scene/keys.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>
#include <type_traits>

#include "assets/files/file.h"
#include "assets/files/json_place.h"
#include "assets/files/words.h"
#include "assets/scene/reading.h"

namespace flaneur {

namespace {

using Json = nlohmann::json;

// A scene is some lines; what its parser and its errors take grows with these.
constexpr size_t k_most_depth = 8, k_most_values = 10'000;

void read_people(SceneReading& r, Scene& scene, const Json& list);
void read_added(SceneReading& r, Scene& scene, const Json& list);
void read_groups(SceneReading& r, Scene& scene, const Json& shares);
void read_recorded(SceneReading& r, Scene& scene, const Json& what);

template <auto list, auto parse>
void read_texts(SceneReading& r, Scene& scene, const Json& texts) {
    for (const Json& text : texts) take_parsed(r, parse(text), (scene.*list).emplace_back());
}

}  // namespace

const std::vector<SceneKey<Scene>>& scene_keys() {
    using enum KeyKind;
    using Reading = SceneReading;
    const std::string point = point_pattern();
    const std::string across = R"(0*(([5-9]|[1-9][0-9]{1,3}|1[0-9]{4})(\.[0-9]*)?|20000(\.0*)?))",
                      bearing = R"(-?0*(([0-9]|[1-9][0-9]|[12][0-9]{2}|3[0-5][0-9])(\.[0-9]*)?|360(\.0*)?))";
    auto degrees = [](const std::string& digits) { return "-?0*" + digits; };
    const std::string corner = coordinate_pattern() + "," + coordinate_pattern();
    const std::string pixels = "0*([1-9][0-9]{0,2}|[1-7][0-9]{3}|80[0-9]{2}|81[0-8][0-9]|819[0-2])";
    static const std::vector<SceneKey<Scene>> keys = {
        {"$schema",
         {text},
         nullptr,
         R"("scene.schema.json")",
         "Where this schema is, for editors; the program does not read it.",
         [](Reading&, Scene&, const Json&) {}},
        plain_key<&Scene::about>("about", {text}, nullptr, R"("The market on a Saturday")",
                                 "One line on the scene, as `flaneur scenes` shows it."),
        plain_key<&Scene::city>(
            "city", {text}, nullptr, R"("berlin.osm.pbf")",
            "An OpenStreetMap extract (.osm, .osm.pbf) or a glTF scene (.glb, .gltf); "
            "without it, the built-in district. A relative path starts at the scene's folder."),
        {"center",
         {text, 0, 0,
          degrees("([0-8]?[0-9](\\.[0-9]*)?|90(\\.0*)?)") + ", *" +
              degrees("((1[0-7][0-9]|[0-9]?[0-9])(\\.[0-9]*)?|180(\\.0*)?)")},
         nullptr,
         R"("52.5163,13.3777")",
         "LAT,LON in degrees: the middle of what is drawn of an OpenStreetMap city; without it, the whole "
         "map "
         "or, of a large one, where there is most to see.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_place(v), s.center); }},
        plain_key<&Scene::radius>(
            "radius", {number, k_least_map_radius, k_most_map_radius}, nullptr, "800",
            "How far the part of an OpenStreetMap city that is drawn reaches from its middle to each side, "
            "metres; without it, as far as can be built in half a minute."),
        word_key<&Scene::built, k_built_in_names>(
            "built", R"("district")", R"("asteroid")",
            "Which of the built-in places, without a city: a district; an asteroid, all round which people "
            "walk; a platform in still water; a walled field; a gallery of linkages; planets, from one to "
            "another of which people leap; a square by a river; a yard where people carry boxes, open doors "
            "and climb; a course of stairs, bridges, stones and plates that move."),
        {"platform",
         {text, 0, 0, corner + "( +" + corner + "){2,15} *"},
         nullptr,
         R"("-8,-5 8,-5 0,9")",
         "The corners of the built-in platform, 3 to 16, each X,Z in metres: any convex outline within 400 "
         "m.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_platform(v), s.platform); }},
        plain_key<&Scene::rock>(
            "rock", {text}, nullptr, R"("torus")",
            "What the asteroid is: torus, or a .glb or .gltf of any closed mesh, which is made 36 m long. A "
            "relative path starts at the scene's folder."),
        plain_key<&Scene::terrain>(
            "terrain", {text}, nullptr, R"("N43E007.hgt.zip")",
            "Heights of the ground under an OpenStreetMap city: an SRTM tile (.hgt, .hgt.zip) or a GeoTIFF "
            "(.tif); without it, level ground. A relative path starts at the scene's folder."),
        plain_key<&Scene::scale>("scale", {number, k_least_scale, k_most_scale}, "1", "0.01",
                                 "Metres to a unit of a glTF city."),
        plain_key<&Scene::blocks>(
            "blocks", {whole, 1, 32}, "4", "1",
            "Blocks along an edge of the built-in district, which grows where its walkers need more."),
        plain_key<&Scene::trams>(
            "trams", {flag}, "false", "true",
            "Whether an avenue of the built-in district, of two blocks or more, has a pair "
            "of tracks; where people drive, trams do there."),
        plain_key<&Scene::seed>("seed", {whole, 0, 0x1p64}, "1", "7",
                                "Another seed makes other people, ways and, built in, another city."),
        plain_key<&Scene::walkers>("walkers", {whole, 0, k_max_walkers}, "500", "2000",
                                   "How many people walk."),
        plain_key<&Scene::creatures>("creatures", {whole, 0, 100}, "0", "5",
                                     "How many creatures of six legs walk among the people."),
        word_key<&Scene::habit, k_habit_names>(
            "habit", R"("wander")", R"("ramble")",
            "What they do: wander from place to place; ramble, straight on until rays find a wall ahead; or, "
            "on the built-in platform, stagger along circles."),
        word_key<&Scene::limbs, k_limb_lead_names>("limbs", R"("gait")", R"("curves")",
                                                   "What leads the limbs of those who ramble: steps planned "
                                                   "on the ground; or four targets on curves, at "
                                                   "whose pace they go, and they turn slowly."),
        plain_key<&Scene::drunk>("drunk", {number, 0, 1}, "0", "0.8",
                                 "How drunk they are, from not at all to hardly able to walk."),
        plain_key<&Scene::drunks>(
            "drunks", {whole, 0, 100}, "0", "2",
            "How many of the walkers, the first of them, are so drunk and stagger on the "
            "platform while the others do as is their habit. 0: all are."),
        plain_key<&Scene::steppers>(
            "steppers", {whole, 0, 100}, "0", "1",
            "How many of the walkers go along \"steppers_way\" and step when they must, as on the course."),
        {"steppers_way",
         {text, 0, 0, corner + "( +" + corner + "){1,63} *"},
         nullptr,
         R"("-18,20 -18,8")",
         "Where they go: corners X,Z in metres of a line that is closed, or of two, there and back.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_way(v), s.steppers_way); }},
        plain_key<&Scene::flat>("flat", {flag}, "false", "true",
                                "Of the course: in one line, and everybody in one plane."),
        {"look",
         {text, 0, 0, point},
         nullptr,
         R"("2,1.5,0")",
         "Of the course: the place X,Y,Z, metres, that all look at who can turn their heads.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_spot(v), s.look); }},
        {"people",
         {people},
         nullptr,
         R"([{"character": "robot.glb", "share": 1}, {"builtin": true, "share": 9}])",
         "Who they are; without it, the built-in people.",
         read_people},
        mix_key<&PeopleMix::children>(
            "children", "How many of the built-in people below 14 years there are, times as many as usual."),
        mix_key<&PeopleMix::old>(
            "old", "How many of the built-in people of 65 years and more there are, times as many as usual."),
        mix_key<&PeopleMix::canes>(
            "canes",
            "How many of the built-in people who walk with a cane there are, times as many as usual."),
        mix_key<&PeopleMix::prams>(
            "prams", "How many of the built-in people who push a pram there are, times as many as usual."),
        mix_key<&PeopleMix::phones>(
            "phones",
            "How many of the built-in people who look at a phone there are, times as many as usual."),
        {"added",
         {added},
         nullptr,
         R"([{"what": "wall", "at": "0,0,0", "to": "8,0,0"}])",
         "What is put into the city: things in the way, walls, closed streets, benches, lamps and entrances.",
         read_added},
        {"pushes",
         {texts, 0, 0, R"([0-9]+(\.[0-9]*)? (\*|[0-9]{1,6}) )" + corner},
         nullptr,
         R"(["2.5 * 60,0"])",
         "Pushes that people get: \"SECONDS WALKER X,Z\", when, who (a number, or * for everybody) and by "
         "how many newton seconds along the ground.",
         read_texts<&Scene::pushes, parse_push>},
        {"balls",
         {texts, 0, 0, R"([0-9]+(\.[0-9]*)? )" + point + " " + point + R"(( [0-9]+(\.[0-9]*)?){1,2})"},
         nullptr,
         R"(["2 0,1.6,9 0,1.2,0 12"])",
         "Balls thrown: \"SECONDS X,Y,Z X,Y,Z SPEED KILOGRAMS\", when, from where past where, m/s; of 4 kg "
         "without the last.",
         read_texts<&Scene::balls, parse_throw>},
        plain_key<&Scene::helpers>(
            "helpers", {number, 0, 1}, "0.5", "0.8",
            "How many of those who are near and could help up somebody who has fallen do; 0: nobody minds."),
        plain_key<&Scene::lamps>("lamps", {flag}, "false", "true",
                                 "Whether traffic lights work, and people wait for them."),
        plain_key<&Scene::jaywalkers>(
            "jaywalkers", {number, 0, 1}, "0.1", "0.05",
            "How many of those who come to a crossing while its lamp is red go on; only with lamps."),
        {"groups",
         {groups},
         nullptr,
         R"({"1": 0.45, "2": 0.38, "3": 0.11, "4": 0.06})",
         "How many of the people are alone, in pairs, in threes and in fours, against the others, who walk, "
         "stand and talk together; children below ten are never alone then. Without it everybody is by "
         "itself.",
         read_groups},
        plain_key<&Scene::acquaintances>("acquaintances", {number, 0, 1}, "0", "0.05",
                                         "How likely two who come towards each other, each alone, know each "
                                         "other: they greet, stop and talk."),
        along_key<&AlongShares::dogs>(
            "dogs", "How many of the grown ones whose hands are free walk a dog on a lead."),
        along_key<&AlongShares::wheelchairs>("wheelchairs", "How many of them go in a wheelchair."),
        along_key<&AlongShares::white_canes>("white_canes",
                                             "How many of them feel their way with a white cane."),
        along_key<&AlongShares::umbrellas>("umbrellas", "How many of them hold an umbrella."),
        {"musicians",
         {whole, 0, 16},
         "0",
         "3",
         "How many people more play on squares, with those who stop to listen.",
         [](Reading&, Scene& s, const Json& v) { s.along.musicians = v.get<uint32_t>(); }},
        pastime_key<&PastimeShares::sitting>(
            "sitting", "0.5",
            "How many of those who stop at benches, low walls or steps and may sit down there do."),
        pastime_key<&PastimeShares::leaning>(
            "leaning", "0.3", "How many of those who stop beside a wall or a railing lean at it."),
        pastime_key<&PastimeShares::phones>("on_phones", "0.2",
                                            "How many people text, call or take pictures at any time."),
        pastime_key<&PastimeShares::windows>(
            "windows", "1", "How many of those who like to look into shop windows as they pass do."),
        pastime_key<&PastimeShares::queues>("queues", "0.1",
                                            "How many of those who pass a stall line up there."),
        pastime_key<&PastimeShares::tourists>(
            "tourists", "0.05", "How many of those who go alone stop now and then to look up at a house."),
        pastime_key<&PastimeShares::hurrying>(
            "hurrying", "0.1",
            "How many of those who go alone are late, and run for a bus that is at their stop."),
        pastime_key<&PastimeShares::strolling>("strolling", "0.1",
                                               "How many of those who go alone have time."),
        plain_key<&Scene::traffic>("traffic", {number, 0, 1}, "0", "0.5",
                                   "How many cars, vans, buses, bicycles and trams drive: 0 none, 0.5 as "
                                   "usual, 1 as in a rush hour."),
        {"idles",
         {texts},
         nullptr,
         R"(["me.glb:Idle"])",
         "Animations that those who stand play: stretch, look-out or neck, which come with the program, or "
         "FILE or FILE:CLIP, glTF files of skinned humanoids. Relative paths start at the scene's folder.",
         [](Reading&, Scene& s, const Json& v) { s.idles = v.get<std::vector<std::string>>(); }},
        {"time",
         {text, 0, 0, "([01][0-9]|2[0-3]):[0-5][0-9]|dawn|noon|dusk|night"},
         R"("17:30")",
         R"("08:15")",
         "The time of day at the first tick, HH:MM, dawn, noon, dusk or night, which moves the sun, of a day "
         "late "
         "in August, and sends people elsewhere.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_time(v), s.hour); }},
        {"sun_height",
         {number, -90, 90},
         nullptr,
         "28",
         "Degrees of the sun above the horizon; without it, as the time has it.",
         [](Reading&, Scene& s, const Json& v) { s.sun_height = v.get<float>(); }},
        {"sun_heading",
         {number, 0, 360},
         nullptr,
         "235",
         "Degrees of the sun clockwise from north; without it, as the time has it.",
         [](Reading&, Scene& s, const Json& v) { s.sun_heading = v.get<float>(); }},
        {"weather",
         {text, 0, 0, {}, {"clear", "overcast"}},
         R"("clear")",
         R"("overcast")",
         "The weather.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_weather(v), s.is_overcast); }},
        {"side",
         {text, 0, 0, {}, {"right", "left"}},
         nullptr,
         R"("left")",
         "The side on which people pass those who come the other way; without it, that of the traffic on a "
         "map, else right.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_side(v), s.side); }},
        {"coming",
         {flag},
         "true",
         "false",
         "Whether people leave at doors, stops and the edges of the map, and as many others come in there; "
         "else the same people walk all the time.",
         [](Reading&, Scene& s, const Json& v) { s.stays = !v.get<bool>(); }},
        plain_key<&Scene::demand>(
            "demand", {text}, nullptr, R"("demand.json")",
            "A file of people who come in somewhere at a time, go where they are sent and leave there: a "
            ".json or SUMO's .rou.xml; see docs/life/demand.md. A relative path starts at the scene's "
            "folder."),
        {"trajectories",
         {recorded},
         nullptr,
         R"("corridor.txt")",
         "A file of where people were, frame by frame: people go there, nobody else does, and the place is "
         "made "
         "of it. Or that as \"file\" with what the file does not say rightly itself; see "
         "docs/trajectories.md. A "
         "relative path starts at the scene's folder.",
         read_recorded},
        {"camera",
         {text, 0, 0,
          "street|overview|crowd|(follow|eyes):0*[0-9]{1,6}|map|map:" + coordinate_pattern() + "," +
              coordinate_pattern() + "," + across + "(," + bearing + ")?|" + point + "/" + point},
         R"("street")",
         R"("0,1.7,-20/0,1.5,0")",
         "Where to look from: street, overview (on the asteroid and the planets, where it is usual), crowd, "
         "follow:ID "
         "(behind a walker, numbered from 0), eyes:ID (through its eyes), map (of all of the city), "
         "map:X,Z,ACROSS or map:X,Z,ACROSS,BEARING (its middle, its width, metres, and the degrees clockwise "
         "from north that are up), or EX,EY,EZ/TX,TY,TZ: where the eye is and what it looks at, metres.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_camera(v), s.camera); }},
        {"fov",
         {number, k_least_fov, k_most_fov},
         nullptr,
         "50",
         "The field of view from the picture's lower border to its upper one, degrees; without it, 32, or "
         "what follow:ID needs. Not of a map.",
         [](Reading&, Scene& s, const Json& v) { s.fov = fov_of(v.get<double>()); }},
        {"size",
         {text, 0, 0, pixels + "x" + pixels},
         R"("1280x720")",
         R"("1920x1080")",
         "Width and height of the picture or the window, pixels, 1 to 8192 each.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_size(v), s.size); }},
        {"quality",
         {text, 0, 0, {}, {std::begin(k_quality_names), std::end(k_quality_names)}},
         nullptr,
         R"("high")",
         "How finely pictures are drawn; without it, medium on a CPU and ultra on a GPU.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_quality(v), s.quality); }},
        {"view",
         {texts, 0, 0, {}, {std::begin(k_work_view_names), std::end(k_work_view_names)}},
         "[]",
         R"(["skeletons", "trails"])",
         "Views for work that are on: one of wireframe, normals and overdraw, one of lods and speed, one of "
         "density and walkable, and any of the others.",
         [](Reading& r, Scene& s, const Json& v) { take_parsed(r, parse_work_views(v), s.views); }},
    };
    return keys;
}

namespace {

bool is_in_range(const KeyRule& rule, const Json& value) {
    if (!value.is_number()) return false;
    auto number = value.get<double>();
    bool has_part = value.is_number_float() && (number != std::floor(number) || number >= 0x1p64);
    if (rule.kind == KeyKind::whole && has_part) return false;
    return number >= rule.low && number <= rule.high;
}

// What a value must be that it is not; empty: nothing.
std::string refusal(const KeyRule& rule, const Json& value) {
    auto is_text = [](const Json& v) {
        return v.is_string() && !v.get_ref<const std::string&>().empty() &&
               v.get_ref<const std::string&>().find('\0') == std::string::npos;
    };
    auto range = [&](std::string what) {
        if (is_in_range(rule, value)) return std::string();
        what += " number from " + schema_bound(rule.low).dump() + " to " + schema_bound(rule.high).dump();
        return what;
    };
    switch (rule.kind) {
        case KeyKind::flag:
            return value.is_boolean() ? "" : "true or false";
        case KeyKind::whole:
            return range("a whole");
        case KeyKind::number:
            return range("a");
        case KeyKind::text:
            return is_text(value) ? "" : value.is_string() ? "a text of some letters" : "a text in quotes";
        case KeyKind::texts:
            return value.is_array() && std::all_of(value.begin(), value.end(), is_text)
                       ? ""
                       : "a list of texts of some letters";
        case KeyKind::people:
            return value.is_array() ? "" : R"(a list such as [{"builtin": true, "share": 9}])";
        case KeyKind::added:
            return value.is_array() ? "" : R"(a list such as [{"what": "bench", "at": "12.5,0,-3"}])";
        case KeyKind::groups:
            return value.is_object() ? "" : R"(shares such as {"1": 0.45, "2": 0.55})";
        case KeyKind::recorded:
            return is_text(value) || value.is_object() ? ""
                                                       : R"(a file, or such as {"file": "a.txt", "fps": 25})";
    }
    return "";
}

// As a sentence quotes it.
std::string shown(const Json& value) {
    return excerpt(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// Why a key is refused: those that it may be, of many only such as begin alike.
template <class Of>
std::string unknown(const std::string& name, const std::vector<SceneKey<Of>>& keys, const char* owner) {
    constexpr size_t k_few = 16;
    std::vector<std::string> names;
    names.reserve(keys.size());
    for (const SceneKey<Of>& k : keys)
        if (keys.size() <= k_few || (!name.empty() && k.name[0] == name[0])) names.emplace_back(k.name);
    std::string text = in_quotes(excerpt(name)) + " is not known; " + owner + " may have ";
    if (!names.empty()) text += joined(names);
    if (keys.size() > k_few)
        text += std::string(names.empty() ? "" : " and others: ") + "what flaneur scenes --schema tells";
    return text;
}

// The keys of one object. `owner` may have these.
template <class Of>
void read_keys(SceneReading& r, const std::vector<SceneKey<Of>>& keys, const char* owner, const Json& object,
               Of& to) {
    for (const auto& [name, value] : object.items()) {
        r.path.push_back(name);
        auto key = std::find_if(keys.begin(), keys.end(),
                                [&, &known = name](const auto& k) { return k.name == known; });
        if (key == keys.end()) {
            add_fault(r, unknown(name, keys, owner), true);
        } else if (std::string must = refusal(key->rule, value); !must.empty()) {
            // A number as it was written: one that is too large is another to the parser.
            std::string is = value.is_number() ? excerpt(text_in_json(r.text, r.path)) : shown(value);
            add_fault(r, in_quotes(name).append(" must be ").append(must).append(", not ").append(is));
        } else {
            key->take(r, to, value);
        }
        r.path.pop_back();
    }
}

void read_people(SceneReading& r, Scene& scene, const Json& list) {
    for (size_t i = 0; i < list.size(); ++i) {
        r.path.push_back(std::to_string(i));
        PeopleItem item;
        size_t faults = r.faults.size();
        if (list[i].is_object()) read_keys(r, people_keys(), "it", list[i], item);
        if (faults == r.faults.size() && item.is_builtin == !item.people.character.empty())
            add_fault(r, R"(it must have either "character": "FILE" or "builtin": true)");
        scene.people.push_back(item.people);
        r.path.pop_back();
    }
}

void read_added(SceneReading& r, Scene& scene, const Json& list) {
    for (size_t i = 0; i < list.size(); ++i) {
        r.path.push_back(std::to_string(i));
        AddedItem item;
        const size_t faults = r.faults.size();
        if (list[i].is_object()) read_keys(r, added_keys(), "it", list[i], item);
        const std::string fault = fault_of(item);
        if (faults == r.faults.size() && !fault.empty()) add_fault(r, fault);
        scene.added.push_back(item.added);
        r.path.pop_back();
    }
}

// Sizes that are not named are of nobody; where none is, everybody is alone.
void read_recorded(SceneReading& r, Scene& scene, const Json& what) {
    if (what.is_string()) {
        scene.trajectories = what;
    } else {
        read_keys(r, recorded_keys(), R"("trajectories")", what, scene);
        if (!what.contains("file")) add_fault(r, R"("trajectories" must have "file")");
    }
}

void read_groups(SceneReading& r, Scene& scene, const Json& shares) {
    scene.groups = {};
    read_keys(r, group_keys(), "it", shares, scene.groups);
    if (scene.groups == SizeShares{}) scene.groups = {1, 0, 0, 0};
}

// Where a number is too large for a parser, which says its digits but not its place.
size_t place_of_digits(std::string_view text, std::string_view said) {
    size_t from = said.find('\''), to = said.rfind('\'');
    size_t at = from < to ? text.find(said.substr(from + 1, to - from - 1)) : 0;
    return at == std::string_view::npos ? 0 : at;
}

}  // namespace

std::vector<SceneFault> read_scene(std::string_view text, Scene& scene) {
    auto fault = [&](size_t at, const std::string& what) {
        JsonPlace place = place_at(text, at);
        return std::vector<SceneFault>{{place.line, place.column, what}};
    };
    if (auto sound = check_json(text, k_most_depth, k_most_values); !sound)
        return fault(0, "it " + sound.error().message);
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        return fault(std::min(error.byte > 0 ? error.byte - 1 : 0, text.size()), "this is not JSON");
    } catch (const Json::out_of_range& error) {
        return fault(place_of_digits(text, error.what()), "this number is too large");
    }
    if (auto at = find_repeated_key(text)) return fault(*at, "this key is there twice; leave one");
    SceneReading r{text, {}, {}};
    if (!json.is_object()) {
        add_fault(r, R"(a scene must be an object, such as { "walkers": 500 })");
        return r.faults;
    }
    read_keys(r, scene_keys(), "a scene", json, scene);
    if ((scene.built != BuiltIn::district || is_recorded(scene)) && !json.contains("camera"))
        scene.camera.kind = CameraChoice::Kind::overview;
    if (!json.contains("walkers")) scene.walkers = is_recorded(scene) ? 0 : usual_walkers(scene.built);
    for (const SceneClash& clash : scene_clashes()) {
        if (!r.faults.empty() || !clash.is_there(scene, json)) continue;
        r.path = {clash.key};
        add_fault(r, clash.what, true);
    }
    if (const auto nobody = r.faults.empty() ? pushed_nobody(scene) : std::nullopt) {
        r.path = {"pushes"};
        add_fault(r, told_nobody(*nobody, scene.walkers), true);
    }
    std::sort(r.faults.begin(), r.faults.end(), [](const SceneFault& a, const SceneFault& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    return r.faults;
}

}  // namespace flaneur
