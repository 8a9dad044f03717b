// What names in a file say of what they name.
#include <string>
#include <string_view>
#include <vector>

#include "assets/gltf/city/ground.h"

namespace flaneur {

namespace {

struct Word {
    std::string_view word;
    Hint hint;
};

constexpr Hint ground_of(Surface kind) { return {kind, true, true}; }
constexpr Hint k_wall = {Surface::plaza, false, true}, k_leaves = {Surface::plaza, false, false};

// Earlier words go before later ones: a "street lamp" is a lamp.
constexpr Word k_words[] = {
    {"backdrop", k_leaves},
    {"roof", k_wall},
    {"car", k_wall},
    {"truck", k_wall},
    {"vehicle", k_wall},
    {"lamp", k_wall},
    {"light", k_wall},
    {"streetlight", k_wall},
    {"trafficlight", k_wall},
    {"trunk", k_wall},
    {"metal", k_wall},
    {"facade", k_wall},
    {"leaf", k_leaves},
    {"leave", k_leaves},
    {"foliage", k_leaves},
    {"bush", k_leaves},
    {"crosswalk", ground_of(Surface::crossing)},
    {"crossing", ground_of(Surface::crossing)},
    {"zebra", ground_of(Surface::crossing)},
    {"sidewalk", ground_of(Surface::sidewalk)},
    {"pavement", ground_of(Surface::sidewalk)},
    {"footway", ground_of(Surface::sidewalk)},
    {"kerb", ground_of(Surface::sidewalk)},
    {"curb", ground_of(Surface::sidewalk)},
    {"step", ground_of(Surface::steps)},
    {"stair", ground_of(Surface::steps)},
    {"grass", ground_of(Surface::grass)},
    {"lawn", ground_of(Surface::grass)},
    {"park", ground_of(Surface::grass)},
    {"water", ground_of(Surface::water)},
    {"river", ground_of(Surface::water)},
    {"pond", ground_of(Surface::water)},
    {"sea", ground_of(Surface::water)},
    {"ballast", ground_of(Surface::track)},
    {"sleeper", ground_of(Surface::track)},
    {"path", ground_of(Surface::path)},
    {"trail", ground_of(Surface::path)},
    {"plaza", ground_of(Surface::plaza)},
    {"square", ground_of(Surface::plaza)},
    {"road", ground_of(Surface::road)},
    {"street", ground_of(Surface::road)},
    {"asphalt", ground_of(Surface::road)},
};

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

// "StoneStairs_01" is stone, stair.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words;
    for (size_t i = 0; i < name.size(); ++i) {
        char c = name[i];
        if (!is_lower(c) && !is_upper(c)) continue;
        bool begins = i == 0 || (!is_lower(name[i - 1]) && !is_upper(name[i - 1])) ||
                      (is_upper(c) && is_lower(name[i - 1]));
        if (begins || words.empty()) words.emplace_back();
        words.back() += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
    }
    for (std::string& word : words)
        if (word.size() > 3 && word.back() == 's' && word[word.size() - 2] != 's') word.pop_back();
    return words;
}

}  // namespace

bool read_hint(const std::string& name, Hint& hint) {
    std::vector<std::string> words = words_of(name);
    for (const Word& known : k_words)
        for (const std::string& word : words)
            if (word == known.word) {
                hint = known.hint;
                return true;
            }
    return false;
}

}  // namespace flaneur
