// Texts taken apart.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace flaneur {

// Whether all of `text` is a number, which `to` then is.
template <class T>
bool parse_number(std::string_view text, T& to) {
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
    return error == std::errc() && end == text.data() + text.size();
}

// A number as short as tells it from all others of its type, without an exponent.
template <class Number>
std::string plainly(Number value) {
    char text[400];  // the smallest double has 330 digits
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr};
}

// What stands between separators: one part more than there are separators.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0;;) {
        size_t next = text.find(separator, at);
        parts.push_back(text.substr(at, next - at));
        if (next == std::string_view::npos) return parts;
        at = next + 1;
    }
}

// "a, b, c"
template <class Words>
std::string joined(const Words& words) {
    std::string all;
    for (const auto& word : words) {
        if (!all.empty()) all += ", ";
        all += word;
    }
    return all;
}

}  // namespace flaneur
