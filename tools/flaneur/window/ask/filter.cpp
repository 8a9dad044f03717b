#include "tools/flaneur/window/ask/filter.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "assets/files/file.h"
#include "assets/files/words.h"

namespace flaneur {
namespace {

constexpr float k_stands = 0.1f, k_runs = 2.2f;  // m/s: below, from

using Holds = Filter::Holds;

struct Word {
    const char* word;
    bool (*holds)(const WalkerFacts& facts);
    bool asks_where_to = false;
};
bool is_at_goal(const WalkerFacts& f) { return f.doing == Doing::stays || f.doing == Doing::arrived; }
template <DestinationKind Kind>
bool goes_to(const WalkerFacts& f) {
    return f.to == Kind;
}

constexpr Word k_words[] = {
    {"woman", [](const WalkerFacts& f) { return f.is_built_in && f.is_woman && f.age >= k_grown_up; }},
    {"man", [](const WalkerFacts& f) { return f.is_built_in && !f.is_woman && f.age >= k_grown_up; }},
    {"girl", [](const WalkerFacts& f) { return f.is_built_in && f.is_woman && f.age < k_grown_up; }},
    {"boy", [](const WalkerFacts& f) { return f.is_built_in && !f.is_woman && f.age < k_grown_up; }},
    {"child", [](const WalkerFacts& f) { return f.is_built_in && f.age < k_grown_up; }},
    {"adult", [](const WalkerFacts& f) { return f.is_built_in && f.age >= k_grown_up; }},
    {"old", [](const WalkerFacts& f) { return f.is_built_in && f.age >= k_old_age; }},
    {"cane", [](const WalkerFacts& f) { return f.cane; }},
    {"pram", [](const WalkerFacts& f) { return f.pram; }},
    {"phone", [](const WalkerFacts& f) { return f.phone; }},
    {"glasses", [](const WalkerFacts& f) { return f.glasses; }},
    {"bag", [](const WalkerFacts& f) { return f.bag != Bag::none; }},
    {"backpack", [](const WalkerFacts& f) { return f.bag == Bag::backpack; }},
    {"waiting", is_at_goal},
    {"standing", [](const WalkerFacts& f) { return f.speed < k_stands; }},
    {"walking", [](const WalkerFacts& f) { return f.speed >= k_stands && f.speed < k_runs; }},
    {"running", [](const WalkerFacts& f) { return f.speed >= k_runs; }},
    {"stuck", [](const WalkerFacts& f) { return f.doing == Doing::is_stuck || f.doing == Doing::is_lost; }},
    {"slowed", [](const WalkerFacts& f) { return f.doing == Doing::is_held || f.doing == Doing::gives_way; }},
};
constexpr Word k_places[] = {
    {"door", goes_to<DestinationKind::door>, true},   {"shop", goes_to<DestinationKind::shop>, true},
    {"bench", goes_to<DestinationKind::bench>, true}, {"stop", goes_to<DestinationKind::stop>, true},
    {"edge", goes_to<DestinationKind::edge>, true},   {"square", goes_to<DestinationKind::square>, true},
};

struct Twin {
    const char *said, *meant;
};
constexpr Twin k_twins[] = {
    {"women", "woman"},    {"female", "woman"},    {"men", "man"},
    {"male", "man"},       {"girls", "girl"},      {"boys", "boy"},
    {"children", "child"}, {"kid", "child"},       {"kids", "child"},
    {"adults", "adult"},   {"elderly", "old"},     {"stick", "cane"},
    {"canes", "cane"},     {"prams", "pram"},      {"stroller", "pram"},
    {"phones", "phone"},   {"bags", "bag"},        {"backpacks", "backpack"},
    {"waits", "waiting"},  {"stands", "standing"}, {"walks", "walking"},
    {"runs", "running"},   {"shops", "shop"},      {"doors", "door"},
    {"benches", "bench"},  {"stops", "stop"},      {"squares", "square"},
    {"above", "over"},     {"older", "over"},      {"below", "under"},
    {"younger", "under"},  {"who", "and"},         {"with", "and"},
    {"people", "and"},     {"is", "and"},          {"going", "and"},
    {"are", "and"},        {"a", "and"},           {"m/s", "and"},
    {"metres", "and"},     {"years", "and"},
};

// A comparison with a number: "over 70", "faster than 1.5".
struct Measure {
    const char* word;
    bool is_more;
    float (*value)(const WalkerFacts& facts);
};
float age_of(const WalkerFacts& f) { return f.is_built_in ? f.age : std::nanf(""); }
constexpr Measure k_measures[] = {
    {"over", true, age_of},
    {"under", false, age_of},
    {"faster", true, [](const WalkerFacts& f) { return f.speed; }},
    {"slower", false, [](const WalkerFacts& f) { return f.speed; }},
    {"taller", true, [](const WalkerFacts& f) { return f.height; }},
    {"shorter", false, [](const WalkerFacts& f) { return f.height; }},
};

// In small letters, parted by spaces and commas.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words(1);
    for (const char c : text) {
        if (c == ' ' || c == ',' || c == '\t') {
            if (!words.back().empty()) words.emplace_back();
        } else {
            words.back().push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
        }
    }
    if (words.back().empty()) words.pop_back();
    for (std::string& word : words)
        for (const Twin& twin : k_twins)
            if (word == twin.said) word = twin.meant;
    return words;
}

std::string known_words() {
    std::string all;
    for (const FilterHint& hint : filter_hints())
        if (hint.is_words) all.append(all.empty() ? "" : "; ").append(hint.words);
    return all;
}

// Reads words one after the other.
struct Reader {
    std::vector<std::string> words;
    size_t at = 0;
    const Zones& zones;

    bool is_done() const { return at >= words.size(); }
    bool takes(const char* word) {
        const bool is_it = !is_done() && words[at] == word;
        if (is_it) ++at;
        return is_it;
    }
    // The next word as a number, if it is one.
    std::optional<float> number() {
        float value = 0;
        if (is_done() || !parse_number(words[at], value)) return {};
        ++at;
        return value;
    }

    Result<Holds> condition(bool& asks_where_to) {
        const std::string word = words[at++];
        if (word == "not") {
            if (is_done()) return Error{"\"not\" stands before what must not be, such as \"not waiting\"."};
            Result<Holds> other = condition(asks_where_to);
            if (!other) return other;
            return Holds([no = *other](const WalkerFacts& f) { return !no(f); });
        }
        for (const Measure& measure : k_measures)
            if (word == measure.word) return comparison(measure);
        if (word == "to") {
            takes("and");  // "to a shop"
            for (const Word& place : k_places)
                if (takes(place.word)) return asks_where_to = true, Holds(place.holds);
            return Error{"After \"to\" comes one of door, shop, bench, stop, square and edge."};
        }
        if (word == "in") return zone();
        if (word == "no." || word == "no" || word == "number") {
            if (const auto value = number()) return numbered(*value);
            return Error{"After \"" + word + "\" comes somebody's number, such as \"no. 12\"."};
        }
        float value = 0;
        if (parse_number(word[0] == '#' ? word.substr(1) : word, value)) return numbered(value);
        for (const Word& one : k_words)
            if (word == one.word) return Holds(one.holds);
        return Error{excerpt(word) + " is none of the words that are known: " + known_words() + "."};
    }
    static Result<Holds> numbered(float value) {
        return Holds([value](const WalkerFacts& f) { return static_cast<float>(f.number) == value; });
    }
    Result<Holds> comparison(const Measure& measure) {
        takes("than");
        const auto value = number();
        if (!value)
            return Error{std::string("After \"") + measure.word + "\" comes a number: \"over 70\" (years), " +
                         "\"faster than 1.5\" (m/s), \"taller than 1.9\" (metres)."};
        return Holds([measure, most = *value](const WalkerFacts& f) {
            return measure.is_more ? measure.value(f) > most : measure.value(f) < most;
        });
    }
    Result<Holds> zone() {
        for (const std::string& zone : zones.names) {
            std::string name = zone;
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return std::tolower(c); });
            if (!takes(name.c_str())) continue;
            return Holds([zone, is_in = zones.holds](const WalkerFacts& f) { return is_in(zone, f.place); });
        }
        if (zones.names.empty()) return Error{"\"in\" asks for a zone: draw one in the room Measure first."};
        return Error{"After \"in\" comes a zone: " + joined(zones.names) + "."};
    }
};

}  // namespace

bool holds(const Filter& filter, const WalkerFacts& facts) {
    return std::any_of(filter.any.begin(), filter.any.end(), [&](const std::vector<Holds>& all) {
        return std::all_of(all.begin(), all.end(), [&](const Holds& one) { return one(facts); });
    });
}

Result<Filter> parse_filter(std::string_view text, const Zones& zones) {
    Filter filter;
    Reader reader{words_of(text), 0, zones};
    while (!reader.is_done()) {
        if (reader.takes("and")) continue;
        if (reader.takes("or")) {
            if (filter.any.empty() || filter.any.back().empty() || reader.is_done())
                return Error{"\"or\" stands between two, such as \"cane or pram\"."};
            filter.any.emplace_back();
            continue;
        }
        if (filter.any.empty()) filter.any.emplace_back();
        Result<Holds> one = reader.condition(filter.asks_where_to);
        if (!one) return one.error();
        filter.any.back().push_back(std::move(*one));
    }
    if (!filter.any.empty() && filter.any.back().empty())
        return Error{"\"or\" stands between two, such as \"cane or pram\"."};
    return filter;
}

std::vector<FilterHint> filter_hints() {
    return {{"who", "woman, man, girl, boy, child, adult, old"},
            {"age in years", "over 70, under 6"},
            {"height in metres", "taller than 1.9, shorter than 1.2"},
            {"with", "cane, pram, phone, glasses, bag, backpack"},
            {"speed in m/s", "faster than 1.5, slower than 0.5, standing, walking, running"},
            {"doing", "waiting, stuck, slowed"},
            {"going", "to door, shop, bench, stop, square or edge"},
            {"where", "in Z1, a zone of the room Measure"},
            {"a number", "12", false},
            {"together", "woman over 70 with cane; child or pram; not waiting", false}};
}

}  // namespace flaneur
