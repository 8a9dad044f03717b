// Files of people who are sent: who comes in where and when, and goes where (docs/life/demand.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/place.h"
#include "sim/base/result.h"
#include "sim/coming/sending.h"

namespace flaneur {

struct City;

struct SentPeople {
    std::vector<Sending> sendings;   // one at least, and none of them without people
    std::vector<std::string> names;  // of each: what the file calls it, or its number
    std::vector<std::string> notes;  // what a file asks for and does not get, a sentence each
};

// Where on the ground plane a place on Earth is; none: the city is not a map.
std::optional<Vec2> place_on_plane(const City& city, const MapPlace& place);

// By how its name ends: .xml persons of SUMO, anything else JSON. Refuses, in a sentence, what cannot be
// read, what is not known in it, and more than k_most_sent people.
Result<SentPeople> load_demand(const std::string& path, const City& city);

// Of a text, whose errors have no subject.
Result<SentPeople> parse_demand(std::string_view json, const City& city);
Result<SentPeople> parse_sumo_persons(std::string_view xml, const City& city);

}  // namespace flaneur
