#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "assets/demand/demand_file.h"
#include "assets/files/file.h"
#include "assets/files/words.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t k_most_depth = 8, k_most_values = 20'000'000, k_most_corners = 1000;
constexpr double k_far = 1e6, k_longest = 1e7;  // metres; seconds
constexpr const char* k_like =
    R"({ "people": [ { "from": [-20, 4], "to": [35, -8], "number": 60, "begin": 0, "end": 600 } ] })";

struct DemandReading {
    const City& city;
    std::map<std::string, SentPlace> places;
};

Result<Vec2> corner_of(const DemandReading& r, const Json& json) {
    if (json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number()) {
        const auto x = json[0].get<double>(), z = json[1].get<double>();
        if (std::fabs(x) <= k_far && std::fabs(z) <= k_far)
            return Vec2{static_cast<float>(x), static_cast<float>(z)};
    }
    if (!json.is_string())
        return Error{excerpt(json.dump()) + R"(, which is neither [X, Z] in metres nor "LAT,LON")"};
    const auto text = json.get<std::string>();
    const auto parts = split(text, ',');
    MapPlace place;
    if (parts.size() != 2 || !parse_number(parts[0], place.latitude) ||
        !parse_number(parts[1], place.longitude) || !(std::fabs(place.latitude) <= 90) ||
        !(std::fabs(place.longitude) <= 180))
        return Error{excerpt(text) + R"(, which is neither a name among "places" nor "LAT,LON")"};
    const auto on_plane = place_on_plane(r.city, place);
    if (!on_plane) return Error{excerpt(text) + ", but only a map has degrees: say [X, Z] in metres"};
    return *on_plane;
}

bool is_corner(const Json& json) {
    return json.is_string() || (json.is_array() && json.size() == 2 && json[0].is_number());
}

Result<SentPlace> area_of(const DemandReading& r, const Json& json) {
    if (json.is_string())
        if (const auto named = r.places.find(json.get<std::string>()); named != r.places.end())
            return named->second;
    SentPlace area;
    const Json* corners = &json;
    if (json.is_object()) {
        for (const auto& [name, value] : json.items())
            if (name != "at" && name != "height")
                return Error{excerpt(name) + ", which is not known; a place has at and height"};
        if (!json.contains("at")) return Error{R"(an object without "at")"};
        corners = &json["at"];
        if (json.contains("height")) {
            const Json& height = json["height"];
            if (!height.is_number() || !(std::fabs(height.get<double>()) <= k_far))
                return Error{R"(a "height" that is no number of metres)"};
            area.height = height.get<float>();
        }
    }
    if (is_corner(*corners)) {
        Result<Vec2> corner = corner_of(r, *corners);
        if (!corner) return corner.error();
        area.corners.push_back(*corner);
        return area;
    }
    if (!corners->is_array() || corners->size() < 3 || corners->size() > k_most_corners)
        return Error{excerpt(corners->dump()) + ", which is neither a place nor three corners or more"};
    for (const Json& one : *corners) {
        Result<Vec2> corner = corner_of(r, one);
        if (!corner) return corner.error();
        area.corners.push_back(*corner);
    }
    return area;
}

// Of one of "people", whose number `which` is for errors.
struct DemandEntry {
    const Json& json;
    std::string subject;

    Error wrong(const std::string& what) const { return Error{subject + what}; }
    Result<double> number(const char* name, double usual, double low, double high) const {
        if (!json.contains(name)) return usual;
        const Json& value = json[name];
        if (value.is_number())
            if (const auto number = value.get<double>(); number >= low && number <= high) return number;
        return wrong(std::string("whose \"") + name + "\" is not a number from " + plainly(low) + " to " +
                     plainly(high));
    }
    Result<uint32_t> whole(const char* name, double low, double high) const {
        Result<double> value = number(name, low, low, high);
        if (!value) return value.error();
        if (*value != std::floor(*value)) return wrong(std::string("whose \"") + name + "\" is not whole");
        return static_cast<uint32_t>(*value);
    }
};

constexpr const char* k_known[] = {"from", "to", "number", "per_minute", "begin", "end", "speed", "group"};

Result<Sending> sending_of(const DemandReading& r, const DemandEntry& entry) {
    if (!entry.json.is_object()) return entry.wrong("that is no object");
    for (const auto& [name, value] : entry.json.items())
        if (std::find(std::begin(k_known), std::end(k_known), name) == std::end(k_known))
            return entry.wrong("with " + excerpt(name) + ", which is not known; there are " +
                               joined(std::vector<std::string>(std::begin(k_known), std::end(k_known))));
    Sending sending;
    for (const auto& [name, area] : {std::pair("from", &sending.from), std::pair("to", &sending.to)}) {
        if (!entry.json.contains(name)) return entry.wrong(std::string("without \"") + name + "\"");
        Result<SentPlace> read = area_of(r, entry.json[name]);
        if (!read) return entry.wrong(std::string("whose \"") + name + "\" is " + read.error().message);
        *area = std::move(*read);
    }
    Result<double> begin = entry.number("begin", 0, 0, k_longest);
    if (!begin) return begin.error();
    Result<double> end = entry.number("end", *begin, 0, k_longest);
    if (!end) return end.error();
    if (*end < *begin) return entry.wrong(R"(whose "end" is before its "begin")");
    sending.begin = static_cast<float>(*begin), sending.end = static_cast<float>(*end);
    Result<double> speed = entry.number("speed", 0, 0.3, 2);
    if (!speed) return speed.error();
    sending.speed = static_cast<float>(*speed);
    Result<uint32_t> group = entry.whole("group", 1, 50);
    if (!group) return group.error();
    sending.group = *group;
    if (!entry.json.contains("per_minute")) {
        Result<uint32_t> people = entry.whole("number", 1, k_most_sent);
        if (!people) return people.error();
        sending.people = *people;
        return sending;
    }
    if (entry.json.contains("number")) return entry.wrong(R"(with both "number" and "per_minute")");
    Result<double> rate = entry.number("per_minute", 0, 0.001, 1e5);
    if (!rate) return rate.error();
    if (*end == *begin) return entry.wrong(R"(with "per_minute" but no "end" after its "begin")");
    const double people = std::floor(*rate * (*end - *begin) / 60 + 0.5);
    if (people > k_most_sent) return entry.wrong("with more than a million people");
    sending.people = static_cast<uint32_t>(people);
    return sending;
}

Result<void> read_places(DemandReading& r, const Json& places) {
    if (!places.is_object()) return Error{R"(has "places" that are no object of names)"};
    for (const auto& [name, value] : places.items()) {
        Result<SentPlace> area = area_of(r, value);
        if (!area) return Error{"has a place " + excerpt(name) + " that is " + area.error().message};
        r.places[name] = std::move(*area);
    }
    return {};
}

}  // namespace

Result<SentPeople> parse_demand(std::string_view text, const City& city) {
    if (Result<void> sound = check_json(text, k_most_depth, k_most_values); !sound) return sound.error();
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return Error{"is not JSON"};
    if (!json.is_object() || !json.contains("people") || !json["people"].is_array())
        return Error{std::string("sends nobody; a demand is ") + k_like};
    for (const auto& [name, value] : json.items())
        if (name != "people" && name != "places" && name != "about")
            return Error{"has " + excerpt(name) +
                         ", which is not known; a demand has about, places and people"};
    DemandReading reading{city, {}};
    if (json.contains("places"))
        if (Result<void> done = read_places(reading, json["places"]); !done) return done.error();
    SentPeople sent;
    bool has_groups = false;
    const Json& people = json["people"];
    for (size_t i = 0; i < people.size(); ++i) {
        Result<Sending> sending =
            sending_of(reading, {people[i], "has people " + std::to_string(i + 1) + " "});
        if (!sending) return sending.error();
        has_groups = has_groups || sending->group > 1;
        if (sending->people > 0) sent.sendings.push_back(std::move(*sending));
    }
    if (has_groups)
        sent.notes.emplace_back(
            "who comes in a group comes when the others do, but walks alone: groups do not walk together "
            "yet");
    return sent;
}

}  // namespace flaneur
