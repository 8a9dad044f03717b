#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "assets/files/words.h"
#include "tools/flaneur/options/shell_words.h"
#include "tools/flaneur/options/spelling.h"
#include "tools/rendercheck/suite/suite.h"

namespace flaneur {

Placeholders placeholders_of(const Suite& suite, const std::string& dir) {
    Placeholders out{{"suite", suite.folder}, {"dir", dir}, {"out", dir + "/out.png"}};
    for (const auto& [name, path] : suite.programs) {
        const bool is_path = path.find('/') != std::string::npos;
        const std::filesystem::path whole = std::filesystem::path(suite.folder) / path;
        out[name] = is_path ? whole.lexically_normal().string() : path;
    }
    return out;
}

Result<std::string> filled(std::string_view text, const Placeholders& placeholders, bool is_shell) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '{') {
            out += text[i];
            continue;
        }
        if (text.substr(i).starts_with("{{")) {
            out += '{';
            ++i;
            continue;
        }
        size_t end = i + 1;
        while (end < text.size() && (std::isalpha(static_cast<unsigned char>(text[end])) || text[end] == '_'))
            ++end;
        if (end == text.size() || text[end] != '}' || end == i + 1) {
            out += '{';
            continue;
        }
        const std::string name(text.substr(i + 1, end - i - 1));
        const auto found = placeholders.find(name);
        if (found == placeholders.end()) {
            std::vector<std::string> known;
            for (const auto& [word, ignored] : placeholders) known.push_back(word);
            return Error{"{" + name + "} stands for nothing: " + joined(known) +
                         " do, and \"programs\" adds to them; {{ is a brace." + did_you_mean(name, known)};
        }
        out += is_shell ? shell_line({found->second}) : found->second;
        i = end;
    }
    return out;
}

Result<std::vector<std::string>> command_of(const SuiteCase& one, const Placeholders& placeholders) {
    std::vector<std::string> words;
    if (one.is_shell) words = {"/bin/sh", "-c"};
    for (const std::string& word : one.command) {
        Result<std::string> whole = filled(word, placeholders, one.is_shell);
        if (!whole) return Error{"case " + one.name + ": " + whole.error().message};
        words.push_back(std::move(*whole));
    }
    return words;
}

Result<Environment> environment_of(const Suite& suite, const SuiteCase& one,
                                   const Placeholders& placeholders) {
    Environment env = suite.env;
    for (const auto& [name, value] : one.env) env[name] = value;
    for (auto& [name, value] : env) {
        if (!value) continue;
        Result<std::string> whole = filled(*value, placeholders);
        if (!whole) return Error{"case " + one.name + ": env " + name + ": " + whole.error().message};
        value = std::move(*whole);
    }
    return env;
}

Result<void> check_filled(const Suite& suite, const SuiteCase& one) {
    const Placeholders places = placeholders_of(suite, "/");
    if (Result<std::vector<std::string>> words = command_of(one, places); !words) return words.error();
    if (Result<Environment> env = environment_of(suite, one, places); !env) return env.error();
    std::vector<std::string> files = one.pictures;
    files.push_back(one.folder);
    for (const SuitePart& part : one.parts) files.insert(files.end(), {part.file, part.legend});
    for (const std::string& file : files)
        if (Result<std::string> whole = filled(file, places); !whole)
            return Error{"case " + one.name + ": " + whole.error().message};
    return {};
}

bool is_chosen(const SuiteCase& one, std::string_view filter) {
    bool is_asked_for = false, asks = false;
    for (std::string_view part : split(filter, ',')) {
        if (part.empty()) continue;
        const bool leaves_out = part.front() == '-';
        const std::string word(part.substr(leaves_out ? 1 : 0));
        bool fits = fnmatch(word.c_str(), one.name.c_str(), 0) == 0;
        for (const std::string& tag : one.tags) fits = fits || fnmatch(word.c_str(), tag.c_str(), 0) == 0;
        if (leaves_out && fits) return false;
        if (!leaves_out) asks = true, is_asked_for = is_asked_for || fits;
    }
    return is_asked_for || !asks;
}

}  // namespace flaneur
