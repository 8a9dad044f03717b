#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/flaneur/options/shell_words.h"
#include "tools/rendercheck/commands.h"
#include "tools/rendercheck/files/disk.h"

namespace flaneur {
namespace {

bool is_picture(const std::string& word) {
    const std::string ending = std::filesystem::path(word).extension().string();
    return ending == ".png" || ending == ".exr";
}

// What follows an option like --out, or else the last: those before it are read as often as written.
std::vector<std::string>::iterator picture_among(std::vector<std::string>& words) {
    auto found = words.end();
    for (auto at = words.begin() + 1; at != words.end(); ++at) {
        if (!is_picture(*at)) continue;
        found = at;
        const std::string& before = *(at - 1);
        if (before == "-o" || before.starts_with("--out")) break;
    }
    return found;
}

// Whether only a shell understands a line: pipes, variables, several commands.
bool is_for_a_shell(const std::string& line) {
    const size_t sets = line.find('=');
    return line.find_first_of("|&;<>$`*?~") != std::string::npos ||
           (sets != std::string::npos && sets < line.find(' '));
}

std::string ask(const char* question) {
    std::fputs(question, stdout);
    std::fflush(stdout);
    std::string line;
    std::getline(std::cin, line);
    return line;
}

}  // namespace

int run_init(const std::string& path, const std::vector<std::string>& command) {
    std::error_code failed;
    if (std::filesystem::exists(path, failed))
        return fail_with(k_exit_usage, path + " is there already: give another name.");
    std::vector<std::string> words = command;
    if (words.empty()) {
        const std::string line = ask("Which command draws one picture, as you would type it?\n> ");
        if (is_for_a_shell(line))
            return fail_with(
                k_exit_usage,
                "That takes a shell, which is asked only where a suite says so. Write "
                "{\"cases\": [{\"name\": \"first\", \"shell\": true, \"command\": \"... {out}\"}]} "
                "into " +
                    path + " (rendercheck run --help), or give a script of its own here.");
        Result<std::vector<std::string>> read = shell_words(line);
        if (!read) return fail_with(k_exit_usage, read.error().message);
        words = std::move(*read);
    }
    if (words.empty())
        return fail_with(k_exit_usage, "No command, no suite: say what draws, here or after --.");
    nlohmann::ordered_json one;
    one["name"] = "first";
    auto picture = picture_among(words);
    if (command.empty()) {
        const std::string guess = picture == words.end() ? "it prints the picture" : *picture;
        const std::string file = ask(
            ("Which file does it write? Enter: " + guess + "; - where it prints the picture.\n> ").c_str());
        if (!file.empty()) picture = std::find(words.begin() + 1, words.end(), file);
        if (picture == words.end() && !file.empty() && file != "-")
            one["picture"] = std::filesystem::absolute(file, failed).string();
    }
    for (std::string& word : words)  // of which none is a placeholder yet
        for (size_t at = 0; (at = word.find('{', at)) != std::string::npos; at += 2) word.insert(at, 1, '{');
    if (picture != words.end()) {
        // The ending says in which format.
        const bool is_exr = std::filesystem::path(*picture).extension() == ".exr";
        *picture = is_exr ? "{dir}/out.exr" : "{out}";
        if (is_exr) one["picture"] = "out.exr";
    } else if (!one.contains("picture")) {
        one["stdout"] = true;
        if (!command.empty())
            std::printf(
                "No word of it is a picture, so it is taken to print one. Where it writes a file, say which: "
                "\"picture\": \"/where/it/is.png\" instead of \"stdout\".\n");
    }
    one["command"] = words;
    nlohmann::ordered_json suite;
    suite["golden"] = "golden";
    suite["defaults"] = {{"time_limit", 60}};
    suite["cases"] = nlohmann::ordered_json::array({one});
    if (Result<void> written =
            write_whole(path, suite.dump(4, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        !written)
        return fail_with(k_exit_usage, written.error().message);
    std::printf(
        "Wrote %s. Next:\n  %s    takes its picture as the reference\n  %s    holds it against that from "
        "then on\n",
        path.c_str(), shell_line({"rendercheck", "run", path, "--bless"}).c_str(),
        shell_line({"rendercheck", "run", path}).c_str());
    return k_exit_passed;
}

}  // namespace flaneur
