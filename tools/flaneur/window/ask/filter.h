// What the room Find people is asked: "woman over 70 with cane", "waiting or slower than 0.5". Words that
// follow each other must all hold; "or" begins others that do as well; "not" is before a word that must not.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/window/ask/facts.h"

namespace flaneur {

struct Filter {
    using Holds = std::function<bool(const WalkerFacts&)>;
    std::vector<std::vector<Holds>> any;  // of which all must hold. None: nobody is asked for
    bool asks_where_to = false;           // then it needs facts_of(), else quick_facts_of() will do
};
bool holds(const Filter& filter, const WalkerFacts& facts);

// Whether somebody stands in a zone of that name; it refuses names that there are not.
struct Zones {
    std::vector<std::string> names;
    std::function<bool(const std::string& zone, Vec3 place)> holds;
};
// Errors are sentences that name the word and those that are known.
Result<Filter> parse_filter(std::string_view text, const Zones& zones = {});

// All words that it knows, in groups, for a hint.
struct FilterHint {
    const char *what, *words;
    bool is_words = true;  // else examples
};
std::vector<FilterHint> filter_hints();

}  // namespace flaneur
