#include "tools/flaneur/options/shell_words.h"

#include <algorithm>
#include <cctype>

namespace flaneur {
namespace {

bool is_plain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-./,:=+@%").find(c) != std::string_view::npos;
}

std::string quoted(const std::string& word) {
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
    std::string out(1, '\'');
    for (const char c : word) {
        if (c == '\'')
            out.append("'\\''");
        else
            out.push_back(c);
    }
    out.push_back('\'');
    return out;
}

std::string_view name_of(std::string_view word) { return word.substr(0, word.find('=')); }

bool is_among(std::string_view name, std::span<const std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string shell_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line.append(line.empty() ? "" : " ").append(quoted(word));
    return line;
}

Result<std::vector<std::string>> shell_words(std::string_view line) {
    std::vector<std::string> words;
    char quote = 0;
    bool is_in_word = false;
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quote == 0 && std::isspace(static_cast<unsigned char>(c))) {
            is_in_word = false;
            continue;
        }
        if (!is_in_word && quote == 0 && c == '#') break;  // a comment
        if (!is_in_word) words.emplace_back();
        is_in_word = true;
        if (c == quote)
            quote = 0;
        else if (quote == 0 && (c == '\'' || c == '"'))
            quote = c;
        else if (c == '\\' && quote != '\'' && i + 1 < line.size())
            words.back().push_back(line[++i]);
        else
            words.back().push_back(c);
    }
    if (quote != 0) return Error{std::string("a quote, ").append(1, quote).append(", does not end")};
    return words;
}

std::vector<std::string> without_options(const std::vector<std::string>& words,
                                         std::span<const std::string_view> options,
                                         std::span<const std::string_view> flags) {
    std::vector<std::string> left;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view name = name_of(words[i]);
        if (is_among(name, flags)) continue;
        if (!is_among(name, options))
            left.push_back(words[i]);
        else if (name.size() == words[i].size())
            ++i;  // and its value
    }
    return left;
}

std::vector<std::string> only_options(const std::vector<std::string>& words,
                                      std::span<const std::string_view> options,
                                      std::span<const std::string_view> flags) {
    std::vector<std::string> kept;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view name = name_of(words[i]);
        const bool is_option = is_among(name, options);
        if (!is_option && !is_among(name, flags)) continue;
        kept.push_back(words[i]);
        const bool has_value_after = is_option && name.size() == words[i].size() && i + 1 < words.size();
        if (has_value_after) kept.push_back(words[++i]);
    }
    return kept;
}

bool has_option(const std::vector<std::string>& words, std::string_view option) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return name_of(word) == option; });
}

}  // namespace flaneur
