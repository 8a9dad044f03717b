#include "assets/files/json_place.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace flaneur {

namespace {

struct Scan {
    std::string_view text;
    size_t at = 0;
    char next() const { return at < text.size() ? text[at] : '\0'; }
};

void skip_blanks(Scan& s) { s.at = std::min(s.text.find_first_not_of(" \t\r\n", s.at), s.text.size()); }

void skip_string(Scan& s) {
    for (++s.at; s.at < s.text.size() && s.next() != '"'; ++s.at) s.at += s.next() == '\\';
    ++s.at;
}

// To the comma or bracket behind it.
void skip_value(Scan& s) {
    int depth = 0;
    while (s.at < s.text.size()) {
        char c = s.next();
        bool opens = c == '{' || c == '[', closes = c == '}' || c == ']';
        if (depth == 0 && (closes || c == ',')) return;
        depth += opens - closes;
        if (c == '"') {
            skip_string(s);
        } else {
            ++s.at;
        }
    }
}

// Before a value of an object or a list? Behind the last, skips the bracket.
bool is_at_value(Scan& s) {
    skip_blanks(s);
    if (s.at < s.text.size() && s.next() != '}' && s.next() != ']') return true;
    ++s.at;
    return false;
}

// To the value behind it.
std::string take_key(Scan& s) {
    size_t at = s.at;
    skip_string(s);
    std::string_view quoted = s.text.substr(at, s.at - at);
    skip_blanks(s);
    ++s.at;  // the colon
    skip_blanks(s);
    return nlohmann::json::parse(quoted).get<std::string>();
}

// From an object or a list to one of its values.
void enter(Scan& s, const std::string& step, bool of_key) {
    bool is_object = s.next() == '{';
    size_t found = s.at++;
    for (size_t i = 0; is_at_value(s); ++i) {
        size_t key_at = s.at;
        std::string name = is_object ? take_key(s) : std::to_string(i);
        if (name == step) found = of_key ? key_at : s.at;
        skip_value(s);
        s.at += s.next() == ',';
    }
    s.at = found;
}

std::optional<size_t> repeated_key(Scan& s) {
    if (s.next() != '{' && s.next() != '[') {
        skip_value(s);
        return {};
    }
    bool is_object = s.next() == '{';
    std::set<std::string> keys;
    ++s.at;
    while (is_at_value(s)) {
        size_t key_at = s.at;
        if (is_object && !keys.insert(take_key(s)).second) return key_at;
        if (auto below = repeated_key(s)) return below;
        skip_blanks(s);
        s.at += s.next() == ',';
    }
    return {};
}

Scan scan_of(std::string_view text) {
    Scan s{text, text.starts_with("\xef\xbb\xbf") ? size_t{3} : 0};
    skip_blanks(s);
    return s;
}

}  // namespace

JsonPlace place_at(std::string_view text, size_t at) {
    JsonPlace place;
    for (char c : text.substr(0, at)) {
        if (c == '\n') {
            ++place.line;
            place.column = 1;
        } else {
            place.column += (c & 0xc0) != 0x80;  // not within a character of UTF-8
        }
    }
    return place;
}

JsonPlace place_in_json(std::string_view text, const std::vector<std::string>& path, bool of_key) {
    Scan s = scan_of(text);
    for (size_t i = 0; i < path.size(); ++i) enter(s, path[i], of_key && i + 1 == path.size());
    return place_at(text, s.at);
}

std::string_view text_in_json(std::string_view text, const std::vector<std::string>& path) {
    Scan s = scan_of(text);
    for (const std::string& step : path) enter(s, step, false);
    const size_t begin = s.at;
    skip_value(s);
    std::string_view value = text.substr(begin, s.at - begin);
    return value.substr(0, value.find_last_not_of(" \t\r\n") + 1);
}

std::optional<size_t> find_repeated_key(std::string_view text) {
    Scan s = scan_of(text);
    return repeated_key(s);
}

}  // namespace flaneur
