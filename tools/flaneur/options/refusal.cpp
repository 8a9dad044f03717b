#include "tools/flaneur/options/refusal.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assets/files/words.h"
#include "tools/flaneur/options/spelling.h"

namespace flaneur {

namespace {

template <class T>
bool is_between(const std::string& text, T low, T high) {
    T value{};
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(text.data(), last, value);
    return error == std::errc() && end == last && value >= low && value <= high;  // nan is not
}

// 1e3 is 1000.
std::string without_exponent(const std::string& text) {
    constexpr double k_exact = 0x1p53;
    double value = 0;
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(text.data(), last, value);
    bool is_whole =
        error == std::errc() && end == last && std::floor(value) == value && std::fabs(value) <= k_exact;
    return is_whole ? std::to_string(static_cast<int64_t>(value)) : text;
}

std::vector<std::string> names_of_commands(CLI::App& app) {
    std::vector<std::string> names;
    for (CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> names_of_options(CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (CLI::App* group : app.get_subcommands({}))
        for (std::string& name : names_of_options(*group)) names.push_back(std::move(name));
    return names;
}

std::string no_command(CLI::App& app, int argc, char** argv) {
    std::string all;
    std::vector<std::string> names = names_of_commands(app);
    for (size_t i = 0; i < names.size(); ++i)
        all += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
    std::string word = argc > 1 ? argv[1] : "";
    std::string wrong;
    if (word.starts_with("-"))
        wrong = "there is no option " + word + " before a command; ";
    else if (!word.empty())
        wrong = "there is no command " + word + "; ";
    return wrong + "say what to do: " + all + "." + did_you_mean(word, names);
}

}  // namespace

Result<void> check_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& value : option->results()) {
            if (!value.empty() || option->get_type_size() == 0) continue;
            std::string type = option->get_type_name();
            if (type.starts_with("FILE")) type = "the name of a file";
            if (type.starts_with("FOLDER")) type = "the name of a folder";
            return Error{option->get_name() + " is empty: give " + type +
                         (option->get_required() ? "." : ", or leave it out.")};
        }
    }
    for (const CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; }))
        if (Result<void> filled = check_values(*group); !filled) return filled;
    return {};
}

CLI::Validator number_between(double low, double high) {
    return {[=](const std::string& text) {
                if (is_between(text, low, high)) return std::string();
                return text + " is not a number from " + plainly(low) + " to " + plainly(high);
            },
            ""};
}

CLI::Validator whole_between(int64_t low, int64_t high) {
    return {[=](std::string& text) {
                text = without_exponent(text);
                if (is_between(text, low, high)) return std::string();
                return text + " is not a whole number from " + std::to_string(low) + " to " +
                       std::to_string(high);
            },
            ""};
}

Error refusal(CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    auto chosen = app.get_subcommands();
    std::string who = chosen.empty() ? "flaneur" : "flaneur " + chosen.front()->get_name();
    std::string what = error.what();
    if (!chosen.empty()) {
        if (Result<void> filled = check_values(*chosen.front()); !filled) return filled.error();
    }
    if (chosen.empty()) {
        what = no_command(app, argc, argv);
    } else if (dynamic_cast<const CLI::ExtrasError*>(&error) ||
               (dynamic_cast<const CLI::RequiredError*>(&error) && app.remaining_size(true) > 0)) {
        std::string word = app.remaining(true).front();
        std::string option = word.substr(0, word.find('='));
        std::vector<std::string> known = names_of_options(*chosen.front());
        if (std::find(known.begin(), known.end(), option) != known.end())
            what = option + " comes after the command: " + who + " " + option + " ...";
        else
            what = who + " has no option or word " + word + "." +
                   (who == "flaneur render" && option == "--seconds"
                        ? " --frames says when: tick 600 is ten seconds in."
                        : did_you_mean(option, known));
    } else if (size_t colon = what.find(": "); what.starts_with("--") && colon != std::string::npos) {
        std::string name = what.substr(0, colon);
        const CLI::Option* option = chosen.front()->get_option_no_throw(name);
        if (option && dynamic_cast<const CLI::ArgumentMismatch*>(&error))
            what = name + " needs a value: " + option->get_type_name();
        else if (option)  // and not "--frames 1: is not ..."
            what.replace(colon, 2, " ");
    }
    if (!what.ends_with('.') && !what.ends_with('?')) what += ".";
    return Error{what + " `" + who + " --help` explains."};
}

}  // namespace flaneur
