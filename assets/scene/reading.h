// What the tables of a scene's keys are made of. Private to assets/scene.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/scene.h"

namespace flaneur {

// A reading under way: where it is, and what was wrong so far.
struct SceneReading {
    std::string_view text;
    std::vector<std::string> path;
    std::vector<SceneFault> faults;
};

std::string in_quotes(std::string text);

// Something is wrong where it is.
void add_fault(SceneReading& r, const std::string& what, bool of_key = false);

enum class KeyKind { flag, whole, number, text, texts, people, added, groups, recorded };

// What may stand at a key.
struct KeyRule {
    KeyKind kind;
    double low = 0, high = 0;             // of numbers; 2^64 stands for the greatest number of 64 bits
    std::string pattern = std::string();  // of a text: a regular expression; what it lets through is parsed
    // Texts that may stand there; none: any but the empty one.
    std::vector<std::string> words = std::vector<std::string>();
};

template <class Of>
struct SceneKey {
    const char* name;
    KeyRule rule;
    const char* usual;    // JSON: what holds without the key; null where nothing does
    const char* example;  // JSON
    const char* meaning;
    void (*take)(SceneReading& r, Of& to,
                 const nlohmann::json& value);  // a value that the rule has nothing against
};

template <class T, class To>
void take_parsed(SceneReading& r, const Result<T>& parsed, To& to) {
    if (parsed) {
        to = *parsed;
    } else {
        add_fault(r, in_quotes(r.path.back()) + ": " + parsed.error().message);
    }
}

template <size_t N>
std::vector<std::string> names(const std::string_view (&all)[N]) {
    return {std::begin(all), std::end(all)};
}

// The one of an enumeration that is called so.
template <class Word, size_t N>
Result<Word> word_of(const std::string_view (&all)[N], const std::string& name) {
    const auto* at = std::find(std::begin(all), std::end(all), name);
    if (at == std::end(all)) return Error{excerpt(name) + " is none of " + joined(names(all))};
    return static_cast<Word>(at - std::begin(all));
}

// What cannot be at once, as the reader sees it and as a schema says it of the key.
struct SceneClash {
    const char* key;  // of those the one to blame
    const char* what;
    bool (*is_there)(const Scene& scene, const nlohmann::json& json);
    nlohmann::ordered_json (*schema)(const char* key);
};
std::span<const SceneClash> scene_clashes();
inline std::string told_nobody(uint32_t walker, int walkers) {
    return R"("pushes": )" + std::to_string(walker) +
           " is nobody: walkers are numbered from 0, and there are " + std::to_string(walkers);
}

// One of "people": a file, or the built-in people.
struct PeopleItem {
    PeopleShare people;
    bool is_builtin = false;
};

// One of "added".
struct AddedItem {
    Addition added;
    bool has_kind = false, has_at = false, has_to = false, has_turn = false;
};

// How many go alone, in pairs, in threes and in fours.
using SizeShares = std::array<float, 4>;

// Of a scene, in the order of its schema and of docs/scenes.md; of one of "people", of one of "added", and of
// "groups".
const std::vector<SceneKey<Scene>>& scene_keys();
const std::vector<SceneKey<PeopleItem>>& people_keys();
const std::vector<SceneKey<AddedItem>>& added_keys();
const std::vector<SceneKey<SizeShares>>& group_keys();
// And of "trajectories".
const std::vector<SceneKey<Scene>>& recorded_keys();
// A bound of a number, whole ones without a point.
nlohmann::ordered_json schema_bound(double value);
// What is wrong with one as a whole; empty: nothing.
std::string fault_of(const AddedItem& item);

// Of a place X,Y,Z.
const std::string& coordinate_pattern();
std::string point_pattern();

// Keys of one kind: how many of some people there are,
template <float PeopleMix::*Times>
SceneKey<Scene> mix_key(const char* name, const char* meaning) {
    return {name,    {KeyKind::number, 0, k_most_mix},
            "1",     "2",
            meaning, [](SceneReading&, Scene& s, const nlohmann::json& v) { s.mix.*Times = v; }};
}

// or what goes along with so many of them.
template <float AlongShares::*Share>
SceneKey<Scene> along_key(const char* name, const char* meaning) {
    return {name,    {KeyKind::number, 0, 1},
            "0",     "0.05",
            meaning, [](SceneReading&, Scene& s, const nlohmann::json& v) { s.along.*Share = v; }};
}

// how many people do something where they stay.
template <float PastimeShares::*Share>
SceneKey<Scene> pastime_key(const char* name, const char* example, const char* meaning) {
    return {name,    {KeyKind::number, 0, 1},
            "0",     example,
            meaning, [](SceneReading&, Scene& s, const nlohmann::json& v) { s.pastimes.*Share = v; }};
}

// A value that is taken as it stands.
template <auto Member>
SceneKey<Scene> plain_key(const char* name, const KeyRule& rule, const char* usual, const char* example,
                          const char* meaning) {
    return {name,    rule,    usual,
            example, meaning, [](SceneReading&, Scene& s, const nlohmann::json& v) { s.*Member = v; }};
}

// One of an enumeration by its name.
template <auto Member, const auto& Names>
SceneKey<Scene> word_key(const char* name, const char* usual, const char* example, const char* meaning) {
    return {name,
            {KeyKind::text, 0, 0, {}, names(Names)},
            usual,
            example,
            meaning,
            [](SceneReading& r, Scene& s, const nlohmann::json& v) {
                using Word = std::remove_reference_t<decltype(s.*Member)>;
                take_parsed(r, word_of<Word>(Names, v), s.*Member);
            }};
}

}  // namespace flaneur
