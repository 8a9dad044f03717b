// Persons of SUMO whose walks say where they begin and end as places; what names edges needs SUMO's net.
// SUMO's x and y are metres to the east and to the north; ours are about the middle of the city.
#include <expat.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "assets/demand/demand_file.h"
#include "assets/files/file.h"
#include "assets/files/words.h"

namespace flaneur {
namespace {

using SumoAttributes = std::map<std::string, std::string, std::less<>>;

constexpr double k_longest = 1e7;  // seconds

struct SumoReading {
    const City& city;
    XML_Parser parser = nullptr;
    SentPeople sent;
    size_t stages_left_out = 0;  // rides and stops
    size_t without_walk = 0;     // persons and flows
    std::string refused;         // what was wrong first, a sentence without its subject
    bool has_root = false, is_in_person = false, has_walk = false;
    Sending person;    // the one that is read: who and when
    std::string name;  // and what it is called
};

void refuse(SumoReading& r, const std::string& what) {
    if (!r.refused.empty()) return;
    r.refused = "has in line " + std::to_string(XML_GetCurrentLineNumber(r.parser)) + " " + what;
    XML_StopParser(r.parser, XML_FALSE);
}

std::optional<double> number_of(SumoReading& r, const SumoAttributes& a, const char* name, double low,
                                double high) {
    const auto found = a.find(name);
    double value = 0;
    if (found == a.end()) return std::nullopt;
    if (parse_number(found->second, value) && value >= low && value <= high) return value;
    refuse(r, std::string("a \"") + name + "\" of " + excerpt(found->second) +
                  ", which is not a number from " + plainly(low) + " to " + plainly(high));
    return std::nullopt;
}

// Seconds, or [days:]hours:minutes:seconds.
std::optional<double> seconds_of(SumoReading& r, const SumoAttributes& a, const char* name) {
    const auto found = a.find(name);
    if (found == a.end()) return std::nullopt;
    double seconds = 0;
    const auto parts = split(found->second, ':');
    constexpr double k_units[] = {86400, 3600, 60, 1};
    bool is_sound = parts.size() == 1 || parts.size() == 3 || parts.size() == 4;
    for (size_t i = 0; is_sound && i < parts.size(); ++i) {
        double part = 0;
        is_sound = parse_number(parts[i], part);
        seconds += part * k_units[4 - parts.size() + i];
    }
    if (is_sound && seconds >= 0 && seconds <= k_longest) return seconds;
    refuse(r, std::string("a \"") + name + "\" of " + excerpt(found->second) +
                  ", which is no time from the beginning on");
    return std::nullopt;
}

void begin_person(SumoReading& r, const SumoAttributes& a) {
    r.person = {};
    r.is_in_person = true;
    r.has_walk = false;
    if (!a.contains("depart")) return refuse(r, R"(a person without "depart")");
    const double depart = seconds_of(r, a, "depart").value_or(0);
    r.person.begin = r.person.end = static_cast<float>(depart);
}

void begin_flow(SumoReading& r, const SumoAttributes& a) {
    r.person = {};
    r.is_in_person = true;
    r.has_walk = false;
    const double begin = seconds_of(r, a, "begin").value_or(0);
    auto end = seconds_of(r, a, "end");
    double people = 0;
    const auto number = number_of(r, a, "number", 0, k_most_sent),
               period = number_of(r, a, "period", 0.001, k_longest);
    const bool has_rate = a.contains("perHour") || a.contains("personsPerHour");
    if (number && (has_rate || (period && end)))
        return refuse(r, R"(a personFlow with "number" beside a rate: leave one, or "end" of a period)");
    if (number) {
        people = *number;
        if (period) end = begin + people * *period;
        if (end && *end > k_longest) return refuse(r, "a personFlow that takes longer than 10,000,000 s");
    } else if (end && *end >= begin) {
        if (const auto rate = number_of(r, a, "perHour", 0, 1e7)) people = *rate * (*end - begin) / 3600;
        if (const auto rate = number_of(r, a, "personsPerHour", 0, 1e7))
            people = *rate * (*end - begin) / 3600;
        if (period) people = std::ceil((*end - begin) / *period);
    }
    if (!end || *end < begin) return refuse(r, R"(a personFlow without an "end" after its "begin")");
    if (people > k_most_sent) return refuse(r, "a personFlow of more than a million people");
    r.person.people = static_cast<uint32_t>(people + 0.5);
    if (r.person.people == 0)
        return refuse(r, R"(a personFlow that sends nobody: it takes "number", "perHour" or "period")");
    r.person.begin = static_cast<float>(begin), r.person.end = static_cast<float>(*end);
}

// "X,Y" or "LON,LAT".
std::optional<SentPlace> place_of(SumoReading& r, const SumoAttributes& a, const std::string& end) {
    const bool is_in_degrees = a.contains(end + "LonLat");
    const auto found = a.find(end + (is_in_degrees ? "LonLat" : "XY"));
    if (found == a.end()) {
        refuse(r, "a walk without \"" + end + "XY\" or \"" + end +
                      "LonLat\": one along edges needs SUMO's net, which is not read");
        return std::nullopt;
    }
    const auto parts = split(found->second, ',');
    double first = 0, second = 0;
    if (parts.size() < 2 || !parse_number(parts[0], first) || !parse_number(parts[1], second) ||
        !(std::fabs(first) <= 1e6) || !(std::fabs(second) <= 1e6)) {
        refuse(r, "a \"" + found->first + "\" of " + excerpt(found->second) + ", which is no place");
        return std::nullopt;
    }
    SentPlace area;
    if (!is_in_degrees) {
        area.corners = {{static_cast<float>(first), static_cast<float>(-second)}};
        return area;
    }
    const auto place = place_on_plane(r.city, {second, first});
    if (!place) {
        refuse(r, "a place in degrees, which only a map has: give one with --city, or say it in metres");
        return std::nullopt;
    }
    area.corners = {*place};
    return area;
}

void add_walk(SumoReading& r, const SumoAttributes& a) {
    if (r.has_walk) return refuse(r, "a person with more than one walk, of whom only one could be walked");
    r.has_walk = true;
    auto from = place_of(r, a, "from"), to = place_of(r, a, "to");
    if (!from || !to) return;
    Sending sending = r.person;
    sending.from = std::move(*from), sending.to = std::move(*to);
    if (const auto speed = number_of(r, a, "speed", 0.3, 2)) sending.speed = static_cast<float>(*speed);
    r.sent.sendings.push_back(std::move(sending));
    r.sent.names.push_back(r.name);
}

std::string name_of(const SumoReading& r, const SumoAttributes& a, const char* kind) {
    const auto id = a.find("id");
    if (id != a.end()) return std::string(kind) + " " + excerpt(id->second);
    return std::string(kind) + " in line " + std::to_string(XML_GetCurrentLineNumber(r.parser));
}

void begin_element(void* user, const XML_Char* name, const XML_Char** pairs) {
    SumoReading& r = *static_cast<SumoReading*>(user);
    if (!r.refused.empty()) return;
    SumoAttributes a;
    for (; *pairs; pairs += 2) a[pairs[0]] = pairs[1];
    const std::string_view element = name;
    if (!r.has_root) {
        r.has_root = true;
        if (element != "routes" && element != "additional")
            refuse(r, "no routes of SUMO, but " + excerpt(element));
    } else if (element == "person") {
        begin_person(r, a);
        r.name = name_of(r, a, "person");
    } else if (element == "personFlow") {
        begin_flow(r, a);
        r.name = name_of(r, a, "personFlow");
    } else if (r.is_in_person && (element == "walk" || element == "personTrip")) {
        add_walk(r, a);
    } else if (r.is_in_person && (element == "ride" || element == "stop")) {
        ++r.stages_left_out;
    }
}

void end_element(void* user, const XML_Char* name) {
    SumoReading& r = *static_cast<SumoReading*>(user);
    const std::string_view element = name;
    if (element != "person" && element != "personFlow") return;
    if (r.is_in_person && !r.has_walk) ++r.without_walk;
    r.is_in_person = false;
}

// Entities may grow without bounds, and no file of SUMO declares any.
void refuse_entity(void* user, const XML_Char*, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                   const XML_Char*, const XML_Char*) {
    refuse(*static_cast<SumoReading*>(user), "an entity, which SUMO writes none of");
}

}  // namespace

Result<SentPeople> parse_sumo_persons(std::string_view text, const City& city) {
    SumoReading reading{.city = city, .sent = {}, .refused = {}, .person = {}, .name = {}};
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                         XML_ParserFree);
    reading.parser = parser.get();
    XML_SetUserData(reading.parser, &reading);
    XML_SetElementHandler(reading.parser, begin_element, end_element);
    XML_SetEntityDeclHandler(reading.parser, refuse_entity);
    const bool is_read =
        XML_Parse(reading.parser, text.data(), static_cast<int>(text.size()), XML_TRUE) == XML_STATUS_OK;
    if (!reading.refused.empty()) return Error{reading.refused};
    if (!is_read)
        return Error{"is no XML in line " + std::to_string(XML_GetCurrentLineNumber(reading.parser)) + ": " +
                     XML_ErrorString(XML_GetErrorCode(reading.parser))};
    if (reading.sent.sendings.empty()) return Error{"sends nobody: it has no person with a walk"};
    if (reading.stages_left_out > 0)
        reading.sent.notes.push_back(std::to_string(reading.stages_left_out) +
                                     " rides and stops of persons are left out: they walk, and leave");
    if (reading.without_walk > 0)
        reading.sent.notes.push_back(std::to_string(reading.without_walk) +
                                     " persons and flows have no walk: they are not sent");
    return reading.sent;
}

}  // namespace flaneur
