// Suites of cases as JSON: which commands draw, and how near to their references the pictures must be.
// docs/render-checks.md has every key; what is not known, or makes no sense, is refused with where it stands.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/result.h"
#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {

using Environment = std::map<std::string, std::optional<std::string>>;  // none: taken out

// A further picture that a command writes, of one pass, in the order of passes: it does not judge, and says
// what differs first and what is there.
struct SuitePart {
    std::string name, file;
    std::string legend;      // JSON beside a picture of ids that says what they stand for; "": none
    bool is_hashed = false;  // a hash is kept, not the picture
};

struct SuiteCase {
    std::string name;
    std::vector<std::string> command;  // words with placeholders; one of them where `is_shell`
    bool is_shell = false;
    std::vector<std::string> pictures;  // files, in {dir} where they are no whole paths
    bool is_stdout = false;             // the picture is what the command prints
    std::vector<SuitePart> parts;
    std::string folder;         // where it runs; "": beside the suite
    int width = 0, height = 0;  // what pictures must have; 0: anything
    Tolerance tolerance;
    std::string mask;
    std::vector<PixelBox> ignored;
    std::vector<std::string> tags;
    double time_limit = 60;   // seconds
    double disk_limit = 256;  // MiB
    Environment env;
    int runs = 1;
};

struct Suite {
    std::string path, folder;  // of the file; the folder is whole
    std::string golden = "golden";
    std::string key;     // of the references; "": by the Vulkan driver
    std::string device;  // words of the name of the one that draws; "": Vulkan's first
    std::map<std::string, std::string> programs;
    Environment env;
    std::vector<SuiteCase> cases;
};

// `path` is how errors name it.
Result<Suite> parse_suite(std::string_view json, const std::string& path);
Result<Suite> load_suite(const std::string& path);

// What placeholders stand for in one run of a case.
using Placeholders = std::map<std::string, std::string>;

// Of {suite}, {dir}, {out} and the suite's programs.
Placeholders placeholders_of(const Suite& suite, const std::string& dir);

// `{name}` by what it stands for, quoted for a shell where `is_shell`; `{{` is a brace. Refuses a name that
// is not known.
Result<std::string> filled(std::string_view text, const Placeholders& placeholders, bool is_shell = false);

// The words that are run: of a shell's line sh -c LINE.
Result<std::vector<std::string>> command_of(const SuiteCase& one, const Placeholders& placeholders);

// The suite's, and what the case says besides. Values have placeholders too.
Result<Environment> environment_of(const Suite& suite, const SuiteCase& one,
                                   const Placeholders& placeholders);

// Refuses a case in which something stands for nothing, wherever it does.
Result<void> check_filled(const Suite& suite, const SuiteCase& one);

// Whether it is meant by a filter: words with * and ?, of names and tags, with commas between; "-word" leaves
// out.
bool is_chosen(const SuiteCase& one, std::string_view filter);

}  // namespace flaneur
