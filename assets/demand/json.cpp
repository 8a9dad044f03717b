#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "assets/demand/demand_file.h"
#include "assets/files/file.h"
#include "assets/files/json_place.h"
#include "assets/files/words.h"
#include "sim/base/planar.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_depth = 8, k_most_values = 20'000'000;
constexpr size_t k_most_corners = 1000, k_most_corners_of_all = 1'000'000;
constexpr double k_far = 1e6, k_longest = 1e7;  // metres; seconds
constexpr const char* k_like =
    R"({ "people": [ { "from": [-20, 4], "to": [35, -8], "number": 60, "begin": 0, "end": 600 } ] })";

struct DemandReading {
    const City& city;
    std::string_view text;
    std::map<std::string, SentPlace> places{};
    bool is_naming = false;  // reads "places", of which only those above are known
    size_t corners = 0;      // of all areas that people are sent between
};

std::string line_of(const DemandReading& r, const std::vector<std::string>& path, bool of_key = false) {
    return "line " + std::to_string(place_in_json(r.text, path, of_key).line);
}

std::vector<std::string> names_of(const DemandReading& r) {
    std::vector<std::string> names;
    for (const auto& [name, area] : r.places) names.push_back(name);
    return names;
}

Result<Vec2> corner_in_metres(const Json& json) {
    const auto x = json[0].get<double>(), z = json[1].get<double>();
    if (std::fabs(x) <= k_far && std::fabs(z) <= k_far)
        return Vec2{static_cast<float>(x), static_cast<float>(z)};
    return Error{excerpt(json.dump()) + ", which is more than " + plainly(k_far) +
                 " m from the middle of the city"};
}

Result<Vec2> corner_in_degrees(const DemandReading& r, const std::string& text, MapPlace place) {
    if (!(std::fabs(place.latitude) <= 90) || !(std::fabs(place.longitude) <= 180))
        return Error{excerpt(text) +
                     R"(, which is nowhere on Earth: "LAT,LON" is within 90 and 180 degrees)"};
    const auto on_plane = place_on_plane(r.city, place);
    if (!on_plane) return Error{excerpt(text) + ", but only a map has degrees: say [X, Z] in metres"};
    return *on_plane;
}

// Of an area, or, if it `is_alone`, a place, which may have a name.
Result<Vec2> corner_of(const DemandReading& r, const Json& json, bool is_alone) {
    if (json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number())
        return corner_in_metres(json);
    if (!json.is_string())
        return Error{excerpt(json.dump()) + R"(, which is neither [X, Z] in metres nor "LAT,LON")"};
    const auto text = json.get<std::string>();
    const auto parts = split(text, ',');
    MapPlace place;
    if (parts.size() == 2 && parse_number(parts[0], place.latitude) &&
        parse_number(parts[1], place.longitude))
        return corner_in_degrees(r, text, place);
    if (!is_alone)
        return Error{excerpt(text) +
                     R"(, which is no corner of an area: neither [X, Z] in metres nor "LAT,LON")"};
    return Error{excerpt(text) + R"(, which is neither "LAT,LON" nor the name of one of "places")" +
                 (r.is_naming ? " above it" : "") +
                 (r.places.empty() ? "" : ": " + excerpt(joined(names_of(r))))};
}

bool is_corner(const Json& json) {
    return json.is_string() || (json.is_array() && json.size() == 2 && json[0].is_number());
}

Result<std::vector<Vec2>> corners_of(const DemandReading& r, const Json& json) {
    if (json.is_string())
        if (const auto named = r.places.find(json.get<std::string>()); named != r.places.end())
            return named->second.corners;
    if (is_corner(json)) {
        Result<Vec2> corner = corner_of(r, json, true);
        if (!corner) return corner.error();
        return std::vector<Vec2>{*corner};
    }
    if (!json.is_array() || json.size() < 3)
        return Error{excerpt(json.dump()) + ", which is neither a place nor three corners or more"};
    if (json.size() > k_most_corners)
        return Error{"an area of " + std::to_string(json.size()) + " corners, and " +
                     std::to_string(k_most_corners) + " are the most"};
    std::vector<Vec2> corners;
    for (const Json& one : json) {
        Result<Vec2> corner = corner_of(r, one, false);
        if (!corner) return corner.error();
        corners.push_back(*corner);
    }
    constexpr double k_least = 0.01;  // square metres
    if (area_of(corners) < k_least)
        return Error{excerpt(json.dump()) +
                     ", which goes round no ground, or crosses itself: an area has 0.01 m2 at least, and a "
                     "place is one corner, [X, Z]"};
    return corners;
}

Result<SentPlace> area_of(const DemandReading& r, const Json& json) {
    SentPlace area;
    const Json* corners = &json;
    if (json.is_object()) {
        for (const auto& [name, value] : json.items())
            if (name != "at" && name != "height")
                return Error{"one with " + excerpt(name) + ", which is not known; a place has at and height"};
        if (!json.contains("at")) return Error{R"(an object without "at")"};
        corners = &json["at"];
        if (json.contains("height")) {
            const Json& height = json["height"];
            if (!height.is_number() || !(std::fabs(height.get<double>()) <= k_far))
                return Error{R"(one with a "height" that is no number of metres)"};
            area.height = height.get<float>();
        }
    }
    if (corners->is_string() && !area.height)
        if (const auto named = r.places.find(corners->get<std::string>()); named != r.places.end())
            area.height = named->second.height;
    Result<std::vector<Vec2>> read = corners_of(r, *corners);
    if (!read) return read.error();
    area.corners = std::move(*read);
    return area;
}

// Of one of "people".
struct DemandEntry {
    const DemandReading& reading;
    const Json& json;
    std::string number;  // in the list, from 0

    Error wrong(const std::string& what, const char* key = nullptr) const {
        std::vector<std::string> path{"people", number};
        if (key && json.contains(key)) path.emplace_back(key);
        const bool has_key = path.size() > 2;
        return Error{"has in " + line_of(reading, path, has_key) + " people " +
                     std::to_string(std::stoul(number) + 1) + " " + what};
    }
    Result<double> in_range(const char* name, double usual, double low, double high) const {
        if (!json.contains(name)) return usual;
        const Json& value = json[name];
        if (value.is_number())
            if (const auto number_read = value.get<double>(); number_read >= low && number_read <= high)
                return number_read;
        return wrong(std::string("whose \"") + name + "\" is not a number from " + plainly(low) + " to " +
                         plainly(high),
                     name);
    }
    Result<uint32_t> whole(const char* name, double low, double high) const {
        Result<double> value = in_range(name, low, low, high);
        if (!value) return value.error();
        if (*value != std::floor(*value))
            return wrong(std::string("whose \"") + name + "\" is not whole", name);
        return static_cast<uint32_t>(*value);
    }
};

constexpr const char* k_known[] = {"name",  "from", "to",    "number", "per_minute",
                                   "begin", "end",  "speed", "group"};

Result<void> read_ends(DemandReading& r, const DemandEntry& entry, Sending& sending) {
    for (const auto& [name, area] : {std::pair("from", &sending.from), std::pair("to", &sending.to)}) {
        if (!entry.json.contains(name)) return entry.wrong(std::string("without \"") + name + "\"");
        Result<SentPlace> read = area_of(r, entry.json[name]);
        if (!read) return entry.wrong(std::string("whose \"") + name + "\" is " + read.error().message, name);
        *area = std::move(*read);
        if (area->corners.size() > 1) r.corners += area->corners.size();
    }
    if (r.corners > k_most_corners_of_all)
        return entry.wrong("with whom the areas that people are sent between have more than " +
                           std::to_string(k_most_corners_of_all) +
                           " corners in all: draw them with fewer, or take fewer entries");
    return {};
}

Result<void> read_times(const DemandEntry& entry, Sending& sending) {
    Result<double> begin = entry.in_range("begin", 0, 0, k_longest);
    if (!begin) return begin.error();
    Result<double> end = entry.in_range("end", *begin, 0, k_longest);
    if (!end) return end.error();
    if (*end < *begin) return entry.wrong(R"(whose "end" is before its "begin")", "end");
    sending.begin = static_cast<float>(*begin), sending.end = static_cast<float>(*end);
    return {};
}

Result<uint32_t> people_of(const DemandEntry& entry, const Sending& sending) {
    if (!entry.json.contains("per_minute")) return entry.whole("number", 1, k_most_sent);
    if (entry.json.contains("number")) return entry.wrong(R"(with both "number" and "per_minute")");
    Result<double> rate = entry.in_range("per_minute", 0, 0.001, 1e5);
    if (!rate) return rate.error();
    const double seconds = static_cast<double>(sending.end) - static_cast<double>(sending.begin);
    if (!(seconds > 0)) return entry.wrong(R"(with "per_minute" but no "end" after its "begin")");
    const double people = std::floor(*rate * seconds / 60 + 0.5);
    if (people > k_most_sent) return entry.wrong("with more than a million people", "per_minute");
    if (people < 1)
        return entry.wrong(
            "who are nobody: from its \"begin\" to its \"end\" less than half a person comes; "
            "make it longer, or its \"per_minute\" more",
            "per_minute");
    return static_cast<uint32_t>(people);
}

Result<Sending> sending_of(DemandReading& r, const DemandEntry& entry) {
    if (!entry.json.is_object()) return entry.wrong("that is no object");
    for (const auto& [name, value] : entry.json.items())
        if (std::find(std::begin(k_known), std::end(k_known), name) == std::end(k_known))
            return entry.wrong("with " + excerpt(name) + ", which is not known; there are " +
                                   joined(std::vector<std::string>(std::begin(k_known), std::end(k_known))),
                               name.c_str());
    if (entry.json.contains("name") && !entry.json["name"].is_string())
        return entry.wrong(R"(whose "name" is no text)", "name");
    Sending sending;
    if (Result<void> read = read_ends(r, entry, sending); !read) return read.error();
    if (Result<void> read = read_times(entry, sending); !read) return read.error();
    Result<double> speed = entry.in_range("speed", 0, 0.3, 2);
    if (!speed) return speed.error();
    sending.speed = static_cast<float>(*speed);
    Result<uint32_t> group = entry.whole("group", 1, 50);
    if (!group) return group.error();
    sending.group = *group;
    Result<uint32_t> people = people_of(entry, sending);
    if (!people) return people.error();
    sending.people = *people;
    return sending;
}

Result<void> read_places(DemandReading& r, const Json& places) {
    if (!places.is_object()) return Error{R"(has "places" that are no object of names)"};
    r.is_naming = true;
    for (const auto& [name, value] : places.items()) {
        Result<SentPlace> area = area_of(r, value);
        if (!area)
            return Error{"has in " + line_of(r, {"places", name}, true) + " a place " + excerpt(name) +
                         " that is " + area.error().message};
        r.places[name] = std::move(*area);
    }
    r.is_naming = false;
    return {};
}

// Without what is in it.
Result<Json> read_head(std::string_view text) {
    if (Result<void> sound = check_json(text, k_most_depth, k_most_values); !sound) return sound.error();
    auto in_line = [&](size_t at) {
        const JsonPlace place = place_at(text, at);
        return "in line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
    };
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        return Error{"is not JSON " + in_line(std::min(error.byte > 0 ? error.byte - 1 : 0, text.size()))};
    } catch (const Json::out_of_range&) {
        return Error{"has a number that is too large"};
    }
    if (const auto at = find_repeated_key(text))
        return Error{"has " + in_line(*at) + " the key " +
                     excerpt(text.substr(*at, text.find('"', *at + 1) + 1 - *at)) + " twice; leave one"};
    if (!json.is_object() || !json.contains("people") || !json["people"].is_array())
        return Error{std::string("sends nobody; a demand is ") + k_like};
    for (const auto& [name, value] : json.items())
        if (name != "people" && name != "places" && name != "about")
            return Error{"has in line " + std::to_string(place_in_json(text, {name}, true).line) + " " +
                         excerpt(name) + ", which is not known; a demand has about, places and people"};
    return json;
}

}  // namespace

Result<SentPeople> parse_demand(std::string_view text, const City& city) {
    const Result<Json> json = read_head(text);
    if (!json) return json.error();
    DemandReading reading{city, text};
    if (json->contains("places"))
        if (Result<void> done = read_places(reading, (*json)["places"]); !done) return done.error();
    SentPeople sent;
    bool has_groups = false;
    const Json& people = (*json)["people"];
    if (people.empty())
        return Error{std::string("sends nobody: its \"people\" are empty; a demand is ") + k_like};
    for (size_t i = 0; i < people.size(); ++i) {
        Result<Sending> sending = sending_of(reading, {reading, people[i], std::to_string(i)});
        if (!sending) return sending.error();
        has_groups = has_groups || sending->group > 1;
        sent.sendings.push_back(std::move(*sending));
        sent.names.push_back(people[i].contains("name") ? excerpt(people[i]["name"].get<std::string>())
                                                        : "people " + std::to_string(i + 1));
    }
    if (has_groups)
        sent.notes.emplace_back(
            "who comes in a group comes when the others do, but walks alone: groups do not walk together "
            "yet");
    return sent;
}

}  // namespace flaneur
