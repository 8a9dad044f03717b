#include "tools/rendercheck/suite/suite.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/flaneur/options/spelling.h"
#include "tools/rendercheck/files/disk.h"
#include "tools/rendercheck/suite/reading.h"

namespace flaneur {
namespace {

using Json = nlohmann::json;

constexpr size_t k_most_bytes = size_t{1} << 24;
constexpr size_t k_most_cases = 10000;

bool is_name(const std::string& name) {
    return !name.empty() && name.size() <= 100 && name.front() != '.' && name.front() != '-' &&
           std::all_of(name.begin(), name.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '_' || c == '-'; });
}

constexpr const char* k_name_rule =
    "is no name: letters, digits, dots, dashes and underscores, no dot or dash first, 100 at most";

Environment environment(JsonReading& at, const Json& value) {
    Environment env;
    for (const auto& [name, one] : value.items()) {
        if (name.empty() || name.find('=') != std::string::npos)
            at.fail(name, "is no name of a variable");
        else if (one.is_null())
            env[name] = std::nullopt;
        else if (one.is_string())
            env[name] = one.get<std::string>();
        else
            at.fail(name, "must be a string, or null to take the variable out");
    }
    return env;
}

void read_tolerance(JsonReading& at, Tolerance& to) {
    at.number("differing", to.differing, 0, 1);
    at.number("over", to.over, 0, 1);
    at.number("step", to.step, 0, 255);
    double in_window = to.in_window;
    at.number("in_window", in_window, 0, k_window * k_window);
    to.in_window = static_cast<int>(in_window);
    at.number("flip", to.flip, 0, 1);
}

void read_size(JsonReading& at, SuiteCase& one) {
    std::string size;
    if (!at.text("size", size)) return;
    int used = 0;
    if (std::sscanf(size.c_str(), "%5dx%5d%n", &one.width, &one.height, &used) != 2 ||
        static_cast<size_t>(used) != size.size() || one.width < 1 || one.height < 1)
        at.fail("size", "must be WIDTHxHEIGHT in pixels, as \"640x360\"");
}

void read_ignored(JsonReading& at, SuiteCase& one) {
    const Json* boxes = at.list("ignore");
    if (!boxes) return;
    one.ignored.clear();
    for (const Json& box : *boxes) {
        const bool is_box =
            box.is_array() && box.size() == 4 && std::all_of(box.begin(), box.end(), [](const Json& n) {
                return n.is_number_integer() && n.get<int64_t>() >= 0 && n.get<int64_t>() <= 100000;
            });
        if (!is_box) return at.fail("ignore", "must be a list of boxes [left, top, width, height] in pixels");
        one.ignored.push_back({box[0].get<int>(), box[1].get<int>(), box[2].get<int>(), box[3].get<int>()});
    }
}

void read_parts(JsonReading& at, SuiteCase& one) {
    const Json* parts = at.list("parts");
    if (!parts) return;
    one.parts.clear();
    std::set<std::string> names;
    for (size_t n = 0; n < parts->size(); ++n) {
        JsonReading part(at.fault, at.where + "parts[" + std::to_string(n) + "].", (*parts)[n]);
        SuitePart read;
        std::string keep = "picture";
        part.text("name", read.name);
        part.text("file", read.file);
        part.text("legend", read.legend);
        part.text("keep", keep);
        part.finish();
        if (!is_name(read.name)) part.fail("name", k_name_rule);
        if (!names.insert(read.name).second) part.fail("name", "is that of another part too");
        if (read.file.empty()) part.fail("file", "is missing: say which file the command writes");
        if (keep != "picture" && keep != "hash") part.fail("keep", "must be \"picture\" or \"hash\"");
        read.is_hashed = keep == "hash";
        one.parts.push_back(std::move(read));
    }
}

// What a case and "defaults" may both say.
void read_common(JsonReading& at, SuiteCase& one) {
    read_size(at, one);
    at.object("tolerance", [&](JsonReading& inner) { read_tolerance(inner, one.tolerance); });
    at.text("mask", one.mask);
    read_ignored(at, one);
    at.texts("tags", one.tags);
    at.number("time_limit", one.time_limit, 0.01, 86400);
    at.number("disk_limit", one.disk_limit, 0.001, 1 << 20);
    if (const Json* env = at.member("env", Json::value_t::object))
        for (auto& [name, value] : environment(at, *env)) one.env[name] = value;
    double runs = one.runs;
    at.number("runs", runs, 1, 100);
    one.runs = static_cast<int>(runs);
    at.text("folder", one.folder);
    at.flag("shell", one.is_shell);
    read_parts(at, one);
}

void read_command(JsonReading& at, SuiteCase& one) {
    const Json* command = at.any("command");
    if (!command) return;
    if (one.is_shell) {
        if (!command->is_string() || command->get<std::string>().empty())
            return at.fail("command", "must be one string where \"shell\" is true");
        one.command = {command->get<std::string>()};
        return;
    }
    if (command->is_string())
        return at.fail(
            "command",
            "must be a list of words, as [\"program\", \"{out}\"]; one string takes \"shell\": true");
    const bool is_words =
        command->is_array() && !command->empty() &&
        std::all_of(command->begin(), command->end(), [](const Json& w) { return w.is_string(); });
    if (!is_words || command->front().get<std::string>().empty())
        return at.fail("command", "must be a list of words, the first of them the program");
    one.command = command->get<std::vector<std::string>>();
    for (const std::string& word : one.command)
        if (word.find('\0') != std::string::npos) at.fail("command", "has a word with a zero byte");
}

void read_pictures(JsonReading& at, SuiteCase& one) {
    std::string picture;
    const bool has_one = at.text("picture", picture);
    const bool has_many = at.texts("pictures", one.pictures);
    at.flag("stdout", one.is_stdout);
    if (has_one + has_many + (one.is_stdout ? 1 : 0) > 1)
        at.fail("picture", "stands beside \"pictures\" or \"stdout\": say one of the three");
    if (has_many && one.pictures.empty()) at.fail("pictures", "is empty");
    if (has_one) one.pictures = {picture};
    if (one.pictures.empty()) one.pictures = {one.is_stdout ? "{dir}/stdout" : "{out}"};
    std::set<std::string> stems;
    for (const std::string& file : one.pictures) {
        if (file.empty()) at.fail("picture", "is empty");
        const std::string stem = std::filesystem::path(file).stem().string();
        if (one.pictures.size() > 1 && !is_name(stem))
            at.fail("pictures", "has " + file + ", whose name without ending " + k_name_rule);
        if (!stems.insert(stem).second) at.fail("pictures", "names " + stem + " twice");
    }
}

void read_case(JsonReading& at, SuiteCase& one) {
    at.text("name", one.name);
    read_common(at, one);
    read_command(at, one);
    read_pictures(at, one);
    at.finish();
    if (one.command.empty()) at.fail("command", "is missing: say what draws, as a list of words");
    if (!is_name(one.name)) at.fail("name", one.name.empty() ? "is missing" : k_name_rule);
}

}  // namespace

Result<Suite> parse_suite(std::string_view json, const std::string& path) {
    Json root;
    try {
        root = Json::parse(json, nullptr, true, true);
    } catch (const Json::exception& fault) {
        return Error{path + " is no JSON: " + std::string(fault.what()) + "."};
    }
    Suite suite;
    suite.path = path;
    std::error_code failed;
    suite.folder = std::filesystem::absolute(path, failed).lexically_normal().parent_path().string();
    std::string fault;
    JsonReading at(fault, "", root);
    at.text("golden", suite.golden);
    at.text("key", suite.key);
    at.text("device", suite.device);
    if (!suite.key.empty() && !is_name(suite.key)) at.fail("key", k_name_rule);
    if (const Json* programs = at.member("programs", Json::value_t::object))
        for (const auto& [name, value] : programs->items()) {
            const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
                return std::isalpha(c) || c == '_';
            });
            if (!is_word || name == "out" || name == "dir" || name == "suite")
                at.fail("programs",
                        "has " + name + ", which is no name for one: letters, and not out, dir or suite");
            else if (!value.is_string() || value.get<std::string>().empty())
                at.fail("programs." + name, "must be a path, or a name to be found by PATH");
            else
                suite.programs[name] = value.get<std::string>();
        }
    if (const Json* env = at.member("env", Json::value_t::object)) suite.env = environment(at, *env);
    SuiteCase usual;
    at.object("defaults", [&](JsonReading& inner) { read_common(inner, usual); });
    if (const Json* cases = at.list("cases")) {
        if (cases->size() > k_most_cases) at.fail("cases", "has more than " + std::to_string(k_most_cases));
        std::set<std::string> names;
        for (size_t n = 0; n < cases->size() && fault.empty(); ++n) {
            const Json& value = (*cases)[n];
            const bool is_named = value.is_object() && value.contains("name") && value["name"].is_string();
            const std::string where = is_named ? "case " + value["name"].get<std::string>() + ": "
                                               : "cases[" + std::to_string(n) + "].";
            JsonReading inner(fault, where, value);
            SuiteCase one = usual;
            read_case(inner, one);
            const std::filesystem::path mask = std::filesystem::path(suite.folder) / one.mask;
            if (!one.mask.empty() && !std::filesystem::is_regular_file(mask, failed))
                inner.fail("mask", "is " + one.mask + ", which is no file beside the suite");
            if (!names.insert(one.name).second) inner.fail("name", "is that of another case too");
            suite.cases.push_back(std::move(one));
        }
    }
    at.finish();
    if (suite.cases.empty()) at.fail("cases", "is missing or empty: there is nothing to check");
    if (!fault.empty()) return Error{path + ": " + fault + "."};
    return suite;
}

Result<Suite> load_suite(const std::string& path) {
    Result<std::vector<uint8_t>> bytes = read_whole(path, k_most_bytes);
    if (!bytes) return bytes.error();
    return parse_suite({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace flaneur
